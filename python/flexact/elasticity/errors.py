# SPDX-License-Identifier: BSD-3-Clause
"""Richardson's extrapolation from n and 2 n beams: a value with its uncertainty."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray
from ..util.records import Frozen

#: The uncertainty of an extrapolated value, as a part of what the extrapolation adds to the finer
#: one; docs/stiffness.md says what was measured.
SAFETY = 1.0


@dataclass(frozen=True, eq=False)
class Estimate(Frozen):
    """A value with its uncertainty.

    The error of the elements falls as 1/n^2, so that with n and 2 n beams (4 X_2n - X_n)/3 is
    left with one of higher order.

    Attributes:
        value: The value, a number or an array.
        uncertainty: How far off it may be for want of more beams, of the same shape; 0 where
            the number of beams is fixed: then nothing is known of it.
        is_extrapolated: Whether the value comes from two numbers of beams.
    """

    value: FloatArray
    uncertainty: FloatArray
    is_extrapolated: bool = True

    @classmethod
    def of(cls, coarse: ArrayLike, fine: ArrayLike) -> Estimate:
        """From a quantity with n and with 2 n beams; what is infinite in one is that of the finer.

        Raises:
            ValueError: the shapes differ.
        """
        one, two = np.asarray(coarse, np.float64), np.asarray(fine, np.float64)
        if one.shape != two.shape:
            raise ValueError(f"the quantity has shapes {one.shape} and {two.shape}")
        both = np.isfinite(one) & np.isfinite(two)
        step = np.where(both, np.where(both, two, 0.0) - np.where(both, one, 0.0), 0.0) / 3.0
        unknown = np.where(np.isfinite(two) & ~both, np.inf, SAFETY * np.abs(step))
        return cls(two + step, unknown)

    @classmethod
    def fixed(cls, value: ArrayLike) -> Estimate:
        """Of a fixed number of beams."""
        made = np.asarray(value, np.float64)
        return cls(made, np.zeros_like(made), False)

    def __float__(self) -> float:
        """The value, of a single number."""
        return float(self.value)

    def __str__(self) -> str:
        """Such as "9.9154 +- 0.0002"."""
        if self.value.ndim:
            return f"{self.value} +- {self.uncertainty}"
        return f"{self.value:.6g} +- {self.uncertainty:.1g}"


def matched_by_sign(coarse: FloatArray, fine: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Multipliers of both signs of two meshes, each with its like: by their order from zero."""
    pairs = []
    for sign in (-1.0, 1.0):
        one, two = (np.sort(sign * each[sign * each > 0.0]) for each in (coarse, fine))
        count = min(one.size, two.size)
        pairs.append((sign * one[:count], sign * two[:count]))
    made = np.concatenate([two for _, two in pairs])
    order = np.argsort(made)
    return np.concatenate([one for one, _ in pairs])[order], made[order]


def matched_by_order(coarse: FloatArray, fine: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Ascending eigenvalues of two meshes, each with its like: by their order."""
    count = min(coarse.size, fine.size)
    return coarse[:count], fine[:count]
