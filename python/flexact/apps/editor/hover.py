# SPDX-License-Identifier: BSD-3-Clause
"""What is said of the word under the pointer, as Markdown: keywords, nodes, elements, numbers."""

from __future__ import annotations

import re

import numpy as np

from ...analysis.naming import length_in_words
from ...analysis.places import deformation_word, deformation_words, node_words, part_words
from ...core.elements import AXES, Class, NodeKind, coordinate_name, element_kinds
from ...core.raw import ElementKind, Meaning
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
from ...model.writing import FIRST_COMPONENT
from .deck import WARPING, Deck, Position, Range, Told, span

_CLASSES = {
    Class.FIXED: "fixed",
    Class.DEPENDENT: "dependent",
    Class.INDEPENDENT: "independent",
}
#: What a node is, by its kind.
KIND_WORDS: dict[int, str] = {
    NodeKind.POSITION: "position",
    NodeKind.PLANAR_POSITION: "position",
    NodeKind.ORIENTATION: "orientation",
    NodeKind.ANGLE: "orientation",
    WARPING: "warping",
}


#: Numbers of a position.
_NUMBERS = {NodeKind.POSITION: 3, NodeKind.PLANAR_POSITION: 2}


def components_of_node(kind: int) -> dict[int, str]:
    """What the components of a node of this kind are, by their numbers."""
    if kind == WARPING:
        return {1: "warping, which is not analysed"}
    first = FIRST_COMPONENT[NodeKind(kind)]
    made = {}
    for axis in AXES[kind]:
        name = coordinate_name(kind, axis)
        words = f"rotation about {name[1:]}" if name.startswith("r") else f"position along {name}"
        made[axis + first] = words
    if kind == NodeKind.ORIENTATION:
        made[1] = "the first Euler parameter, which is no coordinate of its own"
    return dict(sorted(made.items()))


def components_of_element(kind: ElementKind, name: str = "") -> dict[int, str]:
    """What the deformations of an element of this kind are, in its local frame."""
    made = {k: deformation_word(kind.number, k) for k in range(1, kind.deformations + 1)}
    if name == WITH_WARPING:
        made |= {7: "warping at p, which is not analysed", 8: "warping at q, which is not analysed"}
    return made


def designers_words(deck: Deck, element: int, deformation: int) -> str:
    """Such as "in-plane bending at its clamp"; empty where the deck has errors."""
    told, index = _element(deck, element)
    if told is None or index is None:
        return ""
    kind = element_kinds()[told.data.arrays.element_kind[index] - 1]
    is_one = 1 <= deformation <= kind.deformations
    return deformation_words(told, index, deformation) if is_one else ""


def _element(deck: Deck, number: int) -> tuple[Told | None, int | None]:
    told = deck.told
    return told, None if told is None else told.data.element_index.get(number)


def element_words(deck: Deck, number: int) -> list[str]:
    """What an element is, a line each; of a deck with errors what its statement says."""
    made = deck.index.element(number)
    if made is None or made.element is None:
        return [f"There is no element {number}."]
    head = f"**element {number}**: {made.name}"
    told, index = _element(deck, number)
    if told is None or index is None:
        return [f"{head}, {made.comment}" if made.comment else head]
    part = told.parts.of_element(index)
    nodes = told.data.arrays.element_node[:, index].tolist()
    numbers = told.data.arrays.node_number
    slots = [
        f"{slot} {numbers[node - 1]}"
        for slot, node in zip(("p", "op", "q", "oq"), nodes, strict=True)
        if node
    ]
    length = float(told.data.frames.length[index])
    lines = [
        f"{head}, {part.kind} *{part.name}*" if part.is_named else f"{head}, {part.kind}",
        f"nodes {', '.join(slots)}" + (f"; length {length_in_words(length)}" if length else ""),
    ]
    classes = told.data.arrays.deformation_class[:, index].tolist()
    for wanted, word in (
        (Class.FIXED, "held"),
        (Class.DEPENDENT, "released"),
        (Class.INDEPENDENT, "independent"),
    ):
        mine = [k for k, own in enumerate(classes, start=1) if own == wanted]
        words = [f"{k} {deformation_words(told, index, k)}" for k in mine]
        if len(mine) == made.element.deformations:
            words = ["all deformations"]
        if words:
            lines.append(f"{word}: {', '.join(words)}")
    return lines


