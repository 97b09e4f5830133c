# SPDX-License-Identifier: BSD-3-Clause
"""Why a motion or a self-stress is there, as values."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from ...core.arrays import FloatArray
from ...model.parts.parts import Part
from ...util.records import Frozen, Word
from ..step import Step


class CauseKind(Word):
    """Why a motion or a self-stress is there."""

    GENERIC = "generic"
    """The count: any geometry of the same topology has it."""
    SPECIAL = "special"
    """This geometry: almost every other one has it not."""
    UNKNOWN = "not looked at"
    """No other geometry could be analysed."""


@dataclass(frozen=True)
class Lift(Frozen):
    """How fast a misalignment lifts a zero singular value of the scaled D(c), to first order.

    Attributes:
        by_move: Where the node that does it most is moved [1/m]; 0 where no node does.
        node: Number of that node in the model as given; None where no node does.
        by_turn: Where the element that does it most is turned about its centre [1/rad].
        element: Number of that element, likewise.
    """

    by_move: float
    node: int | None
    by_turn: float
    element: int | None

    def __bool__(self) -> bool:
        """Whether anything lifts it to first order."""
        return self.node is not None or self.element is not None


#: What lines, points or members have in common that others have not: they lie along one line, are
#: parallel, lie in one plane, meet in one point, all meet one line, lie across one direction, are
#: generators of one hyperboloid, belong to one linear complex; lie on a circle, on two lines, on a
#: conic; lie along or across an axis of the ground; a rotation or a reflection takes them to each
#: other; or they stand in a special position.
RelationKind = Literal[
    "one line",
    "parallel",
    "one plane",
    "concurrent",
    "one transversal",
    "across",
    "regulus",
    "complex",
    "circle",
    "two lines",
    "conic",
    "along",
    "across axis",
    "rotation",
    "reflection",
    "position",
]
#: What the lines of a relation are: lines of force, axes, planes of sheets, members, or joints.
LineKind = Literal["force", "axis", "sheet", "member", "joint"]


@dataclass(frozen=True, eq=False)
class Relation(Frozen):
    """What makes a geometry special.

    Attributes:
        kind: What the lines or points have in common.
        of: What they are.
        parts: The parts whose lines they are, by name.
        nodes: Of joints the indices of their position nodes in the model as given.
        direction: (3,) of the line, or of parallel lines; across a plane; of the axis of a
            rotation, or of the screw that lines of one complex do not stop; across the mirror of
            a reflection; zero where there is none.
        point: (3,) on the line or axis, in the plane, or where lines meet [m]; zero where there
            is none.
        couple: (3,) unit vector about which these lines of force together make a couple in the
            self-stress; zero where they do not.
        pitch: Of the screw that lines of one complex do not stop [m/rad].
        fold: How many times a rotation brings all back in one turn.
        is_sufficient: Whether other geometries with the same relations were tried and have what
            this one has.
    """

    kind: RelationKind
    of: LineKind
    parts: tuple[Part, ...]
    nodes: tuple[int, ...] = ()
    direction: FloatArray = field(default_factory=lambda: np.zeros(3))
    point: FloatArray = field(default_factory=lambda: np.zeros(3))
    couple: FloatArray = field(default_factory=lambda: np.zeros(3))
    pitch: float = 0.0
    fold: int = 1
    is_sufficient: bool = False


@dataclass(frozen=True)
class Cause(Frozen):
    """Why a motion or a self-stress is there.

    Attributes:
        kind: Generic or special.
        together: Indices of the motions, or self-stresses, among which the choice which of them
            are special is free: a misalignment lifts so many of them, and which depends on it.
            Empty where it is this one whatever the misalignment.
        special: How many of them are special.
        lift: How fast a misalignment lifts it; None of what nothing lifts to first order, or
            where that was not looked at.
        is_first_order: Whether some misalignment of one node or element lifts it to first
            order; None where that was not looked at, and of what is generic.
        relations: What makes this geometry special, the most telling first; together they are
            enough. None where nothing is known to be.
    """

    kind: CauseKind
    together: tuple[int, ...] = ()
    special: int = 0
    lift: Lift | None = None
    is_first_order: bool | None = None
    relations: tuple[Relation, ...] = ()


@dataclass(frozen=True)
class Causes(Frozen):
    """Why the motions and self-stresses of a result are there, and the mend of both.

    Attributes:
        motions: One for each of the result's motions.
        self_stresses: One for each of its self-stresses.
        mends: Flexures turned so that they stop what is free, tried; the best first.
        generic_rank: The rank of D(c) in almost every other geometry of the same topology, of
            divided sheets and wires as one beam each; None where none could be analysed.
    """

    motions: tuple[Cause, ...]
    self_stresses: tuple[Cause, ...]
    mends: tuple[Step, ...] = ()
    generic_rank: int | None = None
