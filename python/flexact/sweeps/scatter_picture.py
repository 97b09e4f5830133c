# SPDX-License-Identifier: BSD-3-Clause
"""Scatter as a picture: a row a quantity, its histogram and whose its variance is."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from ..show.charts import unit_for
from ..show.picture.files import still_bytes
from ..show.picture.make import shown_figure
from .plots import finished

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .scatter_result import Scatter

#: Width of the picture, height of a row and room above [inch].
_WIDTH, _ROW, _ABOVE, _DPI = 9.0, 1.75, 0.7, 120
_MOST_BINS, _MOST_BARS, _MOST_ROWS = 48, 5, 7
_SAMPLES, _BEYOND, _ALONE, _TOGETHER, _INK = "#4477aa", "#cc6677", "#225588", "#bbccdd", "#111827"


def picture_bytes(scatter: Scatter, suffix: str) -> bytes:
    """The picture as a file of a suffix."""
    return still_bytes(_drawn(scatter), suffix, repr(scatter), scatter.describe())


def figure_of_scatter(scatter: Scatter, path: str | os.PathLike[str] | None) -> Figure:
    """The figure, also written to a file if one is named; see `Scatter.plot`."""
    return finished(_drawn(scatter), path, repr(scatter), scatter.describe())


def _drawn(scatter: Scatter) -> Any:
    rows = _chosen(scatter)
    figure = shown_figure(
        figsize=(_WIDTH, _ABOVE + _ROW * len(rows)), dpi=_DPI, layout="constrained"
    )
    grid = figure.subplots(len(rows), 2, squeeze=False, width_ratios=(3, 2))
    for (left, right), q in zip(grid, rows, strict=True):
        _histogram(left, scatter, q)
        _bars(right, scatter, q)
    grid[0][0].set_title(f"{len(scatter):,} samples", fontsize=10, loc="left", pad=12)
    title = "of the variance: alone, with others"
    grid[0][1].set_title(title, fontsize=10, loc="left", pad=12)
    return figure


def _chosen(scatter: Scatter) -> list[int]:
    """What is limited, then the other quantities; of the errors the largest of each kind."""
    limited = {each.name for each in scatter.kept}
    sizes = scatter.values.std(axis=0, where=np.isfinite(scatter.values))
    errors = [q for q, each in enumerate(scatter.answers) if each.words.startswith("error")]
    largest = [
        max((q for q in errors if scatter.answers[q].unit == unit), key=lambda q: sizes[q])
        for unit in dict.fromkeys(scatter.answers[q].unit for q in errors)
    ]
    every = range(len(scatter.answers))
    made = [q for q in every if scatter.answers[q].name in limited]
    # Of the stress and its part of the strength one is enough.
    left = ("stress", "strength") if limited & {"stress", "strength"} else ("strength",)
    made += [q for q in every if q not in errors and scatter.answers[q].name not in left]
    varying = [q for q in dict.fromkeys((*made, *largest)) if sizes[q] > 0.0]
    return varying[:_MOST_ROWS] or made[:1] or [0]


def _histogram(axes: Any, scatter: Scatter, q: int) -> None:
    answer = scatter.answers[q]
    values = scatter.values[:, q][np.isfinite(scatter.values[:, q])]
    written = unit_for(values, answer.unit) if answer.unit else unit_for([], "")
    size, name = (written.size, written.name) if answer.unit else (0.01, "%")
    if answer.unit == "N m":
        size = 1.0 / scatter.units.factor("N m")
        name = scatter.units.symbol("N m")
    limits = [(each.value, each) for each in scatter.kept if each.name == answer.name]
    drawn = values / size
    low, high = float(drawn.min()), float(drawn.max())
    count = int(min(_MOST_BINS, 8 + 0.8 * len(drawn) ** 0.5))
    bins = np.linspace(low, high if high > low else low + max(abs(low), 1.0) * 1e-3, count + 1)
    beyond = np.zeros(values.shape, np.bool_)
    for value, each in limits:
        beyond |= values < value if each.is_least else np.abs(values) > value
    axes.hist(
        [drawn[~beyond], drawn[beyond]], bins, stacked=True, color=[_SAMPLES, _BEYOND], zorder=2
    )
    # What is far beyond the samples would leave them no room.
    for value, each in limits:
        signs = (1.0,) if each.is_least or values.min() >= 0.0 else (-1.0, 1.0)
        for place in (sign * value / size for sign in signs):
            if low - (high - low) <= place <= high + (high - low):
                axes.axvline(place, color=_BEYOND, lw=1.4, ls="--", zorder=4)
    designed = float(scatter.designed[q]) / size
    if low - (high - low) <= designed <= high + (high - low):
        axes.axvline(designed, color=_INK, lw=1.2, zorder=4)
        axes.annotate(
            *("as designed", (designed, 1.0)),
            xycoords=("data", "axes fraction"),
            xytext=(0, 1.5),
            textcoords="offset points",
            ha="center",
            fontsize=7.5,
            color=_INK,
        )
    axes.set_xlabel(f"{answer.words} [{name}]", fontsize=9)
    axes.tick_params(labelsize=8)
    axes.set_yticks([])
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)


def _bars(axes: Any, scatter: Scatter, q: int) -> None:
    names = list(scatter.shares(scatter.answers[q].name).items())[:_MOST_BARS]
    short = {each.name: each.short for each in scatter.inputs}
    for place, (_, (first, total)) in enumerate(names):
        alone, whole = np.nan_to_num([first, min(total, 1.0)])
        axes.barh(place, max(alone, whole), color=_TOGETHER, height=0.62, zorder=2)
        axes.barh(place, alone, color=_ALONE, height=0.62, zorder=3)
        if max(alone, whole) < 0.01:
            axes.annotate(
                *("below 1 %", (0.01, place)), va="center", fontsize=7, color=_INK, zorder=4
            )
    axes.set_yticks(range(len(names)), [short[name] for name, _ in names], fontsize=7.5)
    axes.set_ylim(_MOST_BARS - 0.5, -0.5)
    axes.set_xlim(0.0, 1.0)
    axes.set_xticks([0.0, 0.5, 1.0], ["0", "50 %", "100 %"], fontsize=8)
    axes.grid(True, axis="x", color="#e5e7eb", lw=0.7, zorder=0)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)
