# SPDX-License-Identifier: BSD-3-Clause
"""From a node or an element to where it is made, to where it is named, and to another number."""

from __future__ import annotations

import re
from typing import NamedTuple

from .deck import ELEMENT, Key
from .document import Edit, Position, Range
from .editor_deck import Deck

_LARGEST = 2**31 - 1
#: Statements that name nodes or elements among numbers that mean something else.
_MIXED = ("BEAMVIS", "TRUSSVIS", "INX", "OUTF", "OUTX", "OUTXP", "INPUTF")


class RenameError(ValueError):
    """A number that cannot be given."""


class Place(NamedTuple):
    """The node or the element at a position."""

    key: Key
    range: Range


def place_at(deck: Deck, position: Position) -> Place | None:
    """The node or the element whose number stands at a position."""
    position = deck.document.clamped(position)
    statement = deck.statements.at(position.line)
    word = statement.says.word_at(position.character)
    for one in statement.says.facts.references:
        if one.place == word:
            return Place((one.kind, one.number), statement.span(one.place))
    return None


def definition_at(deck: Deck, position: Position) -> list[Range]:
    """Where the element at a position is made, or the node has its X."""
    place = place_at(deck, position)
    return deck.index.definition(place.key) if place is not None else []


def references_at(deck: Deck, position: Position, with_own: bool = True) -> list[Range]:
    """All places of the node or element at a position."""
    place = place_at(deck, position)
    if place is None:
        return []
    every = deck.index.where(place.key)
    own = () if with_own else deck.index.definition(place.key)
    return [one for one in every if one not in own]


def rename_at(deck: Deck, position: Position, new: str) -> list[Edit]:
    """What gives the node or element at a position another number.

    Raises:
        RenameError: there is none, the number is none, or another one has it.
    """
    place = place_at(deck, position)
    if place is None:
        raise RenameError("there is no number of a node or of an element here")
    kind, old = place.key
    if not re.fullmatch(r"[1-9]\d{0,9}", new.strip()) or int(new) > _LARGEST:
        raise RenameError(f"a {kind} has a positive whole number, such as {deck.index.free(kind)}")
    number = int(new)
    if number == old:
        return []
    if (kind, number) in deck.index.made or (kind, number) in deck.index.named:
        article = "an" if kind == ELEMENT else "a"
        raise RenameError(
            f"there is {article} {kind} {number} already; {deck.index.free(kind)} is free"
        )
    mixed = next((line for line in _mixed(deck) if _holds(deck, line, old)), None)
    if mixed is not None:
        name = deck.index.facts[mixed].name
        raise RenameError(
            f"{name} in line {mixed + 1} has the number {old}, which may be this {kind}: change "
            "it there first"
        )
    return [Edit(where, str(number)) for where in deck.index.where(place.key)]


def _mixed(deck: Deck) -> list[int]:
    """Lines that name nodes or elements among other numbers."""
    return [line for line, one in enumerate(deck.index.facts) if one.name in _MIXED]


def _holds(deck: Deck, line: int, number: int) -> bool:
    return any(word.number == number for word in deck.statements.at(line).says.words[1:])
