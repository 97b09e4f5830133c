# SPDX-License-Identifier: BSD-3-Clause
"""The advice in plain English: the verdict, what is wrong and why, and steps that mend it."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from itertools import groupby
from typing import TYPE_CHECKING

from ..advice.proposal import Purpose
from ..base.plain_text import harmless
from ..result.verdict import Verdict
from ..text.advising.spaces import spaces_lines
from ..text.describe import MOST_MODES, verdict_in_words
from ..text.advising.extents import finite_in_words
from ..text.motions import internal_in_words
from ..text.naming import counted
from ..text.sentences import Line, Pieces, filled, plain, sentence
from .left_out import left_out

if TYPE_CHECKING:
    from .advice import Advice

#: How many steps of one aim and outcome stand on a screen.
MOST_STEPS = 6
#: Causes of fewer letters are told again.
_SHORT = 100
#: What steps are for.
_AIMS = {
    Purpose.MEND: "To let what is stopped twice stop what is free",
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
    causes = _Causes()
    sections = (
        *(_verdict(advice), _motions(advice, causes), _stresses(advice, causes)),
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


def _motions(advice: Advice, causes: _Causes) -> Iterator[str]:
    count = advice.analysis.under_constrained
    if not count:
        return
    yield "What nothing stops"
    told = [each for each in advice.motions if not each.motion.is_internal]
    for each in told[:MOST_MODES]:
        number = each.motion.index + 1
        yield _item(number, (*each.what, *causes.told(each.why, f"motion {number}")))
    yield from _more(len(told) - MOST_MODES, "motion", "s")
    if internal := internal_in_words(advice.analysis):
        yield filled(sentence(f"  {internal}"))
    for line in finite_in_words(advice.extents) if len(told) > 1 else ():
        yield filled(line._replace(head=("  ", *line.head)))


def _stresses(advice: Advice, causes: _Causes) -> Iterator[str]:
    told = advice.self_stresses
    if not told:
        return
    yield "What is stopped twice"
    for each in told[:MOST_MODES]:
        number = each.stress.index + 1
        yield _item(number, (*each.what, *causes.told(each.why, f"self-stress {number}")))
    yield from _more(advice.analysis.over_constrained - MOST_MODES, "self-stress", "es")


class _Causes:
    """Causes that were told, so that none is told in the same words again."""

    def __init__(self) -> None:
        self._whose: dict[str, str] = {}

    def told(self, why: Pieces, whose: str) -> Pieces:
        """Why something is there; of a long cause that was told, where."""
        words = plain(why)
        first = self._whose.setdefault(words, whose)
        is_short = len(words) < _SHORT
        return (" ", *why) if first == whose or is_short else (f" The cause is that of {first}.",)


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
        yield from (_item(step.number, step.pieces) for step in told[:most])
        yield from _more(len(told) - len(told[:most]), "such way", "s")
    if missing := tuple(left_out(advice)):
        yield filled(Line(("Left out: ",), tuple((each,) for each in missing)))


def _spaces(advice: Advice) -> Iterator[str]:
    if advice.spaces is not None:
        yield from map(filled, spaces_lines(advice.analysis, advice.spaces))


def _item(number: int, pieces: Pieces) -> str:
    return filled(Line((f"  {number}. ", *pieces)), hanging=True)
