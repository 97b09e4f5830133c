# SPDX-License-Identifier: BSD-3-Clause
"""Whether a motion goes on, as its path or its least strain says."""

from __future__ import annotations

from functools import partial

from ...core.arrays import FloatArray
from ..following.follow import Wishes, follow
from .extent import EvidenceKind, Extent, Kind, Reason
from .orders import fit_of, measured
from .reduced import Reduced
from .walking import GOAL, Walk, walk

_WISHES = Wishes(length=GOAL, steps=200, through=True)


def by_path(reduced: Reduced, unit: FloatArray, floor: float) -> Extent:
    """Follow a motion both ways; where it stops, fit the order of the least strain.

    Args:
        reduced: What is left of D(x) = 0.
        unit: (N,) the motion, of norm one.
        floor: What the rounding of the geometry strains for each unit of the way.
    """
    felt = reduced.felt
    held, motion = felt.held, felt.motions @ unit
    rank = motion.size - felt.many
    paths = [follow(held, sign * motion, rank, _WISHES) for sign in (-1.0, 1.0)]
    walks = [Walk(path.length, path.residual) for path in paths]
    if felt.many > 1 or floor:
        walks = [
            one if one.arrived else walk(reduced, unit, sign, floor)
            for one, sign in zip(walks, (-1.0, 1.0), strict=True)
        ]
    back, ahead = walks
    made = partial(
        Extent,
        size=held.size,
        reach=(back.gone * held.size, ahead.gone * held.size),
        stops=(paths[0].stop.ending, paths[1].stop.ending),
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
    if any(each.aside for each in found):
        return made(Kind.UNDECIDED, EvidenceKind.NONE, Reason.ASIDE)
    stopped = min(back.gone, ahead.gone) > 0.0
    reason = Reason.STOPPED if stopped else Reason.NO_ORDER
    return made(Kind.UNDECIDED, EvidenceKind.NONE, reason)
