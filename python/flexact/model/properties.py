# SPDX-License-Identifier: BSD-3-Clause
"""Stiffness and mass, as a deck or its maker gave them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray
from ..core.raw import RawProperties
from ..util.records import Frozen

#: How many numbers an element or a node has at most of each.
NUMBERS = {"stiffness": 6, "mass": 5, "node_mass": 6}


@dataclass(frozen=True, eq=False)
class Properties(Frozen):
    """Stiffness and mass; whether a mechanism is exactly constrained does not depend on them.

    A row holds the numbers of one statement of the deck language, in its order, and NaN
    behind them. A row of NaN: nothing is given.

    Attributes:
        stiffness: (elements, 6) of ESTIFF. Of a beam EA [N], G It, E Iy, E Iz [N m^2] and the
            shear E Iy / (G A k), E Iz / (G A k) [m^2]; of a planar beam EA, EI and shear; of a
            truss EA; of a hinge the stiffness about its axis [N m/rad] and about the others.
        mass: (elements, 5) of EM. Of a beam mass [kg/m], then Jxx, Jyy, Jzz, Jyz [kg m] per
            length; of a planar beam mass and J; of a truss or a rigid link mass.
        node_mass: (nodes, 6) of XM. Of a position its mass [kg]; of an orientation Jxx, Jxy,
            Jxz, Jyy, Jyz, Jzz, of a planar one J [kg m^2].

    Raises:
        ValueError: a shape is wrong, or a number stands behind one that is not given.
    """

    stiffness: FloatArray
    mass: FloatArray
    node_mass: FloatArray

    def __post_init__(self) -> None:
        """Check the arrays and make them read-only."""
        super().__post_init__()
        for name, numbers in NUMBERS.items():
            array = getattr(self, name)
            if array.ndim != 2 or array.shape[1] != numbers:
                raise ValueError(f"{name} has shape {array.shape}, but must have (…, {numbers})")
            missing = np.isnan(array)
            if np.isinf(array).any() or (missing[:, :-1] & ~missing[:, 1:]).any():
                raise ValueError(f"{name} has a number behind one that is not given, or infinity")

    @classmethod
    def of(cls, raw: RawProperties) -> Properties | None:
        """What a deck says; None where no number of it is used."""
        if all(np.isnan(part).all() for part in raw):
            return None
        # What was read lies in a larger array.
        return cls(*(part.T.copy() for part in raw))
