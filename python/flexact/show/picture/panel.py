# SPDX-License-Identifier: BSD-3-Clause
"""One panel of a picture: a drawing in a pose, with what belongs to its subject.

Planar drawings are drawn in their plane like an engineering canvas: no light and no depth. What
lies over what is said by small steps along z: sheets, bars, bodies, supports, hinges, joints.
"""

from __future__ import annotations

import numpy as np

from ...core.arrays import FloatArray
from ...util.rotations import unit
from ..drawing import (
    BENDING,
    Drawing,
    Form,
    Pose,
    Support,
    axes_of,
    cylinders,
    joints_of,
    solid,
    stations,
)
from ..drawing.diagrams import PIECES
from ..drawing.members import GHOST as GHOST_COLOUR
from ..drawing.members import GHOST_FACE as PALE
from ..drawing.members import HINGE_SIZE, SUPPORT
from ..drawing.view import View
from .arrows import add_displacements, add_freedoms, add_presses, add_rotations, add_space
from .canvas import GHOST, SOLID, Canvas
from .stress import OUTLINE, OUTLINE_WIDTH, SHADE, Peak, Stress, add_diagrams, add_grid, lit
from .subject import Subject

#: Above sheets and bars in the plane, a part of the drawing's size, and width of its outline [pt].
_HEIGHT, _LINE = 4.0, 0.7


def _add_bodies(canvas: Canvas, drawing: Drawing, pose: Pose, *, pale: bool = False) -> None:
    """Draw the bodies that are solids, pale and behind everything else where they are ghosts."""
    layer, shade = (GHOST, 1.0) if pale else (SOLID, SHADE)
    for each in drawing.solids:
        if not each.opacity > 0.0:
            continue
        own = _GHOST_FACE if pale else each.colour
        line = _GHOST_EDGE if pale else _outlines(each.edge_colour)
        corners, normal = each.placed(drawing.members, drawing.reference, pose)
        if len(each.outline):
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
        beside = front[each.hull.beside]
        seen = (each.hull.drawn & beside.any(axis=1)) | (beside[:, 0] != beside[:, 1])
        canvas.lines(corners[each.hull.edges[seen]], line, OUTLINE_WIDTH, layer=layer)


#: Up to so many members, a bent one has so many segments and a round section so many corners.
_LEVELS = ((60, 32, 18), (400, 16, 10), (1500, 8, 6))
#: Up to so many members the colours of a self-stress change smoothly along them.
_FEW = 60
#: Round members are thick, and have twice as many corners, beyond this part of the drawing's size.
_THICK = 0.05
_GHOST_FACE = np.array(PALE)
_GHOST_EDGE = 0.25 + 0.75 * np.array(GHOST_COLOUR)
#: What colours that mean values keep where no light falls on them.
_SHADE_OF_STRESS = 0.84
#: Of very many members up to so many sheets have their width; beyond, all are lines.
_MOST_STRIPS = 12_000
_SEGMENTS = 4
#: Of very many members those above this part of the largest value are drawn thicker.
_LOUD = 0.05
#: Widths of lines [pt] up to that number, and beyond.
_WIDE, _NARROW = 1.3, 0.6
_DARKER = 0.85


def detail_of(drawing: Drawing) -> tuple[int, int] | None:
    """How finely members are drawn: segments of bent ones, corners of round sections.

    None where they are too many for solids.
    """
    count = len(drawing.members)
    return next(((s, c) for most, s, c in _LEVELS if count <= most), None)


def _outlines(given: FloatArray) -> FloatArray:
    """Colours of edges, where none is given by default."""
    return np.where(np.isnan(given), OUTLINE, given)


def _add_solids(
    canvas: Canvas,
    drawing: Drawing,
    pose: Pose,
    detail: tuple[int, int],
    stress: Stress | None = None,
    *,
    pale: bool = False,
) -> None:
    """Draw the members, coloured by a self-stress if there is one, or pale behind all else."""
    members, pieces, (segments, corners) = drawing.members, 1, detail
    if stress is not None:
        if (stress.pieces > 1 or stress.quantity in BENDING) and len(members) <= _FEW:
            segments = PIECES
        pieces = min(stress.pieces, segments)
    for strip in stations(members, pose, segments, drawing.seen):
        round_ = strip.member[members.round[strip.member]]
        thick = members.section[round_].max(initial=0.0) > _THICK * drawing.size
        for body in solid(strip, members, corners=corners * (2 if thick else 1)):
            joined = members.joined[body.member]
            if pale:
                look = _GHOST_FACE, 1.0, _GHOST_EDGE
                add_grid(canvas, body.points, *look, joined, layer=GHOST, shade=1.0)
                continue
            points = _in_pieces(body.points, pieces)
            at = np.linspace(0.0, 1.0, points.shape[1])
            own = (
                stress.colours(body.member, at) if stress else members.colour[body.member][:, None]
            )
            edges = _outlines(members.edge_colour[body.member])
            shade = _SHADE_OF_STRESS if stress else SHADE
            add_grid(canvas, points, own, members.opacity[body.member], edges, joined, shade=shade)


