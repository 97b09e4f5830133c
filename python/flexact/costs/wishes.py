# SPDX-License-Identifier: BSD-3-Clause
"""What is asked for, found in the model: the stroke, misalignments, directions."""

from __future__ import annotations

from collections.abc import Sequence

from ..core.elements import Class, NodeKind, coordinate_name
from ..deck.errors import ModelError, model_error
from ..elasticity import ElasticError
from ..elasticity.stiffness_errors import require_within
from ..model.data import ModelData
from . import along
from .request import Asked
from .resolve import Places
from .values import DIRECTIONS, PLANAR, Misalignment, Point, words_of_direction


def directions_of(data: ModelData, point: Point) -> tuple[str, ...]:
    """Directions of a point: six, three in the plane, without an orientation its displacements."""
    every = PLANAR if data.planar else DIRECTIONS
    kind = data.arrays.node_kind[data.node_index[point.node]]
    if kind > NodeKind.POSITION:
        return tuple(name for name in every if name.startswith("r"))
    if point.orientation is None:
        return tuple(name for name in every if not name.startswith("r"))
    return every


def given_of(places: Places, asked: Asked) -> tuple[tuple[Misalignment, float], ...]:
    """The misalignments that are given together.

    Raises:
        ModelError: there is no such clamp, it does not hold this coordinate, or the value is
            larger than the model, and not `beyond`; all that are wrong are told.
    """
    made: list[tuple[Misalignment, float]] = []
    wrong: list[ModelError] = []
    for each in asked.misalign:
        try:
            clamp = places.clamp_of(places.node(each.clamp))
            held = places.directions(clamp)
            if each.coordinate not in held:
                what = f"it holds {', '.join(held)}" if held else "it is free: no clamp"
                words = f"node {clamp.node} does not hold {each.coordinate}"
                raise model_error("not-held", words, what)
            if not asked.beyond:
                words = f"the misalignment of {clamp.words} {words_of_direction(each.coordinate)}"
                _require_within(each.value, places.size, each.coordinate, words)
            about = None if each.about is None else _pivot(places, each.about)
            misalignment = Misalignment(clamp, each.coordinate, about)
            if any(misalignment == before for before, _ in made):
                words = f"{each.coordinate} of node {clamp.node} is misaligned twice"
                raise model_error("given-twice", words, "give it once, with their sum")
            made.append((misalignment, each.value))
        except ModelError as error:
            wrong.append(error)
    if wrong:
        raise _together(wrong)
    return tuple(made)


def _pivot(places: Places, target: object) -> int:
    node = places.parts.place_of(places.node(target))
    if node is None:
        raise model_error("no-such-node", f"node {target} is an orientation without a position")
    number: int = places.numbers[node]
    return number


def stroke_of(places: Places, asked: Asked) -> along.Asked | None:
    """The stroke that is asked for, with its places.

    Raises:
        ModelError: there is no such point, the coordinate is not there or is fixed, or the stroke
            leads farther than the model is large, and not `beyond`.
    """
    wish = asked.stroke
    if wish is None:
        return None
    node = _owner(places, places.node(wish.point), wish.coordinate)
    axis = "xyz".index(wish.coordinate[-1])
    data = places.data
    if data.arrays.coordinate_class[axis, node] == Class.FIXED:
        raise model_error(
            "fixed-drive",
            f"{wish.coordinate} of node {places.numbers[node]} is fixed and cannot be driven",
            "a clamp is moved with --misalign (misalign=)",
        )
    rest = _rest(data, node, axis)
    offset = rest if wish.is_offset else 0.0
    # An angle may be of any number of turns.
    is_any = asked.beyond or wish.coordinate.startswith("r")
    for value in () if is_any else (wish.start, wish.stop):
        words = f"the stroke of {places.words(places.numbers[node])} along {wish.coordinate}"
        _require_within(value + offset - rest, places.size, wish.coordinate, words)
    values = along.values_of(wish.start + offset, wish.stop + offset, asked.points, rest)
    return along.Asked(places.numbers[node], wish.coordinate, rest, values)


def _require_within(value: float, size: float, coordinate: str, what: str) -> None:
    try:
        require_within(value, size, coordinate.startswith("r"), what)
    except ElasticError as error:
        raise model_error("beyond-size", str(error)) from None


def _owner(places: Places, node: int, name: str) -> int:
    """The node of the point that has a coordinate of this name.

    Raises:
        ModelError: none has.
    """
    place = places.parts.place_of(node)
    turned = node if place != node else places.orientation_of(node)
    for each in (node, place, turned):
        if each is not None and name in _names(places.data, each):
            return each
    there = [
        n
        for each in dict.fromkeys((place, turned))
        if each is not None
        for n in _names(places.data, each)
    ]
    raise model_error(
        "no-such-coordinate",
        f"the point of node {places.numbers[node]} has no coordinate {name}",
        f"it has {', '.join(there)}",
    )


def _names(data: ModelData, node: int) -> tuple[str, ...]:
    kind = int(data.arrays.node_kind[node])
    return tuple(
        coordinate_name(kind, axis)
        for axis in range(3)
        if data.arrays.coordinate_class[axis, node] != Class.NONE
    )


def _rest(data: ModelData, node: int, axis: int) -> float:
    """Where a coordinate is in the deck [m, rad]: rotations begin at zero."""
    if data.arrays.node_kind[node] > NodeKind.POSITION:
        return 0.0
    return float(data.arrays.node_value[axis, node])


def _together(wrong: Sequence[ModelError]) -> ModelError:
    if len(wrong) == 1:
        return wrong[0]
    first = [error.diagnostics[0] for error in wrong]
    words = "; ".join(f"{e.message}{f' ({e.help})' if e.help else ''}" for e in first)
    return model_error(first[0].code, words)
