# SPDX-License-Identifier: BSD-3-Clause
"""Straight lines in space, and what several of them have in common.

Two lines may be one, be parallel or meet; more of them may lie in one plane, meet in one point or
meet one line. Four that are skew and of rank three are generators of one hyperboloid, and six of
rank five belong to one linear complex (Hunt, *Kinematic Geometry of Mechanisms*, 1978; Merlet,
*Parallel Robots*, 2006, section 6.4).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from ...analysis.decomposition import Decomposition
from ...analysis.mode_basis import without_sense
from ...analysis.result import Result
from ...analysis.screws import ScrewKind, screw_of
from ...core.arrays import BoolArray, FloatArray
from ...core.elements import Class
from ...model.parts.parts import Part, PartKind, natural
from ...util.groups import distinct, grouped, groups_of
from ...util.records import cached_property
from .cause import LineKind, Relation, RelationKind
from .gradients import place_key


class Limb(NamedTuple):
    """Flexible parts in a row.

    Attributes:
        parts: They, by name.
        ends: Indices of the position nodes at both ends in the model as given, ascending.
    """

    parts: tuple[Part, ...]
    ends: tuple[int, ...]

    @property
    def name(self) -> str:
        """What the names of its parts begin with, else all of them."""
        heads = {part.name.rpartition(",")[0].strip() for part in self.parts}
        if len(self.parts) == 1:
            return self.parts[0].name
        head = heads.pop()
        return head if not heads and head else " and ".join(part.name for part in self.parts)


class Limbs:
    """The limbs of a mechanism, and where they end."""

    def __init__(self, outcome: Decomposition) -> None:
        """Keep the analysis; what is asked for is found then."""
        self.outcome = outcome
        self.parts = outcome.parts

    @cached_property
    def all(self) -> tuple[Limb, ...]:
        """By name."""
        flexible = [
            part
            for part in self.parts.all
            if part.kind not in (PartKind.BODY, PartKind.HINGE) and len(part.ends) == 2
        ]
        ends = grouped((p, k) for k, part in enumerate(flexible) for p in part.ends)
        inner = {p: users for p, users in ends.items() if self._is_inner(p, len(users))}
        owner = groups_of(len(flexible), ((first, last) for first, last in inner.values())).tolist()
        made = []
        for mine in grouped(zip(owner, flexible, strict=True)).values():
            members = tuple(sorted(mine, key=by_name))
            points = {position for part in members for position in part.ends}
            outer = tuple(sorted(p for p in points if p not in inner))
            made.append(Limb(members, outer))
        return tuple(sorted(made, key=lambda limb: natural(limb.name)))

    def _is_inner(self, position: int, users: int) -> bool:
        """Whether a point is between two parts and nothing else is there."""
        if users != 2 or position in self.parts.body_at or len(self.parts.at(position)) != 2:
            return False
        classes = self.outcome.given.arrays.coordinate_class[:, position]
        turned = self._orientations.get(position, ())
        return bool(np.all(classes != Class.FIXED)) and len(turned) == 1

    @cached_property
    def _orientations(self) -> dict[int, set[int]]:
        """Orientation nodes of the parts that end at each position node."""
        slots = self.outcome.given.arrays.element_node - 1
        made: dict[int, set[int]] = {}
        for p, op in ((0, 1), (2, 3)):
            both = (slots[p] >= 0) & (slots[op] >= 0)
            for place, turned in zip(
                slots[p][both].tolist(), slots[op][both].tolist(), strict=True
            ):
                made.setdefault(place, set()).add(turned)
        return made

    def place(self, position: int) -> FloatArray:
        """(3,) of a position node [m]."""
        return np.asarray(self.outcome.given.arrays.node_value[:3, position])

    @cached_property
    def hubs(self) -> tuple[tuple[object, tuple[tuple[Limb, int], ...]], ...]:
        """Bodies, and points that turn as one where parts meet: the limbs that end there.

        Each with the position nodes at which they do; those that end at the ground alone are
        left out.
        """
        made: dict[object, list[tuple[Limb, int]]] = {}
        for limb in self.all:
            for position in limb.ends:
                body, turning = self.parts.body_at.get(position), self.orientation_at(position)
                if body is not None:
                    made.setdefault(("body", body), []).append((limb, position))
                elif turning is not None and not all(map(self.parts.is_held, (position, turning))):
                    made.setdefault(("joint", position), []).append((limb, position))
        return tuple((key, tuple(found)) for key, found in made.items())

    def orientation_at(self, position: int) -> int | None:
        """The one orientation node at a position node; None where there is none, or several."""
        found = self._orientations.get(position, set())
        return next(iter(found)) if len(found) == 1 else None


def by_name(part: Part) -> tuple[object, ...]:
    """The key by which parts are sorted."""
    return natural(part.name), part.elements


def position_of_hinge(outcome: Decomposition, part: Part) -> int | None:
    """The position node at which a hinge stands; None where none is known."""
    nodes = (outcome.given.arrays.element_node[:, part.elements[0]] - 1).tolist()
    places = (outcome.parts.place_of(node) for node in nodes if node >= 0)
    return next((place for place in places if place is not None), None)


#: What is below this part of the lengths at hand, or this angle [rad], is none.
SAME = 1.0e-6
#: Of more lines only what all have in common is looked for.
_MOST_LINES = 24
_NONE = np.zeros(3)


#: A straight line: (3,) a point of it [m], and (3,) a unit vector along it.
Line = tuple[FloatArray, FloatArray]


def line_of(limbs: Limbs, part: Part) -> Line:
    """The line of a wire, bar or member from end to end."""
    first, last = (limbs.place(end) for end in part.ends)
    return first, (last - first) / np.linalg.norm(last - first)


#: Which of several lines, ascending, and something that they have in common.
Group = tuple[list[int], FloatArray, FloatArray]


class Lines:
    """Several lines of parts, with a length [m] beside which distances count."""

    def __init__(
        self, of: LineKind, lines: Sequence[Line], parts: Sequence[tuple[Part, ...]], length: float
    ) -> None:
        """Keep them, and whose they are; points are taken from the middle of all."""
        self.of, self.parts, self.length = of, parts, length
        points = np.array([point for point, _ in lines]).reshape(-1, 3)
        self.middle = points.mean(axis=0) if len(lines) else np.zeros(3)
        self.points, self.ways = points - self.middle, np.array([way for _, way in lines])
        self.pairs = list(combinations(range(min(len(lines), _MOST_LINES)), 2))

    def __len__(self) -> int:
        """How many."""
        return len(self.points)

    def relation(
        self,
        kind: RelationKind,
        group: Sequence[int],
        direction: FloatArray = _NONE,
        point: FloatArray | None = None,
        *,
        pitch: float = 0.0,
        fold: int = 1,
    ) -> Relation:
        """What some of the lines have in common, with a point of theirs, from the middle."""
        parts = tuple(part for k in group for part in self.parts[k])
        where = _NONE if point is None else point + self.middle
        return Relation(kind, self.of, parts, (), direction, where, pitch=pitch, fold=fold)

    def coordinates(self) -> FloatArray:
        """(n, 6) Pluecker's coordinates, moments over the length."""
        return np.hstack((self.ways, np.cross(self.points, self.ways) / self.length))

    def is_parallel(self, i: int, j: int) -> bool:
        """Whether two are parallel or one."""
        return bool(np.linalg.norm(np.cross(self.ways[i], self.ways[j])) <= SAME)

    def is_one(self, i: int, j: int) -> bool:
        """Whether two are one line."""
        apart = np.cross(self.points[j] - self.points[i], self.ways[i])
        return self.is_parallel(i, j) and bool(np.linalg.norm(apart) <= SAME * self.length)

    def meeting(self, i: int, j: int) -> FloatArray | None:
        """(3,) the point where two meet; None where they do not, or are parallel."""
        normal = np.cross(self.ways[i], self.ways[j])
        size, way = float(normal @ normal), self.points[j] - self.points[i]
        if size <= SAME**2 or abs(float(way @ normal)) > SAME * self.length * size**0.5:
            return None
        t = float(np.cross(way, self.ways[j]) @ normal) / size
        return np.asarray(self.points[i] + t * self.ways[i])

    def together(self, same: Callable[[int, int], bool]) -> list[list[int]]:
        """Groups of two or more that are pairwise the same, each line in one group."""
        left, made = list(range(len(self))), []
        while left:
            first = left[0]
            group = [first, *(k for k in left[1:] if same(first, k))]
            left = [k for k in left if k not in group]
            if len(group) > 1:
                made.append(group)
        return made

    def planes(self) -> list[Group]:
        """Three or more in one plane each: which, the normal, and a point of it."""
        found = []
        for i, j in self.pairs:
            if self.is_one(i, j):
                continue
            if self.is_parallel(i, j):
                normal = np.cross(self.ways[i], self.points[j] - self.points[i])
            elif self.meeting(i, j) is not None:
                normal = np.cross(self.ways[i], self.ways[j])
            else:
                continue
            normal = normal / np.linalg.norm(normal)
            off = np.abs((self.points - self.points[i]) @ normal) <= SAME * self.length
            found.append((off & (np.abs(self.ways @ normal) <= SAME), normal, self.points[i]))
        return _groups(found)

    def meeting_points(self) -> list[Group]:
        """Three or more through one point each: which, nothing, and the point."""
        found = []
        for point in (self.meeting(i, j) for i, j in self.pairs):
            if point is not None:
                off = np.linalg.norm(np.cross(point - self.points, self.ways), axis=1)
                near = SAME * max(self.length, float(np.linalg.norm(point)))
                found.append((off <= near, _NONE, point))
        return _groups(found)


