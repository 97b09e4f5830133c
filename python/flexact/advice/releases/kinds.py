# SPDX-License-Identifier: BSD-3-Clause
"""Of what kind a deformation or coordinate is: what is alike, and what is changed more easily."""

from __future__ import annotations

import numpy as np

from ...analysis.change import Change
from ...analysis.result import Result
from ...core.elements import NodeKind, Role, role_table
from ...model.parts.parts import PartKind

#: What is changed first, last and in between.
FLEXURE, BODY, LINK = 0, 1, 2
#: What it is of, when it is changed, and two numbers that say what it is.
Kind = tuple[str, int, int, int]
_BENDINGS = {
    Role.BENDING_XZ_P: 2,
    Role.BENDING_XZ_Q: 2,
    Role.BENDING_XY_P: 1,
    Role.BENDING_XY_Q: 1,
}
_ENDS = {
    Role.BENDING_XZ_Q: Role.BENDING_XZ_P,
    Role.BENDING_XY_Q: Role.BENDING_XY_P,
    Role.PLANAR_BENDING_Q: Role.PLANAR_BENDING_P,
}


def tier_of_element(result: Result, given: int) -> int:
    """Flexures come before bodies, and links inside of bodies last; by index in the given."""
    if given in result.parts.links:
        return LINK
    return BODY if result.parts.of_element(given).kind is PartKind.BODY else FLEXURE


def tier_of_node(result: Result, given: int) -> int:
    """Bodies come before joints, and what is inside of sheets and wires last."""
    if given in result.carriers.inner:
        return LINK
    return FLEXURE if given in result.parts.body_at else BODY


def kind_of(result: Result, change: Change) -> Kind:
    """Of what kind the deformation or the coordinate of a change is, however it is turned."""
    if change.deformations:
        return _of_deformation(result, *change.deformations[0][:2])
    return _of_coordinate(result, *change.coordinates[0][:2])


def _of_deformation(result: Result, element: int, number: int) -> Kind:
    index = result.given.element_index[element]
    part = result.parts.of_element(index)
    role = int(role_table()[result.given.arrays.element_kind[index], number - 1])
    wide = int(result.parts.wide[index])
    in_plane = int(wide == _BENDINGS.get(Role(role), -1))
    if not wide and role in _BENDINGS:
        # Of a member that is wide in neither direction both are alike.
        return part.kind.value, 1, int(Role.BENDING_XY_P), 0
    return (
        part.kind.value,
        tier_of_element(result, index),
        int(_ENDS.get(Role(role), role)),
        in_plane,
    )


def _of_coordinate(result: Result, node: int, name: str) -> Kind:
    index = result.given.node_index[node]
    turns = bool(result.given.arrays.node_kind[index] > NodeKind.POSITION)
    held = int(np.count_nonzero(result.given.arrays.coordinate_class[:, index] == 1))
    return "node", tier_of_node(result, index), int(turns), held
