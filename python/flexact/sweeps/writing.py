# SPDX-License-Identifier: BSD-3-Clause
"""Tables as files, row by row: CSV, JSON Lines and Parquet, whole or not at all.

A number that is missing, None or NaN, is an empty cell of CSV and null elsewhere. An infinite one,
such as the margin of what no misalignment changes, is `inf` in CSV and in Parquet; JSON has no
such number, so that it is null there, too.
"""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Callable, Iterable, Sequence
from itertools import islice
from pathlib import Path
from typing import Any, BinaryIO

from ..show.writers import TABLES
from ..util.loading import load
from ..util.outputs import OutputError, written_whole
from .columns import COLUMNS, Column

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
