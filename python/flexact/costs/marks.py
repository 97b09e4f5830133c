# SPDX-License-Identifier: BSD-3-Clause
"""Special places of the curve against a misalignment: what is allowed, and where it buckles."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ..core.arrays import FloatArray
from ..show.charts import Curve, Mark
from ..show.units import told
from .designs import CostValues, Design
from .values import Tolerance

#: Two values that differ by less than this part of them mirror each other.
_MIRRORED = 0.02


def marks_of(cost: CostValues, curve: Curve) -> Iterable[Mark]:
    """Where the design as built is shifted by what is allowed, and where it buckles.

    Args:
        cost: The cost.
        curve: The first of its chart.
    """
    found = _tolerance(cost.as_built)
    if found is None or curve.series != 0:
        return
    shift = f"{100 * cost.shift:+.3g} %".replace("-", "\N{MINUS SIGN}")
    for words, pair in (
        ("buckles at", (found.critical_negative, found.critical_positive)),
        (f"{shift} at", (found.negative, found.positive)),
    ):
        values = [each.value for each in pair if _is_within(each.value, curve.x)]
        yield from _marked(curve, words, values, found.misalignment.unit)


def _is_within(value: float, x: FloatArray) -> bool:
    room = 1e-3 * float(x[-1] - x[0])
    return bool(x[0] - room <= value <= x[-1] + room)


def _marked(curve: Curve, words: str, values: Sequence[float], unit: str) -> Iterable[Mark]:
    """One mark for two values that mirror each other, else one each."""
    points = [(value, float(np.interp(value, curve.x, curve.y))) for value in values]
    if len(values) == 2 and abs(sum(values)) < _MIRRORED * abs(values[1]):
        yield Mark(curve.series, tuple(points), f"{words} ±{told(values[1], unit)}")
    else:
        for value, point in zip(values, points, strict=True):
            yield Mark(curve.series, (point,), f"{words} {told(value, unit)}")


def _tolerance(design: Design) -> Tolerance | None:
    """That of the misalignment which is drawn."""
    wanted = None if design.curve is None else design.curve.misalignment
    return next((each for each in design.tolerances if each.misalignment == wanted), None)
