# SPDX-License-Identifier: BSD-3-Clause
"""Planar drawings, drawn in their plane like an engineering canvas: no light and no depth.

What lies over what is said by small steps along z: sheets, bars, bodies, supports, hinges, joints.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...util.rotations import unit
from ..drawing import Drawing, Form, Members, Pose, Strip, Support, joints_of, solid, stations
from ..drawing.members import GHOST as GHOST_COLOUR
from ..drawing.members import GHOST_FACE as PALE
from .canvas import GHOST, SOLID, Canvas
from .stress import OUTLINE, OUTLINE_WIDTH, PIECES, SHADE, Grid, Stress, add_grid, lit

#: Above sheets and bars in the plane, a part of the drawing's size, and width of its outline [pt].
_HEIGHT, _LINE = 4.0, 0.7


def add_bodies(
    canvas: Canvas,
    drawing: Drawing,
    pose: Pose,
    *,
    face: FloatArray | None = None,
    edge: FloatArray | None = None,
    layer: int = SOLID,
    shade: float = SHADE,
) -> None:
    """Draw the bodies that are solids.

    Args:
        canvas: Where to.
        drawing: The drawing.
        pose: Where its nodes are.
        face: (3,) colour of all faces; by default their own.
        edge: (3,) of all edges; by default their own.
        layer: Of the canvas.
        shade: The part of their colours that they keep where no light falls on them; 1: flat.
    """
    for each in drawing.solids:
        if not each.opacity > 0.0:
            continue
        own = each.colour if face is None else face
        given = np.where(np.isnan(each.edge_colour), OUTLINE, each.edge_colour)
        line = given if edge is None else edge
        corners, normal = each.placed(drawing.members, drawing.reference, pose)
        if each.hull is None:
            ring = corners[each.outline][None]
            above = _HEIGHT * drawing.size
            canvas.polygons(ring, own, opacity=each.opacity, nearer=above, layer=layer)
            around = np.concatenate((ring, ring[:, :1]), axis=1)
            canvas.lines(around, line, _LINE, nearer=above + 0.1 * drawing.size, layer=layer)
            continue
        front = normal @ canvas.view.axes[2] > 1.0e-9
        chosen = front[each.hull.face]
        shaded = own * lit(normal[each.hull.face[chosen]], canvas.view, shade)
        quads = each.quads(corners, chosen)
        colours = np.repeat(shaded, 3, axis=0)
        canvas.polygons(quads, colours, opacity=each.opacity, layer=layer)
        seen = each.hull.edges[front[each.hull.beside].any(axis=1)]
        canvas.lines(corners[seen], line, OUTLINE_WIDTH, layer=layer)


#: Up to so many members, a bent one has so many segments and a round section so many corners.
_LEVELS = ((60, 32, 18), (400, 16, 10), (1500, 8, 6))
#: Up to so many members the colours of a self-stress change smoothly along them.
FEW = 60
#: Round members are thick, and have twice as many corners, beyond this part of the drawing's size.
_THICK = 0.05
GHOST_FACE = np.array(PALE)
GHOST_EDGE = 0.25 + 0.75 * np.array(GHOST_COLOUR)
#: What colours that mean values keep where no light falls on them.
_SHADE_OF_STRESS = 0.84
#: Of very many members up to so many sheets have their width; beyond, all are lines.
_MOST_STRIPS = 12_000
_SEGMENTS = 4
#: Widths of lines [pt] up to that number, and beyond.
_WIDE, _NARROW = 1.3, 0.6
_DARKER = 0.85


@dataclass(frozen=True)
class Detail:
    """How finely members are drawn: segments of bent ones, corners of round sections."""

    segments: int
    corners: int


def detail_of(drawing: Drawing) -> Detail | None:
    """How finely the members of a drawing are drawn; None where they are too many for solids."""
    count = len(drawing.members)
    return next((Detail(s, c) for most, s, c in _LEVELS if count <= most), None)


def outline_of(members: Members, member: np.ndarray) -> FloatArray:
    """(k, 3) colours of edges."""
    given = members.edge_colour[member]
    return np.where(np.isnan(given), OUTLINE, given)


def add_solids(
    canvas: Canvas, drawing: Drawing, pose: Pose, detail: Detail, stress: Stress | None = None
) -> None:
    """Draw the members, coloured by a self-stress if there is one."""
    members, pieces, segments = drawing.members, 1, detail.segments
    if stress is not None:
        if (stress.pieces > 1 or stress.has_diagram) and len(members) <= FEW:
            segments = PIECES
        pieces = min(stress.pieces, segments)
    for strip in stations(members, pose, segments, drawing.seen):
        for body in solid(strip, members, corners=_corners(drawing, strip, detail)):
            points = in_pieces(body.points, pieces)
            at = np.linspace(0.0, 1.0, points.shape[1])
            own = (
                stress.colours(body.member, at) if stress else members.colour[body.member][:, None]
            )
            edges = outline_of(members, body.member)
            joined = members.joined[body.member]
            grid = Grid(points, own, members.opacity[body.member], edges, joined)
            add_grid(canvas, grid, shade=_SHADE_OF_STRESS if stress else SHADE)


def in_pieces(points: FloatArray, pieces: int) -> FloatArray:
    """(k, s, c, 3) points of straight members at as many stations as pieces need."""
    if pieces == 1 or points.shape[1] > 2:
        return points
    share = np.linspace(0.0, 1.0, pieces + 1)[None, :, None, None]
    return np.asarray((1 - share) * points[:, :1] + share * points[:, 1:])


def add_ghosts(canvas: Canvas, drawing: Drawing, detail: Detail) -> None:
    """Draw the reference shape, pale and behind everything else."""
    members = drawing.members
    for strip in stations(members, drawing.reference, detail.segments, drawing.seen):
        for body in solid(strip, members, corners=_corners(drawing, strip, detail)):
            pale, joined = GHOST_FACE[None, None], members.joined[body.member]
            grid = Grid(body.points, pale, np.ones(1), GHOST_EDGE[None], joined)
            add_grid(canvas, grid, layer=GHOST, shade=1.0)


def _corners(drawing: Drawing, strip: Strip, detail: Detail) -> int:
    round_ = strip.member[drawing.members.round[strip.member]]
    thick = drawing.members.section[round_].max(initial=0.0) > _THICK * drawing.size
    return detail.corners * (2 if thick else 1)


def add_many(
    canvas: Canvas, drawing: Drawing, pose: Pose, stress: Stress | None, ghosts: bool
) -> None:
    """Draw very many members, with their reference shape behind them if `ghosts`.

    Sheets are strips without thickness, the rest lines. A stressed member has the colour of its
    larger end.
    """
    members = drawing.members
    few = len(members) <= _MOST_STRIPS
    width = _WIDE if few else _NARROW
    if ghosts:
        for strip in stations(members, drawing.reference, 1, members.seen):
            canvas.lines(strip.centre[:, [0, -1]], GHOST_EDGE, width / 2, layer=GHOST)
    colour = members.colour if stress is None else stress.member_colours()
    loud = np.zeros(len(members), bool) if stress is None else stress.is_loud()
    is_sheet = (members.form == Form.SHEET) & few & (not drawing.planar)
    for strip in stations(members, pose, _SEGMENTS, members.seen):
        wide = is_sheet[strip.member]
        own = colour[strip.member]
        for chosen, part in ((~wide & ~loud[strip.member], 1.0), (~wide & loud[strip.member], 2.0)):
            canvas.lines(strip.centre[chosen], _DARKER * own[chosen], part * width, layer=SOLID)
        if wide.any():
            _add_strips(canvas, drawing, strip, wide, own[wide])


def _add_strips(
    canvas: Canvas, drawing: Drawing, strip: Strip, chosen: np.ndarray, colour: FloatArray
) -> None:
    """Sheets as their middle surfaces."""
    section = drawing.members.section[strip.member[chosen]]
    wide = np.argmax(section, axis=1)
    along = np.take_along_axis(strip.frame[chosen], (1 + wide)[:, None, None, None], axis=3)[..., 0]
    half = section.max(axis=1)[:, None, None] / 2 * along
    left, right = strip.centre[chosen] - half, strip.centre[chosen] + half
    quads = np.stack((left[:, :-1], right[:, :-1], right[:, 1:], left[:, 1:]), axis=2)
    pieces, quads = quads.shape[1], quads.reshape(-1, 4, 3)
    normal = unit(np.cross(quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1]))
    towards = np.where((normal @ canvas.view.axes[2])[:, None] < 0.0, -normal, normal)
    canvas.polygons(quads, np.repeat(colour, pieces, axis=0) * lit(towards, canvas.view))
    for edge in (left, right):
        canvas.lines(edge, np.array(OUTLINE), _NARROW / 2)


_ROUND = 28
_INK = np.array(OUTLINE)
_WHITE = np.ones(3)
_MEMBERS_LINE = 0.7
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
            canvas.lines(
                around, line, _MEMBERS_LINE, nearer=above + 0.1 * drawing.size, layer=layer
            )


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
