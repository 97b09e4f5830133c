# SPDX-License-Identifier: BSD-3-Clause
"""Assemblies of sheets and a body: methods that make cross hinges and parallel guides."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypedDict

from ..deck.errors import model_error
from ..util.quantities import Quantity
from . import arguments
from . import selection as points
from .arguments import Direction
from .assembly_names import AssemblyNames
from .draft import Draft
from .folded_sheets import FoldedSheetMethods, across
from .handles import Assembly, Node
from .making import call
from .material import MaterialLike
from .selection import Point
from .sheet_geometry import normal_to, span

#: Of one guide.
_MOST_SHEETS = 1000


class SheetAssemblyMethods(FoldedSheetMethods):
    """Methods that make cross hinges and parallel guides."""

    def cross_hinge(
        self,
        ground: Iterable[Point],
        moving: Iterable[Point],
        width: Direction | None = None,
        name: str = "",
        *,
        carries: Iterable[Point] = (),
        mass: Quantity | None = None,
        inertia: Quantity | Sequence[Quantity] | None = None,
        beams: int = 1,
        section: Sequence[Quantity] | None = None,
        thickness: Quantity | None = None,
        breadth: Quantity | None = None,
        material: MaterialLike | None = None,
        warping: bool | float = False,
    ) -> Assembly:
        """A cross hinge: two, three or more sheets that cross, and the body that they carry.

        The k-th sheet goes from the k-th point of `ground` to the k-th of `moving`. The body
        turns about the line in which the sheets cross. Nothing is clamped: say
        `fix(*hinge.ground)`, or give the points to a body.

        Args:
            ground: Points on the near side, one a sheet.
            moving: Points on the body, one a sheet.
            width: Direction of the width of the sheets, which is that of the axis; by default
                normal to the first two sheets.
            name: What it is called: its parts are "name sheet 1", ..., "name body".
            carries: Further points of the body.
            mass: Of the body [kg], at its first point, see `body`.
            inertia: Of the body, see `body`.
            beams: Into how many beams each sheet is divided.
            section: Breadth and thickness of the sheets [m].
            thickness: The thickness [m], instead of `section`.
            breadth: The size along the axis [m], instead of `section`.
            material: See `wire`.
            warping: See `sheet`.

        Returns:
            Parts "sheet 1", ..., "body" and points "ground 1", ..., "body 1", ...
        """
        draft = self._change()
        with call("cross_hinge", name):
            near = [
                points.point(draft, p) for p in arguments.several(ground, "points of the ground")
            ]
            far = points.listed(draft, moving, "points of the body")
            if len(near) != len(far) or len(near) < 2:
                raise model_error(
                    "bad-number",
                    f"a cross hinge with {len(near)} points on the ground and {len(far)} on the "
                    "body",
                    "give as many points of the one as of the other, at least two",
                )
            if width is None and not self._planar:
                along = (span(draft, p, q) for p, q in zip(near[:2], far[:2], strict=True))
                width = across(normal_to(*along), "the first two sheets are parallel")
            make = _Sheets(
                section=section,
                thickness=thickness,
                breadth=breadth,
                material=material,
                warping=warping,
            )
            return self._sheets_and_body(
                (near, far), width, name, "body", carries, beams, make, mass, inertia
            )

    def parallel_guide(
        self,
        p: Point,
        q: Point,
        offset: Sequence[Quantity],
        width: Direction | None = None,
        name: str = "",
        *,
        sheets: int = 2,
        carries: Iterable[Point] = (),
        mass: Quantity | None = None,
        inertia: Quantity | Sequence[Quantity] | None = None,
        beams: int = 1,
        section: Sequence[Quantity] | None = None,
        thickness: Quantity | None = None,
        breadth: Quantity | None = None,
        material: MaterialLike | None = None,
        warping: bool | float = False,
    ) -> Assembly:
        """A parallel guide: equal sheets side by side, and the stage that they carry.

        The stage moves along the normal of the sheets. Nothing is clamped: say
        `fix(*guide.ground)`, or give the points to a body.

        Args:
            p: The near end of the first sheet: a point, its name, or its place [m].
            q: Its end on the stage.
            offset: From each sheet to the next, (x, y, z) [m].
            width: Direction of the width; by default normal to the sheet and the offset.
            name: What it is called: its parts are "name sheet 1", ..., "name stage".
            sheets: How many sheets there are, two or more.
            carries: Further points of the stage.
            mass: Of the stage [kg], see `body`.
            inertia: Of the stage, see `body`.
            beams: Into how many beams each sheet is divided.
            section: Breadth and thickness of the sheets [m].
            thickness: The thickness [m], instead of `section`.
            breadth: The size along the width [m], instead of `section`.
            material: See `wire`.
            warping: See `sheet`.

        Returns:
            Parts "sheet 1", ..., "stage" and points "ground 1", ..., "stage 1", ...
        """
        draft = self._change()
        with call("parallel_guide", name):
            count = arguments.count(sheets, 2, _MOST_SHEETS, "sheets")
            step = points.place(draft, offset)
            first = points.point(draft, p), points.point(draft, q)
            if width is None and not self._planar:
                normal = normal_to(span(draft, *first), step[:3])
                width = across(normal, "the offset is along the sheets")
            near, far = (
                [end, *(_shifted(draft, end, step, k) for k in range(1, count))] for end in first
            )
            make = _Sheets(
                section=section,
                thickness=thickness,
                breadth=breadth,
                material=material,
                warping=warping,
            )
            return self._sheets_and_body(
                (near, far), width, name, "stage", carries, beams, make, mass, inertia
            )

    def _sheets_and_body(
        self,
        ends: tuple[list[Node], list[Node]],
        width: Direction | None,
        name: str,
        body_word: str,
        carries: Iterable[Point],
        beams: int,
        sheets: _Sheets,
        mass: Quantity | None,
        inertia: Quantity | Sequence[Quantity] | None,
    ) -> Assembly:
        """Sheets between two rows of points, and the body that carries the far ones."""
        naming = AssemblyNames(self._change(), arguments.text(name, "the name of an assembly"))
        names = naming.numbered("sheet", len(ends[0]))
        made = [
            self.sheet(p, q, width, beams, sheet, **sheets)
            for p, q, sheet in zip(*ends, names, strict=True)
        ]
        further = points.listed(self._change(), carries, "further points of the body")
        body = self.body([*ends[1], *further], naming.free(body_word), mass=mass, inertia=inertia)
        return naming.assembly("sheet", made, body_word, body, list(ends))


class _Sheets(TypedDict):
    """What the sheets of an assembly are made of."""

    section: Sequence[Quantity] | None
    thickness: Quantity | None
    breadth: Quantity | None
    material: MaterialLike | None
    warping: bool | float


def _shifted(draft: Draft, node: Node, step: Sequence[float], k: int) -> Node:
    """The point k steps from this one."""
    here = draft.node_value[node.position]
    size = 2 if draft.planar else 3
    return points.at_place(draft, [here[i] + k * step[i] for i in range(size)])
