# SPDX-License-Identifier: BSD-3-Clause
"""The outline of a deck, and what of it folds."""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum
from typing import NamedTuple

from ..base.plain_text import harmless
from ..deck.keywords import Block, words_of
from ..model.names import part_name
from .deck import Deck
from .document import Range
from .index import is_position
from .names import kind_words
from .statements import Statement

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
    parts: dict[str, list[Symbol]] = {}
    rest: dict[str, list[Symbol]] = {name: [] for name in ("nodes", *_TABLES.values())}
    for statement in deck.index.all:
        says = statement.says
        if says.element is not None:
            name = harmless(part_name(says.comment).strip())
            parts.setdefault(name or _plain(statement), []).append(_element(statement))
        elif says.name == "X":
            rest["nodes"].append(_node(deck, statement))
        elif says.keyword is not None:
            table = words_of(says.keyword).table
            if table in _TABLES:
                rest[_TABLES[table]].append(_statement(statement))
    made = [_part(name, elements) for name, elements in parts.items()]
    groups = [_group("parts", _stretches(made))] if made else []
    return groups + [_group(name, _stretches(each)) for name, each in rest.items() if each]


def _plain(statement: Statement) -> str:
    return " ".join(word.text for word in statement.says.words[:2])


def _element(statement: Statement) -> Symbol:
    says = statement.says
    nodes = " ".join(word.text for word in says.words[2:])
    own = statement.span(0)
    return Symbol(_plain(statement), nodes, Sort.ELEMENT, statement.whole, own)


def _part(name: str, elements: list[Symbol]) -> Symbol:
    if len(elements) == 1:
        one = elements[0]
        return one._replace(name=name, detail=f"{one.name}", sort=Sort.PART)
    detail = f"{len(elements)} elements"
    inner = tuple(_stretches(elements))
    return Symbol(name, detail, Sort.PART, _around(elements), elements[0].own, inner)


def _node(deck: Deck, statement: Statement) -> Symbol:
    says = statement.says
    number = says.number(1)
    kind = deck.index.kinds.get(number) if number is not None else None
    words = kind_words(kind) if kind is not None else "node"
    value = " ".join(word.text for word in says.words[2:])
    name = f"node {says.words[1].text}" if len(says.words) > 1 else "node"
    if says.comment and kind is not None and is_position(kind):
        name = f"{name}: {harmless(says.comment)}"
    return Symbol(name, f"{words} {value}".strip(), Sort.POINT, statement.whole, statement.span(0))


def _statement(statement: Statement) -> Symbol:
    words = " ".join(word.text for word in statement.says.words)
    name = words if len(words) <= 40 else f"{words[:37]}..."
    detail = harmless(statement.says.comment)
    return Symbol(name, detail, Sort.STATEMENT, statement.whole, statement.span(0))


def _group(name: str, inner: list[Symbol]) -> Symbol:
    first = min(inner, key=lambda each: each.range)
    return Symbol(name, "", Sort.GROUP, _around(inner), first.own, tuple(inner))


def _stretches(symbols: list[Symbol]) -> list[Symbol]:
    """Of very many entries the stretches that they stand in."""
    if len(symbols) <= _MOST:
        return symbols
    made = []
    for k in range(0, len(symbols), _STRETCH):
        some = symbols[k : k + _STRETCH]
        name = f"{some[0].name} to {some[-1].name}"
        made.append(Symbol(name, f"{len(some)}", Sort.GROUP, _around(some), some[0].own))
    return made


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
    start, run = 0, ""
    for line in range(last + 2):
        kind = _run(deck, line) if line <= last else ""
        if kind != run:
            if run and line - start >= 3:
                made.append(Fold(start, line - 1, run == "%"))
            start, run = line, kind
    return sorted(dict.fromkeys(made))


def _run(deck: Deck, line: int) -> str:
    says = deck.statements.at(line).says
    if says.words:
        return "element" if says.element is not None else says.name
    return "%" if deck.document.bare[line].strip() else ""
