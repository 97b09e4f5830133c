# SPDX-License-Identifier: BSD-3-Clause
"""Strokes: forces, energy, snap-through, drives that are free or locked, and their ends."""

import contextlib
import math
import warnings
from typing import Any

import numpy as np
import pytest
from stiffness_decks import (
    EA,
    EI,
    LENGTH,
    MASS,
    SHEET,
    THICK,
    arch,
    cross_hinge,
    deck,
    elastic,
    guide,
)

import flexact


def snap(height: float, stiffness: float = 2.0e5, rise: float = 0.1) -> float:
    """Force along y on the top of two shallow bars (von Mises' truss), from its energy."""
    rest, now = math.hypot(1, rise), math.hypot(1, height)
    return 2 * stiffness / rest * (now - rest) * height / now


def test_snap_through_follows_the_drive() -> None:
    heights = [0.08, 0.04, 0.0, -0.05, -0.1, -0.15]
    states = elastic(arch()).along(2, "y", heights)
    for state, height in zip(states, heights, strict=True):
        assert state.force == pytest.approx(snap(height), rel=1e-9, abs=1e-9)
        assert state.position(2) == pytest.approx([0, height], abs=1e-12)
    free = [state.is_stable for state in states]
    assert free == [snap(h - 1e-6) < snap(h + 1e-6) for h in heights]
    locked = elastic(arch(), drive="locked").along(2, "y", heights)
    assert all(state.is_stable for state in locked)
    assert states[4].energy == pytest.approx(0, abs=1e-12)


def test_the_stiffness_of_the_drive_is_the_slope_of_its_force() -> None:
    model = elastic(arch(), beams=1)
    for height in (0.09, 0.07, -0.12):
        low, here, high = model.along(2, "y", [height - 1e-6, height, height + 1e-6])
        assert 1 / here.compliance(2)[1, 1] == pytest.approx(
            (high.force - low.force) / 2e-6, rel=1e-6
        )


@pytest.mark.parametrize("drive", ["free", "locked"])
def test_support_stiffness_along_the_stroke(drive: str) -> None:
    """Beam constraint model (Awtar, Slocum 2007), as in the project's theory, section 3."""
    text = deck(
        f"PLBEAM 1 1 2 3 4\nX 3 {LENGTH} 0\nFIX 1\nFIX 2\nFIX 4\nDYNX 3 2\nRLSE 1 2 3",
        f"ESTIFF 1 {EA} {EI}",
    )
    strokes = [-0.002, -0.0005, 0.0, 0.001]
    states = elastic(text, drive=drive).along(3, "y", strokes)
    for state, d in zip(states, strokes, strict=True):
        compliance = state.compliance(3)[0, 0]
        axial = LENGTH / EA
        wanted = (
            axial * (1 + 12 / 700 * (d / THICK) ** 2)
            if drive == "locked"
            else axial + LENGTH**3 / EI * (d / LENGTH) ** 2 * (0.12 + 1 / 700)
        )
        assert compliance == pytest.approx(wanted, rel=5e-3)
        assert state.stroke == pytest.approx(d, abs=1e-15)


@pytest.mark.parametrize(
    ("text", "node", "coordinate", "far"),
    [(guide(), 9, "x", 0.035), (cross_hinge(), 2, "ry", 0.4), (arch(), 2, "y", -0.05)],
    ids=["guide", "cross hinge", "arch"],
)
def test_the_work_of_the_drive_is_the_energy(
    text: str, node: int, coordinate: str, far: float
) -> None:
    """Gauss's rule of 12 points: the force is as smooth as the energy."""
    model = elastic(text, beams=2)
    begin = {"x": 0.025, "ry": 0.0, "y": 0.1}[coordinate]
    places, weights = np.polynomial.legendre.leggauss(12)
    values = begin + (far - begin) * (places + 1) / 2
    *states, last = model.along(node, coordinate, [*values, far])
    work = (far - begin) / 2 * sum(w * s.force for w, s in zip(weights, states, strict=True))
    assert last.energy == pytest.approx(work, rel=1e-8)


