# SPDX-License-Identifier: BSD-3-Clause
"""Drawings side by side: a mechanism before and after a change, and designs with their charts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from ...advice.spaces.spaces import Spaces
from ...analysis.naming import Line, Pieces
from ...analysis.result import Result
from ...util.errors import require_kind
from ...util.text import file_name
from ..charts import Key
from ..drawing import drawing_of
from ..spaces import SpaceShown
from .assets import (
    PLAIN_SCRIPTS,
    SCRIPTS,
    breakable,
    filled,
    linked,
    paragraphs,
    row,
    section,
    table,
    text,
)
from .charts import series_css
from .content import SWITCH, result_side, verdict_of_side
from .controls import choices_part, keys, layers, toolbar
from .drawing import drawing_part, frames_of
from .viewer import Shaped, shapes_data, viewer_data


def before_and_after(
    before: Result,
    after: Result,
    changed: Pieces,
    told: Iterable[Line] = (),
    stills: tuple[bytes | None, bytes | None] = (None, None),
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
        spaces: Freedom and constraint spaces of a body of each, to be switched on.
        runs: What both are called, where they are two decks.
        changes: What changed, as HTML.
    """
    require_kind(before, Result, "a page is that of a result")
    require_kind(after, Result, "a page is that of a result")
    results = (before, after)
    frames = frames_of(*(drawing_of(each.given) for each in results))
    one, two = (viewer_data(*each) for each in zip(results, frames, spaces, strict=True))
    # What the verdict says, both where it is both.
    if one["first"] == [("movement", "0")] and one["stresses"]:
        one["first"] = [*one["first"], ("stress", "0")]
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
        result_side(before, one, "before-", verdict_of_side(before, heads[0]), stills[0]),
        result_side(after, two, "after-", verdict_of_side(after, heads[1]), stills[1]),
        f'<section class="shared" aria-label="In both drawings" hidden>{layers(one, two)}'
        f"{keys(one)}</section>",
        section("advice", "What can be done", paragraphs(told)),
        "</main>",
    )
    styles = ("style.css", "index.css", "compare.css") if changes else ("style.css",)
    return filled(title, "\n".join(body), SCRIPTS, styles)


class Side(NamedTuple):
    """A design that is drawn.

    Attributes:
        series: Its number, by which it is coloured.
        title: Such as "As built".
        words: What is to be known of it, a sentence.
        shaped: Its shapes.
        still: A picture as PNG, for browsers without scripts or WebGL.
        spaces: Drawn with it.
    """

    series: int
    title: str
    words: str
    shaped: Shaped
    still: bytes | None
    spaces: tuple[SpaceShown, ...] = ()


def designs_page(
    name: str,
    headline: str,
    about: Sequence[str],
    key: Key,
    charts: Sequence[Sequence[str]],
    sides: Sequence[Side],
    notes: Sequence[str],
) -> str:
    """The page as text.

    Args:
        name: Of the mechanism.
        headline: The sentence that counts.
        about: How it was found, in parts.
        key: The table of the designs.
        charts: Charts as SVG, in groups that begin on a new line.
        sides: One or two designs that are drawn.
        notes: Sentences below.
    """
    rows = (
        row(
            f'<span class="s{each.series} swatch" aria-hidden="true"></span>'
            f'<span class="s{each.series} named says">{text(each.label)}</span> '
            + (text(each.words) if each.words != each.label else ""),
            *(
                f'<span class="head" aria-hidden="true">{text(head)}</span>{text(cell)}'
                for head, cell in zip(key.heads, each.cells, strict=True)
            ),
        )
        for each in key.rows
    )
    groups = (f'<div class="charts">{"".join(each)}</div>' for each in charts if each)
    body = (
        top(headline, about, is_named=bool(name)),
        f'<main class="{"pair" if sides else "plain"} designs">',
        section("designs", "The designs", table(("design", *key.heads), rows, kind="designs")),
        section("charts", "What each bears and keeps", "".join(groups)),
        _drawn(sides),
        section("notes", "To be known", *(f"<p>{text(each)}</p>" for each in notes)),
        "</main>",
    )
    title = f"{name or 'model'}: what over-constraint costs"
    scripts = SCRIPTS if sides else PLAIN_SCRIPTS
    # Those of charts come behind those of all pages.
    styles = ("style.css", "charts.css")
    return filled(title, "\n".join(body), scripts, styles, series_css())


def top(headline: str, about: Sequence[str], *, is_named: bool = True) -> str:
    """The head of a page: the sentence that counts, and facts, the first a name if there is one."""
    facts = " ".join(
        f'<span class="{"name" if k == 0 and is_named else "fact"}">{text(each)}</span>'
        for k, each in enumerate(about)
    )
    return (
        '<header class="verdict top"><h1 class="headline">'
        f"<span>{text(headline)}</span></h1>"
        f'<p class="about">{facts}</p>{SWITCH}</header>'
    )


def spaces_page(name: str, headline: str, told: Iterable[Line], sides: Sequence[Side]) -> str:
    """A freedom without a mechanism as a page; arguments as those of `spaces_body`."""
    body = spaces_body(name, headline, told, sides)
    return filled(name, body, SCRIPTS, ("style.css", "charts.css"))


def spaces_body(name: str, headline: str, told: Iterable[Line], sides: Sequence[Side]) -> str:
    """What stands in the body of such a page: its spaces, side by side, and words.

    Args:
        name: What it is called.
        headline: The sentence that counts.
        told: Further ones.
        sides: Its freedom and its constraint.
    """
    body = (
        top(headline, (name,)),
        '<main class="pair designs">',
        _drawn(sides),
        section("notes", "What it takes", paragraphs(told)),
        "</main>",
    )
    return "\n".join(body)


def _drawn(sides: Sequence[Side]) -> str:
    if not sides:
        return ""
    frames = frames_of(*(drawing_of(each.shaped.data) for each in sides))
    every = [
        shapes_data(each.shaped, frame, each.spaces)
        for each, frame in zip(sides, frames, strict=True)
    ]
    marks = [f"design-{k}-" for k in range(len(sides))]
    halves = (
        f'<div class="viewer half"><header class="verdict s{side.series} design">'
        f'<h2 class="headline"><span class="says">{text(side.title)}</span></h2>'
        f'<p class="about">{text(side.words)}</p></header>'
        f"{drawing_part(data, side.still, f'{side.title}. {side.words}', mark=mark)}"
        f"{choices_part(data, (), mark=mark)}</div>"
        for side, data, mark in zip(sides, every, marks, strict=True)
    )
    # A divided sheet has so many nodes that arrows of them all hide it.
    return (
        '<section class="shared" aria-label="The drawings" hidden>'
        f"{toolbar(*every)}</section>{''.join(halves)}"
        '<section class="shared" aria-label="In the drawings" hidden>'
        f"{layers(*every, off=('arrows',))}{keys(every[0])}</section>"
    )
