# SPDX-License-Identifier: BSD-3-Clause
"""What wires and sheets are to do with a body: what it is to go on doing, and what not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...util.records import Frozen
from .families import SAME
from .screw_space import ScrewSpace, complement

#: Wanted motions that differ by less are one.
_APART = 1.0e-3


@dataclass(frozen=True, eq=False)
class Aim(Frozen):
    """What wires are to do with a body.

    Attributes:
        freedom: What the body can do.
        wanted: (w, 6) orthonormal rows, rotations times the length: what it is to go on doing.
        unwanted: (u, 6) orthonormal rows: the rest.
    """

    freedom: ScrewSpace
    wanted: FloatArray
    unwanted: FloatArray

    @classmethod
    def of(cls, freedom: ScrewSpace, twists: Sequence[FloatArray]) -> Aim:
        """Of a freedom space and the wanted twists in it, (6,) each."""
        rows = freedom.scaled
        factors = np.repeat((freedom.length, 1.0), 3)
        if not len(twists) or not len(rows):
            return cls(freedom, rows[:0], rows)
        shares = np.array([rows @ (twist * factors) for twist in twists])
        sizes = np.linalg.norm(shares, axis=1, keepdims=True)
        shares = shares / np.where(sizes > 0.0, sizes, 1.0)
        _, values, right = np.linalg.svd(shares)
        rank = int(np.sum(values > _APART))
        return cls(freedom, right[:rank] @ rows, right[rank:] @ rows)

    @property
    def may_hold(self) -> ScrewSpace:
        """The wrenches that do no work on what is wanted."""
        return self._space(self.wanted).reciprocal

    @property
    def stoppable(self) -> int:
        """How many of the unwanted motions wires can stop: as forces along lines span."""
        span = self.may_hold.span_of_lines
        works = np.roll(span, 3, axis=1) @ self.unwanted.T
        return int(np.sum(np.linalg.svd(works, compute_uv=False) > SAME)) if works.size else 0

    def stopped_by(self, line: FloatArray) -> Aim:
        """What is left to be done with a wire along a line, (6,) scaled."""
        works = self.unwanted @ np.roll(line, 3)
        left = complement(works[None] / np.linalg.norm(works)) @ self.unwanted
        return Aim(self.freedom, self.wanted, left)

    def _space(self, rows: FloatArray) -> ScrewSpace:
        one = self.freedom
        factors = np.repeat((one.length, 1.0), 3)
        return ScrewSpace(rows / factors, one.about, one.length, one.of_wrenches, one.planar)
