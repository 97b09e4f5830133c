# SPDX-License-Identifier: BSD-3-Clause
"""Sheets that press on a body in a self-stress, by their planes.

A sheet holds every force in its plane and the moment about its normal. So it does not stop a
rotation about a line in its plane, or a translation across it, and it repeats a wire that lies in
its plane.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ...analysis.modes import Motion, SelfStress
from ...analysis.order import without_sense
from ...analysis.result import Result
from ...analysis.screws import Screw, ScrewKind
from ...core.arrays import FloatArray
from ...model.parts.parts import Part, PartKind
from .cause import LineKind, Relation, RelationKind
from .force_lines import pushes_on
from .limbs import Limb, Limbs

#: What is below this part of the lengths at hand, or this angle [rad], is none.
_SAME = 1.0e-6
_NOWHERE = np.zeros(3)


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
            for push in pushes:
                hubs.setdefault(key, {})[push.limb] = stress
    for found in hubs.values():
        parts = [limb.parts[0] for limb in found if len(limb.parts) == 1]
        kinds = {part.kind for part in parts}
        if len(parts) < len(found) or not kinds <= {*_STRAIGHT, PartKind.SHEET}:
            continue
        sheets = _Sheets(result, found, limbs, parts)
        yield tuple(sheets.in_one_plane())
        yield tuple(sheets.of_motions(motions))


_STRAIGHT = (PartKind.WIRE, PartKind.BAR)


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
            mine = [one.part for one in self.planes if self._are_one(plane, one)]
            mine += [wire for wire in self.wires if self._has(plane, wire)]
            if len(mine) > 1:
                told.update(mine)
                yield _relation(
                    RelationKind.ONE_PLANE, mine, without_sense(plane.normal), plane.point
                )

    def of_motions(self, motions: Sequence[Motion]) -> Iterator[Relation]:
        """A line in all planes that all wires meet, or a direction that all lie across."""
        parts = [*(plane.part for plane in self.planes), *self.wires]
        if not self.planes or len(parts) < 2:
            return
        for motion in motions:
            for one in motion.bodies:
                screw = one.screw
                direction = without_sense(screw.direction)
                if screw.kind is ScrewKind.ROTATION and self._all_let_turn(screw):
                    yield _relation(RelationKind.ONE_TRANSVERSAL, parts, direction, screw.point)
                    return
                if screw.kind is ScrewKind.TRANSLATION and self._all_let_move(screw):
                    yield _relation(RelationKind.ACROSS, parts, direction, _NOWHERE)
                    return

    def _all_let_turn(self, screw: Screw) -> bool:
        if not all(
            abs(float(plane.normal @ screw.direction)) <= _SAME
            and self._is_near(plane, screw.point)
            for plane in self.planes
        ):
            return False
        for wire in self.wires:
            first, way = self._line(wire)
            moment = np.cross(first - screw.point, way) @ screw.direction
            if abs(float(moment)) > _SAME * self.length:
                return False
        return True

    def _all_let_move(self, screw: Screw) -> bool:
        across = [float(np.linalg.norm(np.cross(p.normal, screw.direction))) for p in self.planes]
        along = [abs(float(self._line(wire)[1] @ screw.direction)) for wire in self.wires]
        return max((*across, *along)) <= _SAME

    def _are_one(self, one: _Plane, other: _Plane) -> bool:
        parallel = float(np.linalg.norm(np.cross(one.normal, other.normal))) <= _SAME
        return parallel and self._is_near(one, other.point)

    def _has(self, plane: _Plane, wire: Part) -> bool:
        return all(self._is_near(plane, self.limbs.place(end)) for end in wire.ends)

    def _is_near(self, plane: _Plane, point: FloatArray) -> bool:
        return abs(float((point - plane.point) @ plane.normal)) <= _SAME * self.length

    def _line(self, wire: Part) -> tuple[FloatArray, FloatArray]:
        first, last = (self.limbs.place(end) for end in wire.ends)
        return first, (last - first) / np.linalg.norm(last - first)


def _relation(
    kind: RelationKind, parts: Sequence[Part], direction: FloatArray, point: FloatArray
) -> Relation:
    return Relation(kind, LineKind.SHEET, tuple(parts), (), direction, point)
