# SPDX-License-Identifier: BSD-3-Clause
"""What a cost shows as a picture: a table, curves, and bars.

Curves are along the stroke, and against the misalignment that matters most.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from ..elasticity.limits import STRENGTH, mirrored
from ..elasticity.points import words_of_direction
from ..show.charts import (
    STYLES,
    Bar,
    BarChart,
    Chart,
    Curve,
    Group,
    Key,
    KeyRow,
    Mark,
    Row,
    Scale,
    exact_scale,
    linear_scale,
    log_scale,
    style_of,
    told,
)
from ..show.picture.charts import BETWEEN, INK, ROW, SOFT, draw_bars, draw_chart, width_of, written
from ..show.picture.files import still_bytes
from ..show.picture.make import shown_figure
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
    stiffness_unit,
)
from .words import first_line

#: Two values that differ by less than this part of them mirror each other.
_MIRRORED = 0.02


def marks_of(cost: CostValues, curve: Curve) -> Iterable[Mark]:
    """Where the design as built is shifted by what is allowed, and where it buckles.

    Args:
        cost: The cost.
        curve: The first of its chart.
    """
    built = cost.as_built
    drawn = None if built.curve is None else built.curve.misalignment
    found = next((each for each in built.tolerances if each.misalignment == drawn), None)
    if found is None or curve.series != 0:
        return
    room = 1e-3 * float(curve.x[-1] - curve.x[0])
    for words, pair in (
        ("buckles at", (found.critical_negative, found.critical_positive)),
        (f"{_shift(cost)} at", (found.negative, found.positive)),
    ):
        values = [v for v, _ in pair if curve.x[0] - room <= v <= curve.x[-1] + room]
        points = [(value, float(np.interp(value, curve.x, curve.y))) for value in values]
        sizes = [f"{words} {told(value, found.misalignment.unit)}" for value in values]
        if len(values) == 2 and abs(sum(values)) < _MIRRORED * abs(values[1]):
            size = told(values[1], found.misalignment.unit)
            yield Mark(curve.series, tuple(points), f"{words} ±{size}")
        else:
            yield from (Mark(curve.series, (p,), s) for p, s in zip(points, sizes, strict=True))


def _shift(cost: CostValues) -> str:
    return f"{100 * cost.shift:+.3g} %".replace("-", "\N{MINUS SIGN}")


#: Clamps that are shown; of more those that bear least.
MOST_CLAMPS = 6
#: Errors beyond this part of the mechanism's size, or this angle [rad], are drawn without an end:
#: stress that is in proportion to the error means nothing there, and no workshop is that far off.
LARGEST = 0.1
#: Room behind the longest bar for its value, as a part of the axis.
_BEYOND = 0.2


def bars_of(cost: CostValues) -> tuple[BarChart, ...]:
    """Tolerances of displacements and of rotations, where there are any that matter."""
    return *_bars(cost, "m"), *_bars(cost, "rad")


def _bars(cost: CostValues, unit: str) -> Iterator[BarChart]:
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
        return
    least: dict[Clamp, float] = {}
    for misalignment, each in found[0].items():
        clamp = misalignment.clamp
        least[clamp] = min(least.get(clamp, math.inf), each.tightest.value)
    chosen = sorted(least, key=lambda clamp: least[clamp])[:MOST_CLAMPS]
    groups = [
        Group(
            clamp.label,
            tuple(
                Row(misalignment.direction.removeprefix("r"), _row(misalignment, found, limit))
                for misalignment in found[0]
                if misalignment.clamp == clamp
            ),
        )
        for clamp in least
        if clamp in chosen
    ]
    left_out = len(least) - len(chosen)
    name, what = ("shifts", "displacement") if unit == "m" else ("turns", "rotation")
    title = f"Tolerance of a clamp for {what} ({_shift(cost)})"
    many = "clamp bears" if left_out == 1 else "clamps bear"
    more = f"; {left_out} more {many} more" if left_out else ""
    note = f"Arrows: more than {told(limit, unit, 2)}{more}"
    yield BarChart(name, title, log_scale(finite, unit, _BEYOND), tuple(groups), note)


def _row(
    misalignment: Misalignment, found: Sequence[dict[Misalignment, Tolerance]], limit: float
) -> tuple[Bar, ...]:
    made = []
    for series, tolerances in enumerate(found):
        if (each := tolerances.get(misalignment)) is not None:
            value, uncertainty = each.tightest
            made.append(Bar(series, *((math.inf, 0.0) if value > limit else (value, uncertainty))))
    return tuple(made)


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
    hertz = [
        (series, each, each.parasitic.column(0))
        for series, each in _strokes(cost)
        if each.parasitic is not None and each.parasitic.value.shape[1]
    ]
    parasitic = _along_stroke(cost, "parasitic", "Lowest parasitic frequency", hertz, "Hz")
    return *_strength(cost), *_stiffness(cost), *parasitic, *_misaligned(cost)


#: How far beyond the limit of the strength its chart goes, and a short name of what is allowed.
_BEYOND_STRENGTH, _ALLOWED = 1.25, "allowed"


def _strength(cost: CostValues) -> Iterator[Chart]:
    """The stress along the stroke, with what is allowed; none where nothing reaches that."""
    asked, labels = cost.strength, short_labels(cost)
    built = cost.as_built.limits
    if asked is None or built is None or not built.of(STRENGTH):
        return
    ends = [each.stroke for each in built.of(STRENGTH)]
    low, high = (_BEYOND_STRENGTH * each for each in (min(*ends, 0.0), max(*ends, 0.0)))
    curves = []
    for series, each in enumerate(cost.designs):
        if each.limits is not None:
            x, y = each.limits.strokes, each.limits.stress
            inside = (x >= low) & (x <= high)
            # To the very ends.
            fine = np.unique(np.concatenate([x[inside], np.clip([low, high], x[0], x[-1])]))
            spread = np.zeros_like(fine)
            curves.append(Curve(series, labels[series], fine, np.interp(fine, x, y), spread))
    allowed = np.interp(ends, built.strokes, built.stress)
    level = np.full(2, float(allowed.min()))
    # In the last look that there is, of so many designs.
    series = min(len(cost.designs), len(STYLES) - 1)
    line = Curve(series, _ALLOWED, np.array([low, high]), level, np.zeros(2))
    words, marks = built.of(STRENGTH)[-1].reason.partition(" (")[0], []
    for both in mirrored(built.of(STRENGTH)):
        size = told(abs(both[-1].stroke) if len(both) > 1 else both[-1].stroke, asked.unit)
        size = f"\N{PLUS-MINUS SIGN}{size}" if len(both) > 1 else size
        points = tuple((each.stroke, float(level[0])) for each in both)
        marks.append(Mark(0, points, f"{words} at {size}", is_open=len(points) > 1))
    yield Chart(
        "strength",
        "Largest stress",
        f"stroke of {asked.words} from rest",
        exact_scale(low, high, asked.unit),
        _up([*curves, line], "Pa"),
        (*curves, line),
        tuple(marks),
    )


def _stiffness(cost: CostValues) -> Iterator[Chart]:
    """In the direction that loses most of what it has as built at rest."""
    strokes = _strokes(cost)
    chosen = _direction(cost, strokes) if strokes else None
    if chosen is not None:
        name = cost.directions[chosen]
        title = f"Support stiffness {words_of_direction(name)}"
        chosen_of = [(series, each, each.stiffness.column(chosen)) for series, each in strokes]
        yield from _along_stroke(cost, "stiffness", title, chosen_of, stiffness_unit(name))


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


def _along_stroke(
    cost: CostValues,
    name: str,
    title: str,
    chosen: Iterable[tuple[int, StrokeCurve, Numbers]],
    unit: str,
) -> Iterator[Chart]:
    """A chart of numbers of designs along the stroke; none where none can be drawn."""
    asked, labels = cost.stroke, short_labels(cost)
    if asked is None:
        return
    made = (
        Curve(series, labels[series], curve.values - asked.rest, *_drawn(numbers))
        for series, curve, numbers in chosen
    )
    curves = tuple(curve for curve in made if curve.runs)
    if not curves:
        return
    first, last = sorted(value - asked.rest for value in asked.reached)
    room = 0.03 * (last - first)
    along = exact_scale(first - room, last + room, asked.unit)
    yield Chart(name, title, f"stroke of {asked.words}", along, _up(curves, unit), curves)


def _misaligned(cost: CostValues) -> Iterator[Chart]:
    """The measure against the misalignment that matters most, to both sides."""
    labels = short_labels(cost)
    curves = tuple(
        Curve(series, labels[series], *_smooth(each.curve, cost.measure == FREQUENCY))
        for series, each in enumerate(cost.designs)
        if each.curve is not None and each.curve.values.size > 1
    )
    if not curves or cost.as_built.curve is None:
        return
    chosen = cost.as_built.curve.misalignment
    # A stiffness without masses has the unit of the direction of the drive, which a stroke names.
    turns = cost.stroke is not None and cost.stroke.unit == "rad"
    unit = "Hz" if cost.measure == FREQUENCY else "N m/rad" if turns else "N/m"
    far = np.concatenate([curve.x for curve in curves])
    first, last = float(far.min()), float(far.max())
    verb = "turned" if chosen.unit == "rad" else "off"
    words = f"{chosen.clamp.label} {verb} {words_of_direction(chosen.direction)}"
    yield Chart(
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
    x, (y, spread) = curve.values, _drawn(curve.measure)
    if not is_frequency or not np.isfinite(y).all():
        return x, y, spread
    square = np.where(y < _BUCKLED * y.max(), 0.0, y**2)
    fine = np.unique(np.concatenate([x, np.linspace(x[0], x[-1], _POINTS)]))
    return fine, np.sqrt(np.interp(fine, x, square)), np.interp(fine, x, spread)


def _strokes(cost: CostValues) -> list[tuple[int, StrokeCurve]]:
    return [
        (series, each.stroke)
        for series, each in enumerate(cost.designs)
        if each.stroke is not None and each.stroke.values.size > 1
    ]


def _drawn(numbers: Numbers) -> tuple[FloatArray, FloatArray]:
    """Values, NaN where there is none that can be drawn, and their uncertainties."""
    value = np.where(np.isfinite(numbers.value), numbers.value, np.nan)
    spread = np.where(np.isfinite(numbers.uncertainty), numbers.uncertainty, 0.0)
    return value, np.broadcast_to(spread, value.shape)


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


def key_of(cost: CostValues) -> Key:
    """The table of a cost: columns of which the deck allows nothing are left out."""
    place = None if cost.tightest is None else cost.tightest.misalignment
    columns = {
        f"tolerance ({_shift(cost)})": [_tightest(each, place) for each in cost.designs],
        "buckles at": [_buckles(each, place) for each in cost.designs],
        "worst stiffness kept": [_kept(each) for each in cost.designs],
        "frequency": [_frequency(each) for each in cost.designs],
        "lowest parasitic": [_lowest_parasitic(each) for each in cost.designs],
        "may go": [_may_go(each) for each in cost.designs],
    }
    shown = {head: cells for head, cells in columns.items() if any(cells[1:] or cells)}
    if len(cost.designs) > 1 and len(set(shown.get("frequency", "12"))) == 1:
        # The same of all: it is told once, and tells nothing here.
        del shown["frequency"]
    rows = []
    for series, (label, design) in enumerate(zip(short_labels(cost), cost.designs, strict=True)):
        words, many = design.words.removeprefix("released: "), len(design.alike)
        words = f"{words} (and {many} alike)" if many else words
        rows.append(KeyRow(series, label, words, tuple(each[series] for each in shown.values())))
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
    critical = (each.critical.value for each in design.tolerances if each.misalignment == told)
    if next(critical, math.inf) <= _ALIKE * found.critical.value:
        return typeset(in_words(_rounded(found.critical), found.misalignment.unit))
    return _with_place(found.critical, found, place)


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
    first = design.frequencies.at(0)
    return in_words(_rounded(first), "Hz") if first.value > 0.0 else "buckled"


def _lowest_parasitic(design: Design) -> str:
    """At rest, and where the stroke makes it lowest."""
    first = design.first_parasitic
    if first is None:
        return ""
    told = in_words(_rounded(first), "Hz")
    along = None if design.stroke is None else design.stroke.parasitic
    if along is None or not along.value.size:
        return told
    k = int(np.argmin(along.value[:, 0]))
    least = along.at(k, 0)
    if least.value > 0.99 * first.value:
        return told
    lowest = in_words(_rounded(least), "Hz")
    if told.endswith(" Hz") and lowest.endswith(" Hz"):
        told = told.removesuffix(" Hz")
    return typeset(f"{told} -> {lowest}")


def _may_go(design: Design) -> str:
    """How far each way."""
    if design.limits is None:
        return ""
    low, high = design.limits.ends
    if len(mirrored((low, high))) == 1:
        return typeset(f"+-{told(high.stroke, design.limits.unit)}")
    return typeset(
        f"{told(low.stroke, design.limits.unit)} to +{told(high.stroke, design.limits.unit)}"
    )


#: Measures of the head [inch], and sizes of its letters [pt].
_MARGIN, _LABEL, _RIGHT_END, _TOP, _ROOM = 0.3, 0.8, 11.8, 0.2, 0.12
_LINE, _TABLE_ROW, _SECOND = 0.31, 0.245, 0.17
_HEADLINE, _WORDS, _SMALL = 16.0, 10.5, 9.0
#: Least and most room between columns [inch]; what is released takes at most so many lines.
_GAP, _MOST_GAP, _LINES = 0.2, 0.4, 2


class Table(NamedTuple):
    """The table as it is drawn.

    Attributes:
        key: What it says.
        words: What each design releases, in lines.
        place: Where these begin [inch].
        cells: Where the columns begin [inch].
        heights: Of the rows [inch].
        headline: Above it, in lines.
    """

    key: Key
    words: tuple[list[str], ...]
    place: float
    cells: list[float]
    heights: tuple[float, ...]
    headline: list[str]


def table_of(figure: Any, key: Key, headline: str) -> Table:
    """The table as wide as the figure; what is released has the room that is left.

    Args:
        figure: Any figure, with which letters are measured.
        key: What it says.
        headline: What stands above.
    """

    def width(words: Iterable[str], weight: str = "normal") -> float:
        return max((width_of(figure, each, _WORDS, weight) for each in words), default=0.0)

    first = _LABEL + width((row.label for row in key.rows), "bold") + _GAP
    wide = [
        max(
            width([head]),
            width([key.rows[0].cells[k]], "bold"),
            width(row.cells[k] for row in key.rows[1:]),
        )
        for k, head in enumerate(key.heads)
    ]
    told = [row.words if row.words != row.label else "" for row in key.rows]
    left = max(_RIGHT_END - first - sum(wide) - _GAP * (len(wide) + 1), 1.0)
    words = tuple(wrapped(figure, each, left, _WORDS) for each in told)
    needed = width(line for lines in words for line in lines)
    # What is not needed goes between the columns.
    gap = _GAP + max(0.0, min((left - needed) / (len(wide) + 1), _MOST_GAP - _GAP))
    place, cells = first + needed + gap * (needed > 0.0), []
    for each in wide:
        cells.append(place)
        place += each + gap
    heights = (_TABLE_ROW + _SECOND * max(len(lines) - 1, 0) for lines in words)
    lines = wrapped(figure, headline, _RIGHT_END - _MARGIN, _HEADLINE, "bold")
    return Table(key, words, first, cells, tuple(heights), lines)


def wrapped(figure: Any, text: str, room: float, size: float, weight: str = "normal") -> list[str]:
    """Words in two lines that fit; what does not fit into the last is cut."""
    lines: list[str] = []
    for word in text.split():
        longer = f"{lines[-1]} {word}" if lines else word
        is_last = len(lines) == _LINES
        if lines and (is_last or width_of(figure, longer, size, weight) <= room + 0.02):
            lines[-1] = longer
        else:
            lines.append(word)
    return [_cut(figure, line, room, size, weight) for line in lines]


def _cut(figure: Any, line: str, room: float, size: float, weight: str) -> str:
    told = line
    while len(line) > 1 and width_of(figure, told, size, weight) > room + 0.02:
        line = line[:-1].rstrip(" ;:,-")
        told = f"{line}\N{HORIZONTAL ELLIPSIS}"
    return told


#: How many notes stand in the picture; the words have them all.
_NOTES = 4


def draw_head(figure: Any, cost: CostValues, table: Table) -> None:
    """The headline, how it was found, and the table."""
    top = _TOP
    for line in table.headline:
        _text(figure, _MARGIN, top, line, _HEADLINE, INK, fontweight="bold")
        top += _LINE
    top += 0.04
    _text(figure, _MARGIN, top, ", ".join(choices_of(cost)), _WORDS, SOFT)
    top += _TABLE_ROW + 0.1
    for place, head in zip(table.cells, table.key.heads, strict=True):
        _text(figure, place, top, head, _WORDS - 0.5, SOFT)
    top += _TABLE_ROW
    for row, words, height in zip(table.key.rows, table.words, table.heights, strict=True):
        _draw_row(figure, table, row, words, top)
        top += height


def _draw_row(figure: Any, table: Table, row: KeyRow, told: list[str], top: float) -> None:
    from matplotlib.lines import Line2D

    look = style_of(row.series)
    whole, wide = figure.get_figheight(), figure.get_figwidth()
    middle = 1.0 - (top + 0.09) / whole
    figure.add_artist(
        Line2D(
            [_MARGIN / wide, (_LABEL - 0.1) / wide],
            [middle, middle],
            color=look.colour,
            lw=look.width,
            ls=(0, look.dashes) if look.dashes else "-",
        )
    )
    weight = "bold" if row.series == 0 else "normal"
    _text(figure, _LABEL, top, row.label, _WORDS, look.colour, fontweight=weight)
    for k, line in enumerate(told):
        _text(figure, table.place, top + k * _SECOND, line, _WORDS, INK)
    for place, cell in zip(table.cells, row.cells, strict=True):
        _text(figure, place, top, cell, _WORDS, INK, fontweight=weight)


def _text(
    figure: Any, left: float, top: float, words: str, size: float, colour: str, **more: Any
) -> None:
    figure.text(
        left / figure.get_figwidth(),
        1.0 - top / figure.get_figheight(),
        written(words),
        fontsize=size,
        color=colour,
        ha="left",
        va="top",
        **more,
    )


#: Width [inch] and pixels an inch: 1200 pixels wide.
_WIDTH, _DPI = 12.0, 100
#: Heights of what stands below each other [inch].
_CHART, _ROW, _TITLE, _BELOW = 2.15, 0.15, 0.3, 0.48
_END = 0.58
#: Charts in a row.
_BESIDE_EACH_OTHER = 3
#: Room beside charts and bars for what stands there [inch].
_LEFT, _NAMES, _GROUPS, _RIGHT = 0.62, 0.82, 1.05, 0.35


def plot_of(cost: CostValues) -> Any:
    """The picture as a figure of matplotlib, which a notebook shows.

    Raises:
        FlexactError: matplotlib is missing.
    """
    # Words are measured before there is a figure with room for them.
    measure = shown_figure(dpi=_DPI)
    charts, bars = charts_of(cost), bars_of(cost)
    table = table_of(measure, key_of(cost), typeset(first_line(cost)))
    rows = max((each.height(ROW, BETWEEN) for each in bars), default=0.0)
    told_of = [harmless(f"{note[:1].upper()}{note[1:]}.") for note in cost.left_out[:_NOTES]]
    room = _RIGHT_END - _MARGIN
    notes = [line for each in told_of for line in wrapped(measure, each, room, _SMALL)]
    heights = (
        _TOP + _LINE * len(table.headline) + 2 * _TABLE_ROW + sum(table.heights) + _ROOM,
        (_TITLE + _CHART + _BELOW) * _rows_of(charts),
        (_TITLE + _ROW * rows + _END) * bool(bars),
    )
    below = (_SECOND * len(notes) + _ROOM) * bool(notes)
    figure = shown_figure(figsize=(_WIDTH, sum(heights) + below), dpi=_DPI)
    draw_head(figure, cost, table)
    _draw_charts(figure, charts, heights[0])
    _draw_bars(figure, bars, heights[0] + heights[1])
    # At the lower edge.
    top = figure.get_figheight() - _SECOND * len(notes) - _ROOM
    for line in notes:
        _text(figure, _MARGIN, top, line, _SMALL, SOFT)
        top += _SECOND
    return figure


def plot_bytes(cost: CostValues, suffix: str = ".png") -> bytes:
    """The picture as a file: .png, .svg or .pdf.

    Raises:
        FlexactError: matplotlib is missing.
    """
    words = file_name(cost.name) or "cost", typeset(first_line(cost))
    return still_bytes(plot_of(cost), suffix, *words)


def _axes(figure: Any, left: float, top: float, width: float, height: float) -> Any:
    """Axes at a place from the upper left corner [inch]."""
    whole = figure.get_figheight()
    return figure.add_axes(
        (left / _WIDTH, 1.0 - (top + height) / whole, width / _WIDTH, height / whole)
    )


def _draw_charts(figure: Any, charts: tuple[Chart, ...], top: float) -> None:
    columns = math.ceil(len(charts) / max(_rows_of(charts), 1))
    cell = (_WIDTH - 2 * _MARGIN + 0.15) / max(columns, 1)
    for k, chart in enumerate(charts):
        row, column = divmod(k, columns)
        left, width = _MARGIN + column * cell + _LEFT, cell - _LEFT - _NAMES
        above = top + row * (_TITLE + _CHART + _BELOW) + _TITLE
        draw_chart(_axes(figure, left, above, width, _CHART), chart)


def _rows_of(charts: tuple[Chart, ...]) -> int:
    """In how many rows they stand."""
    return math.ceil(len(charts) / _BESIDE_EACH_OTHER)


def _draw_bars(figure: Any, bars: tuple[BarChart, ...], top: float) -> None:
    cell = (_WIDTH - 2 * _MARGIN) / max(len(bars), 1)
    for k, chart in enumerate(bars):
        left, width = _MARGIN + k * cell + _GROUPS, cell - _GROUPS - _RIGHT
        height = _ROW * chart.height(ROW, BETWEEN)
        draw_bars(_axes(figure, left, top + _TITLE, width, height), chart)
