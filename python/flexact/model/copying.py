# SPDX-License-Identifier: BSD-3-Clause
"""Copies of parts, within a draft or from one to another: moved, turned or mirrored."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import partial
from itertools import zip_longest

from ..core.elements import AXES, NodeKind, is_position
from .draft import Draft, Vector
from .loads_draft import LoadsDraft
from .model_places import Places
from .selection import pivot, whole_point
from .transform import Transform
from .turning import axes_of, check_axes, check_classes, vector


@dataclass
class Copy:
    """A copy that was made: numbers of nodes and indices of elements, old to new.

    Elements that came to lie on themselves are their own copies.
    """

    nodes: dict[int, int] = field(default_factory=dict)
    elements: dict[int, int] = field(default_factory=dict)


class Copying:
    """Copies of chosen elements of a draft into a draft, as many as are asked for.

    Args:
        source: Where they are.
        indices: The elements; their nodes are copied with them.
        further: Numbers of nodes besides those of the elements.
        target: Where they go; may be the source.
        tolerance: Within which points at one place are joined [m]; None joins none.
    """

    def __init__(
        self,
        source: Draft,
        indices: list[int],
        further: Iterable[int],
        target: Draft,
        tolerance: float | None,
    ) -> None:
        """Note what there is to be copied, with its classes, masses and loads."""
        self.source, self.target = source, target
        self.indices = indices
        self.nodes = _nodes_of(source, indices, further)
        self._places = None if tolerance is None else Places(target, tolerance)
        self._own = {_ends(source, i): i for i in indices} if source is target else {}
        chosen, nodes = set(indices), set(self.nodes)
        self._stated = [(at, value) for at, value in source.stated.items() if at[0] in chosen]
        self._axes = {n: axes_of(source, n) for n in self.nodes}
        self._named = {place for place in source.named if place[0] in nodes}
        self._whole = [both for both in dict.fromkeys(source.whole) if nodes.issuperset(both)]
        self._mass = {
            n: source.properties.node_mass[n]
            for n in self.nodes
            if n in source.properties.node_mass
        }
        self._loads = source.loads.on(self.nodes)

    def run(self, move: Transform) -> Copy:
        """Make one copy.

        Raises:
            ModelError: a class of single coordinates has no image along the axes.
        """
        shared = self.source is self.target and self._places is not None
        check_classes(self.source, self.nodes, move, shared)
        check_axes(self.source, self.indices, move)
        made = Copy()
        taken: set[int] = set()
        for number in self.nodes:
            made.nodes[number] = self._node(number, move, made, taken)
        for index in self.indices:
            made.elements[index] = self._element(index, move, made)
        for (index, number), value in self._stated:
            if not self._is_own(index, made.elements[index]):
                self.target.stated[made.elements[index], number] = value
        self._give_classes(move, made)
        return made

    def _is_own(self, old: int, new: int) -> bool:
        return self.source is self.target and old == new

    def _node(self, number: int, move: Transform, made: Copy, taken: set[int]) -> int:
        source, target = self.source, self.target
        kind, value = source.node_kind[number], source.node_value[number]
        if not is_position(kind):
            return _copy_orientation(source, number, target, move, made)
        x, y, z = move.place((value[0], value[1], value[2]))
        near = [] if self._places is None else self._places.near((x, y, z))
        free = [n for n in near if n not in taken and target.node_kind[n] == kind]
        if free:
            itself = source is target and number in free
            new = number if itself else free[0]
            taken.add(new)
            return new
        new = target.add_node(kind, (x, y, z, 0.0))
        if self._places is not None:
            self._places.add(new)
            taken.add(new)
        return new

    def _element(self, index: int, move: Transform, made: Copy) -> int:
        source, target = self.source, self.target
        slots = tuple(made.nodes.get(n, 0) for n in source.slots[index])
        image = (slots[0], slots[1], slots[2], slots[3])
        same = self._own.get(_ends_of(source.kinds[index], image))
        if same is not None:
            return same
        new = len(target.kinds)
        turned = vector(source, index, move)
        target.append_element(source.kinds[index], image, turned, source.classes[index])
        if index in source.rigid:
            target.rigid.add(new)
        said = source.appearance.said.get(index)
        if said:
            target.appearance.give([new], said)
        target.give_properties(
            new, source.properties.stiffness.get(index), source.properties.mass.get(index)
        )
        return new

    def _give_classes(self, move: Transform, made: Copy) -> None:
        """Classes, masses and loads of nodes that did not come to lie on themselves."""
        target = self.target
        for number, given in self._axes.items():
            new = made.nodes[number]
            if self._is_own(number, new):
                continue
            for value, axes in given.items():
                image = move.axes(axes)
                places = [(new, k) for k in image or () if k in AXES[target.node_kind[new]]]
                target.state_coordinates(places, value)
                if any((number, k) in self._named for k in axes):
                    target.named.update(places)
        foreign = {n: new for n, new in made.nodes.items() if not self._is_own(n, new)}
        for number, mass in self._mass.items():
            if number in foreign:
                new = foreign[number]
                moved = _turned_mass(self.source, number, mass, move)
                there = target.properties.node_mass.get(new, ())
                target.give_node_mass(
                    new, tuple(a + b for a, b in zip_longest(there, moved, fillvalue=0.0))
                )
        target.loads.add(self._loads, foreign, partial(_turned_load, self.source, move))
        for p, o in self._whole:
            both = made.nodes[p], made.nodes[o]
            if both != (p, o) or self.source is not target:
                target.whole.append(both)


def _nodes_of(source: Draft, chosen: list[int], further: Iterable[int]) -> list[int]:
    """Numbers of the nodes of elements, with both nodes of each point; positions first."""
    found = dict.fromkeys(n for index in chosen for n in source.slots[index] if n)
    for number in list(found):
        if number in source.position_of:
            found[source.position_of[number]] = None
    found.update(dict.fromkeys(further))
    for number in list(found):
        if number in source.orientation_at:
            found[source.orientation_at[number]] = None
    return sorted(found, key=lambda n: (not is_position(source.node_kind[n]), n))


def _copy_orientation(
    source: Draft, number: int, target: Draft, move: Transform, made: Copy
) -> int:
    at = source.position_of.get(number, 0)
    there = made.nodes.get(at, 0)
    if there == at and source is target and at:
        return number
    first = source.orientation_at.get(at) == number
    target_last = target.last_node
    if first:
        new = whole_point(target, there).orientation
    elif there:
        new = pivot(target, there).orientation
    else:
        new = target.add_orientation()
    if source.node_kind[number] == NodeKind.ORIENTATION and new > target_last:
        target.node_value[new] = move.euler(source.node_value[number])
    return new


def _ends(draft: Draft, index: int) -> tuple[int, frozenset[tuple[int, int]]]:
    return _ends_of(draft.kinds[index], draft.slots[index])


def _ends_of(kind: int, slots: tuple[int, int, int, int]) -> tuple[int, frozenset[tuple[int, int]]]:
    return kind, frozenset((slots[:2], slots[2:]))


def _turned_mass(
    draft: Draft, number: int, mass: tuple[float, ...], move: Transform
) -> tuple[float, ...]:
    """Numbers of XM after a move; of an orientation all of them, since they mix."""
    if draft.node_kind[number] != NodeKind.ORIENTATION:
        return mass
    return move.inertia((*mass, *(0.0,) * (6 - len(mass))))


def _turned_load(draft: Draft, move: Transform, number: int, load: Vector) -> Vector:
    return move.turned(load) if is_position(draft.node_kind[number]) else move.turned_axially(load)


def turn(draft: Draft, move: Transform) -> None:
    """Turn all that there is.

    Raises:
        ModelError: a class of single coordinates is not along the axes any more.
    """
    check_classes(draft, draft.node_kind, move)
    check_axes(draft, range(len(draft.kinds)), move)
    draft.vectors = [vector(draft, index, move) for index in range(len(draft.kinds))]
    classes: dict[tuple[int, int], int] = {}
    for number, kind in draft.node_kind.items():
        for given, axes in axes_of(draft, number).items():
            classes.update({(number, k): int(given) for k in move.axes(axes) or ()})
        value = draft.node_value[number]
        if is_position(kind):
            draft.node_value[number] = (*move.place((value[0], value[1], value[2])), 0.0)
        elif kind == NodeKind.ORIENTATION:
            draft.node_value[number] = move.euler(value)
        if mass := draft.properties.node_mass.get(number):
            draft.properties.node_mass[number] = _turned_mass(draft, number, mass, move)
    everything = {number: number for number in draft.node_kind}
    loads, draft.loads = draft.loads, LoadsDraft()
    draft.loads.gravity = loads.gravity
    draft.loads.add(loads, everything, partial(_turned_load, draft, move))
    single = {number for number, _ in draft.named}
    draft.named = {place for place in classes if place[0] in single}
    draft.coordinate_class = classes
    draft.changed_names_or_places()
