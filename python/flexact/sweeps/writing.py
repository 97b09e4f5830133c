# SPDX-License-Identifier: BSD-3-Clause
"""Tables as files, row by row: CSV, JSON Lines and Parquet, whole or not at all.

A number that is missing, None or NaN, is an empty cell of CSV and null elsewhere. An infinite one,
such as the margin of what no misalignment changes, is `inf` in CSV and in Parquet; JSON has no
such number, so that it is null there, too.
"""

from __future__ import annotations

import csv
import json
import math
import textwrap
from collections.abc import Callable, Iterable, Sequence
from html import escape
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, NamedTuple

import numpy as np

from ..analysis.naming import length_in_words
from ..analysis.verdict import Verdict
from ..util.loading import load
from ..util.outputs import OutputError, written_whole
from ..util.text import harmless
from .columns import COLUMNS, Column

if TYPE_CHECKING:
    from .table import Table


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


class _Text(NamedTuple):
    """A file of bytes that takes text."""

    file: BinaryIO

    def write(self, text: str) -> int:
        return self.file.write(text.encode("utf-8"))


def _write_csv(file: BinaryIO, columns: Sequence[Column], rows: Iterable[Sequence[Cell]]) -> None:
    writer = csv.writer(_Text(file), lineterminator="\n")
    writer.writerow([column.name for column in columns])
    cells = _cells_of(columns)
    # The shortest decimal that reads back to the same bits is what csv writes of a float.
    writer.writerows([cell(value) for cell, value in zip(cells, row, strict=True)] for row in rows)


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


_WRITERS: dict[str, Callable[[BinaryIO, Sequence[Column], Iterable[Sequence[Cell]]], None]] = {
    ".csv": _write_csv,
    ".jsonl": _write_jsonl,
    ".parquet": _write_parquet,
}
#: Suffixes of tables.
TABLES = tuple(_WRITERS)


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


_WIDTH = 100
#: Rows of a table in a notebook.
_MOST_ROWS = 10
#: Values of a parameter that are told one by one.
_FEW_VALUES = 4


def in_short(table: Table) -> str:
    """Size and verdicts in a line."""
    told = [f"{count} {words}" for words, count in counts_of(table)]
    return f"{_counted(len(table), 'variant')}{': ' * bool(told)}{', '.join(told)}"


def described(table: Table) -> str:
    """See `Table.describe`."""
    lines = [f"{_counted(len(table), 'variant')}{_of_parameters(table)}."]
    for words, count in counts_of(table):
        lines.append(f"{_capital(words)}: {share_in_words(count, len(table))}.")
    lines += _smallest(table)
    lines += _first_error(table)
    return "\n".join(
        textwrap.fill(harmless(line), _WIDTH, subsequent_indent="  ", break_long_words=False)
        for line in lines
    )


def counts_of(table: Table) -> list[tuple[str, int]]:
    """Each verdict that there is, what is doubtful, and errors, with how many rows have it."""
    every = [(each.value, int((table.verdict == each.value).sum())) for each in Verdict]
    every += [("doubtful, of these", int(table.is_doubtful.sum()))]
    every += [("with an error", int(table.has_error.sum()))]
    return [each for each in every if each[1]]


def row_in_words(table: Table, row: int) -> str:
    """A row by its number, and by its parameters."""
    values = (f"{name} {_value(table[row][name])}" for name in table.parameter_names)
    told = ", ".join(values)
    return f"variant {row}{': ' * bool(told)}{told}"


def html_of(table: Table) -> str:
    """The words, and the first rows."""
    heads = "".join(f"<th>{escape(harmless(name))}</th>" for name in table.columns)
    rows = "".join(_row(table[k]) for k in range(min(len(table), _MOST_ROWS)))
    left = len(table) - _MOST_ROWS
    more = f"<p>and {_counted(left, 'further row')}</p>" if left > 0 else ""
    return (
        f"<div><pre>{escape(described(table))}</pre><table><thead><tr>{heads}</tr></thead>"
        f"<tbody>{rows}</tbody></table>{more}</div>"
    )


def _row(row: dict[str, Any]) -> str:
    cells = (f"<td>{escape(harmless(_value(value)))}</td>" for value in row.values())
    return f"<tr>{''.join(cells)}</tr>"


def _of_parameters(table: Table) -> str:
    told = [f"{name} ({_values(table[name])})" for name in table.parameter_names]
    return f" of {', '.join(told)}" if told else ""


def _values(column: np.ndarray) -> str:
    every = list(dict.fromkeys(column.tolist()))
    if len(every) <= _FEW_VALUES:
        return ", ".join(map(_value, every))
    if column.dtype.kind in "if":
        ends = (_value(end(column).item()) for end in (np.nanmin, np.nanmax))
        return f"{len(every)} values from {' to '.join(ends)}"
    return f"{len(every)} values"


def _value(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def share_in_words(count: int, total: int) -> str:
    """A count, and how many per cent that is."""
    return f"{count} ({per_cent(count / total)} %)"


def per_cent(part: float) -> str:
    """A part in per cent; what is short of a hundred stays so."""
    shown, left = 100.0 * part, 100.0 * (1.0 - part)
    if not 0.0 < left < 1.0:
        return f"{shown:.3g}"
    return f"{shown:.{max(1, math.ceil(-math.log10(left) - 1e-6))}f}"


def _smallest(table: Table) -> list[str]:
    """Where margin and gap are smallest."""
    made = []
    for name, words in (("margin", "margin"), ("gap", "singular value that counts (scaled)")):
        if name not in table.columns:
            continue
        values = table[name]
        there = np.flatnonzero(np.isfinite(values))
        if there.size:
            row = int(there[np.argmin(values[there])])
            size = float(values[row])
            told = length_in_words(size) if name == "margin" else f"{size:.3g}"
            if name == "margin" and size == 0.0:
                told = "none, in exact alignment only"
            made.append(f"Smallest {words}: {told}, at {row_in_words(table, row)}.")
    return made


def _first_error(table: Table) -> list[str]:
    rows = np.flatnonzero(table.has_error)
    if not rows.size:
        return []
    first = int(rows[0])
    return [f"First error, {row_in_words(table, first)}: {table.error[first]}"]


def _counted(count: int, what: str) -> str:
    return f"{count} {what}{'s' * (count != 1)}"


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]
