"""The head of the page, the verdict in words, with a sign and a colour; and what is behind it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..verdict import Certainty, Verdict
from ..words import decision, sentence
from .markup import paragraphs, row, section, table, text

if TYPE_CHECKING:
    from ..analysis import Analysis

#: Class of the page and sign, told apart without colours.
KINDS = {
    Verdict.EXACT: ("exact", "\N{CHECK MARK}"),
    Verdict.UNDER: ("under", "\N{LEFT RIGHT ARROW}"),
    Verdict.OVER: ("over", "\N{RIGHTWARDS ARROW}\N{LEFTWARDS ARROW}"),
    Verdict.BOTH: ("both", "\N{LEFT RIGHT ARROW}!"),
}
BROKEN = ("broken", "\N{MULTIPLICATION X}")


def head(kind: str, sign: str, verdict: str, about: str) -> str:
    """The first lines of the page; `about` is HTML."""
    start, colon, rest = " ".join(verdict.split()).partition(":")
    return (
        f'<header class="verdict {kind}"><h1><span class="sign" aria-hidden="true">{sign}</span>'
        f"<span><b>{text(start + colon)}</b>{text(rest)}</span></h1>"
        f'<p class="about">{about}</p>'
        '<button type="button" id="theme" aria-pressed="false" hidden>Dark</button></header>'
    )


def verdict(analysis: Analysis, name: str) -> str:
    """The head of the page of a result."""
    kind, sign = KINDS[analysis.verdict]
    return head(kind, sign, sentence(analysis), " ".join(_about(analysis, name)))


def _about(analysis: Analysis, name: str) -> Iterator[str]:
    if name:
        yield f'<span class="name">{text(name)}</span>'
    if analysis.certainty is Certainty.CERTAIN:
        yield '<span class="fact">decision certain</span>'
    else:
        yield '<span class="fact doubt">decision nearly certain only</span>'
    yield (
        f'<span class="fact">D(c) {analysis.rows} \N{MULTIPLICATION SIGN} {analysis.columns}, '
        f"rank {analysis.rank}</span>"
    )
    freedom = analysis.degrees_of_freedom
    yield f'<span class="fact">{freedom} degree{"s" * (freedom != 1)} of freedom declared</span>'


def decision_part(analysis: Analysis) -> str:
    """Counts by class, rank, gap, certainty, margin and condition."""
    heads = ("", *analysis.counts.coordinates._fields)
    rows = (
        row(name, *(str(value) for value in part))
        for name, part in analysis.counts._asdict().items()
    )
    counts = table(heads, rows, kind="counts")
    return section("decision", "Counts and decision", counts, paragraphs(decision(analysis)))
