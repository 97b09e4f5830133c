# SPDX-License-Identifier: BSD-3-Clause
"""Loads: methods of the builder that give forces, moments and gravity."""

from __future__ import annotations

from collections.abc import Sequence

from ..core.elements import Class, NodeKind, is_position
from ..deck.rendering import model_error
from ..util.quantities import Quantity
from ..util.text import in_short
from . import deformations
from . import selection as arguments
from . import selection as coordinates
from .draft import Draft
from .elements import Making, call
from .handles import FoldedSheet
from .names import is_coordinate, nearest
from .selection import PartLike, Point, nodes_of


class ClassMethods(Making):
    """Methods that give classes of coordinates and deformations, and take them back."""

    def fix(self, *points: Point | int) -> None:
        """Fix points, or coordinates of them, eq. (7): a support.

        `fix(a, b)` clamps both points, `fix(a, "x", "y")` fixes two coordinates of one.

        Args:
            *points: Points, their names or places, bodies, or numbers of nodes; then names of
                coordinates out of x, y, z, rx, ry, rz, by default all that there are.

        Raises:
            ModelError: there is no such point or coordinate, or it has another class.
        """
        draft = self._change()
        targets = [each for each in points if not is_coordinate(each)]
        names = [each for each in points if is_coordinate(each)]
        if not targets:
            raise model_error("not-a-node", "fix needs a point", 'such as fix("clamp 1", "x")')
        for each in targets[1:]:
            if isinstance(each, str) and not self._is_point(each):
                near = nearest(each, [*draft.points_by_name, *draft.parts_by_name])
                hint = f"did you mean {' or '.join(map(in_short, near))}?" if near else ""
                raise model_error(
                    "component-out-of-range",
                    f"there is no coordinate or point {in_short(each)}",
                    hint or "coordinates are x, y, z, rx, ry, rz",
                )
        with call("fix", targets[0] if len(targets) == 1 else ""):
            coordinates.give_coordinates(draft, targets, names, Class.FIXED)

    def independent(
        self,
        target: Point | PartLike | FoldedSheet,
        *which: str | int,
        at: Point | None = None,
    ) -> None:
        """Make coordinates or deformations independent: degrees of freedom, eq. (6).

        `independent("stage", "y")`, `independent("sheet 1", "out-of-plane bending", at=fold)`.

        Args:
            target: A point or a part, by handle or name, or a place; or a number, of a node
                where coordinates are named, of an element where deformations are numbered.
            *which: Coordinates by name, or deformations by word or number; by default all.
            at: The end of a part at which it bends, see `release`.
        """
        draft = self._change()
        with call("independent", target):
            if at is not None or deformations.means_part(draft, target, which):
                deformations.give_deformations(draft, target, which, Class.INDEPENDENT, at)
            else:
                coordinates.give_coordinates(draft, [target], which, Class.INDEPENDENT)

    def release(
        self, part: PartLike | FoldedSheet, *which: str | int, at: Point | None = None
    ) -> None:
        """Release deformations, by default all: they are free to change.

        A sheet of several beams is released as one beam would be: bending at p in its first
        beam, at q in its last one, elongation and twist in one beam alone.

        Args:
            part: A part, its name, or the number of an element.
            *which: "elongation", "twist", "in-plane bending" (which a sheet holds),
                "out-of-plane bending", "bending", "bending about y" or "about z" (local
                axes); of a hinge "rotation", "tilt"; or numbers, from 1.
            at: The end at which it bends: a point, its name, the body there, "p" or "q"; by
                default both.

        Raises:
            ModelError: the part has no such deformation, does not end there, or the deformation
                is independent.
        """
        with call("release", part):
            deformations.give_deformations(self._change(), part, which, Class.DEPENDENT, at)

    def hold(
        self, part: PartLike | FoldedSheet, *which: str | int, at: Point | None = None
    ) -> None:
        """Hold deformations, by default all: takes a release or an independent one back.

        Arguments and errors as of `release`.
        """
        with call("hold", part):
            deformations.give_deformations(self._change(), part, which, Class.FIXED, at)

    def clear(self, point: Point | int, *names: str) -> None:
        """Take back what `fix` and `independent` said of a point: it is free to move.

        Args:
            point: A point, its name or place, or the number of a node.
            *names: Coordinates out of x, y, z, rx, ry, rz; by default all.
        """
        with call("clear", point):
            coordinates.clear_coordinates(self._change(), point, names)

    def _is_point(self, name: str) -> bool:
        draft = self._change()
        return name in draft.points_by_name or name in draft.parts_by_name


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
