# SPDX-License-Identifier: BSD-3-Clause
"""How a state answers to small changes: compliance, frequencies, buckling."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray
from ..util.cached import cached_property
from .compliance import Compliance
from .errors import matched_by_order, matched_by_sign
from .loose import LooseMotion, loose_motions
from .on_meshes import OnMeshes
from .solution import Solution


@dataclass(frozen=True, eq=False, repr=False)
class Response(OnMeshes):
    """A state that is asked how it answers to small changes."""

    def compliance(self, node: object) -> FloatArray:
        """Displacements and small turns of a point under unit forces and moments there.

        Args:
            node: Position or orientation node of the point, or its name.

        Returns:
            (6, 6) in the order x y z rx ry rz [m/N, rad/N = 1/N, rad/(N m)]; without an
            orientation (3, 3) x y z, planar (3, 3) x y rz, or (2, 2) x y. What is held or locked
            has 0; what moves without any stiffness is infinite.

        Raises:
            UnknownError: there is no such node.
            ElasticError: nothing has a stiffness.
        """
        return self.best(lambda at: self._compliance(at, node).matrix)

    def stiffness(self, node: object) -> FloatArray:
        """The inverse of `compliance`: forces and moments for a unit motion, all else free.

        What is held, or rigid, is infinite; what has no stiffness is 0.

        Raises:
            UnknownError: there is no such node.
            ElasticError: nothing has a stiffness.
        """
        return self.best(lambda at: self._compliance(at, node).stiffness)

    def _compliance(self, at: Solution, node: object) -> Compliance:
        at.require_stiffness()
        point = self.model.points.of(node)
        return at.compliance(point, self.model.points.coordinates(point))

    @cached_property
    def frequencies(self) -> FloatArray:
        """Natural frequencies [Hz], ascending: the ten lowest, or all that there are.

        Negative where the square is: an unstable motion. 0 of a motion without stiffness.

        Raises:
            ElasticError: nothing has a mass, or nothing a stiffness.
        """
        self.model.require_mass()
        for at in self.meshes:
            at.require_stiffness()
        return self.eigenvalues(lambda at: at.frequencies, matched_by_order)

    @cached_property
    def modes(self) -> FloatArray:
        """(modes, nodes, 3) displacements and turns of the finer mesh, see `data`."""
        self.model.require_mass()
        return np.moveaxis(self.finest.squares.modes, (0, 1, 2), (2, 1, 0))

    @cached_property
    def multipliers(self) -> FloatArray:
        """By how much the stresses of this state would grow until it buckles, ascending.

        Of both signs, those nearest to zero, ten or more where there are so many: det(K + m G) = 0
        with G of the stresses here. Empty without stress.

        Raises:
            ElasticError: nothing has a stiffness.
        """
        for at in self.meshes:
            at.require_stiffness()
        return self.eigenvalues(lambda at: at.buckling.values, matched_by_sign)

    @cached_property
    def buckling_modes(self) -> FloatArray:
        """(modes, nodes, 3) of the finer mesh, of its own multipliers."""
        return np.moveaxis(self.finest.buckling.modes, (0, 1, 2), (2, 1, 0))

    @property
    def is_stable(self) -> bool:
        """Whether no motion has a negative stiffness; without one, see `loose`."""
        return self.finest.tangent.negative == 0

    @cached_property
    def loose(self) -> tuple[LooseMotion, ...]:
        """Motions without any stiffness."""
        return loose_motions(self.finest)
