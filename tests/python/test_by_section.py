# SPDX-License-Identifier: BSD-3-Clause
"""Tables of SPACAR Light by their sections: what is a sheet, a wire or a body, and what counts."""

from __future__ import annotations

import copy
import json
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from json_schema import schema

import flexact
from flexact.apps.cli.main import main
from flexact.apps.convert.script_results import Script, results_of, text_of_results
from flexact.apps.convert.tables import TablesError, model_of, tables_of
from flexact.deck.diagnostics import Severity

pytestmark = pytest.mark.dear(4)

ALL = [1, 2, 3, 4, 5, 6]
STEEL = {"emod": 200e9, "smod": 80e9, "dens": 8000}
SHEET: dict[str, Any] = {
    **{"cshape": "rect", "dim": [0.04, 0.0004], "orien": [0, 0, 1], "flex": ALL},
    **STEEL,
}
BODY: dict[str, Any] = {"cshape": "rect", "dim": [0.04, 0.008], "orien": [0, 0, 1], "dens": 2700}
#: Two sheets side by side, that carry a body.
GUIDE: dict[str, Any] = {
    "nodes": [[0, 0, 0], [0, 0.09, 0], [0.06, 0.09, 0], [0.06, 0, 0]],
    "elements": [[1, 2], [2, 3], [3, 4]],
    "nprops": [{"fix": True}, {}, {}, {"fix": True}],
    "eprops": [{"elems": [1, 3], **SHEET}, {"elems": [2], **BODY}],
}
#: The same sheets, crossed.
HINGE = {**GUIDE, "elements": [[1, 3], [2, 3], [2, 4]]}


def counts(tables: dict[str, Any], **more: Any) -> tuple[int, int]:
    analysis = flexact.analyse(model_of(tables, **more))
    return analysis.under_constrained, analysis.over_constrained


def changed(tables: dict[str, Any], **sheet: Any) -> dict[str, Any]:
    """The tables with other fields of their first set; of None without one."""
    made = copy.deepcopy(tables)
    made["eprops"][0] = {k: v for k, v in (made["eprops"][0] | sheet).items() if v is not None}
    return made


def moved(tables: dict[str, Any], node: int, **motion: Any) -> dict[str, Any]:
    made = copy.deepcopy(tables)
    made["nprops"][node - 1] = motion
    return made


@pytest.mark.parametrize("nbeams", [1, 2, 5])
def test_two_sheets_guide_or_turn_and_hold_one_direction_twice(nbeams: int) -> None:
    """A sheet holds three directions (Soemers, Design Principles for Precision Mechanisms, 2.3):
    two of them leave one motion and hold one direction twice."""
    for tables, motion in (
        (GUIDE, {"displ_x": 0.001}),
        (HINGE, {"rot_z": 0.1}),
    ):
        divided = changed(tables, nbeams=nbeams)
        assert counts(divided) == (1, 1)
        driven = model_of(moved(divided, 3, **motion))
        analysis = flexact.analyse(driven)
        assert (analysis.under_constrained, analysis.over_constrained) == (0, 1)
        assert len(analysis.freedoms) >= 1
    # As SPACAR Light counts, a loop and a prescribed motion.
    assert counts(GUIDE, flexible="independent") == (0, 6)
    assert counts(moved(GUIDE, 3, displ_x=0.001), flexible="independent") == (0, 7)


def test_three_sheets_about_one_axis_hold_four_times_too_often() -> None:
    """A steering mirror: two sheets side by side and one that crosses them. 9 conditions, of which
    5 are independent of each other."""
    mirror: dict[str, Any] = {
        "nodes": [
            *([0, 0.02, 0], [0.06, 0.02, 0.06], [0, 0.16, 0], [0.06, 0.16, 0.06]),
            *([0, 0.09, 0.06], [0.06, 0.09, 0], [0.06, 0.09, 0.06], [0.08, 0.09, 0.06]),
        ],
        "elements": [[1, 2], [3, 4], [5, 6], [7, 5], [2, 7], [4, 7], [8, 7]],
        "nprops": {"1": {"fix": True}, "3": {"fix": True}, "6": {"fix": True}},
        "eprops": [
            {**SHEET, "elems": [1, 2], "orien": [0, 1, 0]},
            {**SHEET, "elems": [3], "orien": [0, 1, 0], "dim": [0.09, 0.0004]},
            {"elems": [4, 5, 6, 7], "orien": [1, 0, 0]},
        ],
    }
    assert counts(mirror) == (1, 4)


