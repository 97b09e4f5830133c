# SPDX-License-Identifier: BSD-3-Clause
"""How edits are written: as calls of Python, as lines of a deck, and as a new deck in a file."""

from __future__ import annotations

import difflib
import os
import re
from collections.abc import Iterator, Sequence
from http import HTTPStatus
from itertools import zip_longest
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...analysis.calls import MOST_TRIED, Call, coordinate_call, deformation_call, made, named_part
from ...analysis.places import part_of, role_of
from ...core.elements import Class, Role, coordinate_name
from ...deck.diagnostics import decode
from ...model.data import ModelData
from ...model.deformations import AT_P
from ...model.editing import edited_to_the_letter
from ...model.writing import deck_of, statements_of
from ...util.decks import SUFFIX
from ...util.outputs import OutputError, write_together
from ...util.text import harmless
from .editable_model import Board, CoordinatePlace, DeformationPlace, Edit, Edits, RefusedError

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
            a = wanted.arrays
            for calls in _in_words(self.board, edits[-1]):
                tried = made(given, calls)
                if (
                    tried is not None
                    and np.array_equal(tried.arrays.deformation_class, a.deformation_class)
                    and np.array_equal(tried.arrays.coordinate_class, a.coordinate_class)
                ):
                    return calls
        return list(_by_numbers(given, wanted))


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
