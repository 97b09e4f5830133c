# SPDX-License-Identifier: BSD-3-Clause
"""Traced paths: closed forms of linkages, dead points, branches, and what cannot be traced."""

import math
from functools import cache

import mpmath
import numpy as np
import pytest
from reference_decks import ROOT, transform

import flexact
from flexact import Trace, trace
from flexact.motion import Ending

pytestmark = pytest.mark.dear(12)

DECKS = ROOT / "input_decks"


@cache
def traced(name: str, **chosen: float) -> Trace:
    return trace(DECKS / f"{name}.dat", **chosen)


def rigidity(analysis: flexact.Analysis, place: np.ndarray) -> np.ndarray:
    """Singular values of bars between joints, by their directions alone; fixed joints left out."""
    arrays = analysis.data.arrays
    rows = []
    for p, q in (arrays.element_node[[0, 2]] - 1).T.tolist():
        row = np.zeros(place.shape)
        away = (place[q] - place[p]) / np.linalg.norm(place[q] - place[p])
        row[q], row[p] = away, -away
        rows.append(row[(arrays.coordinate_class == 2).T])
    return np.linalg.svd(np.array(rows), compute_uv=False)


# --- the paper's Fig. 2 --------------------------------------------------------------------------


def leaning(path: Trace) -> tuple[np.ndarray, np.ndarray]:
    """By how much E, G lean out (a), and F, H (b) [rad]; they turn about the sides of the base."""
    at = {name: path.positions(name) for name in "EFGH"}
    out = {
        name: (-1.0 if name in "EH" else 1.0) * at[name][:, int(name in "EG")] for name in "EFGH"
    }
    angle = {name: np.arctan2(out[name] - 1.0, at[name][:, 2]) for name in "EFGH"}
    assert angle["E"] == pytest.approx(angle["G"], abs=1e-12)
    assert angle["F"] == pytest.approx(angle["H"], abs=1e-12)
    return angle["E"], angle["F"]


def test_the_path_of_the_twelve_trusses() -> None:
    """references.md: 1 + sin a + sin b - cos a cos b = 0, and a = 0.1 gives -0.111204276782."""
    path = traced("paper/twelve_trusses")
    a, b = leaning(path)
    assert np.abs(1 + np.sin(a) + np.sin(b) - np.cos(a) * np.cos(b)).max() < 1e-14
    assert path.residual < 1e-14
    mpmath.mp.dps = 30
    sin, cos = mpmath.sin, mpmath.cos
    beside = mpmath.findroot(lambda x: 1 + sin(0.1) + sin(x) - cos(0.1) * cos(x), -0.11)
    assert float(beside) == pytest.approx(-0.111204276782, abs=1e-12)
    a, b = leaning(traced("paper/twelve_trusses", length=0.3, steps=60))
    near = np.argsort(np.abs(a - 0.1))[:7]
    b_at = np.polynomial.Polynomial.fit(a[near], b[near], 6)
    assert b_at(0.1) == pytest.approx(-0.111204276782, abs=1e-11)


def test_the_dead_point_of_the_twelve_trusses() -> None:
    """Where a is largest: f = 0 and df/db = 0, solved with 30 digits; 21.47 and -47.06 degrees."""
    mpmath.mp.dps = 30
    sin, cos = mpmath.sin, mpmath.cos
    largest = mpmath.findroot(
        lambda a, b: [1 + sin(a) + sin(b) - cos(a) * cos(b), cos(b) + cos(a) * sin(b)], (0.4, -0.8)
    )
    a_most, b_most = (float(each) for each in largest)
    assert np.degrees([a_most, b_most]) == pytest.approx([21.47, -47.06], abs=0.005)
    path = traced("paper/twelve_trusses")
    a, b = leaning(path)
    dead = [k for k, step in enumerate(path.steps) if step.dead is not None]
    assert len(dead) == 2
    for k, lean, other, names in zip(dead, (a, b), (b, a), (("E", "G"), ("F", "H")), strict=True):
        if lean[k] < 0.0:
            lean, other, names = other, lean, {"E": ("F", "H"), "F": ("E", "G")}[names[0]]
        step = path.steps[k]
        assert step.dead is not None and step.dead.turning == names
        assert lean[k] == pytest.approx(a_most, abs=1e-13)
        assert other[k] == pytest.approx(b_most, abs=1e-11)
        # The path goes through: beside the dead point it leans less on both sides.
        assert lean[k] > max(lean[k - 1], lean[k + 1]) and lean[k] == lean.max()
        # There F and H could go on, or turn back, one without the other.
        assert step.dead.is_branch and step.dead.directions == 2
        place = step.pose.position
        assert (rigidity(path.result, place)[-2:] < 1e-10).all()
        assert (step.under_constrained, step.over_constrained) == (2, 2)
    others = [step for step in path.steps if step.dead is None]
    assert {(step.under_constrained, step.over_constrained) for step in others} == {(1, 1)}


