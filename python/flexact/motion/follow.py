# SPDX-License-Identifier: BSD-3-Clause
"""Follow a motion on D(x) = 0, step by step.

Ahead along the direction of the null space that is nearest to the last one, then back to
D(x) = 0 across it. A step that fails is halved; they grow again.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..analysis.velocities import Velocities
from ..core.arrays import FloatArray
from .branches import branch_about, branch_between, sign_between
from .chart import Chart, Near
from .constraints import Held
from .ending import Ending, Stop
from .followed import Followed, Wishes
from .passing import passing
from .station import Between, Station, arc_between, station_at
from .stations import least_near

#: Held deformations up to this part of the size are zero.
TRUE = 1.0e-12
#: Scaled singular values up to here are zero away from the reference, where rounding of
#: positions is magnified.
ZERO = 1.0e-10
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


def follow_both_ways(
    motion: Velocities, rank: int, wishes: Wishes, zero: float = ZERO
) -> tuple[Followed, Followed]:
    """The path of a motion against it and along it; see `follow`."""
    held = Held(motion.data)
    direction = held.direction(motion)
    return (
        follow(held, -direction, rank, wishes, zero),
        follow(held, direction, rank, wishes, zero),
    )


def follow(
    held: Held,
    direction: FloatArray,
    rank: int,
    wishes: Wishes,
    zero: float = ZERO,
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
        start, along = self.held.reference, direction / np.linalg.norm(direction)
        chart = Chart(self.held, start, rank)
        residual = self.held.at(start).residual
        values = self.held.values(start)
        first = station_at(self.held, start, rank, along, 0.0, residual, 1.0, values)
        self.stations.append(first)
        step, stop = self.wishes.first, None
        while stop is None:
            if len(self.stations) > self.wishes.steps:
                stop = Stop(Ending.STEPS, step)
                break
            left = self.wishes.length - self.stations[-1].arc
            if left < max(1.0e-9 * self.wishes.length, self.wishes.least):
                stop = Stop(Ending.LENGTH, step)
                break
            found = self._onward(chart, min(step, left))
            if found is None:
                stop = self.failed
                break
            there, chart, step = found
            stop = self._arrive(there)
            self.on_step(self.stations[-1].arc)
        return Followed(tuple(self.stations), stop, tuple(self.branches))

    def _arrive(self, there: Station) -> Stop | None:
        """Take a station, unless something came before it; why to stop there, if at all."""
        last = self.stations[-1]
        if self._is_back(last, there):
            start = self.stations[0]
            self.stations.append(replace(start, arc=self._arc_of_start(last, there)))
            return Stop(Ending.CLOSED)
        branch = branch_between(self.held, last, there, self.zero)
        if branch is None and len(self.stations) > 1:
            before = self.stations[-2]
            branch = branch_about(self.held, before, last, there, self.zero)
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
        before = held.difference(start.within, last.within)
        behind = held.difference(start.within, there.within)
        is_near = max(map(held.reach, (before, behind))) < 2.0 * (there.arc - last.arc)
        if len(self.stations) < _FEWEST or not is_near:
            return False
        passed = passing(
            Between(held, last, there),
            lambda near: float(
                start.tangent @ held.difference(start.within, near.place.configuration)
            ),
        )
        if passed is None or start.tangent @ passed.tangent < _STRAIGHT:
            return False
        return held.reach(held.difference(start.within, passed.where)) < _CLOSED

    def _arc_of_start(self, last: Station, there: Station) -> float:
        start = self.stations[0].within
        before, behind = (
            self.held.reach(self.held.difference(start, each.within)) for each in (last, there)
        )
        return last.arc + (there.arc - last.arc) * before / (before + behind)

    def _onward(self, chart: Chart, step: float) -> tuple[Station, Chart, float] | None:
        """The next station with its chart, and the step to try from there; None without any."""
        here = self.stations[-1]
        reach = self.held.reach(here.tangent)
        while step >= self.wishes.least:
            ahead = here.tangent * (step / reach)
            near = chart.near(ahead)
            if near is None or near.place.residual > _ROUNDING:
                near = self._among_branches(here, chart, ahead) or near
            found = None if near is None else self._accepted(here, chart, near, step)
            if near is not None and found is not None:
                bent = float(np.linalg.norm(near.across)) / float(np.linalg.norm(ahead))
                grown = step * (_GROWTH if bent < _EASY else 1.0)
                return *found, min(grown, self.wishes.largest)
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

    def _accepted(
        self, here: Station, last: Chart, near: Near, step: float
    ) -> tuple[Station, Chart] | None:
        """The station there with its chart, if it is one of the path."""
        where, residual = near.place.configuration, near.place.residual
        self.failed = Stop(Ending.NOT_ZERO, step, residual)
        way = step / self.held.reach(here.tangent)
        if residual > TRUE or float(np.linalg.norm(near.across)) > _FARTHEST * way:
            return None
        beyond = self.held.beyond(where)
        if beyond is not None:
            self.failed = Stop(Ending.ELEMENT, step, residual, 0, *beyond)
            return None
        values = self.held.values(where)
        rank = int(np.count_nonzero(values > self.zero))
        if rank > here.rank and values[here.rank] <= _STILL_ZERO:
            rank = here.rank
        chart = Chart(self.held, where, rank)
        # What came last, as it is carried along by what was done.
        last_way = here.tangent
        if here.directions > 1 and chart.null.shape[1] > 1:
            # The null space does not say how the path is curved within it; the way so far does.
            gone = self.held.difference(here.within, where)
            last_way = 2.0 * gone / np.linalg.norm(gone) - here.tangent
        along = chart.null @ (chart.null.T @ last_way)
        straight = float(np.linalg.norm(along))
        if straight < _STRAIGHT:
            if chart.null.shape[1]:
                self.failed = Stop(Ending.TURNS_BACK, step, residual)
            return None
        sign = sign_between(last, chart) * float(np.sign(here.signed) or 1.0)
        arc = here.arc + arc_between(self.held, here, where, along)
        along /= straight
        made = station_at(self.held, where, rank, along, arc, residual, sign, values)
        return made, chart
