# SPDX-License-Identifier: BSD-3-Clause
"""The search for layouts: distances, isometries, the choice of flexures, images, bodies held."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import flexact
from flexact.designs import candidates, choice, geometry, images, search
from flexact.designs.design import place_of
from flexact.designs.frame import scaled, signed_permutations, turned_screws
from flexact.designs.layouts import declared, model_of, snapped
from flexact.designs.problem import Problem
from flexact.designs.reading import problem_of

STAGE = flexact.box((-0.02, -0.02, -0.01), (0.02, 0.02, 0.01))
FRAME = [
    flexact.box((0.06, -0.08, -0.08), (0.08, 0.08, 0.08)),
    flexact.box((-0.08, -0.08, -0.08), (-0.06, 0.08, 0.08)),
    flexact.box((-0.08, 0.06, -0.08), (0.08, 0.08, 0.08)),
    flexact.box((-0.08, -0.08, -0.08), (0.08, -0.06, 0.08)),
]


def problem(wanted: object = "rotation about (0, 0, 0) along x", **given: object) -> Problem:
    """A stage in a frame."""
    usual = {
        **{"stage": STAGE, "ground": FRAME, "length": (0.03, 0.09), "width": (0.01, 0.03)},
        **{"thickness": 0.3e-3, "diameter": 1e-3, "clearance": 2e-3, "kinds": ["wire", "sheet"]},
    }
    return problem_of({"wanted": wanted, **usual, **given})


def strip(random: np.random.Generator, thin: bool) -> np.ndarray:
    """A rectangle, or a segment, at random."""
    start = random.normal(size=3)
    end = start + random.normal(size=3)
    half = np.cross(end - start, random.normal(size=3))
    return np.array([start, end, half * (0.0 if thin else 0.4 / np.linalg.norm(half))])


@pytest.mark.parametrize("thin", list(itertools.product((True, False), repeat=2)))
def test_distances_are_those_of_bounded_least_squares(thin: tuple[bool, bool]) -> None:
    """The least distance of two rectangles is a least-squares problem of four bounded numbers."""
    optimise = pytest.importorskip("scipy.optimize")
    random = np.random.default_rng(7)
    for _ in range(60):
        one, other = (strip(random, each) for each in thin)
        across = np.stack((one[1] - one[0], one[2], other[0] - other[1], -other[2]), axis=1)
        off = other[0] - one[0]
        bounds = ([0, -1, 0, -1], [1, 1, 1, 1])
        best = optimise.lsq_linear(across, off, bounds=bounds, tol=1e-14, max_iter=500).x
        expected = np.linalg.norm(across @ best - off)
        found = geometry.between_strips(one, other[None])[0]
        assert found == pytest.approx(expected, abs=1e-9)


def test_a_rectangle_that_crosses_a_box_is_seen() -> None:
    """A dense grid of points on the rectangle is the other way to see it."""
    random = np.random.default_rng(3)
    low, high = np.array([-0.3, -0.2, -0.1]), np.array([0.2, 0.3, 0.4])
    share = np.linspace(0.0, 1.0, 60)
    for _ in range(200):
        one = strip(random, False) * 0.6
        along, beside = np.meshgrid(share, 2.0 * share - 1.0)
        points = one[0] + along[..., None] * (one[1] - one[0]) + beside[..., None] * one[2]
        if geometry.within(points, low, high).any():
            assert geometry.meets_box(one[None], low, high)[0]
        # Grown by the grid's step nothing is missed.
        elif not geometry.within(points, low - 0.05, high + 0.05).any():
            assert not geometry.meets_box(one[None], low, high)[0]


def test_isometries_of_a_problem_keep_it() -> None:
    """A stage in a square frame that turns about x: half turns and mirrors, and no quarter turn."""
    frame = scaled(problem())
    assert len(frame.isometries) == 8
    for turn in frame.isometries:
        moved = turned_screws(turn, frame.freedom)
        assert abs(abs(moved @ frame.freedom.T)) == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize("number", [0, 7, 29, 46])
def test_a_turned_problem_has_the_same_frame(number: int) -> None:
    """To the bit: so all that follows is the same."""
    turn = list(signed_permutations())[number]
    one = problem("screw about (0, 0, 0.004) along (1, 2, 0) pitch 0.003")
    given = one.to_dict()
    for region in ("stage", "ground"):
        boxes = [np.sort(np.array(box) @ turn.T, axis=0) for box in given[region]["boxes"]]
        given[region]["boxes"] = [box.tolist() for box in boxes]
    (motion,) = given["wanted"]
    # A mirror turns a screw of one sense into one of the other.
    motion["direction"] = (turn @ motion["direction"]).tolist()
    motion["point"] = (turn @ motion["point"]).tolist()
    motion["pitch"] *= float(np.linalg.det(turn))
    here, there = scaled(one), scaled(problem_of(given))
    assert np.array_equal(here.freedom, there.freedom)
    for ours, theirs in zip(here.ground.boxes, there.ground.boxes, strict=True):
        assert np.array_equal(ours.low, theirs.low)
        assert np.array_equal(ours.high, theirs.high)


def test_candidates_hold_nothing_of_what_is_wanted() -> None:
    """A force along a line does no work on a rotation where the line meets the axis."""
    given = problem("rotation about (0, 0.005, 0) along x", kinds=["wire"])
    frame = scaled(given)
    found = candidates.wires(place_of(given, frame))
    assert len(found) > 100
    for start, end in frame.back(found.ends[::37]):
        along = (end - start) / np.linalg.norm(end - start)
        moment = np.cross(start - (0.0, 0.005, 0.0), along)
        assert moment[0] == pytest.approx(0.0, abs=1e-12)


def test_the_choice_is_as_good_as_trying_all() -> None:
    """Of few wires all sets of five can be tried."""
    given = problem(kinds=["wire"])
    place = place_of(given, scaled(given))
    few = search.thinned(candidates.wires(place), 22)
    blocks = choice.blocks_of(few, place.constraint)
    clear = np.array(
        [
            choice.clear_of(few.strips[k], few.radius, few, place.sizes.clearance)
            for k in range(len(few))
        ]
    )
    best = 0.0
    for places in itertools.combinations(range(len(few)), 5):
        if all(clear[i, j] for i, j in itertools.combinations(places, 2)):
            rows = blocks.weighted[list(places), 0]
            best = max(best, float(np.linalg.svd(rows, compute_uv=False)[-1]) ** 2)
    allowed = [np.ones(len(few), dtype=bool)] * 5
    found = choice.chosen_sets([blocks] * 5, 5, choice.Clearances(place.sizes.clearance), allowed)
    assert max(each.stiffness for each in found) >= 0.95 * best


def test_recipes_hold_just_what_is_to_be_held() -> None:
    """The sum of what their flexures hold; never two whole sheets that are exact."""
    every = search.recipes(5, ["wire", "sheet", "waisted sheet", "folded sheet"])
    assert all(sum(search.HOLDS[kind] for kind in recipe) == 5 for recipe in every)
    assert all(recipe.count("sheet") <= 1 for recipe in every)
    assert ("sheet", "waisted sheet") in every
    over = search.recipes(5, ["sheet"], 1)
    assert over == [("sheet", "sheet")]


def test_three_images_of_a_wire_are_a_set() -> None:
    """Of a third of a turn, all in the regions and clear of each other."""
    given = problem("planar z", ground=[flexact.box((-0.08, -0.08, -0.08), (0.08, 0.08, -0.06))])
    frame = scaled(given)
    place = place_of(given, frame)
    group = images.group_of(3, frame.turn @ np.array([0.0, 0.0, 1.0]))
    sets = images.orbits(group, candidates.wires(place, 5), place)
    three = next(each for each in sets if each.members.shape[1] == 3)
    for members in three.members[:20]:
        ends = three.candidates.ends[members]
        for turn in group.turns:
            images_ = {tuple(np.round(each.ravel(), 9) + 0.0) for each in ends @ turn.T}
            assert images_ == {tuple(np.round(each.ravel(), 9) + 0.0) for each in ends}


def test_coordinates_that_tell_motions_apart_are_declared() -> None:
    """Of an oblique rotation the one that turns most."""
    assert declared(problem("rotation about (0, 0, 0) along x").freedom) == ("rx",)
    assert declared(problem("planar z").freedom) == ("x", "y", "rz")
    assert declared(problem("rotation about (0, 0, 0) along (1, 2, 0)").freedom) == ("ry",)


def test_places_are_as_one_would_type_them() -> None:
    """Rounding of short decimals is taken back, and no more than that."""
    near = np.array([0.1 + 0.2 - 0.27, 0.06000000000000001, 1.0 / 3.0, 1e-19])
    assert snapped(near, 0.05).tolist() == [0.03, 0.06, 0.333333333333333, 0.0]


def half_guide() -> flexact.Model:
    """A stage on one sheet, of the two that would guide it."""
    model = flexact.Model(name="half a guide", units="mm")
    model.sheet((0, 0, 0), (100, 0, 0), "z", name="sheet 1", section=(20, 0.3), material="steel")
    model.fix((0, 0, 0))
    points = [(100, 0, 0), (100, 50, 0), (100, 50, 30), (100, 20, -30)]
    model.body(points, name="stage")
    model.independent("stage", "y")
    return model


def test_what_holds_a_body_already_counts() -> None:
    """Two of five constraints are missing; the deck keeps its units and what it declares."""
    ground = flexact.box((-0.01, 0.03, -0.05), (0.01, 0.07, 0.05))
    found = flexact.design(
        half_guide(), body="stage", wanted="translation y", ground=[ground], count=4
    )
    assert len(found) == 4
    for layout in found:
        analysis = flexact.analyse(layout.model)
        assert analysis.verdict is flexact.Verdict.EXACT
        assert layout.model.units == "mm"
        added = [flexure for flexure in layout.flexures if flexure.kind != "sheet 1"]
        assert sum(search.HOLDS[flexure.form] for flexure in added) == 2
        declared_of = [each.part for each in analysis.freedoms if each.owner[0] == "node"]
        assert declared_of == ["y"]
    script: dict[str, object] = {}
    exec(found[0].python().replace("print(", "analysis = ("), script)
    assert "exactly constrained" in str(script["analysis"]).lower()


def test_what_is_stopped_already_cannot_be_wanted() -> None:
    """A sheet stops the translation along it."""
    ground = flexact.box((-0.01, 0.03, -0.05), (0.01, 0.07, 0.05))
    with pytest.raises(flexact.ModelError, match="stop"):
        flexact.design(half_guide(), body="stage", wanted="translation x", ground=[ground])


def test_a_script_makes_the_model_of_its_layout() -> None:
    """The same deck, line by line."""
    found = flexact.design(problem(kinds=["wire", "sheet", "waisted sheet", "folded sheet"]))
    for layout in found:
        made: dict[str, object] = {}
        exec(layout.python().replace("print(", "analysis = ("), made)
        model = made["model"]
        assert isinstance(model, flexact.Model)
        again = model_of(layout.problem, layout.flexures, layout.bodies)
        assert np.array_equal(model.positions, again.positions)
        assert np.array_equal(model.deformation_classes, again.deformation_classes)
        assert np.array_equal(model.coordinate_classes, again.coordinate_classes)
