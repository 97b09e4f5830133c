# SPDX-License-Identifier: BSD-3-Clause
"""Groups of things that are joined two by two: connected components."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray


def groups_of(count: int, pairs: Iterable[tuple[int, int]]) -> np.ndarray:
    """(count,) of each thing one of its group, the same for all of the group.

    Of very many pairs `least_of_groups` is faster.
    """
    owner = list(range(count))

    def root(i: int) -> int:
        while owner[i] != i:
            owner[i] = owner[owner[i]]
            i = owner[i]
        return i

    for i, j in pairs:
        owner[root(i)] = root(j)
    return np.array([root(i) for i in range(count)], dtype=np.int64)


def least_of_groups(
    count: int, one: NDArray[np.integer], other: NDArray[np.integer]
) -> NDArray[np.int64]:
    """(count,) the least of the group of each thing, where `one` and `other` are joined, each."""
    group = np.arange(count, dtype=np.int64)
    while one.size:
        a, b = group[one], group[other]
        # Each root joins the least that it meets; then all ways to the roots are shortened.
        np.minimum.at(group, np.maximum(a, b), np.minimum(a, b))
        while not np.array_equal(shorter := group[group], group):
            group = shorter
        apart = group[one] != group[other]
        one, other = one[apart], other[apart]
    return group
