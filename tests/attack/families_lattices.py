# SPDX-License-Identifier: BSD-3-Clause
"""Mechanisms on lattices of decimals: ties of components, joints without orientation, hinges."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from .exact_deck import KINDS, Vector
from .families_frameworks import hair, off
from .sketch import Chance, Sketch, outer, plus, vector

#: Steps of the lattices, hardly any of which is a double.
_STEPS = tuple(Fraction(part, 100) for part in (1, 2, 5, 10, 20))
#: Deformations of which each has a partner along the other axis across the element.
_PAIRED = {"BEAM": (3, 4, 5, 6), "RBEAM": (2, 3), "PINBODY": (2, 3), "HINGE": (2, 3)}
_AXES = (vector((1, 0, 0)), vector((0, 1, 0)), vector((0, 0, 1)))
#: Of `units`: 1 m in metres, millimetres and micrometres.
UNITS = (Fraction(1), Fraction(1000), Fraction(10**6))


def _point(chance: Chance, step: Fraction, planar: bool = False) -> Vector:
    x, y, z = (step * chance.randint(-12, 12) for _ in range(3))
    return vector((x, y, 0 if planar else z))


def _tied(chance: Chance) -> Vector:
    """A direction whose two smallest components are equal in size, or one unit apart."""
    low = chance.randint(0, 4)
    parts = [low, low + chance.choice((0, 0, 0, 1)), low + chance.randint(1, 5)]
    chance.shuffle(parts)
    return vector(part * chance.choice((1, -1)) for part in parts)


def _some(chance: Chance, keyword: str) -> list[int]:
    """Deformations to release: one of a pair more often than not."""
    every = range(1, KINDS[keyword].deformations + 1)
    if keyword in _PAIRED and chance.random() < 0.8:
        return chance.sample(_PAIRED[keyword], chance.choice((1, 1, 2)))
    return chance.sample(every, chance.randint(0, min(3, len(every) - 1)))


def _bars_to_ground(sketch: Sketch, chance: Chance, nodes: list[int], step: Fraction) -> None:
    """As many as there are columns without a row, or one more or less."""
    deck = sketch.deck
    rows = sum(each.kind.deformations for each in deck.elements.values()) - len(deck.released)
    wanted = max(0, len(deck.columns()) - rows + chance.choice((-1, 0, 0, 0, 1)))
    for _ in range(min(wanted, 12)):
        node = chance.choice(nodes)
        along = chance.choice(_AXES[:2] if sketch.planar else (*_AXES, *_AXES, _tied(chance)))
        sketch.to_ground(node, plus(sketch.at(node), along, 20 * step * chance.choice((1, -1))))


def ties(chance: Chance) -> Sketch:
    """Rows of beams, arms and hinges without vectors whose default axes tie, on bars."""
    sketch, step = Sketch(planar=False, plain=True), chance.choice(_STEPS)
    node, turning = sketch.node(_point(chance, step), fixed=True), sketch.turning(fixed=True)
    moving = []
    for _ in range(chance.randint(1, 3)):
        keyword = chance.choice(("BEAM", "BEAM", "RBEAM", "PINBODY"))
        if chance.random() < 0.3:
            after = sketch.turning()
            free = _some(chance, "HINGE")
            sketch.add("HINGE", turning, after, along=_tied(chance), release=free)
            turning = after
        end = sketch.node(plus(sketch.at(node), _tied(chance), step))
        after = sketch.turning() if keyword == "BEAM" else turning
        ends = (end, after) if keyword == "BEAM" else (end,)
        sketch.add(keyword, node, turning, *ends, release=_some(chance, keyword))
        node, turning = end, after
        moving.append(end)
    _bars_to_ground(sketch, chance, moving, step)
    return sketch


def joints(chance: Chance) -> Sketch:
    """Beams that share position nodes, and orientation nodes not always: ball joints, pivots."""
    planar = chance.random() < 0.3
    sketch, step = Sketch(planar), chance.choice(_STEPS)
    by = hair(chance, sketch, 0.3)
    places = list({_point(chance, step, planar): None for _ in range(chance.randint(2, 5))})
    places[-1] = off(places[-1], chance, planar, by * step)
    nodes = [sketch.node(place, fixed=chance.random() < 0.35) for place in places]
    turnings: dict[int, list[int]] = {node: [] for node in nodes}

    def turned(node: int) -> int:
        """An orientation at a point: one that is there, or a new one, loose or on a hinge."""
        there, kind = turnings[node], chance.random()
        if there and kind < 0.4:
            return chance.choice(there)
        made = sketch.turning(fixed=chance.random() < 0.2)
        if there and kind < 0.7:
            keyword = "PLHINGE" if planar else "HINGE"
            along = None if planar else _tied(chance)
            free = [] if planar else chance.choice(((1,), (1, 2), (3,)))
            sketch.add(keyword, chance.choice(there), made, along=along, release=free)
        there.append(made)
        return made

    for _ in range(chance.randint(2, 6) if len(nodes) > 1 else 0):
        p, q = chance.sample(nodes, 2)
        if chance.random() < 0.2:
            sketch.bar(p, q)
            continue
        keyword = chance.choice(("PLBEAM", "PLRBEAM") if planar else ("BEAM", "BEAM", "RBEAM"))
        chord = plus(sketch.at(q), sketch.at(p), -1)
        along = None
        if not planar and chance.random() < 0.5 and any(outer(chord, _AXES[2])):
            along = outer(chord, _AXES[2])
        first = turned(p)
        ends = (q, turned(q)) if KINDS[keyword].slots == "popo" else (q,)
        sketch.add(keyword, p, first, *ends, along=along, release=_some(chance, keyword))
    used = sketch.deck.slots
    moving = [node for node in nodes if node in used and (node, 0) not in sketch.deck.held]
    if moving:
        _bars_to_ground(sketch, chance, moving, step)
    used = sketch.deck.slots
    sketch.deck.places = {node: at for node, at in sketch.deck.places.items() if node in used}
    sketch.deck.held = {(node, axis) for node, axis in sketch.deck.held if node in used}
    if not sketch.deck.elements:
        sketch.bar(sketch.node((0, 0, 0), fixed=True), sketch.node((1, 0, 0)))
    return sketch


def hinged(chance: Chance) -> Sketch:
    """Bodies that hang on hinges at points of other bodies, a wire or a sheet at the last."""
    sketch, step = Sketch(planar=False), chance.choice(_STEPS)
    by = hair(chance, sketch, 0.3)
    node, turning = sketch.node(_point(chance, step), fixed=True), sketch.turning(fixed=True)
    points = []
    for _ in range(chance.randint(1, 4)):
        if chance.random() < 0.8:
            after = sketch.turning()
            axis = off(_tied(chance), chance, False, by)
            free = chance.choice(((1,), (1,), (1, 2), (2,), (1, 2, 3)))
            keyword = "HINGE"
            sketch.add(keyword, turning, after, along=axis, release=free)
            turning = after
        end = sketch.node(plus(sketch.at(node), _tied(chance), step))
        if chance.random() < 0.3:
            after = sketch.turning()
            sketch.add("BEAM", node, turning, end, after)
            turning = after
        else:
            sketch.add(chance.choice(("RBEAM", "PINBODY")), node, turning, end)
        points.append(end)
        node = end
    if chance.random() < 0.4:
        leg = _tied(chance)
        foot = sketch.node(plus(sketch.at(node), leg, step), fixed=True), sketch.turning(fixed=True)
        across = outer(leg, (1, 3, -2))
        own = turning if chance.random() < 0.5 else sketch.turning()
        along = across if any(across) and chance.random() < 0.5 else None
        sketch.add("BEAM", node, own, *foot, along=along, release=_some(chance, "BEAM"))
    _bars_to_ground(sketch, chance, points, step)
    return sketch


#: What `units` draws.
_ALIKE: tuple[Callable[[Chance], Sketch], ...] = (ties, ties, joints, hinged)


def units(chance: Chance) -> Sketch:
    """One of the others, of which the same is said in any unit, wherever it stands."""
    bare = Chance(chance.random())
    bare.hairless = True
    sketch = chance.choice(_ALIKE)(bare)
    sketch.hairy, sketch.plain, sketch.alike = False, True, True
    return sketch
