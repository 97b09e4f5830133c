# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a table: curves over a parameter, maps of two, and histograms."""

from __future__ import annotations

import os
from collections import defaultdict
from collections.abc import Sequence
from itertools import combinations, pairwise, product
from math import dist
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from ..analysis.naming import length_in_words
from ..analysis.verdict import Verdict
from ..core.arrays import BoolArray, FloatArray
from ..show.picture.files import PictureError, still_bytes
from ..show.picture.make import shown_figure
from ..show.writers import STILLS
from ..util.outputs import write_together
from ..util.text import harmless
from .columns import Rows
from .crossings import ROWS, Crossing, Crossings, lines_of, varying

if TYPE_CHECKING:
    from matplotlib.figure import Figure


#: Of errors, of doubt, and of singular places.
ERROR_COLOUR, DOUBT_COLOUR, SINGULAR_COLOUR = "#6b7280", "#8a6a00", "#111827"
#: Rows of which each has a large mark.
FEW_ROWS = 150
#: Rows between which singular places are sought unasked.
MOST_SEARCHED = 20_000
#: Width and height of a picture [inch], and of each further panel.
_SIZE, _PANEL, _DPI = (8.0, 6.2), 2.6, 120


def chosen(table: Rows, x: str | None, y: str | None) -> tuple[str | None, str | None]:
    """What is drawn along and up the picture; None: the number of the row, and by default.

    Raises:
        KeyError: there is no such column.
        ValueError: it holds no numbers.
    """
    names = varying(table)
    for name in (x, y):
        if name is not None and table[name].dtype.kind not in "if":
            raise ValueError(f"{name!r} cannot be drawn: it holds no numbers")
    if x is None:
        left = [name for name in names if name != y]
        x = next(iter(left), None)
        if y is None and len(left) > 1:
            y = left[1]
    return x, y


def figure_of(panels: int = 1) -> Any:
    """An empty figure that shows itself in a notebook.

    Raises:
        FlexactError: matplotlib is missing.
    """
    height = _SIZE[1] if panels == 1 else 1.0 + _PANEL * panels
    return shown_figure(figsize=(_SIZE[0], height), dpi=_DPI, layout="constrained")


def smallest_values(table: Rows) -> FloatArray:
    """(variants,) the smallest singular value of the scaled D(c), as far as it is known."""
    zero: FloatArray = table["largest_zero"]
    return np.where(np.isnan(zero), table["gap"], zero)


