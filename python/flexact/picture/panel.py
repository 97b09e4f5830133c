"""One panel of a picture: a scene in a pose, with what belongs to its subject."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..scene import Pose, Scene, stations
from ..scene.colours import GHOST as GHOST_COLOUR
from . import flat, symbols
from .arrows import add_displacements, add_freedoms, add_rotations
from .bodies import Detail, bodies, detail_of, grid_of
from .drawing import GHOST, Drawing
from .light import SHADE
from .many import add_many
from .stress import PIECES, Peak, Stress, add_diagrams
from .subject import Subject
from .surfaces import Grid, add_grid
from .view import View

_GHOST_FACE = 0.62 + 0.38 * np.array(GHOST_COLOUR)
_GHOST_EDGE = 0.25 + 0.75 * np.array(GHOST_COLOUR)
#: Facets of round members may be larger by this factor.
_ROUND = 4.0
#: What colours that mean values keep where no light falls on them.
_SHADE_OF_STRESS = 0.84
#: Of so many members the colours change smoothly along them.
_FEW = 60
#: Of more members no bending diagrams are drawn.
_MOST_DIAGRAMS = 200
#: Phases whose poses need room.
_EXTREMES = (-1.0, 1.0)


@dataclass
class Panel:
    """What is drawn of a subject, and where values are to be named."""

    drawing: Drawing
    peaks: list[Peak]


def paint(
    scene: Scene, subject: Subject, view: View, phase: float = 1.0, fineness: float = 1.0
) -> Panel:
    """Draw a subject.

    Args:
        scene: The scene.
        subject: What of it.
        view: From where.
        phase: Of the movement, from -1 to 1.
        fineness: What widths of lines are multiplied by.
    """
    drawing = Drawing(view, fineness)
    movement, stress = subject.movement, subject.stress
    pose = scene.reference if movement is None else movement.pose(phase)
    detail = detail_of(scene)
    peaks: list[Peak] = []
    shown = [] if movement is None else [movement.pose(each) for each in _EXTREMES]
    _leave_room(drawing, scene, [scene.reference, *shown])
    if detail is None:
        add_many(drawing, scene, pose, stress, None if movement is None else _GHOST_EDGE)
    else:
        draw = _paint_flat if scene.planar else _paint_solid
        if movement is not None:
            _add_ghost(drawing, scene, detail)
        draw(drawing, scene, pose, stress, detail)
    if stress is None:
        add_freedoms(drawing, scene)
    elif len(scene.members) <= _MOST_DIAGRAMS:
        peaks = add_diagrams(drawing, scene, stress)
    if movement is not None:
        add_displacements(drawing, scene, pose)
        add_rotations(drawing, scene, pose, movement.pose(1.0))
    return Panel(drawing, peaks)


def is_simplified(scene: Scene) -> bool:
    """Whether there are too many members to draw them as solids."""
    return detail_of(scene) is None


def _add_ghost(drawing: Drawing, scene: Scene, detail: Detail) -> None:
    """The reference shape, pale and behind everything else."""
    if scene.planar:
        flat.add_members(
            drawing,
            scene,
            scene.reference,
            segments=detail.segments,
            colour=np.tile(_GHOST_FACE, (len(scene.members), 1)),
            edge=_GHOST_EDGE,
            layer=GHOST,
        )
        return
    for body in bodies(scene, scene.reference, detail):
        ghost = Grid(body.points, _GHOST_FACE[None, None], np.ones(1), _GHOST_EDGE[None])
        add_grid(drawing, ghost, finest=scene.size, layer=GHOST, shade=1.0)


def _paint_solid(
    drawing: Drawing, scene: Scene, pose: Pose, stress: Stress | None, detail: Detail
) -> None:
    finest = detail.finest * scene.size
    pieces = 1 if stress is None else stress.pieces
    if stress and (pieces > 1 or stress.has_diagram) and len(scene.members) <= _FEW:
        detail = replace(detail, segments=PIECES)
    for body in bodies(scene, pose, detail, min(pieces, detail.segments)):
        colour = stress.colours(body.member, body.at) if stress else None
        shade = _SHADE_OF_STRESS if stress else SHADE
        # Flat members may pass through each other, where small facets err little.
        size = finest if body.points.shape[2] == 4 else _ROUND * finest
        add_grid(drawing, grid_of(scene, body, colour), finest=size, shade=shade)
    symbols.add_joints(drawing, scene, pose)
    symbols.add_hinges(drawing, scene, pose, finest, stress.hinge_colours() if stress else None)
    symbols.add_supports(drawing, scene, pose, finest)


def _paint_flat(
    drawing: Drawing, scene: Scene, pose: Pose, stress: Stress | None, detail: Detail
) -> None:
    flat.add_supports(drawing, scene, pose)
    colour, segments = None, 2 * detail.segments
    if stress is not None:
        segments = PIECES if len(scene.members) <= _FEW else detail.segments
        every = np.arange(len(scene.members))
        colour = stress.colours(every, np.linspace(0.0, 1.0, segments + 1))
    flat.add_members(drawing, scene, pose, segments=segments, colour=colour)
    flat.add_hinges(drawing, scene, pose, stress.hinge_colours() if stress else None)


def _leave_room(drawing: Drawing, scene: Scene, poses: list[Pose]) -> None:
    """Room for the members in some poses with what is round their axes, invisible ones too."""
    for pose in poses:
        for strip in stations(scene.members, pose):
            wide = scene.members.section[strip.member][:, None, None] / 2
            for axis in (1, 2) if not scene.planar else (1,):
                side = wide[..., axis - 1] * strip.frame[..., axis]
                drawing.room(strip.centre + side)
                drawing.room(strip.centre - side)
