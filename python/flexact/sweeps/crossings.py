# SPDX-License-Identifier: BSD-3-Clause
"""Singular variants between the rows of a table: where to search, and all that is found."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..analysis.verdict import Verdict
from .columns import in_a_line
from .crossing import ROWS, Crossing, Crossings, Missed, lines_of
from .evaluate import Positions, Signed, SignedColumns, Source, columns_of_signed, signed_value
from .running import results_of
from .search import Follow, Found, Search, parameters_between

if TYPE_CHECKING:
    from .table import Table

#: With fewer searches than this nobody is sent for.
_FEW = 8
#: Crossings as near to each other as this part of a step are one.
_ONE_PLACE = 1.0e-12
#: How far beside a row that is singular itself the sign counts: a part of the step.
_BESIDE = 2.0**-10


def crossings_of(
    table: Table,
    source: Source,
    signed: SignedColumns | None,
    along: str | None,
    workers: int | None,
) -> Crossings:
    """See `Table.crossings`."""
    lines = lines_of(table, along, isinstance(source, Positions))
    made = 0
    missed: list[Missed] = []
    if signed is None or bool(((signed.topology < 0) & ~table.has_error).any()):
        signed, made = _signed_rows(table, source, workers, missed), len(table)
    follow = Follow(table, source)
    at_rows: list[Crossing] = []
    searches: list[Search] = []
    for name, rows in lines:
        for run in _runs(table, source, signed, rows):
            candidates = _Candidates(follow, signed, name, run)
            at_rows += candidates.at_rows
            searches += candidates.searches
            missed += candidates.missed
            made += candidates.evaluations
    few = len(searches) < _FEW
    found: list[Found] = []
    for each in results_of(follow, searches, workers=1 if few else workers):
        if each.result is None:
            missed.append(follow.missed(searches[each.index], 0.5, each.failure))
        else:
            found.append(each.result)
    missed += [one for each in found for one in each.missed]
    everything = at_rows + [crossing for each in found for crossing in each.crossings]
    order = sorted(everything, key=lambda each: (*each.rows, each.share, each.along))
    return Crossings(
        tuple(_once(order)),
        made + sum(each.evaluations for each in found),
        tuple(sorted(missed, key=lambda each: (*each.rows, each.along))),
    )


def _once(every: Iterable[Crossing]) -> list[Crossing]:
    """Each crossing once, however many searches found it, and rows along however many lines."""
    kept: list[Crossing] = []
    beside: dict[int, list[Crossing]] = defaultdict(list)
    for each in every:
        if not any(_is_same(each, other) for row in each.rows for other in beside[row]):
            kept.append(each)
            for row in set(each.rows):
                beside[row].append(each)
    return kept


def _is_same(one: Crossing, other: Crossing) -> bool:
    """Whether two crossings that share a row are at one place, as far as places are known."""
    if one.kind == other.kind == "row":
        return one.rows == other.rows
    if one.along != other.along:
        return False
    a, b = other.rows
    if one.rows == other.rows:
        apart = abs(one.share - other.share)
    elif one.rows[0] == b:
        apart = (1.0 - other.share) * (a != b) + one.share
    elif one.rows[1] == a:
        apart = (1.0 - one.share) * (one.rows[0] != one.rows[1]) + other.share
    else:
        return False
    return apart <= one.width + other.width + _ONE_PLACE


@dataclass(frozen=True)
class _Rows:
    """Makes the variants of rows, and signs them."""

    table: Table
    source: Source

    def __call__(self, index: int) -> Signed | str:
        """The signed smallest singular value of a row, or why there is none."""
        try:
            row = parameters_between(self.table, index, index, 0.0)
            data = self.source.variant(index, index, 0.0, row)
            data.require_sound()
            return signed_value(data)
        except Exception as error:
            return in_a_line(error)


def _signed_rows(
    table: Table, source: Source, workers: int | None, missed: list[Missed]
) -> SignedColumns:
    every: list[Signed | None] = [None] * len(table)
    work: Callable[[int], Signed | str] = _Rows(table, source)
    for done in results_of(work, range(len(table)), workers=workers):
        if isinstance(done.result, Signed):
            every[done.index] = done.result
        elif not table.error[done.index]:
            row = parameters_between(table, done.index, done.index, 0.0)
            error = done.result or done.failure
            missed.append(Missed(row, ROWS, (done.index, done.index), error))
    return columns_of_signed(every)


def _runs(
    table: Table, source: Source, signed: SignedColumns, rows: Sequence[int]
) -> Iterator[list[int]]:
    """Rows of a line in pieces of one topology, without errors."""
    run: list[int] = []
    for row in rows:
        there = not table.error[row] and not math.isnan(signed.value[row])
        if run and there:
            one = signed.topology[run[-1]] == signed.topology[row]
            if not (one and source.goes_between(run[-1], row)):
                yield run
                run = []
        elif not there:
            if run:
                yield run
            run = []
        if there:
            run.append(row)
    if run:
        yield run


class _Candidates:
    """Of a run of rows those that are singular themselves, and where to search between them."""

    def __init__(self, follow: Follow, signed: SignedColumns, along: str, run: list[int]) -> None:
        self._follow, self._along, self._run = follow, along, run
        self._topology = int(signed.topology[run[0]])
        self.missed: list[Missed] = []
        self.evaluations = 0
        ranks = follow.table.rank[run]
        self._rank = int(ranks.max())
        is_zero = ranks < self._rank
        values = signed.value[run].copy()
        if self._rank < signed.size[run[0]]:
            # All are singular alike: what counts is the value that ends the rank.
            values = np.array([self._at(k, k, 0.0) for k in range(len(run))])
        values[is_zero] = 0.0
        self.at_rows = [
            _at_row(follow.table, along, run, k, float(abs(signed.value[run[k]])))
            for k in np.flatnonzero(is_zero).tolist()
            if not all(is_zero[max(k - 1, 0) : k + 2])
        ]
        self.searches = [*self._changes(values, is_zero), *self._dips(values, is_zero)]

    def _at(self, k: int, j: int, share: float) -> float:
        """The value between two rows of the run; NaN, which is told, where there is none."""
        a, b = self._run[k], self._run[j]
        self.evaluations += 1
        value, error = self._follow.at(a, b, share, self._rank, self._topology)
        if value is None:
            row = parameters_between(self._follow.table, a, b, share)
            self.missed.append(Missed(row, self._along, (a, b), error))
            return math.nan
        return value

    def _changes(self, values: np.ndarray, is_zero: np.ndarray) -> Iterator[Search]:
        """Between which rows the sign changes; it has none at a row that is singular itself."""
        for k in range(len(self._run) - 1):
            ends, there = [0.0, 1.0], [float(values[k]), float(values[k + 1])]
            if is_zero[k] and not is_zero[k + 1]:
                ends[0] = _BESIDE
                there[0] = self._at(k, k + 1, ends[0])
            if is_zero[k + 1] and not is_zero[k]:
                ends[1] = 1.0 - _BESIDE
                there[1] = self._at(k, k + 1, ends[1])
            # Their product may be too small for a number.
            if {*np.sign(there).tolist()} == {-1.0, 1.0}:
                pair, found = (self._run[k], self._run[k + 1]), (there[0], there[1])
                yield self._search(pair, True, found, (ends[0], ends[1]))

    def _dips(self, values: np.ndarray, is_zero: np.ndarray) -> Iterator[Search]:
        """Rows at which the value is lower than at those beside it."""
        size, run = np.abs(values), self._run
        changes = np.sign(values[:-1]) * np.sign(values[1:]) < 0.0
        for k in range(len(run)):
            first, last = max(k - 1, 0), min(k + 1, len(run) - 1)
            beside = size[first : last + 1]
            is_dip = size[k] <= beside.min() and first < last
            if is_dip and not is_zero[first : last + 1].any() and not changes[first:last].any():
                own = tuple(values[first : last + 1].tolist())
                yield self._search(tuple(run[first : last + 1]), False, own)

    def _search(
        self,
        rows: tuple[int, ...],
        is_sign_change: bool,
        values: tuple[float, ...],
        ends: tuple[float, float] = (0.0, 1.0),
    ) -> Search:
        return Search(self._along, rows, is_sign_change, self._rank, values, self._topology, ends)


def _at_row(table: Table, along: str, run: list[int], k: int, value: float) -> Crossing:
    row = run[k]
    beside = (max(k - 1, 0), k, min(k + 1, len(run) - 1))
    verdicts = [Verdict(table.verdict[run[j]]) for j in beside]
    return Crossing(
        parameters_between(table, row, row, 0.0),
        along,
        (row, row),
        *(0.0, 0.0, "row", value, verdicts[1], verdicts[0], verdicts[2], 0),
    )
