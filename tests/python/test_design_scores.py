# SPDX-License-Identifier: BSD-3-Clause
"""Scores of layouts, against closed forms and against finite elements of the tests' own."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from designs_by_hand import (
    MASS,
    SIZE,
    STEEL,
    D,
    E,
    G,
    T,
    W,
    condensed,
    folded,
    layout_of,
    modes,
    problem_of,
    sheet,
    system,
    wire,
)

import flexact
from flexact.designs.layouts import Flexure
from flexact.designs.scores import (
    DEAR,
    SCORES,
    NoScoreError,
    cell,
    cheap_scores,
    constraint_rows,
    dear_scores,
    error_response,
    pareto,
    rank_by,
    rank_given,
    ranked,
    softest_of,
    strokes_of,
    table_of,
    thermal_centre,
    unit_of_stroke,
    unit_rows,
)
from flexact.model.sections import Material
from flexact.util.rotations import matrix_of, vector_of_euler

TURN_X, MOVE_X, MOVE_Y, MOVE_Z = np.eye(6)[[0, 3, 4, 5]]
NU = E / (2.0 * G) - 1.0


def hexapod(problem=None):
    """Three bipods of wires, on a stage that is held in all six ways."""
    made = []
    for k in range(6):
        foot, top = (
            2.0 * math.pi * (k // 2) / 3.0 + (0.6, -0.6)[k % 2],
            2.0 * math.pi * (k // 2) / 3,
        )
        a = (0.02 * math.cos(top), 0.02 * math.sin(top), 0.01 - 0.004 * (k % 2))
        made.append(wire(f"wire {k + 1}", a, (0.05 * math.cos(foot), 0.05 * math.sin(foot), -0.03)))
    return problem or problem_of(), made, ()


def guide():
    """Two whole sheets, over-constrained by one, about the middle of which the stage is."""
    a, b = (-0.03, 0.0), (0.03, 0.0)
    made = [sheet(f"sheet {k}", (*a, z), (*b, z), (0, 0, 1)) for k, z in ((1, 0.02), (2, -0.02))]
    return problem_of(MOVE_Z), made, ("z",)


def cross_hinge():
    """Two whole sheets that cross along x, apart, at half their length."""
    made = [
        sheet("sheet 1", (0.015, -0.03, -0.03), (0.015, 0.03, 0.03), (0, 1, -1)),
        sheet("sheet 2", (-0.015, -0.03, 0.03), (-0.015, 0.03, -0.03), (0, 1, 1)),
    ]
    return problem_of(TURN_X), made, ("rx",)


def hinge():
    """A sheet and two wires."""
    made = [
        sheet("sheet 1", (0, 0, -0.01), (0, 0, -0.06), (0, 1, 0)),
        wire("wire 1", (0.02, 0.01, 0), (0.02, 0.07, 0)),
        wire("wire 2", (-0.02, 0.01, 0), (-0.025, 0.06, 0)),
    ]
    return problem_of(TURN_X), made, ("rx",)


def five():
    """Five folded sheets, whose folds are across z."""
    made = []
    for k, (x, y, z, along) in enumerate(
        [
            (0.02, 0.02, 0.01, 0),
            (0.02, -0.02, 0.01, 0),
            (-0.02, 0.0, -0.01, 0),
            (0.0, 0.02, 0.01, 1),
            (0.0, -0.02, -0.01, 1),
        ]
    ):
        p, axis = np.array((x, y, z)), np.eye(3)[along]
        # Along y to both sides; the middle one of those that fold about x to +y as well.
        out = np.array(((0, 1, 0), (0, -1, 0), (0, 1, 0), (-1, 0, 0), (1, 0, 0)))[k]
        fold = p + 0.04 * out
        made.append(
            folded(f"folded {k + 1}", p, fold, fold + 0.01 * out - np.array((0, 0, 0.05)), axis)
        )
    return problem_of(MOVE_Z), made, ("z",)


def layers():
    """x on a layer of y, each a sheet and two wires, with a body without mass between."""
    upper, lower = ("stage", "body 1"), ("body 1", "ground")
    made = [
        sheet("sheet 1", (0.02, 0, 0), (0.02, 0, -0.05), (1, 0, 0), upper),
        wire("wire 1", (-0.02, 0.015, 0), (-0.02, 0.015, -0.05), upper),
        wire("wire 2", (-0.02, -0.015, 0), (-0.02, -0.06, 0), upper),
        sheet("sheet 2", (0, 0.02, -0.05), (0, 0.02, 0), (0, 1, 0), lower),
        wire("wire 3", (0.015, -0.02, -0.05), (0.015, -0.02, 0), lower),
        wire("wire 4", (-0.015, -0.02, -0.05), (-0.07, -0.02, -0.05), lower),
    ]
    return problem_of(MOVE_X, MOVE_Y), made, ("x", "y")


EVERY = (hexapod, guide, cross_hinge, hinge, five, layers)


def across_of(problem):
    """T and N, by the test's own: unit twists, with (w L, v)."""
    rows = np.array([m.twist for m in problem.wanted]).reshape(-1, 6)
    rows = rows * np.repeat((problem.size, 1.0), 3)
    full = np.linalg.qr(np.vstack((rows, np.eye(6))).T)[0]
    wanted = full[:, : len(rows)]
    return wanted, np.linalg.svd(wanted.T)[2][len(rows) :].T if len(rows) else np.eye(6)


