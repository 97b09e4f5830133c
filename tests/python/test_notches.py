# SPDX-License-Identifier: BSD-3-Clause
"""Notches of a contour, sheets that taper or are thick in the middle, and fillets."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from wrong_use import code_of

import flexact
from flexact import Model, ModelError, NotchContour, analyse
from flexact.model.draft import Shape
from flexact.model.notches import MOTIONS, deep_notch_factor, stress_factor
from flexact.model.sections import constants_of

E, G = 210e9, 81e9
SIZES: dict[str, dict[str, Any]] = {
    "circular": {"thickness": 3e-4, "breadth": 1e-2, "radius": 4e-3},
    "circular, thick": {"thickness": 2e-3, "breadth": 4e-3, "radius": 4e-3},
    "circular, flat": {"thickness": 3e-4, "breadth": 1e-2, "radius": 4e-3, "height": 3e-3},
    "fillet": {"thickness": 3e-4, "breadth": 5e-3, "radius": 1e-3, "length": 6e-3},
    "fillet, low": {
        **{"thickness": 3e-4, "breadth": 5e-3, "radius": 1e-3, "length": 6e-3},
        "height": 1e-3,
    },
    "elliptic": {"thickness": 3e-4, "breadth": 1e-2, "length": 6e-3, "height": 4e-3},
    "parabolic": {"thickness": 3e-4, "breadth": 1e-2, "length": 6e-3, "height": 4e-3},
}


def contour(name: str, **more: Any) -> NotchContour:
    return NotchContour(name.partition(",")[0], **{**SIZES[name], **more})


def counts(model: Model) -> tuple[int, int]:
    analysis = analyse(model)
    return analysis.under_constrained, analysis.over_constrained


def about_middle(compliance: np.ndarray, way: np.ndarray, axis: np.ndarray) -> np.ndarray:
    """A compliance at the end of a way, about its middle, in the frame of the notch.

    Of a rigid body the middle moves as u - r x way/2 where its end moves by u and turns by r.
    """
    x, y, z = way / 2.0
    shift = np.eye(6)
    shift[:3, 3:] = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    along = way / np.linalg.norm(way)
    frame = np.array([along, np.cross(axis, along), axis])
    turn = np.kron(np.eye(2), frame)
    return np.asarray(turn @ shift @ compliance @ shift.T @ turn.T)


@pytest.mark.parametrize("name", SIZES)
def test_its_compliances_are_those_of_fine_beams(name: str) -> None:
    """A bar of 240 beams of steps, closer together towards the neck, and as a model alone."""
    notch = contour(name)
    model, half = Model(), notch.length / 2.0
    u = np.linspace(-1.0, 1.0, 241)
    places = half * np.sign(u) * np.abs(u) ** 1.5
    nodes = [model.node(x + half, 0, 0) for x in places]
    for p, q, at in zip(nodes, nodes[1:], (places[1:] + places[:-1]) / 2.0, strict=False):
        size = float(notch.thickness_at(at)), notch.breadth
        model.beam(p, q, "y", section=size, material="steel")
    model.fix(nodes[0])
    compliance = flexact.elastic(model, beams=1).undeformed().compliance(nodes[-1])
    found = about_middle(compliance, np.array([notch.length, 0, 0]), np.array([0.0, 0, 1]))
    assert np.diag(found) == pytest.approx(notch.compliance, rel=0.005)


def simpson(what: Callable[[np.ndarray], np.ndarray], low: float, high: float) -> float:
    """An integral by Simpson's rule with 2000 steps."""
    x = np.linspace(low, high, 2001)
    y = what(x)
    return float((y[0] + y[-1] + 4 * y[1::2].sum() + 2 * y[2:-1:2].sum()) * (x[1] - x[0]) / 3)


