# SPDX-License-Identifier: BSD-3-Clause
"""What a viewer shows of a result, as data of a page, and what is not among it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ...advice.spaces.spaces import Spaces
from ...analysis.freedoms import Freedom
from ...analysis.result import Result
from ...util.partial import attempted
from .drawing import Frame, static_data
from .limits import MOST_MEMBERS, MOST_SHAPES
from .modes import looked_at, movements, stresses
from .tracks import Tracks
from .viewer import holds_data, spaces_data


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
    return {**data, "first": _first(data)}


def _first(data: dict[str, Any]) -> list[tuple[str, str]]:
    """What the verdict says: a motion, else a self-stress, else a degree of freedom."""
    moves = any(movement["kind"] == "motion" for movement in data["movements"])
    if data["stresses"] and not moves:
        return [("stress", "0")]
    return [("movement", "0")] if data["movements"] else []


def stuck_in(analysis: Result) -> list[Freedom]:
    """The declared degrees of freedom in which the mechanism cannot move."""
    return [each for each in looked_at(analysis) if each.motion is None]


def left_out(analysis: Result, data: dict[str, Any]) -> str:
    """Sentences on what of a large result is not in its drawing."""
    return " ".join(_left_out(analysis, data))


def _left_out(analysis: Result, data: dict[str, Any]) -> Iterator[str]:
    yield from data.get("missing", ())
    members = int((analysis.given.arrays.element_node[[0, 2]] > 0).all(axis=0).sum())
    if members > MOST_MEMBERS:
        yield f"Of {members} members the first {MOST_MEMBERS} are drawn."
    kinds = [movement["kind"] for movement in data["movements"]]
    moved = kinds.count("motion")
    if moved < analysis.under_constrained:
        yield f"Of {analysis.under_constrained} motions the first {moved} can be shown."
    if (shown := len(data["stresses"])) < analysis.over_constrained:
        yield f"Of {analysis.over_constrained} self-stresses the first {shown} can be shown."
    # Those inside of what is taken as one beam move nothing by themselves.
    freedom, free = int(analysis.raw.counts[:, -1].sum()), kinds.count("freedom")
    if free + len(stuck_in(analysis)) < freedom:
        yield f"Of {freedom} declared degrees of freedom {free} can be shown."
