# SPDX-License-Identifier: BSD-3-Clause
"""Families of lines, directions and screws: what a freedom or a constraint space is made of.

In a freedom space a line is one about which the body can turn, and a direction one along which
it can move; in a constraint space a line is one of a force, and a direction that of a couple.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

import numpy as np

from ...core.arrays import FloatArray
from ...util.records import Frozen

#: Directions off by so little [rad], or lines by this part of the characteristic length, are one.
SAME = 1.0e-4


class FamilyKind(str, Enum):
    """What a family is."""

    LINE = "one line"
    PENCIL = "all lines through a point in a plane"
    PARALLELS_IN_PLANE = "all parallel lines in a plane"
    BUNDLE = "all lines through a point"
    PARALLELS = "all parallel lines"
    PLANE = "all lines in a plane"
    REGULUS = "lines on a ruled quadric"
    MEETING_TWO = "all lines that meet two lines"
    MEETING_ACROSS = "all lines that meet a line and are perpendicular to a direction"
    CONGRUENCE = "a linear congruence"
    MEETING = "all lines that meet a line"
    ACROSS = "all lines perpendicular to a direction"
    COMPLEX = "a linear complex"
    EVERY = "every line"
    DIRECTION = "one direction"
    DIRECTIONS_IN_PLANE = "all directions in a plane"
    EVERY_DIRECTION = "every direction"
    SCREW = "one screw"


#: Kinds whose members are directions: translations, or couples.
DIRECTIONS = frozenset(
    (FamilyKind.DIRECTION, FamilyKind.DIRECTIONS_IN_PLANE, FamilyKind.EVERY_DIRECTION)
)


def _nowhere() -> FloatArray:
    return np.zeros(3)


def _no_lines() -> FloatArray:
    return np.zeros((0, 3))


@dataclass(frozen=True, eq=False)
class Family(Frozen):
    """Lines, directions or screws that belong together.

    | kind | `point` | `direction` | `normal` | `points`, `directions` |
    |---|---|---|---|---|
    | `LINE` | on it | along it | | the line |
    | `PENCIL` | through which all go | | of the plane | |
    | `PARALLELS_IN_PLANE` | in the plane | along all | of the plane | |
    | `BUNDLE` | through which all go | | | |
    | `PARALLELS` | | along all | | |
    | `PLANE` | in the plane | | of the plane | |
    | `REGULUS` | the middle of the quadric | axis of a hyperboloid | of the plane to which all \
are parallel, of a paraboloid | twelve of the lines |
    | `MEETING_TWO` | | | | the two lines |
    | `MEETING_ACROSS` | | to which all are perpendicular | | the line that all meet |
    | `CONGRUENCE` | | | | some of its lines |
    | `MEETING` | on the line | along it | | the line that all meet |
    | `ACROSS` | | to which all are perpendicular | | |
    | `COMPLEX` | on the axis | along it | | the axis |
    | `EVERY` | | | | |
    | `DIRECTION` | | it | | |
    | `DIRECTIONS_IN_PLANE` | | | of the plane | |
    | `EVERY_DIRECTION` | | | | |
    | `SCREW` | on the axis | along it | | the axis |

    Attributes:
        kind: What it is.
        point: (3,) [m]; of lines and planes the point nearest to the body's middle.
        direction: (3,) unit vector; zero where there is none.
        normal: (3,) unit vector; zero where there is none.
        pitch: Of a screw [m/rad]; of a complex that of the screw to which all its lines are
            reciprocal [m].
        points: (n, 3) of lines, one each [m].
        directions: (n, 3) unit vectors along them.
    """

    kind: FamilyKind
    point: FloatArray = field(default_factory=_nowhere)
    direction: FloatArray = field(default_factory=_nowhere)
    normal: FloatArray = field(default_factory=_nowhere)
    pitch: float = 0.0
    points: FloatArray = field(default_factory=_no_lines)
    directions: FloatArray = field(default_factory=_no_lines)

    @property
    def is_of_lines(self) -> bool:
        """Whether its members are lines: of rotations, or of forces."""
        return self.kind not in DIRECTIONS and self.kind is not FamilyKind.SCREW

    @property
    def is_of_directions(self) -> bool:
        """Whether its members are directions: of translations, or of couples."""
        return self.kind in DIRECTIONS
