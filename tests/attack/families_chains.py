# SPDX-License-Identifier: BSD-3-Clause
"""Chains whose joints pass a motion on, enlarged or not, closed exactly or off by a hair."""

from __future__ import annotations

import itertools
import math
from fractions import Fraction

from .exact_deck import Vector
from .families_frameworks import apart, direction, hair, off, whole
from .sketch import Chance, Sketch, between, plus, vector
from .truth import Counts


def two_wires(chance: Chance) -> Sketch:
    """Two bars to one joint, at an angle of ten to minus something."""
    planar = chance.random() < 0.6
    sketch = Sketch(planar)
    joint = sketch.node(whole(chance, planar, 3))
    along = direction(chance, planar)
    sketch.to_ground(joint, plus(sketch.at(joint), along))
    side = chance.choice((1, -1, Fraction(1, 2)))
    angle = hair(chance, sketch, 1.0)
    end = plus(sketch.at(joint), along, side)
    sketch.to_ground(joint, off(end, chance, planar, angle))
    return sketch


def long_digits(chance: Chance) -> Sketch:
    """Two bars on a line or not, typed with more digits than a double has."""
    sketch = Sketch(planar=True, plain=True, long=True)
    by = Fraction(chance.randint(1, 9), 10 ** chance.randint(16, 24))
    along = (1, Fraction(chance.randint(1, 9), 2))
    joint = sketch.node((chance.randint(1, 3), chance.randint(1, 3)))
    sketch.to_ground(joint, plus(sketch.at(joint), along))
    end = plus(sketch.at(joint), along, -1)
    sketch.to_ground(joint, plus(end, (0, 1), by if chance.random() < 0.8 else 0))
    return sketch


def collinear(chance: Chance) -> Sketch:
    """Bars on a line, fixed at both ends."""
    planar = chance.random() < 0.6
    sketch = Sketch(planar)
    number = chance.randint(2, 14)
    start, along = whole(chance, planar), direction(chance, planar, 9)
    parts = sorted(chance.sample(range(1, 60), number + 1))
    nodes = [sketch.node(plus(start, along, Fraction(part, 20))) for part in parts]
    sketch.bars(itertools.pairwise(nodes))
    sketch.fix(nodes[0], nodes[-1])
    return sketch


def graded(chance: Chance) -> Sketch:
    """Braced chains whose lengths grow by powers of ten."""
    planar = chance.random() < 0.7
    sketch = Sketch(planar)
    size, step = (2, 3)[not planar], Fraction(10) ** chance.randint(1, 4)
    nodes = [sketch.node(place, fixed=True) for place in apart(chance, size, planar, 2)]
    length = Fraction(1)
    for _ in range(chance.randint(2, 12)):
        length *= step if length < 10**12 else 1
        joint = sketch.node(plus(sketch.at(nodes[-1]), direction(chance, planar), length))
        sketch.bars((joint, end) for end in nodes[-size:])
        nodes.append(joint)
    extra = chance.randrange(3)
    if extra == 1:
        sketch.bar(nodes[-1], nodes[0])
    if extra == 2:
        last = sketch.at(nodes[-1])
        flat = between(last, sketch.at(nodes[-2]), Fraction(chance.randint(2, 5)))
        joint = sketch.node(flat)
        sketch.bars((joint, end) for end in nodes[-size:])
    return sketch


