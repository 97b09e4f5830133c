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
from ...model.data import CrossSection, ModelData
from ...model.parts.forms import Form
from ...model.parts.parts import Body, bodies_of
from ...util.records import Frozen
from .members import Members
from .pose import Pose

#: By so much points are moved, parts of the extent, and so near to a plane they are in it.
_MOVED, _IN_PLANE = 1.0e-6, 1.0e-4
#: Cosine of the angle between faces from which on the edge between them is seen: 4 degrees.
_EDGE = 0.9976
#: What is nearer to a line than this part of the extent lies in it.
_FLAT = 1.0e-9


class Hull(NamedTuple):
    """A convex hull in space."""

    triangles: np.ndarray
    """(t, 3) indices of points, anticlockwise seen from outside; a closed surface."""
    face: np.ndarray
    """(t,) the flat face that each is a part of, from 0."""
    normal: FloatArray
    """(faces, 3) outward unit vectors."""
    edges: np.ndarray
    """(e, 2) indices of points: where faces meet at an angle that is seen."""
    beside: np.ndarray
    """(e, 2) those faces."""


def polygon_round(points: FloatArray) -> np.ndarray:
    """Indices of the corners of the convex polygon round points (n, 2), anticlockwise.

    Two of them where all lie in a line, one where all are one point.
    """
    extent = float(np.ptp(points, axis=0).max())
    if not extent > 0.0:
        return np.arange(1)
    order = np.lexsort(points.T[::-1]).tolist()
    halves = [_half(points, part, _FLAT * extent**2) for part in (order, order[::-1])]
    return np.array(list(dict.fromkeys(halves[0][:-1] + halves[1][:-1])))


def _half(points: FloatArray, order: list[int], least: float) -> list[int]:
    """The corners on the right of the way through points in order (Andrew's monotone chain)."""
    made: list[int] = []
    for i in order:
        while len(made) > 1:
            (ax, ay), (bx, by) = points[made[-1]] - points[made[-2]], points[i] - points[made[-2]]
            if ax * by - ay * bx > least:
                break
            made.pop()
        made.append(i)
    return made


def hull_round(points: FloatArray) -> Hull | None:
    """The convex hull of points (n, 3); None where all lie in a plane."""
    extent = float(np.ptp(points, axis=0).max()) if len(points) else 0.0
    apart = points - points.mean(axis=0) if len(points) else points
    if np.linalg.matrix_rank(apart, tol=_IN_PLANE * extent) != 3:
        return None
    chance = np.random.default_rng(7).uniform(-1.0, 1.0, points.shape)
    moved = points + _MOVED * extent * chance
    triangles = _triangles(moved)
    owner = {way: k for k, face in enumerate(triangles.tolist()) for way in _around(face)}
    a, b, c = np.moveaxis(moved[triangles], 1, 0)
    normal = np.cross(b - a, c - a)
    size = np.linalg.norm(normal, axis=1)
    normal /= size[:, None]
    face = np.full(len(triangles), -1)
    seeds: list[int] = []
    for seed in np.argsort(-size, kind="stable").tolist():
        if face[seed] >= 0:
            continue
        # The largest triangle and, from neighbour to neighbour, those in its plane.
        height = np.abs((points - a[seed]) @ normal[seed]) < _IN_PLANE * extent
        grown, face[seed] = [seed], len(seeds)
        for k in grown:
            for way in _around(triangles[k].tolist()):
                other = owner[way[::-1]]
                if face[other] < 0 and height[triangles[other]].all():
                    face[other] = len(seeds)
                    grown.append(other)
        seeds.append(seed)
    ways = np.array([way for way in owner if way[0] < way[1]])
    beside = np.array([(face[owner[a, b]], face[owner[b, a]]) for a, b in ways.tolist()])
    flat = normal[seeds]
    turns = np.sum(flat[beside[:, 0]] * flat[beside[:, 1]], axis=1) < _EDGE
    return Hull(triangles, face, flat, ways[turns], beside[turns])


def _around(face: list[int]) -> list[tuple[int, int]]:
    return [(face[k], face[(k + 1) % 3]) for k in range(3)]


