# SPDX-License-Identifier: BSD-3-Clause
"""Shapes of solids: prisms with exact contours, and polyhedra; and what is asked of them.

A prism is a plane contour of lines, circles, ellipses and parabolas that is extruded at right
angles to its plane. Faces of a polyhedron are flat; it may be convex or not. Both are closed and
have an inside, and both become triangles, the same on both sides of each edge. Convex ones are
made of points (`hull`), and two of them are apart by so much at least (`apart`).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import IntEnum
from itertools import combinations
from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from ...util.records import Frozen, cached_property
from ...util.rotations import unit
from ..drawing.bodies import polygon_round, triangles_round

#: What is nearer to a plane than this part of the extent lies in it.
_FLAT = 1.0e-10
#: By which part of the extent points are moved that are to be in no plane.
_MOVED = 1.0e-6
#: Turn from corner to corner of a curve where it is made of chords [rad].
STEP = math.pi / 18


class Curve(IntEnum):
    """What a piece of a contour is."""

    LINE = 0
    CIRCLE = 1
    ELLIPSE = 2
    """Its axes along those of the contour."""
    PARABOLA = 3
    """Its vertex is in the middle between its ends, its axis along y."""


class Piece(NamedTuple):
    """A piece of a contour, to the start of the next one.

    Attributes:
        start: x and y of its start [m].
        curve: What it is.
        centre: Of a circle or an ellipse; of a parabola its vertex [m].
        axes: Half axes of an ellipse along x and y, twice the radius of a circle [m].
        left: Whether it goes anticlockwise about its centre.
    """

    start: tuple[float, float]
    curve: Curve = Curve.LINE
    centre: tuple[float, float] = (0.0, 0.0)
    axes: tuple[float, float] = (0.0, 0.0)
    left: bool = True

    def angles(self, end: tuple[float, float]) -> tuple[float, float]:
        """Where it starts and by how much it turns [rad], in the parameter of an ellipse."""
        (cx, cy), (a, b) = self.centre, self.axes
        first, last = (math.atan2((y - cy) / b, (x - cx) / a) for x, y in (self.start, end))
        whole = 2.0 * math.pi
        turn = (last - first) % whole if self.left else -((first - last) % whole)
        return first, turn or (whole if self.left else -whole)

    def inner(self, end: tuple[float, float], step: float) -> FloatArray:
        """(n, 2) points between its start and its end, so many that chords turn by a step."""
        if self.curve == Curve.LINE:
            return np.zeros((0, 2))
        if self.curve == Curve.PARABOLA:
            (x0, y0), (x1, _), (_, tip) = self.start, end, self.centre
            count = max(math.ceil(4.0 * math.atan(2.0 * abs((y0 - tip) / (x1 - x0))) / step), 2)
            s = np.arange(1, count) / count
            return np.column_stack((x0 + s * (x1 - x0), tip + (y0 - tip) * (2.0 * s - 1.0) ** 2))
        first, turn = self.angles(end)
        count = max(math.ceil(abs(turn) / step - 1.0e-9), 2)
        at = first + turn * np.arange(1, count) / count
        return np.asarray(self.centre + np.column_stack((np.cos(at), np.sin(at))) * self.axes)

    def beside(self, end: tuple[float, float]) -> float:
        """Area between it and its chord [m2], positive on the right of the way."""
        if self.curve == Curve.LINE:
            return 0.0
        if self.curve == Curve.PARABOLA:
            return 2.0 / 3.0 * (end[0] - self.start[0]) * (self.start[1] - self.centre[1])
        _, turn = self.angles(end)
        return self.axes[0] * self.axes[1] / 2.0 * (turn - math.sin(turn))


#: A closed contour, anticlockwise.
Contour = tuple[Piece, ...]


def polygon(points: Iterable[Iterable[float]]) -> Contour:
    """The contour with these corners (n, 2)."""
    return tuple(Piece((float(x), float(y))) for x, y in points)


def rectangle(low: tuple[float, float], high: tuple[float, float]) -> Contour:
    """The contour between two corners."""
    return polygon((low, (high[0], low[1]), high, (low[0], high[1])))


def circle(diameter: float) -> Contour:
    """The contour of one circle about the origin."""
    radius = diameter / 2.0
    return (Piece((radius, 0.0), Curve.CIRCLE, (0.0, 0.0), (radius, radius)),)


def ways(contour: Contour) -> Iterator[tuple[Piece, tuple[float, float]]]:
    """Each piece with its end."""
    for k, piece in enumerate(contour):
        yield piece, contour[(k + 1) % len(contour)].start


@dataclass(frozen=True, eq=False)
class Polyhedron(Frozen):
    """A solid with flat faces.

    Attributes:
        points: (n, 3) corners [m].
        faces: Indices of the corners of each face, anticlockwise seen from outside.
    """

    points: FloatArray
    faces: tuple[tuple[int, ...], ...]

    def moved(self, turn: FloatArray, shift: FloatArray) -> Polyhedron:
        """After a rotation (3, 3) about the origin and a shift (3,) [m]."""
        return Polyhedron(self.points @ turn.T + shift, self.faces)

    @cached_property
    def normals(self) -> FloatArray:
        """(faces, 3) outward unit vectors, by Newell's sum."""
        made = np.zeros((len(self.faces), 3))
        counts = np.array([len(face) for face in self.faces])
        for count in set(counts.tolist()):
            rows = np.flatnonzero(counts == count)
            corner = self.points[np.array([self.faces[row] for row in rows.tolist()])]
            corner = corner - corner[:, :1]
            made[rows] = np.cross(corner, np.roll(corner, -1, axis=1)).sum(axis=1)
        return np.asarray(unit(made))

    @cached_property
    def edges(self) -> FloatArray:
        """(e, 3) unit vectors along the edges, each direction once."""
        pairs = [
            (a, b)
            for face in self.faces
            for a, b in zip(face, (*face[1:], face[0]), strict=True)
            if a < b
        ]
        a, b = np.array(pairs).T
        return _distinct(unit(self.points[b] - self.points[a]))

    @property
    def volume(self) -> float:
        """[m3]."""
        a, b, c = (self.points[corner] - self.points[0] for corner in self.triangles().T)
        return float(np.sum(np.cross(a, b) * c) / 6.0)

    def triangles(self) -> np.ndarray:
        """(t, 3) indices of points."""
        made: list[tuple[int, int, int]] = []
        for face, normal in zip(self.faces, self.normals, strict=True):
            if len(face) == 3:
                made.append((face[0], face[1], face[2]))
                continue
            axis = int(np.argmax(np.abs(normal)))
            flat = np.delete(self.points[list(face)], axis, axis=1)
            turned = (normal[axis] < 0.0) != (axis == 1)
            order = range(len(face))[:: -1 if turned else 1]
            for a, b, c in cut_ears(flat[list(order)]):
                corner = face[order[a]], face[order[b]], face[order[c]]
                made.append((corner[0], corner[2], corner[1]) if turned else corner)
        return np.array(made, np.int64).reshape(-1, 3)

    def triangulated(self) -> tuple[FloatArray, np.ndarray]:
        """Points (n, 3) [m] and triangles (t, 3), a closed surface."""
        return self.points, self.triangles()


