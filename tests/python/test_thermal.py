# SPDX-License-Identifier: BSD-3-Clause
"""Warmth: drift, thermal centres, forces; closed forms of textbooks, named beside each number."""

from __future__ import annotations

import dataclasses
import json
import math
import re
from typing import Any

import numpy as np
import pytest
from stiffness_decks import EA, EI, LENGTH, MASS, SHEET, cantilever, deck, elastic, guide

import flexact
from flexact.elasticity.elastic import Elastic
from flexact.util.units import units_of

ALPHA = 12e-6
STEEL = "EXPANSION {} 12e-6"


def test_a_cantilever_grows_and_bends_with_a_gradient() -> None:
    """alpha L dT; of a gradient g across it alpha g L^2/2 away from the warm side, alpha g L."""
    model = elastic(cantilever(STEEL.format(1)))
    drift = model.warmed(10).drift(3)
    np.testing.assert_allclose(drift.values, [0, 0, ALPHA * 10 * LENGTH, 0, 0, 0], atol=1e-15)
    assert drift.centre is None
    across = model.warmed(0, gradient=(100, 0, 0))
    wanted = np.zeros(6)
    wanted[0], wanted[4] = -ALPHA * 100 * LENGTH**2 / 2, -ALPHA * 100 * LENGTH
    np.testing.assert_allclose(across.drift(3).values, wanted, atol=1e-9)
    assert across.drift(3).values[0] == pytest.approx(wanted[0], rel=1e-6)
    # What bends freely is not stressed.
    assert across.energy < 1e-12 * EI / LENGTH * (ALPHA * 100 * LENGTH) ** 2
    # Along it the mean of the temperature counts: about its foot alpha g L^2/2.
    along = model.warmed(0, gradient=(0, 0, 100), about=(0, 0, 0)).drift(3).values
    assert along[2] == pytest.approx(ALPHA * 100 * LENGTH**2 / 2, rel=1e-9)
    both = model.warmed("10 K", gradient=(0, 0, "100 K/m")).drift(3).values
    assert both[2] == pytest.approx(ALPHA * 10 * LENGTH, rel=1e-9)


def test_the_apex_of_a_bipod_rises() -> None:
    """On two legs of length l on cold ground, h high: l dl = h dh, so that dh = alpha dT l^2/h."""
    height, half = 0.08, 0.03
    text = deck(
        f"PLTRUSS 1 1 3\nPLTRUSS 2 2 3\nX 1 -{half} 0\nX 2 {half} 0\nX 3 0 {height}\nFIX 1\nFIX 2",
        f"ESTIFF 1 2E5\nESTIFF 2 2E5\n{STEEL.format(1)}\n{STEEL.format(2)}",
    )
    state = elastic(text).warmed(1.0)
    wanted = ALPHA * (height**2 + half**2) / height
    assert state.drift(3).values == pytest.approx([0, wanted], rel=1e-4, abs=1e-15)
    assert abs(state.stress(1, 1)) < 1e-9 * 2e5 * ALPHA
    # On ground of the same material that is as warm it only grows.
    same = elastic(text).warmed(1.0, ground=(1.0, ALPHA)).drift(3).values
    assert same == pytest.approx([0, ALPHA * height], rel=1e-9, abs=1e-15)


def tangential(stage: float, ground: str = "") -> str:
    """A stage of radius 40 mm on three bars of 60 mm, tangential, of which the stage may expand."""
    radius, length = 0.04, 0.06
    lines, stiff = [], []
    for k in range(3):
        angle = 2 * math.pi * k / 3
        out = np.array([math.cos(angle), math.sin(angle)])
        foot = radius * out + length * np.array([out[1], -out[0]])
        place, here = 10 + 2 * k, radius * out
        lines += [f"PLBEAM {k + 1} 1 2 {place} {place + 1}", f"PLTRUSS {k + 4} {20 + k} {place}"]
        lines += [f"X {place} {here[0]:.17g} {here[1]:.17g}", f"FIX {20 + k}"]
        lines += [f"X {20 + k} {foot[0]:.17g} {foot[1]:.17g}"]
        stiff += [f"ESTIFF {k + 4} 2E5\nEXPANSION {k + 4} 12E-6\nEXPANSION {k + 1} {stage}"]
    return deck("\n".join([*lines, "X 1 0 0"]), "\n".join(stiff))


