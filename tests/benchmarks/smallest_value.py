# SPDX-License-Identifier: BSD-3-Clause
"""Error of the smallest singular value against 60 digits, where it is very small.

    python tests/benchmarks/smallest_value.py small|amplifying COLUMNS METHOD ...

takes stages a nanometre apart, whose rows and columns differ by powers of ten, or stages that
amplify the motion of the last one. Prints a line of JSON: the columns, the smallest singular
value over the largest, and by method the relative error of the smallest one of D(c) as it is
stored.
"""

from __future__ import annotations

import json
import sys

import mpmath as mp
import numpy as np
from families import ill_conditioned, small_stages
from numpy.typing import NDArray

import flexact

_DIGITS = 60
#: Relative change at which the iteration ends: far below the rounding of doubles.
_ENOUGH = 1e-25
#: Steps of the iteration in doubles, which are cheap.
_STEPS = 300
#: Arm at which a stage amplifies the motion of the last one about twenty times.
_ARM = 1.1


def main() -> None:
    """Measure and print."""
    kind, columns, *methods = sys.argv[1:]
    small = kind == "small"
    case = small_stages(int(columns)) if small else ill_conditioned(int(columns), arm=_ARM)
    with mp.workdps(_DIGITS):
        matrix = flexact.analyse(case.model, method="svd").dense_jacobian()
        true, largest = smallest_singular_value(matrix)
        errors = {}
        for method in methods:
            values = flexact.analyse(case.model, method=method).singular_values
            # A sparse decomposition may give those of the scaled matrix alone.
            if values.size:
                errors[method] = float(abs(mp.mpf(float(values[-1])) / true - 1))
    ratio = float(true) / largest
    print(json.dumps({"kind": kind, "columns": case.columns, "ratio": ratio, "errors": errors}))


def smallest_singular_value(matrix: NDArray[np.float64]) -> tuple[mp.mpf, float]:
    """Of a square matrix that doubles can tell from a singular one; and its largest one.

    Inverse iteration, begun in doubles. Systems are solved with the inverse in doubles of the
    matrix with columns of like size, and refined in the working precision of mpmath, in which
    the matrix and its scaling by powers of two are exact.
    """
    scale = np.exp2(np.round(np.log2(np.linalg.norm(matrix, axis=0))))
    balanced = matrix / scale
    inverse: NDArray[np.float64] = np.linalg.inv(balanced).astype(np.float64)
    forth, back = _Exact(balanced), _Exact(balanced.T)
    vector = _exact(_begun(inverse / scale[:, None]))
    value, before = mp.mpf(0), mp.mpf(1)
    while abs(value - before) > _ENOUGH * before:
        left = _refined(back, inverse.T, vector / scale)
        vector = _refined(forth, inverse, left) / scale
        value, before = _norm(left) / _norm(vector), value
        vector = vector / _norm(vector)
    return value, float(np.linalg.norm(matrix, 2))


def _begun(inverse: NDArray[np.float64]) -> NDArray[np.float64]:
    """A vector near the right singular vector of the smallest singular value."""
    vector = np.ones(len(inverse))
    for _ in range(_STEPS):
        vector = inverse @ (inverse.T @ (vector / np.linalg.norm(vector)))
    return vector / np.linalg.norm(vector)


class _Exact:
    """A matrix whose products are formed in the working precision."""

    def __init__(self, matrix: NDArray[np.float64]) -> None:
        self._row, self._column = np.nonzero(matrix)
        self._value = _exact(matrix[self._row, self._column])
        self._start = np.flatnonzero(np.diff(self._row, prepend=-1))

    def times(self, vector: NDArray[np.object_]) -> NDArray[np.object_]:
        """The product; every row of the matrix has an entry."""
        made: NDArray[np.object_] = np.add.reduceat(self._value * vector[self._column], self._start)
        return made


def _refined(
    matrix: _Exact, inverse: NDArray[np.float64], right: NDArray[np.object_]
) -> NDArray[np.object_]:
    solution: NDArray[np.object_] = right * 0
    while True:
        rest = right - matrix.times(solution)
        size = _norm(rest)
        if size <= mp.mpf(10) ** (8 - _DIGITS) * _norm(right):
            return solution
        step = inverse @ (rest / size).astype(np.float64)
        solution = solution + _exact(step) * size


def _exact(numbers: NDArray[np.float64]) -> NDArray[np.object_]:
    made: NDArray[np.object_] = np.array([mp.mpf(float(number)) for number in numbers], object)
    return made


def _norm(vector: NDArray[np.object_]) -> mp.mpf:
    return mp.sqrt(np.dot(vector, vector))


if __name__ == "__main__":
    main()
