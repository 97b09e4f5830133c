# SPDX-License-Identifier: BSD-3-Clause
"""Misalignment: where it buckles, where the frequency has shifted, what a release keeps."""

import math

import numpy as np
import pytest
from stiffness_decks import EA, EI, EI_IN, GJ, LENGTH, cross_hinge, deck, elastic, guide

from flexact.elasticity.tolerance import rises_to

#: The clamps of the guide turn about a line at mid height.
MIDDLE = (0.0, 0.0, LENGTH / 2)
CRITICAL = 4 * math.pi * math.sqrt(EI * GJ) / EI_IN


def test_the_guide_buckles_where_the_closed_form_says() -> None:
    """4 pi sqrt(EI GJ)/EI_in (Meijaard, Brouwer, Jonker 2010; theory, section 3)."""
    model = elastic(guide())
    found = model.estimate(lambda m: m.critical_misalignment(2, "rx", about=MIDDLE))
    assert found.value == pytest.approx([-CRITICAL, CRITICAL], rel=1e-3)
    assert np.all(np.abs(found.value - [-CRITICAL, CRITICAL]) <= found.uncertainty)
    assert model.critical_misalignment(1, "rx", about=MIDDLE) == pytest.approx(tuple(found.value))
    ideal = elastic(guide(), release=[(1, 5)])
    # what is left is the shear of the stage against a lever of both sheets
    assert ideal.critical_misalignment(2, "rx", about=MIDDLE)[1] > 100 * CRITICAL


def test_one_beam_a_sheet_is_far_too_optimistic() -> None:
    coarse = elastic(guide(), beams=1).critical_misalignment(2, "rx", about=MIDDLE)
    assert coarse[1] > 5 * CRITICAL
    fine = elastic(guide(), beams=16).critical_misalignment(2, "rx", about=MIDDLE)
    assert fine[1] == pytest.approx(CRITICAL, rel=0.01)


def test_a_sheet_between_clamps_that_come_nearer() -> None:
    """4 pi^2 EI/EA L (Euler); the other way it never buckles."""
    text = deck(
        f"PLBEAM 1 1 2 3 4\nX 3 {LENGTH} 0\nFIX 1\nFIX 2\nFIX 3\nFIX 4", f"ESTIFF 1 {EA} {EI}"
    )
    wanted = 4 * math.pi**2 * EI / (EA * LENGTH)
    found = elastic(text).estimate(lambda m: m.critical_misalignment(3, "x"))
    assert abs(found.value[0] + wanted) <= found.uncertainty[0] < 3e-4 * wanted
    assert found.value[1] == math.inf
    other = elastic(text).critical_misalignment(1, "x")
    assert other == pytest.approx((-math.inf, -found.value[0]), rel=1e-9)


def test_a_cross_hinge_with_an_offset_clamp() -> None:
    """V = 22.2471 sqrt(EI GJ)/L^2 at an offset of 2 V L^3/12 EI_in (theory, section 3)."""
    force = 22.2471 * math.sqrt(EI * GJ) / LENGTH**2
    offset = 2 * force * LENGTH**3 / (12 * EI_IN)
    assert elastic(cross_hinge()).critical_misalignment(3, "y") == pytest.approx(
        (-offset, offset), rel=2e-3
    )


def test_stiffness_of_the_misaligned_guide() -> None:
    """1/(3 (1/z^2 - cot z/z)), z = pi phi/phi_cr (theory, section 3)."""
    model = elastic(guide())
    before = model.undeformed().compliance(9)[0, 0]
    for part in (0.25, 0.5, 0.75):
        after = model.misaligned(2, "rx", part * CRITICAL, about=MIDDLE).compliance(9)[0, 0]
        z = math.pi * part
        wanted = 1 / (3 * (1 / z**2 - 1 / (z * math.tan(z))))
        assert before / after == pytest.approx(wanted, rel=4e-3)


@pytest.mark.parametrize("shift", [-0.05, -0.5, -0.99])
def test_the_frequency_shifts_as_far_as_was_asked(shift: float) -> None:
    """The path with its large displacements agrees to first order in the stress."""
    model = elastic(guide(), beams=8)
    low, high = model.misalignment_for(shift, 2, "rx", about=MIDDLE)
    limits = model.critical_misalignment(2, "rx", about=MIDDLE)
    assert limits[0] < low < 0 < high < limits[1]
    first = model.undeformed().frequencies[0]
    there = model.misaligned(2, "rx", high, about=MIDDLE).frequencies[0]
    if shift > -0.9:
        assert there / first - 1 == pytest.approx(shift, rel=0.03)


