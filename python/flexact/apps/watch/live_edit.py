# SPDX-License-Identifier: BSD-3-Clause
"""A session of clicking: what was switched in a watched mechanism, and what is asked of it."""

from __future__ import annotations

import difflib
import json
import os
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from http import HTTPStatus
from itertools import zip_longest
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ...analysis.calls import MOST_TRIED, Call, coordinate_call, deformation_call, made, named_part
from ...analysis.deformation_words import bending_of, deformation_words, part_of, role_of
from ...analysis.places import (
    end_words,
    listed,
    node_words,
    part_words,
    place_words,
    point_words,
    stands_for,
    with_article,
)
from ...analysis.result import Result
from ...analysis.verdict_words import margin_in_short, verdict_in_short
from ...analysis.ways import Coordinate, Step, Way, on_motions, on_self_stresses
from ...analysis.ways import Part as WayPart
from ...core.elements import Class, NodeKind, Role, coordinate_name, element_kinds, keywords_of
from ...deck.diagnostics import decode
from ...model.data import ModelData
from ...model.deformations import AT_P
from ...model.editing import edited_to_the_letter
from ...model.names import nearest
from ...model.parts.parts import Part, PartKind, Parts
from ...model.reading import read_bytes
from ...model.writing import deck_of, statements_of
from ...util.decks import SUFFIX
from ...util.outputs import OutputError, write_together
from ...util.records import cached_property
from ...util.text import harmless, in_short
from .editable_model import (
    Board,
    CoordinatePlace,
    DeformationPlace,
    Edit,
    Edits,
    Place,
    RefusedError,
    state_word,
    states_of,
)


def place_in_words(board: Board, place: Place) -> str:
    """Such as "sheet 1: in-plane bending at its clamp" or "the clamp of sheet 1 along y"."""
    if isinstance(place, CoordinatePlace):
        where = node_title(board, board.given.node_index[place.node])
        return f"{where} {way_in_words(place.name)}"
    where = element_title(board, board.given.element_index[place.element])
    return f"{where}: {deformation_in_words(board, place)}"


def edit_in_words(board: Board, edit: Edit) -> str:
    """Such as "sheet 1: in-plane bending at its clamp, held, is released"."""
    before = state_word(edit.place, board.before(edit.place))
    after = state_word(edit.place, edit.to)
    words = place_in_words(board, edit.place)
    return f"{words}: {before} \N{RIGHTWARDS ARROW} {after}"


def deformation_in_words(board: Board, place: DeformationPlace) -> str:
    """Such as "in-plane bending at its clamp"."""
    given = board.given.element_index[place.element]
    outcome = board.base if given in board.wholes else board.plain
    index = outcome.data.element_index[place.element]
    words = deformation_words(outcome, index, place.number)
    part = board.parts.of_element(given)
    bending = bending_of(outcome, index, place.number)
    if bending is None or given in board.wholes or len(part.elements) == 1:
        return words
    # Of one beam of several the ends are not those of the part.
    point = board.parts.name_of_point(bending.position)
    return f"{words.partition(' at ')[0]} at {point or point_words(board.parts, bending.position)}"


def way_in_words(name: str) -> str:
    """A coordinate: "along y" or "about z"."""
    return f"about {name[1:]}" if name.startswith("r") else f"along {name}"


def element_title(board: Board, index: int) -> str:
    """The part of an element, and which of its elements it is where that matters."""
    part = board.parts.of_element(index)
    words = part_words(part)
    if index in board.wholes or len(part.elements) == 1:
        return words
    if part.kind is PartKind.BODY:
        return f"{words}, {element_words(board, index)}"
    return f"{words}, beam {part.elements.index(index) + 1} of {len(part.elements)}"


def element_words(board: Board, index: int) -> str:
    """An element as a deck has it, such as "BEAM 3"."""
    arrays = board.given.arrays
    (keyword,) = keywords_of(arrays.element_kind[[index]])
    return f"{keyword} {arrays.element_number[index]}"


def elements_words(board: Board, part: Part) -> str:
    """All elements of a part as a deck has them."""
    words = [element_words(board, index) for index in part.elements]
    return ", ".join(
        words if len(words) <= 4 else [*words[:2], "\N{HORIZONTAL ELLIPSIS}", words[-1]]
    )


def node_title(board: Board, index: int) -> str:
    """What a node is called: a point of a body by its part, a turn by what turns."""
    if board.given.arrays.node_kind[index] <= NodeKind.POSITION:
        name, body = board.parts.name_of_point(index), board.parts.body_at.get(index)
        if name and (body is None or not stands_for(board.parts, index, body)):
            return with_article(name)
        return node_words(board.parts, index) if name else end_words(board.parts, index)
    return node_words(board.parts, index)


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


def _one(board: Board, now: Result, step: Step, part: WayPart) -> Iterator[Proposal]:
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


def _place(board: Board, now: Result, part: WayPart) -> Place | None:
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


def _every_place(board: Board, part: WayPart) -> Iterator[Place]:
    """A deck's operands may name several deformations of one element."""
    if isinstance(part, Coordinate):
        yield board.coordinate(part.node, part.name)
        return
    element, *numbers = map(int, part.operands.split())
    yield from (board.deformation(element, number) for number in numbers)


#: How many neighbours of a part are named, and how many points of a body can be switched.
_MOST_NEAR, _MOST_POINTS = 10, 3
#: How many names are offered.
MOST_NAMES = 400

