# SPDX-License-Identifier: BSD-3-Clause
"""A singular variant between rows of a table, and all of them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, overload

import numpy as np

from ..analysis.verdict import Verdict
from ..core.arrays import FloatArray
from ..util.records import Frozen
from .parameters import Row

if TYPE_CHECKING:
    from .table import Table


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
        told = "; ".join(map(_in_short, self.found[:6]))
        more = "; ..." if len(self) > 6 else ""
        return f"<Crossings: {len(self)}{': ' * bool(told)}{told}{more}{self._given_up}>"

    @property
    def _given_up(self) -> str:
        if not self.missed:
            return ""
        first, many = self.missed[0], len(self.missed)
        at = _numbers(first.parameters) or f"between rows {first.rows[0]} and {first.rows[1]}"
        what = f"{many} search{'es' * (many > 1)} given up"
        return f"; {what}, {'first' if many > 1 else 'which'} at {at}: {first.error}"


def _in_short(each: Crossing) -> str:
    at = _numbers(each.parameters)
    at = at or f"{each.share:.6g} from row {each.rows[0]} to {each.rows[1]}"
    return f"{at}: {each.verdict}"


def _numbers(row: Row) -> str:
    return ", ".join(f"{name} {value:.10g}" for name, value in row.items() if _is_float(value))


def _is_float(value: object) -> bool:
    return isinstance(value, float)


#: In place of a parameter: rows are neighbours in the order in which they stand.
ROWS = "rows"

Array = np.ndarray


def lines_of(table: Table, along: str | None, in_order: bool) -> list[tuple[str, list[int]]]:
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


def varying(table: Table) -> list[str]:
    """The parameters of which there are different numbers."""
    numbers = [name for name in table.parameter_names if table[name].dtype.kind in "if"]
    return [name for name in numbers if np.unique(_finite(table[name])).size > 1]


def _finite(column: Array) -> Array:
    there: Array = column[np.isfinite(column)]
    return there


def _keys(column: Array) -> list[object]:
    """Values that can be compared: NaN is like NaN."""
    return [None if value != value else value for value in column.tolist()]


def _lines(table: Table, name: str) -> Iterator[list[int]]:
    """Rows that differ in one parameter alone, by its value; of equal ones the first."""
    others = [_keys(table[other]) for other in table.parameter_names if other != name]
    groups: dict[tuple[object, ...], list[int]] = defaultdict(list)
    for row, key in enumerate(zip(*others, strict=True) if others else [()] * len(table)):
        groups[key].append(row)
    values = table[name]
    for rows in groups.values():
        _, first = np.unique(values[rows], return_index=True)
        yield [rows[k] for k in first.tolist() if np.isfinite(values[rows[k]])]
