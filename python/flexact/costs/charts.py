# SPDX-License-Identifier: BSD-3-Clause
"""What a cost shows as curves: along the stroke, and against the misalignment that matters most."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from ..show.charts import (
    Bar,
    BarChart,
    Chart,
    Curve,
    Group,
    Mark,
    Row,
    Scale,
    exact_scale,
    linear_scale,
    log_scale,
    told,
)
from ..util.text import file_name, harmless
from .designs import (
    FREQUENCY,
    Clamp,
    CostValues,
    Design,
    Misalignment,
    MisalignmentCurve,
    Number,
    Numbers,
    StrokeCurve,
    Tolerance,
    in_words,
    percent,
    short_labels,
    unit_of_direction,
    words_of_direction,
)

#: Two values that differ by less than this part of them mirror each other.
_MIRRORED = 0.02


def marks_of(cost: CostValues, curve: Curve) -> Iterable[Mark]:
    """Where the design as built is shifted by what is allowed, and where it buckles.

    Args:
        cost: The cost.
        curve: The first of its chart.
    """
    found = _tolerance(cost.as_built)
    if found is None or curve.series != 0:
        return
    shift = f"{100 * cost.shift:+.3g} %".replace("-", "\N{MINUS SIGN}")
    for words, pair in (
        ("buckles at", (found.critical_negative, found.critical_positive)),
        (f"{shift} at", (found.negative, found.positive)),
    ):
        values = [each.value for each in pair if _is_within(each.value, curve.x)]
        yield from _marked(curve, words, values, found.misalignment.unit)


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


def _tolerance(design: Design) -> Tolerance | None:
    """That of the misalignment which is drawn."""
    wanted = None if design.curve is None else design.curve.misalignment
    return next((each for each in design.tolerances if each.misalignment == wanted), None)


#: Clamps that are shown; of more those that bear least.
MOST_CLAMPS = 6
#: Errors beyond this part of the mechanism's size, or this angle [rad], are drawn without an end:
#: stress that is in proportion to the error means nothing there, and no workshop is that far off.
LARGEST = 0.1
#: Room behind the longest bar for its value, as a part of the axis.
_BEYOND = 0.2


def bars_of(cost: CostValues) -> tuple[BarChart, ...]:
    """Tolerances of displacements and of rotations, where there are any that matter."""
    made = (_bars(cost, "m"), _bars(cost, "rad"))
    return tuple(chart for chart in made if chart is not None)


def _bars(cost: CostValues, unit: str) -> BarChart | None:
    found = [
        {each.misalignment: each for each in design.tolerances if each.misalignment.unit == unit}
        for design in cost.designs
    ]
    limit = LARGEST * (cost.as_built.size if unit == "m" else 1.0)
    finite = [
        each.tightest.value
        for design in found
        for each in design.values()
        if each.tightest.value <= limit
    ]
    if not finite:
        return None
    clamps, left_out = _clamps(found[0])
    groups = [
        Group(
            clamp.label,
            tuple(
                Row(misalignment.direction.removeprefix("r"), _row(misalignment, found, limit))
                for misalignment in found[0]
                if misalignment.clamp == clamp
            ),
        )
        for clamp in clamps
    ]
    name, what = ("shifts", "displacement") if unit == "m" else ("turns", "rotation")
    shift = f"{100 * cost.shift:+.3g} %".replace("-", "\N{MINUS SIGN}")
    title = f"Tolerance of a clamp for {what} ({shift})"
    many = "clamp bears" if left_out == 1 else "clamps bear"
    more = f"; {left_out} more {many} more" if left_out else ""
    note = f"Arrows: more than {told(limit, unit, 2)}{more}"
    scale = log_scale(finite, unit, _BEYOND)
    return BarChart(name, title, scale, tuple(groups), note)


def _row(
    misalignment: Misalignment, found: Sequence[dict[Misalignment, Tolerance]], limit: float
) -> tuple[Bar, ...]:
    made = []
    for series, tolerances in enumerate(found):
        each = tolerances.get(misalignment)
        if each is not None:
            value, uncertainty = each.tightest
            is_open = value > limit
            made.append(Bar(series, *((math.inf, 0.0) if is_open else (value, uncertainty))))
    return tuple(made)


def _clamps(found: dict[Misalignment, Tolerance]) -> tuple[list[Clamp], int]:
    """The clamps that are shown, in their order; how many are left out."""
    least: dict[Clamp, float] = {}
    for misalignment, each in found.items():
        clamp = misalignment.clamp
        least[clamp] = min(least.get(clamp, math.inf), each.tightest.value)
    chosen = sorted(least, key=lambda clamp: least[clamp])[:MOST_CLAMPS]
    return [clamp for clamp in least if clamp in chosen], max(0, len(least) - MOST_CLAMPS)


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


#: What stands where a misalignment does nothing to first order.
ANY, NEVER = "any error", "never"
#: Up to this part a number is told in three digits alone; values within it are alike by symmetry.
_CERTAIN, _ALIKE = 0.02, 1.01
#: "about x and about z".
_TWICE = re.compile(r"(along|about) (\w+) and \1 (\w+)")


class KeyRow(NamedTuple):
    """A design in the table."""

    series: int
    label: str
    """What stands at its curves."""
    words: str
    """What is released."""
    cells: tuple[str, ...]
    """As many as there are headings."""


class Key(NamedTuple):
    """The table.

    Attributes:
        heads: Of the columns for which there are values.
        rows: A design each.
    """

    heads: tuple[str, ...]
    rows: tuple[KeyRow, ...]


def key_of(cost: CostValues) -> Key:
    """The table of a cost: columns of which the deck allows nothing are left out."""
    shift = f"{100 * cost.shift:+.3g} %".replace("-", "\N{MINUS SIGN}")
    place = None if cost.tightest is None else cost.tightest.misalignment
    columns = {
        f"tolerance ({shift})": [_tightest(each, place) for each in cost.designs],
        "buckles at": [_buckles(each, place) for each in cost.designs],
        "worst stiffness kept": [_kept(each) for each in cost.designs],
        "frequency": [_frequency(each) for each in cost.designs],
        "lowest parasitic": [_parasitic_of_key(each) for each in cost.designs],
    }
    shown = {head: cells for head, cells in columns.items() if any(cells[1:] or cells)}
    if len(cost.designs) > 1 and len(set(shown.get("frequency", "12"))) == 1:
        # The same of all: it is told once, and tells nothing here.
        del shown["frequency"]
    rows = (
        KeyRow(
            series,
            label,
            _words(design),
            tuple(cells[series] for cells in shown.values()),
        )
        for series, (label, design) in enumerate(zip(short_labels(cost), cost.designs, strict=True))
    )
    return Key(tuple(shown), tuple(rows))


def choices_of(cost: CostValues) -> tuple[str, ...]:
    """What was asked for, in parts: of what, where, and how."""
    beams = "8 and 16 beams a sheet" if cost.beams == "auto" else f"{cost.beams} beams a sheet"
    told = (
        file_name(cost.name),
        f"at {cost.point.words}",
        f"held deformations {cost.held}",
        f"drive {cost.drive}",
        beams,
        f"lowest frequency {_frequency(cost.as_built)}" if _frequency(cost.as_built) else "",
    )
    return tuple(harmless(each) for each in told if each)


def typeset(words: str) -> str:
    """Words of quantities as they are set in pictures."""
    for plain, proper in (
        (" um", " \N{MICRO SIGN}m"),
        ("/um", "/\N{MICRO SIGN}m"),
        (" urad", " \N{MICRO SIGN}rad"),
        ("+-", "\N{PLUS-MINUS SIGN}"),
        (" -> ", " \N{RIGHTWARDS ARROW} "),
    ):
        words = words.replace(plain, proper)
    return _TWICE.sub(r"\1 \2 and \3", words)


def _words(design: Design) -> str:
    """What is released, and what is alike."""
    words = design.words.removeprefix("released: ")
    many = len(design.alike)
    return f"{words} (and {many} alike)" if many else words


def _tightest(design: Design, place: Misalignment | None) -> str:
    found = design.tightest
    if found is None:
        return ANY if design.tolerances else ""
    return _with_place(found.tightest, found, place)


def _buckles(design: Design, place: Misalignment | None) -> str:
    """Where it buckles; the place is told if no other column tells it."""
    found = design.buckles_at
    if found is None:
        return NEVER if design.tolerances else ""
    told = place if design.tightest is None else design.tightest.misalignment
    if _critical(design, told) <= _ALIKE * found.critical.value:
        return typeset(in_words(_rounded(found.critical), found.misalignment.unit))
    return _with_place(found.critical, found, place)


def _critical(design: Design, place: Misalignment | None) -> float:
    """At which error of a place it buckles; infinite where none does."""
    found = (each for each in design.tolerances if each.misalignment == place)
    return next((each.critical.value for each in found), math.inf)


def _with_place(number: Number, found: Tolerance, place: Misalignment | None) -> str:
    """A misalignment in words; that of which the headline speaks by its size alone."""
    where = found.misalignment
    size = typeset(in_words(_rounded(number), where.unit))
    if where == place:
        return size
    direction = where.direction.replace("r", "about ")
    return f"{size} ({where.clamp.label}, {direction})"


def _rounded(number: Number) -> Number:
    """To three digits where it is that certain; a table is for comparing."""
    if abs(number.uncertainty) < _CERTAIN * abs(number.value):
        return Number(float(f"{number.value:.3g}"))
    return number


def _kept(design: Design) -> str:
    if design.kept is None:
        return "" if design.released else "100 %"
    return f"{percent(round(design.kept.smallest.value, 3))} {typeset(design.kept.words)}"


def _frequency(design: Design) -> str:
    if design.frequencies is None or not design.frequencies.value.size:
        return ""
    first = Number(*(float(part[0]) for part in design.frequencies))
    return in_words(_rounded(first), "Hz") if first.value > 0.0 else "buckled"


def _parasitic_of_key(design: Design) -> str:
    """At rest, and where the stroke makes it lowest."""
    first = design.first_parasitic
    if first is None:
        return ""
    told = in_words(_rounded(first), "Hz")
    along = None if design.stroke is None else design.stroke.parasitic
    if along is None or not along.value.size:
        return told
    k = int(np.argmin(along.value[:, 0]))
    least = Number(float(along.value[k, 0]), float(along.uncertainty[k, 0]))
    if least.value > 0.99 * first.value:
        return told
    lowest = in_words(_rounded(least), "Hz")
    if told.endswith(" Hz") and lowest.endswith(" Hz"):
        told = told.removesuffix(" Hz")
    return typeset(f"{told} -> {lowest}")
