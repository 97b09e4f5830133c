# SPDX-License-Identifier: BSD-3-Clause
"""Richardson's extrapolation from n and 2 n beams: a value with its uncertainty."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray
from ..util.errors import FlexactError
from ..util.quantities import larger_in_words
from ..util.records import Frozen
from ..util.units import METRES, Units


class ElasticError(FlexactError, ValueError):
    """What is asked has no answer; the text says why, and what to do."""


def require_within(
    value: float, size: float, is_turn: bool, what: str, units: Units = METRES
) -> None:
    """Raise where a stroke or an error is larger than the model: a slip of the unit.

    Args:
        value: From where the model rests [m, rad].
        size: Of the model [m].
        is_turn: Whether it is an angle.
        what: Such as "the stroke of z of node 1".
        units: In which it is said.

    Raises:
        ElasticError: the length is larger than the size, or the angle than half a turn.
    """
    if abs(value) <= (math.pi if is_turn else size):
        return
    unit, example = ("rad", "1mrad") if is_turn else (units.symbol("m"), "3mm")
    most = "half a turn" if is_turn else f"the whole model, {units.shown(size, 'm'):.3g} {unit}"
    told = f"{units.shown(abs(value), 'rad' if is_turn else 'm'):.6g} {unit}"
    raise ElasticError(larger_in_words(what, told, most, example))


class UnknownError(ElasticError, LookupError):
    """A node, element, deformation or coordinate that is not there; the text says what is."""


class StrokeWarning(UserWarning):
    """A stroke that is surely meant from where the coordinate rests, and is not given so."""


class StrokeError(ElasticError):
    """A state that could not be reached.

    Attributes:
        reached: What was reached of what was asked for: the value of a driven coordinate, of a
            load the factor, of an error its value, in the units in which it was given.
        place: The node or element where it stopped, in words; empty where it is not known.
    """

    def __init__(self, message: str, reached: float, place: str = "", unit: str = "") -> None:
        """Keep the text, and how far it went in an SI unit."""
        super().__init__(message)
        self.reached = reached
        self.place = place
        self.unit = unit

    def shown(self, units: Units) -> StrokeError:
        """The same with what was reached in other units."""
        return StrokeError(str(self), units.shown(self.reached, self.unit), self.place)

    def __reduce__(self) -> tuple[type[StrokeError], tuple[str, float, str, str]]:
        """What makes it anew, as a worker of a sweep does."""
        return type(self), (str(self), self.reached, self.place, self.unit)


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
    def of(cls, coarse: ArrayLike, fine: ArrayLike | None = None) -> Estimate:
        """From a quantity with n and with 2 n beams; what is infinite in one is that of the finer.

        Without the finer one it is that of a fixed number of beams.

        Raises:
            ValueError: the shapes differ.
        """
        if fine is None:
            return cls.fixed(coarse)
        one, two = np.asarray(coarse, np.float64), np.asarray(fine, np.float64)
        if one.shape != two.shape:
            raise ValueError(f"the quantity has shapes {one.shape} and {two.shape}")
        both = np.isfinite(one) & np.isfinite(two)
        step = np.where(both, np.where(both, two, 0.0) - np.where(both, one, 0.0), 0.0) / 3.0
        return cls(two + step, np.where(np.isfinite(two) & ~both, np.inf, SAFETY * np.abs(step)))

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
