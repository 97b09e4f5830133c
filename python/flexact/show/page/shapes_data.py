# SPDX-License-Identifier: BSD-3-Clause
"""Vibrating and buckled shapes as data of a page's viewer."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from ...core.arrays import FloatArray
from ...model.configuration import Configuration
from ...model.data import ModelData
from ...model.parts.parts import Parts
from ..drawing import Drawing, reach_of, swing
from .drawing import Frame, static_data
from .limits import MOST_MODES, MOST_POSES
from .tracks import Tracks

#: Kinds of shapes, by which the page groups them.
KINDS = ("vibrating", "buckled")
#: Pieces of a bent member, which mostly is a part of a divided sheet.
_PIECES = 4


class Shape(NamedTuple):
    """A shape that plays.

    Attributes:
        kind: One of `KINDS`.
        label: Short, on its button, such as "184 Hz".
        words: What it is, such as "first parasitic frequency, 184 Hz".
        state: Where the nodes are without it.
        displacement: (nodes, 3) of positions, and rotations (spins) of orientations; only their
            ratios matter.
    """

    kind: str
    label: str
    words: str
    state: Configuration
    displacement: FloatArray


class Shaped(NamedTuple):
    """A model, mostly one whose beams are divided, with its shapes."""

    data: ModelData
    shapes: Sequence[Shape]


def shapes_data(shaped: Shaped, frame: Frame) -> dict[str, Any]:
    """What a viewer draws of shapes; as many of them as fit."""
    tracks = Tracks(frame, _PIECES)
    return {
        **static_data(Parts(shaped.data), frame),
        "reference": tracks.data(),
        "segments": tracks.segments,
        "movements": _movements(shaped, tracks),
        "stresses": [],
        "spaces": [],
        "first": [("movement", str(_first(shaped.shapes)))] if shaped.shapes else [],
    }


def _first(shapes: Sequence[Shape]) -> int:
    """What is shown at first: how it buckles, else the second that vibrates, as the first is meant.

    The second is the lowest parasitic one where a drive is free.
    """
    kinds = [each.kind for each in shapes[:MOST_MODES]]
    return kinds.index("buckled") if "buckled" in kinds else min(1, len(kinds) - 1)


def _movements(shaped: Shaped, tracks: Tracks) -> list[dict[str, Any]]:
    made: list[dict[str, Any]] = []
    size, drawing = 0, tracks.frame.drawing
    for each in shaped.shapes[:MOST_MODES]:
        movement = swing(drawing, each.state, each.displacement)
        data, added = tracks.movement(movement)
        size += added
        if made and size > MOST_POSES:
            break
        title = f"{each.words[:1].upper()}{each.words[1:]}"
        note = _note(drawing, reach_of(drawing, (movement.poses[0], movement.poses[-1])))
        made.append({"kind": each.kind, "label": each.label, "title": title, "note": note, **data})
    return made


def _note(drawing: Drawing, reach: tuple[float, float]) -> str:
    """How far it is enlarged: the sizes of a shape mean nothing."""
    share = 100 * reach[0] / drawing.size
    return (
        f"Drawn with displacements up to {share:.2g}\N{NO-BREAK SPACE}% of the model's size; of a "
        "shape only the ratios matter."
    )