Json = dict[str, Any]


def panel_of_element(board: Board, edits: Edits, element: int, wanted: Collection[Edit]) -> Json:
    """What is offered of the part of an element, by its number.

    Args:
        board: The mechanism as given.
        edits: What was switched.
        element: Number of the element.
        wanted: What the advice proposes.

    Raises:
        RefusedError: There is no such element.
    """
    index = board.given.element_index.get(element)
    if index is None:
        raise RefusedError(f"there is no element {element}")
    part = board.parts.of_element(index)
    is_whole = index in board.wholes
    count = element_kinds()[int(board.given.arrays.element_kind[index]) - 1].deformations
    places = [board.deformation(element, number) for number in range(1, count + 1)]
    rows = [
        _row(board, edits, wanted, place, deformation_in_words(board, place)) for place in places
    ]
    own = "" if is_whole or len(part.elements) == 1 else f" of {element_words(board, index)}"
    groups = [_group(f"Deformations{own}", rows)]
    if part.kind is PartKind.BODY:
        groups = [*_of_body(board, edits, wanted, part), *groups]
    about = elements_words(board, part)
    return {
        "element": places[0].element if is_whole else element,
        "title": _capital(element_title(board, index)),
        "kind": part.kind.value,
        "about": about,
        "groups": groups,
        "near": list(_near_part(board, part, index)),
    }


def panel_of_node(board: Board, edits: Edits, node: int, wanted: Collection[Edit]) -> Json:
    """What is offered of a point, by the number of one of its nodes; else as of an element."""
    index = board.given.node_index.get(node)
    if index is None:
        raise RefusedError(f"there is no node {node}")
    position = board.parts.place_of(index)
    index = index if position is None else position
    groups = list(_of_point(board, edits, wanted, index))
    parts = () if position is None else board.parts.at(position)
    numbers = [str(number) for number in _numbers(board, index)]
    return {
        "node": int(board.given.arrays.node_number[index]),
        "title": _capital(node_title(board, index)),
        "kind": "point",
        "about": f"node{'s' * (len(numbers) > 1)} {', '.join(numbers)}",
        "groups": groups,
        "near": [
            {"words": part_words(part), "element": part.number} for part in parts[:_MOST_NEAR]
        ],
    }


def names(board: Board) -> list[Json]:
    """What can be looked at, by its name: the parts, then the supports; of many the first."""
    made: dict[str, Json] = {}
    for part in board.parts.all[:MOST_NAMES]:
        made.setdefault(part_words(part), {"words": part_words(part), "element": part.number})
    for words, node in _supports(board):
        if len(made) >= MOST_NAMES:
            break
        made.setdefault(words, {"words": words, "node": node})
    return list(made.values())


def target_named(board: Board, name: str) -> Json:
    """The part or the point of a name, or "node 3" or "element 5".

    Raises:
        RefusedError: There is none; the nearest names are told.
    """
    kind, _, number = name.strip().lower().partition(" ")
    if kind in ("node", "element") and number.isdecimal() and len(number) < 10:
        return {kind: int(number)}
    for part in board.parts.all:
        if name in (part.name, part_words(part)):
            return {"element": part.number}
    numbers = board.given.arrays.node_number
    for words, node in _supports(board):
        if words == name:
            return {"node": node}
    for index, own in enumerate(board.given.node_names):
        if own and own.strip() == name.strip():
            return {"node": int(numbers[index])}
    known = [each["words"] for each in names(board)]
    near = [
        f"\N{LEFT DOUBLE QUOTATION MARK}{n}\N{RIGHT DOUBLE QUOTATION MARK}"
        for n in nearest(name, known)
    ]
    hint = f"; did you mean {' or '.join(near)}?" if near else ""
    raise RefusedError(f"no part or support is called {in_short(name)}{hint}")


def _supports(board: Board) -> Iterator[tuple[str, int]]:
    """Points of which something is fixed or declared: words and number of a node."""
    classes = board.given.arrays.coordinate_class
    stated = (classes == Class.FIXED) | (classes == Class.INDEPENDENT)
    seen = set()
    for node in np.flatnonzero(stated.any(axis=0)).tolist():
        position = board.parts.place_of(node)
        index = node if position is None else position
        if index not in seen:
            seen.add(index)
            yield node_title(board, index), int(board.given.arrays.node_number[index])


def _row(board: Board, edits: Edits, wanted: Collection[Edit], place: Place, words: str) -> Json:
    before, now = board.before(place), board.now(place, edits)
    proposed = [
        word for word, to in states_of(place).items() if to != now and Edit(place, to) in wanted
    ]
    return {
        "place": place_json(place),
        "words": words,
        "states": list(states_of(place)),
        "now": state_word(place, now),
        "before": state_word(place, before),
        "proposed": proposed,
    }


def place_json(place: Place) -> Json:
    """A place as requests name it."""
    if isinstance(place, DeformationPlace):
        return {"element": place.element, "deformation": place.number}
    return {"node": place.node, "coordinate": place.name}


def _group(title: str, rows: list[Json]) -> Json:
    return {"title": title, "rows": rows}


