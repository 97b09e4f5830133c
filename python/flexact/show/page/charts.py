# SPDX-License-Identifier: BSD-3-Clause
"""Charts as SVG within a page: curves with their names at their ends, marks, and bands."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np

from ...core.arrays import FloatArray
from ..charts import STYLES, Bar, BarChart, Chart, Curve, Mark, Row, Scale, apart, mark_side
from ..charts import told as in_unit
from .assets import text

#: Width of a chart and size of its letters; its height, and margins above and below.
WIDTH, LETTERS = 380.0, 13.0
_HEIGHT, _TOP, _BOTTOM = 262.0, 28.0, 44.0
#: Width of a letter and height of a line, times the size of letters; room before a name.
LETTER, _LINE, _BESIDE = 0.58, 1.2, 12.0
_RADIUS = 4.0


def chart_svg(chart: Chart) -> str:
    """A chart, in words for those who do not see it."""
    names = max((len(curve.label) for curve in chart.curves), default=0)
    right = WIDTH - names * LETTER * LETTERS - _BESIDE - 2.0
    ticks = max(map(len, chart.y.labels), default=0)
    left = 10.0 + max(3, ticks) * LETTER * LETTERS
    place = Places(chart.x, chart.y, (left, right), (_HEIGHT - _BOTTOM, _TOP))
    body = (
        words(0.0, 14.0, chart.heading, "chart-title"),
        *_grid(place),
        *(part for curve in chart.curves for part in _curve(place, curve)),
        *(part for mark in chart.marks for part in _mark(place, mark)),
        *_names(place, chart),
        words((left + right) / 2, _HEIGHT - 8.0, chart.along, "soft middle"),
    )
    ends = ", ".join(
        f"{curve.label} from {chart.y.unit.told(float(np.nanmin(curve.y)))} "
        f"to {chart.y.unit.told(float(np.nanmax(curve.y)))}"
        for curve in chart.curves
    )
    marks = "".join(f"; {mark.words}" for mark in chart.marks)
    return svg(chart.name, _HEIGHT, f"{chart.title} over {chart.x_title}: {ends}{marks}", body)


class Places:
    """Where values of two axes are in the chart."""

    def __init__(
        self, x: Scale, y: Scale, across: tuple[float, float], up: tuple[float, float]
    ) -> None:
        """Keep the axes, and where each begins and ends."""
        self.x, self.y, self.across, self.up = x, y, across, up

    def at(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """(p, 2) places of values (p,)."""
        return np.column_stack((self.along(x), self.above(y)))

    def along(self, x: FloatArray) -> FloatArray:
        """Places of values along."""
        start, end = self.across
        return np.asarray(start + (end - start) * self.x.share(x))

    def above(self, y: FloatArray) -> FloatArray:
        """Places of values up."""
        start, end = self.up
        return np.asarray(start + (end - start) * np.clip(self.y.share(y), -0.02, 1.05))


def svg(name: str, height: float, told: str, body: Iterable[str]) -> str:
    """A picture of the page's charts."""
    return (
        f'<figure class="chart"><svg class="{text(name)}" viewBox="0 0 {WIDTH:g} {height:.5g}" '
        f'role="img" aria-label="{text(told)}">{"".join(body)}</svg></figure>'
    )


def words(x: float, y: float, told: str, kind: str) -> str:
    """Words at a place."""
    return f'<text x="{x:.1f}" y="{y:.1f}" class="{kind}">{text(told)}</text>'


def line(start: tuple[float, float], end: tuple[float, float], kind: str) -> str:
    """A straight line."""
    (a, b), (c, d) = start, end
    return f'<line x1="{a:.1f}" y1="{b:.1f}" x2="{c:.1f}" y2="{d:.1f}" class="{kind}"/>'


