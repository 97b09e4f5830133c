# SPDX-License-Identifier: BSD-3-Clause
"""Reading a design problem: from files, keywords and decks, and all that can be wrong with it.

The twenty problems are those of the specification; what each of their freedoms is stands beside it
in `expect`, and twists are compared with ones that are made here by hand.
"""

import json
import math
import random
import re
from copy import deepcopy
from pathlib import Path

import numpy as np
import pytest

import flexact
from flexact.deck.rendering import DeckError, ModelError, ProblemsError
from flexact.designs.problem import Box, Problem, Region
from flexact.designs.reading import (
    box,
    problem_of,
    problem_of_deck,
    problem_of_file,
    problem_of_keywords,
)

REFERENCE = Path(__file__).parents[1] / "reference" / "design_problems.json"
PROBLEMS = {
    each["id"]: each for each in json.loads(REFERENCE.read_text(encoding="utf-8"))["problems"]
}

#: The example of the specification, in TOML.
HINGE = """\
title   = "Mirror hinge"
wanted  = ["rotation about (0, 0, 0) along x"]
[stage]
boxes   = [[[-0.02, -0.02, -0.01], [0.02, 0.02, 0.01]]]
centre  = [0, 0, 0]
mass    = 0.2
[ground]
boxes   = [[[0.06, -0.08, -0.08], [0.08, 0.08, 0.08]], [[-0.08, -0.08, -0.08], [-0.06, 0.08, 0.08]]]
[keep_out]
boxes   = []
[intermediate]
boxes   = []
[limits]
bodies  = 2
length  = [0.03, 0.09]
width   = [0.01, 0.03]
thickness = 0.3e-3
diameter  = 1e-3
clearance = 2e-3
kinds   = ["wire", "sheet", "folded sheet", "notch"]
over_constraint = 0
symmetry = "any"
material = "steel"
[rank]
by      = "worst stiffness"
"""


def small(**more: object) -> dict[str, object]:
    """A problem with no more than it needs, and something else."""
    made = {
        "wanted": ["rotation x"],
        "stage": [[-0.02, -0.02, -0.01], [0.02, 0.02, 0.01]],
        "ground": [[[0.06, -0.08, -0.08], [0.08, 0.08, 0.08]]],
    }
    return {key: value for key, value in {**made, **more}.items() if value is not None}


def twists(problem: Problem) -> np.ndarray:
    return np.array([each.twist for each in problem.wanted]).reshape(-1, 6)


def file_of(folder: Path, name: str, text: str | bytes) -> Path:
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
    return path


def toml_of(value: object, prefix: str = "") -> str:
    """A problem as TOML, with a table for each dictionary."""
    assert isinstance(value, dict)
    # There is no null in TOML.
    plain = {k: v for k, v in value.items() if not isinstance(v, dict) and v is not None}
    lines = [f"{json.dumps(key)} = {inline(each)}" for key, each in plain.items()]
    for key, each in value.items():
        if isinstance(each, dict):
            lines += [f"[{prefix}{key}]", toml_of(each, f"{prefix}{key}.")]
    return "\n".join(lines)


def inline(value: object) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {inline(each)}" for key, each in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(inline, value)) + "]"
    if isinstance(value, float) and math.isinf(value):
        return "inf"
    return json.dumps(value)


def twist_by_hand(entry: dict, centre: np.ndarray) -> np.ndarray:
    """A unit twist about a point, from its definition: v = w x (centre - point) + pitch w."""
    unit = np.array(entry["direction"], float)
    unit /= np.linalg.norm(unit)
    if entry["kind"] == "translation":
        return np.concatenate((np.zeros(3), unit))
    arm = centre - np.array(entry["point"], float)
    return np.concatenate((unit, np.cross(unit, arm) + entry.get("pitch", 0.0) * unit))


# -- the problems of the specification -------------------------------------------------------------


@pytest.mark.parametrize("name", PROBLEMS)
def test_problem_of_the_specification_is_read_as_it_is_written(name, tmp_path):
    given = PROBLEMS[name]
    found = problem_of(given)
    centre = np.array(given["centre"], float)
    assert np.array_equal(found.centre, centre)
    assert found.size == given["size"]
    assert found.freedom.dimension == given["expect"]["dimension"]
    assert found.constraint.dimension == 6 - given["expect"]["dimension"]
    by_hand = [twist_by_hand(each, centre) for each in given["wanted"]]
    assert np.allclose(twists(found), np.reshape(by_hand, (-1, 6)), rtol=0, atol=1e-15)
    assert [[b.low.tolist(), b.high.tolist()] for b in found.ground.boxes] == given["ground"][
        "boxes"
    ]
    assert found.limits.length == tuple(given["limits"]["length"])
    assert found.limits.kinds == tuple(given["limits"]["kinds"])
    assert found.limits.thickness == (0.0003, 0.0003)
    assert (found.material.E, found.material.G, found.material.density) == (2.1e11, 8.077e10, 7800)
    assert np.array_equal(found.inertia, 4e-5 * np.eye(3))
    assert found.remarks == ()
    # In all languages it is the same problem, and what it is written as reads back.
    whole = found.to_dict()
    texts = {"a.json": json.dumps(given, indent=1), "a.toml": toml_of(given), "b.json": ""}
    texts["b.json"] = json.dumps(whole)
    for file, text in texts.items():
        assert problem_of_file(file_of(tmp_path, file, text)).to_dict() == whole


