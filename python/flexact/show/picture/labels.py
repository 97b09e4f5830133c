# SPDX-License-Identifier: BSD-3-Clause
"""Where words and axes may stand in a picture: beside the mechanism and beside each other."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...core.arrays import FloatArray
from .canvas import Canvas

#: How far round a place is looked for room: distances [px], and so many directions.
_FAR = np.arange(14.0, 190.0, 8.0)
_WAYS = 16


class Room:
    """What is free of a panel, in pixels from its lower left corner."""

    def __init__(self, axes: Any, canvas: Canvas) -> None:
        """Find out where something is drawn."""
        first, last = canvas.boxes()
        self._low, self._high = axes.bbox.min, axes.bbox.max
        if len(first):
            self.first, self.last = axes.transData.transform(first), axes.transData.transform(last)
        else:
            self.first = self.last = np.zeros((0, 2))

    def is_free(self, middle: FloatArray, half: FloatArray) -> bool:
        """Whether a box lies in the panel, and nothing in it."""
        low, high = middle - half, middle + half
        if np.any(low < self._low) or np.any(high > self._high):
            return False
        return not np.any(np.all((self.first < high) & (self.last > low), axis=1))

    def take(self, middle: FloatArray, half: FloatArray) -> None:
        """Say that a box is full now."""
        self.first = np.concatenate((self.first, (middle - half)[None]))
        self.last = np.concatenate((self.last, (middle + half)[None]))

    def near(self, place: FloatArray, away: FloatArray, half: FloatArray) -> FloatArray | None:
        """The free box of this half size nearest to a place; None where there is none near.

        Of equally near ones that which lies most in the direction `away`.
        """
        start = np.arctan2(away[1], away[0])
        turns = np.array(
            [0.0, *(s * k for k in range(1, _WAYS // 2) for s in (1.0, -1.0)), _WAYS / 2]
        )
        for far in _FAR:
            for angle in start + 2 * np.pi / _WAYS * turns:
                middle = place + far * np.array((np.cos(angle), np.sin(angle)))
                if self.is_free(middle, half):
                    return np.asarray(middle)
        return None