def test_a_path_may_end_where_others_branch_off() -> None:
    path = traced("paper/twelve_trusses", through=False)
    for way in (path.against, path.along):
        assert way.stop.ending is Ending.BRANCHES and way.stop.directions == 2
    ends = path.steps[0].dead, path.steps[-1].dead
    assert [end and end.turning for end in ends] == [("E", "G"), ("F", "H")] or [
        end and end.turning for end in ends
    ] == [("F", "H"), ("E", "G")]


# --- linkages ------------------------------------------------------------------------------------


def test_the_platform_of_sarrus_goes_straight() -> None:
    """Sarrus 1853: along z, without turning; h = 2 sqrt(l^2 - (x - 1)^2) of either leg."""
    path = traced("linkages/sarrus")
    top, knee = path.positions(31), path.positions(21)
    assert top[:, 0] == pytest.approx(1.0, abs=1e-12)
    assert top[:, 1] == pytest.approx(0.0, abs=1e-12)
    length = math.hypot(0.5, 0.6)
    height = 2.0 * np.sqrt(np.maximum(length**2 - (knee[:, 0] - 1.0) ** 2, 0.0))
    assert np.abs(top[:, 2]) == pytest.approx(height, abs=1e-7)
    assert np.ptp(top[:, 2]) > 1.0
    # The knees straight: the highest, from which each leg could fold either way. And the upper
    # hinges on the lower ones: either leg can turn as a whole.
    flat, high = path.dead_points
    assert high.dead is not None and high.dead.is_branch and "platform" in high.dead.turning
    node = path.result.given.node_index[31]
    assert high.pose.position[node, 2] == pytest.approx(2.0 * length, abs=1e-12)
    assert flat.dead is not None and flat.dead.directions == 3
    assert flat.pose.position[node, 2] == pytest.approx(0.0, abs=1e-9)


def test_bennett() -> None:
    """tan(t1/2) tan(t2/2) = sin((b + a)/2)/sin((b - a)/2), a and b the twists (Bennett 1903)."""
    path = traced("linkages/bennett", length=20.0, steps=80, beyond=True)
    assert path.along.stop.ending is path.against.stop.ending is Ending.CLOSED
    # One turn of a joint by 2 pi rad, which count as the size.
    given = path.result.given
    places = [np.array(path.positions(number)) for number in (11, 21, 31, 41)]
    start = np.array(
        [[0.0, 0.0, 1.0], [0.6634139481689384, -0.383022221559489, 0.6427876096865394]]
    )
    node = given.node_index[22]
    turned = np.array([step.pose.rotation[node] for step in path.steps])
    axes = np.broadcast_to(start[0], places[0].shape), turned @ start[1]
    halves = []
    for k, axis in enumerate(axes):
        into, out = places[k] - places[k - 1], places[(k + 1) % 4] - places[k]
        sine = np.einsum("kx,kx->k", np.cross(into, out), axis)
        halves.append(np.arctan2(sine, np.einsum("kx,kx->k", into, out)) / 2.0)
    alpha, beta = np.radians([50.0, 80.0])
    ratio = abs(math.sin((beta + alpha) / 2) / math.sin((beta - alpha) / 2))
    # Cross-multiplied, so that nothing is large where a joint is at 180 degrees.
    one, other = np.sin(halves[0]) * np.sin(halves[1]), np.cos(halves[0]) * np.cos(halves[1])
    error = np.minimum.reduce(
        [np.abs(one - s * r * other) for s in (1, -1) for r in (ratio, 1.0 / ratio)]
    )
    assert error.max() < 1e-10
    assert {(s.under_constrained, s.over_constrained) for s in path.steps} == {(1, 3)}


def test_dead_points_of_a_four_bar() -> None:
    """The rocker turns back where crank and coupler are in line: twice a turn of the crank."""
    path = traced("linkages/four_bar_planar", length=40.0, beyond=True)
    assert path.along.stop.ending is Ending.CLOSED
    # The crank turns by 2 pi, a radian counting as the size, which is AC.
    assert path.along.length == pytest.approx(2.0 * math.pi * math.hypot(3.0, 3.0), rel=1e-5)
    index = path.result.given.node_index
    turning = [step for step in path.dead_points if step.dead and "rocker CD" in step.dead.turning]
    assert len(turning) == 4
    coupler, rocker, base = math.hypot(3, 2), math.hypot(1, 3), 4.0
    for step in turning:
        b, c = (step.pose.position[index[number], :2] for number in (21, 31))
        assert abs(b[0] * (c - b)[1] - b[1] * (c - b)[0]) < 1e-11
        # So AC is their sum or difference, and the cosine rule gives where C is.
        reach = np.linalg.norm(c)
        assert min(abs(reach - coupler - 1.0), abs(reach - coupler + 1.0)) < 1e-12
        x = (base**2 + reach**2 - rocker**2) / (2.0 * base)
        assert c[0] == pytest.approx(x, abs=1e-12)


