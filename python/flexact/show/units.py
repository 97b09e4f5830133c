# SPDX-License-Identifier: BSD-3-Clause
"""Units with the prefixes that engineers use, chosen by the sizes of values."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

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
        unit: The SI unit: m, rad, N/m, N m/rad or Hz; another one stays.
    """
    known = _WRITTEN.get(unit, ((1.0, unit),))
    sizes = np.abs(np.asarray(values, float))
    largest = float(sizes[np.isfinite(sizes)].max(initial=0.0))
    if unit == "Hz" and 1.0 <= largest < _HERTZ:
        return Unit(1.0, unit)
    if not largest > 0.0:
        return Unit(1.0, unit)
    fitting = [each for each in known if each[0] <= largest * (1.0 + 1e-9)]
    return Unit(*(fitting[-1] if fitting else known[0]))


def told(value: float, unit: str, digits: int = 3) -> str:
    """A value in an SI unit as words with the prefix that fits, such as "0.13 mm"."""
    found = unit_for([value], unit)
    return found.told(value, digits)


def number(value: float, digits: int = 3) -> str:
    """A number to so many digits, in full up to a million, with a proper minus."""
    text = f"{value:.{digits}g}"
    if "e" in text and 1e-4 <= abs(value) < 1e6:
        text = f"{float(text):.0f}"
    return text.replace("-", "\N{MINUS SIGN}")
