# SPDX-License-Identifier: BSD-3-Clause
"""A refined design as a picture: how far each start came, and where its parameters went."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..show.picture.charts import WORDS, draw_chart, width_of
from ..show.picture.files import still_bytes
from ..show.picture.make import shown_figure

if TYPE_CHECKING:
    from .refined import Refined

#: Width and height of a chart [inch]; room to the left, beside names of curves, above and below.
_WIDTH, _HEIGHT, _DPI = 5.6, 2.4, 120
_LEFT, _BESIDE, _ABOVE, _BELOW = 0.75, 0.4, 0.45, 0.55


def figure_of(refined: Refined) -> Any:
    """A figure of matplotlib with all charts below each other.

    Raises:
        FlexactError: matplotlib is missing.
    """
    charts = refined.charts
    measure = shown_figure(dpi=_DPI)
    names = [curve.label for chart in charts for curve in chart.curves]
    right = _BESIDE + max(width_of(measure, name, WORDS, "bold") for name in names)
    row, width = _ABOVE + _HEIGHT + _BELOW, _LEFT + _WIDTH + right
    whole = row * len(charts)
    figure = shown_figure(figsize=(width, whole), dpi=_DPI)
    for k, chart in enumerate(charts):
        bottom = (whole - (k + 1) * row + _BELOW) / whole
        place = (_LEFT / width, bottom, _WIDTH / width, _HEIGHT / whole)
        draw_chart(figure.add_axes(place), chart)
    return figure


def picture_bytes(refined: Refined, suffix: str) -> bytes:
    """The picture as a file of a suffix: .png, .svg or .pdf.

    Raises:
        FlexactError: matplotlib is missing.
    """
    return still_bytes(figure_of(refined), suffix, repr(refined), refined.describe())
