# SPDX-License-Identifier: BSD-3-Clause
"""Edits as calls of Python: in words where they say the same, else by numbers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ...analysis.calls import MOST_TRIED, Call, coordinate_call, deformation_call, made, named_part
from ...analysis.deformation_words import part_of, role_of
from ...core.elements import Class, Role, coordinate_name
from ...model.data import ModelData
from ...model.words import AT_P
from .editable_model import Board, Edits
from .places import CoordinatePlace, DeformationPlace, Edit

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
