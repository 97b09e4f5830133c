# SPDX-License-Identifier: BSD-3-Clause
"""How far a stroke may go, against closed forms; and the stress of von Mises that it rests on."""

from __future__ import annotations

import csv
import io
import json
import math
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from json_schema import schema, strict
from stiffness_decks import cantilever, deck, elastic

import flexact
from flexact.apps.cli.main import main
from flexact.elasticity.stresses import edge_of
from flexact.model.notches import stress_factor

#: E and G [Pa], strength and that of fatigue: fatigue so low that strokes stay small.
YOUNG, SHEAR, STRENGTH, FATIGUE = 200e9, 80e9, 400e6, 20e6
STEEL = flexact.Material("", YOUNG, SHEAR, 7800.0, STRENGTH, FATIGUE)
LENGTH, BREADTH, THICK = 0.1, 0.02, 0.5e-3
SIZES: dict[str, Any] = {"thickness": THICK, "breadth": BREADTH, "material": STEEL}


def guide(units: str = "m", **changes: Any) -> flexact.Model:
    """Two sheets along y that guide a stage along x."""
    size = 1.0 if units == "m" else 1e3
    sizes = {**SIZES, "thickness": THICK * size, "breadth": BREADTH * size, **changes}
    model = flexact.Model(units=units)
    # At half of the height the drive tilts nothing.
    middle = model.node(0.03 * size, LENGTH * size / 2, 0, name="middle")
    model.parallel_guide(
        (0, 0, 0),
        (0, LENGTH * size, 0),
        (0.06 * size, 0, 0),
        "z",
        carries=[middle],
        mass=0.2,
        **sizes,
    )
    model.fix((0, 0, 0), (0.06 * size, 0, 0))
    model.independent("middle", "x")
    return model


# -- the stress of von Mises -------------------------------------------------------------------


def saint_venant(y: Any, z: Any, thick: float, wide: float) -> Any:
    """Shear of a unit torque anywhere in a rectangle, y across it from its middle.

    Timoshenko and Goodier, Theory of Elasticity, 3rd edition, art. 109: the derivatives of
    Prandtl's function, with 200 terms.
    """
    a = thick / 2.0
    n = np.arange(1.0, 400.0, 2.0)[:, None]
    k, sign = n * math.pi / (2.0 * a), (-1.0) ** ((n - 1.0) / 2.0)
    far = np.exp(k * (np.abs(z) - wide / 2.0)) / (1.0 + np.exp(-k * wide))
    cosh, sinh = (far * (1.0 + s * np.exp(-2.0 * k * np.abs(z))) for s in (1.0, -1.0))
    rows = np.tanh(n * math.pi * wide / (2.0 * thick)) / n**5
    torsion = wide * thick**3 / 3.0 * (1.0 - 192.0 / math.pi**5 * thick / wide * rows.sum())
    along = (sign / n**2 * (1.0 - cosh) * np.sin(k * y)).sum(axis=0)
    across = (sign / n**2 * sinh * np.cos(k * y)).sum(axis=0)
    return 16.0 * a / math.pi**2 * np.hypot(along, across) / torsion


@pytest.mark.parametrize(
    ("ratio", "alpha"),
    [
        *((1.0, 0.208), (1.5, 0.231), (2.0, 0.246), (3.0, 0.267), (4.0, 0.282), (6.0, 0.299)),
        *((10.0, 0.312), (1e4, 0.333)),
    ],
)
def test_the_largest_shear_of_torsion_is_that_of_the_table(ratio: float, alpha: float) -> None:
    """T/(alpha b t^2): Timoshenko and Goodier, table of art. 109, to its digits."""
    found = edge_of(np.array([ratio]))
    assert 1.0 / (found.shear.max() * ratio) == pytest.approx(alpha, abs=1e-3)