@pytest.mark.parametrize(
    ("dim", "released"),
    [
        ([0.04, 0.0004], [2, 3, 4]),
        # The thickness lies along local y.
        ([0.0004, 0.04], [2, 5, 6]),
        ([0.005, 0.001], [2, 3, 4]),
        ([0.0499, 0.01], [2, 3, 4, 5, 6]),
        ([0.001, 0.001], [2, 3, 4, 5, 6]),
    ],
)
def test_the_section_says_what_is_released(dim: list[float], released: list[int]) -> None:
    model = model_of(changed(GUIDE, dim=dim))
    for beam in (0, 2):
        assert (np.flatnonzero(model.deformation_classes[beam] == 2) + 1).tolist() == released
    assert (model.deformation_classes[1] == 1).all()
    assert counts(changed(GUIDE, cshape="circ", dim=0.001)) == counts(
        changed(GUIDE, dim=[0.001, 0.001])
    )


def test_what_is_a_thousand_times_as_stiff_is_a_body_and_that_is_said() -> None:
    """E I of the sheets is 200e9 * 0.04 * 0.0004^3 / 12; of a bar of the same width ten times as
    thick it is a thousand times that, of one of nine times 729. Three sheets between two clamps
    have 9 conditions on the 12 motions of two points."""
    for thickness, kind, expected in ((0.004, "body", (1, 1)), (0.0036, "sheet", (3, 0))):
        tables = copy.deepcopy(GUIDE)
        tables["eprops"][1] = {**SHEET, "elems": [2], "dim": [0.04, thickness]}
        model = model_of(tables)
        (said,) = [each.message for each in model.diagnostics if "eprops[2]" in each.message]
        assert f"is a {kind}" in said and "as stiff in bending as the others" in said
        assert counts(tables) == expected
    # Among three sets the median; one alone is never a body.
    tables["eprops"] = [
        {**SHEET, "elems": [1]},
        {**SHEET, "elems": [2], "dim": [0.04, 0.2]},
        {**SHEET, "elems": [3], "dim": [0.04, 0.001]},
    ]
    assert "is a body" in " ".join(each.message for each in model_of(tables).diagnostics)
    assert "is a wire" in str(model_of(changed(GUIDE, dim=[0.2, 0.2])).diagnostics)


def test_without_a_section_it_is_a_sheet_and_a_warning() -> None:
    model = model_of(changed(GUIDE, cshape=None, dim=None, emod=None, smod=None, dens=None))
    (warning,) = [each for each in model.diagnostics if each.severity is Severity.WARNING]
    assert "taken for a sheet whose width is along orien" in warning.message
    assert counts(changed(GUIDE, cshape=None, dim=None, emod=None, smod=None, dens=None)) == (1, 1)


def test_fewer_are_released_as_they_are_said_and_what_is_missing_is_told() -> None:
    """A sheet that cannot twist holds four directions: two of them have three too many."""
    some = changed(GUIDE, flex=[2, 3, 4])
    assert counts(some) == (1, 1)
    messages = [each.message for each in model_of(some).diagnostics]
    assert messages == ["eprops[1], elements 1, 3: flex says 2-4: these are released"]
    stiff = changed(HINGE, flex=[3, 4])
    assert counts(stiff) == (1, 3)
    said = " ".join(each.message for each in model_of(stiff).diagnostics)
    assert "these are released; a flexure of this section releases torsion 2, too" in said


@pytest.mark.parametrize("bent", [False, True])
def test_elements_in_a_row_count_as_one_sheet(bent: bool) -> None:
    """Four elements of one set in place of each sheet, also where the row is a little bent."""
    tables = copy.deepcopy(GUIDE)
    for x in (0.0, 0.06):
        tables["nodes"] += [[x, 0.09 * k / 4, 0.004 * bent * (k % 2)] for k in (1, 2, 3)]
    tables["elements"] = [
        *([1, 5], [5, 6], [6, 7], [7, 2], [2, 3]),
        *([3, 10], [10, 9], [9, 8], [8, 4]),
    ]
    tables["eprops"][0]["elems"] = [1, 2, 3, 4, 6, 7, 8, 9]
    tables["eprops"][1]["elems"] = 5
    assert counts(tables) == (1, 1)
    # A motion of what is in between makes two of it.
    driven = {**tables, "nprops": [*tables["nprops"], {}, {"displ_z": 0.001}]}
    assert counts(driven)[0] > 0
    assert "sheet 1 and sheet 6 both hold" in flexact.analyse(model_of(tables)).describe()


