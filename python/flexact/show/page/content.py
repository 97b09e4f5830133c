# SPDX-License-Identifier: BSD-3-Clause
"""What a page of a deck holds, to stand in a page of its own or in another."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from ...advice.describe import VerdictInWords, verdict_in_words
from ...advice.spaces.spaces import Spaces
from ...analysis.result import Result
from ...analysis.text_margin import verdict_word
from ...analysis.warnings import warnings_of
from ...deck.errors import ProblemsError
from ...util.errors import require_kind
from ...util.partial import attempted, why
from ...util.plain_text import file_name
from ..drawing import drawing_of
from .controls import choices_part, keys, layers, toolbar
from .deck_part import deck_of_model, deck_part
from .drawing import frames_of
from .drawing_part import drawing_part
from .limits import FEW_SHAPES, MOST_SHAPES
from .markup import folded, section, text
from .modes_part import motions_part, stresses_part
from .origin_part import origin_part
from .verdict_part import BROKEN, Advised, advice_part, advised, decision_part, head, verdict
from .viewer_data import left_out, stuck_in, viewer_data

_SCROLLS = "Until you click on the drawing, the wheel scrolls past it."


class Content(NamedTuple):
    """What stands in the body of a page.

    Attributes:
        title: Of the page, as text.
        body: HTML, with the data of its drawing.
        kind: "result", or "broken" where the deck cannot be analysed.
    """

    title: str
    body: str
    kind: str


def content_of(
    analysis: Result,
    still: bytes | None = None,
    spaces: Spaces | None = None,
    *,
    has_origin: bool = True,
    is_short: bool = False,
    missing: Sequence[str] = (),
) -> Content:
    """What the page of a result holds; what of it cannot be made is left out, and told.

    Args:
        analysis: The result.
        still: A picture of it, as PNG, for browsers without scripts or WebGL.
        spaces: The freedom space and the constraint space of a body, to be switched on.
        has_origin: Whether it is told of what it was made, and how it is made again.
        is_short: Whether tables and deck are folded away, as among other things.
        missing: Sentences on what is left out already.
    """
    require_kind(analysis, Result, "a page is that of a result")
    told = list(missing)

    def made(what: str, make: Callable[[], str]) -> str:
        return attempted(what, make, "", told)

    def drawn() -> dict[str, Any]:
        (frame,) = frames_of(drawing_of(analysis.given))
        return viewer_data(analysis, frame, spaces, FEW_SHAPES if is_short else MOST_SHAPES)

    data = attempted("The drawing", drawn, None, told)
    every = warnings_of(analysis)
    name = file_name(analysis.name)
    raw, is_written = deck_of_model(analysis.given)
    warnings = [item for item in every if item.line == 0]
    in_deck = [item for item in every if item.line > 0]
    words = str(verdict_in_words(analysis))
    advice = attempted("What can be done", lambda: advised(analysis), Advised((), ()), told)
    movements = [] if data is None else data["movements"]
    moving = sum(movement["kind"] == "motion" for movement in movements)
    tables: tuple[str, ...] = (
        advice_part(advice),
        section("notes", "Notes", *(f"<p>{_note(item)}</p>" for item in warnings)),
        made("The table of motions", lambda: motions_part(analysis, moving)),
        made("The table of self-stresses", lambda: stresses_part(analysis)),
        decision_part(analysis),
    )
    origin: tuple[str, ...] = (
        deck_part(raw, in_deck, is_written),
        origin_part(raw, name, analysis, is_written) if has_origin else "",
    )
    if is_short:
        tables = (folded("What can be done, tables, decision", *tables),)
        origin = (folded("Deck and versions", *origin),)
    drawing, choices = "", ""
    if data is not None:
        scrolls = f'<p class="keys">{_SCROLLS}</p>' * is_short
        below = toolbar(data) + keys(data) + scrolls
        others = left_out(analysis, data)
        drawing = drawing_part(data, still, words, below, " ".join([*told, others]).strip())
        choices = choices_part(data, stuck_in(analysis), layers(data))
    else:
        drawing = "".join(f'<p class="note">{text(each)}</p>' for each in told)
    body = (
        verdict(analysis, name, advice),
        '<main class="viewer">',
        drawing,
        '<div class="side">',
        choices,
        *tables,
        "</div>",
        '<div class="below">',
        *origin,
        "</div></main>",
    )
    title = f"{name or 'model'}: {verdict_word(analysis)}"
    return Content(title, "\n".join(body), "result")


def broken_content(error: Exception, name: str) -> Content:
    """What the page of a deck holds that cannot be analysed: why.

    Args:
        error: Why: with diagnostics, or a sentence.
        name: The deck's file name.
    """
    name = file_name(name)
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
    return Content(f"{name}: cannot be analysed", "\n".join(body), "broken")


def reason_in_words(error: Exception) -> str:
    """Why a deck cannot be analysed, in a few words."""
    if isinstance(error, ProblemsError):
        count = error.problems.errors
        return f"{count} error{'s' * (count != 1)}"
    return why(error)


def _note(item: Any) -> str:
    hint = f" {text(item.help)}" if item.help else ""
    return f"<b>{item.severity}</b>: {text(item.message)}{'.' if hint else ''}{hint}"
