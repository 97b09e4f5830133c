# SPDX-License-Identifier: BSD-3-Clause
"""A model in the making: columns of nodes and elements that grow, and finding things in them."""

from __future__ import annotations

import itertools
import math
from bisect import insort
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from ..core.elements import Class, Member, NodeKind, coordinate_name, is_position, member_table
from ..core.raw import ElementKind
from ..deck.diagnostics import Source
from ..deck.rendering import ModelError, model_error
from ..util.groups import grouped
from ..util.records import cached_property
from ..util.text import in_short
from ..util.units import METRES, Units
from .data import NUMBERS, OF_ELEMENTS
from .names import one_line, part_name
from .transform import NO_VECTOR, Transform, Vector

#: Of the size of a model: points nearer than this are at one place.
ROUNDING = 1.0e-9
#: Size of a cell of the table, in tolerances.
_CELL = 16.0


class Places:
    """Position nodes by their places, within a tolerance [m]."""

    def __init__(
        self,
        kinds: Mapping[int, int],
        values: Mapping[int, tuple[float, ...]],
        tolerance: float,
    ) -> None:
        """Of all position nodes that there are now; `values` may grow later."""
        self._values = values
        self._tolerance = tolerance
        self._size = _CELL * tolerance or 1.0
        self._cells: dict[tuple[int, ...], list[int]] = {}
        for number, kind in kinds.items():
            if is_position(kind):
                self.add(number)

    def add(self, number: int) -> None:
        """Take in a position node."""
        for cell in self._cells_of(self._values[number], 0.0):
            self._cells.setdefault(cell, []).append(number)

    def _cells_of(self, place: Sequence[float], within: float) -> Iterable[tuple[int, ...]]:
        """The cells that are met within a distance of a place: nearly always one."""
        size = self._size
        x, y, z = place[0] / size, place[1] / size, place[2] / size
        i, j, k = cell = round(x), round(y), round(z)
        inside = 0.5 - within / size
        if abs(x - i) < inside and abs(y - j) < inside and abs(z - k) < inside:
            return (cell,)
        near = within / size
        return itertools.product(*({round(v - near), round(v + near)} for v in (x, y, z)))

    def near(self, place: Sequence[float], tolerance: float | None = None) -> list[int]:
        """Numbers of the nodes at a place, in the order they were made.

        Args:
            place: (x, y, z) [m].
            tolerance: Of a few times that of all [m]; by default that.
        """
        within = self._tolerance if tolerance is None else tolerance
        return sorted(
            number
            for cell in self._cells_of(place, within)
            for number in self._cells.get(cell, ())
            if all(abs(self._values[number][k] - place[k]) <= within for k in range(3))
        )


class RigidComponents:
    """Points joined by rigid links, as sets that are merged.

    A point is known by the number of its orientation; a point that a link of a deck carries
    without its orientation (RBEAM) by its position number, negative.

    Attributes:
        seen: How many elements of the draft were looked at.
    """

    def __init__(self) -> None:
        """Of no elements so far."""
        self.seen = 0
        self._parent: dict[int, int] = {}
        self._anchor: dict[int, tuple[int, int]] = {}

    def add(self, slots: tuple[int, int, int, int]) -> None:
        """Take in a rigid link between these nodes."""
        p, op, q, oq = slots
        if not oq:
            self._anchor[-q] = p, op
        self._parent[self._root(op)] = self._root(oq or -q)

    def _root(self, key: int) -> int:
        self._parent.setdefault(key, key)
        while (above := self._parent[key]) != key:
            self._parent[key] = self._parent[above]
            key = above
        return key

    def carrier(self, position: int, orientation: int) -> tuple[int, int]:
        """The point with an orientation by which a link takes hold of the body of a point."""
        point = position, orientation
        return point if orientation in self._parent else self._anchor.get(-position, point)

    def joined(self, a: int, b: int) -> bool:
        """Whether one body carries both points, given by orientations of their carriers."""
        return self._root(a) == self._root(b)


Colour = tuple[float, float, float]