def test_parts_and_points_have_the_numbers_of_the_script() -> None:
    model = model_of(changed(GUIDE, nbeams=3))
    assert "sheet 1 and sheet 3 both hold body 2" in flexact.analyse(model).describe()
    assert model.element_names[4] == "sheet 3, part 1 of 3"
    assert "point 4" in model.to_deck()
    # A name that is given stays that of what it was given to.
    other = changed(GUIDE, nbeams=2)
    other["eprops"][1]["name"], other["nprops"][3]["name"] = "sheet 1", "point 2"
    names = model_of(other)
    assert names.element_names[2] == "sheet 1" and names.element_names[0] == ""
    assert [name for name in names.node_names if name] == ["point 1", "point 3", "point 2"]
    named = copy.deepcopy(GUIDE)
    named["eprops"][0]["name"], named["nprops"][1] = "leaf", {"name": "tip"}
    assert {"leaf 1, part 2 of 2", "tip"} <= {
        *model_of(changed(named, nbeams=2)).element_names,
        *model_of(named).node_names,
    }


def test_releases_for_the_solver_are_told_and_not_taken_over() -> None:
    """Also of rigid elements, which SPACAR Light asks for where they make a loop; a joint in the
    body of the guide, that it twists, is said by its flex."""
    for place in ("rls", "opt"):
        rls: Any = [{"def": ALL}, {}, {"def": [3]}]
        tables = {**GUIDE, place: rls if place == "rls" else {"rls": rls}}
        assert counts(tables) == (1, 1)
        said = " ".join(each.message for each in model_of(tables).diagnostics)
        assert "rls, elements 1, 3: not taken over" in said
    assert counts({**GUIDE, "rls": rls[:1]}, flexible="independent") == (0, 0)
    joint = {**copy.deepcopy(GUIDE), "rls": [{}, {"def": [2]}]}
    assert counts(joint) == (1, 1)
    (said,) = [
        each.message for each in model_of(joint).diagnostics if each.severity is Severity.WARNING
    ]
    words = "it is rigid, and 2 stays held; if it is a joint, say so with flex"
    assert said == f"rls[2], element 2: {words}"
    joint["eprops"][1]["flex"] = 2
    assert counts(joint) == (1, 0)


def test_one_modulus_is_enough_for_what_is_rigid() -> None:
    tables = copy.deepcopy(GUIDE)
    tables["eprops"][1]["emod"] = 70e9
    assert counts(tables) == (1, 1)
    said = [each.message for each in model_of(tables).diagnostics]
    assert "eprops[2].emod without smod, of what is rigid (1)" in said
    with pytest.raises(TablesError, match=r"eprops\[1\]: emod and smod belong together: smod is"):
        model_of(changed(GUIDE, smod=None))


def test_a_hinge_turns_about_its_axis_where_nothing_else_is_said() -> None:
    tables: dict[str, Any] = {
        "nodes": [[0, 0, 0], [1, 0, 0], [1, 0, 0], [2, 0, 0]],
        "elements": [[1, 2], [2, 3], [3, 4]],
        "nprops": [{"fix": True}],
        "eprops": [{"elems": 2, "type": "hinge", "orien": [0, 0, 1]}],
    }
    assert counts(tables) == (1, 0)
    assert counts(tables, flexible="independent") == (0, 0)


def test_what_flexact_writes_of_a_deck_comes_back() -> None:
    """A deck may release or declare all deformations of a beam, whatever its section."""
    model = flexact.Model()
    beam = model.beam((0, 0, 0), (0.1, 0, 0), section=(0.04, 0.001), material="steel")
    model.fix((0, 0, 0))
    for mode in (1, 2, 3):
        model.independent(beam, mode)
    for mode in (4, 5, 6):
        model.release(beam, mode)
    tables = tables_of(model)
    assert tables["flexible"] == "independent"
    jsonschema.validate(tables, schema("tables"))
    again = model_of(tables)
    assert np.array_equal(again.deformation_classes, model.deformation_classes)
    assert counts(tables, flexible="by-section") == (3, 0)
    with pytest.raises(TablesError, match="flexible: one of by-section, independent, released"):
        model_of({**tables, "flexible": "all"})
    with pytest.raises(ValueError, match="flexible is one of"):
        model_of(tables, flexible="all")


