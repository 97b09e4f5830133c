# SPDX-License-Identifier: BSD-3-Clause
"""A mechanism with all that can be switched in it, and its edits: as calls, as text, in a new one.

Edits are written as calls of Python, as lines of a deck, and as a new deck in a file; where another
mechanism takes the place of the one at hand, its parts are found again.
"""

from __future__ import annotations

import difflib
import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from http import HTTPStatus
from itertools import zip_longest
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...advice.releases.words import outcome_as_given
from ...analysis.calls import MOST_TRIED, Call, coordinate_call, deformation_call, made, named_part
from ...analysis.change import Change
from ...analysis.decomposition import Decomposition
from ...analysis.places import part_of, role_of
from ...analysis.result import Result, result_of
from ...core.elements import AXES, Class, NodeKind, Role, coordinate_name, element_kinds
from ...deck.diagnostics import decode
from ...model.data import ModelData
from ...model.deformations import classes_of_division
from ...model.editing import edited_to_the_letter
from ...model.parts.chains import Chain
from ...model.parts.forms import AT_P
from ...model.parts.parts import Parts
from ...model.reading import read_bytes
from ...model.writing import deck_of, statements_of
from ...util.decks import SUFFIX
from ...util.errors import FlexactError
from ...util.outputs import OutputError, write_together
from ...util.records import cached_property
from ...util.text import harmless, in_short


class RefusedError(FlexactError):
    """What was asked for is not understood, or cannot be done; nothing has changed.

    Attributes:
        status: Of the answer over HTTP.
    """

    def __init__(self, message: str, status: HTTPStatus = HTTPStatus.UNPROCESSABLE_ENTITY) -> None:
        """Keep the words and the status."""
        super().__init__(message)
        self.status = status


class DeformationPlace(NamedTuple):
    """A deformation of an element; of a divided flexure as if it were its first beam."""

    element: int
    """Number of the element."""
    number: int
    """Number of the deformation, from 1."""


class CoordinatePlace(NamedTuple):
    """A coordinate of a node."""

    node: int
    """Number of the node."""
    name: str
    """Such as x or rz."""


Place = DeformationPlace | CoordinatePlace


class Edit(NamedTuple):
    """A deformation or a coordinate, and the class that it gets."""

    place: Place
    to: Class


_DEFORMATION = {
    "held": Class.FIXED,
    "released": Class.DEPENDENT,
    "independent": Class.INDEPENDENT,
}
_COORDINATE = {
    "fixed": Class.FIXED,
    "free": Class.DEPENDENT,
    "independent": Class.INDEPENDENT,
}


def states_of(place: Place) -> dict[str, Class]:
    """The states that a place can have: words and classes."""
    return _DEFORMATION if isinstance(place, DeformationPlace) else _COORDINATE


def state_word(place: Place, value: Class) -> str:
    """The word of a class: "held", "fixed", ..."""
    return next(word for word, each in states_of(place).items() if each == value)


def index_of(known: Mapping[int, int], kind: str, number: int) -> int:
    """The index of an element or a node by its number.

    Raises:
        RefusedError: There is none.
    """
    if number not in known:
        raise RefusedError(f"there is no {kind} {number}")
    return known[number]


class StepEdit(NamedTuple):
    """A step of the advice, done as a whole, of the mechanism with all that was edited before."""

    words: str
    which: str
    """Which of the advice it is, as Python has it, such as "[0]"."""
    change: Change


#: Edits of single places, in the order in which they were made.
Edits = tuple[Edit, ...]
#: Edits of single places and whole steps, in the order in which they were made.
AllEdits = tuple[Edit | StepEdit, ...]


