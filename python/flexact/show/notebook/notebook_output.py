# SPDX-License-Identifier: BSD-3-Clause
"""A result as an output of a notebook: a still picture and its data, which the viewer wakes."""

from __future__ import annotations

from html import escape

from ...advice.describe import MOST_MODES, describe, verdict_in_words
from ...analysis.result import Result
from ...analysis.text_margin import margin_in_short
from ...util.partial import attempted
from ..page.content import content_of
from ..page.markup import text
from .given import begin, is_wanted
from .output import packed, script, tag
from .stills import WHOLE, still

_HOW = (
    "A still picture. It turns and plays where the notebook is trusted; if it does not, run "
    "<code>flexact.viewer()</code> in a cell."
)


def html_of(analysis: Result) -> str:
    """The result: still, and its data; the first of a kernel with the viewer."""
    body = content_of(analysis, is_short=True).body
    return (
        f"<{tag()}>{_light(analysis)}"
        f'<script type="application/octet-stream" class="flexact-data">{packed(body)}</script>'
        f"</{tag()}>{script() if is_wanted() else ''}"
    )


def _light(analysis: Result) -> str:
    """What is seen without scripts."""
    words = str(verdict_in_words(analysis))
    name = f"{text(analysis.name)}<br>" if analysis.name else ""
    head = f"<b>{text(words)}</b>"
    line = f"border-left:5px solid {analysis.colour};padding-left:10px"
    margin = text(margin_in_short(analysis).capitalize())
    told = escape(attempted("", lambda: describe(analysis, most=MOST_MODES), words, None))
    return (
        f"<div><p style='{line}'>{name}{head} {margin}.</p>{still(analysis, WHOLE, words)}"
        f"<details><summary>In words</summary><pre>{told}</pre></details>"
        f"<p><small>{_HOW}</small></p></div>"
    )


class Viewer:
    """The viewer of results in notebooks, brought by the cell that shows this."""

    def __repr__(self) -> str:
        """What it is."""
        return "<the viewer of results in notebooks>"

    def _repr_html_(self) -> str:
        begin()
        is_wanted()
        return f"<p>The viewer is here: results in this notebook turn and play.</p>{script()}"


def viewer() -> Viewer:
    """The viewer, for a notebook that has lost it: show it in a cell, and all results live.

    The first result that a kernel shows brings it by itself. It is gone where that output was
    cleared, and in a copy of some cells.
    """
    return Viewer()
