# SPDX-License-Identifier: BSD-3-Clause
"""Forces and moments together: along a line, about a direction, or both.

The same rules as of screws, with a force for the rotation and a moment for the velocity
(Poinsot 1806; Hunt, *Kinematic Geometry of Mechanisms*, 1978).
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray, floats
from ..util.cached import cached_property
from ..util.records import Frozen
from .screws import ROUNDING, Screw, ScrewKind, in_words, screw_of


class WrenchKind(str, Enum):
    """What a wrench is."""

    NONE = "none"
    FORCE = "force"
    COUPLE = "couple"
    WRENCH = "wrench"

    def __str__(self) -> str:
        """The word itself."""
        return self.value


_KINDS = {
    ScrewKind.NONE: WrenchKind.NONE,
    ScrewKind.ROTATION: WrenchKind.FORCE,
    ScrewKind.TRANSLATION: WrenchKind.COUPLE,
    ScrewKind.SCREW: WrenchKind.WRENCH,
}


@dataclass(frozen=True, eq=False, repr=False)
class Wrench(Frozen):
    """A force and a moment.

    Attributes:
        force: (3,) [N].
        moment: (3,) about `about` [N m].
        about: (3,) a point [m].
        length: By which forces compare with moments [m].
        rest: Wrenches up to this size are none [N m].
    """

    force: FloatArray
    moment: FloatArray
    about: FloatArray
    length: float
    rest: float = 0.0

    @cached_property
    def _screw(self) -> Screw:
        return screw_of(
            *(self.force, self.moment, self.about, self.length),
            rest=self.rest,
            rounding=ROUNDING,
        )

    @property
    def kind(self) -> WrenchKind:
        """A force along a line, a couple, both with a pitch, or none."""
        return _KINDS[self._screw.kind]

    @property
    def direction(self) -> FloatArray:
        """(3,) unit vector along the force or the couple, its first component positive."""
        return self._screw.direction

    @property
    def point(self) -> FloatArray:
        """(3,) of the line of the force, the one nearest to `about` [m]."""
        return self._screw.point

    @property
    def pitch(self) -> float:
        """Moment along the force over the force [m]; infinite of a couple."""
        return self._screw.pitch

    @property
    def magnitude(self) -> float:
        """Force along `direction` [N]; of a couple moment [N m]. It has a sign."""
        return self._screw.magnitude

    @property
    def size(self) -> float:
        """Its force times `length`, or its moment, whichever is larger [N m]."""
        return max(
            float(np.linalg.norm(self.force)) * self.length, float(np.linalg.norm(self.moment))
        )

    def at(self, point: ArrayLike) -> Wrench:
        """The same wrench with its moment about another point [m]."""
        there = floats(point, "a point")
        moment = self.moment + np.cross(self.about - there, self.force)
        return Wrench(self.force, moment, there, self.length, self.rest)

    def __add__(self, other: Wrench) -> Wrench:
        """Both together, about the point of this one."""
        moved = other.at(self.about)
        force, moment = self.force + moved.force, self.moment + moved.moment
        return Wrench(force, moment, self.about, self.length, max(self.rest, other.rest))

    def __neg__(self) -> Wrench:
        """The opposite one."""
        return Wrench(-self.force, -self.moment, self.about, self.length, self.rest)

    def __mul__(self, factor: float) -> Wrench:
        """So many times the wrench."""
        force, moment = self.force * factor, self.moment * factor
        return Wrench(force, moment, self.about, self.length, self.rest * abs(factor))

    def __bool__(self) -> bool:
        """Whether there is anything."""
        return self.size > self.rest

    def __str__(self) -> str:
        """In words."""
        if self.kind is WrenchKind.NONE:
            return "nothing"
        along, size = in_words(self.direction), f"{self.magnitude:.4g}"
        if self.kind is WrenchKind.COUPLE:
            return f"a moment of {size} N m about {along}"
        line = f"{size} N along {along} through {in_words(self.point, self.length)} m"
        if self.kind is WrenchKind.FORCE:
            return f"a force of {line}"
        return f"a force of {line} with a moment about it, pitch {self.pitch:.4g} m"

    def __repr__(self) -> str:
        """Likewise."""
        return f"<Wrench: {self}>"
