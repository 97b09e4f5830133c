# SPDX-License-Identifier: BSD-3-Clause
"""The least held deformations near a point: how far a motion is from leading anywhere.

First in a chart, where all equations but the few that rank leaves out are solved for, as a
function of the few coordinates of the null space across the motion: the valleys in which it is
small are curved, and no descent in all coordinates follows them. Then in all coordinates. Both by
Levenberg and Marquardt's method, with corrections across the motion, so that its share stays.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..analysis.velocities import Velocities
from ..core.arrays import FloatArray
from ..model.configuration import Configuration
from ..util.records import Frozen
from .chart import Chart, Near
from .constraints import Held

_MOST_STEPS, _MOST_IN_CHART = 12, 80
#: A correction below this is rounding.
_SETTLED = 2.0e-16
#: What the error must go down by, a part of what the linear model says.
_GOES_DOWN = 1.0e-4
#: Damping, times the largest singular value squared: at first, and how it changes.
_DAMPING, _MORE, _LESS, _MOST = 1.0e-3, 8.0, 0.1, 1.0e8
#: Scaled singular values up to here are zero where no rank is given.
_ZERO = 1.0e-9

Function = Callable[[FloatArray], "tuple[FloatArray, FloatArray] | None"]


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


def least_error(
    motion: Velocities | Held, direction: FloatArray, distance: float, rank: int | None = None
) -> Least:
    """The least held deformations after a distance along a motion from the reference.

    Args:
        motion: A motion, whose model holds what it holds; or what was made of its model.
        direction: (n,) of any length: `Held.direction` of the motion or of another one.
        distance: How far the node that moves farthest, by the size; in radians if it turns.
        rank: Of D(c) at the reference; by default as its scaled singular values say.
    """
    held = motion if isinstance(motion, Held) else Held(motion.data)
    known = int(np.count_nonzero(held.values(held.reference) > _ZERO)) if rank is None else rank
    chart = Chart(held, held.reference, known)
    ahead = direction * (distance / held.reach(direction))
    near = least_near(chart, ahead)
    return Least(
        held.outside(near.place.configuration),
        float(np.linalg.norm(near.place.error)),
        near.place.residual,
        float(np.linalg.norm(near.across)),
    )


def least_near(chart: Chart, ahead: FloatArray) -> Near:
    """The place of the least error after a step (n,) ahead from the middle of a chart."""
    held, along = chart.held, ahead / np.linalg.norm(ahead)
    change = _in_chart(chart, ahead, along)
    basis = across(along)

    def errors(share: FloatArray) -> tuple[FloatArray, FloatArray] | None:
        place = held.at(chart.middle, ahead + change + basis @ share)
        return (place.error, place.jacobian @ basis) if place.is_finite else None

    share = descend(errors, np.zeros(basis.shape[1]), _MOST_STEPS)
    correction = change + basis @ share
    return Near(held.at(chart.middle, ahead + correction), correction)


def _in_chart(chart: Chart, ahead: FloatArray, along: FloatArray) -> FloatArray:
    """(n,) the correction after which what rank leaves out is least, the rest being solved for."""
    beside = chart.null - np.outer(along, along @ chart.null)
    left, values, _ = np.linalg.svd(beside, full_matrices=False)
    free = left[:, values > 0.5]
    first = chart.near(ahead)
    if first is None:
        return np.zeros(ahead.size)

    def rest(share: FloatArray) -> tuple[FloatArray, FloatArray] | None:
        near = chart.near(ahead + free @ share)
        if near is None or float(np.linalg.norm(share)) > float(np.linalg.norm(ahead)):
            return None
        jacobian = near.place.jacobian
        across_null = np.linalg.solve(
            chart.left.T @ jacobian @ chart.right, chart.left.T @ jacobian @ free
        )
        slope = chart.rest.T @ jacobian @ (free - chart.right @ across_null)
        return chart.rest.T @ near.place.error, slope

    share = np.zeros(free.shape[1])
    if share.size and chart.rest.size:
        share = descend(rest, share, _MOST_IN_CHART)
    near = chart.near(ahead + free @ share) or first
    return free @ share + near.across


def across(ahead: FloatArray) -> FloatArray:
    """(n, n - 1) an orthonormal basis of all directions across a unit vector."""
    return np.asarray(np.linalg.qr(ahead[:, None], mode="complete")[0][:, 1:])


def descend(function: Function, start: FloatArray, most: int) -> FloatArray:
    """Where a function's values are least, by their norm.

    Args:
        function: Values and derivatives at a place; None where it is not defined.
        start: Where to begin.
        most: How many steps.
    """
    place, here, damping = start, function(start), _DAMPING
    for _ in range(most):
        if here is None or not here[0].any():
            break
        error, jacobian = here
        left, values, right = np.linalg.svd(jacobian, full_matrices=False)
        along, best = left.T @ error, float(error @ error)
        while damping <= _MOST:
            scale = values**2 + damping * float(values.max(initial=0.0)) ** 2
            factor = values / np.where(scale > 0.0, scale, 1.0)
            change = -right.T @ (factor * along)
            there = function(place + change)
            now = np.inf if there is None else float(there[0] @ there[0])
            promised = float(np.sum(along**2 * (1.0 - (1.0 - factor * values) ** 2)))
            if best - now > _GOES_DOWN * promised:
                break
            damping *= _MORE
        else:
            break
        settled = float(np.linalg.norm(change)) <= _SETTLED or best - now <= 1.0e-14 * best
        place, here = place + change, there
        damping *= _LESS
        if settled:
            break
    return place
