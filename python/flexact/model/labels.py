# SPDX-License-Identifier: BSD-3-Clause
"""Which deformation a row is, and which coordinate a column."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..core.arrays import ModelArrays
from ..core.elements import coordinate_name

Labels = tuple[tuple[int, str], ...]


def row_labels(arrays: ModelArrays, label: NDArray[np.integer]) -> tuple[tuple[int, int], ...]:
    """Element numbers and deformations from 1 of (2, m) their indices, both from 0."""
    numbers = arrays.element_number[label[0]].tolist()
    return tuple(zip(numbers, (label[1] + 1).tolist(), strict=True))


def column_labels(arrays: ModelArrays, label: NDArray[np.integer]) -> Labels:
    """Node numbers and coordinate names of (2, n) node indices and axes, both from 0."""
    numbers = arrays.node_number[label[0]].tolist()
    kinds = arrays.node_kind[label[0]].tolist()
    axes = label[1].tolist()
    return tuple(
        (number, coordinate_name(kind, axis))
        for number, kind, axis in zip(numbers, kinds, axes, strict=True)
    )
