# SPDX-License-Identifier: BSD-3-Clause
"""Loads: methods of the builder that give forces, moments and gravity."""

from __future__ import annotations

from collections.abc import Sequence

from ..core.elements import NodeKind, is_position
from ..deck.errors import model_error
from ..util.quantities import Quantity
from . import arguments
from .coordinate_arguments import nodes_of
from .draft import Draft
from .making import Making, call
from .selection import Point


class LoadMethods(Making):
    """Methods that give loads; the verdict does not depend on them."""

    def force(
        self,
        point: Point | int,
        x: Quantity | Sequence[Quantity],
        y: Quantity | None = None,
        z: Quantity | None = None,
        *,
        increment: bool = False,
    ) -> None:
        """Give a point a force [N], in place of the one that it had: XF in a deck.

        Args:
            point: A point, its name or place, a body, or the number of a position node.
            x: Its component along x, or all of them.
            y: Its component along y.
            z: Its component along z, 0 by default; not in a planar model.
            increment: Whether it is added to another in the course of loading: DELXF.

        Raises:
            ModelError: there is no such point, or a component is no finite number.
        """
        draft = self._change()
        with call("force", point):
            number = _node(draft, point, wants_position=True)
            said = _vector(draft, x, y, z, "force", "N")
        (draft.loads.increment if increment else draft.loads.force)[number] = said

    def moment(
        self,
        point: Point | int,
        x: Quantity | Sequence[Quantity],
        y: Quantity | None = None,
        z: Quantity | None = None,
        *,
        increment: bool = False,
    ) -> None:
        """Give a point a moment [N m], in place of the one that it had: XF of its orientation.

        It works on small rotations about fixed axes: it does not turn with the point.

        Args:
            point: A point, its name or place, a body, or the number of an orientation node.
            x: Its component about x, or all of them; in a planar model the moment about z.
            y: Its component about y.
            z: Its component about z, 0 by default.
            increment: Whether it is added to another in the course of loading: DELXF.

        Raises:
            ModelError: there is no such point, or a component is no finite number.
        """
        draft = self._change()
        with call("moment", point):
            number = _node(draft, point, wants_position=False)
            if draft.node_kind[number] == NodeKind.ANGLE:
                said = (0.0, 0.0, _single(x, y, z))
            else:
                said = _vector(draft, x, y, z, "moment", "N m")
        (draft.loads.increment if increment else draft.loads.force)[number] = said

    def gravity(
        self, x: Quantity | Sequence[Quantity], y: Quantity | None = None, z: Quantity | None = None
    ) -> None:
        """Give the acceleration of free fall [m/s2]: GRAVITY in a deck.

        Copies and `rotate` leave it as it is.

        Args:
            x: Its component along x, or all of them.
            y: Its component along y.
            z: Its component along z, 0 by default; not in a planar model.

        Raises:
            ModelError: a component is no finite number.
        """
        draft = self._change()
        with call("gravity", ""):
            said = _vector(draft, x, y, z, "acceleration", "m/s2")
        draft.loads.gravity = said


def _node(draft: Draft, point: object, wants_position: bool) -> int:
    numbers = nodes_of(draft, point)
    for number in numbers:
        if is_position(draft.node_kind[number]) == wants_position:
            return number
    raise model_error(
        "two-kinds-of-node",
        f"node {numbers[0]} is {'an orientation' if wants_position else 'a position'}",
        "a position has a force, an orientation a moment",
    )


def _vector(
    draft: Draft, x: object, y: Quantity | None, z: Quantity | None, what: str, unit: str
) -> tuple[float, float, float]:
    """Three numbers; the last may be missing, and in a plane must be nothing."""
    given = arguments.several(x, f"the components of a {what}") if y is None and z is None else ()
    given = given or (x, y, 0.0 if z is None else z)
    if len(given) == 2:
        given = (*given, 0.0)
    made = arguments.vector(given, what, unit)  # type: ignore[arg-type]
    if draft.planar and made[2]:
        raise model_error("bad-number", f"the {what} has a z component in a planar model")
    return made


def _single(x: object, y: Quantity | None, z: Quantity | None) -> float:
    given = (x, y, z) if y is not None or z is not None else (0.0, 0.0, x)
    if any(given[:2]):
        raise model_error("bad-number", "a planar moment is one number, that about z")
    return arguments.vector((0.0, 0.0, given[2]), "moment", "N m")[2]  # type: ignore[arg-type]
