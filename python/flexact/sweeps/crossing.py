# SPDX-License-Identifier: BSD-3-Clause
"""A singular variant between rows of a table, and all of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, overload

import numpy as np

from ..analysis.verdict import Verdict
from ..core.arrays import FloatArray
from ..util.records import Frozen
from .parameters import Row


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
