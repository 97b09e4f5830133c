# SPDX-License-Identifier: BSD-3-Clause
"""Flexures and links: methods of the builder that make single parts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..core.elements import Class
from ..diagnostics.errors import model_error
from . import arguments, sections
from . import point_arguments as points
from .appearance_arguments import Section, shape_of
from .arguments import Direction
from .class_arguments import deformations
from .division import declare_inner
from .draft import NO_VECTOR
from .handles import Element, Node, Notch, Sheet, Wire
from .making import call
from .material import MaterialLike
from .point_arguments import Point
from .points import PointMethods
from .sections import Make
from .sheet_geometry import between, sheet_normal


class FlexureMethods(PointMethods):
    """Methods that make bars, beams, wires, sheets, rigid links and hinges."""

    def truss(
        self,
        p: Point | int,
        q: Point | int,
        name: str = "",
        *,
        section: Section | None = None,
        thickness: float | None = None,
        material: MaterialLike | None = None,
    ) -> Element:
        """A bar: its elongation is held. A number stands for a position node.

        `section` is how it is drawn, see `look`; `thickness` is its diameter [m], and
        `material` gives it stiffness and mass, see `wire`.
        """
        draft = self._change()
        with call("truss", name):
            name = arguments.text(name, "the name of an element")
            shape = sections.round_section(section, thickness)
            make = sections.made_of(self._kind("TRUSS"), shape, material, "bar")
            slots = (points.position(draft, p), 0, points.position(draft, q), 0)
            number = draft.add_element(self._kind("TRUSS"), slots, name, shape=shape)
            draft.give_properties(len(draft.kinds) - 1, make.stiffness, make.mass)
        return Element(number, self._owner)

    def beam(
        self,
        p: Point,
        q: Point,
        y: Direction | None = None,
        release: Iterable[int | str] = (),
        name: str = "",
        *,
        section: Section | None = None,
        material: MaterialLike | None = None,
    ) -> Element:
        """A beam; all deformations are held but those in `release`.

        Args:
            p: One end.
            q: The other end.
            y: Initial direction of the local y axis; by default the global axis that
                is most nearly across the beam. Not for a planar beam.
            release: Deformations that are free: 1 elongation, 2 torsion, 3 and 4 bending
                in the local xz plane, 5 and 6 in the local xy plane at p and q; of a
                planar beam 1 elongation, 2 and 3 bending. Or in words: "elongation",
                "twist", "bending", "bending about y", "bending about z".
            name: What the element is called.
            section: How it is drawn, see `look`.
            material: Gives it stiffness and mass, see `wire`.
        """
        with call("beam", name):
            kind = self._kind("BEAM")
            released = deformations(kind, release)
            make = sections.made_of(kind, shape_of(section), material, "beam")
            element = self._beam(p, q, y, (), name, make)
            index = self._change().index_of(element.number)
            self._change().state_deformations([(index, k) for k in released], Class.DEPENDENT)
            for number in released:
                self._change().set_deformation(index, number, Class.DEPENDENT)
        return element

    def wire(
        self,
        p: Point,
        q: Point,
        y: Direction | None = None,
        name: str = "",
        *,
        beams: int = 1,
        section: Section | None = None,
        thickness: float | None = None,
        material: MaterialLike | None = None,
    ) -> Wire:
        """A wire flexure: its elongation is held, torsion and bending are released.

        Args:
            p: One end: a point, its name, or its place (x, y, z) [m].
            q: The other end.
            y: Initial direction of the local y axis.
            name: What the wire is called.
            beams: Into how many equal beams it is divided. The inner deformations are
                declared independent, so that the counts are those of one beam.
            section: How it is drawn, see `look`: as a rule the diameter [m].
            thickness: The diameter [m], instead of `section`.
            material: "steel", "titanium" or another name of `MATERIALS`, a
                `flexact.Material`, or {"E": ..., "G": ..., "density": ...}. With it the
                beams get ESTIFF (EA, G It, E Iy, E Iz) and EM, which stand in the deck.

        Raises:
            ModelError: something of it is wrong; its text begins with the name of the wire.
        """
        released = (2, 3) if self._planar else (2, 3, 4, 5, 6)
        with call("wire", name):
            shape = sections.round_section(section, thickness)
            make = sections.made_of(self._kind("BEAM"), shape, material, "wire")
            elements, nodes = self._chain(p, q, y, released, name, make, beams)
        return Wire(elements, nodes)

    def sheet(
        self,
        p: Point,
        q: Point,
        width: Direction | None = None,
        beams: int = 1,
        name: str = "",
        *,
        section: Sequence[float] | None = None,
        thickness: float | None = None,
        breadth: float | None = None,
        material: MaterialLike | None = None,
    ) -> Sheet:
        """A sheet flexure: elongation and in-plane bending are held, the rest released.

        The local z axis of its beams lies in the plane of the sheet, as in section 4.2
        of the paper, so that deformations 3 and 4 are the in-plane bending.

        Args:
            p: One end: a point, its name, or its place (x, y, z) [m].
            q: The other end.
            width: Direction of the width, from edge to edge: a vector, or "x", "y", "z". A
                planar model sees the sheet from its side and takes no width.
            beams: Into how many equal beams the sheet is divided. The inner deformations
                are declared independent, so that the counts are those of one beam.
            name: What the sheet is called.
            section: Breadth (along the width) and thickness [m].
            thickness: The thickness [m], instead of `section`.
            breadth: The size along the width [m], instead of `section`.
            material: Gives stiffness and mass, see `wire`.

        Raises:
            ModelError: something of it is wrong; its text begins with the name of the sheet.
        """
        with call("sheet", name):
            return self._sheet(
                p, q, width, beams, name, self._sheet_make(section, thickness, breadth, material)
            )

    def rigid(
        self, p: Point, q: Point, name: str = "", *, section: Section | None = None
    ) -> Element:
        """A rigid link that carries q with p; `body` makes one body of several points.

        It becomes an RBEAM, which holds the position of q alone, unless the orientation
        of q is needed by another element or by a class that names its coordinates, or
        the link itself is given a class; then it becomes a BEAM with everything held.
        The deformations of `release` and `independent` are those of a BEAM.
        `section` is how it is drawn, see `look`.
        """
        with call("rigid", name):
            element = self._beam(p, q, None, (), name, Make(shape_of(section)))
        draft = self._change()
        draft.rigid.add(len(draft.kinds) - 1)
        return element

    def hinge(
        self,
        p: Point,
        axis: Direction | None = None,
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
        with call("hinge", name):
            return self._hinge(p, axis, q, name, independent).q

    def notch(
        self,
        p: Point,
        axis: Direction | None = None,
        q: Node | None = None,
        name: str = "",
        *,
        independent: bool = False,
    ) -> Notch:
        """A notch at p: all is held but the bending about its axis.

        A notch is so short that it is a hinge at a point: what is fastened to p before it,
        and what is fastened to `notch.q` beyond it, turn about the axis against each other.
        Arguments as of `hinge`.

        Returns:
            The notch, with its points p and q.
        """
        with call("notch", name):
            return self._hinge(p, axis, q, name, independent)

    def _hinge(
        self, p: Point, axis: Direction | None, q: Node | None, name: str, independent: bool
    ) -> Notch:
        draft = self._change()
        name = arguments.text(name, "the name of an element")
        direction = arguments.axis(draft, axis)
        near = points.point(draft, p)
        if q is None:
            q = self.pivot(near)
        elif points.point(draft, q).position != near.position:
            raise model_error(
                "two-positions",
                "a hinge joins two points at one position node",
                "make the second point with pivot(p), or leave it out",
            )
        slots = (0, near.orientation, 0, q.orientation)
        number = draft.add_element(self._kind("HINGE"), slots, name, direction, (1,))
        if independent:
            index = draft.index_of(number)
            draft.state_deformations([(index, 1)], Class.INDEPENDENT)
            draft.set_deformation(index, 1, Class.INDEPENDENT)
        return Notch((Element(number, self._owner),), (near, q))

    def _sheet_make(
        self,
        section: Sequence[float] | None,
        thickness: float | None,
        breadth: float | None,
        material: MaterialLike | None,
    ) -> Make:
        shape = sections.sheet_section(section, thickness, breadth)
        return sections.made_of(self._kind("BEAM"), shape, material, "sheet")

    def _sheet(
        self, p: Point, q: Point, width: Direction | None, beams: int, name: str, make: Make
    ) -> Sheet:
        draft = self._change()
        name = arguments.text(name, "the name of a sheet")
        p, q = points.point(draft, p), points.point(draft, q)
        normal = sheet_normal(draft, p, q, width)
        released = (2, 3) if self._planar else (2, 5, 6)
        return Sheet(*self._chain(p, q, normal, released, name, make, beams))

    def _chain(
        self,
        p: Point,
        q: Point,
        y: Direction | None,
        released: tuple[int, ...],
        name: str,
        make: Make,
        beams: int,
    ) -> tuple[tuple[Element, ...], tuple[Node, ...]]:
        """Beams in a row that are one flexure, and their points."""
        draft = self._change()
        name = arguments.text(name, "the name of an element")
        ends = points.point(draft, p), points.point(draft, q)
        inner = between(draft, *ends, beams)
        nodes = (ends[0], *(self.node(each) for each in inner), ends[1])
        names = [f"{name}, {i + 1}" if name and beams > 1 else name for i in range(beams)]
        elements = tuple(
            self._beam(nodes[i], nodes[i + 1], y, released, names[i], make) for i in range(beams)
        )
        if beams > 1:
            declare_inner(draft, (draft.index_of(e.number) for e in elements), released)
        return elements, nodes

    def _beam(
        self,
        p: Point,
        q: Point,
        y: Direction | None,
        released: tuple[int, ...],
        name: str,
        make: Make,
    ) -> Element:
        draft = self._change()
        if y is not None and draft.planar:
            raise model_error("surplus-vector", "a planar beam takes no y vector")
        hint = NO_VECTOR if y is None else arguments.direction(y, "y vector")
        name = arguments.text(name, "the name of an element")
        a, b = points.point(draft, p), points.point(draft, q)
        slots = (
            points.position(draft, a),
            a.orientation,
            points.position(draft, b),
            b.orientation,
        )
        number = draft.add_element(self._kind("BEAM"), slots, name, hint, released, make.shape)
        draft.give_properties(len(draft.kinds) - 1, make.stiffness, make.mass)
        return Element(number, self._owner)
