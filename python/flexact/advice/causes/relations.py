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

import numpy as np

from ...analysis.modes import Motion, SelfStress
from ...analysis.order import without_sense
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...core.elements import NodeKind
from ...model.parts.parts import Part, PartKind, natural
from .axes import of_axes
from .cause import LineKind, Relation, RelationKind
from .clusters import clusters_of
from .conics import conic_of
from .directions import of_directions
from .force_lines import of_forces
from .in_common import in_common
from .lines import Line, Lines
from .sheet_planes import of_sheets
from .symmetry import symmetries_of
from .trials import Trials

#: How many relations are told, and tried together; and of how many bars bodies are looked for.
_MOST, _MOST_TRIED, _MOST_BARS = 4, 12, 120
#: Of how many self-stresses lines of force are looked at.
_MOST_STRESSES = 4
#: Of self-stresses of more resultants together nothing is said.
_MOST_ENTRIES = 600
_SAME = 1.0e-6


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
        self.parts = tuple(sorted(found, key=self._key))
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
        if len(relations) > _MOST:
            return ()
        return tuple(replace(one, is_sufficient=True) for one in relations)

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
            yield self._of_all(RelationKind.ONE_LINE, without_sense(axes[0]), middle)
        elif self.are_bars and not self.result.given.planar and values[-1] <= _SAME * size:
            yield self._of_all(RelationKind.ONE_PLANE, without_sense(axes[-1]), middle)

    def _of_all(self, kind: RelationKind, direction: FloatArray, point: FloatArray) -> Relation:
        return Relation(kind, LineKind.MEMBER, self.parts, (), direction, point)

    def _of_clusters(self) -> Iterator[Relation]:
        """Bars that hold a body made of bars: their lines."""
        if not self.are_bars or len(self.parts) > _MOST_BARS:
            return
        for positions in clusters_of(self.result):
            mine = [part for part in self.parts if len(set(part.ends) & positions) == 1]
            if len(mine) < 3:
                continue
            lines = Lines([self._line(part) for part in mine], self.result.characteristic_length)
            for one in in_common(lines, planar=self.result.given.planar):
                yield Relation(
                    one.kind,
                    LineKind.MEMBER,
                    tuple(mine[k] for k in one.group),
                    (),
                    one.direction,
                    one.point,
                    pitch=one.pitch,
                )
            return

    def _line(self, part: Part) -> Line:
        first, last = (self.limbs.place(p) for p in part.ends)
        return Line(first, (last - first) / np.linalg.norm(last - first))

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
        return tuple(sorted(able, key=self._joint_key))

    def _joint_key(self, position: int) -> tuple[object, ...]:
        name = self.result.parts.name_of_point(position)
        return natural(name), self._rounded(position)

    def _rounded(self, position: int) -> tuple[float, ...]:
        step = 1.0e-9 * self.result.characteristic_length
        return tuple((np.round(self.limbs.place(position) / step) + 0.0).tolist())

    def _key(self, part: Part) -> tuple[object, ...]:
        return natural(part.name), part.elements


def merged(relations: Iterable[Relation]) -> tuple[Relation, ...]:
    """Each relation once; parallel lines that share some are all told together."""
    made: list[Relation] = []
    for one in relations:
        same = next((k for k, other in enumerate(made) if _go_together(one, other)), None)
        if same is None:
            made.append(one)
            continue
        parts = dict.fromkeys((*made[same].parts, *one.parts))
        ordered = sorted(parts, key=lambda part: (natural(part.name), part.elements))
        made[same] = replace(made[same], parts=tuple(ordered))
    return tuple(made)


def _go_together(one: Relation, other: Relation) -> bool:
    if one.kind is not other.kind or one.of is not other.of:
        return False
    if one.kind is not RelationKind.PARALLEL and one.parts != other.parts:
        return False
    if not set(one.parts) & set(other.parts):
        return False
    return bool(np.linalg.norm(np.cross(one.direction, other.direction)) <= _SAME)
