# SPDX-License-Identifier: BSD-3-Clause
"""What is offered of a part or a point that was clicked, as JSON."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from typing import Any

import numpy as np

from ...analysis.places import node_words, part_words, place_words
from ...core.elements import Class, NodeKind, element_kinds
from ...model.names import nearest
from ...model.parts.parts import Part, PartKind
from ...util.plain_text import in_short
from .editable_model import Board, Edits
from .places import CoordinatePlace, DeformationPlace, Edit, Place, state_word, states_of
from .refusal import RefusedError
from .words import (
    deformation_in_words,
    element_title,
    element_words,
    elements_words,
    node_title,
    way_in_words,
)

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
