# SPDX-License-Identifier: BSD-3-Clause
"""Motions and self-stresses of a variant as plain arrays."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..analysis.result import Result
from ..core.arrays import FloatArray


class MotionArrays(NamedTuple):
    """The motions of a variant, as `Result.motions` has them; as many as are given there."""

    displacement: FloatArray
    """(motions, nodes, 3) [m]; zero for orientations."""
    rotation: FloatArray
    """(motions, nodes, 3) [rad]; zero for positions that have none."""


class StressArrays(NamedTuple):
    """The self-stresses of a variant, as `Result.self_stresses` has them."""

    forces: FloatArray
    """(self-stresses, elements, 6) by deformation [N]."""
    moments: FloatArray
    """(self-stresses, elements, 6) by deformation [N m]."""


NO_MOTIONS = MotionArrays(np.zeros((0, 0, 3)), np.zeros((0, 0, 3)))
NO_STRESSES = StressArrays(np.zeros((0, 0, 6)), np.zeros((0, 0, 6)))


def modes_of(result: Result) -> tuple[MotionArrays, StressArrays]:
    """The arrays of one result."""
    nodes = result.given.arrays.node_number.size
    elements = result.given.arrays.element_number.size
    motions, stresses = tuple(result.motions), tuple(result.self_stresses)
    return (
        MotionArrays(
            _stacked([each.displacement for each in motions], nodes, 3),
            _stacked([each.rotation for each in motions], nodes, 3),
        ),
        StressArrays(
            _stacked([each.forces for each in stresses], elements, 6),
            _stacked([each.moments for each in stresses], elements, 6),
        ),
    )


def _stacked(arrays: list[FloatArray], rows: int, columns: int) -> FloatArray:
    return np.array(arrays, float).reshape(len(arrays), rows, columns)
