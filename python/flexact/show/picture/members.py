# SPDX-License-Identifier: BSD-3-Clause
"""Planar drawings, drawn in their plane like an engineering canvas: no light and no depth.

What lies over what is said by small steps along z: sheets, bars, bodies, supports, hinges, joints.
"""

from __future__ import annotations

import numpy as np

from ...core.arrays import FloatArray
from ..drawing import Drawing, Pose, Support, joints_of, solid, stations
from .canvas import SOLID, Canvas
from .picture_members import in_pieces, outline_of
from .surfaces import OUTLINE

_ROUND = 28
_INK = np.array(OUTLINE)
_WHITE = np.ones(3)
_LINE = 0.7
#: Places along z, parts of the drawing's size; of members by their form.
_HEIGHTS = np.array([0, 1, 1, 2, 3, 4])
_SUPPORT, _PIN, _HINGE, _JOINT = 6, 7, 8, 10
#: Joints at hinges and bars are at most so large: a part of the drawing's size.
_DOT = 0.009


def add_members(
    canvas: Canvas,
    drawing: Drawing,
    pose: Pose,
    segments: int,
    colour: FloatArray | None = None,
    *,
    edge: FloatArray | None = None,
    layer: int = SOLID,
) -> None:
    """Draw the members of a planar drawing.

    Args:
        canvas: Where to.
        drawing: The drawing.
        pose: Where its nodes are.
        segments: Of members that bend.
        colour: (k, 3) of all members, or (k, segments, 3) along them; by default their own.
        edge: (3,) of all outlines; by default the members' own.
        layer: Of the canvas.
    """
    members = drawing.members
    given = members.colour if colour is None else colour
    given = given if given.ndim == 3 else given[:, None]
    for strip in stations(members, pose, segments, drawing.seen):
        for body in solid(strip, members, planar=True):
            points = in_pieces(body.points, given.shape[1])
            pieces = points.shape[1] - 1
            above = _HEIGHTS[members.form[body.member]] * drawing.size
            lower, upper = points[:, :, 0], points[:, :, 1]
            quads = np.stack((lower[:, :-1], upper[:, :-1], upper[:, 1:], lower[:, 1:]), axis=2)
            canvas.polygons(
                quads.reshape(-1, 4, 3),
                np.broadcast_to(given[body.member], (len(points), pieces, 3)).reshape(-1, 3),
                opacity=np.repeat(members.opacity[body.member], pieces),
                nearer=np.repeat(above, pieces),
                layer=layer,
            )
            around = np.concatenate((lower, upper[:, ::-1], lower[:, :1]), axis=1)
            line = outline_of(members, body.member) if edge is None else edge
            canvas.lines(around, line, _LINE, nearer=above + 0.1 * drawing.size, layer=layer)


def add_hinges(
    canvas: Canvas, drawing: Drawing, pose: Pose, colour: FloatArray | None = None
) -> None:
    """Draw the hinges as circles, and joints of bars as dots."""
    hinges = drawing.hinges
    there = (hinges.nodes[:, 0] >= 0) & hinges.seen
    colours = hinges.colour[there]
    fill = np.full_like(colours, 1.0) if colour is None else colour[there]
    rim = OUTLINE if colour is not None or not len(colours) else tuple(colours[0])
    _discs(
        canvas,
        pose.position[hinges.nodes[there, 0]],
        np.minimum(hinges.size[there, 1] / 2, 0.016 * drawing.size),
        fill,
        rim,
        _HINGE * drawing.size,
        1.6,
    )
    node, radius = joints_of(drawing)
    radius = np.minimum(radius, _DOT * drawing.size)
    _discs(canvas, pose.position[node], radius, _WHITE, OUTLINE, _JOINT * drawing.size, 1.0)


def add_supports(canvas: Canvas, drawing: Drawing, pose: Pose) -> None:
    """Draw the supports; those that let a node slide go with it."""
    supports = drawing.supports
    for row in range(len(supports)):
        place = pose.position[supports.node[row]] + supports.offset[row]
        size, kind = float(supports.size[row]), supports.kind[row]
        direction = supports.direction[row]
        if kind == Support.TURN:
            _square(canvas, place, size, _SUPPORT * drawing.size)
            continue
        frame = _frame(direction)
        if kind == Support.CLAMP:
            half = 0.3 * size + float(supports.extent[row].max())
            _ground(canvas, place, frame, half, size, drawing.size)
        else:
            _triangle(canvas, place, frame, size, drawing.size, kind == Support.SLIDE)


def _frame(direction: FloatArray) -> FloatArray:
    """(2, 3): along the ground, and from the ground upwards."""
    return np.stack((np.array((direction[1], -direction[0], 0.0)), direction))


def _ground(
    canvas: Canvas, place: FloatArray, frame: FloatArray, half: float, size: float, whole: float
) -> None:
    """A line of ground with hatching below it."""
    along, up = frame
    ends = np.stack((place - half * along, place + half * along))
    canvas.lines(ends[None], _INK, 1.4, nearer=_SUPPORT * whole)
    count = max(3, round(2 * half / (0.34 * size)))
    start = np.linspace(-half, half, count + 1)[1:]
    depth = 0.42 * size
    top = place + start[:, None] * along
    below = top - depth * along - depth * up
    canvas.lines(np.stack((top, below), axis=1), _INK, 0.7, nearer=_SUPPORT * whole)


def _triangle(
    canvas: Canvas,
    place: FloatArray,
    frame: FloatArray,
    size: float,
    whole: float,
    rolling: bool,
) -> None:
    along, up = frame
    base = place - size * up
    corners = np.stack((place, base - 0.6 * size * along, base + 0.6 * size * along))
    canvas.polygons(corners[None], _WHITE, edge=_INK, width=1.1, nearer=_SUPPORT * whole)
    if rolling:
        radius = 0.17 * size
        middle = base - radius * up + np.array([[-0.33], [0.33]]) * size * along
        _discs(canvas, middle, np.full(2, radius), _WHITE, OUTLINE, _SUPPORT * whole, 1.0)
        base = base - 2 * radius * up
    _ground(canvas, base, frame, 0.85 * size, size, whole)
    _discs(canvas, place[None], np.full(1, 0.17 * size), _WHITE, OUTLINE, _PIN * whole, 1.0)


def _square(canvas: Canvas, place: FloatArray, size: float, above: float) -> None:
    """A rotation that is held, while the node may slide."""
    corner = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * 0.4 * size
    canvas.polygons((place + corner)[None], _WHITE, edge=_INK, width=1.1, nearer=above)


def _discs(
    canvas: Canvas,
    place: FloatArray,
    radius: FloatArray,
    colour: FloatArray,
    edge: tuple[float, ...],
    above: float,
    width: float,
) -> None:
    angle = 2 * np.pi * np.arange(_ROUND) / _ROUND
    circle = np.column_stack((np.cos(angle), np.sin(angle), np.zeros(_ROUND)))
    ring = place[:, None] + radius[:, None, None] * circle
    canvas.polygons(ring, colour, edge=np.array(edge), width=width, nearer=above)
