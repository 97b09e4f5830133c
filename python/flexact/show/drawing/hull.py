# SPDX-License-Identifier: BSD-3-Clause
"""Convex hulls for drawing: polygons round points in a plane, faces round some hundred in space.

Points are moved at random by less than anybody sees, so that no four lie in a plane and no three
in a line; then triangles grow from a first tetrahedron, point by point, the farthest first: those
that a point sees make way for a cone from it to the rim of what it sees (the incremental method;
O'Rourke, Computational Geometry in C, 1998, chapter 4). Neighbours that lie in one plane but for
what nobody sees are one face.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray

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
    moved = _moved(points, extent)
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


def _moved(points: FloatArray, extent: float) -> FloatArray:
    chance = np.random.default_rng(7)
    return points + _MOVED * extent * chance.uniform(-1.0, 1.0, points.shape)


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
