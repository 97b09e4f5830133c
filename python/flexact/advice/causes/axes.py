# SPDX-License-Identifier: BSD-3-Clause
"""What the axes of hinges that carry have in common."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ...analysis.order import without_sense
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...model.parts.parts import Part, PartKind
from .cause import LineKind, Relation, RelationKind
from .conditions import Figure, are_one, half_turned
from .in_common import Common, in_common
from .limbs import position_of_hinge
from .lines import Line, Lines

#: Of more axes no half-turn is looked for, nor where they have one of these in common.
_MOST_TURNED = 12
_SIMPLE = (RelationKind.ONE_LINE, RelationKind.CONCURRENT)


def of_axes(result: Result, parts: Sequence[Part]) -> Iterator[tuple[Relation, ...]]:
    """What the axes of some hinges have in common; nothing where there are fewer than two.

    Each is one set of relations that may be enough, the simplest first.
    """
    hinges = _hinges(result, parts)
    if len(hinges) < 2:
        return
    parts = [part for part, _ in hinges]
    lines = Lines([line for _, line in hinges], result.characteristic_length)

    def relation(one: Common) -> Relation:
        mine = tuple(parts[k] for k in one.group)
        kind, pitch = one.kind, one.pitch
        fold = 2 if kind is RelationKind.ROTATION else 1
        place = one.direction, one.point
        return Relation(kind, LineKind.AXIS, mine, (), *place, pitch=pitch, fold=fold)

    groups = [
        Common(RelationKind.PARALLEL, tuple(group), lines.lines[group[0]].direction, np.zeros(3))
        for group in lines.together(lines.is_parallel)
    ]
    points = [
        Common(RelationKind.CONCURRENT, tuple(group), np.zeros(3), lines.in_place(point))
        for group, _, point in lines.points()
    ]
    if groups and sum(len(one.group) for one in groups) == len(lines):
        yield tuple(map(relation, groups))
    common = in_common(lines, planar=result.given.planar)
    is_simple = any(one.kind in _SIMPLE for one in common)
    # By lines of one complex a motion only begins; by a symmetry it goes on.
    for one in () if is_simple else _half_turns(lines):
        yield (relation(one),)
    yield tuple(map(relation, common))
    yield tuple(map(relation, (*groups, *points)))


def _half_turns(lines: Lines) -> Iterator[Common]:
    """Half-turns that take lines onto each other, as in Bricard's line-symmetric loop."""
    count, length = len(lines), lines.length
    if not 4 <= count <= _MOST_TURNED:
        return
    every = [(line.point[None], line.direction[None]) for line in lines.lines]
    for other in range(1, count):
        for direction, point in _swapping(every[0], every[other], length):
            axis = np.concatenate((direction, point / length))[None]
            images = [half_turned(line, axis, length) for line in every]
            found = [
                next((j for j, one in enumerate(every) if are_one(image, one, length)), -1)
                for image in images
            ]
            if -1 not in found and all(i != j for i, j in enumerate(found)):
                place = lines.in_place(point)
                group = tuple(range(count))
                yield Common(RelationKind.ROTATION, group, without_sense(direction), place)


def _swapping(one: Figure, other: Figure, length: float) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Directions and points of the half-turns that swap two lines that are not parallel."""
    ((a,), (u,)), ((b,), (v,)) = one, other
    normal = np.cross(u, v)
    size = float(normal @ normal)
    if size <= 1.0e-12:
        return
    s = float(np.cross(b - a, v) @ normal) / size
    t = float(np.cross(b - a, u) @ normal) / size
    near, far = a + s * u, b + t * v
    for way in (u + v, u - v):
        yield way / np.linalg.norm(way), 0.5 * (near + far)


def _hinges(result: Result, parts: Sequence[Part]) -> list[tuple[Part, Line]]:
    """Hinges and bearings among some parts, with their axes."""
    made = []
    arrays = result.given.arrays
    for part in parts:
        place = position_of_hinge(result, part) if part.kind is PartKind.HINGE else None
        if place is None:
            continue
        axis = arrays.element_vector[:, part.elements[0]]
        if axis.any():
            unit = axis / np.linalg.norm(axis)
            made.append((part, Line(arrays.node_value[:3, place], unit)))
    return made