class Board:
    """A mechanism, by the analysis of it as it was given: all words are of that state.

    A divided sheet or wire that counts as one beam is switched as one; of any other each beam is
    switched by itself.
    """

    def __init__(self, base: Result) -> None:
        """Keep the analysis."""
        self.base = base
        self.given = base.given
        self.parts = base.parts
        self._calls: dict[Edits, tuple[Call, ...]] = {(): ()}

    @cached_property
    def plain(self) -> Decomposition:
        """The outcome on the elements as given, for words."""
        return outcome_as_given(self.base)

    @cached_property
    def wholes(self) -> dict[int, Chain]:
        """The divided flexure that is switched as one, by the index of each of its beams."""
        chains = self.base.condensed.chains
        return {i: each for each in chains if not any(each.reversed) for i in each.elements}

    def deformation(self, element: int, number: int) -> DeformationPlace:
        """The place of a deformation.

        Raises:
            RefusedError: There is no such element, or it has no such deformation.
        """
        index = index_of(self.given.element_index, "element", element)
        last = element_kinds()[int(self.given.arrays.element_kind[index]) - 1].deformations
        if not 1 <= number <= last:
            raise RefusedError(f"element {element} has no deformation {number}: it has 1 to {last}")
        whole = self.wholes.get(index)
        if whole is not None:
            element = int(self.given.arrays.element_number[whole.elements[0]])
        return DeformationPlace(element, number)

    def coordinate(self, node: int, name: str) -> CoordinatePlace:
        """The place of a coordinate.

        Raises:
            RefusedError: There is no such node, or it has no such coordinate.
        """
        index = index_of(self.given.node_index, "node", node)
        if name not in self.coordinates_of(index):
            there = ", ".join(self.coordinates_of(index))
            raise RefusedError(f"node {node} has no coordinate {in_short(name)}: it has {there}")
        return CoordinatePlace(node, name)

    def coordinates_of(self, index: int) -> list[str]:
        """Names of the coordinates of a node, by its index."""
        kind = int(self.given.arrays.node_kind[index])
        return [coordinate_name(kind, axis) for axis in AXES[kind]]

    def before(self, place: Place) -> Class:
        """The class that a place has in the mechanism as given."""
        if isinstance(place, CoordinatePlace):
            index = self.given.node_index[place.node]
            axes = AXES[int(self.given.arrays.node_kind[index])]
            axis = axes[self.coordinates_of(index).index(place.name)]
            return Class(int(self.given.arrays.coordinate_class[axis, index]))
        # A whole is one beam of the model that was analysed, under the number of its first.
        is_whole = self.given.element_index[place.element] in self.wholes
        data = self.base.data if is_whole else self.given
        index = data.element_index[place.element]
        return Class(int(data.arrays.deformation_class[place.number - 1, index]))

    def now(self, place: Place, edits: Iterable[Edit]) -> Class:
        """The class that a place has after some edits."""
        return next((each.to for each in edits if each.place == place), self.before(place))

    def edited(self, edits: Edits, new: Iterable[Edit]) -> Edits:
        """Edits and new ones; what is as it was given is no edit."""
        made = {each.place: each.to for each in edits}
        for place, to in new:
            made.pop(place, None)
            if to != self.before(place):
                made[place] = to
        return tuple(Edit(place, to) for place, to in made.items())

    def change(self, edits: Edits) -> Change:
        """Edits as one change of the model, element by element."""
        arrays = self.given.arrays
        numbers = arrays.element_number.tolist()
        deformations: dict[tuple[int, int], Class] = {}
        coordinates: dict[tuple[int, str], Class] = {}
        classes: list[list[int]] | None = None
        for place, to in edits:
            if isinstance(place, CoordinatePlace):
                coordinates[place] = to
                continue
            index = self.given.element_index[place.element]
            whole = self.wholes.get(index)
            if whole is None:
                deformations[place] = to
                continue
            classes = arrays.deformation_class.T.tolist() if classes is None else classes
            kind = element_kinds()[int(arrays.element_kind[index]) - 1]
            _, new = classes_of_division(classes, kind, whole.elements, [place.number], to)
            for i, number, value in new:
                classes[i][number - 1] = int(value)
                deformations[numbers[i], number] = value
        return Change(
            tuple((element, number, to) for (element, number), to in deformations.items()),
            tuple((node, name, to) for (node, name), to in coordinates.items()),
        )

    def model(self, edits: Edits) -> ModelData:
        """The mechanism after some edits; as it was given where there are none."""
        return self.change(edits).apply(self.given).data if edits else self.given

    def calls(self, edits: Edits) -> tuple[Call, ...]:
        """The calls that make edits, in order; each was tried, and gives what its edit gives.

        Of a large model the calls are by numbers, and need no trial.
        """
        if edits not in self._calls:
            before = self.calls(edits[:-1])
            given, wanted = self.model(edits[:-1]), self.model(edits)
            ways: Iterable[Sequence[Call]] = ()
            if given.arrays.element_number.size <= MOST_TRIED:
                ways = _in_words(self, edits[-1])
            words = (calls for calls in ways if _is_same(made(given, calls), wanted))
            self._calls[edits] = (*before, *next(words, _by_numbers(given, wanted)))
        return self._calls[edits]


