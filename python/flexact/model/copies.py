# SPDX-License-Identifier: BSD-3-Clause
"""Copies of parts, within a draft or from one to another: moved, turned or mirrored."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from copy import copy
from itertools import zip_longest

from ..core.elements import AXES, Class, NodeKind, Role, element_kinds, is_position
from ..core.elements import Vector as StatedVector
from ..deck.rendering import ModelError, model_error
from ..util.groups import grouped
from ..util.quantities import Quantity
from ..util.text import in_short
from .arguments import (
    Direction,
    PartLike,
    Point,
    angle,
    coordinates,
    count,
    direction,
    drawn_elements,
    existing,
    numbers_of_size,
    of_indices,
    pivot,
    place,
    several,
    text,
    whole_point,
)
from .draft import ROUNDING, Draft, Places, Slots
from .handles import Assembly, Body, Element, FoldedSheet, Named, Node, Part
from .names import part_name
from .transform import (
    IDENTITY,
    NO_VECTOR,
    Transform,
    Vector,
    cross,
    reflection,
    rotation,
    unit,
)

#: How names of copies are made: "upper {}" or "{} {}", with the number of the copy as the second;
#: words that are replaced; or a function.
Names = str | Mapping[str, str] | Callable[[str], str]
Parts = Iterable[PartLike | FoldedSheet | Assembly]
#: A copy that was made: numbers of nodes and indices of elements, old to new. Elements that came
#: to lie on themselves are their own copies.
Copy = tuple[dict[int, int], dict[int, int]]

_MOST_COPIES = 100_000
_PLANES = {"xy": "z", "yx": "z", "yz": "x", "zy": "x", "zx": "y", "xz": "y"}


def frame(draft: Draft, at: Point, axis: Direction, degrees: Quantity) -> Transform:
    """A frame, given in the one at hand by its origin and an axis about which it is turned."""
    turned = rotation(_axis(draft, axis), angle(degrees), NO_VECTOR)
    if draft.frame is not None:
        turned = turned.after(draft.frame)
    return turned._replace(shift=_place(draft, at))


def insert(
    target: Draft,
    source: Draft,
    at: Point,
    axis: Direction,
    degrees: Quantity,
    names: Names | None,
    join: bool | Quantity,
) -> Assembly:
    """Put a copy of another model into this one, turned about its origin and then moved."""
    if source.planar != target.planar:
        raise model_error("two-kinds-of-model", "one of the models is planar and the other is not")
    move = frame(target, at, axis, degrees)
    (made,) = _copies(source, _chosen(source, None), target, [move], names, join)
    return _assembly(source, target, made)


def pattern(
    draft: Draft,
    n: int,
    axis: Direction,
    at: Point,
    degrees: Quantity | None,
    step: Sequence[Quantity] | None,
    parts: Parts | None,
    names: Names | None,
    join: bool | Quantity,
) -> tuple[Assembly, ...]:
    """Repeat parts n times in all, about an axis or in a row; the originals and each copy."""
    size = count(n, 1, _MOST_COPIES, "members of a pattern")
    turned = 360.0 / size if degrees is None else angle(degrees)
    centre = _place(draft, at)
    chosen = _chosen(draft, parts)
    # Of several mistakes that in the names is said before those in the moves.
    _renamer(names, 2)
    if size == 1:
        moves = []
    elif step is None:
        about = _axis(draft, axis)
        moves = [rotation(about, k * turned, centre) for k in range(1, size)]
    else:
        x, y, z = draft.turned(coordinates(draft, step))
        moves = [Transform(IDENTITY, (k * x, k * y, k * z)) for k in range(1, size)]
    originals = {n: n for n in draft.node_kind}, {i: i for i in chosen[0]}
    nodes = _nodes_of(draft, *chosen)
    made = _copies(draft, chosen, draft, moves, names, join)
    results = tuple(_assembly(draft, draft, each) for each in (originals, *made))
    if isinstance(names, str) and names.format("a", 1) != names.format("a", 2):
        _rename_originals(draft, chosen[0], nodes, made, names)
    return results


def mirror(
    draft: Draft,
    plane: Direction,
    at: Point,
    parts: Parts | None,
    names: Names | None,
    join: bool | Quantity,
) -> Assembly:
    """Add the mirror image of parts in a plane."""
    move = reflection(_normal(draft, plane), _place(draft, at))
    if draft.planar and move.matrix[2] != (0.0, 0.0, 1.0):
        raise model_error("no-coordinate", "a planar model is mirrored in a plane along z")
    (made,) = _copies(draft, _chosen(draft, parts), draft, [move], names, join)
    return _assembly(draft, draft, made)


def rotate(draft: Draft, axis: Direction, degrees: Quantity, at: Point) -> None:
    """Turn all that there is.

    Raises:
        ModelError: a class of single coordinates is not along the axes any more.
    """
    move = rotation(_axis(draft, axis), angle(degrees), _place(draft, at))
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
        if mass := draft.node_mass.get(number):
            draft.node_mass[number] = _turned_mass(draft, number, mass, move)
    loads, draft.force, draft.increment = (draft.force, draft.increment), {}, {}
    _add_loads(draft, loads, draft, {number: number for number in draft.node_kind}, move)
    single = {number for number, _ in draft.named}
    draft.named = {place for place in classes if place[0] in single}
    draft.coordinate_class = classes
    draft.changed_names_or_places()


def _axis(draft: Draft, axis: Direction) -> Vector:
    made = direction(axis, "axis")
    if draft.planar and any(made[:2]):
        raise model_error("no-coordinate", "a planar model turns about z")
    return draft.turned(made)


def _normal(draft: Draft, plane: Direction) -> Vector:
    """The normal of a plane: "xy", "yz", "zx", or its normal as a vector.

    Raises:
        ModelError: it is no plane.
    """
    if isinstance(plane, str):
        name = plane.strip().lower()
        if name not in _PLANES:
            raise model_error(
                "bad-number",
                f"a plane is xy, yz or zx, or its normal as a vector, not {in_short(plane)}",
            )
        plane = _PLANES[name]
    return draft.turned(direction(plane, "normal of the plane"))


def _place(draft: Draft, given: Point | Sequence[Quantity]) -> Vector:
    """Where a point is, or three numbers [m] in the frame at hand, or two in a plane."""
    if isinstance(given, (Node, Body, str)):
        x, y, z = draft.node_value[existing(draft, given).position][:3]
    else:
        x, y, z = place(draft, given)[:3]
    return x, y, z


def _chosen(draft: Draft, parts: Parts | None) -> tuple[list[int], list[int]]:
    """Indices of the elements that are meant, and further nodes: of all, where all is."""
    if parts is None:
        return list(range(len(draft.kinds))), list(draft.node_kind)
    chosen = several(parts, "parts")
    return list(dict.fromkeys(i for each in chosen for i in drawn_elements(draft, each))), []


def _copies(
    source: Draft,
    chosen: tuple[list[int], list[int]],
    target: Draft,
    moves: list[Transform],
    names: Names | None,
    join: bool | Quantity,
) -> list[Copy]:
    """A copy after each of some moves, with names; where one cannot be made, none is."""
    _renamer(names, 2)
    # Each name stands once in the model.
    every = (*target.names.values(), *target.node_names.values())
    taken = {_split(name)[0] for name in every}
    # Within which points are joined [m]; None where none are.
    tolerance: float | None = None
    if join is True:
        tolerance = ROUNDING * max(source.size, target.size)
    elif join is not False:
        tolerance = numbers_of_size(
            join, (1,), "join is True, False or a distance", target.units.symbol("m")
        )[0]
    copying = _Copying(source, *chosen, target, tolerance)
    made: list[Copy] = []
    with _all_or_nothing(target):
        for k, move in enumerate(moves, 2):
            made.append(copying.run(move))
            _name(source, target, made[-1], k, names, taken)
    return made


@contextmanager
def _all_or_nothing(draft: Draft) -> Iterator[None]:
    """Leave the draft as it was where an error is raised; takes time for all that there is."""
    before = {name: copy(value) for name, value in vars(draft).items()}
    try:
        yield
    except ModelError:
        vars(draft).update(before)
        draft.changed_names_or_places()
        raise


def _assembly(source: Draft, target: Draft, made: Copy) -> Assembly:
    """The handle of a copy, by the names of the originals."""
    nodes, elements = made
    groups = grouped(
        (part_name(source.names.get(index, "")), new) for index, new in elements.items()
    )
    parts: dict[str, Part | FoldedSheet | Element] = {
        name: of_indices(target, indices) for name, indices in groups.items() if name
    }
    positions = [n for n in nodes if is_position(source.node_kind[n])]
    points = {
        source.node_names[n]: whole_point(target, nodes[n])
        for n in positions
        if n in source.node_names
    }
    ground = tuple(
        whole_point(target, nodes[n])
        for n in positions
        if all(
            source.coordinate_class.get((n, axis)) == Class.FIXED
            for axis in AXES[source.node_kind[n]]
        )
    )
    return Assembly("", Named(parts), Named(points), ground)


# Names ----------------------------------------------------------------------


def _split(name: str) -> tuple[str, str]:
    """What is renamed of a name, and what stays: "sheet 1" and ", 3", "sheet" and ", leaf 1"."""
    head, comma, tail = name.partition(", ")
    return head, comma + tail


def _renamer(names: Names | None, number: int) -> Callable[[str], str]:
    """The function that makes the name of a copy.

    Raises:
        ModelError: it is none.
    """
    if names is None:
        return str
    if isinstance(names, str):
        form = names
        try:
            if form.format("a", number) == form.format("b", number):
                raise ValueError
        except (ValueError, IndexError, KeyError, AttributeError):
            raise model_error(
                "bad-name",
                f"{in_short(names)} makes no names of copies",
                'say names="upper {}", with {} for the name of the original',
            ) from None
        return lambda name: form.format(name, number)
    if isinstance(names, Mapping) and all(
        isinstance(each, str) for pair in names.items() for each in pair
    ):
        pairs = dict(names)

        def replaced(name: str) -> str:
            for old, new in pairs.items():
                name = name.replace(old, new)
            return name

        return replaced
    if not callable(names):
        raise model_error(
            "bad-name",
            f"names of copies cannot be made with {in_short(names)}",
            'say names="upper {}", {"upper": "lower"}, or give a function',
        )
    made = names
    return lambda name: text(made(name), "the name of a copy")


def _name(
    source: Draft, target: Draft, made: Copy, number: int, names: Names | None, taken: set[str]
) -> None:
    """Name what was copied; where a name is taken, " (2)" and so on is added to it."""
    rename = _renamer(names, number)
    heads: dict[str, str] = {}

    def new_name(name: str) -> str:
        head, tail = _split(name)
        if head not in heads:
            form = free = rename(head)
            k = max(number, 2)
            while free in taken:
                free = f"{form} ({k})"
                k += 1
            heads[head] = free
            taken.add(free)
        return heads[head] + tail

    nodes, elements = made
    for index, new in elements.items():
        name = source.names.get(index)
        if name and _is_of_one_body(source, target, index, new):
            _go_on_with(target, new, part_name(name))
        elif name and (source is not target or new != index):
            target.name_element(new, new_name(name))
    for old, new in nodes.items():
        name = source.node_names.get(old)
        if name and new not in target.node_names:
            target.name_node(new, new_name(name))


def _is_of_one_body(source: Draft, target: Draft, index: int, new: int) -> bool:
    """Whether a copied rigid link is carried by the body of its original."""
    if source is not target or new == index or not source.is_rigid(index):
        return False
    before, now = source.slots[index], target.slots[new]
    return bool({before[1], before[3]} & {now[1], now[3]} - {0})


def _go_on_with(draft: Draft, index: int, part: str) -> None:
    """Name an element as the last one of a part, whose elements are then numbered."""
    indices = [i for i in draft.parts_by_name.get(part, []) if i != index]
    if len(indices) == 1:
        draft.name_element(indices[0], f"{part}, 1")
    draft.name_element(index, f"{part}, {len(indices) + 1}")


def _rename_originals(
    draft: Draft, elements: list[int], nodes: list[int], made: list[Copy], names: str
) -> None:
    """Give the originals of a pattern the number 1, but for what their copies share."""
    for index in elements:
        shared = any(
            copied[index] == index or _is_of_one_body(draft, draft, index, copied[index])
            for _, copied in made
        )
        if index in draft.names and not shared:
            head, tail = _split(draft.names[index])
            draft.name_element(index, names.format(head, 1) + tail)
    for number in nodes:
        shared = any(copied[number] == number for copied, _ in made)
        if number in draft.node_names and not shared:
            head, tail = _split(draft.node_names[number])
            draft.name_node(number, names.format(head, 1) + tail)


# Nodes and elements ---------------------------------------------------------


class _Copying:
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
        further: list[int],
        target: Draft,
        tolerance: float | None,
    ) -> None:
        """Note what there is to be copied, with its classes, masses and loads."""
        self.source, self.target = source, target
        self.indices = indices
        self.nodes = _nodes_of(source, indices, further)
        self._places: Places | None = None
        if tolerance is not None:
            self._places = Places(target.node_kind, target.node_value, tolerance)
        self._own: dict[tuple[int, frozenset[tuple[int, int]]], int] = {}
        if source is target:
            self._own = {_ends(source.kinds[i], source.slots[i]): i for i in indices}
        chosen, nodes = set(indices), set(self.nodes)
        self._stated = [(at, value) for at, value in source.stated.items() if at[0] in chosen]
        self._axes = {n: _axes_of(source, n) for n in self.nodes}
        self._named = {place for place in source.named if place[0] in nodes}
        self._whole = [both for both in dict.fromkeys(source.whole) if nodes.issuperset(both)]
        self._mass = {n: source.node_mass[n] for n in self.nodes if n in source.node_mass}
        self._loads = tuple(
            {n: load for n, load in said.items() if n in nodes}
            for said in (source.force, source.increment)
        )

    def run(self, move: Transform) -> Copy:
        """Make one copy.

        Raises:
            ModelError: a class of single coordinates has no image along the axes.
        """
        is_within = self.source is self.target
        _check_classes(self.source, self.nodes, move, is_within and self._places is not None)
        _check_axes(self.source, self.indices, move)
        nodes: dict[int, int] = {}
        taken: set[int] = set()
        for number in self.nodes:
            if is_position(self.source.node_kind[number]):
                nodes[number] = self._position(number, move, taken)
            else:
                nodes[number] = self._orientation(number, move, nodes)
        elements = {index: self._element(index, move, nodes) for index in self.indices}
        for (index, number), value in self._stated:
            if not (is_within and elements[index] == index):
                self.target.stated[elements[index], number] = value
        self._say_of_nodes(move, nodes)
        return nodes, elements

    def _position(self, number: int, move: Transform, taken: set[int]) -> int:
        source, target = self.source, self.target
        kind, value = source.node_kind[number], source.node_value[number]
        x, y, z = move.place((value[0], value[1], value[2]))
        near = [] if self._places is None else self._places.near((x, y, z))
        free = [n for n in near if n not in taken and target.node_kind[n] == kind]
        if free:
            new = number if source is target and number in free else free[0]
        else:
            new = target.add_node(kind, (x, y, z, 0.0))
            if self._places is not None:
                self._places.add(new)
        taken.add(new)
        return new

    def _orientation(self, number: int, move: Transform, nodes: dict[int, int]) -> int:
        source, target = self.source, self.target
        at = source.position_of.get(number, 0)
        there = nodes.get(at, 0)
        if there == at and source is target and at:
            return number
        last = target.last_node
        if source.orientation_at.get(at) == number:
            new = whole_point(target, there).orientation
        elif there:
            new = pivot(target, there).orientation
        else:
            new = target.add_orientation()
        if source.node_kind[number] == NodeKind.ORIENTATION and new > last:
            target.node_value[new] = move.euler(source.node_value[number])
        return new

    def _element(self, index: int, move: Transform, nodes: dict[int, int]) -> int:
        source, target = self.source, self.target
        p, op, q, oq = (nodes.get(n, 0) for n in source.slots[index])
        same = self._own.get(_ends(source.kinds[index], (p, op, q, oq)))
        if same is not None:
            return same
        new = len(target.kinds)
        turned = _vector(source, index, move)
        target.append_element(source.kinds[index], (p, op, q, oq), turned, source.classes[index])
        if index in source.rigid:
            target.rigid.add(new)
        target.say_looks([new], source.said.get(index, {}))
        target.give_properties(new, *source.properties_of(index))
        return new

    def _say_of_nodes(self, move: Transform, nodes: dict[int, int]) -> None:
        """Classes, masses and loads of nodes that did not come to lie on themselves."""
        source, target = self.source, self.target
        foreign = {n: new for n, new in nodes.items() if source is not target or n != new}
        for number, new in foreign.items():
            for value, axes in self._axes[number].items():
                image = move.axes(axes) or ()
                places = [(new, k) for k in image if k in AXES[target.node_kind[new]]]
                target.state_coordinates(places, value)
                if any((number, k) in self._named for k in axes):
                    target.named.update(places)
            if number in self._mass:
                moved = _turned_mass(source, number, self._mass[number], move)
                there = target.node_mass.get(new, ())
                target.give_node_mass(
                    new, tuple(a + b for a, b in zip_longest(there, moved, fillvalue=0.0))
                )
        _add_loads(source, self._loads, target, foreign, move)
        for p, o in self._whole:
            both = nodes[p], nodes[o]
            if both != (p, o) or source is not target:
                target.whole.append(both)


def _nodes_of(source: Draft, chosen: list[int], further: list[int]) -> list[int]:
    """Numbers of the nodes of elements, with both nodes of each point; positions first."""
    found = {n for index in chosen for n in source.slots[index] if n}
    found |= {source.position_of[n] for n in found if n in source.position_of}
    found.update(further)
    found |= {source.orientation_at[n] for n in found if n in source.orientation_at}
    return sorted(found, key=lambda n: (not is_position(source.node_kind[n]), n))


def _ends(kind: int, slots: Slots) -> tuple[int, frozenset[tuple[int, int]]]:
    """By which elements are known that lie on each other."""
    return kind, frozenset((slots[:2], slots[2:]))


def _turned_mass(
    draft: Draft, number: int, mass: tuple[float, ...], move: Transform
) -> tuple[float, ...]:
    """Numbers of XM after a move; of an orientation all of them, since they mix."""
    if draft.node_kind[number] != NodeKind.ORIENTATION:
        return mass
    return move.inertia((*mass, *(0.0,) * (6 - len(mass))))


def _add_loads(
    source: Draft,
    loads: Sequence[Mapping[int, Vector]],
    target: Draft,
    new: Mapping[int, int],
    move: Transform,
) -> None:
    """Add forces and increments after a move to those that the images of their nodes bear."""
    for said, there in zip(loads, (target.force, target.increment), strict=True):
        for number, load in said.items():
            if number in new:
                moves_along = is_position(source.node_kind[number])
                x, y, z = move.turned(load) if moves_along else move.turned_axially(load)
                a, b, c = there.get(new[number], NO_VECTOR)
                there[new[number]] = (a + x, b + y, c + z)


def _vector(source: Draft, index: int, move: Transform) -> Vector:
    """The vector of an element's image; one that had none gets the image of its default."""
    given = source.vectors[index]
    kind = element_kinds()[source.kinds[index] - 1]
    optional = kind.vector == StatedVector.OPTIONAL
    if given == NO_VECTOR and optional and not source.planar and not source.is_rigid(index):
        p, _, q, _ = source.slots[index]
        a, b = source.node_value[p], source.node_value[q]
        given = _default((b[0] - a[0], b[1] - a[1], b[2] - a[2]))
    return given if given == NO_VECTOR else move.turned(given)


