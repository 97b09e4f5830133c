# SPDX-License-Identifier: BSD-3-Clause
"""Singular variants between the rows of a table."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, overload

import numpy as np

from ..base.errors import FlexactError
from ..base.frozen import Frozen
from ..core.arrays import FloatArray
from ..engine.running import results_of
from ..result.outcome import Asked
from ..result.result import Result, result_of
from ..result.verdict import Verdict
from .lines import lines_of
from .parameters import Row
from .roots import Zero, minimum, sign_change
from .signed import Signed, SignedColumns, columns_of_signed, signed_value
from .source import Positions, Source, between
from .worker import signed_or_none

if TYPE_CHECKING:
    from .table import Table

#: A singular value this small is not told from zero, whatever the default says.
_ZERO = 1.0e-10
#: With fewer searches than this nobody is sent for.
_FEW = 8


class Crossing(NamedTuple):
    """A singular variant between two rows, or at one."""

    parameters: Row
    """What makes it."""
    along: str
    """The parameter that changes from one row to the next; "rows" where several do."""
    rows: tuple[int, int]
    """The rows on both sides, from 0."""
    share: float
    """Where it is between them, from 0 to 1."""
    width: float
    """How far the share is uncertain."""
    kind: str
    """"sign change"; "touch", a zero from which the singular value rises on both sides without
    changing its sign, or has none; or "row", where a row is singular itself."""
    singular_value: float
    """What is left of it, of the scaled D(c)."""
    verdict: Verdict
    """There."""
    before: Verdict
    """Of the row before."""
    after: Verdict
    """Of the row behind."""
    evaluations: int
    """How many variants were made to find it."""


@dataclass(frozen=True, eq=False, repr=False)
class Crossings(Frozen, Sequence[Crossing]):
    """The singular variants of a table, in the order of its rows.

    Attributes:
        found: Each of them.
        evaluations: How many variants were made to find them, and to find that there are no
            others.
    """

    found: tuple[Crossing, ...]
    evaluations: int

    def __len__(self) -> int:
        """How many were found."""
        return len(self.found)

    @overload
    def __getitem__(self, index: int) -> Crossing: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Crossing, ...]: ...
    def __getitem__(self, index: int | slice) -> Crossing | tuple[Crossing, ...]:
        """One of them, or some."""
        return self.found[index]

    def of(self, parameter: str) -> FloatArray:
        """(crossings,) the values of a parameter.

        Raises:
            KeyError: there is no such parameter.
        """
        return np.array([each.parameters[parameter] for each in self.found], np.float64)

    def __repr__(self) -> str:
        """How many, and the first."""
        told = "; ".join(map(_in_short, self.found[:6]))
        more = "; ..." if len(self) > 6 else ""
        return f"<Crossings: {len(self)}{': ' * bool(told)}{told}{more}>"


def _in_short(each: Crossing) -> str:
    told = [f"{k} {v:.10g}" for k, v in each.parameters.items() if isinstance(v, float)]
    told = told or [f"{each.share:.6g} from row {each.rows[0]} to {each.rows[1]}"]
    return f"{', '.join(told)}: {each.verdict}"


class _Search(NamedTuple):
    """Rows between which a zero may be."""

    along: str
    rows: tuple[int, ...]
    """Two, between which the sign changes, or up to three with a dip at the middle one."""
    is_sign_change: bool
    rank: int
    """The singular value of this number is followed."""
    values: tuple[float, ...]
    """Of the rows."""


class _Found(NamedTuple):
    crossings: tuple[Crossing, ...]
    evaluations: int


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
    if signed is None or bool(((signed.topology < 0) & ~table.has_error).any()):
        signed, made = _signed_rows(table, source, workers), len(table)
    at_rows: list[Crossing] = []
    searches: list[_Search] = []
    for name, rows in lines:
        for run in _runs(table, source, signed, rows):
            zeros, further = _candidates(table, source, signed, name, run)
            at_rows += zeros
            searches += further
    follow = _Follow(table, source)
    few = len(searches) < _FEW
    answers = [each.result for each in results_of(follow, searches, workers=1 if few else workers)]
    found = [each for each in answers if each is not None]
    everything = at_rows + [crossing for each in found for crossing in each.crossings]
    order = sorted(_once(everything), key=lambda each: (*each.rows, each.share, each.along))
    return Crossings(tuple(order), made + sum(each.evaluations for each in found))


def _once(every: Sequence[Crossing]) -> Iterator[Crossing]:
    """Without those at rows that were found along another parameter, too."""
    seen: set[int] = set()
    for each in every:
        if each.kind != "row" or each.rows[0] not in seen:
            yield each
        if each.kind == "row":
            seen.add(each.rows[0])


@dataclass(frozen=True)
class _Rows:
    """Makes the variants of rows, and signs them."""

    table: Table
    source: Source

    def __call__(self, index: int) -> Signed | None:
        """The signed smallest singular value of a row; None where there is none."""
        try:
            row = _parameters(self.table, index, index, 0.0)
            data = self.source.variant(index, index, 0.0, row)
            data.require_sound()
        except Exception:
            return None
        return signed_or_none(data)


def _signed_rows(table: Table, source: Source, workers: int | None) -> SignedColumns:
    every: list[Signed | None] = [None] * len(table)
    work: Callable[[int], Signed | None] = _Rows(table, source)
    for done in results_of(work, range(len(table)), workers=workers):
        every[done.index] = done.result
    return columns_of_signed(every)


def _parameters(table: Table, a: int, b: int, share: float) -> Row:
    names = table.parameter_names
    ends = [[table[name][k : k + 1].tolist()[0] for name in names] for k in (a, b)]
    return between(names, ends[0], ends[1], share)


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


def _candidates(
    table: Table, source: Source, signed: SignedColumns, along: str, run: list[int]
) -> tuple[list[Crossing], list[_Search]]:
    """Rows that are singular themselves, and where to search between rows."""
    ranks = table.rank[run]
    rank = int(ranks.max())
    is_zero = ranks < rank
    values = signed.value[run].copy()
    if rank < signed.size[run[0]]:
        # All are singular alike: what counts is the value that ends the rank.
        follow = _Follow(table, source)
        values = np.array([_nan_if_none(follow.at(row, row, 0.0, rank)) for row in run])
    values[is_zero] = 0.0
    zeros = [
        _at_row(table, along, run, k, float(abs(signed.value[run[k]])))
        for k in np.flatnonzero(is_zero).tolist()
        if not all(is_zero[max(k - 1, 0) : k + 2])
    ]
    searches = []
    size, changes = np.abs(values), np.sign(values[:-1]) * np.sign(values[1:]) < 0.0
    for k in np.flatnonzero(changes).tolist():
        pair = (run[k], run[k + 1])
        searches.append(_Search(along, pair, True, rank, (values[k], values[k + 1])))
    for k in range(len(run)):
        first, last = max(k - 1, 0), min(k + 1, len(run) - 1)
        beside = size[first : last + 1]
        is_dip = size[k] <= beside.min() and first < last and not is_zero[first : last + 1].any()
        if is_dip and not changes[first:last].any():
            rows = tuple(run[first : last + 1])
            searches.append(_Search(along, rows, False, rank, tuple(values[first : last + 1])))
    return zeros, searches


def _nan_if_none(value: float | None) -> float:
    return math.nan if value is None else value


def _at_row(table: Table, along: str, run: list[int], k: int, value: float) -> Crossing:
    row = run[k]
    beside = (max(k - 1, 0), k, min(k + 1, len(run) - 1))
    verdicts = [Verdict(table.verdict[run[j]]) for j in beside]
    return Crossing(
        _parameters(table, row, row, 0.0),
        along,
        (row, row),
        *(0.0, 0.0, "row", value, verdicts[1], verdicts[0], verdicts[2], 0),
    )


@dataclass(frozen=True)
class _Follow:
    """Searches between rows."""

    table: Table
    source: Source

    def at(self, a: int, b: int, share: float, rank: int) -> float | None:
        """The signed singular value between two rows; None where there is none."""
        try:
            data = self.source.variant(a, b, share, _parameters(self.table, a, b, share))
            data.require_sound()
            return signed_value(data, rank).value
        except Exception:
            return None

    def __call__(self, search: _Search) -> _Found:
        """What one search finds."""
        counted = _Counted(self, search)
        zeros = list(_zeros(search, counted))
        made = [self._crossing(search, zero, kind, counted) for zero, kind in zeros]
        return _Found(tuple(each for each in made if each is not None), counted.calls)

    def _crossing(
        self, search: _Search, zero: Zero, kind: str, counted: _Counted
    ) -> Crossing | None:
        """The crossing at a zero, if an analysis there says so, too."""
        a, b, share = counted.between(zero.place)
        row = _parameters(self.table, a, b, share)
        try:
            result = self._singular(self.source, a, b, share, row, search.rank, zero, kind)
        except FlexactError:
            return None
        if result is None:
            return None
        return Crossing(
            *(row, search.along, (a, b), share, zero.width, kind, abs(zero.value)),
            result.verdict,
            Verdict(self.table.verdict[a]),
            Verdict(self.table.verdict[b]),
            counted.calls,
        )

    @staticmethod
    def _singular(
        source: Source, a: int, b: int, share: float, row: Row, rank: int, zero: Zero, kind: str
    ) -> Result | None:
        data = source.variant(a, b, share, row)
        # The numbers there are rounded: to prove something of them says nothing.
        result: Result = result_of(data, Asked(prove=False))
        if result.rank >= rank and (kind == "sign change" or abs(zero.value) < _ZERO):
            # A root lies between two neighbouring numbers, at which it is not quite zero.
            tolerance = max(result.tolerance, 2.0 * abs(zero.value), 2.0 * _last(result))
            result = result_of(data, Asked(prove=False, tolerance=tolerance))
        return result if result.rank < rank else None


def _last(result: Result) -> float:
    return result.gap.smallest_nonzero or 0.0


class _Counted:
    """The signed value along the rows of a search, and how many variants were made for it."""

    def __init__(self, follow: _Follow, search: _Search) -> None:
        self.calls = 0
        self._follow, self._search = follow, search

    def between(self, place: float) -> tuple[int, int, float]:
        """The rows round a place, of which the first row's is 0, and the share between them."""
        rows = self._search.rows
        first = min(max(int(place), 0), len(rows) - 2)
        return rows[first], rows[first + 1], place - first

    def __call__(self, place: float) -> float | None:
        self.calls += 1
        return self._follow.at(*self.between(place), self._search.rank)


def _zeros(search: _Search, function: _Counted) -> Iterator[tuple[Zero, str]]:
    values = search.values
    if search.is_sign_change:
        zero = sign_change(function, 0.0, 1.0, values[0], values[1])
        if zero is not None:
            yield zero, "sign change"
        return
    sign = math.copysign(1.0, values[0])

    def upward(place: float) -> float | None:
        value = function(place)
        return None if value is None else sign * value

    end = float(len(values) - 1)
    lowest = minimum(upward, 0.0, end)
    if isinstance(lowest, Zero):
        yield lowest, "touch"
    elif lowest is not None:
        # Two roots near to each other.
        below = upward(lowest)
        for place, value in ((0.0, values[0]), (end, values[-1])):
            if below is None:
                return
            zero = sign_change(upward, place, lowest, sign * value, below)
            if zero is not None:
                yield zero, "sign change"
