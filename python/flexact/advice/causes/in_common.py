# SPDX-License-Identifier: BSD-3-Clause
"""What several lines have in common, said by as few simple relations as can be."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ...analysis.order import without_sense
from ...analysis.screws import ScrewKind
from ...core.arrays import FloatArray
from .cause import RelationKind
from .lines import Lines

#: Of more lines nothing is said.
_MOST_LINES = 60
_NONE = np.zeros(3)


class Common(NamedTuple):
    """What some of the lines have in common."""

    kind: RelationKind
    group: tuple[int, ...]
    """Which lines, ascending."""
    direction: FloatArray
    point: FloatArray
    """Where it stands [m]."""
    pitch: float = 0.0


def in_common(lines: Lines, *, planar: bool) -> list[Common]:
    """What dependent lines have in common, the most telling first; nothing if that is not known.

    Args:
        lines: The lines, which are dependent.
        planar: Whether all lie in one plane by themselves.
    """
    if not 2 <= len(lines) <= _MOST_LINES:
        return []
    same = list(_of_one_line(lines))
    if same:
        return same
    held = list(_of_six(lines))
    if held:
        return held
    through = list(_of_one_point(lines))
    groups = _cover(lines, planar)
    if through:
        return through + [one for one in groups if len(one.group) == len(lines)]
    covered = {k for one in groups for k in one.group}
    if len(covered) == len(lines):
        return groups
    return [*_of_all(lines), *groups]


def _of_one_line(lines: Lines) -> Iterator[Common]:
    for group in lines.together(lines.is_one):
        first = lines.lines[group[0]]
        yield Common(
            RelationKind.ONE_LINE,
            tuple(group),
            without_sense(first.direction),
            lines.in_place(first.point),
        )


def _of_one_point(lines: Lines) -> Iterator[Common]:
    for group, _, point in lines.points():
        if len(group) == len(lines):
            yield Common(RelationKind.CONCURRENT, tuple(group), _NONE, lines.in_place(point))
            return


def _of_six(lines: Lines) -> Iterator[Common]:
    """Six and more that leave one motion: that all meet its axis, or lie across it."""
    screw = lines.unstopped() if len(lines) >= 6 else None
    if screw is None or screw.kind is ScrewKind.SCREW:
        return
    turns = screw.kind is ScrewKind.ROTATION
    kind = RelationKind.ONE_TRANSVERSAL if turns else RelationKind.ACROSS
    point = lines.in_place(screw.point) if turns else _NONE
    yield Common(kind, tuple(range(len(lines))), without_sense(screw.direction), point)


def _of_all(lines: Lines) -> Iterator[Common]:
    every = tuple(range(len(lines)))
    if len(lines) == 4 and lines.rank == 3 and lines.are_skew():
        yield Common(RelationKind.REGULUS, every, _NONE, lines.in_place(_NONE))
    screw = lines.unstopped() if len(lines) >= 6 else None
    if screw is not None:
        yield Common(
            RelationKind.COMPLEX,
            every,
            without_sense(screw.direction),
            lines.in_place(screw.point),
            screw.pitch,
        )


def _cover(lines: Lines, planar: bool) -> list[Common]:
    """Groups that share no line, the largest first: parallel ones, or those in one plane."""
    found = [
        Common(
            RelationKind.PARALLEL,
            tuple(group),
            without_sense(lines.lines[group[0]].direction),
            _NONE,
        )
        for group in lines.together(lines.is_parallel)
    ]
    if not planar:
        found += [
            Common(
                RelationKind.ONE_PLANE, tuple(group), without_sense(normal), lines.in_place(point)
            )
            for group, normal, point in lines.planes()
        ]
    found.sort(key=lambda one: (-len(one.group), one.kind is RelationKind.ONE_PLANE, one.group))
    made: list[Common] = []
    taken: set[int] = set()
    for one in found:
        if not taken & set(one.group):
            made.append(one)
            taken |= set(one.group)
    return made
