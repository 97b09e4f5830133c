# SPDX-License-Identifier: BSD-3-Clause
"""Random small mechanisms as a designer makes them in Python: to be advised on.

Frameworks, stages on flexures, chains with a free end, loops of hinges, cranks with notches and
clamped bodies, in the plane and in space, many of them in a special position.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

import flexact
from flexact import Model

#: Elements of a mechanism at most.
MOST = 12
_AXES = ("x", "y", "z", "rx", "ry", "rz")

Random = np.random.Generator
Place = tuple[float, ...]


def mechanism(seed: int, number: int) -> Model:
    """A mechanism by its name, seed and number; one that can be analysed, of 1 to 12 elements."""
    for again in range(1000):
        rng = np.random.default_rng((seed, number, again))
        try:
            model = FAMILIES[number % len(FAMILIES)](rng)
            _declare(rng, model)
            size = model.data.arrays.element_number.size
            if 0 < size <= MOST and not model.data.problems.errors:
                return model
        except flexact.FlexactError:
            continue
    raise AssertionError("no mechanism could be made")


def name_of(seed: int, number: int) -> str:
    """The name from which a mechanism is made again, such as stage-7-10."""
    return f"{FAMILIES[number % len(FAMILIES)].__name__}-{seed}-{number}"


def _declare(rng: Random, model: Model) -> None:
    """Now and then a declared or a fixed coordinate, and a further released deformation."""
    arrays = model.data.arrays
    for _ in range(int(rng.integers(0, 3)) if rng.random() < 0.5 else 0):
        node = int(rng.choice(arrays.node_number))
        call = model.independent if rng.random() < 0.7 else model.fix
        try:
            call(node, str(rng.choice(_AXES)))
        except flexact.FlexactError:
            continue
    if rng.random() < 0.15:
        element = int(rng.choice(arrays.element_number))
        try:
            model.release(element, int(rng.integers(1, 7)))
        except flexact.FlexactError:
            return


def _place(rng: Random, planar: bool = False) -> Place:
    """A place on a lattice of 50 mm, or anywhere to a hundredth of a millimetre."""
    count = 2 if planar else 3
    if rng.random() < 0.6:
        made = 0.05 * rng.integers(-3, 4, count)
    else:
        made = np.round(rng.uniform(-0.15, 0.15, count), 5)
    return tuple(float(f"{value:.6g}") for value in made)


def _way(rng: Random) -> Place:
    """A direction, along an axis as often as not."""
    if rng.random() < 0.6:
        return tuple(np.eye(3)[int(rng.integers(3))].tolist())
    return tuple(np.round(rng.normal(size=3), 3).tolist())


def _across(rng: Random, one: Place, other: Place) -> Place:
    """A direction across a line, as the width of a sheet."""
    along = np.subtract(other, one)
    for _ in range(10):
        made = np.cross(along, _way(rng))
        if np.linalg.norm(made) > 1e-6:
            unit = made / np.abs(made).max()
            return tuple(np.round(unit, 9).tolist())
    return (0.0, 0.0, 1.0)


def framework(rng: Random) -> Model:
    """Bars between joints, some of them fixed."""
    planar = bool(rng.random() < 0.5)
    model = Model(planar=planar)
    count = int(rng.integers(4, 8))
    places = list(dict.fromkeys(_place(rng, planar) for _ in range(count)))
    nodes = [model.node(*place) for place in places]
    pairs = [(i, j) for j in range(len(nodes)) for i in range(j)]
    rng.shuffle(pairs)
    free = len(nodes) - int(rng.integers(2, min(4, len(nodes) - 1) + 1))
    for i, j in pairs[: int(rng.integers(3, MOST + 1))]:
        if min(i, j) < free:
            model.truss(nodes[i], nodes[j])
    for node in nodes[free:]:
        model.fix(node)
    return model


def special_framework(rng: Random) -> Model:
    """Two triangles, or a body, on bars that are parallel, meet in a point or nearly so."""
    planar = bool(rng.random() < 0.5)
    model = Model(planar=planar)
    ends = [_place(rng, planar) for _ in range(3 if planar else int(rng.integers(4, 7)))]
    focus = np.array(_place(rng, planar)) + 0.3
    kind = int(rng.integers(4))
    feet = []
    for end in ends:
        way = np.array([0.0, 0.1, 0.0][: len(end)])
        if kind == 1:
            way = 0.5 * (focus - end)
        elif kind == 2:
            way = 0.1 * np.sign(rng.normal(size=len(end)))
        elif kind == 3 and not planar:
            way = np.array([*rng.uniform(-0.1, 0.1, 2), 0.0])
        feet.append(tuple(np.round(np.add(end, way), 9).tolist()))
    if rng.random() < 0.7:
        model.body([model.node(*end) for end in dict.fromkeys(ends)], name="plate")
    for end, foot in zip(ends, feet, strict=True):
        model.truss(end, foot)
        model.fix(foot)
    return model


def stage(rng: Random) -> Model:
    """A body on sheets, wires, folded sheets and beams that release something."""
    model = Model()
    ends: list[Place] = []
    along, width = _way(rng), _way(rng)
    is_special = rng.random() < 0.7
    focus = np.array(_place(rng)) + 0.2
    is_flat = rng.random() < 0.3
    for _ in range(int(rng.integers(1, 6))):
        end = _place(rng)
        if is_flat:
            end = (*end[:2], 0.0)
        way = 0.1 * np.array(along if is_special else _way(rng))
        if rng.random() < 0.3:
            way = 0.5 * (focus - end)
        if is_flat:
            way[2] = 0.0
        foot = tuple(np.round(np.add(end, way), 9).tolist())
        side = width if is_special else _across(rng, foot, end)
        kind = int(rng.integers(5))
        if kind < 2:
            model.sheet(foot, end, width=side)
        elif kind == 2:
            model.wire(foot, end)
        elif kind == 3:
            middle = np.round(np.add(end, 0.5 * np.subtract(foot, end)), 9) + 0.03 * np.array(
                _way(rng)
            )
            model.folded_sheet(foot, tuple(np.round(middle, 9).tolist()), end)
        else:
            release = sorted({int(k) for k in rng.integers(1, 7, int(rng.integers(1, 5)))})
            model.beam(foot, end, release=release)
        model.fix(foot)
        ends.append(end)
    made = list(dict.fromkeys(ends))
    model.body([*made, _place(rng)] if len(made) < 2 or rng.random() < 0.2 else made, name="stage")
    return model


def chain(rng: Random) -> Model:
    """Sheets, wires, beams and notches in a row from a clamp, with a free end or another clamp."""
    model = Model()
    place = _place(rng)
    here = model.node(*place)
    model.fix(here)
    for _ in range(int(rng.integers(1, 6))):
        step = 0.1 * np.sign(rng.normal()) * np.array(_way(rng))
        following = tuple(np.round(np.add(place, step), 9).tolist())
        if rng.random() < 0.2:
            here = model.notch(here, _way(rng)).q
        there = model.node(*following)
        kind = int(rng.integers(5))
        if kind < 3:
            model.sheet(here, there, width=_across(rng, place, following))
        elif kind == 3:
            model.wire(here, there)
        else:
            model.beam(here, there, release=["twist"] if rng.random() < 0.5 else [])
        here, place = there, following
    if rng.random() < 0.4:
        model.fix(here)
    return model


def loop(rng: Random) -> Model:
    """Links and hinges in a loop: axes parallel by groups, through a point, or a half-turn."""
    model = Model()
    count = int(rng.integers(3, 7))
    places = np.round(rng.uniform(-0.2, 0.2, (count, 3)), 3)
    axes = np.array([_way(rng) for _ in range(count)])
    kind = int(rng.integers(5))
    if kind == 0:
        split = int(rng.integers(1, count + 1))
        axes[:split], axes[split:] = _way(rng), _way(rng)
    elif kind == 1:
        axes = places - np.round(rng.uniform(-0.2, 0.2, 3), 3)
    elif kind == 2 and count == 6:
        turn = np.diag([-1.0, -1.0, 1.0])
        places[3:], axes[3:] = places[:3] @ turn, axes[:3] @ turn
    elif kind == 3:
        axes[:] = _way(rng)
    here = model.node(*places[0].tolist())
    model.fix(here)
    for k in range(count):
        here = model.hinge(here, tuple(axes[k].tolist()), name=f"joint {k + 1}")
        if k + 1 < count:
            there = model.node(*places[k + 1].tolist())
            model.beam(here, there, name=f"link {k + 1}")
            here = there
    model.fix(here)
    return model


def crank(rng: Random) -> Model:
    """A body, clamped or on flexures, with notches at it, wires beyond, and joints that turn."""
    model = Model()
    places = list(dict.fromkeys(_place(rng) for _ in range(3)))
    nodes = [model.node(*place) for place in places]
    model.body(nodes, name="crank")
    if rng.random() < 0.5:
        model.fix(nodes[0])
    else:
        foot = tuple(np.round(np.add(places[0], 0.1 * np.array(_way(rng))), 9).tolist())
        model.sheet(foot, nodes[0], width=_across(rng, foot, places[0]))
        model.fix(foot)
    for node, place in zip(nodes[1:], places[1:], strict=True):
        end = tuple(np.round(np.add(place, 0.1 * np.array(_way(rng))), 9).tolist())
        kind = int(rng.integers(5))
        if kind == 0:
            beyond = model.notch(node, _way(rng)).q
            model.wire(beyond, end)
        elif kind == 1:
            model.truss(node, end)
        elif kind == 2:
            beyond = model.hinge(node, _way(rng))
            model.sheet(beyond, end, width=_across(rng, place, end))
        elif kind == 3:
            model.wire(node, end)
        else:
            model.rigid(node, end)
            model.truss(end, tuple(np.round(np.add(end, 0.1 * np.array(_way(rng))), 9).tolist()))
        if rng.random() < 0.7:
            model.fix(end)
    return model


def plane(rng: Random) -> Model:
    """Sheets, bars, beams and hinges in the plane."""
    model = Model(planar=True)
    places = list(dict.fromkeys(_place(rng, planar=True) for _ in range(int(rng.integers(3, 6)))))
    nodes = [model.node(*place) for place in places]
    for k in range(1, len(nodes)):
        for other in {int(rng.integers(k)), int(rng.integers(k))}:
            kind = int(rng.integers(5))
            p, q = nodes[other], nodes[k]
            if kind == 0:
                model.truss(p, q)
            elif kind == 1:
                model.sheet(p, q)
            elif kind == 2:
                model.wire(p, q)
            elif kind == 3:
                model.beam(model.hinge(p), q)
            else:
                model.beam(p, q)
    model.fix(nodes[0])
    if rng.random() < 0.7:
        model.fix(nodes[-1])
    return model


FAMILIES: tuple[Callable[[Random], Model], ...] = (
    *(framework, special_framework, stage, chain, loop, crank, plane),
    stage,
)