def test_problem_in_yaml(tmp_path):
    yaml = pytest.importorskip("yaml")
    given = PROBLEMS["screw"]
    whole = problem_of(given).to_dict()
    assert problem_of_file(file_of(tmp_path, "a.yaml", yaml.safe_dump(given))).to_dict() == whole
    # JSON is YAML; numbers without a dot are texts for YAML 1.1.
    assert problem_of_file(file_of(tmp_path, "a.yml", json.dumps(given))).to_dict() == whole
    text = "wanted: [x]\nlimits: {thickness: 3e-4, lenght: 1}\n"
    with pytest.raises(DeckError, match="did you mean length") as caught:
        problem_of_file(file_of(tmp_path, "b.yaml", text))
    (item,) = caught.value.diagnostics
    assert (item.line, item.column, item.last_column) == (2, 27, 32)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("wanted: [x]\nmass: &a 1\ninertia: *a\n", "an alias stands for another part"),
        ("wanted: [x]\nwanted: [y]\n", "'wanted' is given twice"),
        ("wanted: [x\n", "this is no YAML"),
        ("? [a]\n: b\n", "a key is not a word"),
        ("- x\n", "there are no keys in this YAML"),
        ("", "there are no keys in this YAML"),
        ("title: 2026-99-99\nwanted: []", "this value cannot be read"),
    ],
)
def test_wrong_yaml_is_refused(text, says, tmp_path):
    pytest.importorskip("yaml")
    with pytest.raises(DeckError, match=re.escape(says)):
        problem_of_file(file_of(tmp_path, "a.yaml", text))


def test_example_of_the_specification(tmp_path):
    found = problem_of_file(file_of(tmp_path, "hinge.toml", HINGE))
    assert found.title == "Mirror hinge"
    assert np.array_equal(twists(found), [[1, 0, 0, 0, 0, 0]])
    # Half the diagonal of the stage, sqrt(0.04^2 + 0.04^2 + 0.02^2) / 2.
    assert found.size == pytest.approx(0.03, rel=1e-15)
    assert found.limits.kinds == ("wire", "sheet", "folded sheet", "notch")
    assert (found.limits.bodies, found.limits.over_constraint) == (2, 0)
    assert found.material is flexact.Material or found.material.name == "steel"
    assert found.rank == ("worst_stiffness", False)
    assert found.symmetry == "any"
    assert problem_of(found.to_dict()).to_dict() == found.to_dict()
    assert len(found.remarks) == 1 and "inertia" in found.remarks[0]


def test_options_take_the_place_of_what_a_file_says(tmp_path):
    path = file_of(tmp_path, "hinge.toml", HINGE)
    instead = {"rank": "parts", "kinds": "wires, sheets", "count": 3, "symmetry": "mirror x"}
    found = problem_of_file(path, instead)
    assert found.rank == ("parts", True) and found.limits.kinds == ("wire", "sheet")
    assert (found.count, found.symmetry) == (3, "mirror x")
    assert found.wanted[0].text == "rotation about (0, 0, 0) along x"
    with pytest.raises(DeckError, match="'wier' is no kind of flexure"):
        problem_of_file(path, {"kinds": "wier"})


# -- forms in which the same is written ------------------------------------------------------------


@pytest.mark.parametrize(
    "form",
    [
        [[[0.06, -0.08, -0.08], [0.08, 0.08, 0.08]]],
        [[0.06, -0.08, -0.08], [0.08, 0.08, 0.08]],
        {"boxes": [[["60 mm", -0.08, "-8 cm"], [0.08, "80mm", 0.08]]]},
        {"boxes": [[0.06, -0.08, -0.08], [0.08, 0.08, 0.08]]},
        {"low": [0.06, -0.08, -0.08], "high": [0.08, 0.08, 0.08]},
        {"boxes": [{"low": [0.06, -0.08, -0.08], "high": [0.08, 0.08, 0.08]}]},
        "0.06..0.08, -0.08..0.08, -80 mm..80mm",
        ["60mm..80mm,-0.08..0.08,-0.08..0.08"],
        {"boxes": "0.06 .. 0.08, -0.08 .. 0.08, -0.08 .. 0.08"},
        np.array([[[0.06, -0.08, -0.08], [0.08, 0.08, 0.08]]]),
        box((0.06, -0.08, -0.08), (0.08, 0.08, 0.08)),
        [box(("60 mm", -0.08, -0.08), (0.08, 0.08, 0.08))],
        Region((Box(np.array([0.06, -0.08, -0.08]), np.array([0.08, 0.08, 0.08])),)),
        "0.06..0.08, -0.08..0.08, -0.08..0.08;",
    ],
)
def test_region_in_every_form(form):
    (found,) = problem_of(small(ground=form)).ground.boxes
    assert found.low.tolist() == [0.06, -0.08, -0.08]
    assert found.high.tolist() == [0.08, 0.08, 0.08]


def test_none_is_as_if_it_were_left_out(tmp_path):
    given = small(mass=None, keep_out=None, limits=None, title=None)
    given |= {"mass": None, "keep_out": {"boxes": None}, "limits": {"width": None}, "rank": None}
    given["wanted"] = [{"kind": "rotation", "direction": [1, 0, 0], "point": None, "pitch": None}]
    found = problem_of(given)
    assert found.to_dict() == problem_of(small()).to_dict()
    path = file_of(tmp_path, "a.json", json.dumps(given))
    assert problem_of_file(path).to_dict() == found.to_dict()


def test_regions_of_points_and_flat_boxes():
    stage = {"points": [[0, 0, 0], ["10 mm", 0, 0]], "boxes": [[[0, 0, 0.01], [0.01, 0.01, 0.01]]]}
    found = problem_of(small(stage=stage))
    assert found.stage.points.tolist() == [[0, 0, 0], [0.01, 0, 0]]
    assert found.stage.corners.shape == (3, 2, 3)
    assert found.centre.tolist() == [0.005, 0.005, 0.005]
    assert problem_of(found.to_dict()).to_dict() == found.to_dict()
    # A range of one number in a text is flat.
    (face,) = problem_of(small(ground="0.06, -0.08..0.08, -0.08..0.08")).ground.boxes
    assert (face.low[0], face.high[0]) == (0.06, 0.06)


