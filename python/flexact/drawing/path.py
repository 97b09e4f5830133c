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

from ..base.frozen import Frozen
from ..core import calls
from ..core.arrays import FloatArray, ModelArrays, packed
from ..core.elements import Class, Dual, NodeKind, dual_table
from ..model.configuration import Configuration
from ..model.data import ModelData
from ..model.parts.bodies import bodies_of
from ..result.velocities import Velocities
from .pose import Pose, pose_of, reference_pose
from .rotations import matrix_of, screw_matrix

#: More coordinates than these are not followed: each step solves a dense system.
_MOST_COORDINATES = 300
#: Steps back towards the path, and the correction [drawing size] that ends them.
_MOST_STEPS = 12
_SETTLED = 1.0e-11
#: Singular values below this part of the largest belong to directions that stay.
_CUT = 1.0e-4
#: The corrections of a step may be this part of the step itself.
_FARTHEST = 0.5


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


def is_followed(data: ModelData) -> bool:
    """Whether a model is small enough for its motions to be followed."""
    coordinates = int(np.count_nonzero(data.arrays.coordinate_class == Class.DEPENDENT))
    return 0 < coordinates <= _MOST_COORDINATES


def follow(motion: Velocities, shares: FloatArray, size: float) -> Path | None:
    """The poses at shares of a motion that grow from the reference on.

    Args:
        motion: The motion; what its model holds stays zero, what it fixes stays.
        shares: (k,) by which the motion is multiplied, of one sign.
        size: Of the drawing [m].

    Returns:
        The path, or None where there is none near.
    """
    track = _Track(motion.data, size)
    direction = track.scaled(motion)
    length = float(np.linalg.norm(direction))
    if not length > 0.0:
        return None
    direction *= np.sign(shares[0]) / length
    here = track.reference
    poses, deviation = [], 0.0
    for step in np.abs(np.diff(shares, prepend=0.0)).tolist():
        found = track.step(here, direction, step * length)
        if found is None:
            return None
        here, error = found
        deviation = max(deviation, error)
        poses.append(track.pose(here))
        direction = track.onward(here, direction)
    return Path(tuple(poses), deviation)


