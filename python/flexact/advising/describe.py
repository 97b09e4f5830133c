# SPDX-License-Identifier: BSD-3-Clause
"""The advice in plain English: the verdict, what is wrong and why, and steps that mend it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from itertools import groupby
from typing import TYPE_CHECKING

from ..advice.proposal import Purpose
from ..base.plain_text import harmless
from ..result.verdict import Verdict
from ..text.advising.spaces import spaces_lines
from ..text.describe import MOST_MODES, verdict_in_words
from ..text.advising.motions import together_in_words
from ..text.motions import internal_in_words
from ..text.naming import counted
from ..text.sentences import Line, Pieces, filled, sentence
from .left_out import left_out

if TYPE_CHECKING:
    from .advice import Advice

#: How many steps of one aim and outcome stand on a screen.
MOST_STEPS = 6
#: What steps are for.
_AIMS = {
    Purpose.MEND: "To stop with what is stopped twice what nothing stops",
    Purpose.RELEASE: "To stop nothing twice",
    Purpose.DECLARE: "To leave nothing free that is not declared",
    Purpose.HOLD: "To leave nothing free that is not declared",
    Purpose.ADD_WIRE: "To stop what is not wanted with a wire",
}


def describe(advice: Advice, most: int | None = MOST_STEPS) -> str:
    """The advice for people, in lines of at most about a hundred characters.

    Args:
        advice: The advice.
        most: How many steps of one aim and outcome are given; None: all.
    """
    sections = (
        *(_verdict(advice), _motions(advice), _stresses(advice)),
        *(_steps(advice, most), _spaces(advice)),
    )
    blocks = ("\n".join(section) for section in map(list, sections) if section)
    return "\n\n".join(blocks)


def html_of(advice: Advice) -> str:
    """The advice in a notebook: the verdict, and the words below it."""
    head = escape(str(verdict_in_words(advice.analysis)))
    colour = advice.analysis.colour
    return (
        f"<div style='border-left:4px solid {colour};padding-left:8px'><b>{head}</b>"
        f"<pre>{escape(describe(advice))}</pre></div>"
    )


def _verdict(advice: Advice) -> Iterator[str]:
    result = advice.analysis
    if result.name:
        yield harmless(result.name)
    yield filled(sentence(str(verdict_in_words(result))))


def _motions(advice: Advice) -> Iterator[str]:
    count = advice.analysis.under_constrained
    if not count:
        return
    yield "What nothing stops"
    told = [each for each in advice.motions if not each.motion.is_internal]
    yield from _numbered([(each.motion.index + 1, each.pieces) for each in told[:MOST_MODES]])
    yield from _more(len(told) - MOST_MODES, "motion", "s")
    if internal := internal_in_words(advice.analysis):
        yield filled(sentence(f"  {internal}"))
    if len(told) > 1 and (together := together_in_words(advice.analysis, advice.extents)):
        yield filled(sentence(f"  {together}"))


def _stresses(advice: Advice) -> Iterator[str]:
    told = advice.self_stresses
    if not told:
        return
    yield "What is stopped twice"
    yield from _numbered([(each.stress.index + 1, each.pieces) for each in told[:MOST_MODES]])
    yield from _more(advice.analysis.over_constrained - MOST_MODES, "self-stress", "es")


def _more(count: int, what: str, ending: str) -> Iterator[str]:
    if count > 0:
        yield f"  ... and {counted(count, f'more {what}', '', ending)}"


def _steps(advice: Advice, most: int | None) -> Iterator[str]:
    if not advice.steps and advice.analysis.verdict is Verdict.EXACT:
        yield "There is nothing to mend."
    kinds = groupby(advice.steps, lambda one: (_AIMS[one.purpose], one.outcome))
    for place, ((aim, outcome), steps) in enumerate(kinds):
        if place:
            yield ""
        told = tuple(steps)
        yield filled(sentence(f"{aim}; then it is {outcome}"))
        yield from _numbered([(step.number, step.pieces) for step in told[:most]])
        yield from _more(len(told) - len(told[:most]), "such way", "s")
    if missing := tuple(left_out(advice)):
        yield filled(Line(("Left out: ",), tuple((each,) for each in missing)))


def _spaces(advice: Advice) -> Iterator[str]:
    if advice.spaces is not None:
        yield from map(filled, spaces_lines(advice.analysis, advice.spaces))


def _numbered(items: Sequence[tuple[int, Pieces]]) -> Iterator[str]:
    for number, pieces in items:
        yield filled(Line((f"  {number}. ", *pieces)), hanging=True)
