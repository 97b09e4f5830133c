# SPDX-License-Identifier: BSD-3-Clause
"""What the axes of hinges that carry have in common."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ...model.parts.parts import Part, PartKind
from ...result.result import Result
from .cause import LineKind, Relation, RelationKind
from .in_common import in_common
from .limbs import position_of_hinge
from .lines import Line, Lines
from .trials import Trials


def of_axes(result: Result, parts: Sequence[Part], trials: Trials) -> Iterator[Relation]:
    """What makes the axes of some hinges special; nothing where there are fewer than two.

    Groups of parallel axes, and axes through one point, are tried in other geometries.
    """
    hinges = _hinges(result, parts)
    if len(hinges) < 2:
        return
    parts = [part for part, _ in hinges]
    lines = Lines([line for _, line in hinges], result.characteristic_length)
    groups = lines.together(lines.is_parallel)
    if groups and sum(map(len, groups)) == len(lines):
        sure = trials.with_parallel([[parts[k] for k in group] for group in groups])
        if sure:
            for group in groups:
                direction = lines.lines[group[0]].direction
                mine = tuple(parts[k] for k in group)
                yield Relation(
                    *(RelationKind.PARALLEL, LineKind.AXIS, mine, ()),
                    *(direction, np.zeros(3)),
                    is_sufficient=True,
                )
            return
    for one in in_common(lines, planar=result.given.planar):
        is_through = one.kind is RelationKind.CONCURRENT
        yield Relation(
            *(one.kind, LineKind.AXIS, tuple(parts[k] for k in one.group), ()),
            *(one.direction, one.point),
            pitch=one.pitch,
            is_sufficient=is_through and trials.with_concurrent(parts),
        )


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
