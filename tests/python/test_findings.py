# SPDX-License-Identifier: BSD-3-Clause
"""Findings in the forms of services: annotations of GitHub, SARIF, and the JSON of check."""

import io
import json
import re
import sys
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import jsonschema
import pytest
from json_schema import assert_valid_as, schema, strict
from sarif_schema import assert_sarif
from small_decks import BROKEN, COLLINEAR, DECKS, json_lines, write

from flexact.analysis.certainty import Doubt, DoubtKind
from flexact.apps.checks.outputs import CODES
from flexact.apps.cli.main import main

ROOT = Path(__file__).parents[2]
CHECK = jsonschema.Draft202012Validator(strict(schema("check")))
#: An error on line 3 behind a character of two UTF-16 units, in a deck named like a command.
ODD_NAME = "50%, a:b.dat"
ODD = "TRUSS 1 1 2\nX 2 1 0 0\nFIX \U0001d49c x\n"


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Decks lie in the folder where the command runs, and no service runs it."""
    monkeypatch.delenv("GITHUB_WORKSPACE", raising=False)
    monkeypatch.chdir(tmp_path)
    for name, text in DECKS.items():
        write(tmp_path / "decks" / f"{name}.dat", text)


def annotations(text: str) -> list[tuple[str, dict[str, str], str]]:
    """Annotations as GitHub's runner reads them: the kind, the entries, the words."""
    made = []
    for line in text.splitlines():
        found = re.fullmatch(r"::(error|warning|notice) ([^:]*)::(.*)", line)
        assert found is not None, line
        entries = dict(entry.split("=", 1) for entry in found[2].split(","))
        # Of all that is escaped, what unquote undoes is just this: % CR LF : and comma.
        assert set(re.findall(r"%..", found[2])) <= {"%25", "%0D", "%0A", "%3A", "%2C"}
        assert set(re.findall(r"%..", found[3])) <= {"%25", "%0D", "%0A"}
        made.append((found[1], {k: unquote(v) for k, v in entries.items()}, unquote(found[3])))
    return made


def sarif(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, dict[str, Any]]:
    capsys.readouterr()
    code = main([*words, "--format", "sarif"])
    log = json.loads(capsys.readouterr().out)
    assert_sarif(dict(log))
    (run,) = log["runs"]
    return code, run


# What is written


def test_check_marks_all_problems_of_all_decks(capsys: pytest.CaptureFixture[str]) -> None:
    write(Path("decks/broken.dat"), BROKEN)
    write(Path("decks/zwei.dat"), "X 2 1 0 0\nTRUSS 1 1 1\nFIX 9\nEND\n")
    assert main(["check", "decks", "missing.dat", "--format", "github"]) == 1
    out, err = capsys.readouterr()
    made = annotations(out)
    errors = {
        (entries["file"], entries.get("line")) for kind, entries, _ in made if kind == "error"
    }
    assert {("decks/broken.dat", "1"), ("missing.dat", None)} <= errors
    assert len([place for place in errors if place[0] == "decks/zwei.dat"]) >= 2
    # What a person reads stands on stderr, as for text.
    assert "broken.dat:1:1" in err and "7 decks" in err


def test_places_are_those_of_the_words(capsys: pytest.CaptureFixture[str]) -> None:
    path = "input_decks/broken/fixed_and_independent.dat"
    write(Path("a.dat"), (ROOT / path).read_text())
    assert main(["check", "a.dat", "--format", "github"]) == 1
    ((kind, entries, words),) = annotations(capsys.readouterr().out)
    # The stored words beside the deck say 6:10, and 5:8 for the first.
    assert kind == "error" and entries["title"] == "flexact (class-conflict)"
    assert [entries[name] for name in ("line", "endLine", "col", "endColumn")] == [
        *"66",
        "10",
        "11",
    ]
    assert "line 5: first here" in words.splitlines() and "help: keep one" in words


