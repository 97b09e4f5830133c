"""What hangs together: groups of things that are joined in pairs."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np


def groups_of(count: int, pairs: Iterable[tuple[int, int]]) -> np.ndarray:
    """(count,) of each thing one of its group, the same for all of the group."""
    owner = list(range(count))

    def root(i: int) -> int:
        while owner[i] != i:
            owner[i] = owner[owner[i]]
            i = owner[i]
        return i

    for i, j in pairs:
        owner[root(i)] = root(j)
    return np.array([root(i) for i in range(count)], dtype=np.int64)