def test_keywords_units_and_homes_of_keys_agree():
    by_keywords = problem_of_keywords(
        wanted=["rotation about (0, 0, 0) along x"],
        stage=box((-0.02, -0.02, -0.01), (0.02, 0.02, 0.01)),
        ground=[box((0.06, -0.08, -0.08), (0.08, 0.08, 0.08))],
        length=(0.03, 0.09),
        width=("10 mm", 0.03),
        thickness=0.3e-3,
        material="steel",
        mass="200 g",
        inertia=(4e-5, 4e-5, 4e-5),
    )
    in_mm = {
        "units": "mm",
        "wanted": ["rotation about (0, 0, 0) along x"],
        "stage": {"boxes": [[[-20, -20, -10], [20, 20, 10]]], "mass": 0.2, "inertia": 40.0},
        "ground": [[60, -80, -80], [80, 80, 80]],
        "limits": {"length": [30, 90], "width": [10, 30], "thickness": 0.3, "material": "steel"},
    }
    assert problem_of(in_mm).to_dict() == by_keywords.to_dict()
    # SI units may be listed.
    assert problem_of(small(units="m, rad, kg, Pa")).size == problem_of(small()).size
    material = {"E": 210000, "G": 81000, "density": 7850, "strength": 235, "expansion": 12e-6}
    found = problem_of({**in_mm, "limits": {}, "material": {**material, "name": "steel"}})
    assert found.material == by_keywords.material


@pytest.mark.parametrize(
    ("wanted", "twists_by_hand"),
    [
        # About the centre (0, 0, 0), by v = w x (0 - p).
        ("x, y, rz", [[0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], [0, 0, 1, 0, 0, 0]]),
        ("planar z", [[0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], [0, 0, 1, 0, 0, 0]]),
        ("planar across x", [[0, 0, 0, 0, 1, 0], [0, 0, 0, 0, 0, 1], [1, 0, 0, 0, 0, 0]]),
        (
            "spherical at (0, 0, 10 mm)",
            [[1, 0, 0, 0, 0.01, 0], [0, 1, 0, -0.01, 0, 0], [0, 0, 1, 0, 0, 0]],
        ),
        ("spherical", [[1, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0]]),
        (
            "cylindrical about (0, 0.01, 0) along z",
            [[0, 0, 1, 0.01, 0, 0], [0, 0, 0, 0, 0, 1]],
        ),
        (
            "universal at (0, 0, 0.01) along x and y",
            [[1, 0, 0, 0, 0.01, 0], [0, 1, 0, -0.01, 0, 0]],
        ),
        ("universal x y", [[1, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0]]),
        ("nothing", []),
        ([], []),
        ("", None),
        ("everything", np.roll(np.eye(6), 3, axis=1)),
        (
            "all but translation z",
            [*np.eye(6)[[3, 4]], *np.eye(6)[:3]],
        ),
        ("all but rotation about (0, 0, 0.3) along y", np.eye(6)[[3, 4, 5, 0, 2]]),
        ("all but translation x and rotation x", np.eye(6)[[4, 5, 1, 2]]),
        ("all but z", [*np.eye(6)[[3, 4]], *np.eye(6)[:3]]),
        ("all but planar z", np.eye(6)[[5, 0, 1]]),
        ("translation x; rotation about (0, 0, 0) along z", np.eye(6)[[3, 2]]),
        (["stage: translation -x"], [[0, 0, 0, -1, 0, 0]]),
        ("screw z pitch 10 mm", [[0, 0, 1, 0, 0, 0.01]]),
        ("screw z pitch 1 mm/turn", [[0, 0, 1, 0, 0, 1e-3 / (2 * math.pi)]]),
        ("rotation (0, 0, 2) through (0, 5mm, 0)", [[0, 0, 1, 0.005, 0, 0]]),
        ({"kind": "rotation", "direction": "z", "point": [0, "5 mm", 0]}, [[0, 0, 1, 0.005, 0, 0]]),
        (
            {"kind": "screw", "direction": [0, 0, 3], "pitch": "-2 mm/rad"},
            [[0, 0, 1, 0, 0, -0.002]],
        ),
    ],
)
def test_language_of_wanted_motions(wanted, twists_by_hand):
    if twists_by_hand is None:
        with pytest.raises(ModelError, match="there is no motion in it"):
            problem_of(small(wanted=wanted))
        return
    found = problem_of(small(wanted=wanted))
    assert np.allclose(twists(found), np.reshape(twists_by_hand, (-1, 6)), rtol=0, atol=1e-16)
    assert problem_of(found.to_dict()).to_dict() == found.to_dict()


@pytest.mark.parametrize("direction", [(1, 0, 1), (0.3, -0.4, 0.8), (0, 1, 0)])
def test_all_but_a_translation_is_what_one_wire_leaves(direction):
    """The wrench of a wire along d through P, (d, P x d), does no work on any of the five."""
    point = np.array([0.003, -0.002, 0.004])
    text = f"all but translation {direction} at {tuple(point.tolist())}"
    found = problem_of(small(wanted=text))
    wrench = np.concatenate((direction, np.cross(point, direction)))
    work = twists(found) @ np.roll(wrench, 3)
    assert np.abs(work).max() < 1e-15
    assert found.freedom.dimension == 5


def test_advice_takes_the_short_forms():
    """Of a body on one wire, all but the translation along it is what it can do already."""
    model = flexact.Model()
    model.body([(0, 0, 0), (0.1, 0, 0), (0, 0.1, 0)], name="stage")
    model.wire((0, 0, -0.1), (0, 0, 0))
    model.fix((0, 0, -0.1))
    analysis = flexact.analyse(model)
    spaces = analysis.advice(wanted=["stage: all but translation z at (0, 0, 0)"]).spaces
    assert spaces is not None and len(spaces.wanted) == 5
    assert all(each.is_free for each in spaces.wanted)
    assert spaces.unwanted == 0
    held = analysis.advice(wanted=["stage: nothing"]).spaces
    assert held is not None and held.wanted == ()
    assert held.unwanted == 5


