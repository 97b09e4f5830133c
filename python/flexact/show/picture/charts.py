# SPDX-License-Identifier: BSD-3-Clause
"""Charts put down with matplotlib: curves with their names at their ends, marks, and bands."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ...util.text import harmless
from ..charts import Bar, BarChart, Chart, Mark, Scale, apart, mark_side, style_of, told

INK, SOFT, GRID = "#18212d", "#566273", "#dfe4ea"
#: Sizes of letters [pt].
TITLE, WORDS, SMALL = 11.5, 10.0, 9.0
#: Height of a line of letters, times their size, and room between a curve's end and its name [pt].
LINE, _BESIDE = 1.25, 7.0
#: Width of a letter, times its size.
LETTER = 0.62
_HALO = 2.5
#: How far below or above its place a mark is told [pt].
_UNDER, _OVER = 20.0, 5.0


def written(words: str) -> str:
    """Words as matplotlib writes them as they are."""
    return harmless(words).replace("$", r"\$")


def draw_chart(axes: Any, chart: Chart) -> None:
    """A chart on empty axes; names of curves stand to the right of them."""
    draw_axis(axes, "x", chart.x)
    draw_axis(axes, "y", chart.y)
    axes.set_title(
        written(chart.heading),
        loc="left",
        fontsize=TITLE,
        color=INK,
        pad=7,
    )
    axes.set_xlabel(written(chart.along), fontsize=WORDS, color=SOFT, labelpad=2)
    for curve in chart.curves:
        look = style_of(curve.series)
        for run in curve.runs:
            x, y, spread = curve.x[run], curve.y[run], curve.spread[run]
            axes.plot(
                x,
                y,
                color=look.colour,
                lw=look.width,
                ls=(0, look.dashes) if look.dashes else "-",
                zorder=3 + curve.series / 10,
                solid_capstyle="butt",
            )
            if np.any(spread > 0.0):
                axes.fill_between(
                    x, y - spread, y + spread, color=look.colour, alpha=0.18, lw=0, zorder=2
                )
    for mark in chart.marks:
        _draw_mark(axes, chart, mark)
    _name_curves(axes, chart)


def draw_axis(axes: Any, which: str, scale: Scale) -> None:
    """Ticks, their words and a quiet grid along x or y."""
    getattr(axes, f"set_{which}scale")("log" if scale.is_log else "linear")
    getattr(axes, f"set_{which}lim")(scale.low, scale.high)
    axis = getattr(axes, f"{which}axis")
    labels = scale.labels
    if which == "x":
        wide = axes.get_window_extent().width * 72.0 / axes.get_figure().dpi
        labels = scale.labels_for(wide / (LETTER * WORDS))
    axis.set_ticks(scale.ticks, [written(label) for label in labels])
    axis.set_ticks([], minor=True)
    axes.tick_params(axis=which, labelsize=WORDS, colors=SOFT, length=0, pad=3)
    axes.grid(True, axis=which, which="major", color=GRID, lw=0.8)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_color("#9aa5b3")


def halo() -> list[Any]:
    """What keeps letters apart from lines behind them."""
    from matplotlib.patheffects import withStroke

    return [withStroke(linewidth=_HALO, foreground="white")]


def _draw_mark(axes: Any, chart: Chart, mark: Mark) -> None:
    colour = style_of(mark.series).colour
    for point in mark.points:
        axes.plot(*point, "o", ms=6, mfc="white", mec=colour, mew=1.8, zorder=6, clip_on=False)
    x, y = np.mean(mark.points, axis=0).tolist()
    across, up = float(chart.x.share(x)), float(chart.y.share(y))
    side, below = mark_side(mark, across, up)
    axes.annotate(
        written(mark.words),
        (x, y),
        xytext=(8.0 * side, -_UNDER if below else _OVER),
        textcoords="offset points",
        ha=("center", "left", "right")[side],
        va="top" if below else "bottom",
        fontsize=WORDS,
        color=colour,
        zorder=7,
        path_effects=halo(),
    )


def _name_curves(axes: Any, chart: Chart) -> None:
    """Names at the right, as near to the ends as there is room, with a line where they are not."""
    found = chart.ends
    height = axes.get_window_extent().height * 72.0 / axes.get_figure().dpi
    wanted = np.array([float(chart.y.share(end[1])) for _, end in found]) * height
    places = apart(wanted, WORDS * LINE, -WORDS, height + WORDS)
    width = axes.get_window_extent().width * 72.0 / axes.get_figure().dpi
    for (curve, end), place in zip(found, places.tolist(), strict=True):
        colour = style_of(curve.series).colour
        across = float(chart.x.share(end[0])) * width
        axes.annotate(
            written(curve.label),
            end,
            xycoords="data",
            xytext=(width - across + _BESIDE, place - float(chart.y.share(end[1])) * height),
            textcoords="offset points",
            ha="left",
            va="center",
            fontsize=WORDS,
            fontweight="bold" if curve.series == 0 else "normal",
            color=colour,
            annotation_clip=False,
            arrowprops={
                "arrowstyle": "-",
                "color": colour,
                "lw": 0.7,
                "shrinkA": 0,
                "shrinkB": 1,
                "relpos": (0.0, 0.5),
            },
        )


def width_of(figure: Any, words: str, size: float, weight: str = "normal") -> float:
    """How wide words are on a figure [inch]."""
    text = figure.text(0.0, 0.0, written(words), fontsize=size, fontweight=weight)
    width = text.get_window_extent().width / figure.dpi
    text.remove()
    return float(width)


#: Heights of a row and of the room between groups, by which bars are measured.
ROW, BETWEEN = 1.0, 0.5
#: The look of what is no thick bar.
_LINE: Any = {"lw": 1.1, "alpha": 0.6, "solid_capstyle": "butt"}


def draw_bars(axes: Any, chart: BarChart) -> None:
    """Bars on empty axes; labels of groups and rows stand to the left of them."""
    draw_axis(axes, "x", chart.x)
    axes.set_yticks([])
    axes.spines["left"].set_visible(False)
    axes.set_ylim(chart.height(ROW, BETWEEN), 0.0)
    axes.set_title(written(chart.heading), loc="left", fontsize=TITLE, color=INK, pad=7)
    for number, (group, place, height, rows) in enumerate(chart.layout(0.0, ROW, BETWEEN)):
        if number % 2:
            axes.axhspan(place, place + height, color="#f4f6f9", lw=0, zorder=0)
        _beside(axes, place + height / 2, group.label, 18.0, INK)
        for row, top in rows:
            _beside(axes, top + 0.5, row.label, 5.0, SOFT)
            for bar, (middle, thick) in zip(row.bars, row.slots, strict=True):
                _draw_bar(axes, chart, bar, top + middle, thick)
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
    if bar.series:
        return
    axes.annotate(
        written(told(bar.value, chart.x.si, 2)),
        (bar.value, middle),
        xytext=(4.0, 0.0),
        textcoords="offset points",
        ha="left",
        va="center",
        fontsize=SMALL - 0.5,
        color=look.colour,
        zorder=6,
        path_effects=halo(),
    )
