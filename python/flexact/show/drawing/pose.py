# SPDX-License-Identifier: BSD-3-Clause
"""The shapes of members in a pose: beams on their own cubic curve, the rest straight.

A beam's axis between its ends is the cubic curve that starts at p along the ex of p's frame and
ends at q along that of q, its parameter running over the reference length; for small
deformations that is the curve on which the deformations of eqs. (3) and (4) are defined. Its
cross-sections turn evenly from the frame of p to that of q and stand across the curve.

Motions along the members are the velocities of the points of their axes, to first order.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...util.records import Frozen
from .drawing_pose import Pose
from .members import Members
from .rotations import aligned, between, unit


@dataclass(frozen=True, eq=False)
class Strip(Frozen):
    """Members with equally many stations along them.

    Attributes:
        member: (k,) which of the drawing's members.
        at: (s,) stations, from 0 at p to 1 at q.
        centre: (k, s, 3) points of the axis [m].
        frame: (k, s, 3, 3) cross-sections: columns ex along the axis, ey, ez.
    """

    member: np.ndarray
    at: FloatArray
    centre: FloatArray
    frame: FloatArray


def stations(
    members: Members, pose: Pose, segments: int = 8, chosen: np.ndarray | bool = True
) -> Iterator[Strip]:
    """The members in a pose: those that bend in so many segments, then the straight ones.

    All of them, or those `chosen` (k,).
    """
    for rows, at in by_shape(members, segments, chosen):
        yield (_bent if at.size > 2 else _straight)(members, pose, rows, at)


def by_shape(
    members: Members, segments: int, chosen: np.ndarray | bool = True
) -> Iterator[tuple[np.ndarray, FloatArray]]:
    """Rows of the members, and their stations: those that bend, then the straight ones."""
    for bends, count in ((True, max(segments, 2)), (False, 1)):
        rows = np.flatnonzero((members.bends == bends) & chosen)
        if rows.size:
            yield rows, np.linspace(0.0, 1.0, count + 1)


def hermite(at: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(4, s) values and derivatives of the cubic polynomials of Hermite at stations (s,).

    In the order: position at p, slope at p, position at q, slope at q.
    """
    s = at
    value = (1 - 3 * s**2 + 2 * s**3, s - 2 * s**2 + s**3, 3 * s**2 - 2 * s**3, s**3 - s**2)
    slope = (6 * s**2 - 6 * s, 1 - 4 * s + 3 * s**2, 6 * s - 6 * s**2, 3 * s**2 - 2 * s)
    return np.stack(value), np.stack(slope)


def _bent(members: Members, pose: Pose, chosen: np.ndarray, at: FloatArray) -> Strip:
    p, op, q, oq = members.nodes[chosen].T
    length = members.length[chosen, None]
    frames = members.frame[chosen]
    turned_p, turned_q = pose.rotation[op], pose.rotation[oq]
    given = np.stack(
        (
            pose.position[p],
            length * (turned_p @ frames)[..., 0],
            pose.position[q],
            length * (turned_q @ frames)[..., 0],
        )
    )
    value, slope = hermite(at)
    centre = np.einsum("as,akx->ksx", value, given)
    tangent = unit(np.einsum("as,akx->ksx", slope, given))
    frame = between(turned_p, turned_q, at) @ frames[:, None]
    return Strip(chosen, at, centre, aligned(frame, tangent))


def _straight(members: Members, pose: Pose, chosen: np.ndarray, at: FloatArray) -> Strip:
    """Trusses and rigid members; those that are stiff keep their length, whatever the pose."""
    p, op, q, _ = members.nodes[chosen].T
    first, last = pose.position[p], pose.position[q]
    oriented, stiff = op >= 0, members.stiff[chosen]
    turn = np.where(oriented[:, None, None], pose.rotation[op], np.eye(3))
    frame = turn @ members.frame[chosen]
    along = aligned(frame, unit(last - first))
    frame = np.where((oriented & stiff)[:, None, None], frame, along)
    half = members.length[chosen, None] / 2 * frame[..., 0]
    middle = first / 2 + last / 2
    first = np.where(stiff[:, None], middle - half, first)
    last = np.where(stiff[:, None], middle + half, last)
    centre = first[:, None] + at[None, :, None] * (last - first)[:, None]
    return Strip(chosen, at, centre, np.repeat(frame[:, None], at.size, axis=1))


@dataclass(frozen=True, eq=False)
class Field(Frozen):
    """A motion at the stations of members.

    Attributes:
        member: (k,) which of the drawing's members.
        at: (s,) stations, from 0 at p to 1 at q.
        displacement: (k, s, 3) of the axis, in the unit of the motion [m].
        rotation: (k, s, 3) of the cross-sections [rad].
    """

    member: np.ndarray
    at: FloatArray
    displacement: FloatArray
    rotation: FloatArray


def field_along(
    members: Members, displacement: FloatArray, rotation: FloatArray, segments: int = 8
) -> Iterator[Field]:
    """A motion, given at the nodes (nodes, 3), along the members; strips as of `stations`.

    It is the derivative of the shapes of `stations` with respect to the pose, except that a
    rigid member whose ends move apart shows that they do. At the ends it is what it is at the
    nodes.
    """
    for chosen, at in by_shape(members, segments):
        along = _bent_field if at.size > 2 else _straight_field
        yield along(members, displacement, rotation, chosen, at)


def _bent_field(
    members: Members, moved: FloatArray, turned: FloatArray, chosen: np.ndarray, at: FloatArray
) -> Field:
    p, op, q, oq = members.nodes[chosen].T
    ex = members.frame[chosen, :, 0]
    length = members.length[chosen, None]
    given = np.stack(
        (
            moved[p],
            length * np.cross(turned[op], ex),
            moved[q],
            length * np.cross(turned[oq], ex),
        )
    )
    value, slope = hermite(at)
    displacement = np.einsum("as,akx->ksx", value, given)
    bending = np.cross(ex[:, None], np.einsum("as,akx->ksx", slope, given) / length[:, None])
    even = (1 - at)[:, None] * turned[op][:, None] + at[:, None] * turned[oq][:, None]
    twist = np.sum(even * ex[:, None], axis=-1, keepdims=True) * ex[:, None]
    rotation = twist + bending
    # To the last bit what the nodes have.
    displacement[:, 0], displacement[:, -1] = moved[p], moved[q]
    rotation[:, 0], rotation[:, -1] = turned[op], turned[oq]
    return Field(chosen, at, displacement, rotation)


def _straight_field(
    members: Members, moved: FloatArray, turned: FloatArray, chosen: np.ndarray, at: FloatArray
) -> Field:
    p, op, q, oq = members.nodes[chosen].T
    first, last = moved[p], moved[q]
    displacement = first[:, None] + at[None, :, None] * (last - first)[:, None]
    displacement[:, 0], displacement[:, -1] = first, last
    length = np.where(members.length[chosen] > 0.0, members.length[chosen], 1.0)
    swing = np.cross(members.frame[chosen, :, 0], last - first) / length[:, None]
    start = np.where((op >= 0)[:, None], turned[op], swing)
    end = np.where((oq >= 0)[:, None], turned[oq], start)
    return Field(chosen, at, displacement, np.stack((start, end), axis=1))
