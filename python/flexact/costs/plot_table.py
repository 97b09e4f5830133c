# SPDX-License-Identifier: BSD-3-Clause
"""Where the table of the designs stands in the picture: columns as wide as what is in them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

from ..show.picture.charts import width_of
from .key import Key, KeyRow


class Head(NamedTuple):
    """Measures of the head [inch], and sizes of its letters [pt]."""

    left: float = 0.3
    label: float = 0.8
    end: float = 11.8
    top: float = 0.2
    line: float = 0.31
    row: float = 0.245
    second: float = 0.17
    room: float = 0.12
    headline: float = 16.0
    words: float = 10.5
    small: float = 9.0


HEAD = Head()
#: Least and most room between columns [inch]; what is released takes at most so many lines.
_GAP, _MOST_GAP, _LINES = 0.2, 0.4, 2


class Table(NamedTuple):
    """The table as it is drawn.

    Attributes:
        heads: Of the columns.
        rows: The designs.
        words: What each releases, in lines.
        place: Where these begin [inch].
        cells: Where the columns begin [inch].
        heights: Of the rows [inch].
        headline: Above it, in lines.
    """

    heads: tuple[str, ...]
    rows: tuple[KeyRow, ...]
    words: tuple[list[str], ...]
    place: float
    cells: list[float]
    heights: tuple[float, ...]
    headline: list[str]


def table_of(figure: Any, key: Key, headline: str) -> Table:
    """The table as wide as the figure; what is released has the room that is left.

    Args:
        figure: Any figure, with which letters are measured.
        key: What it says.
        headline: What stands above.
    """

    def width(words: Iterable[str], weight: str = "normal") -> float:
        return max((width_of(figure, each, HEAD.words, weight) for each in words), default=0.0)

    first = HEAD.label + width((row.label for row in key.rows), "bold") + _GAP
    wide = [
        max(
            width([head]),
            width([key.rows[0].cells[k]], "bold"),
            width(row.cells[k] for row in key.rows[1:]),
        )
        for k, head in enumerate(key.heads)
    ]
    told = [row.words if row.words != row.label else "" for row in key.rows]
    left = max(HEAD.end - first - sum(wide) - _GAP * (len(wide) + 1), 1.0)
    words = tuple(wrapped(figure, each, left, HEAD.words) for each in told)
    needed = width(line for lines in words for line in lines)
    # What is not needed goes between the columns.
    gap = _GAP + max(0.0, min((left - needed) / (len(wide) + 1), _MOST_GAP - _GAP))
    place, cells = first + needed + gap * (needed > 0.0), []
    for each in wide:
        cells.append(place)
        place += each + gap
    heights = (HEAD.row + HEAD.second * max(len(lines) - 1, 0) for lines in words)
    lines = wrapped(figure, headline, HEAD.end - HEAD.left, HEAD.headline, "bold")
    return Table(key.heads, key.rows, words, first, cells, tuple(heights), lines)


def wrapped(figure: Any, text: str, room: float, size: float, weight: str = "normal") -> list[str]:
    """Words in two lines that fit; what does not fit into the last is cut."""
    lines: list[str] = []
    for word in text.split():
        longer = f"{lines[-1]} {word}" if lines else word
        is_last = len(lines) == _LINES
        if lines and (is_last or width_of(figure, longer, size, weight) <= room + 0.02):
            lines[-1] = longer
        else:
            lines.append(word)
    return [_cut(figure, line, room, size, weight) for line in lines]


def _cut(figure: Any, line: str, room: float, size: float, weight: str) -> str:
    told = line
    while len(line) > 1 and width_of(figure, told, size, weight) > room + 0.02:
        line = line[:-1].rstrip(" ;:,-")
        told = f"{line}\N{HORIZONTAL ELLIPSIS}"
    return told
