# SPDX-License-Identifier: BSD-3-Clause
"""States of an elastic model: closed forms of textbooks, named beside each number."""

import math

import numpy as np
import pytest
from stiffness_decks import EA, EI, EI_IN, GJ, LENGTH, MASS, cantilever, deck, elastic, guide

import flexact

#: Frequency of a cantilever: roots of cos x cosh x = -1 (Rao, Mechanical Vibrations, ch. 8).
_ROOTS = (1.8751040687119611, 4.694091132974174)


def test_a_cantilever_has_the_compliance_of_the_textbook() -> None:
    """Of Euler and Bernoulli, in the order x y z rx ry rz."""
    found = elastic(cantilever()).undeformed().compliance(3)
    length, inertia = LENGTH, ((EI, 4, 1.0), (EI_IN, 3, -1.0))
    wanted = np.diag(
        [
            *(length**3 / (3 * EI), length**3 / (3 * EI_IN), length / EA),
            *(length / EI_IN, length / EI, length / GJ),
        ]
    )
    for axis, (stiff, turn, sign) in enumerate(inertia):
        wanted[axis, turn] = wanted[turn, axis] = sign * length**2 / (2 * stiff)
    np.testing.assert_allclose(found, wanted, rtol=1e-9, atol=1e-9 * wanted[1, 1])
    stiffness = elastic(cantilever()).undeformed().stiffness(4)
    np.testing.assert_allclose(stiffness @ wanted, np.eye(6), atol=1e-7)


def test_frequencies_of_a_cantilever_within_their_uncertainty() -> None:
    state = elastic(cantilever()).undeformed()
    found = state.estimate(lambda at: at.frequencies[:2])
    wanted = [x**2 * math.sqrt(EI / MASS) / LENGTH**2 / (2 * math.pi) for x in _ROOTS]
    assert np.all(np.abs(found.value - wanted) <= found.uncertainty + 1e-9 * np.abs(wanted))
    np.testing.assert_allclose(state.frequencies[:2], wanted, rtol=2e-5)
    assert state.frequencies.size >= 10
    assert np.all(np.diff(state.frequencies) >= 0)


def test_euler_buckling_and_the_lateral_buckling_of_a_strip() -> None:
    """pi^2 EI/4 L^2; 4.0126 sqrt(EI GJ)/L^2 (Timoshenko and Gere, ch. 2 and 6)."""
    column = elastic(cantilever("XF 3 0 0 -1")).equilibrium(1e-3)
    multipliers = 1e-3 * column.multipliers
    assert multipliers[multipliers > 0][0] == pytest.approx(
        math.pi**2 * EI / (4 * LENGTH**2), rel=1e-4
    )
    strip = elastic(cantilever("XF 3 0 1 0")).equilibrium(1e-3)
    first = 1e-3 * np.sort(np.abs(strip.multipliers))[:2]
    assert first == pytest.approx([4.0125993 * math.sqrt(EI * GJ) / LENGTH**2] * 2, rel=1e-3)
    assert len(strip.multipliers) >= 10


def test_the_sag_of_a_cantilever_under_its_weight() -> None:
    """q L^4/8 EI (any textbook); the moment at the clamp is q L^2/2."""
    state = elastic(cantilever("GRAVITY -9.81 0 0")).equilibrium(1e-3)
    load = MASS * 9.81e-3
    assert state.position(3)[0] == pytest.approx(-load * LENGTH**4 / (8 * EI), rel=1e-4)
    found = state.resultants(1)
    assert abs(found.moment_y).max() < 1e-12 or abs(found.moment_z).max() < 1e-12
    moments = found.moment_y + found.moment_z
    assert abs(moments[0]) == pytest.approx(load * LENGTH**2 / 2, rel=1e-3)
    assert abs(found.shear_y + found.shear_z) == pytest.approx(load * LENGTH / 2, rel=1e-3)
    assert state.reaction(1, "x") == pytest.approx(load * LENGTH, rel=1e-9)


def test_loads_act_in_equilibrium_alone_and_are_scaled() -> None:
    model = elastic(cantilever("XF 3 0 0 2\nDELXF 3 0 0 1"))
    assert model.undeformed().energy == 0.0
    assert model.equilibrium().stress(1, 1) == pytest.approx(3.0, rel=1e-9)
    assert model.equilibrium(-2).stress(1, 1) == pytest.approx(-6.0, rel=1e-6)
    assert model.equilibrium().resultants(1).normal_force == pytest.approx(3.0, rel=1e-9)


