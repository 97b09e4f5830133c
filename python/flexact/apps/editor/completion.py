# SPDX-License-Identifier: BSD-3-Clause
"""What may stand at a position: keywords, numbers of nodes and elements, components."""

from __future__ import annotations

import re
from collections.abc import Iterator
from enum import Enum
from typing import NamedTuple

from ...core.elements import element_kinds
from ...deck.keywords import (
    ENDINGS,
    WITH_WARPING,
    Block,
    Keyword,
    element_of,
    form_of,
    keywords,
    operands_of,
    words_of,
)
from ...model.attributes import CrossSection
from .deck import ELEMENT, NODE, Deck, slots_of
from .document import Position, Range
from .hover import keyword_words
from .names import components_of_element, components_of_node, designers_words, kind_words
from .statements import Statement

#: How many numbers are offered at once.
_MOST = 200


class Kind(str, Enum):
    """What is offered."""

    KEYWORD = "keyword"
    NUMBER = "number"
    COMPONENT = "component"
    WORD = "word"


class Offer(NamedTuple):
    """Something that may stand there.

    Attributes:
        label: What is shown and written.
        kind: What it is.
        detail: A few words beside it.
        snippet: A snippet in its place, with placeholders; empty without one.
        about: More about it, as Markdown.
    """

    label: str
    kind: Kind
    detail: str = ""
    snippet: str = ""
    about: str = ""


class Offers(NamedTuple):
    """All offers for the word that stands there so far."""

    range: Range
    """What an offer takes the place of."""
    offers: tuple[Offer, ...]
    is_complete: bool = True


def complete_at(deck: Deck, position: Position) -> Offers:
    """What may stand at a position; nothing in a comment."""
    position = deck.document.clamped(position)
    statement = deck.statements.at(position.line)
    says, at = statement.says, position.character
    place = says.word_at(at)
    start, end = at, at
    if place is not None:
        start, end = says.words[place].first, says.words[place].last
    range_ = Range.within(position.line, start, end)
    if at > says.mark or deck.document.bare[position.line].startswith("*"):
        return Offers(range_, ())
    before = sum(word.last < at for word in says.words)
    if before == 0 and place in (None, 0):
        return Offers(range_, tuple(_keywords(says.block)))
    place = place if place is not None else before
    typed = says.words[place].text[: at - start] if place < len(says.words) else ""
    found = list(_operands(deck, statement, place, typed))
    return Offers(range_, tuple(found[:_MOST]), len(found) <= _MOST)


def _keywords(block: Block) -> Iterator[Offer]:
    if block is Block.KINEMATICS:
        for kind in element_kinds():
            for name in (kind.keyword, kind.synonym):
                if name:
                    yield _element(name, block)
        yield _element(WITH_WARPING, block)
    for keyword in keywords().values():
        if keyword.block is block and words_of(keyword).table != "uncovered":
            yield _statement(keyword)
    if block is not Block.PICTURE:
        for name in ENDINGS:
            yield Offer(name, Kind.KEYWORD, "ends a block", about=keyword_words(name, block))
    if block is not Block.KINEMATICS and block is not Block.PICTURE:
        visual = keywords()[Block.PICTURE, "VISUALIZATION"]
        yield _statement(visual)


def _element(name: str, block: Block) -> Offer:
    kind = element_of(name)
    assert kind is not None
    names = operands_of(kind, name)
    required = names if kind.vector != 1 else names[:-3]
    form = form_of(kind, name).partition(" ")[2]
    return Offer(name, Kind.KEYWORD, form, _snippet(name, required), keyword_words(name, block))


def _statement(keyword: Keyword) -> Offer:
    operands = words_of(keyword).operands
    required = re.sub(r"\[[^]]*\]", "", operands).replace("…", "").split()
    return Offer(
        keyword.name,
        Kind.KEYWORD,
        operands,
        _snippet(keyword.name, tuple(required)),
        keyword_words(keyword.name, keyword.block),
    )


def _snippet(name: str, operands: tuple[str, ...]) -> str:
    places = (f"${{{k}:{operand}}}" for k, operand in enumerate(operands, start=1))
    return " ".join((name, *places)) if operands else ""


def _operands(deck: Deck, statement: Statement, place: int, typed: str) -> Iterator[Offer]:
    says = statement.says
    letter = says.letter(place)
    if letter == "E":
        yield Offer(str(deck.index.free(ELEMENT)), Kind.NUMBER, "free for an element")
    elif letter == "n":
        wanted = None
        if says.element is not None:
            slots = slots_of(says.element, says.name)
            wanted = slots[place - 2] if place - 2 < len(slots) else None
        yield from _nodes(deck, wanted, typed)
        if wanted is not None:
            free = str(deck.index.free(NODE))
            yield Offer(free, Kind.NUMBER, f"free for {kind_words(wanted)}")
    elif letter == "e":
        yield from _elements(deck, typed)
    elif letter == "i":
        yield from _components(deck, statement, place)
    elif letter == "w" and says.name in ("CROSSTYPE", "BEAMVIS", "TRUSSVIS"):
        kinds = (each.name for each in CrossSection if each)
        yield from (Offer(name, Kind.WORD, "cross-section") for name in kinds)


def _nodes(deck: Deck, wanted: int | None, typed: str) -> Iterator[Offer]:
    for number, kind in sorted(deck.index.kinds.items()):
        if (wanted is None or kind == wanted) and str(number).startswith(typed):
            comment = deck.index.comment((NODE, number))
            detail = f"{kind_words(kind)}{f', {comment}' if comment else ''}"
            yield Offer(str(number), Kind.NUMBER, detail)


def _elements(deck: Deck, typed: str) -> Iterator[Offer]:
    numbers = sorted(number for kind, number in deck.index.made if kind == ELEMENT)
    for number in numbers:
        if str(number).startswith(typed):
            comment = deck.index.comment((ELEMENT, number))
            name = deck.index.facts[deck.index.made[ELEMENT, number][0][0]].name
            yield Offer(str(number), Kind.NUMBER, f"{name}{f', {comment}' if comment else ''}")


def _components(deck: Deck, statement: Statement, place: int) -> Iterator[Offer]:
    says, owner = statement.says, statement.says.number(1)
    if owner is None:
        return
    taken = {says.number(k) for k in range(2, len(says.words)) if k != place}
    if says.letter(1) == "n":
        kind = deck.index.kinds.get(owner)
        words = components_of_node(kind) if kind is not None else {}
    else:
        made = deck.index.element(owner)
        if made is None or made.says.element is None:
            return
        words = components_of_element(made.says.element, made.says.name)
        words = {k: designers_words(deck, owner, k) or each for k, each in words.items()}
    for number, what in words.items():
        if number not in taken:
            yield Offer(str(number), Kind.COMPONENT, what)