# -- what is left out ------------------------------------------------------------------------------


def test_defaults_follow_the_regions_and_their_scale():
    found = problem_of(small())
    # The ground is 0.04 m away: half of it to twice; widths a third of these.
    assert found.limits.length == pytest.approx((0.02, 0.08))
    assert found.limits.width == pytest.approx((0.02 / 3, 0.08 / 3))
    assert found.limits.thickness == (2.7e-4, 2.7e-4)
    assert found.limits.diameter == (8e-4, 8e-4)
    assert found.limits.clearance == 8e-4
    assert found.limits.kinds == ("wire", "sheet", "folded sheet", "notch")
    assert (found.count, found.limits.bodies, found.mass) == (10, 2, 0.0)
    large = {"stage": [[-20, -20, -10], [20, 20, 10]], "ground": [[60, -80, -80], [80, 80, 80]]}
    scaled = problem_of(small(**large))
    assert scaled.size == pytest.approx(1000 * found.size)
    for one, other in zip(scaled.limits.length, found.limits.length, strict=True):
        assert one == pytest.approx(1000 * other)
    assert scaled.limits.diameter == pytest.approx((0.8, 0.8))


def test_no_stage_and_no_ground_are_free_space():
    found = problem_of_keywords("planar z")
    assert len(found.ground.boxes) == 6 and len(found.stage.boxes) == 1
    assert found.size == 0.05 and found.centre.tolist() == [0, 0, 0]
    assert [each.split(":")[0] for each in found.remarks] == [
        "no stage is given",
        "no ground is given",
    ]
    lows = np.array([each.low for each in found.ground.boxes])
    highs = np.array([each.high for each in found.ground.boxes])
    (stage,) = found.stage.boxes
    gaps = np.maximum(np.maximum(lows - stage.high, stage.low - highs), 0.0)
    away = np.linalg.norm(gaps, axis=1)
    assert np.allclose(away, 0.05)
    assert found.limits.length[0] < 0.05 < found.limits.length[1]
    # How large it is follows from what is wanted, where that has any size.
    remote = problem_of_keywords(
        "rotation about (0, 0, 2) along x; rotation about (0, 0, 6) along y"
    )
    assert remote.centre.tolist() == [0, 0, 4] and remote.size == 2.0
    assert problem_of_keywords("rotation x", length=(0.03, 0.09)).limits.length == (0.03, 0.09)


def test_stage_that_is_a_point():
    found = problem_of(small(stage={"points": [[0, 0, 0]]}))
    assert found.size == pytest.approx(0.03)
    assert any("the stage is a point" in each for each in found.remarks)
    alone = problem_of(small(stage={"points": [[0, 0, 0]]}, ground=None))
    assert alone.size == 0.05


def test_pitch_of_nearly_nothing_is_a_rotation_with_a_remark():
    found = problem_of(small(wanted="screw x pitch 1e-9", size=0.05))
    (motion,) = found.wanted
    assert str(motion.kind) == "rotation" and motion.twist.tolist() == [1, 0, 0, 0, 0, 0]
    assert "is taken as a rotation" in found.remarks[0]
    far = problem_of(small(wanted="screw x pitch 1e6", size=0.05))
    assert far.wanted[0].twist.tolist() == [0, 0, 0, 1, 0, 0]
    for pitch, kind in ((1e-6, "rotation"), (1e4, "translation")):
        with pytest.raises(ModelError, match=f"is it a {kind}"):
            problem_of(small(wanted=f"screw x pitch {pitch}", size=0.05))


@pytest.mark.parametrize(
    ("given", "symmetry"),
    [
        ("any", "any"),
        ("None", "none"),
        ("mirror x", "mirror x"),
        ("mirror across Y", "mirror y"),
        ("3-fold about z", "3-fold about z"),
        ("six fold z", "6-fold about z"),
    ],
)
def test_symmetry(given, symmetry):
    assert problem_of(small(symmetry=given)).symmetry == symmetry


@pytest.mark.parametrize(
    ("given", "rank"),
    [
        ("first parasitic frequency", ("first_parasitic_frequency", False)),
        ("drive_stiffness", ("drive_stiffness", True)),
        ("higher:drive_stiffness", ("drive_stiffness", False)),
        ("lower: worst stiffness", ("worst_stiffness", True)),
        ({"by": "parts", "count": 3}, ("parts", True)),
    ],
)
def test_rank(given, rank):
    found = problem_of(small(rank=given))
    assert found.rank == rank
    assert problem_of(found.to_dict()).rank == rank


def test_inertia_in_every_form():
    six = [3e-5, 1e-6, 2e-6, 4e-5, -1e-6, 5e-5]
    matrix = np.array([[3e-5, 1e-6, 2e-6], [1e-6, 4e-5, -1e-6], [2e-6, -1e-6, 5e-5]])
    for given, wanted in (
        (4e-5, 4e-5 * np.eye(3)),
        ([3e-5, 4e-5, 5e-5], np.diag([3e-5, 4e-5, 5e-5])),
        (six, matrix),
        (matrix, matrix),
        ("40 kg mm2", 4e-5 * np.eye(3)),
    ):
        found = problem_of(small(mass=0.2, inertia=given))
        assert np.allclose(found.inertia, wanted, rtol=1e-14, atol=0)
        assert problem_of(found.to_dict()).to_dict() == found.to_dict()


# -- from a deck -----------------------------------------------------------------------------------


def held_stage(**more: object) -> flexact.Model:
    model = flexact.Model(**more)
    scale = 1000 if more else 1
    corners = [(-0.02, -0.02, 0), (0.02, -0.02, 0), (0.02, 0.02, 0), (-0.02, 0.02, 0)]
    places = [tuple(scale * part for part in each) for each in corners]
    model.body(places, name="stage")
    ground = (0.02 * scale, 0.02 * scale, 0.05 * scale)
    model.wire(ground, places[2], name="wire 1")
    model.fix(ground)
    model.independent("stage", "x")
    return model


