# SPDX-License-Identifier: BSD-3-Clause
"""Which rows of a table are wanted, said by an expression such as `over_constrained > 0`.

Names of columns, numbers, `inf`, texts in quotes; `== != < <= > >=`, also in a row as in
`0 < margin < 1e-4`; `in` and `not in`, with a list of values in parentheses or a part of a text;
`and`, `or`, `not` and parentheses. A column alone is true where it is neither empty nor zero.
A comparison with a number that is missing is false. Nothing is evaluated as Python.
"""

from __future__ import annotations

import ast
import math
import operator
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from ..analysis.decomposition import Asked
from ..analysis.result import Result, result_of
from ..analysis.verdict import AnalysisError, Certainty, Verdict
from ..deck.rendering import DeckError, ProblemsError
from ..model.reading import read_bytes
from ..util.decks import FolderError, no_formula
from ..util.errors import BatchError
from ..util.loading import load
from ..util.partial import why
from ..util.text import harmless, in_short
from .columns import COLUMNS, ERROR, Cell, Column, columns_of, error_row, row_of

DECK = Column("deck", str, "the deck, as it was named", "verdict")
_SIZE = (
    Column("rows", int, "rows of D(c)", "verdict"),
    Column("columns", int, "columns of D(c)", "verdict"),
)
SECONDS = Column("seconds", float, "what reading and analysing it took [s]", "verdict")
#: From this number of elements on, Ctrl-C need not wait for the core.
_LONG = 300


@dataclass(frozen=True)
class DeckRow:
    """What came of a deck.

    Attributes:
        values: By the names of the columns, but for that of the deck.
        result: None where there is an error.
        error: Why there is no result, or None.
    """

    values: dict[str, Cell]
    result: Result | None
    error: Exception | None


def deck_columns(want: str) -> tuple[Column, ...]:
    """The columns of a table of decks, for one of `WANTS`."""
    columns = columns_of(want)
    behind = 1 + [column.name for column in columns].index("rank")
    return (DECK, *columns[:behind], *_SIZE, *columns[behind:], ERROR, SECONDS)


def deck_row(raw: bytes, name: str, asked: Asked, want: str) -> DeckRow:
    """Read and analyse a deck, whose errors are its row.

    Args:
        raw: Its text.
        name: What it is called.
        asked: How it is to be analysed.
        want: One of `WANTS`.
    """
    start = time.perf_counter()
    try:
        data = read_bytes(raw, name)
        # Beside a thread this one hears signals.
        hears = _nothing if data.arrays.element_number.size > _LONG else None
        result: Result = result_of(data, asked, name, hears)
        sizes = {"rows": result.rows, "columns": result.columns}
        made = DeckRow({**row_of(result, want), **sizes}, result, None)
    except (DeckError, AnalysisError, MemoryError) as error:
        made = failed_row(error, name, want)
    except Exception as error:
        # One deck over which this program stumbles shall not cost the others.
        made = failed_row(AnalysisError(why(error)), name, want)
    made.values["seconds"] = time.perf_counter() - start
    return made


def failed_row(error: Exception, name: str, want: str, seconds: float = 0.0) -> DeckRow:
    """The row of a deck that has no result."""
    row = error_row(first_error(error, name), want)
    values = {**row, "rows": None, "columns": None, "seconds": seconds}
    return DeckRow(values, None, error)


def first_error(error: Exception, name: str) -> str:
    """The first error of a deck in a line: `file:line:column: message`."""
    place, message = name, str(error)
    if isinstance(error, ProblemsError):
        first = next(item for item in error.diagnostics if item.is_error)
        message = first.message
        if first.line:
            place = f"{name}:{first.line}:{first.column}"
    elif isinstance(error, MemoryError):
        message = "not enough memory"
    elif isinstance(error, FolderError):
        return harmless(no_formula(message))  # which names it
    return harmless(f"{place}: {message}")


def _nothing(_: str, __: float) -> None:
    """Nothing is shown."""


Values = Mapping[str, Any]
Test = Callable[[Values], bool]

_COMPARISONS: dict[type[ast.cmpop], Callable[[Any, Any], bool]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
}
_CHOICES: dict[str, tuple[str, ...]] = {
    "verdict": tuple(str(each.value) for each in Verdict),
    "certainty": tuple(str(each.value) for each in Certainty),
}
#: Longer ones are nobody's, and none that is not longer is too deep.
_MOST = 2000
_HELP = 'such as "over_constrained > 0" or "margin < 20e-6 and \'guide\' in deck"'


class FilterError(BatchError):
    """An expression that does not say which rows are wanted."""


class _Operand(NamedTuple):
    """One side of a comparison: a column or a constant."""

    value: Callable[[Values], Any]
    is_text: bool
    words: str
    """As a message names it."""
    column: str = ""
    constant: Any = None


