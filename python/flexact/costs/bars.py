# SPDX-License-Identifier: BSD-3-Clause
"""What a cost shows as bars: how far each clamp may be off, in each direction, for each design."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ..show.charts import Bar, BarChart, Group, Row
from ..show.scale import log_scale
from ..show.units import told
from .designs import CostValues
from .values import Clamp, Misalignment, Tolerance

#: Clamps that are shown; of more those that bear least.
MOST_CLAMPS = 6
#: Errors beyond this part of the mechanism's size, or this angle [rad], are drawn without an end:
#: stress that is in proportion to the error means nothing there, and no workshop is that far off.
LARGEST = 0.1
#: Room behind the longest bar for its value, as a part of the axis.
_BEYOND = 0.2


def bars_of(cost: CostValues) -> tuple[BarChart, ...]:
    """Tolerances of displacements and of rotations, where there are any that matter."""
    made = (_bars(cost, "m"), _bars(cost, "rad"))
    return tuple(chart for chart in made if chart is not None)


def _bars(cost: CostValues, unit: str) -> BarChart | None:
    found = [
        {each.misalignment: each for each in design.tolerances if each.misalignment.unit == unit}
        for design in cost.designs
    ]
    limit = LARGEST * (cost.as_built.size if unit == "m" else 1.0)
    finite = [
        each.tightest.value
        for design in found
        for each in design.values()
        if each.tightest.value <= limit
    ]
    if not finite:
        return None
    clamps, left_out = _clamps(found[0])
    groups = [
        Group(
            clamp.label,
            tuple(
                Row(misalignment.direction.removeprefix("r"), _row(misalignment, found, limit))
                for misalignment in found[0]
                if misalignment.clamp == clamp
            ),
        )
        for clamp in clamps
    ]
    name, what = ("shifts", "displacement") if unit == "m" else ("turns", "rotation")
    shift = f"{100 * cost.shift:+.3g} %".replace("-", "\N{MINUS SIGN}")
    title = f"Tolerance of a clamp for {what} ({shift})"
    many = "clamp bears" if left_out == 1 else "clamps bear"
    more = f"; {left_out} more {many} more" if left_out else ""
    note = f"Arrows: more than {told(limit, unit, 2)}{more}"
    scale = log_scale(finite, unit, _BEYOND)
    return BarChart(name, title, scale, tuple(groups), note)


def _row(
    misalignment: Misalignment, found: Sequence[dict[Misalignment, Tolerance]], limit: float
) -> tuple[Bar, ...]:
    made = []
    for series, tolerances in enumerate(found):
        each = tolerances.get(misalignment)
        if each is not None:
            value, uncertainty = each.tightest
            is_open = value > limit
            made.append(Bar(series, *((math.inf, 0.0) if is_open else (value, uncertainty))))
    return tuple(made)


def _clamps(found: dict[Misalignment, Tolerance]) -> tuple[list[Clamp], int]:
    """The clamps that are shown, in their order; how many are left out."""
    least: dict[Clamp, float] = {}
    for misalignment, each in found.items():
        clamp = misalignment.clamp
        least[clamp] = min(least.get(clamp, math.inf), each.tightest.value)
    chosen = sorted(least, key=lambda clamp: least[clamp])[:MOST_CLAMPS]
    return [clamp for clamp in least if clamp in chosen], max(0, len(least) - MOST_CLAMPS)
