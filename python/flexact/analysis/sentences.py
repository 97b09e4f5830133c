# SPDX-License-Identifier: BSD-3-Clause
"""Lines of text whose parts are known: broken into lines, or linked with a drawing, at the end."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from ..util.text import TIE, USUAL, wrapped

_INDENT = "     "


class Named(NamedTuple):
    """An element or a node that a text names."""

    kind: str
    """"element" or "node"."""
    number: int
    words: str
    """What it is called, such as "sheet 1" or "the stage"."""

    def __str__(self) -> str:
        """The words."""
        return self.words


Piece = str | Named
#: Words that follow each other without further blanks.
Pieces = tuple[Piece, ...]


class Line(NamedTuple):
    """A sentence, or the start of one and what it lists."""

    head: Pieces
    items: tuple[Pieces, ...] = ()
    notes: tuple[str, ...] = ()
    """What stands behind the first items, as many as there are."""
    more: bool = False
    """Whether there are more items than these."""

    def shortened(self, most: int) -> Line:
        """The line with its first items."""
        return self._replace(items=self.items[:most], more=self.more or len(self.items) > most)

    def listed(self) -> tuple[tuple[Pieces, str], ...]:
        """The items, each with what stands behind it."""
        behind = [f" {note}" if note else "" for note in self.notes]
        behind += [""] * (len(self.items) - len(behind))
        return tuple(zip(self.items, behind, strict=False))


def sentence(*pieces: Piece) -> Line:
    """A line without items."""
    return Line(pieces)


def plain(pieces: Iterable[Piece]) -> str:
    """The pieces as text."""
    return "".join(map(str, pieces))


def _tied(words: str, width: int) -> str:
    """Words that are not to be torn apart, unless they are longer than a row."""
    return words.replace(" ", TIE) if len(words) < width - 2 * len(_INDENT) else words


def filled(line: Line, *, hanging: bool = False, width: int = USUAL) -> str:
    """A line as text in rows of a width; items are not torn apart.

    Further rows are indented where there are items, or where they are to hang.
    """
    items = [
        _tied(plain(item), width) + note[:1] + _tied(note[1:], width)
        for item, note in line.listed()
    ]
    text = plain(line.head) + "; ".join(items + ["..."] * line.more)
    return wrapped(text, width, _INDENT if line.items or hanging else "")
