# SPDX-License-Identifier: BSD-3-Clause
"""Notches, rods, struts and bellows of layouts.

What each leaves free is told by closed forms: rotations about the axes of notches, all but the
force along a strut, all but the couple along a bellows. Stiffness is that of the tests' own reader
of decks (`tests/reference/design_structure.py`), layouts are judged by `design_oracle.py`, which
is independent of the package.
"""

import copy
import json
import math

import numpy as np
import pytest
from design_answers_by_hand import design_oracle, problems
from design_structure import Structure
from designs_by_hand import SIZE, STEEL, D, E, G, T, W, problem_of

import flexact
from flexact.designs.candidates import outside
from flexact.designs.design import design, place_of, sizes_of
from flexact.designs.frame import scaled
from flexact.designs.layouts import Flexure, Layout, counted, model_of, verified
from flexact.designs.problem import Box, Region
from flexact.designs.rods import (
    SHOWN_AS,
    bellows,
    height_of,
    notches,
    outer_sizes,
    reach_of,
    rods,
    struts,
)
from flexact.designs.scores import unit_rows
from flexact.designs.search import HOLDS, recipes
from flexact.model.bellows import bellows_make
from flexact.model.notches import NotchContour

PROBLEMS = problems()
NU = E / (2.0 * G) - 1.0
LEAST = 0.02
X, Y, Z = np.eye(3)


def turn(axis, point=(0.0, 0.0, 0.0)):
    """A rotation about a line."""
    return np.concatenate((axis, np.cross(point, axis)))


def move(way):
    return np.concatenate((np.zeros(3), way))


ENDS = np.array(((0.01, 0.002, 0.003), (0.05, 0.002, 0.003)))
AT = np.array((0.025, 0.002, 0.003))
NOTCH = Flexure(
    *("notch 1", "notch", ("stage", "ground"), ENDS),
    **{"width": W, "thickness": T, "normal": -Y, "via": AT[None], "axes": Z[None]},
)
AWAY = reach_of(T, LEAST)
NOTCHES = np.array((ENDS[0] + AWAY * X, ENDS[1] - AWAY * X))
ROD = Flexure(
    *("rod 1", "notch", ("stage", "ground"), ENDS),
    **{"width": W, "thickness": T, "normal": -Y, "via": NOTCHES, "axes": np.array((Z, Z))},
)
STRUT = Flexure(
    *("strut 1", "notch", ("stage", "ground"), ENDS),
    **{"diameter": D, "via": NOTCHES, "axes": np.zeros((2, 3))},
)
BELLOWS = Flexure("bellows 1", "bellows", ("stage", "ground"), ENDS, width=W)
#: Each with the motions that it leaves.
ALONE = {
    "notch": (NOTCH, [turn(Z, AT)]),
    "rod": (ROD, [turn(Z, each) for each in NOTCHES]),
    "strut": (STRUT, [turn(X, AT), turn(Y, AT), turn(Z, AT), move(Y), move(Z)]),
    "bellows": (BELLOWS, [move(X), move(Y), move(Z), turn(Y), turn(Z)]),
}


@pytest.mark.parametrize("form", ALONE)
def test_what_each_leaves_free(form):
    flexure, freedom = ALONE[form]
    problem = problem_of(*freedom)
    found = verified(problem, model_of(problem, [flexure]))
    assert flexure.form == form
    assert not found.over_constrained
    assert not found.under_constrained
    assert found.internal == (form == "strut")
    assert found.freedom_error < 1.0e-12
    assert found.analysis.proof is not None


@pytest.mark.parametrize("form", ALONE)
def test_unit_rows_hold_what_is_not_left_free(form):
    flexure, freedom = ALONE[form]
    rows = unit_rows(flexure, np.zeros(3), SIZE)
    assert len(rows) == HOLDS[form] == 6 - len(freedom)
    assert np.linalg.matrix_rank(rows, 1e-9) == len(rows)
    # (w, v) of the freedom, moments in forces times L.
    works = rows[:, :3] @ np.array(freedom)[:, 3:].T
    works += SIZE * rows[:, 3:] @ np.array(freedom)[:, :3].T
    assert np.abs(works).max() < 1e-12


