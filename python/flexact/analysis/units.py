# SPDX-License-Identifier: BSD-3-Clause
"""Lengths and angles in the units of a workshop."""

from __future__ import annotations

_LENGTHS = ((1.0, "m"), (1.0e-3, "mm"), (1.0e-6, "um"), (1.0e-9, "nm"))
_ANGLES = ((1.0, "rad"), (1.0e-3, "mrad"), (1.0e-6, "urad"), (1.0e-9, "nrad"))


def length_in_words(length: float) -> str:
    """A length [m] in two digits, such as "12 um"."""
    return _in_words(length, _LENGTHS)


def angle_in_words(angle: float) -> str:
    """An angle [rad] in two digits, such as "0.2 mrad"."""
    return _in_words(angle, _ANGLES)


def _in_words(size: float, units: tuple[tuple[float, str], ...]) -> str:
    # Rounded before the unit is chosen: 999.7 um are 1 mm.
    rounded = float(f"{size:.2g}")
    factor, unit = next((each for each in units if rounded >= each[0]), units[-1])
    return f"{rounded / factor:.4g} {unit}"
