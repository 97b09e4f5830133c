# SPDX-License-Identifier: BSD-3-Clause
"""Clamps that may be misaligned, and the point at which stiffness is measured."""

from __future__ import annotations

import numpy as np

from ..analysis.locate import node_of
from ..analysis.places import node_words, part_words
from ..core.arrays import FloatArray
from ..core.elements import AXES, Class, NodeKind, coordinate_name
from ..deck.rendering import ModelError, model_error
from ..elasticity import ElasticError
from ..elasticity.errors import require_within
from ..elasticity.points import words_of_direction
from ..model.data import ModelData
from ..model.parts.parts import Parts
from .designs import Clamp, Misalignment, Point, Strength, Stroke
from .request import Request

#: How many declared coordinates are named where one is to be chosen.
_MOST_NAMED = 4


class Places:
    """Clamps and points of a model."""

    def __init__(self, data: ModelData, parts: Parts) -> None:
        """Keep the model as given, and its parts."""
        self.data, self.parts = data, parts
        self.classes = data.arrays.coordinate_class
        self.numbers = data.arrays.node_number.tolist()

    def clamps(self) -> tuple[Clamp, ...]:
        """Supports with something held, by the numbers of their nodes; driven ones are none."""
        made: dict[int, Clamp] = {}
        for node in np.argsort(self.data.arrays.node_number, kind="stable").tolist():
            if self.held(node):
                clamp = self.clamp_of(node)
                made.setdefault(clamp.node, clamp)
        return tuple(made.values())

    def coordinates(self, node: int) -> dict[str, int]:
        """The class of each coordinate of a node, by its index, such as of "x" and "rz"."""
        kind = int(self.data.arrays.node_kind[node])
        return {coordinate_name(kind, k): int(self.classes[k, node]) for k in AXES[kind]}

    def held(self, node: int) -> tuple[str, ...]:
        """Those that are fixed."""
        return tuple(n for n, each in self.coordinates(node).items() if each == Class.FIXED)

    def directions(self, clamp: Clamp) -> tuple[str, ...]:
        """Directions in which a clamp holds, and so may be misaligned."""
        nodes = dict.fromkeys(n for n in (clamp.node, clamp.orientation) if n is not None)
        return tuple(name for node in nodes for name in self.held(self.data.node_index[node]))

    def misalignments(self) -> tuple[Misalignment, ...]:
        """Every clamp in every direction in which it holds."""
        return tuple(
            Misalignment(clamp, direction)
            for clamp in self.clamps()
            for direction in self.directions(clamp)
        )

    def clamp_of(self, node: int) -> Clamp:
        """The clamp that a node, by its index, belongs to."""
        place = self.parts.place_of(node)
        if place is None or not (self.held(place) or place == node):
            place = node
        turned = self.orientation_of(place)
        if turned is not None and not self.held(turned):
            turned = None
        number = self.numbers[place]
        kind = "clamp" if turned is not None or place == node != place else "support"
        if self.data.arrays.node_kind[place] > NodeKind.POSITION:
            kind, turned = "clamp", place
        label = f"{kind} {number}"
        name = self._own_name(place)
        words = f"{label} ({name})" if name and name != label else label
        return Clamp(number, None if turned is None else self.numbers[turned], words, label)

    def _own_name(self, node: int) -> str:
        """The name of a point, or of the only part with a name that is held there."""
        place = self.parts.place_of(node)
        if place is None:
            turning = [part for part in self.parts.turning(node) if part.is_named]
            return turning[0].name if len(turning) == 1 else ""
        name = self.parts.name_of_point(place)
        named = [part.name for part in self.parts.at(place) if part.is_named]
        return name or (named[0] if len(named) == 1 else "")

    def orientation_of(self, position: int) -> int | None:
        """The orientation node at a position node, of the first element that names both."""
        slots = self.data.arrays.element_node - 1
        for element in self.parts.elements_at(position):
            for p, op in ((0, 1), (2, 3)):
                if slots[p, element] == position and slots[op, element] >= 0:
                    return int(slots[op, element])
        return None

    def drives(self) -> tuple[tuple[int, str], ...]:
        """Declared coordinates, (number of the node, name), in the order of the nodes."""
        return tuple(
            (self.numbers[node], name)
            for node in np.flatnonzero((self.classes == Class.INDEPENDENT).any(axis=0)).tolist()
            for name, each in self.coordinates(node).items()
            if each == Class.INDEPENDENT
        )

    def point(self, at: object) -> Point:
        """The point at which stiffness is measured.

        Args:
            at: What is meant; None for the point that is driven, else the one where most parts
                meet that can move.

        Raises:
            ModelError: there is no such point, or nothing that can move.
        """
        if at is not None:
            return self._made(node_of(self.parts, at), "as asked for")
        drives = self.drives()
        if drives:
            return self._made(self.data.node_index[drives[0][0]], "the driven point")
        free = (self.classes > Class.FIXED).any(axis=0)
        nodes = np.flatnonzero(free & (self.data.arrays.node_kind <= NodeKind.POSITION)).tolist()
        if not nodes:
            raise model_error("no-such-point", "no point of this mechanism can move")
        body = self._body_most_hang_on()
        if body is not None:
            return self._made(body, "on the body that most parts hang on")
        best = max(nodes, key=lambda node: len(self.parts.at(node)))
        return self._made(best, "where most parts meet")

    def _body_most_hang_on(self) -> int | None:
        """A point of the body that most parts end at; None without a body that can move."""
        best: tuple[int, int] | None = None
        for body in self.parts.bodies:
            points = [n for n in body.positions if (self.classes[:, n] > Class.FIXED).any()]
            hanging = {part for n in points for part in self.parts.at(n)}
            if points and (best is None or len(hanging) > best[0]):
                best = len(hanging), max(points, key=lambda n: len(self.parts.elements_at(n)))
        return None if best is None else best[1]

    def _made(self, node: int, reason: str) -> Point:
        place = self.parts.place_of(node)
        place = node if place is None else place
        turned = self.orientation_of(place) if place == node else node
        body = self.parts.body_at.get(place)
        number = self.numbers[place]
        own = self.parts.name_of_point(place) or (
            part_words(self.parts.of_body(body))
            if body is not None and self.parts.of_body(body).is_named
            else ""
        )
        words = f"node {number} ({own})" if own else f"node {number}"
        return Point(number, None if turned is None else self.numbers[turned], words, reason)


