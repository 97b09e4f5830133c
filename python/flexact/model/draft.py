# SPDX-License-Identifier: BSD-3-Clause
"""A model in the making: lists that grow, and the arrays made from them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..core.arrays import FloatArray, IntArray, model_arrays
from ..core.elements import AXES, Class, NodeKind, coordinate_name, is_position, kind_of
from ..core.raw import ElementKind
from ..deck.diagnostics import Diagnostic, Problems, Severity, Source
from ..deck.rendering import ModelError, model_error
from ..util.text import in_short
from .attributes import NUMBERS, Appearance, Loads, Properties
from .data import ModelData
from .handles import Owner
from .places import Lookup

Colour = tuple[float, float, float]

#: What is given of an element, and how many.
_NUMBERS: dict[str, tuple[int, ...]] = {"colour": (3,), "edge_colour": (3,), "opacity": ()}


class Shape(NamedTuple):
    """A cross-section: its kind and its sizes along local y and z [m]."""

    kind: int
    y: float
    z: float


#: What is said about drawing an element: shape, colour, edge_colour, opacity, drawn, each if given.
Said = dict[str, Any]


class AppearanceDraft:
    """What was said about drawing elements, by their indices."""

    def __init__(self) -> None:
        """Nothing is said yet."""
        self.said: dict[int, Said] = {}

    @classmethod
    def of(cls, appearance: Appearance) -> AppearanceDraft:
        """The draft that gives this appearance."""
        draft = cls()
        for i in np.flatnonzero(appearance.cross_section).tolist():
            sizes = appearance.dimensions[i].tolist()
            draft.give([i], {"shape": Shape(int(appearance.cross_section[i]), *sizes)})
        for name in _NUMBERS:
            values = getattr(appearance, name)
            rows = values.reshape(len(values), -1)[:, 0]
            for i in np.flatnonzero(~np.isnan(rows)).tolist():
                draft.give([i], {name: values[i].tolist()})
        draft.give(np.flatnonzero(~appearance.drawn).tolist(), {"drawn": False})
        return draft

    def give(self, indices: Iterable[int], said: Said) -> None:
        """Say something about elements; what is not said now stays as it was."""
        if said:
            for i in indices:
                self.said.setdefault(i, {}).update(said)

    def freeze(self, elements: int) -> Appearance | None:
        """The appearance of this number of elements; None where nothing is said."""
        if all(said == {"drawn": True} for said in self.said.values()):
            return None
        shapes, drawn = np.zeros((elements, 3)), np.ones(elements, bool)
        numbers = {name: np.full((elements, *size), np.nan) for name, size in _NUMBERS.items()}
        for i, said in self.said.items():
            shapes[i] = said.get("shape", 0.0)
            drawn[i] = said.get("drawn", True)
            for name in said.keys() & _NUMBERS.keys():
                numbers[name][i] = said[name]
        kinds = shapes[:, 0].astype(np.int32)
        return Appearance(kinds, shapes[:, 1:].copy(), **numbers, drawn=drawn)


_Load = tuple[float, float, float]
_NONE: _Load = (0.0, 0.0, 0.0)


class LoadsDraft:
    """What was said about loads, by numbers of nodes; x, y, z of each, zero where not given."""

    def __init__(self) -> None:
        """Nothing is said yet."""
        self.force: dict[int, _Load] = {}
        self.increment: dict[int, _Load] = {}
        self.gravity: _Load = _NONE

    @classmethod
    def of(cls, loads: Loads, node_numbers: Sequence[int]) -> LoadsDraft:
        """The draft that gives these loads."""
        draft = cls()
        draft.force = _rows(loads.force, node_numbers)
        draft.increment = _rows(loads.increment, node_numbers)
        x, y, z = loads.gravity.tolist()
        draft.gravity = x, y, z
        return draft

    @property
    def nodes(self) -> list[int]:
        """Numbers of the nodes that bear something."""
        both = (*self.force.items(), *self.increment.items())
        return list(dict.fromkeys(number for number, load in both if any(load)))

    def drop(self, number: int) -> None:
        """Say nothing of a node any more."""
        self.force.pop(number, None)
        self.increment.pop(number, None)

    def on(self, numbers: Iterable[int]) -> LoadsDraft:
        """The loads on some nodes, without gravity."""
        chosen, made = set(numbers), LoadsDraft()
        made.force = {n: load for n, load in self.force.items() if n in chosen}
        made.increment = {n: load for n, load in self.increment.items() if n in chosen}
        return made

    def add(
        self, loads: LoadsDraft, new: Mapping[int, int], moved: Callable[[int, _Load], _Load]
    ) -> None:
        """Add the loads on nodes after a move to those that their images bear.

        Args:
            loads: Of which only those on nodes that have an image are taken.
            new: Numbers of the images.
            moved: The image of a load on a node.
        """
        for said, there in ((loads.force, self.force), (loads.increment, self.increment)):
            for number, load in said.items():
                if number in new:
                    a, b, c = there.get(new[number], _NONE)
                    x, y, z = moved(number, load)
                    there[new[number]] = (a + x, b + y, c + z)

    def freeze(self, node_numbers: Sequence[int]) -> Loads | None:
        """The loads on these nodes; None where all are zero."""
        loaded = self.nodes
        place = {number: i for i, number in enumerate(node_numbers)} if loaded else {}
        if not (any(number in place for number in loaded) or any(self.gravity)):
            return None
        rows = len(node_numbers)
        force, increment = (_table(each, place, rows) for each in (self.force, self.increment))
        return Loads(force, increment, np.array(self.gravity))


def _rows(table: FloatArray, node_numbers: Sequence[int]) -> dict[int, _Load]:
    made = {}
    for i in np.flatnonzero(table.any(axis=1)).tolist():
        x, y, z = table[i].tolist()
        made[node_numbers[i]] = (x, y, z)
    return made


def _table(said: Mapping[int, _Load], place: Mapping[int, int], rows: int) -> FloatArray:
    table = np.zeros((rows, 3))
    for number, load in said.items():
        if number in place:
            table[place[number]] = load
    return table


_Numbers = tuple[float, ...]


class PropertiesDraft:
    """What was said about stiffness and mass, by indices of elements and numbers of nodes."""

    def __init__(self) -> None:
        """Nothing is said yet."""
        self.stiffness: dict[int, _Numbers] = {}
        self.mass: dict[int, _Numbers] = {}
        self.node_mass: dict[int, _Numbers] = {}

    @classmethod
    def of(cls, properties: Properties, node_numbers: Sequence[int]) -> PropertiesDraft:
        """The draft that gives these properties."""
        draft = cls()
        draft.stiffness = dict(rows_of(properties.stiffness))
        draft.mass = dict(rows_of(properties.mass))
        draft.node_mass = {node_numbers[i]: row for i, row in rows_of(properties.node_mass)}
        return draft

    def give(self, index: int, stiffness: _Numbers | None, mass: _Numbers | None) -> None:
        """Say something about an element; what is not said now stays as it was."""
        if stiffness is not None:
            _require("stiffness", stiffness)
        if mass is not None:
            self.mass[index] = _require("mass", mass)
        if stiffness is not None:
            self.stiffness[index] = stiffness

    def give_node(self, number: int, values: _Numbers) -> None:
        """Say something about a node."""
        self.node_mass[number] = _require("node_mass", values)

    def renumber(self, new: Mapping[int, int]) -> None:
        """Give elements new indices; of those that get none nothing is said any more."""
        self.stiffness = {new[i]: row for i, row in self.stiffness.items() if i in new}
        self.mass = {new[i]: row for i, row in self.mass.items() if i in new}

    def freeze(self, elements: int, node_numbers: Sequence[int]) -> Properties | None:
        """The properties of these elements and nodes; None where nothing is said."""
        if not (self.stiffness or self.mass or self.node_mass):
            return None
        place = {number: i for i, number in enumerate(node_numbers)} if self.node_mass else {}
        at_nodes = {place[n]: row for n, row in self.node_mass.items() if n in place}
        return Properties(
            _table_of_properties_draft("stiffness", elements, self.stiffness),
            _table_of_properties_draft("mass", elements, self.mass),
            _table_of_properties_draft("node_mass", len(node_numbers), at_nodes),
        )


def rows_of(table: FloatArray) -> Iterable[tuple[int, _Numbers]]:
    """Index and numbers of each row of which something is given."""
    for i in np.flatnonzero(~np.isnan(table[:, 0])).tolist():
        yield i, tuple(value for value in table[i].tolist() if value == value)


def _table_of_properties_draft(name: str, rows: int, said: Mapping[int, _Numbers]) -> FloatArray:
    table = np.full((rows, NUMBERS[name]), np.nan)
    for i, row in said.items():
        table[i, : len(row)] = row
    return table


def _require(name: str, values: _Numbers) -> _Numbers:
    what = "mass" if name == "node_mass" else name
    if not 1 <= len(values) <= NUMBERS[name]:
        raise model_error(
            "bad-number", f"a {what} is 1 to {NUMBERS[name]} numbers, not {len(values)}"
        )
    if not all(map(math.isfinite, values)):
        raise model_error("bad-number", f"a number of the {what} is not finite")
    return values


Vector = tuple[float, float, float]

#: What the vector of an element is where none is given.
NO_VECTOR: Vector = (0.0, 0.0, 0.0)

#: Of the numbers of nodes and elements.
LARGEST = 2**31 - 1
#: Nodes that one message names.
_MOST_LISTED = 5
_CLASS_WORDS = {Class.FIXED: "fixed", Class.DEPENDENT: "released", Class.INDEPENDENT: "independent"}


class Draft(Lookup):
    """Nodes and elements as lists and dictionaries, by their numbers."""

    def __init__(self, planar: bool, owner: Owner) -> None:
        """Start without nodes or elements; `owner` is what its handles are known by."""
        super().__init__()
        self.planar = planar
        self.owner = owner
        owner.draft = self
        self.node_kind: dict[int, int] = {}
        self.node_value: dict[int, tuple[float, ...]] = {}
        #: Names of points, by the numbers of their position nodes.
        self.node_names: dict[int, str] = {}
        self.coordinate_class: dict[tuple[int, int], int] = {}
        #: Coordinates that were named one by one, so that they must exist.
        self.named: set[tuple[int, int]] = set()
        #: Nodes whose classes were given as a whole; one of the two must exist.
        self.whole: list[tuple[int, int]] = []
        self.kinds: list[int] = []
        self.numbers: list[int] = []
        self.slots: list[tuple[int, int, int, int]] = []
        self.vectors: list[Vector] = []
        self.classes: list[tuple[int, ...]] = []
        self.appearance = AppearanceDraft()
        self.properties = PropertiesDraft()
        self.loads = LoadsDraft()
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
        #: The first orientation of each point by its position node, and the other way round.
        self.orientation_at: dict[int, int] = {}
        self.position_of: dict[int, int] = {}

    @classmethod
    def of(cls, data: ModelData, owner: Owner) -> Draft:
        """The draft that gives the same arrays."""
        draft = cls(data.planar, owner)
        a = data.arrays
        numbers = a.node_number.tolist()
        draft.node_kind = dict(zip(numbers, a.node_kind.tolist(), strict=True))
        draft.node_value = dict(zip(numbers, map(tuple, a.node_value.T.tolist()), strict=True))
        for axis, node in np.argwhere(
            (a.coordinate_class != Class.NONE) & (a.coordinate_class != Class.DEPENDENT)
        ).tolist():
            key = numbers[node], axis
            draft.coordinate_class[key] = int(a.coordinate_class[axis, node])
        with_zero = np.concatenate([np.zeros(1, np.int32), a.node_number])
        draft.kinds = a.element_kind.tolist()
        draft.numbers = a.element_number.tolist()
        draft.slots = list(map(tuple, with_zero[a.element_node].T.tolist()))
        draft.vectors = list(map(tuple, a.element_vector.T.tolist()))
        draft.classes = list(map(tuple, a.deformation_class.T.tolist()))
        draft.names = {i: name for i, name in enumerate(data.element_names) if name}
        draft.node_names = {
            number: name for number, name in zip(numbers, data.node_names, strict=True) if name
        }
        if data.properties is not None:
            draft.properties = PropertiesDraft.of(data.properties, numbers)
        if data.loads is not None:
            draft.loads = LoadsDraft.of(data.loads, numbers)
        if data.given_appearance is not None:
            draft.appearance = AppearanceDraft.of(data.given_appearance)
        draft.has_long_numbers = data.has_long_numbers
        draft.began_as = data.source or data.began_as
        draft.elements_given = len(draft.kinds)
        draft.last_node = max(numbers, default=0)
        draft.last_element = max(draft.numbers, default=0)
        # Of several orientations at a place that with the lowest number was made with it.
        ends = [end for p, op, q, oq in draft.slots for end in ((p, op), (q, oq)) if all(end)]
        for position, orientation in sorted(ends, key=lambda end: end[1]):
            draft.join(position, orientation)
        return draft

    def add_node(self, kind: int, value: tuple[float, ...]) -> int:
        """Add a node and return its number."""
        number = self.last_node + 1
        if number > LARGEST:
            raise model_error("number-too-large", "the model has no node number left")
        self.last_node = number
        self.node_kind[number] = kind
        self.node_value[number] = value
        self._added_node(number)
        return number

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
        slots: tuple[int, int, int, int],
        name: str,
        vector: Vector = NO_VECTOR,
        released: Iterable[int] = (),
        shape: Shape | None = None,
    ) -> int:
        """Add an element and return its number; `released` are part of what it is.

        Raises:
            ModelError: both ends are one point, or at one place.
        """
        self.require_two_ends(slots)
        index = len(self.kinds)
        classes = _classes(kind.deformations, tuple(released))
        number = self.append_element(kind.number, slots, vector, classes)
        if name:
            self.name_element(index, name)
        if shape is not None:
            self.appearance.give([index], {"shape": shape})
        return number

    def require_two_ends(self, slots: tuple[int, int, int, int]) -> None:
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
        self, kind: int, slots: tuple[int, int, int, int], vector: Vector, classes: tuple[int, ...]
    ) -> int:
        """Add an element without a name, by the number of its kind, and return its number."""
        number = self.last_element + 1
        if number > LARGEST:
            raise model_error("number-too-large", "the model has no element number left")
        self.last_element = number
        self.numbers.append(number)
        self.kinds.append(kind)
        self.slots.append(slots)
        self.vectors.append(vector)
        self.classes.append(classes)
        self._added_element(len(self.kinds) - 1)
        return number

    def give_properties(
        self,
        index: int,
        stiffness: tuple[float, ...] | None = None,
        mass: tuple[float, ...] | None = None,
    ) -> None:
        """Give an element the numbers of ESTIFF, of EM, or of both; see `Properties`.

        What is not given stays as it was.

        Raises:
            ModelError: there are too many numbers, or one is not finite; nothing has changed.
        """
        self.properties.give(index, stiffness, mass)

    def give_node_mass(self, number: int, values: tuple[float, ...]) -> None:
        """Give a node the numbers of XM; see `Properties`.

        Raises:
            ModelError: there are too many numbers, or one is not finite; nothing has changed.
        """
        self.properties.give_node(number, values)

    def deformations_of(self, index: int) -> int:
        """How many deformations an element has, a rigid one counted as a beam."""
        return sum(c != Class.NONE for c in self.classes[index])

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
        if self.components is not None and index < self.components.seen:
            self.components = None

    def declare(self, index: int, numbers: Iterable[int]) -> None:
        """Make deformations (from 1) of an element independent, whatever was said of them."""
        classes = list(self.classes[index])
        for number in numbers:
            classes[number - 1] = Class.INDEPENDENT
            self.stated[index, number] = Class.INDEPENDENT
        self.classes[index] = tuple(classes)

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

    def freeze(self, name: str) -> ModelData:
        """The model as it is now, with an error for each class of a node that nobody uses."""
        kinds, slots, classes = self._decided()
        used = np.unique(slots[slots > 0])
        numbers = used.tolist()
        node_kind = np.array([self.node_kind[n] for n in numbers], np.int32)
        value = np.array([self.node_value[n] for n in numbers], np.float64).reshape(-1, 4)
        arrays = model_arrays(
            node_number=used,
            node_kind=node_kind,
            node_value=value.T,
            coordinate_class=self._coordinate_classes(used, node_kind),
            element_number=np.array(self.numbers, np.int64),
            element_kind=kinds,
            element_node=np.where(slots > 0, np.searchsorted(used, slots) + 1, 0).T,
            element_vector=np.array(self.vectors, np.float64).reshape(-1, 3).T,
            deformation_class=classes.T,
        )
        names = tuple(self.names.get(i, "") for i in range(len(self.kinds)))
        node_names = tuple(self.node_names.get(n, "") for n in numbers) if self.node_names else ()
        in_use = set(numbers)
        in_vain = self._given_in_vain(in_use)
        return ModelData(
            arrays,
            self.planar,
            name,
            names,
            node_names,
            found=self._wrong(in_vain),
            besides=(*self._left_over(in_use), *self._same_names()),
            given_appearance=self.appearance.freeze(len(self.kinds)),
            properties=self.properties.freeze(len(self.kinds), numbers),
            loads=self.loads.freeze(numbers),
            has_long_numbers=self.has_long_numbers,
            began_as=self.began_as,
            called=frozenset(at for at, given in self.stated.items() if given == Class.DEPENDENT),
        )

    def _wrong(self, in_vain: Sequence[int]) -> Problems | None:
        wrong = [_unused(self.node_words(number)) for number in in_vain]
        return Problems.of(wrong) if wrong else None

    def _decided(self) -> tuple[IntArray, IntArray, IntArray]:
        """Kinds, slots and classes, with the kind of every rigid element decided.

        A rigid element is an RBEAM unless somebody needs the orientation of its
        far end, which may have been given a class, as one of its deformations may.
        """
        kinds = np.array(self.kinds, np.int32)
        slots = np.array(self.slots, np.int64).reshape(-1, 4).astype(np.int32)
        classes = np.array(self.classes, np.int32).reshape(-1, 6)
        if not self.rigid:
            return kinds, slots, classes
        rigid = np.zeros(kinds.size, bool)
        rigid[list(self.rigid)] = True
        needed = set(slots[~rigid][:, (1, 3)].ravel().tolist())
        # One that is fixed or declared holds or drives the body, also where its whole point is.
        needed.update(slots[rigid, 1].tolist(), (number for number, _ in self.coordinate_class))
        needed.update(self.loads.nodes)
        # Two links that end at one point carry it both, so that they are one body.
        far, times = np.unique(slots[rigid, 3], return_counts=True)
        needed.update(far[times > 1].tolist())
        stated = {index for index, _ in self.stated}
        short = kind_of("PLRBEAM" if self.planar else "RBEAM")
        for index in self.rigid:
            if slots[index, 3] not in needed and index not in stated:
                kinds[index] = short.number
                slots[index, 3] = 0
                classes[index] = _classes(short.deformations, ())
        return kinds, slots, classes

    def _coordinate_classes(self, used: IntArray, node_kind: IntArray) -> IntArray:
        of_kind = np.zeros((len(NodeKind) + 1, 3), np.int32)
        for kind, axes in AXES.items():
            of_kind[kind, list(axes)] = Class.DEPENDENT
        classes = of_kind[node_kind].reshape(-1, 3)
        if self.coordinate_class and used.size:
            stated = np.array(list(self.coordinate_class), np.int64)
            values = np.array(list(self.coordinate_class.values()), np.int32)
            place = np.minimum(np.searchsorted(used, stated[:, 0]), used.size - 1)
            there = used[place] == stated[:, 0]
            classes[place[there], stated[there, 1]] = values[there]
        return classes.T

    def _left_over(self, used: set[int]) -> Iterator[Diagnostic]:
        """Warnings about points, masses and loads that nothing uses."""
        points = [
            number
            for number, kind in self.node_kind.items()
            if is_position(kind) and used.isdisjoint((number, self.orientation_at.get(number)))
        ]
        if points:
            yield _warning_of_unused(
                f"no element uses {self._listed(points)}", "join it to something, or leave it out"
            )
        if masses := [number for number in self.properties.node_mass if number not in used]:
            yield _warning_of_unused(
                f"{self._listed(masses)} is given a mass, but no element uses it",
                "give it to a node that an element uses",
            )
        if loads := [number for number in self.loads.nodes if number not in used]:
            yield _warning_of_unused(
                f"{self._listed(loads)} is given a load, but no element uses it",
                "give it to a node that an element uses",
            )

    def _same_names(self) -> Iterator[Diagnostic]:
        """Warnings about parts of one name that hang together, so that the core sees one part.

        Names in a deck are comments of its lines, which may be alike; twins are told as such.
        """
        for name, found in self.parts_by_name.items():
            twins = len({self.slots[index] for index in found}) < len(found)
            if found[-1] < self.elements_given or twins or not self.shares(found):
                continue
            if self._is_one(found):
                yield Diagnostic(
                    Severity.WARNING,
                    "repeated-name",
                    f"several parts that hang together are called {in_short(name)}",
                    help="give each a name of its own: this one finds none of them",
                )

    def _is_one(self, indices: Sequence[int]) -> bool:
        """Whether elements hang together by their nodes."""
        left, nodes = list(indices[1:]), {*self.slots[indices[0]]} - {0}
        grown = True
        while left and grown:
            near = [index for index in left if not nodes.isdisjoint(self.slots[index])]
            grown = bool(near)
            nodes.update(node for index in near for node in self.slots[index] if node)
            left = [index for index in left if index not in near]
        return not left

    def _listed(self, numbers: Sequence[int]) -> str:
        """Nodes by name, or by number where they have none; of many the first."""
        words = [
            f"'{self.node_names[number]}'" if number in self.node_names else f"node {number}"
            for number in numbers[:_MOST_LISTED]
        ]
        more = len(numbers) - _MOST_LISTED
        return ", ".join(words) + (f" and {more} more" if more > 0 else "")

    def _given_in_vain(self, used: set[int]) -> list[int]:
        """Nodes that were given a class and are not in use."""
        vain = {number for number, _ in self.named if number not in used}
        for position, orientation in self.whole:
            if position not in used and orientation not in used:
                vain.add(position)
        return sorted(vain)


def _classes(deformations: int, released: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(
        0 if k > deformations else int(Class.DEPENDENT if k in released else Class.FIXED)
        for k in range(1, 7)
    )


def _conflict(what: str, before: int, now: int) -> ModelError:
    words = f"{_CLASS_WORDS[Class(before)]} and {_CLASS_WORDS[Class(now)]}"
    return model_error(
        "class-conflict",
        f"{what} is given two classes: {words}",
        "keep one of the two, or name other components",
    )


def _warning_of_unused(message: str, hint: str) -> Diagnostic:
    return Diagnostic(Severity.WARNING, "unused-node", message, help=hint)


def _unused(node: str) -> Diagnostic:
    return Diagnostic(
        Severity.ERROR,
        "no-such-node",
        f"{node} is given a class, but no element uses it",
        help="name the node in an element, or leave its class out",
    )
