# SPDX-License-Identifier: BSD-3-Clause
"""Numbers with their units, as people write them: "20um", "3 mm", "2deg", "210 GPa"."""

from __future__ import annotations

import math
import re
from typing import Any, NamedTuple, SupportsFloat, SupportsIndex

import numpy as np

from .errors import FlexactError
from .loading import load
from .text import in_short

#: What Python takes for a quantity: SI, or a text that says its unit.
Quantity = float | str

_NUMBER = r"(?s)\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*"
_MICRO = ("u", "\N{MICRO SIGN}", "\N{GREEK SMALL LETTER MU}")
_SMALL = {"m": -3, **dict.fromkeys(_MICRO, -6), "n": -9}


class _Kind(NamedTuple):
    """Quantities of one kind."""

    name: str
    example: str
    powers: dict[str, int]
    """Powers of ten by unit without blanks, so that 5um is the number that 5e-6 is."""
    plain: int = 0
    """That of a number without a unit."""


def _prefixed(unit: str, **more: int) -> dict[str, int]:
    return {unit: 0, **{prefix + unit: power for prefix, power in _SMALL.items()}, **more}


#: By the unit of a number that says none; what is read is in SI.
_KINDS = {
    "m": _Kind("a length", "50um, 0.1mm or 5e-5", _prefixed("m", cm=-2)),
    "rad": _Kind("an angle", "50urad, 1mrad, 2deg or 1e-3", _prefixed("rad")),
    "deg": _Kind("an angle", "30, 30deg or 0.5rad", {}),
    "Pa": _Kind(
        *("a stress or a modulus", "210GPa or 2.1e11"),
        {"Pa": 0, "kPa": 3, "MPa": 6, "N/mm2": 6, "GPa": 9},
    ),
    "kg/m3": _Kind("a density", "7850kg/m3 or 7850", {"kg/m3": 0, "g/cm3": 3, "kg/dm3": 3}),
    "kg": _Kind("a mass", "0.2kg or 200g", {"kg": 0, "g": -3, "mg": -6}),
    "kg m2": _Kind("a moment of inertia", "2e-4kgm2 or 2e-4", {"kgm2": 0, "kgmm2": -6}),
    "N": _Kind("a force", "5N or 20mN", _prefixed("N", kN=3)),
    "N m": _Kind("a moment", "0.5Nm or 20Nmm", {"Nm": 0, "mNm": -3, "Nmm": -3, "kNm": 3}),
    "N/m": _Kind("a stiffness", "5N/mm or 5000", {"N/m": 0, "N/mm": 3, "kN/m": 3, "N/um": 6}),
    "N m/rad": _Kind(
        *("a stiffness of a rotation", "3.5Nm/rad or 3.5"),
        {"Nm/rad": 0, "mNm/rad": -3, "Nmm/rad": -3},
    ),
    "m/s2": _Kind("an acceleration", "9.81m/s2 or 9.81", {"m/s2": 0, "mm/s2": -3}),
    "1/K": _Kind("an expansion", "11e-6 or 11um/m/K", {"1/K": 0, "ppm/K": -6, "um/m/K": -6}),
    "K/m": _Kind("a gradient of temperature", "5K/m or 0.005K/mm", {"K/m": 0, "K/mm": 3}),
    "Hz": _Kind("a frequency", "9Hz or 9", {"Hz": 0, "kHz": 3}),
    "K": _Kind("a temperature difference", "10 or 10K", {"K": 0, "mK": -3}),
}
#: Of a notch, which bends or, of an elongation, stretches.
NOTCH = "N m/rad or N/m"
_KINDS[NOTCH] = _Kind(
    *("a stiffness", "3.5Nm/rad, 5N/mm or 3.5"),
    {**_KINDS["N m/rad"].powers, **_KINDS["N/m"].powers},
)
for _unit, _small, _example, _plain in (
    ("m", "mm", "0.3, 300um or 0.3mm", -3),
    ("Pa", "MPa", "210000 or 210GPa", 6),
    ("kg m2", "kg mm2", "200 or 2e-4kgm2", -6),
    ("N m", "N mm", "20 or 20Nmm", -3),
    ("N/m", "N/mm", "5 or 5N/mm", 3),
    ("N m/rad", "N mm/rad", "3500 or 3.5Nm/rad", -3),
    ("m/s2", "mm/s2", "9810 or 9.81m/s2", -3),
    ("K/m", "K/mm", "0.005 or 5K/m", 3),
):
    _KINDS[_small] = _KINDS[_unit]._replace(example=_example, plain=_plain)
