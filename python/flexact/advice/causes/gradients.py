# SPDX-License-Identifier: BSD-3-Clause
"""What moving nodes and turning vectors makes of pairs of self-stresses and motions.

The rows of D(c) of an element depend on the offset between its ends and on its vector alone, so
that a few assemblies of a model whose elements share no node have the derivatives of all of them.
u' dD v of all pairs and all changes is theory.md (20) with every change kept apart.
"""

from __future__ import annotations

import numpy as np

from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...core.basis import Basis
from ...util.records import Frozen
from .exploded import Exploded
from .generic import Geometry

#: Step of central differences beside the length of what is changed.
_STEP = 2.0e-5
#: Entries of all pairs and changes together, beyond which they are not made.
MOST_ENTRIES = 20_000_000
#: Rows or columns up to which D(c) is decomposed in full, and how far on the way to another
#: geometry: second-order effects are then of 1e-8.
_MOST_DENSE, _SMALL = 400, 1.0e-4


class Gradients(Frozen):
    """Derivatives of û' D v̂ for orthonormal bases of both null spaces of the scaled D(c).

    Attributes:
        result: The result.
        geometry: Its places and vectors.
        stresses: (m, s) orthonormal self-stresses of the scaled matrix.
        motions: (n, k) its orthonormal motions.
        by_offset: (elements, 3, s, k) by the offset between the ends [1/m].
        by_vector: (elements, 3, s, k) by the vector, which is of unit length [1].
    """

    def __init__(self, result: Result) -> None:
        """Differentiate; ask `are_affordable` first."""
        self.result, self.geometry = result, Geometry(result.data)
        raw = result.raw
        self.stresses = _orthonormal(raw.stresses, raw.row_scale)
        self.motions = _orthonormal(raw.motions, raw.column_scale)
        made = self._derivatives()
        self.by_offset, self.by_vector = made[:, :3], made[:, 3:]

    def at_nodes(self) -> FloatArray:
        """(nodes, 3, s, k) by the place of each node [1/m]; zero of what is no coordinate."""
        arrays = self.result.data.arrays
        made = np.zeros((arrays.node_kind.size, *self.by_offset.shape[1:]))
        for slot, sign in ((0, -1.0), (2, 1.0)):
            node = arrays.element_node[slot] - 1
            used = node >= 0
            np.add.at(made, self.geometry.owner[node[used]], sign * self.by_offset[used])
        made[~self.geometry.free] = 0.0
        return made

    def by_turning(self) -> FloatArray:
        """(elements, 3, s, k) by a turn of each element about its centre [1/rad]."""
        first = np.cross(self._offsets[:, :, None, None], self.by_offset, axis=1)
        vectors = self.geometry.vectors[:, :, None, None]
        made = first + np.cross(vectors, self.by_vector, axis=1)
        if self.result.given.planar:
            made[:, :2] = 0.0
        return np.asarray(made)

    def left_over(self, motions: int, stresses: int) -> tuple[FloatArray, FloatArray] | None:
        """What one small random misalignment leaves, so many: (k, motions), (s, stresses).

        As combinations of the motions and self-stresses; None where that would take long.
        """
        result = self.result
        if min(result.rows, result.columns) > _MOST_DENSE:
            return None
        matrix = self._scaled_at(*self.geometry.random(0), share=_SMALL)
        left, _, right = np.linalg.svd(matrix)
        of_motions = right[result.columns - motions :].T
        of_stresses = left[:, result.rows - stresses :]
        return self.motions.T @ of_motions, self.stresses.T @ of_stresses

    def _scaled_at(self, places: FloatArray, vectors: FloatArray, share: float) -> FloatArray:
        """(m, n) the scaled D(c), so much on the way to other places and vectors."""
        arrays, raw = self.result.data.arrays, self.result.raw
        p, q = arrays.element_node[[0, 2]] - 1
        moved = (places - self.geometry.places)[self.geometry.owner]
        change = np.zeros((arrays.element_number.size, 6))
        both = ((p >= 0) & (q >= 0))[:, None]
        change[:, :3] = share * np.where(both, moved[q] - moved[p], 0.0)
        change[:, 3:] = share * (vectors - self.geometry.vectors)
        rows = Exploded(arrays, self.geometry.vectors).matrices(change)
        made = np.zeros((arrays.element_number.size, 6, arrays.node_kind.size + 1, 3))
        node = arrays.element_node.T - 1
        for slot in range(4):
            np.add.at(
                made,
                (
                    np.arange(node.shape[0])[:, None],
                    np.arange(6)[None],
                    node[:, slot][:, None],
                ),
                rows[:, :, 3 * slot : 3 * slot + 3],
            )
        element, deformation = raw.row_label - 1
        column, axis = raw.column_label - 1
        chosen = made[element[:, None], deformation[:, None], column[None], axis[None]]
        scaled: FloatArray = raw.row_scale[:, None] * chosen * raw.column_scale
        return scaled

    @property
    def _offsets(self) -> FloatArray:
        """(elements, 3) from p to q [m]; zero of elements without places."""
        arrays = self.result.data.arrays
        p, q = arrays.element_node[[0, 2]] - 1
        places = self.geometry.places
        both = ((p >= 0) & (q >= 0))[:, None]
        made: FloatArray = np.where(both, places[q] - places[p], 0.0)
        return made

    def _derivatives(self) -> FloatArray:
        """(elements, 6, s, k) by the three components of the offset, then of the vector."""
        arrays, size = self.result.data.arrays, self.result.data.arrays.element_number.size
        stress = np.zeros((size, 6, self.stresses.shape[1]))
        element, deformation = self.result.raw.row_label - 1
        stress[element, deformation] = self.stresses * self.result.raw.row_scale[:, None]
        motion = np.zeros((arrays.node_kind.size + 1, 3, self.motions.shape[1]))
        node, axis = self.result.raw.column_label - 1
        motion[node, axis] = self.motions * self.result.raw.column_scale[:, None]
        moving = motion[arrays.element_node.T - 1].reshape(size, 12, -1)
        exploded = Exploded(self.result.data.arrays, self.geometry.vectors)
        offset, vector = self._offsets, self.geometry.vectors
        length = np.linalg.norm(offset, axis=1)
        made = np.zeros((size, 6, stress.shape[2], moving.shape[2]))
        for k in range(6):
            step = _STEP * (length if k < 3 else np.linalg.norm(vector, axis=1))
            if not step.any():
                continue
            change = np.zeros((size, 6))
            change[:, k] = step
            rise = exploded.matrices(change) - exploded.matrices(-change)
            per = np.where(step > 0.0, 0.5 / np.where(step > 0.0, step, 1.0), 0.0)
            made[:, k] = np.swapaxes(stress, 1, 2) @ (rise * per[:, None, None]) @ moving
        return made


def are_affordable(result: Result) -> bool:
    """Whether the derivatives of all pairs can be held."""
    raw = result.raw
    changes = 3 * raw.column_label.shape[1] + 12 * result.data.arrays.element_number.size
    return bool(raw.stresses.vectors * raw.motions.vectors * changes <= MOST_ENTRIES)


def _orthonormal(basis: Basis, scale: FloatArray) -> FloatArray:
    """The same space in the scaled matrix, by orthonormal columns."""
    made: FloatArray = np.linalg.qr(basis.toarray() / scale[:, None])[0]
    return made
