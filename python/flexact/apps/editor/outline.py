# SPDX-License-Identifier: BSD-3-Clause
"""The outline of a deck, and what of it folds."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from enum import Enum
from functools import partial
from typing import NamedTuple, TypeVar

from ...deck.keywords import Block, words_of
from ...model.names import part_name
from ...util.plain_text import harmless
from .deck import is_position
from .document import Range
from .editor_deck import Deck
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
