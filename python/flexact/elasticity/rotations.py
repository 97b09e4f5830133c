# SPDX-License-Identifier: BSD-3-Clause
"""Single rotations: vectors, Euler parameters and matrices."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..core.arrays import FloatArray


class Angle(float):
    """An angle [rad]: a number, and a vector of one where positions are gone through alike."""

    def __getitem__(self, index: int) -> float:
        """The number."""
        return (float(self),)[index]

    def __iter__(self) -> Iterator[float]:
        """The number, once."""
        yield float(self)

    def __len__(self) -> int:
        """One."""
        return 1


def vector_of(euler: FloatArray) -> FloatArray:
    """(3,) rotation vector [rad] of Euler parameters (4,), angles up to pi."""
    unit = euler / np.linalg.norm(euler) * (1.0 if euler[0] >= 0.0 else -1.0)
    sine = float(np.linalg.norm(unit[1:]))
    if sine == 0.0:
        return np.zeros(3)
    made: FloatArray = unit[1:] * (2.0 * math.atan2(sine, unit[0]) / sine)
    return made


def dual_to_parameters(euler: FloatArray, moment: FloatArray) -> FloatArray:
    """(3,) what does work on twice the changes of lambda1..3, of a moment (3,) on the spin.

    The spin is 2 (l0 dl - dl0 l - dl x l) with dl0 = -(l . dl)/l0.
    """
    unit = euler / np.linalg.norm(euler)
    scalar, vector = unit[0], unit[1:]
    made: FloatArray = (
        scalar * moment + (vector @ moment) / scalar * vector - np.cross(vector, moment)
    )
    return made


def turn_about(axis: int, angle: float) -> FloatArray:
    """(3, 3) rotation about a global axis by an angle [rad]."""
    made = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    c, s = math.cos(angle), math.sin(angle)
    made[[i, i, j, j], [i, j, i, j]] = c, -s, s, c
    return made


def turned(euler: FloatArray, axis: int, angle: float) -> FloatArray:
    """(4,) Euler parameters after a further rotation about a global axis."""
    scalar, vector = math.cos(angle / 2.0), np.eye(3)[axis] * math.sin(angle / 2.0)
    made = np.empty(4)
    made[0] = scalar * euler[0] - vector @ euler[1:]
    made[1:] = scalar * euler[1:] + euler[0] * vector + np.cross(vector, euler[1:])
    return made
