# SPDX-License-Identifier: BSD-3-Clause
"""The result as HTML for notebooks: the page in a frame, and the words below it."""

from __future__ import annotations

from html import escape

from ..result.result import Result
from ..text.describe import MOST_MODES, describe, verdict_in_words
from .markup import text
from .page import page

_HEIGHT = 860


def html_of(analysis: Result) -> str:
    """The page of a result in a frame of its own, and the words to open.

    Where a notebook that is not trusted takes frames out, verdict and words are left.
    """
    colour = analysis.colour
    head = text(str(verdict_in_words(analysis)))
    words = describe(analysis, most=MOST_MODES)
    return (
        f'<div><iframe sandbox="allow-scripts" title="{text(analysis.name or "result")}" '
        f'style="width:100%;height:{_HEIGHT}px;border:0" srcdoc="{escape(page(analysis))}">'
        f"</iframe><details style='border-left:4px solid {colour};padding-left:8px'>"
        f"<summary><b>{head}</b></summary><pre>{escape(words)}</pre></details></div>"
    )
