# SPDX-License-Identifier: BSD-3-Clause
"""Tables in the style of SPACAR Light: from decks and back, published examples, mistakes."""

from __future__ import annotations

import copy
import json
import math
import random
from typing import Any

import jsonschema
import numpy as np
import pytest
from json_schema import schema
from reference_decks import NAMES, text_of, truth_of

import flexact
from flexact.apps.convert.table_input import ELEMENT_FIELDS, NODE_FIELDS, OPTIONS
from flexact.apps.convert.tables import TablesError, model_of, tables_of
from flexact.deck.diagnostics import Diagnostic

SCHEMA = jsonschema.Draft202012Validator(schema("tables"))
BEAM: dict[str, Any] = {
    "nodes": [[0, 0, 0], [0, 0.1, 0]],
    "elements": [[1, 2]],
    "nprops": [{"fix": True}, {}],
    "eprops": [{"elems": [1], "flex": [2, 3, 4], "orien": [0, 0, 1]}],
}


def places_of(error: pytest.ExceptionInfo[TablesError]) -> list[str]:
    return [item.message.split(": ")[0] for item in error.value.diagnostics]


def changed(**tables: Any) -> dict[str, Any]:
    return {**copy.deepcopy(BEAM), **tables}


# Decks to tables and back


@pytest.mark.parametrize("name", NAMES)
def test_a_deck_through_tables_has_the_same_jacobian(name: str) -> None:
    """The same counts as the oracle's, and singular values that only the order may round."""
    model = flexact.read_text(text_of(name))
    tables = json.loads(json.dumps(tables_of(model)))
    assert not list(SCHEMA.iter_errors(tables))
    again = model_of(tables)
    ours, theirs = flexact.analyse(model), flexact.analyse(again)
    assert (theirs.under_constrained, theirs.over_constrained) == truth_of(name)
    assert (theirs.rows, theirs.columns) == (ours.rows, ours.columns)
    wanted = pytest.approx(ours.singular_values, rel=1e-9, abs=1e-13)
    assert theirs.singular_values == wanted
    assert list(again.element_names) == list(model.element_names)
    # What was written once is what is written again.
    assert tables_of(model_of(tables_of(again))) == tables_of(again)


def test_what_tables_do_not_hold_is_told_once_each() -> None:
    model = flexact.read_text(
        "% title\nTRUSS 7 1 2 % bar\nX 2 1 0 0\nFIX 1\nFIX 2 2 3\nDYNX 2 1 % driven\nEND\nHALT\n"
        "ESTIFF 7 1e6\nEND\nEND\nVISUALIZATION\nEDGECOLOR 1 0 0\n"
    )
    remarks: list[Diagnostic] = []
    tables_of(model, remarks)
    assert [(item.code, item.message) for item in remarks] == [
        ("left-out", "stiffness that no moduli and cross-section give (1)"),
        ("left-out", "colours of edges (1)"),
        ("left-out", "numbers of elements and nodes are now those of their rows (3)"),
        ("left-out", "lines of comment (2)"),
        ("own-field", "fields that SPACAR Light does not know: type (1), name (1)"),
    ]


def test_stiffness_and_mass_of_a_steel_sheet_come_back() -> None:
    """E, G and density of EN 1993-1-1 and EN 1991-1-1; the sheet is 0.3 mm by 40 mm."""
    model = flexact.Model()
    model.sheet((0, 0, 0), (0.1, 0, 0), "z", thickness=3e-4, breadth=0.04, material="steel")
    model.fix((0, 0, 0))
    (entry,) = tables_of(model)["eprops"]
    assert (entry["emod"], entry["smod"], entry["dens"]) == pytest.approx((210e9, 81e9, 7850.0))
    given, again = model.data.properties, model_of(tables_of(model)).data.properties
    assert given is not None and again is not None
    assert again.stiffness[0, :4] == pytest.approx(given.stiffness[0, :4])
    assert again.mass[0] == pytest.approx(given.mass[0])


# Examples of SPACAR Light's documentation