def node_lines(deck: Deck, number: int) -> list[str]:
    """What a node is, a line each; of a deck with errors what its statements say."""
    kind = deck.index.kinds.get(number)
    if kind is None:
        return [f"**node {number}**: no element names it."]
    lines = [f"**node {number}**: {KIND_WORDS[kind]}"]
    told, on = deck.told, deck.index.elements_on(number)
    part_of = dict.fromkeys(on[:8], "")
    if told is not None:
        place, known = told.data.node_index.get(number), told.data.element_index
        if place is not None:
            lines[0] += f", {node_words(told.parts, place)}"
            lines += [_value(told, place), _classes_of_node(told, place)]
        for one in part_of.keys() & known.keys():
            part_of[one] = f" ({part_words(told.parts.of_element(known[one]))})"
    if on:
        named = ", ".join(f"{one}{part}" for one, part in part_of.items())
        more = f" and {len(on) - 8} more" if len(on) > 8 else ""
        lines.append(f"element{'s' * (len(on) > 1)} {named}{more}")
    return lines


def _value(told: Told, place: int) -> str:
    """Where a node stands."""
    arrays = told.data.arrays
    kind = int(arrays.node_kind[place])
    value = arrays.node_value[:, place]
    units = told.data.units
    value = units.shown(value, "m") if kind in _NUMBERS else value
    numbers = ", ".join(f"{each:.6g}" for each in value.tolist()[: _NUMBERS.get(NodeKind(kind), 4)])
    if kind in _NUMBERS:
        return f"at ({numbers}) {units.symbol('m')}"
    at = told.parts.place_of(place)
    where = "" if at is None else f", at node {arrays.node_number[at]}"
    if kind == NodeKind.ANGLE:
        return f"turned by {value[0]:.6g} rad{where}"
    is_plain = bool(np.array_equal(value, [1.0, 0.0, 0.0, 0.0]))
    return f"{'not turned' if is_plain else f'Euler parameters ({numbers})'}{where}"


def _classes_of_node(told: Told, place: int) -> str:
    arrays = told.data.arrays
    kind = int(arrays.node_kind[place])
    by_class: dict[str, list[str]] = {}
    for axis in AXES[kind]:
        word = _CLASSES.get(Class(int(arrays.coordinate_class[axis, place])))
        if word is not None:
            by_class.setdefault(word, []).append(coordinate_name(kind, axis))
    return "; ".join(f"{', '.join(names)} {word}" for word, names in by_class.items())


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
            noun = KIND_WORDS[line.words[place].node]
            article = "an" if noun[0] in "aeiou" else "a"
            slot = operands_of(line.element, line.name)[place - 1]
            lines.append(f"here {slot}, {article} {noun}")
        return "  \n".join(lines)
    return _component(deck, line, number) if letter == "i" else ""


def components_of(deck: Deck, line: Line) -> dict[int, str]:
    """The components of the node, or the deformations of the element, of a statement."""
    owner = line.number_of(1)
    if line.words[1].letter == "n":
        kind = deck.index.kinds.get(owner)
        return components_of_node(kind) if kind is not None else {}
    made = deck.index.element(owner)
    if made is None or made.element is None:
        return {}
    return components_of_element(made.element, made.name)


def _component(deck: Deck, line: Line, number: int) -> str:
    """What a component of the node, or a deformation of the element, of a statement is."""
    words = components_of(deck, line).get(number)
    if words is None:
        return ""
    owner = line.number_of(1)
    if line.words[1].letter == "n":
        return f"**{number}**: {words} of node {owner}"
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
    elif letter == "e" and (made := deck.index.element(owner)) is not None:
        named = meanings.of_element(line.name, made.element) if made.element else ()
    if not 0 <= behind < len(named):
        return ""
    meant = named[behind]
    # A unit has its powers with a caret here.
    unit = re.sub(r"(?<=[a-z])2", "^2", deck.units.symbol(meant.unit.replace("^", "")))
    return f"**{line.words[place].text}**: {meant._replace(unit=unit)}"


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
