# SPDX-License-Identifier: BSD-3-Clause
"""A curve of the smallest singular value, or of another result, over one parameter."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from .crossing import Crossing, Crossings
from .lines import ROWS, lines_of
from .plot import (
    FEW_ROWS,
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

#: Below this part of the largest a value stands at the lower edge: it is zero.
_ZERO = 1.0e-9
#: Rows that are joined where they follow nothing but each other, and whose marks can be told apart.
_MOST_JOINED = 2_000
#: So many singular places are told by their value.
_MOST_TOLD = 6


class _Quantity(NamedTuple):
    words: str
    values: FloatArray
    is_logarithmic: bool
    falls: bool
    """Whether it is zero at singular places."""


def curve(table: Table, x: str | None, y: str | None, crossings: Crossings) -> Any:
    """The figure of a curve over a parameter, or over the rows; see `Table.plot`."""
    quantities = _quantities(table, y)
    figure = figure_of(len(quantities))
    panels = figure.subplots(len(quantities), 1, sharex=True, squeeze=False)[:, 0]
    along = np.arange(len(table), dtype=float) if x is None else table[x].astype(float)
    places = [_place(each, x) for each in crossings if _is_on(each, x)]
    for axes, quantity in zip(panels, quantities, strict=True):
        _draw(axes, table, along, quantity, _lines(table, x), places)
        label(axes, "" if axes is not panels[-1] else x or "variant", quantity.words)
    _tell(panels[0], places)
    add_legend(panels[0], table, has_singular=bool(places), marks=True)
    return figure


def _quantities(table: Table, y: str | None) -> list[_Quantity]:
    if y is not None:
        values = table[y].astype(float)
        return [_Quantity(y, values, y in _LOGARITHMIC, y in _FALLING)]
    if "gap" not in table.columns:
        return [_Quantity("rank of D(c)", table.rank, False, False)]
    return [
        _Quantity("smallest singular value", smallest_values(table), True, True),
        _Quantity("margin [m]", table["margin"], True, True),
    ]


_FALLING = ("gap", "smallest_singular_value", "margin", "margin_angle")
_LOGARITHMIC = (*_FALLING, "largest_zero", "condition_number")


def _lines(table: Table, x: str | None) -> list[list[int]]:
    if x is None and len(table) > _MOST_JOINED:
        return []
    try:
        return [rows for _, rows in lines_of(table, ROWS if x is None else x, False)]
    except ValueError:
        return []


def _is_on(each: Crossing, x: str | None) -> bool:
    return x is None or isinstance(each.parameters.get(x), (int, float))


def _place(each: Crossing, x: str | None) -> float:
    return each.rows[0] + each.share if x is None else float(each.parameters[x] or 0.0)


def _draw(
    axes: Any,
    table: Table,
    along: FloatArray,
    quantity: _Quantity,
    lines: Sequence[Sequence[int]],
    places: Sequence[float],
) -> None:
    there = np.isfinite(quantity.values) & ~table.has_error
    values = np.where(there, quantity.values, np.nan)
    floor = np.nan
    if quantity.is_logarithmic:
        axes.set_yscale("log")
        above = values[values > _ZERO * np.nanmax(values, initial=0.0)]
        zeros = bool((values <= 0.0).any()) or (quantity.falls and bool(places))
        floor = _floor(above, zeros)
        values = np.maximum(values, floor)
    for rows in lines:
        xs, ys = along[list(rows)], values[list(rows)]
        if quantity.falls and len(lines) == 1:
            # The curve comes down to zero at singular places between the rows.
            xs = np.concatenate((xs, places))
            ys = np.concatenate((ys, np.full(len(places), floor)))[np.argsort(xs, kind="stable")]
            xs = np.sort(xs)
        axes.plot(xs, ys, color="#9ca3af", lw=1.0, zorder=2)
    there = np.isfinite(values)
    many = len(table) > _MOST_JOINED
    size = 26 if len(table) <= FEW_ROWS else 2 if many else 9
    points: Any = {"s": size, "c": verdict_colours(table)[there], "rasterized": many}
    axes.scatter(along[there], values[there], zorder=4, clip_on=False, **points)
    if quantity.is_logarithmic:
        axes.set_ylim(bottom=floor)
    for place in places:
        axes.axvline(place, color=SINGULAR_COLOUR, lw=1.2, zorder=3)
    bottom = np.full(len(table), axes.get_ylim()[0])
    mark_rows(axes, table, along, np.where(there, values, bottom))
    if quantity.values.dtype.kind == "i":
        axes.yaxis.get_major_locator().set_params(integer=True)
    axes.grid(True, which="major", color="#e5e7eb", lw=0.7, zorder=0)
    axes.set_axisbelow(True)


def _floor(above: FloatArray, reaches_zero: bool) -> float:
    """The lower edge of a logarithmic axis: a decade below the least, where zero is reached."""
    if not above.size:
        return 0.1
    return float(above.min() / (10.0 if reaches_zero else 1.5))


def _tell(axes: Any, places: Sequence[float]) -> None:
    """The values of few singular places, above them."""
    if len(places) > _MOST_TOLD:
        return
    for place in places:
        axes.annotate(
            f"{place:.6g}",
            (place, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0, 3),
            textcoords="offset points",
            ha="center",
            fontsize=9,
            color=SINGULAR_COLOUR,
        )
