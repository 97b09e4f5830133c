# SPDX-License-Identifier: BSD-3-Clause
"""Nodes, coordinates and deformations as they are named in text."""

from __future__ import annotations

from ..advice.advice import Coordinate, Deformation, Part
from ..base.plain_text import harmless
from ..core.elements import Dual, dual_table
from ..result.result import Result
from .deformation import deformation_word
from .sentences import Named, Pieces

_NUMBERS = (
    *("no", "one", "two", "three", "four", "five", "six"),
    *("seven", "eight", "nine", "ten", "eleven", "twelve"),
)


def part_in_words(part: Part) -> Pieces:
    """A coordinate or a deformation."""
    if isinstance(part, Coordinate):
        return (Named("node", part.node), f" {part.name}")
    return _deformation(part)


def deformation_in_words(result: Result, element: int, number: int) -> Pieces:
    """Deformation `number` of an element, both as a deck numbers them."""
    index = result.data.element_index[element]
    kind = int(result.data.arrays.element_kind[index])
    return _deformation(Deformation(element, result.data.element_names[index], kind, number))


def _deformation(part: Deformation) -> Pieces:
    word = deformation_word(part.kind, part.number)
    named, *called = _with_name("element", part.element, part.name)
    return (named, f"{''.join(map(str, called))} e{part.number} {word}")


def node_name(result: Result, index: int) -> str:
    """What a node is called; empty where it has no name."""
    return ""


def node_in_words(result: Result, number: int) -> Pieces:
    """A node by its number, and its name."""
    return _with_name("node", number, node_name(result, result.data.node_index[number]))


def element_in_words(result: Result, number: int) -> Pieces:
    """An element by its number, and its name."""
    name = result.data.element_names[result.data.element_index[number]]
    return _with_name("element", number, name)


def _with_name(kind: str, number: int, name: str) -> Pieces:
    called = (f" ({harmless(name)})",) if name else ()
    return (Named(kind, number), *called)


def unit_of(result: Result, element: int, number: int) -> str:
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
