# SPDX-License-Identifier: BSD-3-Clause
"""What is said of the word under the pointer, as Markdown."""

from __future__ import annotations

from ...core.raw import Meaning
from ...deck import keywords as meanings
from ...deck.keywords import (
    ENDINGS,
    WITH_WARPING,
    Block,
    element_of,
    find_keyword,
    form_of,
    operands_of,
    words_of,
)
from ...deck.tokens import Line
from .deck import Deck, span
from .document import Position, Range
from .names import (
    components_of_element,
    components_of_node,
    designers_words,
    element_words,
    kind_words,
    node_lines,
)


def hover_at(deck: Deck, position: Position) -> tuple[str, Range] | None:
    """What is said of the word at a position, and where it stands; None where nothing is."""
    position = deck.document.clamped(position)
    line = deck.tokens[position.line]
    place = line.word_at(position.character)
    if place is None:
        return None
    text = _of_operand(deck, line, place) if place else keyword_words(line.name, line.block)
    return (text, span(line, place)) if text else None


def keyword_words(name: str, block: Block) -> str:
    """What a keyword means and takes; empty for a word that is none."""
    if name in ENDINGS:
        return f"**{name}** {ENDINGS[name]}."
    kind = element_of(name)
    if kind is not None:
        known = f"; `{name}` is another spelling" if name == kind.synonym else ""
        if name == WITH_WARPING:
            known = "; its warping is read and not analysed"
        parts = components_of_element(kind, name)
        rows = "\n".join(f"- {k}: {words}" for k, words in parts.items())
        about = f"{_capital(kind.says)}{known}. Its deformations"
        return f"`{form_of(kind, name)}`\n\n{about}:\n\n{rows}"
    keyword = find_keyword(name, block)
    if keyword is None:
        return ""
    words = words_of(keyword)
    if words.table == "uncovered":
        return f"**{name}** {words.says}."
    where = f" (in the {keyword.block.words} block)" if keyword.block is not block else ""
    meaning = _capital(words.says or meanings.properties_in_words(name))
    unused = " It is read and not used." if words.table == "unused" else ""
    return f"`{f'{name} {words.operands}'.strip()}`{where}\n\n{meaning}.{unused}"


def _of_operand(deck: Deck, line: Line, place: int) -> str:
    letter, number = line.words[place].letter, line.words[place].number
    if letter == "v":
        return _vector(line, place)
    if letter == "r":
        return _real(deck, line, place)
    if not number:
        return ""
    if letter in "Ee":
        return "  \n".join(element_words(deck, number))
    if letter == "n":
        lines = node_lines(deck, number)
        if line.element is not None:
            noun = kind_words(line.words[place].node)
            article = "an" if noun[0] in "aeiou" else "a"
            slot = operands_of(line.element, line.name)[place - 1]
            lines.append(f"here {slot}, {article} {noun}")
        return "  \n".join(lines)
    return _component(deck, line, number) if letter == "i" else ""


def _component(deck: Deck, line: Line, number: int) -> str:
    """What a component of the node, or a deformation of the element, of a statement is."""
    owner = line.number_of(1)
    if line.words[1].letter == "n":
        kind = deck.index.kinds.get(owner)
        words = components_of_node(kind).get(number) if kind is not None else None
        return f"**{number}**: {words} of node {owner}" if words else ""
    made = deck.index.element(owner)
    if made is None or made.element is None:
        return ""
    words = components_of_element(made.element, made.name).get(number)
    if words is None:
        return ""
    own = designers_words(deck, owner, number)
    if not own or own == words:
        return f"**{number}**: {words} of element {owner}"
    return "  \n".join([f"**{number}**: {own}", f"({words})", *element_words(deck, owner)[:1]])


def _real(deck: Deck, line: Line, place: int) -> str:
    """Which quantity a number is."""
    owner, letter = line.number_of(1), line.words[1].letter
    named: tuple[Meaning, ...] = ()
    behind = place - 2
    if line.name == "GRAVITY":
        named, behind = meanings.GRAVITY, place - 1
    elif letter == "n" and (node := deck.index.kinds.get(owner, 0)) > 0:
        named = meanings.of_node(line.name, node)
    elif letter == "e" and (kind := deck.index.kind_of_element(owner)) is not None:
        named = meanings.of_element(line.name, kind)
    return f"**{line.words[place].text}**: {named[behind]}" if 0 <= behind < len(named) else ""


def _vector(line: Line, place: int) -> str:
    assert line.element is not None
    names = operands_of(line.element, line.name)
    if place > len(names):
        return ""
    name = names[place - 1]
    if name.startswith("a"):
        return f"**{name}**: {name[1:]} of the direction of the axis"
    return (
        f"**{name}**: {name[1:]} of a vector across the element; local y is that part of it which "
        "is across the line from p to q"
    )


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]
