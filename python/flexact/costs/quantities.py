# SPDX-License-Identifier: BSD-3-Clause
"""Numbers with their uncertainty in words, in the units of a workshop."""

from __future__ import annotations

import math

from .values import Number

#: Prefixes by unit; other units have none.
_PREFIXES: dict[str, tuple[tuple[float, str], ...]] = {
    "m": ((1.0, "m"), (1e-3, "mm"), (1e-6, "um"), (1e-9, "nm")),
    "rad": ((1.0, "rad"), (1e-3, "mrad"), (1e-6, "urad"), (1e-9, "nrad")),
    "Hz": ((1e3, "kHz"), (1.0, "Hz")),
    "N/m": ((1e6, "N/um"), (1e3, "N/mm"), (1.0, "N/m")),
    "N": ((1e3, "kN"), (1.0, "N"), (1e-3, "mN")),
    "J": ((1.0, "J"), (1e-3, "mJ"), (1e-6, "uJ"), (1e-9, "nJ")),
    "Pa": ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"), (1.0, "Pa")),
}
#: Digits of a number whose uncertainty is below this part of it.
_DIGITS, _CERTAIN = 4, 0.5e-4
#: Decimals of a number that stand before it is written with an exponent.
_MOST_DECIMALS = 8


def in_words(number: Number, unit: str = "", *, none: str = "none") -> str:
    """Such as "132.7 +- 0.2 um"; digits that are uncertain are left out.

    Args:
        number: The number; infinite where there is none.
        unit: The SI unit: a prefix is found for m, rad, Hz, N/m, N, J and Pa.
        none: What stands for a number that is infinite.
    """
    if not number.is_finite:
        return none
    factor, name = scale_of(number.value, unit)
    value, off = number.value / factor, abs(number.uncertainty) / factor
    text = _rounded(value, off)
    return f"{text} {name}" if name else text


def scale_of(value: float, unit: str) -> tuple[float, str]:
    """The prefix with which a value is between 1 and 1000, as its factor and its name."""
    prefixes = _PREFIXES.get(unit, ((1.0, unit),))
    size = abs(float(f"{value:.3g}"))
    if size == 0.0:
        return 1.0, unit
    return next((each for each in prefixes if size >= each[0]), prefixes[-1])


def _rounded(value: float, off: float) -> str:
    if not off > _CERTAIN * abs(value):
        return f"{value:.{_DIGITS}g}"
    # One digit of the uncertainty, rounded up.
    digits = -math.floor(math.log10(off))
    off = math.ceil(off * 10.0**digits - 1.0e-9) / 10.0**digits
    if digits > _MOST_DECIMALS or digits < 0:
        return f"{value:.{_DIGITS}g} +- {off:.1g}"
    return f"{value:.{digits}f} +- {off:.{digits}f}"


def percent(part: float) -> str:
    """A part such as 0.05 as "5 %"."""
    return f"{100.0 * part:.3g} %"
