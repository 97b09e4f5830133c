# SPDX-License-Identifier: BSD-3-Clause
"""Loads, as a deck or its maker gave them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray
from ..core.raw import RawLoads
from ..util.records import Frozen


@dataclass(frozen=True, eq=False)
class Loads(Frozen):
    """Dead loads; whether a mechanism is exactly constrained does not depend on them.

    Zero where nothing is given. A position has forces along x, y, z [N], an orientation
    moments about x, y, z [N m], which work on small rotations about these fixed axes; in a
    planar model there are forces along x and y, and the moment about z.

    Attributes:
        force: (nodes, 3) of XF.
        increment: (nodes, 3) of DELXF, which is added to XF in the course of loading.
        gravity: (3,) of GRAVITY, the acceleration of free fall [m/s^2].

    Raises:
        ValueError: a shape is wrong, or a number is not finite.
    """

    force: FloatArray
    increment: FloatArray
    gravity: FloatArray

    def __post_init__(self) -> None:
        """Check the arrays and make them read-only."""
        super().__post_init__()
        for name, shape in (
            ("force", (len(self.force), 3)),
            ("increment", (len(self.force), 3)),
            ("gravity", (3,)),
        ):
            array = getattr(self, name)
            if array.shape != shape:
                raise ValueError(f"{name} has shape {array.shape}, but must have {shape}")
            if not np.isfinite(array).all():
                raise ValueError(f"{name} has a number that is not finite")

    @classmethod
    def of(cls, raw: RawLoads) -> Loads | None:
        """What a deck says; None where all of it is zero."""
        if not any(part.any() for part in raw):
            return None
        return cls(raw.force.T.copy(), raw.increment.T.copy(), raw.gravity.copy())
