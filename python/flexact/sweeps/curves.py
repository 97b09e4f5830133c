# SPDX-License-Identifier: BSD-3-Clause
"""Singular places between the rows of a grid, joined to curves cell by cell."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from itertools import combinations, pairwise
from math import dist
from typing import NamedTuple

import numpy as np

from .crossing import Crossing

Point = tuple[float, float]
Segment = tuple[Point, Point]
#: Of four points of a cell, the ways to join them in pairs.
_PAIRS = (((0, 1), (2, 3)), ((0, 2), (1, 3)), ((0, 3), (1, 2)))


class Curves(NamedTuple):
    """What is drawn of singular places in a map."""

    segments: list[Segment]
    alone: list[Point]
    """Places that are joined with no other one."""


def curves_of(
    crossings: Sequence[Crossing], x: str, y: str, columns: tuple[np.ndarray, np.ndarray]
) -> Curves:
    """Join the singular places on the edges of each cell.

    Args:
        crossings: The places.
        x: The parameter along the map.
        y: The parameter up the map.
        columns: The values of both, (variants,) each.
    """
    index = [np.unique(column, return_inverse=True)[1].tolist() for column in columns]
    cells: dict[tuple[int, int], list[Point]] = defaultdict(list)
    points: list[Point] = []
    for each in crossings:
        if each.along not in (x, y):
            continue
        point = (_number(each, x), _number(each, y))
        points.append(point)
        places = [(index[0][row], index[1][row]) for row in each.rows]
        low = [min(place[axis] for place in places) for axis in (0, 1)]
        high = [max(place[axis] for place in places) for axis in (0, 1)]
        # An edge has a cell on each side, a corner four round it.
        around = [
            range(a - 1, a + 1) if a == b else range(a, b) for a, b in zip(low, high, strict=True)
        ]
        for i in around[0]:
            for j in around[1]:
                cells[i, j].append(point)
    segments = list(dict.fromkeys(s for there in cells.values() for s in _joined(there)))
    joined = {point for segment in segments for point in segment}
    return Curves(segments, [point for point in dict.fromkeys(points) if point not in joined])


def _number(each: Crossing, name: str) -> float:
    value = each.parameters[name]
    assert isinstance(value, (int, float))
    return float(value)


def _joined(there: list[Point]) -> list[Segment]:
    points = sorted(dict.fromkeys(there))
    if len(points) == 4:
        best = min(_PAIRS, key=lambda pairs: sum(dist(points[a], points[b]) for a, b in pairs))
        return [(points[a], points[b]) for a, b in best]
    if len(points) == 3:
        ranked = sorted(combinations(points, 2), key=lambda pair: dist(*pair))
        return list(ranked[:2])
    return list(pairwise(points))
