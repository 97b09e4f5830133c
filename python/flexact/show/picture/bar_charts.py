# SPDX-License-Identifier: BSD-3-Clause
"""Bars by groups put down with matplotlib; one that has no end runs out of the chart."""

from __future__ import annotations

import math
from typing import Any

from ..charts import Bar, BarChart
from ..series import style_of
from ..units import told
from .charts import INK, SMALL, SOFT, TITLE, draw_axis, halo, written

#: Room between groups, in heights of a row.
_BETWEEN = 0.5
#: The look of what is no thick bar.
_LINE: Any = {"lw": 1.1, "alpha": 0.6, "solid_capstyle": "butt"}


def bars_height(chart: BarChart) -> float:
    """How many rows high a chart is, with the room between groups."""
    return chart.rows + _BETWEEN * len(chart.groups)


def draw_bars(axes: Any, chart: BarChart) -> None:
    """Bars on empty axes; labels of groups and rows stand to the left of them."""
    draw_axis(axes, "x", chart.x)
    axes.set_yticks([])
    axes.spines["left"].set_visible(False)
    axes.set_ylim(bars_height(chart), 0.0)
    axes.set_title(
        written(f"{chart.title}{chart.x.heading}"), loc="left", fontsize=TITLE, color=INK, pad=7
    )
    place = 0.0
    for number, group in enumerate(chart.groups):
        height = len(group.rows) + _BETWEEN
        if number % 2:
            axes.axhspan(place, place + height, color="#f4f6f9", lw=0, zorder=0)
        middle = place + height / 2
        _beside(axes, middle, group.label, 18.0, INK)
        for row in group.rows:
            centre = place + _BETWEEN / 2 + 0.5
            _beside(axes, centre, row.label, 5.0, SOFT)
            for bar, (middle, thick) in zip(row.bars, row.slots, strict=True):
                _draw_bar(axes, chart, bar, centre - 0.5 + middle, thick)
            place += 1.0
        place += _BETWEEN
    if chart.note:
        axes.set_xlabel(written(chart.note), fontsize=SMALL, color=SOFT, loc="left")


def _beside(axes: Any, place: float, words: str, far: float, colour: str) -> None:
    axes.annotate(
        written(words),
        (0.0, place),
        xycoords=axes.get_yaxis_transform(),
        xytext=(-far, 0.0),
        textcoords="offset points",
        ha="right",
        va="center",
        fontsize=SMALL,
        color=colour,
        annotation_clip=False,
    )


def _draw_bar(axes: Any, chart: BarChart, bar: Bar, middle: float, thick: float) -> None:
    scale, look = chart.x, style_of(bar.series)
    is_open = not math.isfinite(bar.value)
    end = scale.high if is_open else bar.value
    if is_open or bar.series:
        axes.plot([scale.low, end], [middle, middle], color=look.colour, **_LINE, zorder=2)
        mark = {"marker": ">" if is_open else "o", "ms": 4.0, "color": look.colour, "mew": 0}
        axes.plot(end, middle, clip_on=False, zorder=4, **mark)
    else:
        place = {"height": thick, "left": scale.low}
        axes.barh(middle, end - scale.low, **place, color=look.colour, lw=0, zorder=3)
    if is_open:
        return
    if bar.spread > 0.0:
        ends = [max(bar.value - bar.spread, scale.low), min(bar.value + bar.spread, scale.high)]
        axes.plot(ends, [middle, middle], color=INK, lw=1.2, zorder=5, solid_capstyle="butt")
    if bar.series == 0:
        _tell(axes, chart, bar, middle)


def _tell(axes: Any, chart: BarChart, bar: Bar, middle: float) -> None:
    axes.annotate(
        written(told(bar.value, chart.x.si, 2)),
        (bar.value, middle),
        xytext=(4.0, 0.0),
        textcoords="offset points",
        ha="left",
        va="center",
        fontsize=SMALL - 0.5,
        color=style_of(bar.series).colour,
        zorder=6,
        path_effects=halo(),
    )
