# SPDX-License-Identifier: BSD-3-Clause
"""The least strain of the positions that a motion leads towards, other motions added to it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from ...model.configuration import Configuration
from ..following.least import across, descend
from .felt import Felt

#: Where several motions begin there may be several ways: the steps begin at so many further
#: places, so far beside the motion, and end no farther beside it than that.
_STARTS, _BESIDE, _ASIDE = 6, 0.1, 0.3
#: A strain that is rounding.
_ROUNDING = 1.0e-15


class Nearest(NamedTuple):
    """A position with the least strain."""

    place: Configuration
    change: FloatArray
    """(n,) from the reference."""
    strain: float
    """The largest held deformation."""
    beside: float
    """How far other motions have gone, as a part of this one."""


def least_along(felt: Felt, motion: FloatArray, share: float) -> Nearest | None:
    """The least strain after a motion has gone by a share, of the positions across it.

    Args:
        felt: The component.
        motion: (n,) unit vector, in the space of motions.
        share: How far, of one sign.

    Returns:
        None where the least is met along other motions.
    """
    base = across(motion)
    found = _settled(felt, motion, share, share * motion, base)
    best = found if found.beside <= _ASIDE else None
    if felt.many == 1 or (best is not None and best.strain <= _ROUNDING):
        return best
    others = felt.motions - np.outer(motion, motion @ felt.motions)
    random = np.random.default_rng(len(motion))
    for _ in range(_STARTS):
        off = others @ random.standard_normal(felt.many)
        off *= _BESIDE * abs(share) / max(float(np.linalg.norm(off)), _ROUNDING)
        found = _settled(felt, motion, share, share * motion + off, base)
        if found.beside <= _ASIDE and (best is None or found.strain < best.strain):
            best = found
    return best


def _settled(
    felt: Felt, motion: FloatArray, share: float, start: FloatArray, base: FloatArray
) -> Nearest:
    place, correction = descend(felt.held, felt.held.reference, start, base)
    change = start + correction
    beside = np.linalg.norm(felt.within(change) - share * felt.within(motion)) / abs(share)
    return Nearest(place.configuration, change, place.residual, float(beside))
