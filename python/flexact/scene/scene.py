"""A scene: all that is drawn of a model in its reference configuration."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..elements import NodeKind
from ..exchange import FloatArray
from ..frozen import Frozen
from ..model_data import ModelData
from .hinges import Hinges, hinges_of
from .members import Members, members_of
from .pose import Pose, reference_pose
from .supports import Arrows, Supports, arrows_of, supports_of


@dataclass(frozen=True, eq=False)
class Scene(Frozen):
    """What is drawn of a model.

    Attributes:
        data: The model.
        members: Drawn elements with two ends.
        hinges: Drawn elements without extent.
        supports: Symbols of fixed coordinates.
        arrows: Symbols of independent coordinates.
        reference: Where the nodes are.
        low: (3,) corner of the box round all positions [m].
        high: (3,) the opposite corner [m].
    """

    data: ModelData
    members: Members
    hinges: Hinges
    supports: Supports
    arrows: Arrows
    reference: Pose
    low: FloatArray
    high: FloatArray

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
        middle: FloatArray = self.low / 2 + self.high / 2
        return middle


def scene_of(data: ModelData) -> Scene:
    """The scene of a sound model."""
    arrays = data.arrays
    reference = reference_pose(arrays)
    there = reference.position[arrays.node_kind <= NodeKind.POSITION]
    low = there.min(axis=0) if len(there) else np.zeros(3)
    high = there.max(axis=0) if len(there) else np.zeros(3)
    size = _size(low, high)
    members = members_of(data, reference.position, size)
    return Scene(
        data,
        members,
        hinges_of(data, size),
        supports_of(arrays, members, size),
        arrows_of(arrays),
        reference,
        low,
        high,
    )


def _size(low: FloatArray, high: FloatArray) -> float:
    return float(np.linalg.norm(high - low)) or 1.0
