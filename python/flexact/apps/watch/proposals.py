# SPDX-License-Identifier: BSD-3-Clause
"""What the advice proposes, as switches that do it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from ...analysis.advice_ways import Coordinate, Part, Step, Way, on_motions, on_self_stresses
from ...analysis.places import listed
from ...analysis.result import Result
from ...core.elements import Class
from .editable_model import Board
from .places import Edit, Place
from .refusal import RefusedError
from .words import place_in_words

#: How many proposals of one kind are shown.
_MOST, _MOST_SUPPORTS = 6, 3


class Choice(NamedTuple):
    """What is done with a part."""

    word: str
    """Such as "release"."""
    edits: tuple[Edit, ...]


class Proposal(NamedTuple):
    """A part, and what can be done with it."""

    words: str
    choices: tuple[Choice, ...]


class Proposals(NamedTuple):
    """Proposals of one kind."""

    head: str
    items: tuple[Proposal, ...]
    more: bool
    """Whether there are more of them."""


def proposals(board: Board, now: Result) -> tuple[Proposals, ...]:
    """What may be done about the motions and the self-stresses of the mechanism as it is now."""
    ways = (*on_motions(now), *on_self_stresses(now))
    if now.folds:
        # What else moves is told once the folds are declared.
        ways = (next(on_motions(now)), *on_self_stresses(now))
    if any(way.step is Step.DECLARE_INTERNAL for way in ways):
        # What else there is to do is seen once each divided part is one beam.
        ways = tuple(way for way in ways if way.step is Step.DECLARE_INTERNAL)
    made = (_proposals(board, now, way) for way in ways)
    return tuple(each for each in made if each.items)


def _proposals(board: Board, now: Result, way: Way) -> Proposals:
    together = way.step in (
        *(Step.DECLARE_INTERNAL, Step.DECLARE_FOLDS, Step.DECLARE_OR_HOLD_ALL, Step.RELEASE_ALL),
    )
    if together:
        items = _together(board, way)
    else:
        items = {}
        for part in way.parts:
            for each in _one(board, now, way.step, part):
                items.setdefault(each.words, each)
    most = _MOST_SUPPORTS if way.step is Step.FREE_SUPPORT else _MOST
    every = tuple(items.values())
    return Proposals(_head(now, way.step), every[:most], way.more or len(every) > most)


def _head(now: Result, step: Step) -> str:
    motions, stresses = now.under_constrained, now.over_constrained
    motion = "this motion" if motions == 1 else "one motion"
    stress = "the self-stress" if stresses == 1 else "one self-stress"
    return {
        Step.DECLARE_INTERNAL: "To count each divided sheet or wire as one beam",
        Step.DECLARE_FOLDS: "To declare the folds of folded sheets",
        Step.DECLARE_OR_HOLD: f"To settle {motion}, declare it or stop it",
        Step.DECLARE_OR_HOLD_RELEASED: f"To settle {motion} by a deformation",
        Step.DECLARE_OR_HOLD_ALL: "To settle all motions at once",
        Step.RELEASE: f"To remove {stress}, release one of",
        Step.UNDECLARE: f"To remove {stress}, take a declaration away",
        Step.FREE_SUPPORT: f"To remove {stress}, free a support",
        Step.RELEASE_ALL: "To remove all self-stresses at once",
    }[step]


def _one(board: Board, now: Result, step: Step, part: Part) -> Iterator[Proposal]:
    place = _place(board, now, part)
    if place is None:
        return
    words = place_in_words(board, place)
    is_coordinate = isinstance(part, Coordinate)
    if step in (Step.DECLARE_OR_HOLD, Step.DECLARE_OR_HOLD_RELEASED):
        stop = "fix" if is_coordinate else "hold"
        choices = [("declare", Class.INDEPENDENT), (stop, Class.FIXED)]
    else:
        choices = [("free" if is_coordinate else "release", Class.DEPENDENT)]
    yield Proposal(words, tuple(Choice(word, (Edit(place, to),)) for word, to in choices))


def _together(board: Board, way: Way) -> dict[str, Proposal]:
    """One proposal of all parts."""
    places = [place for part in way.parts for place in _every_place(board, part)]
    if way.step is Step.DECLARE_INTERNAL:
        count = len(way.parts)
        words = f"what is inside {count} beam{'s' * (count != 1)}"
    else:
        words = listed(list(dict.fromkeys(place_in_words(board, place) for place in places)))
    verbs = {
        Step.DECLARE_INTERNAL: [("declare", Class.INDEPENDENT)],
        Step.DECLARE_FOLDS: [("declare", Class.INDEPENDENT)],
        Step.DECLARE_OR_HOLD_ALL: [("declare", Class.INDEPENDENT), ("fix", Class.FIXED)],
        Step.RELEASE_ALL: [("release", Class.DEPENDENT)],
    }
    choices = [
        Choice(word, tuple(Edit(place, to) for place in places)) for word, to in verbs[way.step]
    ]
    return {words: Proposal(words, tuple(choices))} if places else {}


def _place(board: Board, now: Result, part: Part) -> Place | None:
    if isinstance(part, Coordinate):
        return board.coordinate(part.node, part.name)
    element, number = map(int, part.operands.split()[:2])
    index = board.given.element_index[element]
    whole = board.wholes.get(index)
    ends = () if whole is None else (whole.elements[0], whole.elements[-1])
    if whole is not None and index not in ends:
        # Inside of a flexure that is switched as one there is nothing to be switched.
        return None
    try:
        return board.deformation(element, number)
    except RefusedError:
        return None


def _every_place(board: Board, part: Part) -> Iterator[Place]:
    """A deck's operands may name several deformations of one element."""
    if isinstance(part, Coordinate):
        yield board.coordinate(part.node, part.name)
        return
    element, *numbers = map(int, part.operands.split())
    yield from (board.deformation(element, number) for number in numbers)
