# SPDX-License-Identifier: BSD-3-Clause
"""Where other paths branch off: D(c) loses rank between two stations of a path."""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray
from ..model.configuration import Configuration
from .chart import Chart
from .constraints import Held
from .passing import passing, touching
from .station import Between, Station, station_at

#: At a branch singular values up to here are zero: its place is known to about as many digits.
_ZERO_AT_BRANCH = 1.0e-7
#: A singular value may touch zero if it is no more than so many times what it falls in a step.
_MAY_REACH = 1.5


def sign_between(one: Chart, other: Chart) -> float:
    """-1 where a singular value passes zero between two charts, with its left or right vector.

    U' D V of one chart is regular at its middle; its determinant at the other's has the sign of
    the products below, since U' D V = (U' U2) S2 (V2' V).
    """
    if one.right.shape[1] != other.right.shape[1]:
        return 1.0
    left = np.linalg.slogdet(one.left.T @ other.left)[0]
    right = np.linalg.slogdet(one.right.T @ other.right)[0]
    return float(left * right) or 1.0


class Signed:
    """The smallest singular value that is not zero near a configuration, with a sign."""

    def __init__(self, held: Held, middle: Configuration, rank: int) -> None:
        """Take the sign there as positive."""
        self.held, self.rank = held, rank
        self.chart = Chart(held, middle, rank)

    def __call__(self, where: Configuration) -> float:
        """The value at a configuration."""
        if not self.rank:
            return 0.0
        jacobian = self.held.at(where).jacobian
        sign = np.linalg.slogdet(self.chart.left.T @ jacobian @ self.chart.right)[0]
        return float(sign * self.held.values(where)[self.rank - 1])


def branch_between(held: Held, one: Station, other: Station, zero: float) -> Station | None:
    """The station between two at which other paths branch off; None without any."""
    if other.rank < one.rank:
        return other
    if one.rank != other.rank or one.signed * other.signed >= 0.0:
        return None
    way = Between(held, one, other)
    signed = Signed(held, way.base.within, way.base.rank)
    found = passing(way, lambda near: signed(near.place.configuration))
    if found is None:
        return None
    return station_there(held, found.where, found.arc, found.tangent, zero)


def branch_about(
    held: Held, one: Station, middle: Station, other: Station, zero: float
) -> Station | None:
    """The station near the middle one of three at which singular values touch zero.

    So they do where two pass it together: the sign stays.
    """
    if not one.rank == middle.rank == other.rank or one.signed * other.signed <= 0.0:
        return None
    values = np.abs([one.signed, middle.signed, other.signed])
    falls = max(values[0], values[2]) - values[1]
    if values[1] > min(values[0], values[2]) or values[1] > _MAY_REACH * falls:
        return None
    way = Between(held, middle, other)
    signed = Signed(held, middle.within, middle.rank)
    low = -(middle.arc - one.arc) / (other.arc - middle.arc)
    found = touching(way, lambda near: signed(near.place.configuration), low)
    if found is None:
        return None
    made = station_there(held, found.where, found.arc, found.tangent, zero)
    return made if made.rank < middle.rank else None


def station_there(
    held: Held, where: Configuration, arc: float, along: FloatArray, zero: float
) -> Station:
    """The station at a singular place that was found between two others."""
    values = held.values(where)
    rank = int(np.count_nonzero(values > max(zero, _ZERO_AT_BRANCH)))
    residual = held.at(where).residual
    return station_at(held, where, rank, along, arc, residual, 0.0, values)