def filter_of(expression: str, columns: Sequence[Column]) -> Test:
    """What tells of the values of a row, by the names of columns, whether it is wanted.

    Raises:
        FilterError: The expression is none, or names no column.
    """
    try:
        if len(expression) > _MOST:
            raise ValueError
        tree = ast.parse(expression.strip(), mode="eval")
        return _Reader({column.name: column for column in columns}).test(tree.body)
    except (SyntaxError, ValueError, MemoryError, RecursionError):
        raise FilterError(f"--where {in_short(expression)} is no condition, {_HELP}") from None


class _Reader:
    """Makes tests of the nodes of an expression."""

    def __init__(self, columns: Mapping[str, Column]) -> None:
        self._columns = columns

    def test(self, node: ast.expr) -> Test:
        """A condition."""
        if isinstance(node, ast.BoolOp):
            tests = [self.test(each) for each in node.values]
            together = all if isinstance(node.op, ast.And) else any
            return lambda values: together(test(values) for test in tests)
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
            inner = self.test(node.operand)
            return lambda values: not inner(values)
        if isinstance(node, ast.Compare):
            return self._comparisons(node)
        operand = self._operand(node)
        if not operand.column:
            raise FilterError(f"--where: {operand.words} is no condition, {_HELP}")
        return lambda values: not _is_missing(operand.value(values)) and bool(operand.value(values))

    def _comparisons(self, node: ast.Compare) -> Test:
        sides = [node.left, *node.comparators]
        tests = [
            self._membership(left, right, negated=isinstance(sign, ast.NotIn))
            if isinstance(sign, (ast.In, ast.NotIn))
            else self._comparison(left, sign, right)
            for left, sign, right in zip(sides, node.ops, sides[1:], strict=False)
        ]
        return lambda values: all(test(values) for test in tests)

    def _comparison(self, left: ast.expr, sign: ast.cmpop, right: ast.expr) -> Test:
        if type(sign) not in _COMPARISONS:
            raise FilterError("--where: write == or != in place of is")
        compare, one, other = _COMPARISONS[type(sign)], self._operand(left), self._operand(right)
        _require_alike(one, other)
        return lambda values: _compared(compare, one.value(values), other.value(values))

    def _membership(self, left: ast.expr, right: ast.expr, negated: bool) -> Test:
        one = self._operand(left)
        if isinstance(right, (ast.Tuple, ast.List, ast.Set)):
            others = [self._operand(each) for each in right.elts]
            for other in others:
                if other.column:
                    raise FilterError(f"--where: in a list stand values, not {other.words}")
                _require_alike(one, other)
            choice = frozenset(other.constant for other in others)
            return lambda values: (
                not _is_missing(one.value(values)) and (one.value(values) in choice) != negated
            )
        other = self._operand(right)
        if not (one.is_text and other.is_text):
            raise FilterError(
                f"--where: behind in stands a text, or a list of values in parentheses, "
                f"not {other.words}"
            )
        return lambda values: (one.value(values) in other.value(values)) != negated

    def _operand(self, node: ast.expr) -> _Operand:
        if isinstance(node, ast.Name):
            return _constant(math.inf) if node.id == "inf" else self._column(node.id)
        if isinstance(node, ast.Constant) and type(node.value) in (int, float, str):
            return _constant(node.value)
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.UAdd)):
            inner = self._operand(node.operand)
            if not inner.column and not inner.is_text:
                down = isinstance(node.op, ast.USub)
                return _constant(-inner.constant if down else inner.constant)
        words = in_short(ast.unparse(node))
        raise FilterError(f"--where: {words} is neither a column nor a value, {_HELP}")

    def _column(self, name: str) -> _Operand:
        if name not in self._columns:
            raise FilterError(f"--where: there is no column {in_short(name)}{self._hint(name)}")
        is_text = self._columns[name].kind is str
        return _Operand(lambda values: values[name], is_text, f"the column {name}", name)

    def _hint(self, name: str) -> str:
        later = next((each for each in COLUMNS if each.name == name), None)
        if later is not None:
            return f" without --columns {later.least}"
        near = load("difflib").get_close_matches(name, self._columns, 1)
        there = ", ".join(self._columns)
        return f"; did you mean {near[0]}?" if near else f"; there are {there}"


def _constant(value: Any) -> _Operand:
    return _Operand(lambda _: value, isinstance(value, str), repr(value), constant=value)


def _require_alike(one: _Operand, other: _Operand) -> None:
    """Refuse what can never be true: a text beside a number, a verdict that there is not."""
    if one.is_text != other.is_text:
        raise FilterError(
            f"--where: {one.words} is {_kind(one)} and {other.words} is {_kind(other)}"
        )
    for column, constant in ((one, other), (other, one)):
        known = _CHOICES.get(column.column)
        if known and not constant.column and constant.constant not in (*known, ""):
            there = ", ".join(map(repr, known))
            raise FilterError(
                f"--where: there is no {column.column} {constant.words}; there are {there}"
            )


def _kind(operand: _Operand) -> str:
    return "a text" if operand.is_text else "a number"


def _compared(compare: Callable[[Any, Any], bool], one: Any, other: Any) -> bool:
    return not _is_missing(one) and not _is_missing(other) and compare(one, other)


def _is_missing(value: Any) -> bool:
    return value is None or (isinstance(value, float) and math.isnan(value))
