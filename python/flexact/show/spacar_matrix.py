# SPDX-License-Identifier: BSD-3-Clause
"""The matrix Dcc of SPACAR: D(c) with Euler parameters in place of rotations."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..core.arrays import FloatArray
from ..core.elements import NodeKind
from ..model.jacobian import jacobian
from ..model.model import Model
from .spacar_numbering import SpacarNumbering

Indices = NDArray[np.int64]

#: Rows and columns beyond which the singular values of a full matrix take too long.
MOST_ROWS = 2000


def condition_number(numbering: SpacarNumbering) -> float | None:
    """The 2-norm condition number of Dcc; None where Dcc is too large.

    Infinite where the smallest singular value is within the rounding of a zero, nan where
    there is no row or no column.
    """
    rows, columns = shape_of(numbering)
    if not rows or not columns:
        return np.nan
    if max(rows, columns) > MOST_ROWS:
        return None
    values = np.linalg.svd(dcc(numbering), compute_uv=False)
    rounding = max(rows, columns) * np.finfo(float).eps * values[0]
    return float(values[0] / values[-1]) if values[-1] > rounding else np.inf


def shape_of(numbering: SpacarNumbering) -> tuple[int, int]:
    """Rows and columns of Dcc: NEM, and NXC - NXO."""
    fixed, calculable, _, _ = numbering.coordinates.ends
    return numbering.deformations.ends[2], calculable - fixed


def dcc(numbering: SpacarNumbering) -> FloatArray:
    """Dcc in full: fixed and independent deformations by calculable coordinates.

    A rotation [rad] about global axes is 2 L(lambda) d lambda. The row of an Euler element
    holds the derivatives of lambda . lambda - 1.
    """
    data = numbering.data
    full = jacobian(Model.from_data(data))
    node_of, axis_of = np.nonzero(data.arrays.coordinate_class.T)
    element_of, part_of = np.nonzero(data.arrays.deformation_class.T)
    place = _Places(numbering)
    row = place.row[element_of, part_of][full.rows]
    node, axis = node_of[full.columns], axis_of[full.columns]
    turned = data.arrays.node_kind[node] == NodeKind.ORIENTATION
    made = np.zeros(shape_of(numbering))
    _add(made, row[~turned], place.column[node, axis][~turned], full.values[~turned])
    euler = _unit(data.arrays.node_value.T)
    rates = _euler_rates(euler)[node[turned], axis[turned]] * full.values[turned, None]
    _add(made, np.repeat(row[turned], 4), place.column[node[turned]].ravel(), rates.ravel())
    nodes = numbering.euler_nodes
    columns, values = place.column[nodes].ravel(), 2.0 * euler[nodes].ravel()
    _add(made, np.repeat(place.euler_row, 4), columns, values)
    return made


class _Places:
    """Row and column of Dcc, from 0, of what is in it; -1 of what is not."""

    def __init__(self, numbering: SpacarNumbering) -> None:
        arrays = numbering.data.arrays
        x, e = numbering.coordinates, numbering.deformations
        self.column = np.full((arrays.node_number.size, 4), -1)
        inside = x.letter == "c"
        part = np.where(arrays.node_kind[x.owner] == NodeKind.ANGLE, 2, x.part)
        self.column[x.owner[inside], part[inside]] = x.number[inside] - 1 - x.ends[0]
        elements = numbering.elements.size
        row = np.full((elements + numbering.euler_nodes.size, 6), -1)
        inside = e.letter != "c"
        row[e.owner[inside], e.part[inside]] = e.number[inside] - 1
        self.euler_row = row[elements:, 0]
        self.row = np.empty((elements, 6), np.int64)
        self.row[numbering.elements] = row[:elements]


def _add(matrix: FloatArray, rows: Indices, columns: Indices, values: FloatArray) -> None:
    inside = (rows >= 0) & (columns >= 0)
    np.add.at(matrix, (rows[inside], columns[inside]), values[inside])


def _unit(value: FloatArray) -> FloatArray:
    """(nodes, 4) Euler parameters of norm 1, in whatever length they were typed."""
    norm = np.linalg.norm(value, axis=1, keepdims=True)
    made: FloatArray = value / np.where(norm > 0.0, norm, 1.0)
    return made


def _euler_rates(euler: FloatArray) -> FloatArray:
    """(nodes, 3, 4) derivatives of rotations about global axes by Euler parameters."""
    s, x, y, z = euler.T
    rates = np.array([[-x, s, -z, y], [-y, z, s, -x], [-z, -y, x, s]])
    made: FloatArray = 2.0 * np.moveaxis(rates, 2, 0)
    return made
