# SPDX-License-Identifier: BSD-3-Clause
"""A state of one mesh: what the core answers about it, each asked once."""

from __future__ import annotations

import math

import numpy as np

from ..core import calls, elastic
from ..core.arrays import BoolArray, FloatArray
from ..core.elastic import ElasticState, RawLinear, RawModes, Waypoint
from ..core.elements import Class, NodeKind
from ..util.cached import cached_property
from .compliance import Compliance, compliance_at
from .points import Coordinate, Point
from .policy import NO_STIFFNESS
from .solver import Held, Solver
from .stiffness_errors import ElasticError

#: How many frequencies and multipliers are computed.
FREQUENCIES, MULTIPLIERS = 10, 20
#: Multipliers so many times the nearest are those of stresses that are rounding.
_ROUNDING = 1.0e10


class Solution:
    """A state of one mesh.

    Attributes:
        solver: The mesh with its policy.
        raw: Configuration, stresses and reactions.
        way: The loads and misfits at which it is.
        held: Coordinates that are held in what is asked about it, besides the fixed ones.
    """

    def __init__(self, solver: Solver, raw: ElasticState, way: Waypoint, held: Held) -> None:
        """Keep what the state is."""
        self.solver, self.raw, self.way, self.held = solver, raw, way, held
        self._at: dict[Point, Compliance] = {}

    @cached_property
    def is_stressed(self) -> bool:
        """Whether anything but elastic stiffness acts."""
        return bool(
            np.any(self.raw.stress) or np.any(self.raw.reaction) or np.any(self.way.gravity)
        )

    def respond(
        self, force: FloatArray, misfit: FloatArray | None = None, shift: FloatArray | None = None
    ) -> RawLinear:
        """Increments under loads (3, nodes, k), misfits (6, pieces, k) and shifts likewise."""
        s, k = self.solver, force.shape[2]
        nothing = np.zeros((6, s.elements, k), order="F") if misfit is None else misfit
        at_rest = np.zeros((3, s.nodes, k), order="F") if shift is None else shift
        return elastic.linear(
            s.model(self.held), s.arrays, self.raw, self.way.gravity, force, nothing, at_rest
        )

    def compliance(self, point: Point, coordinates: list[Coordinate]) -> Compliance:
        """What a point does under unit loads along and about all of its coordinates."""
        if point not in self._at:
            force = np.zeros((3, self.solver.nodes, len(coordinates)), order="F")
            for i, (node, axis) in enumerate(coordinates):
                force[axis, node, i] = 1.0
            answer = self.respond(force)
            nodes, axes = (list(each) for each in zip(*coordinates, strict=True))
            self._at[point] = compliance_at(
                np.asarray(answer.displacement[axes, nodes]),
                np.asarray(self.unit_motions(answer.loose)[axes, nodes]),
                np.asarray(self.scale[nodes]),
                np.array([self._is_still(each) for each in coordinates]),
                self.solver.least_compliance,
            )
        return self._at[point]

    @property
    def _is_turn(self) -> BoolArray:
        """(nodes,) which are orientations."""
        return np.asarray(self.solver.mesh.data.arrays.node_kind > NodeKind.POSITION)

    @property
    def scale(self) -> FloatArray:
        """(nodes,) what makes a length of a turn; 1 for a displacement."""
        return np.where(self._is_turn, self.size, 1.0)

    def unit_motions(self, motions: FloatArray) -> FloatArray:
        """Motions (3, nodes, l) of which the largest displacement is 1 m, or a turn as large."""
        largest = np.abs(motions * self.scale[:, None]).max(axis=(0, 1), initial=0.0)
        return np.asarray(motions / np.where(largest > 0.0, largest, 1.0))

    def is_held(self, coordinate: Coordinate) -> bool:
        """Whether a coordinate is fixed, or locked."""
        node, axis = coordinate
        fixed = self.solver.mesh.data.arrays.coordinate_class[axis, node] == Class.FIXED
        return bool(fixed) or coordinate in self.held

    def _is_still(self, coordinate: Coordinate) -> bool:
        """Whether nothing moves along it: a held Euler parameter turned otherwise is no axis."""
        node, axis = coordinate
        turned = np.delete(self.raw.configuration[1:, node], axis)
        whole = not self._is_turn[node] or self.is_whole(node) or not np.any(turned)
        return whole and self.is_held(coordinate)

    def is_whole(self, node: int) -> bool:
        """Whether all of an orientation is held, so that its reaction is a moment on the spin."""
        if self.solver.mesh.data.arrays.node_kind[node] != NodeKind.ORIENTATION:
            return False
        return all(self.is_held(Coordinate(node, axis)) for axis in range(3))

    @cached_property
    def size(self) -> float:
        """A length of the model [m]: the root of the mean square of those of its elements."""
        length = self.solver.mesh.own.frames.length
        there = length[length > 0.0]
        return float(np.sqrt(np.mean(there**2))) if there.size else 1.0

    @cached_property
    def tangent(self) -> RawLinear:
        """The answer to no load at all: motions without stiffness, and negative stiffnesses."""
        return self.respond(np.zeros((3, self.solver.nodes, 1), order="F"))

    @cached_property
    def squares(self) -> RawModes:
        """Squares of the lowest angular frequencies with their modes."""
        s = self.solver
        return elastic.frequencies(
            s.model(self.held), s.arrays, self.raw, self.way.gravity, FREQUENCIES
        )

    @property
    def is_confirmed(self) -> bool:
        """Whether none is missing among the frequencies and multipliers that were asked for."""
        asked = (self.__dict__.get(name) for name in ("squares", "buckling"))
        return all(raw.is_complete for raw in asked if raw is not None)

    @property
    def frequencies(self) -> FloatArray:
        """The lowest frequencies [Hz], ascending; negative where the square is: unstable."""
        values = self.squares.values
        return np.asarray(np.sign(values) * np.sqrt(np.abs(values)) / (2.0 * math.pi))

    @cached_property
    def buckling(self) -> RawModes:
        """Multipliers of the stresses nearest to zero, of both signs, with their modes."""
        s = self.solver
        if not self.is_stressed:
            return RawModes(np.zeros(0), np.zeros((3, s.nodes, 0)), 0, 0, True)
        found = elastic.multipliers(
            s.model(self.held), s.arrays, self.raw, self.way.gravity, MULTIPLIERS
        )
        size = np.abs(found.values)
        some = size < _ROUNDING * size.min(initial=math.inf)
        return found._replace(values=found.values[some], modes=found.modes[:, :, some])

    @cached_property
    def deformation(self) -> FloatArray:
        """(6, elements) deformations of the deck's elements, between their own end nodes."""
        mesh = self.solver.mesh
        _, c_t = self.solver.elastic
        here = mesh.own_nodes(self.raw.configuration)
        return calls.assemble(mesh.own.packed, here, c_t[mesh.first]).deformation

    @cached_property
    def stress(self) -> FloatArray:
        """(6, elements) stresses of the deck's elements."""
        return self.solver.mesh.stress(self.raw.stress)

    @cached_property
    def energy(self) -> float:
        """Elastic energy [J]."""
        stiffness, c_t = self.solver.elastic
        data = self.solver.mesh.data
        here = calls.assemble(data.packed, self.raw.configuration, c_t).deformation
        strain = np.where(self.solver.is_elastic, here - self.way.misfit, 0.0).T
        return float(np.einsum("ei,eij,ej->", strain, stiffness, strain)) / 2.0

    def require_stiffness(self) -> None:
        """Raise where nothing in the model has a stiffness.

        Raises:
            ElasticError: There is none, and no stress either.
        """
        if not (self.solver.policy.has_stiffness or self.is_stressed):
            raise ElasticError(NO_STIFFNESS)
