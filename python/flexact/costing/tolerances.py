# SPDX-License-Identifier: BSD-3-Clause
"""What every clamp may be off: errors at which the first frequency is shifted, and buckling.

Stresses are in proportion to the error d. The frequency omega is reached where K - omega^2 M + d G
is singular, with G of the stresses of a unit error: one eigenvalue problem an error, whatever its
size; and with omega = 0 the design buckles.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from ..core.arrays import FloatArray
from ..stiffness import Estimate
from .bench import Bench, Level
from .designs import MisalignmentCurve
from .values import Misalignment, Number, Numbers, Tolerance

#: Errors so many times the nearest are none: rounding in G.
_FAR = 1.0e6
#: Places of a curve on each side of zero, closer where it falls steeply.
_PLACES = 10
#: A design that never buckles in a direction is followed so many times as far as the tolerance.
_BEYOND = 4.0


def tolerances_of(
    bench: Bench,
    misalignments: Sequence[Misalignment],
    shift: float,
    progress: Callable[[float], None],
) -> tuple[Tolerance, ...]:
    """The tolerance of each misalignment, and where the design buckles.

    Raises:
        ElasticError: there is no answer, as of a self-stress of rigid parts.
    """
    found = []
    levels = bench.levels
    for k, level in enumerate(levels):
        stresses = level.stresses(misalignments)
        square = level.first_square * (1.0 + shift) ** 2
        pairs = []
        for j in range(len(misalignments)):
            critical = nearest(level.singular(stresses[:, :, j], 0.0))
            aimed = level.shifted(stresses[:, :, j], square, shift, critical)
            pairs.append((*aimed, *critical))
            progress((k + (j + 1) / len(misalignments)) / len(levels))
        found.append(np.array(pairs).reshape(len(misalignments), 4))
    whole = Estimate.of(*found) if len(found) == 2 else Estimate.fixed(found[0])
    return tuple(
        Tolerance(each, *(_number(whole, j, k) for k in range(4)))
        for j, each in enumerate(misalignments)
    )


def nearest(values: FloatArray) -> tuple[float, float]:
    """The errors nearest to zero below and above it; infinite without one."""
    sizes = np.abs(values)
    there = values[sizes < _FAR * sizes.min(initial=math.inf)]
    below, above = there[there < 0.0], there[there > 0.0]
    return float(below.max(initial=-math.inf)), float(above.min(initial=math.inf))


def _number(whole: Estimate, *place: int) -> Number:
    off = float(whole.uncertainty[place])
    return Number(float(whole.value[place]), off if math.isfinite(off) else 0.0)


def curve_against(bench: Bench, tolerance: Tolerance, reach: float) -> MisalignmentCurve:
    """The first frequency, or stiffness, against one misalignment, up to where it buckles.

    Args:
        bench: The design.
        tolerance: Of that misalignment.
        reach: How far it is followed where it never buckles [m, rad].
    """
    low, high = tolerance.critical_negative.value, tolerance.critical_positive.value
    ends = (max(low, -reach), min(high, reach))
    bend = np.sin(np.linspace(0.0, math.pi / 2.0, _PLACES + 1)[1:])
    values = np.concatenate([ends[0] * bend[::-1], [0.0], ends[1] * bend])
    rows = []
    for level in bench.levels:
        stress = level.stresses((tolerance.misalignment,))[:, :, 0]
        rows.append(np.array([level.measure(value * stress) for value in values.tolist()]))
    whole = Estimate.of(*rows) if len(rows) == 2 else Estimate.fixed(rows[0])
    lost = [values.size * 0 + k for k, end in ((0, low), (-1, high)) if math.isfinite(end)]
    measured = np.maximum(whole.value, 0.0)
    for k in lost:
        if values[k] in (low, high):
            measured[k] = 0.0
    return MisalignmentCurve(
        tolerance.misalignment, values, Numbers(measured, np.where(measured > 0, whole.uncertainty, 0.0))
    )
