# SPDX-License-Identifier: BSD-3-Clause
"""Linear spaces of twists or of wrenches, their reciprocal spaces, and what is in them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import FloatArray, floats
from ...util.cached import cached_property
from ...util.records import Frozen
from .families import SAME, Family
from .screws import families_of, parted, span_of_lines


@dataclass(frozen=True, eq=False)
class ScrewSpace(Frozen):
    """All twists that a body has, or all wrenches that hold it.

    A twist is a rotation w [rad] and the velocity v [m] of the point `about`; a wrench a force
    f [N] and the moment m [N m] about it. Both are six numbers, (w, v) and (f, m): a line first,
    and then its moment. They are reciprocal, the wrench does no work on the twist, where
    w.m + v.f = 0 (Ball 1900; Hunt, *Kinematic Geometry of Mechanisms*, 1978).

    Attributes:
        basis: (k, 6) rows (w, v) or (f, m); with the first three times `length` the rows are
            orthonormal.
        about: (3,) the middle of the body's points [m].
        length: By which rotations compare with displacements, and moments with forces [m].
        of_wrenches: Whether its members are wrenches, not twists.
        planar: Whether it is that of a planar model, with rotations about z and forces in the
            plane alone.
    """

    basis: FloatArray
    about: FloatArray
    length: float
    of_wrenches: bool = False
    planar: bool = False

    @property
    def dimension(self) -> int:
        """How many of them are independent."""
        return int(self.basis.shape[0])

    @property
    def scaled(self) -> FloatArray:
        """(k, 6) the orthonormal rows."""
        made: FloatArray = self.basis * self._factors
        return made

    @property
    def _factors(self) -> FloatArray:
        return np.repeat((self.length, 1.0), 3)

    @cached_property
    def families(self) -> tuple[Family, ...]:
        """The lines, directions and screws in it (`flexact.advice.spaces.screws`)."""
        return families_of(self.scaled, self.about, self.length)

    @property
    def lines(self) -> tuple[Family, ...]:
        """The families of lines: rotations, or forces."""
        return tuple(family for family in self.families if family.is_of_lines)

    @property
    def translations(self) -> tuple[Family, ...]:
        """The families of directions: translations, or couples."""
        return tuple(family for family in self.families if family.is_of_directions)

    def line(self, point: ArrayLike, direction: ArrayLike, pitch: float = 0.0) -> FloatArray:
        """(6,) the unit screw of a line: a rotation about it, or a force along it.

        Args:
            point: (3,) of the line [m].
            direction: (3,) along it.
            pitch: [m/rad], or [m] of a wrench.
        """
        d = floats(direction, "a direction")
        unit = d / np.linalg.norm(d)
        arm = floats(point, "a point") - self.about
        made: FloatArray = np.concatenate((unit, np.cross(arm, unit) + pitch * unit))
        return made

    @staticmethod
    def free(direction: ArrayLike) -> FloatArray:
        """(6,) a translation along a direction, or a couple about it."""
        d = floats(direction, "a direction")
        return np.concatenate((np.zeros(3), d / np.linalg.norm(d)))

    def distance(self, screw: FloatArray) -> float:
        """Which part of a twist or a wrench, (6,), is not in the space: from 0 to 1."""
        scaled = screw * self._factors
        rest = scaled - self.scaled.T @ (self.scaled @ scaled)
        return float(np.linalg.norm(rest) / np.linalg.norm(scaled))

    def has(self, screw: FloatArray, limit: float = SAME) -> bool:
        """Whether a twist or a wrench, (6,) as `line` and `free` make them, is in the space."""
        return self.distance(screw) <= limit

    def sine_to(self, other: ScrewSpace) -> float:
        """The sine of the largest angle of this space with another one about the same point."""
        rest = self.scaled - (self.scaled @ other.scaled.T) @ other.scaled
        return float(np.linalg.norm(rest, 2)) if rest.size else 0.0

    def nearest(self, screw: FloatArray) -> FloatArray:
        """(6,) the part of a twist or a wrench that is in the space."""
        scaled = screw * self._factors
        made: FloatArray = (self.scaled.T @ (self.scaled @ scaled)) / self._factors
        return made

    @cached_property
    def directions(self) -> FloatArray:
        """(t, 6) orthonormal rows of its directions: translations, or couples."""
        return parted(self.scaled)[0] if self.dimension else np.zeros((0, 6))

    @cached_property
    def span_of_lines(self) -> FloatArray:
        """(n, 6) scaled rows that span its lines, pure rotations or forces."""
        return span_of_lines(self.scaled)

    def works(self, screw: FloatArray) -> FloatArray:
        """(k,) the work of a wrench on each twist of the basis, or of each wrench on a twist.

        In parts of the largest that six numbers of this size could do.
        """
        scaled = screw * self._factors
        swapped = np.concatenate((scaled[3:], scaled[:3])) / np.linalg.norm(scaled)
        made: FloatArray = self.scaled @ swapped
        return made

    @cached_property
    def reciprocal(self) -> ScrewSpace:
        """Of twists all wrenches that do no work on them, and the other way round."""
        swapped = np.roll(self.scaled, 3, axis=1)
        used = np.arange(6)
        if self.planar:
            # Twists have wz, vx and vy; wrenches have fx, fy and mz.
            used = np.array([2, 3, 4] if self.of_wrenches else [0, 1, 5])
        made = np.zeros((used.size - self.dimension, 6))
        made[:, used] = complement(swapped[:, used])
        made = canonical(made)
        return ScrewSpace(
            made / self._factors, self.about, self.length, not self.of_wrenches, self.planar
        )


def complement(rows: FloatArray) -> FloatArray:
    """(n - k, n) orthonormal rows perpendicular to k independent ones, (k, n)."""
    count, size = rows.shape
    if not count:
        return np.eye(size)
    right: FloatArray = np.linalg.svd(rows)[2]
    return right[count:]


def canonical(rows: FloatArray) -> FloatArray:
    """(k, n) orthonormal rows that follow from the space of some alone: nearest to unit vectors.

    Args:
        rows: (k, n) orthonormal.
    """
    made = np.zeros((0, rows.shape[1]))
    chosen: list[int] = []
    while len(made) < len(rows):
        # The rest of each unit vector within the space, of which the largest is taken.
        rest = rows.T @ rows - made.T @ made
        place = int(np.argmax(np.round(np.diag(rest), 6)))
        made = np.concatenate((made, rest[place][None] / np.linalg.norm(rest[place])))
        chosen.append(place)
    return made[np.argsort(chosen)]
