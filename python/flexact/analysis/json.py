# SPDX-License-Identifier: BSD-3-Clause
"""Small parts of the JSON: places by number and name, quantities with units, margins, advice."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from typing import Any

from ..core.elements import keywords_of
from .advice_ways import Coordinate, Part, Step, Way, on_motions, on_self_stresses
from .calls import calls_of
from .deformation_words import deformation_word
from .failing import AnalysisError
from .freedoms import Freedom
from .naming import freedom_in_words, node_name, part_in_words, unit_of_coordinate
from .result import Result
from .sentences import plain
from .verdict import Margin

#: Of so many declared degrees of freedom, in models of so many elements, the motions are given:
#: they take one further decomposition.
_MOST_FREEDOMS, _MOST_ELEMENTS = 64, 10_000
#: Components of the motion of a degree of freedom.
_PARTS = 6
_ALL = (Step.DECLARE_FOLDS, Step.DECLARE_OR_HOLD_ALL, Step.RELEASE_ALL)

Entries = dict[str, Any]


def quantity(value: float, unit: str) -> Entries:
    """A number beside its unit."""
    return {"value": value, "unit": unit}


def node_place(result: Result, number: int) -> Entries:
    """A node by its number, and what it is called."""
    return {"node": number, "name": node_name(result, result.data.node_index[number])}


def element_place(result: Result, number: int) -> Entries:
    """An element by its number, what it is called, and its keyword."""
    return _element_at(result, result.given.element_index[number])


def _element_at(result: Result, index: int) -> Entries:
    """The same by its index in the model as given."""
    given = result.given
    (keyword,) = keywords_of(given.arrays.element_kind[index : index + 1])
    return {
        "element": int(given.arrays.element_number[index]),
        "name": given.element_names[index],
        "keyword": keyword,
    }


def deformation_place(result: Result, element: int, number: int) -> Entries:
    """A deformation of an element, by its number and in words."""
    arrays = result.given.arrays
    index, own = result.condensed.in_given(result.data.element_index[element], number)
    word = deformation_word(int(arrays.element_kind[index]), own)
    place = _element_at(result, index)
    return {**place, "deformation": own, "word": word}


def coordinate_place(result: Result, node: int, name: str) -> Entries:
    """A coordinate of a node."""
    return {**node_place(result, node), "coordinate": name}


def margin(result: Result, item: Margin) -> Entries:
    """A misalignment: how far a node moves, how far an element turns."""
    length = angle = None
    if item.length is not None and item.node is not None:
        length = {**quantity(item.length, "m"), **node_place(result, item.node)}
    if item.angle is not None and item.element is not None:
        angle = {**quantity(item.angle, "rad"), **element_place(result, item.element)}
    return {
        "length": length,
        "angle": angle,
        "singular_value": item.singular_value,
        "exact_alignment": item.exact_alignment,
    }


def accuracy(result: Result) -> Entries | None:
    """The accuracy as it was given, and whether the margin is smaller; None without one."""
    given = result.accuracy
    if given is None:
        return None
    return {
        "length": quantity(given.length, "m"),
        "angle": None if given.angle is None else quantity(given.angle, "rad"),
        "exceeds_margin": result.is_marginal,
    }


def advice(result: Result) -> Iterator[Entries]:
    """What removes motions, then what removes self-stresses, the best first.

    What is inside of divided sheets is declared first; the rest is of what is left then.
    """
    whole = result.with_internal_declared
    if whole is not None:
        yield from (_one_advice(result, "motions", item) for item in islice(on_motions(result), 1))
        result = whole
    for about, every in (
        ("motions", on_motions(result)),
        ("self_stresses", on_self_stresses(result)),
    ):
        yield from (_one_advice(result, about, item) for item in every)


def _one_advice(result: Result, about: str, item: Way) -> Entries:
    return {
        "about": about,
        "removes": "all" if item.step in _ALL else "one",
        "step": item.step.value,
        "parts": [
            {
                **_part(result, part),
                "words": plain(part_in_words(result, part)),
                "operands": part.operands,
            }
            for part in item.parts
        ],
        "more": item.more,
        "statements": [
            {"keyword": keyword, "operands": item.parts[0].operands}
            for keyword in item.keywords
            if not (item.step is Step.UNDECLARE and isinstance(item.parts[0], Coordinate))
        ],
        "calls": _calls(result, item),
        "instead": item.instead,
    }


def _calls(result: Result, item: Way) -> list[str]:
    """What does it with the first part of a model that was made in Python."""
    return [] if result.given.source is not None else [*calls_of(result, item, item.parts[0])]


def _part(result: Result, part: Part) -> Entries:
    if isinstance(part, Coordinate):
        return coordinate_place(result, part.node, part.name)
    return deformation_place(result, part.element, part.number)


def freedoms(result: Result) -> Iterator[Entries]:
    """The declared degrees of freedom, and how the mechanism moves in them."""
    most = _MOST_FREEDOMS
    if result.data.arrays.element_number.size > _MOST_ELEMENTS:
        most = 0
    for count, freedom in enumerate(result.freedoms):
        yield _freedom(result, freedom, count < most)


def _freedom(result: Result, freedom: Freedom, is_sought: bool) -> Entries:
    _, number = freedom.owner
    if freedom.is_coordinate:
        place = coordinate_place(result, number, freedom.part)
    else:
        place = deformation_place(result, number, freedom.place[0] + 1)
    made: Entries = {
        "label": plain(freedom_in_words(freedom)),
        **place,
        "moves": None,
        "largest": [],
    }
    try:
        if is_sought:
            made["moves"] = freedom.motion is not None
            made["largest"] = [
                {
                    **coordinate_place(result, node, name),
                    **quantity(value, unit_of_coordinate(name)),
                }
                for node, name, value in freedom.largest(_PARTS)
            ]
    except AnalysisError:
        # The degree of freedom is there, only its motion could not be found.
        pass
    return made
