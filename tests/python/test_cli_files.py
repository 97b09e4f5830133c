# SPDX-License-Identifier: BSD-3-Clause
"""The command's files of results: which there are, and what stands in their way."""

import json
from pathlib import Path

import pytest
from small_decks import BROKEN, DECKS, VERDICTS, files_in, json_lines, write

import flexact
from flexact.apps.cli.main import main
from flexact.util.outputs import OutputError


def test_files_of_a_deck(decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "new" / "results"
    assert main(["analyse", "-v", str(decks / "both.dat"), "-o", str(out)]) == 0
    assert files_in(out) == ["both.json", "both.log", "both.vtu"]
    assert json.loads((out / "both.json").read_text())["verdict"] == VERDICTS["both"]
    log = (out / "both.log").read_text(encoding="utf-8")
    # But for what is best done, which the log does not try.
    assert capsys.readouterr().out.strip().partition("\nMargin: ")[2] in log
    assert f"flexact {flexact.__version__}" in log


def test_subfolders_of_a_folder_are_kept(tmp_path: Path) -> None:
    write(tmp_path / "in" / "a" / "x.dat", DECKS["exact"])
    write(tmp_path / "in" / "b" / "x.dat", DECKS["under"])
    out = tmp_path / "out"
    assert main(["analyse", str(tmp_path / "in"), "-o", str(out), "--mesh", "vtk"]) == 0
    assert files_in(out) == [f"{f}/x.{s}" for f in "ab" for s in ("json", "log", "vtk")]


def test_decks_that_would_share_files_are_refused_beforehand(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    paths = [write(tmp_path / f / "x.dat", DECKS["exact"]) for f in "ab"]
    out = tmp_path / "out"
    assert main(["analyse", *map(str, paths), "-o", str(out)]) == 2
    reported = capsys.readouterr().err
    assert all(str(path) in reported for path in (*paths, out / "x.json"))
    assert not out.exists()


def test_a_broken_deck_writes_nothing(tmp_path: Path) -> None:
    path = write(tmp_path / "broken.dat", BROKEN)
    assert main(["analyse", str(path), "-o", str(tmp_path / "out")]) == 1
    assert not (tmp_path / "out").exists()


def test_a_format_that_cannot_hold_a_mesh_is_refused_beforehand(
    decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    arguments = ["analyse", "--json", str(decks / "exact.dat"), "-o", str(out), "--mesh", "stl"]
    assert main(arguments) == 2
    said, reported = capsys.readouterr()
    assert said == ""
    assert "'stl'" in reported.split() and len(reported.splitlines()) == 1
    assert not out.exists()


def test_a_mesh_that_cannot_be_written_does_not_cost_the_verdict(
    decks: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """What fails with the mesh itself is known only then."""

    def fail(*_: object) -> bytes:
        raise OutputError("no mesh of this")

    monkeypatch.setattr("flexact.apps.cli.export.mesh_bytes", fail)
    out = tmp_path / "out"
    arguments = ["analyse", "--json", str(decks), "-o", str(out)]
    assert main([*arguments, "--expect", "exact"]) == 2
    said, reported = capsys.readouterr()
    verdicts = {Path(line["deck"]).stem: line["verdict"] for line in json_lines(said)}
    assert verdicts == VERDICTS
    of_under = [line for line in reported.splitlines() if str(decks / "under.dat") in line]
    assert len(of_under) == 3, "not written, another verdict, and again in the summary"
    assert sum("no mesh of this" in line for line in of_under) == 1
    assert sum(VERDICTS["exact"] in line for line in of_under) == 1
    assert not out.exists()


def test_a_read_only_file_does_not_cost_the_verdict(
    decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    kept = write(tmp_path / "out" / "exact.log", "old")
    kept.chmod(0o444)
    assert main(["analyse", str(decks / "exact.dat"), "-o", str(kept.parent)]) == 2
    said, reported = capsys.readouterr()
    assert said.startswith(str(decks / "exact.dat"))
    assert str(kept) in reported
    assert files_in(kept.parent) == ["exact.log"]


def test_an_output_that_is_a_file_exits_with_1(decks: Path, tmp_path: Path) -> None:
    file = write(tmp_path / "file", "")
    assert main(["analyse", str(decks / "exact.dat"), "-o", str(file)]) == 2
    assert file.read_text() == ""
