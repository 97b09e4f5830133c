# SPDX-License-Identifier: BSD-3-Clause
"""Position nodes by their places, within a tolerance."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from ..core.elements import is_position

if TYPE_CHECKING:
    from .places import Lookup

#: Of the size of a model: points nearer than this are at one place.
ROUNDING = 1.0e-9
#: Size of a cell of the table, in tolerances.
_CELL = 16.0


class Places:
    """Position nodes of a draft by their places, within a tolerance [m]."""

    def __init__(self, draft: Lookup, tolerance: float) -> None:
        """Of all position nodes that there are now."""
        self._draft = draft
        self._tolerance = tolerance
        self._size = _CELL * tolerance or 1.0
        self._cells: dict[tuple[int, ...], list[int]] = {}
        for number, kind in draft.node_kind.items():
            if is_position(kind):
                self.add(number)

    def add(self, number: int) -> None:
        """Take in a position node."""
        for cell in self._cells_of(self._draft.node_value[number], 0.0):
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
        found = []
        for cell in self._cells_of(place, within):
            for number in self._cells.get(cell, ()):
                value = self._draft.node_value[number]
                if all(abs(value[k] - place[k]) <= within for k in range(3)):
                    found.append(number)
        return sorted(found)


def size_of(draft: Lookup) -> float:
    """The largest coordinate of a draft [m]."""
    return max(
        (
            abs(x)
            for number, kind in draft.node_kind.items()
            if is_position(kind)
            for x in draft.node_value[number][:3]
        ),
        default=0.0,
    )
