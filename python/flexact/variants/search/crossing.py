# SPDX-License-Identifier: BSD-3-Clause
"""A singular variant between rows of a table, and all of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, overload

import numpy as np

from ...base.frozen import Frozen
from ...core.arrays import FloatArray
from ...result.verdict import Verdict
from ..sweeps.parameters import Row


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
