# SPDX-License-Identifier: BSD-3-Clause
"""Frameworks of bars in special positions: joints on conics, concurrent lines, symmetric solids."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from fractions import Fraction

from .exact_deck import Vector
from .sketch import Chance, Place, Sketch, between, plus, vector

#: The smallest hair by which a special position is missed is ten to minus this.
_THINNEST = 20


def hair(chance: Chance, sketch: Sketch, part: float = 0.5) -> Fraction:
    """Zero, or by some chance what a sketch is off its special position by."""
    if chance.random() >= part:
        return Fraction(0)
    sketch.hairy = True
    by = Fraction(chance.randint(1, 9), 10 ** chance.randint(1, _THINNEST))
    return Fraction(0) if chance.hairless else by


def whole(chance: Chance, planar: bool, size: int = 9) -> Vector:
    """A random point of whole numbers."""
    x, y, z = (chance.randint(-size, size) for _ in range(3))
    return vector((x, y, 0 if planar else z))


def apart(chance: Chance, number: int, planar: bool, size: int = 9) -> list[Vector]:
    """Points of whole numbers of which no two are one."""
    found: dict[Vector, None] = {}
    while len(found) < number:
        found[whole(chance, planar, size)] = None
    return list(found)


def direction(chance: Chance, planar: bool, size: int = 5) -> Vector:
    """A random direction of whole numbers."""
    while True:
        if any(found := whole(chance, planar, size)):
            return found


def off(place: Place, chance: Chance, planar: bool, by: Fraction) -> Vector:
    """A point moved in a random direction."""
    return plus(place, direction(chance, planar), by)


def desargues(chance: Chance) -> Sketch:
    """Two triangles joined by three bars that meet in a point, or miss it by a hair."""
    sketch = Sketch(planar=True)
    centre, by = whole(chance, True), hair(chance, sketch)
    rays = [(1, chance.randint(-4, 4)), (chance.randint(-4, 4), 3), (-2, chance.randint(1, 5))]
    held = chance.random() < 0.5
    inner, outside = [], []
    for ray in rays:
        near = Fraction(chance.choice((1, 2, 3)), chance.choice((1, 2, 4, 5)))
        far = near + Fraction(chance.choice((1, 2, 5)), chance.choice((1, 2, 4, 5)))
        inner.append(sketch.node(plus(centre, ray, near), fixed=held))
        place = plus(centre, ray, far)
        outside.append(sketch.node(off(place, chance, True, by)))
    sketch.bars(zip(inner, outside, strict=True))
    sketch.bars(itertools.combinations(outside, 2))
    if not held:
        sketch.bars(itertools.combinations(inner, 2))
    return sketch


def bipartite(chance: Chance) -> Sketch:
    """K(m, n) with its joints on a conic in the plane, or on a quadric in space."""
    planar = chance.random() < 0.6
    sizes = ((3, 3), (3, 3), (3, 4), (4, 4)) if planar else ((4, 6), (5, 5), (4, 5), (4, 4))
    sketch = Sketch(planar)
    by = hair(chance, sketch, 0.4)
    m, n = chance.choice(sizes)
    places = _on_curve(chance, m + n) if planar else _on_surface(chance, m + n)
    chosen = chance.randrange(m + n)
    places[chosen] = off(places[chosen], chance, planar, by)
    nodes = [sketch.node(place) for place in places]
    sketch.bars(itertools.product(nodes[:m], nodes[m:]))
    return sketch


def _on_curve(chance: Chance, number: int) -> list[Vector]:
    """Points of an ellipse, a hyperbola or a parabola."""
    a, b = chance.choice(((1, 1), (2, 2), (3, 2), (5, 1)))
    kind = chance.randrange(3)
    found: list[Vector] = []
    while len(found) < number:
        t = Fraction(chance.randint(-12, 12), chance.choice((1, 2, 3, 4, 5)))
        if kind == 0:
            place = vector((a * (1 - t * t) / (1 + t * t), b * 2 * t / (1 + t * t)))
        elif kind == 1:
            place = vector((a * t, b / t)) if t else vector((a, b))
        else:
            place = vector((t, t * t / a))
        if place not in found:
            found.append(place)
    return found


def _on_surface(chance: Chance, number: int) -> list[Vector]:
    """Points of a sphere, a hyperbolic paraboloid, a cone or a cylinder."""
    kind = chance.randrange(4)
    found: list[Vector] = []
    while len(found) < number:
        u, v = (Fraction(chance.randint(-8, 8), chance.choice((1, 2, 4, 5))) for _ in range(2))
        bottom = 1 + u * u + v * v
        circle = ((1 - u * u) / (1 + u * u), 2 * u / (1 + u * u))
        if kind == 0:
            place = vector((2 * u / bottom, 2 * v / bottom, (bottom - 2) / bottom))
        elif kind == 1:
            place = vector((u, v, u * v))
        elif kind == 2:
            place = vector((v * circle[0], v * circle[1], v))
        else:
            place = vector((*circle, v))
        if place not in found:
            found.append(place)
    return found


def octahedron(chance: Chance) -> Sketch:
    """Twelve edges: generic, flexible after Bricard, or with joints in one plane or line."""
    sketch = Sketch(planar=False)
    a, b, c = apart(chance, 3, False)
    shapes: tuple[Callable[[], list[Vector]], ...] = (
        lambda: apart(chance, 6, False),
        lambda: [a, b, c, *(vector((-x, -y, z)) for x, y, z in (a, b, c))],
        lambda: [a, b, vector((0, c[1], c[2])), _mirrored(a), _mirrored(b), vector((0, 11, 3))],
        lambda: [vector((x, y, 0)) for x, y, _ in (a, b, (7, -11, 0), (8, 13, 0))] + [c, a],
        lambda: [a, b, c, between(a, b, 3), between(b, c, Fraction(1, 2)), vector((1, 12, 5))],
    )
    places = chance.choice(shapes)()
    by, chosen = hair(chance, sketch, 0.3), chance.randrange(6)
    places[chosen] = off(places[chosen], chance, False, by)
    nodes = [sketch.node(place) for place in places]
    sketch.bars(pair for pair in itertools.combinations(nodes, 2) if pair[1] - pair[0] != 3)
    return _stretched(sketch, chance)


def _mirrored(place: Vector) -> Vector:
    return vector((-place[0] - 1, place[1], place[2]))


def prism(chance: Chance) -> Sketch:
    """A polygon above another, bars up and slanting between them: prisms and antiprisms."""
    sketch = Sketch(planar=False)
    sides = chance.choice((3, 3, 4, 4, 5))
    ring = _on_curve(chance, sides) if chance.random() < 0.4 else apart(chance, sides, True, 4)
    height, twist = chance.randint(1, 6), chance.choice(((1, 0), (0, 1), (3, 4), (1, 1)))
    by, held = hair(chance, sketch, 0.3), chance.random() < 0.6
    low = [sketch.node(place, fixed=held) for place in ring]
    high = []
    for x, y, _ in ring:
        place = (twist[0] * x - twist[1] * y, twist[1] * x + twist[0] * y, height)
        high.append(sketch.node(off(place, chance, False, by)))
    sketch.bars(zip(low, high, strict=True))
    sketch.bars(zip(low, high[1:] + high[:1], strict=True))
    around = ([high] if held else [high, low]) * (sides > 3) or [high]
    for polygon in around:
        sketch.bars(zip(polygon, polygon[1:] + polygon[:1], strict=True))
    return _stretched(sketch, chance)


def lattice(chance: Chance) -> Sketch:
    """A braced lattice with bars left out, one of its axes stretched."""
    planar = chance.random() < 0.7
    sketch = Sketch(planar)
    sizes = (chance.randint(2, 5), chance.randint(2, 4), 1) if planar else (2, 2, 2)
    places = list(itertools.product(*map(range, sizes)))
    moved = chance.random() < 0.5
    nodes = {}
    for place in places:
        shift = direction(chance, planar, 3) if moved else vector((0, 0, 0))
        nodes[place] = sketch.node(plus(vector(place), shift, Fraction(1, 16)))
    limit = 2 if planar else 3
    near = [
        (nodes[a], nodes[b])
        for a, b in itertools.combinations(places, 2)
        if 0 < sum((u - v) ** 2 for u, v in zip(a, b, strict=True)) <= limit
    ]
    freedoms = (2 if planar else 3) * len(places)
    chosen = chance.sample(near, min(len(near), freedoms - chance.randint(0, 6)))
    sketch.bars(chosen)
    used = {node for pair in chosen for node in pair}
    sketch.fix(*(node for node in list(nodes.values())[: chance.randint(0, 3)] if node in used))
    return _stretched(sketch, chance, 0.8)


def grown(chance: Chance) -> Sketch:
    """A framework that grows joint by joint; some of its steps are special by construction."""
    planar = chance.random() < 0.5
    sketch = Sketch(planar)
    size = 2 if planar else 3
    nodes = [sketch.node(place, fixed=True) for place in apart(chance, size, planar)]
    by = hair(chance, sketch, 0.4)
    for _ in range(chance.randint(2, 15 if planar else 12)):
        ends = chance.sample(nodes, size)
        place = whole(chance, planar, 20)
        if chance.random() < 0.3:
            part = Fraction(chance.randint(-3, 9), 4)
            flat = between(sketch.at(ends[0]), sketch.at(ends[1]), part)
            if size == 3:
                flat = between(flat, sketch.at(ends[2]), Fraction(chance.randint(1, 5), 8))
            place = off(flat, chance, planar, by)
        if any(place == sketch.at(node) for node in nodes):
            continue
        joint = sketch.node(place)
        sketch.bars((joint, end) for end in ends)
        if chance.random() < 0.2:
            sketch.bar(joint, chance.choice([each for each in nodes if each not in ends] or ends))
        nodes.append(joint)
    if not sketch.deck.elements:
        sketch.to_ground(sketch.node((30, 1)), (31, 5))
    return sketch


def spokes(chance: Chance) -> Sketch:
    """Bars to one joint in rational directions: in one plane or line, or off it by a hair."""
    planar = chance.random() < 0.4
    sketch = Sketch(planar)
    joint = sketch.node(whole(chance, planar))
    a, b = direction(chance, planar), direction(chance, planar)
    by = hair(chance, sketch, 0.7)
    for _ in range(chance.choice((2, 3, 4))):
        u, v = (Fraction(chance.randint(-4, 4), chance.choice((1, 3, 7, 10))) for _ in range(2))
        along = plus(plus((0, 0, 0), a, u), b, 0 if planar else v)
        if not any(along):
            along = a
        sketch.to_ground(joint, plus(sketch.at(joint), off(along, chance, planar, by)))
    return sketch


def _stretched(sketch: Sketch, chance: Chance, part: float = 0.4) -> Sketch:
    """One axis times a power of ten, by some chance."""
    if chance.random() < part:
        axis = chance.randrange(2 if sketch.planar else 3)
        factor = Fraction(10) ** chance.randint(-8, 8)
        for node, place in sketch.deck.places.items():
            parts = list(place)
            parts[axis] *= factor
            sketch.deck.places[node] = vector(parts)
    return sketch
