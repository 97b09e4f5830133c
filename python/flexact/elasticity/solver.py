# SPDX-License-Identifier: BSD-3-Clause
"""A divided model with its policy, ready for the core: its models by what is held."""

from __future__ import annotations

import numpy as np

from ..core.arrays import BoolArray, FloatArray, PackedModel, packed
from ..core.elastic import ElasticArrays, ElasticState, Waypoint, element_stiffness
from ..core.elements import Class
from ..util.cached import cached_property
from .mesh import bending_pairs, rigid_of_pieces
from .points import Coordinate
from .policy import Policy, elastic_arrays, notch_in_units
from .stiffness_mesh import Mesh

#: Part of the compliance of all elements in parallel that is rounding.
_ROUNDING = 1.0e-6

Held = frozenset[Coordinate]


class Solver:
    """What the core needs of a divided model; nothing of it changes."""

    def __init__(self, mesh: Mesh, policy: Policy) -> None:
        """Of a mesh, with the policy of its deck's elements."""
        self.mesh, self.policy = mesh, policy
        self._models: dict[Held, PackedModel] = {}
        data, owner = mesh.data, mesh.owner
        place = np.arange(owner.size)
        is_first, is_last = place == mesh.first[owner], place == mesh.last[owner]
        kinds = mesh.own.arrays.element_kind
        rigid = rigid_of_pieces(policy.rigid, owner, is_first, is_last, kinds)
        self._classes = np.where(
            data.arrays.deformation_class == Class.NONE,
            Class.NONE,
            np.where(rigid, Class.FIXED, Class.DEPENDENT),
        ).astype(np.int32)
        self.arrays: ElasticArrays = elastic_arrays(data, self._notches(is_first, is_last))
        #: (6, pieces) which deformations are no multipliers: those with a notch neither.
        self.is_elastic: BoolArray = ~rigid | (self.arrays.notch >= 0.0)

    def _notches(self, is_first: BoolArray, is_last: BoolArray) -> FloatArray:
        """Notches of the pieces: at q those of the last, all others of the first."""
        mesh = self.mesh
        own = self.policy.arrays.notch[:, mesh.owner]
        there = np.repeat(is_first[None, :], 6, axis=0)
        for _, q, bends in bending_pairs(mesh.own.arrays.element_kind):
            there[q] = np.where(bends[mesh.owner], is_last, is_first)
        return notch_in_units(mesh.data, np.where(there, own, np.nan))

    def model(self, held: Held) -> PackedModel:
        """The model in which fixed coordinates and these are held, and all others free."""
        if held not in self._models:
            arrays = self.mesh.data.arrays
            given = arrays.coordinate_class
            classes = np.where(given > Class.FIXED, np.int32(Class.DEPENDENT), given)
            for node, axis in held:
                classes[axis, node] = Class.FIXED
            self._models[held] = packed(
                arrays._replace(
                    coordinate_class=np.asfortranarray(classes, np.int32),
                    deformation_class=np.asfortranarray(self._classes),
                )
            )
        return self._models[held]

    @property
    def nodes(self) -> int:
        """How many nodes the divided model has."""
        return int(self.mesh.data.arrays.node_number.size)

    @property
    def elements(self) -> int:
        """How many pieces it has."""
        return int(self.mesh.data.arrays.element_number.size)

    @cached_property
    def at_rest(self) -> ElasticState:
        """As the deck gives it, without stress."""
        value = np.asfortranarray(self.mesh.data.arrays.node_value)
        return ElasticState(value, self.no_misfit, self.no_force)

    @cached_property
    def nothing(self) -> Waypoint:
        """All held coordinates where the deck has them, no load, no misfit."""
        return Waypoint(self.at_rest.configuration, self.no_misfit, self.no_force, np.zeros(3))

    @cached_property
    def no_misfit(self) -> FloatArray:
        """(6, pieces) zeros."""
        return np.zeros((6, self.elements), order="F")

    @cached_property
    def no_force(self) -> FloatArray:
        """(3, nodes) zeros."""
        return np.zeros((3, self.nodes), order="F")

    @cached_property
    def elastic(self) -> tuple[FloatArray, FloatArray]:
        """Stiffness (pieces, 6, 6) without what is rigid, and torsion-elongation constants."""
        return element_stiffness(self.model(frozenset()), self.arrays)

    @cached_property
    def least_compliance(self) -> float:
        """What is more compliant than this [m/N] is so for a reason; 0 without any stiffness."""
        stiffness = np.diagonal(self.elastic[0], axis1=1, axis2=2)
        whole = float(stiffness[self.is_elastic.T].sum())
        return _ROUNDING / whole if whole > 0.0 else 0.0

    def loads(self, factor: float) -> tuple[FloatArray, FloatArray]:
        """(3, nodes) forces and (3,) gravity of the deck, times a factor."""
        given = self.mesh.own.loads
        force, gravity = self.no_force.copy(order="F"), np.zeros(3)
        if given is not None:
            force[:, : self.mesh.nodes] = factor * (given.force + given.increment).T
            gravity = factor * np.array(given.gravity)
        return force, gravity
