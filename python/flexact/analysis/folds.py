# SPDX-License-Identifier: BSD-3-Clause
"""Folds of two sheets in series that turn about themselves: how they are declared."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.elements import Class, Role, role_table
from ..model.parts.parts import PartKind
from ..model.words import AT_P, AT_Q
from .carriers import Joint

if TYPE_CHECKING:
    from .result import Result


def turning_folds(result: Result) -> tuple[tuple[int, int], ...]:
    """Of each fold that turns while nothing else moves the bending of a leaf there.

    Indices of elements in `result.data`, and numbers of their deformations, from 1: what
    `Model.folded_sheet` declares. None of a model with divided sheets that are not declared.
    """
    if not result.under_constrained or not result.is_told_by_parts:
        return ()
    if result.with_internal_declared is not None:
        return ()
    folds = {joint.orientation: joint for joint in result.carriers.joints if joint.is_fold}
    moving: dict[Joint, None] = {}
    count = 0
    for motion, is_between in zip(result.motions, result.are_between_ends, strict=True):
        mine = [folds[node] for node in motion.nodes if node in folds] if is_between else []
        moving.update(dict.fromkeys(mine))
        count += bool(mine)
    found = [_bending(result, joint) for joint in moving]
    made = tuple(place for place in found if place is not None)
    return made if len(made) == len(found) == count else ()


def _bending(result: Result, joint: Joint) -> tuple[int, int] | None:
    """The bending that the first leaf releases at a fold; None where it is none of two sheets."""
    if not joint.is_fold or any(part.kind is not PartKind.SHEET for part in joint.parts):
        return None
    data = result.data.arrays
    leaf = min(joint.parts, key=lambda part: part.number)
    index = int(np.searchsorted(result.condensed.elements, min(leaf.elements)))
    at = AT_P if leaf.ends[0] == joint.position else AT_Q
    roles = map(Role, role_table()[data.element_kind[index]].tolist())
    for number, role in enumerate(roles, start=1):
        if role in at and data.deformation_class[number - 1, index] == Class.DEPENDENT:
            return index, number
    return None
