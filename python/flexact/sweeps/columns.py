# SPDX-License-Identifier: BSD-3-Clause
"""The columns of a table of results: what each says, and when it is there.

A number that a row has not, such as the margin of a row with an error, is NaN, or -1 where it
is whole.
"""

from __future__ import annotations

import math
from typing import NamedTuple, Protocol

import numpy as np

from ..analysis.result import Result
from ..core.arrays import BoolArray
from ..deck.rendering import ProblemsError
from ..util.text import harmless

#: How much is to be known of each variant, from little to all.
WANTS = ("verdict", "values", "all")


class Column(NamedTuple):
    """One column."""

    name: str
    kind: type
    """str, int or float."""
    about: str
    """What it says, with its unit."""
    least: str
    """From which of `WANTS` on it is there."""


class Rows(Protocol):
    """A table, a row a variant, as those see it who search in it or draw it."""

    @property
    def columns(self) -> tuple[str, ...]:
        """The names of all columns."""

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """Which of them are parameters."""

    @property
    def is_doubtful(self) -> BoolArray:
        """(variants,) whether the rank is in doubt."""

    @property
    def has_error(self) -> BoolArray:
        """(variants,) whether there is no result."""

    def __len__(self) -> int:
        """Number of variants."""

    def __getitem__(self, name: str, /) -> np.ndarray:
        """(variants,) a column by its name."""


COLUMNS = (
    Column("verdict", str, "verdict; empty where there is an error", "verdict"),
    Column("under_constrained", int, "number of motions that nothing determines", "verdict"),
    Column("over_constrained", int, "number of self-stresses", "verdict"),
    Column("rank", int, "rank of D(c)", "verdict"),
    Column("certainty", str, "whether rounding or digits leave a doubt", "verdict"),
    Column("gap", float, "smallest singular value of the scaled D(c) that is not zero", "values"),
    Column("largest_zero", float, "largest that counts as zero, likewise", "values"),
    Column("smallest_singular_value", float, "smallest singular value of D(c) itself", "values"),
    Column("condition_number", float, "largest over smallest of them", "values"),
    Column(
        "margin",
        float,
        "smallest move of a node that changes the verdict [m]; infinite where none does",
        "values",
    ),
    Column(
        "margin_angle",
        float,
        "smallest turn of an element that changes it [rad]; infinite where none does",
        "values",
    ),
)
ERROR = Column("error", str, "why there is no result; empty where there is one", "verdict")


def columns_of(want: str) -> tuple[Column, ...]:
    """The columns that are there for one of `WANTS`, without that of errors.

    Raises:
        TypeError: it is no text.
        ValueError: it is none of them.
    """
    if not isinstance(want, str):
        raise TypeError(f"want must be a word, not {type(want).__name__}")
    if want not in WANTS:
        raise ValueError(f"want must be one of {', '.join(WANTS)}, not {want!r}")
    return _COLUMNS_OF[want]


_COLUMNS_OF = {
    want: tuple(c for c in COLUMNS if WANTS.index(c.least) <= k) for k, want in enumerate(WANTS)
}


Value = str | int | float
#: What stands where there is no result.
MISSING: dict[type, Value] = {str: "", int: -1, float: math.nan}
#: Letters of the message of an error.
_LONGEST = 400


def row_of(result: Result, want: str = "values") -> dict[str, Value]:
    """The columns of one result by name, for one of `WANTS`; the error is empty."""
    made: dict[str, Value] = {
        "verdict": str(result.verdict),
        "under_constrained": int(result.under_constrained),
        "over_constrained": int(result.over_constrained),
        "rank": int(result.rank),
        "certainty": str(result.certainty),
    }
    if columns_of(want) != columns_of("verdict"):
        gap, margin, values = result.gap, result.margin, result.singular_values
        numbers = {
            "gap": gap.smallest_nonzero,
            "largest_zero": gap.largest_zero,
            "smallest_singular_value": float(values[-1]) if values.size else None,
            "condition_number": result.condition_number,
            "margin": math.inf if margin.length is None else margin.length,
            "margin_angle": math.inf if margin.angle is None else margin.angle,
        }
        made |= {name: math.nan if each is None else each for name, each in numbers.items()}
    return made | {"error": ""}


def in_a_line(error: BaseException) -> str:
    """Kind and message of an exception on one line; of a wrong model or deck the first error."""
    words = str(error)
    if isinstance(error, ProblemsError):
        first = next((each for each in error.diagnostics if each.is_error), None)
        if first is not None:
            words = f"line {first.line}: {first.message}" if first.line else first.message
    words = harmless(" ".join(words.split()))
    if len(words) > _LONGEST:
        words = f"{words[: _LONGEST - 3]}..."
    return f"{type(error).__name__}: {words}" if words else type(error).__name__


def error_row(error: str, want: str = "values") -> dict[str, Value]:
    """The columns where there is no result but an error."""
    return {c.name: MISSING[c.kind] for c in columns_of(want)} | {"error": error}
