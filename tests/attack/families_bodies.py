# SPDX-License-Identifier: BSD-3-Clause
"""Rigid bodies on wires, sheets and hinges: platforms, guides, linkages and closed loops."""

from __future__ import annotations

from fractions import Fraction

from .exact_deck import KINDS, Vector
from .families_frameworks import apart, direction, hair, off, whole
from .sketch import Chance, Sketch, outer, plus, vector

#: A sheet holds elongation and bending in its plane, a wire elongation.
_SHEET = (2, 5, 6)
_WIRE = (2, 3, 4, 5, 6)
#: Deformation of a hinge about its axis, and likewise of a bearing.
_ABOUT = (1,)


def platform(chance: Chance) -> Sketch:
    """Four to six wires from the ground to a body: generic or all in a special position."""
    sketch = Sketch(planar=False)
    body, turning = sketch.node((0, 0, 0)), sketch.turning()
    number = chance.choice((4, 5, 6, 6, 6))
    ends, feet = _special_wires(chance, number)
    by = hair(chance, sketch, 0.6)
    chosen = chance.randrange(number)
    feet[chosen] = off(feet[chosen], chance, False, by)
    releases = chance.random() < 0.3
    for end, foot in zip(ends, feet, strict=True):
        on_body = sketch.node(end)
        sketch.arm(body, turning, on_body)
        if releases:
            ground = sketch.node(foot, fixed=True)
            sketch.add(
                *("BEAM", on_body, sketch.turning(), ground, sketch.turning(fixed=True)),
                release=_WIRE,
            )
        else:
            sketch.to_ground(on_body, foot)
    return sketch


def _special_wires(chance: Chance, number: int) -> tuple[list[Vector], list[Vector]]:
    """Ends on the body and on the ground."""
    ends, kind = apart(chance, number, False), chance.randrange(6)
    if kind == 0:
        return ends, [plus(each, direction(chance, False), 2) for each in ends]
    if kind == 1:
        focus = (chance.randint(20, 40), -chance.randint(20, 40), 30)
        parts = [Fraction(chance.choice((1, 2, 3, 5)), 4) for _ in ends]
        return ends, [plus(each, plus(focus, each, -1), k) for each, k in zip(ends, parts)]  # noqa: B905
    if kind == 2:
        flat = apart(chance, number, True)
        return flat, [plus(each, direction(chance, True), 2) for each in flat]
    if kind == 3:
        return ends, [vector((0, 0, 40 + 3 * chance.randint(0, 5))) for _ in ends]
    if kind == 4:
        along = direction(chance, False)
        return ends, [plus(each, along, chance.choice((1, 2, -1))) for each in ends]
    meets = outer(direction(chance, False), (1, 2, 2))
    return ends, [plus(each, plus(meets, each, -1), Fraction(3, 2)) for each in ends]


def guide(chance: Chance) -> Sketch:
    """A body on two or three sheets or folded sheets, parallel or off by a hair."""
    sketch = Sketch(planar=False)
    body, turning = sketch.node((0, 0, 0)), sketch.turning()
    folded, by = chance.random() < 0.5, hair(chance, sketch, 0.6)
    number = chance.choice((2, 2, 3)) if not folded else chance.choice((1, 2, 3, 4))
    along, width = direction(chance, False, 3), direction(chance, False, 3)
    if not any(outer(along, width)):
        width = plus(width, (1, 2, 4))
    feet = apart(chance, number, False, 5)
    for k, place in enumerate(feet):
        end = body
        if any(place):
            end = sketch.node(place)
            sketch.arm(body, turning, end)
        leg = off(along, chance, False, by * (k == number - 1))
        _sheet(sketch, chance, (end, turning), leg, width, folded)
    return sketch


def _sheet(
    sketch: Sketch,
    chance: Chance,
    start: tuple[int, int],
    leg: Vector,
    width: Vector,
    folded: bool,
) -> None:
    place, normal = sketch.at(start[0]), outer(leg, width)
    if folded:
        fold = sketch.node(plus(place, leg)), sketch.turning()
        sketch.add("BEAM", *start, *fold, along=normal, release=_SHEET)
        start, place = fold, sketch.at(fold[0])
        leg = plus(outer(normal, leg), leg, chance.choice((0, 0, 1)))
        normal = outer(leg, width) if chance.random() < 0.3 else normal
        if not any(normal):
            normal = outer(leg, direction(chance, False))
    ground = sketch.node(plus(place, leg), fixed=True), sketch.turning(fixed=True)
    if not any(outer(leg, normal)):
        normal = plus(normal, (1, 3, -2))
    sketch.add("BEAM", *start, *ground, along=normal, release=_SHEET)


def cranks(chance: Chance) -> Sketch:
    """A body on parallel cranks of one length, more than it takes, in the plane or in space."""
    planar = chance.random() < 0.7
    sketch = Sketch(planar)
    body, turning = sketch.node((0, 0, 0)), sketch.turning()
    along, by = direction(chance, planar, 9), hair(chance, sketch, 0.4)
    number = chance.choice((2, 3, 3, 4)) if planar else chance.choice((3, 4, 5, 6))
    longer = chance.random() < 0.3
    for k, place in enumerate(apart(chance, number, planar)):
        end = body
        if any(place):
            end = sketch.node(place)
            sketch.arm(body, turning, end)
        crank = off(along, chance, planar, by * (k == 0))
        sketch.to_ground(end, plus(place, crank, chance.randint(1, 3) if longer else 1))
    return sketch