def _of_point(
    board: Board, edits: Edits, wanted: Collection[Edit], index: int, title: str = ""
) -> Iterator[Json]:
    """Switches of a position and of what turns there, or of a node that stands nowhere."""
    turned = [node for node in _nodes_at(board, index) if node != index]
    is_position = board.given.arrays.node_kind[index] <= NodeKind.POSITION
    first = [index, *turned] if len(turned) == 1 and is_position else [index]
    yield _group(title or "Coordinates", list(_coordinates(board, edits, wanted, first)))
    for node in turned if len(turned) > 1 else ():
        rows = list(_coordinates(board, edits, wanted, [node]))
        yield _group(f"{_capital(node_words(board.parts, node))} turns", rows)


def _coordinates(
    board: Board, edits: Edits, wanted: Collection[Edit], nodes: Iterable[int]
) -> Iterator[Json]:
    for node in nodes:
        number = int(board.given.arrays.node_number[node])
        for name in board.coordinates_of(node):
            place = CoordinatePlace(number, name)
            yield _row(board, edits, wanted, place, way_in_words(name))


def _of_body(board: Board, edits: Edits, wanted: Collection[Edit], part: Part) -> Iterator[Json]:
    """Coordinates of a body at the points where one is declared, else at its first point."""
    slots = (board.given.arrays.element_node[:, list(part.elements)] - 1).T
    points = list(dict.fromkeys(int(n) for row in slots for n in (row[0], row[2]) if n >= 0))
    classes = board.given.arrays.coordinate_class
    stated = [
        point
        for point in points
        if any(
            (classes[:, node] == Class.INDEPENDENT).any() or (classes[:, node] == Class.FIXED).any()
            for node in _nodes_at(board, point)
        )
    ]
    for point in (stated or points[:1])[:_MOST_POINTS]:
        words = node_title(board, point)
        yield from _of_point(board, edits, wanted, point, f"Coordinates of {words}")


def _nodes_at(board: Board, position: int) -> list[int]:
    """A position node and the orientation nodes that stand there, by their indices."""
    return [position, *_turns(board).get(position, [])]


def _turns(board: Board) -> dict[int, list[int]]:
    made: dict[int, list[int]] = {}
    for turned, position in sorted(board.parts.position_of.items()):
        made.setdefault(position, []).append(turned)
    return made


def _numbers(board: Board, index: int) -> list[int]:
    return [int(board.given.arrays.node_number[node]) for node in _nodes_at(board, index)]


def _near_part(board: Board, part: Part, index: int) -> Iterator[Json]:
    """Ends of a part, and the other elements of one that is not switched as one."""
    numbers = board.given.arrays.node_number
    if part.kind is PartKind.BODY:
        slots = board.given.arrays.element_node[[0, 2]][:, list(part.elements)].T - 1
        points = list(dict.fromkeys(int(n) for n in slots.ravel() if n >= 0))
        for point in points[:_MOST_NEAR]:
            yield {"words": node_title(board, point), "node": int(numbers[point])}
    elif part.kind is PartKind.HINGE:
        for node in board.given.arrays.element_node[[1, 3], index] - 1:
            if node >= 0:
                yield {"words": node_words(board.parts, int(node)), "node": int(numbers[node])}
    else:
        for end in part.ends:
            yield {"words": place_words(board.parts, end, part), "node": int(numbers[end])}
    if index in board.wholes:
        return
    others = [each for each in part.elements if each != index]
    for other in others[:_MOST_NEAR]:
        number = int(board.given.arrays.element_number[other])
        yield {"words": element_title(board, other), "element": number}


def _capital(words: str) -> str:
    """Words as a heading; names stay as they are."""
    return words[:1].upper() + words[1:] if words.startswith(("the ", "a ", "an ")) else words


#: How many steps can be undone.
_HISTORY_MOST = 200


class History:
    """The states of the edits, and which of them holds."""

    def __init__(self) -> None:
        """Without any edit."""
        self._states: list[Edits] = [()]
        self._at = 0

    def copy(self) -> History:
        """The same again, to go back to."""
        made = History()
        made._states, made._at = self._states, self._at
        return made

    @property
    def now(self) -> Edits:
        """The edits that hold."""
        return self._states[self._at]

    @property
    def can_undo(self) -> bool:
        """Whether there is a state before."""
        return self._at > 0

    @property
    def can_redo(self) -> bool:
        """Whether there is a state behind."""
        return self._at + 1 < len(self._states)

    def take(self, edits: Edits) -> None:
        """Take a new state; what was undone is gone."""
        if edits == self.now:
            return
        self._states = [*self._states[: self._at + 1], edits][-_HISTORY_MOST - 1 :]
        self._at = len(self._states) - 1

    def undo(self) -> None:
        """Go back to the state before, if there is one."""
        self._at = max(self._at - 1, 0)

    def redo(self) -> None:
        """Take the state that was undone, if there is one."""
        self._at = min(self._at + 1, len(self._states) - 1)

    def renewed(self, change: Callable[[Edits], Edits]) -> None:
        """Change every state; neighbours that are the same then are one."""
        states: list[Edits] = []
        at = 0
        for k, state in enumerate(map(change, self._states)):
            if not states or state != states[-1]:
                states.append(state)
            if k == self._at:
                at = len(states) - 1
        self._states, self._at = states, at


_SAVING_MOST = 200
#: What no name of a file holds, here or elsewhere.
_NONE = "/\\:"
_EDITED = re.compile(r"_edited(?:_\d+)?$")


