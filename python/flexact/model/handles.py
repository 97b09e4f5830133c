# SPDX-License-Identifier: BSD-3-Clause
"""What a model hands out for its points and parts: frozen, comparable, readable."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TypeVar

from .draft import Draft
from .names import part_name

T = TypeVar("T")


@dataclass(frozen=True, slots=True, repr=False)
class Node:
    """A point of a model: a position node and an orientation node.

    The orientation node comes into the analysis only where an element uses it.

    Attributes:
        position: Number of the position node.
        orientation: Number of the orientation node.
        owner: The draft of its model, which knows its name and place.
    """

    position: int
    orientation: int
    owner: Draft

    @property
    def name(self) -> str:
        """What the point is called, empty without a name."""
        return self.owner.node_names.get(self.position, "")

    @property
    def place(self) -> tuple[float, ...]:
        """(3,) or, in a planar model, (2,) position [m]; empty where the point was deleted."""
        value = self.owner.node_value.get(self.position, ())
        units = self.owner.units
        return tuple(units.shown(each, "m") for each in value[: 2 if self.owner.planar else 3])

    @property
    def words(self) -> str:
        """What messages call the point."""
        return f"point {self.name!r}" if self.name else f"the point at {_place_words(self)}"

    def __repr__(self) -> str:
        """Name and place."""
        at = f"at {_place_words(self)}"
        return f"<Point {self.name!r} {at}>" if self.name else f"<Point {at}>"


@dataclass(frozen=True, slots=True, repr=False)
class Element:
    """An element of a model.

    Attributes:
        number: Number of the element.
        owner: The draft of its model.
    """

    number: int
    owner: Draft

    @property
    def name(self) -> str:
        """What the element is called, empty without a name."""
        return self.owner.names.get(self.owner.index_by_number.get(self.number, -1), "")

    @property
    def elements(self) -> tuple[Element, ...]:
        """Itself, as the parts have it."""
        return (self,)

    def __repr__(self) -> str:
        """Name, or number."""
        return f"<Element {self.name!r}>" if self.name else f"<Element {self.number}>"


@dataclass(frozen=True, slots=True, repr=False)
class Part:
    """A part of a mechanism, made of one or several elements.

    Attributes:
        elements: Its elements, from p to q.
        nodes: Its points, from p to q.
    """

    elements: tuple[Element, ...]
    nodes: tuple[Node, ...]

    @property
    def name(self) -> str:
        """What the part is called, empty without a name."""
        return part_name(self.elements[0].name) if self.elements else self.nodes[0].name

    @property
    def number(self) -> int:
        """Number of its first element."""
        return self.elements[0].number

    def __repr__(self) -> str:
        """Kind, name, ends and number of beams."""
        beams = f", {len(self.elements)} beams" if len(self.elements) > 1 else ""
        ends = f"from {_end_words(self.nodes[0])} to {_end_words(self.nodes[-1])}"
        return f"<{_title(self)} {ends}{beams}>"


class Sheet(Part):
    """A sheet flexure of one or several beams."""

    __slots__ = ()


class ReinforcedSheet(Sheet):
    """A sheet whose middle is thick: two sheets in one plane, and a rigid body between them."""

    __slots__ = ()

    @property
    def pieces(self) -> dict[str, Part]:
        """Its "leaf 1", "middle" and "leaf 2", as they stand in their names."""
        n = len(self.elements) // 2
        return {
            "leaf 1": Sheet(self.elements[:n], self.nodes[: n + 1]),
            "middle": Body(self.elements[n : n + 1], self.nodes[n : n + 2]),
            "leaf 2": Sheet(self.elements[n + 1 :], self.nodes[n + 1 :]),
        }

    @property
    def name(self) -> str:
        """What the sheet is called, empty without a name."""
        return part_name(self.elements[0].name).removesuffix(", leaf 1")


class Wire(Part):
    """A wire flexure of one or several beams."""

    __slots__ = ()


class Body(Part):
    """A rigid body through points: where a point is wanted, it stands for the first of them."""

    __slots__ = ()

    def __repr__(self) -> str:
        """Name and points."""
        return f"<{_title(self)} through {', '.join(map(_end_words, self.nodes))}>"


class Notch(Part):
    """A notch or hinge between two points at one place, `p` before and `q` beyond it."""

    __slots__ = ()

    @property
    def p(self) -> Node:
        """The point on the near side."""
        return self.nodes[0]

    @property
    def q(self) -> Node:
        """The point on the far side."""
        return self.nodes[-1]

    def __repr__(self) -> str:
        """Name and place."""
        return f"<{_title(self)} at {_end_words(self.nodes[0])}>"


class CutNotch(Notch):
    """A notch with a contour: a hinge in its middle, between halves from `p` and to `q`."""

    __slots__ = ()

    @property
    def pieces(self) -> dict[str, Part]:
        """Its "half 1", "hinge" and "half 2"; the hinge is called as the whole."""
        (first, hinge, second), (p, near, far, q) = self.elements, self.nodes
        return {
            "half 1": Body((first,), (p, near)),
            "hinge": Notch((hinge,), (near, far)),
            "half 2": Body((second,), (q, far)),
        }

    @property
    def name(self) -> str:
        """What the notch is called, empty without a name."""
        return self.elements[1].name


@dataclass(frozen=True, slots=True, repr=False)
class FoldedSheet:
    """Two sheets in series that meet in a fold.

    Attributes:
        leaves: The sheet from a to the fold, and the one from the fold to b.
        nodes: The points a, fold, b.
    """

    leaves: tuple[Sheet, Sheet]
    nodes: tuple[Node, Node, Node]

    @property
    def elements(self) -> tuple[Element, ...]:
        """The beams of both leaves."""
        return self.leaves[0].elements + self.leaves[1].elements

    @property
    def name(self) -> str:
        """What the folded sheet is called, empty without a name."""
        return self.leaves[0].name.removesuffix(", leaf 1")

    @property
    def fold(self) -> Node:
        """The point of the fold."""
        return self.nodes[1]

    def __repr__(self) -> str:
        """Name and points."""
        a, fold, b = map(_end_words, self.nodes)
        return f"<{_title(self)} from {a} over {fold} to {b}>"


class Named(Mapping[str, T]):
    """Things by their names, in the order in which they were made; it does not change."""

    __slots__ = ("_items",)
    _items: dict[str, T]

    def __init__(self, items: Mapping[str, T]) -> None:
        """Keep a copy."""
        self._items = dict(items)

    def __getitem__(self, name: str) -> T:
        """The thing of this name."""
        return self._items[name]

    def __iter__(self) -> Iterator[str]:
        """The names."""
        return iter(self._items)

    def __len__(self) -> int:
        """How many there are."""
        return len(self._items)

    def __hash__(self) -> int:
        """Of the names and the things."""
        return hash(tuple(self._items.items()))

    def __repr__(self) -> str:
        """The names."""
        return f"<{', '.join(map(repr, self._items))}>"


@dataclass(frozen=True, slots=True, repr=False)
class Assembly:
    """Parts and points that were made by one call, by their names.

    Attributes:
        name: What it is called, empty without a name.
        parts: Its parts; `assembly["sheet 1"]` finds parts and points alike.
        points: Its points.
        ground: The points by which it is held, to be clamped or carried by a body.
        body: The body that it guides or carries, None without one.
    """

    name: str
    parts: Named[Part | FoldedSheet | Element]
    points: Named[Node]
    ground: tuple[Node, ...] = ()
    body: Body | None = field(default=None)

    def __getitem__(self, name: str) -> Part | FoldedSheet | Element | Node:
        """The part or point of this name in the assembly."""
        if name in self.parts:
            return self.parts[name]
        return self.points[name]

    def __repr__(self) -> str:
        """Names of what it has."""
        title = f"Assembly {self.name!r}" if self.name else "Assembly"
        return f"<{title} of {', '.join(map(repr, self.parts))}>"


def _title(part: Part | FoldedSheet) -> str:
    kind = type(part).__name__
    return f"{kind} {part.name!r}" if part.name else kind


def _end_words(node: Node) -> str:
    return repr(node.name) if node.name else _place_words(node)


def _place_words(node: Node) -> str:
    return f"({', '.join(f'{x:g}' for x in node.place)})"