def _in_pieces(points: FloatArray, pieces: int) -> FloatArray:
    """(k, s, c, 3) points of straight members at as many stations as pieces need."""
    if pieces == 1 or points.shape[1] > 2:
        return points
    share = np.linspace(0.0, 1.0, pieces + 1)[None, :, None, None]
    return np.asarray((1 - share) * points[:, :1] + share * points[:, 1:])


def _add_many(
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
            canvas.lines(strip.centre[:, [0, -1]], _GHOST_EDGE, width / 2, layer=GHOST)
    colour = members.colour if stress is None else stress.member_colours()
    loud = (
        np.zeros(len(members), bool)
        if stress is None
        else np.abs(stress.values[stress.quantity]).max(axis=1) > _LOUD * stress.largest
    )
    is_sheet = (members.form == Form.SHEET) & few & (not drawing.planar)
    for strip in stations(members, pose, _SEGMENTS, members.seen):
        wide = is_sheet[strip.member]
        own = colour[strip.member]
        for chosen, part in ((~wide & ~loud[strip.member], 1.0), (~wide & loud[strip.member], 2.0)):
            canvas.lines(strip.centre[chosen], _DARKER * own[chosen], part * width, layer=SOLID)
        if not wide.any():
            continue
        # Sheets as their middle surfaces.
        section = members.section[strip.member[wide]]
        which = 1 + np.argmax(section, axis=1)[:, None, None, None]
        along = np.take_along_axis(strip.frame[wide], which, axis=3)[..., 0]
        half = section.max(axis=1)[:, None, None] / 2 * along
        left, right = strip.centre[wide] - half, strip.centre[wide] + half
        quads = np.stack((left[:, :-1], right[:, :-1], right[:, 1:], left[:, 1:]), axis=2)
        pieces, quads = quads.shape[1], quads.reshape(-1, 4, 3)
        normal = unit(np.cross(quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1]))
        towards = np.where((normal @ canvas.view.axes[2])[:, None] < 0.0, -normal, normal)
        colours = np.repeat(own[wide], pieces, axis=0) * lit(towards, canvas.view)
        canvas.polygons(quads, colours)
        for edge in (left, right):
            canvas.lines(edge, np.array(OUTLINE), _NARROW / 2)


_DISC = 28
_INK = np.array(OUTLINE)
_WHITE = np.ones(3)
#: Places along z, parts of the drawing's size; of members by their form.
_HEIGHTS = np.array([0, 1, 1, 2, 3, 4])
_SUPPORT, _PIN, _HINGE, _JOINT = 6, 7, 8, 10
#: Joints at hinges and bars are at most so large: a part of the drawing's size.
_DOT = 0.009


def _add_flat_members(
    canvas: Canvas,
    drawing: Drawing,
    pose: Pose,
    segments: int,
    colour: FloatArray | None = None,
    *,
    pale: bool = False,
) -> None:
    """Draw the members of a planar drawing.

    Args:
        canvas: Where to.
        drawing: The drawing.
        pose: Where its nodes are.
        segments: Of members that bend.
        colour: (k, segments, 3) along all members; by default their own.
        pale: Whether they are ghosts, pale and behind everything else.
    """
    members, layer = drawing.members, GHOST if pale else SOLID
    given = members.colour[:, None] if colour is None else colour
    if pale:
        given = np.tile(_GHOST_FACE, (len(members), 1, 1))
    for strip in stations(members, pose, segments, drawing.seen):
        for body in solid(strip, members, planar=True):
            points = _in_pieces(body.points, given.shape[1])
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
            line = _GHOST_EDGE if pale else _outlines(members.edge_colour[body.member])
            canvas.lines(around, line, _LINE, nearer=above + 0.1 * drawing.size, layer=layer)


def _add_flat_hinges(
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
        np.full(len(colours), HINGE_SIZE[1] / 2 * drawing.size),
        fill,
        rim,
        _HINGE * drawing.size,
        1.6,
    )
    node, radius = joints_of(drawing)
    radius = np.minimum(radius, _DOT * drawing.size)
    _discs(canvas, pose.position[node], radius, _WHITE, OUTLINE, _JOINT * drawing.size, 1.0)