@pytest.mark.parametrize("ratio", [1.0, 1.3, 2.0, 5.0, 20.0, 100.0])
def test_nowhere_in_the_section_is_more_than_on_the_places_that_are_looked_at(ratio: float) -> None:
    """Against a fine grid of the whole section, of many combinations: 0.02 % at most."""
    edge = edge_of(np.array([ratio]))
    near = 1.0 - np.geomspace(1e-5, 1.0, 80)
    y = np.concatenate([near, [1.0]]) / 2.0
    z = ratio / 2.0 * np.linspace(0.0, 1.0, 101)
    z = np.concatenate([z, ratio / 2.0 - np.linspace(0.0, 1.0, 101) / 2.0])
    y, z = (each.ravel() for each in np.meshgrid(y, z))
    shear = saint_venant(y, z, 1.0, ratio)
    rng = np.random.default_rng(1)
    for _ in range(60):
        axial, flat, edgewise, twist = rng.choice([0.0, 1.0, rng.random(), 10 * rng.random()], 4)
        twist /= edge.shear.max()
        normal = axial + flat * y / 0.5 + edgewise * z / (ratio / 2.0)
        whole = np.sqrt(normal**2 + 3.0 * (twist * shear) ** 2).max()
        told = axial + flat * edge.across + edgewise * edge.along
        told = np.sqrt(told**2 + 3.0 * (twist * edge.shear) ** 2).max()
        assert whole <= told * 1.0002 + 1e-12


def test_von_mises_of_a_round_wire_with_a_moment_and_a_torque() -> None:
    """32/(pi d^3) sqrt(M^2 + 3/4 T^2), Shigley, eq. (5-15) with M and T; and N/A alone."""
    d, moment, torque, pull = 0.002, 3e-4, 4e-4, 40.0
    picture = f"\nVISUALIZATION\nBEAMPROPS 1\nCROSSTYPE CIRC\nCROSSDIM {d}\n"
    made = elastic(cantilever(f"XF 4 0 {moment} {torque}") + picture).equilibrium()
    wanted = 32 / (math.pi * d**3) * math.hypot(moment, math.sqrt(0.75) * torque)
    assert made.von_mises(1) == pytest.approx(wanted, rel=1e-5)
    pulled = elastic(cantilever(f"XF 3 0 0 {pull}") + picture).equilibrium()
    assert pulled.von_mises(1) == pytest.approx(4 * pull / (math.pi * d**2), rel=1e-9)


def test_von_mises_of_a_rectangle_under_torsion_and_pull() -> None:
    """sqrt(3) T/(alpha b t^2) with alpha 0.246 of b/t = 2, and with N/A beside: in the middle of
    the long side both are whole (Timoshenko and Goodier, art. 109)."""
    torque, pull = 0.02, 200.0
    picture = "\nVISUALIZATION\nBEAMPROPS 1\nCROSSTYPE RECT\nCROSSDIM 0.004 0.002\n"
    shear = torque / (0.24588 * 0.004 * 0.002**2)
    at = elastic(cantilever(f"XF 4 0 0 {torque}") + picture).equilibrium()
    assert at.von_mises(1) == pytest.approx(math.sqrt(3) * shear, rel=1e-4)
    assert at.peak_stress(1) < 0.01 * shear
    both = elastic(cantilever(f"XF 4 0 0 {torque}\nXF 3 0 0 {pull}") + picture).equilibrium()
    normal, shear = pull / (0.004 * 0.002), shear / torque * both.resultants(1).torque
    assert both.von_mises(1) == pytest.approx(math.hypot(normal, math.sqrt(3) * shear), rel=1e-3)


