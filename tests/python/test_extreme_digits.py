# SPDX-License-Identifier: BSD-3-Clause
"""Geometry typed with 3, 4 or 6 digits: right, or `nearly` with the counts that were meant.

The counts meant are those of tests/reference/known_answers.md, in the geometry with all its
digits.
"""

import math

import numpy as np
import pytest
from known_models import ring
from reference_decks import transform
from verdicts import METHODS, Counts, assert_right_or_nearly, counts

from flexact import Certainty, Model, analyse

FORMS = ["%.3f", "%.4f", "%.6f"]
TURNS = [transform.about("z", angle) for angle in (0.0, 0.3, 1.1, 2.7)] + [
    transform.about("x", angle) @ transform.about("y", 2 * angle) for angle in (0.4, 0.9, 2.2)
]

#: Places of joints (k, 3), and the bars between them.
Shape = tuple[np.ndarray, list[tuple[int, int]]]


def typed(form: str, values: np.ndarray) -> tuple[float, ...]:
    return tuple(float(form % value) for value in values)


def bars(form: str, turn: np.ndarray, shape: Shape, fixed: int) -> Model:
    """A framework of bars, turned and typed; its first joints are fixed."""
    model = Model()
    joints = [model.node(*typed(form, turn @ place)) for place in shape[0]]
    for i, j in shape[1]:
        model.truss(joints[i], joints[j])
    for joint in joints[:fixed]:
        model.fix(joint)
    return model


def polygon(corners: int, radius: float, height: float, first: float) -> list[list[float]]:
    angles = [first + 2 * math.pi * k / corners for k in range(corners)]
    return [[radius * math.cos(angle), radius * math.sin(angle), height] for angle in angles]


def prism(twist: float) -> Shape:
    """Three struts and nine cables, free in space (6 rigid motions)."""
    places = np.array(polygon(3, 1.0, 0.0, 0.0) + polygon(3, 1.0, 1.0, math.radians(twist)))
    pairs = [(k, (k + 1) % 3) for k in range(3)] + [(3 + k, 3 + (k + 1) % 3) for k in range(3)]
    pairs += [(k, 3 + k) for k in range(3)] + [(k, 3 + (k + 1) % 3) for k in range(3)]
    return places, pairs


def platform(yaw: float) -> Shape:
    """An octahedron: a triangle of bars on six legs, base radius 1, platform 0.6, height 1."""
    top = polygon(3, 0.6, 1.0, math.radians(60.0 + yaw))
    places = np.array(polygon(3, 1.0, 0.0, 0.0) + top)
    pairs = [(3 + k, 3 + (k + 1) % 3) for k in range(3)]
    pairs += [(k, 3 + k) for k in range(3)] + [((k + 1) % 3, 3 + k) for k in range(3)]
    return places, pairs


def ring_bars(corners: int) -> Shape:
    model = ring(corners)
    pairs = [(p - 1, q - 1) for p, _, q, _ in model.element_nodes.tolist()]
    return model.positions, pairs


# Over-constraint of the prism: the triangle between fixed joints, and its prestress.
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(
    ("shape", "fixed", "truth"),
    [
        (ring_bars(4), 4, (1, 1)),
        (ring_bars(6), 6, (1, 1)),
        (prism(30.0), 3, (1, 4)),
        (platform(90.0), 3, (1, 1)),
    ],
    ids=["ring of 4", "ring of 6", "prism", "platform"],
)
def test_frameworks(form: str, shape: Shape, fixed: int, truth: Counts) -> None:
    """Tarnai's rings, the tensegrity prism, and the octahedral platform turned by a quarter."""
    for turn in TURNS:
        model = bars(form, turn, shape, fixed)
        for method in METHODS:
            assert_right_or_nearly(analyse(model, method=method), truth)


@pytest.mark.parametrize("form", FORMS)
def test_octahedral_platform_off_the_quarter_is_rigid(form: str) -> None:
    """By more than the digits can account for: sigma_min/sigma_1 is 0.06 at 80 degrees."""
    for turn in TURNS:
        for yaw in (0.0, 80.0):
            analysis = analyse(bars(form, turn, platform(yaw), 3))
            assert counts(analysis) == (0, 0)
            assert analysis.certainty is Certainty.CERTAIN


def folded_sheets(form: str, turn: np.ndarray, angle: float, clamped: bool) -> Model:
    """A folded sheet with its y vectors typed too."""
    model = Model()
    bend = math.radians(angle)
    places = [(0, 0, 0), (1, 0, 0), (1 + math.cos(bend), math.sin(bend), 0)]
    a, b, c = (model.node(*typed(form, turn @ place)) for place in np.array(places))
    width = typed(form, turn @ [0.0, 0.0, 1.0])
    model.sheet(a, b, width)
    model.sheet(b, c, width)
    model.fix(a)
    if clamped:
        model.fix(c)
    return model


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("angle", [60.0, 90.0, 127.0])
def test_folded_sheets(form: str, angle: float) -> None:
    """One motion and one self-stress clamped, whatever the angle of the fold."""
    for turn in TURNS:
        for method in METHODS:
            clamped = analyse(folded_sheets(form, turn, angle, True), method=method)
            assert_right_or_nearly(clamped, (1, 1))
            free = analyse(folded_sheets(form, turn, angle, False), method=method)
            assert_right_or_nearly(free, (6, 0))


@pytest.mark.parametrize("form", FORMS)
def test_guides(form: str) -> None:
    """Parallel sheets are parallel as far as they are typed."""
    for turn in TURNS:
        model = Model()
        places = [(0, 0, 0), (0.7, 0, 0), (0, 0.3, 0), (0.7, 0.3, 0)]
        a, b, c, d = (model.node(*typed(form, turn @ place)) for place in np.array(places))
        width = typed(form, turn @ [0.0, 0.0, 1.0])
        model.sheet(a, b, width)
        model.sheet(c, d, width)
        model.rigid(b, d)
        model.fix(a)
        model.fix(c)
        for method in METHODS:
            assert_right_or_nearly(analyse(model, method=method), (1, 1))
