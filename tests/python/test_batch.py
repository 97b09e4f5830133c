# SPDX-License-Identifier: BSD-3-Clause
"""``flexact batch``: what stands in the table, the files and the pages."""

import csv
import json
import math
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from small_decks import BROKEN, DECKS, VERDICTS, files_in, write
from test_cli_process import process_environment

import flexact
from flexact.apps.cli.batch import BatchBar
from flexact.apps.cli.main import main
from flexact.sweeps.batch import deck_row
from flexact.sweeps.columns import row_of
from flexact.util.partial import STRICT

pytestmark = pytest.mark.dear(16)

COLUMNS = (
    *("deck", "verdict", "under_constrained", "over_constrained", "rank", "rows", "columns"),
    *("certainty", "gap", "largest_zero", "smallest_singular_value", "condition_number"),
    *("margin", "margin_angle", "error", "seconds"),
)


def rows_of(path: Path) -> list[dict[str, str]]:
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def cell(value: Any) -> str:
    """How a number stands in CSV: in full, or not at all."""
    missing = value == -1 or (isinstance(value, float) and math.isnan(value))
    return "" if missing else str(value)


def test_rows_are_what_analyse_finds(decks: Path, tmp_path: Path) -> None:
    table = tmp_path / "table.csv"
    assert main(["batch", str(decks), "-o", str(table)]) == 0
    rows = rows_of(table)
    assert tuple(rows[0]) == COLUMNS
    assert [row["deck"] for row in rows] == [str(decks / f"{name}.dat") for name in sorted(DECKS)]
    for row in rows:
        result = flexact.analyse(row["deck"])
        found = {"deck": row["deck"], "rows": result.rows, "columns": result.columns}
        expected = {name: cell(value) for name, value in (row_of(result) | found).items()}
        assert float(row.pop("seconds")) > 0.0
        assert row == expected
        assert row["verdict"] == VERDICTS[Path(row["deck"]).stem]
    assert {rows[k]["margin"] for k in range(4)} >= {"inf", "0.0"}
    assert files_in(tmp_path) == [*(f"decks/{name}.dat" for name in sorted(DECKS)), "table.csv"]


