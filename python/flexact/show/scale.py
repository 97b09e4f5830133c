# SPDX-License-Identifier: BSD-3-Clause
"""The scale of an axis: from where to where, with round ticks in a unit that is read well."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray
from ..util.records import Frozen
from .units import Unit, number, told, unit_for

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
        """The unit behind a title, such as " [mm]"; nothing where each tick has its own."""
        return "" if self.each_its_own else f" [{self.unit.name}]"


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
    low, high = (low if from_zero else low - room), high + room
    written = unit_for([low, high], unit)
    return Scale(low, high, written, False, _round_ticks(low, high, written), unit)


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
