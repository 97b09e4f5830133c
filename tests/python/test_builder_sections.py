# SPDX-License-Identifier: BSD-3-Clause
"""Sections and materials: stiffness and mass against closed forms and printed tables."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from wording import AsStored
from wrong_use import code_of

from flexact import Material, Model, ModelError
from flexact.model.draft import Shape
from flexact.model.sections import MATERIALS, constants_of

ROOT = Path(__file__).resolve().parents[2]

RECT, CIRC = 1, 2


def properties(model: Model) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """ESTIFF and EM of the first element."""
    draft = model._change()
    return draft.stiffness[0], draft.mass[0]


@pytest.mark.parametrize(
    ("ratio", "factor"),
    # J / (b t^3): Timoshenko and Goodier, Theory of Elasticity, table in art. 109.
    [(1.0, 0.1406), (1.2, 0.166), (1.5, 0.196), (2, 0.229), (3, 0.263), (5, 0.291), (10, 0.312)],
)
def test_torsion_constant_of_rectangles(ratio: float, factor: float) -> None:
    for y, z in ((1.0, ratio), (ratio, 1.0)):
        made = constants_of(Shape(RECT, 1e-3 * y, 1e-3 * z))
        assert made.torsion / (ratio * 1e-12) == pytest.approx(factor, abs=6e-4)


def test_torsion_constant_to_many_digits() -> None:
    # Values of 9 digits from the reference cases of beams, ratios 1 and 10.
    assert constants_of(Shape(RECT, 1, 1)).torsion == pytest.approx(0.140577015, abs=5e-10)
    assert constants_of(Shape(RECT, 1, 10)).torsion / 10 == pytest.approx(0.312325037, abs=5e-10)
    thin = constants_of(Shape(RECT, 1e-4, 1.0)).torsion
    assert thin == pytest.approx(1e-12 / 3 * (1 - 0.630e-4), rel=1e-8), (
        "Roark: b t^3/3 (1 - 0.63 t/b)"
    )


def test_a_sheet_has_the_stiffness_of_its_section() -> None:
    # Sheet 100 x 50 x 0.5 mm, 210 GPa, nu 0.3: EA 5.25e6, G It 0.167209, E I in its plane
    # 1093.75, out of it 0.109375 (reference cases of beams).
    steel = Material("steel of the case", 210e9, 210e9 / 2.6, 7850)
    model = Model()
    model.sheet((0, 0, 0), (0.1, 0, 0), "z", section=(0.05, 0.0005), material=steel)
    stiffness, mass = properties(model)
    # Deformations 3 and 4, in the plane of the sheet, have the third value.
    area = 0.05 * 0.0005
    # Shear: Cowper's k of a rectangle, 10 (1 + nu)/(12 + 11 nu) = 13/15.3 for nu 0.3.
    shear = [e / (210e9 / 2.6 * area * 13.0 / 15.3) for e in (1093.75, 0.109375)]
    assert stiffness == pytest.approx((5.25e6, 0.167209, 1093.75, 0.109375, *shear), rel=1e-5)
    inertia = 7850 * 0.0005 * 0.05**3 / 12, 7850 * 0.05 * 0.0005**3 / 12
    assert mass == pytest.approx((7850 * area, sum(inertia), *inertia, 0.0))
    # The section is drawn with its width along local z.
    assert model.data.appearance.dimensions.tolist() == [[0.0005, 0.05]]


def test_thickness_and_breadth_are_the_section() -> None:
    one, other = Model(), Model()
    one.sheet((0, 0, 0), (0.1, 0, 0), "z", section=(0.05, 0.0005), material="steel", beams=3)
    other.sheet(
        (0, 0, 0), (0.1, 0, 0), "z", thickness=5e-4, breadth=5e-2, material="steel", beams=3
    )
    assert properties(one) == properties(other)
    assert len(one._change().stiffness) == len(one._change().mass) == 3
    assert (one.data.appearance.dimensions == other.data.appearance.dimensions).all()


def test_a_wire_is_round() -> None:
    model = Model()
    model.wire((0, 0, 0), (0.1, 0, 0), thickness=0.001, material="spring steel")
    second = math.pi * 0.001**4 / 64
    stiffness, mass = properties(model)
    area = math.pi * 0.001**2 / 4
    # Shear: Cowper's k of a circle, 6 (1 + nu)/(7 + 6 nu).
    nu = 206 / (2 * 81.5) - 1
    shear = 206e9 * second / (81.5e9 * area * 6 * (1 + nu) / (7 + 6 * nu))
    wanted = (206e9 * area, 81.5e9 * 2 * second, 206e9 * second, 206e9 * second, shear, shear)
    assert stiffness == pytest.approx(wanted)
    assert mass == pytest.approx((7850 * area, 7850 * 2 * second, 7850 * second, 7850 * second, 0))
    assert model.data.appearance.cross_section.tolist() == [CIRC]


def test_bars_and_planar_sheets_have_fewer_values() -> None:
    model = Model(planar=True)
    model.sheet((0, 0), (0.1, 0), thickness=5e-4, breadth=5e-2, material="aluminium")
    inertia = 0.05 * 0.0005**3 / 12
    nu = 70 / 54 - 1
    shear = 70e9 * inertia / (27e9 * 2.5e-5 * 10 * (1 + nu) / (12 + 11 * nu))
    assert properties(model)[0] == pytest.approx((70e9 * 2.5e-5, 70e9 * inertia, shear))
    assert properties(model)[1] == pytest.approx((2700 * 2.5e-5, 2700 * inertia))
    bar = Model()
    bar.truss((0, 0, 0), (1, 0, 0), thickness=0.01, material={"E": 1e9, "G": 4e8, "density": 1000})
    area = math.pi * 1e-4 / 4
    assert properties(bar) == (pytest.approx((1e9 * area,)), pytest.approx((1000 * area,)))


def test_hinges_and_notches_have_a_stiffness_of_their_own() -> None:
    model = Model()
    p = model.node(0, 0, 0)
    model.hinge(p, "z", name="free")
    model.hinge(p, "z", stiffness=2.5, name="spring")
    model.notch(p, "z", stiffness=(2.5, 4e3, 5e3), name="notch")
    assert model._change().stiffness == {1: (2.5,), 2: (2.5, 4e3, 5e3)}
    plane = Model(planar=True)
    plane.hinge(plane.node(0, 0), stiffness=3)
    assert plane._change().stiffness == {0: (3.0,)}
    for stiffness in (-1, (1, 2), "stiff", math.nan):
        with pytest.raises(ModelError) as error:
            model.notch(p, "z", stiffness=stiffness, name="wrong")  # type: ignore[arg-type]
        assert code_of(error) in ("bad-size", "bad-number")


def test_a_material_without_density_gives_no_mass() -> None:
    model = Model()
    model.wire((0, 0, 0), (1, 0, 0), thickness=1e-3, material=Material("light", 1e9, 4e8))
    assert model._change().stiffness and not model._change().mass


def test_parts_can_be_given_their_material_afterwards() -> None:
    model = Model()
    hinge = model.cross_hinge(
        [(-0.03, 0, 0), (0.03, 0, 0)], [(0.03, 0, 0.08), (-0.03, 0, 0.08)], name="hinge"
    )
    model.made_of(hinge, "titanium", thickness=2e-4, breadth=0.02)
    model.made_of("hinge sheet 2", "steel")
    draft = model._change()
    axial = [draft.stiffness[k][0] for k in (0, 1)]
    assert axial == pytest.approx([113.8e9 * 4e-6, 210e9 * 4e-6])
    assert set(draft.stiffness) == {0, 1}, "the body has none"
    # Of a body it says how it expands.
    model.made_of("hinge body", "aluminium")
    assert [draft.expansion[k][0] for k in (0, 1, 2)] == [8.6e-6, 12e-6, 23e-6]
    with pytest.raises(ModelError) as error:
        model.made_of("hinge body", "PA12")
    assert code_of(error) == "no-expansion"
    with pytest.raises(ModelError) as error:
        model.made_of("hinge body", thickness=0.01)
    assert code_of(error) == "no-section"


def test_common_materials_are_isotropic_within_reason() -> None:
    """E = 2 G (1 + nu) with nu of metals, 0.25 to 0.36, and of plastics, up to 0.41."""
    assert len(MATERIALS) >= 5
    for name, material in MATERIALS.items():
        assert name == material.name
        assert 0.25 < material.E / (2 * material.G) - 1 < (0.36 if material.E > 1e10 else 0.41), (
            name
        )


def test_the_page_shows_the_known_materials(as_stored: AsStored) -> None:
    rows = [
        "| material | E, G [GPa] | density [kg/m3] | strength, fatigue [MPa] | expansion [1e-6/K] |"
    ]
    rows.append("|---|---|---|---|---|")

    def told(value: float | None, factor: float) -> str:
        return "not known" if value is None else f"{value / factor:.4g}"

    for each in MATERIALS.values():
        both = f"{told(each.strength, 1e6)}, {told(each.fatigue, 1e6)}"
        rows.append(
            f'| "{each.name}" | {told(each.E, 1e9)}, {told(each.G, 1e9)} | {each.density:g} '
            f"| {both} | {told(each.expansion, 1e-6)} |"
        )
    page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    start = "<!-- materials: make wording -->\n"
    before, _, rest = page.partition(start)
    behind = rest.partition("<!-- end of materials -->")[2]
    table = "\n".join(rows)
    filled = f"{before}{start}{table}\n<!-- end of materials -->{behind}"
    as_stored(filled, ROOT / "docs" / "python.md")


def test_shear_as_a_public_program_writes_it() -> None:
    """ESTIFF of sheets of 50 mm x 0.2 mm, E 210 GPa, G 70 GPa, in a deck that SPACAR Light wrote.

    crosshinge.dat of github.com/Wout-S/oopspa at bcad60fc; nu is 0.5, and k = 15/17.5.
    """
    steel = Material("of the deck", 210e9, 70e9, 7800)
    model = Model()
    model.sheet((0, 0, 0), (0.1, 0.1, 0), "z", section=(0.05, 0.0002), material=steel)
    stiffness, mass = properties(model)
    wanted = 2.1e6, 0.009309804722106, 437.5, 0.007, 7.29166666667e-4, 1.1666666667e-8
    assert stiffness == pytest.approx(wanted, rel=1e-6)
    assert mass == pytest.approx((0.078, 1.625026e-5, 1.625e-5, 2.6e-10, 0))


def stiffer(x: float) -> float:
    """Of v - (1/(2 x))^2 v" = 1 on a unit length, v = 0 at its ends, the inverse of the mean of v.

    By differences on a fine mesh.
    """
    n = 400
    second = n**2 * (np.eye(n - 1, k=1) - 2.0 * np.eye(n - 1) + np.eye(n - 1, k=-1))
    twist = np.linalg.solve(np.eye(n - 1) - second / (2.0 * x) ** 2, np.ones(n - 1))
    return float(n / twist.sum())


@pytest.mark.parametrize(
    ("ratio", "factor"),
    # L/b and the factor for nu 0.3, of the closed form; the test solves the equation besides.
    [(1, 1.828), (2, 1.303), (3, 1.184), (5, 1.103), (10, 1.049)],
)
def test_held_warping_raises_the_torsional_stiffness(ratio: float, factor: float) -> None:
    steel = Material("steel", 210e9, 210e9 / 2.6, 7850)
    length, breadth, thickness = 0.01 * ratio, 0.01, 1e-6
    free, held = Model(), Model()
    section = breadth, thickness
    free.sheet((0, 0, 0), (length, 0, 0), "z", section=section, material=steel)
    held.sheet(
        (0, 0, 0), (length, 0, 0), "z", beams=3, section=section, material=steel, warping=True
    )
    plain, raised = properties(free)[0], properties(held)[0]
    assert raised[1] / plain[1] == pytest.approx(factor, abs=6e-4)
    assert raised[1] / plain[1] == pytest.approx(stiffer(ratio * math.sqrt(6 / 1.3)), rel=1e-4)
    assert (raised[0], *raised[2:]) == (plain[0], *plain[2:])


def test_warping_is_a_factor_or_held_or_left_out() -> None:
    model = Model()
    section = 0.02, 1e-4
    model.sheet((0, 0, 0), (0.1, 0, 0), "z", name="plain", section=section, material="steel")
    model.sheet((0, 1, 0), (0.1, 1, 0), "z", section=section, material="steel", warping=1.5)
    corner = (0, 2, 0), (0.1, 2, 0), (0.1, 2, 0.1)
    model.folded_sheet(*corner, section=section, material="steel", warping=True)
    twist = [row[1] for row in model._change().stiffness.values()]
    assert twist[1] == pytest.approx(1.5 * twist[0])
    assert twist[2] == pytest.approx(twist[3]) and twist[2] > 1.05 * twist[0]
    for _ in range(2):
        model.made_of("plain", "steel", warping=True)
        assert model._change().stiffness[0][1] == pytest.approx(twist[2])


Call = Callable[[Model], object]
ENDS = (0, 0, 0), (1, 0, 0)
WRONG: list[tuple[str, Call]] = [
    ("no-such-material", lambda m: m.wire(*ENDS, thickness=1e-3, material="stel", name="w")),
    ("missing-section", lambda m: m.wire(*ENDS, material="steel", name="w")),
    ("missing-section", lambda m: m.sheet(*ENDS, "z", thickness=1e-3, name="w")),
    ("no-section", lambda m: m.sheet(*ENDS, "z", section=(1, 1), warping=True, name="w")),
    (
        "bad-number",
        lambda m: m.sheet(*ENDS, "z", section=(1, 1), material="steel", warping=0.5, name="w"),
    ),
    ("given-twice", lambda m: m.sheet(*ENDS, "z", section=(1, 1), thickness=1, name="w")),
    ("given-twice", lambda m: m.wire(*ENDS, section=1, thickness=1, name="w")),
    ("bad-size", lambda m: m.wire(*ENDS, thickness=-1, name="w")),
    ("bad-number", lambda m: m.wire(*ENDS, thickness="thin", name="w")),
    ("bad-material", lambda m: m.wire(*ENDS, thickness=1, material={"E": 1}, name="w")),
    ("bad-material", lambda m: m.wire(*ENDS, thickness=1, material=5, name="w")),
    ("bad-material", lambda m: m.wire(*ENDS, thickness=1, material={"E": 0, "G": 1}, name="w")),
]


@pytest.mark.parametrize(("code", "call"), WRONG)
def test_wrong_sections_are_told_with_the_part(code: str, call: Call) -> None:
    model = Model()
    with pytest.raises(ModelError) as error:
        call(model)
    assert code_of(error) == code
    assert " 'w': " in error.value.diagnostics[0].message
    assert error.value.diagnostics[0].help or code in ("bad-number",)
    assert model.element_numbers.size == 0


@pytest.mark.parametrize(
    "values", [(0, 1), (-1, 1), (1, math.nan), (1, math.inf), ("1", 1), (1, 1, -1)]
)
def test_no_materials(values: tuple[float, ...]) -> None:
    with pytest.raises(ModelError) as error:
        Material("x", *values)
    assert code_of(error) == "bad-material"
