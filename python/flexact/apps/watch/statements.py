# SPDX-License-Identifier: BSD-3-Clause
"""Edits as the lines of a deck that they change."""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from itertools import zip_longest
from typing import NamedTuple

from ...deck.source import decode
from ...model.data import ModelData
from ...model.editing import edited_to_the_letter
from ...model.writing import deck_of, statements_of


class Statement(NamedTuple):
    """A line of a deck that takes the place of another, or is new, or goes."""

    line: int
    """Number of the line that goes, from 1; 0 where none does, or the deck is written anew."""
    old: str
    """What stood there."""
    new: str
    """What stands there now, empty where nothing does."""

    def to_copy(self) -> str:
        """The new line, with a comment that says which one it replaces."""
        if not self.old:
            return self.new
        where = f"line {self.line}: " if self.line else ""
        if not self.new:
            return f"% without {where}{self.old.strip()}"
        return f"{self.new}   % instead of {where}{self.old.strip()}"


class EditedDeck(NamedTuple):
    """A deck after edits."""

    text: bytes
    """The whole deck."""
    statements: tuple[Statement, ...]
    """What differs from the deck as given."""
    is_anew: bool
    """Whether it is written anew, without what an analysis does not use."""


def edited(given: ModelData, changed: ModelData) -> EditedDeck:
    """The deck of a changed model, and what differs from that of the model as given."""
    text = edited_to_the_letter(given, changed)
    source = given.source or given.began_as
    if text is None or source is None:
        return EditedDeck(deck_of(changed).encode(), tuple(_by_keyword(given, changed)), True)
    return EditedDeck(text, tuple(_differing(source.text, text)), False)


def _differing(old: bytes, new: bytes) -> Iterator[Statement]:
    """Lines that differ, each with the one in whose place it stands."""
    before, after = (decode(text).replace("\r", "").split("\n") for text in (old, new))
    first = next(
        (k for k, (a, b) in enumerate(zip(before, after, strict=False)) if a != b),
        min(len(before), len(after)),
    )
    matcher = difflib.SequenceMatcher(None, before[first:], after[first:])
    for kind, i1, i2, j1, j2 in matcher.get_opcodes():
        if kind == "equal":
            continue
        lines = range(first + i1 + 1, first + i2 + 1)
        for line, new_line in zip_longest(lines, after[first + j1 : first + j2]):
            was = before[line - 1] if line else ""
            if was.strip() or (new_line or "").strip():
                yield Statement(line or 0, was, new_line or "")


def _by_keyword(given: ModelData, changed: ModelData) -> Iterator[Statement]:
    """Statements that differ, of a deck that is written anew."""
    old, new = dict(statements_of(given)), dict(statements_of(changed))
    for key in dict.fromkeys((*old, *new)):
        if old.get(key) != new.get(key):
            yield Statement(0, old.get(key, ""), new.get(key, ""))
