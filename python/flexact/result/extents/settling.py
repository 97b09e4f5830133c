# SPDX-License-Identifier: BSD-3-Clause
"""Towards positions without strain, or with the least: Levenberg-Marquardt steps.

The damping is the square of what is left, so that the steps converge fast to a position without
strain also where it is one of many (Yamashita and Fukushima, Computing Suppl. 15, 2001).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from .held import Held, Place

#: Strains below this are rounding; so are corrections.
ROUNDING = 1.0e-15
_MOST_STEPS = 80
#: The least is reached where a step takes away less than this part of what is left.
_LEAST_GAIN = 1.0e-7
_LEAST_DAMPING, _MOST_DAMPING = 1.0e-4, 1.0e12
#: Farther than this from the start a step is not taken, in parts of the size.
_FARTHEST = 0.5


class Settled(NamedTuple):
    """Where the steps ended."""

    place: Place
    strain: float
    """The largest held deformation there."""
    went: float
    """Length of all corrections."""


def settled(held: Held, start: Place, across: FloatArray | None = None) -> Settled:
    """The nearest position with the least strain.

    Args:
        held: What is held.
        start: Where the steps begin.
        across: (n,) unit vector along which nothing is corrected; None: everything is.
    """
    here, went, damping = start, 0.0, 1.0
    error, jacobian = held.at(here)
    left = float(np.linalg.norm(error))
    for _ in range(_MOST_STEPS):
        if not left > ROUNDING:
            break
        if across is not None:
            jacobian = jacobian - np.outer(jacobian @ across, across)
        u, s, vt = np.linalg.svd(jacobian, full_matrices=False)
        along = u.T @ error
        taken = False
        while damping <= _MOST_DAMPING:
            factor = s / np.maximum(s**2 + damping * left**2, 1.0e-26)
            back = -vt.T @ (factor * along)
            step = float(np.linalg.norm(back))
            if step <= ROUNDING:
                break
            if went + step <= _FARTHEST:
                there = held.moved(here, back)
                new, next_jacobian = held.at(there)
                size = float(np.linalg.norm(new))
                if size < left:
                    taken = True
                    break
            damping *= 8.0
        if not taken:
            break
        gain = 1.0 - size / left
        here, error, jacobian, left = there, new, next_jacobian, size
        went += step
        damping = max(damping / 8.0, _LEAST_DAMPING)
        if gain < _LEAST_GAIN:
            break
    return Settled(here, float(np.abs(error).max(initial=0.0)), went)


def least_along(held: Held, motion: FloatArray, share: float, *, sideways: bool) -> Settled | None:
    """The least strain of the positions that a motion has gone by a share towards.

    Args:
        held: What is held.
        motion: (n,) unit vector, in the space of motions.
        share: How far, of one sign.
        sideways: Whether other motions may be added: then the steps begin at several places.

    Returns:
        None where the least is met along other motions.
    """
    first = settled(held, held.moved(held.reference, share * motion), motion)
    best = first if _is_near(held, first, motion, share) else None
    if not sideways or (best is not None and best.strain <= ROUNDING * 10.0):
        return best
    others = held.motions - np.outer(motion, motion @ held.motions)
    random = np.random.default_rng(len(motion))
    for _ in range(_STARTS):
        beside = others @ random.standard_normal(others.shape[1])
        size = float(np.linalg.norm(beside))
        start = share * motion + _BESIDE * abs(share) / max(size, ROUNDING) * beside
        found = settled(held, held.moved(held.reference, start), motion)
        if _is_near(held, found, motion, share) and (best is None or found.strain < best.strain):
            best = found
    return best


#: Other places to begin at, how far beside the motion, and how far beside it they may end.
_STARTS, _BESIDE, _ASIDE = 6, 0.1, 0.3


def _is_near(held: Held, found: Settled, motion: FloatArray, share: float) -> bool:
    return beside(held, found.place, motion, share) <= _ASIDE


def beside(held: Held, place: Place, motion: FloatArray, share: float) -> float:
    """How far other motions have gone, as a part of a share of this one."""
    gone = held.motions.T @ held.from_reference(place)
    return float(np.linalg.norm(gone - share * (held.motions.T @ motion))) / abs(share)
