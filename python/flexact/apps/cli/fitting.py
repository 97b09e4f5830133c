# SPDX-License-Identifier: BSD-3-Clause
"""Text in as many columns of a terminal as there are."""

from __future__ import annotations

import sys

from ...util.text import columns
from .terminal import columns_of

#: A terminal of fewer columns is taken for one of so many.
_LEAST = 32


def columns_to_fill() -> int | None:
    """How many columns a table may have: those stated, those of the terminal, or any number."""
    wide = columns_of(sys.stdout)
    return max(wide, _LEAST) if wide else None


def padded(text: str, width: int, *, right: bool = False) -> str:
    """A text in a cell, at its left or its right end."""
    room = " " * (width - columns(text))
    return room + text if right else text + room


def shortened_middle(text: str, width: int) -> str:
    """A text without its middle, where it is too wide: a third stays of its beginning."""
    if columns(text) <= width:
        return text
    cut = _cut()
    room = max(width - len(cut), 0)
    head = _first(text, room // 3)
    tail = _first(text[::-1], room - columns(head))[::-1]
    return f"{head}{cut}{tail}"[:width]


def shortened(text: str, width: int) -> str:
    """A text without its end, where it is too wide."""
    if columns(text) <= width:
        return text
    cut = _cut()
    return f"{_first(text, max(width - len(cut), 0))}{cut}"[:width]


def _first(text: str, width: int) -> str:
    kept, wide = 0, 0
    for c in text:
        wide += columns(c)
        if wide > width:
            break
        kept += 1
    return text[:kept]


def _cut() -> str:
    """What stands for what is left out."""
    encoding = getattr(sys.stdout, "encoding", None) or "ascii"
    try:
        "\N{HORIZONTAL ELLIPSIS}".encode(encoding)
    except (UnicodeEncodeError, LookupError):
        return ".."
    return "\N{HORIZONTAL ELLIPSIS}"
