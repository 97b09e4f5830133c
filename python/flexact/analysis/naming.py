# SPDX-License-Identifier: BSD-3-Clause
"""Nodes, coordinates and deformations as they are named in text."""

from __future__ import annotations

from ..core.elements import Dual, dual_table
from .advice_ways import Coordinate, Part
from .decomposition import Outcome
from .deformation_words import deformation_words
from .freedoms import Freedom
from .places import node_words, part_words
from .sentences import Named, Pieces, plain

_NUMBERS = (
    *("no", "one", "two", "three", "four", "five", "six"),
    *("seven", "eight", "nine", "ten", "eleven", "twelve"),
)


def part_in_words(result: Outcome, part: Part) -> Pieces:
    """A coordinate or a deformation."""
    if isinstance(part, Coordinate):
        return coordinate_in_words(result, part.node, part.name)
    return deformation_in_words(result, part.element, part.number)


def coordinate_in_words(result: Outcome, node: int, name: str) -> Pieces:
    """A coordinate of a node: such as "the stage along y" or "clamp 1 about x".

    Args:
        result: The result.
        node: Number of the node.
        name: Such as "y" or "rx".
    """
    way = f" about {name[1:]}" if name.startswith("r") else f" along {name}"
    return (named_node(result, node), way)


def named_node(result: Outcome, node: int) -> Named:
    """A node by its number, and by its body, the name of its point, or what is there."""
    return Named("node", node, node_words(result.parts, result.parts.data.node_index[node]))


def node_name(result: Outcome, index: int) -> str:
    """The name of the point of a node, by its index in `result.data`; empty without one."""
    place = result.parts.place_of(int(result.condensed.nodes[index]))
    return "" if place is None else result.parts.name_of_point(place)


def named_element(result: Outcome, element: int) -> Named:
    """An element by its number, and by the name of its part."""
    part = result.parts.of_element(result.given.element_index[element])
    return Named("element", element, part_words(part))


def deformation_in_words(result: Outcome, element: int, number: int) -> Pieces:
    """Deformation `number` of an element, both as a deck numbers them.

    Such as "sheet 1: in-plane bending at its clamp".
    """
    word = deformation_words(result, result.data.element_index[element], number)
    return (named_element(result, element), f": {word}")


def freedom_in_words(freedom: Freedom) -> Pieces:
    """A declared degree of freedom, such as "the stage along z"."""
    result, (kind, number) = freedom.analysis, freedom.owner
    if kind == "node":
        return coordinate_in_words(result, number, freedom.part)
    return deformation_in_words(result, number, freedom.place[0] + 1)


def motion_in_words(result: Outcome, number: int, freedom: Freedom | None) -> str:
    """Which motion it is: one that nothing determines, or that of a declared freedom."""
    if freedom is None:
        return f"motion {number} of {result.under_constrained}"
    return f"degree of freedom {number}, {plain(freedom_in_words(freedom))}"


def unit_of(result: Outcome, element: int, number: int) -> str:
    """The unit of the stress resultant of a deformation: N or N m."""
    kind = result.data.arrays.element_kind[result.data.element_index[element]]
    return "N" if dual_table()[kind, number - 1] == Dual.FORCE else "N m"


def unit_of_coordinate(name: str) -> str:
    """The unit of a coordinate of this name: m or rad."""
    return "rad" if name.startswith("r") else "m"


def counted(count: int, word: str, one: str, many: str) -> str:
    """A number and the word for what is counted, with its ending."""
    return f"{count} {word}{one if count == 1 else many}"


def counts_in_words(under: int, over: int) -> str:
    """By how much a mechanism is under- and over-constrained."""
    parts = [f"under-constrained by {under}"] * (under > 0)
    parts += [f"over-constrained by {over}"] * (over > 0)
    return " and ".join(parts) or "exactly constrained"


def in_words(count: int) -> str:
    """A number, as a word up to twelve."""
    return _NUMBERS[count] if count < len(_NUMBERS) else str(count)
