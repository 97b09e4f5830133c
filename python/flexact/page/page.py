# SPDX-License-Identifier: BSD-3-Clause
"""The page of a deck: whole, as text."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Any

from ..base.errors import require_kind
from ..diagnostics.errors import ProblemsError
from ..drawing import drawing_of
from ..result.result import Result
from ..text.describe import VerdictInWords, verdict_in_words
from ..text.margin import verdict_word
from ..text.warnings import warnings_of
from .assets import PLAIN_SCRIPTS, SCRIPTS, filled
from .controls_part import choices_part, drawing_part
from .deck_part import deck_of_model, deck_part
from .drawing_data import frame_of, static_data
from .limits import MOST_MEMBERS
from .markup import section, text
from .modes_data import looked_at, movements, stresses
from .modes_part import motions_part, stresses_part
from .origin_part import origin_part
from .packing import json_for_script
from .tracks import Tracks
from .verdict_part import BROKEN, advice_part, advised, decision_part, head, verdict


def page(analysis: Result, still: bytes | None = None) -> str:
    """The page of a result.

    Args:
        analysis: The result.
        still: A picture of it, as PNG, for browsers without scripts or WebGL.
    """
    require_kind(analysis, Result, "a page is that of a result")
    data = _data(analysis)
    every = warnings_of(analysis)
    name = _file_name(analysis.name)
    raw, is_written = deck_of_model(analysis.given)
    drawn = sum(movement["kind"] == "motion" for movement in data["movements"])
    warnings = [item for item in every if item.line == 0]
    in_deck = [item for item in every if item.line > 0]
    words = str(verdict_in_words(analysis))
    advice = advised(analysis)
    stuck = [each for each in looked_at(analysis) if each.motion is None]
    left_out = " ".join(_left_out(analysis, data, len(stuck)))
    body = (
        verdict(analysis, name, advice),
        "<main>",
        drawing_part(data, still, words, left_out),
        '<div class="side">',
        choices_part(data, stuck),
        advice_part(advice),
        section("notes", "Notes", *(f"<p>{_note(item)}</p>" for item in warnings)),
        motions_part(analysis, drawn),
        stresses_part(analysis),
        decision_part(analysis),
        "</div>",
        '<div class="below">',
        deck_part(raw, in_deck, is_written),
        origin_part(raw, name, analysis, is_written),
        "</div></main>",
    )
    held = f'<script type="application/json" id="drawing-data">{json_for_script(data)}</script>\n'
    title = f"{name or 'model'}: {verdict_word(analysis)}"
    return filled(title, "\n".join(body), SCRIPTS, held)


def broken_page(error: Exception, name: str) -> str:
    """The page of a deck that cannot be analysed; it says why.

    Args:
        error: Why: with diagnostics, or a sentence.
        name: The deck's file name.
    """
    name = _file_name(name)
    words = reason_in_words(error)
    raw, told = b"", ""
    if isinstance(error, ProblemsError):
        raw = error.source.text if error.source is not None else b""
        told = deck_part(raw, error.diagnostics)
    body = (
        head(
            *BROKEN,
            VerdictInWords("Cannot be analysed", words),
            f'<span class="name">{text(name)}</span>',
        ),
        '<main class="plain">',
        told,
        origin_part(raw, name, None, False) if raw else "",
        "</main>",
    )
    return filled(f"{name}: cannot be analysed", "\n".join(body), PLAIN_SCRIPTS)


def reason_in_words(error: Exception) -> str:
    """Why a deck cannot be analysed, in a few words."""
    if isinstance(error, ProblemsError):
        count = error.problems.errors
        return f"{count} error{'s' * (count != 1)}"
    return str(error) or "not enough memory"


def _data(analysis: Result) -> dict[str, Any]:
    frame = frame_of(drawing_of(analysis.given))
    tracks = Tracks(frame)
    return {
        **static_data(analysis, frame),
        "reference": tracks.data(),
        "segments": tracks.segments,
        "motions": analysis.under_constrained,
        "movements": movements(analysis, tracks),
        "stresses": stresses(analysis, frame),
    }


def _left_out(analysis: Result, data: dict[str, Any], stuck: int) -> Iterator[str]:
    """What of a large result is not in the drawing; `stuck` degrees of freedom do not move."""
    members = int((analysis.given.arrays.element_node[[0, 2]] > 0).all(axis=0).sum())
    if members > MOST_MEMBERS:
        yield f"Of {members} members the first {MOST_MEMBERS} are drawn."
    kinds = [movement["kind"] for movement in data["movements"]]
    moved = kinds.count("motion")
    if moved < analysis.under_constrained:
        yield f"Of {analysis.under_constrained} motions the first {moved} can be shown."
    if (shown := len(data["stresses"])) < analysis.over_constrained:
        yield f"Of {analysis.over_constrained} self-stresses the first {shown} can be shown."
    freedom, free = analysis.degrees_of_freedom, kinds.count("freedom")
    if free + stuck < freedom:
        yield f"Of {freedom} declared degrees of freedom {free} can be shown."


def _note(item: Any) -> str:
    hint = f" {text(item.help)}" if item.help else ""
    return f"<b>{item.severity}</b>: {text(item.message)}{'.' if hint else ''}{hint}"


def _file_name(name: str) -> str:
    """The last part of a path: where the deck lies is nobody's concern."""
    return os.path.basename(name.replace("\\", "/")) if name else ""