def _distinct(directions: FloatArray) -> FloatArray:
    """Of unit vectors (n, 3) that are parallel the first."""
    same = np.abs(directions @ directions.T) > 1.0 - 1.0e-12
    return np.asarray(directions[~np.any(np.tril(same, -1), axis=1)])


def cut_ears(points: FloatArray) -> list[tuple[int, int, int]]:
    """Triangles, as indices, of a simple polygon (n, 2) that goes anticlockwise.

    Meisters' two ears theorem: some corner can always be cut off. Corners in a line are cut off
    with their neighbours, so that each edge of the polygon is one of a triangle.
    """
    left, made = list(range(len(points))), []
    x: list[float] = points[:, 0].tolist()
    y: list[float] = points[:, 1].tolist()

    def area(a: int, b: int, c: int) -> float:
        return (x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])

    while len(left) > 3:
        found = 0
        for k in range(len(left)):
            a, b, c = left[k - 1], left[k], left[(k + 1) % len(left)]
            size = area(a, b, c)
            if size <= 0.0:
                continue
            inside = any(
                area(a, b, p) >= 0.0 and area(b, c, p) >= 0.0 and area(c, a, p) >= 0.0
                for p in left
                if p not in (a, b, c)
            )
            if not inside:
                # The roundest, so that triangles are no needles.
                around = math.dist(points[a], points[b]) + math.dist(points[b], points[c])
                found = k
                if size > 0.05 * around**2:
                    break
        a, b, c = left[found - 1], left[found], left[(found + 1) % len(left)]
        made.append((a, b, c))
        del left[found]
    return [*made, (left[0], left[1], left[2])]


