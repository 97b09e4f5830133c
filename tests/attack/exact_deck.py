# SPDX-License-Identifier: BSD-3-Clause
"""A deck with its numbers as they are typed: fractions, of which nothing is rounded."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple

Vector = tuple[Fraction, Fraction, Fraction]
#: A node and an axis, or an element and a deformation.
Label = tuple[int, int]

ZERO = Fraction(0)
ORIGIN: Vector = (ZERO, ZERO, ZERO)
AXES: tuple[Vector, ...] = tuple(
    (Fraction(i == 0), Fraction(i == 1), Fraction(i == 2)) for i in range(3)
)


class Kind(NamedTuple):
    """What a keyword means: one letter a node, position or orientation, and the deformations."""

    slots: str
    deformations: int
    planar: bool = False
    vector: bool = False


KINDS = {
    "TRUSS": Kind("pp", 1),
    "BEAM": Kind("popo", 6, vector=True),
    "RBEAM": Kind("pop", 3, vector=True),
    "PINBODY": Kind("pop", 3),
    "HINGE": Kind("oo", 3, vector=True),
    "BEARING": Kind("popo", 6, vector=True),
    "PLTRUSS": Kind("pp", 1, planar=True),
    "PLBEAM": Kind("popo", 3, planar=True),
    "PLRBEAM": Kind("pop", 2, planar=True),
    "PLHINGE": Kind("oo", 1, planar=True),
}
SYNONYMS = {"BEAMNL": "BEAM", "PLBEAMNL": "PLBEAM", "PLTOR": "PLHINGE"}
#: Statements that take coordinates out of D(c).
_HELD = ("FIX", "DYNX", "INPUTX")


class Element(NamedTuple):
    """One element; the vector is what follows the nodes, None where nothing does."""

    keyword: str
    nodes: tuple[int, ...]
    vector: Vector | None = None

    @property
    def kind(self) -> Kind:
        """What its keyword means."""
        return KINDS[self.keyword]

    @property
    def positions(self) -> list[int]:
        """Its position nodes."""
        every = zip(self.nodes, self.kind.slots, strict=True)
        return [node for node, slot in every if slot == "p"]


@dataclass
class Deck:
    """The kinematics of a deck.

    Attributes:
        elements: by number.
        places: position of each position node that has one; the rest stand in the origin.
        held: (node, axis) of coordinates that are no columns of D(c); axes are 0, 1, 2.
        released: (element, deformation) of those that are no rows; deformations count from 1.
    """

    elements: dict[int, Element] = field(default_factory=dict)
    places: dict[int, Vector] = field(default_factory=dict)
    held: set[Label] = field(default_factory=set)
    released: set[Label] = field(default_factory=set)

    @property
    def planar(self) -> bool:
        """Whether its elements are those of the plane."""
        return all(element.kind.planar for element in self.elements.values())

    @property
    def slots(self) -> dict[int, str]:
        """`p` or `o` of each node, in the order in which elements name them."""
        return {
            node: slot
            for element in self.elements.values()
            for node, slot in zip(element.nodes, element.kind.slots, strict=True)
        }

    def axes(self, slot: str) -> tuple[int, ...]:
        """Axes on which a node has coordinates."""
        if self.planar:
            return (0, 1) if slot == "p" else (2,)
        return (0, 1, 2)

    def columns(self) -> dict[Label, int]:
        """(node, axis) of each dependent coordinate, and its column."""
        every = ((node, axis) for node, slot in self.slots.items() for axis in self.axes(slot))
        return {label: k for k, label in enumerate(each for each in every if each not in self.held)}

    def chord(self, element: Element) -> Vector:
        """From p to q; zero for an element without positions."""
        ends = [self.place(node) for node in element.positions]
        if len(ends) < 2:
            return ORIGIN
        (a, b, c), (d, e, f) = ends
        return d - a, e - b, f - c

    def place(self, node: int) -> Vector:
        """Where a position node is."""
        return self.places.get(node, ORIGIN)

    def stored(self) -> Deck:
        """The deck with the double nearest to each number."""
        elements = {
            number: each if each.vector is None else each._replace(vector=_stored(each.vector))
            for number, each in self.elements.items()
        }
        places = {node: _stored(place) for node, place in self.places.items()}
        return Deck(elements, places, self.held, self.released)


def read(text: str) -> Deck:
    """The kinematics of a deck that is sound.

    Raises:
        ValueError: something stands in it that this reader does not know.
    """
    deck = Deck()
    statements = _statements(text)
    for keyword, words in statements:
        if keyword in KINDS:
            _add_element(deck, keyword, words)
    slots, planar = deck.slots, deck.planar
    for keyword, words in statements:
        number, rest = int(words[0]), words[1:]
        if keyword == "X":
            deck.places[number] = _vector(rest)
        elif keyword in _HELD:
            deck.held |= _held(number, slots[number], planar, [int(word) for word in rest])
        elif keyword == "RLSE":
            every = range(1, deck.elements[number].kind.deformations + 1)
            deck.released |= {(number, int(word)) for word in rest or every}
        elif keyword not in (*KINDS, "DYNE", "INPUTE"):
            raise ValueError(f"unknown keyword {keyword}")
    return deck


def _statements(text: str) -> list[tuple[str, list[str]]]:
    found = []
    for line in text.splitlines():
        words = re.split("[%#]", line)[0].split()
        if not words or line.startswith("*"):
            continue
        keyword = words[0].upper()
        if keyword == "END":
            break
        found.append((SYNONYMS.get(keyword, keyword), words[1:]))
    return found


def _add_element(deck: Deck, keyword: str, words: list[str]) -> None:
    last = 1 + len(KINDS[keyword].slots)
    nodes = tuple(int(word) for word in words[1:last])
    vector = _vector(words[last:]) if words[last:] else None
    deck.elements[int(words[0])] = Element(keyword, nodes, vector)


def _vector(words: list[str]) -> Vector:
    x, y, *z = (Fraction(word.replace("D", "e").replace("d", "e")) for word in words)
    return x, y, z[0] if z else ZERO


def _stored(v: Vector) -> Vector:
    x, y, z = (Fraction(float(part)) for part in v)
    return x, y, z


def _held(node: int, slot: str, planar: bool, components: list[int]) -> set[Label]:
    """Coordinates that a statement names; those of an orientation in space count from lambda0."""
    if slot == "o" and planar:
        return {(node, 2)}
    first = 2 if slot == "o" else 1
    return {(node, each - first) for each in components} or {(node, axis) for axis in range(3)}
