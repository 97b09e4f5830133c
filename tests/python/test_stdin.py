# SPDX-License-Identifier: BSD-3-Clause
"""Decks that come by standard input, and texts that go to standard output."""

from __future__ import annotations

import io
import json
import subprocess
import sys
from pathlib import Path

import pytest
from small_decks import BROKEN, DECKS, VERDICTS, files_in, json_lines, write

from flexact.apps.cli.main import main

ROOT = Path(__file__).parents[2]
SIX = ROOT / "input_decks/paper/six_folded_sheets.dat"
BAR = ROOT / "input_decks/linkages/four_bar_planar.dat"
NOTCH = ROOT / "input_decks/flexures/notch_guide.dat"


def give(monkeypatch: pytest.MonkeyPatch, text: str | bytes) -> None:
    raw = text.encode() if isinstance(text, str) else text
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(raw)))


@pytest.mark.parametrize("name", DECKS)
def test_a_deck_on_stdin_has_the_verdict_of_its_file(
    name: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    give(monkeypatch, DECKS[name])
    assert main(["analyse", "-", "--json"]) == 0
    (result,) = json_lines(capsys.readouterr().out)
    assert (result["deck"], result["verdict"]) == ("<stdin>", VERDICTS[name])


def test_diagnostics_name_stdin(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    give(monkeypatch, BROKEN)
    assert main(["check", "-"]) == 1
    out, err = capsys.readouterr()
    assert out == "" and "--> <stdin>:1:1" in err


def test_results_of_stdin_have_a_name(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    give(monkeypatch, DECKS["over"])
    assert main(["analyse", "-", "-o", str(tmp_path)]) == 0
    assert sorted(files_in(tmp_path)) == ["stdin.json", "stdin.log", "stdin.vtu"]


def test_stdin_stands_among_other_decks_once(
    decks: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    give(monkeypatch, DECKS["over"])
    assert main(["analyse", "--json", str(decks / "exact.dat"), "-", "-"]) == 0
    said = [(Path(one["deck"]).name, one["verdict"]) for one in json_lines(capsys.readouterr().out)]
    assert said == [("exact.dat", VERDICTS["exact"]), ("<stdin>", VERDICTS["over"])]


@pytest.mark.parametrize(
    "words",
    [
        ["analyse", "-"],
        ["advise", "-"],
        ["check", "-"],
        ["cost", "-"],
        ["table", "-"],
        ["trace", "-"],
        ["batch", "-", "-j", "1", "-o", "out.csv"],
        ["declare", "-", "-o", "out.dat"],
        ["regress", "-", "--against", "answers", "--store"],
        ["picture", "-", "-o", "out.svg"],
        ["export", "-", "-o", "out.vtu"],
        ["report", "-", "-o", "out.html"],
        ["convert", "-", "-o", "out.json"],
    ],
    ids=lambda words: words[0],
)
def test_every_verb_that_reads_a_deck_reads_stdin(
    words: list[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    give(monkeypatch, NOTCH.read_bytes() if words[0] in ("cost", "table") else BAR.read_bytes())
    assert main(words) == 0
    assert not (tmp_path / "-").exists()


@pytest.mark.posix
def test_a_closed_stdin_is_told() -> None:
    line = f"exec {sys.executable} -m flexact analyse - <&-"
    done = subprocess.run(["sh", "-c", line], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "<stdin>" in done.stderr and "Traceback" not in done.stderr


# To stdout


def test_an_advised_deck_goes_to_stdout_alone(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert main(["advise", str(SIX), "--apply", "1", "-o", "-"]) == 0
    out, err = capsys.readouterr()
    assert main(["advise", str(SIX), "--apply", "1", "-o", str(tmp_path / "m.dat")]) == 0
    assert out == (tmp_path / "m.dat").read_text() and "step 1" in err
    give(monkeypatch, out)
    capsys.readouterr()
    assert main(["analyse", "-", "--expect", "exact"]) == 0


def test_declared_and_converted_decks_go_round(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["declare", str(SIX), "-o", "-"]) == 0
    declared = capsys.readouterr().out
    give(monkeypatch, declared)
    assert main(["convert", "-", "-o", "-"]) == 0
    tables = capsys.readouterr().out
    assert "nodes" in json.loads(tables)
    give(monkeypatch, tables)
    assert main(["convert", "-", "-o", "-"]) == 0
    give(monkeypatch, capsys.readouterr().out)
    assert main(["analyse", "-", "--json"]) == 0
    (result,) = json_lines(capsys.readouterr().out)
    assert result["over_constrained"] == 1


@pytest.mark.parametrize("verb", ["trace", "cost", "table"])
def test_tables_go_to_stdout_alone(
    verb: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    deck = str(BAR if verb == "trace" else NOTCH)
    assert main([verb, deck, "-o", "-"]) == 0
    out = capsys.readouterr().out
    assert main([verb, deck, "-o", str(tmp_path / "t.csv")]) == 0
    assert out == (tmp_path / "t.csv").read_text() and out.count("\n") > 5


@pytest.mark.parametrize(
    "words",
    [
        ["analyse", "-o", "-"],
        ["report", "-o", "-"],
        ["picture", "-o", "-"],
        ["export", "-o", "-"],
        ["batch", "-o", "-"],
        ["batch", "-o", "t.csv", "--files", "-"],
        ["batch", "-o", "t.csv", "--report", "-"],
        ["regress", "--against", "-"],
        ["regress", "--against", "d", "--junit", "-"],
        ["advise", "-o", "-"],
        ["advise", "--json", "--apply", "1", "-o", "-"],
        ["cost", "--json", "-o", "-"],
        ["table", "--json", "-o", "-"],
    ],
    ids=" ".join,
)
def test_what_cannot_go_to_stdout_is_refused_in_words(
    words: list[str],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
) -> None:
    monkeypatch.chdir(tmp_path)
    verb, *rest = words
    assert main([verb, str(SIX), *rest]) == 2
    out, err = capsys.readouterr()
    assert out == "" and "standard output" in err
    assert files_in(tmp_path) == []


# Folders that look like files


@pytest.mark.parametrize(
    ("words", "meant"),
    [
        (["analyse", "-o", "x.pdf"], "flexact picture"),
        (["analyse", "-o", "x.foo"], "x.foo/"),
        (["report", "-o", "x.png"], ".html"),
        (["batch", "-o", "x.txt"], ".csv"),
        (["batch", "-o", "x.csv", "--files", "y.json"], "y.json/"),
        (["batch", "-o", "x.csv", "--report", "y.html"], "flexact report"),
        (["regress", "--store", "--against", "x.json"], "x.json/"),
        (["picture", "-o", "x.txt"], "svg"),
        (["export", "-o", "x.txt"], "vtu"),
        (["cost", "-o", "x.txt"], ".csv"),
        (["table", "-o", "x.txt"], ".csv"),
        (["trace", "-o", "x.txt"], ".csv"),
        (["convert", "-o", "x.txt"], ".json"),
        (["declare", "-o", "x.pdf"], ".dat"),
        (["advise", "--apply", "1", "-o", "x.docx"], ".dat"),
    ],
    ids=lambda words: " ".join(words) if isinstance(words, list) else "",
)
def test_a_wrong_suffix_is_refused_with_what_would_be_right(
    words: list[str],
    meant: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
) -> None:
    monkeypatch.chdir(tmp_path)
    verb, *rest = words
    assert main([verb, str(SIX), *rest]) == 2
    out, err = capsys.readouterr()
    assert out == "" and meant in err
    assert files_in(tmp_path) == []


def test_a_folder_may_look_like_a_file_where_that_is_meant(decks: Path, tmp_path: Path) -> None:
    (tmp_path / "old.d").mkdir()
    for name in ("new.d/", "old.d", "run-1.5", "2026.11.22"):
        assert main(["analyse", str(decks / "exact.dat"), "-o", f"{tmp_path}/{name}"]) == 0
        assert (tmp_path / name / "exact.json").is_file()


def test_a_deck_may_have_the_suffix_of_the_one_that_was_read(tmp_path: Path) -> None:
    deck = write(tmp_path / "guide.spa", DECKS["over"])
    assert main(["declare", str(deck), "-o", str(tmp_path / "new.spa")]) == 0
    assert main(["declare", str(deck), "-o", str(tmp_path / "new.xyz")]) == 2
