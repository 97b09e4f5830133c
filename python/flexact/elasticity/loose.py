# SPDX-License-Identifier: BSD-3-Clause
"""Motions without any stiffness, with what moves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import AXES, coordinate_name
from ..util.records import Frozen
from .solution import Solution

#: A node rests that moves by less, where the farthest moves by one.
_RESTS = 1.0e-6
#: How many coordinates are named.
_MOST = 4


@dataclass(frozen=True, eq=False)
class LooseMotion(Frozen):
    """A motion without any stiffness.

    Attributes:
        displacement: (nodes, 3) displacements and turns of the finer mesh; the largest is one.
        coordinates: Node and coordinate of what moves in the deck, the most first.
    """

    displacement: FloatArray
    coordinates: tuple[tuple[int, str], ...]

    def __str__(self) -> str:
        """Such as "y of node 2 and z of node 2"."""
        shown = [f"{name} of node {node}" for node, name in self.coordinates[:_MOST]]
        more = len(self.coordinates) - len(shown)
        if more > 0:
            shown.append(f"{more} more")
        return " and ".join(filter(None, [", ".join(shown[:-1]), *shown[-1:]])) or "inner nodes"


def loose_motions(at: Solution) -> tuple[LooseMotion, ...]:
    """All motions without stiffness of a state."""
    return tuple(_motion(at, k) for k in range(at.tangent.loose.shape[2]))


def _motion(at: Solution, k: int) -> LooseMotion:
    mesh = at.solver.mesh
    arrays = mesh.own.arrays
    moved = at.unit_motions(at.tangent.loose)[:, :, k]
    size = np.abs(moved) * at.scale
    found = []
    for node in range(mesh.nodes):
        kind = int(arrays.node_kind[node])
        found += [
            (float(size[axis, node]), int(arrays.node_number[node]), coordinate_name(kind, axis))
            for axis in AXES[kind]
            if size[axis, node] > _RESTS
        ]
    # Of equal ones the first of the deck; rounding does not decide.
    found.sort(key=lambda each: -round(each[0], 6))
    return LooseMotion(moved.T.copy(), tuple((node, name) for _, node, name in found))
