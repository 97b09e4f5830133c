# SPDX-License-Identifier: BSD-3-Clause
"""Whether points in the plane lie on one circle or one conic.

Six joints of K3,3 on a conic have a self-stress (Bolker and Roth, Pacific Journal of Mathematics
90, 1980).
"""

from __future__ import annotations

from itertools import combinations

import numpy as np

from ...core.arrays import BoolArray, FloatArray
from .cause import RelationKind

_SAME = 1.0e-6


def conic_of(points: FloatArray) -> RelationKind | None:
    """What six or more points (n, 2) lie on; None where it is neither, or fewer points are given.

    Five points always lie on a conic.
    """
    if len(points) < 6:
        return None
    x, y = ((points - points.mean(axis=0)) / np.abs(points - points.mean(axis=0)).max()).T
    one = np.ones_like(x)
    if _is_dependent(np.stack((x**2 + y**2, x, y, one))):
        return RelationKind.CIRCLE
    if _are_on_two_lines(np.stack((x, y), axis=1)):
        return RelationKind.TWO_LINES
    if _is_dependent(np.stack((x**2, x * y, y**2, x, y, one))):
        return RelationKind.CONIC
    return None


def _are_on_two_lines(points: FloatArray) -> bool:
    """Whether a line through two of the first three, or none of them, leaves the rest on one."""
    for i, j in combinations(range(3), 2):
        on = _is_on_line(points, points[i], points[j])
        rest = points[~on]
        if len(rest) < 3 or bool(_is_on_line(rest, rest[0], rest[1]).all()):
            return True
    return False


def _is_on_line(points: FloatArray, first: FloatArray, second: FloatArray) -> BoolArray:
    way = second - first
    off = (points[:, 0] - first[0]) * way[1] - (points[:, 1] - first[1]) * way[0]
    found: BoolArray = np.abs(off) <= _SAME * float(way @ way)
    return found


def _is_dependent(rows: FloatArray) -> bool:
    values = np.linalg.svd(rows, compute_uv=False)
    return bool(values[-1] <= _SAME * values[0])
