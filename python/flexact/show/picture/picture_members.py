# SPDX-License-Identifier: BSD-3-Clause
"""Members of spatial mechanisms: solids, or, where they are very many, strips and lines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ..drawing import Drawing, Form, Members, Pose, Strip, solid, stations
from ..drawing.colours import GHOST as GHOST_COLOUR
from ..drawing.colours import GHOST_FACE as PALE
from ..drawing.rotations import unit
from .canvas import GHOST, SOLID, Canvas
from .stress import PIECES, Stress
from .surfaces import OUTLINE, SHADE, Grid, add_grid, lit

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
