"""Animations: a motion through a full cosine cycle, or a scene that turns about the vertical."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from ..scene import Scene
from .drawing import Box
from .figure import compose
from .gif import gif_of
from .panel import paint
from .raster import pixels
from .subject import Subject
from .view import View

if TYPE_CHECKING:
    from ..analysis import Analysis

#: Frames of a cycle, and of a full turn; how long each stands [ms].
CYCLE, TURN = 36, 48
_DURATION = 50
#: Width and height [px].
SIZE = (720, 608)
#: Phases at which a motion is looked at for the room that it takes.
_LOOKED_AT = (-1.0, -0.5, 0.0, 0.5, 1.0)

Told = Callable[[float], None]


def gif_bytes(
    analysis: Analysis,
    scene: Scene,
    subject: Subject,
    view: View,
    *,
    size: tuple[int, int] | None = None,
    plain: bool = False,
    progress: Told | None = None,
) -> bytes:
    """The animation as a GIF that runs without end.

    All frames share one palette and one scale, so that nothing but what moves changes.
    """
    made = []
    order, phases, views = _schedule(scene, subject, view)
    box = _reach(scene, subject, views)
    for number, (phase, each) in enumerate(zip(phases, views, strict=True)):
        figure = compose(
            analysis,
            scene,
            [subject],
            each,
            phase=phase,
            size=size or SIZE,
            plain=plain,
            box=box,
        )
        made.append(pixels(figure))
        if progress is not None:
            progress((number + 1) / len(phases))
    return gif_of(made, order, _DURATION)


def _schedule(
    scene: Scene, subject: Subject, view: View
) -> tuple[list[int], list[float], list[View]]:
    """Which drawings the frames show, and the phase and view of each drawing."""
    if subject.movement is not None:
        # The way back shows the same drawings as the way there.
        there = CYCLE // 2
        phases = np.cos(np.pi * np.arange(there + 1) / there).tolist()
        order = [*range(there + 1), *range(there - 1, 0, -1)]
        return order, phases, [view] * len(phases)
    if scene.planar:
        return [0], [0.0], [view]
    views = [view.turned(360.0 * k / TURN) for k in range(TURN)]
    return list(range(TURN)), [0.0] * TURN, views


def _reach(scene: Scene, subject: Subject, views: list[View]) -> Box:
    """The box round all frames, so that the scale stays."""
    if subject.movement is not None:
        boxes = [paint(scene, subject, views[0], phase).drawing.box for phase in _LOOKED_AT]
    else:
        boxes = [paint(scene, subject, view).drawing.box for view in views[:: len(views) // 4 or 1]]
        boxes += [_cylinder(scene, view) for view in views]
    low, high = zip(*boxes, strict=True)
    return np.min(low, axis=0), np.max(high, axis=0)


def _cylinder(scene: Scene, view: View) -> Box:
    """The box round the upright cylinder in which a turning scene stays."""
    nodes = np.unique(scene.members.nodes[:, [0, 2]])
    offset = scene.reference.position[nodes] - scene.centre
    radius = np.linalg.norm(offset[:, :2], axis=1).max(initial=0.0)
    flat = view.project(scene.centre)[:2]
    rise = np.abs(view.axes[1, 2]) * (scene.high[2] - scene.low[2]) / 2
    rise += np.hypot(*view.axes[1, :2]) * radius
    half = np.array((radius, rise))
    return flat - half, flat + half