def test_all_formats_say_the_same(decks: Path, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    write(decks / "broken.dat", BROKEN)
    for suffix in ("csv", "jsonl", "parquet"):
        assert main(["batch", str(decks), "-o", str(tmp_path / f"t.{suffix}"), "-j1"]) == 0
    lines = (tmp_path / "t.jsonl").read_text("utf-8").splitlines()
    records = [json.loads(line) for line in lines]
    groups = parquet.read_table(tmp_path / "t.parquet").to_pylist()
    for row, record, group in zip(rows_of(tmp_path / "t.csv"), records, groups, strict=True):
        assert list(row) == list(record) == list(group) == list(COLUMNS)
        for name in COLUMNS[:-1]:
            assert row[name] == ("" if group[name] is None else str(group[name]))
            assert record[name] == (None if group[name] == math.inf else group[name])


def test_a_bad_deck_is_a_row_with_its_first_error(decks: Path, tmp_path: Path) -> None:
    broken = write(decks / "a_broken.dat", "% a comment\n" + BROKEN + "X 3 nonsense\n")
    missing, table = tmp_path / "missing.dat", tmp_path / "table.csv"
    assert main(["batch", str(missing), str(decks), "-o", str(table)]) == 0
    first, second, *rest = rows_of(table)
    assert first["error"] == f"{missing}: there is no such file"
    assert second["error"].startswith(f"{broken}:2:1: PLTRUS")
    for row in (first, second):
        assert all(row[name] == "" for name in COLUMNS[1:-2])
    assert [row["error"] for row in rest] == [""] * 4


def test_a_stumble_of_the_program_costs_one_row(
    decks: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stumble(raw: bytes, name: str) -> Any:
        if "over" in name:
            raise KeyError("surprise")
        return read(raw, name)

    from flexact.sweeps import batch as deck_rows

    read = deck_rows.read_bytes
    monkeypatch.setattr(deck_rows, "read_bytes", stumble)
    monkeypatch.delenv(STRICT)
    assert main(["batch", str(decks), "-o", str(tmp_path / "t.csv")]) == 0
    errors = [row["error"] for row in rows_of(tmp_path / "t.csv")]
    assert [not each for each in errors] == [True, True, False, True]
    assert errors[2].startswith(f"{decks}/over.dat: ") and "KeyError: 'surprise'" in errors[2]


@pytest.mark.posix
def test_a_deck_that_kills_its_worker_costs_one_row(
    decks: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def die(raw: bytes, name: str, *asked: Any) -> Any:
        if "over" in name:
            os.kill(os.getpid(), signal.SIGKILL)
        return deck_row(raw, name, *asked)

    monkeypatch.setattr("flexact.apps.cli.batch.deck_row", die)
    assert main(["batch", str(decks), "-o", str(tmp_path / "t.csv"), "-j2"]) == 0
    errors = [row["error"] for row in rows_of(tmp_path / "t.csv")]
    assert [bool(error) for error in errors] == [False, False, True, False]
    assert "died" in errors[2]


def test_folders_without_decks_exit_with_2(decks: Path, tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    arguments = ["batch", str(tmp_path / "empty"), str(decks), "-o", str(tmp_path / "t.csv")]
    assert main(arguments) == 1
    rows = rows_of(tmp_path / "t.csv")
    assert len(rows) == 5 and rows[0]["error"].startswith(f"{tmp_path / 'empty'}: no deck")


@pytest.mark.posix
def test_each_deck_once_in_the_order_of_the_input(
    decks: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("exact.dat", "line\nbreak.dat", 'a,"quoted".dat', "b\u00fccher.dat"):
        write(tmp_path / "other" / name, DECKS["exact"])
    (tmp_path / "other" / "link.dat").symlink_to("exact.dat")
    arguments = ["other/link.dat", "decks", "other", "decks", "./decks/exact.dat", "other/../decks"]
    assert main(["batch", *arguments, "-o", "t.csv", "-j1"]) == 0
    assert [row["deck"] for row in rows_of(tmp_path / "t.csv")] == [
        *("other/link.dat", "decks/both.dat", "decks/exact.dat", "decks/over.dat"),
        *("decks/under.dat", 'other/a,"quoted".dat', "other/b\u00fccher.dat"),
        *("other/exact.dat", "other/line\nbreak.dat"),
    ]


@pytest.mark.posix
def test_names_that_are_no_unicode_are_spelled_out(tmp_path: Path) -> None:
    folder = tmp_path / "decks"
    folder.mkdir()
    try:
        (folder / os.fsdecode(b"\xff.dat")).write_text(DECKS["over"])
    except OSError:
        pytest.skip("this file system takes Unicode alone")
    for name in ("t.csv", "t.jsonl", *(["t.parquet"] if has_pyarrow() else [])):
        assert main(["batch", str(folder), "-o", str(tmp_path / name)]) == 0
    assert rows_of(tmp_path / "t.csv")[0]["deck"] == f"{folder}/\\udcff.dat"


def has_pyarrow() -> bool:
    try:
        import pyarrow  # noqa: F401
    except ImportError:
        return False
    return True


def test_less_is_wanted(decks: Path, tmp_path: Path) -> None:
    table = tmp_path / "t.csv"
    assert main(["batch", str(decks), "-o", str(table), "--columns", "verdict"]) == 0
    assert tuple(rows_of(table)[0]) == (*COLUMNS[:8], "error", "seconds")


def test_how_decks_are_analysed_is_as_asked(decks: Path, tmp_path: Path) -> None:
    """A tolerance that is larger than every singular value leaves no rank."""
    arguments = ["--tolerance", "5", "--method", "jacobi", "--no-prove", "--accuracy", "1e-3"]
    assert main(["batch", str(decks), "-o", str(tmp_path / "t.csv"), *arguments]) == 0
    assert {row["rank"] for row in rows_of(tmp_path / "t.csv")} == {"0"}


@pytest.mark.parametrize("workers", ["-j1", "-j2"])
def test_a_condition_is_for_rows_files_and_pages(
    workers: str, decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(decks / "broken.dat", BROKEN)
    where = "over_constrained > 0 and 'o' in deck"
    arguments = ["--where", where, "--files", str(tmp_path / "f"), "--report", str(tmp_path / "r")]
    assert main(["batch", str(decks), "-o", str(tmp_path / "t.csv"), *arguments, workers]) == 0
    assert [Path(row["deck"]).stem for row in rows_of(tmp_path / "t.csv")] == ["both", "over"]
    assert files_in(tmp_path / "f") == [
        f"{name}.{kind}" for name in ("both", "over") for kind in ("json", "log", "vtu")
    ]
    assert files_in(tmp_path / "r") == ["both.html", "index.html", "over.html"]
    assert capsys.readouterr().out.startswith("5 decks: ")


def test_files_are_those_of_analyse(decks: Path, tmp_path: Path) -> None:
    assert main(["analyse", str(decks), "-o", str(tmp_path / "one"), "--mesh", "vtk"]) == 0
    arguments = ["--files", str(tmp_path / "two"), "--mesh", "vtk"]
    assert main(["batch", str(decks), "-o", str(tmp_path / "t.csv"), *arguments]) == 0
    assert files_in(tmp_path / "one") == files_in(tmp_path / "two")
    for name in files_in(tmp_path / "one"):
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()


@pytest.mark.posix
def test_pages_are_those_of_report(decks: Path, tmp_path: Path) -> None:
    write(decks / "sub" / "broken.dat", BROKEN)
    (decks / "unread.dat").symlink_to("nowhere")
    assert main(["report", str(decks), "-o", str(tmp_path / "one")]) == 1
    arguments = ["-o", str(tmp_path / "t.csv"), "--report", str(tmp_path / "two")]
    assert main(["batch", str(decks), *arguments]) == 0
    assert files_in(tmp_path / "one") == files_in(tmp_path / "two")
    for name in files_in(tmp_path / "one"):
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["-o", "table.txt"], ".csv, .jsonl or .parquet"),
        (["-o", "decks/exact.csv"], "would overwrite the deck decks/exact.csv"),
        (["-o", "decks/exact.dat/t.csv"], "is not a folder"),
        (["-o", "folder.csv"], "it is a folder"),
        (["-o", "t.csv", "--where", "over_constraind > 0"], "did you mean over_constrained"),
        (["-o", "t.csv", "--columns", "verdict", "--where", "margin > 0"], "--columns values"),
        (["-o", "t.csv", "--mesh", "vtk"], "--files DIR"),
        (["-o", "t.csv", "--files", "f", "--mesh", "nonsense"], "nonsense"),
        (["-o", "t.csv", "-j", "0"], "a whole number from 1"),
        (["-o", "t.csv", "--dask", "nowhere"], "tcp://host:port"),
    ],
)
def test_wrong_use_is_refused_before_anything_is_done(
    arguments: list[str],
    said: str,
    decks: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    write(decks / "exact.csv", DECKS["exact"])
    (tmp_path / "folder.csv").mkdir()
    before = files_in(tmp_path)
    assert main(["batch", "decks/exact.csv", "decks", *arguments]) == 2
    assert said in capsys.readouterr().err
    assert files_in(tmp_path) == before


def test_decks_that_would_share_files_are_refused(decks: Path, tmp_path: Path) -> None:
    write(tmp_path / "other" / "exact.dat", DECKS["exact"])
    both = ["batch", str(decks), str(tmp_path / "other"), "-o", str(tmp_path / "t.csv")]
    assert main([*both, "--files", str(tmp_path / "f")]) == 2
    assert main(both) == 0


@pytest.mark.posix
def test_a_table_that_is_there_is_replaced(decks: Path, tmp_path: Path) -> None:
    """As by every verb; a link stays one."""
    table = write(tmp_path / "real.csv", "before")
    (tmp_path / "t.csv").symlink_to(table)
    assert main(["batch", str(decks), "-o", str(tmp_path / "t.csv")]) == 0
    assert (tmp_path / "t.csv").is_symlink() and len(rows_of(table)) == 4


@pytest.mark.posix
def test_a_terminal_shows_how_far_it_is(decks: Path, tmp_path: Path) -> None:
    try:
        reader, terminal = os.openpty()
    except OSError:
        pytest.skip("this system hands out no pseudo-terminals")
    write(decks / "broken.dat", BROKEN)
    try:
        done = subprocess.run(
            [sys.executable, "-m", "flexact", "batch", decks, "-o", tmp_path / "t.csv", "-j1"],
            stdout=subprocess.PIPE,
            stderr=terminal,
            env=process_environment(),
            check=True,
        )
        seen = os.read(reader, 65536).decode()
    finally:
        os.close(terminal)
        os.close(reader)
    assert "0 of 5 decks" in seen and "left" in seen
    assert done.stdout.startswith(b"5 decks: ")


def test_a_log_has_a_line_now_and_then(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("flexact.apps.cli.batch._LINE", 0.0)
    with BatchBar(total=50, before=40) as bar:
        bar.count(has_error=False)
        bar.count(has_error=True)
    lines = capsys.readouterr().err.splitlines()
    assert [line.split(",")[0] for line in lines] == ["41 of 50 decks", "42 of 50 decks"]
    assert all("decks/s" in line and line.endswith("left") for line in lines)


@pytest.mark.posix
def test_no_cell_is_what_a_spreadsheet_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    names = ["=cmd|'calc'!A1.dat", "@bad.dat", "+1.dat", "\t=1.dat"]
    for name in names:
        Path(name).write_text("BEAN 1\n" if "bad" in name else "TRUSS 1 1 2\nX 2 1 0 0\n")
    Path("=folder").mkdir()
    main(["batch", ".", *names, "=folder", "-o", "table.csv", "-j1"])
    with open("table.csv", newline="") as file:
        rows = list(csv.reader(file))
    assert len(rows) == 6
    assert not [cell for row in rows for cell in row if cell[:1] in ("=", "@", "+", "\t", "\r")]
    assert {row[0] for row in rows[1:]} == {f"./{name}" for name in (*names, "=folder")}
    assert Path(rows[1][0]).exists()