def write_deck(watched: Path, name: str, text: bytes, *, over: bool = False) -> Path:
    """Write a deck to a file in the folder of the watched file, whole or not at all.

    Args:
        watched: The file that is watched.
        name: Name of the new file; where it has no suffix, .dat is added.
        text: The deck.
        over: Whether a file of this name may be written over; never the watched one.

    Returns:
        The file.

    Raises:
        RefusedError: There can be no file of this name there, it cannot be written, or (status
            409) there is one already.
    """
    target = watched.parent / _checked(name)
    folder = os.path.realpath(watched.parent)
    if os.path.dirname(os.path.realpath(target)) != folder:
        raise RefusedError(
            f"{target.name} is a link that leads out of the folder: take another name"
        )
    if _is_same(target, watched):
        raise RefusedError(f"{target.name} is the file that is watched: take another name")
    if target.is_dir():
        raise RefusedError(f"{target.name} is a folder: take another name")
    if os.path.lexists(target) and not over:
        raise RefusedError(f"there is a file {target.name} already", HTTPStatus.CONFLICT)
    try:
        write_together({target: text})
    except OutputError as error:
        raise RefusedError(harmless(str(error)), HTTPStatus.INTERNAL_SERVER_ERROR) from None
    return target


def free_name(watched: Path) -> str:
    """A name for the new deck that no file in the folder has, and that `write_deck` takes."""
    stem = "".join("_" if c in _NONE or not c.isprintable() else c for c in watched.stem)
    stem = _EDITED.sub("", stem.strip(". ")) or "deck"
    while len(os.fsencode(stem)) > _SAVING_MOST - len(f"_edited_999{SUFFIX}"):
        stem = stem[:-1]
    for k in range(1, 1000):
        name = f"{stem}_edited{f'_{k}' * (k > 1)}{SUFFIX}"
        if not os.path.lexists(watched.parent / name):
            return name
    return f"{stem}_edited{SUFFIX}"


def _checked(name: str) -> str:
    """The name of a file, and nothing else."""
    name = name.strip()
    if not name or name.strip(". ") == "":
        raise RefusedError("the new deck needs a name")
    if any(c in name for c in _NONE) or name.startswith(".") or not name.isprintable():
        raise RefusedError(
            "the new deck is written to the folder of the watched file: give the name of a file, "
            "without a folder"
        )
    if not Path(name).suffix:
        name += SUFFIX
    if Path(name).suffix.lower() != SUFFIX:
        raise RefusedError(f"the name of a deck ends with {SUFFIX}")
    if len(os.fsencode(name)) > _SAVING_MOST:
        raise RefusedError("that name is too long")
    return name


def _is_same(target: Path, watched: Path) -> bool:
    try:
        return os.path.samefile(target, watched)
    except OSError:
        return os.path.realpath(target) == os.path.realpath(watched)


Identity = tuple[object, ...]


class Renewal:
    """From places of a mechanism to those of the one that has taken its place."""

    def __init__(self, old: Board, new: Board) -> None:
        """Keep both."""
        self.old, self.new = old, new
        self._from, self._to = _Known(old.parts), _Known(new.parts)
        self._found: dict[Place, Place | None] = {}

    def edits(self, given: Edits) -> Edits:
        """The edits in the new mechanism, without those whose element or node is gone.

        What the new mechanism says itself is no edit any more.
        """
        found = [Edit(place, each.to) for each in given if (place := self.place(each.place))]
        return self.new.edited((), found)

    def place(self, place: Place) -> Place | None:
        """Where a place is now; None where it is gone."""
        if place not in self._found:
            try:
                self._found[place] = self._place(place)
            except RefusedError:
                self._found[place] = None
        return self._found[place]

    def _place(self, place: Place) -> Place | None:
        if isinstance(place, DeformationPlace):
            element = self._element(place.element)
            return None if element is None else self.new.deformation(element, place.number)
        node = self._node(place.node)
        return None if node is None else self.new.coordinate(node, place.name)

    def _element(self, number: int) -> int | None:
        """An element by its name; else by its number or its nodes."""
        old, new = self.old.given, self.new.given
        index = old.element_index[number]
        same = new.element_index.get(number)
        kind = int(old.arrays.element_kind[index])
        if same is not None and int(new.arrays.element_kind[same]) != kind:
            same = None
        name = old.element_names[index]
        if name:
            return self._named(name, old.element_names, new.element_names, index, same)
        here = self._from.ends(index)
        if same is not None and self._to.ends(same) == here:
            return number
        moved = self._to.elements_between.get((kind, here), [])
        if len(moved) == 1:
            return int(new.arrays.element_number[moved[0]])
        # In a deck a number says which it is; in a program it is counted, and may be another's.
        is_same_model = old.arrays.element_number.size == new.arrays.element_number.size
        stays = same is not None and not new.element_names[same]
        return number if stays and (new.source is not None or is_same_model) else None

    def _named(
        self,
        name: str,
        before: Sequence[str],
        after: Sequence[str],
        index: int,
        same: int | None,
    ) -> int | None:
        numbers = self.new.given.arrays.element_number
        mine = [i for i, each in enumerate(after) if each == name]
        if same in mine:
            return int(numbers[same])
        others = [i for i, each in enumerate(before) if each == name]
        if mine:
            place = others.index(index)
            return int(numbers[mine[place]]) if len(mine) == len(others) else None
        # It may have another name now.
        is_there = same is not None and self._to.ends(same) == self._from.ends(index)
        return int(numbers[same]) if is_there else None

    def _node(self, number: int) -> int | None:
        """A node by the name of its point, else by its place, else by what meets there."""
        old, new = self.old.given, self.new.given
        index = old.node_index[number]
        same = new.node_index.get(number)
        kind = int(old.arrays.node_kind[index])
        if same is not None and int(new.arrays.node_kind[same]) != kind:
            same = None
        name = self._from.name(index)
        found = self._to.points_named.get((kind, name), []) if name else []
        here = self._from.place(index)
        if not found:
            found = self._to.nodes_at.get((kind, here), []) if here else []
        if same is not None and (same in found or (not here and not name)):
            return number
        if len(found) == 1:
            return int(new.arrays.node_number[found[0]])
        if same is not None and self._to.meeting(same) == self._from.meeting(index):
            return number
        return None