@dataclass(frozen=True, eq=False)
class Prism(Frozen):
    """A contour that is extruded.

    Attributes:
        contour: In the plane of x and y.
        origin: (3,) where x, y and z are zero [m].
        frame: (3, 3) columns x, y, and z along which it is extruded, right-handed.
        length: By how much [m].
    """

    contour: Contour
    origin: FloatArray
    frame: FloatArray
    length: float

    def moved(self, turn: FloatArray, shift: FloatArray) -> Prism:
        """After a rotation (3, 3) about the origin and a shift (3,) [m]."""
        return Prism(self.contour, turn @ self.origin + shift, turn @ self.frame, self.length)

    @property
    def volume(self) -> float:
        """[m3]."""
        corner = np.array([piece.start for piece in self.contour])
        x, y = (corner - corner[0]).T
        area = float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2.0
        return self.length * (area + sum(piece.beside(end) for piece, end in ways(self.contour)))

    def outline(self, step: float = STEP) -> FloatArray:
        """(n, 2) the contour as a polygon."""
        made = []
        for piece, end in ways(self.contour):
            made += [np.array([piece.start]), piece.inner(end, step)]
        return np.concatenate(made)

    def polyhedron(self, step: float = STEP) -> Polyhedron:
        """The same with chords in place of curves."""
        flat = self.outline(step)
        n = len(flat)
        below = self.origin + flat @ self.frame[:, :2].T
        points = np.concatenate((below, below + self.length * self.frame[:, 2]))
        sides = [(k, (k + 1) % n, n + (k + 1) % n, n + k) for k in range(n)]
        return Polyhedron(points, (tuple(range(n))[::-1], tuple(range(n, 2 * n)), *sides))

    def triangulated(self) -> tuple[FloatArray, np.ndarray]:
        """Points (n, 3) [m] and triangles (t, 3), a closed surface."""
        return self.polyhedron().triangulated()


Shape = Prism | Polyhedron


def box(middle: FloatArray, frame: FloatArray, sizes: Sequence[float]) -> Polyhedron:
    """A box about a place, with sizes along the columns of a frame [m]."""
    x, y, z = (float(size) for size in sizes)
    corner = middle - frame[:, 2] * z / 2.0
    return Prism(rectangle((-x / 2.0, -y / 2.0), (x / 2.0, y / 2.0)), corner, frame, z).polyhedron()


#: Of more points no hull is made; of more than these not all planes through three are tried.
_MOST_POINTS, _FEW = 400, 20


def hull(points: FloatArray) -> Polyhedron | None:
    """The convex hull of points (n, 3); None where they lie in a plane or are very many.

    Its planes are through three of them and have all others on one side, so that faces are exact.
    """
    points = np.unique(np.round(points, 14), axis=0)
    if not 4 <= len(points) <= _MOST_POINTS:
        return None
    extent = float(np.linalg.norm(np.ptp(points, axis=0)))
    if len(points) > _FEW:
        # First those of points that are moved a little, so that no four are in a plane.
        chance = np.random.default_rng(7).uniform(-1.0, 1.0, points.shape)
        made = _hull_by(points, triangles_round(points + _MOVED * extent * chance), extent)
        if made is not None or len(points) > _MOST_POINTS // 5:
            return made
    return _hull_by(points, np.array(list(combinations(range(len(points)), 3))), extent)


