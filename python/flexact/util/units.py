# SPDX-License-Identifier: BSD-3-Clause
"""The units in which lengths are given and said: metres, or millimetres.

Newtons, kilograms, seconds and radians stay; what has a length in it follows, so that with
millimetres stresses are in MPa, moments in N mm and stiffnesses in N/mm. The core and all arrays
of a model keep SI.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import overload

import numpy as np

from .loading import load
from .quantities import QuantityError, measured
from .records import Frozen
from .text import in_short

#: Power of the length in each quantity, by its SI unit, and its unit with millimetres.
_WITH_LENGTH = {
    "m": (1, "mm"),
    "m2": (2, "mm2"),
    "Pa": (-2, "MPa"),
    "N m": (1, "N mm"),
    "N m2": (2, "N mm2"),
    "N/m": (-1, "N/mm"),
    "N m/rad": (1, "N mm/rad"),
    "m/N": (1, "mm/N"),
    "rad/(N m)": (-1, "rad/(N mm)"),
    "1/(N m)": (-1, "1/(N mm)"),
    "J": (1, "N mm"),
    "kg m": (1, "kg mm"),
    "kg m2": (2, "kg mm2"),
    "kg/m": (-1, "kg/mm"),
    "m/s2": (1, "mm/s2"),
    "m/rad": (1, "mm/rad"),
    "m/K": (1, "mm/K"),
    "K/m": (-1, "K/mm"),
    "N m/rad or N/m": (0, "N mm/rad or N/mm"),
}


@dataclass(frozen=True)
class Units(Frozen):
    """Units of lengths, and of all that has a length in it.

    Attributes:
        name: "m" or "mm", as decks, models and commands have it.
        power: Power of ten of its length in metres.
    """

    name: str
    power: int

    def symbol(self, unit: str) -> str:
        """The unit here of what has an SI unit, such as "N/mm" of "N/m"."""
        return _WITH_LENGTH.get(unit, (0, unit))[1] if self.power else unit

    def factor(self, unit: str) -> float:
        """What a number in an SI unit is multiplied with to be one in the unit here."""
        power = -self.power * _WITH_LENGTH.get(unit, (0, unit))[0]
        return 10.0**power if power >= 0 else 1.0 / 10.0**-power

    @overload
    def shown(self, value: float, unit: str) -> float: ...
    @overload
    def shown(self, value: np.ndarray, unit: str) -> np.ndarray: ...
    def shown(self, value: float | np.ndarray, unit: str) -> float | np.ndarray:
        """A number, or numbers, of an SI unit in the unit here."""
        return _scaled(value, -self.power * _WITH_LENGTH.get(unit, (0, unit))[0])

    @overload
    def si(self, value: float, unit: str) -> float: ...
    @overload
    def si(self, value: np.ndarray, unit: str) -> np.ndarray: ...
    def si(self, value: float | np.ndarray, unit: str) -> float | np.ndarray:
        """A number, or numbers, of the unit here in SI."""
        return _scaled(value, self.power * _WITH_LENGTH.get(unit, (0, unit))[0])

    def said(self, value: float, unit: str, digits: int = 4) -> str:
        """Such as "12.5 N/mm"."""
        return f"{self.shown(value, unit):.{digits}g} {self.symbol(unit)}"

    def read(self, given: object, unit: str) -> float:
        """What is given for a quantity, a number in the unit here or a text with its own, in SI.

        Raises:
            QuantityError: the text is no such quantity, or says no unit.
            TypeError, ValueError, OverflowError: it is no number.
        """
        return measured(given, self.symbol(unit))

    def typed(self, value: float, unit: str) -> str:
        """A number of an SI unit as decks have it here: what reads back to its last bit."""
        power = -self.power * _WITH_LENGTH.get(unit, (0, unit))[0]
        if not power or not value:
            return repr(value)
        decimal = load("decimal").Decimal
        exact = decimal(repr(value)).scaleb(power)
        near = repr(float(exact))
        return near if decimal(near) == exact else str(exact)


def _scaled(value: float | np.ndarray, power: int) -> float | np.ndarray:
    """A number times a power of ten, rounded once."""
    if not power:
        return value
    return value * 10.0**power if power > 0 else value / 10.0**-power


METRES = Units("m", 0)
MILLIMETRES = Units("mm", -3)
_KNOWN = {each.name: each for each in (METRES, MILLIMETRES)}


def units_of(given: object) -> Units:
    """The units that are meant by a name, or by themselves.

    Raises:
        QuantityError: there are none of this name.
    """
    if isinstance(given, Units):
        return given
    found = _KNOWN.get(given) if isinstance(given, str) else None
    if found is None:
        raise QuantityError(f"units are {' or '.join(map(repr, _KNOWN))}, not {in_short(given)}")
    return found