def test_a_fillet_counts_at_the_ends_of_a_part_alone() -> None:
    """A cantilever of two elements with a moment all along: the factor is that of one end."""
    radius = 0.2 * THICK
    made = {}
    for beams, fillet in ((1, ""), (1, "both"), (2, "both")):
        model = flexact.Model()
        model.sheet((0, 0, 0), (0, 0, LENGTH), "y", beams, "leaf", **SIZES)
        model.fix((0, 0, 0))
        text = model.to_deck()
        end = model.point((0, 0, LENGTH))
        loads = f"XF {end.orientation} 0 1e-4 0\n"
        loads += "".join(f"FILLET {k + 1} {radius}\n" for k in range(beams) if fillet)
        state = flexact.elastic(flexact.read_text(text.replace("ESTIFF", f"{loads}ESTIFF", 1)))
        made[beams, fillet] = [state.equilibrium().von_mises(k + 1) for k in range(beams)]
    (plain,), (whole,), halves = made.values()
    factor = float(stress_factor(np.array(THICK), np.array(radius)))
    assert plain == pytest.approx(6e-4 / (BREADTH * THICK**2), rel=1e-5)
    assert whole == pytest.approx(factor * plain, rel=1e-6)
    assert halves == pytest.approx([whole, whole], rel=1e-5)


# -- how far it may go -------------------------------------------------------------------------


def test_a_parallel_guide_of_sheets_that_bend_like_an_s() -> None:
    """sigma = 3 E t d/L^2 at both ends, S-shaped sheets (Soemers, Design Principles for Precision
    Mechanisms, 2011, leaf springs): half of the fatigue strength here."""
    found = flexact.elastic(guide()).limits("middle", "x")
    wanted = 0.5 * FATIGUE * LENGTH**2 / (3 * YOUNG * THICK)
    assert found.high == pytest.approx(wanted, rel=1e-3)
    assert found.low == pytest.approx(-wanted, rel=1e-3)
    assert found.reason == "half of the fatigue strength (10 MPa)"
    assert found.part in ("sheet 1", "sheet 2")
    assert found.nearest.place.startswith(f"in {found.part} at ")
    # The stress grows with the stroke, and ends at the strength itself.
    assert found.stress.max() == pytest.approx(STRENGTH, rel=1e-6)
    assert found.of("reach")[-1].reason == "the strength (400 MPa)"
    ends = np.interp([found.low, found.high], found.strokes, found.usage)
    assert ends == pytest.approx([0.5, 0.5], rel=1e-6)
    other = flexact.elastic(guide()).limits("middle", "x", share=0.05, against="strength")
    assert other.high == pytest.approx(2 * wanted, rel=2e-3)
    assert other.reason == "5 % of the strength (20 MPa)"


def test_millimetres_give_the_same_strokes_in_millimetres() -> None:
    one, other = (
        flexact.elastic(guide(units), beams=4).limits("middle", "x", support=0.5, drive="locked")
        for units in ("m", "mm")
    )
    assert other.unit == "mm"
    assert [other.low, other.high] == pytest.approx([1e3 * one.low, 1e3 * one.high], rel=1e-6)
    assert other.stress.max() == pytest.approx(1e-6 * one.stress.max(), rel=1e-6)
    turns = [name.startswith("r") for name in one.directions]
    scale = np.where(turns, 1e3, 1e-3)
    at_rest = [each.supports[each.strokes == 0.0][0] for each in (one, other)]
    assert at_rest[1] == pytest.approx(at_rest[0] * scale, rel=1e-6)
    assert [each.words for each in one.limits] == [each.words for each in other.limits]


def test_a_cross_hinge_bends_its_sheets_to_circles() -> None:
    """sigma = E t theta/(2 L) of sheets that cross in the middle and turn by a small angle:
    pure bending, but for theta/2 of it (J. A. Haringx, The cross-spring pivot as a constructional
    element, Applied Scientific Research A1, 1949)."""
    model = flexact.Model()
    a = LENGTH / math.sqrt(2.0) / 2.0
    model.cross_hinge(
        [(-a, -a, 0), (a, -a, 0.03)], [(a, a, 0), (-a, a, 0.03)], "z", name="pivot", **SIZES
    )
    model.fix((-a, -a, 0), (a, -a, 0.03))
    found = flexact.elastic(model).limits((a, a, 0), "rz", share=0.05)
    wanted = 0.05 * FATIGUE * 2 * LENGTH / (YOUNG * THICK)
    assert found.unit == "rad"
    assert found.high == pytest.approx(wanted, rel=3e-3)
    assert found.low == pytest.approx(-wanted, rel=3e-3)


