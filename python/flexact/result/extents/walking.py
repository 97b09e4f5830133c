# SPDX-License-Identifier: BSD-3-Clause
"""Along a path where several motions begin, or where the geometry is rounded.

There the follower (`flexact.result.following.follow`) may find no first step, or strains above
its limit all along. What is allowed here grows with the way as rounding lifts the zeros.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from ..following.follow import TRUE
from ..following.settle import onward, settle
from .least import beside, least_along
from .reduced import Reduced

#: How far a path is followed, in parts of the size, and in how large steps.
GOAL, _STEP, _LEAST_STEP = 0.1, 0.02, 2.0e-4
#: Corrections of a step may be this part of it.
_FARTHEST = 0.5
#: Where a motion has gone so far, others that it takes along have gone this part of it at most.
_NEAR, _BESIDE = 1.0e-4, 0.05
#: What may be left is this multiple of what rounding of the geometry explains.
_ROUNDED = 10.0


class Walk(NamedTuple):
    """How far a path was followed one way."""

    gone: float
    """Length of the path, in parts of the size."""
    strain: float
    """The largest on the path."""

    @property
    def arrived(self) -> bool:
        """Whether it went as far as it was to go."""
        return self.gone >= GOAL * (1.0 - 1.0e-9)


def walk(reduced: Reduced, unit: FloatArray, sign: float, floor: float) -> Walk:
    """Follow a motion one way.

    Args:
        reduced: What is left of D(x) = 0.
        unit: (N,) the motion, of norm one.
        sign: 1 or -1.
        floor: What the rounding of the geometry strains for each unit of the way.
    """
    held = reduced.felt.held
    if unit.size > 1 and not _begins(reduced, unit, sign, floor):
        return Walk(0.0, 0.0)
    step = _STEP
    while True:
        first = least_along(reduced, unit, sign * step)
        limit = TRUE + _ROUNDED * floor * step
        if first is not None and first.strain <= limit:
            break
        step /= 2.0
        if step < _LEAST_STEP:
            return Walk(0.0, 0.0)
    where = held.moved(held.reference, first.change)
    here, gone, worst = held.at(where), step, first.strain
    ahead = onward(here, first.change / np.linalg.norm(first.change))
    while gone < GOAL:
        there = settle(held, here, ahead, step)
        limit = TRUE + _ROUNDED * floor * (gone + step)
        if there is None or there.residual > limit:
            step /= 2.0
            if step < _LEAST_STEP:
                break
            continue
        here, gone, worst = there, gone + step, max(worst, there.residual)
        ahead = onward(here, ahead)
        step = min(2.0 * step, _STEP)
    return Walk(gone, worst)


def _begins(reduced: Reduced, unit: FloatArray, sign: float, floor: float) -> bool:
    """Whether there is a path near, on which other motions fall behind."""
    found = least_along(reduced, unit, sign * _NEAR)
    limit = TRUE / 100.0 + _ROUNDED * floor * _NEAR
    if found is None or found.strain > limit:
        return False
    return beside(found, unit, sign * _NEAR) <= _BESIDE
