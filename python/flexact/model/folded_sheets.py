# SPDX-License-Identifier: BSD-3-Clause
"""Folded sheets: the method of the builder that makes them."""

from __future__ import annotations

from collections.abc import Sequence

from ..deck.errors import model_error
from ..util.quantities import Quantity
from . import arguments
from . import selection as points
from .arguments import Direction
from .bodies import BodyMethods
from .classes import ClassMethods
from .draft import NO_VECTOR, Vector
from .handles import FoldedSheet
from .making import call
from .material import MaterialLike
from .selection import Point
from .sheet_geometry import normal_to, span


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