def test_a_folded_sheet_at_its_free_end() -> None:
    """Two leaves at a right angle, pushed at the end across the second: F L is the moment all
    along the first, delta = F L^3/EI (1 + 1/3), so that sigma = 3/8 E t delta/L^2."""
    model = flexact.Model()
    places = (0, 0, 0), (LENGTH, 0, 0), (LENGTH, 0, -LENGTH)
    model.sheet(places[0], places[1], "y", name="first", **SIZES)
    model.sheet(places[1], places[2], "y", name="second", **SIZES)
    model.fix(places[0])
    found = flexact.elastic(model).limits(places[2], "x", share=0.2)
    wanted = 0.2 * FATIGUE * 8 * LENGTH**2 / (3 * YOUNG * THICK)
    # With the force itself along the first leaf, t/6L beside it.
    assert found.high == pytest.approx(wanted, rel=4e-3)
    assert found.part == "first"


def test_a_short_sheet_as_a_notch_between_a_lever_and_the_ground() -> None:
    """A cantilever of a short sheet with a rigid lever that is long: sigma = E t theta/(2 l)."""
    short, long = 0.004, 2.0
    model = flexact.Model()
    model.sheet((0, 0, 0), (short, 0, 0), "y", name="notch", **SIZES)
    model.rigid((short, 0, 0), (long, 0, 0))
    model.fix((0, 0, 0))
    found = flexact.elastic(model).limits((long, 0, 0), "z")
    theta = 0.5 * FATIGUE * 2 * short / (YOUNG * THICK)
    # The force at the lever's end bends the root more, by half of the notch in the lever.
    share = (long - short / 2.0) / (long - short / 2.0 + short / 2.0)
    assert found.high == pytest.approx(theta * share * (long - short / 2.0), rel=1e-3)


@pytest.mark.parametrize("planar", [False, True])
def test_a_notch_reaches_the_stress_of_its_contour(planar: bool) -> None:
    """A long lever on a circular notch: the angle times the peak stress of an angle of the
    contour, which `test_notches` holds against published formulas."""
    neck = flexact.NotchContour(
        "circular", thickness=0.5e-3, radius=2.5e-3, breadth=0.01, material=STEEL
    )
    model = flexact.Model(planar=planar)
    places = [(0, 0), (0.005, 0), (0.5, 0)] if planar else [(0, 0, 0), (0.005, 0, 0), (0.5, 0, 0)]
    model.notch(places[0], None if planar else "y", places[1], "neck", contour=neck)
    model.rigid(places[1], places[2])
    model.fix(places[0])
    found = flexact.elastic(model).limits(places[2], "y" if planar else "z")
    # From the middle of the notch; the force bends it by less than the length over the lever.
    assert found.high / 0.4975 == pytest.approx(0.5 * FATIGUE / neck.stress_per_angle, rel=1e-4)
    assert found.low == pytest.approx(-found.high, rel=1e-6)
    assert found.part == "neck"
    assert found.notes == ()


def test_a_fillet_of_a_sheet_shortens_the_stroke_by_its_factor() -> None:
    one, other = (
        flexact.elastic(guide(fillet=fillet), beams=8).limits("middle", "x")
        for fillet in (None, 0.2 * THICK)
    )
    factor = float(stress_factor(np.array(THICK), np.array(0.2 * THICK)))
    assert factor > 1.3
    assert other.high == pytest.approx(one.high / factor, rel=2e-3)


def column() -> Any:
    """A sheet along z, both ends of it clamped but for z of the upper one."""
    picture = f"VISUALIZATION\nBEAMPROPS 1\nCROSSTYPE RECT\nCROSSDIM {BREADTH} {THICK}\n"
    area, second = BREADTH * THICK, BREADTH * THICK**3 / 12
    text = deck(
        f"BEAM 1 1 2 3 4 0 1 0\nX 3 0 0 {LENGTH}\nFIX 1\nFIX 2\nFIX 4\nFIX 3 1 2",
        f"ESTIFF 1 {YOUNG * area} 0.05 {YOUNG * second} {YOUNG * BREADTH**3 * THICK / 12}\n"
        f"STRENGTH 1 {STRENGTH}",
    )
    return flexact.elastic(flexact.read_text(text + picture))