def test_columns_are_utf16_and_names_are_escaped(capsys: pytest.CaptureFixture[str]) -> None:
    write(Path(ODD_NAME), ODD)
    assert main(["check", ODD_NAME, "--format", "github"]) == 1
    made = annotations(capsys.readouterr().out)
    assert {entries["file"] for _, entries, _ in made} == {ODD_NAME}
    # FIX and a blank are four units, the letter that is none of the first plane two.
    assert (made[0][1]["col"], made[0][1]["endColumn"]) == ("5", "7")
    code, run = sarif(capsys, "check", ODD_NAME)
    location = run["results"][0]["locations"][0]["physicalLocation"]
    assert code == 1 and run["columnKind"] == "utf16CodeUnits"
    assert location["region"] == {"startLine": 3, "startColumn": 5, "endColumn": 7}
    artifact = location["artifactLocation"]
    assert unquote(artifact["uri"]) == ODD_NAME and ":" not in artifact["uri"]
    assert artifact["uriBaseId"] in run["originalUriBaseIds"]


def test_columns_behind_a_letter_of_two_units(capsys: pytest.CaptureFixture[str]) -> None:
    write(Path("a.dat"), "TRUSS 1 1 2\nX 2 1 0 0\nFIX 1\nRLSE 1 \U0001d49c\nEND\n")
    assert main(["check", "a.dat", "--format", "github"]) == 1
    entries = annotations(capsys.readouterr().out)[0][1]
    assert [entries[name] for name in ("line", "col", "endColumn")] == ["4", "8", "10"]


