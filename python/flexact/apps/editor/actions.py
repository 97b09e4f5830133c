# SPDX-License-Identifier: BSD-3-Clause
"""What mends a deck at a place: the help of a problem, and steps of the advice."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator
from typing import NamedTuple

from ...analysis.change import Change
from ...analysis.sentences import plain
from ...model.editing import edited_deck
from ...util.plain_text import harmless
from .advisor import Advice, Step
from .deck import ELEMENT, NODE, Key
from .document import Document, Edit, Position, Range, split
from .editor_deck import Deck
from .editor_problems import Problem

_MEANT = re.compile(r"^did you mean ([!-~]+)\?$")
_LONGEST_TITLE = 160
#: Lines old times lines new up to which both are compared line by line.
_MOST_COMPARED = 4_000_000


class Mend(NamedTuple):
    """An edit that mends a problem."""

    title: str
    edits: tuple[Edit, ...]


class Remedy(NamedTuple):
    """A step of the advice, or one of the choices that symmetry gives it."""

    title: str
    step: int
    """From 1."""
    choice: int
    """From 1."""
    makes_exact: bool


def mends_of(deck: Deck, problem: Problem) -> list[Mend]:
    """Edits that do what the help of a problem says."""
    meant = _MEANT.match(problem.help)
    if meant is not None:
        return [Mend(f"write {meant[1]}", (Edit(problem.range, meant[1]),))]
    at = problem.range.start
    if problem.code == "missing-end":
        start = Position(at.line, 0)
        ending = deck.document.ending
        return [Mend("write END before it", (Edit(Range(start, start), f"END{ending}"),))]
    if problem.code == "bad-comment":
        text = deck.document.bare[at.line]
        if text[at.character : at.character + 1] == ";":
            here = Range.within(at.line, at.character, at.character + 1)
            return [Mend("write % instead", (Edit(here, "%"),))]
    if problem.code == "duplicate-element" and deck.document.bare[at.line].strip():
        free = str(deck.index.free(ELEMENT))
        says = deck.statements.at(at.line).says
        if says.element is not None and says.number(1) is not None:
            return [Mend(f"number it {free}", (Edit(deck.statements.at(at.line).span(1), free),))]
    if problem.code == "class-conflict":
        places = [problem.range, *(one.range for one in problem.remarks)]
        return list(_without_one(deck, dict.fromkeys(places)))
    return []


def _without_one(deck: Deck, places: dict[Range, None]) -> Iterator[Mend]:
    """Of two statements of a class, one keeps what both say; the other one's word goes."""
    for range_ in places:
        line = range_.start.line
        statement = deck.statements.at(line)
        says = statement.says
        place = says.word_at(range_.start.character)
        if place is None or not says.words:
            continue
        if place > 1 and len(says.words) > 3:
            start = says.words[place - 1].last
            edit = Edit(Range.within(line, start, says.words[place].last), "")
            title = f"take {says.words[place].text} out of {says.name} in line {line + 1}"
        elif len(says.words) <= 3:
            # Without a component all would be meant: the whole statement goes.
            edit = Edit(Range.within(line, says.words[0].first, says.words[-1].last), "")
            title = f"take {' '.join(word.text for word in says.words)} out, line {line + 1}"
        else:
            continue
        yield Mend(title, (edit,))


def remedies_at(deck: Deck, advice: Advice, first: int, last: int) -> list[Remedy]:
    """Steps that are about what stands in some lines; all of them in the first line."""
    keys = {
        (one.kind, one.number)
        for line in range(max(first, 0), min(last + 1, len(deck.document.bare)))
        for one in deck.statements.at(line).says.facts.references[:1]
    }
    made = []
    for step in advice.steps:
        for choice, change in enumerate((step.change, *step.alternatives), start=1):
            if (first == 0 and choice == 1) or keys & _touched(change):
                made.append(_remedy(step, choice, change))
    return made


def _touched(change: Change) -> set[Key]:
    """The elements and nodes that a change is about."""
    elements = [one[0] for one in change.deformations] + [one[0] for one in change.vectors]
    nodes = [one[0] for one in change.coordinates] + [one[0] for one in change.places]
    return {*((ELEMENT, number) for number in elements), *((NODE, number) for number in nodes)}


def _remedy(step: Step, choice: int, change: Change) -> Remedy:
    words = harmless(plain(step.pieces))
    alike = words.partition("; likewise")[0].rstrip(".")
    if choice > 1:
        named = ", ".join([f"{kind} {number}" for kind, number in sorted(_touched(change))][:4])
        alike = f"{alike}: likewise at {named}"
    outcome = step.outcome
    room = _LONGEST_TITLE - len(outcome) - 2
    if len(alike) > room:
        alike = f"{alike[: room - 3]}..."
    return Remedy(f"{alike}: {outcome}", step.number, choice, outcome == "exactly constrained")


def edits_of(deck: Deck, advice: Advice, step: int, choice: int) -> list[Edit]:
    """What a step changes in the deck; all else stays to the letter.

    Raises:
        ModelError: there is no such step or choice.
        IndexError: likewise.
    """
    given = advice.analysis.given
    changed = advice.steps[step - 1].apply(choice)
    return edits_between(deck.document, edited_deck(given, changed.data).decode("utf-8"))


def edits_between(document: Document, text: str) -> list[Edit]:
    """What makes a document the same as a text, line by line; its line ends stay."""
    old = document.bare
    new = [line.rstrip("\r\n") for line in split(text.removeprefix("\ufeff"))]
    if document.text.startswith("\ufeff"):
        new[0] = " " + new[0]
    head = 0
    while head < min(len(old), len(new)) and old[head] == new[head]:
        head += 1
    tail = 0
    while tail < min(len(old), len(new)) - head and old[-1 - tail] == new[-1 - tail]:
        tail += 1
    mine, its = old[head : len(old) - tail], new[head : len(new) - tail]
    if len(mine) * len(its) > _MOST_COMPARED:
        return [_edit(document, head, len(old) - tail, its)]
    matcher = difflib.SequenceMatcher(None, mine, its, autojunk=False)
    return [
        _edit(document, head + i, head + j, its[k:m])
        for tag, i, j, k, m in matcher.get_opcodes()
        if tag != "equal"
    ]


def _edit(document: Document, first: int, behind: int, new: list[str]) -> Edit:
    """Lines in the place of others, `behind` being the first that stays."""
    ending = document.ending
    end_of = [len(line) for line in document.bare]
    if behind < len(end_of) and first < behind == first + len(new):
        last = behind - 1
        return Edit(Range(Position(first, 0), Position(last, end_of[last])), ending.join(new))
    if behind < len(end_of):
        text = "".join(line + ending for line in new)
        return Edit(Range(Position(first, 0), Position(behind, 0)), text)
    end = Position(len(end_of) - 1, end_of[-1])
    if first == 0:
        return Edit(Range(Position(0, 0), end), ending.join(new))
    start = Position(first - 1, end_of[first - 1])
    return Edit(Range(start, end), "".join(ending + line for line in new))
