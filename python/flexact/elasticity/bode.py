# SPDX-License-Identifier: BSD-3-Clause
"""A state space as a picture and as a page: size and phase over frequency, poles and zeros."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from html import escape
from typing import Any

import numpy as np

from ..core.arrays import FloatArray
from ..show.charts import Chart, Curve, Mark, Scale, Unit, log_scale
from ..show.page.assets import PLAIN_SCRIPTS, filled, row, section, table, text
from ..show.page.charts import chart_svg, series_css
from ..show.page.content import SWITCH
from ..show.picture.charts import INK, SOFT, draw_chart, width_of, written
from ..show.picture.files import still_bytes
from ..show.picture.make import shown_figure
from ..show.writers import as_bytes
from ..util.text import file_name, harmless
from .linear_system import LinearSystem
from .transfer import ROUNDING, about, first_line, frequencies_shown, rows_of, sentence, unsaid

#: A phase that is so near to a tick, in steps, needs no further one.
_NEAR = 0.1
#: Steps of the phase [degrees], the first that leaves at most so many ticks.
_STEPS, _TICKS = (45.0, 90.0, 180.0, 360.0, 720.0), 7
#: Resonances that are marked: those that stand out so many times from what is so far aside.
_MARKED, _STANDS_OUT, _ASIDE = 2, 1.5, 0.05


def charts_of(system: LinearSystem) -> tuple[tuple[Chart, Chart], ...]:
    """Size and phase of all gains of one unit, group by group."""
    hertz = frequencies_shown(system)
    response = system.response(hertz)
    groups: dict[str, list[tuple[int, int]]] = {}
    for o, units in enumerate(system.gain_units):
        for i, unit in enumerate(units):
            groups.setdefault(unit, []).append((o, i))
    x = _across(hertz)
    # What is no more than rounding beside the others is nothing.
    largest = np.nanmax(np.where(np.isfinite(response), np.abs(response), 0.0), axis=0)
    for pairs in groups.values():
        least = ROUNDING * max(float(largest[pair]) for pair in pairs)
        for o, i in pairs:
            response[:, o, i] *= largest[o, i] > least
    made = []
    for k, (unit, pairs) in enumerate(groups.items()):
        label = _labels(system, pairs)
        sizes, phases, marks = [], [], []
        for series, (o, i) in enumerate(pairs):
            values = response[:, o, i]
            size = np.where(np.isfinite(values), np.abs(values), np.nan)
            none = np.zeros(hertz.size)
            sizes.append(
                Curve(series, label[series], hertz, np.where(size > 0, size, np.nan), none)
            )
            phases.append(Curve(series, label[series], hertz, _phase(values), none))
            marks += _marks(system, o, i, series, hertz, size) if len(pairs) == 1 else []
        every = np.concatenate([each.y for each in sizes])
        title = "Gain" if len(groups) == 1 else f"Gain of {label[0]}"
        named = str(k + 1) if len(groups) > 1 else ""
        y = log_scale(every, "" if unit == "1" else unit)
        made.append(
            (
                Chart(f"gain{named}", title, "Frequency", x, y, tuple(sizes), tuple(marks)),
                Chart(f"phase{named}", "Phase", "Frequency", x, _degrees(phases), tuple(phases)),
            )
        )
    return tuple(made)


def _across(hertz: FloatArray) -> Scale:
    """Frequencies from the first to the last."""
    made = log_scale(hertz, "Hz")
    low, high = float(hertz[0]), float(hertz[-1])
    ticks = made.ticks[(made.ticks >= low) & (made.ticks <= high)]
    return replace(made, low=low, high=high, ticks=ticks, unit=Unit(1.0, "Hz"))


def _labels(system: LinearSystem, pairs: Sequence[tuple[int, int]]) -> list[str]:
    """What stands at the curves: the ends that differ."""
    inputs, outputs = ({pair[k] for pair in pairs} for k in (1, 0))
    made = []
    for o, i in pairs:
        ends = [system.outputs[o].label] * (len(outputs) > 1 or len(inputs) == 1)
        ends += [f"from {system.inputs[i].label}"] * (len(inputs) > 1)
        made.append(harmless(" ".join(ends)))
    return made


def _phase(values: np.ndarray) -> FloatArray:
    """Angles [degrees] without jumps, from half a turn about zero on."""
    angle = np.angle(np.where(np.isfinite(values), values, 1.0))
    turned = np.degrees(np.unwrap(angle))
    return np.where(np.abs(values) > 0.0, turned - 360.0 * np.round(turned[0] / 360.0), np.nan)


def _degrees(curves: Sequence[Curve]) -> Scale:
    """An axis with ticks at parts of a turn."""
    every = np.concatenate([each.y[np.isfinite(each.y)] for each in curves] + [np.zeros(1)])
    low, high = float(every.min()), float(every.max())
    step = next((each for each in _STEPS if (high - low) / each <= _TICKS), _STEPS[-1])
    first, last = np.floor(low / step + _NEAR), np.ceil(high / step - _NEAR)
    ticks = step * np.arange(first, max(last, first + 1) + 1)
    room = 0.06 * float(ticks[-1] - ticks[0])
    unit = Unit(1.0, "\N{DEGREE SIGN}")
    return Scale(float(ticks[0]) - room, float(ticks[-1]) + room, unit, False, ticks, "deg")


def _marks(
    system: LinearSystem, o: int, i: int, series: int, hertz: FloatArray, size: FloatArray
) -> list[Mark]:
    """The first resonances, at the curve."""
    acting = system.acting[o, i] & (system.square > 0.0)
    made = []
    for f in system.frequencies[acting].tolist():
        before, y, behind = np.interp(
            np.multiply(f, (1.0 - _ASIDE, 1.0, 1.0 + _ASIDE)), hertz, size
        )
        if hertz[0] <= f <= hertz[-1] and y > _STANDS_OUT * np.sqrt(before * behind):
            made.append(Mark(series, ((f, float(y)),), f"{f:.4g} Hz"))
    return made[:_MARKED]


#: Of the picture [inch]: width, height of a chart, and what stands about it; letters [pt].
_WIDTH, _SIZE, _PHASE = 8.2, 2.9, 1.7
_EDGE, _FIRST, _NEXT = 0.25, 0.36, 0.26
_HEAD, _TITLE, _BELOW, _LEFT, _RIGHT, _DPI, _LETTERS = 0.86, 0.34, 0.5, 0.85, 0.25, 150, 12.0


def plot_of(system: LinearSystem) -> Any:
    """The picture as a figure of matplotlib, which a notebook shows.

    Raises:
        FlexactError: matplotlib is missing.
    """
    groups = charts_of(system)
    measure = shown_figure(dpi=_DPI)
    names = [curve.label for group in groups for curve in group[0].curves]
    beside = max(width_of(measure, name, 10.0, "bold") for name in names) + _RIGHT + 0.1
    of_group = 2 * (_TITLE + _BELOW) + _SIZE + _PHASE
    height = _HEAD + of_group * len(groups)
    figure = shown_figure(figsize=(_WIDTH, height), dpi=_DPI)
    # What counts stands out; how it resonates stands below.
    for k, words in enumerate(first_line(system).split("; ", 1)):
        look: Any = {"fontweight": "bold", "color": INK} if k == 0 else {"color": SOFT}
        words = f"{words[:1].upper()}{words[1:]}" if k else f"{words}."
        place = _EDGE / _WIDTH, 1.0 - (_FIRST + k * _NEXT) / height
        figure.text(*place, written(words), fontsize=_LETTERS - k, **look)
    top = _HEAD
    for group in groups:
        for chart, high in zip(group, (_SIZE, _PHASE), strict=True):
            top += _TITLE + high
            place = (_LEFT / _WIDTH, 1.0 - top / height)
            whole = (1.0 - (_LEFT + beside) / _WIDTH, high / height)
            draw_chart(figure.add_axes((*place, *whole)), chart)
            top += _BELOW
    return figure


def plot_bytes(system: LinearSystem, suffix: str = ".png") -> bytes:
    """The picture as a file: .png, .svg or .pdf.

    Raises:
        FlexactError: matplotlib is missing.
    """
    words = harmless(file_name(system.name)) or "transfer", harmless(first_line(system))
    return still_bytes(plot_of(system), suffix, *words)


def page_bytes(system: LinearSystem) -> bytes:
    """The page as the content of a file: the curves, poles and zeros, and what is behind them."""
    name = harmless(file_name(system.name)) or "model"
    charts = "".join(
        f'<div class="charts">{"".join(map(chart_svg, group))}</div>' for group in charts_of(system)
    )
    cards = []
    for o in range(len(system.outputs)):
        for i in range(len(system.inputs)):
            pair = system.pair(o, i)
            heads, *rows = rows_of(pair)
            cells = (row(text(each[0]), *map(text, each[1:])) for each in rows)
            cards.append(f"<p>{text(sentence(pair))}</p>")
            cards.append(table(heads, cells, kind="designs"))
            cards.append(f"<p>{text(unsaid(pair))}</p>" if unsaid(pair) else "")
    body = (
        '<header class="verdict top"><h1 class="headline">'
        f"<span>{text(first_line(system))}</span></h1>"
        f'<p class="about"><span class="name">{escape(name)}</span></p>{SWITCH}</header>',
        '<main class="plain designs">',
        section("transfer", "Transfer", charts),
        section("poles", "Poles and zeros", *cards),
        section("notes", "To be known", f"<p>{text(about(system))}</p>"),
        "</main>",
    )
    styles = ("style.css", "charts.css")
    page = filled(f"{name}: transfer", "\n".join(body), PLAIN_SCRIPTS, styles, series_css())
    return as_bytes(page)
