# SPDX-License-Identifier: BSD-3-Clause
"""A cost as one picture: what it says, the designs, and what each keeps and bears."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

from ..show.charts import BarChart, Chart, Key, KeyRow, style_of
from ..show.picture.charts import BETWEEN, INK, ROW, SOFT, draw_bars, draw_chart, width_of, written
from ..show.picture.files import still_bytes
from ..show.picture.make import shown_figure
from ..util.text import file_name, harmless
from .charts import bars_of, charts_of, choices_of, key_of, typeset
from .designs import CostValues
from .words import first_line

#: Measures of the head [inch], and sizes of its letters [pt].
_MARGIN, _LABEL, _RIGHT_END, _TOP, _ROOM = 0.3, 0.8, 11.8, 0.2, 0.12
_LINE, _TABLE_ROW, _SECOND = 0.31, 0.245, 0.17
_HEADLINE, _WORDS, _SMALL = 16.0, 10.5, 9.0
#: Least and most room between columns [inch]; what is released takes at most so many lines.
_GAP, _MOST_GAP, _LINES = 0.2, 0.4, 2


class Table(NamedTuple):
    """The table as it is drawn.

    Attributes:
        key: What it says.
        words: What each design releases, in lines.
        place: Where these begin [inch].
        cells: Where the columns begin [inch].
        heights: Of the rows [inch].
        headline: Above it, in lines.
    """

    key: Key
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
        return max((width_of(figure, each, _WORDS, weight) for each in words), default=0.0)

    first = _LABEL + width((row.label for row in key.rows), "bold") + _GAP
    wide = [
        max(
            width([head]),
            width([key.rows[0].cells[k]], "bold"),
            width(row.cells[k] for row in key.rows[1:]),
        )
        for k, head in enumerate(key.heads)
    ]
    told = [row.words if row.words != row.label else "" for row in key.rows]
    left = max(_RIGHT_END - first - sum(wide) - _GAP * (len(wide) + 1), 1.0)
    words = tuple(wrapped(figure, each, left, _WORDS) for each in told)
    needed = width(line for lines in words for line in lines)
    # What is not needed goes between the columns.
    gap = _GAP + max(0.0, min((left - needed) / (len(wide) + 1), _MOST_GAP - _GAP))
    place, cells = first + needed + gap * (needed > 0.0), []
    for each in wide:
        cells.append(place)
        place += each + gap
    heights = (_TABLE_ROW + _SECOND * max(len(lines) - 1, 0) for lines in words)
    lines = wrapped(figure, headline, _RIGHT_END - _MARGIN, _HEADLINE, "bold")
    return Table(key, words, first, cells, tuple(heights), lines)


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


#: How many notes stand in the picture; the words have them all.
_NOTES = 4


def draw_head(figure: Any, cost: CostValues, table: Table) -> None:
    """The headline, how it was found, and the table."""
    top = _TOP
    for line in table.headline:
        _text(figure, _MARGIN, top, line, _HEADLINE, INK, fontweight="bold")
        top += _LINE
    top += 0.04
    _text(figure, _MARGIN, top, ", ".join(choices_of(cost)), _WORDS, SOFT)
    top += _TABLE_ROW + 0.1
    for place, head in zip(table.cells, table.key.heads, strict=True):
        _text(figure, place, top, head, _WORDS - 0.5, SOFT)
    top += _TABLE_ROW
    for row, told, height in zip(table.key.rows, table.words, table.heights, strict=True):
        _draw_row(figure, table, row, told, top)
        top += height


def notes_of(figure: Any, cost: CostValues) -> list[str]:
    """What the deck does not allow, in lines that fit; measured on any figure."""
    room = _RIGHT_END - _MARGIN
    return [
        line
        for note in cost.left_out[:_NOTES]
        for line in wrapped(figure, harmless(f"{note[:1].upper()}{note[1:]}."), room, _SMALL)
    ]


def draw_notes(figure: Any, notes: list[str]) -> None:
    """Lines at the lower edge."""
    top = figure.get_figheight() - _SECOND * len(notes) - _ROOM
    for line in notes:
        _text(figure, _MARGIN, top, line, _SMALL, SOFT)
        top += _SECOND


def _draw_row(figure: Any, table: Table, row: KeyRow, told: list[str], top: float) -> None:
    from matplotlib.lines import Line2D

    look = style_of(row.series)
    whole, wide = figure.get_figheight(), figure.get_figwidth()
    middle = 1.0 - (top + 0.09) / whole
    figure.add_artist(
        Line2D(
            [_MARGIN / wide, (_LABEL - 0.1) / wide],
            [middle, middle],
            color=look.colour,
            lw=look.width,
            ls=(0, look.dashes) if look.dashes else "-",
        )
    )
    weight = "bold" if row.series == 0 else "normal"
    _text(figure, _LABEL, top, row.label, _WORDS, look.colour, fontweight=weight)
    for k, line in enumerate(told):
        _text(figure, table.place, top + k * _SECOND, line, _WORDS, INK)
    for place, cell in zip(table.cells, row.cells, strict=True):
        _text(figure, place, top, cell, _WORDS, INK, fontweight=weight)


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


#: Width [inch] and pixels an inch: 1200 pixels wide.
_WIDTH, _DPI = 12.0, 100
#: Heights of what stands below each other [inch].
_CHART, _ROW, _ABOVE, _BELOW = 2.15, 0.15, 0.3, 0.48
_END = 0.58
#: Room beside charts and bars for what stands there [inch].
_LEFT, _NAMES, _GROUPS, _RIGHT = 0.62, 0.82, 1.05, 0.35


def plot_of(cost: CostValues) -> Any:
    """The picture as a figure of matplotlib, which a notebook shows.

    Raises:
        FlexactError: matplotlib is missing.
    """
    # Words are measured before there is a figure with room for them.
    measure = shown_figure(dpi=_DPI)
    charts, bars = charts_of(cost), bars_of(cost)
    table = table_of(measure, key_of(cost), typeset(first_line(cost)))
    rows = max((each.height(ROW, BETWEEN) for each in bars), default=0.0)
    notes = notes_of(measure, cost)
    heights = (
        _TOP + _LINE * len(table.headline) + 2 * _TABLE_ROW + sum(table.heights) + _ROOM,
        (_ABOVE + _CHART + _BELOW) * bool(charts),
        (_ABOVE + _ROW * rows + _END) * bool(bars),
    )
    below = (_SECOND * len(notes) + _ROOM) * bool(notes)
    figure = shown_figure(figsize=(_WIDTH, sum(heights) + below), dpi=_DPI)
    draw_head(figure, cost, table)
    _draw_charts(figure, charts, heights[0])
    _draw_bars(figure, bars, heights[0] + heights[1])
    draw_notes(figure, notes)
    return figure


def plot_bytes(cost: CostValues, suffix: str = ".png") -> bytes:
    """The picture as a file: .png, .svg or .pdf.

    Raises:
        FlexactError: matplotlib is missing.
    """
    words = file_name(cost.name) or "cost", typeset(first_line(cost))
    return still_bytes(plot_of(cost), suffix, *words)


def _axes(figure: Any, left: float, top: float, width: float, height: float) -> Any:
    """Axes at a place from the upper left corner [inch]."""
    whole = figure.get_figheight()
    return figure.add_axes(
        (left / _WIDTH, 1.0 - (top + height) / whole, width / _WIDTH, height / whole)
    )


def _draw_charts(figure: Any, charts: tuple[Chart, ...], top: float) -> None:
    cell = (_WIDTH - 2 * _MARGIN + 0.15) / max(len(charts), 1)
    for k, chart in enumerate(charts):
        left, width = _MARGIN + k * cell + _LEFT, cell - _LEFT - _NAMES
        draw_chart(_axes(figure, left, top + _ABOVE, width, _CHART), chart)


def _draw_bars(figure: Any, bars: tuple[BarChart, ...], top: float) -> None:
    cell = (_WIDTH - 2 * _MARGIN) / max(len(bars), 1)
    for k, chart in enumerate(bars):
        left, width = _MARGIN + k * cell + _GROUPS, cell - _GROUPS - _RIGHT
        height = _ROW * chart.height(ROW, BETWEEN)
        draw_bars(_axes(figure, left, top + _ABOVE, width, height), chart)