def expected(problem, flexures, pieces=1):
    """Worst and drive stiffness, first and first parasitic frequency, by finite elements."""
    stiff, mass = system(problem, flexures, pieces)
    wanted, basis = across_of(problem)
    stage = condensed(stiff)
    hertz, twists = modes(stiff, mass)
    within = np.sum((wanted.T @ twists) ** 2, axis=0)
    rest = np.delete(hertz, np.argsort(-within)[: wanted.shape[1]])
    made = {
        "worst_stiffness": np.linalg.eigvalsh(basis.T @ stage @ basis).min(),
        "first_frequency": hertz.min(),
        "first_parasitic_frequency": rest.min(),
    }
    if wanted.shape[1]:
        made["drive_stiffness"] = np.linalg.eigvalsh(wanted.T @ stage @ wanted).max()
    return made


@pytest.mark.parametrize("make", EVERY)
def test_scores_are_those_of_finite_elements(make):
    """Stiffness to rounding; frequencies but for how mass is lumped."""
    problem, flexures, declared = make()
    found = cheap_scores(layout_of(problem, flexures, declared).model, problem, flexures)
    wanted = expected(problem, flexures)
    for key, value in wanted.items():
        limit = 1.0e-6 if key.endswith("stiffness") else 1.0e-3
        assert found[key] == pytest.approx(value, rel=limit), key
    assert ("drive_stiffness" in found) == ("drive_stiffness" in wanted)
    assert all(math.isfinite(value) for value in found.values())


def test_scores_of_random_layouts_are_those_of_finite_elements():
    """Any freedoms, wires, sheets and folded sheets, with up to two bodies between."""
    rng = np.random.default_rng(33)

    def direction():
        u = rng.normal(size=3)
        return u / np.linalg.norm(u)

    for _ in range(30):
        centre = 0.01 * rng.normal(size=3)
        twists = [
            np.concatenate((direction(), 0.03 * rng.normal(size=3)))
            if rng.random() < 0.7
            else np.concatenate((np.zeros(3), direction()))
            for _ in range(rng.integers(0, 6))
        ]
        problem = problem_of(*twists, centre=centre, size=rng.choice((0.02, 0.05, 0.1)))
        names = ["stage", *(f"body {k}" for k in range(rng.integers(0, 3))), "ground"]
        made = []
        for between in pairwise(names):
            for _ in range(rng.integers(2, 6)):
                a, u = centre + 0.03 * rng.normal(size=3), direction()
                b, n = a + rng.uniform(0.03, 0.08) * u, np.cross(u, direction())
                n = n / np.linalg.norm(n)
                last = b + 0.04 * np.cross(n, u) + 0.01 * u
                name = f"flexure {len(made) + 1}"
                kinds = (
                    wire(name, a, b, between),
                    sheet(name, a, b, n, between),
                    folded(name, a, b, last, n, between),
                )
                made.append(kinds[rng.integers(3)])
        found = cheap_scores(layout_of(problem, made).model, problem, made)
        for key, value in expected(problem, made).items():
            limit = 1.0e-6 if key.endswith("stiffness") else 1.0e-2
            assert found[key] == pytest.approx(value, rel=limit), key


