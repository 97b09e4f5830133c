# SPDX-License-Identifier: BSD-3-Clause
"""The null spaces of D(c) and of its transpose, as spaces and in vectors that can be read."""

from __future__ import annotations

from dataclasses import dataclass

from ..core.basis import Basis
from ..util.cached import cached_property
from .decomposition import Outcome
from .mode_basis import (
    internal_motions,
    is_large,
    motion_basis,
    moves_within,
    scaled_motions,
    scaled_stresses,
    stress_basis,
)
from .result_sparse_basis import orthonormal
from .weights import column_weights, row_weights


@dataclass(frozen=True, eq=False, repr=False)
class Spaces(Outcome):
    """An outcome with bases of its null spaces; each is made when it is asked for."""

    def in_notebook(self, what: object) -> str | None:
        """HTML of a motion, a self-stress or a row of them; None: a result makes no pictures."""
        return None

    @cached_property
    def motion_space(self) -> Basis:
        """Orthonormal basis of the motions, rotations in lengths."""
        return orthonormal(self.raw.motions, column_weights(self))

    @cached_property
    def stress_space(self) -> Basis:
        """Orthonormal basis of the self-stresses, moments in forces."""
        return orthonormal(self.raw.stresses, row_weights(self))

    @cached_property
    def motion_basis(self) -> Basis:
        """The motions as they are told, [m] and [rad]: sparse over bodies, not orthogonal.

        The largest entry of each is 1, rotations compared by the characteristic length. Of
        large spaces they are those of the core, scaled (`flexact.analysis.mode_basis`).
        """
        if self.raw.motions.vectors < self.under_constrained or is_large(self.raw.motions):
            return scaled_motions(self)
        return motion_basis(self, self.motion_space)

    @cached_property
    def stress_basis(self) -> Basis:
        """The self-stresses as they are told: sparse over parts, the largest force or moment 1."""
        if self.raw.stresses.vectors < self.over_constrained or is_large(self.raw.stresses):
            return scaled_stresses(self)
        return stress_basis(self, self.stress_space)

    @cached_property
    def internal_motions(self) -> int:
        """How many motions move nothing but what is inside of sheets and wires.

        It is the dimension of the space of these. Of a space so large that it is told as the
        core gives it, it is how many of the core's vectors are so.
        """
        return internal_motions(self, self.motion_basis)

    @cached_property
    def are_between_ends(self) -> tuple[bool, ...]:
        """Of each motion whether it moves nothing but what is between the ends of flexures.

        That is insides of sheets and wires, and folds. Those that do are a basis of all such
        motions, but of spaces so large that they are told as the core gives them.
        """
        if not self.motion_basis.vectors:
            return ()
        nodes = self.carriers.between_ends
        return tuple(moves_within(self, self.motion_basis, nodes).tolist())