@pytest.mark.parametrize("stage", [0.0, 23e-6])
def test_the_centre_stays_on_three_tangential_flexures(stage: float) -> None:
    """By symmetry; the bars turn the stage by alpha dT l/r, however it grows itself."""
    state = elastic(tangential(stage)).warmed(5.0)
    drift = state.drift(1)
    assert drift.values[:2] == pytest.approx([0, 0], abs=1e-13)
    assert abs(drift.values[2]) == pytest.approx(5 * ALPHA * 0.06 / 0.04, rel=1e-3)
    np.testing.assert_allclose(drift.centre, 0.0, atol=1e-9)
    # The same centre from any place of the stage.
    np.testing.assert_allclose(state.drift(10).centre, 0.0, atol=1e-9)
    assert max(abs(state.stress(k, 1)) for k in (4, 5, 6)) < 1e-9 * 2e5 * 5 * ALPHA
    assert "Not over-constrained: there is no thermal self-stress" in state.describe()
    assert "its thermal centre is at (0, 0, 0) m" in state.describe()


def test_three_tangential_sheets_over_constrained_hold_the_centre_too() -> None:
    model = flexact.Model()
    tops = []
    how: dict[str, Any] = {"thickness": 3e-4, "breadth": 0.02, "material": "steel"}
    for k in range(3):
        angle = 2 * math.pi * k / 3
        out = np.array([math.cos(angle), math.sin(angle), 0.0])
        along = np.array([-out[1], out[0], 0.0])
        top, foot = model.node(*(0.04 * out)), model.node(*(0.04 * out - 0.06 * along))
        model.sheet(foot, top, "z", **how)
        model.fix(foot)
        tops.append(top)
    model.body([model.node(0, 0, 0), *tops], "stage")
    state = flexact.elastic(model).warmed(
        5.0, expansion={"stage": 23e-6, **dict.fromkeys(("sheet 1", "sheet 2", "sheet 3"), ALPHA)}
    )
    drift = state.drift("stage")
    assert drift.values[:5] == pytest.approx([0] * 5, abs=1e-12)
    assert abs(drift.values[5]) == pytest.approx(5 * ALPHA * 0.06 / 0.04, rel=1e-3)
    np.testing.assert_allclose(drift.centre, 0.0, atol=1e-8)


def between_two_sheets(stage: str) -> str:
    """A stage of 20 mm between two collinear sheets along z."""
    places = f"X 3 0 0 {LENGTH}\nX 5 0 0 {LENGTH + 0.02}\nX 7 0 0 {2 * LENGTH + 0.02}"
    return deck(
        f"BEAM 1 1 2 3 4 0 1 0\nBEAM 2 3 4 5 6 0 1 0\nBEAM 3 5 6 7 8 0 1 0\n{places}\n"
        "FIX 1\nFIX 2\nFIX 7\nFIX 8\nRLSE 1 2 3 4\nRLSE 3 2 3 4",
        f"ESTIFF 1 {SHEET}\nESTIFF 3 {SHEET}\n{STEEL.format(1)}\n{STEEL.format(3)}\n{stage}",
    )


