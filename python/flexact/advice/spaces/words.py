# SPDX-License-Identifier: BSD-3-Clause
"""Screw spaces in words: their families by the names of what lies there."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...analysis.decomposition import Decomposition
from ...analysis.limits import SAME_PLACE
from ...analysis.mode_words import bare_line_words
from ...analysis.naming import Pieces
from ...analysis.places import axis_words, listed, part_words, place_words, with_article
from ...core.arrays import FloatArray
from ...core.elements import NodeKind
from ...model.parts.parts import Part, PartKind, natural
from ...util.records import cached_property
from ...util.units import Units
from .screws import SAME, Family, FamilyKind, ScrewSpace

#: What belongs to a family in space, of those that no plane and no point says.
_FAMILIES = {
    FamilyKind.LINE: "{line}",
    FamilyKind.SCREW: "{line}",
    FamilyKind.PARALLELS: "all lines along {along}",
    FamilyKind.MEETING_ACROSS: "all lines that meet {line} and are perpendicular to {along}",
    FamilyKind.MEETING: "all lines that meet {line} or are parallel to it",
    FamilyKind.ACROSS: "all lines perpendicular to {along}",
    FamilyKind.CONGRUENCE: "the lines of a linear congruence, one through each point",
    FamilyKind.COMPLEX: "the lines of a linear complex about {line}, pitch {pitch}",
    FamilyKind.EVERY: "every line",
    FamilyKind.DIRECTION: "{along}",
    FamilyKind.DIRECTIONS_IN_PLANE: "every direction perpendicular to {normal}",
    FamilyKind.EVERY_DIRECTION: "every direction",
}

#: The same in the plane, where a rotation is one about a point.
_IN_PLANE = {
    FamilyKind.PARALLELS: "every point",
    FamilyKind.PLANE: "every line",
    FamilyKind.DIRECTIONS_IN_PLANE: "every direction",
}


class Geometry:
    """Lines, planes and points in words: by names where something of a mechanism lies there.

    Attributes:
        units: Of lengths.
        length: The characteristic length [m].
        planar: Whether rotations are about points of a plane.
        outcome: The mechanism as it was given; None where there is none yet.
    """

    def __init__(
        self,
        units: Units,
        length: float,
        *,
        planar: bool = False,
        outcome: Decomposition | None = None,
    ) -> None:
        """Of a mechanism, or of none."""
        self.units, self.length, self.planar, self.outcome = units, length, planar, outcome
        self._near = SAME * length

    @classmethod
    def of_mechanism(cls, outcome: Decomposition) -> Geometry:
        """That of a mechanism."""
        given = outcome.given
        length = outcome.characteristic_length
        return cls(given.units, length, planar=given.planar, outcome=outcome)

    def of(self, family: Family) -> str:
        """What belongs to a family, such as "all lines through A in the plane z = 0.04 m"."""
        made = self._in_plane(family) if self.planar else ""
        return made or self._in_space(family)

    def _in_space(self, family: Family) -> str:
        kind = family.kind
        along = axis_words(family.direction) if family.direction.any() else ""
        normal = axis_words(family.normal) if family.normal.any() else ""
        if kind in (FamilyKind.PENCIL, FamilyKind.BUNDLE):
            plane = f" in {self.plane(family)}" if kind is FamilyKind.PENCIL else ""
            return f"all lines through {self.point(family.point)}{plane}"
        if kind in (FamilyKind.PLANE, FamilyKind.PARALLELS_IN_PLANE):
            way = f" along {along}" if kind is FamilyKind.PARALLELS_IN_PLANE else ""
            return f"all lines{way} in {self.plane(family)}"
        if kind is FamilyKind.REGULUS:
            if not along:
                return f"one set of lines on a hyperbolic paraboloid, all perpendicular to {normal}"
            where = self.point(family.point)
            return f"one set of lines on a hyperboloid about {where}, its axis along {along}"
        lines = [self.line(*each) for each in zip(family.points, family.directions, strict=True)]
        if kind is FamilyKind.MEETING_TWO:
            return f"all lines that meet {listed(sorted(lines))}"
        line = lines[0] if lines else ""
        return _FAMILIES[kind].format(
            line=line, along=along, normal=normal, pitch=self.units.said(family.pitch, "m")
        )

    def _in_plane(self, family: Family) -> str:
        """The same where a rotation is one about a point; empty where there is no difference."""
        if family.kind is FamilyKind.PENCIL:
            return f"all lines through {self.point(family.point)}"
        if family.kind is not FamilyKind.PARALLELS_IN_PLANE:
            return _IN_PLANE.get(family.kind, "")
        if abs(family.direction[2]) <= 0.5:
            return f"all lines along {axis_words(family.direction)}"
        across = np.cross(family.normal, family.direction)
        return f"every point of {self.line(family.point, across)}"

    @cached_property
    def _named(self) -> tuple[tuple[str, FloatArray], ...]:
        """Names of points as sentences have them, and where they are, by name.

        Without those inside divided sheets, and those that go by a part that ends on a body.
        """
        if self.outcome is None:
            return ()
        parts, kinds = self.outcome.parts, self.outcome.given.arrays.node_kind
        values = self.outcome.given.arrays.node_value[:3].T
        inner = self.outcome.carriers.inner
        nodes = [k for k in np.flatnonzero(kinds <= NodeKind.POSITION).tolist() if k not in inner]
        names = ((k, parts.name_of_point(k)) for k in nodes)
        able = [
            (name, k) for k, name in names if name and with_article(name) == place_words(parts, k)
        ]
        able.sort(key=lambda each: natural(each[0]))
        return tuple((with_article(name), values[k]) for name, k in able)

    def point(self, place: FloatArray) -> str:
        """A point by its name, or by its coordinates [m]."""
        for name, there in self._named:
            if np.linalg.norm(place - there) <= self._near:
                return name
        count = 2 if self.planar else 3
        numbers = ", ".join(map(self._number, place[:count].tolist()))
        return f"({numbers}) {self.units.symbol('m')}"

    def _number(self, value: float) -> str:
        return "0" if abs(value) < self._near else f"{self.units.shown(value, 'm'):.4g}"

    def line(self, point: FloatArray, direction: FloatArray) -> str:
        """A line by the wire, bar or hinge on it, by a point that has a name, or by numbers."""
        for part, frame, ends in self._parts(PartKind.WIRE, PartKind.BAR, PartKind.HINGE):
            if not len(ends):
                continue
            if part.kind is PartKind.HINGE:
                axis = frame[:, 0]
                if abs(axis @ direction) > 1.0 - SAME and self._is_on(ends[0], point, direction):
                    return f"the axis of {part_words(part)}"
            elif all(self._is_on(end, point, direction) for end in ends):
                return f"the line of {part_words(part)}"
        for name, there in self._named:
            if self._is_on(there, point, direction):
                if self.planar and abs(direction[2]) > 0.5:
                    return name
                return f"the line through {name} along {axis_words(direction)}"
        least = SAME_PLACE * self.length
        return bare_line_words(point, direction, self.units, least, planar=self.planar)

    def _parts(self, *kinds: PartKind) -> Iterator[tuple[Part, FloatArray, FloatArray]]:
        """Parts of some kinds by name, the frame of the first element and the ends of each."""
        if self.outcome is None:
            return
        given = self.outcome.given
        able = [part for part in self.outcome.parts.all if part.kind in kinds]
        for part in sorted(able, key=lambda part: natural(part.name)):
            ends = given.arrays.node_value[:3].T[list(part.ends)]
            yield part, given.frames.frame[part.elements[0]], ends

    def _is_on(self, place: FloatArray, point: FloatArray, direction: FloatArray) -> bool:
        return bool(np.linalg.norm(np.cross(place - point, direction)) <= self._near)

    def plane(self, family: Family) -> str:
        """The plane of a family, by the sheet in it, by an axis across it, or by numbers."""
        point, normal = family.point, family.normal
        for part, frame, ends in self._parts(PartKind.SHEET):
            wide = int(self.outcome.parts.wide[part.elements[0]]) if self.outcome is not None else 0
            if not wide:
                continue
            own = np.cross(frame[:, 0], frame[:, wide])
            off = (ends - point) @ normal
            if abs(own @ normal) > 1.0 - SAME and np.abs(off).max() <= self._near:
                return f"the plane of {part_words(part)}"
        across = axis_words(normal)
        if across in ("x", "y", "z"):
            number = self._number(float(point["xyz".index(across)]))
            return f"the plane {across} = {number} {self.units.symbol('m')}"
        return f"the plane through {self.point(point)} perpendicular to {across}"


def space_in_words(geometry: Geometry, space: ScrewSpace) -> tuple[Pieces, ...]:
    """The families of a space, or that it is everything."""
    if space.dimension == (3 if space.planar else 6):
        return (("every force and moment" if space.of_wrenches else "every motion",),)
    order = list(dict.fromkeys(family.kind for family in space.families))
    found = [(order.index(each.kind), _family(geometry, each, space)) for each in space.families]
    return tuple((words,) for _, words in sorted(found, key=lambda one: (one[0], natural(one[1]))))


def _family(geometry: Geometry, family: Family, space: ScrewSpace) -> str:
    words = geometry.of(family)
    if family.is_of_directions:
        return f"moments about {words}" if space.of_wrenches else f"translation along {words}"
    if family.kind is FamilyKind.SCREW:
        units = geometry.units
        if space.of_wrenches:
            pitch = units.said(family.pitch, "m")
            return f"a force along {words} with a moment about it, pitch {pitch}"
        return f"a screw about {words}, pitch {units.said(family.pitch, 'm/rad')}"
    if space.of_wrenches:
        one = family.kind is FamilyKind.LINE
        return f"a force along {words}" if one else f"forces along {words}"
    return f"rotation about {words}"