class _Known:
    """What elements and nodes are known by."""

    def __init__(self, parts: Parts) -> None:
        self.parts, self.data = parts, parts.data

    def name(self, node: int) -> str:
        position = self.parts.place_of(node)
        return "" if position is None else self.parts.name_of_point(position)

    def place(self, node: int) -> Identity:
        """Where a node is; nothing where it stands nowhere."""
        position = self.parts.place_of(node)
        return () if position is None else self._at(position)

    def ends(self, element: int) -> Identity:
        """Where the nodes of an element are."""
        slots = (self.data.arrays.element_node[:, element] - 1).tolist()
        return tuple(self.place(node) if node >= 0 else None for node in slots)

    def meeting(self, node: int) -> frozenset[str]:
        """Names of the parts that meet at a node."""
        position = self.parts.place_of(node)
        here = self.parts.turning(node) if position is None else self.parts.at(position)
        return frozenset(part.name for part in here)

    @cached_property
    def elements_between(self) -> dict[Identity, list[int]]:
        """Indices of elements by their kind and ends."""
        kinds = self.data.arrays.element_kind.tolist()
        return _grouped(((kind, self.ends(i)), i) for i, kind in enumerate(kinds))

    @cached_property
    def nodes_at(self) -> dict[Identity, list[int]]:
        """Indices of nodes by their kind and place."""
        kinds = self.data.arrays.node_kind.tolist()
        return _grouped(((kind, self.place(i)), i) for i, kind in enumerate(kinds))

    @cached_property
    def points_named(self) -> dict[Identity, list[int]]:
        """Indices of nodes by their kind and the name of their point."""
        kinds = self.data.arrays.node_kind.tolist()
        return _grouped(((kind, name), i) for i, kind in enumerate(kinds) if (name := self.name(i)))

    def _at(self, position: int) -> Identity:
        count = 2 if self.data.arrays.node_kind[position] == NodeKind.PLANAR_POSITION else 3
        value = np.asarray(self.data.arrays.node_value[:count, position]) + 0.0
        return tuple(value.tolist())


def _grouped(items: Iterable[tuple[Identity, int]]) -> dict[Identity, list[int]]:
    made: dict[Identity, list[int]] = {}
    for key, value in items:
        made.setdefault(key, []).append(value)
    return made


_BENDINGS = {
    **dict.fromkeys((Role.BENDING_XZ_P, Role.BENDING_XZ_Q), "bending about y"),
    **dict.fromkeys((Role.BENDING_XY_P, Role.BENDING_XY_Q), "bending about z"),
}


class Calls:
    """The calls that make edits; those of the edits before are remembered."""

    def __init__(self, board: Board) -> None:
        """Of one mechanism."""
        self.board = board
        self._known: dict[Edits, tuple[Call, ...]] = {(): ()}

    def of(self, edits: Edits) -> tuple[Call, ...]:
        """The calls in order; each was tried on the model, and gives what its edit gives.

        Of a large model the calls are by numbers, and need no trial.
        """
        if edits not in self._known:
            before = self.of(edits[:-1])
            self._known[edits] = (*before, *self._calls(edits))
        return self._known[edits]

    def _calls(self, edits: Edits) -> Sequence[Call]:
        given, wanted = self.board.model(edits[:-1]), self.board.model(edits)
        if given.arrays.element_number.size <= MOST_TRIED:
            for calls in _in_words(self.board, edits[-1]):
                if _same(made(given, calls), wanted):
                    return calls
        return list(_by_numbers(given, wanted))


def _same(a: ModelData | None, b: ModelData) -> bool:
    return (
        a is not None
        and np.array_equal(a.arrays.deformation_class, b.arrays.deformation_class)
        and np.array_equal(a.arrays.coordinate_class, b.arrays.coordinate_class)
    )


def _in_words(board: Board, edit: Edit) -> Iterator[list[Call]]:
    """Ways to say an edit, the plainest first."""
    place, before = edit.place, board.before(edit.place)
    if isinstance(place, CoordinatePlace):
        calls = [
            coordinate_call(board.base, method, place.node, place.name)
            for method in _of_coordinate(before, edit.to)
        ]
        yield calls
        return
    methods = _of_deformation(before, edit.to)
    first = [_worded(board, place, method) for method in methods]
    yield [call for call in first if call is not None]
    is_at_p = _role(board, place) in AT_P
    ended = [call._replace(at="p" if is_at_p else "q") for call in first if call and call.at]
    if ended:
        yield ended


