# SPDX-License-Identifier: BSD-3-Clause
"""The element table and the codes of nodes, classes and roles, as the core has them."""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum
from functools import cache

import numpy as np

from ..util.records import read_only
from . import calls
from .arrays import IntArray
from .raw import ElementKind


class NodeKind(IntEnum):
    """What a node is; the positions are those up to `POSITION`."""

    PLANAR_POSITION = 1
    POSITION = 2
    ANGLE = 3
    ORIENTATION = 4


class Class(IntEnum):
    """Class of a coordinate or a deformation, eq. (7): (o), (c) and (m)."""

    NONE = 0
    FIXED = 1
    DEPENDENT = 2
    INDEPENDENT = 3


class Dual(IntEnum):
    """What the stress resultant of a deformation is."""

    NONE = 0
    FORCE = 1
    MOMENT = 2
    MOMENT_OVER_LENGTH = 3


class Member(IntEnum):
    """What an element is in the mechanism."""

    NONE = 0
    BAR = 1
    BEAM = 2
    LINK = 3
    HINGE = 4


class Vector(IntEnum):
    """Whether a statement of an element has a vector."""

    NONE = 0
    OPTIONAL = 1
    REQUIRED = 2


class Role(IntEnum):
    """What a deformation is to its element; words and resultants are rules on it."""

    NONE = 0
    ELONGATION = 1
    TORSION = 2
    BENDING_XZ_P = 3
    BENDING_XZ_Q = 4
    BENDING_XY_P = 5
    BENDING_XY_Q = 6
    PLANAR_BENDING_P = 7
    PLANAR_BENDING_Q = 8
    OFFSET_X = 9
    OFFSET_Y = 10
    OFFSET_Z = 11
    ROTATION = 12
    TILT_Y = 13
    TILT_Z = 14
    ANGLE = 15


#: The number of ESTIFF, from 0, that stiffens a deformation of a beam or a bar, by its role.
STIFFNESS_NUMBER: dict[int, int] = {
    Role.ELONGATION: 0,
    Role.TORSION: 1,
    **dict.fromkeys((Role.BENDING_XZ_P, Role.BENDING_XZ_Q), 2),
    **dict.fromkeys((Role.BENDING_XY_P, Role.BENDING_XY_Q), 3),
    **dict.fromkeys((Role.PLANAR_BENDING_P, Role.PLANAR_BENDING_Q), 1),
}


POSITION_NAMES = ("x", "y", "z")
ROTATION_NAMES = ("rx", "ry", "rz")

#: Axes that a node of each kind has.
AXES: dict[int, tuple[int, ...]] = {
    NodeKind.PLANAR_POSITION: (0, 1),
    NodeKind.POSITION: (0, 1, 2),
    NodeKind.ANGLE: (2,),
    NodeKind.ORIENTATION: (0, 1, 2),
}


def is_position(kind: int) -> bool:
    """Whether nodes of this kind are positions (else they are rotations)."""
    return kind <= NodeKind.POSITION


def coordinate_name(kind: int, axis: int) -> str:
    """Name of the coordinate along or about axis 0, 1 or 2 of a node of this kind."""
    return POSITION_NAMES[axis] if is_position(kind) else ROTATION_NAMES[axis]


#: All kinds, in the order of their numbers 1, 2, ...
element_kinds = calls.element_kinds


@cache
def kind_of(keyword: str) -> ElementKind:
    """The kind with this keyword in capitals."""
    return next(kind for kind in element_kinds() if kind.keyword == keyword)


def keywords_of(kinds: IntArray) -> tuple[str, ...]:
    """The keyword of each of some kinds, given by their numbers."""
    words = ("", *(kind.keyword for kind in element_kinds()))
    return tuple(words[kind] for kind in kinds.tolist())


@cache
def role_table() -> IntArray:
    """(kinds + 1, 6) `Role` by element kind and deformation; row 0 is empty."""
    return _table([(0,) * 6, *(kind.role for kind in element_kinds())])


@cache
def dual_table() -> IntArray:
    """(kinds + 1, 6) `Dual` likewise."""
    return _table([(0,) * 6, *(kind.dual for kind in element_kinds())])


@cache
def member_table() -> IntArray:
    """(kinds + 1,) `Member` by element kind."""
    return _table([0, *(kind.member for kind in element_kinds())])


@cache
def planar_table() -> IntArray:
    """(kinds + 1,) 1 where elements of a kind lie in the xy plane."""
    planar = {NodeKind.PLANAR_POSITION, NodeKind.ANGLE}
    return _table([0, *(int(bool(planar & set(kind.slots))) for kind in element_kinds())])


@cache
def length_table() -> IntArray:
    """(kinds + 1,) 1 where the two ends of elements of a kind must be apart."""
    return _table([0, *(int(kind.needs_length) for kind in element_kinds())])


def _table(rows: Sequence[int | tuple[int, ...]]) -> IntArray:
    return read_only(np.array(rows, np.int32))
