# SPDX-License-Identifier: BSD-3-Clause
"""Along a path by what is left of D(x) = 0, about the reference alone.

So where several motions begin, where the follower (`flexact.motion.follow`) may find no
first step; where the geometry is rounded, which strains the path above its limit: what is allowed
here grows with the way as rounding lifts the zeros; and of large mechanisms, as it costs less.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from .extents_reduced import Reduced, across
from .follow import TRUE
from .least import beside, least_along

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
    """Length of the path of the node that moves farthest, in parts of the size."""
    strain: float
    """The largest on the path."""

    arrived: bool
    """Whether it went as far as it was to go, or came back to where it began."""


def walk(reduced: Reduced, unit: FloatArray, sign: float, floor: float) -> Walk:
    """Follow a motion one way.

    Args:
        reduced: What is left of D(x) = 0.
        unit: (N,) the motion, of norm one.
        sign: 1 or -1.
        floor: What the rounding of the geometry strains for each unit of the way.
    """
    if unit.size > 1 and not _begins(reduced, unit, sign, floor):
        return Walk(0.0, 0.0, False)
    here, gone, worst, step = reduced.at(np.zeros(unit.size)), 0.0, 0.0, _STEP
    ahead = sign * unit
    while here is not None and gone < GOAL:
        limit = TRUE + _ROUNDED * floor * (gone + step)
        if not gone:
            there = least_along(reduced, unit, sign * step)
        else:
            start = here.shares + step * ahead
            there = reduced.least(start, across(ahead[:, None]), _FARTHEST * step)
            if there is not None and _norm(there.shares - start) > _FARTHEST * step:
                there = None
        if there is None or there.strain > limit:
            step /= 2.0
            if step < _LEAST_STEP:
                break
            continue
        gone, worst = (
            gone + reduced.felt.held.reach(there.change - here.change),
            max(worst, there.strain),
        )
        ahead = (there.shares - here.shares) / _norm(there.shares - here.shares)
        here, step = there, min(2.0 * step, _STEP)
    return Walk(gone, worst, gone >= GOAL)


def _begins(reduced: Reduced, unit: FloatArray, sign: float, floor: float) -> bool:
    """Whether there is a path near, on which other motions fall behind."""
    found = least_along(reduced, unit, sign * _NEAR)
    limit = TRUE / 100.0 + _ROUNDED * floor * _NEAR
    if found is None or found.strain > limit:
        return False
    return beside(found, unit, sign * _NEAR) <= _BESIDE


def _norm(vector: FloatArray) -> float:
    return float(np.linalg.norm(vector))