def test_a_string_rises_in_proportion_to_the_root_of_its_tension() -> None:
    """Two bars in line, across which a spring acts: omega^2 = (k + 2 N/L)/m, N = EA d/2 L."""
    text = deck(
        "PLTRUSS 1 1 2\nPLTRUSS 2 2 3\nPLTRUSS 3 2 4\nX 1 -1 0\nX 3 1 0\nX 4 0 1\n"
        "FIX 1\nFIX 3\nFIX 4",
        "ESTIFF 1 2E5\nESTIFF 2 2E5\nESTIFF 3 500\nXM 2 0.4",
    )
    model = elastic(text)
    for shift in (0.1, 0.5, -0.1):
        wanted = ((1 + shift) ** 2 - 1) * 500 / 2e5
        found = model.misalignment_for(shift, 3, "x")
        assert found[0 if shift < 0 else 1] == pytest.approx(wanted, rel=1e-7)
        assert abs(found[1 if shift < 0 else 0]) == math.inf
    assert model.misalignment_for(-0.1, 4, "x") == (-math.inf, math.inf)


def test_a_concave_function_first_rises_to_a_level() -> None:
    def parabola(x: float) -> float:
        return 4 + 3 * x - x**2

    assert rises_to(parabola, 6.0, 4.0, 0.01, 4.0) == pytest.approx(1.0, rel=1e-8)
    # the top, 6.25, lies between two steps of the search
    assert rises_to(parabola, 6.2499, 4.0, 0.3, 4.0) == pytest.approx(1.49, rel=1e-6)
    assert rises_to(parabola, 6.26, 4.0, 0.01, 4.0) == math.inf


def test_what_a_release_keeps_of_the_guide() -> None:
    """In-plane bending released at one of four ends: the closed form of the theory.

    Of y, rx and rz together one direction loses: two sheets clamped and guided in plane, one
    of them then a bar, by the frame of both.
    """
    model = elastic(guide())
    kept = model.kept(9, [(1, 5)])
    assert kept.shape == (6,)
    before, after = (
        m.undeformed().compliance(9) for m in (model, elastic(guide(), release=[(1, 5)]))
    )
    free = np.linalg.eigvals(np.linalg.solve(after, before)).real
    np.testing.assert_allclose(kept, np.sort(free), rtol=1e-6)
    assert np.sum(kept < 0.999) == 1
    # a stiffer notch keeps more, a rigid one all
    worst = [model.kept(9, {(1, 5): k})[0] for k in (0.0, 10.0, 1e3, 1e9)]
    assert worst == sorted(worst)
    assert worst[0] == pytest.approx(kept[0])
    assert worst[-1] == pytest.approx(1.0, rel=1e-4)
    assert elastic(guide(), drive="locked").kept(9, [(1, 5)]).shape == (5,)


def test_a_release_that_leaves_a_motion_free_keeps_nothing_of_it() -> None:
    text = deck(
        "TRUSS 1 1 2\nTRUSS 2 2 3\nX 1 -1 0 0\nX 3 1 0 0\nFIX 1\nFIX 3",
        "ESTIFF 1 2E5\nESTIFF 2 2E5",
    )
    model = elastic(text)
    assert model.kept(2, [(1, 1)]) == pytest.approx([0.5])
    assert model.kept(2, [(1, 1), (2, 1)]) == pytest.approx([0.0])


def test_misfits_cost_the_same_however_often_a_sheet_is_divided() -> None:
    """A bending, a twist and a length that are off: equal energy, and stresses at its ends."""
    for k, size in ((1, 1e-7), (2, 1e-6), (3, 1e-6), (5, 1e-7), (6, 1e-7)):
        states = [elastic(guide(), beams=n).misfit(1, k, size) for n in (1, 4)]
        one, four = (state.energy for state in states)
        assert four == pytest.approx(one, rel=1e-5)
        stresses = [[state.stress(2, j) for j in range(1, 7)] for state in states]
        np.testing.assert_allclose(*stresses, rtol=1e-4, atol=1e-5 * np.abs(stresses[0]).max())
