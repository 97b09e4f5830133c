# SPDX-License-Identifier: BSD-3-Clause
"""Tables at a point: principal stiffnesses and centres of textbook cases, frames, files."""

from __future__ import annotations

import csv
import io
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from json_schema import schema, strict
from stiffness_decks import EA, EI, EI_IN, GJ, LENGTH, cantilever, deck, elastic, guide

import flexact
from flexact.apps.cli.main import main

ROOT = Path(__file__).resolve().parents[2]
SIX = str(ROOT / "input_decks" / "paper" / "six_folded_sheets.dat")
NOTCHES = str(ROOT / "input_decks" / "flexures" / "notch_guide.dat")
TURN = np.linalg.qr(np.array([[1.0, 2.0, -0.5], [0.3, -1.0, 2.0], [2.0, 0.7, 1.0]]))[0]
TURN = TURN * np.sign(np.linalg.det(TURN))


def principal(table: Any, kind: str) -> list[float]:
    return [each.stiffness for each in table.principal if each.kind == kind]


def test_a_cantilever_has_its_centre_of_compliance_in_its_middle() -> None:
    """12 EI/L^3 without a turn, EI/L of a couple, both about L/2 (any textbook)."""
    table = elastic(cantilever()).undeformed().table(3)
    np.testing.assert_allclose(table.centre, (0, 0, LENGTH / 2), atol=1e-9)
    np.testing.assert_allclose(table.centre_of_stiffness, (0, 0, LENGTH / 2), atol=1e-9)
    wanted = 12 * EI / LENGTH**3, 12 * EI_IN / LENGTH**3, EA / LENGTH
    np.testing.assert_allclose(principal(table, "translation"), wanted, rtol=1e-9)
    wanted = EI / LENGTH, GJ / LENGTH, EI_IN / LENGTH
    np.testing.assert_allclose(principal(table, "rotation"), wanted, rtol=1e-9)
    for each in table.principal:
        assert each.pitch == pytest.approx(0.0, abs=1e-9)
        # Every line goes through the centre.
        arm = np.array([0, 0, LENGTH / 2]) - each.through
        np.testing.assert_allclose(np.cross(arm, each.direction), 0.0, atol=1e-9)


def test_principal_stiffnesses_of_a_parallel_guide() -> None:
    """Two sheets, 2b apart: 24 EI/L^3, 24 EI_in/L^3, 2 EA/L; 2 EI_in/L, 2 EI/L + 2 b^2 EA/L and
    2 GJ/L + 2 b^2 12 EI_in/L^3 (each sheet with its centre in its middle, b from the stage's).
    """
    table = elastic(guide()).undeformed().table(9)
    b, across = 0.025, 12 * EI_IN / LENGTH**3
    wanted = 24 * EI / LENGTH**3, 2 * across, 2 * EA / LENGTH
    np.testing.assert_allclose(principal(table, "translation"), wanted, rtol=1e-9)
    wanted = (
        2 * GJ / LENGTH + 2 * b**2 * across,
        2 * EI_IN / LENGTH,
        2 * EI / LENGTH + 2 * b**2 * EA / LENGTH,
    )
    np.testing.assert_allclose(principal(table, "rotation"), sorted(wanted), rtol=1e-9)
    np.testing.assert_allclose(table.centre, (b, 0, LENGTH / 2), atol=1e-9)


def test_a_cross_hinge_turns_about_its_crossing() -> None:
    """Two sheets that cross at right angles in their middles: 2 EI/L, EA/L + 12 EI/L^3."""
    a = LENGTH / math.sqrt(2.0)
    text = deck(
        f"PLBEAM 1 1 2 3 4\nPLBEAM 2 5 6 7 8\nPLBEAM 3 3 4 7 8\nX 3 {a} {a}\nX 5 {a} 0\nX 7 0 {a}\n"
        "FIX 1\nFIX 2\nFIX 5\nFIX 6\nRLSE 1 2 3\nRLSE 2 2 3",
        f"ESTIFF 1 {EA} {EI}\nESTIFF 2 {EA} {EI}",
    )
    table = elastic(text).undeformed().table(3)
    np.testing.assert_allclose(table.centre, (a / 2, a / 2, 0), atol=1e-9)
    assert principal(table, "rotation") == pytest.approx([2 * EI / LENGTH], rel=1e-9)
    wanted = EA / LENGTH + 12 * EI / LENGTH**3
    assert principal(table, "translation") == pytest.approx([wanted] * 2, rel=1e-9)
    # Of equal ones those along the axes are told.
    directions = [each.direction for each in table.principal if each.kind == "translation"]
    np.testing.assert_allclose(directions, np.eye(3)[:2], atol=1e-7)


