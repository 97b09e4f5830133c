# SPDX-License-Identifier: BSD-3-Clause
"""`flexact design` as a user runs it: what it prints, writes and refuses, and how it ends."""

from __future__ import annotations

import json
import runpy
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from json_schema import assert_valid_as, schema, strict

import flexact
from flexact.apps.cli.main import main
from flexact.designs.problem import KINDS
from flexact.designs.reasons import Reason
from flexact.designs.scores import SCORES

#: Forces along z hold what is not wanted: three wires between a plate and a base.
STAGE = """\
title = "XY-theta stage"
wanted = "planar z"
units = "mm"
[stage]
boxes = [[[-30, -30, 0], [30, 30, 0]]]
mass = 0.3
inertia = "200 kg mm2"
[ground]
boxes = [[[-30, -30, -80], [30, 30, -60]]]
[limits]
length = [60, 80]
diameter = 0.8
kinds = ["wire"]
"""
#: The ground lies beyond the reach of the longest wire: 60 mm at least.
TOO_SHORT = STAGE.replace("length = [60, 80]", "length = [20, 40]")
#: Two translations and nothing else, which wires alone cannot leave, without a body between.
TRANSLATIONS = STAGE.replace('"planar z"', '"x, y"') + "bodies = 0\n"
ANSWER, EXPLANATION = (
    jsonschema.Draft202012Validator(
        {key: value for key, value in strict(schema("design")).items() if key != "oneOf"}
        | {"$ref": f"#/$defs/{of}"}
    )
    for of in ("answer", "explanation")
)