def test_deck_gives_the_points_of_a_body_and_what_is_declared():
    model = held_stage()
    found = problem_of_deck(model, "stage", ground="0.06..0.08, -0.08..0.08, -0.08..0.08")
    assert found.base is model and found.body == "stage"
    assert sorted(found.stage.points.tolist()) == sorted(
        [[-0.02, -0.02, 0], [0.02, -0.02, 0], [0.02, 0.02, 0], [-0.02, 0.02, 0]]
    )
    assert np.allclose(twists(found), [[0, 0, 0, 1, 0, 0]])
    whole = found.to_dict()
    again = problem_of(whole)
    assert again.to_dict() == whole
    in_mm = problem_of_deck(held_stage(units="mm"), "stage", "rotation about (0, 1, 0) along z")
    assert np.allclose(twists(in_mm), [[0, 0, 1, 1e-3, 0, 0]])
    assert np.allclose(in_mm.size, found.size)


def test_rotation_without_a_point_is_about_a_line_that_the_body_can_turn_about():
    """A wire along z through (0.02, 0.02) leaves rotations along x about y = 0.02 alone."""
    found = problem_of_deck(held_stage(), "stage", "stage: rotation x")
    assert np.allclose(twists(found), [[1, 0, 0, 0, 0, -0.02]], atol=1e-12)
    # Of several rotations that meet, the middle is where they do.
    with pytest.raises(ModelError, match="'rotation x' is stopped"):
        problem_of_deck(held_stage(), "stage", "spherical")
    held = problem_of_deck(held_stage(), "stage", "spherical at (0.02, 0.02, 0)")
    assert held.freedom.dimension == 3


def test_problem_that_names_its_deck(tmp_path):
    file_of(tmp_path, "stage.dat", held_stage().to_deck())
    text = 'deck = "stage.dat"\nbody = "stage"\nwanted = "nothing"\n'
    found = problem_of_file(file_of(tmp_path, "a.toml", text))
    assert found.base is not None and found.wanted == ()
    text = 'deck = "stag.dat"\nwanted = "nothing"\n'
    with pytest.raises(DeckError, match="there is no such file"):
        problem_of_file(file_of(tmp_path, "b.toml", text))


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"body": "stag"}, "there is no body called 'stag'"),
        ({"body": "stage", "wanted": "rotation about P along x"}, "there is no point called 'P'"),
        ({"wanted": "nothing; z"}, "'translation z' is stopped by what holds 'stage' already"),
        ({"lenght": 3}, "did you mean length?"),
        ({"ground": "1..2, 3..4"}, "box 1 of the ground is none"),
    ],
)
def test_wrong_problem_of_a_deck_is_refused(given, says):
    with pytest.raises(ModelError, match=re.escape(says)):
        problem_of_deck(held_stage(), **given)


def test_deck_without_a_body_or_in_the_plane_is_refused():
    planar = flexact.Model(planar=True)
    planar.body([(0, 0), (0.1, 0)], name="stage")
    with pytest.raises(ModelError, match="the deck is planar"):
        problem_of_deck(planar, wanted="x")
    bar = flexact.Model()
    bar.truss((0, 0, 0), (1, 0, 0))
    with pytest.raises(ModelError, match="nothing in the deck is a body"):
        problem_of_deck(bar, wanted="x")


# -- nonsense --------------------------------------------------------------------------------------

SAME_TWICE = ["rotation x", "rotation about (0, 0, 0) along -x"]
THIRD_OF_TWO = ["translation x", "translation y", "translation (1, 1, 0)"]

