# SPDX-License-Identifier: BSD-3-Clause
"""What makes the geometry of a special self-stress special: a ladder of simple relations.

First the axes of hinges, then members in one line or plane, then planes of sheets, then the lines
of force along which limbs press on a body, then joints on a circle or conic, then a symmetry; what
none of these explains is a special position.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from ...core.arrays import FloatArray
from ...core.elements import NodeKind
from ...model.parts.parts import Part, PartKind, natural
from ...result.modes import Motion, SelfStress
from ...result.order import without_sense
from ...result.result import Result
from .axes import of_axes
from .cause import LineKind, Relation, RelationKind
from .clusters import clusters_of
from .conics import conic_of
from .force_lines import of_forces
from .in_common import in_common
from .limbs import Limbs
from .lines import Line, Lines
from .sheet_planes import of_sheets
from .symmetry import symmetry_of
from .trials import Trials

#: How many relations are told, and of how many bars bodies are looked for.
_MOST, _MOST_BARS = 3, 120
#: Of self-stresses of more resultants together nothing is said.
_MOST_ENTRIES = 600
_SAME = 1.0e-6


def relations_of(
    result: Result, stresses: Sequence[int], motions: Sequence[Motion]
) -> tuple[Relation, ...]:
    """What makes the geometry of some self-stresses special, the most telling first.

    Args:
        result: A result told by parts.
        stresses: Indices of self-stresses that are special, or of those among which some are.
        motions: Its special motions.

    Returns:
        At most three; none where so many parts are stressed that this would take long.
    """
    entries = [result.stress_basis.entries(k)[0].size for k in stresses]
    if sum(entries) > _MOST_ENTRIES:
        return ()
    return _Ladder(result, [result.self_stresses[k] for k in stresses], motions).found()


class _Ladder:
    def __init__(
        self, result: Result, stresses: list[SelfStress], motions: Sequence[Motion]
    ) -> None:
        self.result, self.stress, self.motions = result, stresses[-1], motions
        self.limbs, self.trials = Limbs(result), Trials(result)
        found = dict.fromkeys(one.part for stress in stresses for one in stress.parts)
        self.parts = tuple(sorted(found, key=self._key))
        self.are_bars = all(part.kind is PartKind.BAR for part in self.parts)

    def found(self) -> tuple[Relation, ...]:
        result = self.result
        for rung in (
            lambda: of_axes(result, self.parts, self.trials),
            self._of_members,
            lambda: of_sheets(result, self.stress, self.limbs, self.motions),
            lambda: of_forces(result, self.stress, self.limbs),
            self._of_clusters,
            self._of_joints,
            self._of_symmetry,
        ):
            made = tuple(rung())
            if made:
                return made[:_MOST]
        nowhere = np.zeros(3)
        return (Relation(RelationKind.POSITION, LineKind.MEMBER, self.parts, (), nowhere, nowhere),)

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

    def _of_symmetry(self) -> Iterator[Relation]:
        found = symmetry_of(self.result, self.parts, self.trials) if self.are_bars else None
        if found is not None:
            yield found


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
