# SPDX-License-Identifier: BSD-3-Clause
"""The verdict on a deck, in a line, and steps that mend it; both take a while."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from ...advice.advice import Advice, advice_of
from ...analysis.decomposition import Asked
from ...analysis.mode_words import (
    conflict_in_words,
    internal_in_words,
    motion_in_parts,
    stress_in_parts,
)
from ...analysis.naming import Named, Pieces, plain
from ...analysis.result import Result, result_of
from ...analysis.verdict import Verdict
from ...analysis.verdict_words import margin_in_short, verdict_in_short, warnings_of
from ...deck.diagnostics import Diagnostic, Place, Severity
from ...util.errors import FlexactError
from ...util.text import harmless
from .deck import Deck, Key
from .document import Document, Position, Range

_FIRST_WORD = re.compile(r"^\s*(\S*)")


class Remark(NamedTuple):
    """What stands at another place of a problem."""

    range: Range
    text: str


class Problem(NamedTuple):
    """A problem at its place.

    Attributes:
        range: Where it is.
        severity: How grave it is.
        code: Its code.
        message: What is wrong.
        remarks: What is said besides, and where: the label, the other place, the help.
        help: How to mend it.
    """

    range: Range
    severity: Severity
    code: str
    message: str
    remarks: tuple[Remark, ...] = ()
    help: str = ""


def problems_of(deck: Deck) -> list[Problem]:
    """All that was found, in the order of the places."""
    problems = deck.problems
    made = [_problem(deck.document, item) for item in problems.kept]
    more = problems.total - len(problems.kept)
    if more > 0:
        words = f"and {more} more problem{'s' if more > 1 else ''}"
        made.append(Problem(first_line(deck.document), Severity.NOTE, "more", words))
    return made


def first_line(document: Document) -> Range:
    """All of the first line."""
    return Range.within(0, 0, len(document.bare[0]))


def first_word(document: Document) -> Range:
    """The first word of the first line."""
    first, last = _FIRST_WORD.search(document.bare[0]).span(1)  # type: ignore[union-attr]
    return Range.within(0, first, last)


def _problem(document: Document, item: Diagnostic) -> Problem:
    place = Place(item.line, item.column, item.last_column)
    range_ = _range(document, place) if item.line > 0 else first_line(document)
    remarks = []
    if item.label:
        remarks.append(Remark(range_, harmless(item.label)))
    if item.other is not None:
        other = "first here" if item.other < (item.line, item.column) else "and here"
        remarks.append(Remark(_range(document, item.other), other))
    if item.help:
        remarks.append(Remark(range_, f"help: {harmless(item.help)}"))
    return Problem(
        range_,
        item.severity,
        item.code,
        harmless(item.message),
        tuple(remarks),
        item.help,
    )


def _range(document: Document, place: Place) -> Range:
    start = document.place_of(place.line, place.column)
    end = document.place_of(place.line, max(place.last_column, place.column) + 1)
    return Range(start, max(start, Position(*end)))


#: Motions, and self-stresses, that are said one by one, and what takes part in each.
_MOST, _PARTS = 4, 4
#: Elements up to which steps are looked for.
LARGEST_FOR_STEPS = 1500


@dataclass(frozen=True, eq=False)
class Opinion:
    """What an analysis says.

    Attributes:
        words: Such as "over-constrained by 1; margin 12 um"; why there is none where the
            analysis failed.
        verdict: The verdict; None where there is none.
        remarks: Motions, self-stresses and doubts, at the elements and nodes that take part.
        result: The result; None where there is none.
    """

    words: str
    verdict: Verdict | None
    remarks: tuple[Remark, ...] = ()
    result: Result | None = None


def opinion_on(deck: Deck) -> Opinion | None:
    """The verdict on a deck; None where it has errors."""
    data = deck.data
    if data is None:
        return None
    try:
        result: Result = result_of(data, Asked(), "deck", None, Result)
        return Opinion(
            f"{verdict_in_short(result)}; {margin_in_short(result)}",
            result.verdict,
            tuple(_remarks(deck, result)),
            result,
        )
    except (FlexactError, MemoryError) as error:
        return Opinion(f"no verdict: {harmless(str(error)).splitlines()[0]}", None)


def advice_on(opinion: Opinion) -> Advice | None:
    """Steps that mend the mechanism; None where nothing is to be mended, or it is too large."""
    result = opinion.result
    if result is None or result.verdict is Verdict.EXACT:
        return None
    if result.given.arrays.element_number.size > LARGEST_FOR_STEPS:
        return None
    try:
        advice = advice_of(result)
        _ = advice.steps
    except (FlexactError, MemoryError):
        return None
    return advice


def _remarks(deck: Deck, result: Result) -> list[Remark]:
    made = []
    internal = internal_in_words(result)
    motions = [one for one in result.motions if not (internal and one.is_internal)]
    for number, motion in enumerate(motions[:_MOST], start=1):
        moving = _listed(motion_in_parts(motion, _PARTS))
        made.append(_remark(deck, f"motion {number}: ", moving, moving))
    if internal:
        made.append(Remark(first_line(deck.document), internal))
    for number, stress in enumerate(result.self_stresses[:_MOST], start=1):
        carried = _listed(stress_in_parts(stress, _PARTS))
        words = conflict_in_words(stress) or carried
        made.append(_remark(deck, f"self-stress {number}: ", words, carried))
    known = len(result.data.problems.kept)
    for item in warnings_of(result)[known:]:
        made.append(Remark(first_line(deck.document), harmless(item.message)))
    return made


def _listed(parts: Sequence[Pieces]) -> Pieces:
    """Several pieces as one list."""
    apart = [piece for one in parts for piece in ("; ", *one)]
    return tuple(apart[1:])


def _remark(deck: Deck, head: str, words: Pieces, carried: Pieces) -> Remark:
    """A remark where the first of what takes part stands."""
    named = next((piece for piece in (*carried, *words) if isinstance(piece, Named)), None)
    where: list[Range] = []
    if named is not None:
        key: Key = (named.kind, named.number)
        where = deck.index.definition(key)
    return Remark(where[0] if where else first_line(deck.document), f"{head}{plain(words)}")
