# SPDX-License-Identifier: BSD-3-Clause
"""Rigid bodies through points: a method of the builder."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..deck.rendering import model_error
from ..util.quantities import Quantity
from ..util.text import in_short
from . import selection as arguments
from . import selection as points
from .coordinates import ClassMethods
from .draft import NO_VECTOR, Draft, Vector
from .elements import call
from .flexures import FlexureMethods, normal_to, span
from .handles import Body, Element, FoldedSheet, Node
from .names import part_name
from .sections import Make, MaterialLike
from .selection import Direction, Point, Section, is_rigid, named_part, numbers_of_size, shape_of


class RigidComponents:
    """Points joined by rigid links, as sets that are merged.

    A point is known by the number of its orientation; a point that a link of a deck carries
    without its orientation (RBEAM) by its position number, negative.
    """

    def __init__(self) -> None:
        """Of no elements so far."""
        self._parent: dict[int, int] = {}
        self._anchor: dict[int, Node] = {}
        #: How many elements of the draft were looked at.
        self.seen = 0

    @classmethod
    def of(cls, draft: Draft) -> RigidComponents:
        """Those of a draft as it is now; elements that are new since the last time are added."""
        if draft.components is None:
            draft.components = cls()
        made = draft.components
        for index in range(made.seen, len(draft.kinds)):
            if is_rigid(draft, index):
                p, op, q, oq = draft.slots[index]
                if not oq:
                    made._anchor[-q] = Node(p, op, draft.owner)
                made._merge(op, oq or -q)
        made.seen = len(draft.kinds)
        return made

    def _root(self, key: int) -> int:
        self._parent.setdefault(key, key)
        while (above := self._parent[key]) != key:
            self._parent[key] = self._parent[above]
            key = above
        return key

    def _merge(self, a: int, b: int) -> None:
        self._parent[self._root(a)] = self._root(b)

    def carrier(self, node: Node) -> Node:
        """The point with an orientation by which a link takes hold of the body of a point."""
        if node.orientation in self._parent:
            return node
        return self._anchor.get(-node.position, node)

    def joined(self, a: Node, b: Node) -> bool:
        """Whether one body carries both points, given by their carriers."""
        return self._root(a.orientation) == self._root(b.orientation)


class BodyMethods(FlexureMethods):
    """The method that makes bodies."""

    def body(
        self,
        points: Iterable[Point],
        name: str = "",
        *,
        mass: Quantity | None = None,
        inertia: Quantity | Sequence[Quantity] | None = None,
        section: Section | None = None,
    ) -> Body:
        """One rigid body through any points.

        Rigid links carry the points with the first of them, as `rigid` makes them. A point
        that is carried already gets no second link; a body among the points is made larger,
        and keeps its name where none is given.

        Args:
            points: Points, their names, their places (x, y, z) [m], or bodies.
            name: What the body is called; its links are "stage, 1", "stage, 2", ...
            mass: Mass [kg], at the first point: give the centre of mass first.
            inertia: Moments of inertia there [kg m2]: Jxx, Jyy, Jzz, or Jxx, Jxy, Jxz, Jyy,
                Jyz, Jzz; in a planar model one number.
            section: How the links are drawn, see `look`.

        Raises:
            ModelError: something of it is wrong; its text begins with the name of the body.
        """
        draft = self._change()
        with call("body", name):
            name = arguments.text(name, "the name of a body")
            nodes, links, old_name = _members(draft, points)
            make = Make(shape_of(section))
            at_node = _mass(mass), _inertia(inertia, draft.planar)
            first = RigidComponents.of(draft).carrier(nodes[0])
            for node in nodes[1:]:
                components = RigidComponents.of(draft)
                carrier = components.carrier(node)
                if not components.joined(first, carrier):
                    links.append(self._beam(first, carrier, None, (), "", make))
                    draft.rigid.add(len(draft.kinds) - 1)
            _name_links(draft, links, name or old_name, nodes[0])
            if not links and name:
                draft.name_node(nodes[0].position, points_name(name))
        for number, values in zip((nodes[0].position, nodes[0].orientation), at_node, strict=True):
            if values:
                draft.give_node_mass(number, values)
        return Body(tuple(links), nodes)


def points_name(name: str) -> str:
    """The name of a body that is one point, as the name of the point."""
    return points.checked_name(name)


def _is_single(given: Iterable[Point]) -> bool:
    """Whether it is an array of no dimension, which cannot be gone through after all."""
    return getattr(given, "ndim", 1) == 0


def _members(draft: Draft, given: Iterable[Point]) -> tuple[tuple[Node, ...], list[Element], str]:
    """Points of a body, each once, the links of bodies among them, and the name of the first."""
    if isinstance(given, (str, bytes)) or not isinstance(given, Iterable) or _is_single(given):
        raise model_error(
            "not-a-point", f"a body goes through several points, not {in_short(given)}"
        )
    nodes: dict[Node, None] = {}
    links: list[Element] = []
    name = ""
    for each in given:
        body: object = each
        if isinstance(each, str) and each not in draft.points_by_name:
            body = named_part(draft, each) if each in draft.parts_by_name else each
        if isinstance(body, Body):
            points.require_own(draft, body, "body")
            nodes.update(dict.fromkeys(body.nodes))
            links += [link for link in body.elements if link not in links]
            name = name or body.name
        else:
            nodes[points.point(draft, each)] = None
    if not nodes:
        raise model_error("not-a-point", "a body needs at least one point")
    return tuple(nodes), links, name


def _name_links(draft: Draft, links: list[Element], name: str, first: Node) -> None:
    """Name the links of a body, that from its first point first; a single one like the body.

    Those of this name that belong to the same body are counted, too.
    """
    if not name:
        return
    indices = _from_first(draft, [draft.index_of(link.number) for link in links], first)
    components = RigidComponents.of(draft)
    others = [i for i in draft.part_indices(name) if i not in indices]
    taken = [i for i in others if components.joined(first, Node(*draft.slots[i][:2], draft.owner))]
    start = len(taken) + 1
    alone = len(indices) == 1 and not taken
    for k, index in enumerate(indices, start):
        draft.name_element(index, name if alone else f"{part_name(name)}, {k}")


def _from_first(draft: Draft, indices: list[int], first: Node) -> list[int]:
    """The links with one that begins at the first point before the others."""
    start = [i for i in indices if draft.slots[i][0] == first.position]
    if not start:
        # A body that was there carries it: its link is turned round, which holds the same.
        start = [i for i in draft.rigid.intersection(indices) if _ends_at(draft, i, first)][:1]
        for index in start:
            p, op, q, oq = draft.slots[index]
            draft.slots[index] = q, oq, p, op
    return [*start, *(i for i in indices if i not in start)]


def _ends_at(draft: Draft, index: int, node: Node) -> bool:
    """Whether a link of which nothing was said ends at a point."""
    is_plain = all(i != index for i, _ in draft.stated)
    return is_plain and draft.slots[index][2:] == (node.position, node.orientation)


def _mass(given: Quantity | None) -> tuple[float, ...]:
    if given is None:
        return ()
    (value,) = numbers_of_size(given, (1,), "a mass is one number", "kg")
    if value < 0.0:
        raise model_error("bad-size", "a mass is not negative", "give it in kg")
    return (value,)


def _inertia(given: Quantity | Sequence[Quantity] | None, planar: bool) -> tuple[float, ...]:
    """Jxx, Jxy, Jxz, Jyy, Jyz, Jzz, or one J in the plane."""
    if given is None:
        return ()
    if planar:
        return numbers_of_size(
            given, (1,), "the moment of inertia in a plane is one number", "kg m2"
        )
    what = "moments of inertia are Jxx, Jyy, Jzz, or Jxx, Jxy, Jxz, Jyy, Jyz, Jzz"
    values = numbers_of_size(given, (3, 6), what, "kg m2")
    if len(values) == 3:
        return values[0], 0.0, 0.0, values[1], 0.0, values[2]
    return values


class FoldedSheetMethods(BodyMethods, ClassMethods):
    """The method that makes folded sheets."""

    def folded_sheet(
        self,
        a: Point,
        fold: Point,
        b: Point,
        width: Direction | None = None,
        name: str = "",
        *,
        beams: int = 1,
        section: Sequence[Quantity] | None = None,
        thickness: Quantity | None = None,
        breadth: Quantity | None = None,
        material: MaterialLike | None = None,
        warping: bool | float = False,
    ) -> FoldedSheet:
        """A folded sheet: two sheets in series, which take one translation, along the fold.

        The fold can turn about itself while both ends stand still: this internal motion is
        declared, as the bending of the first leaf at the fold (section 4.2 of the paper).

        Args:
            a: One end: a point, its name, or its place (x, y, z) [m].
            fold: Where the leaves meet.
            b: The other end.
            width: Direction of the fold line; by default normal to the plane of the points.
            name: What it is called; its leaves are "name, leaf 1" and "name, leaf 2", the
                point where they meet is "name, fold".
            beams: Into how many beams each leaf is divided, see `sheet`.
            section: Breadth (along the fold line) and thickness [m].
            thickness: The thickness [m], instead of `section`.
            breadth: The size along the fold line [m], instead of `section`.
            material: See `wire`.
            warping: Of each leaf, see `sheet`.

        Raises:
            ModelError: something of it is wrong, such as three points on a line and no width.
        """
        draft = self._change()
        with call("folded_sheet", name):
            name = arguments.text(name, "the name of a folded sheet")
            make = self._sheet_make(section, thickness, breadth, material)
            start, middle, end = (points.point(draft, each) for each in (a, fold, b))
            if width is None and not self._planar:
                arms = span(draft, middle, start), span(draft, middle, end)
                width = across(normal_to(*arms), "the two leaves are in one plane")
            names = [f"{name}, leaf {k}" if name else "" for k in (1, 2)]
            first = self._sheet(start, middle, width, beams, names[0], make, warping)
            second = self._sheet(middle, end, width, beams, names[1], make, warping)
            self.independent(first, "out-of-plane bending", at="q")
            if name and not middle.name:
                draft.name_node(middle.position, points.checked_name(f"{name}, fold"))
        return FoldedSheet((first, second), (start, middle, end))


def across(normal: Vector, why: str) -> Vector:
    """The width that follows from the geometry.

    Raises:
        ModelError: none follows.
    """
    if normal == NO_VECTOR:
        raise model_error(
            "missing-vector", f"{why}, so that no width follows", "give width=(x, y, z)"
        )
    return normal
