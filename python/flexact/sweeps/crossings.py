# SPDX-License-Identifier: BSD-3-Clause
"""Singular variants between the rows of a table: where to search, and all that is found."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, overload

import numpy as np

from ..analysis.decomposition import Asked
from ..analysis.result import Result, result_of
from ..analysis.verdict import Verdict
from ..core.arrays import FloatArray
from ..util.errors import FlexactError
from ..util.records import Frozen
from ..util.roots import Zero, minimum, sign_change
from .columns import Rows, in_a_line
from .evaluate import Positions, Signed, Source, signed_column, signed_value, variant_of
from .parameters import Row, Value
from .running import results_of

#: With fewer searches than this nobody is sent for.
_FEW = 8
#: Crossings as near to each other as this part of a step are one.
_ONE_PLACE = 1.0e-12
#: How far beside a row that is singular itself the sign counts: a part of the step.
_BESIDE = 2.0**-10
#: A singular value this small is not told from zero, whatever the default says.
_ZERO = 1.0e-10
_ANOTHER = "another mechanism than those of the rows: its coordinates or deformations are others"
#: In place of a parameter: rows are neighbours in the order in which they stand.
ROWS = "rows"


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


class Missed(NamedTuple):
    """A search that was given up, since a variant could not be made or analysed."""

    parameters: Row
    """What should have made it."""
    along: str
    """As of a `Crossing`."""
    rows: tuple[int, int]
    """The rows on both sides, or twice the row that it is."""
    error: str
    """Why not."""


@dataclass(frozen=True, eq=False, repr=False)
class Crossings(Frozen, Sequence[Crossing]):
    """The singular variants of a table, in the order of its rows.

    Attributes:
        found: Each of them.
        evaluations: How many variants were made to find them, and to find that there are no
            others.
        missed: Where a search was given up, so that a crossing may be there that is not found.
    """

    found: tuple[Crossing, ...]
    evaluations: int
    missed: tuple[Missed, ...] = ()

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
        """How many, and the first; and what was given up."""
        told = "; ".join(
            f"{_numbers(e.parameters) or f'{e.share:.6g} from row {e.rows[0]} to {e.rows[1]}'}: "
            f"{e.verdict}"
            for e in self.found[:6]
        )
        more = "; ..." if len(self) > 6 else ""
        given_up = ""
        if self.missed:
            first, many = self.missed[0], len(self.missed)
            at = _numbers(first.parameters) or f"between rows {first.rows[0]} and {first.rows[1]}"
            what = f"{many} search{'es' * (many > 1)} given up"
            given_up = f"; {what}, {'first' if many > 1 else 'which'} at {at}: {first.error}"
        return f"<Crossings: {len(self)}{': ' * bool(told)}{told}{more}{given_up}>"


def _numbers(row: Row) -> str:
    return ", ".join(f"{name} {v:.10g}" for name, v in row.items() if isinstance(v, float))


def lines_of(table: Rows, along: str | None, in_order: bool) -> list[tuple[str, list[int]]]:
    """Lines of neighbours: a name, and the rows in their order.

    Args:
        table: The table.
        along: The parameter that changes along a line, `ROWS`, or None for all.
        in_order: Whether rows are neighbours in their order where no two differ in one parameter
            alone.

    Raises:
        ValueError: there is no such parameter, or no row has a neighbour.
    """
    every = [(ROWS, list(range(len(table))))]
    if along == ROWS:
        return every
    names = varying(table)
    if along is not None and along not in names:
        told = ", ".join(names) if names else "none"
        raise ValueError(
            f"there is no parameter {along!r} whose numbers vary; there are: {told}. Or say "
            f"along={ROWS!r}"
        )
    chosen = names if along is None else [along]
    made = [(name, line) for name in chosen for line in _lines(table, name) if len(line) > 1]
    if made or len(table) < 2:
        return made
    if in_order and along is None:
        return every
    raise ValueError(
        "no two rows differ in one number alone, so that none are neighbours; where parameters "
        f"change together, say along={ROWS!r}"
    )


def varying(table: Rows) -> list[str]:
    """The parameters of which there are different numbers."""
    numbers = [name for name in table.parameter_names if table[name].dtype.kind in "if"]
    return [n for n in numbers if np.unique(table[n][np.isfinite(table[n])]).size > 1]


def _lines(table: Rows, name: str) -> Iterator[list[int]]:
    """Rows that differ in one parameter alone, by its value; of equal ones the first."""
    # Among values that are compared NaN is like NaN.
    others = [
        [None if value != value else value for value in table[other].tolist()]
        for other in table.parameter_names
        if other != name
    ]
    groups: dict[tuple[object, ...], list[int]] = defaultdict(list)
    for row, key in enumerate(zip(*others, strict=True) if others else [()] * len(table)):
        groups[key].append(row)
    values = table[name]
    for rows in groups.values():
        _, first = np.unique(values[rows], return_index=True)
        yield [rows[k] for k in first.tolist() if np.isfinite(values[rows[k]])]


class Search(NamedTuple):
    """Rows between which a zero may be; the first is at 0, the next at 1."""

    along: str
    rows: tuple[int, ...]
    """Two, between which the sign changes, or up to three with a dip at the middle one."""
    rank: int
    """The singular value of this number is followed."""
    values: tuple[float, ...]
    """Of the rows."""
    topology: int
    """Of all of them; see `flexact.sweeps.evaluate`."""
    ends: tuple[float, float] | None = None
    """Between which places the sign changes, `values` are of these then; None of a dip."""

    def between(self, place: float) -> tuple[int, int, float]:
        """The rows round a place, of which the first row's is 0, and the share between them."""
        first = min(max(int(place), 0), len(self.rows) - 2)
        return self.rows[first], self.rows[first + 1], place - first


