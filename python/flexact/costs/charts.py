# SPDX-License-Identifier: BSD-3-Clause
"""What a cost shows as curves: along the stroke, and against the misalignment that matters most."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ..core.arrays import FloatArray
from ..show.charts import Chart, Curve
from ..show.scale import Scale, exact_scale, linear_scale, log_scale
from .designs import CostValues, MisalignmentCurve, StrokeCurve
from .marks import marks_of
from .names import short_labels
from .values import FREQUENCY, Numbers, unit_of_direction, words_of_direction

#: Stiffnesses that differ by more than so many times are drawn on a logarithmic axis.
_WIDE = 30.0
#: Points of a curve against an error; a frequency below this part of the largest is one of none.
_POINTS, _BUCKLED = 201, 0.1
#: A translation is drawn unless a rotation loses as many times more.
_PREFERRED = 0.5
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
        if np.isinf(every).any() or not np.nanmax(values[0], initial=0.0) > 0.0:
            continue
        share = float(np.nanmin(every) / np.nanmax(values[0]))
        share *= _PREFERRED if name in ("x", "y", "z") else 1.0
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
        Curve(series, labels[series], *_smooth(each.curve, cost.measure == FREQUENCY))
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
    words = f"{chosen.clamp.label} {verb} {words_of_direction(chosen.direction)}"
    return Chart(
        "misaligned",
        cost.measure.capitalize(),
        words,
        exact_scale(first - 0.04 * (last - first), last + 0.04 * (last - first), chosen.unit),
        _up(curves, unit),
        curves,
        tuple(marks_of(cost, curves[0])),
    )


def _smooth(
    curve: MisalignmentCurve, is_frequency: bool
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Errors, the measure and its uncertainty; between errors a frequency by its square.

    The square is a stiffness, which falls straight to zero where the design buckles.
    """
    x, (y, spread) = curve.values, _told(curve.measure)
    if not is_frequency or not np.isfinite(y).all():
        return x, y, spread
    square = np.where(y < _BUCKLED * y.max(), 0.0, y**2)
    fine = np.unique(np.concatenate([x, np.linspace(x[0], x[-1], _POINTS)]))
    return fine, np.sqrt(np.interp(fine, x, square)), np.interp(fine, x, spread)


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
