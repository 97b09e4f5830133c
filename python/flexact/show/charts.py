# SPDX-License-Identifier: BSD-3-Clause
"""Charts as values: curves of several designs over one axis, and bars of them by groups."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from ..util.records import Frozen
from .scale import Scale

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
        note: A sentence below; may be empty.
    """

    name: str
    title: str
    x_title: str
    x: Scale
    y: Scale
    curves: tuple[Curve, ...]
    marks: tuple[Mark, ...] = ()
    note: str = ""


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
    def rows(self) -> int:
        """How many rows there are."""
        return sum(len(group.rows) for group in self.groups)


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
