# SPDX-License-Identifier: BSD-3-Clause
"""The dimension of the positions without strain, measured near the reference.

From random shares of the motions steps lead back to positions without strain, and from places a
little off these again. How many directions of those are independent is the dimension.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from .extents_reduced import Here, Reduced, across
from .follow import TRUE
from .least import least_along
from .orders import fit_of, measured

#: How far off, from the reference, farther, and from the positions that were found.
_OFF, _FAR, _NEAR = 0.03, 0.1, 5.0e-4
#: A position has not come back to the reference where this part of that is left.
_AWAY = 0.15
#: Where all paths begin with one motion, how far off, too.
_NEARER = (0.01, 0.003)
#: How far other motions may have gone beside those that are given, as a part of them.
_BESIDE = 0.3
#: Strains up to here are rounding.
_ROUNDING = 1.0e-14
#: Directions are independent where a singular value is above the second part of the largest.
_DEPENDENT, _INDEPENDENT = 0.03, 0.2
#: About so many positions it is measured; in components of more motions nowhere.
_MOST_LOOKED_AT = 8
MOST_MOTIONS = 12


class Near(NamedTuple):
    """Positions without strain near the reference."""

    dimension: int | None
    """None where it is open."""
    lines: tuple[FloatArray, ...]
    """Directions from the reference, (N,), of positions about which it is one."""


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
        if _norm(found.shares - start) > _BESIDE * share:
            return False
    return True


def positions_near(reduced: Reduced, cone: FloatArray, also: list[FloatArray]) -> Near:
    """Positions without strain near the reference, and their dimension.

    Args:
        reduced: What is left of D(x) = 0.
        cone: (N, k) orthonormal, in which all paths begin.
        also: (N,) unit vectors of motions to begin with, besides random ones.
    """
    many, width = cone.shape
    if width == 1:
        return _along(reduced, cone[:, 0])
    random = np.random.default_rng(width)
    starts = [sign * each for each in also for sign in (1.0, -1.0)]
    starts += [cone @ each for each in random.standard_normal((2 * width + 4, width))]
    dimension = looked_at = unclear = 0
    lines: list[FloatArray] = []
    for start in starts:
        found = reduced.least(_OFF * start / np.linalg.norm(start), np.eye(many), _OFF)
        far = np.inf if found is None else _norm(found.shares) / _OFF
        if found is None or found.strain > _ROUNDING or far <= _AWAY:
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
            return Near(width, tuple(lines))
    # Where some are found, others that are not say nothing; where none is, that proves nothing.
    is_clear = not reduced.is_spent and dimension > 0 and 2 * unclear <= looked_at
    return Near(dimension if is_clear else None, tuple(lines))


def _along(reduced: Reduced, unit: FloatArray) -> Near:
    """Where all paths begin with one motion: whether there is one, to one side at least."""
    for sign in (1.0, -1.0):
        every = [least_along(reduced, unit, sign * share) for share in _NEARER]
        if all(found is not None and found.strain <= _ROUNDING for found in every):
            return Near(1, (unit,))
    fits = [fit_of(measured(reduced, unit, sign, 0.0)) for sign in (1.0, -1.0)]
    return Near(None if None in fits else 0, ())


def _refined(reduced: Reduced, gone: FloatArray) -> FloatArray:
    """(N,) the direction in which a path begins that has gone somewhere, of unit norm."""
    for share in (0.1, 0.1, 0.1):
        found = reduced.least(share * gone, np.eye(gone.size), _BESIDE * _norm(share * gone))
        if found is None or _norm(found.shares - share * gone) > _BESIDE * _norm(share * gone):
            break
        gone = found.shares
    return np.asarray(gone / np.linalg.norm(gone))


def _dimension_at(reduced: Reduced, here: Here, random: np.random.Generator) -> int | None:
    """The dimension about a position without strain."""
    many = here.shares.size
    ways = []
    for _ in range(many + 2):
        off = random.standard_normal(many)
        off *= _NEAR / np.linalg.norm(off)
        found = reduced.least(here.shares + off, np.eye(many), _NEAR)
        if found is None or found.strain > _ROUNDING:
            return None
        ways.append((found.shares - here.shares) / _NEAR)
    values = np.linalg.svd(np.array(ways), compute_uv=False)
    values = values / max(values[0], _INDEPENDENT)
    if np.any((values > _DEPENDENT) & (values < _INDEPENDENT)):
        return None
    return int(np.count_nonzero(values >= _INDEPENDENT))


def _norm(vector: FloatArray) -> float:
    return float(np.linalg.norm(vector))
