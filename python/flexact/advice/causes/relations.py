# SPDX-License-Identifier: BSD-3-Clause
"""What makes the geometry of a special self-stress special: a ladder of simple relations.

First the axes of hinges, then members in one line or plane, then planes of sheets, then the lines
of force along which limbs press on a body, then joints on a circle or conic, then a symmetry, then
what lies along an axis; what none of these explains alone the fewest of them do together, or the
position of all that is stressed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import reduce
from operator import add

import numpy as np

from ...analysis.mode_basis import without_sense
from ...analysis.result import Motion, Result, SelfStress
from ...analysis.screws import ScrewKind, Wrench, WrenchKind
from ...core.arrays import FloatArray
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
    on_two_lines,
)
from .gradients import place_key
from .lines import (
    SAME,
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
            last = next(part for part in limb.parts if position in part.ends)
            loads = (end.wrench for end in stress.of(last).ends if end.position == position)
            wrench = next(loads, None)
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
            "force",
            [(wrench.point, wrench.direction) for _, wrench in pushes],
            [limb.parts for limb, _ in pushes],
            result.characteristic_length,
        )
        found = in_common(lines, planar=result.given.planar)
        if found:
            mine = ([w for limb, w in pushes if limb.parts[0] in one.parts] for one in found)
            return [replace(one, couple=_couple(w)) for one, w in zip(found, mine, strict=True)]
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


#: A sheet, (3,) a point of its plane, and the normal.
Plane = tuple[Part, FloatArray, FloatArray]


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
        planes = [
            (part, limbs.place(part.ends[0]), stress.of(part).normal)
            for part, stress in zip(parts, found.values(), strict=True)
            if part.kind is PartKind.SHEET
        ]
        wires = [(part, line_of(limbs, part)) for part in parts if part.kind in _STRAIGHT]
        yield tuple(_in_one_plane(planes, wires, limbs, result.characteristic_length))
        yield _on_one_line(planes, wires, motions, result.characteristic_length)


def _in_one_plane(
    planes: Sequence[Plane], wires: Sequence[tuple[Part, Line]], limbs: Limbs, length: float
) -> Iterator[Relation]:
    """Sheets, or a sheet and wires, that lie in one plane."""
    told: set[Part] = set()
    for sheet, point, normal in planes:
        if sheet in told:
            continue
        mine = [
            part
            for part, there, other in planes
            if float(np.linalg.norm(np.cross(normal, other))) <= SAME
            and abs(float((there - point) @ normal)) <= SAME * length
        ]
        for wire, _ in wires:
            off = [abs(float((limbs.place(end) - point) @ normal)) for end in wire.ends]
            if max(off) <= SAME * length:
                mine.append(wire)
        if len(mine) > 1:
            told.update(mine)
            yield Relation("one plane", "sheet", tuple(mine), (), without_sense(normal), point)


def _on_one_line(
    planes: Sequence[Plane],
    wires: Sequence[tuple[Part, Line]],
    motions: Sequence[Motion],
    length: float,
) -> tuple[Relation, ...]:
    """A line in all planes that all wires meet, or a direction that all lie across."""
    parts = *(sheet for sheet, _, _ in planes), *(wire for wire, _ in wires)
    if not planes or len(parts) < 2:
        return ()
    for screw in (one.screw for motion in motions for one in motion.bodies):
        axis, point = screw.direction, screw.point
        if screw.kind is ScrewKind.ROTATION:
            off = [abs(float(normal @ axis)) * length for _, _, normal in planes]
            off += [abs(float((point - there) @ normal)) for _, there, normal in planes]
            off += [abs(float(np.cross(at - point, way) @ axis)) for _, (at, way) in wires]
            if max(off) <= SAME * length:
                return (
                    Relation("one transversal", "sheet", parts, (), without_sense(axis), point),
                )
        elif screw.kind is ScrewKind.TRANSLATION:
            across = [float(np.linalg.norm(np.cross(normal, axis))) for _, _, normal in planes]
            along = [abs(float(way @ axis)) for _, (_, way) in wires]
            if max((*across, *along)) <= SAME:
                return (Relation("across", "sheet", parts, (), without_sense(axis)),)
    return ()


#: Of more axes no half-turn is looked for.
_MOST_TURNED = 12


def of_axes(result: Result, parts: Sequence[Part]) -> Iterator[tuple[Relation, ...]]:
    """What the axes of some hinges have in common; nothing where there are fewer than two.

    Each is one set of relations that may be enough, the simplest first.
    """
    hinges = _hinges(result, parts)
    if len(hinges) < 2:
        return
    lines = Lines(
        "axis",
        [line for _, line in hinges],
        [(part,) for part, _ in hinges],
        result.characteristic_length,
    )
    groups = [
        (group, lines.relation("parallel", group, lines.ways[group[0]]))
        for group in lines.together(lines.is_parallel)
    ]
    parallel = [one for _, one in groups]
    if groups and sum(len(group) for group, _ in groups) == len(lines):
        yield tuple(parallel)
    common = in_common(lines, planar=result.given.planar)
    # By lines of one complex a motion only begins; by a symmetry it goes on.
    if not any(one.kind in ("one line", "concurrent") for one in common):
        for one in _half_turns(lines):
            yield (one,)
    yield tuple(common)
    met = lines.meeting_points()
    yield *parallel, *(lines.relation("concurrent", group, point=at) for group, _, at in met)


def _half_turns(lines: Lines) -> Iterator[Relation]:
    """Half-turns that take lines onto each other, as in Bricard's line-symmetric loop."""
    count, length = len(lines), lines.length
    if not 4 <= count <= _MOST_TURNED:
        return
    every = [(lines.points[[k]], lines.ways[[k]]) for k in range(count)]
    for other in range(1, count):
        for direction, point in _swapping(every[0], every[other], length):
            axis = np.concatenate((direction, point / length))[None]
            images = [half_turned(line, axis, length) for line in every]
            found = [
                next((j for j, one in enumerate(every) if are_one(image, one, length)), -1)
                for image in images
            ]
            if -1 not in found and all(i != j for i, j in enumerate(found)):
                way = without_sense(direction)
                yield lines.relation("rotation", range(count), way, point, fold=2)


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
            made.append((part, (arrays.node_value[:3, place], unit)))
    return made