def test_values_lie_on_both_sides_in_any_order() -> None:
    model = elastic(guide(), beams=2)
    values = [0.02, 0.022, 0.025, 0.03]
    one = model.along(9, "x", values)
    other = model.along(9, "x", [values[k] for k in (2, 0, 3, 1)])
    for k, state in zip((2, 0, 3, 1), other, strict=True):
        assert state.force == pytest.approx(one[k].force, rel=1e-7, abs=1e-9)
        assert state.position(9)[0] == pytest.approx(values[k], abs=1e-14)
    assert one[2].energy == pytest.approx(0, abs=1e-15)
    assert model.along(9, "x", []) == ()
    assert model.along(9, "x", [0.03])[0].force == pytest.approx(one[3].force, rel=1e-7)


def test_a_driven_rotation_is_an_angle() -> None:
    """Half the angle is what the Euler parameter counts; 4 EI/L phi of this hinge, twice 2 EI/L."""
    states = elastic(cross_hinge(), beams=4).along(2, "ry", [-0.3, 0.002])
    assert states[0].position(2) == pytest.approx([0, -0.3, 0], abs=1e-12)
    assert states[0].stroke == pytest.approx(-0.3, abs=1e-12)
    # 8 EI/L (1 - 3 l + 3 l^2) with l = 1/2 (Wittrick, Haringx)
    assert states[1].force == pytest.approx(2 * EI / LENGTH * 0.002, rel=1e-3)


def test_the_drive_need_not_be_declared() -> None:
    declared = elastic(guide(), beams=2).along(9, "x", [0.027])[0]
    plain = elastic(guide(drive=""), beams=2).along(9, "x", [0.027])[0]
    assert plain.force == pytest.approx(declared.force, rel=1e-9)


def test_a_stroke_beyond_reach_says_how_far_it_went() -> None:
    """Two rigid bars of length one reach two from the ground."""
    text = deck("PLTRUSS 1 1 2\nPLTRUSS 2 2 3\nX 2 0.8 0.6\nX 3 1.6 0\nFIX 1\nFIX 3 2\nDYNX 3 1")
    model = elastic(text, held="rigid")
    assert model.along(3, "x", [1.2, 1.9])[1].position(2)[1] == pytest.approx(
        math.sqrt(1 - 0.95**2)
    )
    with pytest.raises(flexact.StrokeError, match="beyond") as caught:
        model.along(3, "x", [1.7, 2.3])
    assert 1.9 < caught.value.reached <= 2.0 + 1e-9
    assert caught.value.place


def test_the_verdict_along_a_stroke_of_a_linkage() -> None:
    """A parallelogram of three cranks is over-constrained everywhere, and in line both at once."""
    text = deck(
        "PLTRUSS 1 1 4\nPLTRUSS 2 2 5\nPLTRUSS 3 4 5\nX 1 0 0\nX 2 1 0\nX 4 0 1\nX 5 1 1\n"
        "FIX 1\nFIX 2\nDYNX 4 1"
    )
    states = elastic(text, held="rigid").along(4, "x", [0.0, 0.3, 0.6])
    for state in states:
        assert (state.under_constrained, state.over_constrained) == (0, 0)
        assert state.position(5) == pytest.approx(
            [1 + state.stroke, math.sqrt(1 - state.stroke**2)], abs=1e-9
        )
    values = [state.smallest_singular_value for state in states]
    assert values[0] > values[1] > values[2] > 0.0


def test_errors_go_along_a_stroke() -> None:
    """A clamp that is lifted and lowered again by an element that is as much too short."""
    model = elastic(guide(), beams=2)
    off = model.imperfect(misaligned=[(1, "z", 1e-5)])
    both = off.imperfect(misfit=[(1, 1, -1e-5)])
    plain, lifted, mended = (m.along(9, "x", [0.025, 0.028]) for m in (model, off, both))
    assert lifted[0].energy > 1e-8
    assert mended[0].energy == pytest.approx(0, abs=1e-12)
    assert mended[1].force == pytest.approx(plain[1].force, rel=1e-3)
    assert off.undeformed().energy == 0.0
    assert off.assembled().energy == pytest.approx(lifted[0].energy, rel=1e-3)


