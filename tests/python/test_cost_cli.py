# SPDX-License-Identifier: BSD-3-Clause
"""The verb cost: what it prints and writes, how options are read, what is refused and how."""

import csv
import io
import json
import math
from pathlib import Path

import jsonschema
import pytest
from json_schema import schema, strict
from reference_decks import ROOT

import flexact
from flexact.apps.cli.main import main
from flexact.costs.designs import Number, in_words
from flexact.costs.json import HEADER
from flexact.costs.request import (
    RequestError,
    misalignment_of,
    release_of,
    shift_of,
    stroke_of,
)
from flexact.util.quantities import QuantityError, quantity

SIX = ROOT / "input_decks" / "paper" / "six_folded_sheets.dat"
#: Two sheets that guide a stage, of case A03; with masses.
GUIDE = """\
BEAM 1 1 2 5 6 0 1 0   % left
BEAM 2 3 4 7 8 0 1 0   % right
BEAM 3 5 6 7 8         % stage
X 3 0.05 0 0
X 5 0 0 0.1
X 7 0.05 0 0.1
FIX 1
FIX 2
FIX 3
FIX 4
RLSE 1 2 3 4
RLSE 2 2 3 4
DYNX 5 1
END
HALT
ESTIFF 1 5250000 0.167 0.109375 1093.75
ESTIFF 2 5250000 0.167 0.109375 1093.75
EM 1 0.195
EM 2 0.195
XM 5 0.5
END
END
"""
VALID = jsonschema.Draft202012Validator(strict(schema("cost")))


@pytest.fixture
def guide(tmp_path: Path) -> Path:
    path = tmp_path / "guide.dat"
    path.write_text(GUIDE, encoding="utf-8")
    return path


def run(*words: object) -> int:
    return main(["cost", *map(str, words)])


def assert_valid(made: dict[str, object]) -> None:
    wrong = [f"{each.json_path}: {each.message[:300]}" for each in VALID.iter_errors(made)]
    assert not wrong, wrong[:5]


# What is printed