_DEGREES = ("deg", "\N{DEGREE SIGN}")


class QuantityError(FlexactError, ValueError):
    """A text that is no quantity of the kind that is wanted; it says what is."""


def quantity(text: str, unit: str) -> float:
    """The number that a text such as "50um" or "0.1 mm" is in an SI unit, or in "deg".

    A number without a unit is in that unit.

    Raises:
        QuantityError: it is none, of another kind, or too large.
    """
    return _read(text, unit)[0]


def as_typed(text: str, unit: str) -> Quantity:
    """A text as Python takes it: a number where it says no unit, which is that of the model.

    Raises:
        QuantityError: as of `quantity`.
    """
    value, said = _read(text, unit)
    return text if said else value


def measured(given: object, unit: str) -> float:
    """What Python is given for a quantity: a number, or a text that says its unit.

    Raises:
        QuantityError: the text is no such quantity, or says no unit.
        TypeError, ValueError, OverflowError: it is no number.
    """
    if not isinstance(given, str):
        if not isinstance(given, (SupportsFloat, SupportsIndex)):
            raise TypeError
        plain = _KINDS[unit].plain
        # By its digits, so that 0.3 mm is the number that 0.0003 is.
        return _scaled(repr(float(given)), plain) if plain else float(given)
    value, said = _read(given, unit)
    if not said:
        raise QuantityError(
            f"a text says its unit, such as {_with_unit(unit)}: {in_short(given)} does not; give a "
            "number, or its unit"
        )
    return value


def _with_unit(unit: str) -> str:
    """The first example of a kind that says its unit."""
    examples = re.split(r", | or ", _KINDS[unit].example)
    return next(each for each in examples if re.fullmatch(_NUMBER, each)[2])  # type: ignore[index]


def without_units(given: object, unit: str) -> Any:
    """What is given with each text in it, alone or in lists and tuples, as its number in SI.

    Numbers are in the unit; what is none stays.

    Raises:
        QuantityError: as of `measured`.
    """
    if isinstance(given, str):
        return measured(given, unit)
    if isinstance(given, (list, tuple)):
        return [without_units(each, unit) for each in given]
    if _KINDS[unit].plain and not isinstance(given, (bool, np.bool_)):
        if isinstance(given, np.ndarray) and given.ndim:
            return np.reshape([without_units(each, unit) for each in given.ravel()], given.shape)
        if isinstance(given, (int, float, np.number, np.ndarray)):
            return measured(given, unit)
    return given


def _scaled(digits: str, power: int) -> float:
    """A decimal number times a power of ten."""
    return float(load("decimal").Decimal(digits).scaleb(power))


def _read(text: str, unit: str) -> tuple[float, str]:
    """The number, and the unit that was said."""
    found, kind = re.fullmatch(_NUMBER, text), _KINDS[unit]
    said = "" if found is None else re.sub(r"[\s*]|\N{MIDDLE DOT}", "", found[2])
    said = said.replace("\N{SUPERSCRIPT TWO}", "2").replace("\N{SUPERSCRIPT THREE}", "3")
    value = math.nan
    if found is not None:
        turned = _KINDS["rad"].powers.get(said)
        if not said or (unit == "deg" and said in _DEGREES):
            value = _scaled(found[1], kind.plain)
        elif unit == "deg" and turned is not None:
            value = math.degrees(_scaled(found[1], turned))
        elif unit == "rad" and said in _DEGREES:
            value = math.radians(float(found[1]))
        elif said in kind.powers:
            value = _scaled(found[1], kind.powers[said])
    if math.isnan(value):
        of = next((k.name for k in _KINDS.values() if said in k.powers), "")
        of = "an angle" if said in _DEGREES else of
        told = in_short(text.strip())
        raise QuantityError(
            f"{kind.name} [{unit}] is wanted, such as {kind.example}, not {told}"
            f"{f', which is {of}' if of else ''}"
        )
    if not math.isfinite(value):
        raise QuantityError(f"{in_short(text.strip())} is too large")
    return value, said


def larger_in_words(what: str, size: str, most: str, example: str) -> str:
    """What is said of a size that is larger than the model: mostly a slip of the unit.

    Args:
        what: Such as "the accuracy".
        size: What it is, with its unit.
        most: What it is held against.
        example: How it may be written.
    """
    return (
        f"{what} is {size}, larger than {most}: say its unit, such as {example}, if that is not "
        "meant; --beyond (in Python beyond=True) permits it"
    )
