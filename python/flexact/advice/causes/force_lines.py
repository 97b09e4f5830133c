# SPDX-License-Identifier: BSD-3-Clause
"""The lines along which limbs press on a body in a self-stress, and what they have in common."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...analysis.modes import SelfStress
from ...analysis.order import without_sense
from ...analysis.result import Result
from ...analysis.wrenches import Wrench, WrenchKind
from ...core.arrays import FloatArray
from ...model.parts.parts import PartKind
from .cause import LineKind, Relation
from .in_common import in_common
from .limbs import Limb, Limbs
from .lines import Line, Lines

#: Loads below this part of the largest are none.
_REST = 1.0e-6


class Push(NamedTuple):
    """What a limb exerts on a body or point where it ends."""

    limb: Limb
    wrench: Wrench


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
                found.append(Push(limb, wrench))
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
            [Line(push.wrench.point, push.wrench.direction) for push in pushes],
            result.characteristic_length,
        )
        made = []
        for one in in_common(lines, planar=result.given.planar):
            mine = [pushes[k] for k in one.group]
            made.append(
                Relation(
                    one.kind,
                    LineKind.FORCE,
                    tuple(part for push in mine for part in push.limb.parts),
                    (),
                    one.direction,
                    one.point,
                    _couple([push.wrench for push in mine]),
                    one.pitch,
                )
            )
        if made:
            return made
    return []


def _has_line(push: Push) -> bool:
    """Whether a limb can press along one line only: a wire, a bar, or a folded sheet.

    Of other limbs the loads of two or three on a body in balance always share a line or a plane.
    """
    kinds = [part.kind for part in push.limb.parts]
    is_straight = len(kinds) == 1 and kinds[0] in (PartKind.WIRE, PartKind.BAR)
    is_folded = kinds == [PartKind.SHEET] * 2
    return push.wrench.kind is WrenchKind.FORCE and (is_straight or is_folded)


def _couple(wrenches: list[Wrench]) -> FloatArray:
    """(3,) the direction of the couple that wrenches make together; zero where they make none."""
    total = wrenches[0]
    for wrench in wrenches[1:]:
        total = total + wrench
    size = max(wrench.size for wrench in wrenches)
    if total.size <= _REST * size:
        return np.zeros(3)
    if float(np.linalg.norm(total.force)) * total.length > _REST * size:
        return np.zeros(3)
    return without_sense(total.moment / np.linalg.norm(total.moment))
