# SPDX-License-Identifier: BSD-3-Clause
"""An order of rows and columns of D(c) that follows from names and places alone.

It does not depend on numbers of nodes and elements, on which end of a member is called p, or on
the sense of the vector that turns its section.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import NodeKind, Role, role_table
from ..model.parts.parts import Part, PartKind, natural
from .decomposition import Outcome

#: Local axis about or along which a deformation is, by role; 0 where it has none of its own.
_AXIS: dict[int, int] = {
    **dict.fromkeys((Role.BENDING_XZ_P, Role.BENDING_XZ_Q, Role.OFFSET_Y, Role.TILT_Y), 1),
    **dict.fromkeys((Role.BENDING_XY_P, Role.BENDING_XY_Q, Role.OFFSET_Z, Role.TILT_Z), 2),
}
_AT_P = (Role.BENDING_XZ_P, Role.BENDING_XY_P, Role.PLANAR_BENDING_P)
_AT_Q = (Role.BENDING_XZ_Q, Role.BENDING_XY_Q, Role.PLANAR_BENDING_Q)
#: Bendings of both ends and planes together, behind elongation and torsion.
_BENDING = int(Role.BENDING_XZ_P)
#: Places that differ by less than this part of the characteristic length are one.
_SAME_PLACE = 1.0e-9
#: Parts of a mode below this part of its largest are not named.
_UNNAMED = 1.0e-9
#: Of values of practically one size, no more than so many are put in order.
_MOST_KEYS = 5_000


def ranked(weighted: FloatArray, most: int, key: Callable[[int], Any] | None = None) -> list[int]:
    """Indices of the largest entries, the largest first.

    Args:
        weighted: (n,) values of any sign.
        most: How many at most; entries below 1e-9 of the largest are none.
        key: Of an index, by which entries of practically one size are sorted; by default the
            index itself.
    """
    size = np.abs(weighted)
    largest = size.max(initial=0.0)
    if not largest > 0.0:
        return []
    rounded = np.round(size / largest, 9)
    least = np.partition(rounded, -most)[-most] if 0 < most < size.size else 0.0
    able = np.flatnonzero((rounded > _UNNAMED) & (rounded >= least))
    order = able[np.argsort(-rounded[able], kind="stable")].tolist()
    if key is not None and len(order) <= _MOST_KEYS:
        order.sort(key=lambda i: (-rounded[i], key(i)))
    chosen: list[int] = order[:most]
    return chosen


def row_key(outcome: Outcome, row: int, *, numbered: bool = True) -> Any:
    """By what a row of D(c) is sorted among equals: flexures first, part, what deforms, where.

    Parts without a name go by the number that they are called by, or by place alone.
    """
    element, deformation = (outcome.raw.row_label[:, row] - 1).tolist()
    return deformation_key(outcome, element, deformation, numbered=numbered)


def deformation_key(
    outcome: Outcome, element: int, deformation: int, *, numbered: bool = True
) -> Any:
    """The same of a deformation, from 0, of an element, by its index in `outcome.data`."""
    data, given = outcome.data, int(outcome.condensed.elements[element])
    role = int(role_table()[data.arrays.element_kind[element], deformation])
    part = outcome.parts.of_element(given)
    axis = _AXIS.get(role, 0)
    bends = role in _AT_P or role in _AT_Q
    wide = int(outcome.parts.wide[given])
    # A sheet's local z is in its plane where the bending about local y is held.
    of_sheet = 0 if not wide or not axis else 1 + (wide == axis)
    direction = _direction(data.frames.frame[element][:, axis]) if axis and not wide else ()
    p, q = (data.arrays.element_node[[0, 2], element] - 1).tolist()
    nodes = [p] if role in _AT_P else [q] if role in _AT_Q else [p, q]
    places = [data.arrays.node_value[:3, node] for node in nodes if node >= 0]
    place = _place(outcome, np.mean(places, axis=0)) if places else ()
    kind = _BENDING if bends else role
    is_body = part.kind is PartKind.BODY
    end = _end(outcome, nodes[0]) if bends else ()
    return is_body, natural(_name(part, numbered)), kind, of_sheet, direction, end, place


def column_key(outcome: Outcome, column: int, *, numbered: bool = True) -> Any:
    """By what a column of D(c) is sorted among equals: displacement or rotation, where, axis."""
    node, axis = (outcome.raw.column_label[:, column] - 1).tolist()
    return coordinate_key(outcome, node, axis, numbered=numbered)


def coordinate_key(outcome: Outcome, node: int, axis: int, *, numbered: bool = True) -> Any:
    """The same of a coordinate of a node, by its index in `outcome.data`."""
    given = int(outcome.condensed.nodes[node])
    position = outcome.parts.place_of(given)
    turns = bool(outcome.data.arrays.node_kind[node] > NodeKind.POSITION)
    if position is None:
        return turns, (), (), axis
    value: FloatArray = outcome.given.arrays.node_value[:3, position]
    here = outcome.parts.at(position)
    names = (_name(part, numbered) for part in here)
    name = outcome.parts.name_of_point(position) or next(filter(None, names), "")
    return turns, natural(name), _place(outcome, value), axis


def _end(outcome: Outcome, node: int) -> Any:
    """What is at an end: ground before others, then by name, however the mechanism is turned."""
    given = int(outcome.condensed.nodes[node])
    return not outcome.parts.is_held(given), natural(outcome.parts.name_of_point(given))


def _name(part: Part, numbered: bool) -> str:
    """A part's name; empty where it follows from a number that does not count."""
    return part.name if part.is_named or numbered else ""


def _place(outcome: Outcome, value: FloatArray) -> tuple[float, ...]:
    step = _SAME_PLACE * outcome.characteristic_length
    whole = np.round(value / step) if step > 0.0 else value
    return tuple((whole + 0.0).tolist())


def without_sense(axis: FloatArray) -> FloatArray:
    """An axis or its opposite: the first component that is not small beside others is positive."""
    first = int(np.argmax(np.abs(axis) >= 0.7 * np.abs(axis).max()))
    return axis if axis[first] > 0.0 else -axis


def _direction(axis: FloatArray) -> tuple[float, ...]:
    """An axis without sense, rounded."""
    return tuple((np.round(without_sense(axis), 6) + 0.0).tolist())