L, W = 0.1, 0.05
#: The walkthrough of spacar.nl: a parallel guide of two leaf springs, node 2 displaced along x.
WALKTHROUGH: dict[str, Any] = {
    "nodes": [[0, 0, 0], [0, L, 0], [W, L, 0], [W, 0, 0]],
    "elements": [[1, 2], [2, 3], [3, 4]],
    "nprops": [
        {"fix": True},
        {"displ_initial_x": -0.01, "displ_x": 0.02, "force_initial": [0, 0, 5]},
        {"force_initial": [0, 0, 5]},
        {"fix": True},
    ],
    "eprops": [
        {
            **{"elems": [1, 3], "emod": 210e9, "smod": 70e9, "dens": 7800, "cshape": "rect"},
            **{"dim": [0.05, 0.0005], "flex": [2, 3, 4], "orien": [0, 0, 1], "nbeams": 2},
        },
        {"elems": [2], "dens": 2700, "dim": [0.05, 0.05], "cshape": "rect", "orien": [0, 0, 1]},
    ],
    "rls": [{"def": [1, 2, 3, 4, 5, 6]}, {}, {"def": [3]}],
}
#: spacarexample.m of github.com/precision-utwente/spalight: a cross hinge.
CROSS: dict[str, Any] = {
    "nodes": [[0, 0, 0], [0, 0.1, 0], [0.1, 0.1, 0], [0.1, 0, 0]],
    "elements": [[1, 3], [2, 3], [2, 4]],
    "nprops": [
        {"fix": True},
        {},
        {
            **{"force": [0, 1, 0], "moment_initial": [0, 0, -0.025], "moment": [0, 0, 0.05]},
            "mass": 0.1,
        },
        {"fix": True},
    ],
    "eprops": [
        {
            **{"elems": [1, 3], "emod": 210e9, "smod": 70e9, "dens": 7800, "cshape": "rect"},
            **{"dim": [50e-3, 0.2e-3], "orien": [0, 0, 1], "nbeams": 3, "color": "grey"},
            **{"flex": [1, 2, 3, 4, 5, 6], "opacity": 0.7, "warping": True},
        },
        {
            **{"elems": 2, "dens": 3000, "cshape": "rect", "dim": [50e-3, 10e-3]},
            **{"orien": [0, 0, 1], "nbeams": 1, "color": "darkblue", "warping": True},
        },
    ],
    "opt": {"filename": "crosshinge", "gravity": [0, 0, -9.81]},
}


def test_the_walkthrough_with_its_releases_is_exactly_constrained() -> None:
    """SPACAR Light simulates nothing else. Rows: 6 for each of 5 beams less 7 releases; columns: 6
    for each of 4 points that are free, less the one displacement."""
    assert not list(SCHEMA.iter_errors(WALKTHROUGH))
    analysis = flexact.analyse(model_of(WALKTHROUGH, flexible="independent"))
    assert (analysis.rows, analysis.columns) == (5 * 6 - 7, 4 * 6 - 1)
    assert analysis.verdict.value == "exactly constrained"


def test_an_open_chain_without_releases_would_be_exact_and_a_loop_is_not() -> None:
    """A loop in space that is closed by flexible deformations which count as degrees of freedom has
    six conditions too many: these SPACAR Light releases by itself where nobody says which."""
    assert not list(SCHEMA.iter_errors(CROSS))
    model = model_of(CROSS, flexible="independent")
    assert (model.data.count.rows, model.data.count.columns) == (7 * 6, 6 * 6)
    analysis = flexact.analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (0, 6)
    cut = copy.deepcopy(CROSS)
    cut["nprops"][3] = {}
    analysis = flexact.analyse(model_of(cut, flexible="independent"))
    assert (analysis.under_constrained, analysis.over_constrained) == (0, 0)


