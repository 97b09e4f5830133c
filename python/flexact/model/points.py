# SPDX-License-Identifier: BSD-3-Clause
"""Points: methods of the builder that make and find them."""

from __future__ import annotations

from collections.abc import Sequence

from ..util.quantities import Quantity
from . import selection as points
from .handles import Node
from .making import Making, call
from .selection import Point


class PointMethods(Making):
    """Methods about points."""

    def node(
        self,
        x: Quantity | Sequence[Quantity],
        y: Quantity | None = None,
        z: Quantity | None = None,
        *,
        name: str = "",
    ) -> Node:
        """Add a point [m]; its orientation is used only if an element needs it.

        It is a new one also where there is one already: `point` finds that. Where nothing joins
        two points at one place, a warning of the model says so.

        Args:
            x: Its first coordinate, or a vector or array of all of them.
            y: Its second coordinate.
            z: Its third coordinate, 0 by default.
            name: What the point is called, such as "clamp 1"; not "x", "rz" or the like.

        Raises:
            ModelError: a coordinate is no finite number, or the name is none.
        """
        draft = self._change()
        given = x if y is None and z is None else (x, y, 0.0 if z is None else z)
        with call("node", name):
            value = points.place(draft, given)  # type: ignore[arg-type]
            made = points.checked_name(name)
            node = points.add_point(draft, value)
            draft.name_node(node.position, made)
        return node

    def pivot(self, node: Point) -> Node:
        """Another point at the position of `node`, with an orientation of its own."""
        draft = self._change()
        return points.pivot(draft, points.position(draft, node))

    def handle(self, position: int, orientation: int = 0) -> Node:
        """The point made of two nodes by their numbers, for a model from a deck.

        Raises:
            ModelError: there is no such node, or it is of the other kind.
        """
        return points.handle(self._change(), position, orientation)

    def point(self, point: Point) -> Node:
        """The point of this name, or at this place.

        Args:
            point: Its name, (x, y, z) [m], within 1e-9 of the model's largest coordinate, a
                handle, or a body, whose first point it is.

        Raises:
            ModelError: there is none, or several have this name; the nearest names are told.
        """
        return points.existing(self._change(), point)