def two_springs(drive: str = "") -> str:
    """A rigid bar from 0 to 1 m on a spring of 1000 N/m at 0 and one of 3000 N/m at 1, and one
    of 500 N/m along it.
    """
    return deck(
        "PLBEAM 1 1 2 3 4\nPLTRUSS 2 5 1\nPLTRUSS 3 6 3\nPLTRUSS 4 7 1\nX 3 1 0\nX 5 0 -1\n"
        f"X 6 1 -1\nX 7 -1 0\nFIX 5\nFIX 6\nFIX 7\n{drive}",
        "ESTIFF 2 1000\nESTIFF 3 3000\nESTIFF 4 500",
    )


def test_two_springs_have_their_centre_between_them() -> None:
    """k2 L/(k1 + k2) from the first; k1 + k2; k1 k2 L^2/(k1 + k2) (any textbook)."""
    table = elastic(two_springs()).undeformed().table(1)
    np.testing.assert_allclose(table.centre, (0.75, 0, 0), atol=1e-12)
    assert principal(table, "translation") == pytest.approx([500.0, 4000.0])
    assert principal(table, "rotation") == pytest.approx([750.0])
    lines = {tuple(np.round(each.direction)): each.through for each in table.principal}
    np.testing.assert_allclose(lines[0, 1, 0], (0.75, 0, 0), atol=1e-12)
    assert "Centre of compliance at (0.75, 0, 0) m" in table.describe()


def test_principal_stiffnesses_depend_on_no_frame_and_no_point() -> None:
    straight = elastic(guide()).undeformed().table(9)
    turned = elastic(guide(turn=TURN, drive="")).undeformed()
    seen = turned.table(9, frame=TURN)
    size = np.sqrt(np.outer(*[np.diagonal(straight.stiffness)] * 2))
    assert np.abs((seen.stiffness - straight.stiffness) / size).max() < 1e-8
    size = np.sqrt(np.outer(*[np.diagonal(straight.compliance)] * 2))
    assert np.abs((seen.compliance - straight.compliance) / size).max() < 1e-8
    np.testing.assert_allclose(seen.centre, TURN @ straight.centre, atol=1e-9)
    for node, frame in ((9, "global"), (5, TURN.T)):
        other = turned.table(node, frame)
        for kind in ("translation", "rotation"):
            np.testing.assert_allclose(principal(other, kind), principal(straight, kind), rtol=1e-7)
    named = turned.table(9, "sheet 1")
    np.testing.assert_allclose(abs(named.axes[:, 0] @ TURN[:, 2]), 1.0)
    assert "axes of sheet 1" in named.describe()


def test_a_place_that_is_carried_is_as_a_node_there() -> None:
    """Node 5 is on the same body; at rest and on the way."""
    model = elastic(guide())
    for state in (model.undeformed(), *model.along(9, "x", [0.003], from_rest=True)):
        there, here = state.table(5), state.table(9, at=(0, 0, LENGTH))
        np.testing.assert_allclose(here.place, there.place, atol=1e-12)
        size = np.sqrt(np.outer(*[np.diagonal(there.compliance)] * 2))
        assert np.abs((here.compliance - there.compliance) / size).max() < 1e-6
        np.testing.assert_allclose(here.centre_of_compliance, there.centre_of_compliance, atol=1e-6)
    table = model.undeformed().table(9)
    np.testing.assert_array_equal(table.compliance, model.undeformed().compliance(9))
    np.testing.assert_array_equal(table.stiffness, model.undeformed().stiffness(9))