@pytest.mark.parametrize("name", SIZES)
def test_its_integrals_are_exact(name: str) -> None:
    """By Simpson's rule, in the angle about the ends of the notch; torsion and shear with it."""
    notch, nu = contour(name), E / (2 * G) - 1
    half, b, k = notch.length / 2, notch.breadth, 10 * (1 + nu) / (12 + 11 * nu)
    edge = math.sqrt(notch.thickness * notch.root_radius) / half
    corner = notch.straight / half
    places = {0.0, 1.0, edge / 4, edge, 4 * edge, corner, corner + 0.1 * edge, corner + 0.4 * edge}
    breaks = [math.asin(each) for each in sorted(places) if each <= 1.0]

    def whole(what: Callable[[np.ndarray, np.ndarray], np.ndarray]) -> float:
        """Twice the integral over one half."""

        def local(u: np.ndarray) -> np.ndarray:
            x = half * np.sin(u)
            return what(x, notch.thickness_at(x)) * half * np.cos(u)

        return 2 * sum(simpson(local, *both) for both in itertools.pairwise(breaks))

    def torsion(t: np.ndarray) -> np.ndarray:
        return np.array([constants_of(Shape(1, each, b)).torsion for each in t])

    wanted = (
        whole(lambda x, t: 1 / (E * b * t)),
        whole(lambda x, t: 12 * x**2 / (E * b * t**3) + 1 / (G * k * b * t)),
        whole(lambda x, t: 12 * x**2 / (E * t * b**3) + 1 / (G * k * b * t)),
        whole(lambda x, t: 1 / (G * torsion(t))),
        whole(lambda x, t: 12 / (E * t * b**3)),
        whole(lambda x, t: 12 / (E * b * t**3)),
    )
    assert notch.compliance == pytest.approx(wanted, rel=1e-8)


@pytest.mark.parametrize("name", SIZES)
def test_closed_forms_that_are_published_agree(name: str) -> None:
    """Paros and Weisbord, Smith, Lobontiu: bending without approximation."""
    full = [each for each in contour(name).published if each.holds == "all sizes, by beam theory"]
    assert len(full) == 3
    assert max(abs(each.deviation) for each in full) < 1e-8


@pytest.mark.parametrize("ratio", [0.05, 0.1, 0.2, 0.35, 0.5, 0.8])
def test_it_lies_within_the_spread_of_what_is_published(ratio: float) -> None:
    """Finite elements, which Smith and Schotborgh fitted, are softer: the blank gives way, too."""
    notch = NotchContour(thickness=ratio * 4e-3, breadth=1e-2, radius=4e-3)
    inside = [each for each in notch.published if each.inside and each.what == MOTIONS[5][0]]
    deviations = [each.deviation for each in inside]
    assert len(inside) >= 2
    assert min(deviations) < 1e-8 and max(deviations) > -1e-8
    assert max(map(abs, deviations)) < 0.05 + 0.35 * ratio
    by_name = {each.formula: each.value for each in inside}
    if ratio >= 0.2:
        fits = by_name["Smith and Chetwynd"], by_name["Schotborgh and others"]
        assert fits[0] == pytest.approx(fits[1], rel=0.06)
    if ratio > 0.1:
        assert "Paros and Weisbord, simplified" not in by_name


def test_a_long_parabola_is_the_integral_over_a_whole_one() -> None:
    """The integral of (1 + x^2)^-3 over all x is 3 pi/8, of x^2 (1 + x^2)^-3 it is pi/8."""
    t, c, a = 1e-4, 1.0, 1.0
    notch = NotchContour(
        "parabolic", thickness=t, height=t + 2 * c, length=2 * a, breadth=1.0, material=SOFT
    )
    width = a * math.sqrt(t / (2 * c))
    assert notch.compliance[5] == pytest.approx(12 * width / t**3 * 3 * math.pi / 8, rel=1e-6)


SOFT = flexact.Material("soft", E=1.0, G=0.4)


# Stress ----------------------------------------------------------------------


