# SPDX-License-Identifier: BSD-3-Clause
"""Read a valid deck: the part of the deck language that the reference computation needs.

This reader is written for the reference values alone and shares nothing with flexact. It trusts its
input: a deck that it does not understand raises ``ValueError``; helpful messages are the business
of flexact itself.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

Label = tuple[int, str]
"""A node number and a coordinate, or an element number and a deformation."""


@dataclass(frozen=True)
class ElementType:
    """What a keyword of an element means.

    Attributes:
        slots: one letter per node, ``p`` position and ``o`` orientation.
        deformations: number of deformations.
        planar: whether the element lives in the xy plane.
        vector: whether three numbers may follow the nodes.
        free_axes: groups of deformations along or about axes that follow the global ones, not
            the element, so that a turned deck shares them out anew.
    """

    slots: str
    deformations: int
    planar: bool = False
    vector: bool = False
    free_axes: tuple[str, ...] = ()


#: By keyword; filled by `oracle_elements.element`.
ELEMENT_TYPES: dict[str, ElementType] = {}

CLASS_OF_COORDINATE = {
    "FIX": "fixed",
    "DYNX": "independent",
    "INPUTX": "independent",
}
CLASS_OF_DEFORMATION = {
    "RLSE": "dependent",
    "DYNE": "independent",
    "INPUTE": "independent",
}


@dataclass(frozen=True)
class Element:
    """One element: keyword, node numbers in slot order, and its y vector or axis if given."""

    keyword: str
    nodes: tuple[int, ...]
    vector: tuple[float, ...] = ()

    @property
    def type(self) -> ElementType:
        """The row of the table of elements."""
        return ELEMENT_TYPES[self.keyword]


@dataclass
class Deck:
    """The kinematics of a deck.

    Attributes:
        elements: element number to element, in the order of the deck.
        kinds: node number to ``p`` or ``o``, in the order in which elements name them.
        position: node number of a position to (x, y, z) in m; unset is the origin.
        coordinates: (node, coordinate) to fixed, dependent or independent; coordinates are
            x y z rx ry rz.
        deformations: (element, deformation) to the same; deformations count from "1".
        planar: whether all elements are planar.
    """

    elements: dict[int, Element] = field(default_factory=dict)
    kinds: dict[int, str] = field(default_factory=dict)
    position: dict[int, tuple[float, float, float]] = field(default_factory=dict)
    coordinates: dict[Label, str] = field(default_factory=dict)
    deformations: dict[Label, str] = field(default_factory=dict)
    planar: bool = False

    def axes(self, node: int) -> tuple[str, ...]:
        """Names of the coordinates of a node."""
        if self.planar:
            return ("x", "y") if self.kinds[node] == "p" else ("rz",)
        return ("x", "y", "z") if self.kinds[node] == "p" else ("rx", "ry", "rz")


def number(word: str) -> float:
    """A number of a deck, in which D may stand for the E of the exponent."""
    return float(re.sub("[dD]", "e", word))


def kinematic_statements(text: str) -> list[tuple[int, list[str]]]:
    """Statements before the first END.

    Returns:
        pairs of a line's index (from 0) and its words, keyword in upper case, without comments.
    """
    statements = []
    for index, line in enumerate(text.splitlines()):
        words = re.split("[%#]", line)[0].split()
        if not words or line.startswith("*"):
            continue
        keyword = words[0].upper()
        if keyword == "END":
            break
        if keyword != "OUTLEVEL":
            statements.append((index, [keyword, *words[1:]]))
    return statements


def read_deck(text: str) -> Deck:
    """Read the kinematics of a deck.

    Raises:
        ValueError: something stands in the deck that this reader does not know.
    """
    deck = Deck()
    statements = [words for _, words in kinematic_statements(text)]
    for keyword, *operands in statements:
        if keyword in ELEMENT_TYPES:
            _add_element(deck, keyword, operands)
    planar = {element.type.planar for element in deck.elements.values()}
    if len(planar) != 1:
        raise ValueError("a deck is planar or spatial, not both, and has elements")
    deck.planar = planar.pop()
    _start_classes(deck)
    for keyword, *operands in statements:
        if keyword == "X":
            _set_position(deck, operands)
        elif keyword in CLASS_OF_COORDINATE:
            _classify_coordinates(deck, CLASS_OF_COORDINATE[keyword], operands)
        elif keyword in CLASS_OF_DEFORMATION:
            _classify_deformations(deck, CLASS_OF_DEFORMATION[keyword], operands)
        elif keyword not in ELEMENT_TYPES:
            raise ValueError(f"unknown keyword {keyword}")
    return deck


def _add_element(deck: Deck, keyword: str, operands: list[str]) -> None:
    kind = ELEMENT_TYPES[keyword]
    label, last = int(operands[0]), 1 + len(kind.slots)
    nodes = tuple(int(word) for word in operands[1:last])
    vector = tuple(number(word) for word in operands[last:])
    if label in deck.elements or len(nodes) != len(kind.slots):
        raise ValueError(f"{keyword} {label}: stands twice, or lacks nodes")
    if vector and (not kind.vector or len(vector) != 3):
        raise ValueError(f"{keyword} {label}: wrong number of operands")
    for node, slot in zip(nodes, kind.slots, strict=True):
        if deck.kinds.setdefault(node, slot) != slot:
            raise ValueError(f"node {node} is both a position and an orientation")
    deck.elements[label] = Element(keyword, nodes, vector)


def _start_classes(deck: Deck) -> None:
    for node, kind in deck.kinds.items():
        if kind == "p":
            deck.position[node] = (0.0, 0.0, 0.0)
        for axis in deck.axes(node):
            deck.coordinates[node, axis] = "dependent"
    for label, element in deck.elements.items():
        for deformation in range(1, element.type.deformations + 1):
            deck.deformations[label, str(deformation)] = "fixed"


def _set_position(deck: Deck, operands: list[str]) -> None:
    node, values = int(operands[0]), [number(word) for word in operands[1:]]
    if deck.kinds.get(node) != "p" or len(values) != (2 if deck.planar else 3):
        raise ValueError(f"X {node}: not a position node, or not all of its coordinates")
    deck.position[node] = (values[0], values[1], values[2] if len(values) == 3 else 0.0)


def _classify_coordinates(deck: Deck, name: str, operands: list[str]) -> None:
    node, *components = [int(word) for word in operands]
    axes = deck.axes(node)
    # an orientation in space counts its components from lambda0, which is no coordinate
    first = 2 if len(axes) == 3 and deck.kinds[node] == "o" else 1
    chosen = [axes[component - first] for component in components] if components else axes
    if any(component < first for component in components):
        raise ValueError(f"node {node}: lambda0 is no coordinate of its own")
    for axis in chosen:
        _classify(deck.coordinates, (node, axis), name)


def _classify_deformations(deck: Deck, name: str, operands: list[str]) -> None:
    element, *components = [int(word) for word in operands]
    count = deck.elements[element].type.deformations
    for component in components or range(1, count + 1):
        _classify(deck.deformations, (element, str(component)), name)


def _classify(classes: dict[Label, str], label: Label, name: str) -> None:
    start = "fixed" if name == "dependent" or label[1].isdigit() else "dependent"
    if label not in classes or classes[label] not in (start, name):
        raise ValueError(f"{label}: does not exist, or is {classes.get(label)} and {name}")
    classes[label] = name
