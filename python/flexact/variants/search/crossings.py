# SPDX-License-Identifier: BSD-3-Clause
"""Singular variants between the rows of a table: where to search, and all that is found."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...engine.running import results_of
from ...result.verdict import Verdict
from ..sweeps.source import Positions, Source
from ..sweeps.worker import signed_or_none
from .crossing import Crossing, Crossings
from .lines import lines_of
from .searches import Follow, Search, parameters_between
from .signed import Signed, SignedColumns, columns_of_signed

if TYPE_CHECKING:
    from ..table import Table

#: With fewer searches than this nobody is sent for.
_FEW = 8


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
    searches: list[Search] = []
    for name, rows in lines:
        for run in _runs(table, source, signed, rows):
            zeros, further = _candidates(table, source, signed, name, run)
            at_rows += zeros
            searches += further
    follow = Follow(table, source)
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
            row = parameters_between(self.table, index, index, 0.0)
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
) -> tuple[list[Crossing], list[Search]]:
    """Rows that are singular themselves, and where to search between rows."""
    ranks, topology = table.rank[run], int(signed.topology[run[0]])
    rank = int(ranks.max())
    is_zero = ranks < rank
    values = signed.value[run].copy()
    if rank < signed.size[run[0]]:
        # All are singular alike: what counts is the value that ends the rank.
        follow = Follow(table, source)
        values = np.array([_nan_if_none(follow.at(row, row, 0.0, rank, topology)) for row in run])
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
        searches.append(Search(along, pair, True, rank, (values[k], values[k + 1]), topology))
    for k in range(len(run)):
        first, last = max(k - 1, 0), min(k + 1, len(run) - 1)
        beside = size[first : last + 1]
        is_dip = size[k] <= beside.min() and first < last and not is_zero[first : last + 1].any()
        if is_dip and not changes[first:last].any():
            rows = tuple(run[first : last + 1])
            own = tuple(values[first : last + 1].tolist())
            searches.append(Search(along, rows, False, rank, own, topology))
    return zeros, searches


def _nan_if_none(value: float | None) -> float:
    return math.nan if value is None else value


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
