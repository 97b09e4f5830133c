"""Error of the smallest singular value against 60 digits, as the conditioning grows.

    python tests/benchmarks/smallest_value.py COLUMNS METHOD ...

prints a line of JSON: the columns, the smallest singular value over the largest, and by
method the relative error of the smallest one of D(c) as it is stored.
"""

from __future__ import annotations

import json
import sys

import mpmath as mp
import numpy as np
from families import ill_conditioned
from numpy.typing import NDArray

import flexact

_DIGITS = 60
#: Arm at which a stage amplifies the motion of the last one about twenty times.
_ARM = 1.1


def main() -> None:
    """Measure and print."""
    case = ill_conditioned(int(sys.argv[1]), arm=_ARM)
    with mp.workdps(_DIGITS):
        matrix = flexact.analyse(case.model, method="svd").dense_jacobian()
        true, largest = smallest_singular_value(matrix)
        errors = {}
        for method in sys.argv[2:]:
            values = flexact.analyse(case.model, method=method).singular_values
            # A sparse decomposition may give those of the scaled matrix alone.
            if values.size:
                errors[method] = float(abs(mp.mpf(float(values[-1])) / true - 1))
    print(json.dumps({"columns": case.columns, "ratio": float(true) / largest, "errors": errors}))


def smallest_singular_value(matrix: NDArray[np.float64]) -> tuple[mp.mpf, float]:
    """Of a square matrix that doubles can tell from a singular one; and its largest one.

    Inverse iteration from numpy's singular vector. Systems are solved with numpy's inverse
    and refined in the working precision of mpmath, in which the matrix is exact.
    """
    _, values, vt = np.linalg.svd(matrix)
    inverse: NDArray[np.float64] = np.linalg.inv(matrix).astype(np.float64)
    forth, back = _Exact(matrix), _Exact(matrix.T)
    vector = _exact(vt[-1])
    value, before = mp.mpf(0), mp.mpf(1)
    while abs(value - before) > mp.mpf(10) ** (-_DIGITS // 2) * before:
        left = _refined(back, inverse.T, vector)
        vector = _refined(forth, inverse, left)
        value, before = _norm(left) / _norm(vector), value
        vector = vector / _norm(vector)
    return value, float(values[0])


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
