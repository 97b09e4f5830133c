# SPDX-License-Identifier: BSD-3-Clause
"""Mechanisms of named parts that are placed, turned, scaled and numbered at will."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from flexact import Model, Node

EX, EY, EZ = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def turn_about(axis: Sequence[float], angle: float) -> np.ndarray:
    """(3, 3) rotation by Rodrigues's formula."""
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    made: np.ndarray = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    return made


class Place(NamedTuple):
    """Where a mechanism stands, how large it is, and how it is given."""

    scale: float = 1.0
    turn: np.ndarray = np.eye(3)
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    reverse: bool = False
    """Whether points are numbered in the other order."""
    other_sense: bool = False
    """Whether every width points the other way."""
    swapped: bool = False
    """Whether ends p and q are exchanged."""

    def point(self, place: Sequence[float]) -> np.ndarray:
        made: np.ndarray = self.turn @ (self.scale * np.array(place, float)) + self.offset
        return made

    def direction(self, way: Sequence[float]) -> np.ndarray:
        made: np.ndarray = self.turn @ np.array(way, float)
        return made


HERE = Place()


class Placed:
    """A model with points of a `Place`."""

    def __init__(self, place: Place, points: dict[str, Sequence[float]], name: str = "") -> None:
        self.place = place
        self.model = Model(name=name)
        order = list(points)
        if place.reverse:
            order.reverse()
        self.node: dict[str, Node] = {
            key: self.model.node(*place.point(points[key])) for key in order
        }

    def ends(self, p: str, q: str) -> tuple[Node, Node]:
        return (self.node[q], self.node[p]) if self.place.swapped else (self.node[p], self.node[q])

    def sheet(self, p: str, q: str, width: Sequence[float], name: str, beams: int = 1) -> None:
        sense = -1.0 if self.place.other_sense else 1.0
        way = sense * self.place.direction(width)
        self.model.sheet(*self.ends(p, q), way, beams, name=name)

    def wire(self, p: str, q: str, name: str) -> None:
        self.model.wire(*self.ends(p, q), name=name)

    def body(self, points: Sequence[str], name: str) -> None:
        first, *rest = points
        for k, other in enumerate(rest, start=1):
            self.model.rigid(self.node[first], self.node[other], name=f"{name}, {k}")

    def fix(self, *points: str) -> None:
        for point in points:
            self.model.fix(self.node[point])


def guide(place: Place = HERE, sheets: int = 2, beams: int = 1, names: Sequence[str] = ()) -> Model:
    """Parallel sheets along x with their width along z, and a stage: it moves along y."""
    points: dict[str, Sequence[float]] = {}
    for k in range(sheets):
        points[f"ground {k}"] = (0.0, 0.05 * k, 0.0)
        points[f"stage {k}"] = (0.1, 0.05 * k, 0.0)
    made = Placed(place, points)
    for k in range(sheets):
        name = names[k] if names else f"sheet {k + 1}"
        made.sheet(f"ground {k}", f"stage {k}", EZ, name, beams)
        made.fix(f"ground {k}")
    made.body([f"stage {k}" for k in range(sheets)], "stage")
    return made.model


CROSSING = (0.02, 0.03, 0.0)


def cross_hinge(place: Place = HERE) -> Model:
    """Two sheets, wide along z, that cross above each other at CROSSING: the axis is along z."""
    x, y, _ = CROSSING
    points = {
        "a": (x - 0.03, y - 0.04, 0.0),
        "A": (x + 0.03, y + 0.04, 0.0),
        "b": (x + 0.04, y - 0.03, 0.02),
        "B": (x - 0.04, y + 0.03, 0.02),
    }
    made = Placed(place, points)
    made.sheet("a", "A", EZ, "first sheet")
    made.sheet("b", "B", EZ, "second sheet")
    made.body(["A", "B"], "arm")
    made.fix("a", "b")
    return made.model


RADIUS, RISE = 0.06, 0.02


def wires_on_a_helix(place: Place = HERE, wires: int = 5) -> Model:
    """Wires along tangents of the helix (R cos t, R sin t, c t): a body that can screw about z.

    A wire with direction t at r does no work on a screw of pitch h about z where
    t.(h ez + ez x r) = h c + R^2 = 0.
    """
    points: dict[str, Sequence[float]] = {"middle": (0.0, 0.0, 0.0)}
    for k in range(wires):
        angle = 1.1 * k + 0.1 * k * k
        at = np.array([RADIUS * math.cos(angle), RADIUS * math.sin(angle), RISE * angle])
        tangent = np.array([-RADIUS * math.sin(angle), RADIUS * math.cos(angle), RISE])
        points[f"body {k}"] = at
        points[f"ground {k}"] = at + 0.7 * tangent
    made = Placed(place, points)
    made.body(["middle", *(f"body {k}" for k in range(wires))], "body")
    for k in range(wires):
        made.wire(f"ground {k}", f"body {k}", f"wire {k + 1}")
        made.fix(f"ground {k}")
    return made.model


#: Ways to give one mechanism: the first is as it stands.
PLACES = {
    "as it stands": HERE,
    "in millimetres": Place(scale=1e3),
    "in micrometres": Place(scale=1e6),
    "turned": Place(turn=turn_about((1, 2, -3), 1.1)),
    "turned, in millimetres": Place(scale=1e3, turn=turn_about((3, 1, 2), 2.3)),
    "a metre away": Place(offset=(1.0, -2.0, 0.5)),
    "numbered backwards": Place(reverse=True),
    "other ends and widths": Place(other_sense=True, swapped=True),
    "all of it": Place(1e3, turn_about((1, 1, 0.2), 0.7), (300.0, 20.0, 7.0), True, True, True),
}