def test_a_column_buckles_at_the_stroke_of_euler() -> None:
    """4 pi^2 EI/L^2 of both ends clamped over EA/L: pi^2 t^2/3L. Pulled it does not."""
    found = column().limits(3, "z", drive="locked")
    (lost,) = found.of("stability")
    assert lost.stroke == pytest.approx(-(math.pi**2) * THICK**2 / (3 * LENGTH), rel=3e-3)
    assert "buckles" in lost.reason
    assert found.low == lost.stroke
    # Pulled it yields: sigma = E d/L.
    assert found.high == pytest.approx(0.5 * STRENGTH / YOUNG * LENGTH, rel=3e-3)
    assert found.of("strength")[-1].reason == "half of the strength (200 MPa)"


def test_supports_fall_as_states_along_the_stroke_say() -> None:
    """Each stroke of a support is where that part of its stiffness is left in `along`."""
    model = flexact.elastic(guide(), drive="locked", beams=8)
    found = model.limits("middle", "x", support=0.5)
    names = ("x", "y", "z", "rx", "ry", "rz")
    first = np.diag(model.undeformed().compliance("middle"))
    told = [each for each in found.of("support") if each.stroke > 0.0]
    assert {each.direction for each in told} <= set(found.directions)
    assert "x" not in found.directions
    assert len(told) >= 2
    for each in told:
        k = names.index(each.direction)
        (state,) = model.along("middle", "x", [each.stroke], from_rest=True)
        here = np.diag(state.compliance("middle"))
        assert first[k] / here[k] == pytest.approx(0.5, rel=1e-4)
    # With a free drive the guided motion itself makes the point compliant along y.
    free = model.limits("middle", "x", support=0.5, drive="free")
    along = [
        next(e.stroke for e in of.limits if e.direction == "y" and e.stroke > 0)
        for of in (free, found)
    ]
    assert along[0] < along[1]


def test_what_is_off_counts_from_the_start() -> None:
    """A clamp that is off enough has used the strength before anything moves."""
    model = flexact.elastic(guide(), beams=4)
    off = model.imperfect([((0, 0, 0), "y", "2 mm")])
    found = off.limits("middle", "x")
    assert found.low == found.high == 0.0
    assert "fatigue" in found.reason


def test_what_cannot_be_asked_is_refused_in_words() -> None:
    plain = flexact.Material("", YOUNG, SHEAR)
    weak = flexact.elastic(guide(material=plain), beams=2)
    words = r"sheet 1 and sheet 2 have no strength.*write STRENGTH \d"
    with pytest.raises(flexact.ElasticError, match=words):
        weak.limits("middle", "x")
    static = flexact.Material("", YOUNG, SHEAR, strength=STRENGTH)
    model = flexact.elastic(guide(material=static), beams=2)
    words = r"no fatigue strength.*STRENGTH \d strength fatigue"
    with pytest.raises(flexact.ElasticError, match=words):
        model.limits("middle", "x", against="fatigue")
    assert model.limits("middle", "x").reason == "half of the strength (200 MPa)"
    for wrong, words in (
        ({"share": 1.5}, "at most 1"),
        ({"share": 0}, "above 0"),
        ({"support": -0.5}, "above 0"),
        ({"against": "wear"}, "'strength' or 'fatigue'"),
        ({"drive": "loose"}, "'free' or 'locked'"),
    ):
        with pytest.raises(flexact.ElasticError, match=words):
            model.limits("middle", "x", **wrong)
    with pytest.raises(flexact.ElasticError, match="is fixed"):
        model.limits((0, 0, 0), "x")
    with pytest.raises(flexact.UnknownError, match="no coordinate"):
        model.limits("stage", "w")
    text = cantilever().replace("ESTIFF", "STRENGTH 1 1e8\nESTIFF")
    with pytest.raises(
        flexact.ElasticError, match="section of sheet 1 is not known: give BEAMPROPS"
    ):
        elastic(text).limits(3, "x")


