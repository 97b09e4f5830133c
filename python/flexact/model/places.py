# SPDX-License-Identifier: BSD-3-Clause
"""Points of a draft by their places, and points that rigid links join."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence

from ..core.elements import is_position

#: Of the size of a model: points nearer than this are at one place.
ROUNDING = 1.0e-9
#: Size of a cell of the table, in tolerances.
_CELL = 16.0


class Places:
    """Position nodes by their places, within a tolerance [m]."""

    def __init__(
        self,
        kinds: Mapping[int, int],
        values: Mapping[int, tuple[float, ...]],
        tolerance: float,
    ) -> None:
        """Of all position nodes that there are now; `values` may grow later."""
        self._values = values
        self._tolerance = tolerance
        self._size = _CELL * tolerance or 1.0
        self._cells: dict[tuple[int, ...], list[int]] = {}
        for number, kind in kinds.items():
            if is_position(kind):
                self.add(number)

    def add(self, number: int) -> None:
        """Take in a position node."""
        for cell in self._cells_of(self._values[number], 0.0):
            self._cells.setdefault(cell, []).append(number)

    def _cells_of(self, place: Sequence[float], within: float) -> Iterable[tuple[int, ...]]:
        """The cells that are met within a distance of a place: nearly always one."""
        size = self._size
        x, y, z = place[0] / size, place[1] / size, place[2] / size
        i, j, k = cell = round(x), round(y), round(z)
        inside = 0.5 - within / size
        if abs(x - i) < inside and abs(y - j) < inside and abs(z - k) < inside:
            return (cell,)
        near = within / size
        return itertools.product(*({round(v - near), round(v + near)} for v in (x, y, z)))

    def near(self, place: Sequence[float], tolerance: float | None = None) -> list[int]:
        """Numbers of the nodes at a place, in the order they were made.

        Args:
            place: (x, y, z) [m].
            tolerance: Of a few times that of all [m]; by default that.
        """
        within = self._tolerance if tolerance is None else tolerance
        return sorted(
            number
            for cell in self._cells_of(place, within)
            for number in self._cells.get(cell, ())
            if all(abs(self._values[number][k] - place[k]) <= within for k in range(3))
        )


class RigidComponents:
    """Points joined by rigid links, as sets that are merged.

    A point is known by the number of its orientation; a point that a link of a deck carries
    without its orientation (RBEAM) by its position number, negative.

    Attributes:
        seen: How many elements of the draft were looked at.
    """

    def __init__(self) -> None:
        """Of no elements so far."""
        self.seen = 0
        self._parent: dict[int, int] = {}
        self._anchor: dict[int, tuple[int, int]] = {}

    def add(self, slots: tuple[int, int, int, int]) -> None:
        """Take in a rigid link between these nodes."""
        p, op, q, oq = slots
        if not oq:
            self._anchor[-q] = p, op
        self._parent[self._root(op)] = self._root(oq or -q)

    def _root(self, key: int) -> int:
        self._parent.setdefault(key, key)
        while (above := self._parent[key]) != key:
            self._parent[key] = self._parent[above]
            key = above
        return key

    def carrier(self, position: int, orientation: int) -> tuple[int, int]:
        """The point with an orientation by which a link takes hold of the body of a point."""
        point = position, orientation
        return point if orientation in self._parent else self._anchor.get(-position, point)

    def joined(self, a: int, b: int) -> bool:
        """Whether one body carries both points, given by orientations of their carriers."""
        return self._root(a) == self._root(b)
