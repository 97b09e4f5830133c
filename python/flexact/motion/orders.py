# SPDX-License-Identifier: BSD-3-Clause
"""The order to which the least strain along a motion grows, fitted over powers of ten."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from .extent import Fit
from .extents_reduced import Reduced
from .least import least_along

#: How far along the motion the least strain is measured, in parts of the size.
_SHARES = 0.3 * 10.0 ** (-0.2 * np.arange(20))
#: Strains below this are too near to rounding to be fitted.
_LEAST = 1.0e-14
#: So many powers of ten of the share are fitted, from the smallest on, and so many are needed.
_MOST_DECADES, _LEAST_DECADES = 2.0, 1.0
_LEAST_POINTS = 5
#: An order is taken for whole within this, where the fit leaves no more than this.
_WHOLE, _SPREAD = 0.06, 0.03


class Measured(NamedTuple):
    """The least strains along a motion one way."""

    share: FloatArray
    strain: FloatArray
    aside: bool
    """Whether somewhere the least is met along other motions."""


def measured(reduced: Reduced, unit: FloatArray, sign: float, floor: float) -> Measured:
    """The least strains along a motion, where they are above rounding.

    Args:
        reduced: What is left of D(x) = 0.
        unit: (N,) the motion, of norm one.
        sign: 1 or -1.
        floor: What the rounding of the geometry strains for each unit of the share.
    """
    aside = False
    shares, strains = [], []
    for share in _SHARES.tolist():
        found = least_along(reduced, unit, sign * share)
        if found is None:
            aside = True
            continue
        if found.strain < max(_LEAST, 30.0 * floor * share):
            continue
        shares.append(share)
        strains.append(found.strain)
    return Measured(np.array(shares), np.array(strains), aside)


def fit_of(found: Measured) -> Fit | None:
    """The order, a whole number within the fit; None where there is none."""
    if found.share.size < _LEAST_POINTS:
        return None
    chosen = found.share <= found.share.min() * 10.0**_MOST_DECADES * 1.001
    share, strain = found.share[chosen], found.strain[chosen]
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
