# SPDX-License-Identifier: BSD-3-Clause
"""What mends a deck at a place: the help of a problem, and steps of the advice."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator
from itertools import islice, takewhile

from ...advice.advice import Advice
from ...advice.step import Step
from ...analysis.change import Change
from ...analysis.naming import plain
from ...model.editing import edited_deck
from ...util.text import harmless
from .deck import ELEMENT, NODE, Deck, Document, Edit, Key, Position, Range, keys_in, span, split
from .session import Problem

_MEANT = re.compile(r"^did you mean ([!-~]+)\?$")
_LONGEST_TITLE = 160
#: Lines old times lines new up to which both are compared line by line.
_MOST_COMPARED = 4_000_000


#: A step of the advice, or one of the choices that symmetry gives it: its title, and the numbers of
#: both, from 1.
Remedy = tuple[str, int, int]


def mends_of(deck: Deck, problem: Problem) -> Iterator[tuple[str, Edit]]:
    """Edits that do what the help of a problem says, each with its title."""
    at = problem.range.start
    line = deck.tokens[at.line]
    if (meant := _MEANT.match(problem.help)) is not None:
        yield f"write {meant[1]}", Edit(problem.range, meant[1])
    elif problem.code == "missing-end":
        start = Position(at.line, 0)
        yield "write END before it", Edit(Range(start, start), f"END{deck.document.ending}")
    elif problem.code == "bad-comment" and line.text[at.character : at.character + 1] == ";":
        yield "write % instead", Edit(Range.within(at.line, at.character, at.character + 1), "%")
    elif problem.code == "duplicate-element" and line.element is not None and line.number_of(1):
        free = str(deck.index.free(ELEMENT))
        yield f"number it {free}", Edit(span(line, 1), free)
    elif problem.code == "class-conflict":
        # Of two statements of a class, one keeps what both say; the other one's word goes.
        for range_ in dict.fromkeys((problem.range, *(one.range for one in problem.remarks))):
            line = deck.tokens[range_.start.line]
            words, place = line.words, line.word_at(range_.start.character)
            where = f"line {line.number + 1}"
            if place is None:
                continue
            if len(words) <= 3:
                # Without a component all would be meant: the whole statement goes.
                title = f"take {' '.join(word.text for word in words)} out, {where}"
                yield title, Edit(span(line, 0, -1), "")
            elif place > 1:
                gap = Range.within(line.number, words[place - 1].behind, words[place].behind)
                yield f"take {words[place].text} out of {line.name} in {where}", Edit(gap, "")


def remedies_at(deck: Deck, advice: Advice, first: int, last: int) -> list[Remedy]:
    """Steps that are about what stands in some lines; all of them in the first line."""
    keys = {
        key
        for line in range(max(first, 0), min(last + 1, len(deck.document.bare)))
        for key, _ in islice(keys_in(deck.tokens[line]), 1)
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
    alike = harmless(plain(step.pieces)).partition("; or instead")[0].rstrip(".")
    if choice > 1:
        named = ", ".join([f"{kind} {number}" for kind, number in sorted(_touched(change))][:4])
        alike = f"{alike}: likewise at {named}"
    outcome = step.outcome
    room = _LONGEST_TITLE - len(outcome) - 2
    if len(alike) > room:
        alike = f"{alike[: room - 3]}..."
    return f"{alike}: {outcome}", step.number, choice


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
    # What both have at the start, and at the end of what is left of the shorter one.
    head = _alike(old, new)
    tail = _alike(old[head:][::-1], new[head:][::-1])
    mine, its = old[head : len(old) - tail], new[head : len(new) - tail]
    if len(mine) * len(its) > _MOST_COMPARED:
        return [_edit(document, head, len(old) - tail, its)]
    matcher = difflib.SequenceMatcher(None, mine, its, autojunk=False)
    return [
        _edit(document, head + i, head + j, its[k:m])
        for tag, i, j, k, m in matcher.get_opcodes()
        if tag != "equal"
    ]


def _alike(one: list[str], other: list[str]) -> int:
    """How many lines are the same from the start on."""
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(one, other, strict=False)))


def _edit(document: Document, first: int, behind: int, new: list[str]) -> Edit:
    """Lines in the place of others, `behind` being the first that stays."""
    ending, bare = document.ending, document.bare
    start, end = Position(first, 0), Position(behind, 0)
    text = "".join(line + ending for line in new)
    is_last = behind == len(bare)
    if is_last or first < behind == first + len(new):
        end, text = Position(behind - 1, len(bare[behind - 1])), ending.join(new)
    if is_last and first:
        start, text = (
            Position(first - 1, len(bare[first - 1])),
            "".join(ending + one for one in new),
        )
    return Edit(Range(start, end), text)
