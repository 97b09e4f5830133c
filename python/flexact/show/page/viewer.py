# SPDX-License-Identifier: BSD-3-Clause
"""Freedom and constraint spaces of a body, and what flexures hold, as data of a page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ...advice.spaces.spaces import Spaces
from ...analysis.freedoms import Freedom
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...model.configuration import Configuration
from ...model.data import ModelData
from ...model.parts.parts import Parts
from ...util.partial import attempted
from ...util.text import harmless
from ..drawing import Drawing, SpaceShape, dashes, reach_of, swing
from ..spaces import holds_shown, spaces_shown
from .assets import MOST_MEMBERS, MOST_MODES, MOST_POSES, MOST_SHAPES, floats, integers
from .drawing import Frame, static_data
from .modes import Tracks, looked_at, movements, stresses

#: Of more flexures what they hold is shown together alone.
_MOST_HOLDS = 12


def spaces_data(analysis: Result, frame: Frame, spaces: Spaces | None) -> list[dict[str, Any]]:
    """The freedom space and the constraint space; nothing where none are to be shown."""
    if spaces is None:
        return []
    return [
        {
            "label": harmless(each.title),
            "title": harmless(f"{each.words}."),
            "freedom": each.shape.is_freedom,
            **_drawn(each.shape, frame),
            "wires": floats(frame.places(dashes(each.wires, frame.size))),
        }
        for each in spaces_shown(analysis, spaces, frame.size, frame.planar)
    ]


def holds_data(analysis: Result, frame: Frame) -> list[dict[str, Any]]:
    """What each flexure of an exactly constrained mechanism holds: all together, then each."""
    return [
        {
            "label": harmless(each.title),
            "title": harmless(each.words),
            "freedom": False,
            "held": True,
            **_drawn(each.shape, frame),
            "wires": floats(each.wires),
        }
        for each in holds_shown(analysis, frame.size, frame.planar, _MOST_HOLDS)
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


def viewer_data(
    analysis: Result, frame: Frame, spaces: Spaces | None = None, room: int = MOST_SHAPES
) -> dict[str, Any]:
    """All that is drawn of a result, with spaces of a body, and the first choices.

    A movement has so many phases that it takes so many bytes, if it can. What cannot be drawn is
    told as "missing", sentences.
    """
    tracks = Tracks(frame, room=room)
    missing: list[str] = []
    shown: list[dict[str, Any]] = attempted(
        "What a body may do", lambda: spaces_data(analysis, frame, spaces), [], missing
    )
    held: list[dict[str, Any]] = attempted(
        "What each flexure holds", lambda: holds_data(analysis, frame), [], missing
    )
    data = {
        **static_data(analysis.parts, frame),
        "reference": tracks.data(),
        "segments": tracks.segments,
        "movements": movements(analysis, tracks, missing),
        "stresses": stresses(analysis, frame, missing),
        "spaces": shown + held,
        **({"missing": missing} if missing else {}),
    }
    # What the verdict says: a motion, else a self-stress, else a degree of freedom.
    moves = any(movement["kind"] == "motion" for movement in data["movements"])
    first = [("stress", "0")] if data["stresses"] and not moves else [("movement", "0")]
    has_any = data["stresses"] or data["movements"]
    return {**data, "first": first if has_any else []}


def stuck_in(analysis: Result) -> list[Freedom]:
    """The declared degrees of freedom in which the mechanism cannot move."""
    return [each for each in looked_at(analysis) if each.motion is None]


def left_out(analysis: Result, data: dict[str, Any]) -> str:
    """Sentences on what of a large result is not in its drawing."""
    told = list(data.get("missing", ()))
    members = int((analysis.given.arrays.element_node[[0, 2]] > 0).all(axis=0).sum())
    if members > MOST_MEMBERS:
        told.append(f"Of {members} members the first {MOST_MEMBERS} are drawn.")
    kinds = [movement["kind"] for movement in data["movements"]]
    moved = kinds.count("motion")
    if moved < analysis.under_constrained:
        told.append(f"Of {analysis.under_constrained} motions the first {moved} can be shown.")
    if (shown := len(data["stresses"])) < analysis.over_constrained:
        told.append(f"Of {analysis.over_constrained} self-stresses the first {shown} can be shown.")
    # Those inside of what is taken as one beam move nothing by themselves.
    freedom, free = int(analysis.raw.counts[:, -1].sum()), kinds.count("freedom")
    if free + len(stuck_in(analysis)) < freedom:
        told.append(f"Of {freedom} declared degrees of freedom {free} can be shown.")
    return " ".join(told)
