# SPDX-License-Identifier: BSD-3-Clause
"""Decks as they are while somebody types, and every question that an editor asks of them."""

from __future__ import annotations

import random
from collections.abc import Iterator

from flexact.apps.editor.actions import mends_of
from flexact.apps.editor.completion import complete_at
from flexact.apps.editor.deck import Deck, Document, Position, Range
from flexact.apps.editor.hover import hover_at
from flexact.apps.editor.outline import (
    RenameError,
    Symbol,
    definition_at,
    folds_of,
    outline_of,
    place_at,
    references_at,
    rename_at,
)
from flexact.apps.editor.session import problems_of

_SCRAPS = (
    *("\n", "\r\n", "\r", "\t", " ", "%", "#", "*", ";", "\ufeff", "\x00", "\x0b", "\x0c", "\x1a"),
    *("END\n", "HALT\n", "\nEND", "VISUALIZATION\n", "BEAM 1 1 2 3 4\n", "BEAMW 9 1 2 3 4 5 6\n"),
    *("RLSE 1 7", "FIX 99999999999", "X 3 1e999", "DYNX", "\u2028", "\x85", "é", "😀", "\ud800"),
    *("0", "-1", "1.5", "+007", "TRUS 1 1 2\n", "ESTIFF 1 1 2 3 4 5 6 7\n", "BEAMPROPS 1 2\n"),
)


def mutated(text: str, dice: random.Random) -> str:
    """A text with some random changes."""
    for _ in range(dice.choice((0, 1, 1, 2, 3, 8))):
        at = dice.randrange(len(text) + 1)
        kind = dice.randrange(6)
        if kind == 0:
            text = text[:at]
        elif kind == 1:
            text = text[:at] + dice.choice(_SCRAPS) + text[at:]
        elif kind == 2:
            text = text[:at] + text[at + dice.randrange(1, 9) :]
        elif kind == 3:
            lines = text.split("\n")
            first, second = dice.randrange(len(lines)), dice.randrange(len(lines))
            lines[first], lines[second] = lines[second], lines[first]
            text = "\n".join(lines)
        elif kind == 4:
            end = min(len(text), at + dice.randrange(60))
            text = text[:end] + text[at:end] + text[end:]
        else:
            text = text.replace("\n", dice.choice(("\r\n", "\r", "\n")))
    return text


def ask_everything(document: Document, positions: list[Position]) -> None:
    """No question raises, and every answer lies within the document."""
    deck = Deck(document)
    for problem in problems_of(deck):
        require_within(document, problem.range)
        for remark in problem.remarks:
            require_within(document, remark.range)
        for _, edit in mends_of(deck, problem):
            require_within(document, edit.range)
    for one in flat(outline_of(deck)):
        assert one.name
        require_within(document, one.range)
        require_within(document, one.own)
        assert one.range.start <= one.own.start <= one.own.end <= one.range.end
        for inner in one.inner:
            assert one.range.start <= inner.range.start <= inner.range.end <= one.range.end
    for first, last, _ in folds_of(deck):
        assert 0 <= first < last < len(document.lines)
    for position in positions:
        ask_at(deck, position)


def ask_at(deck: Deck, position: Position) -> None:
    document = deck.document
    found = hover_at(deck, position)
    if found is not None:
        text, where = found
        require_within(document, where)
        assert text and "None" not in text
    offers = complete_at(deck, position)
    require_within(document, offers.range)
    assert offers.range.holds(document.clamped(position))
    place = place_at(deck, position)
    every = references_at(deck, position)
    for range_ in (*definition_at(deck, position), *every):
        require_within(document, range_)
    if place is not None:
        (kind, _), where = place
        assert where in every
        try:
            edits = rename_at(deck, position, str(deck.index.free(kind)))
        except RenameError:
            return
        assert [edit.range for edit in edits] == every


def require_within(document: Document, range_: Range) -> None:
    assert range_.start <= range_.end
    for position in range_:
        assert document.clamped(position) == position


def flat(symbols: list[Symbol] | tuple[Symbol, ...]) -> Iterator[Symbol]:
    for one in symbols:
        yield one
        yield from flat(one.inner)


def some_positions(document: Document, dice: random.Random, count: int) -> list[Position]:
    made = []
    for _ in range(count):
        line = dice.randrange(len(document.lines))
        made.append(Position(line, dice.randrange(len(document.lines[line]) + 2)))
    return [*made, Position(0, 0), Position(len(document.lines) + 5, 3)]
