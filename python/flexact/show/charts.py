# SPDX-License-Identifier: BSD-3-Clause
"""Charts as values: curves of several designs over one axis, and bars of them by groups."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray
from ..util.records import Frozen

_MICRO = "\N{MICRO SIGN}"
#: Of each SI unit the ones that are written for it, with their sizes in it, the smallest first.
_WRITTEN: dict[str, tuple[tuple[float, str], ...]] = {
    "m": ((1e-9, "nm"), (1e-6, f"{_MICRO}m"), (1e-3, "mm"), (1.0, "m")),
    "rad": ((1e-6, f"{_MICRO}rad"), (1e-3, "mrad"), (1.0, "rad")),
    "N/m": ((1e-3, "mN/m"), (1.0, "N/m"), (1e3, "N/mm"), (1e6, f"N/{_MICRO}m")),
    "N m/rad": (
        *((1e-6, f"{_MICRO}N m/rad"), (1e-3, "mN m/rad"), (1.0, "N m/rad")),
        *((1e3, "kN m/rad"), (1e6, "MN m/rad")),
    ),
    "Hz": ((1e-3, "mHz"), (1.0, "Hz"), (1e3, "kHz"), (1e6, "MHz")),
    "Pa": ((1.0, "Pa"), (1e3, "kPa"), (1e6, "MPa"), (1e9, "GPa")),
}
#: A frequency of up to so many Hz is written in Hz.
_HERTZ = 10_000.0


class Unit(NamedTuple):
    """A unit as it is written.

    Attributes:
        size: In the SI unit.
        name: Such as "mm".
    """

    size: float
    name: str

    def told(self, value: float, digits: int = 3) -> str:
        """A value in the SI unit as words, such as "0.13 mm"."""
        return f"{number(value / self.size, digits)} {self.name}"


def unit_for(values: ArrayLike, unit: str) -> Unit:
    """The unit in which finite values are read best: the largest is at least one.

    Args:
        values: In the SI unit.
        unit: The SI unit: m, rad, N/m, N m/rad, Hz or Pa; another one stays.
    """
    known = _WRITTEN.get(unit, ((1.0, unit),))
    sizes = np.abs(np.asarray(values, float))
    largest = float(sizes[np.isfinite(sizes)].max(initial=0.0))
    if not largest > 0.0 or (unit == "Hz" and 1.0 <= largest < _HERTZ):
        return Unit(1.0, unit)
    fitting = [each for each in known if each[0] <= largest * (1.0 + 1e-9)]
    return Unit(*(fitting[-1] if fitting else known[0]))


def told(value: float, unit: str, digits: int = 3) -> str:
    """A value in an SI unit as words with the prefix that fits, such as "0.13 mm"."""
    return unit_for([value], unit).told(value, digits)


def typed(value: float, unit: str, digits: int = 3) -> str:
    """The same in letters of a keyboard, as options take it, such as "-0.13 um"."""
    return told(value, unit, digits).replace("\N{MINUS SIGN}", "-").replace("\N{MICRO SIGN}", "u")


def number(value: float, digits: int = 3) -> str:
    """A number to so many digits, in full up to a million, with a proper minus."""
    text = f"{value:.{digits}g}"
    if "e" in text and 1e-4 <= abs(value) < 1e6:
        text = f"{float(text):.0f}"
    return text.replace("-", "\N{MINUS SIGN}")


#: About how many ticks an axis has; up to how many decades there are ticks within them.
_TICKS = 5
_STEPS = ((1.2, (1.0, 2.0, 5.0)), (2.4, (1.0, 3.0)), (math.inf, (1.0,)))
#: Between words at ticks, in letters.
_APART = 1.0
#: Room beyond the values: as a part of their range, and as a factor.
_ROOM, _LOG_ROOM = 0.04, 1.8


@dataclass(frozen=True, eq=False)
class Scale(Frozen):
    """An axis.

    Attributes:
        low: Where it begins, in the SI unit.
        high: Where it ends.
        unit: In which its ticks are written, unless each has its own.
        is_log: Whether it is logarithmic.
        ticks: (t,) in the SI unit.
        si: That unit.
        each_its_own: Whether each tick has a unit of its own.
    """

    low: float
    high: float
    unit: Unit
    is_log: bool
    ticks: FloatArray
    si: str
    each_its_own: bool = False

    def share(self, values: ArrayLike) -> FloatArray:
        """Where values are, from 0 at the beginning to 1 at the end."""
        low, high = self.low, self.high
        found = np.asarray(values, float)
        if self.is_log:
            found = np.log(np.maximum(found, np.finfo(float).tiny))
            low, high = math.log(low), math.log(high)
        return np.asarray((found - low) / (high - low))

    @property
    def labels(self) -> tuple[str, ...]:
        """What stands at the ticks."""
        if self.each_its_own:
            return tuple(told(tick, self.si) for tick in self.ticks.tolist())
        return tuple(number(tick / self.unit.size, 6) for tick in self.ticks.tolist())

    def labels_for(self, letters: float) -> tuple[str, ...]:
        """What stands at the ticks of an axis that is so many letters long; "" without room."""
        made, free = [], -math.inf
        for place, label in zip(self.share(self.ticks).tolist(), self.labels, strict=True):
            start = place * letters - len(label) / 2
            made.append(label if start >= free else "")
            free = max(free, start + len(label) + _APART) if start >= free else free
        return tuple(made)

    @property
    def heading(self) -> str:
        """The unit behind a title, " [mm]"; nothing without, or where each tick has its own."""
        return "" if self.each_its_own or not self.unit.name else f" [{self.unit.name}]"


def linear_scale(values: ArrayLike, unit: str, *, from_zero: bool = False) -> Scale:
    """A scale on which finite values have room.

    Args:
        values: In the SI unit.
        unit: The SI unit.
        from_zero: Whether it begins at zero; no value is negative then.
    """
    found = _finite(values)
    low, high = (float(found.min()), float(found.max())) if found.size else (0.0, 1.0)
    if from_zero:
        low = 0.0
    if not high > low:
        low, high = (low - 0.5 * abs(low), high + 0.5 * abs(high)) if high else (-1.0, 1.0)
        low = 0.0 if from_zero else low
    room = _ROOM * (high - low)
    return exact_scale(low if from_zero else low - room, high + room, unit)


def exact_scale(low: float, high: float, unit: str) -> Scale:
    """A linear scale from one value to another; with some room where they are the same."""
    if not high > low:
        return linear_scale([low], unit)
    written = unit_for([low, high], unit)
    return Scale(low, high, written, False, _round_ticks(low, high, written), unit)


def log_scale(values: ArrayLike, unit: str, beyond: float = 0.0) -> Scale:
    """A logarithmic scale for the positive finite values; at least a decade.

    Each tick has a unit of its own where there is further room, as bars have it.

    Args:
        values: In the SI unit.
        unit: The SI unit.
        beyond: Further room behind the largest, as a part of the whole.
    """
    found = _finite(values)
    found = found[found > 0.0]
    low, high = (float(found.min()), float(found.max())) if found.size else (1.0, 1.0)
    low, high = low / _LOG_ROOM, high * _LOG_ROOM
    if high < 10.0 * low:
        middle = math.sqrt(low * high)
        low, high = middle / math.sqrt(10.0), middle * math.sqrt(10.0)
    high *= (high / low) ** beyond
    written = unit_for([high], unit)
    wide = math.log10(high / low)
    steps = next(steps for most, steps in _STEPS if wide < most)
    decades = range(
        math.floor(math.log10(low / written.size)), math.ceil(math.log10(high / written.size)) + 1
    )
    every = max(1, math.ceil(len(decades) / (_TICKS + 2)))
    ticks = [step * 10.0**decade * written.size for decade in decades[::every] for step in steps]
    inside = [tick for tick in ticks if low <= tick * (1 + 1e-9) and tick <= high * (1 + 1e-9)]
    return Scale(low, high, written, True, np.array(inside), unit, beyond > 0.0)


def _finite(values: ArrayLike) -> FloatArray:
    found = np.asarray(values, float).ravel()
    return np.asarray(found[np.isfinite(found)])


def _round_ticks(low: float, high: float, unit: Unit) -> FloatArray:
    """Multiples of 1, 2 or 5 times a power of ten, of the unit, between two values."""
    first, last = low / unit.size, high / unit.size
    raw = (last - first) / _TICKS
    power = 10.0 ** math.floor(math.log10(raw))
    step = power * next(each for each in (1.0, 2.0, 5.0, 10.0) if each * power >= raw * 0.999)
    count = np.arange(math.ceil(first / step - 1e-9), math.floor(last / step + 1e-9) + 1)
    # Written to as many digits as the step has.
    written = np.array([float(f"{each * step:.10g}") for each in count.tolist()])
    return np.asarray(written * unit.size)


#: Of a row's height: what bars fill, and the first one where there are others.
_FILLED, _FIRST = 0.88, 0.46


@dataclass(frozen=True, eq=False)
class Curve(Frozen):
    """What one design does along an axis.

    Attributes:
        series: Which design, from 0.
        label: What stands at its end.
        x: (p,) along the axis.
        y: (p,) NaN where there is no value: the curve is interrupted.
        spread: (p,) half the height of its band, 0 where there is none.
    """

    series: int
    label: str
    x: FloatArray
    y: FloatArray
    spread: FloatArray

    @property
    def runs(self) -> tuple[slice, ...]:
        """The stretches without interruption, of at least two points."""
        there = np.concatenate(([False], np.isfinite(self.y), [False]))
        turns = np.flatnonzero(there[1:] != there[:-1])
        pairs = zip(turns[::2].tolist(), turns[1::2].tolist(), strict=True)
        return tuple(slice(a, b) for a, b in pairs if b - a > 1)

    @property
    def end(self) -> tuple[float, float] | None:
        """The last point that has a value."""
        there = np.flatnonzero(np.isfinite(self.y))
        return (float(self.x[there[-1]]), float(self.y[there[-1]])) if there.size else None


class Mark(NamedTuple):
    """A special place of a curve, or two that mirror each other, with a few words."""

    series: int
    points: tuple[tuple[float, float], ...]
    words: str
    is_open: bool = False
    """Whether nothing is drawn above it, and the words stand there."""


@dataclass(frozen=True, eq=False)
class Chart(Frozen):
    """Curves.

    Attributes:
        name: By which files and tests know it, such as "stiffness".
        title: What is shown.
        x_title: What is along, without its unit.
        x: The axis along.
        y: The axis up.
        curves: The earlier ones lie below.
        marks: Special places on curves.
    """

    name: str
    title: str
    x_title: str
    x: Scale
    y: Scale
    curves: tuple[Curve, ...]
    marks: tuple[Mark, ...] = ()

    @property
    def heading(self) -> str:
        """The title with the unit of what is up."""
        return f"{self.title}{self.y.heading}"

    @property
    def along(self) -> str:
        """What is along, with its unit."""
        return f"{self.x_title}{self.x.heading}"

    @property
    def ends(self) -> list[tuple[Curve, tuple[float, float]]]:
        """The curves that have a value, with their last points."""
        return [(curve, curve.end) for curve in self.curves if curve.end is not None]


class Bar(NamedTuple):
    """How much of something one design bears.

    Attributes:
        series: Which design, from 0.
        value: Infinite where it does not matter how much.
        spread: Half the length of its whisker; 0 without one.
    """

    series: int
    value: float
    spread: float


class Row(NamedTuple):
    """Bars of all designs for one thing: the first is thick, the others are lines below it."""

    label: str
    bars: tuple[Bar, ...]

    @property
    def slots(self) -> list[tuple[float, float]]:
        """Where the middle of each bar is and how thick it is, as parts of the row's height."""
        others = sum(bar.series > 0 for bar in self.bars)
        first = _FIRST if others else _FILLED
        thin = (_FILLED - first) / max(others, 1)
        made, top = [], (1.0 - _FILLED) / 2
        for bar in self.bars:
            thick = thin if bar.series > 0 else first
            made.append((top + thick / 2, thick))
            top += thick
        return made


