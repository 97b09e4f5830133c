# SPDX-License-Identifier: BSD-3-Clause
"""Families of lines any two of which meet, and of directions, from six numbers each.

Lengths are in parts of the characteristic length, from the point of the moments.
"""

from __future__ import annotations

import numpy as np

from ...analysis.screws import sense_of
from ...core.arrays import FloatArray
from .families import Family, FamilyKind


def line_of(row: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Point, direction and pitch of a screw, (6,)."""
    axis, moment = row[:3], row[3:]
    square = float(axis @ axis)
    point = np.cross(axis, moment) / square
    return point, _unit(axis), float(axis @ moment) / square


def directions_of(free: FloatArray) -> Family:
    """The family of all directions in the space of some, (t, 6) orthonormal."""
    if len(free) == 1:
        return Family(FamilyKind.DIRECTION, direction=_unit(free[0, 3:]))
    if len(free) == 2:
        normal = _unit(np.cross(free[0, 3:], free[1, 3:]))
        return Family(FamilyKind.DIRECTIONS_IN_PLANE, normal=normal)
    return Family(FamilyKind.EVERY_DIRECTION)


def flat_family(free: FloatArray, lined: FloatArray) -> Family:
    """The family of lines, of which there is one, any two of which meet.

    Args:
        free: (t, 6) its directions without a line, orthonormal.
        lined: (f - t, 6) the rest, perpendicular to these.
    """
    axes, moments = lined[:, :3], lined[:, 3:]
    point, direction, _ = line_of(lined[0])
    if len(lined) == 1:
        if not len(free):
            return Family(FamilyKind.LINE, point, direction)
        if len(free) == 2:
            return Family(FamilyKind.PARALLELS, direction=direction)
        normal = _unit(free[0, 3:])
        height = float(normal @ point)
        return Family(FamilyKind.PARALLELS_IN_PLANE, height * normal, direction, normal)
    if len(free):
        normal = _unit(free[0, 3:])
        # A line at d from the middle has the moment d x a; along the normal that is the height.
        across = np.cross(normal, axes)
        height = float(np.sum(across * moments) / np.sum(across * across))
        return Family(FamilyKind.PLANE, height * normal, normal=normal)
    point = _common_point(axes, moments)
    if len(lined) == 2:
        normal = _unit(np.cross(axes[0], axes[1]))
        return Family(FamilyKind.PENCIL, point, normal=normal)
    return Family(FamilyKind.BUNDLE, point)


def _common_point(axes: FloatArray, moments: FloatArray) -> FloatArray:
    """The point d through which all lines go: d x a = b for each."""
    matrix = np.concatenate([np.cross(np.eye(3), axis).T for axis in axes])
    made: FloatArray = np.linalg.lstsq(matrix, moments.ravel(), rcond=None)[0]
    return made


def _unit(vector: FloatArray) -> FloatArray:
    made: FloatArray = sense_of(vector) * vector / np.linalg.norm(vector)
    return made
