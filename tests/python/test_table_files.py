# SPDX-License-Identifier: BSD-3-Clause
"""Tables as files: what stands in them reads back to the last bit, whole or not at all."""

import csv
import io
import json
import math
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from flexact.sweeps.columns import COLUMNS, Cell, Column, require_table, write_table
from flexact.util.outputs import OutputError

NAMES = (
    Column("angle", float, "", ""),
    Column("count", int, "", ""),
    Column("name", str, "", ""),
    Column("held", bool, "", ""),
)
RANK = next(column for column in COLUMNS if column.name == "rank")
ROWS: list[tuple[Cell, ...]] = [
    (0.1 + 0.2, -1, 'a "quoted", name\nof two lines', True),
    (math.inf, 2**53 + 1, "", False),
    (math.nan, None, "\u03b1 = 1\u00b0", None),
    (5e-324, -(2**62), "=cmd", True),
]
SUFFIXES = (".csv", ".jsonl", ".parquet")


def read(path: Path) -> list[list[Any]]:
    """What a reader of the format finds, headings first; of CSV as text."""
    if path.suffix == ".csv":
        with open(path, encoding="utf-8", newline="") as file:
            return list(csv.reader(file))
    if path.suffix == ".jsonl":
        records = [json.loads(line) for line in path.read_text("utf-8").split("\n") if line]
        return [list(records[0]), *(list(record.values()) for record in records)]
    table = pytest.importorskip("pyarrow.parquet").read_table(path)
    return [table.column_names, *map(list, zip(*table.to_pydict().values(), strict=True))]


def test_csv_reads_back_to_the_last_bit(tmp_path: Path) -> None:
    write_table(tmp_path / "table.csv", NAMES, ROWS)
    assert read(tmp_path / "table.csv") == [
        ["angle", "count", "name", "held"],
        ["0.30000000000000004", "-1", 'a "quoted", name\nof two lines', "True"],
        ["inf", "9007199254740993", "", "False"],
        ["", "", "\u03b1 = 1\u00b0", ""],
        ["5e-324", "-4611686018427387904", "=cmd", "True"],
    ]


def test_json_lines_have_null_for_what_json_has_no_number_for(tmp_path: Path) -> None:
    write_table(tmp_path / "table.jsonl", NAMES, ROWS)
    found = read(tmp_path / "table.jsonl")
    assert found[1:3] == [list(ROWS[0]), [None, 2**53 + 1, "", False]]
    assert found[3:] == [[None, None, "\u03b1 = 1\u00b0", None], list(ROWS[3])]


def test_parquet_keeps_kinds_and_infinity(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    write_table(tmp_path / "table.parquet", NAMES, ROWS)
    found = read(tmp_path / "table.parquet")
    assert found == [
        ["angle", "count", "name", "held"],
        *([None if v != v else v for v in row] for row in ROWS),
    ]


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_a_count_that_is_not_there_is_missing(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"table{suffix}"
    write_table(path, (RANK, NAMES[1]), [(-1, -1), (0, 0)])
    assert [[str(cell or "") for cell in row] for row in read(path)[1:]] == [
        ["", "-1"],
        ["0", "0"] if suffix == ".csv" else ["", ""],
    ]


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_without_rows_there_is_a_table_all_the_same(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"table{suffix}"
    write_table(path, NAMES, [])
    assert path.exists()
    if suffix != ".jsonl":
        assert read(path) == [["angle", "count", "name", "held"]]


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_rows_that_fail_leave_what_was_there(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"table{suffix}"
    path.write_text("before")

    def failing() -> Iterator[tuple[Cell, ...]]:
        yield ROWS[0]
        raise RuntimeError("no more")

    with pytest.raises(RuntimeError):
        write_table(path, NAMES, failing())
    assert path.read_text() == "before"
    assert os.listdir(tmp_path) == [path.name]


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.posix("linux")
def test_a_full_disk_leaves_what_was_there(
    suffix: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The temporary file is a device that takes nothing."""
    path = tmp_path / f"table{suffix}"
    path.write_text("before")
    monkeypatch.setattr("flexact.util.outputs.new_file", lambda *_: io.FileIO("/dev/full", "wb"))
    with pytest.raises(OutputError, match="no space left"):
        write_table(path, NAMES, ROWS * 20_000)
    assert path.read_text() == "before"
    assert os.listdir(tmp_path) == [path.name]


def test_a_number_that_parquet_cannot_hold_is_said(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    with pytest.raises(OutputError, match="column count"):
        write_table(tmp_path / "table.parquet", NAMES, [(0.0, 2**70, "", True)])
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("name", ["table.txt", "table", "csv"])
def test_other_suffixes_are_refused(name: str) -> None:
    with pytest.raises(OutputError, match=r"\.csv, \.jsonl or \.parquet"):
        require_table(Path(name))


def test_without_pyarrow_the_message_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "pyarrow", None)
    with pytest.raises(OutputError, match="pip install pyarrow"):
        require_table(Path("table.PARQUET"))


def test_names_that_are_no_unicode_are_spelled_out(tmp_path: Path) -> None:
    for suffix in SUFFIXES[:2]:
        write_table(tmp_path / f"table{suffix}", NAMES[2:3], [("\udcff.dat",)])
        assert read(tmp_path / f"table{suffix}")[1] == ["\\udcff.dat"]


def test_parquet_is_written_in_groups(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    monkeypatch.setattr("flexact.sweeps.columns._GROUP", 3)
    write_table(tmp_path / "table.parquet", NAMES[1:2], ([k] for k in range(8)))
    assert parquet.ParquetFile(tmp_path / "table.parquet").num_row_groups == 3
    assert read(tmp_path / "table.parquet")[1:] == [[k] for k in range(8)]
