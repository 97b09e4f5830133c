# SPDX-License-Identifier: BSD-3-Clause
"""Freedom and constraint spaces of a body in a picture: a panel each, and wires to add."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import reduce
from operator import add

import numpy as np

from ...advice.advising_holding import holds_in_words, number_of
from ...advice.holding import holds_of
from ...advice.spaces.spaces import Spaces
from ...advice.spaces.words import body_words, dashed_in_words, spaces_lines
from ...analysis.result import Result
from ...analysis.sentences import plain
from ...core.arrays import FloatArray
from ..drawing import Drawing, SpaceShape, dashes, shape_of_space
from ..drawing.colours import CONSTRAINT_SPACE, FREEDOM_SPACE, NEW_WIRE
from ..drawing.holding import shape_of_hold
from .arrows import add_straight
from .canvas import OVER, Canvas

#: Of lines [pt]; and of faces, whose edges are as wide as this.
_BOLD, _WIDTH, _THIN, _EDGE, _DASH = 2.6, 1.5, 0.8, 0.7, 2.6
_OPACITY = 0.16
#: Where the second head of a couple is, along its arrow.
_SECOND = 0.84


@dataclass(frozen=True)
class SpaceShown:
    """A space in a panel.

    Attributes:
        shape: What is drawn of it.
        words: What it is.
        wires: (w, 2, 3) ends of wires that may be added [m].
        labels: Places (3,) [m], each with what stands there.
    """

    shape: SpaceShape
    words: str
    wires: FloatArray
    labels: tuple[tuple[FloatArray, str], ...] = ()


def holds_shown(result: Result, drawing: Drawing) -> SpaceShown | None:
    """What each flexure holds, with how well at each; None where that is not known."""
    holds = holds_of(result)
    if not holds:
        return None
    shapes = [shape_of_hold(each, drawing.size, planar=drawing.planar) for each in holds]
    labels = tuple((each.space.about, number_of(each)) for each in holds)
    none = np.zeros((0, 2, 3))
    return SpaceShown(reduce(add, shapes), holds_in_words(holds), none, labels)


def spaces_shown(
    result: Result, drawing: Drawing, spaces: Spaces
) -> Iterator[tuple[str, SpaceShown]]:
    """The freedom space and the constraint space of a body, each with a title."""
    lines = spaces_lines(result, spaces)
    for which, space, line in zip(
        ("Freedom", "Constraint"), (spaces.freedom, spaces.constraint), lines, strict=False
    ):
        is_freedom = not space.of_wrenches
        shape = shape_of_space(
            space.families, space.about, drawing.size, is_freedom=is_freedom, planar=drawing.planar
        )
        wires = np.zeros((0, 2, 3)) if is_freedom else spaces.new_wires
        words = plain(line.head) + "; ".join(map(plain, line.items))
        words += dashed_in_words(len(wires))
        yield f"{which} space of {body_words(result, spaces)}", SpaceShown(shape, words, wires)


def add_space(canvas: Canvas, drawing: Drawing, shown: SpaceShown) -> None:
    """Draw a space over the mechanism."""
    shape = shown.shape
    colour = np.array(FREEDOM_SPACE if shape.is_freedom else CONSTRAINT_SPACE)
    for face in shape.faces:
        canvas.polygons(face[None], colour, opacity=_OPACITY)
        canvas.lines(np.concatenate((face, face[:1]))[None], colour, _EDGE)
    for line in shape.lines:
        canvas.lines(line[None], colour, _BOLD if shape.is_bold else _WIDTH)
        if shown.labels:
            # What a wire holds lies within it.
            canvas.lines(line[None], colour, _THIN, layer=OVER)
    if shape.arrows:
        ends = np.array(shape.arrows)
        # A couple has two heads.
        for part in (1.0,) if shape.is_freedom else (1.0, _SECOND):
            tips = ends[:, 0] + part * (ends[:, 1] - ends[:, 0])
            add_straight(canvas, ends[:, 0], tips, tuple(colour.tolist()), drawing.size)
    if len(shown.wires):
        canvas.lines(
            dashes(shown.wires, drawing.size),
            np.array(NEW_WIRE),
            _DASH,
            layer=OVER,
            nearer=20 * drawing.size,
        )