@pytest.fixture
def at(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with problems, in which commands are given."""
    monkeypatch.chdir(tmp_path)
    for name, text in (("stage", STAGE), ("short", TOO_SHORT), ("xy", TRANSLATIONS)):
        (tmp_path / f"{name}.toml").write_text(text, encoding="utf-8")
    return tmp_path


class Said:
    """What a command printed, and its exit code."""

    def __init__(self, capsys: pytest.CaptureFixture[str], *words: str) -> None:
        capsys.readouterr()
        try:
            self.code = int(main(["design", *words]))
        except SystemExit as ended:
            self.code = int(ended.code or 0)
        self.out, self.err = capsys.readouterr()

    @property
    def answer(self) -> Any:
        """The first line, which is to be all that is said on stdout."""
        lines = self.out.splitlines()
        assert len(lines) == 1
        return json.loads(lines[0])


def test_layouts_are_said_with_what_was_proven(
    at: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    said = Said(capsys, "stage.toml", "-n", "2")
    assert said.code == 0 and not said.err
    assert "three independent motions: translation x; translation y; rotation z" in said.out
    assert "exactly constrained, proven for the decimals as typed" in said.out
    rows = [line for line in said.out.splitlines() if "three wires" in line]
    assert len(rows) == 2 and [row.split()[0] for row in rows] == ["1", "2"]


def test_the_answer_is_one_line_of_the_schema(at: Path, capsys: pytest.CaptureFixture[str]) -> None:
    answer = Said(capsys, "stage.toml", "--json").answer
    assert_valid_as(ANSWER, answer)
    assert answer["rank_by"] == "worst_stiffness" and answer["kinds"]["wires"] == 3
    # A plate of 60 mm by 60 mm: L is half of its diagonal.
    assert answer["size"] == pytest.approx(0.03 * 2**0.5)
    for layout in answer["layouts"]:
        made = flexact.analyse(flexact.read_text(layout["deck"]))
        assert (made.under_constrained, made.over_constrained) == (0, 0)
        assert made.degrees_of_freedom == 3
        for flexure in layout["flexures"]:
            # Wires between z = 0 and the base along z alone leave x, y and rz.
            (x, y, z), (u, v, w) = flexure["ends"]
            assert z == 0.0 and -0.08 <= w <= -0.06
            assert (u, v) == (x, y)


def test_without_layouts_the_answer_says_why(
    at: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    said = Said(capsys, "short.toml", "--json")
    assert said.code == 1
    assert_valid_as(ANSWER, said.answer)
    assert said.answer["layouts"] == [] and said.answer["none"]["condition"] == "length"
    # The base is 60 mm away; how far is told to 2 %.
    assert 0.0599 <= said.answer["none"]["by"] <= 0.064
    assert said.answer["none"]["statement"].startswith("Flexures are at most 40 mm long; 60 mm")
    said = Said(capsys, "xy.toml", "--json")
    assert said.code == 1 and said.answer["none"]["condition"] == "wires"
    assert_valid_as(ANSWER, said.answer)
    # With rotation about z three wires will do; of one translation five.
    assert [each["dimension"] for each in said.answer["nearby"]] == [3, 1, 1]
    # No layout, no deck; a page or an answer says why. It is not sought anew.
    why = Reason("length", 0.06, "Flexures are too short.")
    monkeypatch.setattr("flexact.designs.design.reason_of", lambda *_: why)
    assert Said(capsys, "short.toml", "-o", "decks").code == 1 and not (at / "decks").exists()
    assert Said(capsys, "short.toml", "--apply", "1", "-o", "short.dat").code == 1
    assert not (at / "short.dat").exists()
    assert Said(capsys, "short.toml", "-o", "short.json").code == 1
    assert json.loads((at / "short.json").read_text("utf-8"))["none"] == why._asdict()
    said = Said(capsys, "short.toml")
    assert said.code == 1 and "No layout: Flexures are too short." in said.out


def test_what_a_freedom_takes_needs_no_regions(
    at: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (at / "alone.toml").write_text('wanted = "rotation x"\n', encoding="utf-8")
    said = Said(capsys, "alone.toml", "--explain")
    assert said.code == 0 and "It takes five constraints" in said.out
    assert "layout" not in said.out
    said = Said(capsys, "alone.toml", "--explain", "--json")
    assert_valid_as(EXPLANATION, said.answer)
    # A line that all wires meet, and a sheet through it (theorems 1 and 2).
    assert said.answer["kinds"]["wires"] == 5 and said.answer["kinds"]["sheet"] == [1, 2]


def test_the_schema_knows_all_scores_and_kinds() -> None:
    defs = schema("design")["$defs"]
    assert list(defs["layout"]["properties"]["scores"]["properties"]) == list(SCORES)
    assert defs["flexure"]["properties"]["kind"]["enum"] == list(KINDS)
    assert list(defs["answer"]["properties"]["candidates"]["properties"]) == list(KINDS)


def test_layouts_are_written(at: Path, capsys: pytest.CaptureFixture[str]) -> None:
    said = Said(capsys, "stage.toml", "-n", "2", "-o", "decks/")
    assert said.code == 0 and "written to decks" in said.out
    decks = sorted(path.name for path in (at / "decks").iterdir())
    assert [name[:3] for name in decks] == ["01_", "02_"]
    said = Said(capsys, "stage.toml", "-n", "2", "--apply", "2", "-o", "second.dat")
    assert said.code == 0
    assert (at / "second.dat").read_bytes() == (at / "decks" / decks[1]).read_bytes()
    # The script makes the same model.
    assert Said(capsys, "stage.toml", "-n", "2", "--apply", "2", "-o", "second.py").code == 0
    made = runpy.run_path(str(at / "second.py"))["model"]
    assert flexact.analyse(made).verdict == flexact.analyse(at / "second.dat").verdict
    assert Said(capsys, "stage.toml", "-n", "2", "-o", "all.json").code == 0
    assert_valid_as(ANSWER, json.loads((at / "all.json").read_text("utf-8")))
    # With --json the answer alone is on stdout.
    said = Said(capsys, "stage.toml", "-n", "2", "--json", "-o", "again.json")
    assert len(said.answer["layouts"]) == 2 and "written to again.json" in said.err


def test_refined_layouts_are_told(at: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What the search found is what the layout has, analysed and scored anew."""
    pytest.importorskip("scipy")
    answer = Said(capsys, "stage.toml", "-n", "1", "--refine", "--json").answer
    assert_valid_as(ANSWER, answer)
    (layout,) = answer["layouts"]
    told = layout["refined"]
    assert told["was"] == 1 and told["score"] == answer["rank_by"] == "worst_stiffness"
    assert told["before"] <= told["after"] == pytest.approx(layout["scores"]["worst_stiffness"])


def test_the_same_question_has_the_same_answer(
    at: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    first, second = (Said(capsys, "stage.toml", "--json").answer for _ in range(2))
    assert first | {"seconds": 0} == second | {"seconds": 0}


def test_options_take_the_place_of_what_a_problem_says(
    at: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    said = Said(capsys, "stage.toml", "--json", "--rank", "drive stiffness")
    assert said.answer["rank_by"] == "lower:drive_stiffness"
    drives = [layout["scores"]["drive_stiffness"] for layout in said.answer["layouts"]]
    assert drives == sorted(drives)
    said = Said(capsys, "stage.toml", "--json", "--symmetry", "3-fold about z")
    assert said.answer["layouts"]
    # Three turns, and where mirrors keep it three of them.
    assert {layout["symmetry"] for layout in said.answer["layouts"]} <= {3, 6}


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (("nowhere.toml",), "there is no such file"),
        (("stage.toml", "--apply", "1"), "--apply writes a layout: say where, with -o FILE.dat"),
        (("stage.toml", "--apply", "99", "-o", "x.dat"), "there is no layout 99"),
        (("stage.toml", "--apply", "0", "-o", "x.dat"), "0"),
        (("stage.toml", "--explain", "--apply", "1", "-o", "x.dat"), "--explain finds no layouts"),
        (("stage.toml", "-o", "x.doc"), "the suffix of x.doc is to be one of"),
        (("stage.toml", "-o", "stage.toml"), "stage.toml"),
        (("stage.toml", "--body", "stage"), "--body is for a deck"),
        (("stage.toml", "--wanted", "rotation x"), "--wanted is for a deck"),
        (("stage.toml", "--rank", "beauty"), "beauty"),
        (("stage.toml", "--kinds", "wires, springs"), "springs"),
        (("stage.toml", "--symmetry", "5-fold about w"), "5-fold about w"),
        (("stage.toml", "-n", "0"), "0"),
        (("stage.toml", "--explain", "--refine"), "--refine"),
        ((), "PROBLEM"),
    ],
)
def test_what_cannot_be_done_is_said_and_nothing_is_written(
    at: Path, capsys: pytest.CaptureFixture[str], words: tuple[str, ...], says: str
) -> None:
    before = {path.name: path.read_bytes() for path in at.iterdir()}
    said = Said(capsys, *words)
    assert said.code == 2 and says in said.err and "Traceback" not in said.err
    assert {path.name: path.read_bytes() for path in at.iterdir()} == before


def test_all_that_is_wrong_in_a_problem_is_said_at_once(
    at: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (at / "bad.toml").write_text(
        STAGE.replace("planar z", "planr z").replace("0.8", '"0.8 kg"').replace("mass", "mas"),
        encoding="utf-8",
    )
    said = Said(capsys, "bad.toml", "--json")
    assert said.code == 2 and json.loads(said.out)["error"]["errors"] == 4
    assert all(each in said.err for each in ("planr", "0.8 kg", "'mas'", " errors"))
    assert " --> bad.toml:2:" in said.err and " --> bad.toml:12:" in said.err
