# SPDX-License-Identifier: BSD-3-Clause
"""What is said of the word under the pointer, as Markdown."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from ...deck import keywords as numbers
from ...deck.keywords import (
    ELEMENTS,
    ENDINGS,
    WITH_WARPING,
    Block,
    find_keyword,
    form_of,
    operands_of,
    words_of,
)
from .deck import Deck, slots_of
from .document import Position, Range
from .names import (
    components_of_element,
    components_of_node,
    designers_words,
    element_words,
    kind_words,
    node_lines,
)
from .statements import Statement, Words


class Hover(NamedTuple):
    """Words and what they are about."""

    text: str
    range: Range


def hover_at(deck: Deck, position: Position) -> Hover | None:
    """What is said of the word at a position; None where there is nothing to be said."""
    position = deck.document.clamped(position)
    statement = deck.statements.at(position.line)
    place = statement.says.word_at(position.character)
    if place is None:
        return None
    text = _of_keyword(statement.says) if place == 0 else _of_operand(deck, statement, place)
    return Hover(text, statement.span(place)) if text else None


def keyword_words(name: str, block: Block) -> str:
    """What a keyword means and takes; empty for a word that is none."""
    says = Words(name, block)
    return _of_keyword(says)


def _of_keyword(says: Words) -> str:
    name = says.name
    if name in ENDINGS:
        return f"**{name}** {ENDINGS[name]}."
    if says.element is not None:
        kind = says.element
        parts = components_of_element(kind, name)
        about = ELEMENTS[kind.keyword]
        known = f"; `{name}` is another spelling" if name == kind.synonym else ""
        if name == WITH_WARPING:
            known = "; its warping is read and not analysed"
        rows = "\n".join(f"- {k}: {words}" for k, words in parts.items())
        form = form_of(kind, name)
        return f"`{form}`\n\n{_capital(about)}{known}. Its deformations:\n\n{rows}"
    keyword = find_keyword(name, says.block)
    if keyword is None:
        return ""
    words = words_of(keyword)
    meaning = words.says or numbers.properties_in_words(name)
    unused = " It is read and not used." if words.table == "unused" else ""
    if words.table == "uncovered":
        return f"**{name}** {meaning}."
    form = f"{name} {words.operands}".strip()
    block = f" (in the {keyword.block.words} block)" if keyword.block is not says.block else ""
    return f"`{form}`{block}\n\n{_capital(meaning)}.{unused}"


def _of_operand(deck: Deck, statement: Statement, place: int) -> str:
    say = _OF_LETTER.get(statement.says.letter(place))
    return say(deck, statement.says, place) if say is not None else ""


def _element(deck: Deck, says: Words, place: int) -> str:
    number = says.number(place)
    return "" if number is None else "  \n".join(element_words(deck, number))


def _node(deck: Deck, says: Words, place: int) -> str:
    number = says.number(place)
    if number is None:
        return ""
    lines = node_lines(deck, number)
    if says.element is not None:
        slot = operands_of(says.element, says.name)[place - 1]
        kind = slots_of(says.element, says.name)[place - 2]
        lines.append(f"here {slot}, {_article(kind_words(kind))}")
    return "  \n".join(lines)


def _component(deck: Deck, says: Words, place: int) -> str:
    number, owner = says.number(place), says.number(1)
    if number is None or owner is None:
        return ""
    if says.letter(1) == "n":
        kind = deck.index.kinds.get(owner)
        words = components_of_node(kind).get(number) if kind is not None else None
        return f"**{number}**: {words} of node {owner}" if words else ""
    made = deck.index.element(owner)
    if made is None or made.says.element is None:
        return ""
    words = components_of_element(made.says.element, made.says.name).get(number)
    if words is None:
        return ""
    own = designers_words(deck, owner, number)
    if not own or own == words:
        return f"**{number}**: {words} of element {owner}"
    lines = element_words(deck, owner)[:1]
    return "  \n".join([f"**{number}**: {own}", f"({words})", *lines])


def _real(deck: Deck, says: Words, place: int) -> str:
    """Which quantity a number is."""
    owner = says.number(1)
    named: tuple[numbers.Quantity, ...] = ()
    behind = place - 2
    if says.name == "GRAVITY":
        named, behind = numbers.GRAVITY, place - 1
    elif says.letter(1) == "n" and owner is not None:
        kind = deck.index.kinds.get(owner)
        named = numbers.of_node(says.name, kind) if kind else ()
    elif says.letter(1) == "e":
        of = deck.index.kind_of_element(owner)
        named = numbers.of_element(says.name, of) if of is not None else ()
    return f"**{says.words[place].text}**: {named[behind]}" if 0 <= behind < len(named) else ""


def _vector(_: Deck, says: Words, place: int) -> str:
    assert says.element is not None
    names = operands_of(says.element, says.name)
    if place > len(names):
        return ""
    name = names[place - 1]
    if name.startswith("a"):
        return f"**{name}**: {name[1:]} of the direction of the axis"
    return (
        f"**{name}**: {name[1:]} of a vector across the element; local y is that part of it which "
        "is across the line from p to q"
    )


_OF_LETTER: dict[str, Callable[[Deck, Words, int], str]] = {
    "E": _element,
    "e": _element,
    "n": _node,
    "i": _component,
    "r": _real,
    "v": _vector,
}


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]


def _article(noun: str) -> str:
    return f"{'an' if noun[:1] in 'aeiou' else 'a'} {noun}"