def _worded(board: Board, place: DeformationPlace, method: str) -> Call | None:
    outcome = (
        board.base if board.given.element_index[place.element] in board.wholes else (board.plain)
    )
    call = deformation_call(outcome, method, *place)
    if call is not None:
        return call
    word = _BENDINGS.get(Role(_role(board, place)))
    index = outcome.data.element_index[place.element]
    part = named_part(
        outcome.parts, part_of(outcome, index), int(outcome.condensed.elements[index])
    )
    at = "p" if _role(board, place) in AT_P else "q"
    return None if word is None else Call(method, (part, word), at)


def _role(board: Board, place: DeformationPlace) -> int:
    return role_of(board.plain, board.given.element_index[place.element], place.number)


def _by_numbers(given: ModelData, wanted: ModelData) -> Iterator[Call]:
    """Calls by the numbers of elements and nodes, which mean the same in every model."""
    before, after = given.arrays.deformation_class, wanted.arrays.deformation_class
    for number, index in np.argwhere(before != after).tolist():
        element = int(given.arrays.element_number[index])
        classes = Class(int(before[number, index])), Class(int(after[number, index]))
        for method in _of_deformation(*classes):
            yield Call(method, (element, number + 1))
    before, after = given.arrays.coordinate_class, wanted.arrays.coordinate_class
    for axis, index in np.argwhere(before != after).tolist():
        node = int(given.arrays.node_number[index])
        name = coordinate_name(int(given.arrays.node_kind[index]), axis)
        classes = Class(int(before[axis, index])), Class(int(after[axis, index]))
        for method in _of_coordinate(*classes):
            yield Call(method, (node, name))


def _of_deformation(before: Class, after: Class) -> list[str]:
    """Methods that change a class; what is stated must be taken back first."""
    if after == Class.FIXED:
        return ["hold"]
    method = "release" if after == Class.DEPENDENT else "independent"
    return [method] if before == Class.FIXED else ["hold", method]


def _of_coordinate(before: Class, after: Class) -> list[str]:
    if after == Class.DEPENDENT:
        return ["clear"]
    method = "fix" if after == Class.FIXED else "independent"
    return [method] if before == Class.DEPENDENT else ["clear", method]


class Statement(NamedTuple):
    """A line of a deck that takes the place of another, or is new, or goes."""

    line: int
    """Number of the line that goes, from 1; 0 where none does, or the deck is written anew."""
    old: str
    """What stood there."""
    new: str
    """What stands there now, empty where nothing does."""

    def to_copy(self) -> str:
        """The new line, with a comment that says which one it replaces."""
        if not self.old:
            return self.new
        where = f"line {self.line}: " if self.line else ""
        if not self.new:
            return f"% without {where}{self.old.strip()}"
        return f"{self.new}   % instead of {where}{self.old.strip()}"


class EditedDeck(NamedTuple):
    """A deck after edits."""

    text: bytes
    """The whole deck."""
    statements: tuple[Statement, ...]
    """What differs from the deck as given."""
    is_anew: bool
    """Whether it is written anew, without what an analysis does not use."""


def edited(given: ModelData, changed: ModelData) -> EditedDeck:
    """The deck of a changed model, and what differs from that of the model as given."""
    text = edited_to_the_letter(given, changed)
    source = given.source or given.began_as
    if text is None or source is None:
        return EditedDeck(deck_of(changed).encode(), tuple(_by_keyword(given, changed)), True)
    return EditedDeck(text, tuple(_differing(source.text, text)), False)


def _differing(old: bytes, new: bytes) -> Iterator[Statement]:
    """Lines that differ, each with the one in whose place it stands."""
    before, after = (decode(text).replace("\r", "").split("\n") for text in (old, new))
    first = next(
        (k for k, (a, b) in enumerate(zip(before, after, strict=False)) if a != b),
        min(len(before), len(after)),
    )
    matcher = difflib.SequenceMatcher(None, before[first:], after[first:])
    for kind, i1, i2, j1, j2 in matcher.get_opcodes():
        if kind == "equal":
            continue
        lines = range(first + i1 + 1, first + i2 + 1)
        for line, new_line in zip_longest(lines, after[first + j1 : first + j2]):
            was = before[line - 1] if line else ""
            if was.strip() or (new_line or "").strip():
                yield Statement(line or 0, was, new_line or "")


def _by_keyword(given: ModelData, changed: ModelData) -> Iterator[Statement]:
    """Statements that differ, of a deck that is written anew."""
    old, new = dict(statements_of(given)), dict(statements_of(changed))
    for key in dict.fromkeys((*old, *new)):
        if old.get(key) != new.get(key):
            yield Statement(0, old.get(key, ""), new.get(key, ""))


#: How many switches a request may have.
_LIVE_EDIT_MOST = 20_000


class Answer(NamedTuple):
    """The answer to a request."""

    changed: bool
    """Whether the mechanism is to be analysed anew."""
    content: Json
    """What is answered besides."""


