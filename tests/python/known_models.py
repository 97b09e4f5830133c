# SPDX-License-Identifier: BSD-3-Clause
"""Models that several tests share."""

import math

import numpy as np

from flexact import Model, Node


def twelve_trusses() -> Model:
    """Fig. 2 of the paper."""
    model = Model(name="twelve trusses")
    base = [model.node(x, y, 0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    top = [model.node(x, y, 1) for x, y in ((0, -1), (1, 0), (0, 1), (-1, 0))]
    for k in range(4):
        model.truss(base[k], top[k])
        model.truss(base[(k + 1) % 4], top[k])
    for k in range(4):
        model.truss(top[k], top[(k + 1) % 4])
    for node in base:
        model.fix(node)
    return model


def ring(n: int) -> Model:
    """Base polygon fixed, one ring joint above the middle of each edge (Tarnai 1980)."""
    model = Model()
    angle = 2 * math.pi / n
    base = [model.node(math.cos(k * angle), math.sin(k * angle), 0) for k in range(n)]
    mid = math.cos(angle / 2)
    top = [
        model.node(mid * math.cos((k + 0.5) * angle), mid * math.sin((k + 0.5) * angle), 1)
        for k in range(n)
    ]
    for k in range(n):
        model.fix(base[k])
        model.truss(base[k], top[k])
        model.truss(base[(k + 1) % n], top[k])
        model.truss(top[k], top[(k + 1) % n])
    return model


def undeclared_sheet(model: Model, p: Node, q: Node, beams: int, name: str = "") -> None:
    """A sheet in the xy plane in several beams, whose inner motions nobody declares."""
    ends = np.array([p.place, q.place])
    inner = [model.node(*((1 - t) * ends[0] + t * ends[1])) for t in np.arange(1, beams) / beams]
    nodes = [p, *inner, q]
    for k in range(beams):
        own = f"{name}, {k + 1}" if name and beams > 1 else name
        model.sheet(nodes[k], nodes[k + 1], (0, 0, 1), name=own)


def folded_sheet(clamped: bool, beams: int = 1, size: float = 1.0) -> Model:
    """Fig. 4 of the paper: two sheets at a right angle, in series."""
    model = Model(name="folded sheet")
    a, b, c = (model.node(size * x, size * y, 0) for x, y in ((0, 0), (1, 0), (1, 1)))
    undeclared_sheet(model, a, b, beams, "first")
    undeclared_sheet(model, b, c, beams, "second")
    model.fix(a)
    if clamped:
        model.fix(c)
    return model


def sheet_clamped_twice() -> Model:
    """Three self-stresses, and D(c) has no columns."""
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    model.sheet(a, b, (0, 0, 1), name="leaf <1>")
    model.fix(a)
    model.fix(b)
    return model


def guide(beams: int = 1, size: float = 1.0) -> Model:
    """Two parallel sheets and a stage: one motion, one self-stress."""
    model = Model()
    a, b = model.node(0, 0, 0), model.node(size, 0, 0)
    c, d = model.node(0, size / 4, 0), model.node(size, size / 4, 0)
    undeclared_sheet(model, a, b, beams)
    undeclared_sheet(model, c, d, beams)
    model.rigid(b, d)
    model.fix(a)
    model.fix(c)
    return model


def hinges_in_a_point() -> Model:
    """Two hinges in a row at one point, nothing else: a mechanism without extent."""
    model = Model()
    a = model.node(0, 0, 0)
    b = model.hinge(a, (0, 0, 1))
    model.hinge(b, (0, 1, 0))
    return model


def bar_driven_twice() -> Model:
    """A bar driven at its one free end, its elongation independent as well: (0, 1)."""
    model = Model(planar=True)
    a, b = model.node(0, 0), model.node(2, 0)
    bar = model.truss(a, b)
    model.fix(a)
    model.fix(b, "y")
    model.independent(b, "x")
    model.independent(bar, 1)
    return model


def frame(size: float) -> Model:
    """Four beams in a skew ring, held at one corner: six self-stresses, no support loaded."""
    model = Model()
    places = size * np.array([[0, 0, 0], [1, 0.3, 0.2], [1.1, 1.3, 0.7], [0, 1, 0.4]])
    corners = [model.node(*place) for place in places]
    for k in range(4):
        model.beam(corners[k], corners[(k + 1) % 4])
    model.fix(corners[0])
    return model


def rounded(model: Model, turn: np.ndarray, form: str) -> Model:
    """Bars of a model turned, their coordinates printed in a form and read back."""
    made = Model()
    places = (turn @ model.positions.T).T
    nodes = [made.node(*(float(format(part, form)) for part in place)) for place in places]
    for p, _, q, _ in model.element_nodes.tolist():
        made.truss(nodes[p], nodes[q])
    fixed = (model.coordinate_classes == 1).all(axis=1)
    for index in np.flatnonzero(fixed):
        made.fix(nodes[index])
    return made
