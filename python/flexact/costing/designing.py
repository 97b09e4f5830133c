# SPDX-License-Identifier: BSD-3-Clause
"""One design: what it keeps, what its clamps may be off, what its stroke costs."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from .along import Along, curve_of
from .bench import Bench
from .designs import Design, Effect, MisalignmentCurve, Shape, StrokeCurve
from .effects import effect_of
from .keeping import kept_of
from .measuring import Measures, drives_of, levels, numbers, over_levels
from .shapes import shapes_of
from .tolerances import curve_against, tolerances_of
from .values import Kept, Misalignment, Numbers, Tolerance


class Wanted(NamedTuple):
    """What is to be found of each design."""

    measures: Measures
    misalignments: tuple[Misalignment, ...]
    shift: float
    drive: tuple[int, str] | None
    """The driven coordinate of the stroke, if one is asked for."""
    given: tuple[tuple[Misalignment, float], ...]
    """Misalignments that act together."""


def kept_beside(measures: Measures, before: Bench, after: Bench) -> Kept | None:
    """What a design keeps of the stiffness of the one as built."""
    one, two = before.rest, after.rest
    finest = measures.ratios(levels(one)[-1], levels(two)[-1])
    mu = numbers(over_levels(lambda a, b: measures.ratios(a, b).mu, one, two))
    return kept_of(finest, mu, measures.directions)


def frequencies_of(measures: Measures, bench: Bench) -> tuple[Numbers | None, tuple[bool, ...]]:
    """The lowest frequencies at rest, and which are the drive's."""
    if not measures.has_masses:
        return None, ()
    found = numbers(over_levels(measures.frequencies, bench.rest))
    if bench.choice.drive == "locked":
        return found, (False,) * found.value.size
    return found, drives_of(measures, bench.rest, found.value.size)
