# SPDX-License-Identifier: BSD-3-Clause
"""A map of two parameters: the verdict in colour, and the singular curves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..analysis.units import length_in_words
from ..core.arrays import BoolArray, FloatArray
from .crossing import Crossings
from .curves import curves_of
from .plot import (
    SINGULAR_COLOUR,
    add_legend,
    figure_of,
    label,
    mark_rows,
    smallest_values,
    verdict_colours,
)

if TYPE_CHECKING:
    from .table import Table

#: A map is of cells where so large a part of them is there.
_FULL = 0.5
#: Paler by so much at most, between the lowest and the highest part of the values.
_PALEST, _ENDS = 0.75, (0.02, 0.8)
#: Behind the crosses of errors.
WRONG = "#e5e7eb"
#: So many contours of the margin.
_MOST_CONTOURS = 6


def parameter_map(table: Table, x: str, y: str, crossings: Crossings) -> Any:
    """The figure of a map; see `Table.plot`.

    Raises:
        ValueError: another parameter changes, too.
    """
    columns = table[x].astype(float), table[y].astype(float)
    cells = _cells(table, x, y, columns)
    figure = figure_of()
    axes = figure.subplots()
    if cells is None:
        sound = ~table.has_error
        points = (column[sound] for column in columns)
        axes.scatter(*points, c=verdict_colours(table)[sound], s=22, zorder=3)
    else:
        _draw_cells(axes, cells, columns, _shaded(table), table.has_error)
        _draw_contours(axes, table, cells, columns)
    has_singular = _draw_singular(axes, crossings, x, y, columns)
    mark_rows(axes, table, *columns)
    label(axes, x, y)
    if cells is not None and "gap" in table.columns:
        told = "Paler: a smaller singular value. Thin lines: margin."
        axes.set_title(told, fontsize=10, loc="left", color="#374151")
    add_legend(axes, table, has_singular=has_singular, marks=cells is None)
    return figure


def _cells(
    table: Table, x: str, y: str, columns: tuple[FloatArray, FloatArray]
) -> np.ndarray | None:
    """(values of y, values of x) row of each cell, -1 where there is none; None: no grid.

    Raises:
        ValueError: several rows have the same parameters.
    """
    if not np.isfinite(columns).all():
        return None
    (xs, i), (ys, j) = (np.unique(column, return_inverse=True) for column in columns)
    made = np.full((ys.size, xs.size), -1)
    made[j, i] = np.arange(len(table))
    there = int((made >= 0).sum())
    if there < len(table):
        others = [name for name in table.parameter_names if name not in (x, y)]
        choose = f"one value of {' and '.join(others)}" if others else "one of them each"
        raise ValueError(
            f"several rows have the same {x} and {y}: choose {choose}, such as "
            f"table[table[{others[0] if others else x!r}] == ...]"
        )
    return made if there >= _FULL * made.size and min(made.shape) > 1 else None


def _shaded(table: Table) -> FloatArray:
    """(variants, 3) the colour of each row, paler for smaller singular values."""
    colours = verdict_colours(table)
    if "gap" not in table.columns:
        return colours
    values = smallest_values(table)
    # Singular rows keep their full colour.
    there = (values > 0.0) & (table.rank == table.rank.max(initial=0))
    if not there.any():
        return colours
    logs = np.log10(values[there])
    low, high = np.quantile(logs, _ENDS)
    share = np.clip((logs - low) / max(high - low, 1e-12), 0.0, 1.0)
    pale = (_PALEST * (1.0 - share))[:, None]
    colours[there] += (1.0 - colours[there]) * pale
    return colours


def _draw_cells(
    axes: Any,
    cells: np.ndarray,
    columns: tuple[FloatArray, FloatArray],
    colours: FloatArray,
    wrong: BoolArray,
) -> None:
    from matplotlib.colors import to_rgba

    image = np.ones((*cells.shape, 4))
    image[..., :3] = colours[cells]
    image[wrong[cells]] = to_rgba(WRONG)
    image[cells < 0] = 0.0
    edges = [_edges(np.unique(column)) for column in columns]
    axes.pcolormesh(*edges, image, rasterized=True)
    axes.set_xlim(edges[0][0], edges[0][-1])
    axes.set_ylim(edges[1][0], edges[1][-1])


def _edges(values: FloatArray) -> FloatArray:
    """Between the values, and as far beyond the ends."""
    middle = 0.5 * (values[1:] + values[:-1])
    return np.concatenate(([2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]))


def _draw_contours(
    axes: Any, table: Table, cells: np.ndarray, columns: tuple[FloatArray, FloatArray]
) -> None:
    """Where the margin has round values."""
    if "margin" not in table.columns or min(cells.shape) < 4:
        return
    margin = np.where(cells >= 0, table["margin"][cells], np.nan)
    margin[~np.isfinite(margin)] = np.nan
    levels = _round_levels(margin)
    if not levels:
        return
    drawn = axes.contour(
        np.unique(columns[0]),
        np.unique(columns[1]),
        margin,
        levels=levels,
        colors="#1f2937",
        linewidths=0.6,
        alpha=0.75,
    )
    axes.clabel(drawn, fmt=lambda value: length_in_words(float(value)), fontsize=8)


def _round_levels(margin: FloatArray) -> list[float]:
    """Values 1, 2, 5, 10, ... within those that occur."""
    there = margin[np.isfinite(margin) & (margin > 0.0)]
    if not there.size:
        return []
    low, high = np.quantile(there, (0.03, 0.97))
    first = int(np.floor(np.log10(low)))
    last = int(np.ceil(np.log10(high)))
    every = [k * 10.0**e for e in range(first, last + 1) for k in (1, 2, 5)]
    levels = [level for level in every if low < level < high]
    return levels[-_MOST_CONTOURS:]


def _draw_singular(
    axes: Any, crossings: Crossings, x: str, y: str, columns: tuple[FloatArray, FloatArray]
) -> bool:
    from matplotlib.collections import LineCollection

    there = [each for each in crossings if x in each.parameters and y in each.parameters]
    curves = curves_of(there, x, y, columns)
    for colour, width in (("white", 4.0), (SINGULAR_COLOUR, 1.8)):
        lines = LineCollection(curves.segments, colors=colour, linewidths=width, zorder=5)
        lines.set_capstyle("round")
        axes.add_collection(lines, autolim=False)
    if curves.alone:
        axes.plot(*zip(*curves.alone, strict=True), ".", color=SINGULAR_COLOUR, ms=5, zorder=5)
    return bool(curves.segments or curves.alone)
