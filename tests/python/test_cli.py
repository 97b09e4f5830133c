# SPDX-License-Identifier: BSD-3-Clause
"""The command as a person and a script meet it: verdicts, files, exit codes."""

import os
import re
from pathlib import Path
from typing import Any

import pytest
from small_decks import BROKEN, DECKS, VERDICTS, files_in, json_lines, write

import flexact
from flexact.apps.cli.main import main
from flexact.apps.cli.terminal import ExitCode

# Verdicts and exit codes


@pytest.mark.parametrize("name", DECKS)
def test_words_stand_under_the_path_and_json_has_the_verdict(
    name: str, decks: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = decks / f"{name}.dat"
    assert main(["analyse", str(path)]) == 0
    out, err = capsys.readouterr()
    assert (out.splitlines()[0], err) == (str(path), "")
    assert len(out.splitlines()) > 5
    assert main(["analyse", "--json", str(path)]) == 0
    (result,) = json_lines(capsys.readouterr().out)
    assert result["verdict"] == VERDICTS[name]


@pytest.mark.parametrize("expected", VERDICTS)
@pytest.mark.parametrize("name", DECKS)
def test_expect_exits_with_3_for_any_other_verdict(name: str, expected: str, decks: Path) -> None:
    code = main(["analyse", str(decks / f"{name}.dat"), "--expect", expected])
    assert code == (0 if name == expected else 3)


def test_method_and_tolerance_are_those_that_are_asked_for(
    decks: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = ["analyse", str(decks / "over.dat"), "--method", "jacobi"]
    assert main([*arguments, "-v"]) == 0
    assert "jacobi" in capsys.readouterr().out
    main([*arguments, "--tolerance", "1e-3", "--json"])
    (result,) = json_lines(capsys.readouterr().out)
    assert (result["method"], result["tolerance"], result["rank"]) == ("jacobi", 1e-3, 2)
    main([*arguments, "--tolerance", "100", "--json"])
    (result,) = json_lines(capsys.readouterr().out)
    assert result["rank"] == 0


def test_a_deck_with_errors_exits_with_1(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write(tmp_path / "broken.dat", BROKEN)
    assert main(["analyse", str(path)]) == 1
    out, err = capsys.readouterr()
    assert out == ""
    assert f"{path}:1:1" in err
    assert "^" in err


def test_an_empty_folder_exits_with_1(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["analyse", str(tmp_path)]) == 1
    out, err = capsys.readouterr()
    assert out == "" and str(tmp_path) in err


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["analyse"],
        ["analize", "x.dat"],
        ["analyse", "x.dat", "--expect", "three"],
        ["analyse", "x.dat", "--exp", "exact"],
        ["analyse", "x.dat", "--mesh", "vtk"],
        ["analyse", "x.dat", "-o", "out", "--mesh", "nonsense"],
        ["analyse", "x.dat", "--method", "cholesky"],
        ["analyse", "x.dat", "--tolerance", "-1"],
        ["regress", "x.dat", "--against", "d", "--method", "cholesky"],
        ["regress", "x.dat"],
        ["regress", "x.dat", "--against", "d", "--within", "nan"],
    ],
)
def test_wrong_usage_exits_with_2(
    arguments: list[str],
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(("flexact: error:", "error:", "usage: flexact"))
    assert files_in(tmp_path) == []


def test_version_and_help(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"flexact {flexact.__version__}\n"
    assert main(["--help"]) == 0
    reported = capsys.readouterr().out
    assert re.findall(r"^ +(\d)  ", reported, re.MULTILINE) == [str(int(code)) for code in ExitCode]


@pytest.mark.parametrize(
    ("word", "meant"), [("analyze", "analyse"), ("chek", "check"), ("nonsense", None)]
)
def test_a_misspelt_command_gets_a_hint(
    word: str, meant: str | None, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([word, "x.dat"]) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"error: unrecognized command '{word}'\n")
    assert (f"tip: a similar command exists: '{meant}'" in said) == (meant is not None)
    assert said.endswith("For more information, try 'flexact --help'.\n")


# Several decks


def test_one_bad_deck_does_not_stop_the_rest(
    decks: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(decks / "broken.dat", BROKEN)
    assert main(["analyse", str(decks)]) == 1
    out, err = capsys.readouterr()
    assert all(f"{name}.dat" in out for name in DECKS)
    assert "broken.dat:1:1" in err
    summary, *listed = out.split("\n5 ")[1].splitlines()
    assert "1" in summary.split()
    assert [line.endswith(f": {decks / 'broken.dat'}") for line in listed] == [True]


def test_the_summary_names_each_that_failed(
    decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    broken, missing = write(tmp_path / "broken.dat", BROKEN), tmp_path / "missing.dat"
    empty = tmp_path / "empty"
    empty.mkdir()
    arguments = [str(decks / "exact.dat"), str(broken), str(missing), str(empty)]
    assert main(["analyse", *arguments]) == 1
    listed = capsys.readouterr().out.split("\n4 ")[1].splitlines()[1:]
    assert [line.split(": ")[1] for line in listed] == [str(broken), str(missing), str(empty)]
    assert len({line.split(": ")[0] for line in listed}) == 3, "each for its own reason"


def test_a_folder_that_cannot_be_searched_does_not_stop_the_rest(
    decks: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    closed = decks / "closed"
    write(closed / "hidden.dat", DECKS["exact"])
    scandir = os.scandir

    def refuse(path: str) -> Any:
        if Path(path) == closed:
            raise PermissionError(13, "Permission denied", str(path))
        return scandir(path)

    monkeypatch.setattr(os, "scandir", refuse)
    assert main(["analyse", "--json", str(decks)]) == 1
    out, err = capsys.readouterr()
    results = {Path(line["deck"]).stem: line for line in json_lines(out)}
    assert {name: results[name]["verdict"] for name in DECKS} == VERDICTS
    (diagnostic,) = results["closed"]["error"]["diagnostics"]
    assert diagnostic["code"] == "cannot-read"
    assert len([line for line in err.splitlines() if str(closed) in line]) == 2
    assert main(["check", str(closed)]) == 1


def test_a_deck_that_is_named_twice_is_analysed_once(
    decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = str(decks / "exact.dat")
    assert main(["analyse", "--json", path, str(decks), path, "-o", str(tmp_path / "out")]) == 0
    assert len(json_lines(capsys.readouterr().out)) == len(DECKS)


def test_deck_errors_outweigh_other_verdicts(decks: Path) -> None:
    broken = write(decks / "broken.dat", BROKEN)
    under = decks / "under.dat"
    assert main(["analyse", str(under), str(broken), "--expect", "exact"]) == 1
    assert main(["analyse", str(under), str(decks / "exact.dat"), "--expect", "exact"]) == 3


# JSON


def test_json_is_one_object_a_line(decks: Path, capsys: pytest.CaptureFixture[str]) -> None:
    broken = write(decks / "broken.dat", BROKEN)
    assert main(["analyse", "--json", str(decks)]) == 1
    out, err = capsys.readouterr()
    results = {Path(line["deck"]).stem: line for line in json_lines(out)}
    assert {name: results[name]["verdict"] for name in DECKS} == VERDICTS
    assert results["broken"]["error"]["errors"] == 1
    (diagnostic,) = results["broken"]["error"]["diagnostics"]
    assert set(diagnostic) == {"code", "severity", "line", "column", "message"}
    assert (diagnostic["line"], diagnostic["column"]) == (1, 1)
    assert results["broken"]["deck"] == str(broken)
    assert "broken.dat:1:1" in err
    assert any(line.startswith("5 ") for line in err.splitlines()), "the summary"


def test_json_counts_all_errors_and_lists_a_hundred(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write(tmp_path / "broken.dat", BROKEN.replace("END", "NONSENSE\n" * 150 + "END"))
    assert main(["analyse", "--json", str(path)]) == 1
    (line,) = json_lines(capsys.readouterr().out)
    assert len(line["error"]["diagnostics"]) == 100
    assert line["error"]["errors"] == 151


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
        raise flexact.AnalysisError("a matrix of 9 x 9")

    monkeypatch.setattr("flexact.apps.cli.decks.result_of", refuse)
    assert main(["analyse", "--json", str(decks / "exact.dat")]) == 2
    out, err = capsys.readouterr()
    (diagnostic,) = json_lines(out)[0]["error"]["diagnostics"]
    assert (diagnostic["code"], diagnostic["line"]) == ("not-analysed", 0)
    assert diagnostic["message"] == "a matrix of 9 x 9"
    assert "a matrix of 9 x 9" in err


# Check


def test_check_says_what_is_wrong(decks: Path, capsys: pytest.CaptureFixture[str]) -> None:
    good, broken = decks / "exact.dat", write(decks / "broken.dat", BROKEN)
    assert main(["check", str(good)]) == 0
    said = capsys.readouterr()
    assert said.out.startswith(f"{good}: ") and said.err == ""
    assert main(["check", str(broken), str(good)]) == 1
    out, err = capsys.readouterr()
    assert said.out in out and str(broken) in out
    assert f"{broken}:1:1" in err and str(good) not in err
