# SPDX-License-Identifier: BSD-3-Clause
"""How the designs of a comparison are told apart: by colour and by dashes.

The colours were sought so that of any two, seen by people of normal sight, with deuteranopia,
protanopia or tritanopia (Machado and others, 2009), the difference is at least 28 in CIE L*a*b*,
and that words in them can be read on white, or on the page's dark ground.
"""

from __future__ import annotations

from typing import NamedTuple


class Style(NamedTuple):
    """The look of a series.

    Attributes:
        colour: On light ground.
        on_dark: On dark ground.
        dashes: Lengths of strokes and gaps, in widths of the line; empty of a full line.
        width: Of its line [pt].
    """

    colour: str
    on_dark: str
    dashes: tuple[float, ...]
    width: float


#: The first is the mechanism as it is. Later ones are drawn over earlier ones, thinner and
#: dashed, so that of curves on each other all are seen.
STYLES = (
    Style("#b8420a", "#ff9d5c", (), 3.2),
    Style("#3b00ff", "#8989ff", (4.0, 1.6), 2.2),
    Style("#007676", "#00b189", (1.6, 1.6), 2.0),
    Style("#b13bd8", "#b189c4", (6.0, 1.4, 1.2, 1.4), 1.8),
    Style("#4e2776", "#76ffff", (8.0, 2.5), 1.6),
    Style("#622714", "#c4ff00", (1.2, 1.2), 1.4),
)


def style_of(series: int) -> Style:
    """The look of a series by its number, from 0; there are as many as a cost has designs."""
    return STYLES[series % len(STYLES)]