class Group(NamedTuple):
    """Rows that belong together, such as the directions of a clamp."""

    label: str
    rows: tuple[Row, ...]


@dataclass(frozen=True, eq=False)
class BarChart(Frozen):
    """Bars by groups, along an axis that begins at the left.

    Attributes:
        name: By which files and tests know it, such as "shifts".
        title: What is shown.
        x: The axis along.
        groups: From the top.
        note: A sentence below; may be empty.
    """

    name: str
    title: str
    x: Scale
    groups: tuple[Group, ...]
    note: str = ""

    @property
    def heading(self) -> str:
        """The title with the unit of what is along."""
        return f"{self.title}{self.x.heading}"

    def height(self, row: float, between: float) -> float:
        """How high all groups are together, of the heights of a row and of the room of a group."""
        return sum(len(group.rows) for group in self.groups) * row + len(self.groups) * between

    def layout(
        self, top: float, row: float, between: float
    ) -> Iterator[tuple[Group, float, float, list[tuple[Row, float]]]]:
        """Each group, where it begins and how high it is, and its rows with where they begin."""
        for group in self.groups:
            first = top + between / 2
            rows = [(each, first + k * row) for k, each in enumerate(group.rows)]
            height = len(group.rows) * row + between
            yield group, top, height, rows
            top += height


