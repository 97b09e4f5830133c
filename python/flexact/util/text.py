# SPDX-License-Identifier: BSD-3-Clause
"""Text in columns of a terminal: how wide it is, and broken into rows."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Sequence

#: Columns of text where nobody says how many there are.
USUAL = 100
#: Holds words together while rows are broken.
TIE = "\N{NO-BREAK SPACE}"
#: Columns between those of a table.
_GAP = 2


def columns(text: str) -> int:
    """How many columns of a terminal a text takes."""
    if text.isascii():
        return len(text)
    return sum(map(_of_character, text))


def _of_character(c: str) -> int:
    if unicodedata.combining(c):
        return 0
    return 2 if unicodedata.east_asian_width(c) in "WF" else 1


def wrapped(text: str, width: int, indent: str = "", *, torn: bool = False) -> str:
    """A text in rows of at most `width` columns; words tied by no-break spaces stay together.

    Args:
        text: One row; blanks at its start stay.
        width: Columns.
        indent: In front of the second row and further ones.
        torn: Whether words that are wider than a row are torn apart.
    """
    if columns(text) <= width:
        return text.replace(TIE, " ")
    if len(indent) > width // 3:
        indent = ""
    rows, row = [], ""
    for word in _words(text, width - len(indent), torn):
        if not row:
            row = word
        elif columns(row) + 1 + columns(word) <= width:
            row = f"{row} {word}"
        else:
            rows.append(row)
            row = indent + word
    return "\n".join((*rows, row)).replace(TIE, " ")


def _words(text: str, width: int, torn: bool) -> Iterator[str]:
    """The words; blanks at the start belong to the first. Tied words that are too wide are not."""
    start = text[: len(text) - len(text.lstrip(" "))]
    for word in text[len(start) :].split(" "):
        told = start + word
        start = ""
        if not torn or columns(told) <= width:
            yield told
            continue
        for part in told.split(TIE):
            yield from _parts(part, width)


def _parts(word: str, width: int) -> Iterator[str]:
    """A word that is wider than a row, in pieces."""
    piece = ""
    for c in word:
        if piece and columns(piece + c) > width:
            yield piece
            piece = ""
        piece += c
    yield piece


def refitted(text: str, width: int) -> str:
    """A text of several rows in which those that are too wide are broken, words too if need be."""
    return "\n".join(
        row if columns(row) <= width else wrapped(row, width, _hanging(row), torn=True)
        for row in text.split("\n")
    )


def _hanging(row: str) -> str:
    return " " * (len(row) - len(row.lstrip(" ")) + 2)


def table(rows: Sequence[Sequence[str]], width: int, *, second: bool = False) -> str:
    """A table whose first row has its headings: in columns, or as a list where they do not fit.

    The first column is aligned to the left, others to the right.

    Args:
        rows: Headings and cells.
        width: Columns that there are.
        second: Whether headings go on in the second row.
    """
    widths = [max(columns(row[k]) for row in rows) for k in range(len(rows[0]))]
    if sum(widths) + _GAP * (len(widths) - 1) <= width:
        return "\n".join(_aligned(row, widths) for row in rows)
    heads, *others = rows
    if second:
        behind, *others = others
        heads = [" ".join(both).strip() for both in zip(heads, behind, strict=True)]
    return "\n".join(line for row in others for line in _listed(heads, row, width))


def _aligned(row: Sequence[str], widths: Sequence[int]) -> str:
    cells = [
        cell + " " * (width - columns(cell)) if k == 0 else " " * (width - columns(cell)) + cell
        for k, (cell, width) in enumerate(zip(row, widths, strict=True))
    ]
    return (" " * _GAP).join(cells).rstrip()


def _listed(heads: Sequence[str], row: Sequence[str], width: int) -> Iterator[str]:
    """A row of the table: its name, and below it what stands in its columns."""
    yield wrapped(row[0], width, torn=True)
    for head, cell in zip(heads[1:], row[1:], strict=True):
        if cell:
            yield wrapped(f"  {head.strip()}: {cell}", width, "    ", torn=True)