def _blade(held: str, along: str = "0.06 0.03 0.07", axis: int = 4) -> str:
    """A blade in a skew direction; its end is driven about an axis, of others some are held."""
    return deck(
        f"BEAM 1 1 2 3 4 0.3 1 -0.2\nX 3 {along}\nFIX 1\nFIX 2\n{held}\nDYNX 4 {axis}\n"
        "RLSE 1 1 2 3 4 5 6",
        f"ESTIFF 1 {SHEET}\nEM 1 {MASS}\nXM 3 0.3\nXM 4 1e-3 2e-4 0 2e-3 1e-4 3e-3",
    )


_FOLDED = deck(
    "BEAM 1 1 2 3 4 0.3 1 -0.2\nBEAM 2 3 4 5 6 1 0.1 0.2\nX 3 0.06 0.03 0.07\nX 5 0.02 0.1 0.05\n"
    "FIX 1\nFIX 2\nDYNX 6 3\nDYNX 5 1\nRLSE 1 1 2 3 4 5 6\nRLSE 2 1 2 3 4 5 6",
    f"ESTIFF 1 {SHEET}\nESTIFF 2 {SHEET}\nEM 1 {MASS}\nEM 2 {MASS}\nXM 5 0.3\n"
    "XM 6 1e-3 0 0 1e-3 0 1e-3",
)
_PLANAR = deck(
    f"PLBEAM 1 1 2 3 4\nX 3 {LENGTH} 0\nFIX 1\nFIX 2\nDYNX 4 1\nRLSE 1 1 2 3",
    f"ESTIFF 1 {EA} {EI}\nEM 1 {MASS}\nXM 3 0.3\nXM 4 1e-4",
)
#: Mechanisms with a node that is turned, about what, and how far [rad].
TURNED = {
    "cross hinge": (cross_hinge(), 2, "ry", (0.1, 0.2, 0.4, 0.6)),
    "skew, all free": (_blade(""), 4, "rz", (0.3, 0.6)),
    "skew, one held": (_blade("FIX 4 2"), 4, "rz", (0.3, 0.6)),
    "skew, both others held": (_blade("FIX 4 2\nFIX 4 3"), 4, "rz", (-0.3, 0.6)),
    "two drives": (_FOLDED, 6, "ry", (0.3, -0.6)),
    "planar": (_PLANAR, 4, "rz", (0.6,)),
}


@pytest.mark.parametrize("name", TURNED)
def test_a_free_rotary_drive_has_a_constant_moment(name: str) -> None:
    """1/compliance about the driven axis is the slope of the moment along the path."""
    text, node, coordinate, angles = TURNED[name]
    model = elastic(text, beams=2)
    for angle in angles:
        low, here, high = model.along(node, coordinate, [angle - 1e-4, angle, angle + 1e-4])
        slope = (high.force - low.force) / 2e-4
        about = _driven_axis(here, node, coordinate)
        size = about.size
        compliance = about @ here.compliance(node)[-size:, -size:] @ about
        assert 1 / compliance == pytest.approx(slope, rel=1e-5)


def test_frequencies_are_those_at_a_constant_moment() -> None:
    """All inertia is about the axis, so that the square is the slope of the moment over it."""
    text = cross_hinge().replace("XM 1 0.3", "XM 2 0 0 0 2e-4 0 0").replace("EM ", "# EM ")
    model = elastic(text, beams=4)
    for angle in (0.2, 0.4, 0.6):
        low, here, high = model.along(2, "ry", [angle - 1e-4, angle, angle + 1e-4])
        slope = (high.force - low.force) / 2e-4
        assert here.frequencies[0] == pytest.approx(math.sqrt(slope / 2e-4) / 2 / math.pi, rel=1e-5)


def test_matrices_keep_euler_parameters() -> None:
    """SPACAR's: second derivatives of the energy by the Euler parameter sin(a/2)."""
    model = elastic(cross_hinge(), beams=1)
    for angle in (0.2, 0.6):
        low, here, high = model.along(2, "ry", [angle - 1e-4, angle, angle + 1e-4])
        # The force on the parameter is the moment times the derivative of the angle.
        forces = [2 * s.force / math.cos(s.stroke / 2) for s in (low, high)]
        parameters = [math.sin(s.stroke / 2) for s in (low, high)]
        slope = (forces[1] - forces[0]) / (parameters[1] - parameters[0])
        whole = here.stiffness_matrix + here.geometric_matrix
        assert whole[0, 0] == pytest.approx(slope, rel=1e-5)