def compliance(flexure):
    """(6, 6) of the stage against wrenches (f, m) about the centre, from the deck alone."""
    freedom = ALONE[flexure.form][1]
    deck = model_of(problem_of(*freedom), [flexure]).to_deck()
    problem = {"centre": [0.0, 0.0, 0.0], "size": 1.0, "material": {}}
    elastic = Structure(deck, problem, [flexure.name]).elastic()
    # Twists (w, v) of the stage by wrenches (m, f).
    found = elastic.stage @ np.linalg.solve(elastic.stiffness, elastic.stage.T)
    return np.roll(np.roll(found, 3, axis=0), 3, axis=1)


def sought(freedom, stage, ground, keep_out=()):
    """A problem between boxes, its frame and place."""
    from dataclasses import replace

    def boxes(given):
        return tuple(Box(*np.array(each, float)) for each in given)

    problem = replace(
        problem_of(*freedom),
        stage=Region(boxes(stage)),
        ground=Region(boxes(ground)),
        keep_out=boxes(keep_out),
    )
    frame = scaled(problem)
    return problem, frame, place_of(problem, frame)


STAGE = [((-0.02, -0.02, -0.01), (0.02, 0.02, 0.01))]
GROUND = [
    ((0.06, -0.08, -0.08), (0.08, 0.08, 0.08)),
    ((-0.08, 0.06, -0.08), (0.08, 0.08, 0.08)),
    ((-0.08, -0.08, 0.06), (0.08, 0.08, 0.08)),
]
SOUGHT = {
    "notch": (notches, [turn(X)]),
    "rod": (rods, [move(Z)]),
    "strut": (struts, [turn(X), turn(Y)]),
    "bellows": (bellows, [move(X), move(Y), move(Z)]),
}


def as_flexure(problem, frame, found, k):
    """A candidate, as a layout would have it."""
    form, size = found.kind, problem.size
    return Flexure(
        *(f"{form} 1", SHOWN_AS.get(form, form), ("stage", "ground"), frame.back(found.ends[k])),
        diameter=D if form == "strut" else 0.0,
        width=found.width[k] * size,
        thickness=T if form in ("notch", "rod") else 0.0,
        normal=frame.turned_back(found.normal[k]),
        via=frame.back(found.via[k]),
        axes=frame.turned_back(found.axes[k]),
    )


@pytest.mark.parametrize("form", SOUGHT)
def test_stiffness_for_the_choice_is_that_of_the_deck(form):
    """What is released free, the compliance against what is held is the deck's."""
    make, freedom = SOUGHT[form]
    problem, frame, place = sought(freedom, STAGE, GROUND)
    found = make(place)
    size = problem.size
    for k in np.linspace(0, len(found) - 1, 4).astype(int):
        flexure = as_flexure(problem, frame, found, k)
        # From the frame to the problem: forces turn, moments change their sense in mirrors.
        sense = np.linalg.det(frame.turn)
        rows = np.concatenate(
            (found.rows[k, :, :3] @ frame.turn, sense * size * found.rows[k, :, 3:] @ frame.turn),
            axis=1,
        )
        given = np.linalg.inv(found.stiffness[k] * E * size)
        own = rows @ compliance(flexure) @ rows.T
        assert own == pytest.approx(given, rel=1e-6, abs=1e-6 * np.abs(given).max())