def test_dead_points_of_a_slider_crank() -> None:
    """Crank 0.5 and rod sqrt(1.53) in line, the slide at their sum; the crank drives on."""
    path = traced("linkages/slider_crank_planar", freedom=1, length=12.0, steps=100, beyond=True)
    index = path.result.given.node_index
    slide = [step for step in path.dead_points if step.dead and step.dead.turning]
    rod, offset = math.hypot(1.2, 0.3), 0.1
    reached = sorted({round(step.pose.position[index[4], 0], 9) for step in slide})
    expected = [math.sqrt((rod + s * 0.5) ** 2 - offset**2) for s in (-1.0, 1.0)]
    assert reached == pytest.approx(expected, abs=2e-9)
    assert not any(step.dead and step.dead.is_drive for step in slide)
    assert {step.verdict for step in path.steps} == {flexact.Verdict.EXACT}


def test_a_driven_rocker_turns_back() -> None:
    """As the drive of a rocker: where crank and coupler are in line it can be driven no farther."""
    text = (DECKS / "linkages" / "four_bar_planar.dat").read_text(encoding="utf-8")
    model = flexact.read_text(text.replace("FIX 41\n", "FIX 41\nDYNX 42\n"))
    path = trace(model, freedom=1, length=30.0, beyond=True)
    drives = [step for step in path.dead_points if step.dead and step.dead.is_drive]
    assert len(drives) >= 2
    index = path.result.given.node_index
    for step in drives:
        b, c = (step.pose.position[index[number], :2] for number in (21, 31))
        assert abs(b[0] * (c - b)[1] - b[1] * (c - b)[0]) < 1e-11
        assert (step.under_constrained, step.over_constrained) == (1, 1)
    others = [step for step in path.steps if step.dead is None or not step.dead.is_drive]
    assert {step.verdict for step in others} == {flexact.Verdict.EXACT}


def test_a_parallelogram_stays_one_where_it_is_flat() -> None:
    path = traced("linkages/parallelogram_three_cranks")
    branches = [step for step in path.dead_points if step.dead and step.dead.is_branch]
    assert len(branches) == 2
    for step in branches:
        assert abs(step.arc) == pytest.approx(math.pi / 2, rel=1e-9)
        assert (step.under_constrained, step.over_constrained) == (2, 2)
    first, second = path.positions(12), path.positions(22)
    assert second - first == pytest.approx(np.broadcast_to([1.0, 0.0, 0.0], first.shape), abs=1e-12)


# --- flexure guides ------------------------------------------------------------------------------


def test_a_guide_of_wires_turns_back() -> None:
    """No wire gets longer, eq. (3), and D(c) is singular where the declared z is largest."""
    path = traced("paper/five_wires", freedom=1)
    model = flexact.read(DECKS / "paper" / "five_wires.dat")
    wires = [k for k, (_, e) in enumerate(flexact.jacobian(model).row_labels) if e == 1][:5]
    for step in path.steps:
        longer = flexact.deformations(model, step.configuration)[wires]
        assert longer == pytest.approx(np.zeros(5), abs=1e-16)
    z = path.positions(1)[:, 2]
    assert z == pytest.approx([step.drive for step in path.steps], abs=1e-16)
    drives = [k for k, step in enumerate(path.steps) if step.dead and step.dead.is_drive]
    assert len(drives) == 2
    for k in drives:
        assert abs(z[k]) == pytest.approx(np.abs(z).max(), abs=1e-13)
        assert path.steps[k].values[0] < 1e-9
    low, high = drives
    inside = path.steps[low + 1 : high]
    assert {step.verdict for step in inside} == {flexact.Verdict.EXACT}


def test_sheets_may_bend_to_right_angles_and_no_farther() -> None:
    path = traced("paper/five_folded_sheets", freedom=1)
    for way in (path.against, path.along):
        assert way.stop.ending is Ending.ELEMENT and way.stop.range == "bending"
    assert path.residual < 1e-13


# --- what all paths have in common ---------------------------------------------------------------


