# SPDX-License-Identifier: BSD-3-Clause
"""What a rigid body does at one moment: a translation, a rotation about a line, or a screw.

With its rotation w and the velocity v of a point c, any body moves along and about one line
(Chasles 1830; Hunt, *Kinematic Geometry of Mechanisms*, 1978): its pitch is w.v/w.w, and the point
of the line nearest to c is c + w x v/w.w.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray, floats
from ..util.records import Frozen, Word, cached_property
from ..util.units import METRES, Units
from .limits import NO_SENSE, ROUNDING


class ScrewKind(Word):
    """What the motion of a body is."""

    NONE = "none"
    TRANSLATION = "translation"
    ROTATION = "rotation"
    SCREW = "screw"


@dataclass(frozen=True, eq=False, repr=False)
class Screw(Frozen):
    """The motion of a rigid body at one moment.

    Attributes:
        kind: What it is.
        direction: (3,) unit vector along the axis, or of the translation; of the two senses the
            one whose first component other than zero is positive. Zero where nothing moves.
        point: (3,) of the axis, the one nearest to `centre` [m]; of a translation `centre`.
        pitch: How far it goes along the axis for a turn by one radian [m/rad], positive for a
            right-hand thread; 0 of a rotation, infinite of a translation.
        magnitude: Rotation about `direction` [rad], of a translation displacement along it [m].
            It has a sign.
        centre: (3,) the middle of the body's points [m].
        rotation: (3,) [rad].
        velocity: (3,) of `centre` [m].
        length: By which rotations compare with displacements [m].
        units: In which it is said.
    """

    kind: ScrewKind
    direction: FloatArray
    point: FloatArray
    pitch: float
    magnitude: float
    centre: FloatArray
    rotation: FloatArray
    velocity: FloatArray
    length: float
    units: Units = METRES

    def at(self, point: ArrayLike) -> FloatArray:
        """(3,) displacement of a point of the body [m], by where it is."""
        return self.velocity + np.cross(self.rotation, floats(point, "a point") - self.centre)

    def __bool__(self) -> bool:
        """Whether anything moves."""
        return self.kind is not ScrewKind.NONE

    def __str__(self) -> str:
        """In words."""
        along = in_words(self.direction)
        if self.kind is ScrewKind.NONE:
            return "does not move"
        if self.kind is ScrewKind.TRANSLATION:
            return f"moves by {self.units.said(self.magnitude, 'm')} along {along}"
        line = f"the line through {place_in_words(self.point, self.length, self.units)}"
        about = f"{self.magnitude:.4g} rad about {line} along"
        if self.kind is ScrewKind.ROTATION:
            return f"turns by {about} {along}"
        return f"screws by {about} {along}, pitch {self.units.said(self.pitch, 'm/rad')}"

    def __repr__(self) -> str:
        """Likewise."""
        return f"<Screw: {self}>"


def screw_of(
    rotation: ArrayLike,
    velocity: ArrayLike,
    centre: ArrayLike,
    length: float,
    *,
    rest: float = 0.0,
    rounding: float = ROUNDING,
    units: Units = METRES,
) -> Screw:
    """The screw of a body.

    It is a translation where the rotation times `length` is at most `rounding` of the motion,
    and a rotation where the pitch is at most `rounding` of `length` and the axis's distance from
    `centre`: what the rotation's direction is off by goes into the pitch with this distance.

    Args:
        rotation: (3,) [rad].
        velocity: (3,) of `centre` [m].
        centre: (3,) a point of the body [m].
        length: By which rotations compare with displacements [m].
        rest: Motions up to this size are none [m].
        rounding: What part of a motion may be rounding.
        units: In which it is said.
    """
    w, v, c = (np.array(each, float) for each in (rotation, velocity, centre))
    speed, turn = float(np.linalg.norm(v)), float(np.linalg.norm(w))
    size = max(speed, turn * length)
    if not size > rest:
        return Screw(ScrewKind.NONE, np.zeros(3), c, 0.0, 0.0, c, 0.0 * w, 0.0 * v, length, units)
    if not turn * length > rounding * size:
        sense = sense_of(v)
        direction = sense * v / speed
        return Screw(
            *(ScrewKind.TRANSLATION, direction, c, float("inf"), sense * speed),
            *(c, 0.0 * w, v, length, units),
        )
    unit = w / turn
    arm = np.cross(unit, v) / turn
    pitch = float(unit @ v) / turn
    is_screw = abs(pitch) > rounding * (length + float(np.linalg.norm(arm)))
    sense = sense_of(unit)
    kind = ScrewKind.SCREW if is_screw else ScrewKind.ROTATION
    return Screw(
        *(kind, sense * unit, c + arm, pitch * is_screw, sense * turn, c, w, v, length, units)
    )


def sense_of(vector: FloatArray) -> float:
    """1 or -1: the sign of the first component that is not zero beside the largest."""
    size = np.abs(vector)
    first = int(np.argmax(size > NO_SENSE * size.max(initial=0.0)))
    return -1.0 if vector[first] < 0.0 else 1.0


def in_words(vector: FloatArray, length: float = 0.0) -> str:
    """Its components; what is rounding beside the largest, or beside a length, is zero."""
    size = max(float(np.abs(vector).max(initial=0.0)), length)
    parts = np.where(np.abs(vector) > ROUNDING * size, vector, 0.0) + 0.0
    return f"({', '.join(f'{part:.4g}' for part in parts)})"


def place_in_words(place: FloatArray, length: float, units: Units) -> str:
    """A place [m] with its unit, likewise."""
    shown = units.shown(place, "m")
    return f"{in_words(shown, units.shown(length, 'm'))} {units.symbol('m')}"


class WrenchKind(Word):
    """What a wrench is."""

    NONE = "none"
    FORCE = "force"
    COUPLE = "couple"
    WRENCH = "wrench"


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
        units: In which it is said.
    """

    force: FloatArray
    moment: FloatArray
    about: FloatArray
    length: float
    rest: float = 0.0
    units: Units = METRES

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

    @property
    def vector(self) -> FloatArray:
        """(6,) force times `length`, and moment [N m]."""
        return np.concatenate((self.force * self.length, self.moment))

    def at(self, point: ArrayLike) -> Wrench:
        """The same wrench with its moment about another point [m]."""
        there = floats(point, "a point")
        moment = self.moment + np.cross(self.about - there, self.force)
        return replace(self, moment=moment, about=there)

    def __add__(self, other: Wrench) -> Wrench:
        """Both together, about the point of this one."""
        moved = other.at(self.about)
        force, moment = self.force + moved.force, self.moment + moved.moment
        return replace(self, force=force, moment=moment, rest=max(self.rest, other.rest))

    def __neg__(self) -> Wrench:
        """The opposite one."""
        return replace(self, force=-self.force, moment=-self.moment)

    def __mul__(self, factor: float) -> Wrench:
        """So many times the wrench."""
        force, moment = self.force * factor, self.moment * factor
        return replace(self, force=force, moment=moment, rest=self.rest * abs(factor))

    def __bool__(self) -> bool:
        """Whether there is anything."""
        return self.size > self.rest

    def __str__(self) -> str:
        """In words."""
        if self.kind is WrenchKind.NONE:
            return "nothing"
        along, units = in_words(self.direction), self.units
        if self.kind is WrenchKind.COUPLE:
            return f"a moment of {units.said(self.magnitude, 'N m')} about {along}"
        through = place_in_words(self.point, self.length, units)
        line = f"{self.magnitude:.4g} N along {along} through {through}"
        if self.kind is WrenchKind.FORCE:
            return f"a force of {line}"
        return f"a force of {line} with a moment about it, pitch {units.said(self.pitch, 'm')}"

    def __repr__(self) -> str:
        """Likewise."""
        return f"<Wrench: {self}>"
