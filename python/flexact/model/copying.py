# SPDX-License-Identifier: BSD-3-Clause
"""Copies of parts, within a draft or from one to another: moved, turned or mirrored."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from dataclasses import dataclass, field

from ..core.elements import AXES, Class, NodeKind, Role, element_kinds, is_position
from ..core.elements import Vector as StatedVector
from ..diagnostics.errors import model_error
from .arguments import unit
from .draft import NO_VECTOR, Draft, Vector
from .point_arguments import is_rigid, pivot, whole_point
from .sheet_geometry import normal_to
from .transform import Transform

#: Of the size of a model: points nearer than this are at one place.
ROUNDING = 1.0e-9


@dataclass
class Copy:
    """A copy that was made: numbers of nodes and indices of elements, old to new.

    Elements that came to lie on themselves are their own copies.
    """

    nodes: dict[int, int] = field(default_factory=dict)
    elements: dict[int, int] = field(default_factory=dict)


class Places:
    """Position nodes of a draft by their places, within a tolerance [m]."""

    def __init__(self, draft: Draft, tolerance: float) -> None:
        """Of all position nodes that there are now."""
        self._draft = draft
        self._tolerance = tolerance
        self._cells: dict[tuple[int, ...], list[int]] = {}
        for number, kind in draft.node_kind.items():
            if is_position(kind):
                self._cells.setdefault(self._cell(draft.node_value[number]), []).append(number)

    def _cell(self, place: Iterable[float]) -> tuple[int, ...]:
        size = 4.0 * self._tolerance or 1.0
        return tuple(round(x / size) for x in itertools.islice(place, 3))

    def near(self, place: Vector) -> list[int]:
        """Numbers of the nodes at a place, in the order they were made."""
        cell = self._cell(place)
        found = []
        for offset in itertools.product((-1, 0, 1), repeat=3):
            key = tuple(a + b for a, b in zip(cell, offset, strict=True))
            for number in self._cells.get(key, []):
                value = self._draft.node_value[number]
                if all(abs(value[k] - place[k]) <= self._tolerance for k in range(3)):
                    found.append(number)
        return sorted(found)


def size_of(draft: Draft) -> float:
    """The largest coordinate of a draft [m]."""
    return max(
        (
            abs(x)
            for number, kind in draft.node_kind.items()
            if is_position(kind)
            for x in draft.node_value[number][:3]
        ),
        default=0.0,
    )


def copy_parts(
    source: Draft,
    indices: list[int],
    further: Iterable[int],
    target: Draft,
    move: Transform,
    tolerance: float | None,
) -> Copy:
    """Copy elements and nodes of a draft into a draft.

    Args:
        source: Where they are.
        indices: The elements; their nodes are copied with them.
        further: Numbers of nodes besides those of the elements.
        target: Where they go; may be the source.
        move: What is done to them.
        tolerance: Within which points at one place are joined [m]; None joins none.

    Raises:
        ModelError: a class of single coordinates has no image along the axes.
    """
    nodes = _nodes_of(source, indices, further)
    made = Copy()
    _check_classes(source, nodes, move)
    _check_axes(source, indices, move)
    _copy_nodes(source, nodes, target, move, tolerance, made)
    _copy_elements(source, indices, target, move, made)
    _copy_classes(source, nodes, target, move, made)
    return made


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


def _copy_nodes(
    source: Draft,
    nodes: list[int],
    target: Draft,
    move: Transform,
    tolerance: float | None,
    made: Copy,
) -> None:
    places = None if tolerance is None else Places(target, tolerance)
    taken: set[int] = set()
    for number in nodes:
        kind, value = source.node_kind[number], source.node_value[number]
        if is_position(kind):
            x, y, z = move.place((value[0], value[1], value[2]))
            near = [] if places is None else places.near((x, y, z))
            free = [n for n in near if n not in taken and target.node_kind[n] == kind]
            itself = source is target and number in free
            if free:
                new = number if itself else free[0]
                taken.add(new)
            else:
                new = target.add_node(kind, (x, y, z, 0.0))
        else:
            new = _copy_orientation(source, number, target, move, made)
        made.nodes[number] = new


def _copy_orientation(
    source: Draft, number: int, target: Draft, move: Transform, made: Copy
) -> int:
    at = source.position_of.get(number, 0)
    there = made.nodes.get(at, 0)
    if there == at and source is target and at:
        return number
    first = source.orientation_at.get(at) == number
    if first:
        new = whole_point(target, there).orientation
    elif there:
        new = pivot(target, there).orientation
    else:
        new = target.add_orientation()
    if source.node_kind[number] == NodeKind.ORIENTATION and new > max(made.nodes.values()):
        target.node_value[new] = move.euler(source.node_value[number])
    return new


def _copy_elements(
    source: Draft, chosen: list[int], target: Draft, move: Transform, made: Copy
) -> None:
    own = {_ends(source, index): index for index in chosen} if source is target else {}
    for index in chosen:
        slots = tuple(made.nodes.get(n, 0) for n in source.slots[index])
        image = (slots[0], slots[1], slots[2], slots[3])
        same = own.get(_ends_of(source.kinds[index], image))
        if same is not None:
            made.elements[index] = same
            continue
        new = len(target.kinds)
        target.append_element(
            source.kinds[index], image, _vector(source, index, move), source.classes[index]
        )
        made.elements[index] = new
        if index in source.rigid:
            target.rigid.add(new)
        said = source.appearance.said.get(index)
        if said:
            target.appearance.give([new], said)
        target.give_properties(
            new, source.properties.stiffness.get(index), source.properties.mass.get(index)
        )
    elements = made.elements
    for (index, number), value in list(source.stated.items()):
        if index in elements and (source is not target or elements[index] != index):
            target.stated[elements[index], number] = value


def _ends(draft: Draft, index: int) -> tuple[int, frozenset[tuple[int, int]]]:
    return _ends_of(draft.kinds[index], draft.slots[index])


def _ends_of(kind: int, slots: tuple[int, int, int, int]) -> tuple[int, frozenset[tuple[int, int]]]:
    return kind, frozenset((slots[:2], slots[2:]))


def _vector(source: Draft, index: int, move: Transform) -> Vector:
    """The vector of an element's image; one that had none gets the image of its default."""
    given = source.vectors[index]
    kind = element_kinds()[source.kinds[index] - 1]
    optional = kind.vector == StatedVector.OPTIONAL
    if given == NO_VECTOR and optional and not source.planar and not is_rigid(source, index):
        p, _, q, _ = source.slots[index]
        a, b = source.node_value[p], source.node_value[q]
        given = _default((b[0] - a[0], b[1] - a[1], b[2] - a[2]))
    return given if given == NO_VECTOR else move.turned(given)