def test_names_of_older_versions_are_those_of_today() -> None:
    """As in the versions of July 2017, in which rx was about z, and those up to 0.6."""
    older = {
        "Nodes": HINGE["nodes"],
        "Elements": HINGE["elements"],
        "Node_props": [{"fix_all": 1}, {}, {"disp_rx": 0.1, "inertia": [1, 0, 0, 1, 0, 1]}],
        "Elem_props": [
            {
                **{"El_Nrs": [1, 3], "E": 200e9, "G": 80e9, "rho": 8000, "type": "leafspring"},
                **{"dim": [0.04, 0.0004], "orien": [0, 0, 1], "n_beams": 2, "flex": ALL},
            },
            {"El_Nrs": 2, "rho": 2700, "type": "rigid", "dim": [0.04, 0.008], "orien": [0, 0, 1]},
        ],
        "Rlse": [],
        "Optional": {"simple_mode": False, "buck_load": False, "gravity": [0, 0, -9.81]},
    }
    today = moved(changed(HINGE, nbeams=2), 3, rot_z=0.1, mominertia=[1, 0, 0, 1, 0, 1])
    today |= {"opt": {"gravity": [0, 0, -9.81]}}
    today["nprops"].pop()
    assert model_of(older).to_deck() == model_of(today).to_deck()
    said = " ".join(each.message for each in model_of(older).diagnostics)
    assert "names of older versions: " in said and "disp_rx for rot_z (1)" in said
    one = {"coordinates": GUIDE["nodes"], "connect": GUIDE["elements"]}
    one |= {"nprops": GUIDE["nprops"], "eprops": GUIDE["eprops"]}
    assert model_of(one).to_deck() == model_of(GUIDE).to_deck()
    with pytest.raises(TablesError, match="connect: this is elements by an older name"):
        model_of({**one, "elements": GUIDE["elements"]})
    twice = {**older, "Elem_props": [{**older["Elem_props"][0], "elems": [1]}]}
    with pytest.raises(TablesError, match=r"eprops\[1\]\.El_Nrs: this is elems by an older name"):
        model_of(twice)


def test_results_of_rigid_directions_that_hold_twice_are_told() -> None:
    """The stiffness of a guide, 24 E I/L^3, does not depend on it (Soemers, 2.3)."""
    tables = moved(changed(GUIDE, flex=[2, 3, 4]), 2, displ_x=1e-6)
    script = Script.of(tables)
    found = results_of(script, flexact.analyse(script.designed))
    (note,) = found["notes"]
    assert "rigid, and over-constrained by 1: of reactions and stresses those of least" in note
    stiffness = 24 * 200e9 * 0.04 * 0.0004**3 / 12 / 0.09**3
    assert found["step"][-1]["node"][1]["Freac"][0] == pytest.approx(1e-6 * stiffness, rel=1e-4)
    assert found["missing"] == {} and json.loads(text_of_results(found)) == found
    script = Script.of(moved(GUIDE, 2, displ_x=1e-6))
    assert "notes" not in results_of(script, flexact.analyse(script.designed))


def test_the_command_says_what_is_taken_for_what(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("guide.json").write_text(json.dumps(GUIDE))
    assert main(["convert", "guide.json", "-o", "guide.dat"]) == 0
    said = capsys.readouterr().err
    assert "eprops[1], elements 1, 3: 40 by 0.4 mm is a sheet: out-of-plane bending and" in said
    assert main(["analyse", "guide.dat", "--summary"]) == 0
    assert "both          1      1" in capsys.readouterr().out


def test_a_width_along_its_element_is_told_with_its_place() -> None:
    """Of a rigid element it says nothing."""
    for given in ([0, 1, 0], None):
        with pytest.raises(TablesError) as error:
            model_of(changed(GUIDE, orien=given))
        what = "it" if given else "(0, 1, 0), the default,"
        for element in (1, 3):
            words = f"eprops[1].orien: {what} lies along element {element}: give a vector"
            assert words in str(error.value)
    short = copy.deepcopy(GUIDE)
    short["nodes"][1] = short["nodes"][0]
    with pytest.raises(TablesError, match=r"elements\[1\]: its nodes are at one place: it has no"):
        model_of(short)
    rigid = copy.deepcopy(GUIDE)
    rigid["eprops"][1]["orien"] = [1, 0, 0]
    assert counts(rigid) == (1, 1)
    said = [each.message for each in model_of(rigid).diagnostics]
    assert "orien along a rigid element (1)" in said
