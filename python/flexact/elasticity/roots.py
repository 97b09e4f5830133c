# SPDX-License-Identifier: BSD-3-Clause
"""Where a concave function first rises to a level, in few evaluations."""

from __future__ import annotations

import math
from collections.abc import Callable

#: The level is met to this part of it.
_MET = 1.0e-8
#: At most so many evaluations.
_MOST = 60

Function = Callable[[float], float]


def rises_to(function: Function, level: float, start: float, step: float, far: float) -> float:
    """Where a concave function first rises to a level, from 0 outward; infinite where not.

    Args:
        function: The function.
        level: Above `start`.
        start: Its value at 0.
        step: With which it is begun.
        far: How far it is looked for.
    """
    before, last, value = (0.0, start), (0.0, start), start
    here = step
    while here <= far:
        value = function(here)
        if value >= level:
            return _root(function, level, (last[0], last[1] - level), (here, value - level), None)
        if value < last[1]:
            return _at_top(function, level, before[0], here)
        before, last, here = last, (here, value), 2.0 * here
    return math.inf


def _at_top(function: Function, level: float, low: float, high: float) -> float:
    """Where it has the level before its maximum, which lies between two places."""
    golden = (math.sqrt(5.0) - 1.0) / 2.0
    begin = low
    one, two = high - golden * (high - low), low + golden * (high - low)
    at_one, at_two = function(one), function(two)
    for _ in range(_MOST):
        best, value = (one, at_one) if at_one > at_two else (two, at_two)
        if value >= level:
            first = function(begin) - level
            return _root(function, level, (begin, first), (best, value - level), None)
        if high - low < 1.0e-6 * high:
            break
        if at_one > at_two:
            high, two, at_two = two, one, at_one
            one = high - golden * (high - low)
            at_one = function(one)
        else:
            low, one, at_one = one, two, at_two
            two = low + golden * (high - low)
            at_two = function(two)
    return math.inf


def _root(
    function: Function,
    level: float,
    low: tuple[float, float],
    high: tuple[float, float],
    guess: float | None,
) -> float:
    """Where a function less a level changes its sign: by parabolas within a bracket."""
    third: tuple[float, float] | None = None
    here = guess if guess is not None else _secant(low, high)
    for _ in range(_MOST):
        if not low[0] < here < high[0]:
            here = (low[0] + high[0]) / 2.0
        there = (here, function(here) - level)
        if abs(there[1]) <= _MET * abs(level):
            return here
        if (there[1] > 0.0) == (low[1] > 0.0):
            low, third = there, low
        else:
            high, third = there, high
        if high[0] - low[0] <= 1.0e-13 * high[0]:
            break
        here = _parabola(low, high, third)
    return here


def _secant(low: tuple[float, float], high: tuple[float, float]) -> float:
    return low[0] - low[1] * (high[0] - low[0]) / (high[1] - low[1])


def _parabola(
    low: tuple[float, float], high: tuple[float, float], third: tuple[float, float]
) -> float:
    """The root between low and high of the parabola through three places, as of a concave one."""
    (a, fa), (b, fb), (c, fc) = low, high, third
    first = (fb - fa) / (b - a)
    second = ((fc - fb) / (c - b) - first) / (c - a)
    slope = first + second * (a - b)
    inner = slope * slope - 4.0 * second * fa
    if inner <= 0.0:
        return _secant(low, high)
    root = math.copysign(math.sqrt(inner), slope)
    # Without cancellation.
    for step in (-2.0 * fa / (slope + root), -(slope + root) / (2.0 * second or math.inf)):
        if low[0] < a + step < high[0]:
            return a + step
    return _secant(low, high)
