# SPDX-License-Identifier: BSD-3-Clause
"""Configurations: where all nodes of a model are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray, IntArray, floats
from ..core.elements import NodeKind
from ..util import rotations
from ..util.records import Frozen

#: Kinds of nodes; a search among all of them would take as long as all else that is done here.
_FIRST, _LAST = min(NodeKind), max(NodeKind)


@dataclass(frozen=True, eq=False)
class Configuration(Frozen):
    """Where all nodes of a model are.

    Attributes:
        kinds: (nodes,) `NodeKind` of each node.
        value: (nodes, 4) position [m]; Euler parameters, of any length but zero; or the
            angle [rad] of a planar node.
    """

    kinds: IntArray
    value: FloatArray

    def __post_init__(self) -> None:
        """Take read-only copies and check their shape."""
        given, value = floats(self.kinds, "kinds"), floats(self.value, "value").copy()
        if not np.all((given >= _FIRST) & (given <= _LAST) & (given % 1 == 0)):
            raise ValueError("kinds has a number that is no kind of node")
        kinds = given.astype(np.int32)
        if value.shape != (kinds.size, 4):
            raise ValueError(f"value has shape {value.shape}, not {(kinds.size, 4)}")
        object.__setattr__(self, "kinds", kinds)
        object.__setattr__(self, "value", value)
        super().__post_init__()

    def moved(self, delta: ArrayLike) -> Configuration:
        """This configuration moved by displacements and rotations.

        Args:
            delta: (nodes, 3) displacement of a position [m] along x, y, z; rotation vector
                [rad] about the global axes of an orientation, applied after the rotation
                that it has; a planar angle takes the third.

        Raises:
            TypeError: `delta` does not hold numbers.
            ValueError: `delta` has another shape, or a number is too large.
        """
        move = floats(delta, "delta")
        if move.shape != (self.kinds.size, 3):
            raise ValueError(f"delta has shape {move.shape}, not {(self.kinds.size, 3)}")
        value = self.value.copy()
        places = self.kinds <= NodeKind.POSITION
        value[places, :3] += move[places]
        angles = self.kinds == NodeKind.ANGLE
        value[angles, 0] += move[angles, 2]
        turned = self.kinds == NodeKind.ORIENTATION
        value[turned] = rotations.turned(value[turned], move[turned])
        return Configuration(self.kinds, value)
