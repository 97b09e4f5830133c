# SPDX-License-Identifier: BSD-3-Clause
"""How much may be off: buckling and shift of the first frequency, to first order in the stress.

The stress is proportional to the error about the undeformed state. The square of the first
frequency is the smallest eigenvalue of K + d G with M, a concave function of the error d: it
falls to any level at most once on each side, before it is 0 where the mechanism buckles.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property

import numpy as np

from ..core import elastic
from ..core.arrays import FloatArray
from ..core.elastic import ElasticState
from .errors import ElasticError
from .imperfections import Imperfection
from .paths import at_rest
from .roots import falls_to, rises_to
from .solution import MULTIPLIERS, Solution
from .solver import Held, Solver

#: Errors larger than so many lengths of the model, or radians, are none that a design meets.
_FAR = 1.0e3
#: What rigid parts cannot follow, of what was asked, beyond rounding.
_MISMATCH = 1.0e-8
#: Multipliers beyond so many times the nearest are rounding.
_ROUNDING = 1.0e6
#: The part of the nearest critical error with which a rise is looked for.
_BEGIN = 1.0e-2
#: So many multipliers are looked at first; mostly there are both signs among them.
_FEW = 4
#: Critical errors of both signs are alike up to this part.
_ALIKE = 1.0e-6

Pair = tuple[float, float]


class Linear:
    """The stresses of one imperfection, for each unit of it, about the undeformed state."""

    def __init__(self, solver: Solver, held: Held, off: Imperfection) -> None:
        """Of a mesh with what is held, and what is off."""
        self._rest, self._off = at_rest(solver, held), off
        self._shifted: dict[float, Pair] = {}

    @cached_property
    def stressed(self) -> Solution:
        """The undeformed configuration with the stresses.

        Raises:
            ElasticError: rigid parts cannot follow.
        """
        rest, s = self._rest, self._rest.solver
        own = s.mesh.own
        shift = np.zeros((3, s.nodes, 1), order="F")
        shift[:, : s.mesh.nodes, 0] = self._off.shift(own)
        misfit = np.asfortranarray(s.mesh.misfit(self._off.misfit)[:, :, None])
        answer = rest.respond(np.zeros((3, s.nodes, 1), order="F"), misfit, shift)
        if float(answer.mismatch[0]) > _MISMATCH:
            raise ElasticError(
                f"rigid parts cannot follow {self._off.words}: nothing between them is elastic; "
                "give their elements a stiffness (ESTIFF)"
            )
        stress = np.asfortranarray(answer.stress[:, :, 0])
        return Solution(
            s, ElasticState(rest.raw.configuration, stress, s.no_force), rest.way, rest.held
        )

    @cached_property
    def critical(self) -> Pair:
        """The errors of both signs at which it buckles; infinite where it does not."""
        for count in (_FEW, MULTIPLIERS):
            values = self.stressed.multipliers(count).values
            nearest = float(np.abs(values).min(initial=math.inf))
            there = values[np.abs(values) < min(self._far, _ROUNDING * nearest)]
            low = float(there[there < 0.0].max(initial=-math.inf))
            high = float(there[there > 0.0].min(initial=math.inf))
            if values.size < count or math.isfinite(low) == math.isfinite(high):
                break
        return low, high

    @property
    def _far(self) -> float:
        return _FAR if self._off.is_turn else _FAR * self._rest.size

    def square(self, value: float) -> float:
        """The square of the first angular frequency at an error."""
        at = self.stressed
        raw = at.raw._replace(stress=np.asfortranarray(value * at.raw.stress))
        s = at.solver
        return float(
            elastic.frequencies(s.model(at.held), s.arrays, raw, at.way.gravity, 1).values[0]
        )

    @cached_property
    def first(self) -> float:
        """The square at no error.

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

    def shifted(self, shift: float, near: Pair | None = None) -> Pair:
        """The errors at which the first frequency has shifted by a part of itself.

        Args:
            shift: Relative, above -1 and not 0.
            near: As parts of the critical errors, where the answer is expected.
        """
        if shift not in self._shifted:
            wanted = self.first * (1.0 + shift) ** 2
            low = self._one_way(-1.0, wanted, None if near is None else near[0])
            part = None if near is None else near[1]
            if abs(sum(self.critical)) <= _ALIKE * abs(self.critical[0]):
                part = self.parts((low, low))[0]
            self._shifted[shift] = low, self._one_way(1.0, wanted, part)
        return self._shifted[shift]

    def _one_way(self, sign: float, wanted: float, near: float | None) -> float:
        limit = abs(self.critical[0 if sign < 0.0 else 1])
        square: Callable[[float], float] = lambda d: self.square(sign * d)  # noqa: E731
        if wanted < self.first:
            return sign * falls_to(square, wanted, self.first, limit, near)
        nearest = min(map(abs, self.critical))
        if math.isinf(nearest):
            # It falls on neither side, and is concave: it does not change.
            return sign * math.inf
        far = min(limit, self._far)
        return sign * rises_to(square, wanted, self.first, _BEGIN * nearest, far)

    def parts(self, errors: Pair) -> Pair:
        """Errors as parts of the critical ones; NaN where there is none."""
        made = [
            abs(error / limit) if math.isfinite(limit) and math.isfinite(error) else math.nan
            for error, limit in zip(errors, self.critical, strict=True)
        ]
        return made[0], made[1]


def finite(pair: FloatArray) -> Pair:
    """A pair of plain numbers."""
    return float(pair[0]), float(pair[1])