@pytest.mark.parametrize("make", [hexapod, layers])
def test_an_arbitrary_place_and_size_change_what_they_must_alone(make):
    """Turned, shifted, scaled by s: stiffness by s, frequencies by 1/s; all else by geometry."""
    problem, flexures, _declared = make()
    scale, place = 1.0e-3, np.array((0.3, -0.2, 0.1))
    turn = matrix_of(np.array((0.3, -0.5, 0.7)))

    def moved(places):
        return place + scale * places @ turn.T

    other = [
        replace(
            *(f,),
            **{name: scale * getattr(f, name) for name in ("diameter", "width", "thickness")},
            ends=moved(f.ends),
            normal=turn @ f.normal,
        )
        for f in flexures
    ]
    there = replace(
        problem,
        wanted=tuple(
            replace(m, twist=np.concatenate((turn @ m.twist[:3], turn @ m.twist[3:])))
            for m in problem.wanted
        ),
        **{"centre": place, "size": scale * SIZE, "mass": MASS * scale**3},
        inertia=problem.inertia * scale**5,
    )
    first = cheap_scores(layout_of(problem, flexures).model, problem, flexures)
    second = cheap_scores(layout_of(there, other).model, there, other)
    powers = {"N/m": 1, "Hz": -1, "m/K": 1}
    assert first.keys() == second.keys()
    for key in first.keys() - {"room"}:
        factor = scale ** powers.get(SCORES[key].unit, 0)
        assert second[key] == pytest.approx(factor * first[key], rel=1.0e-6), key


# -- closed forms ----------------------------------------------------------------------------------


def test_a_parallel_guide_has_the_stiffness_of_its_closed_form():
    """Two clamped-guided sheets, 24 E I/l^3, softer by shear, 1/(1 + 12 E I/(G A k l^2))."""
    problem, flexures, declared = guide()
    layout = layout_of(problem, flexures, declared, over=1)
    found = cheap_scores(layout.model, problem, flexures)
    length, bending = 0.06, E * W * T**3 / 12.0
    k = 10.0 * (1.0 + NU) / (12.0 + 11.0 * NU)
    shear = 12.0 * bending / (G * W * T * k * length**2)
    assert found["drive_stiffness"] == pytest.approx(
        24.0 * bending / length**3 / (1.0 + shear), rel=1.0e-8
    )
    # Its own mass moves by 3 x^2 - 2 x^3, which is 13/35 of it.
    own = 2.0 * 13.0 / 35.0 * STEEL.density * W * T * length
    square = found["drive_stiffness"] / (MASS + own)
    assert found["first_frequency"] == pytest.approx(math.sqrt(square) / (2 * math.pi), rel=1e-6)
    # Stage and clamp part by the expansion.
    assert found["thermal_drift"] == pytest.approx(1.0e-5 * length, rel=1.0e-8)
    assert found["room"] == pytest.approx(length * W * (0.04 + T), rel=1.0e-8)
    assert found["separation"] == pytest.approx(
        found["worst_stiffness"] / found["drive_stiffness"], rel=1.0e-8
    )
    assert (found["parts"], found["kinds"]) == (2.0, 1.0)


def test_a_parallel_guide_has_the_stroke_of_its_closed_form():
    """Soemers: sigma l^2/(3 E t); for large strokes a little less."""
    problem, flexures, declared = guide()
    layout = layout_of(problem, flexures, declared, over=1)
    found, reasons = dear_scores(layout)
    assert not reasons
    assert found["stroke"] == pytest.approx(300e6 * 0.06**2 / (3.0 * E * T), rel=0.02)
    (name, value, unit, reason), *others = strokes_of(layout)
    assert (name, unit, others) == ("z", "m", []) and value == pytest.approx(found["stroke"])
    assert reason.startswith("the strength (300 MPa) in sheet")
    assert unit_of_stroke(problem) == "m"
    assert 0.0 < found["stiffness_at_the_end_of_the_stroke"] < 1.0
    assert 0.0 < found["tightest_tolerance"] < 1.0e-3


def test_a_material_with_a_strength_of_its_own_ends_the_stroke_there():
    problem, flexures, declared = guide()
    strong = replace(problem, material=Material("strong", E, G, 7800.0, 600.0e6))
    given = dear_scores(layout_of(problem, flexures, declared), ["stroke"])[0]["stroke"]
    there = dear_scores(layout_of(strong, flexures, declared), ["stroke"])[0]["stroke"]
    # Twice but for what large strokes add.
    assert there == pytest.approx(2.0 * given, rel=0.05)


