# SPDX-License-Identifier: BSD-3-Clause
"""Poses of a motion to a finite extent: on its path, or with rigid bodies on their screws.

On the path the deformations that the motion holds stay zero, or nearly so.

From the reference one step after the other: along the motion, then back towards D(x) = 0 of
eq. (5) by Gauss-Newton steps of least norm. Where the motion is infinitesimal only, they end
at the least deformations.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ...analysis.velocities import Velocities
from ...core.arrays import FloatArray, ModelArrays
from ...core.elements import NodeKind
from ...model.configuration import Configuration
from ...model.data import ModelData
from ...model.parts.bodies import bodies_of
from ...motion.constraints import Held, Place, is_followed
from ...motion.settle import onward, settle
from ...util.records import Frozen
from .drawing_pose import Pose, pose_of, reference_pose
from .rotations import matrix_of, screw_matrix

#: More coordinates than these are not followed: it would take seconds.
_MOST_COORDINATES = 300


@dataclass(frozen=True, eq=False)
class Path(Frozen):
    """Poses along a motion.

    Attributes:
        poses: One a share.
        deviation: The largest deformation in them that the motion holds, as a part of the
            drawing's size.
    """

    poses: tuple[Pose, ...]
    deviation: float


def has_path(data: ModelData) -> bool:
    """Whether a model is small enough for its motions to be followed in a drawing."""
    return is_followed(data, _MOST_COORDINATES)


def follow(motion: Velocities, shares: FloatArray, size: float) -> Path | None:
    """The poses at shares of a motion that grow from the reference on.

    Args:
        motion: The motion; what its model holds stays zero, what it fixes stays.
        shares: (k,) by which the motion is multiplied, of one sign.
        size: Of the drawing [m].

    Returns:
        The path, or None where there is none near.
    """
    held = Held(motion.data, size)
    direction = held.direction(motion)
    length = float(np.linalg.norm(direction))
    if not length > 0.0:
        return None
    direction *= np.sign(shares[0]) / length
    here: Place | None = held.at(held.reference)
    poses, deviation = [], 0.0
    for step in np.abs(np.diff(shares, prepend=0.0)).tolist():
        here = settle(held, here, direction, step * length) if here else None
        if here is None:
            return None
        deviation = max(deviation, here.residual)
        poses.append(pose_in(held, here.configuration))
        direction = onward(here, direction)
    return Path(tuple(poses), deviation)


def pose_in(held: Held, here: Configuration) -> Pose:
    """The pose that a configuration means, which `Held` has, where the model stands."""
    placed = (held.arrays.node_kind <= NodeKind.POSITION)[:, None]
    there = pose_of(held.data.arrays, held.outside(here))
    return Pose(np.where(placed, there.position, 0.0), there.rotation)


def moved_by_screws(motion: Velocities, shares: Iterable[float]) -> tuple[Pose, ...]:
    """The poses after a motion times each of `shares`.

    Every node of a rigid body moves on the body's screw, so that the body keeps its shape. A
    node of no body moves straight and turns about its own axis.
    """
    reference, moves = reference_pose(motion.data.arrays), BodyMoves(motion.data.arrays)
    return tuple(_moved(motion, share, reference, moves) for share in shares)


def _moved(motion: Velocities, share: float, reference: Pose, moves: BodyMoves) -> Pose:
    moved, turned = share * motion.displacement, share * motion.rotation
    rotation = matrix_of(turned)
    position = moves.carried(reference.position, reference.position + moved, turned)
    rotation[motion.data.arrays.node_kind <= NodeKind.POSITION] = np.eye(3)
    return Pose(position, rotation)


class BodyMoves:
    """How the position nodes of rigid bodies move with them."""

    def __init__(self, arrays: ModelArrays) -> None:
        """Find the bodies."""
        self._centre, self._turn = _bodies(arrays)

    def carried(self, start: FloatArray, moved: FloatArray, turned: FloatArray) -> FloatArray:
        """Positions (nodes, 3) after velocities that last for a time of one.

        Args:
            start: (nodes, 3) where they were [m].
            moved: (nodes, 3) where they would be, had all gone straight [m].
            turned: (nodes, 3) rotation vectors of orientations [rad].
        """
        made = moved.copy()
        body = np.flatnonzero(self._centre >= 0)
        centre, about = self._centre[body], turned[self._turn[body]]
        gone = np.einsum("kxy,ky->kx", screw_matrix(about), (moved - start)[centre])
        arm = np.einsum("kxy,ky->kx", matrix_of(about), start[body] - start[centre])
        made[body] = start[centre] + gone + arm
        return made


def _bodies(arrays: ModelArrays) -> tuple[np.ndarray, np.ndarray]:
    """Of each position node of a rigid body, a position node and an orientation node of it.

    (nodes,) indices, -1 for nodes of no body.
    """
    centre, turn = (np.full(arrays.node_kind.size, -1) for _ in range(2))
    for body in bodies_of(arrays):
        p, op = (arrays.element_node[:2, body.elements[0]] - 1).tolist()
        for node in body.positions:
            if centre[node] < 0:
                centre[node], turn[node] = p, op
    return centre, turn