def test_the_factor_of_deep_notches() -> None:
    """Neuber's is 4/3 where the half thickness is the radius; Smith's fit, Flexures (2000)."""
    assert deep_notch_factor(2.0, 1.0) == pytest.approx(4 / 3)
    assert deep_notch_factor(2e-3 * (1 - 1e-9), 1.0) == pytest.approx(
        deep_notch_factor(2e-3 * (1 + 1e-9), 1.0), abs=1e-6
    )
    for beta in (0.02, 0.1, 0.3, 1.0):
        assert deep_notch_factor(2 * beta, 1.0) == pytest.approx((1 + beta) ** 0.45, rel=0.03)


@pytest.mark.parametrize("ratio", [0.05, 0.1, 0.2, 0.3])
def test_the_factor_of_a_fillet(ratio: float) -> None:
    """R. L. Norton, Machine Design, appendix E: 0.9072 (r/d)^(-1/3) for D/d = 3."""
    assert stress_factor(1.0, ratio) == pytest.approx(0.9072 * ratio ** (-1 / 3), rel=0.035)
    assert (
        stress_factor(1.0, ratio) == stress_factor(1.0, ratio, 3.0) == stress_factor(2, 2 * ratio)
    )


def test_a_notch_with_fillets_has_a_radius_that_says_its_factor() -> None:
    """That of deep notches stands with its hinge, which knows no contour."""
    notch = contour("fillet")
    found = deep_notch_factor(notch.thickness, notch.even_radius)
    assert found == pytest.approx(notch.stress_factor, rel=1e-9)
    assert stress_factor(1.0, [0.1, math.nan]).tolist() == [stress_factor(1.0, 0.1), 1.0]


def test_the_factor_of_a_fillet_goes_on_beyond_its_charts() -> None:
    assert stress_factor(1.0, 100.0) == 1.0
    falling = [stress_factor(1.0, r) for r in np.geomspace(1e-3, 10, 200)]
    assert (np.diff(falling) < 1e-9).all() and falling[-1] < 1.02
    assert stress_factor(1.0, 1e-4) == pytest.approx(stress_factor(1.0, 1e-3) * 10**0.4555)
    for edge in (0.05, 0.5):
        both = stress_factor(1.0, edge * (1 - 1e-9)), stress_factor(1.0, edge * (1 + 1e-9))
        assert both[0] == pytest.approx(both[1], rel=0.01)


def test_peak_stress_of_a_slender_circular_notch() -> None:
    """From the simplified formula of Paros and Weisbord, 4/(3 pi) E sqrt(t/R) an angle."""
    notch = NotchContour(thickness=2e-4, breadth=1e-2, radius=4e-3)
    wanted = notch.stress_factor * 4 / (3 * math.pi) * E * math.sqrt(0.05)
    assert notch.stress_per_angle == pytest.approx(wanted, rel=0.01)
    moment = 1 / notch.compliance[5]
    assert notch.stress_per_moment * moment == pytest.approx(notch.stress_per_angle)


# In a model ------------------------------------------------------------------


@pytest.mark.parametrize("name", SIZES)
@pytest.mark.parametrize(
    ("way", "axis"), [((0.02, 0, 0), (0, 0, 1)), ((0.02, 0.02, 0.04), (1, -2, 0.5))]
)
def test_a_model_has_its_six_compliances(
    name: str, way: tuple[float, ...], axis: tuple[float, ...]
) -> None:
    notch, model = contour(name), Model()
    made = model.notch((0, 0, 0), axis, way, "neck", contour=notch)
    model.fix((0, 0, 0))
    model.body([made.q, np.multiply(way, 1.5)], name="stage")
    for each in (model, flexact.read_text(model.to_deck())):
        assert not each.diagnostics
        assert counts(each) == (1, 0)
        compliance = flexact.elastic(each).undeformed().compliance(made.q.position)
        unit = np.array(axis) / np.linalg.norm(axis)
        found = about_middle(compliance, np.array(way), unit)
        assert np.diag(found) == pytest.approx(notch.compliance, rel=1e-8)
        size = np.sqrt(notch.compliance)
        assert np.abs(found / np.outer(size, size) - np.eye(6)).max() < 1e-8