@pytest.mark.parametrize("form", SOUGHT)
def test_candidates_are_within_regions_and_limits(form):
    make, freedom = SOUGHT[form]
    keep = ((0.03, -0.03, -0.03), (0.05, 0.03, 0.0))
    problem, frame, place = sought(freedom, STAGE, GROUND, [keep])
    found = make(place)
    assert len(found) > 4
    assert found.rows.shape[1] == HOLDS[form]
    assert outside(place.freedom, found.rows).max() < 1e-9
    low, high = np.array(keep) + problem.limits.clearance * np.array(((-1,), (1,)))
    for k in range(len(found)):
        flexure = as_flexure(problem, frame, found, k)
        a, b = flexure.ends
        length = np.linalg.norm(b - a)
        assert LEAST * (1 - 1e-9) <= length <= 0.09 * (1 + 1e-9)
        u = (b - a) / length
        sizes = flexure.diameter, flexure.width, flexure.thickness
        diameter, breadth, height = outer_sizes(form, *sizes, LEAST)
        if diameter:
            across = np.linalg.svd(u[None])[2][1:]
            angles = np.linspace(0.0, 2.0 * math.pi, 24, endpoint=False)
            rim = diameter / 2.0 * np.stack((np.cos(angles), np.sin(angles)), axis=1) @ across
        else:
            deep = np.cross(flexure.axes[0], u)
            assert abs(flexure.axes @ u).max() < 1e-9
            rim = np.array(
                [
                    s * breadth / 2.0 * flexure.axes[0] + t * height / 2.0 * deep
                    for s in (-1, 1)
                    for t in (-1, 1)
                ]
            )
        # Whole end faces are within one box.
        for end, boxes in ((a, STAGE), (b, GROUND)):
            inside = [
                ((end + rim >= np.array(low_) - 1e-9) & (end + rim <= np.array(high_) + 1e-9)).all()
                for low_, high_ in boxes
            ]
            assert any(inside)
        # Between the ends none of the surface is near to what is kept out.
        along = a + np.linspace(0.0, 1.0, 41)[:, None] * (b - a)
        points = (along[:, None] + rim).reshape(-1, 3)
        assert not ((points > low + 1e-9) & (points < high - 1e-9)).all(axis=1).any()
        for place_ in flexure.via:
            assert AWAY - 1e-9 <= (place_ - a) @ u <= length - AWAY + 1e-9 or form == "strut"


def test_where_there_is_none():
    """Notches need one rotation or nothing, rods a plane, bellows a couple."""
    free = {
        "translation": [move(Z)],
        "screw": [np.concatenate((Z, 0.01 * Z))],
        "two rotations that meet": [turn(X), turn(Y)],
        "two parallel rotations": [turn(X), turn(X, (0.0, 0.03, 0.0))],
        "two skew rotations": [turn(X, (0.0, 0.0, 0.01)), turn(Y, (0.0, 0.0, -0.01))],
        "ball": [turn(X), turn(Y), turn(Z)],
    }
    found = {}
    for name, freedom in free.items():
        place = sought(freedom, STAGE, GROUND)[2]
        found[name] = tuple(len(make(place)) > 0 for make in (notches, rods, struts, bellows))
    assert found == {
        "translation": (False, True, True, True),
        "screw": (False, False, True, True),
        "two rotations that meet": (False, False, True, True),
        "two parallel rotations": (False, True, True, True),
        "two skew rotations": (False, False, True, True),
        "ball": (False, False, True, False),
    }


def asked(name, kinds, wanted=None):
    """An answer to a problem with other kinds of flexures, judged."""
    problem = copy.deepcopy(PROBLEMS[name])
    problem["limits"]["kinds"] = kinds
    problem["wanted"] = problem["wanted"] if wanted is None else wanted
    problem["symmetry"] = "none"
    problem.pop("expect")
    found = design({key: value for key, value in problem.items() if key != "source"})
    seen = set()
    for layout in json.loads(found.to_json())["layouts"]:
        if layout["what"] in seen:
            continue
        seen.add(layout["what"])
        wrong, _ = design_oracle.judge_layout(problem, layout)
        assert wrong == [], layout["what"]
    return found


def whats(found) -> set[str]:
    return {layout.what.split(",")[0] for layout in found}


PARALLEL = [
    {"kind": "rotation", "direction": [1, 0, 0], "point": [0, 0, 0]},
    {"kind": "rotation", "direction": [1, 0, 0], "point": [0, 0.03, 0]},
]


@pytest.mark.dear(3)
@pytest.mark.parametrize(
    ("name", "kinds", "wanted", "expected"),
    [
        ("hinge", ["notch"], None, {"a notch", "a rod with two notches and a strut"}),
        ("guide", ["wire", "notch"], None, {"a rod with two notches and a wire"}),
        ("universal_joint", ["notch"], None, {"four struts"}),
        ("universal_joint", ["notch"], PARALLEL, {"a rod with two notches"}),
        ("hexapod", ["notch"], None, {"six struts", "a notch and a strut"}),
        ("ball", ["notch"], None, {"three struts"}),
        ("xyz", ["bellows"], None, {"three bellows"}),
        ("xy", ["wire", "bellows"], None, {"a bellows and three wires"}),
        ("schoenflies", ["wire", "bellows"], None, {"two bellows"}),
    ],
)
def test_layouts_hold_by_an_independent_computation(name, kinds, wanted, expected):
    found = asked(name, kinds, wanted)
    assert whats(found) >= expected
    assert not found.refused
    for layout in found:
        assert layout.internal == sum(each.form == "strut" for each in layout.flexures)
        apart(layout, found.problem)