def loop(chance: Chance) -> Sketch:
    """Bodies in a loop with a hinge between each two: the axes in a special position or not."""
    sketch = Sketch(planar=False)
    corners, axes = _special_axes(chance)
    by = hair(chance, sketch, 0.5)
    number = len(corners)
    chosen = chance.randrange(number)
    axes[chosen] = off(axes[chosen], chance, False, by)
    places = [sketch.node(place) for place in corners]
    bodies = [sketch.turning() for _ in corners]
    keyword = chance.choice(("RBEAM", "PINBODY"))
    for k in range(number):
        after = (k + 1) % number
        if k:
            sketch.add(keyword, places[k], bodies[k], places[after])
        sketch.add("HINGE", bodies[k - 1], bodies[k], along=axes[k], release=_ABOUT)
    if chance.random() < 0.8:
        sketch.fix(bodies[0], places[0], places[1])
    else:
        sketch.arm(places[0], bodies[0], places[1])
    return sketch


def _special_axes(chance: Chance) -> tuple[list[Vector], list[Vector]]:
    """Corners of a loop and an axis in each."""
    kind = chance.randrange(6)
    number = (4, 4, 4, 6, 5, 6)[kind]
    corners = apart(chance, number, False)
    if kind == 0:
        # After Bennett: a skew quadrilateral that a half turn leaves, axes across its sides.
        a, b = apart(chance, 2, False)
        corners = [a, b, vector((-a[0], -a[1], a[2])), vector((-b[0], -b[1], b[2]))]
        axes = [
            outer(plus(corners[k - 1], place, -1), plus(corners[(k + 1) % 4], place, -1))
            for k, place in enumerate(corners)
        ]
    elif kind == 1:
        axes = [direction(chance, False)] * number
    elif kind == 2:
        axes = [plus((1, 30, -20), place, -1) for place in corners]
    elif kind == 3:
        # After Sarrus: three hinges along one direction, three along another.
        first, second = direction(chance, False), direction(chance, False)
        axes = [first] * 3 + [second] * 3
    else:
        axes = [direction(chance, False) for _ in corners]
    return corners, [each if any(each) else vector((1, 2, 3)) for each in axes]


def mixed(chance: Chance) -> Sketch:
    """A few elements of all kinds between points of whole numbers, with classes of all kinds."""
    planar = chance.random() < 0.4
    sketch = Sketch(planar)
    places = apart(chance, chance.randint(3, 7), planar, 3)
    points = [(sketch.node(place), sketch.turning()) for place in places]
    kinds = [keyword for keyword, kind in KINDS.items() if kind.planar == planar]
    for _ in range(chance.randint(2, 11)):
        keyword = chance.choice(kinds)
        p, q = chance.sample(points, 2)
        slots = KINDS[keyword].slots
        nodes = {
            "pp": (p[0], q[0]),
            "oo": (p[1], q[1]),
            "pop": (*p, q[0]),
            "popo": (*p, *q),
        }[slots]
        number = sketch.add(keyword, *nodes, along=_along(sketch, chance, keyword, (p[0], q[0])))
        every = range(1, KINDS[keyword].deformations + 1)
        free = chance.sample(every, chance.randint(0, len(every) - 1))
        sketch.deck.released |= {(number, each) for each in free}
    used = sketch.deck.slots
    for node in used:
        if chance.random() < 0.35:
            sketch.fix(node)
    sketch.deck.places = {node: at for node, at in sketch.deck.places.items() if node in used}
    return sketch


def _along(sketch: Sketch, chance: Chance, keyword: str, ends: tuple[int, int]) -> Vector | None:
    """A vector as the element needs it, not parallel to its chord."""
    if not KINDS[keyword].vector:
        return None
    along = direction(chance, False)
    if keyword in ("HINGE", "BEARING"):
        return along
    chord = plus(sketch.at(ends[1]), sketch.at(ends[0]), -1)
    if chance.random() < 0.4 or not any(outer(along, chord)):
        return None
    return along


def far_whole(chance: Chance) -> Sketch:
    """A joint on bars of whole numbers, far from the origin and all digits kept."""
    planar = chance.random() < 0.5
    sketch = Sketch(planar, plain=True)
    far = plus((0, 0, 0), whole(chance, planar), Fraction(10) ** chance.randint(3, 12))
    joint = sketch.node(far)
    along, by = direction(chance, planar), hair(chance, sketch)
    size = 2 if planar else 3
    by = max(by, Fraction(1, 10**4)) if by else by
    for k in range(size + chance.randint(-1, 1)):
        side = along if k < 2 else direction(chance, planar)
        factor = (1, -1, 1, 2)[k]
        sketch.to_ground(joint, plus(far, off(plus((0, 0, 0), side, factor), chance, planar, by)))
    return sketch
