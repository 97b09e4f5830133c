# SPDX-License-Identifier: BSD-3-Clause
"""Bars by groups as SVG within a page; one that has no end runs out of the chart."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..charts import Bar, BarChart, Row
from ..units import told
from .charts import LETTER, LETTERS, WIDTH, line, svg, words

#: Heights: of what stands above and below, of a row, and between groups.
_TOP, _BOTTOM, _ROW, _BETWEEN = 28.0, 26.0, 17.0, 9.0
#: Where a row's own label ends before the axis; room at the right; letters of a group's label.
_BESIDE, _RIGHT, _LETTERS = 18.0, 14.0, 12


def bars_svg(chart: BarChart) -> str:
    """Bars, in words for those who do not see them."""
    longest = max(min(len(group.label), _LETTERS) for group in chart.groups)
    left = _BESIDE + longest * LETTER * LETTERS + 8.0
    height = _TOP + chart.rows * _ROW + len(chart.groups) * _BETWEEN
    body = "".join(_parts(chart, left, height))
    title = words(0.0, 14.0, f"{chart.title}{chart.x.heading}", "chart-title")
    note = words(left, height + _BOTTOM + 12.0, chart.note, "soft") if chart.note else ""
    whole = height + _BOTTOM + (16.0 if chart.note else 0.0)
    return svg(chart.name, whole, _told(chart), (title, body, note))


def _parts(chart: BarChart, left: float, bottom: float) -> Iterator[str]:
    right = WIDTH - _RIGHT
    place = _TOP
    grounds, marks = [], []
    for number, group in enumerate(chart.groups):
        high = len(group.rows) * _ROW + _BETWEEN
        if number % 2:
            grounds.append(
                f'<rect x="{left:.1f}" y="{place:.1f}" width="{right - left:.1f}" '
                f'height="{high:.1f}" class="stripe"/>'
            )
        label = group.label
        if len(label) > _LETTERS:
            label = f"{label[: _LETTERS - 1]}\N{HORIZONTAL ELLIPSIS}"
        marks.append(words(left - _BESIDE, place + high / 2 + 4.5, label, "end"))
        top = place + _BETWEEN / 2
        for row in group.rows:
            marks.append(words(left - 6.0, top + _ROW / 2 + 4.5, row.label, "soft end"))
            marks.extend(_row(chart, row, top, (left, right)))
            top += _ROW
        place += high
    yield from grounds
    ticks = left + (right - left) * chart.x.share(chart.x.ticks)
    labels = chart.x.labels_for((right - left) / (LETTER * LETTERS))
    for x, label in zip(np.asarray(ticks).tolist(), labels, strict=True):
        yield line((x, _TOP), (x, bottom), "grid")
        yield words(x, bottom + 17.0, label, "soft middle")
    yield line((left, _TOP), (left, bottom), "axis")
    yield from marks


def _row(chart: BarChart, bars: Row, top: float, across: tuple[float, float]) -> Iterator[str]:
    """Bars of a row below each other, then the value of the first."""
    said = ""
    for bar, (share, thick) in zip(bars.bars, bars.slots, strict=True):
        middle, kind = top + _ROW * share, f"s{bar.series}"
        yield from _bar(chart, bar, (middle, _ROW * thick), across)
        if bar.series == 0 and math.isfinite(bar.value):
            size, end = told(bar.value, chart.x.si, 2), _end(chart, bar.value, across)
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


def _told(chart: BarChart) -> str:
    """The bars of the first design in words."""
    made = []
    for group in chart.groups:
        each = [
            f"{row.label} {told(bar.value, chart.x.si, 2) if math.isfinite(bar.value) else 'any'}"
            for row in group.rows
            for bar in row.bars[:1]
        ]
        made.append(f"{group.label}: {', '.join(each)}")
    return f"{chart.title}. As built: {'; '.join(made)}"
