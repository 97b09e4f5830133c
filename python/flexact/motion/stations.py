# SPDX-License-Identifier: BSD-3-Clause
"""The least held deformations near a point: how far a motion is from leading anywhere.

First in a chart, where all equations but the few that rank leaves out are solved for, as a
function of the few coordinates of the null space across the motion: the valleys in which it is
small are curved, and no descent in all coordinates follows them. Then in all coordinates. Both by
Levenberg and Marquardt's method, with corrections across the motion, so that its share stays.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..analysis.limits import ZERO_AT_REFERENCE
from ..core.arrays import FloatArray
from ..model.configuration import Configuration
from ..util.matrices import complement
from ..util.records import Frozen, cached_property
from .bordered import Bordered, Smallest, smallest_of
from .constraints import Held, Place

_MOST_STEPS = 12
#: A correction below this part of the size is rounding, where it no longer gets smaller.
_SETTLED = 1.0e-15
_ROUNDING, _ROUNDING_NEAR = 1.0e-11, 2.0e-14
#: Corrections have to get smaller by this.
_SHRINKS = 0.6
#: The factors of a large matrix are kept while corrections get smaller by this, and with those
#: there may be more steps by this factor.
_KEEPS, _OF_KEPT = 0.02, 3


@dataclass(eq=False)
class Near:
    """A place near the middle of a chart."""

    place: Place
    across: FloatArray
    """(n,) the change of the coordinates that is not in the null space."""
    factor: Bordered
    """Of the derivatives there, or a little beside."""


class Chart:
    """Coordinates of the configurations near one."""

    def __init__(
        self, middle: Place, rank: int, smallest: Smallest, near: Chart | None = None
    ) -> None:
        """Find the null vectors of D(c) there, of a given rank.

        Args:
            middle: Where it is.
            rank: Of D(c).
            smallest: Singular values of the scaled matrix there.
            near: Of a place that is near.
        """
        self.held, self.middle, self.rank = middle.held, middle, rank
        if not self.held.is_small:
            nulls = middle.unscaled(*smallest.null(rank))
        elif near is not None and near.rank == rank and smallest.is_clear(rank):
            nulls = near.nulls_at(middle)
        else:
            left, _, right = np.linalg.svd(middle.jacobian)
            self.rest, self.null = left[:, rank:], right[rank:].T
            return
        self.rest, self.null = (np.linalg.qr(each)[0] for each in nulls)

    def nulls_at(self, place: Place) -> tuple[FloatArray, FloatArray]:
        """(m, m - rank) and (n, n - rank), what is sent to zero at a place of the same rank."""
        bordered, (m, n) = self.bordered(place), self.held.shape
        rest, null = np.eye(m - self.rank), np.eye(n - self.rank)
        return (
            bordered.solved_transposed(np.zeros((n, m - self.rank)), rest)[0],
            bordered.solved(np.zeros((m, n - self.rank)), null)[0],
        )

    def bordered(self, place: Place) -> Bordered:
        """The derivatives at a place, bordered with the null vectors of the middle."""
        return Bordered(place.matrix, self.rest, self.null)

    @cached_property
    def _sign(self) -> float:
        return self.bordered(self.middle).sign

    def sign(self, place: Place) -> float:
        """-1 where a singular value passes zero between the middle and a place.

        The determinant of the bordered matrix is that of U' D V, U and V across the null vectors,
        but for a sign that stays; at the middle U' D V is regular.
        """
        return self.bordered(place.here).sign * self._sign

    def near(
        self,
        ahead: FloatArray,
        across: FloatArray | None = None,
        factor: Bordered | None = None,
    ) -> Near | None:
        """The place after a change (n,) in the null space; None where Newton finds none.

        Args:
            ahead: The change.
            across: (n,) where it begins, not in the null space.
            factor: Of a place near that.
        """
        nulls, still = (self.rest, self.null), np.zeros(ahead.size)
        if across is not None:
            # What begins near its end has no steps that show how small rounding is.
            limits = _MOST_STEPS, _ROUNDING_NEAR, _SHRINKS
            found = solved(self.middle, ahead, nulls, across, limits, factor)
            if found is not None:
                return found
        return solved(self.middle, ahead, nulls, still, (_MOST_STEPS, _ROUNDING, _SHRINKS))

    def nulls(self, near: Near) -> FloatArray:
        """(n, n - rank) orthonormal null vectors at a place that is near, of the same rank."""
        place, many = near.place.here, self.null.shape[1]
        vectors, still = np.zeros((self.null.shape[0], many)), np.eye(many)
        last = np.inf
        for _ in range(0 if self.held.is_small else _MOST_STEPS):
            change, _ = near.factor.solved(-(place.matrix @ vectors), still - self.null.T @ vectors)
            now = float(np.linalg.norm(change))
            vectors += change
            if now <= _SETTLED * math.sqrt(many) or _SHRINKS * last < now <= _ROUNDING:
                return np.asarray(np.linalg.qr(vectors)[0])
            if not now <= _KEEPS * last:
                break
            last = now
        rows = self.held.shape[0]
        vectors = self.bordered(place).solved(np.zeros((rows, many)), np.eye(many))[0]
        return np.asarray(np.linalg.qr(vectors)[0])


def solved(
    middle: Place,
    ahead: FloatArray,
    nulls: tuple[FloatArray, FloatArray],
    across: FloatArray,
    limits: tuple[int, float, float],
    factor: Bordered | None = None,
) -> Near | None:
    """The place, by Newton's method, at which the held deformations are zero but for a few.

    Args:
        middle: Where it begins.
        ahead: (n,) a change that stays.
        nulls: Orthonormal columns: combinations of the held deformations that are left out, and
            changes to which those that are sought are across.
        across: (n,) with this of those it begins.
        limits: How many steps; up to where a correction that no longer gets smaller is rounding;
            by how much they have to.
        factor: Of a place near where it begins, of a large matrix.

    Returns:
        None where it does not converge.
    """
    (most, rounding, shrinks), last = limits, np.inf
    still, held = np.zeros(nulls[1].shape[1]), middle.held
    for _ in range(most if held.is_small else _OF_KEPT * most):
        place = held.at(middle, ahead + across)
        kept = factor
        try:
            factor = kept or Bordered(place.matrix, *nulls)
            change, _ = factor.solved(place.error, still)
        except np.linalg.LinAlgError:
            return None
        now = math.sqrt(change @ change)
        if kept and now > max(_KEEPS * last, rounding):
            factor = Bordered(place.matrix, *nulls)
            change, _ = factor.solved(place.error, still)
            now, kept = math.sqrt(change @ change), None
        if now <= _SETTLED or shrinks * last < now <= rounding:
            return Near(place, across, factor)
        if not now <= max(shrinks * last, rounding):
            return None
        across, last = across - change, now
        # Small ones are factorised as fast as they are made.
        factor = None if held.is_small else factor
    return None


@dataclass(frozen=True, eq=False)
class Station(Frozen):
    """A configuration of a path.

    Attributes:
        place: Where it is.
        arc: How far it is along the path, in sizes: of the node that moves farthest,
            displacements by the size, rotations in radians.
        tangent: (n,) along the path, displacements by the size, rotations in radians; norm 1.
        rank: How many singular values of the scaled matrix, theory.md (2), are not zero.
        signed: The smallest of these, with a sign that changes where it passes zero.
        smallest: The smallest singular values of that matrix.
    """

    place: Place
    arc: float
    tangent: FloatArray
    rank: int
    signed: float
    smallest: Smallest

    @property
    def within(self) -> Configuration:
        """As `Held` has it, in its unit."""
        return self.place.configuration

    @property
    def residual(self) -> float:
        """The largest held deformation, lengths by the size, angles in radians."""
        return self.place.residual

    @cached_property
    def chart(self) -> Chart:
        """Coordinates of what is near."""
        return Chart(self.place, self.rank, self.smallest)

    @property
    def directions(self) -> int:
        """In how many independent directions it goes on from here, to first order."""
        return self.tangent.size - self.rank


#: From so many known places on a way the next one is foretold.
_OF_NEAREST = 5


class Between:
    """The path between two stations, by the share of the way."""

    def __init__(self, one: Station, other: Station, *, is_regular: bool = False) -> None:
        """Use the chart of the end with the higher rank: there the path is regular.

        Args:
            one: Where it begins.
            other: Where it ends.
            is_regular: Whether nothing between them is singular, so that what is known of some
                places helps to find others.
        """
        self.one, self.other, self.is_regular = one, other, is_regular
        self.is_backward = one.rank < other.rank
        self.base, self.far = (other, one) if self.is_backward else (one, other)
        self.chart, self.held = self.base.chart, one.place.held
        along = self.base.tangent
        way = float(along @ self.held.way(self.base.place.value, self.far.place.value))
        self._way = way * along
        self._known: dict[float, Near | None] = {}
        self._tangents: dict[Near, FloatArray] = {}

    def near(self, share: float) -> Near | None:
        """The place at a share of the way, also a little outside of it."""
        if share not in self._known:
            known = {s: near for s, near in self._known.items() if near is not None}
            # At the middle nothing is across.
            middle = float(self.is_backward)
            known.pop(middle, None)
            nearest = sorted(known, key=lambda each: abs(each - share))[:_OF_NEAREST]
            shares = np.array([middle, *nearest])
            across, factor = None, None
            if nearest and self.is_regular and not self.held.is_small:
                weights = _weights(shares, share)[1:]
                across = weights @ np.array([known[each].across for each in nearest])
                factor = known[nearest[0]].factor
            self._known[share] = self.chart.near(self.ahead(share), across, factor)
        return self._known[share]

    def ahead(self, share: float) -> FloatArray:
        """(n,) the change in the null space, from the chart's middle, at a share of the way."""
        return self._way * (1.0 - share if self.is_backward else share)

    def direction(self, near: Near) -> FloatArray:
        """(n,) the tangent at a place, of norm 1."""
        if near not in self._tangents:
            null = self.chart.nulls(near)
            along = null @ (null.T @ self.base.tangent)
            self._tangents[near] = along / np.linalg.norm(along)
        return self._tangents[near]


