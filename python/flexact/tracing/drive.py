# SPDX-License-Identifier: BSD-3-Clause
"""The declared coordinate or deformation that drives a path."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..analysis.freedoms import Freedom
from ..core.arrays import FloatArray
from ..core.elements import Dual, NodeKind, dual_table
from ..model.configuration import Configuration
from ..motion import Held
from ..show.drawing.drawing_pose import Pose
from ..show.drawing.rotations import vector_of
from ..show.drawing.selection import Selection


class Drive(NamedTuple):
    """What drives a path, and how to look at it."""

    freedom: Freedom
    held: Held

    @property
    def unit(self) -> str:
        """Of its value, m or rad."""
        return drive_unit(self.freedom)

    def rate(self, where: Configuration, along: FloatArray) -> float:
        """How fast it changes along a direction (n,)."""
        part, owner = self.freedom.place
        if self.freedom.is_coordinate:
            return float(self.held.at_nodes(along)[owner, part])
        return self.held.rate(where, 6 * owner + part, along)

    def value(self, where: Configuration, pose: Pose) -> float:
        """By how much it has changed since the reference [m, rad]; of a pose as given.

        Of a declared rotation it is the component of the rotation vector.
        """
        part, owner = self.freedom.place
        if not self.freedom.is_coordinate:
            value = self.held.deformation(where, 6 * owner + part)
            return value * self.held.sizes.unit if self.unit == "m" else value
        analysis = self.freedom.analysis
        node = int(analysis.condensed.nodes[owner])
        if self.unit == "m":
            start = analysis.given.arrays.node_value[part, node]
            return float(pose.position[node, part] - start)
        return float(vector_of(pose.rotation[node][np.newaxis])[0, part])


def drive_of(shown: Selection, held: Held) -> Drive | None:
    """What drives the path of a declared degree of freedom; None of another motion."""
    return None if shown.freedom is None else Drive(shown.freedom, held)


def drive_unit(freedom: Freedom) -> str:
    """Of a declared coordinate or deformation: m or rad."""
    part, owner = freedom.place
    arrays = freedom.analysis.data.arrays
    if freedom.is_coordinate:
        return "m" if arrays.node_kind[owner] <= NodeKind.POSITION else "rad"
    turns = dual_table()[arrays.element_kind[owner], part] == Dual.MOMENT
    return "rad" if turns else "m"
