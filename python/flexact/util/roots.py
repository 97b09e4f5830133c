# SPDX-License-Identifier: BSD-3-Clause
"""Zeros of a function of one variable: where its sign changes, and where a minimum reaches zero."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

Function = Callable[[float], float | None]

#: The variable goes from 0 to 1, or from -1 to 1: it is known to the last bit or two.
_LAST_BITS = 4.0e-16
#: A continuous function is this much smaller at a root than at the ends where the search began.
_CONTINUOUS = 1.0e-6
_GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0
#: A minimum this many times higher than what is left to fall does not reach zero; looked at once
#: the search has come so far.
_NO_ZERO, _WARM = 10.0, 6
_MOST_STEPS = 200
#: What cannot be told from the minimum: so many times as much, or rounding of values about one.
_AS_LOW, _NOTHING = 2.0, 4.0e-16
#: A function is below zero where it is so by more than rounding.
_BELOW = 1.0e-14


class Zero(NamedTuple):
    """A place where a function is zero."""

    place: float
    value: float
    """What is left of the function there."""
    width: float
    """How wide the interval is in which it lies."""


def sign_change(function: Function, a: float, b: float, fa: float, fb: float) -> Zero | None:
    """The root between two places at which a function has different signs.

    Bisection, sped up where it can be by inverse quadratic interpolation, so that the root stays
    between the two: T.R. Chandrupatla, A new hybrid quadratic/bisection algorithm, Advances in
    Engineering Software 28 (1997) 145-149. None where the function jumps or is not defined.
    """
    largest = max(abs(fa), abs(fb))
    c, fc = a, fa
    share = 0.5
    for _ in range(_MOST_STEPS):
        place = a + share * (b - a)
        value = function(place)
        if value is None:
            return None
        # The root stays between a and b, of which a is the newer; c is what was left behind.
        if math.copysign(1.0, value) == math.copysign(1.0, fa):
            c, fc = a, fa
        else:
            c, b, fc, fb = b, a, fb, fa
        a, fa = place, value
        best, least = (a, fa) if abs(fa) < abs(fb) else (b, fb)
        tolerance = _LAST_BITS * max(abs(best), 0.5)
        width = abs(b - a)
        if width <= 2.0 * tolerance or least == 0.0:
            break
        share = _share(a, b, c, fa, fb, fc)
        share = min(max(share, tolerance / width), 1.0 - tolerance / width)
    # From ends that are next to nothing it cannot fall below what rounding leaves.
    return Zero(best, least, width) if abs(least) <= max(_CONTINUOUS * largest, _BELOW) else None


def _share(a: float, b: float, c: float, fa: float, fb: float, fc: float) -> float:
    """Where to look next: by inverse quadratic interpolation if that is safe, else halfway."""
    if c == b or fb in (fa, fc) or fa == fc:
        return 0.5
    xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
    if not (phi**2 < xi and (1.0 - phi) ** 2 < 1.0 - xi):
        return 0.5
    return fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)


def minimum(function: Function, a: float, c: float) -> Zero | float | None:
    """The smallest value of a function between two places, by golden section.

    A place where it is below zero is given as it is, for there the sign changes. None where
    the minimum is clearly above zero, or the function is not defined.
    """
    seen: list[tuple[float, float]] = []

    def at(place: float) -> float:
        value = function(place)
        if value is None:
            raise _UndefinedError
        seen.append((value, place))
        return value

    try:
        return _minimum(at, a, c) or _lowest(seen)
    except _UndefinedError:
        return None


class _UndefinedError(Exception):
    """The function is not defined where it was asked for."""


def _minimum(at: Callable[[float], float], a: float, c: float) -> float | None:
    """Come as near to a minimum as can be; a place where the function is negative, if any."""
    b, d = c - _GOLDEN * (c - a), a + _GOLDEN * (c - a)
    fa, fb, fc, fd = at(a), at(b), at(c), at(d)
    for step in range(_MOST_STEPS):
        for place, value in ((b, fb), (d, fd)):
            if value < -_BELOW:
                return place
        least, most = min(fa, fb, fc, fd), max(fa, fc)
        if step >= _WARM and least > _NO_ZERO * (most - least):
            raise _UndefinedError
        if c - a <= _LAST_BITS * max(abs(a), abs(c), 1.0):
            break
        if fb <= fd:
            c, fc, d, fd = d, fd, b, fb
            b = c - _GOLDEN * (c - a)
            fb = at(b)
        else:
            a, fa, b, fb = b, fb, d, fd
            d = a + _GOLDEN * (c - a)
            fd = at(d)
    return None


def _lowest(seen: list[tuple[float, float]]) -> Zero:
    """The middle of where the function cannot be told from its minimum."""
    value = min(abs(each) for each, _ in seen)
    lowest = [place for each, place in seen if abs(each) <= max(_AS_LOW * value, _NOTHING)]
    first, last = min(lowest), max(lowest)
    return Zero(0.5 * (first + last), value, max(last - first, _LAST_BITS))