def test_a_stage_between_two_collinear_sheets_is_pressed() -> None:
    """N = EA alpha dT where the stage has no size for it; else with its own growth over 2 L."""
    cold = elastic(between_two_sheets("")).warmed(0.1)
    assert cold.stress(1, 1) == pytest.approx(-EA * ALPHA * 0.1, rel=1e-6)
    assert cold.reaction(1, "z") == pytest.approx(EA * ALPHA * 0.1, rel=1e-6)
    assert cold.warmth.cold == ("body 2",)
    text = cold.describe()
    assert "Taken as 0, for want of a coefficient of expansion: body 2." in text
    assert "of pressure in sheet" in text
    warm = elastic(between_two_sheets("EXPANSION 2 24E-6")).warmed(0.1)
    wanted = EA * (ALPHA + 24e-6 * 0.02 / (2 * LENGTH)) * 0.1
    assert warm.stress(3, 1) == pytest.approx(-wanted, rel=1e-6)
    # Ground that grows as much leaves nothing of it.
    free = elastic(between_two_sheets("EXPANSION 2 12E-6")).warmed(0.1, ground=(0.1, ALPHA))
    assert abs(free.stress(1, 1)) < 1e-9 * EA * ALPHA * 0.1


def test_two_parallel_sheets_lift_the_stage_without_a_force() -> None:
    model = elastic(guide())
    state = model.warmed(10, parts=["sheet 1", "sheet 2"], expansion=ALPHA)
    assert abs(state.stress(1, 1)) < 1e-9 * EA * ALPHA * 10
    values = state.drift(9).values
    assert values == pytest.approx([0, 0, ALPHA * 10 * LENGTH, 0, 0, 0], rel=1e-6, abs=1e-13)
    # One alone turns it about the foot of the other, by alpha dT L over their distance.
    one = model.warmed(0.01, parts="sheet 1", expansion=ALPHA).drift(9)
    assert one.values[4] == pytest.approx(ALPHA * 0.01 * LENGTH / 0.05, rel=1e-3)