NONSENSE = [
    # What is wanted.
    ({"wanted": None}, "nothing says what is wanted"),
    ({"wanted": 3}, "wanted motions are a list, not 3"),
    ({"wanted": [3]}, "a wanted motion is a text or a table, not 3"),
    ({"wanted": ["rotatoin x"]}, "did you mean rotation?"),
    ({"wanted": ["plannar z"]}, "did you mean planar?"),
    ({"wanted": ["planar"]}, "there is no direction"),
    ({"wanted": ["rotation about P along x"]}, "'P' in 'rotation about P along x' is no point"),
    ({"wanted": ["rotation about (0, 0, 20 kg) along x"]}, "which is a mass"),
    ({"wanted": ["rotation (0, 0, 0)"]}, "a direction is not zero"),
    ({"wanted": ["screw x"]}, "a screw needs a pitch"),
    ({"wanted": ["screw x pitch 3 kg"]}, "which is a mass"),
    ({"wanted": ["translation x pitch 3"]}, "a translation has no pitch"),
    ({"wanted": ["all but screw z pitch 0.01"]}, "of a screw there is no one opposite"),
    ({"wanted": ["all but translation x at (0,0,1) and translation y"]}, "are of two points"),
    ({"wanted": ["all but " * 500 + "z"]}, "is no motion"),
    ({"wanted": ["universal x"]}, "two directions are wanted"),
    ({"wanted": ["nothing at all"]}, "nothing stands behind nothing"),
    ({"wanted": ["x;; y"]}, "there is no motion between two semicolons"),
    ({"wanted": [{"kind": "rotaton", "direction": [1, 0, 0]}]}, "did you mean rotation?"),
    ({"wanted": [{"direction": [1, 0, 0]}]}, "a wanted motion has no kind"),
    ({"wanted": [{"kind": "rotation"}]}, "the rotation has no direction"),
    ({"wanted": [{"kind": "rotation", "direction": [0, 0, 0]}]}, "the direction is zero"),
    ({"wanted": [{"kind": "rotation", "direction": [1, 0]}]}, "has three numbers"),
    ({"wanted": [{"kind": "rotation", "direction": [1, 0, math.nan]}]}, "is not finite"),
    ({"wanted": [{"kind": "rotation", "direction": "w"}]}, "the direction has three numbers"),
    ({"wanted": [{"kind": "screw", "direction": "x"}]}, "a screw needs a pitch"),
    ({"wanted": [{"kind": "screw", "direction": "x", "pitch": "1 N"}]}, "which is a force"),
    ({"wanted": [{"kind": "rotation", "direction": "x", "pitch": 3}]}, "a rotation has no pitch"),
    (
        {"wanted": [{"kind": "rotation", "direction": "x", "piont": [0, 0, 0]}]},
        "did you mean point",
    ),
    ({"wanted": SAME_TWICE}, "is the same motion as 'rotation x'"),
    ({"wanted": THIRD_OF_TWO}, "follows from 'translation x' and 'translation y'"),
    ({"wanted": ["planar z", "rotation z"]}, "is the same motion as 'rotation z'"),
    (
        {"wanted": ["rotation x", "rotation about (0, 0, 1e-7) along x"]},
        "is nearly the same motion",
    ),
    ({"wanted": ["x, y, z, rx, ry, rz", "screw z pitch 0.01"]}, "follows from 'translation z'"),
    # Regions.
    ({"stage": {"boxes": []}}, "the stage has no boxes and no points"),
    ({"stage": {}}, "the stage has no boxes and no points"),
    ({"ground": []}, "the ground has no boxes and no points"),
    ({"ground": {"boxes": 3}}, "boxes of the ground are a list, not 3"),
    ({"ground": ["..."]}, "box 1 of the ground is none: '...'"),
    ({"ground": [[[1, 2], [3, 4]]]}, "the low corner of box 1 of the ground has three numbers"),
    ({"ground": [[[1, 2, 3]]]}, "box 1 of the ground is none"),
    ({"ground": [[[0.1, 0, 0], [0.09, 1, 1]]]}, "x from 0.1 m to 0.09 m: the first is larger"),
    ({"ground": [[["20 kg", 0, 0], [1, 1, 1]]]}, "not '20 kg', which is a mass"),
    ({"ground": [[["0.06", 0, 0], [1, 1, 1]]]}, "a text says its unit"),
    ({"ground": [[[math.inf, 0, 0], [1, 1, 1]]]}, "is not finite: inf"),
    ({"ground": [[[1e300, 0, 0], [2e300, 1, 1]]]}, "is more than 1000 km away"),
    ({"ground": [[[True, 0, 0], [1, 1, 1]]]}, "is a number [m], not True"),
    ({"ground": {"points": [[0, 0]]}}, "point 1 of the ground has three numbers"),
    ({"stage": None}, "there is ground and no stage"),
    ({"ground": [[[-1, -1, -1], [1, 1, 1]]]}, "box 1 of the stage lies in box 1 of the ground"),
    ({"ground": {"points": [[0, 0, 0]]}}, "box 1 of the stage lies in point 1 of the ground"),
    ({"stage": {"points": [[0.07, 0, 0]]}}, "point 1 of the stage lies in box 1 of the ground"),
    ({"keep_out": [[[-1, -1, -1], [0.05, 1, 1]]]}, "what is kept out covers all of the stage"),
    ({"keep_out": [[[-1, -1, -1], [0, 1, 1]], [[0, -1, -1], [0.05, 1, 1]]]}, "all of the stage"),
    ({"keep_out": [[[0.05, -1, -1], [1, 1, 1]]]}, "what is kept out covers all of the ground"),
    ({"keep_out": {"points": [[0, 0, 0]]}}, "there is no key 'points' in [keep_out]"),
    # Numbers.
    ({"size": 0}, "size is zero: 0"),
    ({"size": -1}, "size is negative"),
    ({"size": 1e9}, "size is too large"),
    ({"size": 1e-30}, "size is too small"),
    ({"size": 10**400}, "size is a number [m]"),
    ({"centre": [0, 0]}, "the centre has three numbers"),
    ({"length": 0}, "length is zero"),
    ({"length": [0.03]}, "length has 1 numbers, not one or two"),
    ({"length": [0.09, 0.03]}, "the least length is larger than the largest"),
    ({"length": ["30 mm", "2 s"]}, "the largest length: a length [m] is wanted"),
    ({"width": [-0.01, 0.03]}, "the least width is negative"),
    ({"thickness": "0.3"}, "thickness: a text says its unit"),
    ({"thickness": 0.3}, "the thickness of a sheet, 0.3 m, is not less than its width"),
    ({"diameter": 1}, "the diameter of a wire, 1 m, is not less than its length"),
    ({"clearance": -1}, "clearance is negative"),
    ({"clearance": [1, 2]}, "clearance is a number [m]"),
    ({"bodies": -1}, "bodies can be 0 to 10, not -1"),
    ({"bodies": 1.5}, "bodies is a whole number, not 1.5"),
    ({"over_constraint": -1}, "over_constraint can be 0 to 100, not -1"),
    ({"over_constraint": "one"}, "over_constraint is a whole number, not 'one'"),
    ({"count": 0}, "count can be 1 to 1000, not 0"),
    ({"count": math.nan}, "count is a whole number"),
    ({"mass": -0.2}, "mass is negative"),
    ({"mass": "20 mm"}, "not '20 mm', which is a length"),
    ({"mass": 1e30}, "mass is too large"),
    ({"mass": 1, "inertia": [1, 2]}, "inertia has 2 numbers"),
    ({"mass": 1, "inertia": [1, 1, 3]}, "no body has this inertia"),
    ({"mass": 1, "inertia": [[1, 2, 0], [0, 1, 0], [0, 0, 1]]}, "is not symmetric"),
    ({"mass": 1, "inertia": [[1, 2], [0, 1], [0, 0]]}, "no matrix of three rows"),
    ({"mass": 1, "inertia": -4e-5}, "inertia is negative"),
    ({"inertia": 4e-5}, "there is inertia and no mass"),
    # Words.
    ({"title": 3}, "title is a text, not 3"),
    ({"units": "inch"}, "units are 'm' or 'mm', not 'inch'"),
    ({"kinds": []}, "kinds is empty"),
    ({"kinds": ["wires", "shet"]}, "'shet' is no kind of flexure"),
    ({"kinds": [3]}, "3 is no kind of flexure"),
    ({"symmetry": "3-fold"}, "the symmetry '3-fold' is none"),
    ({"symmetry": "1-fold about z"}, "the symmetry '1-fold about z' is none"),
    ({"symmetry": 3}, "the symmetry 3 is none"),
    ({"rank": "stiffnes"}, "layouts cannot be ordered by 'stiffnes'"),
    ({"rank": 3}, "rank is a text, not 3"),
    ({"rank": {"by": "wrost stiffness"}}, "did you mean worst stiffness"),
    ({"material": "stele"}, "there is no material 'stele'"),
    ({"material": 3}, "a material is a name or a table, not 3"),
    ({"material": {"E": 2e11}}, "the material has no G"),
    ({"material": {"E": 2e11, "G": -1}}, "G of a material cannot be -1"),
    ({"material": {"E": 2e11, "G": "8 kg"}}, "which is a mass"),
    ({"material": {"E": 2e11, "G": 8e10, "nu": 0.3}}, "a material has no key 'nu'"),
    ({"material": {"E": 1e-30, "G": 8e10}}, "E of the material is 1e-30 Pa"),
    ({"material": {"E": [1], "G": 8e10}}, "E of the material is a number, not [1]"),
    # Keys.
    ({"masss": 3}, "there is no key 'masss' at the top", "did you mean mass?"),
    ({"limits": 3}, "limits are a table, not 3"),
    ({"limits": {"lenght": 1}}, "did you mean length?"),
    ({"limits": {"length": [0.03, 0.09]}, "length": [0.03, 0.09]}, "length is given twice"),
    ({"keep_out": {"boxes": [], "mass": 1}}, "it stands above all tables or in [stage]"),
    ({"qqq": 3}, "there are title, units, wanted"),
    ({"problems": []}, "this file holds several problems"),
    ({"body": "arm"}, "there is no deck that a body 'arm' could be of"),
    ({"deck": 3}, "a deck is a file, or its text, not 3"),
    ({"deck": "COORD 1 0\nBEAM\n"}, "deck 'COORD 1 0'"),
]


