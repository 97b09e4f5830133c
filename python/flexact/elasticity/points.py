# SPDX-License-Identifier: BSD-3-Clause
"""Points of a model: a position node and the orientation node that stands there."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..analysis.locate import deformations_of, element_of, elements_of, numbers_listed, position_of
from ..core.arrays import FloatArray, IntArray
from ..core.elements import AXES, Class, NodeKind, coordinate_name, dual_table
from ..model.data import ModelData
from ..model.parts.parts import Parts
from ..model.transform import Place
from ..util.quantities import without_units
from ..util.records import cached_property
from ..util.text import in_short
from .errors import UnknownError


def words_of_direction(direction: str) -> str:
    """Such as "along x" or "about z"."""
    return f"about {direction[1:]}" if direction.startswith("r") else f"along {direction}"


class Point(NamedTuple):
    """A point; -1 where it has no position or no orientation."""

    position: int
    orientation: int

    @property
    def nodes(self) -> tuple[int, ...]:
        """Indices of its nodes, the position first."""
        return tuple(node for node in self if node >= 0)


class Coordinate(NamedTuple):
    """A coordinate of a node, by its index, along or about axis 0, 1 or 2."""

    node: int
    axis: int


class Points:
    """Points and coordinates of a model, as users name them."""

    def __init__(self, data: ModelData) -> None:
        """Keep the model as given."""
        self.data = data
        self.kinds: IntArray = data.arrays.node_kind

    @cached_property
    def parts(self) -> Parts:
        """Sheets and bodies of the model, for those who point by name."""
        return Parts(self.data)

    @cached_property
    def _pairs(self) -> IntArray:
        """(2, k) position and orientation of both ends of all elements, in their order."""
        slots = self.data.arrays.element_node - 1
        both = np.stack((slots[:2], slots[2:]), axis=2).reshape(2, -1)
        return np.asarray(both[:, (both >= 0).all(axis=0)])

    @cached_property
    def _partner(self) -> IntArray:
        """(nodes,) the other node of each one's point, by the first element that holds both."""
        partner = np.full(self.kinds.size, -1, np.int32)
        for mine, other in (self._pairs[:, ::-1], self._pairs[::-1, ::-1]):
            # Of several values at one place the last one stays, that of the first element.
            partner[mine] = other
        return partner

    def node(self, given: object) -> int:
        """Index of a node by its number, name or place, the name of a body, or a handle.

        Raises:
            UnknownError: there is none with this number.
            ModelError: no point, or several, have this name or are there.
            TypeError: it is nothing of that.
        """
        if isinstance(given, (int, np.integer)) and not isinstance(given, bool):
            index = self.data.node_index.get(int(given))
            if index is None:
                raise UnknownError(
                    f"there is no node {in_short(int(given))}: there are "
                    f"{numbers_listed(self.data.arrays.node_number)}"
                )
            return index
        return position_of(self.parts, given)

    def of(self, given: object) -> Point:
        """The point of a position or orientation node; where several fit, the first."""
        node = self.node(given)
        other = int(self._partner[node])
        return Point(node, other) if self.kinds[node] <= NodeKind.POSITION else Point(other, node)

    def turned_at(self, position: int) -> list[int]:
        """Indices of all orientation nodes at a position node, each once."""
        return list(dict.fromkeys(self._pairs[1, self._pairs[0] == position].tolist()))

    def coordinates(self, point: Point) -> list[Coordinate]:
        """All coordinates of a point in the order x y z rx ry rz, planar x y rz."""
        return [
            Coordinate(node, axis) for node in point.nodes for axis in AXES[int(self.kinds[node])]
        ]

    def name(self, coordinate: Coordinate) -> str:
        """Such as "z" or "rx"."""
        return coordinate_name(int(self.kinds[coordinate.node]), coordinate.axis)

    def coordinate(self, given: object, name: object) -> Coordinate:
        """The coordinate of a point with this name.

        Raises:
            UnknownError: the point has none.
        """
        point = self.of(given)
        every = self.coordinates(point)
        found = next((each for each in every if self.name(each) == name), None)
        if found is None:
            raise UnknownError(
                f"node {self.number(self.node(given))} has no coordinate {in_short(name)}: there "
                f"are {', '.join(map(self.name, every))}"
            )
        return found

    def number(self, node: int) -> int:
        """Number of a node by its index."""
        return int(self.data.arrays.node_number[node])

    def words(self, coordinate: Coordinate) -> str:
        """Such as "z of node 3"."""
        return f"{self.name(coordinate)} of node {self.number(coordinate.node)}"

    def dual(self, element: int, k: int) -> int:
        """Of what kind the stress dual to a deformation is, by their indices."""
        return int(dual_table()[self.data.arrays.element_kind[element], k])

    def unit(self, coordinate: Coordinate) -> str:
        """The SI unit of a coordinate."""
        return "rad" if self.kinds[coordinate.node] > NodeKind.POSITION else "m"

    def place(self, given: object) -> FloatArray:
        """(3,) where a node, or a point given by its coordinates, is [m].

        Raises:
            UnknownError: it is an orientation without a position.
            TypeError: it is nothing of that.
            ValueError: it has another number of coordinates, or one is not finite.
        """
        if isinstance(given, (list, tuple, np.ndarray)):
            made = np.zeros(3)
            unit = self.data.units.symbol("m")
            # What was computed is in metres.
            taken = given if isinstance(given, Place) else without_units(given, unit)
            numbers = np.asarray(taken, np.float64)
            if numbers.ndim != 1 or numbers.size not in (2, 3) or not np.isfinite(numbers).all():
                raise ValueError(f"a place has three finite coordinates [m], not {in_short(given)}")
            made[: numbers.size] = numbers
            return made
        position = self.of(given).position
        if position < 0:
            raise UnknownError(f"node {in_short(given)} is an orientation without a position")
        return np.array(self.data.arrays.node_value[:3, position])

    def element(self, given: object) -> int:
        """Index of an element by its number, its name, or what a model handed out.

        Raises:
            UnknownError: there is none of this number.
            ModelError: no part, or several, have this name; or it has several elements.
            TypeError: it is nothing of that.
        """
        number = getattr(given, "number", given)
        if isinstance(number, (int, np.integer)) and int(number) not in self.data.element_index:
            raise UnknownError(
                f"there is no element {in_short(int(number))}: there are "
                f"{numbers_listed(self.data.arrays.element_number)}"
            )
        return element_of(self.parts, given)

    def elements(self, given: object) -> tuple[int, ...]:
        """Indices of an element, or of all of a part that is given by name or handle; likewise."""
        if isinstance(given, str) or hasattr(given, "elements"):
            return elements_of(self.parts, given)
        return (self.element(given),)

    def deformation(self, element: object, k: object) -> tuple[int, int]:
        """Indices of an element and of one of its deformations, from 0.

        Raises:
            UnknownError: there is no such element, or it has no such deformation.
        """
        index = self.element(element)
        there = np.flatnonzero(self.data.arrays.deformation_class[:, index] != Class.NONE) + 1
        if isinstance(k, bool) or not isinstance(k, (int, np.integer)) or int(k) not in there:
            number = int(self.data.arrays.element_number[index])
            raise UnknownError(
                f"element {number} has no deformation {in_short(k)}: it has "
                f"{', '.join(map(str, there.tolist()))}"
            )
        return index, int(k) - 1

    def deformations(
        self, element: object, which: object, at: object = None
    ) -> list[tuple[int, int]]:
        """Indices of elements and deformations, from 0, of a number or a word; likewise."""
        if isinstance(which, str):
            return deformations_of(self.parts, element, which, at)
        return [self.deformation(element, which)]
