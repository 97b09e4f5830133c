# SPDX-License-Identifier: BSD-3-Clause
"""The dimension of the positions without strain, measured near the reference.

From random shares of the motions steps lead back to positions without strain, and from places a
little off these again. How many directions of those are independent is the dimension.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from ..analysis.limits import TRUE
from ..core.arrays import FloatArray
from .extent import EvidenceKind, Extent, Fit, Kind, Reason
from .follow import Ending, Wishes, follow
from .reduced import Here, Reduced, across

#: Where several motions begin there may be several ways: the steps begin at so many further
#: places, so far beside the motion, and end no farther beside it than that.
_STARTS, _BESIDE, _ASIDE = 6, 0.1, 0.3
#: A strain that is rounding.
_ROUNDING = 1.0e-15


def least_along(reduced: Reduced, unit: FloatArray, share: float) -> Here | None:
    """The least strain after a motion has gone by a share, of the positions across it.

    Args:
        reduced: What is left of D(x) = 0.
        unit: (N,) the motion, of norm one.
        share: How far, of one sign.

    Returns:
        None where the least is met along other motions.
    """
    base = across(unit[:, None])
    starts = [share * unit]
    if base.shape[1]:
        random = np.random.default_rng(unit.size)
        off = base @ random.standard_normal((base.shape[1], _STARTS))
        off *= _BESIDE * share / np.linalg.norm(off, axis=0)
        starts += list((starts[0][:, None] + off).T)
    best: Here | None = None
    for start in starts:
        found = reduced.least(start, base, _ASIDE * abs(share))
        if found is None or beside(found, unit, share) > _ASIDE:
            continue
        if best is None or found.strain < best.strain:
            best = found
        if best.strain <= _ROUNDING:
            break
    return best


def beside(here: Here, unit: FloatArray, share: float) -> float:
    """How far other motions have gone, as a part of a share of this one."""
    return float(np.linalg.norm(here.shares - share * unit)) / abs(share)


#: How far along the motion the least strain is measured, in parts of the size.
_SHARES = 0.3 * 10.0 ** (-0.2 * np.arange(20))
#: Strains below this are too near to rounding to be fitted.
_LEAST = 1.0e-14
#: So many powers of ten of the share are fitted, from the smallest on, and so many are needed.
_MOST_DECADES, _LEAST_DECADES = 2.0, 1.0
_LEAST_POINTS = 5
#: An order is taken for whole within this, where the fit leaves no more than this.
_WHOLE, _SPREAD = 0.06, 0.03


def measured(
    reduced: Reduced, unit: FloatArray, sign: float, floor: float
) -> tuple[Fit | None, bool]:
    """The order of the least strains along a motion, where they are above rounding.

    Args:
        reduced: What is left of D(x) = 0.
        unit: (N,) the motion, of norm one.
        sign: 1 or -1.
        floor: What the rounding of the geometry strains for each unit of the share.

    Returns:
        A whole number within the fit, None where there is none; and whether somewhere the least
        is met along other motions.
    """
    found = [(share, least_along(reduced, unit, sign * share)) for share in _SHARES.tolist()]
    told = [
        (share, here.strain)
        for share, here in found
        if here is not None and here.strain >= max(_LEAST, 30.0 * floor * share)
    ]
    share, strain = np.array(told).reshape(-1, 2).T
    return _fitted(share, strain), any(here is None for _, here in found)


def _fitted(share: FloatArray, strain: FloatArray) -> Fit | None:
    if share.size < _LEAST_POINTS:
        return None
    chosen = share <= share.min() * 10.0**_MOST_DECADES * 1.001
    share, strain = share[chosen], strain[chosen]
    if np.log10(share.max() / share.min()) < _LEAST_DECADES - 1.0e-9:
        return None
    # Terms of the next orders bend the line at its upper end.
    design = np.stack([np.ones(share.size), np.log(share), share, share**2], axis=1)
    columns = 4 if share.size >= 7 else 3
    solution = np.linalg.lstsq(design[:, :columns], np.log(strain), rcond=None)[0]
    left = np.log(strain) - design[:, :columns] @ solution
    spread = float(np.sqrt(np.mean(left**2)))
    order = float(solution[1])
    is_whole = abs(order - round(order)) <= _WHOLE and round(order) >= 2
    if not is_whole or spread > _SPREAD:
        return None
    return Fit(order, spread, float(np.log10(strain.max() / strain.min())))


#: How far a path is followed, in parts of the size, and in how large steps.
GOAL, _STEP, _LEAST_STEP = 0.1, 0.02, 2.0e-4
#: Corrections of a step may be this part of it.
_FARTHEST = 0.5
#: Where a motion has gone so far, others that it takes along have gone this part of it at most.
_NEAR, _WALKING_BESIDE = 1.0e-4, 0.05
#: What may be left is this multiple of what rounding of the geometry explains.
_ROUNDED = 10.0


#: How far a path was followed one way: the length of the path of the node that moves farthest, in
#: parts of the size; the largest strain on it; and whether it went as far as it was to go, or came
#: back to where it began.
Walk = tuple[float, float, bool]


def walk(reduced: Reduced, unit: FloatArray, sign: float, floor: float) -> Walk:
    """Follow a motion one way.

    Args:
        reduced: What is left of D(x) = 0.
        unit: (N,) the motion, of norm one.
        sign: 1 or -1.
        floor: What the rounding of the geometry strains for each unit of the way.
    """
    if unit.size > 1:
        # Whether there is a path near, on which other motions fall behind.
        begun = least_along(reduced, unit, sign * _NEAR)
        limit = TRUE / 100.0 + _ROUNDED * floor * _NEAR
        if begun is None or begun.strain > limit:
            return 0.0, 0.0, False
        if beside(begun, unit, sign * _NEAR) > _WALKING_BESIDE:
            return 0.0, 0.0, False
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
        gone += reduced.felt.held.reach(there.change - here.change)
        worst = max(worst, there.strain)
        ahead = (there.shares - here.shares) / _norm(there.shares - here.shares)
        here, step = there, min(2.0 * step, _STEP)
    return gone, worst, gone >= GOAL


def _norm(vector: FloatArray) -> float:
    return float(np.linalg.norm(vector))


#: How far off, from the reference, farther, and from the positions that were found.
_OFF, _FAR, _PATHS_NEAR = 0.03, 0.1, 5.0e-4
#: A position has not come back to the reference where this part of that is left.
_AWAY = 0.15
#: Where all paths begin with one motion, how far off, too.
_NEARER = (0.01, 0.003)
#: How far other motions may have gone beside those that are given, as a part of them.
_OTHERS_BESIDE = 0.3
#: Strains up to here are rounding.
_ROUNDED_STRAIN = 1.0e-14
#: Directions are independent where a singular value is above the second part of the largest.
_DEPENDENT, _INDEPENDENT = 0.03, 0.2
#: About so many positions it is measured; in components of more motions nowhere.
_MOST_LOOKED_AT = 8
MOST_MOTIONS = 12


def is_without_strain(reduced: Reduced, cone: FloatArray) -> bool:
    """Whether random motions of a cone (N, k) lead to positions without strain, others added.

    Then all do, as the least strain is an analytic function or the root of one.
    """
    random, base = np.random.default_rng(cone.shape[0]), across(cone)
    for share in (_OFF, _FAR, _FAR):
        unit = cone @ random.standard_normal(cone.shape[1])
        start = share * unit / np.linalg.norm(unit)
        found = reduced.least(start, base, share)
        if found is None or found.strain > TRUE / 10.0:
            return False
        if _norm(found.shares - start) > _OTHERS_BESIDE * share:
            return False
    return True


def positions_near(
    reduced: Reduced, cone: FloatArray, also: list[FloatArray]
) -> tuple[int | None, list[FloatArray]]:
    """Positions without strain near the reference, and their dimension.

    Args:
        reduced: What is left of D(x) = 0.
        cone: (N, k) orthonormal, in which all paths begin.
        also: (N,) unit vectors of motions to begin with, besides random ones.

    Returns:
        The dimension, None where it is open, and directions from the reference, (N,), of positions
        about which it is one.
    """
    many, width = cone.shape
    if width == 1:
        # All paths begin with one motion: whether there is one, to one side at least.
        unit = cone[:, 0]
        for sign in (1.0, -1.0):
            every = [least_along(reduced, unit, sign * share) for share in _NEARER]
            if all(found is not None and found.strain <= _ROUNDED_STRAIN for found in every):
                return 1, [unit]
        fits = [measured(reduced, unit, sign, 0.0)[0] for sign in (1.0, -1.0)]
        return None if None in fits else 0, []
    random = np.random.default_rng(width)
    starts = [sign * each for each in also for sign in (1.0, -1.0)]
    starts += [cone @ each for each in random.standard_normal((2 * width + 4, width))]
    dimension = looked_at = unclear = 0
    lines: list[FloatArray] = []
    for start in starts:
        found = reduced.least(_OFF * start / np.linalg.norm(start), np.eye(many), _OFF)
        far = np.inf if found is None else _norm(found.shares) / _OFF
        if found is None or found.strain > _ROUNDED_STRAIN or far <= _AWAY:
            continue
        if looked_at == _MOST_LOOKED_AT:
            break
        looked_at += 1
        here = _dimension_at(reduced, found, random)
        # No more can be about it than paths begin with.
        here = None if here is not None and here > width else here
        unclear += here is None
        dimension = max(dimension, here or 0)
        if here == 1:
            lines.append(_refined(reduced, found.shares))
        if dimension == width:
            return width, lines
    # Where some are found, others that are not say nothing; where none is, that proves nothing.
    is_clear = not reduced.is_spent and dimension > 0 and 2 * unclear <= looked_at
    return dimension if is_clear else None, lines


def _refined(reduced: Reduced, gone: FloatArray) -> FloatArray:
    """(N,) the direction in which a path begins that has gone somewhere, of unit norm."""
    for share in (0.1, 0.1, 0.1):
        start, most = share * gone, _OTHERS_BESIDE * _norm(share * gone)
        found = reduced.least(start, np.eye(gone.size), most)
        if found is None or _norm(found.shares - start) > most:
            break
        gone = found.shares
    return np.asarray(gone / np.linalg.norm(gone))


def _dimension_at(reduced: Reduced, here: Here, random: np.random.Generator) -> int | None:
    """The dimension about a position without strain."""
    many = here.shares.size
    ways = []
    for _ in range(many + 2):
        off = random.standard_normal(many)
        off *= _PATHS_NEAR / np.linalg.norm(off)
        found = reduced.least(here.shares + off, np.eye(many), _PATHS_NEAR)
        if found is None or found.strain > _ROUNDED_STRAIN:
            return None
        ways.append((found.shares - here.shares) / _PATHS_NEAR)
    values = np.linalg.svd(np.array(ways), compute_uv=False)
    values = values / max(values[0], _INDEPENDENT)
    if np.any((values > _DEPENDENT) & (values < _INDEPENDENT)):
        return None
    return int(np.count_nonzero(values >= _INDEPENDENT))


#: Components of more coordinates are followed about the reference alone.
_MOST_COORDINATES = 120
_WISHES = Wishes(length=GOAL, steps=500, through=True, branches=False)


def by_path(reduced: Reduced, unit: FloatArray, floor: float) -> Extent:
    """Follow a motion both ways; where it stops, fit the order of the least strain.

    Args:
        reduced: What is left of D(x) = 0.
        unit: (N,) the motion, of norm one.
        floor: What the rounding of the geometry strains for each unit of the way.
    """
    felt = reduced.felt
    held, motion = felt.held, felt.motions @ unit
    ways = [_gone(reduced, sign * motion, sign, unit, floor) for sign in (-1.0, 1.0)]
    ((back, strain_back, is_back), why_back), ((ahead, strain_ahead, is_ahead), why_ahead) = ways
    made = partial(
        Extent,
        size=held.size,
        reach=(back * held.size, ahead * held.size),
        stops=(why_back, why_ahead),
        residual=max(strain_back, strain_ahead),
    )
    if is_back and is_ahead:
        return made(Kind.FINITE, EvidenceKind.FOLLOWED, "path")
    if is_back or is_ahead:
        return made(Kind.UNDECIDED, EvidenceKind.NONE, "one way")
    found = [measured(reduced, unit, sign, floor) for sign in (-1.0, 1.0)]
    fits = [fit for fit, _ in found if fit is not None]
    if len(fits) == 2 and round(fits[0].order) == round(fits[1].order):
        fit = max(fits, key=lambda each: each.spread)
        return made(Kind.INFINITESIMAL, EvidenceKind.FITTED, "order", fit=fit)
    if felt.many > 1 and any(aside for _, aside in found):
        return made(Kind.UNDECIDED, EvidenceKind.NONE, "aside")
    if reduced.is_spent:
        return made(Kind.UNDECIDED, EvidenceKind.NONE, "too large")
    reason: Reason = "stopped" if min(back, ahead) > 0.0 else "no order"
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
            return (path.length, path.residual, arrived), path.stop.ending
        stop = path.stop.ending
    found = walk(reduced, unit, sign, floor)
    return found, Ending.LENGTH if found[2] else stop