def apart(layout: Layout, problem):
    """Solids as thick as bars and cylinders are, which the judge takes as thin, keep clear."""
    solids = []
    for each in layout.flexures:
        a, b = each.ends
        u = (b - a) / np.linalg.norm(b - a)
        sizes = each.diameter, each.width, each.thickness
        diameter, breadth, height = outer_sizes(each.form, *sizes, problem.limits.length[0])
        half = [(b - a) / 2.0]
        if height:
            half += [breadth / 2.0 * each.axes[0], height / 2.0 * np.cross(each.axes[0], u)]
        solids.append(design_oracle.Solid((a + b) / 2.0, np.array(half), diameter / 2.0))
    for k, one in enumerate(solids):
        for other in solids[k + 1 :]:
            gap = design_oracle.distance(one, other)
            assert gap >= problem.limits.clearance - 1e-9, layout.what


def test_a_script_makes_the_model():
    for name, kinds in (("hinge", ["notch"]), ("xyz", ["bellows"])):
        layout = asked(name, kinds)[0]
        made: dict[str, object] = {}
        exec(layout.python().rpartition("print(")[0], made)
        model = made["model"]
        again = flexact.analyse(model)
        assert again.verdict == flexact.analyse(layout.model).verdict
        lines = [
            [line for line in each.to_deck().splitlines() if "stage" not in line]
            for each in (model, layout.model)
        ]
        assert lines[0] == lines[1]


def test_recipes_take_few_of_what_holds_much():
    for count in range(1, 7):
        for recipe in recipes(count, ("wire", "sheet", "notch")):
            assert sum(HOLDS[kind] for kind in recipe) == count
            assert sum(kind in ("notch", "rod", "sheet") for kind in recipe) <= 1
    assert recipes(5, ("notch",)) == [("strut",) * 5, ("notch",), ("rod", "strut")]
    assert recipes(3, ("bellows",)) == [("bellows",) * 3]
    assert recipes(4, ("wire", "bellows"), 0, 1) == [("wire", "wire", "wire", "bellows")]
    # Where wires span W no bellows is taken.
    assert recipes(4, ("wire", "bellows")) == [("wire",) * 4]


def test_words():
    assert counted([ROD, NOTCH, STRUT]) == "a notch, a rod with two notches and a strut"
    assert counted([ROD, ROD]) == "two rods with two notches"
    assert counted([STRUT] * 6) == "six struts"
    assert counted([BELLOWS] * 3) == "three bellows"


# What flexures are as stiff as ------------------------------------------------------------

OUTER, WALL, DEPTH, PITCH, LONG = 0.02, 1.0e-4, 3.0e-3, 3.0e-3, 0.06


def test_a_bellows_by_its_walls():
    """Along as clamped strips in a row, in bending as a ring of springs, in twist as a shell."""
    made = bellows_make(LONG, OUTER, WALL, DEPTH, PITCH, STEEL)
    assert made.stiffness is not None
    axial, twist, bend, other, *shear = made.stiffness
    count, mean = 20, OUTER - DEPTH
    # A strip between guided ends gives w^3/(12 E' I), two in each convolution.
    second = math.pi * mean * WALL**3 / 12.0
    give = 2 * count * DEPTH**3 / (12.0 * E / (1.0 - NU**2) * second)
    assert axial == pytest.approx(LONG / give, rel=1e-12)
    angles = (np.arange(360) + 0.5) * math.pi / 180.0
    ring = np.mean((mean / 2.0 * np.cos(angles)) ** 2) / give
    assert bend == other == pytest.approx(ring * LONG, rel=1e-9)
    assert shear == [0.0, 0.0]
    # The meridian in small steps, each a thin tube that twists by T ds/(2 pi r^3 G t).
    radius = np.linspace(OUTER / 2.0 - DEPTH, OUTER / 2.0, 20001)
    middle = (radius[:-1] + radius[1:]) / 2.0
    walls = 2.0 * np.sum(np.diff(radius) / middle**3)
    flats = PITCH / 2.0 * (1.0 / radius[0] ** 3 + 1.0 / radius[-1] ** 3)
    turned = count * (walls + flats) / (2.0 * math.pi * G * WALL)
    assert twist == pytest.approx(LONG / turned, rel=1e-6)
    # What it is made of, by Pappus.
    assert made.mass is not None
    walls = 2.0 * math.pi * ((OUTER / 2.0) ** 2 - (OUTER / 2.0 - DEPTH) ** 2) * WALL
    flats = math.pi * PITCH * WALL * (OUTER - DEPTH)
    assert made.mass[0] == pytest.approx(STEEL.density * (walls + flats) / PITCH, rel=1e-12)


