# SPDX-License-Identifier: BSD-3-Clause
"""Stages held by wires and sheets as textbooks draw them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from flexact import Model

Vector = Sequence[float]
#: A point on the stage and the direction of the wire that ends there.
Wire = tuple[Vector, Vector]


def on_wires(wires: Sequence[Wire], *, scale: float = 1.0, turn: np.ndarray | None = None) -> Model:
    """A stage from (0, 0, 0.05) m to where wires of 0.1 m end; these are "wire 1", "wire 2", ..."""
    turn = np.eye(3) if turn is None else turn
    model = Model(name="stage on wires")
    places = [turn @ (scale * np.array(point, float)) for point, _ in wires]
    ends = [model.node(*place) for place in places]
    model.body([turn @ np.array((0.0, 0.0, 0.05 * scale)), *dict.fromkeys(ends)], name="stage")
    for k, (end, place, (_, way)) in enumerate(zip(ends, places, wires, strict=True), start=1):
        unit = turn @ (np.array(way, float) / np.linalg.norm(way))
        ground = model.node(*(place + 0.1 * scale * unit))
        model.wire(ground, end, name=f"wire {k}")
        model.fix(ground)
    return model


X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)

#: By name, from the literature (`test_advice_spaces`).
WIRES: dict[str, list[Wire]] = {
    "one wire": [((0.05, 0, 0), X)],
    "two parallel wires": [((0.05, 0.02, 0), X), ((0.05, -0.02, 0), X)],
    "two wires that meet": [((0.05, 0, 0), (-1, 1, 0)), ((-0.05, 0, 0), (1, 1, 0))],
    "two skew wires": [((0.05, 0, 0.02), X), ((0, 0.05, -0.02), Y)],
    "three wires in a plane": [
        ((0.04, 0, 0.02), Y),
        ((-0.02, 0.03, 0.02), (-2, -1, 0)),
        ((-0.02, -0.03, 0.02), (1, -2, 0)),
    ],
    "three parallel wires": [((0.04, 0, 0), Z), ((-0.02, 0.03, 0), Z), ((-0.02, -0.03, 0), Z)],
    "three parallel wires in a plane": [((0.05, k * 0.02, 0), X) for k in (-1, 0, 1)],
    "three wires through a point": [
        ((0.04, 0, 0), (-0.04, 0, 0.1)),
        ((-0.02, 0.03, 0), (0.02, -0.03, 0.1)),
        ((-0.02, -0.03, 0), (0.02, 0.03, 0.1)),
    ],
    "three skew wires": [((0.04, 0, 0), Y), ((0, 0.04, 0.02), Z), ((0.01, -0.02, 0.05), X)],
    "three wires to a point and one": [
        ((0.04, 0, 0), (-0.04, 0, 0.1)),
        ((-0.02, 0.03, 0), (0.02, -0.03, 0.1)),
        ((-0.02, -0.03, 0), (0.02, 0.03, 0.1)),
        ((0.05, 0.01, 0), X),
    ],
    "three wires in a plane and one": [
        ((0.04, 0, 0.02), Y),
        ((-0.02, 0.03, 0.02), (-2, -1, 0)),
        ((-0.02, -0.03, 0.02), (1, -2, 0)),
        ((0.05, 0.0, -0.02), X),
    ],
    "wires to two points": [
        ((0.04, 0, 0), (-0.04, 0, 0.1)),
        ((-0.02, 0.03, 0), (0.02, -0.03, 0.1)),
        ((-0.02, -0.03, 0), (0.02, 0.03, 0.1)),
        ((0.03, 0.02, -0.03), (-0.03, -0.02, -0.05)),
        ((-0.03, 0.01, -0.03), (0.03, -0.01, -0.05)),
    ],
    "guide": [
        ((0.04, 0.03, 0.02), X),
        ((0.04, -0.03, 0.02), X),
        ((0, 0.04, 0.02), Y),
        ((0.04, 0, -0.02), X),
        ((0, 0.04, -0.02), Y),
    ],
    "guide with lower two parallel": [
        ((0.04, 0.03, 0.02), X),
        ((0.04, -0.03, 0.02), X),
        ((0, 0.04, 0.02), Y),
        ((0.04, 0.03, -0.02), X),
        ((0.04, -0.03, -0.02), X),
    ],
    "six wires": [
        ((0.04, 0.03, 0.02), X),
        ((0.04, -0.03, 0.02), X),
        ((0, 0.04, 0.02), Y),
        ((0.04, 0, -0.02), X),
        ((0, 0.04, -0.02), Y),
        ((0, 0, 0.04), Z),
    ],
}


def on_sheets(sheets: Sequence[tuple[Vector, Vector, Vector]], beams: int = 1) -> Model:
    """A stage on sheets: where each is clamped, where it ends on the stage, and its width."""
    model = Model(name="stage on sheets")
    for k, (ground, end, width) in enumerate(sheets, start=1):
        model.sheet(ground, end, width, beams, f"sheet {k}")
        model.fix(ground)
    model.body([(0.0, 0.0, 0.2), *(end for _, end, _ in sheets)], name="stage")
    return model


SHEETS: dict[str, list[tuple[Vector, Vector, Vector]]] = {
    "one sheet": [((0.1, 0, 0.01), (0.2, 0, 0.01), Y)],
    "two parallel sheets": [((0, 0, 0), (0.1, 0, 0), Z), ((0, 0.05, 0), (0.1, 0.05, 0), Z)],
    "two crossed sheets": [
        ((-0.03, -0.04, 0), (0.03, 0.04, 0), Z),
        ((0.04, -0.03, 0.02), (-0.04, 0.03, 0.02), Z),
    ],
    "membrane": [
        ((0.1, 0, 0.01), (0.05, 0, 0.01), Y),
        ((-0.05, 0.0866, 0.01), (-0.025, 0.0433, 0.01), (0.0866, 0.05, 0)),
        ((-0.05, -0.0866, 0.01), (-0.025, -0.0433, 0.01), (0.0866, -0.05, 0)),
    ],
}


def on_folded_sheets(angles: Sequence[float], height: float = 0.03) -> Model:
    """A stage on folded sheets whose fold lines are tangents of a circle of 60 mm."""
    model = Model(name="stage on folded sheets")
    ends = []
    for degrees in angles:
        angle = np.radians(degrees)
        out = np.array([np.cos(angle), np.sin(angle), 0.0])
        along = np.array([-np.sin(angle), np.cos(angle), 0.0])
        fold = 0.06 * out + np.array([0.0, 0.0, height])
        ground, end = fold + np.array([0.0, 0.0, 0.06]), 0.02 * out + np.array([0, 0, height])
        name = f"flexure {degrees:g}"
        folded = model.node(*fold, name=f"fold {degrees:g}")
        model.sheet(ground, folded, along, name=f"{name}, ground to fold")
        model.sheet(folded, end, along, name=f"{name}, fold to stage")
        model.fix(ground)
        ends.append(end)
    model.body([(0.0, 0.0, 0.0), *ends], name="stage")
    return model