def arc_between(here: Station, where: Place, along: FloatArray) -> float:
    """How far the node goes that moves farthest: on arcs of circles over the chords."""
    held = where.held
    chord = np.linalg.norm(held.at_nodes(held.way(here.place.value, where.value)), axis=1)
    before, behind = held.at_nodes(here.tangent), held.at_nodes(along)
    sizes = np.linalg.norm(before, axis=1) * np.linalg.norm(behind, axis=1)
    cosine = np.sum(before * behind, axis=1) / np.where(sizes > 0.0, sizes, 1.0)
    half = 0.5 * np.arccos(np.clip(np.where(sizes > 0.0, cosine, 1.0), 0.0, 1.0))
    return float(np.max(chord / np.sinc(half / np.pi)))


_SETTLE_SETTLED = 1.0e-11
#: Singular values below this part of the largest belong to directions that stay.
_CUT = 1.0e-4
#: The corrections of a step may be this part of the step itself.
_FARTHEST = 0.5


def settle(start: Place, ahead: FloatArray, step: float) -> Place | None:
    """The place after a step, where the held deformations are least; None without any near.

    Args:
        start: Where the step begins.
        ahead: (n,) its direction, of norm one.
        step: Its length.
    """
    held = start.held
    here, went = held.at(start, step * ahead), 0.0
    for _ in range(_MOST_STEPS):
        if not here.is_finite:
            return None
        # Corrections are across the motion, so that its share stays.
        across = here.jacobian - np.outer(here.jacobian @ ahead, ahead)
        back = -_least_squares(across, here.error)
        correction = float(np.linalg.norm(back))
        if correction <= _SETTLE_SETTLED:
            return here
        went += correction
        if went > _FARTHEST * step:
            return None
        here = held.at(here, back).here
    return None


