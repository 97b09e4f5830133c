# SPDX-License-Identifier: BSD-3-Clause
"""A refined design as a picture: how far each start came, and where its parameters went."""

from __future__ import annotations

from typing import Any

from ..show.picture.charts import draw_chart
from ..show.picture.files import still_bytes
from ..show.picture.make import shown_figure
from .refined import Refined

#: Width of the picture and height of a chart [inch]; room to the left, right, above and below.
_WIDTH, _HEIGHT, _DPI = 9.0, 2.4, 120
_LEFT, _RIGHT, _ABOVE, _BELOW = 0.75, 2.9, 0.45, 0.55


def figure_of(refined: Refined) -> Any:
    """A figure of matplotlib with all charts below each other.

    Raises:
        FlexactError: matplotlib is missing.
    """
    charts = refined.charts
    row = _ABOVE + _HEIGHT + _BELOW
    whole = row * len(charts)
    figure = shown_figure(figsize=(_WIDTH, whole), dpi=_DPI)
    for k, chart in enumerate(charts):
        bottom = whole - (k + 1) * row + _BELOW
        place = (_LEFT, bottom, _WIDTH - _LEFT - _RIGHT, _HEIGHT)
        size = (_WIDTH, whole, _WIDTH, whole)
        draw_chart(figure.add_axes(tuple(a / b for a, b in zip(place, size, strict=True))), chart)
    return figure


def picture_bytes(refined: Refined, suffix: str) -> bytes:
    """The picture as a file of a suffix: .png, .svg or .pdf.

    Raises:
        FlexactError: matplotlib is missing.
    """
    return still_bytes(figure_of(refined), suffix, repr(refined), refined.describe())
