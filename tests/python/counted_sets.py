# SPDX-License-Identifier: BSD-3-Clause
"""How many sets of releases and declarations there are, block by block, by numpy."""

import math
from itertools import combinations

import numpy as np

from flexact.core import calls
from flexact.core.elements import Class, NodeKind
from flexact.model.data import ModelData

#: More sets than these are not counted.
_MOST = 40_000
#: Singular values below this part of the largest are zero: where tests count, there is a gap.
_ZERO = 1.0e-9


def jacobian(data: ModelData) -> tuple[np.ndarray, np.ndarray]:
    """D(c) of a model as it stands, without what is condensed, and which rows are fixed."""
    arrays = data.arrays
    whole = calls.assemble(data.packed, arrays.node_value, np.zeros(arrays.element_number.size))
    full = np.zeros((6 * arrays.element_number.size, 3 * arrays.node_number.size))
    np.add.at(full, (whole.row_of, whole.column_of), whole.value)
    deformation = arrays.deformation_class.T.ravel()
    rows = np.isin(deformation, (Class.FIXED, Class.INDEPENDENT))
    columns = arrays.coordinate_class.T.ravel() == Class.DEPENDENT
    turns = np.repeat(arrays.node_kind > NodeKind.POSITION, 3)[columns]
    chosen = full[np.ix_(rows, columns)]
    chosen[:, turns] /= float(np.ptp(arrays.node_value[:3], axis=1).max()) or 1.0
    norms = np.linalg.norm(chosen, axis=1, keepdims=True)
    return chosen / np.where(norms > 0.0, norms, 1.0), deformation[rows] == Class.FIXED


def self_stresses(data: ModelData) -> int:
    matrix, _ = jacobian(data)
    return matrix.shape[0] - _rank(matrix)


def motions(data: ModelData) -> int:
    matrix, _ = jacobian(data)
    return matrix.shape[1] - _rank(matrix)


def releases_counted(data: ModelData) -> int | None:
    """Sets of rows; None where there are too many to look at."""
    matrix, is_fixed = jacobian(data)
    return _counted(matrix, is_fixed)


def declarations_counted(data: ModelData) -> int | None:
    """Sets of columns, likewise."""
    matrix, _ = jacobian(data)
    return _counted(matrix.T, np.ones(matrix.shape[1], bool))


def _rank(matrix: np.ndarray) -> int:
    values = np.linalg.svd(matrix, compute_uv=False)
    return int(np.count_nonzero(values > _ZERO * values.max(initial=0.0)))


def _counted(matrix: np.ndarray, able: np.ndarray) -> int | None:
    size = matrix.shape[0] - _rank(matrix)
    if not size:
        return 1
    space = np.linalg.svd(matrix)[0][:, matrix.shape[0] - size :]
    able = np.flatnonzero(able & (np.linalg.norm(space, axis=1) > _ZERO))
    if math.comb(able.size, size) > _MOST:
        return None
    sets = np.array(list(combinations(able.tolist(), size)), np.int64).reshape(-1, size)
    values = np.linalg.svd(space[sets], compute_uv=False)[:, -1:]
    return int(np.count_nonzero(values > _ZERO))
