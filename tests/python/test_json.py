# SPDX-License-Identifier: BSD-3-Clause
"""The JSON: valid against its schema, in physical quantities, and with all that the text says."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from json_numbers import assert_all_told, walk
from json_schema import RESULT, assert_valid, schema
from known_models import folded_sheet, ring, sheet_clamped_twice, twelve_trusses
from large_results import changed, first_of
from reference_decks import ROOT, UNDIVIDED
from small_decks import BROKEN, DECKS, json_lines, write
from test_margin import two_wires
from test_wording import RESULTS

import flexact
from flexact import Analysis, Model, analyse
from flexact.advice.describe import describe
from flexact.apps.cli.main import main

pytestmark = pytest.mark.dear(80)

INPUT = ROOT / "input_decks"
PATHS = sorted(path for path in INPUT.rglob("*.dat") if path.parent.name != "broken")


def grid(n: int) -> Model:
    """Square meshes of bars that stand on the ground and sway, one row of them braced."""
    model = Model(planar=True)
    nodes = [[model.node(i, j) for i in range(n)] for j in range(n)]
    for node in nodes[0]:
        model.fix(node)
    for j in range(1, n):
        for i in range(n):
            model.truss(nodes[j][i], nodes[j - 1][i])
        for i in range(1, n):
            model.truss(nodes[j][i], nodes[j][i - 1])
    for i in range(1, n):
        model.truss(nodes[0][i - 1], nodes[1][i])
    return model


def without_columns() -> Model:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    model.truss(a, b)
    model.fix(a)
    model.fix(b)
    return model


def without_rows() -> Model:
    model = Model()
    model.release(model.truss(model.node(0, 0, 0), model.node(1, 0, 0)))
    return model


def part_given() -> Analysis:
    whole = analyse(folded_sheet(False, beams=4))
    return changed(whole, motions=first_of(whole.raw.motions, 3))


MODELS: dict[str, Callable[[], Analysis]] = {
    **RESULTS,
    "no columns": lambda: analyse(without_columns()),
    "no rows": lambda: analyse(without_rows()),
    "clamped twice": lambda: analyse(sheet_clamped_twice()),
    "some motions given": part_given,
    "far from others": lambda: analyse(ring(5), accuracy=1e-3),
    "marginal": lambda: analyse(two_wires(1e-5), accuracy=20e-6),
    "marginal by angle": lambda: analyse(two_wires(1e-5), accuracy=(1e-6, 20e-6)),
    "aligned": lambda: analyse(twelve_trusses(), accuracy=(20e-6, 1e-4)),
    "tolerance": lambda: analyse(twelve_trusses(), tolerance=1e-6),
    "named": lambda: analyse(twelve_trusses(), name='a "b" \u00e9 \udcff\n'),
}


@pytest.mark.parametrize("name", MODELS)
def test_results_of_models_are_valid_and_hold_what_the_text_says(name: str) -> None:
    analysis = MODELS[name]()
    made = analysis.to_dict()
    assert_valid(made)
    text = analysis.to_json()
    assert json.loads(text) == made and text == json.dumps(made)
    assert_all_told(describe(analysis, verbose=True), made)


@pytest.mark.grid
@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_results_of_decks_are_valid_and_hold_what_the_text_says(path: Path) -> None:
    for chosen in ({}, {"accuracy": (20e-6, 1e-4)}, {"prove": False}):
        analysis = analyse(path, **chosen)
        made = json.loads(analysis.to_json())
        assert_valid(made)
        assert_all_told(describe(analysis, verbose=True), made)


def accuracies(made: dict[str, Any]) -> list[dict[str, Any]]:
    return [made["accuracy"], made["usual_accuracy"]]


def test_a_number_that_the_json_lacks_is_found() -> None:
    """Of the comparison itself: it sees each kind of number that is not there, or is of another."""
    whole = analyse(flexact.read_text(guide().to_deck()), accuracy=20e-6)
    close = analyse(two_wires(1e-5), accuracy=20e-6)
    hinge = analyse(INPUT / "linkages" / "bennett.dat")

    def without(key: str, name: str) -> Callable[[dict[str, Any]], object]:
        return lambda made: [each.pop(name, None) for each in walk(made[key])]

    for of, change in (
        (whole, lambda made: [each.update(unit="N") for each in walk(made["self_stresses"])]),
        (whole, without("self_stresses", "value")),
        (whole, lambda made: made["advice"][0].update(statements=[])),
        (whole, lambda made: [each["length"].update(unit="rad") for each in accuracies(made)]),
        (whole, lambda made: made["counts"]["coordinates"].update(total=77)),
        (whole, lambda made: made.update(condition_number=None)),
        (close, lambda made: (made["margin"].update(length=None), made.update(margins=[]))),
        (hinge, without("motions", "direction")),
        (hinge, without("motions", "point")),
        (hinge, without("motions", "pitch")),
        (hinge, without("advice", "words")),
    ):
        assert_all_told(describe(of, verbose=True), of.to_dict())
        made = of.to_dict()
        change(made)
        with pytest.raises(AssertionError):
            assert_all_told(describe(of, verbose=True), made)


def test_a_large_result_is_valid() -> None:
    """Each row of joints above the braced one sways by itself: n - 2 motions."""
    analysis = analyse(grid(60))
    assert analysis.method == "sparse" and analysis.under_constrained == 58
    made = analysis.to_dict()
    assert_valid(made)
    assert json.loads(analysis.to_json()) == made
    assert sum(len(each["components"]) for each in made["motions"]) > 58 * 60 - 1


def test_every_line_of_the_command_is_valid(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Broken decks, a folder without decks, a deck that is not there, and sound ones."""
    (tmp_path / "empty").mkdir()
    for name, text in {**DECKS, "broken": BROKEN}.items():
        write(tmp_path / f"{name}.dat", text)
    paths = (INPUT / "broken", tmp_path, tmp_path / "empty", tmp_path / "missing.dat")
    assert main(["analyse", "--json", "--accuracy", "1e-3,1e-3", *map(str, paths)]) == 1
    lines = json_lines(capsys.readouterr().out)
    for line in lines:
        assert_valid(line)
    assert sum("verdict" in line for line in lines) >= len(DECKS)
    assert sum("error" in line for line in lines) > 30


