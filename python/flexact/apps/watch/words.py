# SPDX-License-Identifier: BSD-3-Clause
"""What is switched, in the words of a designer."""

from __future__ import annotations

from ...analysis.deformation_words import bending_of, deformation_words
from ...analysis.places import (
    end_words,
    node_words,
    part_words,
    point_words,
    stands_for,
    with_article,
)
from ...core.elements import NodeKind, keywords_of
from ...model.parts.parts import Part, PartKind
from .editable_model import Board
from .places import CoordinatePlace, DeformationPlace, Edit, Place, state_word


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
