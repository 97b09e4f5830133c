# SPDX-License-Identifier: BSD-3-Clause
"""The outline of a deck, and what of it folds."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from functools import partial
from itertools import pairwise
from typing import Literal, NamedTuple, TypeVar

import numpy as np

from ...core.elements import is_position
from ...deck.keywords import Block, words_of
from ...deck.tokens import Line
from ...model.names import part_name
from ...util.text import harmless
from .deck import ELEMENT, Deck, Edit, Key, Position, Range, keys_in, span
from .hover import KIND_WORDS

One = TypeVar("One")
Sort = Literal["group", "part", "element", "point", "statement"]
#: Lines of one kind beyond which they are shown in stretches of so many.
_MOST, _STRETCH = 1000, 500


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


_TABLES = {
    "classes": "classes",
    "properties": "material",
    "loads": "loads",
    "pictures": "pictures",
    "unused": "read and not used",
}


def outline_of(deck: Deck) -> list[Symbol]:
    """Parts by name with their elements, nodes, classes, stiffness and mass, loads, pictures."""
    parts: dict[str, list[int]] = {}
    rest: dict[str, list[int]] = {name: [] for name in ("nodes", *_TABLES.values())}
    for line in deck.tokens:
        if line.element is not None:
            name = harmless(part_name(line.comment).strip()) if line.comment else ""
            parts.setdefault(name or f"\0{line.number}", []).append(line.number)
        elif line.keyword is not None:
            table = words_of(line.keyword).table
            name = "nodes" if line.keyword.name == "X" else _TABLES.get(table, "")
            if name:
                rest[name].append(line.number)
    groups = []
    if parts:
        groups.append(_group("parts", list(parts.items()), lambda one: _part(deck, *one)))
    for name, lines in rest.items():
        if lines:
            make = _node if name == "nodes" else _statement
            groups.append(_group(name, lines, partial(make, deck)))
    return groups


def _group(
    name: str,
    entries: list[One],
    make: Callable[[One], Symbol],
    detail: str = "",
    sort: Sort = "group",
) -> Symbol:
    """Entries, or the stretches that they stand in, below one that is named where the first is."""
    inner = _stretches(entries, make)
    first = min(inner, key=lambda each: each.range)
    return Symbol(name, detail, sort, _around(inner), first.own, tuple(inner))


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
        start = first.own if around.start <= first.own.start else Range(*[around.start] * 2)
        made.append(Symbol(name, f"{len(some)}", "group", around, start))
    return made


def _symbol(line: Line, name: str, detail: str, sort: Sort) -> Symbol:
    return Symbol(name, detail, sort, span(line, 0, -1), span(line, 0))


def _words(line: Line, first: int, behind: int | None = None) -> str:
    return " ".join(word.text for word in line.words[first:behind])


def _element(deck: Deck, number: int) -> Symbol:
    line = deck.tokens[number]
    return _symbol(line, _words(line, 0, 2), _words(line, 2), "element")


def _part(deck: Deck, name: str, lines: list[int]) -> Symbol:
    if len(lines) == 1:
        one = _element(deck, lines[0])._replace(sort="part")
        return one if name.startswith("\0") else one._replace(name=name, detail=one.name)
    return _group(name, lines, partial(_element, deck), f"{len(lines)} elements", "part")


def _node(deck: Deck, number: int) -> Symbol:
    line = deck.tokens[number]
    kind = deck.index.kinds.get(line.number_of(1))
    words = KIND_WORDS[kind] if kind is not None else "node"
    name = f"node {line.words[1].text}" if len(line.words) > 1 else "node"
    if line.comment and kind is not None and kind > 0 and is_position(kind):
        name = f"{name}: {harmless(line.comment)}"
    return _symbol(line, name, f"{words} {_words(line, 2)}".strip(), "point")


def _statement(deck: Deck, number: int) -> Symbol:
    line = deck.tokens[number]
    words = _words(line, 0)
    name = words if len(words) <= 40 else f"{words[:37]}..."
    return _symbol(line, name, harmless(line.comment), "statement")


def _around(symbols: Iterable[Symbol]) -> Range:
    every = [each.range for each in symbols]
    return Range(min(one.start for one in every), max(one.end for one in every))


def folds_of(deck: Deck) -> list[tuple[int, int, bool]]:
    """First and last line of what folds, and whether it is a comment.

    These are blocks, and runs of at least three lines of comment or of one keyword.
    """
    tokens, last = deck.tokens, len(deck.tokens) - 1
    while last > 0 and not deck.document.bare[last].strip():
        last -= 1
    edges = [0, *(np.flatnonzero(np.diff(tokens.block)) + 1).tolist(), last + 1]
    made = [
        (first, behind - 1, False)
        for first, behind in pairwise(edges)
        if tokens.block[first] != Block.CLOSED and behind - 1 > first
    ]
    start, run = 0, ""
    for line in range(last + 2):
        kind = _run(tokens[line]) if line <= last else ""
        if kind != run:
            if run and line - start >= 3:
                made.append((start, line - 1, run == "%"))
            start, run = line, kind
    return sorted(dict.fromkeys(made))


def _run(line: Line) -> str:
    """What lines of a run have in common; empty for a blank line."""
    if line.words:
        return "element" if line.element is not None else line.name
    return "%" if line.mark < len(line.text) else ""


_LARGEST = 2**31 - 1
#: Statements that name nodes or elements among numbers that mean something else.
_MIXED = ("BEAMVIS", "TRUSSVIS", "INX", "OUTF", "OUTX", "OUTXP", "INPUTF")


class RenameError(ValueError):
    """A number that cannot be given."""


def place_at(deck: Deck, position: Position) -> tuple[Key, Range] | None:
    """The node or the element whose number stands at a position."""
    position = deck.document.clamped(position)
    line = deck.tokens[position.line]
    word = line.word_at(position.character)
    where = None if word is None else span(line, word)
    return next((found for found in keys_in(line) if found[1] == where), None)


def definition_at(deck: Deck, position: Position) -> list[Range]:
    """Where the element at a position is made, or the node has its X."""
    place = place_at(deck, position)
    return deck.index.definition(place[0]) if place is not None else []


def references_at(deck: Deck, position: Position, with_own: bool = True) -> list[Range]:
    """All places of the node or element at a position."""
    place = place_at(deck, position)
    if place is None:
        return []
    own = () if with_own else deck.index.definition(place[0])
    return [one for one in deck.index.where(place[0]) if one not in own]


def rename_at(deck: Deck, position: Position, new: str) -> list[Edit]:
    """What gives the node or element at a position another number.

    Raises:
        RenameError: there is none, the number is none, or another one has it.
    """
    place = place_at(deck, position)
    if place is None:
        raise RenameError("there is no number of a node or of an element here")
    kind, old = place[0]
    free = deck.index.free(kind)
    if not re.fullmatch(r"[1-9]\d{0,9}", new.strip()) or int(new) > _LARGEST:
        raise RenameError(f"a {kind} has a positive whole number, such as {free}")
    number = int(new)
    if number == old:
        return []
    if deck.index.where((kind, number)):
        article = "an" if kind == ELEMENT else "a"
        raise RenameError(f"there is {article} {kind} {number} already; {free} is free")
    for at in deck.tokens.lines_of(*_MIXED).tolist():
        line = deck.tokens[at]
        if any(word.number == old for word in line.words[1:]):
            raise RenameError(
                f"{line.name} in line {at + 1} has the number {old}, which may be this {kind}: "
                "change it there first"
            )
    return [Edit(where, str(number)) for where in deck.index.where(place[0])]
