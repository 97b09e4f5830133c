# SPDX-License-Identifier: BSD-3-Clause
"""D(c) of a model in full, for numpy's singular value decomposition beside the analysis."""

from __future__ import annotations

import numpy as np

from ...core import calls
from ...core.arrays import FloatArray, packed
from ...core.elements import Class
from ...model.data import ModelData


def full_matrix(data: ModelData) -> FloatArray:
    """D(c): derivatives of fixed and independent deformations to dependent coordinates."""
    arrays = data.arrays
    elements = arrays.element_number.size
    whole = calls.assemble(packed(arrays), np.asfortranarray(arrays.node_value), np.zeros(elements))
    deformation = arrays.deformation_class.T.ravel()
    held = (deformation == Class.FIXED) | (deformation == Class.INDEPENDENT)
    dependent = arrays.coordinate_class.T.ravel() == Class.DEPENDENT
    used = held[whole.row_of] & dependent[whole.column_of]
    row = (np.cumsum(held) - 1)[whole.row_of[used]]
    column = (np.cumsum(dependent) - 1)[whole.column_of[used]]
    full = np.zeros((int(held.sum()), int(dependent.sum())))
    np.add.at(full, (row, column), whole.value[used])
    return full