def add_legend(axes: Any, table: Rows, *, has_singular: bool, marks: bool) -> None:
    """The colours of the verdicts, in words with counts, and what else there is."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles: list[Any] = []
    for verdict in Verdict:
        if count := int((table["verdict"] == verdict.value).sum()):
            dot: Any = {"label": f"{verdict.value}: {count}", "color": verdict.colour}
            handles.append(
                Line2D([], [], marker="o", ms=6, ls="none", **dot)
                if marks
                else Patch(facecolor=verdict.colour, label=dot["label"])
            )
    if has_singular:
        handles.append(Line2D([], [], color=SINGULAR_COLOUR, lw=1.8, label="singular"))
    if count := int(table.is_doubtful.sum()):
        ring: Any = {"marker": "o", "mfc": "none", "mec": DOUBT_COLOUR, "ls": "none", "mew": 1.5}
        handles.append(Line2D([], [], label=f"rank doubtful: {count}", ms=9, **ring))
    if count := int(table.has_error.sum()):
        cross: Any = {"marker": "x", "color": ERROR_COLOUR, "ls": "none", "mew": 1.6}
        handles.append(Line2D([], [], label=f"error: {count}", **cross))
    if not handles:
        handles.append(Patch(facecolor="none", label="no variants"))
    axes.get_figure().legend(
        handles=handles, loc="outside lower center", ncols=2, frameon=False, fontsize=9.5
    )


def verdict_colours(table: Rows) -> np.ndarray:
    """(variants, 3) the colour of each row, from 0 to 1."""
    from matplotlib.colors import to_rgb

    made = np.tile(to_rgb(ERROR_COLOUR), (len(table), 1))
    for verdict in Verdict:
        made[table["verdict"] == verdict.value] = to_rgb(verdict.colour)
    return made


def mark_rows(axes: Any, table: Rows, x: np.ndarray, y: np.ndarray) -> None:
    """Rings round what is doubtful, and crosses at errors."""
    doubtful, wrong = table.is_doubtful, table.has_error
    size = 70 if len(table) <= FEW_ROWS else 24
    if doubtful.any():
        rings = {"marker": "o", "facecolors": "none", "edgecolors": DOUBT_COLOUR, "s": size}
        axes.scatter(x[doubtful], y[doubtful], linewidths=1.5, zorder=6, clip_on=False, **rings)
    if wrong.any():
        cross = {"marker": "x", "color": ERROR_COLOUR, "s": 28, "linewidths": 1.6}
        axes.scatter(x[wrong], y[wrong], zorder=6, clip_on=False, **cross)


def label(axes: Any, x: str, y: str) -> None:
    """Names of the axes; what they hold is never taken for a formula."""
    for put, words in ((axes.set_xlabel, x), (axes.set_ylabel, y)):
        put(harmless(words), parse_math=False, fontsize=11)


def finished(figure: Figure, path: str | os.PathLike[str] | None, title: str, words: str) -> Figure:
    """The figure, which is also written to a file if one is named.

    Args:
        figure: The figure.
        path: The file, if any.
        title: What it is, in a line.
        words: What it shows.

    Raises:
        FlexactError: it cannot be written.
    """
    if path is not None:
        path = Path(path)
        suffix = path.suffix.lower()
        if suffix not in STILLS:
            raise PictureError(f"{path} is no such picture: its suffix must be .png, .svg or .pdf")
        write_together({path: still_bytes(figure, suffix, title, words)})
    return figure


Point = tuple[float, float]
Segment = tuple[Point, Point]
#: Of four points of a cell, the ways to join them in pairs.
_PAIRS = (((0, 1), (2, 3)), ((0, 2), (1, 3)), ((0, 3), (1, 2)))


def curves_of(
    crossings: Sequence[Crossing], x: str, y: str, columns: tuple[np.ndarray, np.ndarray]
) -> tuple[list[Segment], list[Point]]:
    """Join the singular places on the edges of each cell.

    Args:
        crossings: The places.
        x: The parameter along the map.
        y: The parameter up the map.
        columns: The values of both, (variants,) each.

    Returns:
        What joins them, and those that are joined with no other one.
    """
    index = [np.unique(column, return_inverse=True)[1].tolist() for column in columns]
    cells: dict[tuple[int, int], list[Point]] = defaultdict(list)
    points: list[Point] = []
    for each in crossings:
        if each.along not in (x, y):
            continue
        point = (float(cast(float, each.parameters[x])), float(cast(float, each.parameters[y])))
        points.append(point)
        ends = [sorted(of_axis[row] for row in each.rows) for of_axis in index]
        # An edge has a cell on each side, a corner four round it.
        across, up = (range(a - 1, a + 1) if a == b else range(a, b) for a, b in ends)
        for cell in product(across, up):
            cells[cell].append(point)
    segments = list(dict.fromkeys(s for there in cells.values() for s in _joined(there)))
    joined = {point for segment in segments for point in segment}
    return segments, [point for point in dict.fromkeys(points) if point not in joined]


def _joined(there: list[Point]) -> list[Segment]:
    points = sorted(dict.fromkeys(there))
    if len(points) == 4:
        best = min(_PAIRS, key=lambda pairs: sum(dist(points[a], points[b]) for a, b in pairs))
        return [(points[a], points[b]) for a, b in best]
    if len(points) == 3:
        return sorted(combinations(points, 2), key=lambda pair: dist(*pair))[:2]
    return list(pairwise(points))


#: Below this part of the largest a value stands at the lower edge: it is zero.
_ZERO = 1.0e-9
#: Rows that are joined where they follow nothing but each other, and whose marks can be told apart.
_MOST_JOINED = 2_000
#: So many singular places are told by their value.
_MOST_TOLD = 6


def curve(table: Rows, x: str | None, y: str | None, crossings: Crossings) -> Any:
    """The figure of a curve over a parameter, or over the rows; see `Table.plot`."""
    quantities = _quantities(table, y)
    figure = figure_of(len(quantities))
    panels = figure.subplots(len(quantities), 1, sharex=True, squeeze=False)[:, 0]
    along = np.arange(len(table), dtype=float) if x is None else table[x].astype(float)
    if x is None:
        places = [each.rows[0] + each.share for each in crossings]
    else:
        values = [each.parameters.get(x) for each in crossings]
        places = [float(value) for value in values if isinstance(value, (int, float))]
    for axes, (words, *quantity) in zip(panels, quantities, strict=True):
        _draw(axes, table, along, _lines(table, x), places, *quantity)
        label(axes, "" if axes is not panels[-1] else x or "variant", words)
    for place in places if len(places) <= _MOST_TOLD else ():
        _note(panels[0], place, f"{place:.6g}", color=SINGULAR_COLOUR)
    add_legend(panels[0], table, has_singular=bool(places), marks=True)
    return figure


def _quantities(table: Rows, y: str | None) -> list[tuple[Any, ...]]:
    """Words, values, whether their axis is logarithmic, and whether singular places have zero."""
    if y is not None:
        return [(y, table[y].astype(float), y in _LOGARITHMIC, y in _FALLING)]
    if "gap" not in table.columns:
        return [("rank of D(c)", table["rank"], False, False)]
    return [
        ("smallest singular value", smallest_values(table), True, True),
        ("margin [m]", table["margin"], True, True),
    ]


_FALLING = ("gap", "smallest_singular_value", "margin", "margin_angle")
_LOGARITHMIC = (*_FALLING, "largest_zero", "condition_number")


def _lines(table: Rows, x: str | None) -> list[list[int]]:
    if x is None and len(table) > _MOST_JOINED:
        return []
    try:
        return [rows for _, rows in lines_of(table, ROWS if x is None else x, False)]
    except ValueError:
        return []


def _draw(
    axes: Any,
    table: Rows,
    along: FloatArray,
    lines: Sequence[Sequence[int]],
    places: Sequence[float],
    given: np.ndarray,
    is_logarithmic: bool,
    falls: bool,
) -> None:
    values = np.where(np.isfinite(given) & ~table.has_error, given, np.nan)
    floor = np.nan
    if is_logarithmic:
        axes.set_yscale("log")
        above = values[values > _ZERO * np.nanmax(values, initial=0.0)]
        zeros = bool((values <= 0.0).any()) or (falls and bool(places))
        # The lower edge of the axis: a decade below the least, where zero is reached.
        floor = float(above.min() / (10.0 if zeros else 1.5)) if above.size else 0.1
        values = np.maximum(values, floor)
    for rows in lines:
        xs, ys = along[list(rows)], values[list(rows)]
        if falls and len(lines) == 1:
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
    if is_logarithmic:
        axes.set_ylim(bottom=floor)
    for place in places:
        axes.axvline(place, color=SINGULAR_COLOUR, lw=1.2, zorder=3)
    mark_rows(axes, table, along, np.where(there, values, np.full(len(table), axes.get_ylim()[0])))
    if given.dtype.kind == "i":
        axes.yaxis.get_major_locator().set_params(integer=True)
    axes.grid(True, which="major", color="#e5e7eb", lw=0.7, zorder=0)
    axes.set_axisbelow(True)


def _note(axes: Any, place: float, words: str, **look: Any) -> None:
    """Words above a place."""
    where = {"xycoords": ("data", "axes fraction"), "textcoords": "offset points"}
    axes.annotate(words, (place, 1.0), xytext=(0, 3), ha="center", fontsize=9, **where, **look)


_BINS = 48
#: What is smaller than this part of the median is zero: it stands in the first bin.
_NONE_BELOW = 1.0e-6


def histograms(table: Rows, nominal: Rows, below: float | None) -> Any:
    """The figure; see `Tolerances.plot`."""
    figure = figure_of(2)
    value, margin = figure.subplots(2, 1)
    _draw_histogram(
        value, table, smallest_values(table), [(smallest_values(nominal)[0], "as designed")]
    )
    label(value, "smallest singular value (scaled)", "samples")
    lines = [(nominal["margin"][0], "as designed")]
    lines += [] if below is None else [(below, "asked about")]
    _draw_histogram(margin, table, table["margin"], lines)
    label(margin, "margin [m]", "samples")
    add_legend(value, table, has_singular=False, marks=False)
    return figure


def _draw_histogram(
    axes: Any, table: Rows, values: FloatArray, lines: list[tuple[float, str]]
) -> None:
    there = np.isfinite(values)
    axes.set_xscale("log")
    positive = values[there & (values > 0.0)]
    low = 0.0
    if positive.size:
        low = max(positive.min(), _NONE_BELOW * np.median(positive))
        drawn = [place for place, _ in lines if np.isfinite(place) and place > low]
        high = max([positive.max() * 1.0001, 1.001 * low, *drawn])
        edges = np.geomspace(low, high, _BINS + 1)
        found = [
            (each, np.clip(values[there & (table["verdict"] == each.value)], edges[0], edges[-1]))
            for each in Verdict
        ]
        found = [(each, part) for each, part in found if part.size]
        colours = [each.colour for each, _ in found]
        axes.hist([part for _, part in found], edges, stacked=True, color=colours, zorder=2)
    for place, words in lines:
        if np.isfinite(place) and place >= low:
            axes.axvline(place, color=SINGULAR_COLOUR, lw=1.2, ls="--", zorder=4)
            _note(axes, place, words)
        elif np.isfinite(place):
            axes.set_title(f"{words}: {place:.2g}", fontsize=9, loc="left")
    beyond = int((~there & ~table.has_error).sum())
    if beyond:
        axes.set_title(f"{beyond} without limit", fontsize=9, loc="right")
    axes.grid(True, axis="y", color="#e5e7eb", lw=0.7, zorder=0)


#: A map is of cells where so large a part of them is there.
_FULL = 0.5
#: Paler by so much at most, between the lowest and the highest part of the values.
_PALEST, _ENDS = 0.75, (0.02, 0.8)
#: Behind the crosses of errors.
WRONG = "#e5e7eb"
#: So many contours of the margin.
_MOST_CONTOURS = 6


def parameter_map(table: Rows, x: str, y: str, crossings: Crossings) -> Any:
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
    table: Rows, x: str, y: str, columns: tuple[FloatArray, FloatArray]
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


def _shaded(table: Rows) -> FloatArray:
    """(variants, 3) the colour of each row, paler for smaller singular values."""
    colours = verdict_colours(table)
    if "gap" not in table.columns:
        return colours
    values = smallest_values(table)
    # Singular rows keep their full colour.
    there = (values > 0.0) & (table["rank"] == table["rank"].max(initial=0))
    if not there.any():
        return colours
    logs = np.log10(values[there])
    low, high = np.quantile(logs, _ENDS)
    share = np.clip((logs - low) / max(high - low, 1e-12), 0.0, 1.0)
    colours[there] += (1.0 - colours[there]) * (_PALEST * (1.0 - share))[:, None]
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
    axes.set(xlim=edges[0][[0, -1]], ylim=edges[1][[0, -1]])


def _edges(values: FloatArray) -> FloatArray:
    """Between the values, and as far beyond the ends."""
    middle = 0.5 * (values[1:] + values[:-1])
    return np.concatenate(([2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]))


def _draw_contours(
    axes: Any, table: Rows, cells: np.ndarray, columns: tuple[FloatArray, FloatArray]
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
    first, last = int(np.floor(np.log10(low))), int(np.ceil(np.log10(high)))
    every = [k * 10.0**e for e in range(first, last + 1) for k in (1, 2, 5)]
    return [level for level in every if low < level < high][-_MOST_CONTOURS:]


def _draw_singular(
    axes: Any, crossings: Crossings, x: str, y: str, columns: tuple[FloatArray, FloatArray]
) -> bool:
    from matplotlib.collections import LineCollection

    there = [each for each in crossings if x in each.parameters and y in each.parameters]
    segments, alone = curves_of(there, x, y, columns)
    for colour, width in (("white", 4.0), (SINGULAR_COLOUR, 1.8)):
        lines = LineCollection(segments, colors=colour, linewidths=width, zorder=5)
        lines.set_capstyle("round")
        axes.add_collection(lines, autolim=False)
    if alone:
        axes.plot(*zip(*alone, strict=True), ".", color=SINGULAR_COLOUR, ms=5, zorder=5)
    return bool(segments or alone)
