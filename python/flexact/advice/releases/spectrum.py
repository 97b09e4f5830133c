# SPDX-License-Identifier: BSD-3-Clause
"""By what two changed mechanisms are told apart, if symmetry does not make them equal."""

from __future__ import annotations

import numpy as np

from ...analysis.result import Result
from ...analysis.result_sparse_basis import index_of
from ...core.arrays import FloatArray
from ...model.parts.parts import PartKind

#: Rows and columns of D(c) up to which bodies are taken as what they are.
_MOST = 250
_ZERO = 1.0e-9


def spectrum_of(result: Result) -> FloatArray:
    """Singular values of the scaled D(c) on motions that leave its bodies rigid.

    They do not depend on the links of which a body is made, but on its points alone. Of large
    models they are those of the scaled D(c) itself.
    """
    if max(result.rows, result.columns) > _MOST or not result.rows * result.columns:
        return result.scaled_singular_values
    matrix = _scaled(result)
    given = result.condensed.elements[result.raw.row_label[0] - 1].tolist()
    kinds = {i: result.parts.of_element(i).kind for i in set(given)}
    rigid = np.array([kinds[i] is PartKind.BODY for i in given], bool)
    if rigid.any():
        _, values, vectors = np.linalg.svd(matrix[rigid])
        rank = int(np.count_nonzero(values > _ZERO * values[0]))
        matrix = matrix[~rigid] @ vectors[rank:].T
    if not matrix.size:
        return np.zeros(0)
    return np.asarray(np.linalg.svd(matrix, compute_uv=False), np.float64)


def _scaled(result: Result) -> FloatArray:
    """(m, n) the matrix on which the rank is decided."""
    arrays, raw, whole = result.data.arrays, result.raw, result.assembly
    element, deformation = raw.row_label - 1
    node, axis = raw.column_label - 1
    row = index_of(6 * element + deformation, 6 * arrays.element_number.size)[whole.row_of]
    column = index_of(3 * node + axis, 3 * arrays.node_number.size)[whole.column_of]
    there = (row >= 0) & (column >= 0)
    made = np.zeros((result.rows, result.columns))
    np.add.at(made, (row[there], column[there]), whole.value[there])
    return made * raw.row_scale[:, None] * raw.column_scale
