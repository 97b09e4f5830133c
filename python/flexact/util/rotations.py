# SPDX-License-Identifier: BSD-3-Clause
"""Rotations of many nodes at once: matrices, rotation vectors and Euler parameters."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

#: Below this, sines of angles are as good as nothing.
_SMALL = 1.0e-12


def unit(vectors: FloatArray) -> FloatArray:
    """Vectors (..., 3) of unit length; zero ones stay zero."""
    size = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.asarray(vectors / np.where(size > 0.0, size, 1.0))


def cross(one: FloatArray, other: FloatArray) -> FloatArray:
    """(..., 3) vector products; of a few vectors numpy's own takes ten times as long."""
    return np.asarray(one[..., _ON] * other[..., _BACK] - one[..., _BACK] * other[..., _ON])


_ON, _BACK = [1, 2, 0], [2, 0, 1]


def frames_along(ex: FloatArray) -> FloatArray:
    """(k, 3, 3) frames with unit vectors ex (k, 3); ey towards the axis least along each."""
    axis = np.eye(3)[np.argmin(np.abs(ex), axis=1)]
    ey = unit(axis - np.sum(ex * axis, axis=1, keepdims=True) * ex)
    return np.stack((ex, ey, np.cross(ex, ey)), axis=-1)


def matrix_of(rotation: FloatArray) -> FloatArray:
    """Matrices (..., 3, 3) of rotation vectors (..., 3) [rad], by Rodrigues' formula."""
    half = np.linalg.norm(rotation, axis=-1) / 2
    share = np.sinc(half / np.pi)
    sine, versine = share * np.cos(half), share**2 / 2
    made = np.empty((*rotation.shape, 3))
    for k, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
        made[..., k, k] = 1 - versine * (rotation[..., i] ** 2 + rotation[..., j] ** 2)
        both, own = versine * rotation[..., i] * rotation[..., j], sine * rotation[..., k]
        made[..., i, j], made[..., j, i] = both - own, both + own
    return made


def screw_matrix(rotation: FloatArray) -> FloatArray:
    """(..., 3, 3): times a velocity, the translation of a screw with this rotation vector.

    The integral of the rotation over the time from 0 to 1.
    """
    angle = np.linalg.norm(rotation, axis=-1)[..., None, None]
    skew = _skew(rotation)
    versine = np.sinc(angle / (2 * np.pi)) ** 2 / 2
    safe = np.where(angle > 1.0e-3, angle, 1.0)
    third = np.where(angle > 1.0e-3, (safe - np.sin(safe)) / safe**3, 1 / 6 - angle**2 / 120)
    return np.asarray(np.eye(3) + versine * skew + third * (skew @ skew))


def vector_of(matrix: FloatArray) -> FloatArray:
    """Rotation vectors (..., 3) [rad] of matrices (..., 3, 3), angles below pi."""
    return vector_of_euler(euler_of(matrix))


def vector_of_euler(euler: FloatArray) -> FloatArray:
    """Rotation vectors (..., 3) [rad] of Euler parameters (..., 4) of unit norm, up to pi."""
    scalar, vector = euler[..., :1], euler[..., 1:]
    sine = np.linalg.norm(vector, axis=-1, keepdims=True)
    angle = 2 * np.arctan2(sine, np.abs(scalar))
    factor = np.where(sine > _SMALL, angle / np.where(sine > _SMALL, sine, 1.0), 2.0)
    return np.asarray(np.where(scalar < 0.0, -1.0, 1.0) * factor * vector)


def vector_between(one: FloatArray, other: FloatArray) -> FloatArray:
    """(k, 3) rotation vectors that turn Euler parameters (k, 4) into others."""
    a, u = one[:, :1], one[:, 1:]
    b, v = other[:, :1], other[:, 1:]
    scalar = b * a + np.sum(u * v, axis=1, keepdims=True)
    return vector_of_euler(np.hstack([scalar, v * a - b * u - cross(v, u)]))


def turned(euler: FloatArray, rotation: FloatArray) -> FloatArray:
    """Euler parameters (k, 4) after a further rotation by vectors (k, 3)."""
    half = 0.5 * np.sqrt(np.einsum("kx,kx->k", rotation, rotation))[:, None]
    scalar, vector = np.cos(half), rotation * (0.5 * _sine_over(half))
    old_scalar, old_vector = euler[:, :1], euler[:, 1:]
    made = np.empty_like(euler)
    made[:, :1] = scalar * old_scalar - np.einsum("kx,kx->k", vector, old_vector)[:, None]
    made[:, 1:] = scalar * old_vector + old_scalar * vector + cross(vector, old_vector)
    return made