class _Track:
    """The held deformations of a model as functions of the coordinates that may change."""

    def __init__(self, data: ModelData, size: float) -> None:
        self.arrays, self.middle = _about_the_middle(data.arrays)
        self.packed = packed(self.arrays)
        self.size = size
        classes = self.arrays.deformation_class
        held = (classes == Class.FIXED) | (classes == Class.INDEPENDENT)
        self.rows = np.flatnonzero(held.T.ravel())
        self.columns = np.flatnonzero((self.arrays.coordinate_class == Class.DEPENDENT).T.ravel())
        # Rotations count as the displacements that they make at the drawing's size.
        placed = self.arrays.node_kind[self.columns // 3] <= NodeKind.POSITION
        self.weight = np.where(placed, 1.0, size)
        turning = dual_table()[self.arrays.element_kind].ravel()[self.rows] == Dual.MOMENT
        self.row_weight = np.where(turning, size, 1.0)

    @property
    def reference(self) -> Configuration:
        """Where the path starts."""
        return Configuration(self.arrays.node_kind, self.arrays.node_value.T)

    def pose(self, here: Configuration) -> Pose:
        """The pose that a configuration means, where the model stands."""
        pose = pose_of(self.arrays, here)
        placed = (self.arrays.node_kind <= NodeKind.POSITION)[:, None]
        return Pose(np.where(placed, pose.position + self.middle, 0.0), pose.rotation)

    def scaled(self, motion: Velocities) -> FloatArray:
        """(columns,) the motion, rotations times the size of the drawing."""
        both = (motion.displacement + motion.rotation).ravel()
        return np.asarray(both[self.columns] * self.weight)

    def step(
        self, start: Configuration, ahead: FloatArray, step: float
    ) -> tuple[Configuration, float] | None:
        """The configuration after a step, and its largest held deformation [drawing size].

        None where there is none near.
        """
        here, went = self._moved(start, step * ahead), 0.0
        for _ in range(_MOST_STEPS):
            error, jacobian = self._assembled(here)
            if not np.all(np.isfinite(error)):
                return None
            # Corrections are across the motion, so that its share stays.
            across = jacobian - np.outer(jacobian @ ahead, ahead)
            back = np.asarray(-np.linalg.lstsq(across, error, rcond=_CUT)[0], np.float64)
            correction = float(np.linalg.norm(back))
            if correction <= _SETTLED * self.size:
                return here, float(np.abs(error).max(initial=0.0)) / self.size
            went += correction
            if went > _FARTHEST * step:
                return None
            here = self._moved(here, back)
        return None

    def onward(self, here: Configuration, direction: FloatArray) -> FloatArray:
        """The direction in which the path goes on: the last one within the null space."""
        _, jacobian = self._assembled(here)
        along = direction - np.linalg.lstsq(jacobian, jacobian @ direction, rcond=_CUT)[0]
        length = float(np.linalg.norm(along))
        return np.asarray(along / length) if length > _FARTHEST else direction

    def _moved(self, start: Configuration, change: FloatArray) -> Configuration:
        delta = np.zeros(3 * self.arrays.node_kind.size)
        delta[self.columns] = change / self.weight
        return start.moved(delta.reshape(-1, 3))

    def _assembled(self, here: Configuration) -> tuple[FloatArray, FloatArray]:
        """Held deformations (rows,) [m], their derivatives (rows, columns) [1]."""
        nodes, elements = self.arrays.node_number.size, self.arrays.element_number.size
        raw = calls.assemble(self.packed, here.value.T, np.zeros(elements))
        full = np.zeros((6 * elements, 3 * nodes))
        np.add.at(full, (raw.row_of, raw.column_of), raw.value)
        error = raw.deformation.T.ravel()[self.rows] * self.row_weight
        part = full[np.ix_(self.rows, self.columns)]
        return error, self.row_weight[:, None] * part / self.weight


def _about_the_middle(arrays: ModelArrays) -> tuple[ModelArrays, FloatArray]:
    """The arrays with positions about their middle, and that [m].

    Far from the origin too few digits are left for differences.
    """
    placed = arrays.node_kind <= NodeKind.POSITION
    there = arrays.node_value[:3, placed]
    middle = there.min(axis=1) / 2 + there.max(axis=1) / 2 if there.size else np.zeros(3)
    value = arrays.node_value.copy(order="F")
    value[:3, placed] -= middle[:, None]
    return arrays._replace(node_value=value), middle


def moved_by_screws(motion: Velocities, shares: Iterable[float]) -> tuple[Pose, ...]:
    """The poses after a motion times each of `shares`.

    Every node of a rigid body moves on the body's screw, so that the body keeps its shape. A
    node of no body moves straight and turns about its own axis.
    """
    reference, bodies = reference_pose(motion.data.arrays), _bodies(motion.data.arrays)
    return tuple(_moved(motion, share, reference, *bodies) for share in shares)


def _moved(
    motion: Velocities, share: float, reference: Pose, centre: np.ndarray, turn: np.ndarray
) -> Pose:
    moved, turned = share * motion.displacement, share * motion.rotation
    position = reference.position + moved
    rotation = matrix_of(turned)
    body = np.flatnonzero(centre >= 0)
    arm = reference.position[body] - reference.position[centre[body]]
    about = turned[turn[body]]
    carried = np.einsum("kxy,ky->kx", screw_matrix(about), moved[centre[body]])
    position[body] = (
        reference.position[centre[body]] + carried + np.einsum("kxy,ky->kx", matrix_of(about), arm)
    )
    rotation[motion.data.arrays.node_kind <= NodeKind.POSITION] = np.eye(3)
    return Pose(position, rotation)


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
