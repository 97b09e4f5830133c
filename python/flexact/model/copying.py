# SPDX-License-Identifier: BSD-3-Clause
"""Copies of parts, within a draft or from one to another: moved, turned or mirrored."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import partial
from itertools import zip_longest

from ..core.elements import AXES, Class, NodeKind, Role, element_kinds, is_position
from ..core.elements import Vector as StatedVector
from ..deck.rendering import model_error
from ..util.text import in_short
from .draft import NO_VECTOR, Draft, LoadsDraft, Vector
from .places import ROUNDING, Places
from .selection import Direction, cross, direction, is_rigid, pivot, unit, whole_point

Matrix = tuple[Vector, Vector, Vector]
IDENTITY: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_PLANES = {"xy": "z", "yx": "z", "yz": "x", "zy": "x", "zx": "y", "xz": "y"}
#: Where the sine is known to the last bit, in steps of 30 degrees.
_SINES = (0.0, 0.5, math.sqrt(0.75), 1.0)
#: An entry of an image is no whole number beyond this.
_ROUNDING = 1.0e-9


@dataclass(frozen=True, slots=True)
class Transform:
    """x goes to matrix x + shift; the matrix is orthogonal.

    Attributes:
        matrix: (3, 3) rows.
        shift: (3,) [m].
    """

    matrix: Matrix
    shift: Vector

    def place(self, x: Vector) -> Vector:
        """The image of a place."""
        a, b, c = self.turned(x)
        return a + self.shift[0], b + self.shift[1], c + self.shift[2]

    def turned(self, v: Vector) -> Vector:
        """The image of a direction."""
        a, b, c = (row[0] * v[0] + row[1] * v[1] + row[2] * v[2] for row in self.matrix)
        return a, b, c

    def turned_axially(self, v: Vector) -> Vector:
        """The image of a rotation or a moment, which a mirror image reverses."""
        a, b, c = self.turned(v)
        return (-a, -b, -c) if self.is_mirror else (a, b, c)

    @property
    def is_mirror(self) -> bool:
        """Whether it turns a right hand into a left one."""
        (a, b, c), (d, e, f), (g, h, i) = self.matrix
        return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) < 0.0

    def euler(self, value: tuple[float, ...]) -> tuple[float, ...]:
        """Euler parameters of the image of an orientation; unturned stays unturned."""
        x, y, z = self.turned((value[1], value[2], value[3]))
        sign = -1.0 if self.is_mirror else 1.0
        return value[0], sign * x, sign * y, sign * z

    def inertia(self, value: tuple[float, ...]) -> tuple[float, ...]:
        """Jxx, Jxy, Jxz, Jyy, Jyz, Jzz of the image of a body."""
        xx, xy, xz, yy, yz, zz = value
        rows = [self.turned(column) for column in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))]
        columns = list(zip(*rows, strict=True))
        made = [self.turned((c[0], c[1], c[2])) for c in columns]
        return made[0][0], made[0][1], made[0][2], made[1][1], made[1][2], made[2][2]

    def axes(self, chosen: set[int]) -> set[int] | None:
        """The axes that span the image of some axes; None where no axes do."""
        found = set()
        for k in range(3):
            size = sum(self.matrix[k][j] ** 2 for j in chosen)
            if abs(size - 1.0) < _ROUNDING:
                found.add(k)
            elif size > _ROUNDING:
                return None
        return found


def rotation(axis: Direction, degrees: float, at: Vector) -> Transform:
    """The rotation about an axis through a point; exact for multiples of 30 degrees about x, y, z.

    Args:
        axis: "x", "y", "z" or a vector.
        degrees: The angle, right-handed [degrees].
        at: A point of the axis [m].
    """
    n = unit(direction(axis, "axis"))
    s, c = sine(degrees), sine(degrees + 90.0)
    rows = []
    for i in range(3):
        row = []
        for j in range(3):
            k = 3 - i - j
            skew = 0.0 if i == j else (n[k] if (j - i) % 3 == 2 else -n[k])
            row.append((c if i == j else 0.0) + (1.0 - c) * n[i] * n[j] + s * skew)
        rows.append((row[0], row[1], row[2]))
    return _about((rows[0], rows[1], rows[2]), at)


def reflection(plane: Direction, at: Vector) -> Transform:
    """The mirror image in a plane through a point.

    Args:
        plane: "xy", "yz" or "zx", or its normal as a vector.
        at: A point of the plane [m].

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
    n = unit(direction(plane, "normal of the plane"))
    rows = [tuple((1.0 if i == j else 0.0) - 2.0 * n[i] * n[j] for j in range(3)) for i in range(3)]
    return _about((rows[0], rows[1], rows[2]), at)  # type: ignore[arg-type]