def test_a_strength_below_that_of_fatigue_ends_the_path_all_the_same() -> None:
    odd = flexact.Material("", YOUNG, SHEAR, strength=0.4 * FATIGUE, fatigue=FATIGUE)
    found = flexact.elastic(guide(material=odd), beams=4).limits("middle", "x")
    assert found.of("strength") == ()
    assert found.reason == "the strength (8 MPa)"
    whole = flexact.elastic(guide(), beams=4).limits("middle", "x", share=1.0, against="strength")
    assert whole.reason == "the strength (400 MPa)"
    assert [each.criterion for each in whole.limits] == ["strength", "strength"]


# -- the cost ----------------------------------------------------------------------------------


def test_a_cost_says_how_far_it_may_go() -> None:
    model, off = guide(), [((0, 0, 0), "y", "20 um")]
    made = flexact.cost(
        model, strength=True, support=0.5, beams=4, stroke="middle:x=+-0.1mm", misalign=off
    )
    words = " ".join(made.describe().split())
    limits = made.as_built.limits
    assert limits is not None
    assert "half of the fatigue strength (10 MPa) at +-" in words
    assert "half the stiffness at +-" in words
    assert "(drive locked)" in words
    assert "safety" in words
    data = made.to_dict()
    closed = strict(schema("cost"))
    jsonschema.Draft202012Validator({**closed, "$ref": "#/$defs/cost"}).validate(data)
    assert data["strength"]["share"] == 0.5
    design = data["designs"][0]
    assert design["limits"]["high"] == limits.high
    assert design["effect"]["safety"]["value"][0] is None
    # The stress grows with the stroke, and safety is the strength over it.
    curve = design["stroke"]
    assert np.array(curve["safety"]["value"][-1]) * curve["stress"]["value"][-1] == pytest.approx(
        FATIGUE
    )
    table = made.to_csv()
    assert "stroke at the limit of strength" in table
    assert "part of the strength" in table
    plain = flexact.cost(model, beams=4, stroke="middle:x=+-0.1mm", misalign=off).to_dict()
    assert "strength" not in plain
    assert "limits" not in plain["designs"][0]
    assert not {"stress", "safety"} & plain["designs"][0]["stroke"].keys()
    assert not {"von_mises", "safety"} & plain["designs"][0]["effect"].keys()


