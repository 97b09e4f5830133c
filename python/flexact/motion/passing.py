# SPDX-License-Identifier: BSD-3-Clause
"""Where between two stations a function passes zero, or touches it.

Near a branch of the path, rounding over the smallest singular value spoils what is computed. So
the zero is bracketed by bisection, and then found, with the place there, by the polynomial
through points on both sides that are not near.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from ..model.configuration import Configuration
from .chart import Chart, Near
from .station import Between, arc_between

#: Halvings, and the points on both sides, as shares of the way from one station to the other.
_HALVINGS = 9
_POINTS = 0.02 * np.array([-3.0, -2.0, -1.0, 1.0, 2.0, 3.0])
#: Golden sections before a touch is refined.
_SECTIONS = 12
_GOLDEN = (5.0**0.5 - 1.0) / 2.0
#: Scaled singular values up to here are left alone when the place is put on the path.
_SMALL = 1.0e-5

Function = Callable[[Near], float]


class Passing(NamedTuple):
    """A place between two stations."""

    share: float
    arc: float
    where: Configuration
    tangent: FloatArray
    """(n,) along the path, of norm 1."""


def passing(way: Between, function: Function) -> Passing | None:
    """Where a function of the place passes zero on the way; None where it cannot be found."""
    low, high = 0.0, 1.0
    first, last = way.near(low), way.near(high)
    if first is None or last is None:
        return None
    sign = np.sign(function(first))
    if sign == np.sign(function(last)):
        return None
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        near = way.near(middle)
        value = 0.0 if near is None else function(near)
        if value == 0.0:
            low = high = middle
            break
        low, high = (middle, high) if np.sign(value) == sign else (low, middle)
    return _refined(way, function, 0.5 * (low + high), is_touching=False)


def touching(way: Between, function: Function, low: float) -> Passing | None:
    """Where a function is least between a share `low` and 1; None where it cannot be found.

    By golden section, and then by the polynomial through the squares of its values: of singular
    values that pass zero together these are smooth.
    """
    first, last = low, 1.0
    for _ in range(_SECTIONS):
        inner = first + (1.0 - _GOLDEN) * (last - first), first + _GOLDEN * (last - first)
        places = [way.near(share) for share in inner]
        values = [np.inf if near is None else abs(function(near)) for near in places]
        first, last = (first, inner[1]) if values[0] <= values[1] else (inner[0], last)
    return _refined(way, lambda near: function(near) ** 2, 0.5 * (first + last), is_touching=True)


def _refined(
    way: Between, function: Function, about: float, *, is_touching: bool
) -> Passing | None:
    shares = about + _POINTS
    places = [way.near(share) for share in shares.tolist()]
    known = [near for near in places if near is not None]
    if len(known) < len(places):
        return None
    values = np.array([function(near) for near in known])
    share = _root(_POINTS, values, is_touching)
    if share is None:
        return None
    weights = _lagrange(_POINTS, share)
    changes = [way.change_to(s, near) for s, near in zip(shares.tolist(), known, strict=True)]
    change = np.asarray(weights @ np.array(changes))
    where = way.held.at(way.chart.middle, change).configuration
    tangents = np.array([way.direction(near) for near in known])
    tangent = weights @ tangents
    rank = int(np.count_nonzero(way.held.values(where) > _SMALL))
    near = Chart(way.held, where, rank).near(np.zeros(change.size))
    if near is not None:
        where = near.place.configuration
    tangent = tangent / np.linalg.norm(tangent)
    arc = way.one.arc + arc_between(way.held, way.one, where, tangent)
    if about + share < 0.0:
        arc = 2.0 * way.one.arc - arc
    return Passing(about + share, arc, where, tangent)


def _root(points: FloatArray, values: FloatArray, of_slope: bool) -> float | None:
    """The zero, near 0, of the polynomial through values at some points; None without any."""
    fit = np.polynomial.Polynomial.fit(points, values, points.size - 1)
    if of_slope:
        fit = fit.deriv()
    slope, at = fit.deriv(), 0.0
    for _ in range(30):
        steep = float(slope(at))
        if steep == 0.0:
            return None
        step = float(fit(at)) / steep
        at -= step
        if abs(step) <= 1.0e-16:
            break
    return at if abs(at) <= abs(float(points[0])) else None


def _lagrange(points: FloatArray, at: float) -> FloatArray:
    """The weights of values at some points in the polynomial's value at a place."""
    apart = points[:, None] - points
    np.fill_diagonal(apart, 1.0)
    to = at - points
    rest = np.array([np.prod(np.delete(to, k)) for k in range(points.size)])
    return np.asarray(rest / apart.prod(axis=1))
