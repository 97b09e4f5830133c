# SPDX-License-Identifier: BSD-3-Clause
"""Trace the path of a motion, both ways, and find its dead points."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path

import numpy as np

from ..analysis.decomposition import asked_for
from ..analysis.limits import TRUE
from ..analysis.result import Result, result_of
from ..core.arrays import FloatArray
from ..core.elements import NodeKind
from ..model.model import Model
from ..model.parts.parts import natural
from ..model.reading import read
from ..motion import (
    Ending,
    Followed,
    Held,
    Place,
    Station,
    Wishes,
    follow,
    is_followed,
    least_error,
)
from ..motion.bordered import Smallest, smallest_of
from ..motion.constraints import MOST_COORDINATES
from ..motion.stations import Between, passing
from ..show.drawing.movement import poses_in, poses_with_inner_nodes
from ..show.drawing.pose import Pose
from ..show.drawing.selection import Selection, select_motion
from ..util.errors import FlexactError
from ..util.quantities import Quantity, larger_in_words, without_units
from ..util.records import Frozen, cached_property
from ..util.rotations import vector_of
from ..util.units import Units
from .output import TRACES, lines
from .values import ROTATION, DeadPoint, Step, Traced, Way, drive_unit


@dataclass(frozen=True, eq=False, repr=False)
class Trace(Traced):
    """The path of a motion, or of a declared degree of freedom, with words and files of it."""

    def describe(self) -> str:
        """How far it goes each way, what stops it, its dead points and verdicts, in words."""
        return "\n".join(lines(self))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it to a file, whole or not at all.

        Args:
            path: Its suffix says what it is to be: .csv, a row a step; a picture (.png, .svg, .pdf)
                of singular values and coordinates along the path; .pvd, a cycle that plays in
                ParaView.

        Raises:
            FlexactError: There is no such kind of file, a package is missing, or the file cannot
                be written.
        """
        TRACES.save(self, self.result.given, Path(path))


#: How far each way by default, in sizes of the model, and by how many steps.
LENGTH, STEPS = 1.0, 50
#: What ends both ways within so small a part of the size is no path: held deformations have not
#: become larger than what counts as zero. Nor is it where they have grown out of rounding.
_NO_PATH, _NEAR, _GROWN = 1.0e-3, 0.1, 1.0e-14
#: Where held deformations are looked at if there is no path, a part of the size.
_TRIED = 0.01
#: Halved so often a step is too small.
_LEAST = 2.0**-11


class TraceError(FlexactError):
    """A path that cannot be traced."""


