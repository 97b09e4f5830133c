# SPDX-License-Identifier: BSD-3-Clause
"""Whether a motion goes on, as its path or its least strain says."""

from __future__ import annotations

from functools import partial

from ..core.arrays import FloatArray
from .ending import Ending
from .extent import EvidenceKind, Extent, Kind, Reason
from .extents_reduced import Reduced
from .follow import follow
from .followed import Wishes
from .orders import fit_of, measured
from .walking import GOAL, Walk, walk

#: Components of more coordinates are followed about the reference alone.
_MOST_COORDINATES = 120
_WISHES = Wishes(length=GOAL, steps=500, through=True)


def by_path(reduced: Reduced, unit: FloatArray, floor: float) -> Extent:
    """Follow a motion both ways; where it stops, fit the order of the least strain.

    Args:
        reduced: What is left of D(x) = 0.
        unit: (N,) the motion, of norm one.
        floor: What the rounding of the geometry strains for each unit of the way.
    """
    felt = reduced.felt
    held, motion = felt.held, felt.motions @ unit
    (back, why), (ahead, why_ahead) = (
        _gone(reduced, sign * motion, sign, unit, floor) for sign in (-1.0, 1.0)
    )
    made = partial(
        Extent,
        size=held.size,
        reach=(back.gone * held.size, ahead.gone * held.size),
        stops=(why, why_ahead),
        residual=max(back.strain, ahead.strain),
    )
    if back.arrived and ahead.arrived:
        return made(Kind.FINITE, EvidenceKind.FOLLOWED, Reason.PATH)
    if back.arrived or ahead.arrived:
        return made(Kind.UNDECIDED, EvidenceKind.NONE, Reason.ONE_WAY)
    found = [measured(reduced, unit, sign, floor) for sign in (-1.0, 1.0)]
    fits = [fit for each in found if (fit := fit_of(each)) is not None]
    if len(fits) == 2 and round(fits[0].order) == round(fits[1].order):
        fit = max(fits, key=lambda each: each.spread)
        return made(Kind.INFINITESIMAL, EvidenceKind.FITTED, Reason.ORDER, fit=fit)
    if felt.many > 1 and any(each.aside for each in found):
        return made(Kind.UNDECIDED, EvidenceKind.NONE, Reason.ASIDE)
    if reduced.is_spent:
        return made(Kind.UNDECIDED, EvidenceKind.NONE, Reason.TOO_LARGE)
    stopped = min(back.gone, ahead.gone) > 0.0
    reason = Reason.STOPPED if stopped else Reason.NO_ORDER
    return made(Kind.UNDECIDED, EvidenceKind.NONE, reason)


def _gone(
    reduced: Reduced, motion: FloatArray, sign: float, unit: FloatArray, floor: float
) -> tuple[Walk, Ending]:
    """How far a motion was followed one way, and why not farther."""
    felt, stop = reduced.felt, Ending.NOT_ZERO
    if motion.size <= _MOST_COORDINATES:
        path = follow(felt.held, motion, motion.size - felt.many, _WISHES)
        arrived = path.stop.ending in (Ending.LENGTH, Ending.CLOSED)
        if arrived or not (felt.many > 1 or floor):
            return Walk(path.length, path.residual, arrived), path.stop.ending
        stop = path.stop.ending
    found = walk(reduced, unit, sign, floor)
    return found, Ending.LENGTH if found.arrived else stop