def test_a_planar_model_has_its_three() -> None:
    notch, model = contour("circular"), Model(planar=True)
    made = model.notch((0, 0), None, (0.02, 0), "neck", contour=notch, independent=True)
    model.fix((0, 0))
    model.body([made.q, (0.03, 0)], name="stage")
    assert counts(model) == (0, 0)
    found = flexact.elastic(model).undeformed().compliance(made.q.position)
    shift = np.eye(3)
    shift[1, 2] = -0.01
    found = shift @ found @ shift.T
    assert np.diag(found) == pytest.approx(notch.compliance[[0, 1, 5]], rel=1e-8)


def test_its_halves_are_not_divided_and_its_bodies_keep_their_names() -> None:
    model = Model()
    made = model.notch(
        (0, 0, 0), "z", (0.02, 0, 0), "neck", contour="circular", **SIZES["circular"]
    )
    model.fix((0, 0, 0))
    model.body([made.q, (0.03, 0, 0)], name="stage")
    assert [each.elements for each in flexact.elastic(model, beams=8).solvers] == [4]
    parts = {part.name for part in analyse(model).parts.all}
    assert parts == {"neck", "neck, half 1", "stage"}
    assert made.name == "neck"
    model.rename(made, "hinge")
    assert {part.name for part in analyse(model).parts.all} == {"hinge", "hinge, half 1", "stage"}
    model.independent(made)
    assert counts(model) == (0, 0)
    model.hold(made)
    assert analyse(model).under_constrained == 0
    model.delete(made)
    assert model.element_names == ("stage",)


def test_its_neck_is_known_to_the_deck() -> None:
    """Section and radius of the neck stand with its hinge, where its stress is."""
    model = Model(units="mm")
    sizes = {"thickness": 0.3, "breadth": 10, "radius": "4 mm", "material": "spring steel"}
    made = model.notch((0, 0, 0), "z", (20, 0, 0), "neck", contour="circular", **sizes)
    model.fix((0, 0, 0))
    model.body([made.q, (30, 0, 0)], name="stage")
    model.independent(made)
    back = flexact.read_text(model.to_deck())
    assert back.to_deck() == model.to_deck()
    hinge = back.element_keywords.index("HINGE")
    properties = back.data.properties
    assert properties is not None
    assert properties.fillet[hinge, 0] == 4e-3
    assert properties.strength[hinge].tolist() == [1200e6, 450e6]
    assert back.data.appearance.dimensions[hinge] == pytest.approx([3e-4, 1e-2])
    # Steel of the blank without the two half circles.
    mass = 7850 * 0.01 * (0.02 * 8.3e-3 - math.pi * 4e-3**2)
    assert properties.mass[0, 0] * 0.02 == pytest.approx(mass)


def test_words_follow_the_units() -> None:
    sizes = {"thickness": "0.3 mm", "breadth": "10 mm", "radius": "4 mm"}
    said = NotchContour(**sizes, units="mm").describe()
    assert "0.3 mm at the thinnest, 8 mm long, 4 mm radius, 8.3 mm high, 10 mm broad." in said
    assert "3696 N mm/rad" in said and "25.01 MPa at 1 mrad" in said
    assert "-3.34 %   Paros and Weisbord, simplified" in said
    assert NotchContour(**sizes) == NotchContour(thickness=3e-4, breadth=0.01, radius=4e-3)
    assert "0.0003 m at the thinnest" in NotchContour(**sizes).describe()


# Sheets as made --------------------------------------------------------------


def tip(model: Model, **how: Any) -> np.ndarray:
    """The compliance of the end of a sheet of 0.1 m along z whose width is along y."""
    model.sheet((0, 0, 0), (0, 0, 0.1), "y", name="sheet 1", material="steel", **how)
    model.fix((0, 0, 0))
    model.body([(0, 0, 0.1), (0, 0, 0.11)], name="stage")
    model.independent("stage", "x", "ry", "rz")
    assert counts(model) == (0, 0)
    assert {part.name for part in analyse(model).parts.all} == {"sheet 1", "stage"}
    return flexact.elastic(model, beams=1).undeformed().compliance("stage")


