# SPDX-License-Identifier: BSD-3-Clause
"""Groups of things: joined two by two, by a key, or alike."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Key = TypeVar("_Key", bound=Hashable)
_Thing = TypeVar("_Thing")


def grouped(pairs: Iterable[tuple[_Key, _Thing]]) -> dict[_Key, list[_Thing]]:
    """Things by their keys, each key and each thing in the order in which they come."""
    made: dict[_Key, list[_Thing]] = {}
    for key, thing in pairs:
        made.setdefault(key, []).append(thing)
    return made


def distinct(things: Iterable[_Thing], are_alike: Callable[[_Thing, _Thing], bool]) -> list[_Thing]:
    """Of things that are alike the first; `are_alike` is asked of a thing and one before it."""
    made: list[_Thing] = []
    for thing in things:
        if not any(are_alike(thing, other) for other in made):
            made.append(thing)
    return made


def groups_of(count: int, pairs: Iterable[tuple[int, int]]) -> NDArray[np.int64]:
    """(count,) the least of the group of each thing, of pairs that are joined."""
    ends = np.array(list(pairs), np.int64).reshape(-1, 2)
    return least_of_groups(count, ends[:, 0], ends[:, 1])


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


def values_in(array: ArrayLike) -> NDArray[Any]:
    """Each value of an array once, in order; plain `numpy.unique` would import numpy.ma first."""
    ordered = np.sort(array, axis=None)
    is_first = np.ones(ordered.size, bool)
    is_first[1:] = ordered[1:] != ordered[:-1]
    values: NDArray[Any] = ordered[is_first]
    return values