def _groups(found: Iterable[tuple[BoolArray, FloatArray, FloatArray]]) -> list[Group]:
    """Of three lines or more, each group once."""
    every = ((np.flatnonzero(mask).tolist(), normal, point) for mask, normal, point in found)
    large = (each for each in every if len(each[0]) > 2)
    return distinct(large, lambda one, other: bool(one[0] == other[0]))


#: Of more lines nothing is said.
_IN_COMMON_MOST_LINES = 60


def in_common(lines: Lines, *, planar: bool) -> list[Relation]:
    """What dependent lines have in common, the most telling first; nothing if that is not known.

    Args:
        lines: The lines, which are dependent.
        planar: Whether all lie in one plane by themselves.
    """
    if not 2 <= len(lines) <= _IN_COMMON_MOST_LINES:
        return []
    every = range(len(lines))
    ones = [
        lines.relation(
            "one line", group, without_sense(lines.ways[group[0]]), lines.points[group[0]]
        )
        for group in lines.together(lines.is_one)
    ]
    if ones:
        return ones
    values, axes = np.linalg.svd(lines.coordinates())[1:]
    screw = None
    if len(lines) >= 6 and int(np.count_nonzero(values > SAME * values[0])) == 5:
        # The one motion that a body has which is held along these lines.
        rotation, length = axes[5, 3:] / lines.length, lines.length
        screw = screw_of(rotation, axes[5, :3], np.zeros(3), length, rounding=SAME)
    if screw is not None and screw.kind is not ScrewKind.SCREW:
        # Six and more that leave one motion all meet its axis, or lie across it.
        axis = without_sense(screw.direction)
        if screw.kind is ScrewKind.ROTATION:
            return [lines.relation("one transversal", every, axis, screw.point)]
        return [lines.relation("across", every, axis)]
    groups = _cover(lines, planar)
    for group, _, point in lines.meeting_points():
        if len(group) == len(lines):
            whole = [one for mine, one in groups if len(mine) == len(lines)]
            return [lines.relation("concurrent", every, point=point), *whole]
    made = [one for _, one in groups]
    if sum(len(group) for group, _ in groups) == len(lines):
        return made
    if screw is not None:
        axis = without_sense(screw.direction)
        made.insert(0, lines.relation("complex", every, axis, screw.point, pitch=screw.pitch))
    met = (lines.is_parallel(i, j) or lines.meeting(i, j) is not None for i, j in lines.pairs)
    rank = int(np.count_nonzero(values > SAME * values[0]))
    if len(lines) == 4 and rank == 3 and not any(met):
        made.insert(0, lines.relation("regulus", every, point=_NONE))
    return made