def conic_of(points: FloatArray) -> RelationKind | None:
    """What six or more points (n, 2) lie on; None where it is neither, or fewer points are given.

    Five points always lie on a conic.
    """
    if len(points) < 6:
        return None
    at = (points - points.mean(axis=0)) / np.abs(points - points.mean(axis=0)).max()
    if _is_dependent(circle_terms(at).T):
        return "circle"
    if next(on_two_lines(at), None) is not None:
        return "two lines"
    return "conic" if _is_dependent(conic_terms(at).T) else None


def _is_dependent(rows: FloatArray) -> bool:
    values = np.linalg.svd(rows, compute_uv=False)
    return bool(values[-1] <= SAME * values[0])


def of_directions(result: Result, parts: Sequence[Part]) -> Iterator[tuple[Relation, ...]]:
    """What lies along or across x, y or z, where these directions matter.

    Each is one set of relations that may be enough: of an axis, then all of them.
    """
    arrays = result.data.arrays
    free = np.any(arrays.coordinate_class == Class.DEPENDENT, axis=0)
    held = np.any(np.isin(arrays.coordinate_class, (Class.FIXED, Class.INDEPENDENT)), axis=0)
    # They do where some coordinates of a node are dependent, and others are not.
    if not np.any(free & held):
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
            if float(np.linalg.norm(np.cross(way, axis))) <= SAME:
                made.setdefault((own[0], "along"), []).append(part)
            elif abs(float(way @ axis)) <= SAME:
                made.setdefault((own[0], "across axis"), []).append(part)
        found = [Relation(kind, of, tuple(mine), (), axis) for (of, kind), mine in made.items()]
        for one in found:
            yield (one,)
        every += found
    yield tuple(every)


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
        place = Relation("position", "member", self.parts)
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
        size, in_space = float(values[0]), self.are_bars and not self.result.given.planar
        if len(values) > 1 and values[1] <= SAME * size:
            yield Relation("one line", "member", self.parts, (), without_sense(axes[0]), middle)
        elif in_space and values[-1] <= SAME * size:
            yield Relation("one plane", "member", self.parts, (), without_sense(axes[-1]), middle)

    def _of_clusters(self) -> Iterator[Relation]:
        """Bars that hold a body made of bars: their lines."""
        if not self.are_bars or len(self.parts) > _MOST_BARS:
            return
        for positions in clusters_of(self.result):
            mine = [part for part in self.parts if len(set(part.ends) & positions) == 1]
            if len(mine) < 3:
                continue
            lines = [line_of(self.limbs, part) for part in mine]
            length, parts = self.result.characteristic_length, [(part,) for part in mine]
            found = Lines("member", lines, parts, length)
            yield from in_common(found, planar=self.result.given.planar)
            return

    def _of_joints(self) -> Iterator[Relation]:
        """In the plane: joints on one circle, two lines or a conic."""
        if not self.result.given.planar or not self.are_bars:
            return
        nodes = self._joints()
        kind = conic_of(np.array([self.limbs.place(node)[:2] for node in nodes]))
        if kind is not None:
            yield Relation(kind, "joint", self.parts, nodes)

    def _joints(self) -> tuple[int, ...]:
        """The position nodes of all that carries, by name and place."""
        arrays = self.result.given.arrays
        elements = [index for part in self.parts for index in part.elements]
        found = set((arrays.element_node[[0, 2]][:, elements] - 1).ravel().tolist()) - {-1}
        able = [p for p in found if arrays.node_kind[p] <= NodeKind.POSITION]

        def key(position: int) -> tuple[object, ...]:
            name = natural(self.result.parts.name_of_point(position))
            return name, place_key(self.result, self.limbs.place(position))

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
    if one.kind != "parallel" and one.parts != other.parts:
        return False
    return bool(np.linalg.norm(np.cross(one.direction, other.direction)) <= SAME)
