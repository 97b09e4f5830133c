# SPDX-License-Identifier: BSD-3-Clause
"""Searches for singular variants between neighbouring rows."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from ..analysis.decomposition import Asked
from ..analysis.result import Result, result_of
from ..analysis.verdict import Verdict
from ..util.errors import FlexactError
from .columns import in_a_line
from .crossing import Crossing, Missed
from .evaluate import Source, signed_value
from .evaluate import between as row_between
from .parameters import Row

if TYPE_CHECKING:
    from .table import Table


Function = Callable[[float], float | None]

#: The variable goes from 0 to 1, or from -1 to 1: it is known to the last bit or two.
_LAST_BITS = 4.0e-16
#: A continuous function is this much smaller at a root than at the ends where the search began.
_CONTINUOUS = 1.0e-6
_GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0
#: A minimum this many times higher than what is left to fall does not reach zero; looked at once
#: the search has come so far.
_NO_ZERO, _WARM = 10.0, 6
_MOST_STEPS = 200
#: What cannot be told from the minimum: so many times as much, or rounding of values about one.
_AS_LOW, _NOTHING = 2.0, 4.0e-16
#: A function is below zero where it is so by more than rounding.
_BELOW = 1.0e-14


class Zero(NamedTuple):
    """A place where a function is zero."""

    place: float
    value: float
    """What is left of the function there."""
    width: float
    """How wide the interval is in which it lies."""


def sign_change(function: Function, a: float, b: float, fa: float, fb: float) -> Zero | None:
    """The root between two places at which a function has different signs.

    Bisection, sped up where it can be by inverse quadratic interpolation, so that the root stays
    between the two: T.R. Chandrupatla, A new hybrid quadratic/bisection algorithm, Advances in
    Engineering Software 28 (1997) 145-149. None where the function jumps or is not defined.
    """
    largest = max(abs(fa), abs(fb))
    c, fc = a, fa
    share = 0.5
    for _ in range(_MOST_STEPS):
        place = a + share * (b - a)
        value = function(place)
        if value is None:
            return None
        # The root stays between a and b, of which a is the newer; c is what was left behind.
        if math.copysign(1.0, value) == math.copysign(1.0, fa):
            c, fc = a, fa
        else:
            c, b, fc, fb = b, a, fb, fa
        a, fa = place, value
        best, least = (a, fa) if abs(fa) < abs(fb) else (b, fb)
        tolerance = _LAST_BITS * max(abs(best), 0.5)
        width = abs(b - a)
        if width <= 2.0 * tolerance or least == 0.0:
            break
        share = _share(a, b, c, fa, fb, fc)
        share = min(max(share, tolerance / width), 1.0 - tolerance / width)
    # From ends that are next to nothing it cannot fall below what rounding leaves.
    return Zero(best, least, width) if abs(least) <= max(_CONTINUOUS * largest, _BELOW) else None


def _share(a: float, b: float, c: float, fa: float, fb: float, fc: float) -> float:
    """Where to look next: by inverse quadratic interpolation if that is safe, else halfway."""
    if c == b or fb in (fa, fc) or fa == fc:
        return 0.5
    xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
    if not (phi**2 < xi and (1.0 - phi) ** 2 < 1.0 - xi):
        return 0.5
    return fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)


def minimum(function: Function, a: float, c: float) -> Zero | float | None:
    """The smallest value of a function between two places, by golden section.

    A place where it is below zero is given as it is, for there the sign changes. None where
    the minimum is clearly above zero, or the function is not defined.
    """
    seen: list[tuple[float, float]] = []

    def at(place: float) -> float:
        value = function(place)
        if value is None:
            raise _UndefinedError
        seen.append((value, place))
        return value

    try:
        return _minimum(at, a, c) or _lowest(seen)
    except _UndefinedError:
        return None


class _UndefinedError(Exception):
    """The function is not defined where it was asked for."""


def _minimum(at: Callable[[float], float], a: float, c: float) -> float | None:
    """Come as near to a minimum as can be; a place where the function is negative, if any."""
    b, d = c - _GOLDEN * (c - a), a + _GOLDEN * (c - a)
    fa, fb, fc, fd = at(a), at(b), at(c), at(d)
    for step in range(_MOST_STEPS):
        for place, value in ((b, fb), (d, fd)):
            if value < -_BELOW:
                return place
        least, most = min(fa, fb, fc, fd), max(fa, fc)
        if step >= _WARM and least > _NO_ZERO * (most - least):
            raise _UndefinedError
        if c - a <= _LAST_BITS * max(abs(a), abs(c), 1.0):
            break
        if fb <= fd:
            c, fc, d, fd = d, fd, b, fb
            b = c - _GOLDEN * (c - a)
            fb = at(b)
        else:
            a, fa, b, fb = b, fb, d, fd
            d = a + _GOLDEN * (c - a)
            fd = at(d)
    return None


def _lowest(seen: list[tuple[float, float]]) -> Zero:
    """The middle of where the function cannot be told from its minimum."""
    value = min(abs(each) for each, _ in seen)
    lowest = [place for each, place in seen if abs(each) <= max(_AS_LOW * value, _NOTHING)]
    first, last = min(lowest), max(lowest)
    return Zero(0.5 * (first + last), value, max(last - first, _LAST_BITS))


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
    """Of all of them; see `flexact.sweeps.evaluate`."""
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