def series_css() -> str:
    """Colours and dashes of the designs, on light ground and on dark."""
    light, dark = (
        "".join(f".s{k}{{--series:{colour}}}" for k, colour in enumerate(colours))
        for colours in ([each.colour for each in STYLES], [each.on_dark for each in STYLES])
    )
    lines = "".join(
        f".s{k}.curve{{stroke-width:{each.width:g};"
        f"stroke-dasharray:{' '.join(f'{part * each.width:g}' for part in each.dashes) or 'none'}}}"
        for k, each in enumerate(STYLES)
    )
    chosen = dark.replace(".s", ':root[data-theme="dark"] .s')
    system = dark.replace(".s", ':root:not([data-theme="light"]) .s')
    return f"{light}{lines}{chosen}@media (prefers-color-scheme: dark){{{system}}}"


def _grid(place: Places) -> Iterator[str]:
    (left, right), (bottom, top) = place.across, place.up
    for y, label in zip(place.above(place.y.ticks).tolist(), place.y.labels, strict=True):
        yield line((left, y), (right, y), "grid")
        yield words(left - 6.0, y + 4.5, label, "soft end")
    labels = place.x.labels_for((right - left) / (LETTER * LETTERS))
    for x, label in zip(place.along(place.x.ticks).tolist(), labels, strict=True):
        yield line((x, bottom), (x, top), "grid")
        yield words(x, bottom + 16.0, label, "soft middle")
    yield line((left, bottom), (right, bottom), "axis")


def _curve(place: Places, curve: Curve) -> Iterator[str]:
    for run in curve.runs:
        x, y, spread = curve.x[run], curve.y[run], curve.spread[run]
        if np.any(spread > 0.0):
            round_it = (place.at(x, y + spread), place.at(x, y - spread)[::-1])
            path = _path(np.concatenate(round_it))
            yield f'<path d="{path}Z" class="s{curve.series} band"/>'
        yield f'<path d="{_path(place.at(x, y))}" class="s{curve.series} curve"/>'


def _path(points: FloatArray) -> str:
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points.tolist())