class Session:
    """What was switched in a mechanism that is watched, and what comes of it.

    Args:
        watched: The deck or script; new decks are written to its folder.
        model: What the model is called in calls of Python.
    """

    def __init__(self, watched: Path, model: str = "model") -> None:
        """Without a mechanism so far."""
        self.watched, self.model_name = watched, model
        self.history = History()
        self._board: Board | None = None
        self._calls: Calls | None = None
        self._now: Result | None = None
        self._proposed: tuple[Proposals, ...] | None = None
        self._deck: tuple[Edits, EditedDeck] | None = None
        self._is_broken = False
        self._said: tuple[str, ...] = ()

    @property
    def board(self) -> Board:
        """The mechanism as given.

        Raises:
            RefusedError: There is none yet, or the file has errors now.
        """
        if self._board is None and not self._is_broken:
            raise RefusedError("the file is still being analysed", HTTPStatus.CONFLICT)
        if self._board is None or self._is_broken:
            raise RefusedError(
                "nothing can be changed while the file has errors: mend them first",
                HTTPStatus.CONFLICT,
            )
        return self._board

    def broken(self) -> None:
        """Wait for the file, which has errors, to be mended; edits stay."""
        self._is_broken = True

    def renew(self, base: Result) -> tuple[str, ...]:
        """Take the analysis of the file as it is now; edits stay.

        Returns:
            Sentences on edits that are dropped, as their element or node is gone or the file
            says the same now.
        """
        old, self._board = self._board, Board(base)
        self._calls, self._proposed, self._deck = Calls(self._board), None, None
        self._now, self._is_broken, self._said = None, False, ()
        if old is None:
            return ()
        before = self.history.now
        renewal = Renewal(old, self._board)
        self.history.renewed(renewal.edits)
        self._said = tuple(_dropped(old, self._board, renewal, before, self.history.now))
        return self._said

    @property
    def now(self) -> Result:
        """The analysis of the mechanism with all edits; as given where that was not made."""
        return self.board.base if self._now is None else self._now

    @property
    def known(self) -> Result | None:
        """As `now`; None where there is nothing, or the file has errors now."""
        return None if self._board is None or self._is_broken else self.now

    def put_aside(self, why: str) -> None:
        """Take all edits back, as they cannot be analysed with the file as it is now."""
        self.history = History()
        self._said = (f"The changes were put aside: with the file as it is now {why}.",)
        self._now = None

    def model(self) -> ModelData:
        """The mechanism with all edits, of a deck as reading its changed text gives it."""
        if not self.history.now:
            return self.board.given
        if self.board.given.source is None:
            return self.board.model(self.history.now)
        return read_bytes(self.deck().text, self.board.given.name)

    def analysed(self, now: Result) -> None:
        """Take the analysis of the mechanism with all edits."""
        self._now, self._proposed = now, None

    def ask(self, request: object) -> Answer:
        """Do what a request says.

        Args:
            request: A JSON object; "do" is one of "set", "undo", "redo", "reset", "look",
                "save" and "tell".

        Raises:
            RefusedError: It is not understood, or cannot be done; then nothing has changed.
        """
        if not isinstance(request, Mapping):
            raise RefusedError('a JSON object with "do" is wanted')
        what = request.get("do")
        actions = {
            "set": self._set,
            "undo": self._undo,
            "redo": self._redo,
            "reset": self._reset,
            "look": self._look,
            "save": self._save,
            "tell": self._tell,
        }
        if not isinstance(what, str) or what not in actions:
            known = ", ".join(actions)
            raise RefusedError(f'"do" must be one of {known}, not {_short(what)}')
        before = self.history.now
        content = actions[what](request)
        if self.history.now != before:
            self._said = ()
        return Answer(self.history.now != before, content)

    def _set(self, request: Mapping[str, Any]) -> Json:
        given = request.get("set")
        if not isinstance(given, list) or len(given) > _LIVE_EDIT_MOST:
            raise RefusedError('"set" must be a list of what is switched')
        new = [self._edit(each) for each in given]
        self.history.take(self.board.edited(self.history.now, new))
        return {}

    def _undo(self, _: Mapping[str, Any]) -> Json:
        self._require_sound()
        self.history.undo()
        return {}

    def _redo(self, _: Mapping[str, Any]) -> Json:
        self._require_sound()
        self.history.redo()
        return {}

    def _reset(self, _: Mapping[str, Any]) -> Json:
        self._require_sound()
        self.history.take(())
        return {}

    def _tell(self, _: Mapping[str, Any]) -> Json:
        return {"told": self.told()}

    def _require_sound(self) -> None:
        """Raise as `board` does."""
        _ = self.board

    def _look(self, request: Mapping[str, Any]) -> Json:
        """What is offered of a part or a point."""
        if "name" in request:
            name = request["name"]
            if not isinstance(name, str):
                raise RefusedError('"name" must be text')
            request = target_named(self.board, name)
        wanted = {
            edit
            for each in self.proposals()
            for item in each.items
            for choice in item.choices
            for edit in choice.edits
        }
        edits = self.history.now
        if "element" in request:
            return {
                "panel": panel_of_element(self.board, edits, _number(request, "element"), wanted)
            }
        if "node" in request:
            return {"panel": panel_of_node(self.board, edits, _number(request, "node"), wanted)}
        raise RefusedError('"element", "node" or "name" is wanted')

    def _save(self, request: Mapping[str, Any]) -> Json:
        name, over = request.get("name"), request.get("over", False)
        if not isinstance(name, str) or not isinstance(over, bool):
            raise RefusedError('"name" must be text, and "over" true or false')
        written = write_deck(self.watched, name, self.deck().text, over=over)
        return {"saved": harmless(written.name)}

    def _edit(self, given: object) -> Edit:
        if not isinstance(given, Mapping):
            raise RefusedError("what is switched is a JSON object")
        place = self._place(given)
        to = given.get("to")
        states = states_of(place)
        if to == "given":
            return Edit(place, self.board.before(place))
        if not isinstance(to, str) or to not in states:
            raise RefusedError(f'"to" must be one of {", ".join(states)}, not {_short(to)}')
        return Edit(place, states[to])

    def _place(self, given: Mapping[str, Any]) -> Place:
        if "element" in given:
            return self.board.deformation(_number(given, "element"), _number(given, "deformation"))
        name = given.get("coordinate")
        if not isinstance(name, str):
            raise RefusedError('"element" and "deformation", or "node" and "coordinate" are wanted')
        return self.board.coordinate(_number(given, "node"), name)

    def deck(self) -> EditedDeck:
        """The deck with all edits, and the lines that differ."""
        edits = self.history.now
        if self._deck is None or self._deck[0] != edits:
            changed = self.board.model(edits)
            self._deck = (edits, edited(self.board.given, changed))
        return self._deck[1]

    def proposals(self) -> tuple[Proposals, ...]:
        """What the advice proposes for the mechanism as it is now."""
        if self._proposed is None:
            self._proposed = proposals(self.board, self.now)
        return self._proposed

    def told(self) -> Json:
        """All that the page shows of the session."""
        if self._board is None or self._is_broken:
            is_ = "broken" if self._is_broken else "none"
            return {"is": is_, "edits": [], "undo": False, "redo": False}
        board, edits, now = self._board, self.history.now, self.now
        return {
            "is": "deck" if board.given.source is not None else "model",
            "verdict": _capital_of_live_edit(verdict_in_short(now)),
            "margin": f"{_capital_of_live_edit(margin_in_short(now))}.",
            "edits": [
                {"words": edit_in_words(board, each), "place": place_json(each.place)}
                for each in edits
            ],
            "undo": self.history.can_undo,
            "redo": self.history.can_redo,
            "proposals": [
                {
                    "head": each.head,
                    "more": each.more,
                    "items": [
                        {
                            "words": item.words,
                            "place": place_json(item.choices[0].edits[0].place),
                            "choices": [
                                {"word": choice.word, "set": [_edit_json(e) for e in choice.edits]}
                                for choice in item.choices
                            ],
                        }
                        for item in each.items
                    ],
                }
                for each in self.proposals()
            ],
            "names": names(board),
            "said": list(self._said),
            "save": harmless(free_name(self.watched)),
            "folder": harmless(str(self.watched.absolute().parent)),
            **self._how(),
        }

    def _how(self) -> Json:
        """The lines of the deck or the calls of Python that do it, and the text to be copied."""
        edits = self.history.now
        if not edits:
            return {"lines": [], "calls": [], "copy": "", "note": ""}
        if self.board.given.source is None:
            assert self._calls is not None
            calls = [call.in_words(self.model_name) for call in self._calls.of(edits)]
            return {"lines": [], "calls": calls, "copy": "\n".join(calls), "note": ""}
        deck = self.deck()
        note = ""
        if deck.is_anew:
            note = (
                "These changes cannot be made line by line in this deck; a new deck is written "
                "anew, without what an analysis does not use."
            )
        return {
            "lines": [each._asdict() for each in deck.statements],
            "calls": [],
            "copy": "\n".join(each.to_copy() for each in deck.statements),
            "note": note,
        }