def trace(
    model: Model | Result | str | bytes | os.PathLike[str] | os.PathLike[bytes],
    *,
    motion: int | None = None,
    freedom: int | str | None = None,
    length: Quantity | None = None,
    steps: int = STEPS,
    through: bool = True,
    beyond: bool = False,
    progress: Callable[[float], None] | None = None,
) -> Trace:
    """Follow a motion on D(x) = 0, eq. (5), both ways from the reference.

    All fixed and independent deformations stay zero; of a declared degree of freedom the
    declaration is let loose, so that the path goes on where it can be driven no farther.

    Args:
        model: A model, the path of a deck, or an analysis.
        motion: The number, from 1, of one of the motions that nothing determines; by default the
            first of them, else the first declared degree of freedom that can move.
        freedom: The number, from 1, of a declared degree of freedom instead, or its name, such as
            "stage y".
        length: How far each way [m], or a text such as "20mm": of the node that moves farthest,
            a rotation of 1 rad counting as the model's size. By default that size.
        steps: By how many steps each way, at least.
        through: Whether to go straight on where other paths branch off; else the path ends there.
        beyond: Whether the length may be larger than the model.
        progress: Called with the part that is done, from 0 to 1.

    Raises:
        DeckError: the model's deck is wrong.
        ModelError: the model is wrong.
        FlexactError: there is no such motion or freedom, the path cannot be begun, or the length
            is larger than the model, and not `beyond`.
        TypeError: something is of another kind than it must be.
        ValueError: the length or the number of steps is not positive.
    """
    result = _analysed(model)
    wished = _checked(length, steps, result.given.units)
    if motion is not None and freedom is not None:
        raise TraceError("a motion or a degree of freedom is traced, not both")
    shown = select_motion(result, motion, freedom)
    if shown is None:
        raise TraceError(
            "there is nothing to trace: the mechanism has no motion, and no declared degree of "
            "freedom that can move"
        )
    data = shown.motion.analysed.data
    if not is_followed(data):
        raise TraceError(
            f"the model has more than {MOST_COORDINATES} coordinates that may change, too many to "
            "be followed; declare divided sheets (flexact declare), or trace a smaller model"
        )
    held = Held(data)
    size = 1.0 if wished is None else wished / held.size
    if wished is not None and wished > data.size and size > 1.0 and not beyond:
        units = result.given.units
        whole = f"the whole model, {units.said(data.size, 'm', 3)}"
        raise TraceError(larger_in_words("the length", units.said(wished, "m", 6), whole, "20mm"))
    most = size / steps
    wishes = Wishes(size, most, most, _LEAST * min(most, 0.1), 100 * steps + 2000, through)
    direction = held.direction(shown.motion.analysed)
    zero = result.gap.zero_elsewhere(result.raw.noise)
    rank = result.rank
    if shown.freedom is not None:
        counts = max(result.tolerance, result.raw.noise)
        rank = smallest_of(held.at(held.reference).scaled, counts).rank(counts)
    stroke = Stroke(result, shown, held, zero)
    ways: list[Followed] = []
    for number, sense in enumerate((-1.0, 1.0)):

        def report(arc: float, before: int = number) -> None:
            if progress is not None:
                progress(min(1.0, 0.5 * (before + arc / wishes.length)))

        ways.append(follow(held, sense * direction, rank, wishes, zero, report))
    _require_begun(result, ways, held)
    against, along = (stroke.steps(way) for way in ways)
    both = (*(replace(step, arc=-step.arc) for step in against[:0:-1]), *along)
    made = stroke.at_reference(both, ways)
    ends = (Way(way.length * held.size, way.stop) for way in ways)
    return Trace(result, shown, held.size, made, *ends)


def _analysed(given: object) -> Result:
    if isinstance(given, Result):
        return given
    if isinstance(given, (str, bytes, os.PathLike)):
        given = read(given)
    if isinstance(given, Model):
        return result_of(given.data, asked_for("auto", None))
    raise TypeError(
        f"a model, the path of a deck or an analysis can be traced, not {type(given).__name__}"
    )


def _checked(length: Quantity | None, steps: int, units: Units) -> float | None:
    if isinstance(steps, bool) or not isinstance(steps, int):
        raise TypeError(f"the number of steps must be whole, not {type(steps).__name__}")
    if steps < 1:
        raise ValueError("there must be one step each way at least")
    if length is None:
        return None
    length = without_units(length, units.symbol("m"))
    if isinstance(length, bool) or not isinstance(length, (int, float, np.floating, np.integer)):
        raise TypeError(f"the length must be a number, not {type(length).__name__}")
    if not (math.isfinite(length) and length > 0.0):
        raise ValueError("the length must be positive and finite")
    return float(length)