def test_what_is_held_and_what_is_loose_is_said() -> None:
    locked = elastic(guide(), drive="locked").undeformed().table(9)
    assert principal(locked, "translation")[2] == math.inf
    assert "translation along x: held" in locked.describe()
    hinge = deck(
        "HINGE 1 1 2 0 0 1\nBEAM 2 3 2 4 5 0 1 0\nX 4 0.1 0 0\nFIX 3\nFIX 1\nRLSE 1 1",
        "ESTIFF 2 1E6 10 10 10\n",
    )
    loose = elastic(hinge, held="elastic").undeformed().table(4)
    turning = next(
        each for each in loose.principal if each.stiffness == 0.0 and each.through is not None
    )
    np.testing.assert_allclose(np.abs(turning.direction), (0, 0, 1), atol=1e-9)
    np.testing.assert_allclose(turning.through, (0, 0, 0), atol=1e-9)
    assert loose.centre is None
    assert "motion without stiffness" in loose.centre_words
    assert "no stiffness" in loose.describe()
    bars = elastic(deck("TRUSS 1 1 2\nX 2 1 0 0\nFIX 1", "ESTIFF 1 2E5")).undeformed().table(2)
    assert "nothing turns" in bars.centre_words
    none = flexact.elastic(NOTCHES).undeformed().table(14)
    assert none.centre is None
    assert none.coupling > 0.5
    assert none.centre_words.startswith("No centre of compliance: there is no place that couples")


def test_what_is_wrong_is_said_in_words() -> None:
    state = elastic(guide()).undeformed()
    for frame, words in (
        ("foo", "no part called 'foo'"),
        (np.eye(2), "3 x 3 rotation"),
        (2 * np.eye(3), "3 x 3 rotation"),
        (-np.eye(3), "right-handed"),
        (None, "not by None"),
    ):
        with pytest.raises((flexact.FlexactError, TypeError), match=words):
            state.table(9, frame)
    with pytest.raises(flexact.FlexactError, match="no point named 'stage'"):
        state.table("stage")
    bar = elastic(deck("TRUSS 1 1 2\nX 2 1 0 0\nFIX 1", "ESTIFF 1 2E5")).undeformed()
    with pytest.raises(flexact.ElasticError, match="carries no other place"):
        bar.table(2, at=(0, 0, 1))
    with pytest.raises(flexact.ElasticError, match="one value at least"):
        elastic(guide()).stroke_table(9, "x", [])


def test_parasitic_motion_of_a_parallel_guide() -> None:
    """It sinks by 3 x^2/5 L to first order (any textbook), and the force begins as 24 EI/L^3."""
    table = elastic(guide()).stroke_table(
        9, "x", ["-1 mm", "0 mm", "1 mm"], from_rest=True, of=9, at=(0.025, 0, 0.1)
    )
    sink = table.motion[:, table.directions.index("z")]
    np.testing.assert_allclose(sink[[0, 2]], -0.6 * 1e-6 / LENGTH, rtol=1e-3)
    np.testing.assert_allclose(
        table.force, 24e-3 * EI / LENGTH**3 * np.array([-1, 0, 1]), rtol=1e-2
    )
    assert table.parasitic.tolist() == [False, True, True, True, True, True]
    rest = elastic(guide()).undeformed().table(9, at=(0.025, 0, 0.1))
    np.testing.assert_allclose(table.stiffness[1], 1 / np.diagonal(rest.compliance), rtol=1e-9)
    assert "largest parasitic motion" in table.describe()
    assert "none" in table.describe()
    turned = elastic(guide()).stroke_table(
        9, "x", [0.026], frame=[[0, 0, 1], [1, 0, 0], [0, 1, 0]], of="body 3"
    )
    assert turned.motion[0, 2] == pytest.approx(0.001, rel=1e-9)
    assert turned.parasitic.tolist() == [True, True, False, True, True, True]


def test_files_hold_the_same_numbers(tmp_path: Path) -> None:
    model = elastic(guide(), drive="locked")
    table = model.undeformed().table(9)
    for name in ("t.csv", "t.json", "t.png", "t.svg"):
        table.save(tmp_path / name)
    rows = list(csv.DictReader(io.StringIO((tmp_path / "t.csv").read_text())))
    found = json.loads((tmp_path / "t.json").read_text())
    assert found == table.to_dict()
    for what in ("stiffness", "compliance"):
        cells = [float(row["value"]) for row in rows if row["quantity"] == what]
        numbers = [x if x is not None else math.inf for row in found[what] for x in row]
        assert cells == numbers == getattr(table, what).ravel().tolist()
    assert [r["unit"] for r in rows if r["quantity"] == "stiffness"][:4] == ["N/m"] * 3 + ["N"]
    centre = [float(row["value"]) for row in rows if row["quantity"] == "centre of compliance"]
    assert centre == found["centre"]
    stroke = model.stroke_table(9, "x", [0.024, 0.026])
    text = stroke.to_csv(tmp_path / "s.csv")
    stroke.save(tmp_path / "s.png")
    assert (tmp_path / "s.csv").read_text() == text
    heads, *numbers = csv.reader(io.StringIO(text))
    columns = stroke.to_dict()["columns"]
    assert heads == [f"{each['name']} [{each['unit']}]" for each in columns]
    for k, each in enumerate(columns):
        values = [math.inf if v is None else v for v in each["values"]]
        assert [float(row[k]) for row in numbers] == values
    with pytest.raises(flexact.FlexactError, match="suffix"):
        table.save(tmp_path / "t.txt")


