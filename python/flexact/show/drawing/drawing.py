# SPDX-License-Identifier: BSD-3-Clause
"""A drawing: all that is drawn of a model in its reference configuration."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...core.elements import NodeKind
from ...model.data import ModelData
from ...util.records import Frozen, cached_property, kept
from .bodies import Solid, solids_of
from .members import Elements, Members, hinges_of, members_of
from .pose import Pose, axes_along, reference_pose
from .supports import Symbol, arrows_of, supports_of

#: Diameter of a joint, times that of the bars.
_BALL = 1.9


@dataclass(frozen=True, eq=False)
class Drawing(Frozen):
    """What is drawn of a model.

    Attributes:
        data: The model.
        members: Drawn elements with two ends.
        hinges: Drawn elements without extent.
        supports: Symbols of fixed coordinates.
        arrows: Of the independent coordinates, as of `arrows_of`.
        reference: Where the nodes are.
        low: (3,) corner of the box round all positions [m].
        high: (3,) the opposite corner [m].
    """

    data: ModelData
    members: Members
    hinges: Elements
    supports: tuple[Symbol, ...]
    arrows: tuple[np.ndarray, FloatArray, np.ndarray]
    reference: Pose
    low: FloatArray
    high: FloatArray

    @cached_property
    def solids(self) -> list[Solid]:
        """The rigid bodies that are drawn as solids."""
        return solids_of(self.data, self.members, self.size, self.reference.position)

    @cached_property
    def in_solid(self) -> np.ndarray:
        """(members,) whether a member is a part of a solid, in whose place it is not drawn."""
        made = np.zeros(len(self.members), bool)
        for solid in self.solids:
            made[solid.rows] = True
        return made

    @property
    def seen(self) -> np.ndarray:
        """(members,) which members are drawn themselves."""
        return np.asarray(self.members.seen & ~self.in_solid)

    @cached_property
    def axes(self) -> list[FloatArray]:
        """Points of the axes of members in the reference, as of `axes_along`."""
        return list(axes_along(self.members, self.reference))

    @property
    def planar(self) -> bool:
        """Whether everything lies in the xy plane."""
        return self.data.planar

    @property
    def size(self) -> float:
        """Diagonal of the box round all positions [m]; 1 where they are one point."""
        return _size(self.low, self.high)

    @property
    def centre(self) -> FloatArray:
        """(3,) middle of that box [m]."""
        return np.asarray(self.low / 2 + self.high / 2)


def drawing_of(data: ModelData) -> Drawing:
    """The drawing of a sound model, made once."""
    return kept(data, Drawing, lambda: _drawing_of(data))


def _drawing_of(data: ModelData) -> Drawing:
    arrays = data.arrays
    reference = reference_pose(arrays)
    there = reference.position[arrays.node_kind <= NodeKind.POSITION]
    low = there.min(axis=0) if len(there) else np.zeros(3)
    high = there.max(axis=0) if len(there) else np.zeros(3)
    size = _size(low, high)
    members = members_of(data, size)
    return Drawing(
        data,
        members,
        hinges_of(data),
        supports_of(arrays, members, size),
        arrows_of(arrays),
        reference,
        low,
        high,
    )


def _size(low: FloatArray, high: FloatArray) -> float:
    return float(np.linalg.norm(high - low)) or 1.0


def joints_of(drawing: Drawing) -> tuple[np.ndarray, FloatArray]:
    """(j,) position nodes about which members turn freely, (j,) radii of their joints [m].

    Bars do, and members that end at one position with different orientations, unless a hinge
    stands there or none of them is seen.
    """
    members = drawing.members
    nodes = drawing.reference.position.shape[0]
    place = members.nodes[:, [0, 2]].ravel()
    turn = members.nodes[:, [1, 3]].copy()
    # The far end of a rigid link turns with its near end.
    turn[:, 1] = np.where(turn[:, 1] < 0, turn[:, 0], turn[:, 1])
    turn = turn.ravel()
    thick = np.repeat(members.section.max(axis=1), 2)
    bar = turn < 0
    size, solid_size = np.zeros(nodes), np.full(nodes, np.inf)
    np.maximum.at(size, place[bar], _BALL * thick[bar])
    pairs = np.unique(np.stack((place[~bar], turn[~bar]), axis=1), axis=0)
    orientations = np.bincount(pairs[:, 0], minlength=nodes)
    np.minimum.at(solid_size, place[~bar], thick[~bar])
    pinned = orientations > 1
    size[pinned] = np.maximum(size[pinned], 1.15 * solid_size[pinned])
    bars = np.bincount(place[bar], minlength=nodes)
    size[(orientations == 0) & (bars == 0)] = 0.0
    size[drawing.hinges.nodes[drawing.hinges.nodes[:, 0] >= 0, 0]] = 0.0
    unseen = np.ones(nodes, bool)
    unseen[members.nodes[members.seen][:, [0, 2]]] = False
    size[unseen] = 0.0
    node = np.flatnonzero(size > 0.0)
    return node, size[node] / 2
