# SPDX-License-Identifier: BSD-3-Clause
"""What may be released, freed, declared or held, as rows over a null space of D(c).

To release or to hold some of them works exactly when their rows span the space.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...analysis.change import Change
from ...analysis.order import column_key, coordinate_key, deformation_key, row_key
from ...analysis.result import Result
from ...analysis.result_sparse_basis import Sparse, index_of, support_of
from ...analysis.ways import is_of_class
from ...analysis.weights import column_weights, row_weights
from ...core.arrays import FloatArray
from ...core.basis import Basis
from ...core.elements import Class, Dual, NodeKind, coordinate_name, dual_table
from ...util.records import Frozen

#: Rows of a null space that are held in full, times vectors, and times vectors again.
MOST_ENTRIES, MOST_WORK = 4_000_000, 50_000_000
#: Below this part of the largest a row does not reach into the space.
_NOTHING = 1.0e-7

#: Rows or vectors, by their places.
Places = NDArray[np.integer]


@dataclass(frozen=True, eq=False)
class Reach(Frozen):
    """Rows over a null space.

    Attributes:
        rows: (n, k) of k orthonormal vectors.
        index: (n,) what each is: a row or column of D(c), or a place in the whole Jacobian.
        key: By what rows of practically one value are sorted, of an entry of `index`.
        change: What is done with it, of an entry of `index`.
    """

    rows: FloatArray
    index: Places
    key: Callable[[int], Any]
    change: Callable[[int], Change]

    @property
    def vectors(self) -> int:
        """Number of the vectors."""
        return int(self.rows.shape[1])

    def only(self, chosen: Places) -> Reach:
        """Some of the rows."""
        return replace(self, rows=self.rows[chosen], index=self.index[chosen])


def fits(basis: Basis) -> bool:
    """Whether the rows of a space can be held in full."""
    entries = support_of(basis).size * basis.vectors
    return entries <= MOST_ENTRIES and entries * basis.vectors <= MOST_WORK


def of_rows(result: Result, vectors: Places | None = None) -> Reach:
    """The fixed deformations among the rows of D(c), over the self-stresses or some of them."""
    able = is_of_class(result, Class.FIXED)
    rows, index = _rows(_some(result.stress_space, vectors), able)
    return Reach(
        *(rows, index, lambda row: row_key(result, row)),
        lambda row: _released(result, *(result.raw.row_label[:, row] - 1).tolist()),
    )


def of_columns(result: Result, vectors: Places | None = None) -> Reach:
    """The columns of D(c), over the motions or some of them."""
    space = _some(result.motion_space, vectors)
    rows, index = _rows(space, np.ones(result.columns, bool))
    return Reach(
        *(rows, index, lambda column: column_key(result, column)),
        lambda column: _declared(result, *(result.raw.column_label[:, column] - 1).tolist()),
    )


def of_supports(result: Result) -> Reach:
    """The fixed coordinates, over the self-stresses: the reactions, as forces."""
    arrays = result.data.arrays
    whole = result.assembly
    able = (arrays.coordinate_class.T == Class.FIXED).ravel()
    element, deformation = result.raw.row_label - 1
    row = index_of(6 * element + deformation, 6 * arrays.element_number.size)[whole.row_of]
    chosen = able[whole.column_of] & (row >= 0)
    matrix = Sparse(whole.column_of, row, whole.value, able.size).only(chosen)
    turned = np.repeat(arrays.node_kind > NodeKind.POSITION, 3)
    weight = 1.0 / np.where(turned, result.characteristic_length, 1.0)
    value = matrix.value * weight[matrix.row_of] / row_weights(result)[matrix.column_of]
    rows, index = _product(matrix._replace(value=value), result.stress_space)
    return Reach(
        *(rows, index, lambda place: coordinate_key(result, *divmod(place, 3))),
        lambda place: _of_coordinate(result, *divmod(place, 3), Class.DEPENDENT),
    )


def of_released(result: Result) -> Reach:
    """The released deformations, over the motions: their rates, angles as lengths."""
    arrays = result.data.arrays
    whole = result.assembly
    released = (arrays.deformation_class.T == Class.DEPENDENT).ravel()
    node, axis = result.raw.column_label - 1
    column = index_of(3 * node + axis, 3 * arrays.node_number.size)[whole.column_of]
    chosen = released[whole.row_of] & (column >= 0)
    matrix = Sparse(whole.row_of, column, whole.value, released.size).only(chosen)
    angle = (dual_table()[arrays.element_kind] == Dual.MOMENT).ravel()
    weight = np.where(angle, result.characteristic_length, 1.0)
    value = matrix.value * weight[matrix.row_of] / column_weights(result)[matrix.column_of]
    rows, index = _product(matrix._replace(value=value), result.motion_space)
    return Reach(
        *(rows, index, lambda place: deformation_key(result, *divmod(place, 6))),
        lambda place: _held(result, *divmod(place, 6)),
    )


def _some(basis: Basis, vectors: Places | None) -> Basis:
    return basis if vectors is None else basis.only(vectors.astype(np.int32))


def _rows(basis: Basis, able: NDArray[np.bool_]) -> tuple[FloatArray, Places]:
    """Those rows of a basis that are not zero."""
    support = support_of(basis)
    support = support[able[support]]
    place = index_of(support, basis.size)[basis.place]
    there = place >= 0
    made = np.zeros((support.size, basis.vectors))
    made[place[there], basis.of_entries()[there]] = basis.value[there]
    return made, support


def _product(matrix: Sparse, basis: Basis) -> tuple[FloatArray, Places]:
    """Rows of a matrix times a basis that are not zero, up to what rounding leaves of them."""
    index = np.unique(matrix.row_of)
    row = index_of(index, matrix.rows)[matrix.row_of]
    vectors = basis.toarray()
    made = np.zeros((2, index.size, basis.vectors))
    np.add.at(made[0], row, matrix.value[:, None] * vectors[matrix.column_of])
    np.add.at(made[1], row, np.abs(matrix.value[:, None] * vectors[matrix.column_of]))
    size, contributed = np.linalg.norm(made, axis=2)
    left = size > _NOTHING * contributed
    return made[0][left], index[left]


def _released(result: Result, element: int, deformation: int) -> Change:
    return _of_deformation(result, element, deformation, Class.DEPENDENT)


def _declared(result: Result, node: int, axis: int) -> Change:
    return _of_coordinate(result, node, axis, Class.INDEPENDENT)


def _held(result: Result, element: int, deformation: int) -> Change:
    return _of_deformation(result, element, deformation, Class.FIXED)


def _of_deformation(result: Result, element: int, deformation: int, given: Class) -> Change:
    index, own = result.condensed.in_given(element, deformation + 1)
    number = int(result.given.arrays.element_number[index])
    return Change(deformations=((number, own, given),))


def _of_coordinate(result: Result, node: int, axis: int, given: Class) -> Change:
    arrays = result.data.arrays
    name = coordinate_name(int(arrays.node_kind[node]), axis)
    return Change(coordinates=((int(arrays.node_number[node]), name, given),))