def test_a_wire_of_a_held_stage_buckles_as_a_clamped_column():
    """Euler: 4 pi^2 E I/l^2, of the longest wire."""
    problem, flexures, declared = hexapod()
    name, load = softest_of(layout_of(problem, flexures, declared))
    length = max(np.linalg.norm(f.ends[1] - f.ends[0]) for f in flexures)
    column = 4.0 * math.pi**2 * E * math.pi * D**4 / 64.0 / length**2
    assert load == pytest.approx(column, rel=5.0e-3)
    assert np.linalg.norm(np.diff(flexures[int(name[-1]) - 1].ends, axis=0)) == (
        pytest.approx(length)
    )


def test_wires_across_each_other_turn_with_errors_by_their_closed_form():
    """Three wires in a plane, tangential at r: each turns the stage by e/3r, moves it by 2e/3."""
    radius = 0.02
    made = []
    for k in range(3):
        angle = 2.0 * math.pi * k / 3.0
        out = np.array((math.cos(angle), math.sin(angle), 0.0))
        along = np.array((-math.sin(angle), math.cos(angle), 0.0))
        made.append(wire(f"wire {k + 1}", radius * out, radius * out + 0.05 * along))
    problem = problem_of(*np.eye(6)[[0, 1, 5]])
    layout = layout_of(problem, made, ("z", "rx", "ry"))
    found = cheap_scores(layout.model, problem, made)
    # A N has the singular values sqrt(3/2) twice, and sqrt(3) r/L.
    assert found["turns_with_errors"] == pytest.approx(
        1.0 / min(math.sqrt(1.5), math.sqrt(3.0) * radius / SIZE), rel=1.0e-8
    )
    response = error_response(made, problem)
    assert response[2] == pytest.approx(np.full(3, SIZE / (3.0 * radius)), rel=1.0e-9)
    assert np.linalg.norm(response[3:5], axis=0) == pytest.approx(np.full(3, 2.0 / 3.0), rel=1e-9)
    # Warmer by a kelvin: each is longer by alpha l, and so the stage turns about its middle.
    assert found["thermal_drift"] == 0.0
    assert thermal_centre(layout.model, problem, made) == pytest.approx(np.zeros(3), abs=1e-12)


def test_a_thermal_centre_stays():
    """A stage that turns when it is warm turns about a point of it, which is found again there."""
    radius, shift = 0.02, np.array((0.004, -0.003, 0.0))
    made = []
    for k in range(3):
        angle = 2.0 * math.pi * k / 3.0
        out = np.array((math.cos(angle), math.sin(angle), 0.0))
        along = np.array((-math.sin(angle), math.cos(angle), 0.0))
        a = shift + radius * out
        made.append(wire(f"wire {k + 1}", a, a + 0.05 * along))
    problem = problem_of(*np.eye(6)[[0, 1, 5]])
    layout = layout_of(problem, made, ("z", "rx", "ry"))
    assert thermal_centre(layout.model, problem, made) == pytest.approx(shift, abs=1.0e-9)
    turn = 1.0e-5 * 0.05 / radius
    found = cheap_scores(layout.model, problem, made)["thermal_drift"]
    # The wires bend besides, against which they push.
    assert found == pytest.approx(turn * np.linalg.norm(shift), rel=1.0e-3)
    # A guide only moves.
    problem, made, declared = guide()
    said = thermal_centre(layout_of(problem, made, declared).model, problem, made)
    assert said == "the stage moves without turning: no point of it stays"


def test_the_expansion_of_the_material_counts():
    problem, flexures, _ = guide()
    warm = replace(problem, material=Material("warm", E, G, 7800.0, expansion=23.0e-6))
    found = cheap_scores(layout_of(warm, flexures).model, warm, flexures)
    assert found["thermal_drift"] == pytest.approx(23.0e-6 * 0.06, rel=1.0e-8)


# -- errors ----------------------------------------------------------------------------------------


def moved_of(state):
    """(6,) the twist (w L, v) of the stage, whose point is the first node and at the origin."""
    there = state.finest.raw.configuration
    return np.concatenate((SIZE * vector_of_euler(there[:, 1]), there[:3, 0]))


@pytest.mark.parametrize("make", [hexapod, hinge, layers])
def test_errors_of_lengths_move_the_stage_as_the_formula_says(make):
    """N (A N)^-1 e, against a real model in which one flexure after the other is too long."""
    problem, flexures, declared = make()
    rigid = flexact.elastic(layout_of(problem, flexures, declared).model, "rigid", beams=1)
    _, basis = across_of(problem)
    response, error, row = error_response(flexures, problem), 1.0e-7, 0
    for flexure in flexures:
        # Its first row is the force along it, and e is by how much it is too short.
        moved = moved_of(rigid.misfit(flexure.name, 1, error))
        wanted = -error * response[:, row]
        assert basis.T @ moved == pytest.approx(basis.T @ wanted, abs=1.0e-5 * error)
        row += len(unit_rows(flexure, problem.centre, problem.size))


