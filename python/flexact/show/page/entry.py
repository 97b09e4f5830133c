# SPDX-License-Identifier: BSD-3-Clause
"""What an index says of one deck."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ...advice.describe import verdict_in_words
from ...analysis.result import Result
from ...analysis.text_margin import margin_in_short, verdict_word
from ...analysis.verdict_words import certainty_word
from ...deck.errors import ProblemsError
from ...deck.source import decode
from ...util.plain_text import file_name, harmless
from .content import reason_in_words
from .verdict_part import BROKEN, kind_of

#: What is counted of decks without a verdict.
_BROKEN = "cannot be analysed"
#: Characters of a line of a deck, and of it before what is wrong.
_LINE, _BEFORE = 90, 30


@dataclass(frozen=True)
class Entry:
    """One deck of an index.

    Attributes:
        name: What it is called.
        page: Path of its page beside the index; empty where there is none.
        kind: Class of its card, and sign.
        verdict: Its verdict as it is counted, or that it cannot be analysed.
        words: The verdict, or why there is none, in a few words.
        margin: How far another verdict is, in a few words.
        picture: A small picture as PNG, if there is one.
        counts: Motions, self-stresses, declared degrees of freedom, elements; none without a
            verdict.
        margin_length: The margin [m], for sorting; None where it is large.
        certainty: How sure the rank is; empty without a verdict.
        place: Where the first error is, as `file:line:column`.
        error: The first error.
        line: The line of the deck that it is in, or the part round it.
        marked: First and last character of that line that are wrong, from 1.
    """

    name: str
    page: str
    kind: tuple[str, str]
    verdict: str
    words: str
    margin: str = ""
    picture: bytes | None = None
    counts: tuple[int, ...] = ()
    margin_length: float | None = None
    certainty: str = ""
    place: str = ""
    error: str = ""
    line: str = ""
    marked: tuple[int, int] = (0, 0)


def entry_of(result: Result, name: str, page: str, picture: bytes | None = None) -> Entry:
    """The entry of a result, whose page is at a path beside the index."""
    return Entry(
        name,
        page,
        kind_of(result),
        verdict_word(result),
        verdict_in_words(result).start,
        margin_in_short(result),
        picture,
        (
            result.under_constrained,
            result.over_constrained,
            result.degrees_of_freedom,
            int(result.given.arrays.element_number.size),
        ),
        result.margin.length,
        certainty_word(result),
    )


def broken_entry(error: Exception, name: str, page: str, file: str = "") -> Entry:
    """The entry of a deck that cannot be analysed: its first error, and where it is."""
    words = f"Cannot be analysed: {reason_in_words(error)}"
    told: dict[str, Any] = {}
    if isinstance(error, ProblemsError):
        told = _first_error(error, file_name(file) or name)
    return Entry(name, page, BROKEN, _BROKEN, words, **told)


def unread_entry(name: str) -> Entry:
    """The entry of a deck that could not be read."""
    return Entry(name, "", BROKEN, _BROKEN, "Cannot be read")


def _first_error(error: ProblemsError, file: str) -> dict[str, Any]:
    first = next((item for item in error.diagnostics if item.is_error), None)
    if first is None:
        return {}
    if not first.line:
        return {"error": harmless(first.message)}
    told = {"place": f"{file}:{first.line}:{first.column}", "error": harmless(first.message)}
    if error.source is None:
        return told
    whole = harmless(decode(error.source.line(first.line)), keep_tabs=True)
    start = max(0, min(first.column - 1 - _BEFORE, len(whole) - _LINE))
    ends = (first.column - start, max(first.last_column, first.column) - start)
    return {**told, "line": whole[start : start + _LINE], "marked": ends}
