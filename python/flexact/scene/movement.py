"""A motion as it is drawn: poses from one end of a swing to the other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..exchange import FloatArray
from ..frozen import Frozen
from ..model_data import ModelData
from .field import field_along
from .path import follow
from .pose import Pose, reference_pose
from .rotations import between
from .scene import Scene
from .screws import moved_by_screws

#: The largest displacement that is drawn, as a part of the scene's size.
AMPLITUDE = 0.1
#: The largest rotation that is drawn [rad].
_LARGEST_ROTATION = 1.0
#: Poses to each side of the reference.
_STEPS = 8
#: Deformations on a path, as a part of the scene's size: up to here they are rounding, and up
#: to here nobody sees them.
_TRUE = 1.0e-9
_UNSEEN = 1.0e-3


class Moving(Protocol):
    """A motion at the nodes: of an analysis, or of a declared degree of freedom."""

    @property
    def data(self) -> ModelData:
        """The model in which it is a motion that nothing determines."""

    @property
    def displacement(self) -> FloatArray:
        """(nodes, 3) [m]."""

    @property
    def rotation(self) -> FloatArray:
        """(nodes, 3) [rad]."""


@dataclass(frozen=True, eq=False)
class Movement(Frozen):
    """A motion as it is drawn.

    Attributes:
        scale: What the motion is multiplied by, so that the largest displacement along the
            members is a tenth of the scene's size, and no rotation larger than 1 rad.
        deviation: The largest deformation in the poses that the motion holds, as a part of the
            scene's size; infinite where none of it was looked at and rigid bodies move on the
            screws of the motion.
        phases: (17,) from -1 to 1; 0 is the reference.
        poses: One a phase.
    """

    scale: float
    deviation: float
    phases: FloatArray
    poses: tuple[Pose, ...]

    @property
    def true_path(self) -> bool:
        """Whether the mechanism can move so far: the held deformations stay zero."""
        return self.deviation <= _TRUE

    def pose(self, phase: float) -> Pose:
        """The pose at a phase from -1 to 1, between the two nearest ones."""
        place = np.clip((phase + 1) / 2, 0.0, 1.0) * (len(self.poses) - 1)
        first = min(int(place), len(self.poses) - 2)
        share = float(place - first)
        one, other = self.poses[first], self.poses[first + 1]
        position = (1 - share) * one.position + share * other.position
        turned = between(one.rotation, other.rotation, np.array([share]))[:, 0]
        return Pose(position, turned)


def move(scene: Scene, motion: Moving) -> Movement:
    """The poses of a motion on both sides of the reference.

    They lie on a path on which the deformations that the motion holds stay zero, or so small
    that nobody sees them, where there is one and the model is not large.
    """
    scale = scale_of(scene, motion)
    shares = scale * np.arange(1, _STEPS + 1) / _STEPS
    sides = [follow(motion, sign * shares, scene.size) for sign in (-1.0, 1.0)]
    found = [side.poses for side in sides if side is not None and side.deviation <= _UNSEEN]
    deviation = max(side.deviation if side is not None else np.inf for side in sides)
    if len(found) < len(sides):
        deviation = np.inf
        found = [
            tuple(moved_by_screws(motion, sign * share) for share in shares.tolist())
            for sign in (-1.0, 1.0)
        ]
    poses = (*found[0][::-1], reference_pose(scene.data.arrays), *found[1])
    return Movement(scale, deviation, np.linspace(-1.0, 1.0, len(poses)), poses)


def scale_of(scene: Scene, motion: Moving) -> float:
    """What a motion is multiplied by when it is drawn."""
    along = field_along(scene.members, motion.displacement, motion.rotation)
    largest = max(
        (float(np.linalg.norm(each.displacement, axis=-1).max(initial=0.0)) for each in along),
        default=0.0,
    )
    largest = max(largest, float(np.linalg.norm(motion.displacement, axis=1).max(initial=0.0)))
    turned = float(np.linalg.norm(motion.rotation, axis=1).max(initial=0.0))
    bounds = []
    if largest > 0.0:
        bounds.append(AMPLITUDE * scene.size / largest)
    if turned > 0.0:
        bounds.append(_LARGEST_ROTATION / turned)
    return min(bounds, default=0.0)