def test_a_loop_of_rigid_elements_cannot_be_released() -> None:
    """The second question of SPACAR Light's FAQ: elements A, B and C between three nodes."""
    tables = copy.deepcopy(CROSS)
    tables["nodes"].append([0.05, 0.15, 0])
    tables["elements"] += [[2, 5], [5, 3]]
    both = {**tables, "rls": [{"def": [1, 2, 3, 4, 5, 6]}]}
    over = [
        flexact.analyse(model_of(each, flexible="independent")).over_constrained
        for each in (tables, both)
    ]
    assert over == [12, 6]
    both["elements"] = both["elements"][:-1]
    assert flexact.analyse(model_of(both, flexible="independent")).over_constrained == 0


def test_what_is_flexible_may_be_released_instead() -> None:
    """The compliant deformations of two parallel sheets: over-constrained by one as everybody
    knows, and free to move along x."""
    tables = {**WALKTHROUGH, "rls": []}
    tables["eprops"][0]["nbeams"] = 1
    tables["nprops"] = [{"fix": True}, {"displ_x": 0.01}, {}, {"fix": True}]
    analysis = flexact.analyse(model_of(tables, flexible="released"))
    assert (analysis.under_constrained, analysis.over_constrained) == (0, 1)
    analysis = flexact.analyse(model_of(tables, flexible="independent"))
    assert analysis.over_constrained == 18 - 11


def test_beams_of_an_element_are_as_in_spacar_light() -> None:
    """Nodes 3 (i - 1) + 1 and + 2; those between behind all; releases in the last beam."""
    tables = changed(rls={"def": [2]}, eprops={**BEAM["eprops"][0], "nbeams": 3})
    model = model_of(tables, flexible="independent")
    assert model.element_nodes.tolist() == [[0, 1, 4, 5], [4, 5, 6, 7], [6, 7, 2, 3]]
    assert model.node_numbers.tolist() == [1, 2, 4, 5, 7, 8, 10, 11]
    y = model.positions[[4, 6], 1]
    assert y == pytest.approx([0.1 / 3, 0.2 / 3])
    assert model.deformation_classes.tolist() == [
        [1, 3, 3, 3, 1, 1],
        [1, 3, 3, 3, 1, 1],
        [1, 2, 3, 3, 1, 1],
    ]


def test_stiffness_and_mass_follow_from_the_section() -> None:
    """By hand, E = 200, G = 80 GPa so that nu is 1/4; round, d = 10 mm; k = 6 (1 + nu)/(7 + 6 nu);
    and the width of a rectangle lies along local y."""
    section = {"emod": 200e9, "smod": 80e9, "dens": 8000, "cshape": "circ", "dim": 0.01}
    model = model_of(changed(eprops=[{**BEAM["eprops"][0], **section}]))
    area, second = math.pi * 0.01**2 / 4, math.pi * 0.01**4 / 64
    shear = 200e9 * second / (80e9 * area * (7.5 / 8.5))
    given = model.data.properties
    assert given is not None
    assert given.stiffness[0] == pytest.approx(
        [200e9 * area, 80e9 * 2 * second, 200e9 * second, 200e9 * second, shear, shear]
    )
    assert given.mass[0] == pytest.approx(
        [8000 * area, 16000 * second, 8000 * second, 8000 * second, 0.0]
    )
    flat = {**section, "cshape": "rect", "dim": [0.04, 0.001]}
    model = model_of(changed(eprops=[{**BEAM["eprops"][0], **flat}]))
    assert model.data.properties is not None
    assert model.data.properties.stiffness[0, 2:4] == pytest.approx(
        [200e9 * 0.04 * 0.001**3 / 12, 200e9 * 0.001 * 0.04**3 / 12]
    )


