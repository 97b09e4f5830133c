# SPDX-License-Identifier: BSD-3-Clause
"""What goes wrong easily in millimetres, and where a mechanism has many notches."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import flexact
from flexact.apps.cli.main import main

THICK, RADIUS, BREADTH, REACH, ROD = 0.6, 3.0, 10.0, 12.0, 48.0


def notched_guide(material: str = "Al 7075-T6") -> flexact.Model:
    """A stage on two rods with a notch at each end, in mm; the necks are 48 mm apart."""
    model = flexact.Model(units="mm")
    sizes: dict[str, Any] = {
        **{"contour": "circular", "thickness": THICK, "radius": RADIUS, "breadth": BREADTH},
        "material": material,
    }
    notches = [
        model.notch((x, 0, z), "y", (x, 0, z + REACH), f"n{k}", **sizes)
        for k, (x, z) in enumerate(((0, 0), (40, 0), (0, ROD), (40, ROD)), 1)
    ]
    for k in (0, 1):
        model.body([notches[k].q, notches[k + 2].p], name=f"rod {k + 1}")
    model.body([notches[2].q, notches[3].q], name="stage", mass=0.2)
    model.fix(notches[0].p, notches[1].p)
    model.independent("stage", "x")
    return model


def sheet_guide(units: str = "mm") -> flexact.Model:
    """A stage on two sheets, 80 mm long."""
    size = 1.0 if units == "mm" else 1e-3
    model = flexact.Model(units=units)
    guide = model.parallel_guide(
        *((0, 0, 0), (0, 0, 80 * size), (40 * size, 0, 0), "y"),
        **{"thickness": 0.4 * size, "breadth": 30 * size, "material": "spring steel", "mass": 0.3},
    )
    model.fix(*guide.ground)
    model.independent("stage", "x")
    return model


def test_each_of_several_necks_has_the_stress_of_its_own_moment() -> None:
    """6 M/(b t^2) with M = k d/L, and the little pull of the circle that the stage goes on."""
    neck = flexact.NotchContour(
        "circular",
        thickness=THICK,
        radius=RADIUS,
        breadth=BREADTH,
        material="Al 7075-T6",
        units="mm",
    )
    (state,) = flexact.elastic(notched_guide()).along("stage", "x", [0.2])
    bending = neck.stress_per_moment / neck.stress_factor / neck.compliance[5] * 0.2 / ROD
    for name in ("n1", "n2", "n3", "n4"):
        assert state.peak_stress(name) == pytest.approx(bending * 1e-6, rel=1e-2)
        assert state.von_mises(name) >= state.peak_stress(name)


def test_a_guide_on_notches_neither_buckles_nor_gets_faster_by_a_small_stroke() -> None:
    """The stiffness that keeps the halves straight says nothing of their section.

    With the polar radius of E I/(E A), about a metre, the pull of half a newton twisted them.
    """
    guide = flexact.elastic(notched_guide())
    rest, (away,) = guide.undeformed(), guide.along("stage", "x", [0.2])
    assert away.is_stable
    assert away.frequencies[:4] == pytest.approx(rest.frequencies[:4], rel=0.02)
    assert not guide.limits("stage", "x").of("stability")


@pytest.mark.parametrize("units", ["m", "mm"])
def test_a_notch_that_is_released_has_a_stiffness_of_its_own_kind(units: str) -> None:
    """One that bends has N mm/rad, one that is stretched N/mm; numbers are of the model."""
    model = sheet_guide(units)
    typed = 3500.0 if units == "mm" else 3.5
    texts = [flexact.elastic(model, release={(1, 3): given}) for given in ("3.5 N m/rad", typed)]
    assert texts[0].release == texts[1].release == {(1, 3): pytest.approx(3.5)}
    stretched = flexact.elastic(model, release={(1, 1): "5 N/mm"})
    assert stretched.release == {(1, 1): pytest.approx(5000.0)}
    assert repr(stretched).endswith("1:1 with 5 N/mm>" if units == "mm" else "1:1 with 5000 N/m>")
    for pair, given in (((1, 3), "5 N/mm"), ((1, 1), "3.5 N m/rad")):
        with pytest.raises(flexact.FlexactError, match=r"a stiffness.* is wanted, such as"):
            flexact.elastic(model, release={pair: given})
        with pytest.raises(flexact.FlexactError, match=r"a stiffness.* is wanted, such as"):
            flexact.cost(model, release=[{pair: given}], beams=1)


def test_the_command_transfer_takes_notches_in_the_units_of_the_deck(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As a text and as a number, of both kinds of decks."""
    gains = []
    for units, given in (("m", "3.5"), ("mm", "3500"), ("mm", "3.5Nm/rad"), ("m", "3500Nmm/rad")):
        deck = tmp_path / f"{units}.dat"
        deck.write_text(sheet_guide(units).to_deck())
        wanted = ["--from", "stage:y", "--to", "stage:y", "--modes", "3", "--beams", "2", "--json"]
        assert main(["transfer", str(deck), *wanted, "--release", f"1:3={given}"]) == 0
        found = json.loads(capsys.readouterr().out)
        gains.append(found["D"][0][0] * (1e-3 if units == "mm" else 1.0))
    assert gains == pytest.approx(gains[:1] * 4)


