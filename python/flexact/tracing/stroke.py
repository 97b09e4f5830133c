# SPDX-License-Identifier: BSD-3-Clause
"""The steps of a path with what is special between them, from the stations that were followed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ..analysis.result import Result
from ..core.arrays import FloatArray
from ..model.configuration import Configuration
from ..motion import Followed, Held, Station
from ..motion.stations import Between, Passing, passing
from ..show.drawing.movement import pose_in, poses_with_inner_nodes
from ..show.drawing.selection import Selection
from ..util.records import Frozen
from .values import ROTATION, DeadPoint, Drive, Names, Step


@dataclass(frozen=True, eq=False)
class Found(Frozen):
    """A place between two stations, and what is special there."""

    arc: float
    where: Configuration
    nodes: tuple[int, ...] = ()
    """Those that turn back there."""
    resting: tuple[int, ...] = ()
    """Those that are at rest, also such as never move."""
    is_drive: bool = False
    directions: int = 0


def _passing(
    between: Between, function: Callable[[Configuration, FloatArray], float]
) -> Passing | None:
    """Where a function of place and direction passes zero; None where it is not found."""
    return passing(
        between, lambda near: function(near.place.configuration, between.direction(near))
    )


def merged(found: Sequence[Found], apart: float) -> list[Found]:
    """What was found, in order; what is at one place is one."""
    made: list[Found] = []
    for each in sorted(found, key=lambda one: one.arc):
        if made and each.arc - made[-1].arc <= apart:
            last = made[-1]
            made[-1] = replace(
                last,
                nodes=tuple(sorted({*last.nodes, *each.nodes})),
                resting=tuple(sorted({*last.resting, *each.resting})),
                is_drive=last.is_drive or each.is_drive,
                directions=max(last.directions, each.directions),
            )
        else:
            made.append(each)
    return made


#: Velocities, with that of the fastest node one: below this a node rests, and above that it moves.
_RESTS, _MOVES = 1.0e-6, 1.0e-6
#: Places nearer than this part of a step are one.
_ONE_PLACE = 1.0e-5
#: At a dead point singular values up to here are zero.
_ZERO_AT_DEAD = 1.0e-7
#: How many of the smallest singular values are kept.
_KEPT = 6


class Stroke:
    """Makes steps of stations."""

    def __init__(self, result: Result, shown: Selection, held: Held, zero: float) -> None:
        """Keep what was followed; `zero` is up to where scaled singular values are zero."""
        self.result, self.held, self.zero = result, held, zero
        self.judged = held if shown.freedom is None else Held(result.data)
        self.drive = None if shown.freedom is None else Drive(shown.freedom, held)
        self.names = Names(result)

    def steps(self, way: Followed) -> list[Step]:
        """The steps of a path one way, the reference first, dead points among them."""
        stations = way.stations
        branches = {id(station): station for station in way.branches}
        made = [self._of_station(stations[0], self.result.rank)]
        for k, (one, other) in enumerate(pairwise(stations)):
            inside = [b for b in way.branches if one.arc < b.arc <= other.arc]
            found = self._between(one, other, inside)
            made += [self._of_found(each) for each in found]
            if id(other) not in branches:
                step = self._of_station(other)
                if k + 2 < len(stations):
                    names, is_drive = self._turning_at((one, 1.0), other, (stations[k + 2], 1.0))
                    if names or is_drive:
                        step = replace(step, dead=DeadPoint(names, is_drive))
                made.append(step)
        if len(stations) > 1 and id(stations[-1]) in branches:
            made[-1] = self._at_last_branch(made[-1], stations[-2], stations[-1])
        return made

    def _at_last_branch(self, step: Step, before: Station, last: Station) -> Step:
        """The step where the path ends, with what comes to rest there."""
        moved = np.linalg.norm(self._speeds(before), axis=1) > _RESTS
        rests = np.linalg.norm(self._speeds(last), axis=1) <= _RESTS
        names = self.names.turning(np.flatnonzero(rests & moved).tolist(), rests, rests)
        rate = 1.0 if self.drive is None else self.drive.rate(last.within, last.tangent)
        dead = DeadPoint(names, abs(rate) <= _RESTS, last.directions)
        return replace(step, dead=dead)

    def at_reference(self, steps: Sequence[Step], ways: Sequence[Followed]) -> tuple[Step, ...]:
        """The steps of both ways, with what is special at the reference."""
        made = list(steps)
        place = next(k for k, step in enumerate(made) if step.arc == 0.0)
        start = ways[1].stations[0]
        beside = [way.stations[1] for way in ways if len(way.stations) > 1]
        directions = start.directions if any(b.rank > start.rank for b in beside) else 0
        names: tuple[str, ...] = ()
        is_drive = False
        if len(beside) == 2:
            names, is_drive = self._turning_at((beside[0], -1.0), start, (beside[1], 1.0))
            # What moves to second order only turns a little on both sides: that is none.
            names = tuple(name for name in names if not name.startswith(ROTATION))
        if names or directions or is_drive:
            dead = DeadPoint(names, is_drive, directions)
            made[place] = replace(made[place], dead=dead)
        return tuple(made)

    def _turning_at(
        self, before: tuple[Station, float], here: Station, behind: tuple[Station, float]
    ) -> tuple[tuple[str, ...], bool]:
        """What turns back at a station itself, and whether the drive does.

        The stations beside it stand with 1, or -1 where their tangents point the other way.
        """
        came, goes = (sense * self._speeds(station) for station, sense in (before, behind))
        resting = np.linalg.norm(self._speeds(here), axis=1) <= _RESTS
        moves = _least_norm(came, goes) > _MOVES
        turns = resting & moves & (np.sum(came * goes, axis=1) < 0.0)
        names = self.names.turning(np.flatnonzero(turns).tolist(), resting, turns)
        if self.drive is None:
            return names, False
        rates = [
            sense * self.drive.rate(station.within, station.tangent)
            for station, sense in (before, (here, 1.0), behind)
        ]
        least = _RESTS * max(abs(rate) for rate in rates)
        return names, rates[0] * rates[2] < 0.0 and abs(rates[1]) <= least

    def _speeds(self, station: Station) -> FloatArray:
        """(nodes, 3) velocities along the path, that of the fastest node one."""
        return self.held.at_nodes(station.tangent) / self.held.reach(station.tangent)

    def _of_station(self, station: Station, rank: int | None = None) -> Step:
        if rank is None and self.judged is self.held:
            rank = station.rank
        # Where the path is a multiple zero of D(x) it is known to half as many digits.
        zero = self.zero if station.directions == 1 else max(self.zero, _ZERO_AT_DEAD)
        return self._step(station.within, station.arc, station.residual, zero, rank)

    def _of_found(self, found: Found) -> Step:
        resting = np.zeros(self.held.arrays.node_kind.size, bool)
        resting[list(found.resting)] = True
        names = self.names.turning(found.nodes, resting, resting)
        residual = self.held.at(found.where).residual
        step = self._step(found.where, found.arc, residual, max(self.zero, _ZERO_AT_DEAD))
        if not (names or found.is_drive or found.directions):
            return step
        return replace(step, dead=DeadPoint(names, found.is_drive, found.directions))

    def _step(
        self,
        where: Configuration,
        arc: float,
        residual: float,
        zero: float,
        rank: int | None = None,
    ) -> Step:
        values = self.judged.values(where)
        known = int(np.count_nonzero(values > zero)) if rank is None else rank
        rows, columns = self.judged.rows.size, self.judged.columns.size
        (pose,) = poses_with_inner_nodes(self.result.condensed, [pose_in(self.held, where)])
        return Step(
            arc * self.held.size,
            self.held.outside(where),
            pose,
            residual,
            values[::-1][:_KEPT].copy(),
            columns - known,
            rows - known,
            np.nan if self.drive is None else self.drive.value(where, pose),
        )

    def _between(self, one: Station, other: Station, branches: Sequence[Station]) -> list[Found]:
        found = [Found(b.arc, b.within, directions=b.directions) for b in branches]
        before, behind = self._speeds(one), self._speeds(other)
        reverses = np.sum(before * behind, axis=1) < 0.0
        turning = np.flatnonzero((_least_norm(before, behind) > _MOVES) & reverses).tolist()
        drive = self.drive
        turns = drive is not None and (
            drive.rate(one.within, one.tangent) * drive.rate(other.within, other.tangent) < 0.0
        )
        if turning or turns:
            between = Between(self.held, one, other)
            if drive is not None and turns:
                place = _passing(between, drive.rate)
                found += [] if place is None else [Found(place.arc, place.where, is_drive=True)]
            while turning:
                rest = self._rest(between, turning[0])
                at_rest = () if rest is None else rest.nodes
                turning = [each for each in turning[1:] if each not in at_rest]
                found += [] if rest is None else [rest]
        return merged(found, _ONE_PLACE * (other.arc - one.arc))

    def _rest(self, between: Between, node: int) -> Found | None:
        """Where a node comes to rest between two stations, and the nodes that do so with it."""
        before, behind = self._speeds(between.one), self._speeds(between.other)
        difference = before[node] - behind[node]
        place = _passing(
            between, lambda _, along: float(self.held.at_nodes(along)[node] @ difference)
        )
        if place is None:
            return None
        speeds = self.held.at_nodes(place.tangent) / self.held.reach(place.tangent)
        rests = np.linalg.norm(speeds, axis=1) <= _RESTS
        turns = rests & (np.sum(before * behind, axis=1) < 0.0)
        if not turns[node]:
            return None
        nodes, resting = (tuple(np.flatnonzero(each).tolist()) for each in (turns, rests))
        return Found(place.arc, place.where, nodes, resting)


def _least_norm(one: FloatArray, other: FloatArray) -> FloatArray:
    return np.asarray(np.minimum(np.linalg.norm(one, axis=1), np.linalg.norm(other, axis=1)))