def test_held_warping_raises_the_stiffness_in_torsion() -> None:
    """Against the closed forms: G It k L/(k L - 2 tanh(k L/2)) held at both ends, and
    G It k L/(k L - tanh(k L)) at one, with k^2 = G It/(E Iw) and Iw = b^3 t^3/144 (Timoshenko,
    Strength of Materials II, 1956, art. 54); a sheet of the builder likewise."""
    modulus, shear, b, t, length = 200e9, 80e9, 0.04, 0.001, 0.1
    section = {"emod": modulus, "smod": shear, "cshape": "rect", "dim": [b, t]}

    def torsion(nprops: list[Any], **more: object) -> float:
        tables = changed(
            eprops=[{**BEAM["eprops"][0], **section, **more}],
            nprops=nprops,
            nodes=[[0, 0, 0], [0, length, 0]],
        )
        model = model_of(tables)
        assert not [item for item in model.diagnostics if "warping:" in item.message]
        assert model.data.properties is not None
        assert len({*model.data.properties.stiffness[:, 1]}) == 1
        return float(model.data.properties.stiffness[0, 1])

    free = torsion([{"fix": True}, {}])
    kl = length * math.sqrt(free / (modulus * b**3 * t**3 / 144))
    both, one = kl / (kl - 2 * math.tanh(kl / 2)), kl / (kl - math.tanh(kl))
    assert both > 1.2 > one > 1.1
    held = [{"fix": True}, {"fix_warp": True}]
    assert torsion([{"fix": True}, {}], cw=True) == pytest.approx(both * free)
    assert torsion(held, warping=True) == pytest.approx(both * free)
    assert torsion(held, warping=True, nbeams=3) == pytest.approx(both * free)
    assert torsion([{"fix": True}, {}], warping=True) == pytest.approx(one * free)
    assert torsion([{}, {"fix_warp": True}], warping=True) == pytest.approx(one * free)
    assert torsion([{"fix_pos": True}, {}], warping=True) == free
    model = flexact.Model()
    model.sheet(
        *((0, 0, 0), (0, length, 0), "x"),
        **{"thickness": t, "breadth": b, "warping": True},
        material=flexact.Material("steel", modulus, shear),
    )
    assert model.data.properties is not None
    assert model.data.properties.stiffness[0, 1] == pytest.approx(both * free)


def test_warping_that_means_nothing_here_is_told_with_its_place() -> None:
    tables = changed(nprops=[{"fix_warp": True}, {}])
    notes = [item.message for item in model_of(tables).diagnostics]
    assert "warping: nprops[1].fix_warp: no element warps (1)" in notes


def test_a_rigid_element_that_warps_holds_the_warping_of_its_neighbours() -> None:
    """SPACAR Light 1.38 fixes both warping nodes of a rigid BEAMW; two flexible ones that meet
    depend on each other."""
    model = model_of(CROSS, flexible="independent")
    assert not [item for item in model.diagnostics if "warping" in item.message]
    held = changed(
        nprops=[{"fix": True}, {}, {}, {"fix": True}],
        **{name: CROSS[name] for name in ("nodes", "elements")},
        eprops=[{**CROSS["eprops"][0], "warping": False, "cw": True}, CROSS["eprops"][1]],
    )
    with_cw = model_of(held, flexible="independent").data.properties
    given = model.data.properties
    assert given is not None and with_cw is not None
    assert given.stiffness[0, 1] == with_cw.stiffness[0, 1]
    two = changed(
        nodes=[*BEAM["nodes"], [0, 0.2, 0]],
        elements=[[1, 2], [2, 3]],
        eprops=[{**CROSS["eprops"][0], "elems": [1, 2]}],
    )
    notes = [item.message for item in model_of(two).diagnostics]
    for one, other in ((1, 2), (2, 1)):
        words = f"eprops[1].warping of element {one}: at node 2 it depends on element {other}"
        assert f"warping: {words} (1)" in notes


def test_what_a_model_does_not_hold_is_told_once_each() -> None:
    notes = [(item.code, item.message) for item in model_of(CROSS).diagnostics]
    assert notes == [
        (
            "by-section",
            "eprops[1], elements 1, 3: 50 by 0.2 mm is a sheet: out-of-plane bending and torsion "
            "are released",
        ),
        ("left-out", "what is for a simulation: opt.filename (1)"),
    ]
    codes = [item.message for item in model_of(WALKTHROUGH).diagnostics]
    where = "nprops[2].displ_x, nprops[2].displ_initial_x"
    assert f"values of prescribed motions: {where} (2)" in codes


