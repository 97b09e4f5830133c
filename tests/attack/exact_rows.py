# SPDX-License-Identifier: BSD-3-Clause
"""Rows of D(c) of each element, each up to a factor, from its chord and vector by products alone.

So they are exact for fractions, and for residues of fractions modulo a prime. A frame ex, ey, ez
is kept as c, y, z of its directions: c the chord or axis, z = c x v of a vector v, y = z x c.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import TypeVar

from .exact_deck import AXES, ORIGIN, Deck, Element, Label, Vector

Number = TypeVar("Number", int, Fraction)
Triple = tuple[Number, Number, Number]
#: One block of three for each node slot of the element.
Row = tuple[Triple[Number], ...]


def cross(a: Triple[Number], b: Triple[Number]) -> Triple[Number]:
    """The vector product."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def minus(a: Triple[Number]) -> Triple[Number]:
    """The opposite."""
    return -a[0], -a[1], -a[2]


def times(factor: Number, a: Triple[Number]) -> Triple[Number]:
    """A multiple."""
    return factor * a[0], factor * a[1], factor * a[2]


def square(a: Triple[Number]) -> Number:
    """Its length squared."""
    return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]


def rows_of(
    deck: Deck, number: Callable[[Fraction], Number]
) -> Iterator[tuple[Label, tuple[int, ...], Row[Number]]]:
    """Each row of D(c): element and deformation, the nodes, and a block for each of these.

    Args:
        deck: The deck.
        number: What is reckoned with in place of a fraction.
    """

    def triple(v: Vector) -> Triple[Number]:
        return number(v[0]), number(v[1]), number(v[2])

    for label, element in deck.elements.items():
        chord, axis = triple(deck.chord(element)), triple(element.vector or ORIGIN)
        second = triple(second_vector(deck, element))
        for k, row in enumerate(rows(element.keyword, chord, axis, second), start=1):
            if (label, k) not in deck.released:
                yield (label, k), element.nodes, row


def second_vector(deck: Deck, element: Element) -> Vector:
    """What the y axis of its frame is to be near to: the vector given, or a global axis.

    The first of those along which the decimals of its direction are smallest.
    """
    if element.kind.planar or element.keyword == "TRUSS":
        return ORIGIN
    if element.keyword in ("HINGE", "BEARING"):
        first = element.vector or ORIGIN
    elif element.vector is not None:
        return element.vector
    else:
        first = deck.chord(element)
    return min(AXES, key=lambda axis: abs(sum(map(operator.mul, axis, first))))


def rows(
    keyword: str, chord: Triple[Number], axis: Triple[Number], second: Triple[Number]
) -> list[Row[Number]]:
    """The rows of one element, in the order of its deformations.

    Args:
        keyword: Its kind.
        chord: From p to q.
        axis: Of a hinge or bearing.
        second: What the y axis of the frame is near to.
    """
    none = times(chord[0] * 0, axis)
    if keyword in ("TRUSS", "PLTRUSS"):
        return [(minus(chord), chord)]
    if keyword == "BEAM":
        return _beam(chord, second, none)
    if keyword in ("RBEAM", "PINBODY"):
        return _arm(chord, _frame(chord, second))
    if keyword == "HINGE":
        return [(minus(f), f) for f in _frame(axis, second)]
    if keyword == "BEARING":
        frame = _frame(axis, second)
        moves: list[Row[Number]] = [(minus(f), cross(f, chord), f, none) for f in frame]
        turns: list[Row[Number]] = [(none, minus(f), none, f) for f in frame]
        return moves + turns
    return _planar(keyword, chord, none)


def _frame(c: Triple[Number], v: Triple[Number]) -> tuple[Triple[Number], ...]:
    """Directions of ex, ey and ez; the global axes where there is none."""
    if not any(c):
        one = c[0] * 0 + 1
        none = one - one
        return (one, none, none), (none, one, none), (none, none, one)
    z = cross(c, v)
    return c, cross(z, c), z


def _arm(c: Triple[Number], frame: tuple[Triple[Number], ...]) -> list[Row[Number]]:
    return [(minus(f), cross(f, c), f) for f in frame]


def _beam(c: Triple[Number], v: Triple[Number], none: Triple[Number]) -> list[Row[Number]]:
    _, y, z = _frame(c, v)
    turned = times(square(c), z)
    return [
        (minus(c), none, c, none),
        (none, minus(c), none, c),
        (z, minus(y), minus(z), none),
        (minus(z), none, z, y),
        (minus(y), minus(turned), y, none),
        (y, none, minus(y), turned),
    ]


def _planar(keyword: str, c: Triple[Number], none: Triple[Number]) -> list[Row[Number]]:
    zero = c[0] * 0
    if keyword == "PLHINGE":
        return [((zero, zero, zero - 1), (zero, zero, zero + 1))]
    n = (-c[1], c[0], zero)
    turn = (zero, zero, square(c))
    if keyword == "PLRBEAM":
        return [(minus(c), none, c), (minus(n), minus(turn), n)]
    return [
        (minus(c), none, c, none),
        (n, turn, minus(n), none),
        (minus(n), none, n, minus(turn)),
    ]
