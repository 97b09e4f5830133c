"""The result as HTML for notebooks."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from .words import MOST_MODES, describe, sentence

if TYPE_CHECKING:
    from .analysis import Analysis

_COLOURS = {(False, False): "#2e7d32", (True, False): "#b26a00", (False, True): "#b26a00"}
_WORST = "#b00020"


def html_of(analysis: Analysis) -> str:
    """Verdict, counts as a table, and the words behind them to open."""
    state = analysis.under_constrained > 0, analysis.over_constrained > 0
    colour = _COLOURS.get(state, _WORST)
    rows = "".join(
        f"<tr><th style='text-align:left'>{name}</th>"
        + "".join(f"<td>{value}</td>" for value in part)
        + "</tr>"
        for name, part in analysis.counts._asdict().items()
    )
    heads = "".join(f"<th>{word}</th>" for word in analysis.counts.coordinates._fields)
    words = describe(analysis, most=MOST_MODES)
    return (
        f"<div><p style='border-left:4px solid {colour};padding-left:8px'>"
        f"<b>{escape(sentence(analysis))}</b></p>"
        f"<table><tr><th></th>{heads}</tr>{rows}</table>"
        f"<p>D(c): {analysis.rows} rows, {analysis.columns} columns, rank {analysis.rank}; "
        f"degrees of freedom: {analysis.degrees_of_freedom}</p>"
        f"<details><summary>in words</summary><pre>{escape(words)}</pre></details>"
        "</div>"
    )
