# SPDX-License-Identifier: BSD-3-Clause
"""What makes the geometry of a special self-stress special: a ladder of simple relations.

First the axes of hinges, then members in one line or plane, then planes of sheets, then the lines
of force along which limbs press on a body, then joints on a circle or conic, then a symmetry, then
what lies along an axis; what none of these explains alone the fewest of them do together, or the
position of all that is stressed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import reduce
from itertools import combinations
from operator import add
from typing import NamedTuple

import numpy as np

from ...analysis.mode_basis import without_sense
from ...analysis.result import Motion, Result, SelfStress
from ...analysis.screws import Screw, ScrewKind, Wrench, WrenchKind
from ...core.arrays import BoolArray, FloatArray
from ...core.elements import Class, NodeKind
from ...model.parts.parts import Part, PartKind, natural
from .cause import LineKind, Relation, RelationKind
from .conditions import (
    Figure,
    Figures,
    are_one,
    circle_terms,
    conic_terms,
    half_turned,
)
from .lines import (
    Common,
    Limb,
    Limbs,
    Line,
    Lines,
    by_name,
    clusters_of,
    in_common,
    line_of,
    position_of_hinge,
)
from .trials import Trials, symmetries_of

_STRAIGHT = (PartKind.WIRE, PartKind.BAR)
#: Loads below this part of the largest are none.
_REST = 1.0e-6


#: A limb, and what it exerts on a body or point where it ends.
Push = tuple[Limb, Wrench]


def pushes_on(stress: SelfStress, limbs: Limbs) -> list[tuple[object, list[Push]]]:
    """What limbs exert in a self-stress, of each body or point on which some do, by limb."""
    carrying = {one.part for one in stress.parts}
    largest = max(end.wrench.size for one in stress.parts for end in one.ends)
    made = []
    for key, ends in limbs.hubs:
        found = []
        for limb, position in ends:
            if not carrying & set(limb.parts):
                continue
            loads = stress.of(limb.at(position)).ends
            wrench = next((end.wrench for end in loads if end.position == position), None)
            if wrench is not None and wrench.size > _REST * largest:
                found.append((limb, wrench))
        if found:
            made.append((key, found))
    return made


def of_forces(result: Result, stress: SelfStress, limbs: Limbs) -> list[Relation]:
    """What lines of force have in common, on the body of which the most lines are known."""
    able = [
        found
        for _, found in pushes_on(stress, limbs)
        if len(found) > 1 and all(_has_line(push) for push in found)
    ]
    for pushes in sorted(able, key=lambda found: -len(found)):
        lines = Lines(
            [Line(wrench.point, wrench.direction) for _, wrench in pushes],
            result.characteristic_length,
        )
        made = [
            Relation(
                *(one.kind, LineKind.FORCE),
                tuple(part for k in one.group for part in pushes[k][0].parts),
                (),
                *(one.direction, one.point),
                _couple([pushes[k][1] for k in one.group]),
                one.pitch,
            )
            for one in in_common(lines, planar=result.given.planar)
        ]
        if made:
            return made
    return []


def _has_line(push: Push) -> bool:
    """Whether a limb can press along one line only: a wire, a bar, or a folded sheet.

    Of other limbs the loads of two or three on a body in balance always share a line or a plane.
    """
    limb, wrench = push
    kinds = [part.kind for part in limb.parts]
    is_straight = len(kinds) == 1 and kinds[0] in _STRAIGHT
    is_folded = kinds == [PartKind.SHEET] * 2
    return wrench.kind is WrenchKind.FORCE and (is_straight or is_folded)


def _couple(wrenches: list[Wrench]) -> FloatArray:
    """(3,) the direction of the couple that wrenches make together; zero where they make none."""
    total = reduce(add, wrenches)
    size = max(wrench.size for wrench in wrenches)
    pushes = float(np.linalg.norm(total.force)) * total.length > _REST * size
    if pushes or total.size <= _REST * size:
        return np.zeros(3)
    return without_sense(total.moment / np.linalg.norm(total.moment))


#: What is below this part of the lengths at hand, or this angle [rad], is none.
_SAME = 1.0e-6


class _Plane(NamedTuple):
    part: Part
    point: FloatArray
    normal: FloatArray


def of_sheets(
    result: Result, stresses: Sequence[SelfStress], limbs: Limbs, motions: Sequence[Motion]
) -> Iterator[tuple[Relation, ...]]:
    """What the planes of sheets have in common with each other and with wires.

    Nothing where other parts than single sheets, wires and bars press on a body. Each is one set
    of relations that may be enough.

    Args:
        result: The result.
        stresses: Some of its self-stresses.
        limbs: Its limbs.
        motions: Its special motions.
    """
    hubs: dict[object, dict[Limb, SelfStress]] = {}
    for stress in stresses:
        for key, pushes in pushes_on(stress, limbs):
            hubs.setdefault(key, {}).update((limb, stress) for limb, _ in pushes)
    for found in hubs.values():
        parts = [limb.parts[0] for limb in found if len(limb.parts) == 1]
        kinds = {part.kind for part in parts}
        if len(parts) < len(found) or not kinds <= {*_STRAIGHT, PartKind.SHEET}:
            continue
        sheets = _Sheets(result, found, limbs, parts)
        yield tuple(sheets.in_one_plane())
        yield tuple(sheets.of_motions(motions))


class _Sheets:
    def __init__(
        self,
        result: Result,
        found: Mapping[Limb, SelfStress],
        limbs: Limbs,
        parts: Sequence[Part],
    ) -> None:
        self.length = result.characteristic_length
        self.limbs = limbs
        self.planes = [
            _Plane(part, limbs.place(part.ends[0]), stress.of(part).normal)
            for part, stress in zip(parts, found.values(), strict=True)
            if part.kind is PartKind.SHEET
        ]
        self.wires = [part for part in parts if part.kind in _STRAIGHT]

    def in_one_plane(self) -> Iterator[Relation]:
        """Sheets, or a sheet and wires, that lie in one plane."""
        told: set[Part] = set()
        for plane in self.planes:
            if plane.part in told:
                continue
            mine = [
                one.part
                for one in self.planes
                if float(np.linalg.norm(np.cross(plane.normal, one.normal))) <= _SAME
                and self._is_near(plane, one.point)
            ]
            mine += [
                wire
                for wire in self.wires
                if all(self._is_near(plane, self.limbs.place(end)) for end in wire.ends)
            ]
            if len(mine) > 1:
                told.update(mine)
                normal = without_sense(plane.normal)
                yield _relation(RelationKind.ONE_PLANE, mine, normal, plane.point)

    def of_motions(self, motions: Sequence[Motion]) -> Iterator[Relation]:
        """A line in all planes that all wires meet, or a direction that all lie across."""
        parts = [*(plane.part for plane in self.planes), *self.wires]
        if not self.planes or len(parts) < 2:
            return
        for screw in (one.screw for motion in motions for one in motion.bodies):
            direction = without_sense(screw.direction)
            if screw.kind is ScrewKind.ROTATION and self._all_let_turn(screw):
                yield _relation(RelationKind.ONE_TRANSVERSAL, parts, direction, screw.point)
                return
            if screw.kind is ScrewKind.TRANSLATION and self._all_let_move(screw):
                yield _relation(RelationKind.ACROSS, parts, direction, np.zeros(3))
                return

    def _all_let_turn(self, screw: Screw) -> bool:
        if not all(
            abs(float(plane.normal @ screw.direction)) <= _SAME
            and self._is_near(plane, screw.point)
            for plane in self.planes
        ):
            return False
        lines = (line_of(self.limbs, wire) for wire in self.wires)
        moments = (np.cross(at - screw.point, way) @ screw.direction for at, way in lines)
        return all(abs(float(moment)) <= _SAME * self.length for moment in moments)

    def _all_let_move(self, screw: Screw) -> bool:
        across = [float(np.linalg.norm(np.cross(p.normal, screw.direction))) for p in self.planes]
        ways = [line_of(self.limbs, wire).direction for wire in self.wires]
        along = [abs(float(way @ screw.direction)) for way in ways]
        return max((*across, *along)) <= _SAME

    def _are_one(self, one: _Plane, other: _Plane) -> bool:
        parallel = float(np.linalg.norm(np.cross(one.normal, other.normal))) <= _SAME
        return parallel and self._is_near(one, other.point)

    def _has(self, plane: _Plane, wire: Part) -> bool:
        return all(self._is_near(plane, self.limbs.place(end)) for end in wire.ends)

    def _is_near(self, plane: _Plane, point: FloatArray) -> bool:
        return abs(float((point - plane.point) @ plane.normal)) <= _SAME * self.length


def _relation(
    kind: RelationKind, parts: Sequence[Part], direction: FloatArray, point: FloatArray
) -> Relation:
    return Relation(kind, LineKind.SHEET, tuple(parts), (), direction, point)


#: Of more axes no half-turn is looked for, nor where they have one of these in common.
_MOST_TURNED = 12
_SIMPLE = (RelationKind.ONE_LINE, RelationKind.CONCURRENT)


def of_axes(result: Result, parts: Sequence[Part]) -> Iterator[tuple[Relation, ...]]:
    """What the axes of some hinges have in common; nothing where there are fewer than two.

    Each is one set of relations that may be enough, the simplest first.
    """
    hinges = _hinges(result, parts)
    if len(hinges) < 2:
        return
    parts = [part for part, _ in hinges]
    lines = Lines([line for _, line in hinges], result.characteristic_length)

    def relation(one: Common) -> Relation:
        mine = tuple(parts[k] for k in one.group)
        kind, pitch = one.kind, one.pitch
        fold = 2 if kind is RelationKind.ROTATION else 1
        place = one.direction, one.point
        return Relation(kind, LineKind.AXIS, mine, (), *place, pitch=pitch, fold=fold)

    groups = [
        Common(RelationKind.PARALLEL, tuple(group), lines.lines[group[0]].direction, np.zeros(3))
        for group in lines.together(lines.is_parallel)
    ]
    points = [
        Common(RelationKind.CONCURRENT, tuple(group), np.zeros(3), lines.in_place(point))
        for group, _, point in lines.points()
    ]
    if groups and sum(len(one.group) for one in groups) == len(lines):
        yield tuple(map(relation, groups))
    common = in_common(lines, planar=result.given.planar)
    is_simple = any(one.kind in _SIMPLE for one in common)
    # By lines of one complex a motion only begins; by a symmetry it goes on.
    for one in () if is_simple else _half_turns(lines):
        yield (relation(one),)
    yield tuple(map(relation, common))
    yield tuple(map(relation, (*groups, *points)))


def _half_turns(lines: Lines) -> Iterator[Common]:
    """Half-turns that take lines onto each other, as in Bricard's line-symmetric loop."""
    count, length = len(lines), lines.length
    if not 4 <= count <= _MOST_TURNED:
        return
    every = [(line.point[None], line.direction[None]) for line in lines.lines]
    for other in range(1, count):
        for direction, point in _swapping(every[0], every[other], length):
            axis = np.concatenate((direction, point / length))[None]
            images = [half_turned(line, axis, length) for line in every]
            found = [
                next((j for j, one in enumerate(every) if are_one(image, one, length)), -1)
                for image in images
            ]
            if -1 not in found and all(i != j for i, j in enumerate(found)):
                place = lines.in_place(point)
                group = tuple(range(count))
                yield Common(RelationKind.ROTATION, group, without_sense(direction), place)


