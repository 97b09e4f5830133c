# SPDX-License-Identifier: BSD-3-Clause
"""A model whose elements share no node, so that each of them can be changed alone."""

from __future__ import annotations

import numpy as np

from ...core import calls
from ...core.arrays import FloatArray, ModelArrays, packed
from ...core.elements import Class, Role, Vector, element_kinds, role_table


class Exploded:
    """The rows of D of each element of a model in its reference configuration."""

    def __init__(self, arrays: ModelArrays, vectors: FloatArray) -> None:
        """Give each element nodes of its own; its vector is (elements, 3)."""
        element, slot = np.nonzero(arrays.element_node.T)
        node = arrays.element_node.T[element, slot] - 1
        made = np.zeros(arrays.element_node.shape, np.int32)
        made[slot, element] = np.arange(1, node.size + 1)
        classes = arrays.coordinate_class[:, node]
        self._arrays = arrays._replace(
            node_number=np.arange(1, node.size + 1, dtype=np.int32),
            node_kind=arrays.node_kind[node],
            node_value=np.asfortranarray(arrays.node_value[:, node]),
            coordinate_class=np.asfortranarray(
                np.where(classes == Class.NONE, classes, np.int32(Class.DEPENDENT))
            ),
            element_node=np.asfortranarray(made),
            element_vector=np.asfortranarray(vectors.T),
        )
        self._element, self._slot = element, slot
        needed = np.array([0, *(kind.vector for kind in element_kinds())])[arrays.element_kind]
        self._is_about_axis = needed == Vector.REQUIRED
        self._frame = calls.find_frames(packed(self._arrays)).frame

    def matrices(self, change: FloatArray) -> FloatArray:
        """(elements, 6, 12) rows of each element, its offset and vector changed, (elements, 6)."""
        value = self._arrays.node_value.copy(order="F")
        at_q = self._slot == 2
        value[:3, at_q] += change[self._element[at_q], :3].T
        vectors = np.asfortranarray(self._arrays.element_vector + change[:, 3:].T)
        arrays = self._arrays._replace(node_value=value, element_vector=vectors)
        size = arrays.element_number.size
        found = calls.assemble(packed(arrays), value, np.zeros(size))
        node, axis = np.divmod(found.column_of, 3)
        column = 3 * self._slot[node] + axis
        flat = found.row_of.astype(np.int64) * 12 + column
        made = np.bincount(flat, found.value, 72 * size).reshape(size, 6, 12).astype(float)
        self._turn_back(made, calls.find_frames(packed(arrays)).frame)
        return made

    def _turn_back(self, rows: FloatArray, frame: FloatArray) -> None:
        """Rows about two axes across a third, in the reference axes: these may be others.

        An axis alone does not say which they are, so that a small turn may exchange them.
        """
        roles = role_table()[self._arrays.element_kind]
        own = np.einsum("eij,eik->ejk", frame[:, :, 1:], self._frame[:, :, 1:])
        for first, second in ((Role.OFFSET_Y, Role.OFFSET_Z), (Role.TILT_Y, Role.TILT_Z)):
            element, row = np.nonzero((roles == first) & self._is_about_axis[:, None])
            there = roles[element, row + 1] == second
            element, row = element[there], row[there]
            both = np.stack((rows[element, row], rows[element, row + 1]), axis=1)
            back = np.einsum("ejk,ejc->ekc", own[element], both)
            rows[element, row], rows[element, row + 1] = back[:, 0], back[:, 1]