def _cover(lines: Lines, planar: bool) -> list[tuple[list[int], Relation]]:
    """Groups that share no line, the largest first: parallel ones, or those in one plane."""
    found = [
        (group, lines.relation("parallel", group, without_sense(lines.ways[group[0]])))
        for group in lines.together(lines.is_parallel)
    ]
    for group, normal, point in [] if planar else lines.planes():
        found.append((group, lines.relation("one plane", group, without_sense(normal), point)))
    found.sort(key=lambda each: (-len(each[0]), each[1].kind == "one plane", each[0]))
    return distinct(found, lambda each, taken: not set(each[0]).isdisjoint(taken[0]))


def clusters_of(result: Result) -> tuple[frozenset[int], ...]:
    """Position nodes of each body of bars that can move, indices in the model as given.

    A triangle is a body; a joint with three bars to a body, two in the plane, belongs to it. Not
    all are found: of a body that no triangle starts nothing is known.
    """
    bars = [part for part in result.parts.all if part.kind is PartKind.BAR]
    near: dict[int, set[int]] = {}
    for part in bars:
        p, q = part.ends
        near.setdefault(p, set()).add(q)
        near.setdefault(q, set()).add(p)
    needed = 2 if result.given.planar else 3
    made: list[frozenset[int]] = []
    for p in sorted(near):
        for q, r in combinations(sorted(k for k in near[p] if k > p), 2):
            if r not in near[q] or any({p, q, r} <= body for body in made):
                continue
            made.append(_grown({p, q, r}, near, needed))
    # Those of which no coordinate of a joint is fixed.
    classes = result.given.arrays.coordinate_class
    free = [body for body in made if not np.any(classes[:, sorted(body)] == Class.FIXED)]

    def key(body: frozenset[int]) -> tuple[object, ...]:
        """By the names of its joints, then by their places."""
        places = result.given.arrays.node_value[:3, sorted(body)].T
        names = sorted(natural(result.parts.name_of_point(node)) for node in body)
        return -len(body), names, sorted(place_key(result, place) for place in places)

    return tuple(sorted(free, key=key))


def _grown(body: set[int], near: dict[int, set[int]], needed: int) -> frozenset[int]:
    while True:
        around = {k for node in body for k in near[node]} - body
        new = {k for k in around if len(near[k] & body) >= needed}
        if not new:
            return frozenset(body)
        body |= new