def _sine_over(angle: FloatArray) -> FloatArray:
    """Sines of angles over these."""
    safe = np.where(angle == 0.0, 1.0, angle)
    return np.asarray(np.where(angle == 0.0, 1.0, np.sin(safe) / safe))


def left_jacobian(vector: FloatArray) -> FloatArray:
    """(k, 3, 3) T(v) with exp(v + dv) = exp(T dv) exp(v), of rotation vectors (k, 3)."""
    square = np.einsum("kx,kx->k", vector, vector)[:, None]
    angle = np.sqrt(square)
    small, half = angle < 1.0e-4, 0.5 * _sine_over(0.5 * angle) ** 2
    safe = np.where(small, 1.0, angle)
    third = np.where(small, 1 / 6 - square / 120, (safe - np.sin(safe)) / safe**3)
    first = half * vector
    # The square of the matrix of a cross product is v v' - |v|^2.
    made = (third * vector)[:, :, None] * vector[:, None, :]
    straight = 1.0 - third[:, 0] * square[:, 0]
    for k, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
        made[:, k, k] += straight
        made[:, j, i] += first[:, k]
        made[:, i, j] -= first[:, k]
    return np.asarray(made)


def euler_of(matrix: FloatArray) -> FloatArray:
    """Euler parameters (..., 4) of matrices (..., 3, 3), the first not negative.

    The largest of the four is found from the diagonal, the others from it.
    """
    m = matrix
    trace = np.trace(m, axis1=-2, axis2=-1)
    diagonal = np.diagonal(m, axis1=-2, axis2=-1)
    squares = np.concatenate((1 + trace[..., None], 1 - trace[..., None] + 2 * diagonal), axis=-1)
    largest = np.argmax(squares, axis=-1)
    products = np.empty((*trace.shape, 4, 4))
    a, b, c = m[..., 2, 1], m[..., 0, 2], m[..., 1, 0]
    d, e, f = m[..., 1, 2], m[..., 2, 0], m[..., 0, 1]
    for i, row in enumerate(
        (
            (squares[..., 0], a - d, b - e, c - f),
            (a - d, squares[..., 1], c + f, b + e),
            (b - e, c + f, squares[..., 2], a + d),
            (c - f, b + e, a + d, squares[..., 3]),
        )
    ):
        for j, value in enumerate(row):
            products[..., i, j] = value
    row_of = np.take_along_axis(products, largest[..., None, None], axis=-2)[..., 0, :]
    made = row_of / np.linalg.norm(row_of, axis=-1, keepdims=True)
    return np.asarray(np.where(made[..., :1] < 0, -made, made))


def matrix_of_euler(euler: FloatArray) -> FloatArray:
    """Matrices (..., 3, 3) of Euler parameters (..., 4) of any length but zero."""
    euler = euler / np.linalg.norm(euler, axis=-1, keepdims=True)
    scalar, vector = euler[..., 0, None, None], euler[..., 1:]
    skew = _skew(vector)
    return np.asarray(np.eye(3) + 2 * scalar * skew + 2 * (skew @ skew))


def between(first: FloatArray, second: FloatArray, share: FloatArray) -> FloatArray:
    """Rotations (..., k, s, 3, 3) at shares (s,) of the way between two of (..., k, 3, 3)."""
    way = vector_of(np.swapaxes(first, -1, -2) @ second)
    return np.asarray(first[..., None, :, :] @ matrix_of(share[:, None] * way[..., None, :]))


def aligned(frame: FloatArray, direction: FloatArray) -> FloatArray:
    """Frames (..., 3, 3) after the smallest rotation that brings ex to unit directions (..., 3).

    Where a direction is zero the frame stays; where it is opposite, it turns about ey.
    """
    ex = frame[..., 0]
    axis = cross(ex, direction)
    cosine = np.einsum("...x,...x->...", ex, direction)[..., None]
    part = axis / np.maximum(1 + cosine, _SMALL)
    made = np.empty(np.broadcast_shapes(frame.shape, (*direction.shape, 3)))
    for k in range(3):
        # To be added to what is there, so that what has its direction stays to the last bit.
        once = cross(axis, frame[..., k])
        made[..., k] = frame[..., k] + once + cross(part, once)
    there = np.any(direction != 0.0, axis=-1)
    rest = ~(there & (cosine[..., 0] > _SMALL - 1))
    if rest.any():
        turns = np.where(there[rest][:, None], [-1.0, 1.0, -1.0], 1.0)
        made[rest] = np.broadcast_to(frame, made.shape)[rest] * turns[:, None]
    return made


def _skew(vectors: FloatArray) -> FloatArray:
    """Matrices (..., 3, 3) that make cross products with vectors (..., 3)."""
    made = np.zeros((*vectors.shape, 3))
    for k, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
        made[..., j, i] = vectors[..., k]
        made[..., i, j] = -vectors[..., k]
    return made
