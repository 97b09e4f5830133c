# SPDX-License-Identifier: BSD-3-Clause
"""What the page of a watched mechanism offers: proposals, and switches of a part or a point."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from typing import Any

import numpy as np

from ...analysis.places import (
    bending_of,
    deformation_words,
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
from ...analysis.ways import Coordinate, Step, Way, on_motions, on_self_stresses
from ...analysis.ways import Part as WayPart
from ...core.elements import Class, NodeKind, element_kinds, keywords_of
from ...model.names import nearest
from ...model.parts.parts import Part, PartKind
from ...util.text import in_short
from .editable_model import (
    Board,
    CoordinatePlace,
    DeformationPlace,
    Edit,
    Edits,
    Place,
    RefusedError,
    index_of,
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
    before, after = (state_word(edit.place, to) for to in (board.before(edit.place), edit.to))
    return f"{place_in_words(board, edit.place)}: {before} \N{RIGHTWARDS ARROW} {after}"


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


#: What is done with all parts of a way at once.
_OF_ALL: dict[Step, Sequence[tuple[str, Class]]] = {
    Step.DECLARE_INTERNAL: [("declare", Class.INDEPENDENT)],
    Step.DECLARE_FOLDS: [("declare", Class.INDEPENDENT)],
    Step.DECLARE_OR_HOLD_ALL: [("declare", Class.INDEPENDENT), ("fix", Class.FIXED)],
    Step.RELEASE_ALL: [("release", Class.DEPENDENT)],
}


Json = dict[str, Any]


def proposals(board: Board, now: Result) -> list[Json]:
    """What may be done about the motions and the self-stresses of the mechanism as it is now."""
    ways = (*on_motions(now), *on_self_stresses(now))
    if now.folds:
        # What else moves is told once the folds are declared.
        ways = (next(on_motions(now)), *on_self_stresses(now))
    if any(way.step is Step.DECLARE_INTERNAL for way in ways):
        # What else there is to do is seen once each divided part is one beam.
        ways = tuple(way for way in ways if way.step is Step.DECLARE_INTERNAL)
    return [made for way in ways if (made := _proposals(board, now, way))["items"]]


def _proposals(board: Board, now: Result, way: Way) -> Json:
    """Parts, and of each what can be done with it, such as to release it."""
    items: dict[str, Json] = {}
    if way.step in _OF_ALL:
        if places := [place for part in way.parts for place in _every_place(board, part)]:
            count = len(way.parts)
            words = f"what is inside {count} beam{'s' * (count != 1)}"
            if way.step is not Step.DECLARE_INTERNAL:
                words = listed(list(dict.fromkeys(place_in_words(board, each) for each in places)))
            items[words] = _proposal(words, places, _OF_ALL[way.step])
    else:
        for part in way.parts:
            is_coordinate = isinstance(part, Coordinate)
            if (place := _place(board, part)) is not None:
                words = place_in_words(board, place)
                release, stop = ("free", "fix") if is_coordinate else ("release", "hold")
                verbs = [(release, Class.DEPENDENT)]
                if way.step in (Step.DECLARE_OR_HOLD, Step.DECLARE_OR_HOLD_RELEASED):
                    verbs = [("declare", Class.INDEPENDENT), (stop, Class.FIXED)]
                items.setdefault(words, _proposal(words, [place], verbs))
    most = _MOST_SUPPORTS if way.step is Step.FREE_SUPPORT else _MOST
    return {
        "head": _head(now, way.step),
        "more": way.more or len(items) > most,
        "items": list(items.values())[:most],
    }


def _proposal(words: str, places: list[Place], verbs: Sequence[tuple[str, Class]]) -> Json:
    choices = [
        {
            "word": word,
            "set": [{**place_json(place), "to": state_word(place, to)} for place in places],
        }
        for word, to in verbs
    ]
    return {"words": words, "place": place_json(places[0]), "choices": choices}


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


def _place(board: Board, part: WayPart) -> Place | None:
    if isinstance(part, Coordinate):
        return board.coordinate(part.node, part.name)
    element, number = map(int, part.operands.split()[:2])
    index = board.given.element_index[element]
    whole = board.wholes.get(index)
    if whole is not None and index not in (whole.elements[0], whole.elements[-1]):
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


def panel_of_element(board: Board, edits: Edits, element: int, wanted: Collection[Json]) -> Json:
    """What is offered of the part of an element, by its number.

    Args:
        board: The mechanism as given.
        edits: What was switched.
        element: Number of the element.
        wanted: What the advice proposes, as requests name it.

    Raises:
        RefusedError: There is no such element.
    """
    index = index_of(board.given.element_index, "element", element)
    part = board.parts.of_element(index)
    is_whole = index in board.wholes
    count = element_kinds()[int(board.given.arrays.element_kind[index]) - 1].deformations
    places = [board.deformation(element, number) for number in range(1, count + 1)]
    rows = [
        _row(board, edits, wanted, place, deformation_in_words(board, place)) for place in places
    ]
    elements = [element_words(board, each) for each in part.elements]
    if len(elements) > 4:
        elements[2:-1] = ["\N{HORIZONTAL ELLIPSIS}"]
    own = "" if is_whole or len(part.elements) == 1 else f" of {element_words(board, index)}"
    groups = [{"title": f"Deformations{own}", "rows": rows}]
    if part.kind is PartKind.BODY:
        groups = [*_of_body(board, edits, wanted, part), *groups]
    return {
        "element": places[0].element if is_whole else element,
        "name": part.name,
        "title": _capital(element_title(board, index)),
        "kind": part.kind.value,
        "about": ", ".join(elements),
        "groups": groups,
        "near": list(_near_part(board, part, index)),
    }


def panel_of_node(board: Board, edits: Edits, node: int, wanted: Collection[Json]) -> Json:
    """What is offered of a point, by the number of one of its nodes; else as of an element."""
    index = index_of(board.given.node_index, "node", node)
    position = board.parts.place_of(index)
    index = index if position is None else position
    parts = () if position is None else board.parts.at(position)
    numbers = [str(board.given.arrays.node_number[node]) for node in _nodes_at(board, index)]
    return {
        "node": int(board.given.arrays.node_number[index]),
        "name": board.parts.name_of_point(index),
        "title": _capital(node_title(board, index)),
        "kind": "point",
        "about": f"node{'s' * (len(numbers) > 1)} {', '.join(numbers)}",
        "groups": list(_of_point(board, edits, wanted, index)),
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
    stated = np.isin(classes, (Class.FIXED, Class.INDEPENDENT)).any(axis=0)
    seen = set()
    for node in np.flatnonzero(stated).tolist():
        position = board.parts.place_of(node)
        index = node if position is None else position
        if index not in seen:
            seen.add(index)
            yield node_title(board, index), int(board.given.arrays.node_number[index])


def _row(board: Board, edits: Edits, wanted: Collection[Json], place: Place, words: str) -> Json:
    now, states, at = board.now(place, edits), states_of(place), place_json(place)
    return {
        "place": at,
        "words": words,
        "states": list(states),
        "now": state_word(place, now),
        "before": state_word(place, board.before(place)),
        "proposed": [w for w, to in states.items() if to != now and {**at, "to": w} in wanted],
    }


def place_json(place: Place) -> Json:
    """A place as requests name it."""
    if isinstance(place, DeformationPlace):
        return {"element": place.element, "deformation": place.number}
    return {"node": place.node, "coordinate": place.name}


def _of_point(
    board: Board, edits: Edits, wanted: Collection[Json], index: int, title: str = ""
) -> Iterator[Json]:
    """Switches of a position and of what turns there, or of a node that stands nowhere."""
    turned = [node for node in _nodes_at(board, index) if node != index]
    is_position = board.given.arrays.node_kind[index] <= NodeKind.POSITION
    first = [index, *turned] if len(turned) == 1 and is_position else [index]
    titled = [(title or "Coordinates", first)]
    for node in turned if len(turned) > 1 else ():
        titled.append((f"{_capital(node_words(board.parts, node))} turns", [node]))
    for head, nodes in titled:
        places = (
            CoordinatePlace(int(board.given.arrays.node_number[node]), name)
            for node in nodes
            for name in board.coordinates_of(node)
        )
        rows = [_row(board, edits, wanted, each, way_in_words(each.name)) for each in places]
        yield {"title": head, "rows": rows}


def _of_body(board: Board, edits: Edits, wanted: Collection[Json], part: Part) -> Iterator[Json]:
    """Coordinates of a body at the points where one is declared, else at its first point."""
    points = _points_of(board, part)
    classes = board.given.arrays.coordinate_class
    stated = [
        point
        for point in points
        if np.isin(classes[:, _nodes_at(board, point)], (Class.INDEPENDENT, Class.FIXED)).any()
    ]
    for point in (stated or points[:1])[:_MOST_POINTS]:
        words = node_title(board, point)
        yield from _of_point(board, edits, wanted, point, f"Coordinates of {words}")


def _points_of(board: Board, part: Part) -> list[int]:
    """The positions that a body names, in the order of its elements."""
    slots = board.given.arrays.element_node[[0, 2]][:, list(part.elements)].T - 1
    return list(dict.fromkeys(slots[slots >= 0].tolist()))


def _nodes_at(board: Board, position: int) -> list[int]:
    """A position node and the orientation nodes that stand there, by their indices."""
    turned = (node for node, place in board.parts.position_of.items() if place == position)
    return [position, *sorted(turned)]


def _near_part(board: Board, part: Part, index: int) -> Iterator[Json]:
    """Ends of a part, and the other elements of one that is not switched as one."""
    numbers = board.given.arrays.node_number
    if part.kind is PartKind.BODY:
        for point in _points_of(board, part)[:_MOST_NEAR]:
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
