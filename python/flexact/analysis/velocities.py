# SPDX-License-Identifier: BSD-3-Clause
"""The velocities of the nodes of a model, and of those inside its divided sheets and wires."""

from __future__ import annotations

from dataclasses import dataclass

from ..core.arrays import FloatArray
from ..model.data import ModelData
from ..model.parts.condensing import Condensed
from ..util.records import Frozen


@dataclass(frozen=True, eq=False)
class Velocities(Frozen):
    """The velocities of all nodes of a model.

    Attributes:
        data: The model.
        displacement: (nodes, 3) of each position [m]; zero rows for orientations.
        rotation: (nodes, 3) of each orientation [rad]; zero rows for positions.
    """

    data: ModelData
    displacement: FloatArray
    rotation: FloatArray

    def at_all_nodes(self, condensed: Condensed) -> tuple[FloatArray, FloatArray]:
        """Displacement and rotation at the nodes of the model as it was given."""
        if not condensed.chains:
            return self.displacement, self.rotation
        made = condensed.motion(self.displacement, self.rotation)
        for array in made:
            array.flags.writeable = False
        return made