def _triangles(points: FloatArray) -> np.ndarray:
    """(t, 3) triangles of the hull of points in general position."""
    first = _first_corners(points)
    inside = points[first].mean(axis=0)
    faces = np.array([_turned(points, np.delete(first, k), inside) for k in range(4)])
    rest = np.setdiff1d(np.arange(len(points)), first)
    farthest = np.argsort(-np.linalg.norm(points[rest] - inside, axis=1), kind="stable")
    for i in rest[farthest].tolist():
        a, b, c = np.moveaxis(points[faces], 1, 0)
        seen = np.sum(np.cross(b - a, c - a) * (points[i] - a), axis=1) > 0.0
        if seen.any():
            rim = _ways(faces[seen]) - _ways(faces[seen][:, ::-1])
            cone = np.array([(start, end, i) for start, end in sorted(rim)])
            faces = np.concatenate((faces[~seen], cone))
    return faces


def _ways(faces: np.ndarray) -> set[tuple[int, int]]:
    """The edges of triangles, each in the sense in which its triangle goes round."""
    return {way for face in faces.tolist() for way in _around(face)}


def _first_corners(points: FloatArray) -> np.ndarray:
    """Four points far from each other."""
    a = int(np.argmin(points[:, 0]))
    away = points - points[a]
    b = int(np.argmax(np.linalg.norm(away, axis=1)))
    along = away[b] / np.linalg.norm(away[b])
    across = away - np.outer(away @ along, along)
    c = int(np.argmax(np.linalg.norm(across, axis=1)))
    d = int(np.argmax(np.abs(away @ np.cross(along, across[c]))))
    return np.array([a, b, c, d])


def _turned(points: FloatArray, triangle: np.ndarray, inside: FloatArray) -> np.ndarray:
    """A triangle that goes round anticlockwise, seen from the side where `inside` is not."""
    a, b, c = points[triangle]
    return triangle if np.cross(b - a, c - a) @ (a - inside) > 0.0 else triangle[::-1]


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


@dataclass(frozen=True, eq=False)
class Solid(Frozen):
    """A rigid body in the reference configuration.

    Attributes:
        rows: Its members in the drawing; it moves with the first.
        corners: (v, 3) [m].
        hull: Its surface, of `corners`; in the plane with the normals of its sides.
        outline: (c,) its corners in the plane, anticlockwise; empty in space.
        colour: (3,) red, green, blue, 0 to 1.
        edge_colour: (3,) likewise; NaN where none is given.
        opacity: 0 to 1.
    """

    rows: np.ndarray
    corners: FloatArray
    hull: Hull
    outline: np.ndarray
    colour: FloatArray
    edge_colour: FloatArray
    opacity: float

    def placed(
        self, members: Members, reference: Pose, pose: Pose
    ) -> tuple[FloatArray, FloatArray]:
        """(v, 3) its corners in a pose [m], and the outward (faces, 3) unit vectors in space."""
        p, op = members.nodes[self.rows[0], :2]
        turn = pose.rotation[op].T
        corners = pose.position[p] + (self.corners - reference.position[p]) @ turn
        return corners, self.hull.normal @ turn

    def quads(self, corners: FloatArray, chosen: np.ndarray | slice = slice(None)) -> FloatArray:
        """(q, 4, 3) its surface, or some of its triangles, three a triangle; corners as placed."""
        corner = corners[self.hull.triangles[chosen]]
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
    outline = np.zeros(0, np.int64)
    if data.planar:
        every[:, 2] = 0.0
        outline = polygon_round(every[:, :2])
    hull = _polygon_hull(every, outline) if data.planar else hull_round(every)
    if hull is None:
        return None
    colours = members.colour[rows[0]], members.edge_colour[rows[0]]
    return Solid(np.array(rows), every, hull, outline, *colours, float(members.opacity[rows[0]]))


def _polygon_hull(points: FloatArray, outline: np.ndarray) -> Hull | None:
    """A polygon in the plane of points (n, 3); None where they lie in a line."""
    if len(outline) < 3:
        return None
    following = np.roll(outline, -1)
    first = np.repeat(outline[:1], len(outline) - 2)
    triangles = np.stack((first, outline[1:-1], outline[2:]), axis=1)
    way = points[following] - points[outline]
    normal = np.stack((way[:, 1], -way[:, 0], np.zeros(len(way))), axis=1)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    sides = np.arange(len(outline))
    edges = np.stack((outline, following), axis=1)
    return Hull(triangles, np.zeros(len(first), int), normal, edges, np.stack((sides, sides), 1))


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
    normal = solid.hull.normal
    top = (solid.corners @ normal.T).max(axis=0)
    depth = (top - places @ normal.T).min(axis=-1)
    return bool(np.any(depth > _DEEP * _THICK * size))
