# SPDX-License-Identifier: BSD-3-Clause
"""Points and cells of a drawing: axes as lines, hinges as vertices, and surfaces of quads."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...analysis.modes import SelfStress
from ...core.arrays import BoolArray, FloatArray
from ...util.records import Frozen
from ..drawing import (
    QUANTITIES,
    Drawing,
    Pose,
    Strip,
    axes_of,
    cylinders,
    field_along,
    resultants,
    solid,
    stations,
)
from ..drawing.pose import by_shape

Integers = NDArray[np.int64]

#: Lines along a member that bends.
SEGMENTS = 8
#: Corners round a hinge, and quads of the polygon that they make.
_CORNERS = 8
_DISC = _CORNERS // 2 - 1


@dataclass(frozen=True, eq=False)
class Layout(Frozen):
    """Points and cells of a drawing in a pose.

    The first b points are those of the axes: one a hinge, then those of the members, all the
    stations of one behind each other. Those of the surfaces follow. No two parts share a point.

    Attributes:
        drawing: The drawing.
        points: (n, 3) [m].
        frame: (b, 3, 3) cross-sections: columns ex along the axis, ey, ez.
        node: (b,) index of the position node at the point, -1 where there is none.
        axis_point: (n,) the point of an axis that each point belongs to, those themselves.
        has_stress: (n,) whether a point is of one element, and not on the solid of a body.
        strips: Members in the order of the points, with their stations (s,).
        corners: Points of the cells: (vertices, 1), (lines, 2), (quads, 4).
        element: (cells,) index of each cell's element, in the order of `corners`.
    """

    drawing: Drawing
    points: FloatArray
    frame: FloatArray
    node: Integers
    axis_point: Integers
    has_stress: BoolArray
    strips: tuple[tuple[np.ndarray, FloatArray], ...]
    corners: tuple[Integers, Integers, Integers]
    element: Integers

    def motion(
        self, displacement: FloatArray, rotation: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """(n, 3) displacements [m] and rotations [rad] of the points, to first order.

        Args:
            displacement: (nodes, 3) of positions.
            rotation: (nodes, 3) of orientations.
        """
        place, turn, _ = self.drawing.hinges.nodes.T
        moved = [np.where((place >= 0)[:, None], displacement[place], 0.0)]
        turned = [rotation[turn]]
        for field in field_along(self.drawing.members, displacement, rotation, SEGMENTS):
            moved.append(field.displacement.reshape(-1, 3))
            turned.append(field.rotation.reshape(-1, 3))
        about = np.concatenate(turned)[self.axis_point]
        made = np.concatenate(moved)[self.axis_point]
        skin = slice(len(self.frame), None)
        arm = self.points[skin] - self.points[self.axis_point[skin]]
        made[skin] += np.cross(about[skin], arm)
        return made, about

    def stress(self, stress: SelfStress) -> dict[str, FloatArray]:
        """(n,) each: the `QUANTITIES` [N, N m] at the points; see `flexact.show.drawing.Resultants`."""
        found = resultants(self.drawing, stress)
        made = {}
        for column, quantity in enumerate(QUANTITIES):
            along = [found.along(quantity, member, at).ravel() for member, at in self.strips]
            of_axes = np.concatenate((found.hinges[:, column], *along))
            made[quantity] = np.where(self.has_stress, of_axes[self.axis_point], 0.0)
        return made


def layout_of(drawing: Drawing, pose: Pose, skinned: BoolArray) -> Layout:
    """The points and cells of a drawing in a pose.

    Args:
        drawing: The drawing.
        pose: Where its nodes are.
        skinned: (elements,) which elements have a surface, besides their axis.
    """
    hinges = axes_of(drawing.hinges, pose)
    moved = pose is not drawing.reference
    members = tuple(stations(drawing.members, pose, SEGMENTS) if moved else _straight(drawing))
    axes = np.concatenate([each.centre.reshape(-1, 3) for each in (hinges, *members)])
    frame = np.concatenate([each.frame.reshape(-1, 3, 3) for each in (hinges, *members)])
    lines, of_lines, nodes = _lines(drawing, hinges.member.size, members)
    itself = skinned.copy()
    itself[drawing.members.index[drawing.in_solid]] = False
    skin = list(_skins(drawing, (hinges, *members), itself))
    skin += _bodies(drawing, pose, (hinges, *members), skinned)
    quads, behind = [np.zeros((0, 4), np.int64)], len(axes)
    for each in skin:
        quads.append(behind + each.quads.reshape(-1, 4))
        behind += len(each.points)
    owners = [np.repeat(each.element, each.quads.shape[1]) for each in skin]
    return Layout(
        drawing,
        np.concatenate((axes, *(each.points for each in skin))),
        frame,
        nodes,
        np.concatenate((np.arange(len(axes)), *(each.axis_point for each in skin))),
        np.concatenate(
            (np.ones(len(axes), bool), *(np.full(len(each.points), each.stressed) for each in skin))
        ),
        tuple((each.member, each.at) for each in members),
        (np.arange(hinges.member.size)[:, None], lines, np.concatenate(quads)),
        np.concatenate((drawing.hinges.index, of_lines, *owners)),
    )


def _straight(drawing: Drawing) -> Iterator[Strip]:
    """The members in the reference configuration, where none is bent."""
    start, end = (drawing.reference.position[drawing.members.nodes[:, slot]] for slot in (0, 2))
    for member, at in by_shape(drawing.members, SEGMENTS):
        way = (end - start)[member]
        centre = start[member, None] + at[:, None] * way[:, None]
        centre[:, -1] = end[member]
        frame = drawing.members.frame[member, None]
        yield Strip(member, at, centre, np.repeat(frame, at.size, axis=1))


def _lines(
    drawing: Drawing, behind: int, strips: tuple[Strip, ...]
) -> tuple[Integers, Integers, Integers]:
    """Points of the lines, their elements, and the nodes of the points of all axes."""
    lines, owners = [np.zeros((0, 2), np.int64)], [np.zeros(0, np.int64)]
    nodes = [drawing.hinges.nodes[:, 0]]
    for strip in strips:
        count = strip.at.size
        first = behind + np.arange(strip.member.size)[:, None] * count + np.arange(count - 1)
        lines.append(np.stack((first, first + 1), axis=-1).reshape(-1, 2))
        owners.append(np.repeat(drawing.members.index[strip.member], count - 1))
        at_ends = np.full((strip.member.size, count), -1)
        at_ends[:, [0, -1]] = drawing.members.nodes[strip.member][:, [0, 2]]
        nodes.append(at_ends.ravel())
        behind += strip.member.size * count
    return np.concatenate(lines), np.concatenate(owners), np.concatenate(nodes)


@dataclass(frozen=True, eq=False)
class _Skin:
    """Surfaces: points (m, 3), their points of axes (m,), faces (k, f, 4), elements (k,).

    And whether they have the stress of their elements.
    """

    points: FloatArray
    axis_point: Integers
    quads: Integers
    element: Integers
    stressed: bool = True


def _skins(drawing: Drawing, strips: tuple[Strip, ...], skinned: BoolArray) -> Iterator[_Skin]:
    """The surfaces of the hinges, which are the first strip, and of the members."""
    behind = 0
    for number, strip in enumerate(strips):
        index = (drawing.members if number else drawing.hinges).index[strip.member]
        rows = np.flatnonzero(skinned[index])
        part = Strip(strip.member[rows], strip.at, strip.centre[rows], strip.frame[rows])
        for each in (
            solid(part, drawing.members, drawing.planar)
            if number
            else cylinders(part, drawing.hinges, drawing.planar, _CORNERS)
        ):
            k, s, c, _ = each.points.shape
            # A disc is seen from the side to which z points.
            quads = each.quads[:, -_DISC:] if s == 1 else each.quads
            station = np.minimum(np.arange(s), strip.at.size - 1)[None, :, None]
            owner = behind + rows[each.strip][:, None, None] * strip.at.size + station
            yield _Skin(
                each.points.reshape(-1, 3),
                np.broadcast_to(owner, (k, s, c)).ravel(),
                quads,
                index[rows][each.strip],
            )
        behind += strip.member.size * strip.at.size


def _bodies(
    drawing: Drawing, pose: Pose, strips: tuple[Strip, ...], skinned: BoolArray
) -> Iterator[_Skin]:
    """The surfaces of bodies that are solids, as those of their first elements."""
    first: dict[int, int] = {}
    behind = strips[0].member.size
    for strip in strips[1:]:
        starts = behind + np.arange(strip.member.size) * strip.at.size
        first.update(zip(strip.member.tolist(), starts.tolist(), strict=True))
        behind += strip.member.size * strip.at.size
    for body in drawing.solids:
        row = int(body.rows[0])
        index = drawing.members.index[row]
        if not skinned[index]:
            continue
        corners = body.placed(drawing.members, drawing.reference, pose).corners
        points = body.quads(corners).reshape(-1, 3)
        quads = np.arange(len(points)).reshape(1, -1, 4)
        owner = np.full(len(points), first[row])
        yield _Skin(points, owner, quads, np.array([index]), stressed=False)