def _add_flat_supports(canvas: Canvas, drawing: Drawing, pose: Pose) -> None:
    """Draw the supports; those that let a node slide go with it."""
    for symbol in drawing.supports:
        place, size, kind = symbol.at(drawing.reference, pose), symbol.size, symbol.kind
        if kind == Support.TURN:
            # A rotation that is held, while the node may slide.
            corner = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * 0.4 * size
            above = _SUPPORT * drawing.size
            canvas.polygons((place + corner)[None], _WHITE, edge=_INK, width=1.1, nearer=above)
            continue
        up = symbol.frame[:, 0]
        along, whole = np.array((up[1], -up[0], 0.0)), drawing.size
        if kind == Support.CLAMP:
            half = 0.3 * size + float(symbol.extent.max())
            _ground(canvas, place, (along, up), half, size, whole)
            continue
        base = place - size * up
        corners = np.stack((place, base - 0.6 * size * along, base + 0.6 * size * along))
        canvas.polygons(corners[None], _WHITE, edge=_INK, width=1.1, nearer=_SUPPORT * whole)
        radius = 0.17 * size
        if kind == Support.SLIDE:
            # It rolls.
            middle = base - radius * up + np.array([[-0.33], [0.33]]) * size * along
            _discs(canvas, middle, np.full(2, radius), _WHITE, OUTLINE, _SUPPORT * whole, 1.0)
            base = base - 2 * radius * up
        _ground(canvas, base, (along, up), 0.85 * size, size, whole)
        _discs(canvas, place[None], np.full(1, radius), _WHITE, OUTLINE, _PIN * whole, 1.0)


def _ground(
    canvas: Canvas,
    place: FloatArray,
    frame: tuple[FloatArray, FloatArray],
    half: float,
    size: float,
    whole: float,
) -> None:
    """A line of ground with hatching below it; the frame is along it, and upwards."""
    along, up = frame
    ends = np.stack((place - half * along, place + half * along))
    canvas.lines(ends[None], _INK, 1.4, nearer=_SUPPORT * whole)
    count = max(3, round(2 * half / (0.34 * size)))
    start = np.linspace(-half, half, count + 1)[1:]
    depth = 0.42 * size
    top = place + start[:, None] * along
    below = top - depth * along - depth * up
    canvas.lines(np.stack((top, below), axis=1), _INK, 0.7, nearer=_SUPPORT * whole)


def _discs(
    canvas: Canvas,
    place: FloatArray,
    radius: FloatArray,
    colour: FloatArray,
    edge: tuple[float, ...],
    above: float,
    width: float,
) -> None:
    angle = 2 * np.pi * np.arange(_DISC) / _DISC
    circle = np.column_stack((np.cos(angle), np.sin(angle), np.zeros(_DISC)))
    ring = place[:, None] + radius[:, None, None] * circle
    canvas.polygons(ring, colour, edge=np.array(edge), width=width, nearer=above)


_ROUND = 20
_GROUND = (0.72, 0.73, 0.74)
_HATCH = (0.36, 0.38, 0.41)


def _add_supports(canvas: Canvas, drawing: Drawing, pose: Pose) -> None:
    """Draw the supports; those that let a node slide go with it."""
    for symbol in drawing.supports:
        for rings, thick in symbol.solids(symbol.at(drawing.reference, pose), _ROUND):
            colour = np.array([[_GROUND]]) if thick else np.array([[SUPPORT]]) * 1.35
            add_grid(canvas, rings[None], colour)
            if thick:
                _add_hatches(canvas, rings, symbol.frame, thick)


def _add_hinges(
    canvas: Canvas, drawing: Drawing, pose: Pose, colour: FloatArray | None = None
) -> None:
    """Draw the hinges of which it is known where they stand, as cylinders about their axes."""
    hinges = drawing.hinges
    colours = hinges.colour if colour is None else colour
    seen = np.flatnonzero((hinges.nodes[:, 0] >= 0) & hinges.seen)
    for body in cylinders(axes_of(hinges, pose, seen), drawing.size, corners=_ROUND):
        own, opacity = colours[body.member][:, None], hinges.opacity[body.member]
        add_grid(canvas, body.points, own, opacity)


def _add_joints(canvas: Canvas, drawing: Drawing, pose: Pose) -> None:
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


