# SPDX-License-Identifier: BSD-3-Clause
"""The outline of a deck, and what of it folds."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from enum import Enum
from functools import partial
from typing import NamedTuple, TypeVar

from ...deck.keywords import Block, words_of
from ...model.names import part_name
from ...util.text import harmless
from .deck import ELEMENT, Deck, Key, is_position
from .document import Edit, Position, Range
from .names import kind_words
from .statements import Facts, Statement, plan_of

One = TypeVar("One")
#: Lines of one kind beyond which they are shown in stretches of so many.
_MOST, _STRETCH = 1000, 500


class Sort(str, Enum):
    """What a symbol is."""

    GROUP = "group"
    PART = "part"
    ELEMENT = "element"
    POINT = "point"
    STATEMENT = "statement"


class Symbol(NamedTuple):
    """An entry of the outline.

    Attributes:
        name: What it is called; never empty.
        detail: A few words beside it.
        sort: What it is.
        range: All of it.
        own: Where its name stands, within the range.
        inner: Entries below it.
    """

    name: str
    detail: str
    sort: Sort
    range: Range
    own: Range
    inner: tuple[Symbol, ...] = ()


class Fold(NamedTuple):
    """Lines that fold, from 0, both included."""

    first: int
    last: int
    is_comment: bool = False


_TABLES = {
    "classes": "classes",
    "properties": "stiffness and mass",
    "loads": "loads",
    "pictures": "pictures",
    "unused": "read and not used",
}


def outline_of(deck: Deck) -> list[Symbol]:
    """Parts by name with their elements, nodes, classes, stiffness and mass, loads, pictures."""
    parts: dict[str, list[int]] = {}
    rest: dict[str, list[int]] = {name: [] for name in ("nodes", *_TABLES.values())}
    for line, facts in enumerate(deck.index.facts):
        if not facts.is_statement:
            continue
        if facts.element is not None:
            name = harmless(part_name(facts.comment).strip()) if facts.comment else ""
            parts.setdefault(name or f"\0{line}", []).append(line)
        elif facts.name == "X":
            rest["nodes"].append(line)
        else:
            keyword = plan_of(facts.name, deck.statements.blocks.of_line(line)).keyword
            table = words_of(keyword).table if keyword is not None else ""
            if table in _TABLES:
                rest[_TABLES[table]].append(line)
    groups = []
    if parts:
        named = list(parts.items())
        groups.append(_group("parts", named, lambda one: _part(deck, *one)))
    for name, lines in rest.items():
        if lines:
            make = _node if name == "nodes" else _statement
            groups.append(_group(name, lines, partial(make, deck)))
    return groups


def _group(name: str, entries: list[One], make: Callable[[One], Symbol]) -> Symbol:
    inner = _stretches(entries, make)
    first = min(inner, key=lambda each: each.range)
    return Symbol(name, "", Sort.GROUP, _around(inner), first.own, tuple(inner))


def _stretches(entries: list[One], make: Callable[[One], Symbol]) -> list[Symbol]:
    """The entries; of very many the stretches that they stand in."""
    if len(entries) <= _MOST:
        return [make(one) for one in entries]
    made = []
    length = max(_STRETCH, len(entries) // _STRETCH)
    for k in range(0, len(entries), length):
        some = entries[k : k + length]
        first, last = make(some[0]), make(some[-1])
        name = f"{first.name} to {last.name}"
        around = _around((first, last))
        made.append(Symbol(name, f"{len(some)}", Sort.GROUP, around, _own(first, around)))
    return made


def _own(first: Symbol, around: Range) -> Range:
    return first.own if around.start <= first.own.start else Range(around.start, around.start)


def _plain(statement: Statement) -> str:
    return " ".join(word.text for word in statement.says.words[:2])


def _element(deck: Deck, line: int) -> Symbol:
    statement = deck.index.at(line)
    nodes = " ".join(word.text for word in statement.says.words[2:])
    return Symbol(_plain(statement), nodes, Sort.ELEMENT, statement.whole, statement.span(0))


def _part(deck: Deck, name: str, lines: list[int]) -> Symbol:
    if len(lines) == 1:
        one = _element(deck, lines[0])
        if name.startswith("\0"):
            return one._replace(sort=Sort.PART)
        return one._replace(name=name, detail=one.name, sort=Sort.PART)
    inner = tuple(_stretches(lines, partial(_element, deck)))
    first = min(inner, key=lambda each: each.range)
    detail = f"{len(lines)} elements"
    return Symbol(name, detail, Sort.PART, _around(inner), first.own, inner)


def _node(deck: Deck, line: int) -> Symbol:
    statement = deck.index.at(line)
    says, comment = statement.says, deck.index.facts[line].comment
    number = says.number(1)
    kind = deck.index.kinds.get(number) if number is not None else None
    words = kind_words(kind) if kind is not None else "node"
    value = " ".join(word.text for word in says.words[2:])
    name = f"node {says.words[1].text}" if len(says.words) > 1 else "node"
    if comment and kind is not None and is_position(kind):
        name = f"{name}: {harmless(comment)}"
    return Symbol(name, f"{words} {value}".strip(), Sort.POINT, statement.whole, statement.span(0))


def _statement(deck: Deck, line: int) -> Symbol:
    statement = deck.index.at(line)
    words = " ".join(word.text for word in statement.says.words)
    name = words if len(words) <= 40 else f"{words[:37]}..."
    detail = harmless(deck.index.facts[line].comment)
    return Symbol(name, detail, Sort.STATEMENT, statement.whole, statement.span(0))


def _around(symbols: Iterable[Symbol]) -> Range:
    every = [each.range for each in symbols]
    return Range(min(one.start for one in every), max(one.end for one in every))


def folds_of(deck: Deck) -> list[Fold]:
    """Blocks, and runs of at least three lines of comment or of one keyword."""
    document, blocks = deck.document, deck.statements.blocks
    last = len(document.bare) - 1
    while last > 0 and not document.bare[last].strip():
        last -= 1
    made = []
    edges = [*blocks.starts, last + 1]
    for first, end, block in zip(edges, edges[1:], blocks.blocks, strict=False):
        if block is not Block.CLOSED and end - 1 > first:
            made.append(Fold(first, end - 1))
    kinds = [_run(facts) for facts in deck.index.facts]
    start, run = 0, ""
    for line in range(last + 2):
        kind = kinds[line] if line <= last else ""
        if kind != run:
            if run and line - start >= 3:
                made.append(Fold(start, line - 1, run == "%"))
            start, run = line, kind
    return sorted(dict.fromkeys(made))


def _run(facts: Facts) -> str:
    if facts.name:
        return "element" if facts.element is not None else facts.name
    return "" if facts.is_blank else "%"


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
