# SPDX-License-Identifier: BSD-3-Clause
"""Steps along a motion that end where the held deformations are least, whether zero or not.

Gauss-Newton steps of least norm across the motion. Directions in which hardly anything is held
are left alone, so that in a null space of several dimensions nothing but the motion moves.
"""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray
from .constraints import Held, Place

#: Steps back, and the correction [size] that ends them.
_MOST_STEPS = 12
_SETTLED = 1.0e-11
#: Singular values below this part of the largest belong to directions that stay.
_CUT = 1.0e-4
#: The corrections of a step may be this part of the step itself.
_FARTHEST = 0.5


def settle(held: Held, start: Place, ahead: FloatArray, step: float) -> Place | None:
    """The place after a step, where the held deformations are least; None without any near.

    Args:
        held: What is held.
        start: Where the step begins.
        ahead: (n,) its direction, of norm one.
        step: Its length.
    """
    here, went = held.at(start.configuration, step * ahead), 0.0
    for _ in range(_MOST_STEPS):
        if not here.is_finite:
            return None
        # Corrections are across the motion, so that its share stays.
        across = here.jacobian - np.outer(here.jacobian @ ahead, ahead)
        back = np.asarray(-np.linalg.lstsq(across, here.error, rcond=_CUT)[0], np.float64)
        correction = float(np.linalg.norm(back))
        if correction <= _SETTLED:
            return here
        went += correction
        if went > _FARTHEST * step:
            return None
        here = held.at(held.moved(here.configuration, back))
    return None


def onward(here: Place, direction: FloatArray) -> FloatArray:
    """The direction in which it goes on: the last one within the null space."""
    back = np.linalg.lstsq(here.jacobian, here.jacobian @ direction, rcond=_CUT)[0]
    along = direction - back
    length = float(np.linalg.norm(along))
    return np.asarray(along / length) if length > _FARTHEST else direction
