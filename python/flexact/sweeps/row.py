# SPDX-License-Identifier: BSD-3-Clause
"""What a table says of one result."""

from __future__ import annotations

import math

from ..analysis.result import Result
from ..deck.diagnostics import Diagnostic
from ..deck.errors import ProblemsError
from ..util.plain_text import harmless
from .columns import Column, columns_of

Value = str | int | float
#: What stands where there is no result.
MISSING: dict[type, Value] = {str: "", int: -1, float: math.nan}
#: Letters of the message of an error.
_LONGEST = 400


def row_of(result: Result, want: str = "values") -> dict[str, Value]:
    """The columns of one result by name, for one of `WANTS`; the error is empty."""
    return {c.name: _value(result, c) for c in columns_of(want)} | {"error": ""}


def in_a_line(error: BaseException) -> str:
    """Kind and message of an exception on one line; of a wrong model or deck the first error."""
    words = str(error)
    if isinstance(error, ProblemsError):
        first = next((each for each in error.diagnostics if each.is_error), None)
        words = words if first is None else _placed(first)
    words = harmless(" ".join(words.split()))
    if len(words) > _LONGEST:
        words = f"{words[: _LONGEST - 3]}..."
    return f"{type(error).__name__}: {words}" if words else type(error).__name__


def _placed(first: Diagnostic) -> str:
    return f"line {first.line}: {first.message}" if first.line else first.message


def error_row(error: str, want: str = "values") -> dict[str, Value]:
    """The columns where there is no result but an error."""
    return {c.name: MISSING[c.kind] for c in columns_of(want)} | {"error": error}


def _value(result: Result, column: Column) -> Value:
    if column.name in ("gap", "largest_zero"):
        found = result.gap.smallest_nonzero if column.name == "gap" else result.gap.largest_zero
        return math.nan if found is None else found
    if column.name == "smallest_singular_value":
        return float(result.singular_values[-1]) if result.singular_values.size else math.nan
    if column.name == "condition_number":
        return math.nan if result.condition_number is None else result.condition_number
    if column.name in ("margin", "margin_angle"):
        size = result.margin.length if column.name == "margin" else result.margin.angle
        return math.inf if size is None else size
    made: Value = column.kind(getattr(result, column.name))
    return made
