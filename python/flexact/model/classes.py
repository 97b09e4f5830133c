# SPDX-License-Identifier: BSD-3-Clause
"""Classes: methods of the builder that say what is fixed, independent, released or held."""

from __future__ import annotations

from ..core.elements import Class
from ..deck.errors import model_error
from ..util.plain_text import in_short
from . import coordinate_arguments as coordinates
from . import deformations
from .handles import FoldedSheet
from .making import Making, call
from .names import is_coordinate, nearest
from .part_arguments import PartLike
from .selection import Point


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
