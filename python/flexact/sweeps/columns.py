# SPDX-License-Identifier: BSD-3-Clause
"""The columns of a table of results, and tables as files: CSV, JSON Lines and Parquet.

A number that a row has not, such as the margin of a row with an error, is NaN, or -1 where it
is whole; it is an empty cell of CSV and null elsewhere. An infinite one, such as the margin of what
no misalignment changes, is `inf` in CSV and in Parquet; JSON has no such number, so that it is null
there, too. Files are written row by row, whole or not at all.
"""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Callable, Iterable, Sequence
from itertools import islice
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple, Protocol

import numpy as np

from ..analysis.result import Result
from ..core.arrays import BoolArray
from ..deck.rendering import ProblemsError
from ..show.writers import TABLES
from ..util.loading import load
from ..util.outputs import OutputError, written_whole
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


#: What stands in a cell. None: nothing is known.
Cell = str | int | float | bool | None
#: Rows of a group of Parquet, which is what is held in memory.
_GROUP = 2**15
_WITHOUT_PARQUET = "Parquet needs the package pyarrow: pip install pyarrow"


def require_table(path: Path) -> None:
    """Raise where a table cannot be written to a file of this name.

    Raises:
        OutputError: Its suffix is none of a table, or the package for it is missing.
    """
    if path.suffix.lower() not in _WRITERS:
        known = ", ".join(TABLES[:-1])
        raise OutputError(f"{path} is no table: its suffix must be {known} or {TABLES[-1]}")
    if path.suffix.lower() == ".parquet":
        _pyarrow()


def write_table(path: Path, columns: Sequence[Column], rows: Iterable[Sequence[Cell]]) -> None:
    """Write a table to a file, of the kind that its suffix says.

    Args:
        path: The file, .csv, .jsonl or .parquet.
        columns: The columns, each of a kind str, int, float or bool.
        rows: A value for each column; taken one by one, so that no more than some thousands
            are held at a time.

    Raises:
        OutputError: It cannot be written, or not as such a file; what was there has not changed.
    """
    require_table(path)
    with written_whole(path) as file:
        _WRITERS[path.suffix.lower()](file, columns, rows)


def _write_csv(file: BinaryIO, columns: Sequence[Column], rows: Iterable[Sequence[Cell]]) -> None:
    text = io.TextIOWrapper(file, encoding="utf-8", newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([column.name for column in columns])
    cells = _cells_of(columns)
    # The shortest decimal that reads back to the same bits is what csv writes of a float.
    writer.writerows([cell(value) for cell, value in zip(cells, row, strict=True)] for row in rows)
    # Whose the file is closes it.
    text.detach()


def _write_jsonl(file: BinaryIO, columns: Sequence[Column], rows: Iterable[Sequence[Cell]]) -> None:
    cells, names = _cells_of(columns), [column.name for column in columns]
    encode = json.JSONEncoder(ensure_ascii=False, allow_nan=False).encode
    for row in rows:
        values = (_finite(cell(value)) for cell, value in zip(cells, row, strict=True))
        line = encode(dict(zip(names, values, strict=True)))
        file.write(f"{line}\n".encode())


def _write_parquet(
    file: BinaryIO, columns: Sequence[Column], rows: Iterable[Sequence[Cell]]
) -> None:
    arrow = _pyarrow()
    types = {str: arrow.string(), int: arrow.int64(), float: arrow.float64(), bool: arrow.bool_()}
    schema = arrow.schema([(column.name, types[column.kind]) for column in columns])
    cells, taken = _cells_of(columns), iter(rows)
    with load("pyarrow.parquet").ParquetWriter(file, schema) as writer:
        while group := list(islice(taken, _GROUP)):
            made = [
                _array(arrow, column, [cell(row[k]) for row in group])
                for k, (column, cell) in enumerate(zip(columns, cells, strict=True))
            ]
            writer.write_table(arrow.Table.from_arrays(made, schema=schema))


def _array(arrow: Any, column: Column, values: list[Cell]) -> Any:
    try:
        return arrow.array(values, {int: arrow.int64(), str: arrow.string()}.get(column.kind))
    except (OverflowError, arrow.ArrowException) as error:
        raise OutputError(f"the column {column.name} cannot be held by Parquet: {error}") from None


_WRITERS: dict[str, Callable[[BinaryIO, Sequence[Column], Iterable[Sequence[Cell]]], None]] = dict(
    zip(TABLES, (_write_csv, _write_jsonl, _write_parquet), strict=True)
)


def _cells_of(columns: Sequence[Column]) -> list[Callable[[Any], Cell]]:
    """For each column what makes a cell of a value: a plain one of its kind, or None."""
    return [_count if c.kind is int and c in COLUMNS else _CELLS[c.kind] for c in columns]


def _count(value: Any) -> Cell:
    """A count of a result: -1 where there is none."""
    return None if value is None or value < 0 else int(value)


def _number(value: Any) -> Cell:
    return None if value is None or math.isnan(value) else float(value)


_CELLS: dict[type, Callable[[Any], Cell]] = {
    str: lambda value: None if value is None else _encodable(str(value)),
    int: lambda value: None if value is None else int(value),
    bool: lambda value: None if value is None else bool(value),
    float: _number,
}


def _finite(value: Cell) -> Cell:
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _encodable(text: str) -> str:
    """Names of files may hold what is no Unicode."""
    return text if text.isascii() else text.encode("utf-8", "backslashreplace").decode("utf-8")


def _pyarrow() -> Any:
    try:
        return load("pyarrow")
    except ImportError:
        raise OutputError(_WITHOUT_PARQUET) from None
