# SPDX-License-Identifier: BSD-3-Clause
"""A design along a stroke, from where it rests to both ends."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from ..elasticity import Elastic, State, StrokeError
from .designs import Numbers, StrokeCurve, stacked
from .elastic_design import Measures, drives_of, numbers, over_levels


class StrokePoints(NamedTuple):
    """The stroke: of which coordinate, and where."""

    node: int
    coordinate: str
    rest: float
    values: FloatArray
    """(n,) ascending, absolute."""


class Reached(NamedTuple):
    """What was reached of a stroke."""

    states: tuple[State, ...]
    values: FloatArray
    """(n,) those that were reached, ascending."""
    ends: tuple[float, float]
    """How far it went each way: the ends that were asked for, or the last value reached."""
    why: str
    """Why not farther; empty where all was reached."""


def values_of(start: float, stop: float, count: int, rest: float) -> FloatArray:
    """(n,) places along a stroke, ascending; where it rests, if that is in between, is one."""
    made = np.linspace(min(start, stop), max(start, stop), count)
    if made[0] < rest < made[-1]:
        made[int(np.argmin(np.abs(made - rest)))] = rest
    return made


def follow(elastic: Elastic, asked: StrokePoints) -> Reached:
    """The states along a stroke, each way from where it rests, as far as they are found."""
    found: dict[float, State] = {}
    ends, why = [asked.rest, asked.rest], []
    for end, sense in enumerate((-1.0, 1.0)):
        way = np.sort(sense * asked.values[sense * asked.values >= sense * asked.rest]) * sense
        if end == 1:
            way = way[way != asked.rest]
        states, reached, reason = _one_way(elastic, asked, way.tolist())
        found.update(zip(way.tolist(), states, strict=False))
        if way.size:
            ends[end] = reached
        why += [reason] if reason else []
    values = np.array(sorted(found))
    return Reached(
        tuple(found[v] for v in values.tolist()), values, (ends[0], ends[1]), "; ".join(why)
    )


def _one_way(
    elastic: Elastic, asked: StrokePoints, way: Sequence[float]
) -> tuple[tuple[State, ...], float, str]:
    """States from the one at rest outward, how far that is, and why not farther."""
    reached, why, rest = way[-1] if way else asked.rest, "", asked.rest
    while way:
        try:
            drive = elastic.points.coordinate(asked.node, asked.coordinate)
            return elastic.driven(drive, way), reached, why
        except StrokeError as error:
            why = why or str(error)
            reached = error.reached
            shorter = [v for v in way if abs(v - rest) <= abs(reached - rest)]
            # What was reached on the way to a place may be out of reach by a hair.
            way = shorter if len(shorter) < len(way) else way[:-1]
    return (), reached, why


def curve_of(
    measures: Measures,
    rest: State,
    reached: Reached,
    drive: tuple[int, str],
    is_locked: bool,
    progress: Callable[[float], None],
) -> StrokeCurve | None:
    """A design along the states that were reached; None without any."""
    if not reached.states:
        return None
    rows = []
    for k, state in enumerate(reached.states):
        rows.append(_row(measures, rest, state, drive, is_locked))
        progress((k + 1) / len(reached.states))
    stiffness, kept, own, force, *hertz = (stacked(each) for each in zip(*rows, strict=True))
    if is_locked:
        # How the force changes with the value, where the drive is held.
        slope = np.zeros_like(force.value)
        if reached.values.size > 1:
            slope = np.gradient(force.value[:, 0], reached.values)[:, None]
        own = Numbers(slope, np.zeros_like(slope))
    frequencies = parasitic = None
    if hertz and hertz[0].value.size:
        frequencies = hertz[0]
        others = []
        for k, state in enumerate(reached.states):
            count = len(state.alone[-1].frequencies)
            is_drive = (False,) * count if is_locked else drives_of(measures, state, count)
            left = [j for j in range(frequencies.value.shape[1]) if not is_drive[j]]
            others.append(Numbers(frequencies.value[k, left], frequencies.uncertainty[k, left]))
        parasitic = stacked(others)
    # With masses it is known from the frequencies whether a stiffness is negative.
    is_stable = [
        state.finest.squares.negative == 0 if measures.has_masses else state.is_stable
        for state in reached.states
    ]
    return StrokeCurve(
        reached.values,
        stiffness,
        kept.column(0),
        own.column(0),
        force.column(0),
        frequencies,
        parasitic,
        tuple(is_stable),
        tuple(state.under_constrained for state in reached.states),
        tuple(state.over_constrained for state in reached.states),
    )


def _row(
    measures: Measures, rest: State, state: State, drive: tuple[int, str], is_locked: bool
) -> list[Numbers]:
    """Stiffness, what is kept of it in the worst direction, of the drive, force, frequencies."""

    def own(one: State) -> FloatArray:
        """(1,) stiffness of the driven coordinate itself; infinite where it is held."""
        if is_locked:
            return np.zeros(1)
        node, name = drive
        points = one.model.points
        names = [points.name(each) for each in points.coordinates(points.of(node))]
        value = one.compliance(node)[(names.index(name),) * 2]
        return np.array([1.0 / value if value != 0.0 else np.inf])

    made = [
        over_levels(measures.stiffness, state),
        over_levels(measures.worst, rest, state),
        over_levels(own, state),
        over_levels(lambda one: np.atleast_1d(one.force), state),
    ]
    if measures.has_masses:
        made.append(over_levels(measures.frequencies, state))
    return [numbers(each) for each in made]
