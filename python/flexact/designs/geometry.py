# SPDX-License-Identifier: BSD-3-Clause
"""Lines, rectangles and boxes: what part of a line is in a box, how far flexures are apart.

A flexure is one or more *strips*, (3, 3): the two ends of the middle line of a rectangle and half
of its width, as a vector; of a wire half the width is zero. Distances are closed forms: of two
rectangles that do not meet, the least distance is between two edges, or between a corner and the
face of the other one (Ericson, *Real-Time Collision Detection*, 2005, sections 5.1.9 and 5.1.4).
"""

from __future__ import annotations

import numpy as np

from ..core.arrays import BoolArray, FloatArray

#: What is smaller is zero, of lengths in parts of the size of a problem.
TINY = 1.0e-9
#: By so much a place may be outside of a region, and a line miss one, for rounding.
SLACK = 1.0e-12


def within(points: FloatArray, low: FloatArray, high: FloatArray) -> BoolArray:
    """Whether points, (..., 3), are in a box."""
    return np.asarray(((points >= low - TINY) & (points <= high + TINY)).all(axis=-1))


def cut(
    points: FloatArray, directions: FloatArray, low: FloatArray, high: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The first and last parameter at which lines are in a box; first > last where they miss it.

    Where they touch it rounding may make the last less than the first, by less than `SLACK`.

    Args:
        points: (n, 3) of the lines.
        directions: (n, 3) along them.
        low: (3,) of the box.
        high: (3,) of the box.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        one, other = (low - points) / directions, (high - points) / directions
    still = np.abs(directions) < TINY
    inside = (points >= low - SLACK) & (points <= high + SLACK)
    first = np.where(still, np.where(inside, -np.inf, np.inf), np.minimum(one, other))
    last = np.where(still, np.where(inside, np.inf, -np.inf), np.maximum(one, other))
    return first.max(axis=-1), last.min(axis=-1)


def between_segments(p: FloatArray, q: FloatArray, r: FloatArray, s: FloatArray) -> FloatArray:
    """The least distance of segments pq and rs, (..., 3) each; they may be points."""
    d, e, w = q - p, s - r, p - r
    a, f = (d * d).sum(-1), (e * e).sum(-1)
    b, c, g = (d * e).sum(-1), (d * w).sum(-1), (e * w).sum(-1)
    small = 1.0e-30
    denominator = a * f - b * b
    on_first = np.where(
        denominator > 1.0e-12 * a * f + small,
        np.clip((b * g - c * f) / np.maximum(denominator, small), 0.0, 1.0),
        0.0,
    )
    on_second = (b * on_first + g) / np.maximum(f, small)
    kept = np.clip(on_second, 0.0, 1.0)
    # Where the second was cut off, the first is that nearest to its end.
    on_first = np.where(
        (on_second != kept) | (f <= small),
        np.clip((b * kept - c) / np.maximum(a, small), 0.0, 1.0),
        on_first,
    )
    on_first = np.where(a <= small, 0.0, on_first)
    kept = np.where(f <= small, 0.0, kept)
    apart = w + on_first[..., None] * d - kept[..., None] * e
    return np.asarray(np.sqrt((apart * apart).sum(-1)))


def edges_of(strips: FloatArray) -> FloatArray:
    """(..., 4, 2, 3) the edges of strips, (..., 3, 3)."""
    a, b, h = strips[..., 0, :], strips[..., 1, :], strips[..., 2, :]
    corners = np.stack((a - h, b - h, b + h, a + h), axis=-2)
    return np.stack((corners, np.roll(corners, -1, axis=-2)), axis=-2)


def between_strips(one: FloatArray, others: FloatArray) -> FloatArray:
    """(n,) the least distances of strips; zero where they meet.

    Args:
        one: (3, 3) one strip, or (n, 3, 3) as many.
        others: (n, 3, 3).
    """
    if not len(others):
        return np.zeros(0)
    mine = one if one.ndim == 3 else one[None]
    thin, slim = not mine[:, 2].any(), not others[:, 2].any()
    if thin and slim:
        return between_segments(mine[:, 0], mine[:, 1], others[:, 0], others[:, 1])
    # A segment is one edge of itself.
    first = mine[:, None, :2] if thin else edges_of(mine)
    second = others[:, None, :2] if slim else edges_of(others)
    found = between_segments(
        *(first[:, :, None, 0], first[:, :, None, 1]),
        *(second[:, None, :, 0], second[:, None, :, 1]),
    ).min(axis=(1, 2))
    if not slim:
        found = np.minimum(found, _to_faces(first, others))
    if not thin:
        found = np.minimum(found, _to_faces(second, np.broadcast_to(mine, others.shape)))
    return np.asarray(found)


def _to_faces(edges: FloatArray, strips: FloatArray) -> FloatArray:
    """(n,) of edges, (n or 1, e, 2, 3), from the insides of faces of strips; infinite beside."""
    starts, ends = edges[:, :, 0], edges[:, :, 1]
    a, b, h = strips[:, 0], strips[:, 1], strips[:, 2]
    along, half = (b - a) / 2.0, h
    middle = (a + b) / 2.0
    normal = np.cross(along, half)
    size = np.linalg.norm(normal, axis=1)
    flat = size > 0.0
    normal = normal / np.where(flat, size, 1.0)[:, None]

    def inside(points: FloatArray) -> BoolArray:
        off = points - middle[:, None]
        u = (off * along[:, None]).sum(-1) / np.maximum((along * along).sum(-1), 1e-300)[:, None]
        v = (off * half[:, None]).sum(-1) / np.maximum((half * half).sum(-1), 1e-300)[:, None]
        return np.asarray((np.abs(u) <= 1.0) & (np.abs(v) <= 1.0) & flat[:, None])

    heights = ((starts - middle[:, None]) * normal[:, None]).sum(-1)
    there = ((ends - middle[:, None]) * normal[:, None]).sum(-1)
    found = np.minimum(
        np.where(inside(starts), np.abs(heights), np.inf).min(axis=1),
        np.where(inside(ends), np.abs(there), np.inf).min(axis=1),
    )
    # An edge that goes through the face.
    through = heights * there < 0.0
    share = heights / np.where(through, heights - there, 1.0)
    crossing = starts + share[..., None] * (ends - starts)
    return np.where((through & inside(crossing)).any(axis=1), 0.0, found)


def meets_box(strips: FloatArray, low: FloatArray, high: FloatArray) -> BoolArray:
    """(n,) whether strips, (n, 3, 3), have a point in a box: by separating axes."""
    middle, reach = (low + high) / 2.0, (high - low) / 2.0
    a, b, h = strips[:, 0], strips[:, 1], strips[:, 2]
    centre, along = (a + b) / 2.0 - middle, (b - a) / 2.0
    axes = [np.broadcast_to(axis, centre.shape) for axis in np.eye(3)]
    axes += [np.cross(along, h), along, h]
    axes += [np.cross(axis, each) for axis in np.eye(3) for each in (along, h)]
    apart = np.zeros(len(strips), dtype=bool)
    for axis in axes:
        gap = np.abs((centre * axis).sum(-1)) - (np.abs(axis) * reach).sum(-1)
        gap -= np.abs((along * axis).sum(-1)) + np.abs((h * axis).sum(-1))
        apart |= gap > 1.0e-12
    return ~apart
