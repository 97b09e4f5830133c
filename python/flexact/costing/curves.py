# SPDX-License-Identifier: BSD-3-Clause
"""What a cost shows as curves: along the stroke, and against the misalignment that matters most."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ..core.arrays import FloatArray
from ..drawing.charts.scale import Scale, exact_scale, linear_scale, log_scale
from ..drawing.charts.units import told
from ..drawing.charts.values import Chart, Curve, Mark
from .designs import CostValues, Design, StrokeCurve
from .names import short_labels
from .values import FREQUENCY, Numbers, Tolerance, unit_of_direction, words_of_direction

#: Stiffnesses that differ by more than so many times are drawn on a logarithmic axis.
_WIDE = 30.0
#: Two values that differ by less than this part of them mirror each other.
_MIRRORED = 0.02
#: Room above the highest curve, as a part of the axis.
_ABOVE = 1.08


def charts_of(cost: CostValues) -> tuple[Chart, ...]:
    """The charts for which there are values, in the order in which they are read."""
    made = (_stiffness(cost), _parasitic(cost), _misaligned(cost))
    return tuple(chart for chart in made if chart is not None)


def _stiffness(cost: CostValues) -> Chart | None:
    """In the direction that loses most of what it has as built at rest."""
    strokes = _strokes(cost)
    if not strokes or cost.stroke is None:
        return None
    chosen = _direction(cost, strokes)
    if chosen is None:
        return None
    name = cost.directions[chosen]
    unit = "N m/rad" if name.startswith("r") else "N/m"
    curves = _curves(
        cost,
        (
            (series, each, Numbers(*(part[:, chosen] for part in each.stiffness)))
            for series, each in strokes
        ),
    )
    if not curves:
        return None
    return Chart(
        "stiffness",
        f"Support stiffness {words_of_direction(name)}",
        _stroke_title(cost),
        _along(cost),
        _up(curves, unit),
        curves,
    )


def _direction(cost: CostValues, strokes: Sequence[tuple[int, StrokeCurve]]) -> int | None:
    """The direction whose stiffness is smallest beside that as built; not that of the drive."""
    best: tuple[float, int] | None = None
    for k, name in enumerate(cost.directions):
        if cost.stroke is not None and name == cost.stroke.coordinate:
            continue
        values = [each.stiffness.value[:, k] for _, each in strokes]
        every = np.concatenate(values)
        if not np.isfinite(every).all() or not every.max() > 0.0:
            continue
        share = float(every.min() / values[0].max())
        if best is None or share < best[0] * (1.0 - 1e-6):
            best = (share, k)
    return None if best is None else best[1]


def _parasitic(cost: CostValues) -> Chart | None:
    chosen = []
    for series, each in _strokes(cost):
        if each.parasitic is not None and each.parasitic.value.shape[1]:
            chosen.append((series, each, Numbers(*(part[:, 0] for part in each.parasitic))))
    curves = _curves(cost, chosen)
    if not curves or cost.stroke is None:
        return None
    return Chart(
        "parasitic",
        "Lowest parasitic frequency",
        _stroke_title(cost),
        _along(cost),
        _up(curves, "Hz"),
        curves,
    )


def _misaligned(cost: CostValues) -> Chart | None:
    """The measure against the misalignment that matters most, to both sides."""
    labels = short_labels(cost)
    curves = tuple(
        Curve(series, labels[series], each.curve.values, *_told(each.curve.measure))
        for series, each in enumerate(cost.designs)
        if each.curve is not None and each.curve.values.size > 1
    )
    if not curves or cost.as_built.curve is None:
        return None
    chosen = cost.as_built.curve.misalignment
    is_frequency = cost.measure == FREQUENCY
    # A stiffness without masses has the unit of the direction of the drive, which a stroke names.
    turns = cost.stroke is not None and cost.stroke.unit == "rad"
    unit = "Hz" if is_frequency else "N m/rad" if turns else "N/m"
    far = np.concatenate([curve.x for curve in curves])
    first, last = float(far.min()), float(far.max())
    verb = "turned" if chosen.unit == "rad" else "off"
    words = f"{chosen.clamp.words} {verb} {words_of_direction(chosen.direction)}"
    return Chart(
        "misaligned",
        cost.measure.capitalize(),
        words,
        exact_scale(first - 0.04 * (last - first), last + 0.04 * (last - first), chosen.unit),
        _up(curves, unit),
        curves,
        tuple(_marks(cost, curves)),
    )


def _marks(cost: CostValues, curves: Sequence[Curve]) -> Iterable[Mark]:
    """Where the design as built is shifted by what is allowed, and where it buckles."""
    found = _tolerance(cost, cost.as_built)
    if found is None or curves[0].series != 0:
        return
    shift = f"{100 * cost.shift:+.3g} %".replace("-", "\N{MINUS SIGN}")
    for words, pair in (
        ("buckles at", (found.critical_negative, found.critical_positive)),
        (f"{shift} at", (found.negative, found.positive)),
    ):
        values = [each.value for each in pair if _is_within(each.value, curves[0].x)]
        yield from _marked(curves[0], words, values, found.misalignment.unit)


def _is_within(value: float, x: FloatArray) -> bool:
    room = 1e-3 * float(x[-1] - x[0])
    return bool(x[0] - room <= value <= x[-1] + room)


def _marked(curve: Curve, words: str, values: Sequence[float], unit: str) -> Iterable[Mark]:
    """One mark for two values that mirror each other, else one each."""
    points = [(value, float(np.interp(value, curve.x, curve.y))) for value in values]
    if len(values) == 2 and abs(sum(values)) < _MIRRORED * abs(values[1]):
        yield Mark(curve.series, tuple(points), f"{words} ±{told(values[1], unit)}")
    else:
        for value, point in zip(values, points, strict=True):
            yield Mark(curve.series, (point,), f"{words} {told(value, unit)}")


def _tolerance(cost: CostValues, design: Design) -> Tolerance | None:
    """That of the misalignment which is drawn."""
    wanted = None if design.curve is None else design.curve.misalignment
    return next((each for each in design.tolerances if each.misalignment == wanted), None)


def _strokes(cost: CostValues) -> list[tuple[int, StrokeCurve]]:
    if cost.stroke is None:
        return []
    return [
        (series, each.stroke)
        for series, each in enumerate(cost.designs)
        if each.stroke is not None and each.stroke.values.size > 1
    ]


def _curves(
    cost: CostValues, chosen: Iterable[tuple[int, StrokeCurve, Numbers]]
) -> tuple[Curve, ...]:
    labels = short_labels(cost)
    rest = 0.0 if cost.stroke is None else cost.stroke.rest
    made = (
        Curve(series, labels[series], stroke.values - rest, *_told(numbers))
        for series, stroke, numbers in chosen
    )
    return tuple(curve for curve in made if curve.runs)


def _told(numbers: Numbers) -> tuple[FloatArray, FloatArray]:
    """Values, NaN where there is none that can be drawn, and their uncertainties."""
    value = np.where(np.isfinite(numbers.value), numbers.value, np.nan)
    spread = np.where(np.isfinite(numbers.uncertainty), numbers.uncertainty, 0.0)
    return value, np.broadcast_to(spread, value.shape)


def _stroke_title(cost: CostValues) -> str:
    return "" if cost.stroke is None else f"stroke of {cost.stroke.words}"


def _along(cost: CostValues) -> Scale:
    assert cost.stroke is not None
    first, last = sorted(value - cost.stroke.rest for value in cost.stroke.reached)
    room = 0.03 * (last - first)
    return exact_scale(first - room, last + room, unit_of_direction(cost.stroke.coordinate))


def _up(curves: Sequence[Curve], unit: str) -> Scale:
    """From zero, or logarithmic where values differ widely."""
    every = np.concatenate([curve.y + curve.spread for curve in curves])
    every = every[np.isfinite(every)]
    smallest = float(every[every > 0.0].min(initial=np.inf))
    if unit != "Hz" and (every > 0.0).all() and every.max() > _WIDE * smallest:
        return log_scale(every, unit)
    return linear_scale([0.0, _ABOVE * float(every.max())], unit, from_zero=True)
