# SPDX-License-Identifier: BSD-3-Clause
"""Searches for singular variants between neighbouring rows."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from ..analysis.decomposition import Asked
from ..analysis.result import Result, result_of
from ..analysis.verdict import Verdict
from ..util.errors import FlexactError
from .crossing import Crossing, Missed
from .parameters import Row
from .roots import Zero, minimum, sign_change
from .row import in_a_line
from .signed import signed_value
from .source import Source
from .source import between as row_between

if TYPE_CHECKING:
    from .table import Table

_ANOTHER = "another mechanism than those of the rows: its coordinates or deformations are others"
#: A singular value this small is not told from zero, whatever the default says.
_ZERO = 1.0e-10


class Search(NamedTuple):
    """Rows between which a zero may be; the first is at 0, the next at 1."""

    along: str
    rows: tuple[int, ...]
    """Two, between which the sign changes, or up to three with a dip at the middle one."""
    is_sign_change: bool
    rank: int
    """The singular value of this number is followed."""
    values: tuple[float, ...]
    """Of the rows."""
    topology: int
    """Of all of them; see `flexact.sweeps.signed`."""
    ends: tuple[float, float] = (0.0, 1.0)
    """Between which places the sign changes; `values` are of these then."""


class Found(NamedTuple):
    """What a search found, and how many variants were made for it."""

    crossings: tuple[Crossing, ...]
    evaluations: int
    missed: tuple[Missed, ...] = ()


def parameters_between(table: Table, a: int, b: int, share: float) -> Row:
    """The parameters between those of two rows."""
    names = table.parameter_names
    ends = [[table[name][k : k + 1].tolist()[0] for name in names] for k in (a, b)]
    return row_between(names, ends[0], ends[1], share)


def between(search: Search, place: float) -> tuple[int, int, float]:
    """The rows round a place, of which the first row's is 0, and the share between them."""
    first = min(max(int(place), 0), len(search.rows) - 2)
    return search.rows[first], search.rows[first + 1], place - first


@dataclass(frozen=True)
class Follow:
    """Searches between rows."""

    table: Table
    source: Source

    def at(
        self, a: int, b: int, share: float, rank: int, topology: int
    ) -> tuple[float | None, str]:
        """The signed singular value between two rows; None, and why, where there is none."""
        try:
            data = self.source.variant(a, b, share, parameters_between(self.table, a, b, share))
            data.require_sound()
            found = signed_value(data, rank)
        except Exception as error:
            return None, in_a_line(error)
        if found.topology != topology:
            return None, _ANOTHER
        return found.value, ""

    def __call__(self, search: Search) -> Found:
        """What one search finds."""
        counted = _Counted(self, search)
        zeros = list(_zeros(search, counted))
        made = [self._crossing(search, zero, kind, counted) for zero, kind in zeros]
        missed = [self.missed(search, *each) for each in counted.errors[:1]]
        found = tuple(each for each in made if each is not None)
        return Found(found, counted.calls, tuple(missed))

    def missed(self, search: Search, place: float, error: str) -> Missed:
        """A search that an error at a place has ended."""
        a, b, share = between(search, place)
        row = parameters_between(self.table, a, b, share)
        return Missed(row, search.along, (a, b), error)

    def _crossing(
        self, search: Search, zero: Zero, kind: str, counted: _Counted
    ) -> Crossing | None:
        """The crossing at a zero, if an analysis there says so, too."""
        a, b, share = between(search, zero.place)
        row = parameters_between(self.table, a, b, share)
        try:
            result = self._singular(self.source, a, b, share, row, search.rank, zero, kind)
        except FlexactError as error:
            counted.errors.append((zero.place, in_a_line(error)))
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

    def __init__(self, follow: Follow, search: Search) -> None:
        self.calls = 0
        self.errors: list[tuple[float, str]] = []
        self._follow, self._search = follow, search

    def __call__(self, place: float) -> float | None:
        self.calls += 1
        where, search = between(self._search, place), self._search
        value, error = self._follow.at(*where, search.rank, search.topology)
        if error:
            self.errors.append((place, error))
        return value


def _zeros(search: Search, function: _Counted) -> Iterator[tuple[Zero, str]]:
    values = search.values
    if search.is_sign_change:
        zero = sign_change(function, *search.ends, values[0], values[1])
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