def _least_squares(matrix: FloatArray, values: FloatArray) -> FloatArray:
    """(n,) the shortest with which a matrix (m, n) makes values (m,) best; small ones are zero."""
    if matrix.shape[0] < matrix.shape[1]:
        square = matrix @ matrix.T
        try:
            inverse = np.linalg.inv(square)
        except np.linalg.LinAlgError:
            inverse = np.full((1, 1), np.inf)
        # Then none of its singular values is as small a part of the largest.
        if np.linalg.norm(inverse) * np.linalg.norm(square) < _CUT**-2:
            return np.asarray(matrix.T @ (inverse @ values))
    return np.asarray(np.linalg.lstsq(matrix, values, rcond=_CUT)[0], np.float64)


def onward(here: Place, direction: FloatArray) -> FloatArray:
    """The direction in which it goes on: the last one within the null space."""
    jacobian = here.jacobian
    along = direction - _least_squares(jacobian, jacobian @ direction)
    length = float(np.linalg.norm(along))
    return np.asarray(along / length) if length > _FARTHEST else direction


#: Parts of the way from one station to the other to which places are narrowed down; fewer where
#: nothing is singular; and the points on both sides of one, as shares.
_PARTS, _FEWER_PARTS = 1_000, 50
_POINTS = 0.02 * np.array([-3.0, -2.0, -1.0, 1.0, 2.0, 3.0])
#: Golden sections before a touch is refined.
_SECTIONS = 12
_GOLDEN = (5.0**0.5 - 1.0) / 2.0
#: Scaled singular values up to here are left alone when the place is put on the path.
_SMALL = 1.0e-5

