"""The head of the page: the verdict in words, with a sign and a colour; what helps, and why."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..verdict import Certainty, Verdict
from ..words import decision, remedies_of_motions, remedies_of_self_stresses, sentence
from .markup import flowing, paragraphs, row, section, table, text

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


#: So many ways to mend it stand in the head.
_WAYS = 2


@dataclass(frozen=True)
class Remedies:
    """What can be done about motions and about self-stresses: sentences, the best first."""

    motions: tuple[str, ...]
    stresses: tuple[str, ...]


def remedies_of(analysis: Analysis) -> Remedies:
    """What can be done; nothing where nothing need be."""
    found = (
        remedies_of_motions(analysis) if analysis.under_constrained else (),
        remedies_of_self_stresses(analysis) if analysis.over_constrained else (),
    )
    return Remedies(*(tuple(filter(str.strip, sentences)) for sentences in found))


def head(
    kind: str, sign: str, verdict: str, about: str, certainty: str = "", todo: str = ""
) -> str:
    """The first lines of the page; all but the sign and the verdict are HTML."""
    start, colon, rest = " ".join(verdict.split()).partition(":")
    return (
        f'<header class="verdict {kind}"><h1><span class="sign" aria-hidden="true">{sign}</span>'
        f"<span><b>{text(start + colon)}</b>{text(rest)}{certainty}</span></h1>"
        f'<p class="about">{about}</p>{todo}'
        '<button type="button" id="theme" aria-pressed="false" hidden>Dark</button></header>'
    )


def verdict(analysis: Analysis, name: str, remedies: Remedies) -> str:
    """The head of the page of a result: what is wrong, how sure that is, and what helps."""
    kind, sign = KINDS[analysis.verdict]
    if analysis.certainty is not Certainty.CERTAIN:
        sign += "?"
    about = " ".join(_about(analysis, name))
    return head(kind, sign, sentence(analysis), about, _certainty(analysis), _todo(remedies))


def _certainty(analysis: Analysis) -> str:
    if analysis.certainty is Certainty.CERTAIN:
        return ' <span class="sure">Certain.</span>'
    counts = (analysis.under_constrained, analysis.over_constrained)
    under, over = analysis.nearly or counts
    other = (
        f": there may be {under} motion{'s' * (under != 1)} and "
        f"{over} self-stress{'es' * (over != 1)}"
    ) * ((under, over) != counts)
    return f' <a class="sure doubt" href="#decision">Nearly certain only{other}.</a>'


def _todo(remedies: Remedies) -> str:
    """The first ways to mend it, and where the others are."""
    kinds = (("Motion", remedies.motions), ("Self-stress", remedies.stresses))
    told = [(f"<b>{kind}:</b> ", sentences[0]) for kind, sentences in kinds if sentences]
    shown = "".join(
        f"<li>{kind if len(told) > 1 else ''}{flowing(_shortened(first))}</li>"
        for kind, first in told
    )
    return f'<ul class="todo">{shown}</ul>' if shown else ""


def _shortened(sentence: str) -> str:
    start, colon, ways = " ".join(sentence.split()).partition(": ")
    several = ways.split("; ")
    if len(several) > _WAYS:
        several[_WAYS:] = ["\N{HORIZONTAL ELLIPSIS}"]
    return f"{start}{colon}{'; '.join(several)}"


def remedies_part(remedies: Remedies) -> str:
    """All that can be done."""
    kinds = (("About motions", remedies.motions), ("About self-stresses", remedies.stresses))
    both = all(sentences for _, sentences in kinds)
    parts = [
        (f"<h3>{kind}</h3>" if both else "") + paragraphs(sentences)
        for kind, sentences in kinds
        if sentences
    ]
    return section("remedies", "What can be done", *parts)


def _about(analysis: Analysis, name: str) -> Iterator[str]:
    if name:
        yield f'<span class="name">{text(name)}</span>'
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
