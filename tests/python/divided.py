# SPDX-License-Identifier: BSD-3-Clause
"""Mechanisms whose sheets and wires are divided into beams and declared as one each."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

import flexact
from flexact import Model
from flexact.model.handles import Node

SHEET, WIRE = (2, 5, 6), (2, 3, 4, 5, 6)
#: The same bending seen from the other end of a beam.
OTHER_END = {3: 4, 4: 3, 5: 6, 6: 5}


@dataclass(frozen=True)
class Division:
    """How sheets and wires are divided.

    Attributes:
        beams: Into how many.
        amplitude: How far inner nodes are off the line, at most [m].
        seed: Of what is irregular.
        stroke: By how much the body has moved across [m].
        against: Whether some beams run against the others.
        turned: Whether the y vectors of some beams but the first are the other way round.
        declared: Whether what is inside is declared.
        named: Whether the beams have names.
        release: Deformations that the first sheet or wire releases besides, 3 or 5 in its first
            beam, 4 or 6 in its last.
    """

    beams: int = 1
    amplitude: float = 0.0
    seed: int = 0
    stroke: float = 0.0
    against: bool = False
    turned: bool = False
    declared: bool = True
    named: bool = True
    release: tuple[int, ...] = ()

    @property
    def undivided(self) -> Division:
        """The same with one beam each."""
        return Division(stroke=self.stroke, named=self.named, release=self.release)


class Rows:
    """Adds rows of beams to a model."""

    def __init__(self, model: Model, how: Division) -> None:
        self.model, self.how = model, how
        self.rng = np.random.default_rng(how.seed)
        self.count = 0

    def add(
        self,
        ends: tuple[Node, Node],
        places: tuple[np.ndarray, np.ndarray],
        normal: Sequence[float],
        released: tuple[int, ...],
        name: str,
    ) -> None:
        """A sheet or wire between two points."""
        how, model, n = self.how, self.model, self.how.beams
        points = [ends[0], *(model.node(*self._inner(places, i / n)) for i in range(1, n)), ends[1]]
        besides = how.release if self.count == 0 else ()
        self.count += 1
        for i in range(n):
            against = how.against and self.rng.random() < 0.5
            sign = -1.0 if how.turned and i and self.rng.random() < 0.5 else 1.0
            p, q = points[i : i + 2][:: -1 if against else 1]
            called = (f"{name}, {i + 1}" if n > 1 else name) if how.named else ""
            mine = set(released) if not i or not how.declared else set()
            mine |= {d for d in besides if i == (n - 1 if d in (4, 6) else 0)}
            own = {OTHER_END.get(d, d) if against else d for d in mine}
            beam = model.beam(p, q, sign * np.array(normal), sorted(own), name=called)
            rest = sorted({OTHER_END.get(d, d) if against else d for d in released} - own)
            if rest and how.declared:
                model.independent(beam, *rest)

    def _inner(self, places: tuple[np.ndarray, np.ndarray], t: float) -> np.ndarray:
        """A guided sheet is the cubic of its stroke, along z."""
        p, q = places
        across = np.array([0.0, 0.0, q[2] - p[2]]) if self.how.stroke else np.zeros(3)
        line = p + t * (q - p - across) + (3 * t**2 - 2 * t**3) * across
        return np.asarray(line + self.how.amplitude * self.rng.uniform(-1.0, 1.0, 3))


def parallel_guide(how: Division, guided: bool = True) -> Model:
    """Two sheets of 100 mm along x guide a stage along z; over-constrained by one."""
    model = Model(name="parallel guide")
    rows, stage = Rows(model, how), []
    for k, z in enumerate((0.0, 0.05)):
        places = np.array([0.0, 0.0, z]), np.array([0.1, 0.0, z + how.stroke])
        ends = model.node(*places[0]), model.node(*places[1])
        model.fix(ends[0])
        rows.add(ends, places, (0.0, 0.0, 1.0), SHEET, f"sheet {k + 1}")
        stage.append(ends[1])
    model.rigid(*stage, name="stage")
    if guided:
        model.independent(stage[0], "z")
    return model


def cross_hinge(how: Division, guided: bool = True) -> Model:
    """Two sheets of 100 mm cross halfway; the body turns about y; over-constrained by one."""
    model = Model(name="cross hinge")
    rows, body = Rows(model, how), []
    for k, side in enumerate((-1.0, 1.0)):
        places = np.array([0.03 * side, 0.0, 0.0]), np.array([-0.03 * side, 0.0, 0.08])
        ends = model.node(*places[0]), model.node(*places[1])
        model.fix(ends[0])
        rows.add(ends, places, (0.8, 0.0, 0.6 * side), SHEET, f"sheet {k + 1}")
        body.append(ends[1])
    model.rigid(*body, name="body")
    if guided:
        model.independent(body[0], "ry")
    return model


def wire_guide(how: Division, guided: bool = True) -> Model:
    """Five wires guide a body along z, as input_decks/paper/five_wires.dat; exact."""
    model = Model(name="wire guide")
    rows, centre = Rows(model, how), model.node(0, 0, 0)
    directions = ((1, 0, -0.03, 0.02), (1, 0, 0.03, 0.02), (0, 1, 0, 0.02))
    for k, (x, y, beside, z) in enumerate((*directions, (1, 0, 0, -0.02), (0, 1, 0, -0.02))):
        way, off = np.array([x, y, 0.0]), np.array([beside * y, beside * x, z])
        places = 0.1 * way + off, 0.04 * way + off
        ends = model.node(*places[0]), model.node(*places[1])
        model.fix(ends[0])
        rows.add(ends, places, (0.0, 0.0, 1.0), WIRE, f"wire {k + 1}")
        model.rigid(centre, ends[1], name=f"body, {k + 1}")
    if guided:
        model.independent(centre, "z")
    return model


Make = Callable[[Division], Model]
MAKERS: dict[str, Make] = {
    "parallel guide": parallel_guide,
    "cross hinge": cross_hinge,
    "wire guide": wire_guide,
    # The released bending lets the stage twist: the guide is exact.
    "released at the clamp": lambda how: parallel_guide(replace(how, release=(3,))),
    "released at the stage": lambda how: parallel_guide(replace(how, release=(4,))),
}
#: Under- and over-constraint by tests/reference/known_answers.md; a release takes one away.
TRUTH = {
    "parallel guide": (0, 1),
    "cross hinge": (0, 1),
    "wire guide": (0, 0),
    "released at the clamp": (0, 0),
    "released at the stage": (0, 0),
}


def counts(analysis: flexact.Analysis) -> tuple[int, int]:
    """Under- and over-constraint."""
    return analysis.under_constrained, analysis.over_constrained