def test_a_state_space_that_is_asked_for_is_told_as_a_command() -> None:
    """SPACAR Light takes true, or true with a relative damping; without one there is none."""
    ends = {"transfer_in": "force_z", "transfer_out": ["displ_z", "veloc_x"]}
    nprops = [*CROSS["nprops"]]
    nprops[2] = {**nprops[2], **ends}
    for asked, damping in (([True, 0.02], "0.02"), (True, "0")):
        tables = {**CROSS, "nprops": nprops, "opt": {**CROSS["opt"], "transfer": asked}}
        (note,) = [each for each in model_of(tables).diagnostics if each.code == "state-space"]
        assert "--from 7:z --to 7:z --to '7:x velocity'" in note.message
        assert (
            f"--damping {damping} " in note.message and "['7:z'], ['7:z', '7:x vel" in note.message
        )
    tables["opt"]["transfer"] = False
    codes = [(each.code, each.message) for each in model_of(tables).diagnostics]
    assert ("left-out", "what is for a simulation: nprops.transfer_out (2)") in codes
    for wrong in ([True, -1], "yes", [True, 0.1, 0.2]):
        with pytest.raises(TablesError, match=r"opt\.transfer"):
            model_of({**CROSS, "opt": {"transfer": wrong}})
    nprops[2] = {"transfer_in": "moment_z"}
    with pytest.raises(TablesError, match="force_x, force_y, force_z"):
        model_of({**CROSS, "nprops": nprops})


def test_loads_are_those_of_a_deck() -> None:
    """SPACAR Light writes force_initial as XF, force as DELXF, and gravity as GRAVITY."""
    model = model_of(CROSS)
    loads = model.data.loads
    assert loads is not None
    position, orientation = model.node_index(7), model.node_index(8)
    assert loads.force[orientation].tolist() == [0, 0, -0.025]
    assert loads.increment[position].tolist() == [0, 1, 0]
    assert loads.increment[orientation].tolist() == [0, 0, 0.05]
    assert np.count_nonzero(loads.force) + np.count_nonzero(loads.increment) == 3
    assert loads.gravity.tolist() == [0, 0, -9.81]
    again = tables_of(model)
    (entry,) = [entry for entry in again["nprops"] if "force" in entry]
    assert again["nodes"][again["nprops"].index(entry)] == CROSS["nodes"][2]
    for name in ("force", "moment_initial", "moment"):
        assert entry[name] == CROSS["nprops"][2][name]
    assert again["opt"]["gravity"] == CROSS["opt"]["gravity"]


def test_loads_that_no_model_has_are_told() -> None:
    flat: dict[str, Any] = {"nodes": [[0, 0], [1, 0]], "elements": [[1, 2]], "eprops": []}
    flat["nprops"] = [{"fix": True}, {"force_initial": [1, 2, 3], "moment": [0, 0, 4]}]
    model = model_of({**flat, "opt": {"gravity": [0, -9.81, 0]}})
    loads = model.data.loads
    assert loads is not None
    assert loads.force[2].tolist() == [1, 2, 0]
    assert loads.increment[3].tolist() == [0, 0, 4]
    assert [item.message for item in model.diagnostics] == ["loads out of the plane (1)"]
    wrong: dict[str, Any] = {**flat, "nodes": [[0, 0], [1, 0], [2, 0]]}
    wrong["nprops"] = {"3": {"force": [1, 0, 0]}}
    for tables, place in ((wrong, "nprops[3].force"), ({**flat, "opt": {"gravity": 9.81}}, "opt")):
        with pytest.raises(TablesError) as caught:
            model_of(tables)
        assert place in str(caught.value)


# Forms


def test_a_single_entry_and_numbers_as_keys_as_matlab_and_people_write_them() -> None:
    plain = tables_of(model_of(BEAM))
    entry = BEAM["eprops"][0]
    for tables in (
        changed(nprops={"fix": True}, eprops={**entry, "elems": 1}),
        changed(nprops={"1": {"fix": True}}, elements=[1, 2]),
        changed(nprops={1: {"fix": 1}}, nodes=np.array(BEAM["nodes"]), opt=[], rls=[]),
        changed(nprops=[{"fix": True, "force": []}, {"fix": []}], opt={"rls": None}),
    ):
        assert tables_of(model_of(tables)) == plain


