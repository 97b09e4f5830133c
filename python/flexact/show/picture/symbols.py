# SPDX-License-Identifier: BSD-3-Clause
"""Supports, hinges and pin joints of spatial drawings, as solids."""

from __future__ import annotations

import numpy as np

from ...core.arrays import FloatArray
from ..drawing import Drawing, Pose, Support, axes_of, cylinders, joints_of
from ..drawing.colours import SUPPORT
from .canvas import Canvas
from .surfaces import OUTLINE, OUTLINE_WIDTH, Grid, add_grid

_ROUND = 20
_GROUND = (0.72, 0.73, 0.74)
_HATCH = (0.36, 0.38, 0.41)


def add_supports(canvas: Canvas, drawing: Drawing, pose: Pose) -> None:
    """Draw the supports; those that let a node slide go with it."""
    supports = drawing.supports
    place = pose.position[supports.node] + supports.offset
    for row in range(len(supports)):
        kind, size = supports.kind[row], float(supports.size[row])
        frame, half = supports.frame[row], supports.extent[row]
        if kind == Support.CLAMP:
            depth = float(supports.depth[row])
            _add_box(canvas, place[row], frame, (half[0], half[1]), depth)
        elif kind == Support.PIN:
            _add_pin(canvas, place[row], frame, size)
        elif kind == Support.SLIDE:
            _add_turned(canvas, place[row], frame, ((-1.1, 0.45), (0.0, 0.0)), size)
        else:
            rings = ((-0.7, 0.4), (0.0, 0.0), (0.7, 0.4))
            _add_turned(canvas, place[row], frame, rings, size)


def add_hinges(
    canvas: Canvas, drawing: Drawing, pose: Pose, colour: FloatArray | None = None
) -> None:
    """Draw the hinges of which it is known where they stand, as cylinders about their axes."""
    hinges = drawing.hinges
    colours = hinges.colour if colour is None else colour
    seen = np.flatnonzero((hinges.nodes[:, 0] >= 0) & hinges.seen)
    for body in cylinders(axes_of(hinges, pose, seen), hinges, corners=_ROUND):
        own, opacity = colours[body.member][:, None], hinges.opacity[body.member]
        add_grid(canvas, Grid(body.points, own, opacity, _edge()))


def add_joints(canvas: Canvas, drawing: Drawing, pose: Pose) -> None:
    """Draw balls where bars meet that turn freely about their ends."""
    node, radius = joints_of(drawing)
    angle = 2 * np.pi * np.arange(_ROUND) / _ROUND
    right, up, _ = canvas.view.axes
    disc = np.cos(angle)[:, None] * right + np.sin(angle)[:, None] * up
    place = pose.position[node]
    # As far before its middle as the ball that it stands for.
    for scale, shift, colour in ((1.0, 0.0, (0.55, 0.58, 0.62)), (0.55, 0.3, (0.75, 0.78, 0.81))):
        middle = place + (radius * shift)[:, None] * (0.5 * up - 0.5 * right)
        ring = middle[:, None] + (scale * radius)[:, None, None] * disc
        edge = np.array(OUTLINE) if scale == 1.0 else None
        nearer = radius * (1.01 if edge is None else 1.0)
        canvas.polygons(ring, np.array(colour), edge=edge, width=OUTLINE_WIDTH, nearer=nearer)


def _edge() -> FloatArray:
    return np.array([OUTLINE])


def _add_turned(
    canvas: Canvas,
    place: FloatArray,
    frame: FloatArray,
    rings: tuple[tuple[float, float], ...],
    size: float,
    corners: int = _ROUND,
) -> None:
    """Rings about ex of a frame: place along it and radius of each, parts of the size."""
    angle = 2 * np.pi * (np.arange(corners) + 0.5 * (corners == 4)) / corners
    circle = np.cos(angle)[:, None] * frame[:, 1] + np.sin(angle)[:, None] * frame[:, 2]
    points = np.stack([place + size * (x * frame[:, 0] + r * circle) for x, r in rings])[None]
    grid = Grid(points, np.array([[SUPPORT]]) * 1.35, np.ones(1), _edge())
    add_grid(canvas, grid)


def _add_pin(canvas: Canvas, place: FloatArray, frame: FloatArray, size: float) -> None:
    """A pyramid on a plate of ground."""
    _add_turned(canvas, place, frame, ((-1.0, 0.75), (0.0, 0.0)), size, corners=4)
    half = 0.85 * size
    _add_box(canvas, place - size * frame[:, 0], frame, (half, half), 0.28 * size)


def _add_box(
    canvas: Canvas,
    place: FloatArray,
    frame: FloatArray,
    half: tuple[float, float],
    thick: float,
) -> None:
    """A block of ground whose upper face lies at the place; its sides are hatched."""
    corner = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * np.array(half)
    upper = place + corner @ frame[:, 1:].T
    points = np.stack((upper - thick * frame[:, 0], upper))[None]
    grid = Grid(points, np.array([[_GROUND]]), np.ones(1), _edge())
    add_grid(canvas, grid)
    towards = canvas.view.axes[2]
    for side in range(4):
        first, last = points[0, :, side], points[0, :, (side + 1) % 4]
        normal = np.cross(last[0] - first[0], frame[:, 0])
        if normal @ towards > 0.0:
            _add_hatch(canvas, first, last, thick)


def _add_hatch(canvas: Canvas, first: FloatArray, last: FloatArray, thick: float) -> None:
    """Slanting lines over a side: `first` and `last` are its edges, from below to above."""
    length = float(np.linalg.norm(last[0] - first[0]))
    count = max(2, min(14, round(length / (0.55 * thick))))
    pitch = 1.0 / count
    lean = min(thick / length, 1.0) if length > 0.0 else 1.0
    lines = []
    for start in np.arange(-lean + pitch / 2, 1.0, pitch).tolist():
        # From (start, 0) to (start + lean, 1), cut at the edges.
        low, high = max(0.0, -start / lean), min(1.0, (1.0 - start) / lean)
        if high - low > 0.05:
            ends = [(start + share * lean, share) for share in (low, high)]
            lines.append([_on(first, last, u, v) for u, v in ends])
    canvas.lines(np.array(lines), np.array(_HATCH), 0.5)


def _on(first: FloatArray, last: FloatArray, u: float, v: float) -> FloatArray:
    lower, upper = (edge[0] + v * (edge[1] - edge[0]) for edge in (first, last))
    return np.asarray(lower + u * (upper - lower))
