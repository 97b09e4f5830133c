# SPDX-License-Identifier: BSD-3-Clause
"""The head of the page: the verdict in words, with a sign and a colour; what helps, and why."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from ...advice.describe import VerdictInWords, verdict_in_words
from ...advice.ways_words import lines_on_motions, lines_on_self_stresses
from ...analysis.result import Result
from ...analysis.sentences import Line
from ...analysis.text_margin import margin_line
from ...analysis.verdict import Certainty, Verdict
from ...analysis.verdict_words import decision, declared_in_words
from .markup import flowing, paragraphs, row, section, table, text

#: Class of the page and sign, told apart without colours.
KINDS = {
    Verdict.EXACT: ("exact", "\N{CHECK MARK}"),
    Verdict.UNDER: ("under", "\N{LEFT RIGHT ARROW}"),
    Verdict.OVER: ("over", "\N{RIGHTWARDS ARROW}\N{LEFTWARDS ARROW}"),
    Verdict.BOTH: ("both", "\N{LEFT RIGHT ARROW}!"),
}
MARGINAL = ("marginal", "\N{ALMOST EQUAL TO}")
BROKEN = ("broken", "\N{MULTIPLICATION X}")


#: How many ways to fix it stand in the head.
_WAYS = 2


class Advised(NamedTuple):
    """What can be done about motions and about self-stresses, the best first."""

    motions: tuple[Line, ...]
    stresses: tuple[Line, ...]


def kind_of(analysis: Result) -> tuple[str, str]:
    """Class of the page and sign of a result."""
    if analysis.verdict is Verdict.EXACT and analysis.is_marginal:
        return MARGINAL
    return KINDS[analysis.verdict]


def advised(analysis: Result) -> Advised:
    """What can be done; nothing where nothing need be."""
    return Advised(lines_on_motions(analysis), lines_on_self_stresses(analysis))


def head(
    kind: str, sign: str, verdict: VerdictInWords, about: str, margin: str = "", todo: str = ""
) -> str:
    """The first lines of the page; all but the sign and the verdict are HTML."""
    return (
        f'<header class="verdict {kind}">{_headline("h1", sign, verdict)}{margin}'
        f'<p class="about">{about}</p>{todo}{SWITCH}</header>'
    )


#: From light to dark and back.
SWITCH = '<button type="button" id="theme" aria-pressed="false" hidden>Dark</button>'


def _headline(level: str, sign: str, verdict: VerdictInWords) -> str:
    return (
        f'<{level} class="headline"><span class="sign" aria-hidden="true">{sign}</span>'
        f'<span><b class="says">{text(verdict.start)}:</b> {text(verdict.reason)}</span></{level}>'
    )


def verdict(analysis: Result, name: str, advice: Advised) -> str:
    """The head of the page of a result: what is wrong, by how much, how sure, and what helps."""
    kind, sign, margin = _judged(analysis)
    about = " ".join(_about(analysis, name))
    return head(kind, sign, verdict_in_words(analysis), about, margin, _todo(advice))


def verdict_of_side(analysis: Result, which: str) -> str:
    """The head of one of several results of a page; `which` is HTML."""
    kind, sign, margin = _judged(analysis)
    return (
        f'<header class="verdict {kind}"><p class="which">{which}</p>'
        f"{_headline('h2', sign, verdict_in_words(analysis))}{margin}"
        f'<p class="about">{" ".join(_about(analysis, ""))}</p></header>'
    )


def _judged(analysis: Result) -> tuple[str, str, str]:
    """Class and sign of a verdict, and how far another one is."""
    kind, sign = kind_of(analysis)
    if analysis.certainty is not Certainty.CERTAIN:
        sign += "?"
    return kind, sign, f'<p class="margin">{flowing(margin_line(analysis))}</p>'


def _certainty(analysis: Result) -> str:
    """How sure the rank is: of the arithmetic, not of the machine."""
    if analysis.certainty is Certainty.CERTAIN:
        is_proven = analysis.proof is not None and analysis.proof.rank == analysis.rank
        how = "proven" if is_proven else "numerically certain"
        return f'<span class="sure">rank {how}</span>'
    counts = (analysis.under_constrained, analysis.over_constrained)
    under, over = analysis.nearly or counts
    other = (
        f": there may be {under} motion{'s' * (under != 1)} and "
        f"{over} self-stress{'es' * (over != 1)}"
    ) * ((under, over) != counts)
    return f'<a class="sure doubt" href="#decision">rank doubtful{other}</a>'


def _todo(advice: Advised) -> str:
    """The first ways to fix it, and where the others are."""
    kinds = (("Motion", advice.motions), ("Self-stress", advice.stresses))
    told = [(f"<b>{kind}:</b> ", sentences[0]) for kind, sentences in kinds if sentences]
    shown = "".join(
        f"<li>{kind if len(told) > 1 else ''}{flowing(first.shortened(_WAYS))}</li>"
        for kind, first in told
    )
    return f'<ul class="todo">{shown}</ul>' if shown else ""


def advice_part(advice: Advised) -> str:
    """All that can be done."""
    kinds = (("About motions", advice.motions), ("About self-stresses", advice.stresses))
    both = all(sentences for _, sentences in kinds)
    parts = [
        (f"<h3>{kind}</h3>" if both else "") + paragraphs(sentences)
        for kind, sentences in kinds
        if sentences
    ]
    return section("remedies", "What can be done", *parts)


def _about(analysis: Result, name: str) -> Iterator[str]:
    if name:
        yield f'<span class="name">{text(name)}</span>'
    yield (
        f'<span class="fact">D(c) {analysis.rows} \N{MULTIPLICATION SIGN} {analysis.columns}, '
        f"rank {analysis.rank}</span>"
    )
    yield _certainty(analysis)
    yield f'<span class="fact">{text(declared_in_words(analysis))}</span>'


def decision_part(analysis: Result) -> str:
    """Counts by class, rank, gap, certainty and condition."""
    heads = ("", *analysis.counts.coordinates._fields)
    rows = (
        row(name, *(str(value) for value in part))
        for name, part in analysis.counts._asdict().items()
    )
    counts = table(heads, rows, kind="counts")
    return section("decision", "Counts and decision", counts, paragraphs(decision(analysis)))
