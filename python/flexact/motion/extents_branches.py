# SPDX-License-Identifier: BSD-3-Clause
"""Paths that several motions begin together, by what the told motions have in them."""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray
from .extent import Branch

#: Directions are one where the cosine between them is larger.
_SAME = 0.999


def branches_of(
    lines: tuple[FloatArray, ...], vectors: dict[int, FloatArray]
) -> tuple[Branch, ...]:
    """The paths in some directions, each once; those with little of the first motions first.

    Args:
        lines: (N,) directions of norm one.
        vectors: (N,) the told motions by index.
    """
    told = np.stack(list(vectors.values()), axis=1)
    made: list[FloatArray] = []
    for line in lines:
        if not any(abs(line @ other) > _SAME for other in made):
            made.append(line)
    found = [
        _branch(np.asarray(np.linalg.lstsq(told, line, rcond=None)[0], np.float64), vectors)
        for line in made
    ]
    return tuple(sorted(found, key=lambda each: [share for _, share in each.shares]))


def _branch(shares: FloatArray, vectors: dict[int, FloatArray]) -> Branch:
    """The largest share is 1, of equal ones the first."""
    size = np.abs(shares)
    largest = shares[np.argmax(size > (1.0 - 1.0e-5) * size.max())]
    return Branch(tuple(zip(vectors, (shares / largest).tolist(), strict=True)))