Function = Callable[[Near], float]


class Passing(NamedTuple):
    """A place between two stations."""

    arc: float
    where: Place
    tangent: FloatArray
    """(n,) along the path, of norm 1."""


def passing(way: Between, function: Function) -> Passing | None:
    """Where a function of the place passes zero on the way; None where it cannot be found.

    Where nothing is singular, places are those of a coarse grid, so that other functions that
    pass zero near meet them again.
    """
    low, high = 0, _FEWER_PARTS if way.is_regular else _PARTS
    parts = high
    first, last = way.near(0.0), way.near(1.0)
    if first is None or last is None:
        return None
    below, above = function(first), function(last)
    sign = np.sign(below)
    if sign == np.sign(above):
        return None
    while high - low > 1:
        middle = (low + high) // 2
        near = way.near(middle / parts)
        value = 0.0 if near is None else function(near)
        if value == 0.0:
            low, below = middle, value
            break
        if np.sign(value) == sign:
            low, below = middle, value
        else:
            high, above = middle, value
    about = low if abs(below) < abs(above) else high
    return _refined(way, function, about / parts, is_touching=False)


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
    # Rounded, so that shares of a grid are the same however they were found.
    shares = np.round(about + _POINTS, 12)
    places = [way.near(share) for share in shares.tolist()]
    known = [near for near in places if near is not None]
    if len(known) < len(places):
        return None
    values = np.array([function(near) for near in known])
    share = _root(_POINTS, values, is_touching)
    if share is None:
        return None
    weights = _weights(_POINTS, share)
    changes = [way.ahead(s) + near.across for s, near in zip(shares.tolist(), known, strict=True)]
    change = np.asarray(weights @ np.array(changes))
    tangent = weights @ np.array([way.direction(near) for near in known])
    where = way.held.at(way.chart.middle, change).here
    if way.is_regular and not way.held.is_small:
        near = way.near(about + share)
    else:
        smallest = smallest_of(where.scaled, _SMALL, way.base.smallest)
        near = Chart(where, smallest.rank(_SMALL), smallest).near(np.zeros(change.size))
    if near is not None:
        where = near.place.here
    tangent = tangent / np.linalg.norm(tangent)
    arc = way.one.arc + arc_between(way.one, where, tangent)
    if about + share < 0.0:
        arc = 2.0 * way.one.arc - arc
    return Passing(arc, where, tangent)


def _weights(points: FloatArray, place: float) -> FloatArray:
    """The weights of values at some points in the value of their polynomial at a place."""
    apart, way = points[:, None] - points, np.tile(place - points, (points.size, 1))
    np.fill_diagonal(apart, 1.0)
    np.fill_diagonal(way, 1.0)
    return np.asarray(way.prod(axis=1) / apart.prod(axis=1))


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


_STATIONS_MOST_STEPS, _MOST_IN_CHART = 12, 80
#: A correction below this is rounding.
_STATIONS_SETTLED = 2.0e-16
#: What the error must go down by, a part of what the linear model says.
_GOES_DOWN = 1.0e-4
#: Damping, times the largest singular value squared: at first, and how it changes.
_DAMPING, _MORE, _LESS, _MOST = 1.0e-3, 8.0, 0.1, 1.0e8


