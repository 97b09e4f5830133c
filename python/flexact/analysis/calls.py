# SPDX-License-Identifier: BSD-3-Clause
"""Calls of Python that do what an advice says, for models that were made in Python."""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from ..core.elements import Class, Member, NodeKind, Role
from ..deck.rendering import ModelError
from ..model.data import ModelData
from ..model.draft import ROUNDING
from ..model.parts.condensing import condensed
from ..model.parts.forms import AT_Q, is_member
from ..model.parts.parts import Part as NamedPart
from ..model.parts.parts import PartKind, Parts
from ..util.loading import load
from .change import Change
from .decomposition import Decomposition
from .locate import positions_near
from .places import bending_of, part_of, role_of
from .ways import Coordinate, Deformation, Part, Step, Way

#: What a method of a model is, by the statement of a deck that does the same.
_METHODS = {"DYNX": "independent", "FIX": "fix", "RLSE": "release", "DYNE": "independent"}
#: The word for holding what is released, which a deck does without a statement.
HOLD = "hold"

#: Elements up to which calls in words are tried before they are shown.
MOST_TRIED = 3_000
#: Of the size of a model: points nearer than this might be taken for each other.
_APART = 4.0 * ROUNDING

#: A name, a number, or a place [m].
Argument = str | int | tuple[float, ...]


class Call(NamedTuple):
    """A call of a method of a model."""

    method: str
    arguments: tuple[Argument, ...]
    at: Argument | None = None
    """The end of a part, where one is said."""

    def in_words(self, model: str = "model") -> str:
        """As it is typed, with the name of the model; of places twelve digits are enough."""
        words = list(map(_typed, self.arguments))
        if self.at is not None:
            words.append(f"at={_typed(self.at)}")
        return f"{model}.{self.method}({', '.join(words)})"


def calls_of(result: Decomposition, advice: Way, part: Part) -> tuple[str, ...]:
    """Such as `model.release("sheet 1", "in-plane bending", at="clamp 1")`.

    None where nothing is to be said, or no word says it without local axes. What a call has
    released is held before it is declared, as a model does not take both.
    """
    if advice.step is Step.UNDECLARE:
        return taken_back(result, part)
    if not advice.keywords:
        return ()
    call = call_of(result, advice.keywords[0], part)
    if not call or isinstance(part, Coordinate):
        return (call,) if call else ()
    named = part_of(result, result.data.element_index[part.element])
    is_stated = advice.instead and not result.given.called.isdisjoint(
        (index, number) for index in named.elements for number in range(1, 7)
    )
    return _in_turn(result, (HOLD, method_of(advice.keywords[0])), part) if is_stated else (call,)


def taken_back(result: Decomposition, part: Part) -> tuple[str, ...]:
    """The calls that take back a declaration; a deformation is held before it is released."""
    if isinstance(part, Coordinate):
        call = coordinate_call(result, "clear", part.node, part.name)
        cleared = Change(coordinates=((part.node, part.name, Class.DEPENDENT),))
        wanted, found = cleared.apply(result.given).data, made(result.given, [call])
        # Of a body with several orientations its name is that of the first.
        is_it = found is not None and np.array_equal(
            found.arrays.coordinate_class, wanted.arrays.coordinate_class
        )
        return ((call if is_it else Call("clear", (part.node, part.name))).in_words(),)
    return _in_turn(result, (HOLD, "release"), part)


def _in_turn(result: Decomposition, methods: tuple[str, ...], part: Deformation) -> tuple[str, ...]:
    """Calls with one deformation: in words, or where the model does not take these by numbers."""
    calls = [deformation_call(result, method, *part[:2]) for method in methods]
    worded = [call for call in calls if call is not None]
    if worded and made(result.given, worded) is None:
        place, own = result.condensed.in_given(result.data.element_index[part.element], part.number)
        number = int(result.given.arrays.element_number[place])
        worded = [Call(method, (number, own)) for method in methods]
    return tuple(call.in_words() for call in worded)


def method_of(keyword: str) -> str:
    """The method that does what a statement of a deck does; of `HOLD` and others themselves."""
    return _METHODS.get(keyword, keyword)


def call_of(result: Decomposition, keyword: str, part: Part) -> str:
    """The call that does with a part what a statement of a deck does, or `HOLD`."""
    method = method_of(keyword)
    if isinstance(part, Coordinate):
        return coordinate_call(result, method, part.node, part.name).in_words()
    call = deformation_call(result, method, part.element, part.number)
    return "" if call is None else call.in_words()


def calls_of_change(result: Decomposition, change: Change, method: str) -> list[Call]:
    """Calls of one method that make a change together; none where there are none for all of it.

    They were tried on the model. Where words do not do it, as bending has no plane any more once
    a sheet holds none, numbers do.
    """
    worded = [deformation_call(result, method, *place[:2]) for place in change.deformations]
    coordinates = [coordinate_call(result, method, *place[:2]) for place in change.coordinates]
    if None in worded:
        return []
    calls = list(dict.fromkeys(call for call in worded if call is not None))
    if calls and result.given.arrays.element_number.size <= MOST_TRIED:
        # Rows of beams count as one, and what is held may be declared.
        wanted = Change(change.deformations).apply(result.given).data
        found = made(result.given, calls)
        releases = [
            condensed(each).data.arrays.deformation_class == Class.DEPENDENT
            for each in (found, wanted)
            if each is not None
        ]
        if len(releases) < 2 or not np.array_equal(*releases):
            calls = [Call(method, place[:2]) for place in change.deformations]
    return calls + coordinates