@pytest.mark.parametrize("beams", [1, 2])
def test_a_sheet_that_is_thick_in_the_middle(beams: int) -> None:
    """Three beams in series, by hand; the deck says the same."""
    model = Model()
    size = {"thickness": 2e-4, "breadth": 0.02, "reinforced": (0.6, "1 mm"), "beams": beams}
    found = tip(model, **size)
    ei, thick = E * 0.02 * 2e-4**3 / 12, E * 0.02 * 1e-3**3 / 12
    assert found[4, 4] == pytest.approx(0.04 / ei + 0.06 / thick, rel=1e-9)
    cubes = (0.1**3 - 0.08**3 + 0.02**3) / 3 / ei + (0.08**3 - 0.02**3) / 3 / thick
    assert found[0, 0] == pytest.approx(cubes, rel=1e-4)
    ea = E * 0.02
    assert found[2, 2] == pytest.approx(0.04 / (ea * 2e-4) + 0.06 / (ea * 1e-3), rel=1e-9)
    back = flexact.read_text(model.to_deck())
    assert counts(back) == (0, 0)
    # A body that is moved takes the pieces along in proportion.
    model.move((0, 0, 0.1), (0, 0, 0.2))
    places = np.unique(model.positions[:, 2].round(12))
    assert {0.04, 0.16} <= set(places.tolist())


def test_a_tapered_sheet() -> None:
    """By the closed integrals of 1/t and 1/t^3, and of 1/b and 1/(b t)."""
    size = {"thickness": 4e-4, "breadth": 0.02}
    found = tip(Model(), tapered="0.2 mm", **size)
    t, s, b = 4e-4, 2e-4, 0.02
    assert found[4, 4] == pytest.approx(12 * 0.1 * (t + s) / (2 * E * b * t**2 * s**2), rel=1e-9)
    assert found[2, 2] == pytest.approx(0.1 * math.log(t / s) / (E * b * (t - s)), rel=1e-9)
    bent = simpson(lambda x: 12 * (0.1 - x) ** 2 / (E * b * (t - 10 * (t - s) * x) ** 3), 0, 0.1)
    assert found[0, 0] == pytest.approx(bent, rel=3e-3)
    found = tip(Model(), tapered=(0.005, 4e-4), **size)
    assert found[4, 4] == pytest.approx(12 * 0.1 * math.log(4) / (E * 0.015 * t**3), rel=1e-9)
    found = tip(Model(), tapered=2e-4, beams=3, **size)
    assert found[4, 4] == pytest.approx(12 * 0.1 * (t + s) / (2 * E * b * t**2 * s**2), rel=1e-9)


def test_a_tapered_sheet_is_a_mesh_already() -> None:
    model = Model()
    tip(model, thickness=4e-4, breadth=0.02, tapered=2e-4)
    assert [each.elements for each in flexact.elastic(model).solvers] == [17, 33]


@pytest.mark.parametrize("how", [{"tapered": 2e-4}, {"reinforced": (0.6, 1e-3)}])
def test_what_is_made_of_several_sections_keeps_them(how: dict[str, Any]) -> None:
    model = Model()
    size = {"thickness": 4e-4, "breadth": 0.02, "material": "steel"}
    made = model.sheet((0, 0, 0), (0, 0, 0.1), "y", name="sheet 1", **size, **how)
    before = model.data.properties
    model.made_of(made, {"E": E / 2, "G": G / 2})
    after = model.data.properties
    assert before is not None and after is not None
    # ESTIFF but for the shear, which has no modulus.
    assert after.stiffness[:, :4] == pytest.approx(before.stiffness[:, :4] / 2)
    with pytest.raises(ModelError, match="several sections"):
        model.made_of(made, "steel", thickness=1e-3, breadth=0.02)


