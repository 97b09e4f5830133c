# SPDX-License-Identifier: BSD-3-Clause
"""What `flexact check` says of a deck, at the places of an editor."""

from __future__ import annotations

import re
from typing import NamedTuple

from ...deck.diagnostics import Diagnostic, Place, Severity
from ...util.plain_text import harmless
from .document import Document, Position, Range
from .editor_deck import Deck

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
    if item.line < 1:
        range_ = first_line(document)
    else:
        range_ = _range(document, Place(item.line, item.column, item.last_column))
    remarks = []
    if item.label:
        remarks.append(Remark(range_, harmless(item.label)))
    if item.other is not None:
        is_before = item.other < (item.line, item.column)
        other = "first here" if is_before else "and here"
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
