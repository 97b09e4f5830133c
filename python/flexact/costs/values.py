# SPDX-License-Identifier: BSD-3-Clause
"""What the cost of a design is told in: numbers with uncertainty, clamps, releases, tolerances.

Lengths are in m, angles in rad, frequencies in Hz; directions are x y z rx ry rz of the deck's
axes. A number that does not exist is infinite (no misalignment does it), one that the deck does
not allow is None; none is NaN.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ..core.arrays import FloatArray

#: Directions of a point or clamp, in the order of all arrays; planar ones have x y rz.
DIRECTIONS = ("x", "y", "z", "rx", "ry", "rz")
PLANAR = ("x", "y", "rz")
#: What the first frequency is called where the deck has no masses.
FREQUENCY, STIFFNESS = "first frequency", "lowest stiffness"


def unit_of_direction(direction: str) -> str:
    """Of a displacement or rotation: m or rad."""
    return "rad" if direction.startswith("r") else "m"


def words_of_direction(direction: str) -> str:
    """Such as "along x" or "about z"."""
    return f"about {direction[1:]}" if direction.startswith("r") else f"along {direction}"


class Number(NamedTuple):
    """A number and what refinement leaves open of it.

    The value may be infinite, where no misalignment reaches what is asked for; its uncertainty is
    0 then. With a fixed number of beams the uncertainty is 0, and `Cost.beams` says so.
    """

    value: float
    uncertainty: float = 0.0

    @property
    def is_finite(self) -> bool:
        """Whether there is such a value."""
        return math.isfinite(self.value)


class Numbers(NamedTuple):
    """Numbers of one kind: values and uncertainties, two arrays of one shape."""

    value: FloatArray
    uncertainty: FloatArray


class Point(NamedTuple):
    """The point at which stiffness is measured."""

    node: int
    """Number of its position node."""
    orientation: int | None
    """Number of its orientation node; None where it has none: only displacements count then."""
    words: str
    """Such as "the stage" or "node 1"."""
    reason: str
    """Why it was taken: "as asked for", "the driven point", "where most parts meet"."""


class Clamp(NamedTuple):
    """A support that may be misaligned: position and orientation node, both of them held."""

    node: int
    """Number of its position node."""
    orientation: int | None
    """Number of its orientation node; None of a support that holds no rotation."""
    words: str
    """Such as "clamp 11" or "the clamp of sheet 1"."""
    label: str
    """Short, for tables and axes: a name, or "clamp 11"."""


class Misalignment(NamedTuple):
    """A clamp moved or turned."""

    clamp: Clamp
    direction: str
    """One of x y z rx ry rz."""
    about: int | None = None
    """Number of the position node through which the axis of a turn goes; None: the clamp's own."""

    @property
    def unit(self) -> str:
        """Of its size: m or rad."""
        return unit_of_direction(self.direction)

    @property
    def words(self) -> str:
        """Such as "clamp 11 along x"."""
        pivot = "" if self.about is None else f" through node {self.about}"
        return f"{self.clamp.words} {words_of_direction(self.direction)}{pivot}"


class Tolerance(NamedTuple):
    """What a clamp may be off in one direction.

    Stresses are taken in proportion to the error, about the undeformed state.
    """

    misalignment: Misalignment
    negative: Number
    """The error below zero that shifts the measure by `Cost.shift`; -infinity where none does."""
    positive: Number
    """Likewise above zero."""
    critical_negative: Number
    """The error below zero at which the design buckles; -infinity where none does."""
    critical_positive: Number
    """Likewise above zero."""

    @property
    def tightest(self) -> Number:
        """The smaller in size of both, as a size."""
        first = min(self.negative, self.positive, key=lambda each: abs(each.value))
        return Number(abs(first.value), first.uncertainty)

    @property
    def critical(self) -> Number:
        """The smaller in size of both critical errors, as a size."""
        first = min(self.critical_negative, self.critical_positive, key=lambda n: abs(n.value))
        return Number(abs(first.value), first.uncertainty)


class Released(NamedTuple):
    """A deformation that a design releases."""

    element: int
    """Number of the element."""
    deformation: int
    """From 1."""
    notch: float
    """Stiffness of the notch [N m/rad; of an elongation N/m]; 0: ideal."""
    words: str
    """Such as "sheet 1: in-plane bending at its clamp"."""

    @property
    def label(self) -> str:
        """Such as "1:5" or "1:5=3.5"."""
        return f"{self.element}:{self.deformation}" + (f"={self.notch:g}" if self.notch else "")


class Kept(NamedTuple):
    """What a design keeps of the stiffness as built at the point: C_before v = mu C_after v."""

    mu: Numbers
    """(directions that can move,) ascending; 1: all of it is kept."""
    worst: FloatArray
    """(6,), of planar models and points without orientation (3,): load v of the smallest mu
    [N, N m], its largest entry 1 with lengths in units of the model's size."""
    words: str
    """The direction, such as "about z" or "along x with a turn about y"."""

    @property
    def smallest(self) -> Number:
        """The smallest mu."""
        return Number(float(self.mu.value[0]), float(self.mu.uncertainty[0]))