def test_free_fall_is_in_the_plane_of_a_planar_model(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """And has three components in space."""
    model = flexact.Model(planar=True, units="mm")
    model.sheet((0, 0), (0, 60), name="blade", thickness=0.3, breadth=20, material="spring steel")
    model.fix((0, 0))
    flat, solid = tmp_path / "flat.dat", tmp_path / "solid.dat"
    flat.write_text(model.to_deck())
    solid.write_text(sheet_guide().to_deck())
    for deck, given, said in (
        (flat, "-z", "the model is planar: write --gravity=-y"),
        (flat, "0,0,-9810", "the model is planar: write --gravity=-y"),
        (solid, "0,-9810", "the model is spatial: write --gravity=-z"),
    ):
        assert main(["analyse", str(deck), f"--gravity={given}"]) == 1
        assert said in capsys.readouterr().err
    told = []
    for given in ("-y", "0,-9806.65", "0,-9.80665m/s2,0"):
        assert main(["analyse", str(flat), f"--gravity={given}"]) == 0
        told.append(capsys.readouterr().out)
    assert "Under its weight" in told[0]
    assert told[1:] == told[:1] * 2


def test_what_is_larger_than_the_model_is_said_in_its_units() -> None:
    """Not 1 m beside 0.0894 m."""
    with pytest.raises(
        flexact.FlexactError, match=r"is 1000 mm, larger than the whole model, 89\.4 mm"
    ):
        flexact.cost(sheet_guide(), misalign=[(1, "x", 1000)], beams=1)


@pytest.mark.parametrize(
    ("statement", "code", "said"),
    [
        ("GRAVITY 0 0 -9.81", "unlikely-gravity", "9.81 is a usual number in m/s2"),
        ("STRENGTH 1 450 1200", "unlikely-strength", "a fatigue strength above the strength"),
        ("STRENGTH 1 1e-3", "unlikely-strength", "a strength of 0.001 MPa"),
        ("STRENGTH 1 0", "unlikely-strength", "a strength of 0 MPa"),
        ("EXPANSION 1 12", "unlikely-expansion", "for 12 um/m/K write 12e-6"),
        ("EM 1 0.0942", "unlikely-density", "as of an EM in kg/m"),
    ],
)
def test_slips_of_new_statements_are_warned_of(statement: str, code: str, said: str) -> None:
    """What is hardly meant has a warning that names the likely slip."""
    deck = sheet_guide().to_deck()
    assert not flexact.read_text(deck).diagnostics
    word = " ".join(statement.split()[:2]) if "GRAVITY" not in statement else "GRAVITY"
    kept = [line for line in deck.splitlines() if not line.startswith(word)]
    kept.insert(kept.index("HALT") + 1, statement)
    found = flexact.read_text("\n".join(kept)).diagnostics
    assert [each.code for each in found] == [code]
    assert said in f"{found[0].message} {found[0].help}"


@pytest.mark.parametrize("strength", ["0", "-5", ""])
def test_a_part_without_a_strength_above_zero_has_none(strength: str) -> None:
    """It is not left out of what is asked: nobody knows how far it may go."""
    deck = sheet_guide().to_deck()
    lines = [line for line in deck.splitlines() if not line.startswith("STRENGTH 1")]
    if strength:
        lines.insert(lines.index("HALT") + 1, f"STRENGTH 1 {strength}")
    with pytest.raises(flexact.ElasticError, match="sheet 1 has no strength"):
        flexact.elastic(flexact.read_text("\n".join(lines)), beams=2).limits("stage", "x")


def test_without_masses_there_is_no_weight() -> None:
    """Loads alone are told of then."""
    model = sheet_guide()
    model.force("stage", 1.0, 0.0, 0.0)
    model.gravity(0, 0, "-9.81 m/s2")
    assert "Under its weight and its loads" in flexact.analyse(model).describe()
    deck = "\n".join(x for x in model.to_deck().splitlines() if x[:3] not in ("EM ", "XM "))
    assert "Under its loads" in flexact.analyse(flexact.read_text(deck)).describe()
