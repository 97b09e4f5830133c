"""Planar scenes, drawn in their plane like an engineering drawing: no light and no depth.

What lies over what is said by small steps along z: sheets, bars, bodies, supports, hinges, joints.
"""

from __future__ import annotations

import numpy as np

from ..exchange import FloatArray
from ..scene import Pose, Scene, Support, solid
from .bodies import outline_of
from .drawing import SOLID, Drawing
from .surfaces import OUTLINE
from .visible import visible_joints, visible_stations

_ROUND = 28
_INK = np.array(OUTLINE)
_WHITE = np.ones(3)
_LINE = 0.7
#: Places along z, parts of the scene's size; of members by their form.
_HEIGHTS = np.array([0, 1, 1, 2, 3, 4])
_SUPPORT, _HINGE, _JOINT = 6, 8, 10
#: Joints at hinges and bars are at most so large: a part of the scene's size.
_DOT = 0.009


def add_members(
    drawing: Drawing,
    scene: Scene,
    pose: Pose,
    *,
    segments: int,
    colour: FloatArray | None = None,
    edge: FloatArray | None = None,
    layer: int = SOLID,
) -> None:
    """Draw the members of a planar scene.

    Args:
        drawing: Where to.
        scene: The scene.
        pose: Where its nodes are.
        segments: Of members that bend.
        colour: (k, 3) of all members, or (k, segments, 3) along them; by default their own.
        edge: (3,) of all outlines; by default the members' own.
        layer: Of the drawing.
    """
    members = scene.members
    given = members.colour if colour is None else colour
    given = given if given.ndim == 3 else given[:, None]
    for strip in visible_stations(members, pose, segments):
        for body in solid(strip, members, planar=True):
            points = _in_pieces(body.points, given.shape[1])
            pieces = points.shape[1] - 1
            above = _HEIGHTS[members.form[body.member]] * scene.size
            lower, upper = points[:, :, 0], points[:, :, 1]
            quads = np.stack((lower[:, :-1], upper[:, :-1], upper[:, 1:], lower[:, 1:]), axis=2)
            drawing.polygons(
                quads.reshape(-1, 4, 3),
                np.broadcast_to(given[body.member], (len(points), pieces, 3)).reshape(-1, 3),
                opacity=np.repeat(members.opacity[body.member], pieces),
                nearer=np.repeat(above, pieces),
                layer=layer,
            )
            around = np.concatenate((lower, upper[:, ::-1], lower[:, :1]), axis=1)
            line = outline_of(members, body.member) if edge is None else edge
            drawing.lines(around, line, _LINE, nearer=above + 0.1 * scene.size, layer=layer)


def _in_pieces(points: FloatArray, pieces: int) -> FloatArray:
    """(k, s, c, 3) points of straight members at as many stations as pieces need."""
    if pieces == 1 or points.shape[1] > 2:
        return points
    share = np.linspace(0.0, 1.0, pieces + 1)[None, :, None, None]
    return np.asarray((1 - share) * points[:, :1] + share * points[:, 1:])


def add_hinges(
    drawing: Drawing, scene: Scene, pose: Pose, colour: FloatArray | None = None
) -> None:
    """Draw the hinges as circles, and joints of bars as dots."""
    hinges = scene.hinges
    there = (hinges.nodes[:, 0] >= 0) & (hinges.opacity > 0.0)
    colours = hinges.colour[there]
    fill = np.full_like(colours, 1.0) if colour is None else colour[there]
    rim = OUTLINE if colour is not None or not len(colours) else tuple(colours[0])
    _discs(
        drawing,
        pose.position[hinges.nodes[there, 0]],
        np.minimum(hinges.size[there, 1] / 2, 0.016 * scene.size),
        fill,
        rim,
        _HINGE * scene.size,
        1.6,
    )
    node, radius = visible_joints(scene)
    radius = np.minimum(radius, _DOT * scene.size)
    _discs(drawing, pose.position[node], radius, _WHITE, OUTLINE, _JOINT * scene.size, 1.0)


def add_supports(drawing: Drawing, scene: Scene, pose: Pose) -> None:
    """Draw the supports; those that let a node slide go with it."""
    supports = scene.supports
    for row in range(len(supports)):
        place = pose.position[supports.node[row]]
        size, kind = float(supports.size[row]), supports.kind[row]
        direction = supports.direction[row]
        if kind == Support.TURN:
            _square(drawing, place, size, _SUPPORT * scene.size)
            continue
        frame = _frame(direction)
        if kind == Support.CLAMP:
            half = 0.3 * size + float(supports.extent[row].max())
            _ground(drawing, place, frame, half, size, scene.size)
        else:
            _triangle(drawing, place, frame, size, scene.size, kind == Support.SLIDE)


def _frame(direction: FloatArray) -> FloatArray:
    """(2, 3): along the ground, and from the ground upwards."""
    return np.stack((np.array((direction[1], -direction[0], 0.0)), direction))


def _ground(
    drawing: Drawing, place: FloatArray, frame: FloatArray, half: float, size: float, whole: float
) -> None:
    """A line of ground with hatching below it."""
    along, up = frame
    ends = np.stack((place - half * along, place + half * along))
    drawing.lines(ends[None], _INK, 1.4, nearer=_SUPPORT * whole)
    count = max(3, round(2 * half / (0.34 * size)))
    start = np.linspace(-half, half, count + 1)[1:]
    depth = 0.42 * size
    top = place + start[:, None] * along
    below = top - depth * along - depth * up
    drawing.lines(np.stack((top, below), axis=1), _INK, 0.7, nearer=_SUPPORT * whole)


def _triangle(
    drawing: Drawing,
    place: FloatArray,
    frame: FloatArray,
    size: float,
    whole: float,
    rolling: bool,
) -> None:
    along, up = frame
    base = place - size * up
    corners = np.stack((place, base - 0.6 * size * along, base + 0.6 * size * along))
    drawing.polygons(corners[None], _WHITE, edge=_INK, width=1.1, nearer=_SUPPORT * whole)
    if rolling:
        radius = 0.17 * size
        middle = base - radius * up + np.array([[-0.33], [0.33]]) * size * along
        _discs(drawing, middle, np.full(2, radius), _WHITE, OUTLINE, _SUPPORT * whole, 1.0)
        base = base - 2 * radius * up
    _ground(drawing, base, frame, 0.85 * size, size, whole)
    _discs(drawing, place[None], np.full(1, 0.17 * size), _WHITE, OUTLINE, _HINGE * whole, 1.0)


def _square(drawing: Drawing, place: FloatArray, size: float, above: float) -> None:
    """A rotation that is held, while the node may slide."""
    corner = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * 0.4 * size
    drawing.polygons((place + corner)[None], _WHITE, edge=_INK, width=1.1, nearer=above)


def _discs(
    drawing: Drawing,
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
    drawing.polygons(ring, colour, edge=np.array(edge), width=width, nearer=above)
