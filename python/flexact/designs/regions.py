# SPDX-License-Identifier: BSD-3-Clause
"""Boxes with edges along x, y and z: how far they are apart, and which lie in others.

A point is a box without extent, as in `Region.corners`.
"""

from __future__ import annotations

import itertools

import numpy as np

from ..core.arrays import BoolArray, FloatArray
from .problem import Box, Region

#: Pieces that a box may fall into before it counts as not covered.
_MOST_PIECES = 300


def distances(one: FloatArray, others: FloatArray) -> FloatArray:
    """(n,) distances of a box, (2, 3), from others, (n, 2, 3); zero where they meet."""
    gaps = np.maximum(others[:, 0] - one[1], one[0] - others[:, 1])
    return np.asarray(np.linalg.norm(np.maximum(gaps, 0.0), axis=1))


def overlap(one: FloatArray, others: FloatArray, slack: float) -> BoolArray:
    """(n,) whether a box, (2, 3), and others have inner points in common; faces may touch."""
    (low, high), lows, highs = one, others[:, 0], others[:, 1]
    inside = (low < highs - slack) & (lows < high - slack)
    # Flat ones in one plane lie in each other.
    flat = (np.abs(highs - lows) <= slack) & (high - low <= slack) & (np.abs(low - lows) <= slack)
    return np.asarray((inside | flat).all(axis=1))


def covered(one: FloatArray, others: FloatArray) -> bool:
    """Whether all of a box, (2, 3), lies in some others, (n, 2, 3), if perhaps in none alone."""
    left = [one]
    for other in others:
        left = [piece for each in left for piece in _without(each, other)]
        if len(left) > _MOST_PIECES:
            return False
    return not left


def _without(one: FloatArray, other: FloatArray) -> list[FloatArray]:
    """The pieces of a box that stick out of another one."""
    if (one[1] < other[0]).any() or (one[0] > other[1]).any():
        return [one]
    made, rest = [], one.copy()
    for axis, side in itertools.product(range(3), (0, 1)):
        edge = other[side, axis]
        if rest[0, axis] < edge if side == 0 else rest[1, axis] > edge:
            piece = rest.copy()
            piece[1 - side, axis] = rest[side, axis] = edge
            made.append(piece)
    return made


def all_around(low: FloatArray, high: FloatArray, gap: float) -> Region:
    """Six boxes around a box, each `gap` from it and half of that thick."""
    boxes = []
    for axis, is_high in itertools.product(range(3), (True, False)):
        one, other = low - 1.5 * gap, high + 1.5 * gap
        if is_high:
            one[axis] = high[axis] + gap
        else:
            other[axis] = low[axis] - gap
        boxes.append(Box(one, other))
    return Region(tuple(boxes))