def test_errors_of_lines_turn_the_freedom_as_the_formula_says():
    """-N (A N)^-1 dA T, against the motion of a real model with a wire that ends elsewhere."""
    problem, flexures, declared = hinge()
    wanted, basis = across_of(problem)
    for which, off in ((1, (2.0e-5, 0, 1.0e-5)), (2, (0, 0, -2.0e-5))):
        other = list(flexures)
        ends = flexures[which].ends + np.array(((0, 0, 0), off))
        other[which] = replace(flexures[which], ends=ends)
        change = constraint_rows(other, problem) - constraint_rows(flexures, problem)
        turned = -error_response(flexures, problem) @ change @ wanted[:, 0]
        rigid = flexact.elastic(layout_of(problem, other, declared).model, "rigid", beams=1)
        before, after = (moved_of(s) for s in rigid.along("stage", "rx", (-1.0e-4, 1.0e-4)))
        motion = after - before
        found = basis.T @ motion / (wanted[:, 0] @ motion)
        assert np.linalg.norm(found) > 1.0e-5
        assert found == pytest.approx(basis.T @ turned, abs=2.0e-3 * np.linalg.norm(turned))


def test_the_gain_is_the_most_that_unit_errors_move_the_stage():
    problem, flexures, _ = hinge()
    _, basis = across_of(problem)
    sizes = np.linalg.svd(constraint_rows(flexures, problem) @ basis)[1]
    found = cheap_scores(layout_of(problem, flexures).model, problem, flexures)
    assert found["turns_with_errors"] == pytest.approx(1.0 / sizes.min(), rel=1.0e-8)
    # Of an over-constrained one the pseudo-inverse, of which the rest is stress.
    problem, flexures, _ = cross_hinge()
    sizes = np.linalg.svd(constraint_rows(flexures, problem) @ across_of(problem)[1])[1]
    found = cheap_scores(layout_of(problem, flexures).model, problem, flexures)
    assert found["turns_with_errors"] == pytest.approx(1.0 / sizes.min(), rel=1.0e-8)


def test_what_does_not_hold_the_stage_by_itself_has_no_gain():
    """As flexures that come to those of a model which is there already."""
    problem, flexures, _ = hinge()
    with pytest.raises(NoScoreError, match="these flexures alone"):
        error_response(flexures[:2], problem)
    found = cheap_scores(layout_of(problem, flexures).model, problem, flexures[:2])
    assert "turns_with_errors" not in found and found["parts"] == 2.0


#: What each kind holds, by table "What each flexure holds" of the specification: forces (f, m) and
#: couples that it takes, and motions (w, v) on which it does no work, all about (1, 2, 3) cm.
AT, ALONG = np.array((0.01, 0.02, 0.03)), np.array((0.01, 0.0, 0.0))


def flexure_of(kind, via=(), axes=()):
    ends = np.array((AT - 3.0 * ALONG, AT + 3.0 * ALONG))
    given = {"via": np.reshape(via, (-1, 3)), "axes": np.reshape(axes, (-1, 3))}
    return Flexure("a", kind, ("stage", "ground"), ends, D, W, T, np.array((0, 0, 1.0)), **given)


@pytest.mark.parametrize(
    ("flexure", "free"),
    [
        # Twists about AT that the flexure leaves: all but those that its forces do work on.
        (flexure_of("wire"), np.eye(6)[[0, 1, 2, 4, 5]]),
        (flexure_of("sheet"), np.eye(6)[[0, 1, 5]]),
        (flexure_of("waisted sheet", [AT]), np.eye(6)[[0, 1, 2, 5]]),
        (flexure_of("folded sheet", [AT], [(0, 1, 0)]), np.eye(6)[[0, 1, 2, 3, 5]]),
        (flexure_of("notch", [AT], [(0, 0, 1)]), np.eye(6)[[2]]),
        # Two notches about z, 2 cm apart: both turns, of which the difference is a move along y.
        (
            flexure_of("notch", [AT - ALONG, AT + ALONG], [(0, 0, 1)] * 2),
            np.eye(6)[[2, 4]],
        ),
        (flexure_of("bellows"), np.eye(6)[1:]),
    ],
    ids=lambda given: getattr(given, "kind", ""),
)
def test_a_flexure_holds_what_its_kind_does(flexure, free):
    for centre in (AT, np.zeros(3)):
        rows = unit_rows(flexure, centre, SIZE)
        assert len(rows) == np.linalg.matrix_rank(rows) == 6 - len(free)
        # Forces are of 1, or there is none and the couple is.
        sizes = np.linalg.norm(unit_rows(flexure, AT, SIZE), axis=1)
        assert sizes == pytest.approx(np.ones(len(rows)))
        there = free.copy()
        there[:, 3:] += np.cross(free[:, :3], centre - AT)
        there[:, :3] *= SIZE
        assert np.roll(rows, 3, axis=1) @ there.T == pytest.approx(np.zeros((len(rows), len(free))))


