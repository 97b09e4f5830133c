# SPDX-License-Identifier: BSD-3-Clause
"""One line a deck: what stands in the table, how wide it is, and what the command makes of it."""

import csv
from pathlib import Path

import pytest
from reference_decks import ROOT
from small_decks import BROKEN, write

from flexact.apps.cli.main import main
from flexact.apps.cli.terminal import ExitCode, shortened, shortened_middle
from flexact.util.text import columns

INPUT = str(ROOT / "input_decks")


@pytest.fixture(autouse=True)
def piped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("COLUMNS", raising=False)


def table(text: str) -> dict[str, list[str]]:
    """The cells of each deck; names hold no blanks here."""
    rows = [line.split() for line in text.splitlines()]
    return {row[0]: row[1:] for row in rows if row}


def test_each_deck_has_its_line(decks: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Counts by hand: see `small_decks`."""
    assert main(["analyse", str(decks), "--summary"]) == ExitCode.ANALYSED
    found = table(capsys.readouterr().out)
    assert found["deck"] == ["verdict", "under", "over", "freedoms", "margin", "certainty"]
    expected = {"exact": "0 0 0", "under": "1 0 0", "over": "0 1 0", "both": "1 1 0"}
    for name, counts in expected.items():
        verdict, *cells = found[str(decks / f"{name}.dat")]
        assert (verdict, cells[:3]) == (name, counts.split())
        assert cells[-1] == "proven"
    # Two bars in line: a motion and a self-stress in exact alignment only.
    assert found[str(decks / "both.dat")][4:6] == ["exact", "alignment"]
    assert found["4"][0] == "decks:"


def test_a_broken_deck_has_its_first_error(decks: Path, capsys: pytest.CaptureFixture[str]) -> None:
    broken = write(decks / "broken.dat", "% 1\nPLTRUS 1 1 2\nX 1 a\n")
    code = main(["analyse", str(decks), "--summary"])
    out, err = capsys.readouterr()
    assert (code, err) == (ExitCode.DECK_ERROR, "")
    assert table(out)[str(broken)][:3] == ["error", "2:1:", "PLTRUS"]
    assert "1 with errors" in out.splitlines()[-1]
    missing = str(decks / "missing.dat")
    assert main(["analyse", missing, "--summary"]) == ExitCode.DECK_ERROR
    assert table(capsys.readouterr().out)[missing] == ["error", "there", "is", "no", "such", "file"]


@pytest.mark.parametrize("width", [40, 80, 200])
@pytest.mark.parametrize("verb", ["analyse", "check"])
def test_no_line_is_wider_than_the_terminal(
    verb: str, width: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    main([verb, INPUT, "--summary"])
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) > 113
    assert max(map(columns, lines)) <= width
    assert any(line.startswith("113 decks") for line in lines)


def test_a_pipe_gets_whole_names(capsys: pytest.CaptureFixture[str]) -> None:
    main(["analyse", INPUT, "--summary"])
    found = table(capsys.readouterr().out)
    assert all((ROOT / "input_decks" / name).exists() for name in list(found)[1:-1])


def test_what_is_not_as_expected_is_named(decks: Path, capsys: pytest.CaptureFixture[str]) -> None:
    chosen = ["analyse", str(decks), "--summary", "--expect", "exact"]
    assert main(chosen) == ExitCode.DIFFERENT
    named = capsys.readouterr().out.split("4 decks")[1].splitlines()[1:]
    assert named == [f"  not as expected: {decks / name}.dat" for name in ("both", "over", "under")]


def test_an_accuracy_that_the_margin_does_not_keep_is_said(
    decks: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The triangle has a height of 1: a metre of misalignment lets it fall flat."""
    main(["analyse", str(decks / "exact.dat"), "--summary", "--accuracy", "2", "--beyond"])
    assert table(capsys.readouterr().out)[str(decks / "exact.dat")][0] == "marginal"


def test_a_table_has_a_row_a_deck(decks: Path, tmp_path: Path) -> None:
    write(decks / "broken.dat", BROKEN)
    target = tmp_path / "out" / "x.csv"
    chosen = ["analyse", str(decks), str(tmp_path / "none"), "--summary", "-o", str(target)]
    (tmp_path / "none").mkdir()
    assert main(chosen) == ExitCode.DECK_ERROR
    with open(target, encoding="utf-8", newline="") as file:
        rows = {Path(row["deck"]).stem: row for row in csv.DictReader(file)}
    assert list(rows) == ["both", "broken", "exact", "over", "under", "none"]
    over = rows["over"]
    assert (over["verdict"], over["over_constrained"]) == ("over-constrained", "1")
    assert over["degrees_of_freedom"] == "0" and over["certainty"] == "proven"
    assert rows["both"]["margin"] == "0.0"
    assert "PLTRUS is not a keyword" in rows["broken"]["error"] and not rows["broken"]["verdict"]
    assert "no deck" in rows["none"]["error"]


def test_files_are_written_beside_the_table(decks: Path, tmp_path: Path) -> None:
    assert main(["analyse", str(decks), "--summary", "-o", str(tmp_path / "out")]) == 0
    assert len(list((tmp_path / "out").iterdir())) == 12


@pytest.mark.parametrize(
    ("chosen", "reason"),
    [
        (["--summary", "--json"], "--summary is in place of --json"),
        (["--summary", "--log", "spacar"], "--summary is in place of --log"),
        (["-o", "x.csv"], "x.csv is a table, which --summary writes"),
        (["--summary", "-o", "exact.csv"], "exact.csv would overwrite the deck"),
    ],
)
def test_wrong_use_is_refused_in_words(
    chosen: list[str],
    reason: str,
    decks: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(decks)
    Path("exact.dat").rename("exact.csv")
    assert main(["analyse", "exact.csv", *chosen]) not in (0, ExitCode.DIFFERENT)
    assert reason in capsys.readouterr().err
    assert not Path("x.csv").exists()


def test_check_counts_problems(decks: Path, capsys: pytest.CaptureFixture[str]) -> None:
    ten = str(ROOT / "input_decks" / "broken" / "ten_mistakes.dat")
    assert main(["check", ten, str(decks / "exact.dat"), "--summary"]) == ExitCode.DECK_ERROR
    found = table(capsys.readouterr().out)
    assert found[ten][:2] == ["10", "2:1:"]
    assert found[str(decks / "exact.dat")] == ["0", "0", "0"]


def test_names_are_shortened_in_the_middle() -> None:
    assert shortened_middle("abcdefghij", 10) == "abcdefghij"
    assert shortened_middle("abcdefghij", 7).replace("..", "…") in ("ab…ghij", "a…ghij")
    assert columns(shortened_middle("数学数学数学", 7)) <= 7
    assert shortened("abcdefghij", 5).startswith("abc")