def _default(along: Vector) -> Vector:
    """The global axis along which a direction is smallest, from which a frame is made."""
    parts = unit(along)
    least = min(range(3), key=lambda k: abs(parts[k]))
    return IDENTITY[least]


#: What an element with an axis does across it, in a frame that no statement gives.
_ACROSS = ((Role.TILT_Y, Role.TILT_Z), (Role.OFFSET_Y, Role.OFFSET_Z))


def _check_axes(source: Draft, indices: Iterable[int], move: Transform) -> None:
    """Raise where a joint does different things across its axis, which do not turn with it."""
    for index in indices:
        kind = element_kinds()[source.kinds[index] - 1]
        if kind.vector != StatedVector.REQUIRED:
            continue
        classes = dict(zip(kind.role, source.classes[index], strict=True))
        if all(classes.get(a) == classes.get(b) for a, b in _ACROSS):
            continue
        axis = source.vectors[index]
        before, after = move.turned(_default(axis)), _default(move.turned(axis))
        if math.hypot(*cross(unit(before), unit(after))) > ROUNDING:
            raise model_error(
                "turned-class",
                f"{source.element_words(index)} has classes across its axis that would not turn",
                "copy first and give the classes afterwards",
            )


def _check_classes(
    source: Draft, nodes: Iterable[int], move: Transform, shared: bool = False
) -> None:
    """Raise where coordinates that were given a class are not along the axes after a move.

    Where nodes that stay at their places are `shared`, these keep their classes as they are.
    """
    for number in nodes:
        for value, axes in _axes_of(source, number).items():
            if move.axes(axes) is None:
                here = source.node_value[source.position_of.get(number, number)][:3]
                away = math.dist(move.place((here[0], here[1], here[2])), here)
                stays = away <= ROUNDING * math.hypot(*here)
                if not (shared and stays):
                    raise model_error(
                        "turned-class",
                        f"{source.node_words(number)} has {value.name.lower()} coordinates that "
                        "are not along x, y or z any more",
                        "copy first and give the class afterwards",
                    )


def _axes_of(source: Draft, number: int) -> dict[Class, set[int]]:
    """Axes of a node by the classes that they were given."""
    axes = AXES[source.node_kind[number]]
    given = grouped((source.coordinate_class.get((number, axis)), axis) for axis in axes)
    return {Class(value): set(found) for value, found in given.items() if value is not None}
