# SPDX-License-Identifier: BSD-3-Clause
"""What is read off a state: compliance, frequencies, and which of them are the drive's."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray
from ..elasticity import Estimate, State
from .keeping import Ratios, able, ratios, scales_of
from .values import Number, Numbers, Point

#: How many frequencies are looked at.
MOST = 10
#: From which part of the largest displacement of a mode the driven point moves in it.
_DRIVEN = 0.1


@dataclass(frozen=True)
class Measures:
    """What is measured, and where.

    Attributes:
        point: The point.
        directions: Its directions.
        size: Of the model [m].
        drives: Declared coordinates, number of the node and name.
        has_masses: Whether there are frequencies.
    """

    point: Point
    directions: tuple[str, ...]
    size: float
    drives: tuple[tuple[int, str], ...]
    has_masses: bool

    @property
    def scale(self) -> FloatArray:
        """(d,) see `keeping.scales_of`."""
        return scales_of(self.directions, self.size)

    def compliance(self, state: State) -> FloatArray:
        """(d, d) at the point."""
        made: FloatArray = np.asarray(state.compliance(self.point.node), np.float64)
        return made

    def stiffness(self, state: State) -> FloatArray:
        """(d,) inverse of each compliance along its direction; infinite where it is held."""
        compliance = self.compliance(state)
        free = able(compliance, self.scale) | np.isinf(np.diag(compliance))
        own = np.where(free, np.diag(compliance), 1.0)
        return np.where(free, 1.0 / own, np.inf)

    def ratios(self, before: State, after: State) -> Ratios:
        """What is kept of the stiffness at the point."""
        return ratios(self.compliance(before), self.compliance(after), self.scale)

    def worst(self, before: State, after: State) -> FloatArray:
        """(1,) smallest part that is kept; 1 of a point that cannot move."""
        mu = self.ratios(before, after).mu
        return mu[:1] if mu.size else np.ones(1)

    def frequencies(self, state: State) -> FloatArray:
        """(k,) lowest frequencies [Hz], ascending; 0 where a mode is unstable."""
        return np.maximum(np.asarray(state.frequencies[:MOST], np.float64), 0.0)


def numbers(estimate: Estimate) -> Numbers:
    """An estimate as a cost has it."""
    value, off = np.atleast_1d(estimate.value), np.atleast_1d(estimate.uncertainty)
    return Numbers(value, np.where(np.isfinite(off), off, 0.0))


def number(estimate: Estimate) -> Number:
    """The same of a single number."""
    value, off = float(estimate.value), float(estimate.uncertainty)
    return Number(value, off if np.isfinite(off) else 0.0)


def over_levels(quantity: Callable[..., FloatArray], *states: State) -> Estimate:
    """A quantity of several states, extrapolated; of each number of beams what fits is taken."""
    made = [quantity(*each) for each in zip(*(s.alone for s in states), strict=True)]
    if len(made) == 1:
        return Estimate.fixed(made[0])
    count = min(len(each) for each in made)
    return Estimate.of(made[0][:count], made[1][:count])


def drives_of(measures: Measures, state: State, count: int) -> tuple[bool, ...]:
    """Which of the lowest frequencies belong to a declared coordinate: one of each.

    Without a declared coordinate none does. The mode is the one in which the driven point moves
    most, of several the lowest.
    """
    found = [False] * count
    finest = state.alone[-1]
    for node, name in measures.drives:
        moved = [_moved(measures, finest, k, node, name) for k in range(count)]
        best = int(np.argmax(np.round(moved, 1)))
        if moved[best] >= _DRIVEN:
            found[best] = True
    return tuple(found)


def _moved(measures: Measures, state: State, mode: int, node: int, name: str) -> float:
    """How far a coordinate moves in a mode, as a part of what moves farthest."""
    shape = np.asarray(state.modes[mode], np.float64)
    index = state.data.node_index[node]
    turns = state.data.arrays.node_kind > 2
    sizes = np.abs(shape) * np.where(turns, measures.size, 1.0)[:, None]
    largest = float(sizes.max(initial=0.0))
    return float(sizes[index, "xyz".index(name[-1])]) / largest if largest > 0.0 else 0.0