def test_a_cost_in_millimetres_is_that_in_metres() -> None:
    """Given in mm, N mm/rad and told in them; the numbers on the designs are the same."""
    made = [
        flexact.cost(
            guide(units),
            strength=True,
            support=0.5,
            beams=2,
            stroke=("middle", "x", *(30 * size + np.array([-0.1, 0.1]) * size)),
            misalign=[((0, 0, 0), "y", 0.02 * size)],
            release=[{("sheet 1", 3): 3.5 * moment}],
        )
        for units, size, moment in (("m", 1e-3, 1.0), ("mm", 1.0, 1e3))
    ]
    one, other = made
    assert other.stroke is not None and one.stroke is not None
    assert other.stroke.asked == pytest.approx(one.stroke.asked)
    assert [d.label for d in one.designs] == [
        "as built",
        f"{one.designs[1].released[0].element}:3=3.5",
    ]
    assert other.designs[1].label.endswith("=3500")
    for first, second in zip(one.designs, other.designs, strict=True):
        assert first.limits is not None and second.limits is not None
        assert second.limits.high == pytest.approx(first.limits.high, rel=1e-6)
        assert second.compliance.value == pytest.approx(first.compliance.value, rel=1e-6)
    si, mm = (each.to_dict() for each in made)
    closed = strict(schema("cost"))
    jsonschema.Draft202012Validator({**closed, "$ref": "#/$defs/cost"}).validate(mm)
    assert (si["units"], mm["units"]) == ("m", "mm")
    a, b = (each["designs"][0] for each in (si, mm))
    scale = {"m": 1e3, "rad": 1.0}
    for x, y in zip(a["tolerances"], b["tolerances"], strict=True):
        assert y["unit"] == ("mm" if x["unit"] == "m" else "rad")
        if x["negative"]["value"] is not None:
            wanted = scale[x["unit"]] * x["negative"]["value"]
            assert y["negative"]["value"] == pytest.approx(wanted, rel=1e-6)
    assert b["limits"]["high"] == pytest.approx(1e3 * a["limits"]["high"], rel=1e-6)
    assert b["effect"]["von_mises"]["value"][1] == pytest.approx(
        1e-6 * a["effect"]["von_mises"]["value"][1], rel=1e-6
    )
    assert np.array(b["stroke"]["values"]) == pytest.approx(1e3 * np.array(a["stroke"]["values"]))
    assert b["stroke"]["stiffness"]["units"][:1] == ["N/mm"]
    assert b["effect"]["resultants"]["value"][1][2] == pytest.approx(
        1e3 * a["effect"]["resultants"]["value"][1][2], rel=1e-6
    )
    rows = list(csv.DictReader(io.StringIO(other.to_csv())))
    assert {row["unit"] for row in rows} <= {
        *("", "1", "Hz", "rad", "mm", "mm/N", "mm/(N mm)", "rad/N", "rad/(N mm)", "N/mm"),
        *("N mm/rad", "N", "N mm", "MPa"),
    }
    assert "N mm" in other.describe()


def test_the_safety_of_a_tolerance_is_that_of_a_small_part_of_the_error() -> None:
    """Stress in proportion to the error: against the whole path at a hundredth of it."""
    model = guide()
    made = flexact.cost(model, strength=True, beams=4, release=())
    tightest = made.tightest
    assert tightest is not None
    where = tightest.misalignment
    small = 0.01 * tightest.tightest.value
    state = flexact.elastic(model, beams=4).misaligned(where.clamp.node, where.direction, small)
    stress = max(state.von_mises(f"sheet {k}") for k in (1, 2))
    safety = made.as_built.safety(tightest)
    assert safety is not None
    assert safety.value == pytest.approx(FATIGUE / stress * 0.01, rel=1e-2)


def test_the_command_says_it_and_refuses_what_it_cannot(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "guide.dat"
    path.write_text(guide().to_deck(), encoding="utf-8")
    asked = [
        "cost",
        str(path),
        "--strength",
        "--support",
        "50%",
        "--beams",
        "2",
        "--release",
        "none",
    ]
    assert main(asked) == 0
    assert "half of the fatigue strength (10 MPa) at +-" in capsys.readouterr().out
    assert main([*asked, "--share", "20%", "--against", "strength", "--json"]) == 0
    made = json.loads(capsys.readouterr().out)
    reasons = [each["reason"] for each in made["designs"][0]["limits"]["limits"]]
    assert "20 % of the strength (80 MPa)" in reasons
    assert "along y half the stiffness" in reasons
    for more, words in (
        (["--share", "2"], "at most 1"),
        (["--share", "much"], "share"),
    ):
        assert main([*asked, *more]) != 0
        assert words in capsys.readouterr().err
    assert main(["cost", str(path), "--support", "0.5"]) != 0
    assert "--strength" in capsys.readouterr().err
    undeclared = tmp_path / "undeclared.dat"
    lines = guide().to_deck().splitlines()
    undeclared.write_text("\n".join(x for x in lines if not x.startswith("DYNX")), encoding="utf-8")
    assert main(["cost", str(undeclared), "--strength", "--beams", "2"]) != 0
    assert "--stroke 1:x=" in capsys.readouterr().err
    weak = tmp_path / "weak.dat"
    weak.write_text("\n".join(x for x in lines if not x.startswith("STRENGTH")), encoding="utf-8")
    assert main(["cost", str(weak), "--strength", "--beams", "2"]) != 0
    assert "write STRENGTH" in capsys.readouterr().err
