# SPDX-License-Identifier: BSD-3-Clause
"""Freedom and constraint spaces of a body, and what flexures hold, as data of a page."""

from __future__ import annotations

from functools import reduce
from operator import add
from typing import Any

import numpy as np

from ...advice.advising_holding import hold_in_words, holds_in_words, number_of
from ...advice.holding import holds_of
from ...advice.spaces.spaces import Spaces
from ...advice.spaces.words import body_words, dashed_in_words, spaces_lines
from ...analysis.result import Result
from ...analysis.sentences import plain
from ...core.arrays import FloatArray
from ...util.plain_text import harmless
from ..drawing import SpaceShape, dashes, shape_of_space
from ..drawing.holding import shape_of_hold
from .drawing import Frame
from .packing import floats, integers

#: Of more flexures what they hold is shown together alone.
_MOST_HOLDS = 12


def spaces_data(analysis: Result, frame: Frame, spaces: Spaces | None) -> list[dict[str, Any]]:
    """The freedom space and the constraint space; nothing where none are to be shown."""
    if spaces is None:
        return []
    lines = spaces_lines(analysis, spaces)
    made = []
    for label, space, line in zip(
        ("Freedom", "Constraint"), (spaces.freedom, spaces.constraint), lines, strict=False
    ):
        is_freedom = not space.of_wrenches
        shape = shape_of_space(
            space.families, space.about, frame.size, is_freedom=is_freedom, planar=frame.planar
        )
        wires = np.zeros((0, 2, 3)) if is_freedom else spaces.new_wires
        words = harmless(plain(line.head) + "; ".join(map(plain, line.items)))
        words += dashed_in_words(len(wires))
        made.append(
            {
                "label": harmless(f"{label} space of {body_words(analysis, spaces)}"),
                "title": f"{words}.",
                "freedom": is_freedom,
                **_drawn(shape, frame),
                "wires": floats(frame.places(dashes(wires, frame.size))),
            }
        )
    return made


def holds_data(analysis: Result, frame: Frame) -> list[dict[str, Any]]:
    """What each flexure of an exactly constrained mechanism holds: all together, then each."""
    holds = holds_of(analysis)
    if not holds:
        return []
    shapes = [shape_of_hold(each, frame.size, planar=frame.planar) for each in holds]
    every = reduce(add, shapes)
    made = [("What each flexure holds", holds_in_words(holds), every)]
    if 1 < len(holds) <= _MOST_HOLDS:
        for hold, shape in zip(holds, shapes, strict=True):
            label = f"{hold.name}: {number_of(hold)}"
            made.append((label, hold_in_words(analysis, hold), shape))
    return [
        {
            "label": harmless(label),
            "title": harmless(words),
            "freedom": False,
            "held": True,
            **_drawn(shape, frame),
            "wires": floats(np.zeros((0, 2, 3))),
        }
        for label, words, shape in made
    ]


def _drawn(shape: SpaceShape, frame: Frame) -> dict[str, Any]:
    """Pieces of lines and arrows by their ends, and faces as triangles."""
    pieces = [np.stack((line[:-1], line[1:]), axis=1) for line in shape.lines]
    corners, triangles, behind = [], [], 0
    for face in shape.faces:
        fan = np.arange(1, len(face) - 1)
        triangles.append(behind + np.stack((np.zeros_like(fan), fan, fan + 1), axis=1))
        corners.append(face)
        behind += len(face)
    return {
        "lines": floats(_placed(pieces, frame)),
        "bold": shape.is_bold,
        "arrows": floats(_placed([each[None] for each in shape.arrows], frame)),
        "corners": floats(_placed(corners, frame)),
        "triangles": integers(np.concatenate([np.zeros((0, 3), int), *triangles])),
    }


def _placed(points: list[FloatArray], frame: Frame) -> FloatArray:
    every = [np.zeros((0, 3)), *(each.reshape(-1, 3) for each in points)]
    return frame.places(np.concatenate(every))
