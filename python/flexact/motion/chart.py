# SPDX-License-Identifier: BSD-3-Clause
"""The configurations near one of a path, by coordinates in its null space.

D(c) = U S V' there, of rank r. A change of the coordinates is split into one in the null space,
which is given, and one across it, for which U' D = 0 (r equations) is solved by Newton's method.
That has a solution by the implicit function theorem. It is on a path if the rest of D is zero,
too: with self-stresses that has to be looked at (Lyapunov and Schmidt).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from ..model.configuration import Configuration
from .constraints import Held, Place

_MOST_STEPS = 12
#: A correction below this part of the size is rounding, where it no longer gets smaller.
_SETTLED = 1.0e-15
_ROUNDING = 1.0e-11
#: Corrections have to get smaller by this.
_SHRINKS = 0.6


class Near(NamedTuple):
    """A place near the middle of a chart."""

    place: Place
    across: FloatArray
    """(n,) the change of the coordinates that is not in the null space."""


class Chart:
    """Coordinates of the configurations near one."""

    def __init__(self, held: Held, middle: Configuration, rank: int) -> None:
        """Decompose D(c) there, of a given rank."""
        self.held, self.middle = held, middle
        left, _, right = np.linalg.svd(held.at(middle).jacobian)
        self.left, self.rest = left[:, :rank], left[:, rank:]
        self.right, self.null = right[:rank].T, right[rank:].T

    def near(self, ahead: FloatArray) -> Near | None:
        """The place after a change (n,) in the null space; None where Newton finds none."""
        share, last = np.zeros(self.right.shape[1]), np.inf
        for _ in range(_MOST_STEPS):
            across = self.right @ share
            place = self.held.at(self.middle, ahead + across)
            if not place.is_finite:
                return None
            try:
                change = np.linalg.solve(
                    self.left.T @ place.jacobian @ self.right, self.left.T @ place.error
                )
            except np.linalg.LinAlgError:
                return None
            now = float(np.linalg.norm(change))
            if now <= _SETTLED or (now <= _ROUNDING and now > _SHRINKS * last):
                return Near(place, across)
            if now > max(_SHRINKS * last, _ROUNDING) or not np.isfinite(now):
                return None
            share, last = share - change, now
        return None