def _require_begun(result: Result, ways: list[Followed], held: Held) -> None:
    """Raise where the path goes neither way.

    Raises:
        TraceError: It does not.
    """
    far = max(way.length for way in ways)
    ends = all(way.stop.ending is Ending.NOT_ZERO for way in ways)
    grown = far < _NEAR and max(way.residual for way in ways) > _GROWN
    if far > 0.0 and not (ends and (far < _NO_PATH or grown)):
        return
    start, stop = ways[1].stations[0], ways[1].stop
    if stop.ending is Ending.ELEMENT:
        element = int(result.data.arrays.element_number[stop.element])
        raise TraceError(f"the path cannot be begun: element {element} is at the end of its range")
    _, largest = least_error(held, start.tangent, _TRIED)
    tried = (
        f"{result.given.units.said(_TRIED * held.size, 'm', 2)} along it, held deformations of "
        f"{largest:.2g} of the model's size are left at the least"
    )
    why = f"the motion is infinitesimal, or ends here; {tried}"
    if start.directions > 1:
        why = f"the mechanism can move in {start.directions} independent directions here, and "
        why += (
            "the paths that are near leave in others than this one. Trace from a configuration a "
            "little way along one of them"
            if largest <= TRUE
            else f"no path leads along this one: {tried}"
        )
    raise TraceError(f"the path cannot be begun: {why}")


