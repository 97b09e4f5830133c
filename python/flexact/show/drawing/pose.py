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

from ...core.arrays import FloatArray, ModelArrays
from ...core.elements import NodeKind
from ...model.configuration import Configuration
from ...util.records import Frozen
from ...util.rotations import aligned, between, matrix_of, matrix_of_euler, unit
from .members import HINGE_SIZE, Elements, Members


@dataclass(frozen=True, eq=False)
class Pose(Frozen):
    """Where all nodes are; or several poses, one behind the other in a first axis more.

    Attributes:
        position: (nodes, 3) of positions [m]; zero for orientations.
        rotation: (nodes, 3, 3) since the reference; the identity for positions.
    """

    position: FloatArray
    rotation: FloatArray


def reference_pose(arrays: ModelArrays) -> Pose:
    """The pose in which all deformations are zero."""
    placed = arrays.node_kind <= NodeKind.POSITION
    position = np.where(placed, arrays.node_value[:3], 0.0).T
    return Pose(position, np.broadcast_to(np.eye(3), (placed.size, 3, 3)).copy())


def pose_of(arrays: ModelArrays, configuration: Configuration) -> Pose:
    """The pose that a configuration means."""
    return poses_of(arrays, configuration.value)


def poses_of(arrays: ModelArrays, value: FloatArray) -> Pose:
    """The poses that values of nodes mean, (..., nodes, 4)."""
    kind = arrays.node_kind
    placed = kind <= NodeKind.POSITION
    rotation = np.broadcast_to(np.eye(3), (*value.shape[:-1], 3, 3)).copy()
    turned = kind == NodeKind.ORIENTATION
    now, then = matrix_of_euler(value[..., turned, :]), matrix_of_euler(arrays.node_value.T[turned])
    rotation[..., turned, :, :] = now @ np.swapaxes(then, -1, -2)
    plane = kind == NodeKind.ANGLE
    angle = np.zeros((*value.shape[:-2], int(plane.sum()), 3))
    angle[..., 2] = value[..., plane, 0] - arrays.node_value[0, plane]
    rotation[..., plane, :, :] = matrix_of(angle)
    return Pose(np.where(placed[:, None], value[..., :3], 0.0), rotation)


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


def along(members: Members, pose: Pose, rows: np.ndarray, at: FloatArray) -> Strip:
    """Some members in a pose, that bend all or none, at stations (s,) of one's choice."""
    return (_bent if members.bends[rows[0]] else _straight)(members, pose, rows, at)


def axes_along(members: Members, pose: Pose) -> Iterator[FloatArray]:
    """Points (k, s, 3) of the axes of the strips of `stations`; sections take most of its time."""
    for rows, at in by_shape(members, 8):
        if at.size > 2:
            yield np.einsum("as,a...kx->...ksx", hermite(at)[0], _ends(members, pose, rows))
        else:
            yield _straight(members, pose, rows, at).centre


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


def _ends(members: Members, pose: Pose, chosen: np.ndarray) -> FloatArray:
    """(4, k, 3) places and slopes at both ends of members that bend, as `hermite` has them."""
    p, op, q, oq = members.nodes[chosen].T
    along = members.length[chosen, None] * members.frame[chosen, :, 0]
    slopes = ((pose.rotation[..., turn, :, :] @ along[..., None])[..., 0] for turn in (op, oq))
    places = (pose.position[..., place, :] for place in (p, q))
    return np.stack((next(places), next(slopes), next(places), next(slopes)))


def _bent(members: Members, pose: Pose, chosen: np.ndarray, at: FloatArray) -> Strip:
    given, (value, slope) = _ends(members, pose, chosen), hermite(at)
    centre = np.einsum("as,a...kx->...ksx", value, given)
    tangent = unit(np.einsum("as,a...kx->...ksx", slope, given))
    nodes = members.nodes[chosen]
    turned_p, turned_q = (pose.rotation[..., nodes[:, turn], :, :] for turn in (1, 3))
    frame = between(turned_p, turned_q, at) @ members.frame[chosen, None]
    return Strip(chosen, at, centre, aligned(frame, tangent))


def _straight(members: Members, pose: Pose, chosen: np.ndarray, at: FloatArray) -> Strip:
    """Trusses and rigid members; those that are stiff keep their length, whatever the pose."""
    p, op, q, _ = members.nodes[chosen].T
    first, last = pose.position[..., p, :], pose.position[..., q, :]
    oriented, stiff = op >= 0, members.stiff[chosen]
    turn = np.where(oriented[:, None, None], pose.rotation[..., op, :, :], np.eye(3))
    frame = turn @ members.frame[chosen]
    along = aligned(frame, unit(last - first))
    frame = np.where((oriented & stiff)[:, None, None], frame, along)
    half = members.length[chosen, None] / 2 * frame[..., 0]
    middle = first / 2 + last / 2
    first = np.where(stiff[:, None], middle - half, first)
    last = np.where(stiff[:, None], middle + half, last)
    centre = first[..., None, :] + at[:, None] * (last - first)[..., None, :]
    return Strip(chosen, at, centre, np.repeat(frame[..., None, :, :], at.size, axis=-3))