def _driven_axis(state: Any, node: int, coordinate: str) -> Any:
    """The axis along which the spin changes the angle: (l0 e + l x e)/cos(angle/2)."""
    turn = state.position(node)
    if np.size(turn) == 1:
        return np.ones(1)
    angle = float(np.linalg.norm(turn))
    scalar, vector = math.cos(angle / 2), turn * (math.sin(angle / 2) / angle)
    e = np.eye(3)["xyz".index(coordinate[1])]
    axis = scalar * e + np.cross(vector, e)
    assert np.linalg.norm(axis) == pytest.approx(math.cos(state.stroke / 2), rel=1e-9)
    return axis / np.linalg.norm(axis)


def test_strokes_from_rest_and_far_from_it() -> None:
    model = elastic(guide(), beams=1)
    there = model.along(9, "x", [0.025, 0.028])
    found = model.along(9, "x", [0, "3 mm"], from_rest=True)
    assert [s.stroke for s in found] == pytest.approx([s.stroke for s in there], abs=1e-15)
    with pytest.warns(flexact.elasticity.StrokeWarning, match=r"rests at 0.025.*from_rest=True"):
        model.along(9, "x", [0, 0.003])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        model.along(9, "x", [0.02, 0.03])
        elastic(cross_hinge(), beams=1).along(2, "ry", [0.3, 0.4])


@pytest.mark.parametrize(
    "ask",
    [
        lambda m, **o: m.along(9, "x", [-3.0], **o),
        lambda m, **o: m.along(9, "x", [3.0], from_rest=True, **o),
        lambda m, **o: m.misaligned(1, "x", 50, **o),
        lambda m, **o: m.misaligned(1, "ry", 50.0, **o),
        lambda m, **o: m.misfit(1, 1, 0.3, **o),
        lambda m, **o: m.misfit(1, 2, -7.0, **o),
        lambda m, **o: m.imperfect(misaligned=[(1, "z", -0.2)], **o),
        lambda m, **o: m.imperfect(misfit=[(1, 1, 0.2)], **o),
    ],
)
def test_what_is_larger_than_the_model_is_refused(ask: Any) -> None:
    model = elastic(guide(), beams=1)
    with pytest.raises(flexact.ElasticError, match=r"larger than .*beyond=True"):
        ask(model)
    # It is tried then.
    with contextlib.suppress(flexact.StrokeError):
        ask(model, beyond=True)


def test_points_are_given_by_places_and_bodies_by_their_first_point() -> None:
    made = flexact.Model(name="guide")
    for k, x in enumerate((0.0, 0.05)):
        made.fix(made.node(x, 0, 0, name=f"foot {k}"))
        made.sheet(
            *(f"foot {k}", made.node(x, 0.1, 0, name=f"head {k}"), "z", 2, f"leaf {k}"),
            thickness=5e-4,
            breadth=0.02,
            material="steel",
        )
    made.body([(0.025, 0.1, 0), "head 0", "head 1"], name="stage", mass=0.5)
    made.independent("stage", "x")
    model = flexact.elastic(made, beams=2)
    number = int(made.node_numbers[np.argmin(np.abs(made.positions - (0.025, 0.1, 0)).sum(1))])
    rest = model.undeformed()
    wanted = rest.compliance(number)
    for given in ((0.025, 0.1, 0), [0.025 + 1e-13, 0.1, 0.0], np.array([0.025, 0.1, 0]), "stage"):
        assert rest.compliance(given) == pytest.approx(wanted)
        (state,) = model.along(given, "x", [0.027])
        assert state.position(number)[0] == pytest.approx(0.027)
    off = model.misaligned((0.05, 0.0, 0.0), "y", 1e-5)
    assert off.energy == pytest.approx(model.misaligned("foot 1", "y", 1e-5).energy)
    named = zip(made.element_numbers, made.element_names, strict=True)
    numbers = [n for n, name in named if "leaf 1" in name]
    assert off.peak_stress("leaf 1") == pytest.approx(max(map(off.peak_stress, numbers)))
    for wrong in ((0.025, 0.1001, 0), "nothing", "leaf 1"):
        with pytest.raises(flexact.FlexactError, match=r"(no-such-point|not-a-node)"):
            rest.compliance(wrong)
    with pytest.raises(TypeError):
        rest.compliance((1, 2, 3, 4))