def hexapod(bars: str, legs: str) -> str:
    """A triangle of rigid beams on six legs of which each expands in its own way."""
    lines, more = [], []
    feet = [(math.cos(a), math.sin(a), 0.0) for a in np.radians([0, 60, 120, 180, 240, 300])]
    tops = [(0.5 * math.cos(a), 0.5 * math.sin(a), 0.8) for a in np.radians([30, 150, 270])]
    for k, top in enumerate(tops):
        lines += [f"X {2 * k + 1} " + " ".join(f"{x:.17g}" for x in top)]
    lines += ["BEAM 7 1 2 3 4 0 0 1\nBEAM 8 1 2 5 6 0 0 1"]
    for k, foot in enumerate(feet):
        top, number = 2 * (k // 2) + 1, 11 + 2 * k
        lines += [f"X {number} " + " ".join(f"{x:.17g}" for x in foot), f"FIX {number}"]
        lines += [bars.format(e=k + 1, p=number, op=number + 1, q=top, oq=30 + k)]
        more += [legs.format(e=k + 1), f"EXPANSION {k + 1} {1e-6 * (k + 1):.17g}"]
    return deck("\n".join(lines), "\n".join(more))


@pytest.mark.parametrize(
    ("bars", "legs", "options"),
    [
        ("TRUSS {e} {p} {q}", "ESTIFF {e} 2E6", {}),
        # Wires whose bending and torsion resist nothing at either end.
        (
            "BEAM {e} {p} {op} {q} {oq} 0.3 0.4 0.5\nFIX {op}\nRLSE {e} 2 3 4 5 6",
            "ESTIFF {e} 2E6",
            {"beams": 1},
        ),
    ],
)
def test_an_exactly_constrained_design_has_no_thermal_self_stress(
    bars: str, legs: str, options: dict[str, Any]
) -> None:
    """Six legs of six materials: the platform goes somewhere, and nothing is stressed."""
    model = elastic(hexapod(bars, legs), **options)
    assert model.result.over_constrained == 0
    state = model.warmed(10)
    assert np.abs(state.drift(1).values).max() > 1e-6
    most = max(abs(state.stress(k, 1)) for k in range(1, 9))
    assert most < 1e-9 * 2e6 * 6e-6 * 10
    assert "No normal force anywhere." in state.describe()


def test_the_place_about_which_the_ground_grows_moves_all_alike() -> None:
    model = elastic(guide())
    one, two = (
        model.warmed(3, ground=(5, 11e-6, place), expansion=ALPHA).drift(9).values
        for place in ((0, 0, 0), (1, 2, 3))
    )
    assert two - one == pytest.approx(-5 * 11e-6 * np.array([1, 2, 3, 0, 0, 0]), abs=1e-12)


def test_a_body_that_is_clamped_twice_is_the_grounds_own() -> None:
    text = deck(
        "BEAM 1 1 2 3 4 0 1 0\nBEAM 2 3 4 5 6 0 1 0\nX 3 0.1 0 0\nX 5 0.1 0 0.1\n"
        "FIX 1\nFIX 2\nFIX 3\nFIX 4\nRLSE 2 2 3 4",
        f"ESTIFF 2 {SHEET}\n{STEEL.format(1)}\n{STEEL.format(2)}",
    )
    state = elastic(text).warmed(10)
    assert state.drift(5).values[2] == pytest.approx(ALPHA * 10 * 0.1, rel=1e-9)
    assert abs(state.stress(1, 1)) < 1e-6
    grown = elastic(text).warmed(10, ground=(10, 20e-6, (0, 0, 0)))
    assert grown.drift(5).values[0] == pytest.approx(20e-6 * 10 * 0.1, rel=1e-9)
    assert abs(grown.stress(1, 1)) < 1e-6


@pytest.mark.parametrize("closed", [False, True])
def test_rigid_bodies_of_several_members_follow_a_gradient(closed: bool) -> None:
    """A linear field strains no free body of one material (Boley and Weiner 1960): a
    place r from the clamp moves by alpha ((g . r) r - g r^2/2).
    """
    more = "BEAM 3 5 6 7 8 0 1 0\n" if closed else ""
    text = deck(
        f"BEAM 1 1 2 5 6 0 1 0\nBEAM 2 1 2 7 8 0 1 0\n{more}X 5 0.1 0 0.02\nX 7 0.03 0.01 0.08\n"
        f"BEAM 4 7 8 9 10 0 1 0\nX 9 0.03 0.01 0.18\nFIX 1\nFIX 2\nRLSE 4 2 3 4",
        f"ESTIFF 4 {SHEET}",
    )
    slope = np.array([30.0, -50.0, 20.0])
    state = elastic(text).warmed(0, gradient=slope, expansion=ALPHA, about=(0, 0, 0))
    for node, place in ((5, (0.1, 0, 0.02)), (7, (0.03, 0.01, 0.08)), (9, (0.03, 0.01, 0.18))):
        r = np.array(place)
        wanted = ALPHA * ((slope @ r) * r - slope * (r @ r) / 2)
        found = state.drift(node).values
        np.testing.assert_allclose(found[:3], wanted, atol=1e-3 * np.abs(wanted).max())
        np.testing.assert_allclose(found[3:], ALPHA * np.cross(slope, r), atol=1e-8)


def test_frequency_falls_where_it_is_pressed() -> None:
    """f/f0 = sqrt(1 - N/N_cr), N = EA alpha dT, of a bar between two walls (any textbook)."""
    text = deck(
        "PLBEAM 1 1 2 3 4\nX 3 0.2 0\nFIX 1\nFIX 3\n" + "RLSE 1 1 2 3",
        f"ESTIFF 1 {EA} {EI}\nEM 1 {MASS}\nEXPANSION 1 12E-6",
    )
    model = elastic(text)
    critical = math.pi**2 * EI / 0.2**2
    step = 0.5 * critical / (EA * ALPHA)
    state = model.warmed(step)
    ratio = state.frequencies[0] / state.before.frequencies[0]
    assert ratio == pytest.approx(math.sqrt(0.5), rel=1e-3)
    assert "(-29 %)" in state.describe()


def test_what_is_missing_or_wrong_is_said_in_words() -> None:
    model = elastic(cantilever())
    with pytest.raises(flexact.ElasticError, match="EXPANSION in the deck's dynamics block"):
        model.warmed(10)
    with pytest.raises(flexact.FlexactError, match="no part called 'stage'"):
        model.warmed(10, parts="stage", expansion=ALPHA)
    guided = elastic(guide("EXPANSION 1 12e-6\nEXPANSION 2 12e-6"))
    with pytest.raises(flexact.ElasticError, match="body 3 has no coefficient of expansion"):
        guided.warmed(10, parts=["sheet 1", "body 3"])
    assert guided.warmed(1).warmth.cold == ("body 3",)
    for given, words in (
        ({"by": math.nan}, "a change of temperature"),
        ({"by": "10 N"}, "a force"),
        ({"gradient": 5}, "three finite numbers"),
        ({"gradient": (1, 2, "x")}, "three finite numbers"),
        ({"ground": 5}, "ground=.10, 12e-6."),
        ({"ground": (5, "x")}, "an expansion"),
        ({"expansion": None, "parts": "sheet 1"}, "sheet 1 has no coefficient"),
        ({"expansion": "hot"}, "an expansion"),
        ({"expansion": 12}, "write 12e-6"),
        ({"expansion": {"foo": 1e-6}}, "no part called 'foo'"),
    ):
        with pytest.raises(flexact.FlexactError, match=words):
            model.warmed(**{"by": 1.0, "expansion": ALPHA, **given})
    rigid = elastic(guide(), held="rigid")
    with pytest.raises(flexact.ElasticError, match="over-constrained by 1"):
        rigid.warmed(1, expansion=ALPHA)


def test_the_numbers_of_the_words_are_in_the_dictionary() -> None:
    state = elastic(guide(), drive="locked").warmed(10, gradient=(0, 0, 5), expansion=ALPHA)
    found = state.to_dict()
    json.dumps(found, allow_nan=False)
    assert found["by"] == 10.0
    assert found["drifts"][0]["point"] == "body 3"
    np.testing.assert_array_equal(found["drifts"][0]["drift"], state.drift(9).values)
    np.testing.assert_array_equal(found["drifts"][0]["per_kelvin"], state.drift(9).values / 10)
    assert state.alone[0].drift(9).values == pytest.approx(
        state.drift(9).values, rel=1e-3, abs=1e-12
    )
    assert "µm" in state.describe() or "nm" in state.describe()


def test_what_else_is_off_is_no_drift() -> None:
    """The drift is that of the warmth alone; a stroke of what is warm has both."""
    model = elastic(guide())
    once = model.imperfect(misaligned=[(1, "y", 1e-5), (3, "y", 1e-5)])
    drift = once.warmed(10, expansion=ALPHA).drift(9).values
    wanted = model.warmed(10, expansion=ALPHA).drift(9).values
    assert drift == pytest.approx(wanted, abs=1e-10)
    both = once.imperfect(warmed={"by": 10, "expansion": ALPHA})
    motion = both.stroke_table(9, "x", [0.025]).motion[0]
    assert motion == pytest.approx([0, 1e-5, wanted[2], 0, 0, 0], abs=1e-9)


def test_millimetres_change_the_numbers_and_nothing_else() -> None:
    text, made = guide(), {}
    for units, size in (("m", 1.0), ("mm", 1000.0)):
        data = dataclasses.replace(flexact.read_text(text).data, units=units_of(units))
        model = Elastic(data, "elastic", "free", {}, 4)
        slope = np.array([10.0, 0.0, 50.0]) / size
        ground = (2, 11e-6, (0, 0, 0.01 * size))
        state = model.warmed(5, gradient=slope, ground=ground, expansion=ALPHA)
        made[units] = state, state.drift(9), state.to_dict()
    (one, before, _), (two, after, found) = made["m"], made["mm"]
    size = np.where(np.arange(6) < 3, 1e3, 1.0)
    np.testing.assert_allclose(after.values, size * before.values, rtol=1e-9, atol=1e-15)
    np.testing.assert_allclose(after.centre, 1e3 * before.centre, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(found["gradient"], [0.01, 0, 0.05], rtol=1e-12)

    def words(text: str) -> str:
        return re.sub(r"\W?\d[\d.e+-]*|\bm\b|\bmm\b|K/mm?\b", "#", text)

    assert words(two.describe()) == words(one.describe())
    assert "K/mm" in two.describe()