def test_peak_stress_of_a_bent_sheet_and_a_wire() -> None:
    """6 F L/b t^2 and 32 F L/pi d^3 at the clamp (any textbook)."""
    picture = "\nVISUALIZATION\nBEAMPROPS 1\nCROSSTYPE {}\nCROSSDIM {}\n"
    force = 1e-3
    text = cantilever(f"XF 3 {force} 0 0")
    sheet = elastic(text + picture.format("RECT", "0.05 0.0005")).equilibrium()
    assert sheet.peak_stress(1) == pytest.approx(6 * force * LENGTH / (0.05 * 0.0005**2), rel=1e-4)
    wire = elastic(text + picture.format("CIRC", "0.002")).equilibrium()
    assert wire.peak_stress(1) == pytest.approx(
        32 * force * LENGTH / (math.pi * 0.002**3), rel=1e-4
    )
    with pytest.raises(flexact.ElasticError, match="section of element 1 is not known"):
        elastic(text).equilibrium().peak_stress(1)


def test_the_guide_in_closed_form() -> None:
    """24 EI/L^3, 2 EA/L and 12 EI_in of two sheets side by side, at mid height."""
    state = elastic(guide()).undeformed()
    assert 1 / state.compliance(9)[0, 0] == pytest.approx(24 * EI / LENGTH**3, rel=1e-9)
    assert 1 / state.compliance(10)[2, 2] == pytest.approx(2 * EA / LENGTH, rel=1e-9)
    assert state.over_constrained == 1
    assert state.under_constrained == 0
    assert state.is_stable
    assert state.loose == ()


def test_a_locked_drive_has_no_compliance_and_an_infinite_stiffness() -> None:
    state = elastic(guide(), drive="locked").undeformed()
    compliance, stiffness = state.compliance(9), state.stiffness(9)
    assert not compliance[0].any()
    assert not compliance[:, 0].any()
    assert stiffness[0, 0] == math.inf
    rest = np.ix_(range(1, 6), range(1, 6))
    np.testing.assert_allclose(stiffness[rest] @ compliance[rest], np.eye(5), atol=1e-8)


def test_a_motion_without_stiffness_is_named_and_prestress_stiffens_it() -> None:
    """Two bars in line: k = 2 N/L across them (a string)."""
    text = deck(
        "TRUSS 1 1 2\nTRUSS 2 2 3\nX 1 -1 0 0\nX 3 1 0 0\nFIX 1\nFIX 3",
        "ESTIFF 1 2E5\nESTIFF 2 2E5\nXM 2 0.4",
    )
    model = elastic(text)
    rest = model.undeformed()
    assert [motion.coordinates for motion in rest.loose] == [((2, "y"),), ((2, "z"),)]
    assert rest.compliance(2)[1, 1] == math.inf
    assert rest.compliance(2)[0, 0] == pytest.approx(1 / 4e5)
    np.testing.assert_allclose(rest.stiffness(2), np.diag([4e5, 0, 0]), atol=1e-9)
    assert list(rest.frequencies[:2]) == pytest.approx([0, 0], abs=1e-9)
    tight = model.misfit(1, 1, -1e-4)
    assert tight.stress(2, 1) == pytest.approx(10.0, rel=1e-6)
    assert tight.compliance(2)[2, 2] == pytest.approx(1 / 20.0, rel=1e-3)
    slack = model.misfit(1, 1, 1e-4)
    assert not slack.is_stable
    assert slack.frequencies[0] == pytest.approx(-tight.frequencies[0], rel=1e-3)
    assert "Buckled" in slack.describe()


def test_what_is_warmed_between_walls_is_pressed() -> None:
    """N = EA alpha dT of a clamped bar (any textbook)."""
    text = deck("TRUSS 1 1 2\nX 2 1 0 0\nFIX 1\nFIX 2", "ESTIFF 1 2E5")
    state = elastic(text).warmed(10.0, expansion=1.2e-5)
    assert state.stress(1, 1) == pytest.approx(-2e5 * 1.2e-4, rel=1e-9)
    assert state.energy == pytest.approx(2e5 * 1.2e-4**2 / 2, rel=1e-9)


def test_stresses_of_least_norm_are_taken_and_it_is_said() -> None:
    """A rigid stage on two rigid sheets that are pressed alike."""
    model = elastic(guide("XF 9 0 0 -1"), held="rigid")
    state = model.equilibrium()
    assert state.stress(1, 1) == pytest.approx(-0.5, rel=1e-6)
    assert state.stress(2, 1) == pytest.approx(-0.5, rel=1e-6)
    assert "least norm" in state.notes[0]
    assert not model.undeformed().notes
