# SPDX-License-Identifier: BSD-3-Clause
"""D(c) of a model as a sparse matrix, scaled as the analysis scales it, for the peers."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from flexact import Model
from flexact.core import calls
from flexact.core.arrays import packed
from flexact.core.elements import Class, NodeKind


class Columns(NamedTuple):
    """A sparse matrix by compressed columns."""

    shape: tuple[int, int]
    start: NDArray[np.int64]
    """(columns + 1,)."""
    row: NDArray[np.int64]
    """(entries,) ascending within a column."""
    value: NDArray[np.float64]

    def toarray(self) -> NDArray[np.float64]:
        """The matrix in full."""
        full = np.zeros(self.shape)
        full[self.row, np.repeat(np.arange(self.shape[1]), np.diff(self.start))] = self.value
        return full

    def write(self, path: Path) -> None:
        """As peers.c reads it."""
        sizes = np.array([*self.shape, self.value.size], np.int64)
        with path.open("wb") as file:
            for part in (sizes, self.start, self.row, self.value):
                part.tofile(file)


def scaled_jacobian(model: Model) -> Columns:
    """D(c) with rotations times the mean length of the elements, and rows of unit norm.

    A row's norm is that of all its entries, those of fixed coordinates too.
    """
    arrays = model.data.arrays
    elements = arrays.element_number.size
    configuration = np.asfortranarray(arrays.node_value)
    whole = calls.assemble(packed(arrays), configuration, np.zeros(elements))
    rotation = np.repeat(arrays.node_kind > NodeKind.POSITION, 3)
    value = np.where(rotation[whole.column_of], whole.value / _mean_length(model), whole.value)
    square = np.bincount(whole.row_of, value**2, 6 * elements)
    value /= np.sqrt(square)[whole.row_of]
    row_class = arrays.deformation_class.T.ravel()
    held = (row_class == Class.FIXED) | (row_class == Class.INDEPENDENT)
    dependent = arrays.coordinate_class.T.ravel() == Class.DEPENDENT
    used = held[whole.row_of] & dependent[whole.column_of]
    row = (np.cumsum(held) - 1)[whole.row_of[used]]
    column = (np.cumsum(dependent) - 1)[whole.column_of[used]]
    shape = (int(held.sum()), int(dependent.sum()))
    order = np.lexsort((row, column))
    start = np.searchsorted(column[order], np.arange(shape[1] + 1))
    return Columns(shape, start.astype(np.int64), row[order].astype(np.int64), value[used][order])


def _mean_length(model: Model) -> float:
    arrays = model.data.arrays
    ends = arrays.element_node[[0, 2]]
    ends = ends[:, np.all(ends > 0, axis=0)] - 1
    place = arrays.node_value[:3]
    length = np.linalg.norm(place[:, ends[1]] - place[:, ends[0]], axis=0)
    return float(np.exp(np.log(length).mean()))
