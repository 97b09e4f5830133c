# SPDX-License-Identifier: BSD-3-Clause
"""The least strain of the positions that a motion leads towards, other motions added to it."""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray
from .extents_reduced import Here, Reduced, across

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