def staircase(chance: Chance) -> Sketch:
    """Joints that each enlarge the motion of the last by a power of ten, one of them driven.

    The first joint moves along x, the next ones along y and x by turns: a bar that is off the
    line of the link by a step leads each. The end is held by nothing, by a bar at the first
    joint, or by a loop that closes exactly, or but for a hair of what it would take.
    """
    sketch = Sketch(planar=True, plain=True)
    number, power = chance.randint(3, 8), chance.randint(3, 10)
    same = chance.random() < 0.5
    steps = [_step(chance, power, same) for _ in range(number - 1)]
    places = [vector(((k + 1) // 2, k // 2)) for k in range(number)]
    joints = [sketch.node(place) for place in places]
    sketch.to_ground(joints[0], plus(places[0], (0, 1)))
    motions = [vector((1, 0))]
    for k in range(1, number):
        step = steps[k - 1]
        level = k % 2 == 1
        sketch.bar(joints[k - 1], joints[k])
        sketch.to_ground(joints[k], plus(places[k], (-1, step) if level else (-step, 1)))
        speed = motions[-1][0] if level else motions[-1][1]
        motions.append(vector((speed, speed / step) if level else (speed / step, speed)))
    _close(sketch, chance, joints, motions)
    return sketch


def _step(chance: Chance, power: int, same: bool) -> Fraction:
    if same:
        return Fraction(1, 10**power)
    # Inverses that end: motions stay decimals.
    return Fraction(chance.choice((1, 2, 4, 5, 8)), 10 ** max(1, power + chance.randint(-3, 1)))


def _close(sketch: Sketch, chance: Chance, joints: list[int], motions: list[Vector]) -> None:
    kind = chance.randrange(4)
    first, last = sketch.at(joints[0]), sketch.at(joints[-1])
    if kind == 0:
        sketch.to_ground(joints[0], plus(first, (-1, 0)))
    elif kind > 1:
        # The corner moves along x as one joint does and along y as the other.
        corner = sketch.node((last[0], 0) if last[0] > 0 else (1, 0))
        if sketch.at(corner)[1] == last[1]:
            return
        sketch.bars(((corner, joints[0]), (corner, joints[-1])))
        miss = Fraction(chance.randint(1, 9), 10 ** chance.randint(1, 6)) * (kind - 2)
        slope = motions[0][0] / motions[-1][1] * (1 + miss)
        sketch.to_ground(corner, plus(sketch.at(corner), (-1, slope), chance.choice((1, -1))))


def mirrored(chance: Chance) -> Sketch:
    """A staircase and its mirror image, driven as one, with a bar between the last joints."""
    sketch = Sketch(planar=True, plain=True)
    number, power = chance.randint(2, 5), chance.randint(2, 8)
    steps = [_step(chance, power, False) for _ in range(number)]
    off_by = chance.choice((0, 0, 1, 1, 1)) * Fraction(1, 10 ** chance.randint(1, 12))
    middle = sketch.node((0, 0))
    sketch.to_ground(middle, (0, 1))
    ends = []
    for side in (1, -1):
        # The first link slants, and its joint is led along x.
        place = vector((side, 1))
        before = sketch.node(place)
        sketch.bar(middle, before)
        sketch.to_ground(before, plus(place, (0, 1)))
        for k, step in enumerate(steps):
            exact = step * (1 + (off_by if side < 0 and k == number // 2 else 0))
            upright = k % 2 == 1
            place = plus(place, (0, 1) if upright else (side, 0))
            joint = sketch.node(place)
            sketch.to_ground(joint, plus(place, (-side * exact, 1) if upright else (side, exact)))
            sketch.bar(before, joint)
            before = joint
        ends.append(before)
    sketch.bar(*ends)
    return sketch


def levers(chance: Chance) -> Sketch:
    """Levers on levers in storeys; the last is linked to a lever that the first drives."""
    sketch = Sketch(planar=True)
    storeys = chance.randint(2, 5)
    turns, x = Fraction(1), Fraction(0)
    pivot, body = sketch.node((0, 0), fixed=True), sketch.turning()
    first = body
    by = hair(chance, sketch)
    for level in range(1, storeys + 1):
        short = Fraction(chance.choice((1, 2, 5)), 10 ** chance.randint(0, 5))
        long = Fraction(chance.choice((-4, -1, 1, 2, 5)))
        end = sketch.node((x + long, level - 1))
        sketch.arm(pivot, body, end)
        x, turns = x + long - short, turns * long / short
        pivot, body = sketch.node((x, level), fixed=True), sketch.turning()
        start = sketch.node((x + short, level))
        sketch.arm(pivot, body, start)
        sketch.bar(end, start)
    if chance.random() < 0.4:
        sketch.add("PLHINGE", first, sketch.turning(fixed=True))
        return sketch
    # A link up from the first lever, at an arm that moves it as far as the last one does.
    foot = x / (1 - turns) * -turns if turns != 1 else Fraction(1)
    if foot in (0, x):
        return sketch
    low = sketch.node((foot * (1 + by), 0))
    high = sketch.node((foot, storeys))
    sketch.arm(sketch.deck.elements[1].nodes[0], first, low)
    sketch.arm(pivot, body, high)
    sketch.bar(low, high)
    return sketch


def ring(chance: Chance) -> Sketch:
    """Joints in a ring that each slide; the last path closes the ring, exactly or by a hair."""
    sketch = Sketch(planar=True)
    number = chance.randint(3, 14)
    places = apart(chance, number, True, 12)
    joints = [sketch.node(place) for place in places]
    by = hair(chance, sketch)
    motion = first = direction(chance, True)
    _lead(sketch, joints[0], motion, by * 0)
    for k in range(1, number):
        link = plus(places[k], places[k - 1], -1)
        speed = link[0] * motion[0] + link[1] * motion[1]
        if k < number - 1:
            path = direction(chance, True)
            along = link[0] * path[0] + link[1] * path[1]
            motion = vector(part * speed / along for part in path) if along else motion
        else:
            motion = _meets(link, speed, plus(places[0], places[k], -1), first) or motion
        _lead(sketch, joints[k], motion, by * (k == number - 1))
    sketch.bars(zip(joints, joints[1:] + joints[:1], strict=True))
    return sketch


def _meets(a: Vector, speed: Fraction, b: Vector, other: Vector) -> Vector | None:
    """What moves along a with a speed, and along b as the other does."""
    determinant = a[0] * b[1] - a[1] * b[0]
    if not determinant:
        return None
    along = b[0] * other[0] + b[1] * other[1]
    return vector(
        ((speed * b[1] - along * a[1]) / determinant, (along * a[0] - speed * b[0]) / determinant)
    )


def _lead(sketch: Sketch, joint: int, motion: Vector, by: Fraction) -> None:
    """A bar to the ground across the motion of a joint."""
    size = max(map(abs, motion)) or Fraction(1)
    across = vector((-motion[1] / size + by, motion[0] / size)) if any(motion) else vector((1, 1))
    sketch.to_ground(joint, plus(sketch.at(joint), across))


def polygon(chance: Chance) -> Sketch:
    """A regular polygon whose corners slide in and out: with an even number, all by turns."""
    number = chance.randint(3, 14)
    even = int(number % 2 == 0)
    sketch = Sketch(planar=True, meant=Counts(even, even))
    joints = []
    for k in range(number):
        angle = 2 * math.pi * k / number
        c, s = Fraction(math.cos(angle)), Fraction(math.sin(angle))
        joints.append(sketch.node((c, s)))
        sketch.to_ground(joints[-1], (c - s, s + c))
    sketch.bars(zip(joints, joints[1:] + joints[:1], strict=True))
    return sketch