def test_fillets_are_at_the_ends() -> None:
    model, size = Model(units="mm"), {"thickness": 0.4, "breadth": 20, "fillet": 0.5}
    model.sheet((0, 0, 0), (0, 0, 100), "y", 3, "sheet 1", **size)
    model.wire((0, 0, 0), (0, 100, 0), name="wire 1", thickness=1, fillet="0.2 mm")
    model.sheet((0, 0, 0), (100, 0, 0), "y", 1, "sheet 2", reinforced=0.5, **size)
    model.folded_sheet((0, 0, 0), (0, 0, -50), (50, 0, -50), name="folded", **size)
    model.parallel_guide((0, 0, 200), (0, 0, 300), (100, 0, 0), "y", "guide", **size)
    model.cartwheel([(0, 1, 0), (9, 1, 0)], [(9, 1, 9), (0, 1, 9)], name="wheel", **size)
    properties = model.data.properties
    assert properties is not None
    given = dict(zip(model.element_names, (properties.fillet[:, 0] * 1e3).tolist(), strict=True))
    radii = {name: round(each, 9) for name, each in given.items() if each == each}
    assert radii.pop("wire 1") == 0.2 and set(radii.values()) == {0.5}
    assert {"sheet 1, 1", "sheet 1, 3", "sheet 2, leaf 1", "sheet 2, leaf 2"} <= set(radii)
    assert {"folded, leaf 1", "folded, leaf 2", "guide sheet 1", "wheel far sheet 2"} <= set(radii)
    assert not {"sheet 1, 2", "sheet 2, middle"} & set(radii)


NOTCH = {"contour": "circular", **SIZES["circular"]}
SHEET = {"thickness": 4e-4, "breadth": 0.02, "material": "steel"}


def _notch(model: Model, **more: Any) -> None:
    words = {"q": (0.02, 0, 0), "axis": "z", **NOTCH, **more}
    model.notch((0, 0, 0), **{k: v for k, v in words.items() if v is not None})


def _sheet(model: Model, **more: Any) -> None:
    model.sheet((0, 0, 0), (0, 0, 0.1), "y", **{**SHEET, **more})


REFUSED: dict[str, tuple[str, str, Callable[[Model], object]]] = {
    "contour": ("no-such-word", "circular or fillet", lambda m: _notch(m, contour="oval")),
    "no contour": ("surplus-size", "contour=", lambda m: _notch(m, contour=None, q=None)),
    "no end": ("missing-point", "give q", lambda m: _notch(m, q=None)),
    "too short": ("bad-size", "8 mm|0.008 m", lambda m: _notch(m, q=(0.007, 0, 0))),
    "along": ("parallel-vector", "across", lambda m: _notch(m, axis=(1, 0, 1))),
    "no axis": ("missing-vector", "axis", lambda m: _notch(m, axis=None)),
    "twice": ("given-twice", "stiffness", lambda m: _notch(m, stiffness=3.0)),
    "narrow": ("bad-size", "narrower", lambda m: _notch(m, breadth=2e-4)),
    "no radius": ("missing-section", "needs its radius", lambda m: _notch(m, radius=None)),
    "length": ("surplus-size", "takes no length", lambda m: _notch(m, length=3e-3)),
    "flat": ("bad-size", "height", lambda m: _notch(m, height=2e-4)),
    "negative": ("bad-size", "not positive", lambda m: _notch(m, thickness=-1e-3)),
    "fillets": ("bad-size", "fillets alone", lambda m: _notch(m, contour="fillet", length=2e-3)),
    "given": ("given-twice", "sizes already", lambda m: _notch(m, contour=contour("fillet"))),
    "thin middle": ("bad-size", "thicker", lambda m: _sheet(m, reinforced=(0.5, 2e-4))),
    "share": ("out-of-range", "share", lambda m: _sheet(m, reinforced=(1.5, 2e-3))),
    "three": ("bad-number", "share", lambda m: _sheet(m, reinforced=(0.5, 2e-3, 1))),
    "both": (
        *("surplus-size", "one of them"),
        lambda m: _sheet(m, reinforced=(0.5, 2e-3), tapered=2e-4),
    ),
    "rigid taper": ("surplus-size", "one of them", lambda m: _sheet(m, reinforced=0.5, tapered=1)),
    "warping": ("surplus-size", "one of them", lambda m: _sheet(m, tapered=2e-4, warping=True)),
    "no section": (
        *("missing-section", "has a section"),
        lambda m: m.sheet((0, 0, 0), (0, 0, 1), "y", tapered=2e-4),
    ),
    "to nothing": ("bad-size", "taper", lambda m: _sheet(m, tapered=0.0)),
    "fillet": ("bad-size", "fillet", lambda m: _sheet(m, fillet=0.0)),
    "folds": (
        *("surplus-size", "tapered is"),
        lambda m: m.folded_hinge(0.1, thickness=1e-3, breadth=0.01, tapered=2e-4),
    ),
}


