# SPDX-License-Identifier: BSD-3-Clause
"""The surfaces of members, their sections along their stations, and of hinges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...util.records import Frozen
from .drawing_pose import Pose
from .hinges import Hinges
from .members import Members
from .pose import Strip


@dataclass(frozen=True, eq=False)
class Solid(Frozen):
    """Surfaces of members that have equally many stations and corners.

    Attributes:
        member: (k,) which of the drawing's members, or of its hinges.
        strip: (k,) which row of the strip.
        at: (s,) stations, from 0 at p to 1 at q.
        offset: (k, c, 2) corners of the sections along ey and ez [m].
        points: (k, s, c, 3) corners along the member [m].
        closed: Whether the corners go round; in the plane they are two edges.
    """

    member: np.ndarray
    strip: np.ndarray
    at: FloatArray
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
        faces = _faces(s, c, self.closed)
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
        points = strip.centre[rows][:, :, None] + np.einsum("ksxd,kcd->kscx", across, offset)
        made.append(Solid(member, rows, strip.at, offset, points, not planar))
    return made


def axes_of(hinges: Hinges, pose: Pose, chosen: np.ndarray | slice = slice(None)) -> Strip:
    """Hinges, or some of them, with one station each; those that stand nowhere at the origin."""
    place, turn, _ = hinges.nodes[chosen].T
    centre = np.where((place >= 0)[:, None], pose.position[place], 0.0)
    frame = pose.rotation[turn] @ hinges.frame[chosen]
    member = np.arange(len(hinges))[chosen]
    return Strip(member, np.array([0.5]), centre[:, None], frame[:, None])


def cylinders(strip: Strip, hinges: Hinges, planar: bool = False, corners: int = 8) -> list[Solid]:
    """The surfaces of hinges, cylinders about their axes; in the plane they have no length."""
    length, diameter = hinges.size[strip.member].T
    offset = diameter[:, None, None] * _corners(corners)
    ends = np.array([0.0]) if planar else np.array([-0.5, 0.5])
    shift = (length[:, None] * ends)[:, :, None] * strip.frame[..., 0]
    across = np.einsum("kxd,kcd->kcx", strip.frame[:, 0, :, 1:], offset)
    points = strip.centre[:, :, None] + shift[:, :, None] + across[:, None]
    rows = np.arange(strip.member.size)
    return [Solid(strip.member, rows, ends, offset, points, True)] if rows.size else []


def _corners(count: int, planar: bool = False) -> FloatArray:
    """(c, 2) corners of a section of unit size, anticlockwise about ex."""
    if planar:
        return np.array([[-0.5, 0.0], [0.5, 0.0]])
    if count == 4:
        return np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    angle = 2 * np.pi * np.arange(count) / count
    return np.column_stack((np.cos(angle), np.sin(angle))) / 2


def _faces(s: int, c: int, closed: bool) -> np.ndarray:
    """(f, 4) faces of one member; its ends are cut into quads."""
    station = np.arange(s - 1)[:, None] * c
    corner = np.arange(c if closed else c - 1)
    follower = (corner + 1) % c
    side = np.stack(
        np.broadcast_arrays(
            station + corner, station + follower, station + c + follower, station + c + corner
        ),
        axis=-1,
    ).reshape(-1, 4)
    if not closed:
        # Seen from the side to which ez points.
        return np.asarray(side[:, ::-1])
    fan = np.array([[0, i, i + 1, i + 2] for i in range(1, c - 1, 2)])
    return np.concatenate((side, fan[:, ::-1], fan + (s - 1) * c))
