# SPDX-License-Identifier: BSD-3-Clause
"""An elastic shape as it is drawn: a displacement field, enlarged, to both sides of a state."""

from __future__ import annotations

import numpy as np

from ...core.arrays import FloatArray
from ...core.elements import NodeKind
from ...model.configuration import Configuration
from .drawing import Drawing
from .drawing_pose import Pose, pose_of
from .movement import Movement, amplitude_of
from .path import BodyMoves
from .pose import field_along

#: Poses from one end to the other, of which the middle one is the state itself.
_POSES = 5
#: The largest rotation that is drawn [rad].
_LARGEST_ROTATION = 0.4


def swing(
    drawing: Drawing, state: Configuration, displacement: FloatArray, about: str = "Enlarged."
) -> Movement:
    """The poses of a vibrating or buckled shape.

    The largest displacement along the members is a tenth of the drawing's size, or a quarter of
    the size of what moves where that is less, unless a rotation would be larger than 0.4 rad.
    Rigid bodies keep their shapes.

    Args:
        drawing: The drawing of the model whose nodes are displaced.
        state: Where its nodes are without the shape.
        displacement: (nodes, 3) of positions, and rotations (spins) of orientations; only their
            ratios matter.
        about: What is said of it, a sentence.
    """
    arrays = drawing.data.arrays
    placed = (arrays.node_kind <= NodeKind.POSITION)[:, None]
    moved, turned = np.where(placed, displacement, 0.0), np.where(placed, 0.0, displacement)
    amplitude, part = amplitude_of(drawing, moved, turned)
    scale = _scale(drawing, moved, turned, amplitude)
    start, bodies = pose_of(arrays, state), BodyMoves(arrays)
    phases = np.linspace(-1.0, 1.0, _POSES)

    def pose(share: float) -> Pose:
        there = pose_of(arrays, state.moved(share * (moved + turned)))
        position = bodies.carried(start.position, there.position, share * turned)
        return Pose(np.where(placed, position, 0.0), there.rotation)

    poses = tuple(pose(scale * phase) for phase in phases.tolist())
    return Movement(scale, np.nan, phases, poses, about, part)


def _scale(drawing: Drawing, moved: FloatArray, turned: FloatArray, amplitude: float) -> float:
    """What the shape is multiplied by; 0 of one that does not move."""
    along = field_along(drawing.members, moved, turned)
    ways = [float(np.linalg.norm(each.displacement, axis=-1).max(initial=0.0)) for each in along]
    far = max([*ways, float(np.linalg.norm(moved, axis=1).max(initial=0.0))])
    angle = float(np.linalg.norm(turned, axis=1).max(initial=0.0))
    wanted = ((amplitude, far), (_LARGEST_ROTATION, angle))
    return min((most / found for most, found in wanted if found > 0.0), default=0.0)
