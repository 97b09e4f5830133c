# SPDX-License-Identifier: BSD-3-Clause
"""The head of the picture of a cost: the sentence that counts, and the designs with their looks."""

from __future__ import annotations

from typing import Any

from ..show.picture.charts import INK, SOFT, written
from ..show.series import style_of
from ..util.plain_text import harmless
from .designs import CostValues
from .key import KeyRow, choices_of
from .plot_table import HEAD, Table, wrapped

#: How many notes stand in the picture; the words have them all.
_NOTES = 4


def head_height(table: Table) -> float:
    """How high the head is [inch]."""
    lines = HEAD.line * len(table.headline)
    return HEAD.top + lines + 2 * HEAD.row + sum(table.heights) + HEAD.room


def draw_head(figure: Any, cost: CostValues, table: Table) -> None:
    """The headline, how it was found, and the table."""
    top = HEAD.top
    for line in table.headline:
        _text(figure, HEAD.left, top, line, HEAD.headline, INK, fontweight="bold")
        top += HEAD.line
    top += 0.04
    _text(figure, HEAD.left, top, ", ".join(choices_of(cost)), HEAD.words, SOFT)
    top += HEAD.row + 0.1
    for place, head in zip(table.cells, table.heads, strict=True):
        _text(figure, place, top, head, HEAD.words - 0.5, SOFT)
    top += HEAD.row
    for row, told, height in zip(table.rows, table.words, table.heights, strict=True):
        _draw_row(figure, table, row, told, top)
        top += height


def notes_of(figure: Any, cost: CostValues) -> list[str]:
    """What the deck does not allow, in lines that fit; measured on any figure."""
    room = HEAD.end - HEAD.left
    return [
        line
        for note in cost.left_out[:_NOTES]
        for line in wrapped(figure, harmless(f"{note[:1].upper()}{note[1:]}."), room, HEAD.small)
    ]


def draw_notes(figure: Any, notes: list[str]) -> None:
    """Lines at the lower edge."""
    top = figure.get_figheight() - HEAD.second * len(notes) - HEAD.room
    for line in notes:
        _text(figure, HEAD.left, top, line, HEAD.small, SOFT)
        top += HEAD.second


def _draw_row(figure: Any, table: Table, row: KeyRow, told: list[str], top: float) -> None:
    from matplotlib.lines import Line2D

    look = style_of(row.series)
    whole, wide = figure.get_figheight(), figure.get_figwidth()
    middle = 1.0 - (top + 0.09) / whole
    figure.add_artist(
        Line2D(
            [HEAD.left / wide, (HEAD.label - 0.1) / wide],
            [middle, middle],
            color=look.colour,
            lw=look.width,
            ls=(0, look.dashes) if look.dashes else "-",
        )
    )
    weight = "bold" if row.series == 0 else "normal"
    _text(figure, HEAD.label, top, row.label, HEAD.words, look.colour, fontweight=weight)
    for k, line in enumerate(told):
        _text(figure, table.place, top + k * HEAD.second, line, HEAD.words, INK)
    for place, cell in zip(table.cells, row.cells, strict=True):
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
