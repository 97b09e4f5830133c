# SPDX-License-Identifier: BSD-3-Clause
"""One panel of a picture: a drawing in a pose, with what belongs to its subject."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ..drawing import Drawing, Pose, axes_of, cylinders, joints_of, stations
from ..drawing.members import SUPPORT
from ..drawing.view import View
from . import members as flat
from .arrows import add_displacements, add_freedoms, add_rotations, add_space
from .canvas import GHOST, Canvas
from .members import (
    FEW,
    GHOST_EDGE,
    GHOST_FACE,
    Detail,
    add_bodies,
    add_ghosts,
    add_many,
    add_solids,
    detail_of,
)
from .stress import OUTLINE, OUTLINE_WIDTH, PIECES, Grid, Peak, add_diagrams, add_grid
from .subject import Subject

_ROUND = 20
_GROUND = (0.72, 0.73, 0.74)
_HATCH = (0.36, 0.38, 0.41)


def add_supports(canvas: Canvas, drawing: Drawing, pose: Pose) -> None:
    """Draw the supports; those that let a node slide go with it."""
    supports = drawing.supports
    for row in range(len(supports)):
        node = pose.position[supports.node[row]]
        for rings, thick in supports.solids(row, node, _ROUND):
            colour = np.array([[_GROUND]]) if thick else np.array([[SUPPORT]]) * 1.35
            add_grid(canvas, Grid(rings[None], colour, np.ones(1), _edge()))
            if thick:
                _add_hatches(canvas, rings, supports.frame[row], thick)


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


def _add_hatches(canvas: Canvas, rings: FloatArray, frame: FloatArray, thick: float) -> None:
    """Slanting lines over the sides of a block of ground that are seen."""
    towards = canvas.view.axes[2]
    for side in range(4):
        first, last = rings[:, side], rings[:, (side + 1) % 4]
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
            ends = []
            for share in (low, high):
                lower, upper = (edge[0] + share * (edge[1] - edge[0]) for edge in (first, last))
                ends.append(lower + (start + share * lean) * (upper - lower))
            lines.append(ends)
    canvas.lines(np.array(lines), np.array(_HATCH), 0.5)


#: Of more members no bending diagrams are drawn.
_MOST_DIAGRAMS = 200
#: Phases whose poses need room.
_EXTREMES = (-1.0, 1.0)


@dataclass
class Panel:
    """What is drawn of a subject, and where values are to be named."""

    canvas: Canvas
    peaks: list[Peak]


def paint(
    drawing: Drawing, subject: Subject, view: View, phase: float = 1.0, fineness: float = 1.0
) -> Panel:
    """Draw a subject.

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
    shown = [] if movement is None else [movement.pose(each) for each in _EXTREMES]
    _leave_room(canvas, drawing, [drawing.reference, *shown])
    if detail is None:
        add_many(canvas, drawing, pose, stress, movement is not None)
    elif drawing.planar:
        _paint_flat(canvas, drawing, pose, subject, detail)
    else:
        if movement is not None:
            add_ghosts(canvas, drawing, detail)
            _add_pale_bodies(canvas, drawing)
        add_bodies(canvas, drawing, pose)
        add_solids(canvas, drawing, pose, detail, stress)
        add_joints(canvas, drawing, pose)
        add_hinges(canvas, drawing, pose, stress.hinge_colours() if stress else None)
        add_supports(canvas, drawing, pose)
    if subject.space is not None:
        add_space(canvas, drawing, subject.space)
    elif stress is None:
        add_freedoms(canvas, drawing)
    elif len(drawing.members) <= _MOST_DIAGRAMS:
        peaks = add_diagrams(canvas, drawing, stress)
    if movement is not None:
        add_displacements(canvas, drawing, pose)
        add_rotations(canvas, drawing, pose, movement.pose(1.0))
    return Panel(canvas, peaks)


def _add_pale_bodies(canvas: Canvas, drawing: Drawing) -> None:
    add_bodies(
        canvas,
        drawing,
        drawing.reference,
        face=GHOST_FACE,
        edge=GHOST_EDGE,
        layer=GHOST,
        shade=1.0,
    )


def _paint_flat(
    canvas: Canvas, drawing: Drawing, pose: Pose, subject: Subject, detail: Detail
) -> None:
    count, stress = len(drawing.members), subject.stress
    if subject.movement is not None:
        pale = np.tile(GHOST_FACE, (count, 1))
        flat.add_members(
            canvas, drawing, drawing.reference, detail.segments, pale, edge=GHOST_EDGE, layer=GHOST
        )
        _add_pale_bodies(canvas, drawing)
    flat.add_supports(canvas, drawing, pose)
    colour, segments = None, 2 * detail.segments
    if stress is not None:
        segments = PIECES if count <= FEW else detail.segments
        colour = stress.colours(np.arange(count), np.linspace(0.0, 1.0, segments + 1))
    flat.add_members(canvas, drawing, pose, segments, colour)
    add_bodies(canvas, drawing, pose)
    flat.add_hinges(canvas, drawing, pose, stress.hinge_colours() if stress else None)


def _leave_room(canvas: Canvas, drawing: Drawing, poses: list[Pose]) -> None:
    """Room for the members in some poses with what is round their axes, invisible ones too."""
    for pose in poses:
        for strip in stations(drawing.members, pose):
            wide = drawing.members.section[strip.member][:, None, None] / 2
            for axis in (1, 2) if not drawing.planar else (1,):
                side = wide[..., axis - 1] * strip.frame[..., axis]
                canvas.room(strip.centre + side)
                canvas.room(strip.centre - side)
        for solid in drawing.solids:
            canvas.room(solid.placed(drawing.members, drawing.reference, pose).corners)
