# SPDX-License-Identifier: BSD-3-Clause
"""Lines, planes, directions and screws of a freedom or a constraint space in words."""

from __future__ import annotations

import numpy as np

from ...analysis.decomposition import Outcome
from ...analysis.motions import line_words
from ...analysis.places import axis_words, listed, part_words, place_words, with_article
from ...core.arrays import FloatArray
from ...core.elements import NodeKind
from ...model.parts.parts import Part, PartKind, natural
from ...util.cached import cached_property
from .families import SAME, Family, FamilyKind


class Geometry:
    """Lines, planes and points of a mechanism in words: by names where something lies there."""

    def __init__(self, outcome: Outcome) -> None:
        """Of the mechanism as it was given."""
        self.outcome = outcome
        self._values = outcome.given.arrays.node_value[:3].T

    def of(self, family: Family) -> str:
        """What belongs to a family, such as "all lines through A in the plane z = 0.04 m"."""
        planar = self.outcome.given.planar
        made = self._in_plane(family) if planar else ""
        return made or self._in_space(family)

    def _in_space(self, family: Family) -> str:
        kind, along = family.kind, axis_words(family.direction) if family.direction.any() else ""
        if kind is FamilyKind.PENCIL:
            return f"all lines through {self.point(family.point)} in {self.plane(family)}"
        if kind is FamilyKind.BUNDLE:
            return f"all lines through {self.point(family.point)}"
        if kind is FamilyKind.PLANE:
            return f"all lines in {self.plane(family)}"
        if kind is FamilyKind.PARALLELS_IN_PLANE:
            return f"all lines along {along} in {self.plane(family)}"
        lines = [self.line(*each) for each in zip(family.points, family.directions, strict=True)]
        if kind in (FamilyKind.LINE, FamilyKind.SCREW):
            return lines[0]
        if kind is FamilyKind.MEETING_TWO:
            return f"all lines that meet {listed(sorted(lines))}"
        if kind is FamilyKind.MEETING_ACROSS:
            return f"all lines that meet {lines[0]} and are perpendicular to {along}"
        if kind is FamilyKind.REGULUS:
            return self._regulus(family, along)
        return {
            FamilyKind.PARALLELS: f"all lines along {along}",
            FamilyKind.MEETING: f"all lines that meet {lines[0] if lines else ''} or are parallel "
            "to it",
            FamilyKind.ACROSS: f"all lines perpendicular to {along}",
            FamilyKind.CONGRUENCE: "the lines of a linear congruence, one through each point",
            FamilyKind.COMPLEX: f"the lines of a linear complex about {lines[0] if lines else ''}, "
            f"pitch {family.pitch:.4g} m",
            FamilyKind.EVERY: "every line",
            FamilyKind.DIRECTION: along,
            FamilyKind.DIRECTIONS_IN_PLANE: "every direction perpendicular to "
            + (axis_words(family.normal) if family.normal.any() else ""),
            FamilyKind.EVERY_DIRECTION: "every direction",
        }[kind]

    def _in_plane(self, family: Family) -> str:
        """The same where a rotation is one about a point; empty where there is no difference."""
        kind, about_z = family.kind, abs(family.direction[2]) > 0.5
        if kind is FamilyKind.PARALLELS:
            return "every point"
        if kind is FamilyKind.PARALLELS_IN_PLANE and about_z:
            across = np.cross(family.normal, family.direction)
            return f"every point of {self.line(family.point, across)}"
        if kind is FamilyKind.PARALLELS_IN_PLANE:
            return f"all lines along {axis_words(family.direction)}"
        if kind is FamilyKind.PENCIL:
            return f"all lines through {self.point(family.point)}"
        if kind is FamilyKind.PLANE:
            return "every line"
        if kind is FamilyKind.DIRECTIONS_IN_PLANE:
            return "every direction"
        return ""

    def _regulus(self, family: Family, along: str) -> str:
        if family.direction.any():
            where = self.point(family.point)
            return f"one set of lines on a hyperboloid about {where}, its axis along {along}"
        normal = axis_words(family.normal)
        return f"one set of lines on a hyperbolic paraboloid, all perpendicular to {normal}"

    # Names ------------------------------------------------------------------

    @property
    def _near(self) -> float:
        return SAME * self.outcome.characteristic_length

    @cached_property
    def _named(self) -> tuple[tuple[str, FloatArray], ...]:
        """Names of points as sentences have them, and where they are, by name.

        Without those inside divided sheets, and those that go by a part that ends on a body.
        """
        parts, kinds = self.outcome.parts, self.outcome.given.arrays.node_kind
        inner = self.outcome.carriers.inner
        nodes = [k for k in np.flatnonzero(kinds <= NodeKind.POSITION).tolist() if k not in inner]
        names = ((k, parts.name_of_point(k)) for k in nodes)
        able = [(name, k) for k, name in names if name and with_article(name) == self._words(k)]
        able.sort(key=lambda each: natural(each[0]))
        return tuple((with_article(name), self._values[k]) for name, k in able)

    def _words(self, node: int) -> str:
        return place_words(self.outcome.parts, node)

    def point(self, place: FloatArray) -> str:
        """A point by its name, or by its coordinates [m]."""
        for name, there in self._named:
            if np.linalg.norm(place - there) <= self._near:
                return name
        return self._coordinates(place)

    def _coordinates(self, place: FloatArray) -> str:
        count = 2 if self.outcome.given.planar else 3
        return f"({', '.join(self._number(value) for value in place[:count])}) m"

    def _number(self, value: float) -> str:
        return "0" if abs(value) < self._near else f"{value:.4g}"

    def line(self, point: FloatArray, direction: FloatArray) -> str:
        """A line by the wire, bar or hinge on it, by a point that has a name, or by numbers."""
        for part in self._members():
            ends = self._values[list(part.ends)]
            if part.kind is PartKind.HINGE:
                axis = self.outcome.given.frames.frame[part.elements[0]][:, 0]
                if abs(axis @ direction) > 1.0 - SAME and self._is_on(ends[0], point, direction):
                    return f"the axis of {part_words(part)}"
            elif all(self._is_on(end, point, direction) for end in ends):
                return f"the line of {part_words(part)}"
        planar = self.outcome.given.planar
        for name, there in self._named:
            if self._is_on(there, point, direction):
                if planar and abs(direction[2]) > 0.5:
                    return name
                return f"the line through {name} along {axis_words(direction)}"
        return line_words(self.outcome, point, direction)

    def _members(self) -> list[Part]:
        kinds = (PartKind.WIRE, PartKind.BAR, PartKind.HINGE)
        able = [part for part in self.outcome.parts.all if part.kind in kinds and part.ends]
        return sorted(able, key=lambda part: natural(part.name))

    def _is_on(self, place: FloatArray, point: FloatArray, direction: FloatArray) -> bool:
        return bool(np.linalg.norm(np.cross(place - point, direction)) <= self._near)

    def plane(self, family: Family) -> str:
        """The plane of a family, by the sheet in it, by an axis across it, or by numbers."""
        point, normal = family.point, family.normal
        for part in self._sheets():
            frame = self.outcome.given.frames.frame[part.elements[0]]
            own = np.cross(frame[:, 0], frame[:, int(self.outcome.parts.wide[part.elements[0]])])
            off = (self._values[list(part.ends)] - point) @ normal
            if abs(own @ normal) > 1.0 - SAME and np.abs(off).max() <= self._near:
                return f"the plane of {part_words(part)}"
        across = axis_words(normal)
        if across in ("x", "y", "z"):
            return f"the plane {across} = {self._number(float(point['xyz'.index(across)]))} m"
        return f"the plane through {self.point(point)} perpendicular to {across}"

    def _sheets(self) -> list[Part]:
        wide = self.outcome.parts.wide
        able = [
            part
            for part in self.outcome.parts.all
            if part.kind is PartKind.SHEET and int(wide[part.elements[0]])
        ]
        return sorted(able, key=lambda part: natural(part.name))
