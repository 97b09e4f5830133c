# SPDX-License-Identifier: BSD-3-Clause
"""Orthonormal bases of small matrices: of what their columns span, and of what is across that."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def span(columns: FloatArray, least: float) -> FloatArray:
    """(n, r) orthonormal columns that span the same as others (n, k).

    Args:
        columns: Of any length.
        least: Singular values up to here are zero.
    """
    if not columns.size:
        return np.zeros((columns.shape[0], 0))
    left, values, _ = np.linalg.svd(columns, full_matrices=False)
    return np.asarray(left[:, values > least])


def complement(columns: FloatArray) -> FloatArray:
    """(n, n - k) orthonormal columns across independent ones, (n, k)."""
    count, many = columns.shape
    if not many:
        return np.eye(count)
    return np.asarray(np.linalg.qr(columns, mode="complete")[0][:, many:])


def null_space(matrix: FloatArray, least: float) -> FloatArray:
    """(k, d) orthonormal columns that a matrix (rows, k) sends to zero.

    Args:
        matrix: Any.
        least: Singular values up to here are zero.
    """
    rows, count = matrix.shape
    if not rows:
        return np.eye(count)
    _, values, right = np.linalg.svd(matrix)
    return np.asarray(right[int(np.count_nonzero(values > least)) :].T)


def first_largest(values: FloatArray) -> int:
    """Where the largest of some values is, none below zero; of equal ones the first.

    Equal are those that differ by rounding, in the seventh digit.
    """
    return int(np.argmax(np.round(values / max(float(values.max()), 1.0e-300), 6)))