def given_of(places: Places, asked: Request) -> tuple[tuple[Misalignment, float], ...]:
    """The misalignments that are given together.

    Raises:
        ModelError: there is no such clamp, it does not hold this coordinate, or the value is
            larger than the model, and not `beyond`; all that are wrong are told.
    """
    made: list[tuple[Misalignment, float]] = []
    wrong: list[ModelError] = []
    for target, coordinate, value, about in asked.misalign:
        try:
            clamp = places.clamp_of(node_of(places.parts, target))
            held = places.directions(clamp)
            if coordinate not in held:
                what = f"it holds {', '.join(held)}" if held else "it is free: no clamp"
                words = f"node {clamp.node} does not hold {coordinate}"
                raise model_error("not-held", words, what)
            if not asked.beyond:
                words = f"the misalignment of {clamp.words} {words_of_direction(coordinate)}"
                _require_within(value, places.data, coordinate, words)
            centre = None
            if about is not None:
                pivot = places.parts.place_of(node_of(places.parts, about))
                if pivot is None:
                    words = f"node {about} is an orientation without a position"
                    raise model_error("no-such-node", words)
                centre = places.numbers[pivot]
            misalignment = Misalignment(clamp, coordinate, centre)
            if any(misalignment == before for before, _ in made):
                words = f"{coordinate} of node {clamp.node} is misaligned twice"
                raise model_error("given-twice", words, "give it once, with their sum")
            made.append((misalignment, value))
        except ModelError as error:
            wrong.append(error)
    if len(wrong) == 1:
        raise wrong[0]
    if wrong:
        first = [error.diagnostics[0] for error in wrong]
        words = "; ".join(f"{e.message}{f' ({e.help})' if e.help else ''}" for e in first)
        raise model_error(first[0].code, words)
    return tuple(made)


