# SPDX-License-Identifier: BSD-3-Clause
"""How singular values and margins are spread, as a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..analysis.verdict import Verdict
from ..core.arrays import FloatArray
from .plot import SINGULAR_COLOUR, add_legend, figure_of, label, smallest_values

if TYPE_CHECKING:
    from .table import Table

_BINS = 48
#: What is smaller than this part of the median is zero: it stands in the first bin.
_ZERO = 1.0e-6


def histograms(table: Table, nominal: Table, below: float | None) -> Any:
    """The figure; see `Tolerances.plot`."""
    figure = figure_of(2)
    value, margin = figure.subplots(2, 1)
    _draw(value, table, smallest_values(table), [(smallest_values(nominal)[0], "as designed")])
    label(value, "smallest singular value (scaled)", "samples")
    lines = [(nominal.margin[0], "as designed")]
    lines += [] if below is None else [(below, "asked about")]
    _draw(margin, table, table.margin, lines)
    label(margin, "margin [m]", "samples")
    add_legend(value, table, has_singular=False, marks=False)
    return figure


def _draw(axes: Any, table: Table, values: FloatArray, lines: list[tuple[float, str]]) -> None:
    there = np.isfinite(values)
    axes.set_xscale("log")
    positive = values[there & (values > 0.0)]
    low = 0.0
    if positive.size:
        low = max(positive.min(), _ZERO * np.median(positive))
        drawn = [place for place, _ in lines if np.isfinite(place) and place > low]
        high = max([positive.max() * 1.0001, *drawn])
        edges = np.geomspace(low, max(high, 1.001 * low), _BINS + 1)
        found = [
            (each, np.clip(values[there & (table.verdict == each.value)], edges[0], edges[-1]))
            for each in Verdict
        ]
        found = [(each, part) for each, part in found if part.size]
        colours = [each.colour for each, _ in found]
        axes.hist([part for _, part in found], edges, stacked=True, color=colours, zorder=2)
    for place, words in lines:
        if np.isfinite(place) and place >= low:
            _mark(axes, place, words)
        elif np.isfinite(place):
            axes.set_title(f"{words}: {place:.2g}", fontsize=9, loc="left")
    beyond = int((~there & ~table.has_error).sum())
    if beyond:
        axes.set_title(f"{beyond} without limit", fontsize=9, loc="right")
    axes.grid(True, axis="y", color="#e5e7eb", lw=0.7, zorder=0)


def _mark(axes: Any, place: float, words: str) -> None:
    axes.axvline(place, color=SINGULAR_COLOUR, lw=1.2, ls="--", zorder=4)
    where = {"xycoords": ("data", "axes fraction"), "textcoords": "offset points"}
    axes.annotate(words, (place, 1.0), xytext=(0, 3), ha="center", fontsize=9, **where)
