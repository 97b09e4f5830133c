# SPDX-License-Identifier: BSD-3-Clause
"""Sets of rows that span a null space, the best first."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import chain, combinations
from typing import NamedTuple

import numpy as np

from ...analysis.ways import spanning
from ...core.arrays import FloatArray
from .candidates import Places, Reach

#: Up to so many sets are looked at; of more those near a good one.
_MOST_SETS, _FEWEST_SETS, _MOST_OPERATIONS = 20_000, 40, 2.0e7
#: Of so many rows at most, those that reach furthest.
_MOST_ROWS = 400
#: Blocks worse than this are none; nor those so many times worse than the best.
_WORST, _MUCH_WORSE = 1.0e7, 1.0e5
#: How often a set is looked for near the best of those known, and near how many.
_ROUNDS, _NEAR = 2, 4
#: Of larger sets none are looked for near another.
_MOST_EXCHANGED = 60


class Candidate(NamedTuple):
    """A set of rows whose block is regular."""

    members: tuple[int, ...]
    """Places in the reach."""
    condition: float
    """The inverse of the smallest singular value of its block, 1 at best."""
    rank: tuple[float, ...]
    """By what it is sorted among others."""


#: Sizes by which sets are sorted before their condition, (sets, any), of (sets, k) rows.
Ranking = Callable[[Places, FloatArray], FloatArray]


def candidates(reach: Reach, ranking: Ranking, wishes: FloatArray) -> list[Candidate]:
    """Sets of rows whose blocks are regular, the best first.

    Args:
        reach: The rows over the space.
        ranking: Of sets and their conditions, what they are sorted by before.
        wishes: (n,) how unwelcome each row is; where sets are too many those of little are looked
            at.
    """
    count = reach.vectors
    place = _order(reach)
    found = list(_sets(reach, place, count, wishes))
    if not found:
        return []
    sets = np.array(found, np.int64)
    condition = _conditions(reach.rows, sets)
    good = condition < min(_WORST, _MUCH_WORSE * float(condition.min()))
    sets, condition = sets[good], condition[good]
    if not sets.size:
        return []
    rounded = np.round(np.log(condition), 6)[:, None]
    ranks = np.concatenate([np.round(ranking(sets, condition), 6), rounded], axis=1).tolist()
    keys = [tuple(sorted(place[list(each)].tolist())) for each in sets.tolist()]
    order = sorted(range(len(keys)), key=lambda i: (tuple(ranks[i]), keys[i]))
    return [
        Candidate(
            tuple(sorted(sets[i].tolist(), key=lambda row: int(place[row]))),
            float(condition[i]),
            tuple(ranks[i]),
        )
        for i in order
    ]


def _order(reach: Reach) -> Places:
    """(n,) the place of each row among all by names and geometry."""
    keys = [reach.key(int(i)) for i in reach.index]
    place = np.empty(len(keys), np.int64)
    place[sorted(range(len(keys)), key=keys.__getitem__)] = np.arange(len(keys))
    return place


def _conditions(rows: FloatArray, sets: Places) -> FloatArray:
    values = np.linalg.svd(rows[sets], compute_uv=False)[:, -1]
    with np.errstate(divide="ignore"):
        made: FloatArray = np.divide(1.0, values)
    return made


def _sets(reach: Reach, place: Places, count: int, wishes: FloatArray) -> Iterator[Sequence[int]]:
    norms = np.linalg.norm(reach.rows, axis=1)
    able = np.flatnonzero(norms > norms.max(initial=0.0) / _WORST)
    if able.size < count:
        return
    most_sets = max(_FEWEST_SETS, min(_MOST_SETS, int(_MOST_OPERATIONS / count**3)))
    if math.comb(able.size, count) <= most_sets:
        yield from combinations(able.tolist(), count)
        return
    is_large = count > _MOST_EXCHANGED
    if able.size > _MOST_ROWS and not is_large:
        order = np.lexsort((place[able], -np.round(norms[able], 9)))
        able = able[order[:_MOST_ROWS]]
    known: dict[tuple[int, ...], None] = {}
    for most in np.unique(wishes[able]).tolist():
        if known and is_large:
            break
        some = able[wishes[able] <= most]
        chosen = spanning(reach.rows[some], lambda i, some=some: int(place[some[i]]))  # type: ignore[misc]
        if len(chosen) == count:
            known[tuple(sorted(some[chosen].tolist()))] = None
    for _ in range(_ROUNDS if known and not is_large else 0):
        sets = list(known)
        best = np.argsort(np.round(_conditions(reach.rows, np.array(sets)), 9), kind="stable")
        near = (_exchanges(sets[i], able.tolist()) for i in best[:_NEAR].tolist())
        for each in chain.from_iterable(near):
            if len(known) >= most_sets:
                break
            known.setdefault(each)
    yield from known


def _exchanges(members: tuple[int, ...], able: list[int]) -> Iterator[tuple[int, ...]]:
    """The sets in which one row is another."""
    for k in range(len(members)):
        rest = members[:k] + members[k + 1 :]
        for other in able:
            if other not in members:
                yield tuple(sorted((*rest, other)))
