# SPDX-License-Identifier: BSD-3-Clause
"""One panel of a picture: a drawing in a pose, with what belongs to its subject."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..drawing import Drawing, Pose, stations
from ..drawing.view import View
from . import members as flat
from . import symbols
from .arrows import add_displacements, add_freedoms, add_rotations
from .bodies import add_bodies
from .canvas import GHOST, Canvas
from .picture_members import (
    FEW,
    GHOST_EDGE,
    GHOST_FACE,
    Detail,
    add_ghosts,
    add_many,
    add_solids,
    detail_of,
)
from .spaces import add_space
from .stress import PIECES, Peak, add_diagrams
from .subject import Subject

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
        symbols.add_joints(canvas, drawing, pose)
        symbols.add_hinges(canvas, drawing, pose, stress.hinge_colours() if stress else None)
        symbols.add_supports(canvas, drawing, pose)
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


def is_simplified(drawing: Drawing) -> bool:
    """Whether there are too many members to draw them as solids."""
    return detail_of(drawing) is None


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
