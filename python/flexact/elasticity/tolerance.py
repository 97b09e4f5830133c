# SPDX-License-Identifier: BSD-3-Clause
"""How much may be off: buckling and shift of the first frequency, to first order in the stress.

The stress is proportional to the error d about the undeformed state. The square of the first
frequency is the smallest eigenvalue of K + d G with M, a concave function of d: it falls to any
level at most once on each side, before it is 0 where the mechanism buckles.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from ..core.arrays import FloatArray
from ..core.elastic import RawLinear
from ..util.records import cached_property
from .equilibria import Imperfection
from .errors import ElasticError
from .solution import Solution

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
            return _root(function, level, (last[0], last[1] - level), (here, value - level))
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
            return _root(function, level, (begin, function(begin) - level), (best, value - level))
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
    function: Function, level: float, low: tuple[float, float], high: tuple[float, float]
) -> float:
    """Where a function less a level changes its sign: by parabolas within a bracket."""
    here = _secant(low, high)
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


#: Errors larger than so many lengths of the model, or radians, are none that a design meets.
_FAR = 1.0e3
#: What rigid parts cannot follow, of what was asked, beyond rounding.
MISMATCH = 1.0e-8
#: The part of the nearest critical error with which a rise is looked for.
_BEGIN = 1.0e-2

Pair = tuple[float, float]


def unit_errors(rest: Solution, off: Sequence[Imperfection]) -> tuple[FloatArray, RawLinear]:
    """(3, nodes, k) moves of the supports for a unit of each misalignment, and what they do."""
    mesh = rest.solver.mesh
    shift = np.zeros((3, rest.solver.nodes, len(off)), order="F")
    for k, each in enumerate(off):
        shift[:, : mesh.nodes, k] = each.shift(mesh.own)
    return shift, rest.respond(np.zeros_like(shift), shift)


class Linear:
    """The stresses of one misalignment, for each unit of it, about the undeformed state."""

    def __init__(self, rest: Solution, off: Imperfection) -> None:
        """Of a mesh at rest, and what is off."""
        self._rest, self._off = rest, off

    @cached_property
    def stress(self) -> FloatArray:
        """(6, pieces, 1) stresses.

        Raises:
            ElasticError: rigid parts cannot follow.
        """
        _, answer = unit_errors(self._rest, (self._off,))
        if float(answer.mismatch[0]) > MISMATCH:
            raise ElasticError(
                f"rigid parts cannot follow {self._off.words}: nothing between them is elastic; "
                "give their elements a stiffness (ESTIFF)"
            )
        return answer.stress

    @cached_property
    def critical(self) -> Pair:
        """The errors of both signs at which it buckles; infinite where it does not."""
        return self._errors(0.0)

    def _errors(self, square: float) -> Pair:
        """The errors of both signs at which a frequency has this square; 0: it buckles."""
        found = self._rest.errors(self.stress, (square,))
        if found.negative:
            raise ElasticError("the undeformed state is unstable, so that no error makes it so")
        low, high = float(found.below[0, 0]), float(found.above[0, 0])
        return low if -low < self._far else -math.inf, high if high < self._far else math.inf

    @property
    def _far(self) -> float:
        return _FAR if self._off.is_turn else _FAR * self._rest.size

    @property
    def _first(self) -> float:
        """The square of the first angular frequency at no error.

        Raises:
            ElasticError: nothing vibrates, or a motion has no stiffness.
        """
        found = self._rest.squares
        if not found.values.size:
            raise ElasticError("nothing vibrates: no mass moves")
        if found.loose or found.values[0] <= 0.0:
            raise ElasticError(
                "a motion without stiffness has the frequency 0, which shifts by no part of "
                "itself: see undeformed().loose"
            )
        return float(found.values[0])

    def shifted(self, shift: float) -> Pair:
        """The errors at which the first frequency has shifted by a part of itself.

        A lower frequency is reached where K - square M + d G is singular first, on either side;
        a higher one is looked for.

        Args:
            shift: Relative, above -1 and not 0.
        """
        wanted = self._first * (1.0 + shift) ** 2
        if shift < 0.0:
            return self._errors(wanted)
        return self._rise(-1.0, wanted), self._rise(1.0, wanted)

    def _rise(self, sign: float, wanted: float) -> float:
        nearest = min(map(abs, self.critical))
        if math.isinf(nearest):
            # It falls on neither side, and is concave: it does not change.
            return sign * math.inf
        far = min(abs(self.critical[0 if sign < 0.0 else 1]), self._far)

        def square(error: float) -> float:
            return self._rest.under(sign * error * self.stress[:, :, 0]).lowest_square

        return sign * rises_to(square, wanted, self._first, _BEGIN * nearest, far)
