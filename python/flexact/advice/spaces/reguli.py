# SPDX-License-Identifier: BSD-3-Clause
"""The lines of a regulus: one of the two sets of lines on a hyperboloid or a paraboloid.

With principal pitches h1, h2, h3 about three axes through one point, the lines of a space of three
dimensions lie on h1 x^2 + h2 y^2 + h3 z^2 + h1 h2 h3 = 0 (Hunt, *Kinematic Geometry of
Mechanisms*, 1978, section 12.5).
"""

from __future__ import annotations

import numpy as np

from ...analysis.screws import sense_of
from ...core.arrays import FloatArray
from .families import SAME, Family, FamilyKind
from .flat_families import line_of

#: How many lines of it are given.
_SAMPLES = 12


def regulus_of(rows: FloatArray, values: FloatArray, vectors: FloatArray) -> Family:
    """The regulus of a space of three dimensions.

    Args:
        rows: (3, 6) that span it.
        values: (3,) eigenvalues of q on it, of both signs.
        vectors: (3, 3) their eigenvectors.
    """
    points, directions = _samples(rows, values, vectors)
    _, sizes, right = np.linalg.svd(rows[:, :3])
    if sizes[-1] > SAME:
        point, axis = _middle(rows)
        return Family(
            FamilyKind.REGULUS, point, direction=axis, points=points, directions=directions
        )
    normal = sense_of(right[2]) * right[2]
    # The vertex is no more than a point to look at: the mean of the middles of some lines.
    return Family(
        *(FamilyKind.REGULUS, points.mean(axis=0)),
        normal=normal,
        points=points,
        directions=directions,
    )


def _samples(
    rows: FloatArray, values: FloatArray, vectors: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Points and directions of lines all round."""
    scaled = (vectors / np.sqrt(np.abs(values))).T @ rows
    lone = int(np.argmax(np.sign(values) != np.sign(np.sum(np.sign(values)))))
    one, other = (scaled[k] for k in range(3) if k != lone)
    points, directions = [], []
    for angle in 2.0 * np.pi * (np.arange(_SAMPLES) + 0.5) / _SAMPLES:
        screw = np.cos(angle) * one + np.sin(angle) * other + scaled[lone]
        if np.linalg.norm(screw[:3]) > SAME * np.linalg.norm(screw):
            point, direction, _ = line_of(screw)
            points.append(point)
            directions.append(direction)
    return np.array(points), np.array(directions)


def _middle(rows: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The centre of the hyperboloid and the direction of its axis.

    Every rotation a has the moment M a; the skew part of M is that of the centre, and the
    symmetric part has the principal pitches.
    """
    matrix = np.linalg.solve(rows[:, :3], rows[:, 3:]).T
    skew = (matrix - matrix.T) / 2.0
    point = np.array([skew[2, 1], skew[0, 2], skew[1, 0]])
    pitches, axes = np.linalg.eigh((matrix + matrix.T) / 2.0)
    # Of three pitches of both signs the lone one is the first or the last.
    lone = 0 if pitches[1] > 0.0 else 2
    axis = axes[:, lone]
    return point, sense_of(axis) * axis