def test_a_bellows_as_a_part():
    model = flexact.Model(units="mm")
    made = model.bellows((0, 0, 0), (60, 0, 0), "y", "b", diameter=20, thickness=0.1, depth=3)
    model.fix((0, 0, 0))
    model.body([(60, 0, 0)], name="stage")
    assert made.name == "b"
    assert "ESTIFF" in model.to_deck()
    for sizes in ({"diameter": 20, "depth": 10}, {"diameter": 20, "thickness": 2}):
        with pytest.raises(flexact.ModelError, match="b"):
            flexact.Model(units="mm").bellows((0, 0, 0), (60, 0, 0), name="b", **sizes)
    with pytest.raises(flexact.ModelError):
        flexact.Model(planar=True).bellows((0, 0), (60, 0), diameter=20)


@pytest.mark.parametrize("length", [2.0e-3, 5.0e-3, 20.0e-3, 80.0e-3])
def test_a_notch_that_cannot_warp(length):
    """A long even strip: Vlasov's torsion with both ends held, x = (L/b) sqrt(6/(1 + nu))."""
    breadth, thickness = 20.0e-3, 0.2e-3
    notch = NotchContour(
        "fillet",
        **{"thickness": thickness, "breadth": breadth, "radius": 1e-6, "length": length},
        material=STEEL,
    )
    torsion = float(notch.compliance[3])
    x = length / breadth * math.sqrt(6.0 / (1.0 + NU))
    exact = torsion * (1.0 - math.tanh(x) / x)
    assert exact * 0.999 <= notch.held_torsion <= exact * 1.13
    assert notch.held_torsion < torsion


def test_a_notch_with_held_warping_in_a_model():
    """Of the same notch torsion alone is stiffer, by the deck's own numbers."""
    found = []
    for warping in (False, True):
        model = flexact.Model()
        sizes = {"thickness": T, "breadth": W, "radius": 3e-3, "material": STEEL}
        middle = model.node(0.0033, 0.0, 0.0)
        model.notch(
            *((0, 0, 0), "z", (0.0066, 0, 0), "n"), contour="circular", warping=warping, **sizes
        )
        model.body([middle, (0.0066, 0, 0)], name="stage")
        model.fix((0, 0, 0))
        problem = {"centre": [0.0033, 0.0, 0.0], "size": 1.0, "material": {}}
        elastic = Structure(model.to_deck(), problem, ["n"]).elastic()
        found.append(elastic.stage @ np.linalg.solve(elastic.stiffness, elastic.stage.T))
    free, held = found
    contour = NotchContour("circular", thickness=T, breadth=W, radius=3e-3, material=STEEL)
    assert free[0, 0] == pytest.approx(contour.compliance[3], rel=1e-6)
    assert held[0, 0] == pytest.approx(contour.held_torsion, rel=1e-6)
    free[0, 0] = held[0, 0]
    assert held == pytest.approx(free, rel=1e-6, abs=1e-10 * np.abs(free).max())


def test_sizes_follow_from_the_limits():
    problem = problem_of(move(Z))
    sizes = sizes_of(problem)
    assert sizes.thickness == pytest.approx(T / SIZE)
    assert height_of(T, LEAST) == pytest.approx(T + 2.0 * LEAST / 8.0)
    assert height_of(T, 0.03) == pytest.approx(21.0 * T)
