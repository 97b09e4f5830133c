# SPDX-License-Identifier: BSD-3-Clause
"""A cost as a page: the designs, their charts, and what vibrates and buckles, to turn and play."""

from __future__ import annotations

from html import escape

from ..show.charts import Key
from ..show.page import Side, designs_page
from ..show.page.assets import image, text
from ..show.page.charts import bars_svg, chart_svg
from ..show.page.viewer import Shape as Played
from ..show.page.viewer import Shaped
from ..show.picture import has_packages, shape_bytes
from ..show.writers import as_bytes
from ..util.text import file_name, harmless
from .charts import LARGEST, bars_of, charts_of, choices_of, key_of, plot_bytes, typeset
from .designs import CostValues, Design, Number, in_words
from .shape import Shape
from .words import describe, first_line

#: Designs that are drawn: the one as built, and beside it the best that has shapes.
_DRAWN = 2


def page_bytes(cost: CostValues) -> bytes:
    """The page as the content of a file."""
    key = key_of(cost)
    chosen = [(series, design) for series, design in enumerate(cost.designs) if _shown(design)]
    # Remarks on the designs, and what the deck does not allow.
    remarks = [f"{design.label}: {remark}" for design in cost.designs for remark in design.remarks]
    return as_bytes(
        designs_page(
            file_name(cost.name),
            typeset(first_line(cost)),
            choices_of(cost),
            key,
            (
                [chart_svg(each) for each in charts_of(cost)],
                [bars_svg(each) for each in bars_of(cost)],
            ),
            [_side(series, design, key) for series, design in chosen[:_DRAWN]],
            [harmless(each) for each in (*remarks, *cost.left_out)],
        )
    )


def _shown(design: Design) -> tuple[Shape, ...]:
    """The shapes of one model, without those at errors that mean nothing."""
    first = next(iter(design.shapes), None)
    if first is None:
        return ()
    nodes = first.displacement.shape
    return tuple(
        each
        for each in design.shapes
        if each.displacement.shape == nodes
        and (
            each.kind == "vibrating"
            or abs(each.value) <= LARGEST * (design.size if _unit(design, each) == "m" else 1.0)
        )
    )


def _side(series: int, design: Design, key: Key) -> Side:
    row, shapes = key.rows[series], _shown(design)
    title = "As built" if not design.released else f"{row.label}: {row.words} released"
    words = "; ".join(
        f"{head}: {cell}" for head, cell in zip(key.heads, row.cells, strict=True) if cell
    )
    played = tuple(
        Played(
            each.kind,
            _label(design, each),
            typeset(each.words),
            each.configuration,
            each.displacement,
        )
        for each in shapes
    )
    still, first = None, shapes[0]
    if has_packages():
        drawn = first.data, first.configuration, first.displacement
        still = shape_bytes(*drawn, typeset(first.words))
    return Side(series, title, words, Shaped(first.data, played), still)


def _unit(design: Design, shape: Shape) -> str:
    """Of the error at which it buckles."""
    units = {each.critical.value: each.misalignment.unit for each in design.tolerances}
    return units.get(min(units, key=lambda size: abs(size - abs(shape.value)), default=0.0), "m")


def _label(design: Design, shape: Shape) -> str:
    """Its frequency, or the error at which it buckles."""
    unit = "Hz" if shape.kind == "vibrating" else _unit(design, shape)
    return typeset(in_words(Number(abs(float(f"{shape.value:.3g}"))), unit))


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
