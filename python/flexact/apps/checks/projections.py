# SPDX-License-Identifier: BSD-3-Clause
"""What a projector that is too large to be kept makes of a few fixed vectors.

Two subspaces are practically equal where the orthogonal projectors onto them make the same of
vectors that have nothing to do with them. These vectors follow from the labels alone.
"""

from __future__ import annotations

import zlib
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...core.basis import Basis

#: Number of the fixed vectors.
VECTORS = 3
#: When the equations of a projection count as solved, and how long that may take.
_SOLVED = 1.0e-14
_MOST_STEPS = 500


@dataclass(frozen=True)
class Images:
    """The images of the fixed vectors under an orthogonal projector.

    Attributes:
        labels: What each row is; labels that are left out stand for zeros.
        values: (labels, VECTORS).
    """

    labels: tuple[str, ...]
    values: FloatArray


def fixed_vectors(labels: Sequence[str]) -> FloatArray:
    """(labels, VECTORS) numbers between -1 and 1 that follow from the labels alone."""
    made = np.empty((len(labels), VECTORS))
    for k in range(VECTORS):
        made[:, k] = [zlib.crc32(f"{k}/{label}".encode()) for label in labels]
    return made / 2.0**31 - 1.0


def project(basis: Basis, vectors: FloatArray) -> FloatArray:
    """(size, p) orthogonal projections of vectors onto the span of a basis.

    The basis need not be orthonormal: B (B'B)^-1 B' is applied by conjugate gradients
    (Hestenes and Stiefel 1952), which take one step where it is.
    """
    of_entry = basis.of_entries()

    def combine(factors: FloatArray) -> FloatArray:
        sums = np.bincount(basis.place, basis.value * factors[of_entry], basis.size)
        return np.asarray(sums, np.float64)

    def products(vector: FloatArray) -> FloatArray:
        sums = np.bincount(of_entry, basis.value * vector[basis.place], basis.vectors)
        return np.asarray(sums, np.float64)

    made = np.zeros((basis.size, vectors.shape[1]))
    for k in range(vectors.shape[1]):
        rest = products(vectors[:, k])
        direction, square = rest, rest @ rest
        least = _SOLVED**2 * square
        for _ in range(_MOST_STEPS):
            if not square > least:
                break
            change = combine(direction)
            step = square / (change @ change)
            made[:, k] += step * change
            rest = rest - step * products(change)
            before, square = square, rest @ rest
            direction = rest + square / before * direction
    return made
