# SPDX-License-Identifier: BSD-3-Clause
"""Copies: methods of the builder that insert, repeat, mirror and turn."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from ..core.elements import AXES, Class, is_position
from ..deck.rendering import model_error
from ..util.quantities import Quantity
from ..util.text import in_short
from . import selection as arguments
from .assemblies import HexapodMethods
from .copying import Copy, Copying, Transform, reflection, rotation, translation, turn
from .draft import Draft, Vector
from .elements import Making, all_or_nothing
from .handles import Assembly, Body, Element, FoldedSheet, Named, Node, Part
from .names import part_name
from .places import ROUNDING, size_of
from .selection import (
    Direction,
    PartLike,
    Point,
    drawn_elements,
    existing,
    is_rigid,
    numbers_of_size,
    of_indices,
    place,
    text,
    whole_point,
)

#: How names of copies are made: "upper {}" or "{} {}", with the number of the copy as the second;
#: words that are replaced; or a function.
Names = str | Mapping[str, str] | Callable[[str], str]


def split(name: str) -> tuple[str, str]:
    """What is renamed of a name, and what stays: "sheet 1" and ", 3", "sheet" and ", leaf 1"."""
    head, comma, tail = name.partition(", ")
    return head, comma + tail


def renamer(names: Names | None, number: int) -> Callable[[str], str]:
    """The function that makes the name of a copy.

    Raises:
        ModelError: it is none.
    """
    if names is None:
        return lambda name: name
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
    if isinstance(names, Mapping) and all(map(_are_texts, names.items())):
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


def _are_texts(pair: tuple[object, object]) -> bool:
    return all(isinstance(each, str) for each in pair)


class Naming:
    """Names of copies, of which each stands once in the model."""

    def __init__(self, source: Draft, target: Draft, names: Names | None) -> None:
        """Note the names that are taken.

        Raises:
            ModelError: `names` makes no names.
        """
        renamer(names, 2)
        self._source, self._target, self._names = source, target, names
        every = (*target.names.values(), *target.node_names.values())
        self._taken = {split(name)[0] for name in every}

    def name(self, made: Copy, number: int) -> None:
        """Name what was copied; where a name is taken, " (2)" and so on is added to it."""
        source, target = self._source, self._target
        rename = renamer(self._names, number)
        heads: dict[str, str] = {}
        for index, new in made.elements.items():
            name = source.names.get(index)
            if name and is_of_one_body(source, target, index, new):
                go_on_with(target, new, part_name(name))
            elif name and (source is not target or new != index):
                target.name_element(new, self._new(name, heads, rename, number))
        for old, new in made.nodes.items():
            name = source.node_names.get(old)
            if name and new not in target.node_names:
                target.name_node(new, self._new(name, heads, rename, number))

    def _new(
        self, name: str, heads: dict[str, str], rename: Callable[[str], str], number: int
    ) -> str:
        head, tail = split(name)
        if head not in heads:
            made = free = rename(head)
            k = max(number, 2)
            while free in self._taken:
                free = f"{made} ({k})"
                k += 1
            heads[head] = free
            self._taken.add(free)
        return heads[head] + tail


def is_of_one_body(source: Draft, target: Draft, index: int, new: int) -> bool:
    """Whether a copied rigid link is carried by the body of its original."""
    if source is not target or new == index or not is_rigid(source, index):
        return False
    before, now = source.slots[index], target.slots[new]
    return bool({before[1], before[3]} & {now[1], now[3]} - {0})


def go_on_with(draft: Draft, index: int, part: str) -> None:
    """Name an element as the last one of a part, whose elements are then numbered."""
    indices = [i for i in draft.part_indices(part) if i != index]
    if len(indices) == 1:
        draft.name_element(indices[0], f"{part}, 1")
    draft.name_element(index, f"{part}, {len(indices) + 1}")


_ORIGIN = (0.0, 0.0, 0.0)
_MOST_COPIES = 100_000
Parts = Iterable[PartLike | FoldedSheet | Assembly]


class CopyMethods(HexapodMethods):
    """Methods that copy parts, or turn the whole model."""

    def insert(
        self,
        model: Making,
        at: Point = _ORIGIN,
        *,
        axis: Direction = "z",
        degrees: Quantity = 0.0,
        names: Names | None = None,
        join: bool | Quantity = True,
    ) -> Assembly:
        """Put a copy of another model into this one, turned and then moved.

        Args:
            model: The model, which stays as it is.
            at: Where its origin comes to lie [m].
            axis: The axis through its origin about which it is turned first.
            degrees: The angle [degrees].
            names: How its names are changed: "upper {}", or {"old word": "new word"}. A name
                that is taken gets " (2)".
            join: Whether points that come to lie at a point of this model, within rounding,
                become that point; or the distance within which they do [m].

        Returns:
            Its parts and points by the names that they have in `model`.

        Raises:
            ModelError: one model is planar and the other is not, or a class of single
                coordinates is not along x, y or z any more.
        """
        if model is self:
            raise model_error("same-model", "a model cannot be inserted into itself", "pattern it")
        if not isinstance(model, Making):
            raise model_error("not-a-model", f"a model is wanted, not {in_short(model)}")
        source, target = model._change(), self._change()
        if source.planar != target.planar:
            raise model_error(
                "two-kinds-of-model", "one of the models is planar and the other is not"
            )
        turn = rotation(_axis(target, axis), arguments.angle(degrees), _ORIGIN)
        move = Transform(turn.matrix, _place(target, at))
        naming = Naming(source, target, names)
        every = list(range(len(source.kinds))), list(source.node_kind)
        copying = Copying(source, *every, target, _tolerance(join, source, target))
        with all_or_nothing(target):
            made = copying.run(move)
            naming.name(made, 2)
        return _assembly(source, target, made)

    def pattern(
        self,
        n: int,
        axis: Direction = "z",
        *,
        at: Point = _ORIGIN,
        degrees: Quantity | None = None,
        step: Sequence[Quantity] | None = None,
        parts: Parts | None = None,
        names: Names | None = None,
        join: bool | Quantity = True,
    ) -> tuple[Assembly, ...]:
        """Repeat parts n times in all, about an axis or, with `step`, in a row.

        Supports and other classes are copied, too. What comes to lie on itself, such as a
        point on the axis, is not copied but shared.

        Args:
            n: How many there are in the end, with the originals.
            axis: The axis, "x", "y", "z" or a vector.
            at: A point of the axis [m].
            degrees: The angle from each to the next; by default 360/n.
            step: The way from each to the next [m], instead of an angle.
            parts: Which parts, by handle or name; by default the whole model as it is.
            names: How names of copies are made: "{} {}" gives "sheet 1", "sheet 2", ..., the
                original included; by default copies are "sheet (2)", "sheet (3)", ...
            join: See `insert`.

        Returns:
            The originals and each copy, with parts and points by the names of the originals.
        """
        draft = self._change()
        count = arguments.count(n, 1, _MOST_COPIES, "members of a pattern")
        angle = 360.0 / count if degrees is None else arguments.angle(degrees)
        centre = _place(draft, at)
        indices, further = self._chosen(parts)
        naming = Naming(draft, draft, names)
        moves = [
            rotation(_axis(draft, axis), k * angle, centre)
            if step is None
            else translation(_times(k, _place(draft, step)))
            for k in range(1, count)
        ]
        made = [Copy({n: n for n in draft.node_kind}, {i: i for i in indices})]
        copying = Copying(draft, indices, further, draft, _tolerance(join, draft, draft))
        with all_or_nothing(draft):
            for k, move in enumerate(moves, 2):
                made.append(copying.run(move))
                naming.name(made[-1], k)
        results = tuple(_assembly(draft, draft, each) for each in made)
        if isinstance(names, str) and names.format("a", 1) != names.format("a", 2):
            _rename_originals(draft, copying, made[1:], names)
        return results

    def mirror(
        self,
        plane: Direction,
        *,
        at: Point = _ORIGIN,
        parts: Parts | None = None,
        names: Names | None = None,
        join: bool | Quantity = True,
    ) -> Assembly:
        """Add the mirror image of parts in a plane.

        What comes to lie on itself, such as a point in the plane, is not copied but shared.

        Args:
            plane: "xy", "yz", "zx", or the normal of the plane as a vector.
            at: A point of the plane [m].
            parts: Which parts, by handle or name; by default the whole model as it is.
            names: How names of the image are made, such as {"left": "right"}; see `insert`.
            join: See `insert`.

        Returns:
            The image, with parts and points by the names of the originals.
        """
        draft = self._change()
        move = reflection(plane, _place(draft, at))
        if draft.planar and move.matrix[2] != (0.0, 0.0, 1.0):
            raise model_error("no-coordinate", "a planar model is mirrored in a plane along z")
        indices, further = self._chosen(parts)
        naming = Naming(draft, draft, names)
        copying = Copying(draft, indices, further, draft, _tolerance(join, draft, draft))
        with all_or_nothing(draft):
            made = copying.run(move)
            naming.name(made, 2)
        return _assembly(draft, draft, made)

    def rotate(self, axis: Direction, degrees: Quantity, *, at: Point = _ORIGIN) -> None:
        """Turn the whole model about an axis through a point.

        Args:
            axis: "x", "y", "z" or a vector.
            degrees: The angle, right-handed [degrees].
            at: A point of the axis [m].

        Raises:
            ModelError: a class of single coordinates is not along x, y or z any more.
        """
        draft = self._change()
        move = rotation(_axis(draft, axis), arguments.angle(degrees), _place(draft, at))
        turn(draft, move)

    def _chosen(self, parts: Parts | None) -> tuple[list[int], list[int]]:
        """Indices of the elements that are meant, and further nodes: of all, where all is."""
        draft = self._change()
        if parts is None:
            return list(range(len(draft.kinds))), list(draft.node_kind)
        chosen = arguments.several(parts, "parts")
        return list(dict.fromkeys(i for each in chosen for i in drawn_elements(draft, each))), []


def _axis(draft: Draft, axis: Direction) -> Vector:
    made = arguments.direction(axis, "axis")
    if draft.planar and any(made[:2]):
        raise model_error("no-coordinate", "a planar model turns about z")
    return made


def _place(draft: Draft, given: Point) -> Vector:
    """Three numbers [m], or two in a plane; or where a point is."""
    if isinstance(given, (Node, Body, str)):
        given = draft.node_value[existing(draft, given).position][:3]
    x, y, z = place(draft, given)[:3]
    return x, y, z


def _times(k: int, step: Vector) -> Vector:
    return k * step[0], k * step[1], k * step[2]


def _tolerance(join: bool | Quantity, source: Draft, target: Draft) -> float | None:
    """Within which points are joined [m]; None where none are."""
    if join is False:
        return None
    if join is True:
        return ROUNDING * max(size_of(source), size_of(target))
    return numbers_of_size(join, (1,), "join is True, False or a distance", "m")[0]


def _assembly(source: Draft, target: Draft, made: Copy) -> Assembly:
    """The handle of a copy, by the names of the originals."""
    groups: dict[str, list[int]] = {}
    for index, new in made.elements.items():
        groups.setdefault(part_name(source.names.get(index, "")), []).append(new)
    parts: dict[str, Part | FoldedSheet | Element] = {
        name: of_indices(target, indices) for name, indices in groups.items() if name
    }
    positions = [n for n in made.nodes if is_position(source.node_kind[n])]
    points = {
        source.node_names[n]: whole_point(target, made.nodes[n])
        for n in positions
        if n in source.node_names
    }
    ground = [whole_point(target, made.nodes[n]) for n in positions if _is_clamped(source, n)]
    return Assembly("", Named(parts), Named(points), tuple(ground))


def _is_clamped(draft: Draft, number: int) -> bool:
    axes = AXES[draft.node_kind[number]]
    return all(draft.coordinate_class.get((number, axis)) == Class.FIXED for axis in axes)


def _rename_originals(draft: Draft, copying: Copying, made: list[Copy], names: str) -> None:
    """Give the originals of a pattern the number 1, but for what their copies share."""

    def is_shared(index: int, new: int) -> bool:
        return new == index or is_of_one_body(draft, draft, index, new)

    for index in copying.indices:
        shared = any(is_shared(index, each.elements[index]) for each in made)
        if index in draft.names and not shared:
            head, tail = split(draft.names[index])
            draft.name_element(index, names.format(head, 1) + tail)
    for number in copying.nodes:
        shared = any(each.nodes[number] == number for each in made)
        if number in draft.node_names and not shared:
            head, tail = split(draft.node_names[number])
            draft.name_node(number, names.format(head, 1) + tail)
