# SPDX-License-Identifier: BSD-3-Clause
"""Follow a motion on D(x) = 0, step by step.

Ahead along the direction of the null space that is nearest to the last one, then back to
D(x) = 0 across it. A step that fails is halved; they grow again.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...base.frozen import Frozen
from ...core.arrays import FloatArray
from ...model.configuration import Configuration
from ..velocities import Velocities
from .chart import Chart, Near
from .ending import Ending, Stop
from .held import Held
from .least import across, descend

#: Held deformations up to this part of the size are zero.
TRUE = 1.0e-12
#: Scaled singular values up to here are zero away from the reference, where rounding of
#: positions is magnified; and how many of the smallest are kept.
_ZERO = 1.0e-10
_KEPT = 6
#: The correction of a step may be this part of it, and the cosine between two directions is at
#: least so large.
_FARTHEST = 0.25
_STRAIGHT = 0.8
#: Where the first step is halved, the correction of a path becomes smaller by this at least.
_CURVED = 0.35
#: Back at the start, for a closed path: by this part of the step that leads past it.
_CLOSED = 1.0e-9


@dataclass(frozen=True)
class Wishes:
    """How a path is to be followed.

    Attributes:
        length: How far each way, in sizes of the model.
        first: The first step, likewise.
        largest: The largest step.
        least: The least step; where one of it fails the path ends.
        steps: How many steps each way at most.
        through: Whether to go straight on where other paths branch off.
    """

    length: float = 0.1
    first: float = 0.01
    largest: float = 0.02
    least: float = 1.0e-5
    steps: int = 2_000
    through: bool = False


@dataclass(frozen=True, eq=False)
class Station(Frozen):
    """A configuration of a path.

    Attributes:
        configuration: In metres, where the model stands.
        arc: How far it is along the path, in sizes: of displacements by the size, rotations in
            radians, the root of the sum of the squares of all dependent coordinates.
        residual: The largest held deformation, lengths by the size, angles in radians.
        tangent: (n,) along the path, displacements by the size, rotations in radians; norm 1.
        values: The smallest singular values of the scaled matrix, theory.md (2), ascending,
            at most six.
        rank: How many of all of them are not zero.
        signed: The smallest of these, with a sign that changes where it passes zero.
    """

    configuration: Configuration
    arc: float
    residual: float
    tangent: FloatArray
    values: FloatArray
    rank: int
    signed: float

    @property
    def directions(self) -> int:
        """In how many independent directions it goes on from here, to first order."""
        return self.tangent.size - self.rank


@dataclass(frozen=True, eq=False)
class Followed(Frozen):
    """A path from the reference one way.

    Attributes:
        stations: The first is the reference.
        stop: Why it was not followed farther.
    """

    stations: tuple[Station, ...]
    stop: Stop

    @property
    def length(self) -> float:
        """How far it was followed [size]."""
        return self.stations[-1].arc

    @property
    def residual(self) -> float:
        """The largest held deformation on it [size]."""
        return max(each.residual for each in self.stations)


def follow_both_ways(
    motion: Velocities, rank: int, wishes: Wishes, zero: float = _ZERO
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
    zero: float = _ZERO,
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


@dataclass(frozen=True, eq=False)
class _Here(Frozen):
    """A station as the walk needs it."""

    station: Station
    chart: Chart
    along: FloatArray


class _Walk:
    def __init__(
        self, held: Held, wishes: Wishes, zero: float, on_step: Callable[[float], None] | None
    ) -> None:
        self.held, self.wishes, self.zero, self.on_step = held, wishes, zero, on_step
        self.failed = Stop(Ending.STEPS)

    def walk(self, direction: FloatArray, rank: int) -> Followed:
        here = self._start(direction, rank)
        made, step = [here.station], self.wishes.first
        for _ in range(self.wishes.steps):
            left = self.wishes.length - here.station.arc
            if left <= 1.0e-12 * self.wishes.length:
                return Followed(tuple(made), Stop(Ending.LENGTH, step))
            found = self._onward(here, min(step, left), is_first=len(made) == 1)
            if found is None:
                return Followed(tuple(made), self.failed)
            there, step = found
            made.append(there.station)
            if self.on_step is not None:
                self.on_step(there.station.arc)
            stop = self._stop(here, there)
            if stop is not None:
                return Followed(tuple(made), stop)
            here = there
        return Followed(tuple(made), Stop(Ending.STEPS, step))

    def _start(self, direction: FloatArray, rank: int) -> _Here:
        middle = self.held.reference
        chart = Chart(self.held, middle, rank)
        along = direction / np.linalg.norm(direction)
        return self._arrived(middle, chart, along, 0.0, 0.0, 1.0)

    def _arrived(
        self,
        where: Configuration,
        chart: Chart,
        along: FloatArray,
        arc: float,
        residual: float,
        sign: float,
    ) -> _Here:
        values = np.linalg.svd(self.held.scaled(where), compute_uv=False)
        rank = chart.right.shape[1]
        station = Station(
            self.held.outside(where),
            arc,
            residual,
            along,
            np.array(values[::-1][:_KEPT], np.float64),
            rank,
            sign * float(values[rank - 1]) if rank else 0.0,
        )
        return _Here(station, chart, along)

    def _onward(self, here: _Here, step: float, is_first: bool) -> tuple[_Here, float] | None:
        """The next station, and the step to try from there; None where there is none."""
        while step >= self.wishes.least:
            ahead = here.along * step
            near = here.chart.near(ahead)
            if near is None or near.place.residual > TRUE:
                near = self._among_branches(here, ahead, near, is_first) or near
            there = None if near is None else self._accepted(here, near, step)
            if there is not None:
                bent = float(np.linalg.norm(near.across)) / step if near else 0.0
                grown = step * (1.5 if bent < 0.25 * _FARTHEST else 1.0)
                return there, min(grown, self.wishes.largest)
            step *= 0.5
        return None

    def _among_branches(
        self, here: _Here, ahead: FloatArray, near: Near | None, is_first: bool
    ) -> Near | None:
        """Where the null space is larger than the path is wide, corrections within it, too."""
        if here.chart.null.shape[1] < 2:
            return None
        direction = here.along / np.linalg.norm(here.along)
        base = across(direction)
        place, change = descend(self.held, here.chart.middle, ahead, base)
        found = Near(place, change)
        if place.residual > TRUE:
            return None
        # A path that is tangent to the motion leaves it by the square of the step, another one
        # by the step itself.
        half, less = descend(self.held, here.chart.middle, 0.5 * ahead, base)
        is_path = half.residual <= TRUE
        curved = np.linalg.norm(less) <= _CURVED * np.linalg.norm(change) + 1.0e-9
        return found if is_path and curved else None

    def _accepted(self, here: _Here, near: Near, step: float) -> _Here | None:
        """The station there, if it is one of the path."""
        where, residual = near.place.configuration, near.place.residual
        self.failed = Stop(Ending.NOT_ZERO, step, residual)
        if residual > TRUE:
            return None
        if float(np.linalg.norm(near.across)) > _FARTHEST * step:
            return None
        beyond = self.held.beyond(where)
        if beyond is not None:
            self.failed = Stop(Ending.ELEMENT, step, residual, 0, *beyond)
            return None
        values = np.linalg.svd(self.held.scaled(where), compute_uv=False)
        chart = Chart(self.held, where, int(np.count_nonzero(values > self.zero)))
        # What came last, as it is carried along by what was done.
        along = chart.null @ (chart.null.T @ here.along)
        straight = float(np.linalg.norm(along))
        if straight < _STRAIGHT:
            if chart.null.shape[1]:
                self.failed = Stop(Ending.TURNS_BACK, step, residual)
            return None
        sign = _sign_between(here.chart, chart) * np.sign(here.station.signed)
        arc = here.station.arc + step * float(np.hypot(1.0, np.linalg.norm(near.across) / step))
        return self._arrived(where, chart, along / straight, arc, residual, float(sign))

    def _stop(self, here: _Here, there: _Here) -> Stop | None:
        directions = there.station.directions
        if directions > here.station.directions and not self.wishes.through:
            return Stop(Ending.BRANCHES, 0.0, there.station.residual, directions)
        return None


def _sign_between(one: Chart, other: Chart) -> float:
    """-1 where a singular value passes zero between two charts, with its left or right vector."""
    if one.right.shape[1] != other.right.shape[1]:
        return 1.0
    left = np.linalg.slogdet(one.left.T @ other.left)[0]
    right = np.linalg.slogdet(one.right.T @ other.right)[0]
    return float(left * right) or 1.0