def made(given: ModelData, calls: Iterable[Call]) -> ModelData | None:
    """A model after some calls; None where it does not take them."""
    model = load("flexact.model.model").Model.from_data(given)
    try:
        for call in calls:
            at = {} if call.at is None else {"at": call.at}
            getattr(model, call.method)(*call.arguments, **at)
    except ModelError:
        return None
    after: ModelData = model.data
    return after


def coordinate_call(result: Decomposition, method: str, node: int, name: str) -> Call:
    """The call of a method with a coordinate of a node, by its number."""
    named = _node_by_name(result.parts, result.given.node_index[node])
    return Call(method, (node if named is None else named, name))


def deformation_call(result: Decomposition, method: str, element: int, number: int) -> Call | None:
    """The call of a method with a deformation; None where no word says it without local axes.

    Nor does one of a link that only carries a point: what it is, a model decides at the end.

    Args:
        result: The result.
        method: Such as "release".
        element: Number of the element.
        number: Number of the deformation, from 1.
    """
    index = result.data.element_index[element]
    if is_member(result.data.arrays.element_kind[[index]], Member.LINK)[0]:
        return None
    named, (place, own) = part_of(result, index), result.condensed.in_given(index, number)
    part = named_part(result.parts, named, place)
    if isinstance(part, int) and len(named.elements) > 1:
        return Call(method, (part, own))
    bending = bending_of(result, index, number)
    words = {Role.ELONGATION: "elongation", Role.TORSION: "twist"}
    role = role_of(result, index, number)
    if bending is None:
        return Call(method, (part, words[Role(role)] if role in words else number))
    if bending.word is None:
        return None
    # Of several beams that are one, any of them may release what is at an end of all.
    ends = named.ends if len(named.elements) > 1 else (bending.position,) * 2
    end = ends[1] if role in AT_Q else ends[0]
    return Call(method, (part, bending.word), _end(result.parts, named, end))


def named_part(parts: Parts, part: NamedPart, index: int) -> str | int:
    """A part by its name if the builder takes it by that, or by the number of an element of it."""
    if (len(part.elements) == 1 or parts.is_one_beam(index)) and _is_found(parts, part):
        return part.name
    return int(parts.data.arrays.element_number[index])


def _is_found(parts: Parts, part: NamedPart) -> bool:
    """Whether the builder finds this part, and no other, by its name."""
    found = parts.elements_by_name.get(part.name, []) if part.is_named else []
    if found != sorted(part.elements):
        return False
    if len(found) == 1:
        return True
    slots = parts.data.arrays.element_node
    is_row = all(np.array_equal(slots[2:, a], slots[:2, b]) for a, b in itertools.pairwise(found))
    named_alike = any(parts.data.element_names[i] == part.name for i in found)
    return not named_alike and (is_row or part.kind is PartKind.BODY)


def _node_by_name(parts: Parts, node: int) -> Argument | None:
    """A node as the builder finds it by its body, its point or its place; None where it does not.

    A point, by whatever it is called, has the orientation that was made with it: the first.
    """
    data, body, place = parts.data, parts.body_at.get(node), parts.place_of(node)
    turns = data.arrays.node_kind[node] > NodeKind.POSITION
    if body is not None and (turns or parts.first_points[body] == node):
        part = parts.of_body(body)
        if part.name not in parts.points_by_name and _is_found(parts, part):
            return part.name
    if place is None or (turns and not _is_made_with(parts, node, place)):
        return None
    return _point(parts, place)


def _is_made_with(parts: Parts, node: int, place: int) -> bool:
    """Whether an orientation is the first that its place had, as far as numbers tell.

    One between them that no element uses, or that none has at a place, may have been before it.
    """
    numbers = parts.data.arrays.node_number
    first, last = int(numbers[place]) + 1, int(numbers[node])
    between = range(*np.searchsorted(numbers, (first, last)).tolist())
    are_known = all(parts.place_of(each) is not None for each in between)
    return parts.orientations_at[place][0] == node and len(between) == last - first and are_known


def _point(parts: Parts, position: int) -> Argument | None:
    """A point by its name or its place; None where neither is its own."""
    name = parts.name_of_point(position)
    if parts.points_by_name.get(name) == [position]:
        return name
    here = parts.data.arrays.node_value[:3, position]
    if positions_near(parts, here, _APART).size > 1:
        return None
    return tuple(parts.data.units.shown(here[: 2 if parts.data.planar else 3], "m").tolist())


def _end(parts: Parts, part: NamedPart, position: int) -> Argument:
    """An end of a part: by its point, by the body there, by its place, or as p or q."""
    point, body = _point(parts, position), parts.body_at.get(position)
    if isinstance(point, str):
        return point
    if body is not None and len({*part.ends} & {*parts.bodies[body].positions}) == 1:
        there = parts.of_body(body)
        if there.name not in parts.points_by_name and _is_found(parts, there):
            return there.name
    if point is not None:
        return point
    first = parts.data.arrays.element_node[0, min(part.elements)] - 1
    return "p" if first == position else "q"


def _typed(given: Argument) -> str:
    if isinstance(given, str):
        return '"' + given.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(given, int):
        return str(given)
    return f"({', '.join(f'{value + 0.0:.12g}' for value in given)})"
