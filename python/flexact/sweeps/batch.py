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
from typing import Any, cast

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
    return DeckRow({**row, "rows": None, "columns": None, "seconds": seconds}, None, error)


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


#: One side of a comparison: a column or a constant.
_Operand = Column | float | str


def filter_of(expression: str, columns: Sequence[Column]) -> Test:
    """What tells of the values of a row, by the names of columns, whether it is wanted.

    Raises:
        BatchError: The expression is none, or names no column.
    """
    try:
        if len(expression) > _MOST:
            raise ValueError
        tree = ast.parse(expression.strip(), mode="eval")
        return _test(tree.body, {column.name: column for column in columns})
    except (SyntaxError, ValueError, MemoryError, RecursionError):
        raise BatchError(f"--where {in_short(expression)} is no condition, {_HELP}") from None


def _test(node: ast.expr, columns: Mapping[str, Column]) -> Test:
    """A condition."""
    if isinstance(node, ast.BoolOp):
        tests = [_test(each, columns) for each in node.values]
        together = all if isinstance(node.op, ast.And) else any
        return lambda values: together(test(values) for test in tests)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        inner = _test(node.operand, columns)
        return lambda values: not inner(values)
    if isinstance(node, ast.Compare):
        sides = [node.left, *node.comparators]
        links = zip(sides, node.ops, sides[1:], strict=False)
        tests = [_comparison(*link, columns) for link in links]
        return lambda values: all(test(values) for test in tests)
    operand = _operand(node, columns)
    if not isinstance(operand, Column):
        raise BatchError(f"--where: {_words(operand)} is no condition, {_HELP}")
    name = operand.name
    return lambda values: not _is_missing(values[name]) and bool(values[name])


def _comparison(
    left: ast.expr, sign: ast.cmpop, right: ast.expr, columns: Mapping[str, Column]
) -> Test:
    is_in, negated = isinstance(sign, (ast.In, ast.NotIn)), isinstance(sign, ast.NotIn)
    if not is_in and type(sign) not in _COMPARISONS:
        raise BatchError("--where: write == or != in place of is")
    one = _operand(left, columns)
    if is_in and isinstance(right, (ast.Tuple, ast.List, ast.Set)):
        others = [_operand(each, columns) for each in right.elts]
        for other in others:
            if isinstance(other, Column):
                raise BatchError(f"--where: in a list stand values, not {_words(other)}")
            _require_alike(one, other)
        choice = frozenset(others)
        return lambda values: (
            not _is_missing(_value(one, values)) and (_value(one, values) in choice) != negated
        )
    other = _operand(right, columns)
    if is_in:
        if not (_is_text(one) and _is_text(other)):
            raise BatchError(
                f"--where: behind in stands a text, or a list of values in parentheses, "
                f"not {_words(other)}"
            )
        return lambda values: (_value(one, values) in _value(other, values)) != negated
    _require_alike(one, other)
    compare = _COMPARISONS[type(sign)]

    def test(values: Values) -> bool:
        both = _value(one, values), _value(other, values)
        return not any(map(_is_missing, both)) and compare(*both)

    return test


def _operand(node: ast.expr, columns: Mapping[str, Column]) -> _Operand:
    if isinstance(node, ast.Name):
        return math.inf if node.id == "inf" else _column(node.id, columns)
    if isinstance(node, ast.Constant) and type(node.value) in (int, float, str):
        return cast(_Operand, node.value)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.UAdd)):
        inner = _operand(node.operand, columns)
        if not isinstance(inner, (Column, str)):
            return -inner if isinstance(node.op, ast.USub) else inner
    words = in_short(ast.unparse(node))
    raise BatchError(f"--where: {words} is neither a column nor a value, {_HELP}")


def _column(name: str, columns: Mapping[str, Column]) -> Column:
    if name in columns:
        return columns[name]
    later = next((each for each in COLUMNS if each.name == name), None)
    near = load("difflib").get_close_matches(name, columns, 1)
    hint = f"; did you mean {near[0]}?" if near else f"; there are {', '.join(columns)}"
    if later is not None:
        hint = f" without --columns {later.least}"
    raise BatchError(f"--where: there is no column {in_short(name)}{hint}")


def _words(operand: _Operand) -> str:
    return f"the column {operand.name}" if isinstance(operand, Column) else repr(operand)


def _is_text(operand: _Operand) -> bool:
    return operand.kind is str if isinstance(operand, Column) else isinstance(operand, str)


def _value(operand: _Operand, values: Values) -> Any:
    return values[operand.name] if isinstance(operand, Column) else operand


def _require_alike(one: _Operand, other: _Operand) -> None:
    """Refuse what can never be true: a text beside a number, a verdict that there is not."""
    if _is_text(one) != _is_text(other):
        told = (
            f"{_words(each)} is {'a text' if _is_text(each) else 'a number'}"
            for each in (one, other)
        )
        raise BatchError(f"--where: {' and '.join(told)}")
    for column, constant in ((one, other), (other, one)):
        if not isinstance(column, Column) or isinstance(constant, Column):
            continue
        known = _CHOICES.get(column.name)
        if known and constant not in (*known, ""):
            there = ", ".join(map(repr, known))
            raise BatchError(
                f"--where: there is no {column.name} {_words(constant)}; there are {there}"
            )


def _is_missing(value: Any) -> bool:
    return value is None or (isinstance(value, float) and math.isnan(value))
