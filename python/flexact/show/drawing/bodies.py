# SPDX-License-Identifier: BSD-3-Clause
"""Rigid bodies as solids: round the points that they carry and the ends of their sheets.

A body is the convex hull of those points, each with a small box round it. Its links are drawn as
they are where a deck or its maker gives them sections, where they are one bar without sheets, or
where the hull would swallow what does not belong to the body.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from ...model.attributes import CrossSection
from ...model.data import ModelData
from ...model.parts.bodies import Body, bodies_of
from ...model.parts.forms import Form
from ...util.records import Frozen
from .drawing_pose import Pose
from .hull import Hull, hull_round, polygon_round
from .members import Members

#: Thickness where points lie in a line or a plane: a part of the drawing's size, and of the
#: body's own extent, which it does not exceed.
_THICK, _LIMIT = 0.034, 0.4
#: Of more points, of bodies in drawings of more members, the links are drawn.
_MOST_POINTS, _MOST_MEMBERS = 120, 1500
#: A frame fits a body better than another one by so much.
_BETTER = 1.0e-6
#: Places along other members, and how deep within a hull one may not lie, parts of the thickness.
_INNER, _DEEP = np.linspace(0.25, 0.75, 9), 0.3
_BOX = np.array(list(product((-0.5, 0.5), repeat=3)))


class Placed(NamedTuple):
    """A body in a pose."""

    corners: FloatArray
    """(v, 3) [m]."""
    normal: FloatArray
    """(faces, 3) outward unit vectors; none in the plane."""


@dataclass(frozen=True, eq=False)
class Solid(Frozen):
    """A rigid body in the reference configuration.

    Attributes:
        rows: Its members in the drawing; it moves with the first.
        corners: (v, 3) [m].
        hull: Its surface, of `corners`; None in the plane.
        outline: (c,) its corners in the plane, anticlockwise; empty in space.
        colour: (3,) red, green, blue, 0 to 1.
        edge_colour: (3,) likewise; NaN where none is given.
        opacity: 0 to 1.
    """

    rows: np.ndarray
    corners: FloatArray
    hull: Hull | None
    outline: np.ndarray
    colour: FloatArray
    edge_colour: FloatArray
    opacity: float

    def placed(self, members: Members, reference: Pose, pose: Pose) -> Placed:
        """Where it is in a pose."""
        p, op = members.nodes[self.rows[0], :2]
        turn = pose.rotation[op].T
        corners = pose.position[p] + (self.corners - reference.position[p]) @ turn
        normal = np.zeros((0, 3)) if self.hull is None else self.hull.normal @ turn
        return Placed(corners, normal)

    @property
    def triangles(self) -> np.ndarray:
        """(t, 3) indices of corners; in the plane parts of the polygon."""
        if self.hull is not None:
            return self.hull.triangles
        rest = self.outline[1:]
        first = np.repeat(self.outline[:1], len(rest) - 1)
        return np.stack((first, rest[:-1], rest[1:]), axis=1)

    @property
    def edges(self) -> np.ndarray:
        """(e, 2) indices of corners."""
        if self.hull is not None:
            return self.hull.edges
        return np.stack((self.outline, np.roll(self.outline, -1)), axis=1)

    def quads(self, corners: FloatArray, chosen: np.ndarray | slice = slice(None)) -> FloatArray:
        """(q, 4, 3) its surface, or some of its triangles, three a triangle; corners as placed."""
        corner = corners[self.triangles[chosen]]
        middle = corner.mean(axis=1)
        side = (corner + np.roll(corner, -1, axis=1)) / 2
        parts = [np.stack((corner[:, k], side[:, k], middle, side[:, k - 1]), 1) for k in range(3)]
        return np.stack(parts, axis=1).reshape(-1, 4, 3)


def solids_of(data: ModelData, members: Members, size: float, position: FloatArray) -> list[Solid]:
    """The bodies of a drawing that are drawn as solids.

    Args:
        data: The model.
        members: The members of the drawing.
        size: Of the drawing [m].
        position: (nodes, 3) of the nodes in the reference [m].
    """
    if len(members) > _MOST_MEMBERS or not np.any(members.form == Form.RIGID):
        return []
    row_of = dict(zip(members.index.tolist(), range(len(members)), strict=True))
    made = []
    for body in bodies_of(data.arrays):
        rows = [row_of[i] for i in body.elements if i in row_of]
        solid = _solid(data, members, body, rows, size)
        if solid is not None and not _swallows(members, solid, position, size):
            made.append(solid)
    return made


def _solid(
    data: ModelData, members: Members, body: Body, rows: list[int], size: float
) -> Solid | None:
    given, elements = data.appearance, list(body.elements)
    if len(rows) < len(elements):
        return None
    has_section = np.any(given.cross_section[elements] != CrossSection.NONE)
    if has_section or np.any(given.dimensions[elements] > 0.0):
        return None
    carried = data.arrays.node_value[:3, list(body.positions)].T
    sheets = list(_sheets_at(data, members, body))
    points = np.concatenate((carried, *(edge for _, edge in sheets)))
    if len(points) > _MOST_POINTS or len(body.positions) < 2 or not (sheets or len(rows) > 1):
        return None
    frames = [np.eye(3), *members.frame[rows], *(frame for frame, _ in sheets)]
    extent = float(np.linalg.norm(np.ptp(points, axis=0)))
    thick = min(_THICK * size, _LIMIT * extent)
    box = thick * _BOX @ _fitting(points, frames, thick).T
    every = (points[:, None] + box).reshape(-1, 3)
    hull, outline = None, np.zeros(0, np.int64)
    if data.planar:
        every[:, 2] = 0.0
        outline = polygon_round(every[:, :2])
        if len(outline) < 3:
            return None
    else:
        hull = hull_round(every)
        if hull is None:
            return None
    return Solid(
        np.array(rows),
        every,
        hull,
        outline,
        members.colour[rows[0]],
        members.edge_colour[rows[0]],
        float(members.opacity[rows[0]]),
    )


def _sheets_at(
    data: ModelData, members: Members, body: Body
) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Frame (3, 3) and both ends (2, 3) of the edge of each sheet that ends clamped at a body."""
    if data.planar:
        return
    orientations, positions = list(body.orientations), list(body.positions)
    for end in (0, 2):
        place, turn = members.nodes[:, end], members.nodes[:, end + 1]
        there = np.isin(turn, orientations) & np.isin(place, positions)
        for row in np.flatnonzero(there & (members.form == Form.SHEET)).tolist():
            wide = int(np.argmax(members.section[row]))
            half = members.section[row, wide] / 2 * members.frame[row, :, 1 + wide]
            middle = data.arrays.node_value[:3, place[row]]
            yield members.frame[row], np.stack((middle - half, middle + half))


def _fitting(points: FloatArray, frames: list[FloatArray], thick: float) -> FloatArray:
    """(3, 3) of some frames, by columns, the one in which the box round points is least."""
    best, least = frames[0], np.inf
    for frame in frames:
        volume = float(np.prod(np.ptp(points @ frame, axis=0) + thick))
        if volume < least * (1.0 - _BETTER):
            best, least = frame, volume
    return best


def _swallows(members: Members, solid: Solid, position: FloatArray, size: float) -> bool:
    """Whether members of other parts run through a solid's inside."""
    others = np.ones(len(members), bool)
    others[solid.rows] = False
    ends = position[members.nodes[others][:, [0, 2]]]
    places = ends[:, :1] + _INNER[:, None] * (ends[:, 1:] - ends[:, :1])
    if solid.hull is None:
        corner = solid.corners[solid.outline]
        way = np.roll(corner, -1, axis=0) - corner
        normal = np.stack((way[:, 1], -way[:, 0], np.zeros(len(way))), axis=1)
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    else:
        normal = solid.hull.normal
    top = (solid.corners @ normal.T).max(axis=0)
    depth = (top - places @ normal.T).min(axis=-1)
    return bool(np.any(depth > _DEEP * _THICK * size))
