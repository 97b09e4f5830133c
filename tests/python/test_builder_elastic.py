"""What the builder gives is what an elastic analysis needs: against beam theory."""

import math

import pytest

import flexact
from flexact import Material, Model

#: A sheet 100 mm x 40 mm x 0.5 mm.
LENGTH, BREADTH, THICKNESS = 0.1, 0.04, 0.5e-3
STEEL = Material("steel", 210e9, 210e9 / 2.6, 7800.0)
AREA = BREADTH * THICKNESS
BENDING = 210e9 * BREADTH * THICKNESS**3 / 12, 210e9 * THICKNESS * BREADTH**3 / 12
#: Cowper's coefficient of a rectangle for nu 0.3.
SHEAR = 13.0 / 15.3 * STEEL.G * AREA
#: Saint-Venant's constant to the second term, b t^3/3 (1 - 0.63025 t/b): thin sheets.
TORSION = STEEL.G * BREADTH * THICKNESS**3 / 3 * (1 - 0.63025 * THICKNESS / BREADTH)


def cantilever() -> Model:
    """Along x, the width along z."""
    model = Model()
    size = {"section": (BREADTH, THICKNESS), "material": STEEL}
    model.sheet((0, 0, 0), model.node(LENGTH, 0, 0, name="tip"), "z", name="sheet", **size)
    model.fix((0, 0, 0))
    return model


def test_all_six_compliances_of_a_cantilever() -> None:
    """Timoshenko's beam: L^3/3EI + L/kGA, L/EI, L/G It, L/EA."""
    model = cantilever()
    tip = model.point("tip")
    found = flexact.elastic(model, beams=1).undeformed().compliance(tip.orientation)
    out, inside = BENDING
    wanted = (
        LENGTH / (STEEL.E * AREA),
        LENGTH**3 / (3 * out) + LENGTH / SHEAR,
        LENGTH**3 / (3 * inside) + LENGTH / SHEAR,
        LENGTH / TORSION,
        LENGTH / inside,
        LENGTH / out,
    )
    assert found.diagonal() == pytest.approx(wanted, rel=1e-5)


def test_forces_and_moments_of_python_act() -> None:
    model = cantilever()
    tip = model.point("tip")
    model.force("tip", 0, 1e-4, 2e-2)
    model.moment("tip", 1e-6, 0, 0)
    state = flexact.elastic(model, beams=1).equilibrium()
    out, inside = BENDING
    there = state.position(tip.position) - (LENGTH, 0, 0)
    assert there[1] == pytest.approx(1e-4 * (LENGTH**3 / 3 / out + LENGTH / SHEAR), rel=1e-4)
    assert there[2] == pytest.approx(2e-2 * (LENGTH**3 / 3 / inside + LENGTH / SHEAR), rel=1e-3)
    assert state.position(tip.orientation)[0] == pytest.approx(1e-6 * LENGTH / TORSION, rel=1e-2)
    twice = flexact.elastic(model, beams=1).equilibrium(load=2.0)
    moved = twice.position(tip.position) - (LENGTH, 0, 0)
    assert moved[1] == pytest.approx(2 * there[1], rel=1e-4)
    # What is added in the course of loading is there at its end.
    model.force("tip", 0, -1e-4, -2e-2, increment=True)
    model.moment("tip", -1e-6, 0, 0, increment=True)
    state = flexact.elastic(model, beams=1).equilibrium()
    assert abs(state.position(tip.position) - (LENGTH, 0, 0)).max() < 1e-12


def test_a_sheet_sags_under_its_own_weight() -> None:
    """w L^4/8EI + w L^2/2kGA: consistent loads are exact at the nodes but for the shear."""
    model = cantilever()
    model.gravity(0, -9.81, 0)
    tip = model.point("tip")
    weight = 9.81 * STEEL.density * AREA
    state = flexact.elastic(model, beams=1).equilibrium()
    wanted = -weight * LENGTH**4 / (8 * BENDING[0])
    assert state.position(tip.position)[1] == pytest.approx(wanted, rel=1e-4)


def test_masses_of_sheets_and_bodies_count() -> None:
    """A guide of two sheets: omega^2 = 24 EI/(L^3 (1 + P)) / (M + 2 * 13/35 of a sheet)."""
    guide = Model()
    size = {"section": (BREADTH, THICKNESS), "material": STEEL}
    for y in (0.0, 0.05):
        guide.sheet((0, y, 0), (LENGTH, y, 0), "z", **size)
        guide.fix((0, y, 0))
    guide.body([(LENGTH, 0, 0), (LENGTH, 0.05, 0)], name="stage", mass=0.3)
    guide.independent("stage", "y")
    sheet = STEEL.density * AREA * LENGTH
    phi = 12 * BENDING[0] / (SHEAR * LENGTH**2)
    stiffness = 24 * BENDING[0] / (LENGTH**3 * (1 + phi))
    omega = math.sqrt(stiffness / (0.3 + 2 * 13 / 35 * sheet))
    found = flexact.elastic(guide, beams=1).undeformed().frequencies[0]
    assert found == pytest.approx(omega / (2 * math.pi), rel=2e-3)


def test_a_notch_has_the_stiffness_that_it_is_given() -> None:
    """A rigid lever on a notch: F a^2/k at its end."""
    model = Model()
    notch = model.notch(model.node(0, 0, 0), "z", stiffness=2.5)
    model.fix(notch.p)
    model.rigid(notch.q, model.node(0.08, 0, 0, name="end"))
    end = model.point("end")
    found = flexact.elastic(model, beams=1).undeformed().compliance(end.position)
    assert found[1, 1] == pytest.approx(0.08**2 / 2.5, rel=1e-9)


@pytest.mark.parametrize("beams", [1, 4])
def test_held_warping_is_in_the_torsional_compliance(beams: int) -> None:
    """1/(1 - tanh x/x) with x = (L/b) sqrt(6/(1 + nu)), of a thin sheet, however it is divided."""
    x = LENGTH / BREADTH * math.sqrt(6 / 1.3)
    size = {"section": (BREADTH, THICKNESS), "material": STEEL, "beams": beams}
    compliance = []
    for warping in (False, True):
        model = Model()
        model.sheet((0, 0, 0), (LENGTH, 0, 0), "z", warping=warping, **size)
        model.fix((0, 0, 0))
        tip = model.point((LENGTH, 0, 0))
        state = flexact.elastic(model, beams=1).undeformed()
        compliance.append(state.compliance(tip.orientation)[3, 3])
    # The finite thickness is 1e-2 of the breadth.
    assert compliance[0] / compliance[1] == pytest.approx(1 / (1 - math.tanh(x) / x), rel=4e-3)