def test_orientations_and_positions_may_be_shared() -> None:
    """A ball joint, two points of one place; and two places that turn as one."""
    ball = {
        "nodes": [[0, 0, 0], [1, 0, 0], [1, 0, 0], [2, 1, 0]],
        "elements": [[1, 2], [3, 4]],
        "nprops": [{"fix": True}, {}, {"same_pos": 2}, {"same_orien": 3}],
        "eprops": [{"elems": [1], "orien": [0, 0, 1]}, {"elems": [2], "type": "rbeam"}],
    }
    model = model_of(ball)
    assert model.element_nodes.tolist() == [[0, 1, 2, 3], [2, 4, 5, -1]]
    analysis = flexact.analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (3, 0)


def test_points_at_one_place_that_a_hinge_joins_share_it() -> None:
    tables = {
        "nodes": [[0, 0, 0], [1, 0, 0], [1, 0, 0], [2, 0, 0]],
        "elements": [[1, 2], [2, 3], [3, 4]],
        "nprops": [{"fix": True}],
        "eprops": [{"elems": 2, "type": "hinge", "orien": [0, 0, 1], "flex": 1}],
        "rls": [{}, {"def": 1}],
    }
    analysis = flexact.analyse(model_of(tables))
    assert (analysis.under_constrained, analysis.over_constrained) == (1, 0)
    with pytest.raises(TablesError) as error:
        model_of({**tables, "eprops": [{"elems": 2, "type": "hinge"}]})
    assert places_of(error) == ["eprops[1]"]


def test_nodes_with_x_and_y_are_planar() -> None:
    tables = {"nodes": [[0, 0], [1, 0]], "elements": [[1, 2]], "nprops": [{"fix": True}]}
    model = model_of({**tables, "eprops": [{"elems": 1, "flex": [2, 3]}], "rls": {"def": [2, 3]}})
    assert model.planar and model.element_keywords == ("PLBEAM",)
    assert flexact.analyse(model).under_constrained == 2
    with pytest.raises(TablesError) as error:
        model_of({**tables, "eprops": [{"elems": 1, "type": "beam"}]})
    assert places_of(error) == ["eprops[1].type"]


# Mistakes


def test_all_mistakes_are_told_in_one_run_each_with_its_place() -> None:
    with pytest.raises(TablesError) as error:
        model_of(
            {
                "nodes": [[0, 0, 0], [0, 1], [0, 0, "x"], [0, 0, float("nan")]],
                "elements": [[1, 2], [1, 9], [2, 2], [1]],
                "nprops": [{"fix": "yes"}, {"fixx": True}, {"mass": -1}, {}, {"fix": True}],
                "eprops": [
                    {"elems": [1, 7], "orien": [0, 0, 0], "flex": [1, 8]},
                    {"emod": 1},
                    {"elems": [2, 7], "cshape": "rect", "dim": [1]},
                ],
                "opt": {"rls": [{"deff": 1}], "gravty": 3},
                "node": [],
            }
        )
    assert sorted(places_of(error)) == sorted(
        [
            *("node", "nodes[2]", "nodes[3][3]", "nodes[4][3]"),
            *("elements[2]", "elements[3]", "elements[4]"),
            *("nprops[1].fix", "nprops[2].fixx", "nprops[3].mass", "nprops[5]"),
            *("eprops[1].orien", "eprops[1].flex", "eprops[2]", "eprops[2]", "eprops[2]"),
            *("eprops[3].elems", "eprops[3].dim", "opt.gravty", "opt.rls[1].deff"),
        ]
    )
    words = str(error.value)
    assert "did you mean fix_x?" in words and "did you mean gravity?" in words


