# SPDX-License-Identifier: BSD-3-Clause
"""The advice in plain English: the verdict, what is wrong and why, and steps that mend it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from typing import TYPE_CHECKING

from ..base.plain_text import harmless
from ..text.advising.spaces import spaces_lines
from ..text.describe import MOST_MODES, verdict_in_words
from ..text.motions import internal_in_words
from ..text.naming import counted
from ..text.sentences import Line, Pieces, filled, sentence
from .steps import Step

if TYPE_CHECKING:
    from .advice import Advice

#: How many steps stand on a screen.
MOST_STEPS = 12


def describe(advice: Advice, most: int | None = MOST_STEPS) -> str:
    """The advice for people, in lines of at most about a hundred characters.

    Args:
        advice: The advice.
        most: How many steps are given one by one; None: all.
    """
    sections = (_verdict(advice), _motions(advice), _stresses(advice), _steps(advice, most), _spaces(advice))
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
    result = advice.analysis
    count = result.under_constrained
    if not count:
        return
    yield f"Motion{'s' * (count > 1)} that nothing stops" 
    internal = internal_in_words(result)
    if internal:
        yield filled(sentence(f"  {internal}"))
    told = [each for each in advice.motions if not each.motion.is_internal]
    yield from _numbered([(each.motion.index + 1, each.pieces) for each in told[:MOST_MODES]])
    if len(told) > MOST_MODES:
        yield f"  ... and {counted(len(told) - MOST_MODES, 'more motion', '', 's')}"


def _stresses(advice: Advice) -> Iterator[str]:
    count = advice.analysis.over_constrained
    if not count:
        return
    yield f"What is stopped twice: {counted(count, 'self-stress', '', 'es')}"
    told = advice.self_stresses
    yield from _numbered([(each.stress.index + 1, each.pieces) for each in told[:MOST_MODES]])
    if count > MOST_MODES:
        yield f"  ... and {counted(count - MOST_MODES, 'more self-stress', '', 'es')}"


def _steps(advice: Advice, most: int | None) -> Iterator[str]:
    shown: Sequence[Step] = advice.steps[:most]
    if not shown:
        return
    yield f"Way{'s' * (len(advice) > 1)} to mend it, each of them analysed"
    yield from _numbered([(step.number, step.pieces) for step in shown])
    if len(advice) > len(shown):
        yield f"  ... and {counted(len(advice) - len(shown), 'more', '', '')}"


def _spaces(advice: Advice) -> Iterator[str]:
    if advice.spaces is not None:
        yield from map(filled, spaces_lines(advice.analysis, advice.spaces))


def _numbered(items: Sequence[tuple[int, Pieces]]) -> Iterator[str]:
    for number, pieces in items:
        # An item makes that what does not fit on the line is indented.
        yield _indented(filled(Line((f"  {number}. ", *pieces))))


def _indented(text: str) -> str:
    first, *rest = text.split("\n")
    return "\n".join([first, *(f"     {line}" for line in rest)])
