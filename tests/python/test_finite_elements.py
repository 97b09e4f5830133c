# SPDX-License-Identifier: BSD-3-Clause
"""A parallel guide by beams against the same guide by bricks of CalculiX.

The values and why they differ stand in tests/reference/finite_elements; `make reference` computes
them anew. No package of finite elements is needed here.
"""

import json
from typing import Any

import numpy as np
import pytest
from reference_decks import REFERENCE
from stiffness_answers import guide

import flexact

CONTENT = json.loads((REFERENCE / "finite_elements" / "values.json").read_text(encoding="utf-8"))
MODEL, VALUES = CONTENT["model"], CONTENT["values"]
MIDDLE = (0.0, 0.0, MODEL["length"] / 2)


def sheet(width: float) -> tuple[str, str]:
    """Numbers of ESTIFF and EM of a sheet whose clamped ends do not warp."""
    e, nu, t, length = (MODEL[k] for k in ("modulus", "poisson", "thickness", "length"))
    g, area = e / 2 / (1 + nu), width * t
    n = np.arange(1, 99, 2)
    series = np.sum(np.tanh(n * np.pi * width / 2 / t) / n**5)
    saint_venant = width * t**3 / 3 * (1 - 192 / np.pi**5 * t / width * series)
    x = length / width * np.sqrt(6 / (1 + nu))
    torsion = g * saint_venant / (1 - np.tanh(x) / x)
    out, within = e * width * t**3 / 12, e * t * width**3 / 12
    shear = 10 * (1 + nu) / (12 + 11 * nu) * g * area
    rho = MODEL["density"]
    stiffness = [e * area, torsion, out, within, out / shear, within / shear]
    mass = [rho * area, rho * (out + within) / e, rho * out / e, rho * within / e, 0.0]
    return " ".join(map(repr, map(float, stiffness))), " ".join(map(repr, map(float, mass)))


def model(which: str, beams: int | str, **options: Any) -> Any:
    stiffness, mass = sheet(MODEL[which])
    total, (x, y, z) = MODEL["stage_mass"], MODEL["stage_mass_off"]
    inertia = [total * (y**2 + z**2), 0, 0, total * (x**2 + z**2), 0, total * (x**2 + y**2)]
    more = f"XM 9 {total}\nXM 10 " + " ".join(map(str, inertia))
    text = guide(1, stiffness=stiffness, mass=mass, more=more)
    return flexact.elastic(flexact.read_text(text), beams=beams, **options)


@pytest.mark.parametrize("kind", ["built", "released"])
def test_compliance_of_the_stage_as_by_bricks(kind: str) -> None:
    release = [(1, 5)] if kind == "released" else []
    found = np.diag(model("wide", 1, release=release).undeformed().compliance(9))
    # z, rx, ry: the same; x: shear of thin plates; y, rz: the clamped edge cannot bulge in shear
    limits = [2e-5, 7e-3, 1e-6, 1e-4, 1e-5, 7e-3]
    difference = np.abs(found / VALUES[f"compliance_{kind}"] - 1)
    assert np.all(difference < limits), difference


@pytest.mark.parametrize("kind", ["built", "released"])
def test_frequencies_as_by_bricks(kind: str) -> None:
    release = [(1, 5)] if kind == "released" else []
    found = np.array(model("wide", "auto", release=release).undeformed().frequencies[:4])
    difference = np.abs(found / VALUES[f"frequencies_{kind}"] - 1)
    # up to the bending of sheets 1e-3; turning about z (fourth as built) as its compliance, 4e-3
    assert np.all(difference < [2e-5, 1e-3, 1e-3, 5e-3]), difference


def test_support_stiffness_along_the_stroke_as_by_bricks() -> None:
    strokes = [0.025 + stroke for stroke in VALUES["strokes"]]
    states = model("wide", 8, drive="locked").along(9, "x", strokes)
    found = np.array([1 / state.compliance(9)[2, 2] for state in states])
    difference = np.abs(found / VALUES["support_stiffness"] - 1)
    assert np.all(difference < 4e-3), difference


def test_frequency_of_a_misaligned_guide_of_narrow_sheets_as_by_bricks() -> None:
    elastic = model("narrow", 8)
    found = np.array(
        [
            elastic.misaligned(1, "rx", turn, about=MIDDLE).frequencies[0]
            for turn in VALUES["narrow_turns"]
        ]
    )
    difference = np.abs(found / VALUES["narrow_frequencies"] - 1)
    assert np.all(difference < 2e-3), difference


def test_critical_turn_of_narrow_sheets_as_by_bricks() -> None:
    found = model("narrow", "auto").critical_misalignment(1, "rx", about=MIDDLE)[1]
    assert found == pytest.approx(VALUES["narrow_critical_turns"][0], rel=6e-3)


def test_wide_sheets_bear_more_than_beams_that_warp_freely() -> None:
    """What a beam without warping is wrong by, on the safe side: see the README of the values."""
    elastic = model("wide", 8)
    critical = elastic.critical_misalignment(1, "rx", about=MIDDLE)[1]
    assert 0.9 < critical / VALUES["wide_critical_turns"][0] < 1.0
    for turn, truth in zip(VALUES["wide_turns"][1:], VALUES["wide_frequencies"][1:], strict=True):
        found = elastic.misaligned(1, "rx", turn, about=MIDDLE).frequencies[0]
        rest = VALUES["wide_frequencies"][0]
        # half of the loss, as EIw beta'''' + GIt beta'' says for this mode
        assert found < truth
        assert 0.4 < (1 - (truth / rest) ** 2) / (1 - (found / rest) ** 2) < 0.6
