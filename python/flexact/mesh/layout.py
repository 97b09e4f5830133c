"""Points and cells of a scene: axes as lines, hinges as vertices, and surfaces of quads."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..exchange import BoolArray, FloatArray
from ..frozen import Frozen
from ..modes import SelfStress
from ..scene import (
    QUANTITIES,
    Pose,
    Scene,
    Solid,
    Strip,
    field_along,
    resultants,
    solid,
    stations,
)
from ..scene.shapes import by_shape

Integers = NDArray[np.int64]

#: Lines along a member that bends.
SEGMENTS = 8
#: Corners round a hinge, and quads of the polygon that they make.
_CORNERS = 8
_DISC = _CORNERS // 2 - 1


@dataclass(frozen=True, eq=False)
class Layout(Frozen):
    """Points and cells of a scene in a pose.

    The first b points are those of the axes: one a hinge, then those of the members, all the
    stations of one behind each other. Those of the surfaces follow. No two parts share a point.

    Attributes:
        scene: The scene.
        points: (n, 3) [m].
        frame: (b, 3, 3) cross-sections: columns ex along the axis, ey, ez.
        node: (b,) index of the position node at the point, -1 where there is none.
        axis_point: (n,) the point of an axis that each point belongs to, those themselves.
        strips: Members in the order of the points, with their stations (s,).
        corners: Points of the cells: (vertices, 1), (lines, 2), (quads, 4).
        element: (cells,) index of each cell's element, in the order of `corners`.
    """

    scene: Scene
    points: FloatArray
    frame: FloatArray
    node: Integers
    axis_point: Integers
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
        place, turn, _ = self.scene.hinges.nodes.T
        moved = [np.where((place >= 0)[:, None], displacement[place], 0.0)]
        turned = [rotation[turn]]
        for field in field_along(self.scene.members, displacement, rotation, SEGMENTS):
            moved.append(field.displacement.reshape(-1, 3))
            turned.append(field.rotation.reshape(-1, 3))
        about = np.concatenate(turned)[self.axis_point]
        made = np.concatenate(moved)[self.axis_point]
        skin = slice(len(self.frame), None)
        arm = self.points[skin] - self.points[self.axis_point[skin]]
        made[skin] += np.cross(about[skin], arm)
        return made, about

    def stress(self, stress: SelfStress) -> dict[str, FloatArray]:
        """(n,) each: N [N], T, My, Mz [N m] at the points; see `flexact.scene.Resultants`."""
        found = resultants(self.scene, stress)
        made = {}
        for column, quantity in enumerate(QUANTITIES):
            along = [found.along(quantity, member, at).ravel() for member, at in self.strips]
            made[quantity] = np.concatenate((found.hinges[:, column], *along))[self.axis_point]
        return made


def layout_of(scene: Scene, pose: Pose, skinned: BoolArray) -> Layout:
    """The points and cells of a scene in a pose.

    Args:
        scene: The scene.
        pose: Where its nodes are.
        skinned: (elements,) which elements have a surface, besides their axis.
    """
    hinges = _hinge_strip(scene, pose)
    moved = pose is not scene.reference
    members = tuple(stations(scene.members, pose, SEGMENTS) if moved else _straight(scene))
    axes = np.concatenate([each.centre.reshape(-1, 3) for each in (hinges, *members)])
    frame = np.concatenate([each.frame.reshape(-1, 3, 3) for each in (hinges, *members)])
    lines, of_lines, nodes = _lines(scene, hinges.member.size, members)
    skin = list(_skins(scene, (hinges, *members), skinned))
    quads, behind = [np.zeros((0, 4), np.int64)], len(axes)
    for each in skin:
        quads.append(behind + each.quads.reshape(-1, 4))
        behind += len(each.points)
    owners = [np.repeat(each.element, each.quads.shape[1]) for each in skin]
    return Layout(
        scene,
        np.concatenate((axes, *(each.points for each in skin))),
        frame,
        nodes,
        np.concatenate((np.arange(len(axes)), *(each.axis_point for each in skin))),
        tuple((each.member, each.at) for each in members),
        (np.arange(hinges.member.size)[:, None], lines, np.concatenate(quads)),
        np.concatenate((scene.hinges.index, of_lines, *owners)),
    )


def _hinge_strip(scene: Scene, pose: Pose) -> Strip:
    """The hinges, each with one station; those that stand nowhere are at the origin."""
    place, turn, _ = scene.hinges.nodes.T
    centre = np.where((place >= 0)[:, None], pose.position[place], 0.0)
    frame = pose.rotation[turn] @ scene.hinges.frame
    return Strip(np.arange(place.size), np.array([0.5]), centre[:, None], frame[:, None])


def _straight(scene: Scene) -> Iterator[Strip]:
    """The members in the reference configuration, where none is bent."""
    start, end = (scene.reference.position[scene.members.nodes[:, slot]] for slot in (0, 2))
    for member, at in by_shape(scene.members, SEGMENTS):
        way = (end - start)[member]
        centre = start[member, None] + at[:, None] * way[:, None]
        centre[:, -1] = end[member]
        frame = scene.members.frame[member, None]
        yield Strip(member, at, centre, np.repeat(frame, at.size, axis=1))


def _lines(
    scene: Scene, behind: int, strips: tuple[Strip, ...]
) -> tuple[Integers, Integers, Integers]:
    """Points of the lines, their elements, and the nodes of the points of all axes."""
    lines, owners = [np.zeros((0, 2), np.int64)], [np.zeros(0, np.int64)]
    nodes = [scene.hinges.nodes[:, 0]]
    for strip in strips:
        count = strip.at.size
        first = behind + np.arange(strip.member.size)[:, None] * count + np.arange(count - 1)
        lines.append(np.stack((first, first + 1), axis=-1).reshape(-1, 2))
        owners.append(np.repeat(scene.members.index[strip.member], count - 1))
        at_ends = np.full((strip.member.size, count), -1)
        at_ends[:, [0, -1]] = scene.members.nodes[strip.member][:, [0, 2]]
        nodes.append(at_ends.ravel())
        behind += strip.member.size * count
    return np.concatenate(lines), np.concatenate(owners), np.concatenate(nodes)


@dataclass(frozen=True, eq=False)
class _Skin:
    """Surfaces: points (m, 3), their points of axes (m,), faces (k, f, 4), elements (k,)."""

    points: FloatArray
    axis_point: Integers
    quads: Integers
    element: Integers


def _skins(scene: Scene, strips: tuple[Strip, ...], skinned: BoolArray) -> Iterator[_Skin]:
    """The surfaces of the hinges, which are the first strip, and of the members."""
    behind = 0
    for number, strip in enumerate(strips):
        index = (scene.members if number else scene.hinges).index[strip.member]
        rows = np.flatnonzero(skinned[index])
        part = Strip(strip.member[rows], strip.at, strip.centre[rows], strip.frame[rows])
        for each in solid(part, scene.members, scene.planar) if number else _cylinders(scene, part):
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


def _cylinders(scene: Scene, strip: Strip) -> list[Solid]:
    """Cylinders about the axes of hinges; in the plane they have no length."""
    length, diameter = scene.hinges.size[strip.member].T
    angle = 2 * np.pi * np.arange(_CORNERS) / _CORNERS
    round_ = np.column_stack((np.cos(angle), np.sin(angle))) / 2
    offset = diameter[:, None, None] * round_
    ends = np.array([0.0]) if scene.planar else np.array([-0.5, 0.5])
    shift = (length[:, None] * ends)[:, :, None] * strip.frame[..., 0]
    across = np.einsum("kxd,kcd->kcx", strip.frame[:, 0, :, 1:], offset)
    points = strip.centre[:, :, None] + shift[:, :, None] + across[:, None]
    rows = np.arange(strip.member.size)
    return [Solid(strip.member, rows, ends, offset, points, True)] if rows.size else []
