# SPDX-License-Identifier: BSD-3-Clause
"""Position nodes by their places, within a tolerance."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from ..core.elements import is_position

if TYPE_CHECKING:
    from .lookup import Lookup

#: Of the size of a model: points nearer than this are at one place.
ROUNDING = 1.0e-9


class Places:
    """Position nodes of a draft by their places, within a tolerance [m]."""

    def __init__(self, draft: Lookup, tolerance: float) -> None:
        """Of all position nodes that there are now."""
        self._draft = draft
        self._tolerance = tolerance
        self._cells: dict[tuple[int, ...], list[int]] = {}
        for number, kind in draft.node_kind.items():
            if is_position(kind):
                self.add(number)

    def add(self, number: int) -> None:
        """Take in a position node."""
        self._cells.setdefault(self._cell(self._draft.node_value[number]), []).append(number)

    def _cell(self, place: Iterable[float]) -> tuple[int, ...]:
        size = 4.0 * self._tolerance or 1.0
        return tuple(round(x / size) for x in itertools.islice(place, 3))

    def near(self, place: Sequence[float], tolerance: float | None = None) -> list[int]:
        """Numbers of the nodes at a place, in the order they were made.

        Args:
            place: (x, y, z) [m].
            tolerance: At most twice that of all [m]; by default that.
        """
        within = self._tolerance if tolerance is None else tolerance
        cell = self._cell(place)
        found = []
        for offset in itertools.product((-1, 0, 1), repeat=3):
            key = tuple(a + b for a, b in zip(cell, offset, strict=True))
            for number in self._cells.get(key, []):
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
