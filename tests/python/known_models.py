"""Models that several tests share."""

import math

from flexact import Model


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


def folded_sheet(clamped: bool, beams: int = 1, size: float = 1.0) -> Model:
    """Fig. 4 of the paper: two sheets at a right angle, in series."""
    model = Model(name="folded sheet")
    a, b, c = (model.node(size * x, size * y, 0) for x, y in ((0, 0), (1, 0), (1, 1)))
    model.sheet(a, b, (0, 0, 1), beams, name="first")
    model.sheet(b, c, (0, 0, 1), beams, name="second")
    model.fix(a)
    if clamped:
        model.fix(c)
    return model
