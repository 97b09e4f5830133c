# SPDX-License-Identifier: BSD-3-Clause
"""Rigid bodies as solids: round the points that they carry and the ends of their sheets.

A body is a plate or a block with rounded edges round those points, where that is not much larger
than their convex hull; else the hull, rounded likewise. Its links are drawn as they are where a
deck or its maker gives them sections, where they are one bar without sheets, or where the solid
would swallow what does not belong to the body.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from ...model.data import BodyShape, CrossSection, ModelData
from ...model.parts.forms import Form
from ...model.parts.parts import Body, bodies_of
from ...util.records import Frozen
from ...util.rotations import frames_along, unit
from .members import Members
from .pose import Pose

#: By so much points are moved, parts of the extent, and so near to a plane they are in it.
_MOVED, _IN_PLANE = 1.0e-6, 1.0e-4
#: Cosine of the angle between faces from which on the edge between them is seen: 4 degrees.
_EDGE = 0.9976
#: And from which on it is drawn from any side: 18 degrees.
_SHARP = 0.951
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
    drawn: np.ndarray
    """(e,) which edges are drawn from any side; the others are where they bound what is seen."""


def polygon_round(points: FloatArray) -> np.ndarray:
    """Indices of the corners of the convex polygon round points (n, 2), anticlockwise.

    Two of them where all lie in a line, one where all are one point.
    """
    extent = float(np.ptp(points, axis=0).max())
    if not extent > 0.0:
        return np.arange(1)
    # What rounding tells apart is equal, else points on an upright side stand in no order.
    order = np.lexsort(np.round(points.T[::-1] / (_FLAT * extent))).tolist()
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
    triangles = triangles_round(moved)
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
    cosine = np.sum(flat[beside[:, 0]] * flat[beside[:, 1]], axis=1)
    turns = cosine < _EDGE
    return Hull(triangles, face, flat, ways[turns], beside[turns], cosine[turns] < _SHARP)


def _around(face: list[int]) -> list[tuple[int, int]]:
    return [(face[k], face[(k + 1) % 3]) for k in range(3)]


def triangles_round(points: FloatArray) -> np.ndarray:
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
_MOST_POINTS, MOST_MEMBERS = 120, 1500
#: Shapes of a body, and whether upright alone, in the order in which they are tried: where one
#: swallows others the next may not.
_TRIES = (("", False), ("", True), ("hull", False))
#: An axis fits a body better than another one by so much.
_BETTER = 1.0e-6
#: Places along other members, and how deep within a hull one may not lie, parts of the thickness.
_INNER, _DEEP = np.linspace(0.25, 0.75, 9), 0.3
#: Radius of the edges of plates: a part of the thickness that points need, and at most of half of
#: the plate's own; and the turn [rad] of a step on the way round a corner, and round a disc.
_EDGE_RADIUS, _ROUNDEST, _STEP, _FINE_STEP = 0.2, 0.8, np.pi / 6, np.pi / 24
#: Points that fill less of the plate round them are drawn as their hull.
_FULL = 0.4
#: What a body may be drawn as where its maker says it.
_SHAPES = {int(each): each.name.lower() for each in BodyShape if each}
#: Corners (v, 3) of a solid [m], outward unit vectors there (v, 3), and its surface.
Rounded = tuple[FloatArray, FloatArray, Hull]


def solid_of(
    points: FloatArray,
    shape: str = "",
    thickness: float = 0.0,
    *,
    least: float = 0.0,
    axes: FloatArray | None = None,
) -> Rounded | None:
    """A solid with rounded edges round points; None where there is none.

    Args:
        points: (n, 3) that lie within it [m].
        shape: "disc", "box", "hull", or "" for what fits.
        thickness: Of a plate, a disc or a box, and of what is round a hull [m]; 0: as thick as
            the points need.
        least: How thick it is at least; half of it is round the points [m]; 0: a part of their
            extent.
        axes: (k, 3) unit vectors along which it may be thick where the points are no plane; by
            default the principal axes of the points.
    """
    least = least or _THICK * float(np.linalg.norm(np.ptp(points, axis=0)))
    apart = points - points.mean(axis=0)
    if not least > 0.0:
        return None
    size, own = np.linalg.svd(np.concatenate((apart, np.zeros((3, 3)))), full_matrices=False)[1:]
    hull = hull_round(points)
    if hull is None and size[1] > _IN_PLANE * size[0]:
        axes = own[2:]
    frame, outline, volume = _plate_frame(points, own if axes is None else axes, least)
    flat, height = points @ frame[:, :2], points @ frame[:, 2]
    # Where points are nearly in a plane their hull is crumpled.
    if (
        hull is not None
        and np.ptp(height) > least
        and (shape == "hull" or (not shape and _volume(points, hull) < _FULL * volume))
    ):
        return _rounded_hull(points, hull, (thickness or least) / 2)
    middle, half = (height.max() + height.min()) / 2, float(np.ptp(height) + least) / 2
    corner, margin, step = flat[outline], least / 2, _STEP
    if shape == "disc":
        corner = (flat.max(axis=0) + flat.min(axis=0))[None] / 2
        margin += float(np.linalg.norm(flat - corner, axis=1).max())
        step = _FINE_STEP
    elif shape == "box":
        corner = _rectangle(corner)
    half = thickness / 2 if thickness > 0.0 else half
    radius = min(_EDGE_RADIUS * least, _ROUNDEST * half)
    base, way = _round_the_corners(corner, step)
    rings = (
        (margin - radius, half, 1.0),
        (margin, half - radius, 0.0),
        (margin, radius - half, 0.0),
        (margin - radius, -half, -1.0),
    )
    made, normal = [], []
    for out, up, turn in rings:
        made.append(np.column_stack((base + out * way, np.full(len(way), middle + up))))
        sideways = way if turn == 0.0 else np.zeros_like(way)
        normal.append(np.column_stack((sideways, np.full(len(way), turn))))
    corners = np.concatenate(made) @ frame.T
    return corners, np.concatenate(normal) @ frame.T, _hull_of_rings(corners, len(way), len(rings))


def _plate_frame(
    points: FloatArray, axes: FloatArray, least: float
) -> tuple[FloatArray, np.ndarray, float]:
    """The frame (3, 3) whose ez is the axis of the least plate round points.

    Of equally large ones it is the thinnest, of these the first. Besides, the points on its
    outline, anticlockwise, and the volume of the plate, without what is round the points [m3].
    """
    found, best = None, (np.inf, np.inf)
    for frame in frames_along(axes)[..., [1, 2, 0]]:
        flat = points @ frame[:, :2]
        outline = polygon_round(flat)
        (x, y), way = flat[outline].T, np.roll(flat[outline], -1, axis=0) - flat[outline]
        area = float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
        around = float(np.hypot(*way.T).sum())
        height = float(np.ptp(points @ frame[:, 2]))
        # Of a rectangle that of the box round it, so that all axes of boxes are equal.
        size = (area + around * least / 2 + least**2) * (height + least)
        is_less = size < best[0] * (1.0 - _BETTER)
        if is_less or (size < best[0] * (1.0 + _BETTER) and height < best[1] - _BETTER * least):
            found, best = (frame, outline, area * height), (size, height)
    assert found is not None
    return found


def _volume(points: FloatArray, hull: Hull) -> float:
    a, b, c = np.moveaxis(points[hull.triangles] - points.mean(axis=0), 1, 0)
    return float(np.abs(np.sum(np.cross(a, b) * c)) / 6)


def _rectangle(corner: FloatArray) -> FloatArray:
    """(4, 2) corners, anticlockwise, of the least rectangle round a convex polygon (c, 2)."""
    best, least = corner, np.inf
    for way in np.roll(corner, -1, axis=0) - corner if len(corner) > 1 else np.eye(2)[:1]:
        x = way / np.hypot(*way)
        turn = np.stack((x, (-x[1], x[0])), axis=1)
        low, high = (corner @ turn).min(axis=0), (corner @ turn).max(axis=0)
        if (size := float(np.prod(high - low))) < least * (1.0 - _BETTER) or least == np.inf:
            least = size
            best = np.array([low, (high[0], low[1]), high, (low[0], high[1])]) @ turn.T
    return best


def _round_the_corners(corner: FloatArray, step: float) -> tuple[FloatArray, FloatArray]:
    """(k, 2) corners of a convex polygon, repeated, and unit vectors round each of them."""
    way = np.roll(corner, -1, axis=0) - corner
    angle = np.arctan2(-way[:, 0], way[:, 1])
    base, ways = [], []
    for k, place in enumerate(corner):
        start, turn = angle[k - 1], (angle[k] - angle[k - 1]) % (2 * np.pi)
        whole = len(corner) == 1
        turn = 2 * np.pi if whole else turn
        count = max(int(np.ceil(turn / step - _BETTER)), 1)
        every = start + turn * np.arange(count + (not whole)) / count
        ways.append(np.column_stack((np.cos(every), np.sin(every))))
        base.append(np.broadcast_to(place, ways[-1].shape))
    return np.concatenate(base), np.concatenate(ways)


def _hull_of_rings(corners: FloatArray, around: int, rings: int) -> Hull:
    """The surface of a convex solid of rings of so many corners, from above to below."""
    here = np.arange(around)
    there = (here + 1) % around
    fan = np.stack((np.zeros(around - 2, int), here[1:-1], here[2:]), axis=1)
    behind = (rings - 1) * around
    band = np.arange(rings - 1)[:, None] * around
    a, b, c, d = (band + each for each in (here, there, around + here, around + there))
    sides = np.stack((np.stack((a, c, d), axis=-1), np.stack((a, d, b), axis=-1)), axis=2)
    triangles = np.concatenate((fan, sides.reshape(-1, 3), behind + fan[:, ::-1]))
    faces = 2 + np.arange((rings - 1) * around).reshape(rings - 1, around)
    face = np.concatenate(
        (np.zeros(len(fan), int), np.repeat(faces.ravel(), 2), np.ones(len(fan), int))
    )
    first = [0, len(triangles) - 1, *(len(fan) + 2 * np.arange(faces.size))]
    p, q, r = np.moveaxis(corners[triangles[first]], 1, 0)
    normal = unit(np.cross(q - p, r - p))
    # Round each ring, and from ring to ring.
    level = np.arange(rings)[:, None] * around
    along = np.stack((level + here, level + there), axis=-1)
    above = np.concatenate((np.zeros((1, around), int), faces))
    below = np.concatenate((faces, np.ones((1, around), int)))
    up = np.stack((a, c), axis=-1)
    edges = np.concatenate((along.reshape(-1, 2), up.reshape(-1, 2)))
    beside = np.concatenate(
        (
            np.stack((above, below), axis=-1).reshape(-1, 2),
            np.stack((np.roll(faces, 1, axis=1), faces), axis=-1).reshape(-1, 2),
        )
    )
    drawn = np.zeros(len(edges), bool)
    drawn[:around] = drawn[behind : behind + around] = True
    return Hull(triangles, face, normal, edges, beside, drawn)


def _rounded_hull(points: FloatArray, hull: Hull, margin: float) -> Rounded | None:
    """A convex hull with its faces moved outwards, and bevels between them."""
    pairs = np.unique(np.stack((hull.triangles.ravel(), np.repeat(hull.face, 3)), axis=1), axis=0)
    normal = hull.normal[pairs[:, 1]]
    corners = points[pairs[:, 0]] + margin * normal
    around = hull_round(corners)
    return None if around is None else (corners, normal, around)


@dataclass(frozen=True, eq=False)
class Solid(Frozen):
    """A rigid body in the reference configuration.

    Attributes:
        rows: Its members in the drawing; it moves with the first.
        corners: (v, 3) [m].
        normals: (v, 3) outward unit vectors at the corners, by which rounded edges look round.
        hull: Its surface, of `corners`; in the plane with the normals of its sides.
        outline: (c,) its corners in the plane, anticlockwise; empty in space.
        colour: (3,) red, green, blue, 0 to 1.
        edge_colour: (3,) likewise; NaN where none is given.
        opacity: 0 to 1.
    """

    rows: np.ndarray
    corners: FloatArray
    normals: FloatArray
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
    if len(members) > MOST_MEMBERS or not np.any(members.form == Form.RIGID):
        return []
    row_of = dict(zip(members.index.tolist(), range(len(members)), strict=True))
    made = []
    for body in bodies_of(data.arrays):
        rows = [row_of[i] for i in body.elements if i in row_of]
        asked = data.appearance.body_shape[list(body.elements)]
        wish = _SHAPES.get(int(asked.max(initial=0)), "")
        for shape, upright in ((wish, False),) if wish else _TRIES:
            solid = _solid(data, members, body, rows, size, shape, upright)
            if solid is not None and (wish or not _swallows(members, solid, position, size)):
                made.append(solid)
                break
    return made


def _solid(
    data: ModelData,
    members: Members,
    body: Body,
    rows: list[int],
    size: float,
    shape: str,
    upright: bool,
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
    colours = members.colour[rows[0]], members.edge_colour[rows[0]]
    look = (*colours, float(members.opacity[rows[0]]))
    if data.planar:
        base, way = _round_the_corners(points[polygon_round(points[:, :2]), :2], _STEP)
        ring = np.column_stack((base + thick / 2 * way, np.zeros(len(way))))
        normal = np.column_stack((way, np.zeros(len(way))))
        outline = np.arange(len(ring))
        hull = _polygon_hull(ring, outline)
        return None if hull is None else Solid(np.array(rows), ring, normal, hull, outline, *look)
    axes = np.eye(3)[::-1] if upright else np.concatenate([frame.T for frame in frames])
    asked = given.body_thickness[elements]
    thickness = float(np.nanmax(np.where(np.isnan(asked), 0.0, asked), initial=0.0))
    made = solid_of(points, shape, thickness, least=thick, axes=axes)
    if made is None:
        return None
    corners, normals, hull = made
    return Solid(np.array(rows), corners, normals, hull, np.zeros(0, np.int64), *look)


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
    beside, drawn = np.stack((sides, sides), axis=1), np.ones(len(edges), bool)
    return Hull(triangles, np.zeros(len(first), int), normal, edges, beside, drawn)


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