@dataclass
class Follow:
    """The singular value between rows of a table, and searches along it.

    Attributes:
        table: The table.
        source: How its variants came about.
        calls: How many variants were made.
    """

    table: Rows
    source: Source
    calls: int = 0

    def parameters(self, a: int, b: int, share: float) -> Row:
        """The parameters between those of two rows, as Python's own numbers.

        What is no number is that of the first.
        """
        columns = {name: self.table[name] for name in self.table.parameter_names}
        ends = {n: [c[k : k + 1].tolist()[0] for k in (a, b)] for n, c in columns.items()}
        return {name: _between(first, last, share) for name, (first, last) in ends.items()}

    def of_row(self, row: int) -> Signed | str:
        """The signed smallest singular value of a row, or why there is none."""
        return self.at(row, row, 0.0)

    def at(
        self, a: int, b: int, share: float, rank: int | None = None, topology: int | None = None
    ) -> Signed | str:
        """The signed singular value between two rows of one topology, or why there is none."""
        self.calls += 1
        try:
            data = variant_of(self.source, a, b, share, self.parameters(a, b, share))
            data.require_sound()
            found = signed_value(data, rank)
        except Exception as error:
            return in_a_line(error)
        return found if topology in (None, found.topology) else _ANOTHER

    def __call__(self, search: Search) -> Crossings:
        """What one search finds."""
        errors: list[tuple[float, str]] = []
        before = self.calls

        def value_at(place: float) -> float | None:
            found = self.at(*search.between(place), search.rank, search.topology)
            if isinstance(found, str):
                errors.append((place, found))
                return None
            return found.value

        crossings = []
        zeros = list(_zeros(search, value_at))
        calls = self.calls - before
        for zero, kind in zeros:
            a, b, share = search.between(zero.place)
            row = self.parameters(a, b, share)
            try:
                result = self._singular(
                    variant_of(self.source, a, b, share, row), search, zero, kind
                )
            except FlexactError as error:
                errors.append((zero.place, in_a_line(error)))
                continue
            # An analysis there says so, too.
            if result.rank < search.rank:
                crossings.append(
                    Crossing(
                        *(row, search.along, (a, b), share, zero.width, kind, abs(zero.value)),
                        result.verdict,
                        Verdict(self.table["verdict"][a]),
                        Verdict(self.table["verdict"][b]),
                        calls,
                    )
                )
        missed = tuple(self.missed(search, *each) for each in errors[:1])
        return Crossings(tuple(crossings), calls, missed)

    @staticmethod
    def _singular(data: Any, search: Search, zero: Zero, kind: str) -> Result:
        """The analysis at a zero, of which the last singular value that counts is one."""
        # The numbers there are rounded: to prove something of them says nothing.
        result: Result = result_of(data, Asked(prove=False))
        if result.rank >= search.rank and (kind == "sign change" or abs(zero.value) < _ZERO):
            # A root lies between two neighbouring numbers, at which it is not quite zero.
            last = result.gap.smallest_nonzero or 0.0
            tolerance = max(result.tolerance, 2.0 * abs(zero.value), 2.0 * last)
            result = result_of(data, Asked(prove=False, tolerance=tolerance))
        return result

    def missed(self, search: Search, place: float, error: str) -> Missed:
        """A search that an error at a place has ended."""
        a, b, share = search.between(place)
        return Missed(self.parameters(a, b, share), search.along, (a, b), error)


def _between(a: Value, b: Value, share: float) -> Value:
    if a == b or share == 0.0 or isinstance(a, bool) or isinstance(b, bool):
        return a
    if not (isinstance(a, (int, float)) and isinstance(b, (int, float))):
        return a
    return b if share == 1.0 else float(a + share * (b - a))


def _zeros(search: Search, function: Callable[[float], float | None]) -> Iterator[tuple[Zero, str]]:
    values = search.values
    if search.ends is not None:
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