# -- modes -----------------------------------------------------------------------------------------


def test_light_bodies_between_do_not_stand_for_a_wanted_motion():
    """A body between without mass has fast modes along x and y, in which the stage rests."""
    problem, flexures, declared = layers()
    found = cheap_scores(layout_of(problem, flexures, declared).model, problem, flexures)
    hertz, twists = modes(*system(problem, flexures))
    moves = np.abs(twists[3:5]).max(axis=0) > 0.5 / math.sqrt(MASS)
    assert moves.tolist()[:3] == [True, True, False]
    assert found["first_parasitic_frequency"] == pytest.approx(hertz[2], rel=1.0e-3)


@pytest.mark.parametrize("make", [five, layers])
def test_what_has_no_mass_follows_the_stage(make):
    """Bodies between and folds, of flexures without a density: six modes, of K condensed."""
    problem, flexures, declared = make()
    light = replace(problem, material=Material("light", E, G))
    found = cheap_scores(layout_of(light, flexures, declared).model, light, flexures)
    mass = np.diag((4.0e-5 / SIZE**2,) * 3 + (MASS,) * 3)
    hertz, twists = modes(condensed(system(light, flexures)[0]), mass)
    wanted, _ = across_of(light)
    within = np.sum((wanted.T @ twists) ** 2, axis=0)
    rest = np.delete(hertz, np.argsort(-within)[: wanted.shape[1]])
    assert found["first_frequency"] == pytest.approx(hertz[0], rel=1.0e-6)
    assert found["first_parasitic_frequency"] == pytest.approx(rest.min(), rel=1.0e-6)


def test_without_a_mass_there_are_no_frequencies():
    problem, flexures, _ = hinge()
    light = replace(problem, mass=0.0, inertia=np.zeros((3, 3)))
    found = cheap_scores(layout_of(light, flexures).model, light, flexures)
    assert found.keys() & {"first_frequency", "first_parasitic_frequency"} == set()
    assert found["worst_stiffness"] > 0.0


def test_a_wanted_turn_without_inertia_is_in_no_mode():
    """Of a point mass on a hinge of light flexures: nothing but parasitic modes are left."""
    problem, flexures, _ = hinge()
    light = replace(problem, inertia=np.zeros((3, 3)), material=Material("light", E, G))
    found = cheap_scores(layout_of(light, flexures).model, light, flexures)
    assert found["first_frequency"] == found["first_parasitic_frequency"]
    # The stage's compliance at its centre, all turns free.
    stiff = condensed(system(light, flexures)[0])
    moved = np.linalg.inv(stiff)[3:, 3:]
    square = 1.0 / np.linalg.eigvalsh(moved).max() / MASS
    wanted = math.sqrt(square) / (2.0 * math.pi)
    assert found["first_frequency"] == pytest.approx(wanted, rel=1.0e-6)


