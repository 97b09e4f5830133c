# SPDX-License-Identifier: BSD-3-Clause
"""A mechanism as it is, and beside it as a change makes it: seen from one side, playing in step."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ...advice.describe import verdict_in_words
from ...advice.spaces.spaces import Spaces
from ...analysis.result import Result
from ...analysis.sentences import Line, Pieces
from ...util.errors import require_kind
from ...util.plain_text import file_name
from ..drawing import drawing_of
from .assets import SCRIPTS, filled
from .controls import choices_part, keys, layers, toolbar
from .drawing import frames_of
from .drawing_part import drawing_part
from .markup import breakable, linked, paragraphs, section, text
from .verdict_part import SWITCH, verdict_of_side
from .viewer_data import left_out, stuck_in, viewer_data


def before_and_after(
    before: Result,
    after: Result,
    changed: Pieces,
    told: Iterable[Line] = (),
    stills: tuple[bytes | None, bytes | None] = (None, None),
    first: tuple[tuple[str, int], ...] = (),
    spaces: tuple[Spaces | None, Spaces | None] = (None, None),
    runs: tuple[str, str] | None = None,
    changes: str = "",
) -> str:
    """The page of a result beside that of a changed mechanism.

    Both have one scale and one camera: turning one turns the other.

    Args:
        before: The result of the mechanism as it is.
        after: The result of the changed one.
        changed: What was changed, in words that may name elements and nodes of the changed one.
        told: Further advice, which stands below; it may name elements and nodes of the first.
        stills: Pictures of both as PNG, for browsers without scripts or WebGL.
        first: What of the mechanism as it is is shown at first, such as ("motion", 2) and
            ("self-stress", 1); else what its verdict says, both where it is both.
        spaces: Freedom and constraint spaces of a body of each, to be switched on.
        runs: What both are called, where they are two decks.
        changes: What changed, as HTML.
    """
    require_kind(before, Result, "a page is that of a result")
    require_kind(after, Result, "a page is that of a result")
    results = (before, after)
    frames = frames_of(*(drawing_of(each.given) for each in results))
    one, two = (viewer_data(*each) for each in zip(results, frames, spaces, strict=True))
    one["first"] = _chosen(first) or _everything(one)
    name = file_name(before.name)
    title = f"{name or 'model'}: before and after"
    heads = "<b>As it is</b>", f"<b>Changed:</b> {linked(changed)}"
    if runs is not None:
        title = " \N{RIGHTWARDS ARROW} ".join(runs)
        heads = f"<b>Before:</b> {breakable(runs[0])}", f"<b>After:</b> {breakable(runs[1])}"
    body = (
        f'<header class="verdict top"><h1 class="headline">{text(title)}</h1>{SWITCH}</header>',
        '<main class="pair">',
        f'<section class="shared" aria-label="Both drawings" hidden>{toolbar(one, two)}</section>',
        section("changes", "What changed", changes),
        _side(before, one, "before", heads[0], stills[0]),
        _side(after, two, "after", heads[1], stills[1]),
        f'<section class="shared" aria-label="In both drawings" hidden>{layers(one, two)}'
        f"{keys(one)}</section>",
        section("advice", "What can be done", paragraphs(told)),
        "</main>",
    )
    styles = ("style.css", "index.css", "compare.css") if changes else ("style.css",)
    return filled(title, "\n".join(body), SCRIPTS, styles)


def _side(
    analysis: Result, data: dict[str, Any], mark: str, which: str, still: bytes | None
) -> str:
    words = str(verdict_in_words(analysis))
    mark += "-"
    return (
        f'<div class="viewer half">{verdict_of_side(analysis, which)}'
        f"{drawing_part(data, still, words, left_out=left_out(analysis, data), mark=mark)}"
        f"{choices_part(data, stuck_in(analysis), mark=mark)}</div>"
    )


def _chosen(first: tuple[tuple[str, int], ...]) -> list[tuple[str, str]]:
    kinds = {"motion": "movement", "self-stress": "stress"}
    return [(kinds[kind], str(number - 1)) for kind, number in first]


def _everything(data: dict[str, Any]) -> list[tuple[str, str]]:
    """The first motion and the first self-stress, where there are both."""
    first: list[tuple[str, str]] = list(data["first"])
    if first == [("movement", "0")] and data["stresses"]:
        first.append(("stress", "0"))
    return first
