# SPDX-License-Identifier: BSD-3-Clause
"""A cost in a notebook: the sentence that counts, the picture, and the words to open."""

from __future__ import annotations

from html import escape

from ..show.page.markup import image, text
from ..show.picture import has_packages
from .designs import CostValues
from .plot import plot_bytes
from .words import describe, first_line


def html_of(cost: CostValues) -> str:
    """The cost as HTML; without a picture where matplotlib is missing."""
    words = first_line(cost)
    picture = ""
    if has_packages():
        made = image(plot_bytes(cost), words)
        picture = made.replace("<img ", '<img style="width:100%;max-width:1200px" ', 1)
    return (
        f"<div><p><b>{text(words)}</b></p>{picture}"
        f"<details><summary>In words</summary><pre>{escape(describe(cost))}</pre></details></div>"
    )