class Boards:
    """A mechanism as given, and what steps of the advice have made of it, each with its edits."""

    def __init__(self, base: Result) -> None:
        """Keep the analysis of the mechanism as given."""
        self.base = base
        self._known: dict[AllEdits, Board] = {(): Board(base)}

    @staticmethod
    def split(edits: AllEdits) -> tuple[AllEdits, Edits]:
        """Edits up to the last step, and the edits of single places behind it."""
        last = max((k for k, one in enumerate(edits) if isinstance(one, StepEdit)), default=-1)
        return edits[: last + 1], tuple(one for one in edits[last + 1 :] if isinstance(one, Edit))

    def of(self, edits: AllEdits) -> Board:
        """The mechanism on which edits behind the last step are made.

        Raises:
            KeyError: A step names what is not there any more.
            FlexactError: What a step makes of it cannot be analysed.
        """
        below, _ = self.split(edits)
        if below not in self._known:
            step = below[-1]
            assert isinstance(step, StepEdit)
            changed = step.change.apply(self.model(below[:-1])).data
            self._known[below] = Board(self.analysed(changed))
        return self._known[below]

    def model(self, edits: AllEdits) -> ModelData:
        """The mechanism with all edits."""
        return self.of(edits).model(self.split(edits)[1])

    def deck(self, changed: ModelData) -> EditedDeck:
        """The deck of a changed mechanism, and what differs from that as given."""
        return edited(self.base.given, changed)

    def analysed(self, changed: ModelData) -> Result:
        """The analysis of a changed mechanism, of a deck as reading its changed text gives it.

        Raises:
            FlexactError: It cannot be analysed.
            MemoryError: It is too large.
        """
        base = self.base
        if base.given.source is not None:
            changed = read_bytes(self.deck(changed).text, base.given.name)
        return result_of(changed, base.asked, base.name, kind=Result)

    def calls(self, edits: AllEdits, name: str) -> list[str]:
        """The calls of Python that make all edits of the model of this name."""
        below, top = self.split(edits)
        made = [call.in_words(name) for call in self.of(edits).calls(top)]
        if not below:
            return made
        step = below[-1]
        assert isinstance(step, StepEdit)
        done = f"{name} = flexact.analyse({name}).advice(){step.which}.apply()"
        return [*self.calls(below[:-1], name), done, *made]


_BENDINGS = {
    **dict.fromkeys((Role.BENDING_XZ_P, Role.BENDING_XZ_Q), "bending about y"),
    **dict.fromkeys((Role.BENDING_XY_P, Role.BENDING_XY_Q), "bending about z"),
}


def _is_same(tried: ModelData | None, wanted: ModelData) -> bool:
    """Whether calls could be made, and give the same classes."""
    if tried is None:
        return False
    a, b = tried.arrays, wanted.arrays
    is_same = np.array_equal(a.deformation_class, b.deformation_class)
    return is_same and np.array_equal(a.coordinate_class, b.coordinate_class)


def _in_words(board: Board, edit: Edit) -> Iterator[list[Call]]:
    """Ways to say an edit, the plainest first."""
    place, before = edit.place, board.before(edit.place)
    if isinstance(place, CoordinatePlace):
        yield [
            coordinate_call(board.base, method, place.node, place.name)
            for method in _of_coordinate(before, edit.to)
        ]
        return
    first = [_worded(board, place, method) for method in _of_deformation(before, edit.to)]
    yield [call for call in first if call is not None]
    is_at_p = _role(board, place) in AT_P
    ended = [call._replace(at="p" if is_at_p else "q") for call in first if call and call.at]
    if ended:
        yield ended


def _worded(board: Board, place: DeformationPlace, method: str) -> Call | None:
    is_whole = board.given.element_index[place.element] in board.wholes
    outcome = board.base if is_whole else board.plain
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
    a, b = given.arrays, wanted.arrays
    for before, after, numbers, methods in (
        (a.deformation_class, b.deformation_class, a.element_number, _of_deformation),
        (a.coordinate_class, b.coordinate_class, a.node_number, _of_coordinate),
    ):
        for row, index in np.argwhere(before != after).tolist():
            which: int | str = row + 1
            if numbers is a.node_number:
                which = coordinate_name(int(a.node_kind[index]), row)
            for method in methods(Class(int(before[row, index])), Class(int(after[row, index]))):
                yield Call(method, (int(numbers[index]), which))


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


_LONGEST_NAME = 200
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
    try:
        is_same = os.path.samefile(target, watched)
    except OSError:
        is_same = os.path.realpath(target) == os.path.realpath(watched)
    if is_same:
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
    while len(os.fsencode(stem)) > _LONGEST_NAME - len(f"_edited_999{SUFFIX}"):
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
    if len(os.fsencode(name)) > _LONGEST_NAME:
        raise RefusedError("that name is too long")
    return name


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
            return int(numbers[mine[others.index(index)]]) if len(mine) == len(others) else None
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
        """The name of the point where a node stands."""
        position = self.parts.place_of(node)
        return "" if position is None else self.parts.name_of_point(position)

    def place(self, node: int) -> Identity:
        """Where a node is; nothing where it stands nowhere."""
        position = self.parts.place_of(node)
        if position is None:
            return ()
        count = 2 if self.data.arrays.node_kind[position] == NodeKind.PLANAR_POSITION else 3
        return tuple((np.asarray(self.data.arrays.node_value[:count, position]) + 0.0).tolist())

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


def _grouped(items: Iterable[tuple[Identity, int]]) -> dict[Identity, list[int]]:
    made: dict[Identity, list[int]] = {}
    for key, value in items:
        made.setdefault(key, []).append(value)
    return made
