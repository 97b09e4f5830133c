# SPDX-License-Identifier: BSD-3-Clause
"""Mechanisms drawn with exact fractions, node by node."""

from __future__ import annotations

import random
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

from .exact_deck import Deck, Element, Vector
from .truth import Counts

Real: TypeAlias = Fraction | int
Place: TypeAlias = tuple[Real, Real] | tuple[Real, Real, Real]


def vector(place: Iterable[Real]) -> Vector:
    """Two or three components as fractions."""
    x, y, *z = (Fraction(part) for part in place)
    return x, y, z[0] if z else Fraction(0)


def plus(a: Place, b: Place, factor: Real = 1) -> Vector:
    """a + factor * b."""
    (x, y, z), (u, v, w) = vector(a), vector(b)
    return x + factor * u, y + factor * v, z + factor * w


def between(a: Place, b: Place, part: Real) -> Vector:
    """The point at a part of the way from a to b."""
    return plus(a, plus(b, a, -1), part)


def outer(a: Place, b: Place) -> Vector:
    """The vector product."""
    (x, y, z), (u, v, w) = vector(a), vector(b)
    return y * w - z * v, z * u - x * w, x * v - y * u


class Chance(random.Random):
    """Random choices; `hairless` makes the same ones and leaves out what is a hair."""

    hairless = False


@dataclass
class Sketch:
    """A deck under construction, and what it was meant to be.

    Attributes:
        deck: The deck so far, exact.
        planar: Whether its elements are those of the plane.
        hairy: Whether it is off a special position by a hair, which digits may not show.
        meant: Counts that are meant, where the fractions themselves are rounded.
        plain: Whether it is to be typed as it is, every digit of it.
        long: Whether that may be more digits than a double has.
        alike: Whether the same is to be said of it in other units, and elsewhere.
    """

    planar: bool
    hairy: bool = False
    meant: Counts | None = None
    plain: bool = False
    long: bool = False
    alike: bool = False
    _numbers: int = 0

    def __post_init__(self) -> None:
        self.deck = Deck()

    def node(self, place: Place, fixed: bool = False) -> int:
        """A position node."""
        number = self._next()
        self.deck.places[number] = vector(place)
        if fixed:
            self.fix(number)
        return number

    def turning(self, fixed: bool = False) -> int:
        """An orientation node."""
        number = self._next()
        if fixed:
            self.fix(number)
        return number

    def fix(self, *nodes: int) -> None:
        """Hold all coordinates of nodes."""
        self.deck.held |= {(node, axis) for node in nodes for axis in range(3)}

    def at(self, node: int) -> Vector:
        """Where a node is."""
        return self.deck.places[node]

    def add(
        self,
        keyword: str,
        *nodes: int,
        along: Place | None = None,
        release: Iterable[int] = (),
    ) -> int:
        """An element; its number."""
        number = len(self.deck.elements) + 1
        chosen = None if along is None else vector(along)
        self.deck.elements[number] = Element(keyword, nodes, chosen)
        self.deck.released |= {(number, each) for each in release}
        return number

    def bar(self, p: int, q: int) -> None:
        """A bar between two position nodes."""
        self.add("PLTRUSS" if self.planar else "TRUSS", p, q)

    def bars(self, pairs: Iterable[tuple[int, int]]) -> None:
        """Several bars."""
        for p, q in pairs:
            self.bar(p, q)

    def to_ground(self, node: int, place: Place) -> int:
        """A bar from a node to a fixed point."""
        end = self.node(place, fixed=True)
        self.bar(node, end)
        return end

    def arm(self, body: int, turning: int, end: int) -> None:
        """A point that belongs to a rigid body."""
        self.add("PLRBEAM" if self.planar else "RBEAM", body, turning, end)

    def take_in(self, other: Sketch, scale: Real, shift: Place) -> None:
        """Draw another mechanism beside this one, in another size."""
        node, element = self._numbers, len(self.deck.elements)
        self._numbers += other._numbers
        for label, each in other.deck.elements.items():
            nodes = tuple(node + end for end in each.nodes)
            self.deck.elements[element + label] = each._replace(nodes=nodes)
        for label, place in other.deck.places.items():
            self.deck.places[node + label] = plus(shift, place, scale)
        self.deck.held |= {(node + label, axis) for label, axis in other.deck.held}
        self.deck.released |= {(element + label, part) for label, part in other.deck.released}
        self.hairy |= other.hairy

    def _next(self) -> int:
        self._numbers += 1
        return self._numbers