def test_a_drive_without_stiffness_is_told_as_such():
    """Five bars that only bear along: K is A'kA, and the mass that of the stage."""
    problem, flexures, _ = hinge()
    light = replace(problem, material=Material("light", E, G))
    ends = [flexures[1].ends, flexures[2].ends]
    ends += [np.array(((0, 0, -0.01), (y, 0, -0.06))) for y in (0.02, -0.02)]
    ends.append(np.array(((0.01, 0, -0.01), (0.02, 0, -0.06))))
    bars = [wire(f"wire {k}", a, b) for k, (a, b) in enumerate(ends)]
    model = flexact.Model()
    places = [tuple(bar.ends[0].tolist()) for bar in bars]
    model.body([(0, 0, 0), *places], "stage", mass=MASS, inertia=(4.0e-5,) * 3)
    for bar in bars:
        a, b = (tuple(end.tolist()) for end in bar.ends)
        model.truss(a, b, name=bar.name, section=D, material=light.material)
        model.fix(b)
    found = cheap_scores(model, light, bars)
    rows = constraint_rows(bars, light)
    lengths = np.array([np.linalg.norm(b - a) for a, b in ends])
    stiff = rows.T @ np.diag(E * math.pi * D**2 / 4.0 / lengths) @ rows
    _, basis = across_of(light)
    assert found["worst_stiffness"] == pytest.approx(
        np.linalg.eigvalsh(basis.T @ stiff @ basis).min(), rel=1.0e-6
    )
    assert (found["drive_stiffness"], found["first_frequency"]) == (0.0, 0.0)
    assert "separation" not in found
    mass = np.diag((4.0e-5 / SIZE**2,) * 3 + (MASS,) * 3)
    hertz, _ = modes(stiff, mass)
    assert found["first_parasitic_frequency"] == pytest.approx(np.sort(hertz)[1], rel=1.0e-6)


# -- what takes longer, or is not there ------------------------------------------------------------


@pytest.mark.parametrize("make", EVERY)
def test_what_a_layout_has_not_is_said(make):
    """Every dear score is a finite number, or a reason in words."""
    problem, flexures, declared = make()
    layout = layout_of(problem, flexures, declared, over=int(make in (guide, cross_hinge)))
    found, reasons = dear_scores(layout)
    assert sorted((*found, *reasons)) == sorted(DEAR)
    assert all(math.isfinite(value) and value > 0.0 for value in found.values())
    assert all(len(reason.split()) > 4 for reason in reasons.values())
    assert ("tightest_tolerance" in found) == bool(layout.over_constrained)
    assert ("stroke" in found) == bool(declared)


def test_a_stage_that_is_none_is_refused_in_words():
    problem, flexures, _ = hinge()
    model = layout_of(problem, flexures).model
    with pytest.raises(flexact.FlexactError, match="nothing"):
        cheap_scores(model, replace(problem, body="nothing"), flexures)
    flat = flexact.Model(planar=True)
    flat.body([(0, 0), (0, 1)], "stage")
    flat.sheet((0, 1), (1, 1), name="sheet 1", section=(W, T), material=STEEL)
    flat.fix((1, 1))
    with pytest.raises(NoScoreError, match="'stage' is no body that moves and turns in space"):
        cheap_scores(flat, problem, flexures)


def test_only_what_is_asked_is_computed():
    problem, flexures, declared = hinge()
    layout = layout_of(problem, flexures, declared)
    assert dear_scores(layout, ["tightest_tolerance", "room"]) == (
        {},
        {"tightest_tolerance": "it is exactly constrained: no error of a clamp stresses anything"},
    )


def test_a_turn_about_a_far_line_is_counted_as_a_turn():
    """A hinge whose line is 40 mm from the centre, driven by a displacement."""
    problem, flexures, _ = hinge()
    shift = np.array((0, 0, 0.04))
    moved = [replace(f, ends=f.ends - shift) for f in flexures]
    twist = np.concatenate((TURN_X[:3], np.cross(TURN_X[:3], shift)))
    far = problem_of(twist)
    ((name, value, unit, _),) = strokes_of(layout_of(far, moved, ("y",)))
    ((_, near, _, _),) = strokes_of(layout_of(problem, flexures, ("rx",)))
    assert (name, unit) == ("y", "rad")
    # The force of the drive acts elsewhere.
    assert value == pytest.approx(near, rel=0.05)


def test_turns_and_displacements_are_compared_at_the_size():
    """Wires along z: x, y and a turn, whose stroke counts by what it moves at L."""
    places = ((0.02, 0.0), (-0.01, 0.017), (-0.01, -0.017))
    made = [wire(f"wire {k}", (x, y, 0), (x, y, -0.06)) for k, (x, y) in enumerate(places)]
    problem = problem_of(MOVE_X, MOVE_Y, np.eye(6)[2])
    layout = layout_of(problem, made, ("x", "y", "rz"))
    ways = {name: (value, unit) for name, value, unit, _ in strokes_of(layout)}
    assert [unit for _, unit in ways.values()] == ["m", "m", "rad"]
    assert unit_of_stroke(problem) == "m"
    sizes = [value * (SIZE if unit == "rad" else 1.0) for value, unit in ways.values()]
    assert dear_scores(layout, ["stroke"])[0]["stroke"] == pytest.approx(min(sizes), rel=1.0e-8)