@pytest.mark.parametrize("case", NONSENSE, ids=lambda case: re.sub(r"\W+", "_", case[1])[:50])
def test_nonsense_is_refused_in_words(case, tmp_path):
    change, *says = case
    with pytest.raises(ModelError) as caught:
        problem_of(small(**change))
    for each in says:
        assert each in str(caught.value)
    assert "nan" not in str(caught.value).replace("inertia", "").lower() or "nan" in repr(change)
    given = small(**change)
    with pytest.raises(DeckError) as again:
        problem_of_file(file_of(tmp_path, "a.json", json.dumps(given)))
    # The same is said of a file, with its place.
    assert {each.message for each in again.value.diagnostics} == {
        each.message for each in caught.value.diagnostics
    }
    if next(iter(change.values())) is not None and "nothing says" not in says[0]:
        assert any(each.line > 0 for each in again.value.diagnostics)


def test_all_that_is_wrong_is_said_at_once_with_its_place(tmp_path):
    text = HINGE.replace("mass    = 0.2", 'mass = "20 mm"').replace("0.3e-3", "0")
    text = text.replace('"sheet"', '"shet"').replace("[rank]\nby", "[rank]\nbye")
    text = text.replace("along x", "alnog x")
    with pytest.raises(DeckError) as caught:
        problem_of_file(file_of(tmp_path, "hinge.toml", text))
    found = [(each.line, each.column, each.last_column) for each in caught.value.diagnostics]
    lines = text.splitlines()
    marked = [lines[line - 1][first - 1 : last] for line, first, last in found]
    assert marked == [
        '"rotation about (0, 0, 0) alnog x"',
        '"20 mm"',
        "0",
        '"shet"',
        "bye",
    ]
    assert str(caught.value).count("^") >= 5 and "hinge.toml: 5 errors" in str(caught.value)


def test_tables_in_lists_of_toml_have_places(tmp_path):
    text = """\
[[wanted]]
kind = "rotation"
direction = [1, 0, 0]
[[wanted]]
'kind' = "rotaton" # a comment with "quotes"
direction = [
  0, # and one here
  1, 0]
[stage."boxes".a]
"""
    with pytest.raises(DeckError) as caught:
        problem_of_file(file_of(tmp_path, "a.toml", text))
    first, second = caught.value.diagnostics
    assert (first.line, first.column, first.last_column) == (5, 10, 18)
    assert (second.line, second.code) == (9, "bad-region")


def test_dependent_motions_are_both_shown(tmp_path):
    text = 'wanted = [\n  "rotation x",\n  "y",\n  {kind = "rotation", direction = [2, 0, 0]},\n]\n'
    with pytest.raises(DeckError) as caught:
        problem_of_file(file_of(tmp_path, "a.toml", text))
    (item,) = caught.value.diagnostics
    assert item.code == "dependent-motions"
    assert (item.line, item.column) == (4, 3)
    assert item.other is not None and (item.other.line, item.other.column) == (2, 3)


