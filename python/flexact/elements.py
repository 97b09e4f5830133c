"""The element table and the codes of nodes and classes, as the core has them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from functools import cache

import numpy as np

from . import _boundary
from .exchange import IntArray


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


@dataclass(frozen=True, slots=True)
class ElementKind:
    """One row of the element table."""

    number: int
    keyword: str
    slots: tuple[int, ...]
    """Node kind of the slots p, op, q, oq; 0 where a slot is not used."""
    deformations: int
    vector: int
    """0 takes no vector, 1 may take one, 2 must have one."""
    needs_length: bool
    dual: tuple[int, ...]
    """`Dual` of each of six deformations."""


@cache
def element_kinds() -> tuple[ElementKind, ...]:
    """All kinds, in the order of their numbers 1, 2, ..."""
    return tuple(
        ElementKind(number, *row)
        for number, row in enumerate(_boundary.describe_element_kinds(), start=1)
    )


@cache
def kind_of(keyword: str) -> ElementKind:
    """The kind with this keyword in capitals."""
    return next(kind for kind in element_kinds() if kind.keyword == keyword)


def keywords_of(kinds: IntArray) -> tuple[str, ...]:
    """The keyword of each of some kinds, given by their numbers."""
    words = ("", *(kind.keyword for kind in element_kinds()))
    return tuple(words[kind] for kind in kinds.tolist())


@cache
def dual_table() -> IntArray:
    """(kinds + 1, 6) `Dual` by element kind and deformation; row 0 is empty."""
    table = np.array([(0,) * 6, *(kind.dual for kind in element_kinds())], np.int32)
    table.flags.writeable = False
    return table