def test_millimetres_change_the_numbers_and_nothing_else() -> None:
    """N/mm is 1000 N/m; N mm/rad a thousandth of N m/rad."""
    made = {}
    for units, size in (("m", 1.0), ("mm", 1000.0)):
        model = flexact.Model(units=units)
        places = [(0, 0, 0), (0.05, 0, 0), (0, 0, 0.1), (0.05, 0, 0.1)]
        a, b, c, d = (model.node(*(size * x for x in place)) for place in places)
        how = {"thickness": 5e-4 * size, "breadth": 0.05 * size, "material": "steel"}
        model.sheet(a, c, "y", **how)
        model.sheet(b, d, "y", **how)
        model.body([c, d], "stage")
        model.fix(a, b)
        made[units] = flexact.elastic(model).undeformed().table("stage")
    one, two = made["m"], made["mm"]
    factor = np.array([1.0, 1.0, 1.0, 1e3, 1e3, 1e3])
    both = np.outer(factor, factor) * 1e-3
    np.testing.assert_allclose(two.stiffness, one.stiffness * both, rtol=1e-7, atol=1e-6)
    np.testing.assert_allclose(two.centre, 1000 * one.centre, atol=1e-6)
    for kind, size in (("translation", 1e-3), ("rotation", 1e3)):
        wanted = size * np.array(principal(one, kind))
        np.testing.assert_allclose(principal(two, kind), wanted, rtol=1e-7)
    assert "N/mm" in two.describe()
    assert two.to_dict()["units"]["N m/rad"] == "N mm/rad"


@pytest.mark.parametrize(
    "words",
    [
        (),
        ("--stroke", "1:z=+-1mm", "--points", "3"),
        ("--warm", "10", "--expansion", "12e-6", "--at", "2"),
        ("--warm=-5K", "--expansion", "12ppm/K", "--gradient", "0,0,5K/m", "--ground", "5,11e-6"),
    ],
)
def test_the_command_says_and_writes_them(
    words: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    jsonschema = pytest.importorskip("jsonschema")
    call = ["table", SIX, "--beams", "1", *words]
    target = tmp_path / "x.csv"
    assert main([*call, "-o", str(target)]) == 0
    assert "axes of the model" in capsys.readouterr().out
    assert main([*call, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    jsonschema.Draft202012Validator(strict(schema("table"))).validate(found)
    assert ("warmed" in found) == any(word.startswith("--warm") for word in words)
    assert main([*call, "-o", "-"]) == 0
    assert capsys.readouterr().out == target.read_text()


@pytest.mark.parametrize("stroke", ["1:z=+-1mm", "1:z=+-1", "1:z+=-1..1mm", "1:z=29..31"])
def test_a_stroke_without_a_unit_is_in_those_of_the_model(
    stroke: str, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["table", SIX, "--beams", "1", "--units", "mm", "--points", "3", "--stroke", stroke]
    assert main(words) == 0
    assert "from 29 to 31 mm" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--points", "3"), "--stroke"),
        (("--expansion", "1e-5"), "--warm"),
        (("--warm", "10"), "EXPANSION"),
        (("--warm", "10 N"), "a force"),
        (("--place", "1,2"), "3 numbers"),
        (("--at", "stage"), "no point named 'stage'"),
        (("--frame", "stage"), "no part called 'stage'"),
        (("--stroke", "1:z=1"), "a stroke is written"),
        (("--beams", "x"), "whole number"),
        (("--json", "-o", "-"), "choose one"),
        (("-o", "x.txt"), ".csv"),
    ],
)
def test_the_command_says_what_is_wrong(
    words: tuple[str, ...], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["table", SIX, *words]) in (1, 2)
    assert said in capsys.readouterr().err
