# SPDX-License-Identifier: BSD-3-Clause
"""The head of the picture of a cost: the sentence that counts, and the designs with their looks."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from typing import Any, NamedTuple

from ..drawing.charts.series import style_of
from ..picture.charts import INK, SOFT, width_of, written
from .designs import CostValues
from .key import Key, KeyRow, choices_of, typeset
from .words import first_line


class Head(NamedTuple):
    """Measures of the head [inch], and sizes of its letters [pt]."""

    left: float = 0.3
    top: float = 0.2
    line: float = 0.31
    row: float = 0.245
    room: float = 0.2
    headline: float = 16.0
    words: float = 10.5


HEAD = Head()
#: Letters of a line of the headline, and lines of it.
_LETTERS, _LINES = 96, 2
#: Where looks and labels stand, where the table ends, least and most room between columns.
_LOOK, _LABEL, _END, _GAP, _MOST_GAP = 0.3, 0.8, 11.8, 0.2, 0.4
#: Words are not made shorter than so many letters.
_FEWEST = 12


def head_height(cost: CostValues, key: Key) -> float:
    """How high the head is [inch]."""
    rows = 2 + len(key.rows)
    return HEAD.top + HEAD.line * len(_headline(cost)) + HEAD.row * rows + HEAD.room


def _headline(cost: CostValues) -> list[str]:
    return textwrap.wrap(typeset(first_line(cost)), _LETTERS)[:_LINES]


def draw_head(figure: Any, cost: CostValues, key: Key) -> None:
    """The headline, how it was found, and the table."""
    top = HEAD.top
    for line in _headline(cost):
        _text(figure, _LOOK, top, line, HEAD.headline, INK, fontweight="bold")
        top += HEAD.line
    top += 0.04
    _text(figure, _LOOK, top, ", ".join(choices_of(cost)), HEAD.words, SOFT)
    top += HEAD.row + 0.1
    columns = _columns(figure, key)
    for place, head in zip(columns.cells, key.heads, strict=True):
        _text(figure, place, top, head, HEAD.words - 0.5, SOFT)
    for row in key.rows:
        top += HEAD.row
        _draw_row(figure, row, top, columns)


class _Columns(NamedTuple):
    """Where columns begin [inch], and how wide the words may be."""

    words: float
    room: float
    cells: list[float]


def _columns(figure: Any, key: Key) -> _Columns:
    """As wide as what stands in them; the words of what is released have what is left."""

    def width(words: Iterable[str], weight: str = "normal") -> float:
        return max((width_of(figure, each, HEAD.words, weight) for each in words), default=0.0)

    first = _LABEL + width((row.label for row in key.rows), "bold") + _GAP
    wide = [
        max(
            width([head]),
            width([key.rows[0].cells[k]], "bold"),
            width(r.cells[k] for r in key.rows),
        )
        for k, head in enumerate(key.heads)
    ]
    needed = width(row.words for row in key.rows if row.words != row.label)
    left = _END - first - sum(wide) - _GAP * (len(wide) + 1)
    # What is not needed goes between the columns.
    gap = _GAP + max(0.0, min((left - needed) / (len(wide) + 1), _MOST_GAP - _GAP))
    place = first + min(needed, max(left, 0.0)) + gap
    cells = []
    for each in wide:
        cells.append(place)
        place += each + gap
    return _Columns(first, min(needed, max(left, 0.0)), cells)


def _fitting(figure: Any, words: str, room: float) -> str:
    """As many words as there is room for."""
    letters = len(words)
    while letters > _FEWEST and width_of(figure, words, HEAD.words) > room + 0.02:
        letters -= 1
        words = f"{words[:letters].rstrip(' ;:,-')}\N{HORIZONTAL ELLIPSIS}"
    return words


def _draw_row(figure: Any, row: KeyRow, top: float, columns: _Columns) -> None:
    from matplotlib.lines import Line2D

    look = style_of(row.series)
    whole, wide = figure.get_figheight(), figure.get_figwidth()
    middle = 1.0 - (top + 0.09) / whole
    figure.add_artist(
        Line2D(
            [_LOOK / wide, (_LABEL - 0.1) / wide],
            [middle, middle],
            color=look.colour,
            lw=look.width,
            ls=(0, look.dashes) if look.dashes else "-",
        )
    )
    weight = "bold" if row.series == 0 else "normal"
    _text(figure, _LABEL, top, row.label, HEAD.words, look.colour, fontweight=weight)
    if row.words != row.label:
        words = _fitting(figure, row.words, columns.room)
        _text(figure, columns.words, top, words, HEAD.words, INK)
    for place, cell in zip(columns.cells, row.cells, strict=True):
        _text(figure, place, top, cell, HEAD.words, INK, fontweight=weight)


def _text(
    figure: Any, left: float, top: float, words: str, size: float, colour: str, **more: Any
) -> None:
    figure.text(
        left / figure.get_figwidth(),
        1.0 - top / figure.get_figheight(),
        written(words),
        fontsize=size,
        color=colour,
        ha="left",
        va="top",
        **more,
    )