def _default(along: Vector) -> Vector:
    """The global axis along which a direction is smallest, from which a frame is made."""
    parts = unit(along)
    least = min(range(3), key=lambda k: abs(parts[k]))
    x, y, z = (float(k == least) for k in range(3))
    return x, y, z


#: What an element with an axis does across it, in a frame that no statement gives.
_ACROSS = ((Role.TILT_Y, Role.TILT_Z), (Role.OFFSET_Y, Role.OFFSET_Z))


def _check_axes(source: Draft, indices: Iterable[int], move: Transform) -> None:
    """Raise where a joint does different things across its axis, which do not turn with it."""
    for index in indices:
        kind = element_kinds()[source.kinds[index] - 1]
        if kind.vector != StatedVector.REQUIRED:
            continue
        classes = dict(zip(kind.role, source.classes[index], strict=True))
        axis = source.vectors[index]
        alike = all(classes.get(a) == classes.get(b) for a, b in _ACROSS)
        if (
            alike
            or normal_to(move.turned(_default(axis)), _default(move.turned(axis))) == NO_VECTOR
        ):
            continue
        raise model_error(
            "turned-class",
            f"{source.element_words(index)} has classes across its axis that would not turn",
            "copy first and give the classes afterwards",
        )


def _check_classes(source: Draft, nodes: Iterable[int], move: Transform) -> None:
    for number in nodes:
        for value, axes in _axes_of(source, number).items():
            if move.axes(axes) is None:
                here = _place(source, number)
                if math.dist(move.place(here), here) > ROUNDING * math.hypot(*here):
                    raise model_error(
                        "turned-class",
                        f"{source.node_words(number)} has {value.name.lower()} coordinates that "
                        "are not along x, y or z any more in the copy",
                        "copy first and give the class afterwards",
                    )


def _place(source: Draft, number: int) -> Vector:
    position = source.position_of.get(number, number)
    x, y, z = source.node_value[position][:3]
    return x, y, z


def _axes_of(source: Draft, number: int) -> dict[Class, set[int]]:
    """Axes of a node by the classes that they were given."""
    found: dict[Class, set[int]] = {}
    axes = AXES[source.node_kind[number]]
    for axis in axes:
        value = source.coordinate_class.get((number, axis))
        if value is not None:
            found.setdefault(Class(value), set()).add(axis)
    return found


def _copy_classes(
    source: Draft, nodes: list[int], target: Draft, move: Transform, made: Copy
) -> None:
    """Classes and masses of nodes that did not come to lie on themselves."""
    for number in nodes:
        new = made.nodes[number]
        if source is target and new == number:
            continue
        for value, axes in _axes_of(source, number).items():
            image = move.axes(axes)
            places = [(new, k) for k in image or () if k in AXES[target.node_kind[new]]]
            target.state_coordinates(places, value)
            if any((number, k) in source.named for k in axes):
                target.named.update(places)
        mass = source.properties.node_mass.get(number)
        if mass:
            moved = move.inertia(mass) if len(mass) == 6 else mass
            there = target.properties.node_mass.get(new, (0.0,) * len(moved))
            target.give_node_mass(new, tuple(a + b for a, b in zip(there, moved, strict=True)))
    for p, o in list(source.whole):
        if p in made.nodes and o in made.nodes:
            both = made.nodes[p], made.nodes[o]
            if both not in target.whole:
                target.whole.append(both)


def turn(draft: Draft, move: Transform) -> None:
    """Turn all that there is.

    Raises:
        ModelError: a class of single coordinates is not along the axes any more.
    """
    _check_classes(draft, draft.node_kind, move)
    _check_axes(draft, range(len(draft.kinds)), move)
    draft.vectors = [_vector(draft, index, move) for index in range(len(draft.kinds))]
    classes: dict[tuple[int, int], int] = {}
    for number, kind in draft.node_kind.items():
        for given, axes in _axes_of(draft, number).items():
            classes.update({(number, k): int(given) for k in move.axes(axes) or ()})
        value = draft.node_value[number]
        if is_position(kind):
            draft.node_value[number] = (*move.place((value[0], value[1], value[2])), 0.0)
        elif kind == NodeKind.ORIENTATION:
            draft.node_value[number] = move.euler(value)
        mass = draft.properties.node_mass.get(number, ())
        if len(mass) == 6:
            draft.properties.node_mass[number] = move.inertia(mass)
    single = {number for number, _ in draft.named}
    draft.named = {place for place in classes if place[0] in single}
    draft.coordinate_class = classes
    draft.changed_names_or_places()
