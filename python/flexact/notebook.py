"""The result as HTML for notebooks: the page in a frame, and the words below it."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from .words import MOST_MODES, describe, sentence

if TYPE_CHECKING:
    from .analysis import Analysis

_HEIGHT = 860


def html_of(analysis: Analysis) -> str:
    """The page of a result in a frame of its own, and the words to open.

    Where a notebook that is not trusted takes frames out, verdict and words are left.
    """
    from .report import page
    from .report.markup import text

    colour = analysis.verdict.colour
    head = text(" ".join(sentence(analysis).split()))
    words = describe(analysis, most=MOST_MODES)
    return (
        f'<div><iframe sandbox="allow-scripts" title="{text(analysis.name or "result")}" '
        f'style="width:100%;height:{_HEIGHT}px;border:0" srcdoc="{escape(page(analysis))}">'
        f"</iframe><details style='border-left:4px solid {colour};padding-left:8px'>"
        f"<summary><b>{head}</b></summary><pre>{escape(words)}</pre></details></div>"
    )