def _dropped(
    old: Board, new: Board, renewal: Renewal, before: Edits, after: Edits
) -> Iterator[str]:
    left = {each.place for each in after}
    for each in before:
        place = renewal.place(each.place)
        words = place_in_words(old, each.place)
        if place is None:
            yield f"Dropped, as it is not in the file any more: {words}."
        elif place not in left:
            state = next(w for w, to in states_of(place).items() if to == new.before(place))
            yield f"The file says so itself now: {words} is {state}."


def _edit_json(edit: Edit) -> Json:
    word = next(word for word, to in states_of(edit.place).items() if to == edit.to)
    return {**place_json(edit.place), "to": word}


def _number(given: Mapping[str, Any], key: str) -> int:
    number = given.get(key)
    if isinstance(number, bool) or not isinstance(number, int):
        raise RefusedError(f'"{key}" must be a whole number, not {_short(number)}')
    return number


def _capital_of_live_edit(words: str) -> str:
    return words[:1].upper() + words[1:]


def _short(given: object) -> str:
    words = harmless(repr(given))
    return words if len(words) <= 40 else f"{words[:37]}..."


#: Bytes of the largest request.
MOST_BYTES = 4_000_000


class Reply(NamedTuple):
    """The answer to a request."""

    status: HTTPStatus
    content: dict[str, Any]
    """What is answered, as JSON; "error" in words where it was refused."""
    changed: bool
    """Whether the mechanism is to be analysed anew."""


def answered(session: Session, body: bytes) -> Reply:
    """Do what the body of a request says; what it cannot is told in words."""
    try:
        answer = session.ask(_read(body))
    except RefusedError as error:
        return Reply(error.status, refused(error), False)
    return Reply(HTTPStatus.OK, answer.content, answer.changed)


def refused(error: Exception) -> dict[str, Any]:
    """An error as JSON."""
    return {"error": str(error)}


def _read(body: bytes) -> object:
    if len(body) > MOST_BYTES:
        raise RefusedError("the request is too long", HTTPStatus.REQUEST_ENTITY_TOO_LARGE)
    try:
        return json.loads(body)
    except (ValueError, RecursionError):
        raise RefusedError("the request is no JSON", HTTPStatus.BAD_REQUEST) from None