@dataclass(frozen=True, eq=False)
class Found(Frozen):
    """A place between two stations, and what is special there."""

    arc: float
    where: Place
    nodes: tuple[int, ...] = ()
    """Those that turn back there."""
    resting: tuple[int, ...] = ()
    """Those that are at rest, also such as never move."""
    is_drive: bool = False
    directions: int = 0


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
        self.freedom = shown.freedom
        self._smallest: Smallest | None = None

    def steps(self, way: Followed) -> list[Step]:
        """The steps of a path one way, the reference first, dead points among them."""
        stations = way.stations
        branches = {id(station) for station in way.branches}
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
            # Where the path ends, with what comes to rest there.
            before, last = stations[-2:]
            moved = np.linalg.norm(self._speeds(before), axis=1) > _RESTS
            rests = np.linalg.norm(self._speeds(last), axis=1) <= _RESTS
            names = self._turning(np.flatnonzero(rests & moved).tolist(), rests)
            rate = self._rate(last.place, last.tangent)
            made[-1] = replace(
                made[-1], dead=DeadPoint(names, abs(rate) <= _RESTS, last.directions)
            )
        return made

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
            made[place] = replace(made[place], dead=DeadPoint(names, is_drive, directions))
        return tuple(made)

    def _turning(self, nodes: Sequence[int], resting: np.ndarray) -> tuple[str, ...]:
        """Bodies and points that turn back where nodes, by their index as analysed, rest.

        A body does so if all of its nodes that move do, and its rotation if those that turn do.
        """
        given, kinds = self.result.condensed.nodes, self.result.given.arrays.node_kind
        rests = set(given[resting].tolist())
        names: set[str] = set()
        for node in nodes:
            name = self._name_of(int(given[node]))
            mine = self._moving.get(name, set())
            turned = {each for each in mine if kinds[each] > NodeKind.POSITION}
            if mine <= rests:
                names.add(name)
            elif turned and turned <= rests:
                names.add(f"{ROTATION}{name}")
        return tuple(sorted(names, key=natural))

    @cached_property
    def _moving(self) -> dict[str, set[int]]:
        """Nodes of the model as given that can move and were analysed, by what they belong to."""
        made: dict[str, set[int]] = {}
        free = (self.result.data.arrays.coordinate_class > 1).any(axis=0)
        for given in np.asarray(self.result.condensed.nodes)[free].tolist():
            made.setdefault(self._name_of(given), set()).add(given)
        return made

    def _name_of(self, node: int) -> str:
        """The body of a node of the model as given, by its index; else the point."""
        parts = self.result.parts
        body = parts.body_at.get(node)
        if body is not None:
            return parts.of_body(body).name
        position = parts.place_of(node)
        name = "" if position is None else parts.name_of_point(position)
        number = parts.data.arrays.node_number[node if position is None else position]
        return name or f"node {number}"

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
        names = self._turning(np.flatnonzero(turns).tolist(), resting)
        rates = [
            sense * self._rate(station.place, station.tangent)
            for station, sense in (before, (here, 1.0), behind)
        ]
        least = _RESTS * max(abs(rate) for rate in rates)
        return names, rates[0] * rates[2] < 0.0 and abs(rates[1]) <= least

    def _rate(self, where: Place, along: FloatArray) -> float:
        """How fast what drives changes along a direction (n,); 1 where the path itself does."""
        if self.freedom is None:
            return 1.0
        part, owner = self.freedom.place
        if self.freedom.is_coordinate:
            return float(self.held.at_nodes(along)[owner, part])
        return self.held.rate(where, 6 * owner + part, along)

    def _value(self, where: Place, pose: Pose) -> float:
        """By how much what drives has changed since the reference [m, rad]; of a pose as given.

        Of a declared rotation it is the component of the rotation vector; NaN of the path itself.
        """
        if self.freedom is None:
            return np.nan
        part, owner = self.freedom.place
        is_length = drive_unit(self.freedom) == "m"
        if not self.freedom.is_coordinate:
            value = self.held.deformation(where, 6 * owner + part)
            return value * self.held.unit if is_length else value
        analysis = self.freedom.analysis
        node = int(analysis.condensed.nodes[owner])
        if not is_length:
            return float(vector_of(pose.rotation[node][np.newaxis])[0, part])
        return float(pose.position[node, part] - analysis.given.arrays.node_value[part, node])

    def _speeds(self, station: Station) -> FloatArray:
        """(nodes, 3) velocities along the path, that of the fastest node one."""
        return self.held.at_nodes(station.tangent) / self.held.reach(station.tangent)

    def _of_station(self, station: Station, rank: int | None = None) -> Step:
        if rank is None and self.judged is self.held:
            rank = station.rank
        # Where the path is a multiple zero of D(x) it is known to half as many digits.
        zero = self.zero if station.directions == 1 else max(self.zero, _ZERO_AT_DEAD)
        return self._step(station.place, station.arc, zero, rank, station.smallest)

    def _of_found(self, found: Found) -> Step:
        resting = np.zeros(self.held.arrays.node_kind.size, bool)
        resting[list(found.resting)] = True
        names = self._turning(found.nodes, resting)
        step = self._step(found.where, found.arc, max(self.zero, _ZERO_AT_DEAD))
        if not (names or found.is_drive or found.directions):
            return step
        return replace(step, dead=DeadPoint(names, found.is_drive, found.directions))

    def _step(
        self,
        where: Place,
        arc: float,
        zero: float,
        rank: int | None = None,
        smallest: Smallest | None = None,
    ) -> Step:
        if smallest is None or self.judged is not self.held:
            judged = self.judged.at(where.configuration)
            smallest = smallest_of(judged.scaled, zero, self._smallest)
        self._smallest = smallest
        known = smallest.rank(zero) if rank is None else rank
        rows, columns = self.judged.shape
        here = poses_in(self.held, [where.configuration])
        (pose,) = poses_with_inner_nodes(self.result.condensed, here)
        return Step(
            arc * self.held.size,
            self.held.outside(where.configuration),
            pose,
            where.residual,
            smallest.values[:_KEPT].copy(),
            columns - known,
            rows - known,
            self._value(where, pose),
        )

    def _between(self, one: Station, other: Station, branches: Sequence[Station]) -> list[Found]:
        found = [Found(b.arc, b.place, directions=b.directions) for b in branches]
        before, behind = self._speeds(one), self._speeds(other)
        reverses = np.sum(before * behind, axis=1) < 0.0
        turning = np.flatnonzero((_least_norm(before, behind) > _MOVES) & reverses).tolist()
        rates = (self._rate(each.place, each.tangent) for each in (one, other))
        turns = math.prod(rates) < 0.0
        if turning or turns:
            between = Between(one, other, is_regular=not (branches or turns))
            if turns:
                place = passing(
                    between,
                    lambda near: self._rate(near.place, between.direction(near)),
                )
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
        place = passing(
            between,
            lambda near: float(self.held.at_nodes(between.direction(near))[node] @ difference),
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