@pytest.mark.parametrize(
    ("name", "text", "says"),
    [
        ("a.toml", "wanted = [\n", "this is no TOML"),
        ("a.toml", "size = 20 mm\n", 'stands in quotes: "20 mm"'),
        ("a.toml", "size = 1\nsize = 2\n", "this is no TOML"),
        ("a.toml", "a = " + "[" * 3000, "this is no TOML|too deep"),
        ("a.toml", "a = " + "[" * 40 + "]" * 40, "too deep"),
        ("a.toml", "size = " + "9" * 5000, "too many digits"),
        ("a.toml", b'title = "\xe9"\n', "not written in UTF-8"),
        ("a.toml", "title = 'a'".encode("utf-16"), "in UTF-16"),
        ("a.toml", "", "nothing says what is wanted"),
        ("a.json", "", "this is no JSON"),
        ("a.json", "{'wanted': []}", "this is no JSON"),
        ("a.json", '{"size": 20 mm}', 'stands in quotes: "20 mm"'),
        ("a.json", "[1, 2]", "there are no keys in this JSON"),
        ("a.json", '{"wanted": [], "wanted": ["x"]}', "'wanted' is given twice"),
        ("a.json", '{"size": NaN, "wanted": []}', "size is not finite"),
        ("a.json", '{"size": 1e999, "wanted": []}', "size is not finite"),
        ("a.json", '{"a": ' + "[" * 100000 + "]" * 100000 + "}", "too deep|this is no JSON"),
        ("a.json", "{" + " " * 2**20 + "}", "the file is too large"),
        ("a.txt", "wanted = []", "the suffix '.txt' is none of a problem"),
        ("a.dat", "BEAM", "a deck (.dat) takes --body"),
    ],
)
def test_file_that_is_none_is_refused(name, text, says, tmp_path):
    with pytest.raises(DeckError) as caught:
        problem_of_file(file_of(tmp_path, name, text))
    assert any(each in str(caught.value) for each in says.split("|"))


def test_file_that_is_not_there(tmp_path):
    with pytest.raises(DeckError, match="there is no such file"):
        problem_of_file(tmp_path / "a.toml")
    (tmp_path / "b.toml").mkdir()
    with pytest.raises(DeckError, match="this is a folder"):
        problem_of_file(tmp_path / "b.toml")
    with pytest.raises(DeckError, match="cannot be read"):
        problem_of_file("a\0.toml")
    with pytest.raises(TypeError, match="a problem is a mapping"):
        problem_of([1])


def test_box_is_checked():
    assert repr(box((0, 0, 0), ("1 mm", 1, 2))) == "flexact.box((0.0, 0.0, 0.0), (0.001, 1.0, 2.0))"
    with pytest.raises(ModelError, match="the first is larger"):
        box((0, 0, 0), (-1, 1, 1))
    with pytest.raises(ModelError, match="has three numbers"):
        box((0, 0), (1, 1, 1))


def test_errors_beyond_a_hundred_are_counted(tmp_path):
    boxes = [[[0, 0, "1 kg"], [1, 1, 1]]] * 500
    with pytest.raises(ModelError) as caught:
        problem_of(small(ground=boxes))
    assert caught.value.problems.errors == 500
    with pytest.raises(DeckError, match="500 errors"):
        problem_of_file(file_of(tmp_path, "a.json", json.dumps(small(ground=boxes))))
    with pytest.raises(ModelError, match="has 3000 boxes: at most 2000"):
        problem_of(small(ground=[[[1, 1, 1], [2, 2, 2]]] * 3000))


# -- anything --------------------------------------------------------------------------------------

_BITS = [
    "[",
    "]",
    "{",
    "}",
    '"',
    "'",
    ",",
    "=",
    ":",
    "#",
    "\n",
    ".",
    "-",
    "1e999",
    "nan",
    "0",
    "mm",
]
_BITS += [
    " kg",
    "true",
    "null",
    "[[a]]\n",
    '"""',
    "\\",
    "é",
    "\t",
    "planar z",
    "all but ",
    "x;",
    "(1,",
]
_VALUES: list[object] = [
    None,
    True,
    0,
    -1,
    1e308,
    math.nan,
    "",
    "20 kg",
    "x",
    [],
    {},
    [[]],
    [1, 2, 3],
]
_VALUES += [
    10**50,
    "all but ",
    "(0, 0",
    {"boxes": [[]]},
    {"low": 3},
    "1..2, 3..4, 5..6",
    [None],
    "mm",
]


def places_in(tree: object) -> list[tuple]:
    """All places in lists and tables, with what holds them."""
    entries = tree.items() if isinstance(tree, dict) else enumerate(tree)
    found = []
    for key, each in list(entries):
        found.append((tree, key))
        if isinstance(each, (dict, list)):
            found += places_in(each)
    return found


def test_mutated_texts_never_end_in_a_traceback(tmp_path):
    """What is no problem is a FlexactError whose words hold no surprise; seeds are fixed."""
    chance = random.Random(33)
    texts = {
        "a.toml": HINGE,
        "b.json": json.dumps(PROBLEMS["screw"]),
        "c.toml": toml_of(PROBLEMS["ball"]),
    }
    refused = 0
    for turn in range(200):
        name = chance.choice(sorted(texts))
        text = texts[name]
        for _ in range(chance.randint(1, 4)):
            at = chance.randrange(len(text))
            cut = chance.choice((0, 0, 1, 3, 20))
            text = text[:at] + chance.choice((*_BITS, "")) + text[at + cut :]
        try:
            problem_of_file(file_of(tmp_path, name, text))
        except ProblemsError as error:
            refused += 1
            assert str(error), turn
            for each in error.diagnostics:
                lines = text.split("\n")
                assert each.line <= len(lines)
                assert not each.line or each.column <= len(lines[each.line - 1]) + 1
    assert refused > 70


def test_mutated_values_never_end_in_a_traceback():
    chance = random.Random(34)
    refused = 0
    for _ in range(150):
        given = json.loads(json.dumps(PROBLEMS[chance.choice(sorted(PROBLEMS))]))
        given["keep_out"] = {"boxes": [[[0.03, 0.03, 0.03], [0.04, 0.04, 0.04]]]}
        for _ in range(chance.randint(1, 3)):
            holder, key = chance.choice(places_in(given))
            holder[key] = deepcopy(chance.choice(_VALUES))
        try:
            found = problem_of(given)
            assert problem_of(found.to_dict()).to_dict() == found.to_dict()
        except ModelError as error:
            refused += 1
            assert str(error)
    assert refused > 70