@pytest.mark.parametrize("old", [False, True])
def test_paths_are_those_from_the_root_of_the_repository(
    old: bool, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    write(Path("decks/broken.dat"), BROKEN)
    monkeypatch.setenv("GITHUB_WORKSPACE", str(Path.cwd()))
    given = str(Path.cwd() / "decks" / "broken.dat") if old else "broken.dat"
    monkeypatch.chdir("decks")
    main(["check", given, "--format", "github"])
    assert {entries["file"] for _, entries, _ in annotations(capsys.readouterr().out)} == {
        "decks/broken.dat"
    }


def test_a_deck_outside_keeps_its_whole_path(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write(tmp_path / "elsewhere" / "b c.dat", BROKEN)
    monkeypatch.chdir("decks")
    _, run = sarif(capsys, "check", str(path))
    artifact = run["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]
    assert artifact == {"uri": path.as_uri()}


def test_a_deck_on_standard_input(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for form in ("github", "sarif"):
        raw = io.TextIOWrapper(io.BytesIO(BROKEN.encode()))
        monkeypatch.setattr(sys, "stdin", raw)
        assert main(["check", "-", "--format", form]) == 1
        assert "stdin" in capsys.readouterr().out


# Verdicts


@pytest.mark.parametrize("name", DECKS)
@pytest.mark.parametrize("expected", DECKS)
def test_a_verdict_that_is_not_expected_is_an_error(
    name: str, expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["analyse", f"decks/{name}.dat", "--expect", expected]
    code = main([*words, "--format", "github"])
    made = annotations(capsys.readouterr().out)
    assert (code == 3) == (name != expected) == any(kind == "error" for kind, *_ in made)
    ours, run = sarif(capsys, *words)
    assert ours == code == run["invocations"][0]["exitCode"]
    assert {result["level"] for result in run["results"]} <= {"error"}
    assert len(run["results"]) == len(made)


def test_what_is_wrong_stands_at_the_statement_of_the_element(
    capsys: pytest.CaptureFixture[str],
) -> None:
    """README's guide: both sheets hold the rotation of the stage about y."""
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    deck = next(part for part in readme.split("\n\n") if part.startswith("    BEAM"))
    write(Path("guide.dat"), deck.replace("    ", "") + "\n")
    assert main(["analyse", "guide.dat", "--expect", "exact", "--format", "github"]) == 3
    out, err = capsys.readouterr()
    ((kind, entries, words),) = annotations(out)
    assert (kind, entries["line"], entries["col"]) == ("error", "1", "6")
    assert entries["title"] == "flexact (over-constrained)"
    assert "sheet 1 and sheet 2 both hold the stage against rotation about y" in words
    assert "RLSE 1 3" in words and "over-constrained by 1; expected" in err
    _, run = sarif(capsys, "analyse", "guide.dat", "--expect", "exact")
    (result,) = run["results"]
    related = [one["physicalLocation"]["region"]["startLine"] for one in result["relatedLocations"]]
    assert related == [1, 2]


def test_without_an_expectation_a_verdict_is_a_note(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["analyse", "decks", "--format", "github"]) == 0
    made = annotations(capsys.readouterr().out)
    assert {kind for kind, *_ in made} == {"notice"}
    found = {(entries["file"], entries["title"]) for _, entries, _ in made}
    under, over = ("flexact (under-constrained)", "flexact (over-constrained)")
    files = {name: f"decks/{name}.dat" for name in DECKS}
    assert found == {
        (files["under"], under),
        (files["over"], over),
        (files["both"], under),
        (files["both"], over),
    }


def test_a_margin_below_the_accuracy_is_an_error(capsys: pytest.CaptureFixture[str]) -> None:
    # A joint that is 1 um beside the line of its two bars, so that it is exact by that.
    write(Path("near.dat"), COLLINEAR.replace("X 1 -1 0", "X 1 -1 0\nX 2 0 1e-6"))
    words = ["analyse", "near.dat", "--expect", "exact", "--accuracy", "20e-6"]
    assert main([*words, "--format", "github"]) == 3
    made = [one for one in annotations(capsys.readouterr().out) if one[0] == "error"]
    ((_, entries, said),) = made
    assert entries["title"] == "flexact (small-margin)" and "1 um" in said


def test_files_are_written_beside(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["analyse", "decks/exact.dat", "-o", "out", "--mesh", "vtk", "--format", "github"]
    assert main(words) == 0
    assert {path.name for path in Path("out").iterdir()} == {
        *("exact.json", "exact.log", "exact.vtk")
    }
    assert capsys.readouterr().out == ""


# Fingerprints


def prints(capsys: pytest.CaptureFixture[str], text: str) -> list[str]:
    write(Path("a.dat"), text)
    _, run = sarif(capsys, "analyse", "a.dat", "--expect", "exact")
    return [one["partialFingerprints"]["primaryLocationLineHash"] for one in run["results"]]


def test_fingerprints_survive_moved_lines_and_tell_results_apart(
    capsys: pytest.CaptureFixture[str],
) -> None:
    both = "X 2 1 0 0\nX 2 1 0 0\nX 2 1 0 0\n" + DECKS["over"].replace("END\n", "RLSE 9 x\nEND\n")
    for text in (both, DECKS["both"], DECKS["over"]):
        first = prints(capsys, text)
        assert first and len(set(first)) == len(first)
        moved = "% a line before\n\n" + re.sub("\n", "\n\n", text.replace(" ", "\t "))
        assert prints(capsys, moved.replace("PLTRUSS", "pltruss")) == first
    other = re.sub(r"PLTRUSS (\d)", r"PLTRUSS 1\1", DECKS["over"])
    assert prints(capsys, other) != first


def test_a_wrong_log_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    """What the test of the form itself would see."""
    _, run = sarif(capsys, "check", "missing.dat")
    (result,) = run["results"]
    for wrong in ({"level": "grave"}, {"text": "x"}, {"locations": {}}, {"ruleIndex": "0"}):
        log = {"$schema": "", "version": "2.1.0", "runs": [{**run, "results": [result | wrong]}]}
        with pytest.raises(AssertionError):
            assert_sarif(log)
    del result["message"]
    with pytest.raises(AssertionError, match="message is missing"):
        assert_sarif({"$schema": "", "version": "2.1.0", "runs": [run]})


# Rules


def test_every_code_of_decks_and_doubts_has_a_rule() -> None:
    made = set()
    for folder in ("deck", "model"):
        for path in (ROOT / "fortran" / folder).glob("*.f90"):
            made |= set(re.findall(r"'([a-z]+(?:-[a-z]+)+)'", path.read_text()))
    for name in ("model/reading.py", "util/decks.py", "apps/cli/decks.py"):
        text = (ROOT / "python" / "flexact" / name).read_text()
        made |= set(re.findall(r'(?<!encode\(")"([a-z]+(?:-[a-z]+)+)"', text))
    made |= {Doubt(kind).code for kind in DoubtKind}
    assert made - {"utf-8", "mixed-up"} <= CODES


def test_rules_of_a_log_have_help(capsys: pytest.CaptureFixture[str]) -> None:
    code, run = sarif(capsys, "check", str(ROOT / "input_decks" / "broken"))
    rules = run["tool"]["driver"]["rules"]
    assert code == 1 and len(rules) > 20 and {rule["id"] for rule in rules} <= CODES
    for result in run["results"]:
        rule = rules[result["ruleIndex"]]
        assert rule["id"] == result["ruleId"] and rule["help"]["text"]
        page, _, _ = rule["helpUri"].rpartition("/docs/")[2].partition("#")
        assert (ROOT / "docs" / page).is_file()


# The JSON of check


def test_json_of_check_is_what_its_schema_says(capsys: pytest.CaptureFixture[str]) -> None:
    write(Path("decks/broken.dat"), BROKEN)
    words = ["check", "--json", "decks", "missing.dat", str(ROOT / "input_decks" / "broken")]
    assert main(words) == 1
    out, err = capsys.readouterr()
    objects = json_lines(out)
    for made in objects:
        assert_valid_as(CHECK, made)
    by_deck = {made["deck"]: made for made in objects}
    assert by_deck["decks/exact.dat"]["errors"] == 0 and "broken.dat:1:1" in err
    (wrong,) = by_deck["decks/broken.dat"]["diagnostics"]
    assert (wrong["code"], wrong["line"], wrong["column"]) == ("unknown-keyword", 1, 1)
    assert by_deck["missing.dat"]["diagnostics"][0]["code"] == "no-such-file"
    conflict = next(made for name, made in by_deck.items() if "fixed_and_independent" in name)
    assert conflict["diagnostics"][0]["other"] == {"line": 5, "column": 8, "end_column": 9}
    assert main(["check", "--json", "decks/exact.dat"]) == 0


# Options


@pytest.mark.parametrize(
    "words",
    [
        ["check", "a.dat", "--json", "--format", "github"],
        ["check", "a.dat", "--summary", "--json"],
        ["check", "a.dat", "--summary", "--format", "sarif"],
        ["check", "a.dat", "--format", "vtk"],
        ["analyse", "a.dat", "--json", "--format", "sarif"],
        ["analyse", "a.dat", "--format", "nonsense"],
    ],
)
def test_one_form_is_chosen(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == 2
    out, err = capsys.readouterr()
    assert out == "" and words[-1].lstrip("-") in err


def test_names_are_no_links(capsys: pytest.CaptureFixture[str]) -> None:
    """Of the characters that SARIF reads, each has a backslash before it (2.1.0, 3.11.6)."""
    name = "[see](https://evil.example) \\\\ []"
    Path("x.dat").write_text(
        f"BEAM 1 1 2 3 4 0 1 0 % {name}\nX 3 0.1 0 0\nBEAM 1 1 2 3 4 % {name}\n"
    )
    for words in (["check", "x.dat"], ["analyse", "x.dat", "--expect", "exact"]):
        _, run = sarif(capsys, *words)
        texts = [one["message"]["text"] for one in run["results"]]
        texts += [
            each["message"]["text"]
            for one in run["results"]
            for each in one.get("relatedLocations", ())
        ]
        assert texts and all(not re.search(r"[\[\]]", re.sub(r"\\.", "", text)) for text in texts)
    Path("y.dat").write_text(f"BEAM 1 1 2 3 4 0 1 0 % {name}\nX 3 0.1 0 0\n")
    _, run = sarif(capsys, "analyse", "y.dat", "--expect", "exact")
    assert r"\[see\](https://evil.example)" in json.dumps(run).replace("\\\\", "\\")
