# SPDX-License-Identifier: BSD-3-Clause
"""What a model is measured by, so that no digits are lost."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..core.arrays import FloatArray, ModelArrays
from ..core.elements import NodeKind

#: Of more positions than so many not all pairs are looked at.
_MANY = 1_500


class Sizes(NamedTuple):
    """What the model is measured by."""

    size: float
    """The largest distance between positions [m]; 1 where they are one point."""
    unit: float
    """The power of two next to it [m]: nothing is rounded when it is divided by."""
    middle: FloatArray
    """(3,) what is taken off all positions [m]."""


def sizes_of(arrays: ModelArrays, size: float | None = None) -> Sizes:
    """The sizes of a model; `size` in place of its own."""
    placed = arrays.node_kind <= NodeKind.POSITION
    there = arrays.node_value[:3, placed]
    if not there.size:
        return Sizes(1.0 if size is None else size, 1.0, np.zeros(3))
    low, high = there.min(axis=1), there.max(axis=1)
    across = float(_extent(there) or 1.0) if size is None else size
    unit = 2.0 ** round(math.log2(across))
    middle = low / 2 + high / 2
    # Near the origin the numbers are best left as they were typed.
    return Sizes(across, unit, np.where(np.abs(middle) > across, middle, 0.0))


def _extent(there: FloatArray) -> float:
    """The largest distance between two positions, (3, k); of many twice that to their mean.

    It does not change when the model is turned.
    """
    if there.shape[1] > _MANY:
        return 2.0 * float(np.linalg.norm(there - there.mean(axis=1, keepdims=True), axis=0).max())
    apart = there[:, :, None] - there[:, None, :]
    return float(np.sqrt((apart**2).sum(axis=0).max()))


def scaled_arrays(arrays: ModelArrays, sizes: Sizes) -> ModelArrays:
    """The arrays with positions about the middle, in the unit."""
    placed = arrays.node_kind <= NodeKind.POSITION
    value = arrays.node_value.copy(order="F")
    value[:3, placed] = (value[:3, placed] - sizes.middle[:, None]) / sizes.unit
    return arrays._replace(node_value=value)
