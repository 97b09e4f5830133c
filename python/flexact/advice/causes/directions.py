# SPDX-License-Identifier: BSD-3-Clause
"""Parts that lie along or across an axis in which a coordinate is held or declared by itself."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ...analysis.result import Result
from ...core.elements import Class
from ...model.parts.parts import Part
from .cause import LineKind, Relation, RelationKind
from .conditions import Figures

_SAME = 1.0e-6


def of_directions(result: Result, parts: Sequence[Part]) -> Iterator[tuple[Relation, ...]]:
    """What lies along or across x, y or z, where these directions matter.

    Each is one set of relations that may be enough: of an axis, then all of them.
    """
    if not _is_split(result):
        return
    figures = Figures(result)
    every: list[Relation] = []
    for axis in np.eye(3)[: 2 if result.given.planar else 3]:
        made: dict[tuple[LineKind, RelationKind], list[Part]] = {}
        for part in parts:
            own = figures.own(part)
            if own is None:
                continue
            way = own[1](*figures.here)[1][0]
            if float(np.linalg.norm(np.cross(way, axis))) <= _SAME:
                made.setdefault((own[0], RelationKind.ALONG), []).append(part)
            elif abs(float(way @ axis)) <= _SAME:
                made.setdefault((own[0], RelationKind.ACROSS_AXIS), []).append(part)
        found = [
            Relation(kind, of, tuple(mine), (), axis, np.zeros(3))
            for (of, kind), mine in made.items()
        ]
        for one in found:
            yield (one,)
        every += found
    yield tuple(every)


def _is_split(result: Result) -> bool:
    """Whether some coordinates of a node are dependent, and others are not."""
    arrays = result.data.arrays
    classes = arrays.coordinate_class
    free = np.any(classes == Class.DEPENDENT, axis=0)
    held = np.any(np.isin(classes, (Class.FIXED, Class.INDEPENDENT)), axis=0)
    return bool(np.any(free & held))