@pytest.mark.parametrize(
    "name",
    [
        *("paper/twelve_trusses", "linkages/bennett", "linkages/rssr", "frameworks/ring_4"),
        *("flexures/parallel_guide_four_beams", "flexures/cross_hinge", "flexures/notch_guide"),
    ],
)
def test_the_reference_is_what_analyse_says(name: str) -> None:
    analysis = flexact.analyse(DECKS / f"{name}.dat")
    path = trace(analysis, length=None, steps=4)
    start = path.steps[path.reference]
    assert start.arc == 0.0 and start.verdict is analysis.verdict
    assert start.under_constrained == analysis.under_constrained
    assert start.over_constrained == analysis.over_constrained
    smallest = analysis.scaled_singular_values[::-1][: start.values.size]
    assert start.values == pytest.approx(smallest, abs=1e-13)
    assert start.pose.position == pytest.approx(
        np.where(
            (analysis.given.arrays.node_kind <= 2)[:, None],
            analysis.given.arrays.node_value[:3].T,
            0.0,
        ),
        abs=1e-15,
    )


def test_the_same_is_found_again() -> None:
    one = trace(DECKS / "linkages" / "bennett.dat", steps=10)
    other = trace(DECKS / "linkages" / "bennett.dat", steps=10)
    assert one.arc.tolist() == other.arc.tolist()
    assert all(
        np.array_equal(a.pose.position, b.pose.position)
        for a, b in zip(one.steps, other.steps, strict=True)
    )


@pytest.mark.parametrize("factor", [1e-3, 1e-6])
def test_units_do_not_matter(factor: float) -> None:
    text = (DECKS / "paper" / "twelve_trusses.dat").read_text(encoding="utf-8")
    path = trace(flexact.read_text(transform.scaled(text, factor)))
    metres = traced("paper/twelve_trusses")
    assert path.arc == pytest.approx(factor * metres.arc, rel=1e-9, abs=1e-9 * factor)
    assert path.dead_points[0].values == pytest.approx(metres.dead_points[0].values, abs=1e-11)


def test_a_length_and_steps_are_kept() -> None:
    path = trace(DECKS / "linkages" / "bennett.dat", length=0.3, steps=7)
    assert path.along.length == pytest.approx(0.3, rel=1e-3)
    assert path.reference >= 7 and len(path.steps) - 1 - path.reference >= 7


# --- what cannot be traced -----------------------------------------------------------------------


@pytest.mark.parametrize(
    "name",
    [
        *("frameworks/collinear_bars_plane", "frameworks/third_order", "frameworks/k33_circle"),
        *("frameworks/prism_twist_30", "linkages/parallelogram_flat", "linkages/loop_6r"),
        *("frameworks/octahedral_platform_yaw_90", "flexures/sheet_clamped_both_ends"),
    ],
)
def test_what_leads_nowhere_is_told(name: str) -> None:
    with pytest.raises(flexact.FlexactError, match=r"begun|nothing to trace"):
        trace(DECKS / f"{name}.dat")


def test_wrong_choices_are_told() -> None:
    deck = DECKS / "linkages" / "bennett.dat"
    with pytest.raises(flexact.FlexactError, match="no motion 2"):
        trace(deck, motion=2)
    with pytest.raises(flexact.FlexactError, match="no degree of freedom 1"):
        trace(deck, freedom=1)
    with pytest.raises(flexact.FlexactError, match="not both"):
        trace(deck, freedom=1, motion=1)
    for wrong in (0.0, -1.0, math.inf, math.nan):
        with pytest.raises(ValueError, match="length"):
            trace(deck, length=wrong)
    with pytest.raises(TypeError, match="length"):
        trace(deck, length=b"1")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="says its unit"):
        trace(deck, length="1")
    with pytest.raises(ValueError, match="step"):
        trace(deck, steps=0)
    with pytest.raises(TypeError, match="steps"):
        trace(deck, steps=2.5)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="traced"):
        trace(3)  # type: ignore[arg-type]


def test_too_large_a_model_is_told() -> None:
    bars = [f"TRUSS {i + 1} {i + 1} {i + 2}" for i in range(400)]
    joints = [f"X {i + 1} {i} {0.3 * (i % 2)} {0.1 * (i % 3)}" for i in range(401)]
    text = "\n".join([*bars, *joints, "FIX 1", "END", "HALT", "END", ""])
    with pytest.raises(flexact.FlexactError, match="1000 coordinates"):
        trace(flexact.read_text(text))


def test_a_length_beyond_the_model_is_refused() -> None:
    deck = DECKS / "linkages" / "four_bar_planar.dat"
    with pytest.raises(flexact.FlexactError, match=r"larger than .*--beyond.*beyond=True"):
        trace(deck, length=20.0)
    assert len(trace(deck, length="20m", beyond=True, steps=5).steps) > 1