@pytest.mark.parametrize("what", REFUSED)
def test_what_makes_no_sense_is_refused_in_words(what: str) -> None:
    code, words, make = REFUSED[what]
    with pytest.raises(ModelError, match=words) as caught:
        make(Model())
    assert code_of(caught) == code


@pytest.mark.parametrize("planar", [False, True])
def test_a_linkage_has_the_verdict_of_its_hinges(planar: bool) -> None:
    """A parallelogram of four hinges: one motion; in space three things twice, by Gruebler."""
    found = []
    for sizes in ({}, NOTCH):
        model = Model(planar=planar)
        ends = []
        for x in (0.0, 0.1):
            points: list[flexact.Node] = []
            for y in (0.0, 0.1):
                if sizes:
                    made = model.notch(
                        *((x, y - 0.01), None if planar else "z", (x, y + 0.01)), **sizes
                    )
                else:
                    made = model.notch(model.node(x, y), None if planar else "z")
                points += [made.p, made.q]
            model.body(points[1:3])
            ends.append((points[0], points[3]))
        model.fix(*(each[0] for each in ends))
        model.body([each[1] for each in ends])
        found.append(counts(model))
    assert found[0] == found[1] == ((1, 0) if planar else (1, 3))


# How far it may go -----------------------------------------------------------


@pytest.mark.parametrize("name", ["circular", "fillet", "elliptic", "parabolic"])
def test_how_far_a_notch_may_turn(name: str) -> None:
    """Half of the fatigue strength is reached at an angle of 450 MPa/2 over the stress an angle."""
    notch = contour(name, material="spring steel")
    model = Model()
    made = model.notch((0, 0, 0), "z", (0.02, 0, 0), "neck", contour=notch)
    model.fix((0, 0, 0))
    model.body([made.q, (0.06, 0, 0)], name="stage")
    model.independent("stage", "rz")
    wanted = 225e6 / notch.stress_per_angle
    for each in (model, flexact.read_text(model.to_deck())):
        elastic = flexact.elastic(each)
        found = elastic.limits(made.q.position, "rz")
        assert (-found.low, found.high) == pytest.approx((wanted, wanted), rel=1e-4)
        assert found.part == "neck" and "225 MPa" in found.reason
        (turned,) = elastic.along(made.q.orientation, "rz", [wanted])
        assert turned.von_mises("neck") == pytest.approx(225e6, rel=1e-4)
    if name == "circular":
        # Paros and Weisbord, simplified, as above.
        slender = notch.stress_factor * 4 / (3 * math.pi) * 206e9 * math.sqrt(0.3 / 4)
        assert wanted == pytest.approx(225e6 / slender, rel=0.01)


def test_a_notch_that_is_pulled() -> None:
    notch, model = contour("circular", material="spring steel"), Model()
    made = model.notch((0, 0, 0), "z", (0.02, 0, 0), "neck", contour=notch)
    model.fix((0, 0, 0))
    model.force(made.q, 100.0, 0.0, 0.0)
    state = flexact.elastic(model).equilibrium()
    assert state.peak_stress("neck") == pytest.approx(100.0 / (3e-4 * 1e-2), rel=1e-6)
    assert state.von_mises("neck") == pytest.approx(
        notch.stress_factor * 100.0 / (3e-4 * 1e-2), rel=1e-6
    )
    with pytest.raises(flexact.ElasticError, match="section"):
        state.von_mises("neck, half 1")