@pytest.mark.parametrize(
    ("place", "tables"),
    [
        ("nodes", {"nodes": None}),
        ("elements", {"elements": "1 2"}),
        ("nprops", {"nprops": 5}),
        ("nprops[1]", {"nprops": [5]}),
        ("nprops[x]", {"nprops": {"x": {}}}),
        ("nprops[0]", {"nprops": {"0": {"fix": True}}}),
        ("opt", {"opt": 5}),
        ("opt.rls", {"rls": {"def": 1}, "opt": {"rls": {"def": 2}}}),
        ("rls[4]", {"rls": [{}, {}, {}, {"def": 1}]}),
        ("nprops[2].displ_x", {"nprops": [{}, {"fix_x": True, "displ_x": 1}]}),
        ("nprops[1].same_pos", {"nprops": [{"same_pos": 2}]}),
        ("nprops[2].same_pos", {"nprops": [{}, {"same_pos": 1}]}),
        ("eprops[2].elems", {"eprops": [{"elems": 1}, {"elems": [1]}]}),
        ("eprops[1].elems", {"eprops": [{"elems": [1, 1]}]}),
        ("eprops[1].color", {"eprops": [{"elems": 1, "color": "pink"}]}),
        ("eprops[1].color", {"eprops": [{"elems": 1, "color": [1, 2, 300]}]}),
        ("eprops[1].type", {"eprops": [{"elems": 1, "type": "wheel"}]}),
        ("eprops[1].nbeams", {"eprops": [{"elems": 1, "type": "truss", "nbeams": 2}]}),
        ("elements[1]", {"eprops": [{"elems": 1, "type": "truss", "flex": [2]}]}),
        ("nprops[2].mominertia", {"nprops": [{}, {"mominertia": [1, 2]}]}),
        ("nprops[2].mass", {"nprops": [{}, {"mass": 10**400}]}),
        (
            "eprops[1]",
            {
                **{"nodes": [[0, 0, 0], [1, 0, 0], [2, 0, 0]], "elements": [[1, 2], [2, 3]]},
                "eprops": [{"elems": [1, 2], "type": "bearing"}],
            },
        ),
    ],
)
def test_one_mistake_is_told_with_its_place(place: str, tables: dict[str, Any]) -> None:
    with pytest.raises(TablesError) as error:
        model_of(changed(**tables))
    assert places_of(error) == [place]


def test_no_tables_at_all() -> None:
    with pytest.raises(TypeError):
        model_of([1, 2])  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="flexible"):
        model_of(BEAM, flexible="maybe")
    with pytest.raises(TypeError):
        tables_of(5)  # type: ignore[arg-type]
    with pytest.raises(flexact.ModelError):
        tables_of(flexact.Model())


@pytest.mark.parametrize("seed", range(8))
def test_whatever_stands_in_tables_is_taken_or_told(seed: int) -> None:
    """Values exchanged at random by others: a model, or mistakes in words."""
    chance = random.Random(seed)
    odd = [None, True, -1, 0, 2, 7, 1e300, 1e-300, math.nan, "x", "", [], {}, [1], [[1]], 10**400]
    outcomes = set()
    for _ in range(150):
        tables = copy.deepcopy(chance.choice((BEAM, WALKTHROUGH, CROSS)))
        for _k in range(chance.randint(1, 2)):
            spoil(tables, chance, odd)
        try:
            model = model_of(tables)
            model.data.problems  # noqa: B018
            outcomes.add("model")
        except TablesError as error:
            assert error.diagnostics and str(error)
            outcomes.add("told")
    assert outcomes == {"model", "told"}


def spoil(part: Any, chance: random.Random, odd: list[Any]) -> None:
    while True:
        keys = list(part) if isinstance(part, dict) else list(range(len(part)))
        if not keys:
            return
        key = chance.choice(keys)
        if isinstance(part[key], (dict, list)) and chance.random() < 0.8:
            part = part[key]
            continue
        part[key] = copy.deepcopy(chance.choice(odd))
        return


def test_the_schema_has_the_fields_of_the_tables() -> None:
    defined = schema("tables")["$defs"]
    assert set(defined["node"]["properties"]) == set(NODE_FIELDS)
    assert set(defined["set"]["properties"]) == set(ELEMENT_FIELDS)
    assert set(schema("tables")["properties"]["opt"]["properties"]) == set(OPTIONS)
