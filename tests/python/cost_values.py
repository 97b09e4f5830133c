# SPDX-License-Identifier: BSD-3-Clause
"""Values of a cost for tests of pictures: made up after the paper's six folded sheets.

The stiffnesses and frequencies at rest, and the critical error of clamp 11, are those of an
independent program (tests/reference/stiffness_cases.json, P01 and P02); along the stroke and
against the error they follow plausible laws. No test takes them for truths.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from math import inf

import numpy as np
from reference_decks import ROOT

import flexact
from flexact.core.elements import NodeKind
from flexact.costs.designs import (
    FREQUENCY,
    Clamp,
    CostValues,
    Design,
    Kept,
    Misalignment,
    MisalignmentCurve,
    Number,
    Numbers,
    Point,
    Released,
    Stroke,
    StrokeCurve,
    Tolerance,
)
from flexact.costs.shape import Shape
from flexact.model.configuration import Configuration
from flexact.model.reading import read_file

DIRECTIONS = ("x", "y", "z", "rx", "ry", "rz")
DECK = ROOT / "input_decks" / "paper" / "six_folded_sheets.dat"
CLAMPS = tuple(
    Clamp(node, node + 1, f"clamp {node}", f"clamp {node}") for node in range(11, 71, 10)
)
#: Of the clamp that matters most: where it buckles [m], and by which power the frequency falls.
CRITICAL, POWER = 1.3268e-4, 2.76
SHIFT = -0.05
_STROKE = np.linspace(-2e-3, 2e-3, 21)
_STIFFNESS = {
    "as built": (3503052.3, 3503052.3, 3937.4163, 2.1e3, 2.1e3, 89602.9),
    "21:2": (3503052.3, 3503052.3, 3937.4163, 2.1e3, 2.1e3, 44801.45),
    "1:3": (703162.97, 3503052.3, 3937.4163, 1.6e3, 1.3e3, 44885.33),
}
_FREQUENCIES = {"as built": (9.9154, 402.74), "21:2": (9.9154, 402.74), "1:3": (9.9154, 184.43)}
_RELEASED = {
    "as built": (),
    "21:2": (Released(21, 2, 0.0, "the cylinder: twist"),),
    "1:3": (Released(1, 3, 0.0, "sheet 1: in-plane bending at its clamp"),),
}
_KEPT = {"21:2": (0.5, "about z"), "1:3": (0.2007, "along x")}


def numbers(values: object, part: float = 0.002) -> Numbers:
    value = np.asarray(values, float)
    return Numbers(value, part * np.abs(value))


def _tolerance(clamp: Clamp, direction: str, *, released: bool) -> Tolerance:
    """As built the odd clamps bear less; a release leaves no self-stress to first order."""
    if released:
        none = [Number(-inf), Number(inf)]
        return Tolerance(Misalignment(clamp, direction), *none, *none)
    size = {"x": 1.0, "y": 1.6, "z": 240.0, "rx": 30.0, "ry": inf, "rz": 9.0}[direction]
    size *= CRITICAL * (1.0 + 0.3 * CLAMPS.index(clamp))
    share = (1.0 - (1.0 + SHIFT) ** 2) ** (1.0 / POWER)
    made = [
        Number(sign * part * size, 0.002 * part * size if size < inf else 0.0)
        for part in (share, 1.0)
        for sign in (-1.0, 1.0)
    ]
    return Tolerance(Misalignment(clamp, direction), *made)


def _design(label: str) -> Design:
    first, second = _FREQUENCIES[label]
    fall = 1.0 / (1.0 + (_STROKE / 2.2e-3)[:, None] ** 2 * np.array([1, 1, 0.01, 0.4, 0.4, 0.2]))
    frequencies = np.column_stack([np.full(21, first), second * np.sqrt(fall[:, 0])])
    misalignment = Misalignment(CLAMPS[0], "x")
    error = CRITICAL * np.linspace(-1.0, 1.0, 41)
    falls = 1.0 - (np.abs(error) / CRITICAL) ** POWER if label == "as built" else np.ones(41)
    stable = (True,) * 21
    counts = (0,) * 21
    return Design(
        _RELEASED[label],
        ("4:3", "7:3") if label == "1:3" else (),
        0,
        int(label == "as built"),
        numbers(np.diag(1.0 / np.array(_STIFFNESS[label]))),
        Kept(numbers([_KEPT[label][0], 1.0]), np.eye(6)[0], _KEPT[label][1])
        if label in _KEPT
        else None,
        numbers([first, second]),
        (True, False),
        tuple(
            _tolerance(clamp, direction, released=label != "as built")
            for clamp in CLAMPS
            for direction in DIRECTIONS
        ),
        0.2,
        MisalignmentCurve(misalignment, error, numbers(first * np.sqrt(falls))),
        StrokeCurve(
            _STROKE,
            numbers(fall * np.array(_STIFFNESS[label])),
            numbers(fall[:, 0]),
            numbers(np.full(21, 3937.4)),
            numbers(3937.4 * _STROKE),
            numbers(frequencies),
            numbers(frequencies[:, 1:]),
            stable,
            counts,
            counts,
        ),
        shapes=_shapes(label == "as built"),
    )


@cache
def _shapes(buckles: bool) -> tuple[Shape, ...]:
    """Fields that look like shapes: the guided motion, and the cylinder turning about its axis."""
    analysis = flexact.analyse(DECK)
    guided = analysis.freedoms[0].motion
    data = analysis.data
    place = data.arrays.node_value.T
    start = Configuration(data.arrays.node_kind, place)
    turned = np.where(np.abs(guided.displacement).sum(1, keepdims=True) > 0, 1.0, 0.0)
    placed = data.arrays.node_kind[:, None] <= NodeKind.POSITION
    turning = np.where(placed, np.cross([0.0, 0.0, 1.0], place[:, :3]) * turned, 0.0)
    fields = [
        ("vibrating", "first frequency, 9.92 Hz", 9.92, guided.displacement + guided.rotation),
        ("vibrating", "first parasitic frequency, 403 Hz", 403.0, turning),
        ("buckled", "buckles at clamp 11 off by 0.133 mm along x", CRITICAL, turning),
    ]
    return tuple(
        Shape(kind, words, value, data, start, field)
        for kind, words, value, field in fields[: 3 if buckles else 2]
    )


def made_up_cost() -> CostValues:
    """Six folded sheets as built, with the cylinder's twist released, or a sheet's bending."""
    data = read_file(str(DECK))
    return CostValues(
        data,
        "six_folded_sheets.dat",
        tuple(_design(label) for label in _STIFFNESS),
        Point(1, 2, "the cylinder", "the driven point"),
        DIRECTIONS,
        CLAMPS,
        FREQUENCY,
        SHIFT,
        "elastic",
        "free",
        "auto",
        Stroke(1, "z", "the cylinder along z", 0.0, (-2e-3, 2e-3), (-2e-3, 2e-3)),
        (),
        (),
    )


def without_stroke(cost: CostValues) -> CostValues:
    """The same, had no stroke been asked for."""
    designs = tuple(replace(each, stroke=None) for each in cost.designs)
    return replace(cost, designs=designs, stroke=None)


def without_masses(cost: CostValues) -> CostValues:
    """The same of a deck that gives no masses."""
    designs = []
    for each in cost.designs:
        stroke = each.stroke and replace(each.stroke, frequencies=None, parasitic=None)
        curve = each.curve and replace(
            each.curve, measure=numbers(40.0 * each.curve.measure.value**2)
        )
        designs.append(replace(each, frequencies=None, is_drive=(), stroke=stroke, curve=curve))
    return replace(cost, designs=tuple(designs), measure="drive stiffness")
