# SPDX-License-Identifier: BSD-3-Clause
"""The rows of a matrix in terms of some of them that are well-conditioned."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import FloatArray

#: Entries of an echelon form beyond which the rows are better exchanged.
_EXCHANGED = 1.01
#: How many exchanges there are at most for each factor.
_MOST_EXCHANGES = 10


@dataclass(frozen=True)
class Echelon:
    """Rows of a matrix in terms of some of them.

    Attributes:
        basis: (k,) numbers of the rows of the basis.
        others: (n - k,) numbers of the others.
        factor: (k, n - k) of each other row the multiples of the rows of the basis that it is.
        smallest: Smallest singular value of the block of the basis.
    """

    basis: NDArray[np.integer]
    others: NDArray[np.integer]
    factor: FloatArray
    smallest: float


def echelon_of(matrix: FloatArray, least: float = 0.0) -> Echelon | None:
    """The rows of a matrix (n, k) in terms of k of them, whose block is well-conditioned.

    No factor is larger than 1.01: no exchange of one row makes the block much larger. None where
    the smallest singular value of the best block is not above `least`.
    """
    rows, count = matrix.shape
    if rows < count:
        return None
    rest, chosen = matrix.copy(), []
    for _ in range(count):
        row, column = divmod(int(np.argmax(np.abs(rest))), count)
        if not abs(rest[row, column]) > least:
            return None
        chosen.append(row)
        rest -= np.outer(rest[:, column], rest[row] / rest[row, column])
        rest[row], rest[:, column] = 0.0, 0.0
    basis = np.array(chosen, np.int64)
    others = np.setdiff1d(np.arange(rows), basis)
    if not _smallest(matrix[basis]) > least:
        return None
    factor = _in_terms_of(matrix[basis], matrix[others])
    for _ in range(_MOST_EXCHANGES * factor.size):
        i, j = divmod(int(np.argmax(np.abs(factor))), others.size)
        if abs(factor[i, j]) <= _EXCHANGED:
            break
        basis[i], others[j] = others[j], basis[i]
        factor = _in_terms_of(matrix[basis], matrix[others])
    return Echelon(basis, others, factor, _smallest(matrix[basis]))


def _in_terms_of(basis: FloatArray, others: FloatArray) -> FloatArray:
    return np.asarray(np.linalg.solve(basis.T, others.T), np.float64)


def _smallest(block: FloatArray) -> float:
    return float(np.linalg.svd(block, compute_uv=False)[-1]) if block.size else 1.0
