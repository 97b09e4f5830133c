# SPDX-License-Identifier: BSD-3-Clause
"""Rotation vectors between Euler parameters, and how they change."""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray


def rotation_between(one: FloatArray, other: FloatArray) -> FloatArray:
    """(k, 3) rotation vectors that turn Euler parameters (k, 4) into others."""
    a, u = one[:, :1], one[:, 1:]
    b, v = other[:, :1], other[:, 1:]
    scalar = b * a + np.sum(u * v, axis=1, keepdims=True)
    vector = v * a - b * u - np.cross(v, u)
    sine = np.linalg.norm(vector, axis=1, keepdims=True)
    flip = np.where(scalar < 0.0, -1.0, 1.0)
    angle = 2.0 * np.arctan2(sine, np.abs(scalar))
    size = np.where(sine > 0.0, sine, 1.0)
    factor = np.where(sine > 1.0e-9, angle / size, 2.0 / np.where(scalar == 0.0, 1.0, abs(scalar)))
    return np.asarray(flip * factor * vector)


def left_jacobian(vector: FloatArray) -> FloatArray:
    """(k, 3, 3) T(v) with exp(v + dv) = exp(T dv) exp(v), of rotation vectors (k, 3)."""
    angle = np.linalg.norm(vector, axis=1)[:, None, None]
    cross = np.zeros((len(vector), 3, 3))
    x, y, z = vector.T
    cross[:, 0, 1], cross[:, 0, 2], cross[:, 1, 2] = -z, y, -x
    cross -= np.swapaxes(cross, 1, 2)
    small = angle < 1.0e-4
    safe = np.where(small, 1.0, angle)
    first = np.where(small, 0.5 - angle**2 / 24, 0.5 * np.sinc(angle / (2 * np.pi)) ** 2)
    second = np.where(small, 1 / 6 - angle**2 / 120, (safe - np.sin(safe)) / safe**3)
    return np.asarray(np.eye(3) + first * cross + second * (cross @ cross))