def crossings_of(
    table: Rows,
    source: Source,
    signed: np.ndarray | None,
    along: str | None,
    workers: int | None,
) -> Crossings:
    """See `Table.crossings`."""
    lines = lines_of(table, along, isinstance(source, Positions))
    made = 0
    missed: list[Missed] = []
    follow = Follow(table, source)
    if signed is None or bool(((signed["topology"] < 0) & ~table.has_error).any()):
        signed, made = _signed_rows(follow, workers, missed), len(table)
    before = follow.calls
    candidates = [
        each
        for name, rows in lines
        for run in _runs(follow, signed, rows)
        for each in _candidates(follow, signed, name, run, missed)
    ]
    made += follow.calls - before
    found = [each for each in candidates if isinstance(each, Crossing)]
    searches = [each for each in candidates if isinstance(each, Search)]
    few = len(searches) < _FEW
    for done in results_of(follow, searches, workers=1 if few else workers):
        if done.result is None:
            missed.append(follow.missed(searches[done.index], 0.5, done.failure))
        else:
            found += done.result.found
            missed += done.result.missed
            made += done.result.evaluations
    order = sorted(found, key=lambda each: (*each.rows, each.share, each.along))
    missed.sort(key=lambda each: (*each.rows, each.along))
    return Crossings(tuple(_once(order)), made, tuple(missed))


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


def _signed_rows(follow: Follow, workers: int | None, missed: list[Missed]) -> np.ndarray:
    table = follow.table
    every: list[Signed | None] = [None] * len(table)
    for done in results_of(follow.of_row, range(len(table)), workers=workers):
        if isinstance(done.result, Signed):
            every[done.index] = done.result
        elif not table["error"][done.index]:
            row = follow.parameters(done.index, done.index, 0.0)
            missed.append(Missed(row, ROWS, (done.index, done.index), done.result or done.failure))
    return signed_column(every)


def _runs(follow: Follow, signed: np.ndarray, rows: Sequence[int]) -> Iterator[list[int]]:
    """Rows of a line in pieces of one topology, without errors."""
    source, topology = follow.source, signed["topology"]

    def goes_on(a: int, b: int) -> bool:
        is_way = not isinstance(source, Positions) or source.goes_between(a, b)
        return is_way and bool(topology[a] == topology[b])

    run: list[int] = []
    for row in rows:
        there = not follow.table["error"][row] and not math.isnan(signed["value"][row])
        if run and not (there and goes_on(run[-1], row)):
            yield run
            run = []
        if there:
            run.append(row)
    if run:
        yield run


def _candidates(
    follow: Follow, signed: np.ndarray, along: str, run: list[int], missed: list[Missed]
) -> Iterator[Crossing | Search]:
    """Of a run of rows those that are singular themselves, and where to search between them."""
    table, topology = follow.table, int(signed["topology"][run[0]])
    ranks = table["rank"][run]
    rank = int(ranks.max())
    is_zero = ranks < rank

    def at(k: int, j: int, share: float) -> float:
        """The value between two rows of the run; NaN, which is told, where there is none."""
        a, b = run[k], run[j]
        found = follow.at(a, b, share, rank, topology)
        if isinstance(found, str):
            missed.append(Missed(follow.parameters(a, b, share), along, (a, b), found))
            return math.nan
        return found.value

    values = signed["value"][run].copy()
    if rank < signed["size"][run[0]]:
        # All are singular alike: what counts is the value that ends the rank.
        values = np.array([at(k, k, 0.0) for k in range(len(run))])
    values[is_zero] = 0.0
    for k in np.flatnonzero(is_zero).tolist():
        if not all(is_zero[max(k - 1, 0) : k + 2]):
            value = float(abs(signed["value"][run[k]]))
            beside = (k, max(k - 1, 0), min(k + 1, len(run) - 1))
            verdicts = [Verdict(table["verdict"][run[j]]) for j in beside]
            yield Crossing(
                follow.parameters(run[k], run[k], 0.0),
                along,
                (run[k], run[k]),
                *(0.0, 0.0, "row", value, verdicts[0], verdicts[1], verdicts[2], 0),
            )
    # Between which rows the sign changes; it has none at a row that is singular itself.
    for k in range(len(run) - 1):
        low, high, one, two = 0.0, 1.0, float(values[k]), float(values[k + 1])
        if is_zero[k] and not is_zero[k + 1]:
            low = _BESIDE
            one = at(k, k + 1, low)
        if is_zero[k + 1] and not is_zero[k]:
            high = 1.0 - _BESIDE
            two = at(k, k + 1, high)
        # Their product may be too small for a number.
        if {*np.sign((one, two)).tolist()} == {-1.0, 1.0}:
            yield Search(along, tuple(run[k : k + 2]), rank, (one, two), topology, (low, high))
    # Rows at which the value is lower than at those beside it.
    size = np.abs(values)
    changes = np.sign(values[:-1]) * np.sign(values[1:]) < 0.0
    for k in range(len(run)):
        first, last = max(k - 1, 0), min(k + 1, len(run) - 1)
        near = slice(first, last + 1)
        is_dip = size[k] <= size[near].min() and first < last
        if is_dip and not is_zero[near].any() and not changes[first:last].any():
            yield Search(along, tuple(run[near]), rank, tuple(values[near].tolist()), topology)
