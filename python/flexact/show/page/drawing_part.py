# SPDX-License-Identifier: BSD-3-Clause
"""A drawing's place in the page: live where the browser can, else a still picture and words."""

from __future__ import annotations

from typing import Any

from .controls import KEYS, PLANAR_KEYS
from .markup import image, text
from .packing import json_for_script


def drawing_part(
    data: dict[str, Any],
    still: bytes | None,
    words: str,
    below: str = "",
    left_out: str = "",
    mark: str = "",
) -> str:
    """The drawing, and its data.

    Args:
        data: The drawing's data.
        still: A picture as PNG, if there is one.
        words: What the picture shows.
        below: HTML of what stands below it where it is live.
        left_out: Sentences about what is not in the page; may be empty.
        mark: What tells its names from those of other drawings of the page.
    """
    keys = PLANAR_KEYS if data["planar"] else KEYS
    note = f'<p class="note">{text(left_out)}</p>' if left_out else ""
    return (
        f'<section class="drawing" aria-label="{text(f"Drawing {mark}".strip())}">'
        f'<script type="application/json" class="drawing-data">{json_for_script(data)}</script>\n'
        f'<div class="still">{_still(still, words)}</div>'
        '<div class="interactive" hidden>'
        '<div class="stage"><canvas class="canvas" tabindex="0" role="application" '
        f'aria-label="Drawing. {text(keys)}" aria-describedby="{mark}shown"></canvas>'
        '<canvas class="overlay" aria-hidden="true"></canvas>'
        '<canvas class="on-paper" aria-hidden="true"></canvas>'
        '<div class="tip" role="tooltip" hidden></div></div>'
        f'<div class="told-below"><p class="shown" id="{mark}shown" role="status" '
        f'aria-live="polite"></p>{_LEGEND}</div>{below}</div>{note}</section>'
    )


_LEGEND = (
    '<div class="legend" hidden><span class="legend-name"></span><span class="legend-bar"></span>'
    '<span class="ticks"><span class="legend-low"></span><span>0</span>'
    '<span class="legend-high"></span></span><span class="legend-note"></span></div>'
)


def _still(still: bytes | None, words: str) -> str:
    if still is None:
        return f'<p class="note">{text(words)} {text(_WITHOUT)}</p>'
    return f'{image(still, words)}<p class="note">{text(_WITHOUT)}</p>'


_WITHOUT = (
    "A browser with scripts and WebGL shows the drawing here, to turn, to play and to colour."
)