#: Of the numbers of nodes and elements.
LARGEST = 2**31 - 1
#: What a draft finds by names, numbers and places, made when it is asked for.
_TABLES = (
    *("parts_by_name", "points_by_name", "index_by_number"),
    *("_at_place", "size", "_components"),
)
_CLASS_WORDS = {Class.FIXED: "fixed", Class.DEPENDENT: "released", Class.INDEPENDENT: "independent"}


class Shape(NamedTuple):
    """A cross-section: its kind and its sizes along local y and z [m]."""

    kind: int
    y: float
    z: float


#: What is said about drawing an element, each if given: shape, colour, edge_colour, opacity, drawn;
#: body_shape and body_thickness, contour.
Said = dict[str, Any]
Numbers = tuple[float, ...]
Slots = tuple[int, int, int, int]


class Draft:
    """Nodes and elements as columns: by number those of nodes, by index those of elements."""

    def __init__(self, planar: bool, units: Units = METRES) -> None:
        """Start without nodes or elements."""
        self.planar = planar
        #: In which numbers without a unit are given; all that is kept is in SI.
        self.units = units
        #: In which places and directions are given; None: in the model's own.
        self.frame: Transform | None = None
        self.node_kind: dict[int, int] = {}
        self.node_value: dict[int, Numbers] = {}
        #: Names of points, by the numbers of their position nodes.
        self.node_names: dict[int, str] = {}
        self.node_mass: dict[int, Numbers] = {}
        #: Loads: x, y, z of nodes that have some, and the acceleration of free fall.
        self.force: dict[int, Vector] = {}
        self.increment: dict[int, Vector] = {}
        self.gravity: Vector = NO_VECTOR
        self.coordinate_class: dict[tuple[int, int], int] = {}
        #: Coordinates that were named one by one, so that they must exist.
        self.named: set[tuple[int, int]] = set()
        #: Nodes whose classes were given as a whole; one of the two must exist.
        self.whole: list[tuple[int, int]] = []
        #: The first orientation of each point by its position node, and the other way round.
        self.orientation_at: dict[int, int] = {}
        self.position_of: dict[int, int] = {}
        self.kinds: list[int] = []
        self.numbers: list[int] = []
        self.slots: list[Slots] = []
        self.vectors: list[Vector] = []
        self.classes: list[tuple[int, ...]] = []
        self.names: dict[int, str] = {}
        self.said: dict[int, Said] = {}
        self.stiffness: dict[int, Numbers] = {}
        self.mass: dict[int, Numbers] = {}
        self.strength: dict[int, Numbers] = {}
        self.expansion: dict[int, Numbers] = {}
        self.fillet: dict[int, Numbers] = {}
        #: Classes that were stated for single deformations, by index.
        self.stated: dict[tuple[int, int], int] = {}
        #: Indices of rigid elements whose kind is decided when arrays are made.
        self.rigid: set[int] = set()
        #: Of the data that it started as: how many elements, and whether they had long numbers.
        self.elements_given = 0
        self.has_long_numbers = False
        self.began_as: Source | None = None
        self.last_node = 0
        self.last_element = 0
        self._places: tuple[float, Places] | None = None

    # Nodes and elements -----------------------------------------------------

    def add_node(self, kind: int, value: Numbers) -> int:
        """Add a node and return its number."""
        number = self.last_node + 1
        if number > LARGEST:
            raise model_error("number-too-large", "the model has no node number left")
        self.last_node = number
        self.node_kind[number] = kind
        self.node_value[number] = value
        if is_position(kind):
            known = vars(self)
            if "_at_place" in known:
                self._at_place.setdefault(value, []).append(number)
            if "size" in known:
                self.size = max(self.size, *map(abs, value[:3]))
            if self._places is not None:
                self._places[1].add(number)
        return number

    def turned(self, given: Vector) -> Vector:
        """A direction in the model that is given in the frame at hand."""
        return self.frame.turned(given) if self.frame else given

    def seen(self, number: int) -> Vector:
        """The place of a position node as the frame at hand has it [m]."""
        x, y, z = self.node_value[number][:3]
        return self.frame.inverse.place((x, y, z)) if self.frame else (x, y, z)

    def join(self, position: int, orientation: int) -> None:
        """Say that an orientation is one of the point at a position node."""
        self.orientation_at.setdefault(position, orientation)
        self.position_of.setdefault(orientation, position)

    def add_orientation(self) -> int:
        """Add an unturned orientation, in the plane an angle, and return its number."""
        if self.planar:
            return self.add_node(NodeKind.ANGLE, (0.0, 0.0, 0.0, 0.0))
        return self.add_node(NodeKind.ORIENTATION, (1.0, 0.0, 0.0, 0.0))

    def add_element(
        self,
        kind: ElementKind,
        slots: Slots,
        name: str,
        vector: Vector = NO_VECTOR,
        released: tuple[int, ...] = (),
        shape: Shape | None = None,
    ) -> int:
        """Add an element and return its number; `released` are part of what it is.

        Its vector is given in the frame at hand.

        Raises:
            ModelError: both ends are one point, or at one place.
        """
        self.require_two_ends(slots)
        index = len(self.kinds)
        classes = classes_of(kind.deformations, released)
        number = self.append_element(kind.number, slots, self.turned(vector), classes)
        if name:
            self.name_element(index, name)
        if shape is not None:
            self.say_looks([index], {"shape": shape})
        return number

    def require_two_ends(self, slots: Slots) -> None:
        """Raise unless an element between these nodes has two ends, at two places.

        Raises:
            ModelError: it has not.
        """
        p, op, q, oq = slots
        if p and p == q:
            raise model_error(
                "same-node",
                f"both ends are {self.node_words(p)}",
                "give two points; two that turn apart at one place are joined by a hinge",
            )
        if op and op == oq:
            raise model_error(
                "same-node", f"both ends turn with node {op}", "give two points, or leave out q"
            )
        if p and q and self.node_value[p] == self.node_value[q]:
            raise model_error(
                "zero-length",
                f"both ends, {self.node_words(p)} and {self.node_words(q)}, are at one place",
                "give the two points different places",
            )

    def append_element(
        self, kind: int, slots: Slots, vector: Vector, classes: tuple[int, ...]
    ) -> int:
        """Add an element without a name, by the number of its kind, and return its number."""
        number = self.last_element + 1
        if number > LARGEST:
            raise model_error("number-too-large", "the model has no element number left")
        self.last_element = number
        if "index_by_number" in vars(self):
            self.index_by_number[number] = len(self.kinds)
        self.numbers.append(number)
        self.kinds.append(kind)
        self.slots.append(slots)
        self.vectors.append(vector)
        self.classes.append(classes)
        return number

    def keep_elements(self, kept: list[int]) -> None:
        """Delete all elements but these, by their indices."""
        new = {old: k for k, old in enumerate(kept)}
        for name in ("kinds", "numbers", "slots", "vectors", "classes"):
            column = getattr(self, name)
            setattr(self, name, [column[i] for i in kept])
        for name in ("names", "said", *OF_ELEMENTS):
            column = getattr(self, name)
            setattr(self, name, {new[i]: each for i, each in column.items() if i in new})
        self.stated = {(new[i], k): value for (i, k), value in self.stated.items() if i in new}
        self.rigid = {new[i] for i in self.rigid if i in new}
        self.elements_given = sum(i < self.elements_given for i in kept)
        self.changed_names_or_places()

    def drop_node(self, number: int) -> None:
        """Delete a node that no element uses, and all that was said of it."""
        columns: tuple[dict[int, Any], ...] = (
            *(self.node_kind, self.node_value, self.node_names, self.node_mass),
            *(self.force, self.increment, self.position_of, self.orientation_at),
        )
        for column in columns:
            column.pop(number, None)
        self.coordinate_class = {
            place: value for place, value in self.coordinate_class.items() if place[0] != number
        }
        self.named = {place for place in self.named if place[0] != number}
        self.whole = [both for both in self.whole if number not in both]
        self.changed_names_or_places()

    # What is said of them ---------------------------------------------------

    def say_looks(self, indices: Iterable[int], said: Said) -> None:
        """Say how elements are drawn; what is not said now stays as it was."""
        if said:
            for i in indices:
                self.said.setdefault(i, {}).update(said)

    def give_properties(
        self,
        index: int,
        stiffness: Numbers | None = None,
        mass: Numbers | None = None,
        strength: Numbers | None = None,
        expansion: Numbers | None = None,
        fillet: Numbers | None = None,
    ) -> None:
        """Give an element the numbers of ESTIFF, EM, STRENGTH and others; see `Properties`.

        What is not given stays as it was.

        Raises:
            ModelError: there are too many numbers, or one is not finite; nothing has changed.
        """
        given = dict(zip(OF_ELEMENTS, (stiffness, mass, strength, expansion, fillet), strict=True))
        for name, numbers in given.items():
            if numbers is not None:
                _require_numbers(name, numbers, name)
        for name, numbers in given.items():
            if numbers is not None:
                getattr(self, name)[index] = numbers

    def properties_of(self, index: int) -> tuple[Numbers | None, ...]:
        """What was given of an element, in the order of `give_properties`."""
        return tuple(getattr(self, name).get(index) for name in OF_ELEMENTS)

    def give_node_mass(self, number: int, values: Numbers) -> None:
        """Give a node the numbers of XM; see `Properties`.

        Raises:
            ModelError: there are too many numbers, or one is not finite; nothing has changed.
        """
        _require_numbers("node_mass", values, "mass")
        self.node_mass[number] = values

    @property
    def loaded(self) -> list[int]:
        """Numbers of the nodes that bear a load."""
        both = (*self.force.items(), *self.increment.items())
        return list(dict.fromkeys(number for number, load in both if any(load)))

    def deformations_of(self, index: int) -> int:
        """How many deformations an element has, a rigid one counted as a beam."""
        return sum(c != Class.NONE for c in self.classes[index])

    def is_rigid(self, index: int) -> bool:
        """Whether an element is a rigid link: a beam or link that holds everything."""
        if int(member_table()[self.kinds[index]]) not in (Member.BEAM, Member.LINK):
            return False
        return all(value in (Class.NONE, Class.FIXED) for value in self.classes[index])

    @cached_property
    def _components(self) -> RigidComponents:
        return RigidComponents()

    def rigid_components(self) -> RigidComponents:
        """Points by the rigid links between them; elements that are new are added."""
        made = self._components
        for index in range(made.seen, len(self.kinds)):
            if self.is_rigid(index):
                made.add(self.slots[index])
        made.seen = len(self.kinds)
        return made

    def state_deformations(self, places: Iterable[tuple[int, int]], value: Class) -> None:
        """Note that deformations (index, number from 1) are stated to have a class.

        Raises:
            ModelError: one of them has another class; then nothing is noted.
        """
        wanted = tuple(places)
        for index, number in wanted:
            before = self.stated.get((index, number), value)
            if before != value:
                name = self.element_words(index)
                raise _conflict(f"deformation {number} of {name}", before, value)
        self.stated.update((place, value) for place in wanted)

    def set_deformation(self, index: int, number: int, value: Class) -> None:
        """Set the class of a deformation, from 1, of an element."""
        classes = list(self.classes[index])
        classes[number - 1] = value
        self.classes[index] = tuple(classes)
        if index < self._components.seen:
            del self._components

    def declare(self, index: int, numbers: Iterable[int]) -> None:
        """Make deformations (from 1) of an element independent, whatever was said of them."""
        for number in numbers:
            self.set_deformation(index, number, Class.INDEPENDENT)
            self.stated[index, number] = Class.INDEPENDENT

    def state_coordinates(self, places: Iterable[tuple[int, int]], value: Class) -> None:
        """Give coordinates (node number, axis) a class, all or none of them.

        Raises:
            ModelError: one of them has another class.
        """
        wanted = tuple(places)
        for number, axis in wanted:
            before = self.coordinate_class.get((number, axis), value)
            if before != value:
                name = coordinate_name(self.node_kind[number], axis)
                raise _conflict(f"coordinate {name} of {self.node_words(number)}", before, value)
        self.coordinate_class.update((place, value) for place in wanted)

    # Names and places -------------------------------------------------------

    def changed_names_or_places(self) -> None:
        """Forget what was found by names, numbers and places; it is found anew when asked for."""
        for table in _TABLES:
            vars(self).pop(table, None)
        self._places = None

    @cached_property
    def size(self) -> float:
        """The largest coordinate [m]."""
        return max(
            (
                abs(x)
                for number, kind in self.node_kind.items()
                if is_position(kind)
                for x in self.node_value[number][:3]
            ),
            default=0.0,
        )

    def nodes_at(self, value: Numbers) -> list[int]:
        """Numbers of the position nodes at a place, in the order they were made.

        Where there are none at exactly this place, those within 1e-9 of the model's size; the
        table of them is made anew when the model has doubled.
        """
        found = self._at_place.get(value, [])
        if found or not self.size:
            return found
        if self._places is None or self.size > 2.0 * self._places[0]:
            places = Places(self.node_kind, self.node_value, ROUNDING * self.size)
            self._places = self.size, places
        return self._places[1].near(value[:3], ROUNDING * self.size)

    @cached_property
    def _at_place(self) -> dict[Numbers, list[int]]:
        positions = (number for number, kind in self.node_kind.items() if is_position(kind))
        return grouped((self.node_value[number], number) for number in positions)

    @cached_property
    def parts_by_name(self) -> dict[str, list[int]]:
        """Indices of elements by the name of their part, ascending."""
        return grouped((part_name(self.names[index]), index) for index in sorted(self.names))

    @cached_property
    def points_by_name(self) -> dict[str, list[int]]:
        """Numbers of position nodes by their names."""
        return grouped((name, number) for number, name in self.node_names.items())

    @cached_property
    def index_by_number(self) -> dict[int, int]:
        """Index of each element by its number."""
        return {number: i for i, number in enumerate(self.numbers)}

    def shares(self, indices: list[int]) -> bool:
        """Whether elements of one part's name are those of several parts.

        Those of one part are numbered behind its name, or there is a single one.
        """
        if len(indices) < 2:
            return False
        own = {self.names[index] for index in indices}
        return len(own) < len(indices) or any(name == part_name(name) for name in own)

    def name_node(self, number: int, name: str) -> None:
        """Name a node, or with an empty name take its name away."""
        if number in self.node_names:
            vars(self).pop("points_by_name", None)
            del self.node_names[number]
        if name := one_line(name):
            self.node_names[number] = name
            if "points_by_name" in vars(self):
                self.points_by_name.setdefault(name, []).append(number)

    def name_element(self, index: int, name: str) -> None:
        """Name an element, or with an empty name take its name away."""
        old = self.names.pop(index, None)
        made = one_line(name)
        if made:
            self.names[index] = made
        known = vars(self).get("parts_by_name")
        if known is not None and old is not None:
            known[part_name(old)].remove(index)
            if not known[part_name(old)]:
                del known[part_name(old)]
        if known is not None and made:
            insort(known.setdefault(part_name(made), []), index)

    def index_of(self, number: int) -> int:
        """Index of the element with this number.

        Raises:
            ModelError: there is none.
        """
        index = self.index_by_number.get(number)
        if index is None:
            raise model_error("no-such-element", f"there is no element {in_short(number)}")
        return index

    def element_words(self, index: int) -> str:
        """What messages call an element."""
        name = self.names.get(index)
        return in_short(name) if name else f"element {self.numbers[index]}"

    def node_words(self, number: int) -> str:
        """What messages call a node."""
        name = self.node_names.get(number)
        return f"point {in_short(name)}" if name else f"node {number}"


def classes_of(deformations: int, released: tuple[int, ...]) -> tuple[int, ...]:
    """(6,) classes of an element with so many deformations, all held but those released."""
    return tuple(
        0 if k > deformations else int(Class.DEPENDENT if k in released else Class.FIXED)
        for k in range(1, 7)
    )


def _require_numbers(name: str, values: Numbers, what: str) -> None:
    if not 1 <= len(values) <= NUMBERS[name]:
        raise model_error(
            "bad-number", f"a {what} is 1 to {NUMBERS[name]} numbers, not {len(values)}"
        )
    if not all(map(math.isfinite, values)):
        raise model_error("bad-number", f"a number of the {what} is not finite")


def _conflict(what: str, before: int, now: int) -> ModelError:
    words = f"{_CLASS_WORDS[Class(before)]} and {_CLASS_WORDS[Class(now)]}"
    return model_error(
        "class-conflict",
        f"{what} is given two classes: {words}",
        "keep one of the two, or name other components",
    )