def test_the_words_fit_a_screen_and_say_what_was_chosen(
    guide: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """By default: refined by itself, and with the proven releases."""
    assert run(guide) == 0
    told = capsys.readouterr().out
    lines = told.splitlines()
    # The first one is the path.
    assert max(map(len, lines[1:])) <= 80
    assert lines[1].startswith("It costs: clamp ") and " +- " in lines[1]
    assert "elastic" in told and "drive\nfree" in told.replace("drive free", "drive\nfree")
    for label in ("as built", "1:5", "1:6"):
        assert any(line.startswith(label) for line in lines)


def test_options_with_minus_signs_and_units_are_read(
    guide: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ("--beams", 1, "--release", "1:5+2:5=3.5", "--shift", "-10%", "--drive", "locked")
    more = ("--misalign", "1:y=-5um", "--stroke", "5:x+=-1mm..1mm", "--points", 3, "--at", "7")
    assert run(guide, *words, *more, "--json") == 0
    made = json.loads(capsys.readouterr().out)
    assert_valid(made)
    assert made["choice"] == {
        "held": "elastic",
        "drive": "locked",
        "beams": 1,
        "shift": -0.1,
        "measure": "first frequency",
    }
    assert made["point"]["node"] == 7
    assert [design["label"] for design in made["designs"]] == ["as built", "1:5+2:5=3.5"]
    assert made["misaligned"][0]["value"] == -5e-6
    assert made["designs"][0]["stroke"]["values"] == [-0.001, 0.0, 0.001]


def test_files_are_written_by_their_suffix(guide: Path, tmp_path: Path) -> None:
    table, stored = tmp_path / "cost.csv", tmp_path / "cost.json"
    options = ("--beams", 2, "--stroke", "5:x=0..1mm", "--points", 2, "--misalign", "1:y=1um")
    assert run(guide, *options, "-o", table, "-o", stored) == 0
    made = json.loads(stored.read_text(encoding="utf-8"))
    assert_valid(made)
    rows = list(csv.DictReader(io.StringIO(table.read_text(encoding="utf-8"))))
    assert tuple(rows[0]) == HEADER
    assert {row["design"] for row in rows} == {each["label"] for each in made["designs"]}
    tolerances = [row for row in rows if row["quantity"] == "buckles above zero"]
    assert len(tolerances) == 12 * len(made["designs"])
    first = next(row for row in tolerances if row["clamp"] == "1" and row["direction"] == "rx")
    known = made["designs"][0]["tolerances"][3]
    assert (known["clamp"], known["direction"]) == (1, "rx")
    assert float(first["value"]) == known["critical_positive"]["value"]
    assert all(math.isfinite(float(row["uncertainty"])) for row in rows)
    quantities = {row["quantity"] for row in rows}
    assert {"compliance", "stiffness kept", "support stiffness", "elastic energy"} <= quantities
    assert not [row for row in rows if row["value"] == "nan"]


def test_python_has_the_same(guide: Path, tmp_path: Path) -> None:
    made = flexact.cost(guide, beams=1, release=())
    assert_valid(made.to_dict())
    assert json.loads(made.to_json()) == made.to_dict()
    assert made.to_csv(tmp_path / "c.csv") == (tmp_path / "c.csv").read_text(encoding="utf-8")
    assert made.describe().startswith(str(guide))
    assert "It costs" in repr(made)
    made.save(tmp_path / "c.json")
    assert json.loads((tmp_path / "c.json").read_text(encoding="utf-8")) == made.to_dict()


# What is refused


def test_mistakes_in_options_are_told_all_at_once(
    guide: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    wrong = ("--release", "abc", "--misalign", "1:q=5", "--shift", "-500%", "--beams", "many")
    assert run(guide, *wrong) == 2
    told = capsys.readouterr().err
    assert told.count("flexact: error: ") == 4
    for word in ("'abc'", "'q'", "'-500%'", "'many'"):
        assert word in told


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (("--at", "99"), "no node 99"),
        (("--at", "nowhere"), "nowhere"),
        (("--misalign", "5:x=1um"), "does not hold x"),
        (("--misalign", "99:x=1um"), "no node 99"),
        (("--release", "1:7"), "no deformation 7"),
        (("--release", "9:1"), "no element 9"),
        (("--release", "1:5", "--release", "1:5"), "twice"),
        (("--stroke", "1:x=0..1"), "is fixed"),
        (("--stroke", "99:x=0..1"), "no node 99"),
        (("-o", "cost.xyz"), ".csv"),
    ],
)
def test_what_is_not_there_is_told(
    guide: Path, capsys: pytest.CaptureFixture[str], words: tuple[str, ...], part: str
) -> None:
    assert run(guide, "--beams", 1, *words) == (2 if "-o" in words else 1)
    told = capsys.readouterr().err
    assert part in told and "Traceback" not in told


def test_a_deck_without_stiffness_and_one_with_errors(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "bare.dat"
    path.write_text(GUIDE.split("END")[0], encoding="utf-8")
    assert run(path) == 1
    assert "ESTIFF" in capsys.readouterr().err
    path.write_text("BEAM 1 1 2\n", encoding="utf-8")
    assert run(path) == 1


def test_a_stroke_beyond_reach_says_how_far_and_exits_with_1(
    guide: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Rigid sheets of 0.1 m lead no farther than that."""
    options = ("--beams", 1, "--held", "rigid", "--release", "none", "--points", 3)
    assert run(guide, *options, "--stroke", "5:x=0..0.5", "--beyond") == 1
    told = capsys.readouterr()
    assert "reached from 0 to" in told.err
    reached = float(told.err.split("reached from 0 to ")[1].split(" ")[0])
    assert 0.0 < reached < 0.1
    assert "Stroke of node 5" in told.out


# How numbers are read and written


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("50um", "m", 50e-6),
        ("50 \N{MICRO SIGN}m", "m", 50e-6),
        ("-.1mm", "m", -1e-4),
        ("5e-5", "m", 5e-5),
        ("1mrad", "rad", 1e-3),
        ("2deg", "rad", math.pi / 90),
    ],
)
def test_lengths_and_angles(text: str, unit: str, value: float) -> None:
    assert quantity(text, unit) == pytest.approx(value, rel=1e-15)


def test_what_is_asked_for_is_read() -> None:
    assert release_of("1:5+2:5=1e+3") == {(1, 5): 0.0, (2, 5): 1000.0}
    assert release_of("none") == {}
    assert stroke_of("1:z=25mm..35mm")[:4] == (1, "z", 0.025, 0.035)
    assert stroke_of("upper 90, rim:z+=-5mm..5mm") == ("upper 90, rim", "z", -0.005, 0.005, True)
    assert misalignment_of("11:rx=1mrad@13") == (11, "rx", 1e-3, 13)
    assert shift_of("-5%") == -0.05 == shift_of(-0.05)


@pytest.mark.parametrize(
    ("read", "text"),
    [
        (release_of, "1"),
        (release_of, "1:5=-3"),
        (stroke_of, "1:z=5mm"),
        (stroke_of, "1:z=5mm..5mm"),
        (stroke_of, "1:z=5mrad..6mrad"),
        (misalignment_of, "11:x=5um@13"),
        (misalignment_of, "x=5um"),
        (shift_of, "0"),
        (shift_of, "-5"),
        (shift_of, "five"),
    ],
)
def test_what_is_not_understood(read: object, text: str) -> None:
    with pytest.raises((RequestError, QuantityError)):
        read(text)  # type: ignore[operator]


@pytest.mark.parametrize(
    ("number", "unit", "words"),
    [
        (Number(1.3083e-4, 2.3e-7), "m", "130.8 +- 0.3 um"),
        (Number(48.664e-6, 1.4e-7), "m", "48.7 +- 0.2 um"),
        (Number(0.167277, 1e-9), "", "0.1673"),
        (Number(math.inf), "m", "none"),
        (Number(306.1012, 0.0019), "Hz", "306.1 Hz"),
        (Number(0.0), "m", "0 m"),
    ],
)
def test_numbers_in_words(number: Number, unit: str, words: str) -> None:
    assert in_words(number, unit) == words
