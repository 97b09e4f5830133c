# SPDX-License-Identifier: BSD-3-Clause
"""What makes rotations comparable with displacements, and moments with forces."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..core.arrays import FloatArray, IntArray
from ..core.elements import Dual, NodeKind, dual_table
from .decomposition import Outcome

#: Rows or columns of D(c): all of them, or those of an array.
Places = IntArray | slice
_ALL = slice(None)


def column_weights(analysis: Outcome, columns: Places = _ALL) -> FloatArray:
    """(columns,) 1 for a displacement, the characteristic length for a rotation."""
    kinds = analysis.data.arrays.node_kind[analysis.raw.column_label[0, columns] - 1]
    return np.where(kinds <= NodeKind.POSITION, 1.0, analysis.characteristic_length)


def row_duals(analysis: Outcome, rows: Places = _ALL) -> NDArray[np.int32]:
    """(rows,) `Dual` of rows of D(c)."""
    element, deformation = analysis.raw.row_label[:, rows] - 1
    table: NDArray[np.int32] = dual_table()[analysis.data.arrays.element_kind[element], deformation]
    return table


def row_factors(analysis: Outcome, rows: Places = _ALL) -> FloatArray:
    """(rows,) what makes a force or a moment of a stress resultant: 1, or l0 [m]."""
    over_length = row_duals(analysis, rows) == Dual.MOMENT_OVER_LENGTH
    return np.where(
        over_length, analysis.data.frames.length[analysis.raw.row_label[0, rows] - 1], 1.0
    )


def row_weights(analysis: Outcome, rows: Places = _ALL) -> FloatArray:
    """(rows,) what makes a stress resultant comparable with a force.

    A moment is divided by the characteristic length.
    """
    moment = row_duals(analysis, rows) != Dual.FORCE
    return row_factors(analysis, rows) / np.where(moment, analysis.characteristic_length, 1.0)