def stroke_of(places: Places, asked: Request) -> tuple[Stroke, FloatArray] | None:
    """The stroke that is asked for, with its places, absolute and ascending.

    Raises:
        ModelError: there is no such point, the coordinate is not there or is fixed, or the stroke
            leads farther than the model is large, and not `beyond`.
    """
    if asked.stroke is None:
        return None
    target, coordinate, start, stop, is_offset = asked.stroke
    node = _owner(places, node_of(places.parts, target), coordinate)
    axis = "xyz".index(coordinate[-1])
    data = places.data
    if data.arrays.coordinate_class[axis, node] == Class.FIXED:
        raise model_error(
            "fixed-drive",
            f"{coordinate} of node {places.numbers[node]} is fixed and cannot be driven",
            "a clamp is moved with --misalign (misalign=)",
        )
    # Rotations begin at zero.
    turns = data.arrays.node_kind[node] > NodeKind.POSITION
    rest = 0.0 if turns else float(data.arrays.node_value[axis, node])
    offset = rest if is_offset else 0.0
    # An angle may be of any number of turns.
    is_any = asked.beyond or coordinate.startswith("r")
    owner, number = node_words(places.parts, node), places.numbers[node]
    first, last = sorted((start + offset, stop + offset))
    for value in () if is_any else (start + offset, stop + offset):
        what = f"the stroke of {owner} along {coordinate}"
        _require_within(value - rest, data, coordinate, what)
    values = np.linspace(first, last, asked.points)
    if values[0] < rest < values[-1]:
        # Where it rests is one of them.
        values[int(np.argmin(np.abs(values - rest)))] = rest
    words = f"node {number} ({owner}) {words_of_direction(coordinate)}"
    whole = (float(values[0]), float(values[-1]))
    made = Stroke(number, coordinate, words, rest, whole, whole, units=data.units)
    return made, values


def strength_of(
    places: Places, asked: Request, stroke: tuple[Stroke, FloatArray] | None
) -> Strength | None:
    """What is asked of the strength: of the stroke's drive, else of the only declared one.

    Raises:
        ModelError: none is declared, or several are, and there is no stroke.
    """
    if not asked.strength:
        return None
    if stroke is not None:
        node, coordinate = stroke[0].node, stroke[0].coordinate
        words, rest = stroke[0].words, stroke[0].rest
    else:
        drives = places.drives()
        if len(drives) != 1:
            named = ", ".join(f"{name} of node {node}" for node, name in drives[:_MOST_NAMED])
            many = "no coordinate is declared (DYNX)" if not drives else f"several are: {named}"
            raise model_error(
                "no-drive",
                f"how far may which coordinate go? {many}",
                "name it by a stroke, such as --stroke 1:x=+-1mm (stroke=)",
            )
        node, coordinate = drives[0]
        index = places.data.node_index[node]
        turns = places.data.arrays.node_kind[index] > NodeKind.POSITION
        rest = float(places.data.arrays.node_value["xyz".index(coordinate[-1]), index])
        rest = 0.0 if turns else rest
        owner = node_words(places.parts, index)
        words = f"{owner} {words_of_direction(coordinate)}"
    return Strength(node, coordinate, words, rest, asked.share, asked.support, asked.against)


def _require_within(value: float, data: ModelData, coordinate: str, what: str) -> None:
    try:
        require_within(value, data.size, coordinate.startswith("r"), what, data.units)
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
        if each is not None and name in places.coordinates(each):
            return each
    there = [
        n
        for each in dict.fromkeys((place, turned))
        if each is not None
        for n in places.coordinates(each)
    ]
    raise model_error(
        "no-such-coordinate",
        f"the point of node {places.numbers[node]} has no coordinate {name}",
        f"it has {', '.join(there)}",
    )