def translation(by: Vector) -> Transform:
    """The shift by a vector [m]."""
    return Transform(IDENTITY, by)


def _about(matrix: Matrix, at: Vector) -> Transform:
    moved = Transform(matrix, (0.0, 0.0, 0.0)).turned(at)
    return Transform(matrix, (at[0] - moved[0], at[1] - moved[1], at[2] - moved[2]))


def sine(degrees: float) -> float:
    """The sine of an angle in degrees, right to the last bit for multiples of 30."""
    angle = math.fmod(degrees, 360.0)
    steps = round(angle / 30.0)
    if angle != 30.0 * steps:
        return math.sin(math.radians(angle))
    steps %= 12
    sign = -1.0 if steps > 6 else 1.0
    steps %= 6
    return sign * _SINES[min(steps, 6 - steps)] + 0.0


def on_circle(centre: Vector, radius: float, degrees: float) -> Vector:
    """The point of a circle about z at an angle from x [degrees]."""
    x, y = radius * sine(degrees + 90.0), radius * sine(degrees)
    return centre[0] + x, centre[1] + y, centre[2]


def vector(source: Draft, index: int, move: Transform) -> Vector:
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


def check_axes(source: Draft, indices: Iterable[int], move: Transform) -> None:
    """Raise where a joint does different things across its axis, which do not turn with it."""
    for index in indices:
        kind = element_kinds()[source.kinds[index] - 1]
        if kind.vector != StatedVector.REQUIRED:
            continue
        classes = dict(zip(kind.role, source.classes[index], strict=True))
        axis = source.vectors[index]
        alike = all(classes.get(a) == classes.get(b) for a, b in _ACROSS)
        if alike or _along(move.turned(_default(axis)), _default(move.turned(axis))):
            continue
        raise model_error(
            "turned-class",
            f"{source.element_words(index)} has classes across its axis that would not turn",
            "copy first and give the classes afterwards",
        )


def _along(a: Vector, b: Vector) -> bool:
    return math.hypot(*cross(unit(a), unit(b))) <= ROUNDING


def check_classes(
    source: Draft, nodes: Iterable[int], move: Transform, shared: bool = False
) -> None:
    """Raise where coordinates that were given a class are not along the axes after a move.

    Where nodes that stay at their places are `shared`, these keep their classes as they are.
    """
    for number in nodes:
        for value, axes in axes_of(source, number).items():
            if move.axes(axes) is None:
                here = _place(source, number)
                stays = math.dist(move.place(here), here) <= ROUNDING * math.hypot(*here)
                if not (shared and stays):
                    raise model_error(
                        "turned-class",
                        f"{source.node_words(number)} has {value.name.lower()} coordinates that "
                        "are not along x, y or z any more",
                        "copy first and give the class afterwards",
                    )


def _place(source: Draft, number: int) -> Vector:
    position = source.position_of.get(number, number)
    x, y, z = source.node_value[position][:3]
    return x, y, z


def axes_of(source: Draft, number: int) -> dict[Class, set[int]]:
    """Axes of a node by the classes that they were given."""
    found: dict[Class, set[int]] = {}
    axes = AXES[source.node_kind[number]]
    for axis in axes:
        value = source.coordinate_class.get((number, axis))
        if value is not None:
            found.setdefault(Class(value), set()).add(axis)
    return found


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