# -- order -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "rank"),
    [
        ("worst_stiffness", ("worst_stiffness", False)),
        ("  Worst  stiffness ", ("worst_stiffness", False)),
        ("drive stiffness", ("drive_stiffness", True)),
        ("lower:drive_stiffness", ("drive_stiffness", True)),
        ("higher: drive stiffness", ("drive_stiffness", False)),
        ("lower:worst-stiffness", ("worst_stiffness", True)),
        ("thermal drift", ("thermal_drift", True)),
        ("stiffness at the end of the stroke", ("stiffness_at_the_end_of_the_stroke", False)),
    ],
)
def test_a_rank_is_a_key_or_words(text, rank):
    assert rank_given(text) == rank
    assert rank_given(rank_by(rank)) == (rank if rank[1] else (rank[0], SCORES[rank[0]].lower))


@pytest.mark.parametrize("text", ["", "stiffnes", "lower:", "first mode", "\x1b[31m", "lower:x"])
def test_a_rank_that_is_none_is_refused_in_words(text):
    with pytest.raises(flexact.ModelError, match="layouts cannot be ordered by"):
        rank_given(text)


def scored(number, what, **scores):
    problem, flexures, _ = guide()
    layout = layout_of(problem, flexures[:1], number=number, what=what)
    return replace(layout, scores=scores)


def test_layouts_are_ordered_by_the_score_that_is_asked():
    every = [
        scored(1, "b", worst_stiffness=2.0),
        scored(2, "none"),
        scored(3, "a", worst_stiffness=2.0),
        scored(4, "c", worst_stiffness=3.0),
    ]
    for given in (every, every[::-1]):
        best = [each.number for each in ranked(given, ("worst_stiffness", False))]
        assert best == [4, 3, 1, 2]
        assert [each.number for each in ranked(given, ("worst_stiffness", True))] == [3, 1, 4, 2]


def test_the_pareto_set_holds_what_nothing_else_beats():
    def one(worst, drive, first, parts):
        keys = ("worst_stiffness", "drive_stiffness", "first_parasitic_frequency", "parts")
        return scored(1, "a", **dict(zip(keys, (worst, drive, first, parts), strict=True)))

    best = one(2.0, 1.0, 100.0, 5)
    worse = one(1.0, 1.0, 100.0, 5)
    other = one(1.0, 0.5, 100.0, 5)
    assert pareto([best, worse, other, best]) == (True, False, True, True)
    # A score that is not there is as bad as can be, and no one else is beaten by that.
    assert pareto([best, scored(1, "a", worst_stiffness=1.0)]) == (True, False)
    assert pareto([best, scored(1, "a", worst_stiffness=3.0)]) == (True, True)
    assert pareto([]) == ()


def test_a_table_has_the_scores_in_its_columns():
    problem, flexures, declared = hinge()
    layout = layout_of(problem, flexures, declared, what="a sheet and two wires")
    scores = cheap_scores(layout.model, problem, flexures)
    layout = replace(layout, scores=scores)
    worse = replace(
        layout, number=2, what="another", scores={"worst_stiffness": 1.0e5, "room": 1.0}
    )
    text = table_of([layout, worse], ("room", True), 200)
    heads, under, first, second, *below = (" ".join(line.split()) for line in text.splitlines())
    assert heads == "layout stiffness drive first parasitic turns with room of parts"
    assert under == "N/um, worst N/um frequency errors by flexures"
    assert first == "1 * a sheet and two wires 0.218 0.00151 250 Hz 1.83 195 cm3 3"
    assert second == "2 another 0.1 1000000 cm3"
    assert below == [
        "* No layout is better in stiffness, drive, frequency or parts without a loss.",
        "Turns are compared with displacements at L = 50 mm.",
        "Ordered by room, the least first.",
    ]
    # Where all are of the Pareto set nothing is marked.
    assert "*" not in table_of([layout], ("room", True), 200)
    assert all(len(line) <= 40 for line in table_of([layout], ("room", True), 40).splitlines())
    assert table_of([], ("room", True), 80) == ""
    assert cell("stroke", layout) == ""
    turned = replace(layout, scores={"stroke": 0.0276, "room": 1.234e-2, "parts": 3.0})
    assert [cell(key, turned) for key in turned.scores] == ["27.6 mrad", "12300 cm3", "3"]