#: A motion at the stations of members: (k,) which of the drawing's members, (k, s, 3) of their
#: axes in the unit of the motion [m], (k, s, 3) of their cross-sections [rad].
Field = tuple[np.ndarray, FloatArray, FloatArray]


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
    return chosen, displacement, rotation


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
    return chosen, displacement, np.stack((start, end), axis=1)


@dataclass(frozen=True, eq=False)
class Solid(Frozen):
    """Surfaces of members that have equally many stations and corners.

    Attributes:
        member: (k,) which of the drawing's members, or of its hinges.
        strip: (k,) which row of the strip.
        offset: (k, c, 2) corners of the sections along ey and ez [m].
        points: (k, s, c, 3) corners along the member [m].
        closed: Whether the corners go round; in the plane they are two edges.
    """

    member: np.ndarray
    strip: np.ndarray
    offset: FloatArray
    points: FloatArray
    closed: bool

    @property
    def quads(self) -> np.ndarray:
        """(k, f, 4) corners of the faces, indices into `points.reshape(-1, 3)`.

        Along the member first, station by station, then the two ends. Seen from outside they
        go round anticlockwise.
        """
        k, s, c, _ = self.points.shape
        station = np.arange(s - 1)[:, None] * c
        corner = np.arange(c if self.closed else c - 1)
        follower = (corner + 1) % c
        around = (station + corner, station + follower, station + c + follower)
        side = np.stack(np.broadcast_arrays(*around, station + c + corner), axis=-1).reshape(-1, 4)
        # What is not closed is seen from the side to which ez points.
        faces = side[:, ::-1]
        if self.closed:
            fan = np.array([[0, i, i + 1, i + 2] for i in range(1, c - 1, 2)])
            faces = np.concatenate((side, fan[:, ::-1], fan + (s - 1) * c))
        return np.asarray(np.arange(k)[:, None, None] * (s * c) + faces)


def solid(strip: Strip, members: Members, planar: bool = False, corners: int = 8) -> list[Solid]:
    """The surfaces of a strip: those with rectangular sections, then the round ones.

    Args:
        strip: The members with their stations.
        members: All members of the drawing.
        planar: Whether all are flat, two edges at a distance of the size along ey.
        corners: Of round sections, an even number.
    """
    made = []
    is_round = members.round[strip.member] & (not planar)
    for count, rows in ((4, np.flatnonzero(~is_round)), (corners, np.flatnonzero(is_round))):
        if not rows.size:
            continue
        member = strip.member[rows]
        offset = members.section[member][:, None, :] * _corners(count, planar)
        across = strip.frame[rows][..., 1:]
        scale, beside = members.profile(member, strip.at)
        local = scale[:, :, None] * offset[:, None] + beside[:, :, None]
        points = strip.centre[rows][:, :, None] + np.einsum("ksxd,kscd->kscx", across, local)
        made.append(Solid(member, rows, offset, points, not planar))
    return made


def axes_of(hinges: Elements, pose: Pose, chosen: np.ndarray | slice = slice(None)) -> Strip:
    """Hinges, or some of them, with one station each; those that stand nowhere at the origin."""
    place, turn, _ = hinges.nodes[chosen].T
    centre = np.where((place >= 0)[:, None], pose.position[..., place, :], 0.0)
    frame = pose.rotation[..., turn, :, :] @ hinges.frame[chosen]
    member = np.arange(len(hinges))[chosen]
    return Strip(member, np.array([0.5]), centre[..., None, :], frame[..., None, :, :])


def cylinders(strip: Strip, size: float, planar: bool = False, corners: int = 8) -> list[Solid]:
    """The surfaces of hinges, cylinders about their axes; in the plane they have no length.

    Args:
        strip: The hinges.
        size: Of the drawing [m].
        planar: Whether it is.
        corners: Of each.
    """
    length, diameter = np.tile(np.array(HINGE_SIZE) * size, (strip.member.size, 1)).T
    offset = diameter[:, None, None] * _corners(corners)
    ends = np.array([0.0]) if planar else np.array([-0.5, 0.5])
    shift = (length[:, None] * ends)[:, :, None] * strip.frame[..., 0]
    across = np.einsum("kxd,kcd->kcx", strip.frame[:, 0, :, 1:], offset)
    points = strip.centre[:, :, None] + shift[:, :, None] + across[:, None]
    rows = np.arange(strip.member.size)
    return [Solid(strip.member, rows, offset, points, True)] if rows.size else []


def _corners(count: int, planar: bool = False) -> FloatArray:
    """(c, 2) corners of a section of unit size, anticlockwise about ex."""
    if planar:
        return np.array([[-0.5, 0.0], [0.5, 0.0]])
    if count == 4:
        return np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    angle = 2 * np.pi * np.arange(count) / count
    return np.column_stack((np.cos(angle), np.sin(angle))) / 2
