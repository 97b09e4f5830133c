"""The command as a person and a script meet it: verdicts, files, exit codes."""

import json
from pathlib import Path

import pytest
from small_decks import BROKEN, DECKS, files_in, json_lines, write

import flexact
from flexact.cli.main import main

VERDICTS = {
    "exact": "exactly constrained",
    "under": "under-constrained",
    "over": "over-constrained",
    "both": "under-constrained and over-constrained",
}


# Verdicts and exit codes


@pytest.mark.parametrize("name", DECKS)
def test_words_say_the_verdict_under_the_path(
    name: str, decks: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = decks / f"{name}.dat"
    assert main(["analyse", str(path)]) == 0
    out, err = capsys.readouterr()
    first, second = out.splitlines()[:2]
    assert first == str(path)
    assert second.startswith(f"{VERDICTS[name].capitalize()}: ")
    assert err == ""


@pytest.mark.parametrize("expected", VERDICTS)
@pytest.mark.parametrize("name", DECKS)
def test_expect_exits_with_3_for_any_other_verdict(name: str, expected: str, decks: Path) -> None:
    code = main(["analyse", str(decks / f"{name}.dat"), "--expect", expected])
    assert code == (0 if name == expected else 3)


def test_a_deck_with_errors_exits_with_2(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write(tmp_path / "broken.dat", BROKEN)
    assert main(["analyse", str(path)]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert f"{path}:1:1" in err
    assert "^" in err


def test_an_empty_folder_exits_with_2(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["analyse", str(tmp_path)]) == 2
    assert "no deck" in capsys.readouterr().err


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["analyse"],
        ["analize", "x.dat"],
        ["analyse", "x.dat", "--expect", "three"],
        ["analyse", "x.dat", "--exp", "exact"],
        ["analyse", "x.dat", "--format", "vtk"],
        ["analyse", "x.dat", "-o", "out", "--format", "nonsense"],
        ["regress", "x.dat"],
        ["regress", "x.dat", "--against", "d", "--tolerance", "nan"],
    ],
)
def test_wrong_usage_exits_with_1(
    arguments: list[str],
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(arguments) == 1
    out, err = capsys.readouterr()
    assert out == ""
    assert "error: " in err
    assert files_in(tmp_path) == []


def test_version_and_help(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"flexact {flexact.__version__}\n"
    assert main(["--help"]) == 0
    assert "exit codes" in capsys.readouterr().out


# Several decks


def test_one_bad_deck_does_not_stop_the_rest(
    decks: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(decks / "broken.dat", BROKEN)
    assert main(["analyse", str(decks)]) == 2
    out, err = capsys.readouterr()
    assert all(f"{name}.dat" in out for name in DECKS)
    assert "broken.dat:1:1" in err
    summary = out[out.index("5 decks: ") :]
    assert "1 failed" in summary
    assert f"deck with errors: {decks / 'broken.dat'}" in summary


def test_deck_errors_outweigh_other_verdicts(decks: Path) -> None:
    broken = write(decks / "broken.dat", BROKEN)
    under = decks / "under.dat"
    assert main(["analyse", str(under), str(broken), "--expect", "exact"]) == 2
    assert main(["analyse", str(under), str(decks / "exact.dat"), "--expect", "exact"]) == 3


# JSON


def test_json_is_one_object_a_line(decks: Path, capsys: pytest.CaptureFixture[str]) -> None:
    broken = write(decks / "broken.dat", BROKEN)
    assert main(["analyse", "--json", str(decks)]) == 2
    out, err = capsys.readouterr()
    results = {Path(line["deck"]).stem: line for line in json_lines(out)}
    assert {name: results[name]["verdict"] for name in DECKS} == VERDICTS
    (diagnostic,) = results["broken"]["error"]["diagnostics"]
    assert set(diagnostic) == {"code", "line", "column", "message"}
    assert (diagnostic["line"], diagnostic["column"]) == (1, 1)
    assert results["broken"]["deck"] == str(broken)
    assert "broken.dat:1:1" in err
    assert "5 decks: " in err


def test_json_has_the_promised_names(decks: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["analyse", "--json", str(decks / "both.dat")])
    (result,) = json_lines(capsys.readouterr().out)
    assert set(result) >= {
        "deck", "flexact", "verdict", "under_constrained", "over_constrained", "rank", "rows",
        "columns", "singular_values", "condition_number", "degrees_of_freedom", "counts",
        "motions", "self_stresses", "warnings",
    }  # fmt: skip
    assert (result["under_constrained"], result["over_constrained"]) == (1, 1)
    assert result["condition_number"] is None
    (component,) = result["motions"][0]["components"]
    assert (component["node"], component["coordinate"]) == (2, "y")
    assert abs(component["value"]) == pytest.approx(1.0, abs=1e-15)
    stresses = result["self_stresses"][0]["components"]
    assert [(each["element"], each["deformation"]) for each in stresses] == [(1, 1), (2, 1)]


def test_too_large_an_analysis_is_told_in_json(
    decks: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise flexact.AnalysisError("a matrix of 9 x 9 needs more memory than there is")

    monkeypatch.setattr(flexact, "analyse", refuse)
    assert main(["analyse", "--json", str(decks / "exact.dat")]) == 1
    out, err = capsys.readouterr()
    (diagnostic,) = json_lines(out)[0]["error"]["diagnostics"]
    assert diagnostic["line"] == 0
    assert diagnostic["message"].startswith("a matrix of 9 x 9")
    assert "a matrix of 9 x 9" in err


# Files


def test_files_of_a_deck(decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "new" / "results"
    assert main(["analyse", str(decks / "both.dat"), "-o", str(out)]) == 0
    assert files_in(out) == ["both.json", "both.log", "both.vtu"]
    assert json.loads((out / "both.json").read_text())["verdict"] == VERDICTS["both"]
    log = (out / "both.log").read_text(encoding="utf-8")
    said = capsys.readouterr().out.strip()
    assert said in log
    assert "element 2, deformation 1" in log
    assert "node 2, coordinate y" in log
    assert f"flexact {flexact.__version__}" in log


def test_subfolders_of_a_folder_are_kept(tmp_path: Path) -> None:
    write(tmp_path / "in" / "a" / "x.dat", DECKS["exact"])
    write(tmp_path / "in" / "b" / "x.dat", DECKS["under"])
    out = tmp_path / "out"
    assert main(["analyse", str(tmp_path / "in"), "-o", str(out), "--format", "vtk"]) == 0
    assert files_in(out) == [f"{f}/x.{s}" for f in "ab" for s in ("json", "log", "vtk")]


def test_decks_that_would_share_files_are_refused_beforehand(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    paths = [write(tmp_path / f / "x.dat", DECKS["exact"]) for f in "ab"]
    out = tmp_path / "out"
    assert main(["analyse", *map(str, paths), "-o", str(out)]) == 1
    assert "would both write" in capsys.readouterr().err
    assert not out.exists()


def test_a_broken_deck_writes_nothing(tmp_path: Path) -> None:
    path = write(tmp_path / "broken.dat", BROKEN)
    assert main(["analyse", str(path), "-o", str(tmp_path / "out")]) == 2
    assert not (tmp_path / "out").exists()


def test_a_format_that_cannot_hold_the_mesh_writes_nothing(
    decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    arguments = ["analyse", "--json", str(decks / "exact.dat"), "-o", str(out), "--format", "stl"]
    assert main(arguments) == 1
    captured = capsys.readouterr()
    assert "stl cannot hold this scene" in captured.err
    assert "STL can only write triangle cells" in captured.err
    assert [set(line) for line in json_lines(captured.out)] == [{"deck", "error"}]
    assert not out.exists()


def test_an_output_that_is_a_file_exits_with_1(decks: Path, tmp_path: Path) -> None:
    file = write(tmp_path / "file", "")
    assert main(["analyse", str(decks / "exact.dat"), "-o", str(file)]) == 1
    assert file.read_text() == ""


# Check


def test_check_says_what_is_wrong(decks: Path, capsys: pytest.CaptureFixture[str]) -> None:
    good, broken = decks / "exact.dat", write(decks / "broken.dat", BROKEN)
    assert main(["check", str(good)]) == 0
    assert capsys.readouterr() == (f"{good}: no errors\n", "")
    assert main(["check", str(broken), str(good)]) == 2
    out, err = capsys.readouterr()
    assert f"{good}: no errors" in out
    assert f"{broken}:1:1" in err