def _hull_by(points: FloatArray, triples: np.ndarray, extent: float) -> Polyhedron | None:
    """The hull whose planes are among those through triples of points (m, 3); None if they miss."""
    i, j, k = triples.T
    normal = np.cross(points[j] - points[i], points[k] - points[i])
    size = np.linalg.norm(normal, axis=1)
    there = size > 1.0e-7 * extent**2
    normal, i = normal[there] / size[there, None], i[there]
    height = normal @ points.T - np.sum(normal * points[i], axis=1)[:, None]
    flat = _FLAT * extent
    above, below = np.any(height > flat, axis=1), np.any(height < -flat, axis=1)
    sided = above != below
    # Outwards is where no point is.
    outward = np.where(above[sided], -1.0, 1.0)[:, None] * normal[sided]
    lies = np.abs(height[sided]) <= flat
    if not len(lies):
        return None
    _, first = np.unique(np.packbits(lies, axis=1), axis=0, return_index=True)
    faces = []
    for row in sorted(first.tolist()):
        mine = np.flatnonzero(lies[row])
        x = unit(points[mine[1]] - points[mine[0]])
        across = np.stack((x, np.cross(outward[row], x)), axis=1)
        around = polygon_round((points[mine] - points[mine[0]]) @ across)
        if len(around) > 2:
            faces.append(tuple(mine[around].tolist()))
    edges = {(a, b) for face in faces for a, b in zip(face, (*face[1:], face[0]), strict=True)}
    if any((b, a) not in edges for a, b in edges):
        return None
    used = sorted({corner for face in faces for corner in face})
    place = {old: new for new, old in enumerate(used)}
    return Polyhedron(
        points[used], tuple(tuple(place[corner] for corner in face) for face in faces)
    )


def apart(one: Polyhedron, other: Polyhedron) -> float:
    """How far two convex solids are apart at least [m]; less than zero where they overlap.

    The largest gap along the normals of their faces and across both of two edges: where all of
    these overlap, the solids do (separating axes; Gottschalk, Lin and Manocha 1996).
    """
    crossed = np.cross(one.edges[:, None], other.edges[None]).reshape(-1, 3)
    size = np.linalg.norm(crossed, axis=1)
    axes = np.concatenate((one.normals, other.normals, crossed[size > 1.0e-6]))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    mine, theirs = one.points @ axes.T, other.points @ axes.T
    gap = np.maximum(theirs.min(axis=0) - mine.max(axis=0), mine.min(axis=0) - theirs.max(axis=0))
    return float(gap.max())


def rings_solid(rings: FloatArray, flat: float = 1.0e-10) -> Polyhedron:
    """A solid of rings of corners (s, c, 3), anticlockwise about the way from the first on.

    Sides that are not flat within a part of the extent are cut into triangles.
    """
    s, c, _ = rings.shape
    points = rings.reshape(-1, 3)
    extent = float(np.ptp(points, axis=0).max())
    faces: list[tuple[int, ...]] = [tuple(range(c))[::-1], tuple(range((s - 1) * c, s * c))]
    for first in range(0, (s - 1) * c, c):
        for k in range(c):
            quad = first + k, first + (k + 1) % c, first + c + (k + 1) % c, first + c + k
            p, q, r, t = points[list(quad)]
            normal = np.cross(r - p, t - q)
            height = abs(float((q - p) @ normal)) / (float(np.linalg.norm(normal)) or 1.0)
            if height <= flat * extent:
                faces.append(quad)
            else:
                faces += [quad[:3], (quad[0], quad[2], quad[3])]
    return Polyhedron(points, tuple(faces))
