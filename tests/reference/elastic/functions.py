# SPDX-License-Identifier: BSD-3-Clause
"""Deformation functions of the elements at any state, differentiated twice by jets.

The twelve variables of an element are (position of p, spin of p, position of q, spin of q). A spin
w turns a vector a of the node by exp(w): a + w x a + w x (w x a)/2, to second order. In the plane
the third spin is the change of the angle, and the angle itself may be any.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jets import Jet, Real, Vector, cross, dot, minus, plus, times

COUNT = 12


@dataclass
class Batch:
    """B elements of one kind, at one state.

    Attributes:
        frame: local axes at rest, columns, (B, 3, 3).
        offset: q - p at rest, (B, 3).
        length: l0, (B,); the torsion-elongation constant, (B,).
        xp, xq: positions (B, 3).
        rp, rq: rotation matrices of the nodes (B, 3, 3).
        ap, aq: planar angles (B,).
    """

    frame: Real
    offset: Real
    length: Real
    coupling: Real
    xp: Real
    rp: Real
    ap: Real
    xq: Real
    rq: Real
    aq: Real

    def position(self, end: str) -> Vector:
        values, first = (self.xp, 0) if end == "p" else (self.xq, 6)
        a, b, c = (Jet.variable(values[:, i], first + i, COUNT) for i in range(3))
        return a, b, c

    def constant(self, vectors: Real) -> Vector:
        a, b, c = (Jet.constant(vectors[:, i], COUNT) for i in range(3))
        return a, b, c

    def turned(self, end: str, at_rest: Real) -> Vector:
        """A vector that is fixed to a node, given at rest."""
        turn, first = (self.rp, 3) if end == "p" else (self.rq, 9)
        now = self.constant(np.einsum("bij,bj->bi", turn, at_rest))
        zero = np.zeros(len(at_rest))
        w0, w1, w2 = (Jet.variable(zero, first + i, COUNT) for i in range(3))
        spin = (w0, w1, w2)
        change = cross(spin, now)
        half = cross(spin, change)
        return plus(plus(now, change), (half[0] * 0.5, half[1] * 0.5, half[2] * 0.5))

    def axis(self, end: str, index: int) -> Vector:
        return self.turned(end, self.frame[:, :, index])


def _chord(batch: Batch) -> tuple[Jet, Vector]:
    """Elongation of the line from p to q, and its unit vector."""
    line = minus(batch.position("q"), batch.position("p"))
    length = dot(line, line).sqrt()
    # l - l0 = (l^2 - l0^2)/(l + l0), with the small difference first
    rest = batch.constant(batch.offset)
    change = minus(line, rest)
    elongation = (
        dot(change, plus(line, rest)) * (length + Jet.constant(batch.length, COUNT)).reciprocal()
    )
    return elongation, times(length.reciprocal(), line)


def truss(batch: Batch) -> list[Jet]:
    return [_chord(batch)[0]]


def beam(batch: Batch) -> list[Jet]:
    """Equations (3) and (4) of the paper in full."""
    elongation, along = _chord(batch)
    yp, zp = batch.axis("p", 1), batch.axis("p", 2)
    yq, zq = batch.axis("q", 1), batch.axis("q", 2)
    l0 = batch.length
    b2 = (dot(zp, yq) - dot(yp, zq)) * (l0 / 2)
    b3, b4 = dot(along, zp) * -l0, dot(along, zq) * l0
    b5, b6 = dot(along, yp) * l0, dot(along, yq) * -l0
    squares = 2.0 * b3 * b3 + b3 * b4 + 2.0 * b4 * b4 + 2.0 * b5 * b5 + b5 * b6 + 2.0 * b6 * b6
    sixth = 1 / (6 * l0)
    return [
        elongation + squares * (1 / (30 * l0)) + b2 * b2 * (batch.coupling / (2 * l0**3)),
        b2 + (b4 * b5 - b3 * b6) * (1 / l0),
        b3 + b2 * (b5 + b6) * sixth,
        b4 - b2 * (b5 + b6) * sixth,
        b5 - b2 * (b3 + b4) * sixth,
        b6 + b2 * (b3 + b4) * sixth,
    ]


def planar_beam(batch: Batch) -> list[Jet]:
    elongation, along = _chord(batch)
    l0 = batch.length
    e2 = dot(along, batch.axis("p", 1)) * -l0
    e3 = dot(along, batch.axis("q", 1)) * l0
    squares = 2.0 * e2 * e2 + e2 * e3 + 2.0 * e3 * e3
    return [elongation + squares * (1 / (30 * l0)), e2, e3]


def place_in_frame(batch: Batch) -> list[Jet]:
    """RBEAM, PINBODY, PLRBEAM: q in the frame that turns with p, minus its place at rest."""
    line = minus(batch.position("q"), batch.position("p"))
    apart = minus(line, batch.turned("p", batch.offset))
    return [dot(batch.axis("p", i), apart) for i in range(3)]


def hinge(batch: Batch) -> list[Jet]:
    """Twist about the axis that is left when its tilt is undone, and the two tilts."""
    yp, zp = batch.axis("p", 1), batch.axis("p", 2)
    xq, yq, zq = (batch.axis("q", i) for i in range(3))
    twist = (dot(yq, zp) - dot(zq, yp)).arctan2(dot(yq, yp) + dot(zq, zp))
    return [twist, -dot(xq, zp), dot(xq, yp)]


def planar_hinge(batch: Batch) -> list[Jet]:
    ap, aq = Jet.variable(batch.ap, 5, COUNT), Jet.variable(batch.aq, 11, COUNT)
    return [aq - ap]


def bearing(batch: Batch) -> list[Jet]:
    return place_in_frame(batch) + hinge(batch)


FUNCTIONS = {
    "TRUSS": truss,
    "PLTRUSS": truss,
    "BEAM": beam,
    "PLBEAM": planar_beam,
    "RBEAM": place_in_frame,
    "PINBODY": place_in_frame,
    "PLRBEAM": lambda batch: place_in_frame(batch)[:2],
    "HINGE": hinge,
    "PLTOR": planar_hinge,
    "PLHINGE": planar_hinge,
    "BEARING": bearing,
}


def weight(batch: Batch, mass: Real, gravity: Real) -> Jet:
    """Potential energy of a beam of the given masses in a field of gravity."""
    field = batch.constant(np.tile(gravity, (len(mass), 1)))
    middle = plus(batch.position("p"), batch.position("q"))
    tilt = minus(batch.axis("p", 0), batch.axis("q", 0))
    return (dot(field, middle) * 0.5 + dot(field, tilt) * (batch.length / 12)) * -mass


def straight_weight(batch: Batch, mass: Real, gravity: Real) -> Jet:
    """Potential energy of straight bars."""
    field = batch.constant(np.tile(gravity, (len(mass), 1)))
    return dot(field, plus(batch.position("p"), batch.position("q"))) * (-mass / 2)
