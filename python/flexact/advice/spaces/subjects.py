# SPDX-License-Identifier: BSD-3-Clause
"""Where on a body, and along which lines, wires may be put."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...analysis.result import Result
from ...analysis.screws import ROUNDING
from ...core.arrays import FloatArray
from ...model.parts.parts import PartKind, natural
from ...util.cached import cached_property
from .families import Family, FamilyKind
from .screw_space import ScrewSpace
from .spaces_subjects import Subject

#: Places nearer than this part of the characteristic length are one.
_SAME_PLACE = 1.0e-6
#: A wire is so long, in characteristic lengths, where there is no flexure to take it from.
_LENGTH = 0.5
#: Directions of members that are looked at.
_MOST_DIRECTIONS, _MOST_CROSSED = 24, 6


class Attachment(NamedTuple):
    """A point of a body, or one that a link may carry."""

    place: FloatArray
    """(3,) [m]."""
    position: int
    """Index of a position node of the body: that at the place, or the nearest."""
    orientation: int
    """Index of an orientation node of the body, of those that stand there if there is one."""
    is_there: bool
    """Whether the body has a node at the place."""
    key: tuple[object, ...]
    """By name and place, to decide between equals."""


class Site:
    """A body and what is around it; each answer is found when it is asked for."""

    def __init__(self, result: Result, subject: Subject) -> None:
        """Keep the result and the body."""
        self.result = result
        self.subject = subject
        self.middle = subject.middle(result)
        self._values = result.given.arrays.node_value[:3].T

    @property
    def near(self) -> float:
        """Points nearer than this are one [m]."""
        return _SAME_PLACE * self.result.characteristic_length

    @cached_property
    def own(self) -> tuple[Attachment, ...]:
        """The points of the body, each place once, those with names first."""
        made: list[Attachment] = []
        for node in sorted(self.subject.positions, key=self._key):
            place = self._values[node]
            if all(np.linalg.norm(place - other.place) > self.near for other in made):
                made.append(Attachment(place, node, self._turning(node), True, self._key(node)))
        return tuple(made)

    def carried(self, spaces: Sequence[ScrewSpace]) -> tuple[Attachment, ...]:
        """Points that a link would carry: where lines of these spaces come near to the body."""
        places = [self.middle]
        for family in (each for space in spaces for each in space.lines):
            places += [self._nearest(family, near) for near in (self.middle, *self._own_places)]
            places += list(self._feet(family, self.middle)) if len(family.points) > 2 else []
        return self._carried(places)

    @property
    def reached(self) -> tuple[Attachment, ...]:
        """Points that a longer link would carry, along and across flexures from the middle."""
        arm = _LENGTH * self.result.characteristic_length
        ways = (*self.directions, *np.eye(3)[: 2 if self.result.given.planar else 3])
        return self._carried(
            [self.middle + side * arm * each for each in ways for side in (1.0, -1.0)]
        )

    def _carried(self, places: Sequence[FloatArray]) -> tuple[Attachment, ...]:
        made: list[Attachment] = []
        for place in places:
            there = [each.place for each in (*self.own, *made)]
            if all(np.linalg.norm(place - other) > self.near for other in there):
                base = min(self.own, key=lambda each: self._far(each, place))
                key = ((True,), (), (len(made),))
                made.append(Attachment(place, base.position, base.orientation, False, key))
        return tuple(made)

    @property
    def _own_places(self) -> list[FloatArray]:
        return [each.place for each in self.own]

    def _far(self, one: Attachment, place: FloatArray) -> tuple[object, ...]:
        return round(float(np.linalg.norm(one.place - place)) / self.near), one.key

    def _key(self, node: int) -> tuple[object, ...]:
        """Named points first, then those where named parts end, then by place."""
        parts = self.result.parts
        name = parts.name_of_point(node)
        here = [part.name for part in parts.at(node) if part.kind is not PartKind.BODY]
        place = tuple((np.round(self._values[node] / self.near) + 0.0).tolist())
        return (not name,), natural(name or next(iter(here), "")), place

    def _turning(self, position: int) -> int:
        stands = self.result.parts.position_of
        own = self.subject.orientations
        return next((node for node in own if stands.get(node) == position), own[0])

    def _nearest(self, family: Family, place: FloatArray) -> FloatArray:
        """The point nearest to a place through which lines of a family go."""
        arm = place - family.point
        if family.kind in (FamilyKind.LINE, FamilyKind.MEETING):
            return family.point + (arm @ family.direction) * family.direction
        if family.kind in (FamilyKind.PENCIL, FamilyKind.BUNDLE):
            return family.point
        if family.kind in (FamilyKind.PLANE, FamilyKind.PARALLELS_IN_PLANE):
            return place - (arm @ family.normal) * family.normal
        if len(family.points):
            feet = self._feet(family, place)
            made: FloatArray = feet[int(np.argmin(np.linalg.norm(place - feet, axis=1)))]
            return made
        return place

    @staticmethod
    def _feet(family: Family, place: FloatArray) -> FloatArray:
        """(n, 3) the point of each line of a family that is nearest to a place."""
        arms = place - family.points
        along = np.sum(arms * family.directions, axis=1)[:, None]
        made: FloatArray = family.points + along * family.directions
        return made

    @cached_property
    def directions(self) -> FloatArray:
        """(n, 3) unit vectors that a designer uses already, by the names of their parts.

        Along flexures and hinges, across sheets, and across any two of the first of these.
        """
        parts, frames = self.result.parts, self.result.given.frames.frame
        made: list[FloatArray] = []
        for part in sorted(parts.all, key=lambda one: natural(one.name)):
            if part.kind is PartKind.BODY or len(made) >= _MOST_DIRECTIONS:
                continue
            axes = frames[part.elements[0]].T
            if len(part.ends) == 2:
                _add(np.diff(self._values[list(part.ends)], axis=0)[0], made)
            # Across a wire or about a hinge no direction is different from others.
            used = axes[1:] if part.kind is PartKind.SHEET else axes[:1]
            for axis in used if part.kind in (PartKind.SHEET, PartKind.HINGE) else ():
                _add(axis, made)
        for one, other in itertools.combinations(made[:_MOST_CROSSED], 2):
            _add(np.cross(one, other), made)
        return np.array(made).reshape(-1, 3)

    @cached_property
    def length(self) -> float:
        """How long a new wire is: as the flexures are, the median [m]."""
        sizes = [
            float(np.linalg.norm(np.diff(self._values[list(part.ends)], axis=0)))
            for part in self.result.parts.all
            if part.kind in (PartKind.WIRE, PartKind.SHEET, PartKind.BAR) and len(part.ends) == 2
        ]
        return float(np.median(sizes)) if sizes else _LENGTH * self.result.characteristic_length

    def ground(self, place: FloatArray, direction: FloatArray) -> FloatArray:
        """(3,) the other end of a wire from a place: on the side where there is most room [m]."""
        used = self.result.parts.data.arrays.node_kind <= 2
        nodes = self._values[used]
        mean = nodes.mean(axis=0)
        sides = []
        for sense in (1.0, -1.0):
            end = place + sense * self.length * direction
            room = float(np.min(np.linalg.norm(nodes - end, axis=1))) / self.length
            outward = sense * float((place - mean) @ direction) / self.length
            sides.append((round(outward, 6), round(room, 6), sense, end))
        # Outward, unless something is there already.
        sides.sort(key=lambda side: (side[1] > 1.0e-3, *side[:3]), reverse=True)
        made: FloatArray = sides[0][3]
        return made


def _add(axis: FloatArray, made: list[FloatArray]) -> None:
    """Keep a direction that is none of those."""
    size = float(np.linalg.norm(axis))
    if size > 0.0 and all(abs(axis @ other) < (1.0 - ROUNDING) * size for other in made):
        made.append(axis / size)
