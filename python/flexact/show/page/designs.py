# SPDX-License-Identifier: BSD-3-Clause
"""Designs compared on one page: a table, charts, and what vibrates and buckles side by side."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from ..charts import Key
from ..drawing import drawing_of
from .assets import PLAIN_SCRIPTS, SCRIPTS, filled, row, section, table, text
from .charts import series_css
from .content import SWITCH
from .controls import choices_part, keys, layers, toolbar
from .drawing import drawing_part, frames_of
from .viewer import Shaped, shapes_data

#: Of the page's styles, those of charts come behind those of all pages.
STYLES = ("style.css", "charts.css")
#: A divided sheet has so many nodes that arrows of them all hide it.
_OFF = ("arrows",)


class Side(NamedTuple):
    """A design that is drawn.

    Attributes:
        series: Its number, by which it is coloured.
        title: Such as "As built".
        words: What is to be known of it, a sentence.
        shaped: Its shapes.
        still: A picture as PNG, for browsers without scripts or WebGL.
    """

    series: int
    title: str
    words: str
    shaped: Shaped
    still: bytes | None


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
    facts = " ".join(
        f'<span class="{"name" if k == 0 and name else "fact"}">{text(each)}</span>'
        for k, each in enumerate(about)
    )
    groups = (f'<div class="charts">{"".join(each)}</div>' for each in charts if each)
    body = (
        '<header class="verdict top"><h1 class="headline">'
        f"<span>{text(headline)}</span></h1>"
        f'<p class="about">{facts}</p>{SWITCH}</header>',
        f'<main class="{"pair" if sides else "plain"} designs">',
        section("designs", "The designs", _table(key)),
        section("charts", "What each bears and keeps", "".join(groups)),
        _drawn(sides),
        section("notes", "To be known", *(f"<p>{text(each)}</p>" for each in notes)),
        "</main>",
    )
    title = f"{name or 'model'}: what over-constraint costs"
    scripts = SCRIPTS if sides else PLAIN_SCRIPTS
    return filled(title, "\n".join(body), scripts, STYLES, series_css())


def _table(key: Key) -> str:
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
    return table(("design", *key.heads), rows, kind="designs")


def _drawn(sides: Sequence[Side]) -> str:
    if not sides:
        return ""
    frames = frames_of(*(drawing_of(each.shaped.data) for each in sides))
    every = [shapes_data(each.shaped, frame) for each, frame in zip(sides, frames, strict=True)]
    marks = [f"design-{k}-" for k in range(len(sides))]
    halves = (_side(*each) for each in zip(sides, every, marks, strict=True))
    return (
        '<section class="shared" aria-label="The drawings" hidden>'
        f"{toolbar(*every)}</section>{''.join(halves)}"
        '<section class="shared" aria-label="In the drawings" hidden>'
        f"{layers(*every, off=_OFF)}{keys(every[0])}</section>"
    )


def _side(side: Side, data: dict[str, Any], mark: str) -> str:
    return (
        f'<div class="viewer half"><header class="verdict s{side.series} design">'
        f'<h2 class="headline"><span class="says">{text(side.title)}</span></h2>'
        f'<p class="about">{text(side.words)}</p></header>'
        f"{drawing_part(data, side.still, f'{side.title}. {side.words}', mark=mark)}"
        f"{choices_part(data, (), mark=mark)}</div>"
    )