def _swapping(one: Figure, other: Figure, length: float) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Directions and points of the half-turns that swap two lines that are not parallel."""
    ((a,), (u,)), ((b,), (v,)) = one, other
    normal = np.cross(u, v)
    size = float(normal @ normal)
    if size <= 1.0e-12:
        return
    s = float(np.cross(b - a, v) @ normal) / size
    t = float(np.cross(b - a, u) @ normal) / size
    near, far = a + s * u, b + t * v
    for way in (u + v, u - v):
        yield way / np.linalg.norm(way), 0.5 * (near + far)


def _hinges(result: Result, parts: Sequence[Part]) -> list[tuple[Part, Line]]:
    """Hinges and bearings among some parts, with their axes."""
    made = []
    arrays = result.given.arrays
    for part in parts:
        place = position_of_hinge(result, part) if part.kind is PartKind.HINGE else None
        if place is None:
            continue
        axis = arrays.element_vector[:, part.elements[0]]
        if axis.any():
            unit = axis / np.linalg.norm(axis)
            made.append((part, Line(arrays.node_value[:3, place], unit)))
    return made


def conic_of(points: FloatArray) -> RelationKind | None:
    """What six or more points (n, 2) lie on; None where it is neither, or fewer points are given.

    Five points always lie on a conic.
    """
    if len(points) < 6:
        return None
    at = (points - points.mean(axis=0)) / np.abs(points - points.mean(axis=0)).max()
    if _is_dependent(circle_terms(at).T):
        return RelationKind.CIRCLE
    if _are_on_two_lines(at):
        return RelationKind.TWO_LINES
    return RelationKind.CONIC if _is_dependent(conic_terms(at).T) else None


def _are_on_two_lines(points: FloatArray) -> bool:
    """Whether a line through two of the first three, or none of them, leaves the rest on one."""
    for i, j in combinations(range(3), 2):
        on = _is_on_line(points, points[i], points[j])
        rest = points[~on]
        if len(rest) < 3 or bool(_is_on_line(rest, rest[0], rest[1]).all()):
            return True
    return False


def _is_on_line(points: FloatArray, first: FloatArray, second: FloatArray) -> BoolArray:
    way = second - first
    off = (points[:, 0] - first[0]) * way[1] - (points[:, 1] - first[1]) * way[0]
    return np.asarray(np.abs(off) <= _SAME * float(way @ way), bool)


def _is_dependent(rows: FloatArray) -> bool:
    values = np.linalg.svd(rows, compute_uv=False)
    return bool(values[-1] <= _SAME * values[0])


def of_directions(result: Result, parts: Sequence[Part]) -> Iterator[tuple[Relation, ...]]:
    """What lies along or across x, y or z, where these directions matter.

    Each is one set of relations that may be enough: of an axis, then all of them.
    """
    if not _is_split(result):
        return
    figures = Figures(result)
    every: list[Relation] = []
    for axis in np.eye(3)[: 2 if result.given.planar else 3]:
        made: dict[tuple[LineKind, RelationKind], list[Part]] = {}
        for part in parts:
            own = figures.own(part)
            if own is None:
                continue
            way = own[1](*figures.here)[1][0]
            if float(np.linalg.norm(np.cross(way, axis))) <= _SAME:
                made.setdefault((own[0], RelationKind.ALONG), []).append(part)
            elif abs(float(way @ axis)) <= _SAME:
                made.setdefault((own[0], RelationKind.ACROSS_AXIS), []).append(part)
        found = [
            Relation(kind, of, tuple(mine), (), axis, np.zeros(3))
            for (of, kind), mine in made.items()
        ]
        for one in found:
            yield (one,)
        every += found
    yield tuple(every)


def _is_split(result: Result) -> bool:
    """Whether some coordinates of a node are dependent, and others are not."""
    arrays = result.data.arrays
    classes = arrays.coordinate_class
    free = np.any(classes == Class.DEPENDENT, axis=0)
    held = np.any(np.isin(classes, (Class.FIXED, Class.INDEPENDENT)), axis=0)
    return bool(np.any(free & held))


#: How many relations are told, and tried together; and of how many bars bodies are looked for.
_MOST, _MOST_TRIED, _MOST_BARS = 4, 12, 120
#: Of how many self-stresses lines of force are looked at.
_MOST_STRESSES = 4
#: Of self-stresses of more resultants together nothing is said.
_MOST_ENTRIES = 600


def relations_of(
    result: Result,
    stresses: Sequence[int],
    motions: Sequence[Motion],
    trials: Trials,
    special: int = 1,
) -> tuple[Relation, ...]:
    """What makes the geometry of some self-stresses special, the most telling first.

    What is told is enough: other geometries that have it, and nothing else, were tried and have
    as many special self-stresses.

    Args:
        result: A result told by parts.
        stresses: Indices of self-stresses that are special, or of those among which some are.
        motions: Its special motions.
        trials: Tries other geometries.
        special: How many of the self-stresses are special.

    Returns:
        At most four; none where nothing is known to be enough, or so many parts are stressed that
        this would take long.
    """
    entries = [result.stress_basis.entries(k)[0].size for k in stresses]
    if sum(entries) > _MOST_ENTRIES:
        return ()
    chosen = [result.self_stresses[k] for k in stresses]
    return _Ladder(result, chosen, motions, trials, special).found()


class _Ladder:
    def __init__(
        self,
        result: Result,
        stresses: list[SelfStress],
        motions: Sequence[Motion],
        trials: Trials,
        special: int,
    ) -> None:
        self.result, self.stresses, self.motions = result, stresses, motions
        self.limbs, self.trials, self.special = trials.figures.limbs, trials, special
        found = dict.fromkeys(one.part for stress in stresses for one in stress.parts)
        self.parts = tuple(sorted(found, key=by_name))
        self.are_bars = all(part.kind is PartKind.BAR for part in self.parts)

    def found(self) -> tuple[Relation, ...]:
        every: list[Relation] = []
        for made in self._candidates():
            if self._are_enough(made):
                return self._told(made)
            every += made
        return self._least(every)

    def _candidates(self) -> Iterator[tuple[Relation, ...]]:
        """Sets of relations that may be enough, the simplest first."""
        result = self.result
        yield from of_axes(result, self.parts)
        yield tuple(self._of_members())
        yield from of_sheets(result, self.stresses, self.limbs, self.motions)
        for stress in self.stresses[: -1 - _MOST_STRESSES : -1]:
            yield tuple(of_forces(result, stress, self.limbs))
        yield tuple(self._of_clusters())
        yield tuple(self._of_joints())
        if self.are_bars:
            for one in symmetries_of(result, self.parts):
                yield (one,)
        yield from of_directions(result, self.parts)

    def _are_enough(self, relations: Sequence[Relation]) -> bool:
        if not 0 < len(relations) <= _MOST_TRIED:
            return False
        return self.trials.are_enough(relations, self.special)

    def _told(self, relations: Sequence[Relation]) -> tuple[Relation, ...]:
        """Nothing where they are too many to be told."""
        few = relations if len(relations) <= _MOST else ()
        return tuple(replace(one, is_sufficient=True) for one in few)

    def _least(self, every: Sequence[Relation]) -> tuple[Relation, ...]:
        """As few relations as are enough together, else the parts that stand so."""
        left = list(merged(every))
        if self._are_enough(left):
            for one in reversed(tuple(left)):
                rest = [other for other in left if other is not one]
                if self._are_enough(rest):
                    left = rest
            return self._told(left)
        nowhere = np.zeros(3)
        place = Relation(RelationKind.POSITION, LineKind.MEMBER, self.parts, (), nowhere, nowhere)
        is_told = len(self.parts) > 1 and self._are_enough((place,))
        return self._told((place,)) if is_told else ()

    def _of_members(self) -> Iterator[Relation]:
        """Bars and links of which all that carry lie in one line, or, in space, in one plane."""
        if len(self.parts) < 2 or not {part.kind for part in self.parts} <= {
            PartKind.BAR,
            PartKind.BODY,
        }:
            return
        points = np.array([self.limbs.place(node) for node in self._joints()])
        middle = points.mean(axis=0)
        values, axes = np.linalg.svd(points - middle, full_matrices=False)[1:]
        size = float(values[0])
        if len(values) > 1 and values[1] <= _SAME * size:
            kind, axis = RelationKind.ONE_LINE, axes[0]
        elif self.are_bars and not self.result.given.planar and values[-1] <= _SAME * size:
            kind, axis = RelationKind.ONE_PLANE, axes[-1]
        else:
            return
        yield Relation(kind, LineKind.MEMBER, self.parts, (), without_sense(axis), middle)

    def _of_clusters(self) -> Iterator[Relation]:
        """Bars that hold a body made of bars: their lines."""
        if not self.are_bars or len(self.parts) > _MOST_BARS:
            return
        for positions in clusters_of(self.result):
            mine = [part for part in self.parts if len(set(part.ends) & positions) == 1]
            if len(mine) < 3:
                continue
            lines = Lines(
                [line_of(self.limbs, part) for part in mine], self.result.characteristic_length
            )
            for one in in_common(lines, planar=self.result.given.planar):
                parts = tuple(mine[k] for k in one.group)
                where = one.direction, one.point
                yield Relation(one.kind, LineKind.MEMBER, parts, (), *where, pitch=one.pitch)
            return

    def _of_joints(self) -> Iterator[Relation]:
        """In the plane: joints on one circle, two lines or a conic."""
        if not self.result.given.planar or not self.are_bars:
            return
        nodes = self._joints()
        kind = conic_of(np.array([self.limbs.place(node)[:2] for node in nodes]))
        if kind is not None:
            yield Relation(kind, LineKind.JOINT, self.parts, nodes, np.zeros(3), np.zeros(3))

    def _joints(self) -> tuple[int, ...]:
        """The position nodes of all that carries, by name and place."""
        arrays = self.result.given.arrays
        elements = [index for part in self.parts for index in part.elements]
        found = set((arrays.element_node[[0, 2]][:, elements] - 1).ravel().tolist()) - {-1}
        able = [p for p in found if arrays.node_kind[p] <= NodeKind.POSITION]
        step = 1.0e-9 * self.result.characteristic_length

        def key(position: int) -> tuple[object, ...]:
            place = np.round(self.limbs.place(position) / step) + 0.0
            return natural(self.result.parts.name_of_point(position)), tuple(place.tolist())

        return tuple(sorted(able, key=key))


def merged(relations: Iterable[Relation]) -> tuple[Relation, ...]:
    """Each relation once; parallel lines that share some are all told together."""
    made: list[Relation] = []
    for one in relations:
        same = next((k for k, other in enumerate(made) if _go_together(one, other)), None)
        if same is None:
            made.append(one)
            continue
        parts = dict.fromkeys((*made[same].parts, *one.parts))
        ordered = sorted(parts, key=by_name)
        made[same] = replace(made[same], parts=tuple(ordered))
    return tuple(made)


def _go_together(one: Relation, other: Relation) -> bool:
    if (one.kind, one.of) != (other.kind, other.of) or not set(one.parts) & set(other.parts):
        return False
    if one.kind is not RelationKind.PARALLEL and one.parts != other.parts:
        return False
    return bool(np.linalg.norm(np.cross(one.direction, other.direction)) <= _SAME)