def test_files_hold_what_the_command_prints(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    deck = write(tmp_path / "both.dat", DECKS["both"])
    words = ["analyse", "--json", str(deck), "-o", str(tmp_path), "--accuracy", "1e-3"]
    assert main(words) == 0
    (line,) = json_lines(capsys.readouterr().out)
    assert json.loads((tmp_path / "both.json").read_text(encoding="utf-8")) == line
    assert line["accuracy"]["length"] == {"value": 1e-3, "unit": "m"}


# The schema


def test_the_schema_is_one_and_refuses_what_is_wrong() -> None:
    jsonschema.Draft202012Validator.check_schema(schema())
    made = analyse(twelve_trusses()).to_dict()
    whole = jsonschema.Draft202012Validator(schema())
    assert whole.is_valid(made) and RESULT.is_valid(made)

    def spoiled(change: Callable[[dict[str, Any]], object]) -> dict[str, Any]:
        other = copy.deepcopy(made)
        change(other)
        return other

    for change in (
        lambda each: each.pop("margin"),
        lambda each: each.update(format=1),
        lambda each: each.update(verdict="certain"),
        lambda each: each.update(certainty="certain"),
        lambda each: each["motions"][0]["components"][0].pop("unit"),
        lambda each: each["motions"][0]["components"][0].update(unit="rad"),
        lambda each: each["self_stresses"][0]["components"][0].update(unit="m"),
        lambda each: each["self_stresses"][0]["components"][0].pop("keyword"),
        lambda each: each["advice"][0]["parts"][0].pop("node"),
        lambda each: each["margin"].pop("exact_alignment"),
    ):
        assert not whole.is_valid(spoiled(change))
    more = spoiled(lambda each: each.update(more=[]))
    assert whole.is_valid(more) and not RESULT.is_valid(more), "names may be added"


def test_the_number_of_the_format_is_that_of_the_schema_and_the_manual() -> None:
    number = schema()["$defs"]["result"]["properties"]["format"]["const"]
    assert analyse(ring(3)).to_dict()["format"] == number
    assert f'`"format": {number}`' in (ROOT / "docs" / "command.md").read_text("utf-8")


# Physical quantities


def guide() -> Model:
    """Two sheets 0.1 m long that hold a stage of 0.05 m between them."""
    model = Model(name="guide")
    ground = [model.node(0.0, y, 0.0) for y in (0.0, 0.05)]
    stage = [model.node(0.1, y, 0.0) for y in (0.0, 0.05)]
    for k in (0, 1):
        model.fix(ground[k])
        model.sheet(ground[k], stage[k], width=(0, 0, 1), name=f"sheet {k + 1}")
    model.rigid(stage[0], stage[1], name="stage")
    model.independent(stage[0], "y")
    return model


def test_a_self_stress_is_in_newton_metres_beside_the_raw_column() -> None:
    """By hand: the torsion of the stage is the end moment of each sheet, so all are of one size.

    The raw column has sigma, the moment over the length of each beam: 0.1, 0.1 and 0.05 m.
    """
    (stress,) = analyse(guide()).to_dict()["self_stresses"]
    found = [
        (each["element"], each["name"], each["keyword"], each["deformation"], each["unit"])
        for each in stress["components"]
    ]
    assert found == [
        *((1, "sheet 1", "BEAM", k, "N m") for k in (3, 4)),
        *((2, "sheet 2", "BEAM", k, "N m") for k in (3, 4)),
        (3, "stage", "BEAM", 2, "N m"),
    ]
    sizes = [abs(each["value"]) for each in stress["components"]]
    assert sizes == pytest.approx([sizes[0]] * 5, rel=1e-12)
    lengths = [each["value"] / each["raw"] for each in stress["components"]]
    assert lengths == pytest.approx([0.1, 0.1, 0.1, 0.1, 0.05], rel=1e-12)
    assert stress["components"][-1]["word"] == "torsion"


@pytest.mark.parametrize("name", UNDIVIDED)
def test_components_are_those_of_motions_and_self_stresses(name: str) -> None:
    """Where a sheet is one beam; of others see test_divided_sheets.py."""
    analysis = analyse(INPUT / f"{name}.dat")
    made, model = analysis.to_dict(), analysis.model
    for motion, mode in zip(analysis.motions, made["motions"], strict=True):
        moved, turned = np.zeros_like(motion.displacement), np.zeros_like(motion.rotation)
        for each in mode["components"]:
            into = moved if each["unit"] == "m" else turned
            axis = "xyz".index(each["coordinate"][-1])
            into[model.node_index(each["node"]), axis] = each["value"]
        # Inner nodes of a sheet that counts as one beam follow from its ends.
        told = list(map(model.node_index, analysis.data.arrays.node_number.tolist()))
        assert moved[told] == pytest.approx(motion.displacement[told], abs=1e-13)
        rounding = 1e-13 * max(1.0, np.abs(motion.rotation).max())
        assert turned[told] == pytest.approx(motion.rotation[told], abs=rounding)
    for stress, mode in zip(analysis.self_stresses, made["self_stresses"], strict=True):
        found = {unit: np.zeros_like(stress.forces) for unit in ("N", "N m")}
        for each in mode["components"]:
            index = model.element_index(each["element"])
            assert each["name"] == analysis.given.element_names[index]
            found[each["unit"]][index, each["deformation"] - 1] = each["value"]
        # So do the beams within it: what is told is at its ends.
        for unit, whole in (("N", stress.forces), ("N m", stress.moments)):
            there = found[unit] != 0.0
            # The frame of a sheet that is bent is not that of its first and last beam.
            near = {"rel": 0.01} if analysis.condensed.chains else {"abs": 1e-12}
            assert found[unit][there] == pytest.approx(whole[there], **near)
            assert analysis.condensed.chains or not np.abs(whole[~there]).max(initial=0.0) > 1e-13


def test_freedoms_say_how_the_mechanism_moves() -> None:
    """The stage of a parallel guide goes along y with both of its nodes, and does not turn."""
    (freedom,) = analyse(guide()).to_dict()["freedoms"]
    assert (freedom["label"], freedom["moves"]) == ("the stage along y", True)
    assert (freedom["node"], freedom["coordinate"]) == (5, "y")
    found = {
        (each["node"], each["coordinate"]): (each["value"], each["unit"])
        for each in freedom["largest"]
    }
    assert found == {(5, "y"): (pytest.approx(1.0), "m"), (7, "y"): (pytest.approx(1.0), "m")}


def test_a_freedom_that_cannot_move_says_so() -> None:
    deck = INPUT / "flexures" / "folded_sheet_clamped_trap.dat"
    analysis = analyse(deck)
    made = analysis.to_dict()["freedoms"]
    assert [each["moves"] for each in made] == [
        each.motion is not None for each in analysis.freedoms
    ]
    assert not any(each["moves"] for each in made) and made
    assert all(each["largest"] == [] for each in made)


def test_freedoms_of_a_very_large_model_are_listed_without_their_motions(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("flexact.analysis.json._MOST_ELEMENTS", 2)
    (freedom,) = analyse(guide()).to_dict()["freedoms"]
    assert (freedom["label"], freedom["moves"], freedom["largest"]) == (
        "the stage along y",
        None,
        [],
    )


def test_advice_is_made_when_it_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    """By `to_dict`, not by `analyse`; each piece of it is as in the text."""
    asked = []
    from flexact.analysis import json as json_parts

    plain = json_parts.on_self_stresses
    monkeypatch.setattr(json_parts, "on_self_stresses", lambda of: asked.append(of) or plain(of))
    analysis = analyse(guide())
    assert not asked
    advice = analysis.to_dict()["advice"]
    assert asked == [analysis]
    assert [(each["about"], each["removes"], each["step"]) for each in advice] == [
        ("self_stresses", "one", "release one deformation"),
        ("self_stresses", "one", "free one support"),
    ]
    first = advice[0]["parts"][0]
    assert (first["element"], first["name"], first["deformation"]) == (1, "sheet 1", 3)
    assert advice[0]["statements"] == [{"keyword": "RLSE", "operands": "1 3"}]
    assert {part["coordinate"] for part in advice[1]["parts"]} == {"ry"}


def test_following_the_advice_of_the_json_removes_the_self_stress() -> None:
    model = guide()
    (statement,) = analyse(model).to_dict()["advice"][0]["statements"]
    released = f"{statement['keyword']} {statement['operands']}"
    deck = model.to_deck().replace("END\n", f"{released}\nEND\n", 1)
    assert released in deck
    assert analyse(flexact.read_text(deck)).verdict is flexact.Verdict.EXACT