def least_error(held: Held, direction: FloatArray, distance: float) -> tuple[float, float]:
    """The least held deformations after a distance along a motion from the reference.

    Args:
        held: What is held.
        direction: (n,) of any length: `Held.direction` of a motion.
        distance: How far the node that moves farthest, by the size; in radians if it turns.

    Returns:
        Their norm, and the largest of them; lengths by the size, angles in radians.
    """
    start = held.at(held.reference)
    smallest = smallest_of(start.scaled, ZERO_AT_REFERENCE)
    chart = Chart(start, smallest.rank(ZERO_AT_REFERENCE), smallest)
    place = least_near(chart, direction * (distance / held.reach(direction))).place
    return float(np.linalg.norm(place.error)), place.residual


def least_near(chart: Chart, ahead: FloatArray) -> Near:
    """The place of the least error after a step (n,) ahead from the middle of a chart."""
    held, along = chart.held, ahead / np.linalg.norm(ahead)
    change = _in_chart(chart, ahead, along)
    basis = complement(along[:, None])

    def errors(share: FloatArray) -> tuple[FloatArray, FloatArray] | None:
        place = held.at(chart.middle, ahead + change + basis @ share)
        return (place.error, place.jacobian @ basis) if place.is_finite else None

    share = descend(errors, np.zeros(basis.shape[1]), _STATIONS_MOST_STEPS)
    correction = change + basis @ share
    place = held.at(chart.middle, ahead + correction)
    return Near(place, correction, chart.bordered(place))


def _in_chart(chart: Chart, ahead: FloatArray, along: FloatArray) -> FloatArray:
    """(n,) the correction after which what rank leaves out is least, the rest being solved for."""
    beside = chart.null - np.outer(along, along @ chart.null)
    left, values, _ = np.linalg.svd(beside, full_matrices=False)
    free = left[:, values > 0.5]
    first = chart.near(ahead)
    if first is None:
        return np.zeros(ahead.size)

    def rest(share: FloatArray) -> tuple[FloatArray, FloatArray] | None:
        near = chart.near(ahead + free @ share)
        if near is None or float(np.linalg.norm(share)) > float(np.linalg.norm(ahead)):
            return None
        # What the others do, with what is solved for as it is.
        still = np.zeros((chart.null.shape[1], free.shape[1]))
        slope = chart.bordered(near.place).solved(near.place.matrix @ free, still)[1]
        return chart.rest.T @ near.place.error, slope

    share = np.zeros(free.shape[1])
    if share.size and chart.rest.size:
        share = descend(rest, share, _MOST_IN_CHART)
    near = chart.near(ahead + free @ share) or first
    return free @ share + near.across


Descended = Callable[[FloatArray], "tuple[FloatArray, FloatArray] | None"]


def descend(function: Descended, start: FloatArray, most: int) -> FloatArray:
    """Where a function's values are least, by their norm.

    Args:
        function: Values and derivatives at a place; None where it is not defined.
        start: Where to begin.
        most: How many steps.
    """
    place, here, damping = start, function(start), _DAMPING
    for _ in range(most):
        if here is None or not here[0].any():
            break
        error, jacobian = here
        left, values, right = np.linalg.svd(jacobian, full_matrices=False)
        along, best = left.T @ error, float(error @ error)
        while damping <= _MOST:
            scale = values**2 + damping * float(values.max(initial=0.0)) ** 2
            factor = values / np.where(scale > 0.0, scale, 1.0)
            change = -right.T @ (factor * along)
            there = function(place + change)
            now = np.inf if there is None else float(there[0] @ there[0])
            promised = float(np.sum(along**2 * (1.0 - (1.0 - factor * values) ** 2)))
            if best - now > _GOES_DOWN * promised:
                break
            damping *= _MORE
        else:
            break
        settled = float(np.linalg.norm(change)) <= _STATIONS_SETTLED or best - now <= 1.0e-14 * best
        place, here = place + change, there
        damping *= _LESS
        if settled:
            break
    return place
