# SPDX-License-Identifier: BSD-3-Clause
"""Names of designs that are short enough to stand at a curve."""

from __future__ import annotations

from .designs import CostValues

#: The longest label that stands at a curve.
_LONGEST = 11


def short_labels(cost: CostValues) -> tuple[str, ...]:
    """What stands at the curves and bars of designs: their labels, or letters if one is long."""
    labels = [each.label for each in cost.designs]
    if max(map(len, labels)) <= _LONGEST:
        return tuple(labels)
    return (labels[0], *(chr(ord("A") + k) for k in range(len(labels) - 1)))
