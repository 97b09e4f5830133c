# SPDX-License-Identifier: BSD-3-Clause
"""Follow a motion on D(x) = 0, step by step.

Ahead along the direction of the null space that is nearest to the last one, then back to
D(x) = 0 across it. A step that fails is halved; they grow again.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np

from ..analysis.limits import TRUE, ZERO_ELSEWHERE
from ..core.arrays import FloatArray
from ..util.records import Frozen
from .bordered import Smallest, smallest_of
from .constraints import Held, Place
from .stations import (
    Between,
    Chart,
    Near,
    Passing,
    Station,
    arc_between,
    least_near,
    passing,
    touching,
)


class Ending(str, Enum):
    """Why a path was not followed farther."""

    LENGTH = "length"
    """It was followed as far as was asked."""
    CLOSED = "closed"
    """It came back to where it began."""
    BRANCHES = "branches"
    """Directions in which it may go on are more than before: others branch off."""
    TURNS_BACK = "turns back"
    """It comes to a point from which no direction leads on but the one back."""
    NOT_ZERO = "not zero"
    """No configuration near, ahead of it, has held deformations of zero."""
    ELEMENT = "element"
    """An element has left its range."""
    STEPS = "steps"
    """As many steps were taken as are allowed."""


@dataclass(frozen=True, eq=False)
class Stop(Frozen):
    """Why a path was not followed farther, and by how much it failed.

    Attributes:
        ending: Which it is.
        step: The last step that was tried [size].
        residual: The largest held deformation that was left after it [size]; 0 without.
        directions: How many independent directions are possible there.
        element: Index of the element that has left its range; -1 without.
        range: "length" or "bending" of it; empty without.
    """

    ending: Ending
    step: float = 0.0
    residual: float = 0.0
    directions: int = 0
    element: int = -1
    range: str = ""


@dataclass(frozen=True)
class Wishes:
    """How a path is to be followed.

    Lengths are in sizes of the model, of the node that moves farthest; rotations in radians.

    Attributes:
        length: How far each way.
        first: The first step.
        largest: The largest step.
        least: The least step; where one of it fails the path ends.
        steps: How many steps each way at most.
        through: Whether to go straight on where other paths branch off.
        branches: Whether these places are looked for where it goes straight on.
    """

    length: float = 0.1
    first: float = 0.01
    largest: float = 0.02
    least: float = 1.0e-5
    steps: int = 2_000
    through: bool = False
    branches: bool = True


@dataclass(frozen=True, eq=False)
class Followed(Frozen):
    """A path from the reference one way.

    Attributes:
        stations: The first is the reference.
        stop: Why it was not followed farther.
        branches: Where other paths branch off, also the one where it stops.
    """

    stations: tuple[Station, ...]
    stop: Stop
    branches: tuple[Station, ...] = ()

    @property
    def length(self) -> float:
        """How far it was followed [size]."""
        return self.stations[-1].arc

    @property
    def residual(self) -> float:
        """The largest held deformation on it [size]."""
        return max(each.residual for each in self.stations)


#: At a branch singular values up to here are zero: its place is known to about as many digits.
_ZERO_AT_BRANCH = 1.0e-7
#: A singular value may touch zero if it is no more than so many times what it falls in a step.
_MAY_REACH = 1.5


def signed_value(chart: Chart, smallest: Smallest) -> Callable[[Near], float]:
    """The smallest singular value that is not zero near the middle of a chart; positive there."""

    def value(near: Near) -> float:
        if not chart.rank:
            return 0.0
        found = smallest_of(near.place.scaled, ZERO_ELSEWHERE, smallest)
        return _sign(chart, near.place, found) * found.value(chart.rank - 1)

    return value


def _sign(chart: Chart, place: Place, smallest: Smallest) -> float:
    """-1 where a value passes zero between the middle of a chart, the guess, and a place."""
    known = smallest.right.shape[1] - smallest.pairs == chart.null.shape[1]
    return smallest.passed if known and smallest.passed is not None else chart.sign(place)


def branch_between(one: Station, other: Station, zero: float) -> Station | None:
    """The station between two at which other paths branch off; None without any."""
    if other.rank < one.rank:
        return other
    if one.rank != other.rank or one.signed * other.signed >= 0.0:
        return None
    way = Between(one, other)
    found = passing(way, signed_value(way.chart, way.base.smallest))
    return None if found is None else station_there(found, zero, one.smallest)


def branch_about(one: Station, middle: Station, other: Station, zero: float) -> Station | None:
    """The station near the middle one of three at which singular values touch zero.

    So they do where two pass it together: the sign stays.
    """
    if not one.rank == middle.rank == other.rank or one.signed * other.signed <= 0.0:
        return None
    values = np.abs([one.signed, middle.signed, other.signed])
    falls = max(values[0], values[2]) - values[1]
    if values[1] > min(values[0], values[2]) or values[1] > _MAY_REACH * falls:
        return None
    way = Between(middle, other)
    low = -(middle.arc - one.arc) / (other.arc - middle.arc)
    found = touching(way, signed_value(middle.chart, middle.smallest), low)
    if found is None:
        return None
    made = station_there(found, zero, middle.smallest)
    return made if made.rank < middle.rank else None


def station_there(found: Passing, zero: float, near: Smallest) -> Station:
    """The station at a singular place that was found between two others; values of a near one."""
    zero = max(zero, _ZERO_AT_BRANCH)
    smallest = smallest_of(found.where.scaled, zero, near)
    return Station(found.where, found.arc, found.tangent, smallest.rank(zero), 0.0, smallest)


#: Where the null space is larger than the path is wide, what exceeds rounding is corrected within
#: it; a multiple zero of D(x) is known to half as many digits, and singular values that were zero
#: count as such up to here.
_ROUNDING, _STILL_ZERO = 5.0e-15, 1.0e-7
#: The correction of a step may be this part of it, and the cosine between two directions is at
#: least so large.
_FARTHEST = 0.25
_STRAIGHT = 0.8
#: Steps grow where the correction is below this part of them.
_EASY, _GROWTH = 0.06, 1.5
#: Where the first step is halved, the correction of a path becomes smaller by this at least.
_CURVED = 0.35
#: Back at the start a path is closed: nearer to it than this.
_CLOSED = 1.0e-8
#: A closed path has so many stations at least.
_FEWEST = 6


def follow(
    held: Held,
    direction: FloatArray,
    rank: int,
    wishes: Wishes,
    zero: float = ZERO_ELSEWHERE,
    on_step: Callable[[float], None] | None = None,
) -> Followed:
    """The path from the reference on, along a motion.

    Args:
        held: What stays zero.
        direction: (n,) the motion, `Held.direction`; of any length but zero.
        rank: Of D(c) at the reference.
        wishes: How far, by which steps.
        zero: Scaled singular values up to here are zero away from the reference.
        on_step: Called with the arc [size] after each step.
    """
    return _Walk(held, wishes, zero, on_step).walk(direction, rank)


class _Walk:
    """Goes from station to station."""

    def __init__(
        self, held: Held, wishes: Wishes, zero: float, on_step: Callable[[float], None] | None
    ) -> None:
        self.held, self.wishes, self.zero = held, wishes, zero
        self.on_step = on_step or (lambda _: None)
        self.failed = Stop(Ending.STEPS)
        self.stations: list[Station] = []
        self.branches: list[Station] = []

    def walk(self, direction: FloatArray, rank: int) -> Followed:
        """Step until something stops it."""
        start, along = self.held.at(self.held.reference), direction / np.linalg.norm(direction)
        smallest = smallest_of(start.scaled, self.zero)
        signed = smallest.value(rank - 1) if rank else 0.0
        self.stations.append(Station(start, 0.0, along, rank, signed, smallest))
        step, stop = self.wishes.first, None
        while stop is None:
            left = self.wishes.length - self.stations[-1].arc
            if len(self.stations) > self.wishes.steps:
                stop = Stop(Ending.STEPS, step)
            elif left < max(1.0e-9 * self.wishes.length, self.wishes.least):
                stop = Stop(Ending.LENGTH, step)
            elif (found := self._onward(min(step, left))) is None:
                stop = self.failed
            else:
                there, step = found
                stop = self._arrive(there)
                self.on_step(self.stations[-1].arc)
        return Followed(tuple(self.stations), stop, tuple(self.branches))

    def _arrive(self, there: Station) -> Stop | None:
        """Take a station, unless something came before it; why to stop there, if at all."""
        last = self.stations[-1]
        if self._is_back(last, there):
            start, held = self.stations[0], self.held
            to_start, past_start = (
                held.reach(held.way(start.place.value, each.place.value)) for each in (last, there)
            )
            arc = last.arc + (there.arc - last.arc) * to_start / (to_start + past_start)
            self.stations.append(replace(start, arc=arc))
            return Stop(Ending.CLOSED)
        if self.wishes.through and not self.wishes.branches:
            self.stations.append(there)
            return None
        branch = branch_between(last, there, self.zero)
        if branch is None and len(self.stations) > 1:
            before = self.stations[-2]
            branch = branch_about(before, last, there, self.zero)
        if branch is not None:
            self.branches.append(branch)
            if not self.wishes.through:
                if branch.arc <= last.arc:
                    self.stations.pop()
                self.stations.append(branch)
                return Stop(Ending.BRANCHES, 0.0, branch.residual, branch.directions)
        self.stations.append(there)
        return None

    def _is_back(self, last: Station, there: Station) -> bool:
        """Whether the path passes its start, the same way as it left it."""
        start, held = self.stations[0], self.held
        if len(self.stations) < _FEWEST:
            return False
        ways = (held.way(start.place.value, each.place.value) for each in (last, there))
        if not max(map(held.reach, ways)) < 2.0 * (there.arc - last.arc):
            return False
        passed = passing(
            Between(last, there),
            lambda near: float(start.tangent @ held.way(start.place.value, near.place.value)),
        )
        if passed is None or start.tangent @ passed.tangent < _STRAIGHT:
            return False
        return held.reach(held.way(start.place.value, passed.where.value)) < _CLOSED

    def _onward(self, step: float) -> tuple[Station, float] | None:
        """The next station, and the step to try from there; None without any."""
        here = self.stations[-1]
        chart = here.chart
        reach = self.held.reach(here.tangent)
        while step >= self.wishes.least:
            ahead = here.tangent * (step / reach)
            near = chart.near(ahead)
            if near is None or near.place.residual > _ROUNDING:
                near = self._among_branches(here, chart, ahead) or near
            found = None if near is None else self._accepted(here, near, step)
            if near is not None and found is not None:
                bent = float(np.linalg.norm(near.across)) / float(np.linalg.norm(ahead))
                grown = step * (_GROWTH if bent < _EASY else 1.0)
                return found, min(grown, self.wishes.largest)
            step *= 0.5
        return None

    def _among_branches(self, here: Station, chart: Chart, ahead: FloatArray) -> Near | None:
        """Where the null space is larger than the path is wide, corrections within it, too."""
        if here.directions < 2:
            return None
        near = least_near(chart, ahead)
        if near.place.residual > TRUE:
            return None
        if len(self.stations) > 1:
            return near
        # A path that is tangent to the motion leaves it by the square of the step, another one
        # by the step itself.
        half = least_near(chart, 0.5 * ahead)
        less, more = (float(np.linalg.norm(each.across)) for each in (half, near))
        return near if half.place.residual <= TRUE and less <= _CURVED * more + 1.0e-9 else None

    def _accepted(self, here: Station, near: Near, step: float) -> Station | None:
        """The station there, if it is one of the path."""
        where, held = near.place.here, self.held
        residual = where.residual
        self.failed = Stop(Ending.NOT_ZERO, step, residual)
        way = step / held.reach(here.tangent)
        if residual > TRUE or float(np.linalg.norm(near.across)) > _FARTHEST * way:
            return None
        beyond = held.beyond(where)
        if beyond is not None:
            self.failed = Stop(Ending.ELEMENT, step, residual, 0, *beyond)
            return None
        smallest = smallest_of(where.scaled, self.zero, here.smallest)
        rank = smallest.rank(self.zero)
        if rank > here.rank and smallest.value(here.rank) <= _STILL_ZERO:
            rank = here.rank
        chart = Chart(where, rank, smallest, here.chart)
        # What came last, as it is carried along by what was done.
        last_way = here.tangent
        if here.directions > 1 and chart.null.shape[1] > 1:
            # The null space does not say how the path is curved within it; the way so far does.
            gone = held.way(here.place.value, where.value)
            last_way = 2.0 * gone / np.linalg.norm(gone) - here.tangent
        along = chart.null @ (chart.null.T @ last_way)
        straight = float(np.linalg.norm(along))
        if straight < _STRAIGHT:
            if chart.null.shape[1]:
                self.failed = Stop(Ending.TURNS_BACK, step, residual)
            return None
        # Which way singular values passed zero is known where the rank is the same.
        sign = _sign(here.chart, where, smallest) if rank == here.rank else 1.0
        sign *= float(np.sign(here.signed) or 1.0)
        arc = here.arc + arc_between(here, where, along)
        signed = sign * smallest.value(rank - 1) if rank else 0.0
        made = Station(where, arc, along / straight, rank, signed, smallest)
        made.__dict__["chart"] = chart
        return made