class KeyRow(NamedTuple):
    """A design in the key of charts."""

    series: int
    """Which design, from 0."""
    label: str
    """What stands at its curves."""
    words: str
    """What it is."""
    cells: tuple[str, ...]
    """As many as there are headings."""


class Key(NamedTuple):
    """The key of charts, a table of the designs: headings of the columns, and rows."""

    heads: tuple[str, ...]
    rows: tuple[KeyRow, ...]


#: A mark on a place that is higher than this part of an axis stands below it, else above.
_HIGH = 0.2


def mark_side(mark: Mark, across: float, up: float) -> tuple[int, bool]:
    """On which side of its place a mark is told: 1 right, -1 left, 0 amid a pair; and if below.

    Args:
        mark: The mark.
        across: Where its place is, from 0 at the left to 1.
        up: Likewise, from 0 at the bottom.
    """
    side = 0 if len(mark.points) > 1 else 1 if across < 0.5 else -1
    return side, up > _HIGH and not mark.is_open


def apart(wanted: FloatArray, gap: float, low: float, high: float) -> FloatArray:
    """Places nearest to the wanted ones that keep a gap from each other, between two bounds.

    Neighbours that are too near are moved as a block about their mean (pool adjacent violators).
    Where there is not room for all, they stand evenly.
    """
    count = wanted.size
    if count * gap >= high - low:
        order = np.argsort(np.argsort(wanted, kind="stable"), kind="stable")
        return np.asarray(low + (high - low) * (order + 0.5) / max(count, 1))
    order = np.argsort(wanted, kind="stable")
    # Each at what its place would be were all of them one block.
    shifted = wanted[order] - gap * np.arange(count)
    blocks: list[tuple[float, int]] = []
    for value in shifted.tolist():
        blocks.append((value, 1))
        while len(blocks) > 1 and blocks[-2][0] > blocks[-1][0]:
            (a, n), (b, m) = blocks[-2:]
            blocks[-2:] = [((a * n + b * m) / (n + m), n + m)]
    flat = np.repeat([each[0] for each in blocks], [each[1] for each in blocks])
    low, high = low + gap / 2, high - gap / 2
    made = np.empty(count)
    made[order] = np.clip(flat, low, high - gap * (count - 1)) + gap * np.arange(count)
    return made


class Style(NamedTuple):
    """The look of a series.

    Attributes:
        colour: On light ground.
        on_dark: On dark ground.
        dashes: Lengths of strokes and gaps, in widths of the line; empty of a full line.
        width: Of its line [pt].
    """

    colour: str
    on_dark: str
    dashes: tuple[float, ...]
    width: float


#: The first is the mechanism as it is. Later ones are drawn over earlier ones, thinner and
#: dashed, so that of curves on each other all are seen.
STYLES = (
    Style("#b8420a", "#ff9d5c", (), 3.2),
    Style("#3b00ff", "#8989ff", (4.0, 1.6), 2.2),
    Style("#007676", "#00b189", (1.6, 1.6), 2.0),
    Style("#b13bd8", "#b189c4", (6.0, 1.4, 1.2, 1.4), 1.8),
    Style("#4e2776", "#76ffff", (8.0, 2.5), 1.6),
    Style("#622714", "#c4ff00", (1.2, 1.2), 1.4),
)


def style_of(series: int) -> Style:
    """The look of a series by its number, from 0; there are as many as a cost has designs."""
    return STYLES[series % len(STYLES)]
