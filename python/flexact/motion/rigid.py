# SPDX-License-Identifier: BSD-3-Clause
"""Motions of a component as one rigid body, which strain nothing however far they go."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..core.arrays import FloatArray
from ..core.elements import NodeKind
from .constraints import Held

#: The axes in which a node of each kind can move or turn.
_AXES = {
    NodeKind.PLANAR_POSITION: (0, 1),
    NodeKind.POSITION: (0, 1, 2),
    NodeKind.ANGLE: (2,),
    NodeKind.ORIENTATION: (0, 1, 2),
}
#: What is below this is zero.
_ZERO = 1.0e-9


def rigid_motions(held: Held) -> FloatArray:
    """(n, k) orthonormal basis of the motions that move all nodes as one body would.

    They are those that do not move what is fixed or independent.
    """
    kinds = held.arrays.node_kind
    every = np.array([3 * i + axis for i, k in enumerate(kinds.tolist()) for axis in _AXES[k]])
    fields = _fields(held)
    free = np.isin(every, held.columns)
    stopped = fields[every[~free]]
    ways = np.eye(6)
    if stopped.size:
        _, values, right = np.linalg.svd(np.linalg.qr(stopped, mode="r"))
        ways = right[int(np.count_nonzero(values > _ZERO)) :].T
    left, values, _ = np.linalg.svd(fields[held.columns] @ ways, full_matrices=False)
    return np.asarray(left[:, values > _ZERO])


def leading_rows(vectors: FloatArray) -> NDArray[np.integer]:
    """(k,) rows of independent vectors (n, k) in which they are as independent as can be."""
    left, chosen = vectors.copy(), []
    for _ in range(vectors.shape[1]):
        sizes = np.linalg.norm(left, axis=1)
        # Of rows that rounding alone tells apart the first.
        row = int(np.argmax(sizes > (1.0 - 1.0e-6) * sizes.max()))
        chosen.append(row)
        unit = left[row] / sizes[row]
        left = left - np.outer(left @ unit, unit)
    return np.array(chosen, np.int64)


def _fields(held: Held) -> FloatArray:
    """(3 nodes, 6) translations along and rotations about the axes, by the size and radians."""
    kinds, value = held.arrays.node_kind, held.arrays.node_value[:3].T
    placed = kinds <= NodeKind.POSITION
    middle = value[placed].mean(axis=0) if placed.any() else np.zeros(3)
    arms = (value - middle) * (held.sizes.unit / held.size)
    made = np.zeros((kinds.size, 3, 6))
    made[placed, :, :3] = np.eye(3)
    for axis in range(3):
        made[placed, :, 3 + axis] = np.cross(np.eye(3)[axis], arms[placed])
        made[~placed, axis, 3 + axis] = 1.0
    if held.data.planar:
        made[:, :, [2, 3, 4]] = 0.0
    return made.reshape(-1, 6)
