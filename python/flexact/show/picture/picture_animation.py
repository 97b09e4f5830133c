# SPDX-License-Identifier: BSD-3-Clause
"""Animations: a motion through a full cycle from rest, or a drawing that turns about z."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from ...analysis.result import Result
from ..drawing import Drawing
from ..drawing.view import View
from .animation import SUFFIXES as VIDEOS
from .animation import video_bytes
from .canvas import Box
from .figure import compose
from .files import gif_bytes, pixels
from .panel import paint
from .subject import Subject

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Frames of a cycle, and of a full turn; how long each stands [ms].
CYCLE, TURN = 36, 48
_DURATION = 50
#: Width and height [px].
SIZE = (720, 608)
#: Phases at which a motion is looked at for the room that it takes.
_LOOKED_AT = (-1.0, -0.5, 0.0, 0.5, 1.0)

Told = Callable[[float], None]


#: Suffixes of pictures that move.
SUFFIXES = (".gif", *VIDEOS)


def moving_bytes(
    analysis: Result | None,
    drawing: Drawing,
    subject: Subject,
    view: View,
    suffix: str,
    title: str,
    *,
    size: tuple[int, int] | None = None,
    plain: bool = False,
    progress: Told | None = None,
) -> bytes:
    """The animation as a GIF that runs without end, or as a video of one cycle that loops.

    All frames share one scale, and those of a GIF one palette, so that nothing but what moves
    changes.
    """
    made: list[np.ndarray] = []
    order, phases, views = _schedule(drawing, subject, view)
    box = _reach(drawing, subject, views)
    for number, (phase, each) in enumerate(zip(phases, views, strict=True)):
        figure = compose(
            analysis,
            drawing,
            [subject],
            each,
            phase=phase,
            size=size or SIZE,
            plain=plain,
            box=box,
        )
        made.append(_after(made[0], figure) if made and drawing.planar else pixels(figure))
        if progress is not None:
            progress((number + 1) / (len(phases) + (suffix in VIDEOS)))
    if suffix not in VIDEOS:
        return gif_bytes(made, order, _DURATION)
    content = video_bytes(made, order, _DURATION, suffix, title)
    if progress is not None:
        progress(1.0)
    return content


def _after(first: np.ndarray, figure: Figure) -> np.ndarray:
    """The pixels of a later figure, of which only the axes differ from those of the first.

    Words stand above and below planar drawings, and to draw them takes as long as the rest.
    """
    for words in figure.texts:
        words.set_visible(False)
    made, box = first.copy(), figure.axes[0].bbox
    rows = slice(len(made) - int(np.ceil(box.y1)), len(made) - int(np.floor(box.y0)))
    made[rows] = pixels(figure)[rows]
    return made


def _schedule(
    drawing: Drawing, subject: Subject, view: View
) -> tuple[list[int], list[float], list[View]]:
    """Which drawings the frames show, and the phase and view of each drawing."""
    if subject.movement is not None:
        # From rest to the end, to the other end, and back to rest; the ways back show the same
        # drawings as the ways there.
        there = CYCLE // 2
        rest = there // 2
        phases = np.cos(np.pi * np.arange(there + 1) / there).tolist()
        phases[rest] = 0.0
        order = [*range(rest, 0, -1), *range(there), *range(there, rest, -1)]
        return order, phases, [view] * len(phases)
    if drawing.planar:
        return [0], [0.0], [view]
    views = [view.turned(360.0 * k / TURN) for k in range(TURN)]
    return list(range(TURN)), [0.0] * TURN, views


def _reach(drawing: Drawing, subject: Subject, views: list[View]) -> Box:
    """The box round all frames, so that the scale stays."""
    if subject.movement is not None:
        boxes = [paint(drawing, subject, views[0], phase).canvas.box for phase in _LOOKED_AT]
    else:
        boxes = [
            paint(drawing, subject, view).canvas.box for view in views[:: len(views) // 4 or 1]
        ]
        boxes += [_cylinder(drawing, view) for view in views]
    low, high = zip(*boxes, strict=True)
    return np.min(low, axis=0), np.max(high, axis=0)


def _cylinder(drawing: Drawing, view: View) -> Box:
    """The box round the upright cylinder in which a turning drawing stays."""
    nodes = np.unique(drawing.members.nodes[:, [0, 2]])
    offset = drawing.reference.position[nodes] - drawing.centre
    radius = np.linalg.norm(offset[:, :2], axis=1).max(initial=0.0)
    flat = view.project(drawing.centre)[:2]
    rise = np.abs(view.axes[1, 2]) * (drawing.high[2] - drawing.low[2]) / 2
    rise += np.hypot(*view.axes[1, :2]) * radius
    half = np.array((radius, rise))
    return flat - half, flat + half
