# SPDX-License-Identifier: BSD-3-Clause
"""A cost as one picture: what it says, the designs, and what each keeps and bears."""

from __future__ import annotations

from typing import Any

from ..show.charts import BarChart, Chart
from ..show.picture.bar_charts import bars_height, draw_bars
from ..show.picture.charts import draw_chart
from ..show.picture.files import png_bytes, still_bytes
from ..show.picture.loading import load_matplotlib
from ..show.picture.make import check_packages
from ..util.plain_text import file_name
from .bars import bars_of
from .charts import charts_of
from .designs import CostValues
from .key import key_of, typeset
from .plot_head import draw_head, draw_notes, head_height, notes_of
from .plot_table import HEAD, table_of
from .words import first_line

#: Width [inch] and pixels an inch: 1200 pixels wide.
_WIDTH, _DPI = 12.0, 100
#: Heights of what stands below each other [inch].
_CHART, _ROW, _ABOVE, _BELOW = 2.15, 0.15, 0.3, 0.48
_END = 0.58
#: Room beside charts and bars for what stands there [inch].
_LEFT, _NAMES, _GROUPS, _RIGHT = 0.62, 0.82, 1.05, 0.35


def plot_of(cost: CostValues) -> Any:
    """The picture as a figure of matplotlib, which a notebook shows.

    Raises:
        FlexactError: matplotlib is missing.
    """
    check_packages()
    load_matplotlib()
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    class Shown(Figure):
        def _repr_png_(self) -> bytes:
            return png_bytes(self)

    charts, bars = charts_of(cost), bars_of(cost)
    measure: Any = Figure(dpi=_DPI)
    FigureCanvasAgg(measure)
    table = table_of(measure, key_of(cost), typeset(first_line(cost)))
    rows = max((bars_height(each) for each in bars), default=0.0)
    head, notes = head_height(table), notes_of(measure, cost)
    heights = (
        head,
        (_ABOVE + _CHART + _BELOW) * bool(charts),
        (_ABOVE + _ROW * rows + _END) * bool(bars),
    )
    below = (HEAD.second * len(notes) + HEAD.room) * bool(notes)
    figure: Any = Shown(figsize=(_WIDTH, sum(heights) + below), dpi=_DPI, facecolor="white")
    FigureCanvasAgg(figure)
    draw_head(figure, cost, table)
    _draw_charts(figure, charts, heights[0])
    _draw_bars(figure, bars, heights[0] + heights[1])
    draw_notes(figure, notes)
    return figure


def plot_bytes(cost: CostValues, suffix: str = ".png") -> bytes:
    """The picture as a file: .png, .svg or .pdf.

    Raises:
        FlexactError: matplotlib is missing.
    """
    words = file_name(cost.name) or "cost", typeset(first_line(cost))
    return still_bytes(plot_of(cost), suffix, *words)


def _axes(figure: Any, left: float, top: float, width: float, height: float) -> Any:
    """Axes at a place from the upper left corner [inch]."""
    whole = figure.get_figheight()
    return figure.add_axes(
        (left / _WIDTH, 1.0 - (top + height) / whole, width / _WIDTH, height / whole)
    )


def _draw_charts(figure: Any, charts: tuple[Chart, ...], top: float) -> None:
    if not charts:
        return
    cell = (_WIDTH - 2 * HEAD.left + 0.15) / len(charts)
    for k, chart in enumerate(charts):
        axes = _axes(
            figure,
            HEAD.left + k * cell + _LEFT,
            top + _ABOVE,
            cell - _LEFT - _NAMES,
            _CHART,
        )
        draw_chart(axes, chart)


def _draw_bars(figure: Any, bars: tuple[BarChart, ...], top: float) -> None:
    if not bars:
        return
    cell = (_WIDTH - 2 * HEAD.left) / len(bars)
    for k, chart in enumerate(bars):
        axes = _axes(
            figure,
            HEAD.left + k * cell + _GROUPS,
            top + _ABOVE,
            cell - _GROUPS - _RIGHT,
            _ROW * bars_height(chart),
        )
        draw_bars(axes, chart)