def _add_hatches(canvas: Canvas, rings: FloatArray, frame: FloatArray, thick: float) -> None:
    """Slanting lines over the sides of a block of ground that are seen."""
    towards = canvas.view.axes[2]
    for side in range(4):
        # The edges of the side, from below to above.
        edges = rings[:, side], rings[:, (side + 1) % 4]
        along = edges[1][0] - edges[0][0]
        if not np.cross(along, frame[:, 0]) @ towards > 0.0:
            continue
        length = float(np.linalg.norm(along))
        pitch = 1.0 / max(2, min(14, round(length / (0.55 * thick))))
        lean = min(thick / length, 1.0) if length > 0.0 else 1.0
        lines = []
        for start in np.arange(-lean + pitch / 2, 1.0, pitch).tolist():
            # From (start, 0) to (start + lean, 1), cut at the edges.
            low, high = max(0.0, -start / lean), min(1.0, (1.0 - start) / lean)
            ends = []
            for share in (low, high):
                lower, upper = (edge[0] + share * (edge[1] - edge[0]) for edge in edges)
                ends.append(lower + (start + share * lean) * (upper - lower))
            if high - low > 0.05:
                lines.append(ends)
        canvas.lines(np.array(lines), np.array(_HATCH), 0.5)


#: Of more members no bending diagrams are drawn.
_MOST_DIAGRAMS = 200


def paint(
    drawing: Drawing, subject: Subject, view: View, phase: float = 1.0, fineness: float = 1.0
) -> tuple[Canvas, list[Peak]]:
    """Draw a subject; where values are to be named.

    Args:
        drawing: The drawing.
        subject: What of it.
        view: From where.
        phase: Of the movement, from -1 to 1.
        fineness: What widths of lines are multiplied by.
    """
    canvas = Canvas(view, fineness)
    movement, stress = subject.movement, subject.stress
    pose = drawing.reference if movement is None else movement.pose(phase)
    detail = detail_of(drawing)
    peaks: list[Peak] = []
    shown = [] if movement is None else [movement.pose(end) for end in (-1.0, 1.0)]
    # Room for the members with what is round their axes, invisible ones too.
    for each in (drawing.reference, *shown):
        for strip in stations(drawing.members, each):
            wide = drawing.members.section[strip.member][:, None, None] / 2
            for axis in (1, 2) if not drawing.planar else (1,):
                side = wide[..., axis - 1] * strip.frame[..., axis]
                canvas.room(strip.centre + side)
                canvas.room(strip.centre - side)
        for body in drawing.solids:
            canvas.room(body.placed(drawing.members, drawing.reference, each)[0])
    if detail is None:
        _add_many(canvas, drawing, pose, stress, movement is not None)
    elif drawing.planar:
        _paint_flat(canvas, drawing, pose, subject, detail)
    else:
        if movement is not None:
            _add_solids(canvas, drawing, drawing.reference, detail, pale=True)
            _add_bodies(canvas, drawing, drawing.reference, pale=True)
        _add_bodies(canvas, drawing, pose)
        _add_solids(canvas, drawing, pose, detail, stress)
        _add_joints(canvas, drawing, pose)
        _add_hinges(canvas, drawing, pose, stress.hinge_colours() if stress else None)
        _add_supports(canvas, drawing, pose)
    if subject.space is not None:
        add_space(canvas, drawing, subject.space)
    elif stress is None:
        add_freedoms(canvas, drawing)
    elif len(drawing.members) <= _MOST_DIAGRAMS:
        peaks = add_diagrams(canvas, drawing, stress)
        add_presses(canvas, drawing, stress.presses)
    if movement is not None:
        add_displacements(canvas, drawing, pose)
        add_rotations(canvas, drawing, pose, movement.pose(1.0))
    return canvas, peaks


def _paint_flat(
    canvas: Canvas, drawing: Drawing, pose: Pose, subject: Subject, detail: tuple[int, int]
) -> None:
    count, stress = len(drawing.members), subject.stress
    if subject.movement is not None:
        _add_flat_members(canvas, drawing, drawing.reference, detail[0], pale=True)
        _add_bodies(canvas, drawing, drawing.reference, pale=True)
    _add_flat_supports(canvas, drawing, pose)
    colour, segments = None, 2 * detail[0]
    if stress is not None:
        segments = PIECES if count <= _FEW else detail[0]
        colour = stress.colours(np.arange(count), np.linspace(0.0, 1.0, segments + 1))
    _add_flat_members(canvas, drawing, pose, segments, colour)
    _add_bodies(canvas, drawing, pose)
    _add_flat_hinges(canvas, drawing, pose, stress.hinge_colours() if stress else None)
