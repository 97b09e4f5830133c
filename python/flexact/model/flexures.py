# SPDX-License-Identifier: BSD-3-Clause
"""Flexures: methods of the builder that make wires and sheets of one or several beams."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ..deck.rendering import model_error
from ..util.quantities import Quantity
from ..util.text import in_short
from . import sections
from . import selection as arguments
from . import selection as points
from .deformations import declare_inner
from .draft import LARGEST, NO_VECTOR, Draft, Vector
from .elements import ElementMethods, call
from .handles import Element, Node, Sheet, Wire
from .sections import Make, MaterialLike
from .selection import Direction, Point, Section, cross, direction, unit, whole

#: As the core's check of a y vector.
_PARALLEL = 1.0e-6


def place_of(draft: Draft, point: Node) -> Vector:
    """Where a point is [m]."""
    x, y, z = draft.node_value[point.position][:3]
    return x, y, z


def span(draft: Draft, p: Node, q: Node) -> Vector:
    """The vector from p to q [m]."""
    (x0, y0, z0), (x1, y1, z1) = place_of(draft, p), place_of(draft, q)
    return x1 - x0, y1 - y0, z1 - z0


def normal_to(a: Vector, b: Vector) -> Vector:
    """The unit normal of the plane of two vectors; zero where they are parallel."""
    made = cross(unit(a), unit(b))
    if math.hypot(*made) <= _PARALLEL:
        return NO_VECTOR
    x, y, z = unit(made)
    return x + 0.0, y + 0.0, z + 0.0


def sheet_normal(draft: Draft, p: Node, q: Node, width: Direction | None) -> Vector | None:
    """The y vector of a sheet's beams: normal to the sheet, so that z lies in its plane.

    A sheet of no length has none; that is left to the check of the model.
    """
    if draft.planar:
        if width is not None and any(direction(width, "width")[:2]):
            raise model_error("surplus-vector", "the width of a sheet in a planar model is along z")
        return None
    if width is None:
        raise model_error(
            "missing-vector",
            "a sheet needs the direction of its width",
            'give width=(x, y, z), or "x", "y" or "z"',
        )
    wide = direction(width, "width")
    along = unit(span(draft, p, q))
    if along == NO_VECTOR:
        return wide
    normal = normal_to(wide, along)
    if normal == NO_VECTOR:
        raise model_error(
            "parallel-vector",
            "the width of the sheet is parallel to it",
            "give a direction across the sheet, from edge to edge",
        )
    return normal


def between(draft: Draft, p: Node, q: Node, parts: int) -> list[Vector]:
    """Points that divide the way from p to q into equal parts."""
    parts = whole(parts, "the number of beams must be a whole number")
    if not 1 <= parts <= LARGEST:
        raise model_error(
            "out-of-range", f"a flexure cannot be divided into {in_short(parts)} beams"
        )
    start, end = place_of(draft, p), place_of(draft, q)
    made = []
    for i in range(1, parts):
        t = i / parts
        x, y, z = (start[k] * (1.0 - t) + end[k] * t for k in range(3))
        made.append((x, y, z))
    return made


class FlexureMethods(ElementMethods):
    """Methods that make wires and sheets."""

    def wire(
        self,
        p: Point,
        q: Point,
        y: Direction | None = None,
        name: str = "",
        *,
        beams: int = 1,
        section: Section | None = None,
        thickness: Quantity | None = None,
        material: MaterialLike | None = None,
    ) -> Wire:
        """A wire flexure: its elongation is held, torsion and bending are released.

        Args:
            p: One end: a point, its name, or its place (x, y, z) [m].
            q: The other end.
            y: Initial direction of the local y axis.
            name: What the wire is called.
            beams: Into how many equal beams it is divided. The inner deformations are
                declared independent, so that the verdict is that of one beam.
            section: How it is drawn, see `look`: as a rule the diameter [m].
            thickness: The diameter [m], instead of `section`.
            material: "steel", "titanium" or another name of `MATERIALS`, a
                `flexact.Material`, or {"E": ..., "G": ..., "density": ...}. With it the
                beams get ESTIFF (EA, G It, E Iy, E Iz, shear) and EM, which stand in the deck.

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
        section: Sequence[Quantity] | None = None,
        thickness: Quantity | None = None,
        breadth: Quantity | None = None,
        material: MaterialLike | None = None,
        warping: bool | float = False,
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
                are declared independent, so that the verdict is that of one beam.
            name: What the sheet is called.
            section: Breadth (along the width) and thickness [m].
            thickness: The thickness [m], instead of `section`.
            breadth: The size along the width [m], instead of `section`.
            material: Gives stiffness and mass, see `wire`.
            warping: False: the ends are free to warp. True: they are clamped and cannot, which
                raises G It by `flexact.model.sections.warping_factor`; a number is the factor.

        Raises:
            ModelError: something of it is wrong; its text begins with the name of the sheet.
        """
        with call("sheet", name):
            make = self._sheet_make(section, thickness, breadth, material)
            return self._sheet(p, q, width, beams, name, make, warping)

    def _sheet_make(
        self,
        section: Sequence[Quantity] | None,
        thickness: Quantity | None,
        breadth: Quantity | None,
        material: MaterialLike | None,
    ) -> Make:
        shape = sections.sheet_section(section, thickness, breadth)
        return sections.made_of(self._kind("BEAM"), shape, material, "sheet")

    def _sheet(
        self,
        p: Point,
        q: Point,
        width: Direction | None,
        beams: int,
        name: str,
        make: Make,
        warping: bool | float,
    ) -> Sheet:
        draft = self._change()
        name = arguments.text(name, "the name of a sheet")
        p, q = points.point(draft, p), points.point(draft, q)
        normal = sheet_normal(draft, p, q, width)
        released = (2, 3) if self._planar else (2, 5, 6)
        make = make.with_warping(warping, math.hypot(*span(draft, p, q)))
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
        draft.require_two_ends((ends[0].position, 0, ends[1].position, 0))
        inner = between(draft, *ends, beams)
        nodes = (ends[0], *(self.node(each) for each in inner), ends[1])
        names = [f"{name}, {i + 1}" if name and beams > 1 else name for i in range(beams)]
        elements = tuple(
            self._beam(nodes[i], nodes[i + 1], y, released, names[i], make) for i in range(beams)
        )
        if beams > 1:
            declare_inner(draft, (draft.index_of(e.number) for e in elements), released)
        return elements, nodes