def _mark(place: Places, mark: Mark) -> Iterator[str]:
    points = place.at(*np.array(mark.points).T)
    for x, y in points.tolist():
        yield (f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{_RADIUS:g}" class="s{mark.series} point"/>')
    x, y = points.mean(axis=0).tolist()
    (left, right), (bottom, top) = place.across, place.up
    side, below = mark_side(mark, (x - left) / (right - left), (bottom - y) / (bottom - top))
    anchor = ("middle", "start", "end")[side]
    height = y + (29.0 if below else -9.0)
    yield words(x + 10.0 * side, height, mark.words, f"s{mark.series} named {anchor}")


def _names(place: Places, chart: Chart) -> Iterator[str]:
    found = chart.ends
    wanted = np.array([float(place.above(np.array(end[1]))) for _, end in found])
    bottom, top = place.up
    heights = apart(wanted, LETTERS * _LINE, top - LETTERS, bottom + LETTERS)
    right = place.across[1]
    for (curve, end), there, height in zip(found, wanted.tolist(), heights.tolist(), strict=True):
        x = float(place.along(np.array(end[0])))
        kind = f"s{curve.series}"
        yield line((x + 2.0, there), (right + _BESIDE - 2.0, height), f"{kind} leader")
        bold = " says" if curve.series == 0 else ""
        yield words(right + _BESIDE, height + 4.5, curve.label, f"{kind} named{bold}")


#: Heights: of what stands above and below, of a row, and between groups.
_BARS_TOP, _BARS_BOTTOM, _ROW, _BETWEEN = 28.0, 26.0, 17.0, 9.0
#: Where a row's own label ends before the axis; room at the right; letters of a group's label.
_GROUPS, _RIGHT, _LETTERS = 18.0, 14.0, 12


def bars_svg(chart: BarChart) -> str:
    """Bars, in words for those who do not see them."""
    longest = max(min(len(group.label), _LETTERS) for group in chart.groups)
    left, right = _GROUPS + longest * LETTER * LETTERS + 8.0, WIDTH - _RIGHT
    bottom = _BARS_TOP + chart.height(_ROW, _BETWEEN)
    grounds, marks, told = [], [], []
    for number, (group, top, high, rows) in enumerate(chart.layout(_BARS_TOP, _ROW, _BETWEEN)):
        if number % 2:
            grounds.append(
                f'<rect x="{left:.1f}" y="{top:.1f}" width="{right - left:.1f}" '
                f'height="{high:.1f}" class="stripe"/>'
            )
        label = group.label
        if len(label) > _LETTERS:
            label = f"{label[: _LETTERS - 1]}\N{HORIZONTAL ELLIPSIS}"
        marks.append(words(left - _GROUPS, top + high / 2 + 4.5, label, "end"))
        # Of the first design.
        first = [(row.label, row.bars[0].value) for row in group.rows if row.bars]
        each = (
            f"{name} {in_unit(value, chart.x.si, 2) if math.isfinite(value) else 'any'}"
            for name, value in first
        )
        told.append(f"{group.label}: {', '.join(each)}")
        for row, place in rows:
            marks.append(words(left - 6.0, place + _ROW / 2 + 4.5, row.label, "soft end"))
            marks.extend(_row(chart, row, place, (left, right)))
    ticks = left + (right - left) * chart.x.share(chart.x.ticks)
    labels = chart.x.labels_for((right - left) / (LETTER * LETTERS))
    axis = []
    for x, label in zip(np.asarray(ticks).tolist(), labels, strict=True):
        axis.append(line((x, _BARS_TOP), (x, bottom), "grid"))
        axis.append(words(x, bottom + 17.0, label, "soft middle"))
    axis.append(line((left, _BARS_TOP), (left, bottom), "axis"))
    note = words(left, bottom + _BARS_BOTTOM + 12.0, chart.note, "soft") if chart.note else ""
    whole = bottom + _BARS_BOTTOM + (16.0 if chart.note else 0.0)
    body = (words(0.0, 14.0, chart.heading, "chart-title"), *grounds, *axis, *marks, note)
    return svg(chart.name, whole, f"{chart.title}. As built: {'; '.join(told)}", body)


def _row(chart: BarChart, bars: Row, top: float, across: tuple[float, float]) -> Iterator[str]:
    """Bars of a row below each other, then the value of the first."""
    said = ""
    for bar, (share, thick) in zip(bars.bars, bars.slots, strict=True):
        middle, kind = top + _ROW * share, f"s{bar.series}"
        yield from _bar(chart, bar, (middle, _ROW * thick), across)
        if bar.series == 0 and math.isfinite(bar.value):
            size, end = in_unit(bar.value, chart.x.si, 2), _end(chart, bar.value, across)
            said = words(end + 5.0, middle + 4.0, size, f"{kind} named small")
    yield said


def _end(chart: BarChart, value: float, across: tuple[float, float]) -> float:
    left, right = across
    return float(left + (right - left) * np.clip(chart.x.share(value), 0.0, 1.0))


def _bar(
    chart: BarChart, bar: Bar, place: tuple[float, float], across: tuple[float, float]
) -> Iterator[str]:
    """A bar, or a line with a dot; one without an end has an arrow."""
    (middle, thick), kind = place, f"s{bar.series}"
    left, right = across
    if not math.isfinite(bar.value):
        yield line((left, middle), (right, middle), f"{kind} open")
        yield f'<path d="M{right:.1f} {middle - 2.6:.1f}l5 2.6l-5 2.6Z" class="{kind} arrow"/>'
        return
    end = _end(chart, bar.value, across)
    if bar.series:
        yield line((left, middle), (end, middle), f"{kind} open")
        yield f'<circle cx="{end:.1f}" cy="{middle:.1f}" r="2.3" class="{kind} arrow"/>'
    else:
        yield (
            f'<rect x="{left:.1f}" y="{middle - thick / 2:.1f}" width="{end - left:.1f}" '
            f'height="{thick:.1f}" class="{kind} bar"/>'
        )
    if bar.spread > 0.0:
        low, high = (_end(chart, bar.value + way * bar.spread, across) for way in (-1.0, 1.0))
        yield line((low, middle), (high, middle), "whisker")
