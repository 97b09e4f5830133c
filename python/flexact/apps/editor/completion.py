# SPDX-License-Identifier: BSD-3-Clause
"""What may stand at a position: keywords, numbers of nodes and elements, components."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice
from typing import Literal, NamedTuple

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
from ...deck.tokens import Line, Tokens
from ...model.data import CrossSection
from .deck import ELEMENT, NODE, Deck, Position, Range
from .hover import (
    KIND_WORDS,
    components_of,
    designers_words,
    keyword_words,
)

#: How many numbers are offered at once.
_MOST = 200


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
    kind: Literal["keyword", "number", "component", "word"]
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
    at = position.character
    line = deck.tokens[position.line]
    place = line.word_at(at)
    start, end = at, at
    if at > line.mark or line.text.startswith("*"):
        return Offers(Range.within(position.line, at, at), ())
    if place is not None:
        start, end = line.words[place].first, line.words[place].behind
    else:
        # Where nothing stands yet, the core says what a word would be.
        lines = list(deck.document.bare)
        lines[position.line] = f"{line.text[:at]}0{line.text[at:]}"
        line = Tokens("\n".join(lines))[position.line]
        place = line.word_at(at)
    range_ = Range.within(position.line, start, end)
    if not place:
        return Offers(range_, tuple(_keywords(line.block)))
    typed = line.words[place].text[: at - start]
    found = list(islice(_operands(deck, line, place, typed), _MOST + 1))
    return Offers(range_, tuple(found[:_MOST]), len(found) <= _MOST)


def _keywords(block: Block) -> Iterator[Offer]:
    if block is Block.KINEMATICS:
        for kind in element_kinds():
            yield from (_element(name, block) for name in (kind.keyword, kind.synonym) if name)
        yield _element(WITH_WARPING, block)
    for keyword in keywords().values():
        if keyword.block is block and words_of(keyword).table != "uncovered":
            yield _statement(keyword)
    if block is not Block.PICTURE:
        for name in ENDINGS:
            yield Offer(name, "keyword", "ends a block", about=keyword_words(name, block))
    if block is not Block.KINEMATICS and block is not Block.PICTURE:
        yield _statement(keywords()[Block.PICTURE, "VISUALIZATION"])


def _element(name: str, block: Block) -> Offer:
    kind = element_of(name)
    assert kind is not None
    names = operands_of(kind, name)
    required = names if kind.vector != 1 else names[:-3]
    form = form_of(kind, name).partition(" ")[2]
    return Offer(name, "keyword", form, _snippet(name, required), keyword_words(name, block))


def _statement(keyword: Keyword) -> Offer:
    operands = words_of(keyword).operands
    required = re.sub(r"\[[^]]*\]", "", operands).replace("…", "").split()
    return Offer(
        keyword.name,
        "keyword",
        operands,
        _snippet(keyword.name, tuple(required)),
        keyword_words(keyword.name, keyword.block),
    )


def _snippet(name: str, operands: tuple[str, ...]) -> str:
    places = (f"${{{k}:{operand}}}" for k, operand in enumerate(operands, start=1))
    return " ".join((name, *places)) if operands else ""


def _operands(deck: Deck, line: Line, place: int, typed: str) -> Iterator[Offer]:
    letter, index = line.words[place].letter, deck.index
    if letter == "E":
        yield Offer(str(index.free(ELEMENT)), "number", "free for an element")
    elif letter == "n":
        wanted = line.words[place].node
        for number, kind in index.kinds.items():
            if wanted in (0, kind) and str(number).startswith(typed):
                comment = index.comment((NODE, number))
                detail = f"{KIND_WORDS[kind]}{f', {comment}' if comment else ''}"
                yield Offer(str(number), "number", detail)
        if wanted:
            yield Offer(str(index.free(NODE)), "number", f"free for {KIND_WORDS[wanted]}")
    elif letter == "e":
        for number, made in index.made[ELEMENT].items():
            if str(number).startswith(typed):
                comment = index.comment((ELEMENT, number))
                name = index.tokens[made].name
                yield Offer(str(number), "number", f"{name}{f', {comment}' if comment else ''}")
    elif letter == "i":
        taken = [line.number_of(k) for k in range(2, len(line.words)) if k != place]
        owner, is_node = line.number_of(1), line.words[1].letter == "n"
        for number, what in components_of(deck, line).items():
            if number not in taken:
                own = "" if is_node else designers_words(deck, owner, number)
                yield Offer(str(number), "component", own or what)
    elif letter == "w" and line.name in ("CROSSTYPE", "BEAMVIS", "TRUSSVIS"):
        for section in CrossSection:
            if section:
                yield Offer(section.name, "word", "cross-section")
