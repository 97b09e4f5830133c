# SPDX-License-Identifier: BSD-3-Clause
"""Straight lines in space, and what several of them have in common.

Two lines may be one, be parallel or meet; more of them may lie in one plane, meet in one point or
meet one line. Four that are skew and of rank three are generators of one hyperboloid, and six of
rank five belong to one linear complex (Hunt, *Kinematic Geometry of Mechanisms*, 1978; Merlet,
*Parallel Robots*, 2006, section 6.4).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import combinations
from typing import NamedTuple

import numpy as np

from ...analysis.screws import Screw, screw_of
from ...core.arrays import FloatArray

#: What is below this part of the lengths at hand, or this angle [rad], is none.
_SAME = 1.0e-6
#: Of more lines only what all have in common is looked for.
_MOST_LINES = 24


class Line(NamedTuple):
    """A straight line."""

    point: FloatArray
    """(3,) [m]."""
    direction: FloatArray
    """(3,) unit vector."""

    def coordinates(self, length: float) -> FloatArray:
        """(6,) Pluecker's coordinates, moments over a length."""
        return np.concatenate((self.direction, np.cross(self.point, self.direction) / length))


class Lines:
    """Several lines, with a length [m] beside which distances count."""

    def __init__(self, lines: list[Line], length: float) -> None:
        """Keep them; their points are taken from the middle of all."""
        middle = np.mean([line.point for line in lines], axis=0) if lines else np.zeros(3)
        self.middle = middle
        self.lines = [Line(line.point - middle, line.direction) for line in lines]
        self.length = length

    def __len__(self) -> int:
        """How many."""
        return len(self.lines)

    @property
    def rank(self) -> int:
        """Of their coordinates."""
        if not self.lines:
            return 0
        values = np.linalg.svd(
            np.array([line.coordinates(self.length) for line in self.lines]), compute_uv=False
        )
        return int(np.count_nonzero(values > _SAME * values[0]))

    def is_parallel(self, i: int, j: int) -> bool:
        """Whether two are parallel or one."""
        a, b = self.lines[i].direction, self.lines[j].direction
        return bool(np.linalg.norm(np.cross(a, b)) <= _SAME)

    def is_one(self, i: int, j: int) -> bool:
        """Whether two are one line."""
        a, b = self.lines[i], self.lines[j]
        apart = np.cross(b.point - a.point, a.direction)
        return self.is_parallel(i, j) and bool(np.linalg.norm(apart) <= _SAME * self.length)

    def meeting(self, i: int, j: int) -> FloatArray | None:
        """(3,) the point where two meet; None where they do not, or are parallel."""
        a, b = self.lines[i], self.lines[j]
        normal = np.cross(a.direction, b.direction)
        size = float(normal @ normal)
        way = b.point - a.point
        if size <= _SAME**2 or abs(float(way @ normal)) > _SAME * self.length * size**0.5:
            return None
        t = float(np.cross(way, b.direction) @ normal) / size
        return np.asarray(a.point + t * a.direction)

    def in_place(self, point: FloatArray) -> FloatArray:
        """A point of these lines where it stands [m]."""
        return np.asarray(point + self.middle)

    def together(self, same: Callable[[int, int], bool]) -> list[list[int]]:
        """Groups of two or more that are pairwise the same, each line in one group."""
        left, made = list(range(len(self))), []
        while left:
            first = left[0]
            group = [first, *(k for k in left[1:] if same(first, k))]
            left = [k for k in left if k not in group]
            if len(group) > 1:
                made.append(group)
        return made

    def planes(self) -> list[tuple[list[int], FloatArray, FloatArray]]:
        """Three or more in one plane each: which, the normal, and a point of it."""
        return list(self._largest(self._planes_of_pairs(), self._is_in_plane))

    def points(self) -> list[tuple[list[int], FloatArray, FloatArray]]:
        """Three or more through one point each: which, nothing, and the point."""
        return list(self._largest(self._points_of_pairs(), self._is_through))

    def _largest(
        self,
        found: Iterator[tuple[FloatArray, FloatArray]],
        has: Callable[[int, FloatArray, FloatArray], bool],
    ) -> Iterator[tuple[list[int], FloatArray, FloatArray]]:
        seen: set[tuple[int, ...]] = set()
        for normal, point in found:
            group = [k for k in range(len(self)) if has(k, normal, point)]
            if len(group) > 2 and tuple(group) not in seen:
                seen.add(tuple(group))
                yield group, normal, point

    def _pairs(self) -> Iterator[tuple[int, int]]:
        return combinations(range(min(len(self), _MOST_LINES)), 2)

    def _planes_of_pairs(self) -> Iterator[tuple[FloatArray, FloatArray]]:
        for i, j in self._pairs():
            a, b = self.lines[i], self.lines[j]
            if self.is_one(i, j):
                continue
            if self.is_parallel(i, j):
                normal = np.cross(a.direction, b.point - a.point)
            elif self.meeting(i, j) is not None:
                normal = np.cross(a.direction, b.direction)
            else:
                continue
            yield normal / np.linalg.norm(normal), a.point

    def _points_of_pairs(self) -> Iterator[tuple[FloatArray, FloatArray]]:
        for i, j in self._pairs():
            point = self.meeting(i, j)
            if point is not None:
                yield np.zeros(3), point

    def _is_in_plane(self, k: int, normal: FloatArray, point: FloatArray) -> bool:
        line = self.lines[k]
        off = abs(float((line.point - point) @ normal))
        return bool(abs(float(line.direction @ normal)) <= _SAME and off <= _SAME * self.length)

    def _is_through(self, k: int, _: FloatArray, point: FloatArray) -> bool:
        line = self.lines[k]
        off = float(np.linalg.norm(np.cross(point - line.point, line.direction)))
        return off <= _SAME * max(self.length, float(np.linalg.norm(point)))

    def unstopped(self) -> Screw | None:
        """The one motion that a body has which is held along these lines; of rank five."""
        rows = np.array([line.coordinates(self.length) for line in self.lines])
        values, axes = np.linalg.svd(rows)[1:]
        if len(values) < 5 or int(np.count_nonzero(values > _SAME * values[0])) != 5:
            return None
        velocity, rotation = axes[5, :3], axes[5, 3:] / self.length
        return screw_of(rotation, velocity, np.zeros(3), self.length, rounding=_SAME)

    def are_skew(self) -> bool:
        """Whether no two are parallel or meet."""
        return not any(
            self.is_parallel(i, j) or self.meeting(i, j) is not None for i, j in self._pairs()
        )
