# SPDX-License-Identifier: BSD-3-Clause
"""Along a path without strain, step by step, both ways."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from .held import Held, Place
from .settling import beside, least_along, settled

#: How far a path is followed, in parts of the size, and in how large steps.
GOAL, _STEP, _LEAST_STEP = 0.1, 0.02, 2.0e-4
#: Strain on a path, in parts of the size.
LARGEST_STRAIN = 1.0e-12
#: Corrections of a step may be this part of it.
_FARTHEST = 0.5
#: Where a motion has gone so far, others that it takes along have gone this part of it at most.
_NEAR, _BESIDE = 1.0e-4, 0.05
#: Singular values below this part of the largest belong to directions that stay.
_CUT = 1.0e-4


class Walk(NamedTuple):
    """How far a path was followed one way."""

    gone: float
    """Largest displacement or rotation, in parts of the size."""
    strain: float
    """The largest on the path."""
    ends: Place

    @property
    def arrived(self) -> bool:
        """Whether it went as far as it was to go."""
        return self.gone >= GOAL * (1.0 - 1.0e-9)


def walk(held: Held, motion: FloatArray, sign: float, floor: float) -> Walk:
    """Follow a motion one way.

    Args:
        held: What is held.
        motion: (n,) unit vector in the space of motions.
        sign: 1 or -1.
        floor: What the rounding of the geometry strains for each unit of the way.
    """
    here, ahead, gone, worst = held.reference, sign * motion, 0.0, 0.0
    sideways = held.motions.shape[1] > 1
    if sideways and not _begins(held, motion, sign, floor):
        return Walk(0.0, 0.0, here)
    step = _STEP
    while gone < GOAL:
        # From where several motions begin there may be several ways on.
        found = (
            least_along(held, motion, sign * step, sideways=True)
            if sideways and not gone
            else settled(held, held.moved(here, step * ahead), ahead)
        )
        limit = LARGEST_STRAIN + 10.0 * floor * (gone + step)
        if found is None or found.strain > limit or found.went > _FARTHEST * step:
            step /= 2.0
            if step < _LEAST_STEP:
                break
            continue
        way = held.from_reference(found.place) - held.from_reference(here)
        gone += held.largest(way)
        here, worst = found.place, max(worst, found.strain)
        ahead = _onward(held, here, ahead)
        step = min(2.0 * step, _STEP)
    return Walk(gone, worst, here)


def _begins(held: Held, motion: FloatArray, sign: float, floor: float) -> bool:
    """Whether there is a path near, on which other motions fall behind."""
    found = least_along(held, motion, sign * _NEAR, sideways=True)
    if found is None or found.strain > LARGEST_STRAIN / 100.0 + 10.0 * floor * _NEAR:
        return False
    return beside(held, found.place, motion, sign * _NEAR) <= _BESIDE


def _onward(held: Held, here: Place, ahead: FloatArray) -> FloatArray:
    """The direction in which a path goes on: the last one within the null space."""
    _, jacobian = held.at(here)
    along = ahead - np.linalg.lstsq(jacobian, jacobian @ ahead, rcond=_CUT)[0]
    length = float(np.linalg.norm(along))
    return np.asarray(along / length) if length > _FARTHEST else ahead
