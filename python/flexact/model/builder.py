# SPDX-License-Identifier: BSD-3-Clause
"""The builder: methods that make nodes and elements and give classes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..core.elements import Class, NodeKind, kind_of
from ..core.raw import ElementKind
from ..diagnostics.errors import model_error
from . import appearance_arguments as appearance
from . import arguments as targets
from .appearance_arguments import Section
from .appearance_draft import Shape
from .data import ModelData
from .draft import NO_VECTOR, Draft
from .handles import Element, Node, Sheet


class Builder:
    """The half of `Model` that makes it; see there."""

    def __init__(self, *, planar: bool = False, name: str = "") -> None:
        """Start an empty model."""
        self._start(bool(planar), targets.text(name, "the name of a model"))

    def _start(self, planar: bool, name: str) -> None:
        self._name = name
        self._planar = planar
        self._owner = object()
        self._draft: Draft | None = Draft(planar, self._owner)
        self._data: ModelData | None = None

    def _change(self) -> Draft:
        """The draft, to be changed; arrays that were made are dropped."""
        if self._draft is None:
            self._draft = Draft.of(self.data, self._owner)
        self._data = None
        return self._draft

    @property
    def data(self) -> ModelData:
        """The model as it is now; later changes do not touch it."""
        if self._data is None:
            assert self._draft is not None
            self._data = self._draft.freeze(self._name)
        return self._data

    # Nodes ------------------------------------------------------------------

    def node(self, x: float, y: float, z: float = 0.0, name: str = "") -> Node:
        """Add a point [m]; its orientation is used only if an element needs it."""
        draft = self._change()
        value = (*targets.vector((x, y, z), "position"), 0.0)
        if draft.planar and value[2] != 0.0:
            raise model_error("no-coordinate", "a planar model has no coordinate z")
        kind = NodeKind.PLANAR_POSITION if draft.planar else NodeKind.POSITION
        position = draft.add_node(kind, value, targets.text(name, "the name of a point"))
        return Node(position, draft.add_orientation(), self._owner)

    def pivot(self, node: Node) -> Node:
        """Another point at the position of `node`, with an orientation of its own."""
        draft = self._change()
        position = targets.position(draft, node)
        return Node(position, draft.add_orientation(), self._owner)

    def handle(self, position: int, orientation: int = 0) -> Node:
        """The point made of two nodes by their numbers, for a model from a deck.

        Raises:
            ModelError: there is no such node, or it is of the other kind.
        """
        return targets.handle(self._change(), position, orientation)

    # Elements ---------------------------------------------------------------

    def truss(
        self, p: Node | int, q: Node | int, name: str = "", *, section: Section | None = None
    ) -> Element:
        """A bar: its elongation is held. A number stands for a position node.

        `section` is how it is drawn, see `look`.
        """
        draft = self._change()
        slots = (targets.position(draft, p), 0, targets.position(draft, q), 0)
        name = targets.text(name, "the name of an element")
        shape = appearance.shape_of(section)
        number = draft.add_element(_kind("TRUSS", draft.planar), slots, name, shape=shape)
        return Element(number, self._owner)

    def beam(
        self,
        p: Node,
        q: Node,
        y: Sequence[float] | None = None,
        release: Iterable[int] = (),
        name: str = "",
        *,
        section: Section | None = None,
    ) -> Element:
        """A beam; all deformations are held but those in `release`.

        Args:
            p: One end.
            q: The other end.
            y: Initial direction of the local y axis; by default the global axis that
                is most nearly across the beam. Not for a planar beam.
            release: Deformations that are free: 1 elongation, 2 torsion, 3 and 4 bending
                in the local xz plane, 5 and 6 in the local xy plane at p and q; of a
                planar beam 1 elongation, 2 and 3 bending.
            name: What the element is called.
            section: How it is drawn, see `look`.
        """
        released = targets.deformations(_kind("BEAM", self._planar), release)
        element = self._beam(p, q, y, (), name, appearance.shape_of(section))
        if released:
            self.release(element, *released)
        return element

    def wire(
        self,
        p: Node,
        q: Node,
        y: Sequence[float] | None = None,
        name: str = "",
        *,
        section: Section | None = None,
    ) -> Element:
        """A wire flexure: its elongation is held, torsion and bending are released.

        `section` is how it is drawn, see `look`: as a rule the diameter [m].
        """
        released = (2, 3) if self._planar else (2, 3, 4, 5, 6)
        return self._beam(p, q, y, released, name, appearance.shape_of(section))

    def sheet(
        self,
        p: Node,
        q: Node,
        width: Sequence[float] | None = None,
        beams: int = 1,
        name: str = "",
        *,
        section: Sequence[float] | None = None,
    ) -> Sheet:
        """A sheet flexure: elongation and in-plane bending are held, the rest released.

        The local z axis of its beams lies in the plane of the sheet, as in section 4.2
        of the paper, so that deformations 3 and 4 are the in-plane bending.

        Args:
            p: One end.
            q: The other end.
            width: Direction of the width, not along the sheet. A planar model sees the
                sheet from its side and takes no width.
            beams: Into how many equal beams the sheet is divided.
            name: What the sheet is called.
            section: Width and thickness [m], as it is drawn.
        """
        draft = self._change()
        name = targets.text(name, "the name of a sheet")
        shape = appearance.sheet_shape(section)
        normal = targets.sheet_normal(draft, p, q, width)
        points = targets.between(draft, p, q, beams)
        nodes = (p, *(self.node(*point) for point in points), q)
        names = [f"{name}, {i + 1}" if name and beams > 1 else name for i in range(beams)]
        released = (2, 3) if self._planar else (2, 5, 6)
        elements = tuple(
            self._beam(nodes[i], nodes[i + 1], normal, released, names[i], shape)
            for i in range(beams)
        )
        return Sheet(elements, nodes)

    def rigid(self, p: Node, q: Node, name: str = "", *, section: Section | None = None) -> Element:
        """A rigid link that carries q with p.

        It becomes an RBEAM, which holds the position of q alone, unless the orientation
        of q is needed by another element or by a class that names its coordinates, or
        the link itself is given a class; then it becomes a BEAM with everything held.
        The deformations of `release` and `independent` are those of a BEAM.
        `section` is how it is drawn, see `look`.
        """
        element = self._beam(p, q, None, (), name, appearance.shape_of(section))
        draft = self._change()
        draft.rigid.add(len(draft.kinds) - 1)
        return element

    def hinge(
        self,
        p: Node,
        axis: Sequence[float] | None = None,
        q: Node | None = None,
        name: str = "",
        independent: bool = False,
    ) -> Node:
        """A hinge at p: the rotation about the axis is released, the others are held.

        Args:
            p: The point on one side.
            axis: Direction of the axis; not for a planar model.
            q: The point on the other side, at the same position node; by default a new
                one, as `pivot` makes it.
            name: What the element is called.
            independent: Whether the rotation is a degree of freedom, eq. (6).

        Returns:
            The point beyond the hinge.
        """
        draft = self._change()
        here = targets.orientation(draft, p)
        direction = targets.axis(draft, axis)
        name = targets.text(name, "the name of an element")
        if q is None:
            q = self.pivot(p)
        there = targets.orientation(draft, q)
        if q.position != p.position:
            raise model_error(
                "two-positions",
                "a hinge joins two points at one position node",
                "make the second point with pivot(p), or leave it out",
            )
        kind = _kind("HINGE", draft.planar)
        number = draft.add_element(kind, (0, here, 0, there), name, direction, (1,))
        if independent:
            self.independent(Element(number, self._owner), 1)
        return q

    def _beam(
        self,
        p: Node,
        q: Node,
        y: Sequence[float] | None,
        released: tuple[int, ...],
        name: str,
        shape: Shape | None = None,
    ) -> Element:
        draft = self._change()
        if y is not None and draft.planar:
            raise model_error("surplus-vector", "a planar beam takes no y vector")
        hint = NO_VECTOR if y is None else targets.direction(y, "y vector")
        slots = (
            targets.position(draft, p),
            targets.orientation(draft, p),
            targets.position(draft, q),
            targets.orientation(draft, q),
        )
        name = targets.text(name, "the name of an element")
        kind = _kind("BEAM", draft.planar)
        number = draft.add_element(kind, slots, name, hint, released, shape)
        return Element(number, self._owner)

    # Classes ----------------------------------------------------------------

    def fix(self, target: Node | int, *coordinates: str) -> None:
        """Fix coordinates, eq. (7): a support.

        Args:
            target: A point, or the number of a node.
            *coordinates: Names out of x, y, z, rx, ry, rz; by default all that the point
                or node has.
        """
        targets.give_coordinates(self._change(), target, coordinates, Class.FIXED)

    def independent(self, target: Node | Element | Sheet | int, *which: str | int) -> None:
        """Make coordinates or deformations independent: degrees of freedom, eq. (6).

        Args:
            target: A point or an element; or a number, of a node where coordinates are
                named, of an element where deformations are numbered.
            *which: Coordinates by name, or deformations by number; by default all.
        """
        draft = self._change()
        if targets.means_element(target, which):
            targets.give_deformations(draft, target, which, Class.INDEPENDENT)
        else:
            targets.give_coordinates(draft, target, which, Class.INDEPENDENT)

    def release(self, element: Element | Sheet | int, *deformations: int) -> None:
        """Release deformations, by default all: they are free to change.

        Args:
            element: An element, a sheet (each of its beams), or an element's number.
            *deformations: Their numbers, from 1.
        """
        targets.give_deformations(self._change(), element, deformations, Class.DEPENDENT)

    # Pictures ---------------------------------------------------------------

    def look(
        self,
        target: Element | Sheet | Node | int,
        *,
        section: Section | None = None,
        colour: Sequence[float] | None = None,
        edge_colour: Sequence[float] | None = None,
        opacity: float | None = None,
        drawn: bool | None = None,
    ) -> None:
        """Say how elements are drawn; the analysis does not use it.

        What is not given stays as it was.

        Args:
            target: An element, a sheet (each of its beams), the point beyond a hinge, or
                an element's number.
            section: A diameter, or the sizes along the local y and z axes [m]; of a sheet
                its width and its thickness, whatever its local axes are.
            colour: Red, green and blue, from 0 to 1.
            edge_colour: The same for edges.
            opacity: From 0, invisible, to 1.
            drawn: Whether it is drawn at all.

        Raises:
            ModelError: something of it is wrong; then nothing has changed.
        """
        draft = self._change()
        indices = appearance.indices_of(draft, target)
        said = appearance.said(target, section, colour, edge_colour, opacity, drawn)
        draft.appearance.give(indices, said)


def _kind(keyword: str, planar: bool) -> ElementKind:
    return kind_of("PL" + keyword if planar else keyword)
