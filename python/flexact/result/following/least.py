# SPDX-License-Identifier: BSD-3-Clause
"""The least held deformations near a point: how far a motion is from leading anywhere.

Levenberg-Marquardt on |D(x)|, with corrections across the motion, so that its share stays. The
damping is the square of the error: so it converges fast where D(x) = 0 has solutions, whether
they are isolated or not (Yamashita and Fukushima, Computing Supplement 15, 2001), and where it
has none it still goes down.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...base.frozen import Frozen
from ...core.arrays import FloatArray
from ...model.configuration import Configuration
from ..velocities import Velocities
from .held import Held, Place

_MOST_STEPS = 60
#: A correction below this is rounding.
_SETTLED = 2.0e-16
#: What the error must go down by, a part of what the linear model says.
_GOES_DOWN = 1.0e-4
#: Damping, times the square of the error: at first, and how it changes.
_DAMPING, _MORE, _LESS, _MOST = 1.0, 8.0, 0.2, 1.0e12


@dataclass(frozen=True, eq=False)
class Least(Frozen):
    """Where the held deformations are least, of all places across a motion.

    Attributes:
        configuration: There, in metres.
        error: Norm of the held deformations, lengths by the size, angles in radians.
        largest: The largest of them, likewise.
        correction: How far it is from where the motion itself leads, displacements by the size,
            rotations in radians.
    """

    configuration: Configuration
    error: float
    largest: float
    correction: float


def least_error(motion: Velocities | Held, direction: FloatArray, distance: float) -> Least:
    """The least held deformations after a distance along a motion from the reference.

    Args:
        motion: A motion, whose model holds what it holds; or what was made of its model.
        direction: (n,) of any length: `Held.direction` of the motion or of another one.
        distance: How far the node that moves farthest, by the size; in radians if it turns.
    """
    held = motion if isinstance(motion, Held) else Held(motion.data)
    ahead = direction / np.linalg.norm(direction)
    step = ahead * (distance / held.reach(ahead))
    place, change = descend(held, held.reference, step, across(ahead))
    return Least(
        held.outside(place.configuration),
        float(np.linalg.norm(place.error)),
        place.residual,
        float(np.linalg.norm(change)),
    )


def across(ahead: FloatArray) -> FloatArray:
    """(n, n - 1) an orthonormal basis of all directions across a unit vector."""
    return np.asarray(np.linalg.qr(ahead[:, None], mode="complete")[0][:, 1:])


def descend(
    held: Held, start: Configuration, ahead: FloatArray, basis: FloatArray, most: int = _MOST_STEPS
) -> tuple[Place, FloatArray]:
    """The place of the least error after a step (n,) ahead, corrected within a basis (n, k).

    Returns:
        The place, and the correction (n,).
    """
    share = np.zeros(basis.shape[1])
    here, damping = held.at(start, ahead), _DAMPING
    if not here.is_finite:
        return here, basis @ share
    best = float(here.error @ here.error)
    for _ in range(most):
        if best == 0.0 or damping > _MOST:
            break
        left, values, right = np.linalg.svd(here.jacobian @ basis, full_matrices=False)
        along = left.T @ here.error
        while damping <= _MOST:
            factor = values / (values**2 + damping * best + np.finfo(float).tiny)
            change = -right.T @ (factor * along)
            there = held.at(start, ahead + basis @ (share + change))
            error = float(there.error @ there.error) if there.is_finite else np.inf
            promised = float(np.sum(along**2 * (1.0 - (1.0 - factor * values) ** 2)))
            if best - error >= _GOES_DOWN * promised:
                break
            damping *= _MORE
        else:
            break
        settled = float(np.linalg.norm(change)) <= _SETTLED or best - error <= 1.0e-14 * best
        share, here, best = share + change, there, error
        damping = max(damping * _LESS, 1.0e-12)
        if settled:
            break
    return here, basis @ share
