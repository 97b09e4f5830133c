# SPDX-License-Identifier: BSD-3-Clause
"""What every clamp may be off: errors at which the first frequency is shifted, and buckling.

Stresses are in proportion to the error d. A frequency omega is reached where
K - omega^2 M + d G is singular, with G of the stresses of a unit error: one eigenvalue problem an
error, whatever its size; and with omega = 0 the design buckles.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from ..core.arrays import FloatArray
from ..elasticity import Estimate
from .designs import Misalignment, MisalignmentCurve, Number, Numbers, Tolerance
from .elastic_design import ElasticDesign

#: Errors of so many sizes of the model, or radians, are none that anybody makes, and far beyond
#: where the stress is in proportion to them.
FAR = 0.1
#: A design that buckles within so many times the reach is followed until it does.
_NEAR = 1.5
#: Places of a curve on each side of zero, closer where it falls steeply; few where it does not
#: fall to zero.
_PLACES, _FEW_PLACES = 9, 3


def tolerances_of(
    mechanism: ElasticDesign,
    misalignments: Sequence[Misalignment],
    shift: float,
    size: float,
    progress: Callable[[float], None],
) -> tuple[Tolerance, ...]:
    """The tolerance of each misalignment, and where the design buckles.

    Those that rigid parts cannot follow are left out: nothing can be off so.

    Args:
        mechanism: The design.
        misalignments: Of which clamps, in which directions.
        shift: Of the first frequency, relative.
        size: Of the model [m].
        progress: Called with the part that is done.

    Raises:
        ElasticError: there is no answer, as of a self-stress of rigid parts.
    """
    found, able = [], np.ones(len(misalignments), bool)
    for k, level in enumerate(mechanism.levels):
        square = level.first_square * (1.0 + shift) ** 2
        stresses = level.stresses(misalignments)
        able &= np.isfinite(stresses).all(axis=(0, 1))
        stresses = np.asfortranarray(stresses[:, :, able])
        critical = level.errors(stresses, 0.0)
        progress((k + 0.5) / len(mechanism.levels))
        if shift < 0.0:
            aimed = level.errors(stresses, square)
        else:
            some = [each for each, fits in zip(misalignments, able, strict=True) if fits]
            aimed = np.array([level.rising(each, shift) for each in some]).reshape(-1, 2)
        found.append(np.concatenate([aimed, critical], axis=1))
        progress((k + 1.0) / len(mechanism.levels))
    kept = [each for each, fits in zip(misalignments, able, strict=True) if fits]
    whole = extrapolated(found)
    return tuple(
        Tolerance(each, *(_number(whole, j, k, size, each.unit) for k in range(4)))
        for j, each in enumerate(kept)
    )


def extrapolated(found: Sequence[FloatArray]) -> Estimate:
    """From one or two numbers of beams."""
    return Estimate.of(*found) if len(found) == 2 else Estimate.fixed(found[0])


def _number(whole: Estimate, row: int, column: int, size: float, unit: str) -> Number:
    value, off = (float(each[row, column]) for each in (whole.value, whole.uncertainty))
    if abs(value) > FAR * (size if unit == "m" else 1.0):
        return Number(math.copysign(math.inf, value))
    return Number(value, off if math.isfinite(off) else 0.0)


def curve_against(
    mechanism: ElasticDesign, tolerance: Tolerance, reach: float
) -> MisalignmentCurve:
    """The first frequency, or stiffness, against one misalignment, up to where it buckles.

    Args:
        mechanism: The design.
        tolerance: Of that misalignment.
        reach: How far it is followed where it does not buckle before, about [m, rad].
    """
    low, high = tolerance.critical_negative.value, tolerance.critical_positive.value
    first, last = (
        end if abs(end) <= _NEAR * reach else math.copysign(reach, end) for end in (low, high)
    )
    values = np.concatenate([_places(first, low)[::-1], [0.0], _places(last, high)])
    rows = []
    for level in mechanism.levels:
        stress = level.stresses((tolerance.misalignment,))[:, :, 0]
        rows.append(np.array([level.measure(value * stress) for value in values.tolist()]))
    whole = extrapolated(rows)
    is_lost = (values <= low) | (values >= high)
    measure = np.where(is_lost, 0.0, np.maximum(whole.value, 0.0))
    return MisalignmentCurve(
        tolerance.misalignment,
        values,
        Numbers(measure, np.where(measure > 0.0, whole.uncertainty, 0.0)),
    )


def _places(end: float, critical: float) -> FloatArray:
    """Errors from near zero to an end: more of them where the design buckles there."""
    count = _PLACES if end == critical else _FEW_PLACES
    made: FloatArray = end * np.sin(np.linspace(0.0, math.pi / 2.0, count + 1)[1:])
    return made
