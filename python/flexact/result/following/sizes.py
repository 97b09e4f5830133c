# SPDX-License-Identifier: BSD-3-Clause
"""What a model is measured by, so that no digits are lost."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray, ModelArrays
from ...core.elements import NodeKind


class Sizes(NamedTuple):
    """What the model is measured by."""

    size: float
    """Diagonal of the box round all positions [m]; 1 where they are one point."""
    unit: float
    """The power of two next to it [m]: nothing is rounded when it is divided by."""
    middle: FloatArray
    """(3,) what is taken off all positions [m]."""


def sizes_of(arrays: ModelArrays) -> Sizes:
    """The sizes of a model."""
    placed = arrays.node_kind <= NodeKind.POSITION
    there = arrays.node_value[:3, placed]
    if not there.size:
        return Sizes(1.0, 1.0, np.zeros(3))
    low, high = there.min(axis=1), there.max(axis=1)
    size = float(np.linalg.norm(high - low)) or 1.0
    unit = 2.0 ** round(math.log2(size))
    middle = low / 2 + high / 2
    # Near the origin the numbers are best left as they were typed.
    return Sizes(size, unit, np.where(np.abs(middle) > size, middle, 0.0))


def scaled_arrays(arrays: ModelArrays, sizes: Sizes) -> ModelArrays:
    """The arrays with positions about the middle, in the unit."""
    placed = arrays.node_kind <= NodeKind.POSITION
    value = arrays.node_value.copy(order="F")
    value[:3, placed] = (value[:3, placed] - sizes.middle[:, None]) / sizes.unit
    return arrays._replace(node_value=value)
