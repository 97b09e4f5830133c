# SPDX-License-Identifier: BSD-3-Clause
"""A design on the bench: its elastic model, its state at rest, and what pushes it off."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..core import elastic as core
from ..core.arrays import FloatArray
from ..core.elements import NodeKind
from ..deck.errors import model_error
from ..elasticity import Elastic, ElasticError, State, elastic
from ..elasticity.imperfections import misalignment
from ..elasticity.solution import Solution
from ..model.data import ModelData
from ..model.model import Model
from ..model.properties import Properties
from ..util.cached import cached_property
from .asking import ReleaseAsked
from .values import Misalignment

#: What rigid parts cannot follow of an error, beyond rounding.
MISMATCH = 1.0e-8


class Choice(NamedTuple):
    """What is made of a model."""

    held: str
    drive: str
    beams: int | str


def has_stiffness(data: ModelData) -> bool:
    """Whether any element has a stiffness."""
    given = data.properties
    return given is not None and bool((np.nan_to_num(given.stiffness) > 0.0).any())


def require_stiffness(data: ModelData) -> None:
    """Raise where no element has a stiffness.

    Raises:
        ModelError: none has.
    """
    if not has_stiffness(data):
        raise model_error(
            "no-stiffness",
            "what it costs needs stiffness, and the model gives none",
            "state ESTIFF for each flexible element behind the END of the kinematics (of a beam "
            "EA, G It, E Iy, E Iz), or give sheets a material in Python",
        )


def has_masses(data: ModelData) -> bool:
    """Whether any mass is given, so that there are frequencies."""
    given = data.properties
    return given is not None and any(
        bool((np.nan_to_num(part) > 0.0).any()) for part in (given.mass, given.node_mass)
    )


def with_unit_mass(data: ModelData, node: int) -> ModelData:
    """The model with the mass 1 kg, or inertia 1 kg m^2, at one node by its index, and no other.

    Its lowest squared frequency is the lowest stiffness of that node.
    """
    assert data.properties is not None
    mass = np.full_like(data.properties.node_mass, math.nan)
    if data.arrays.node_kind[node] == NodeKind.ORIENTATION:
        mass[node] = (1.0, 0.0, 0.0, 1.0, 0.0, 1.0)
    else:
        mass[node, 0] = 1.0
    given = data.properties
    none = np.full_like(given.mass, math.nan)
    return replace(data, properties=Properties(given.stiffness, none, mass))


class Bench:
    """A design: its elastic model, and its state at rest."""

    def __init__(self, data: ModelData, choice: Choice, pairs: ReleaseAsked, drive: int) -> None:
        """Of a model as given.

        Args:
            data: The model.
            choice: What is made of it.
            pairs: What is released.
            drive: Index of the node of which the stiffness stands for frequencies without masses.
        """
        self.data, self.choice, self.pairs, self.drive = data, choice, pairs, drive

    def with_beams(self, beams: int) -> Bench:
        """The same with another number of beams."""
        return Bench(self.data, self.choice._replace(beams=beams), self.pairs, self.drive)

    def released(self, pairs: ReleaseAsked) -> Bench:
        """The same with something else released."""
        return Bench(self.data, self.choice, pairs, self.drive)

    def _elastic(self, data: ModelData) -> Elastic:
        held, drive, beams = self.choice
        return elastic(Model.from_data(data), held, drive, self.pairs, beams)

    @cached_property
    def elastic(self) -> Elastic:
        """The elastic model."""
        return self._elastic(self.data)

    @cached_property
    def rest(self) -> State:
        """The undeformed state."""
        return self.elastic.undeformed()

    @cached_property
    def has_masses(self) -> bool:
        """Whether there are frequencies."""
        return has_masses(self.data)

    @cached_property
    def measured(self) -> Elastic:
        """The model whose first frequency is watched: without masses that of a unit mass."""
        if self.has_masses:
            return self.elastic
        return self._elastic(with_unit_mass(self.data, self.drive))

    @cached_property
    def levels(self) -> tuple[Level, ...]:
        """The design with each number of beams, the fewest first."""
        rest = self.rest if self.has_masses else self.measured.undeformed()
        return tuple(Level(self, k, each.finest) for k, each in enumerate(rest.alone))


class Level:
    """A design with one number of beams: what errors do to it whose stress is in proportion."""

    def __init__(self, bench: Bench, number: int, solution: Solution) -> None:
        """Keep the design, which of its meshes this is, and its state at rest."""
        self.bench, self.number, self.solution = bench, number, solution

    @cached_property
    def first_square(self) -> float:
        """Square of the first angular frequency [rad^2/s^2].

        Raises:
            ElasticError: a motion has no stiffness, or the design is unstable.
        """
        loose = self.bench.rest.loose
        if loose:
            raise ElasticError(f"a motion has no stiffness: {loose[0]}")
        values = self.solution.squares.values
        if not values.size or not values[0] > 0.0:
            raise ElasticError("no mass moves, or the undeformed state is unstable")
        return float(values[0])

    def response(self, misalignments: Sequence[Misalignment]) -> tuple[FloatArray, core.RawLinear]:
        """(3, nodes, k) moves of the supports for unit errors, and what they do.

        Raises:
            ElasticError: a self-stress of rigid parts is not determined.
        """
        self.bench.elastic.require_determined()
        solver, points = self.solution.solver, self.bench.elastic.points
        shift = np.zeros((3, solver.nodes, len(misalignments)), order="F")
        for k, each in enumerate(misalignments):
            off = misalignment(
                *(points, each.clamp.node, each.direction, 1.0, each.about), beyond=True
            )
            shift[:, : solver.mesh.nodes, k] = off.shift(solver.mesh.own)
        return shift, self.solution.respond(np.zeros_like(shift), None, shift)

    def stresses(self, misalignments: Sequence[Misalignment]) -> FloatArray:
        """(6, pieces, k) stress of each unit error; NaN where rigid parts cannot follow it.

        Raises:
            ElasticError: a self-stress of rigid parts is not determined.
        """
        _, answer = self.response(misalignments)
        return np.where(answer.mismatch > MISMATCH, np.nan, answer.stress)

    def errors(
        self, stresses: FloatArray, square: float, lengths: FloatArray | None = None
    ) -> FloatArray:
        """(k, 2) errors below and above zero that bring a frequency to a square; 0: it buckles.

        With lengths (k,) of unit errors only those about as short as the shortest; others are
        infinite.
        """
        at = self.solution
        model = at.solver.model(at.held)
        raw = core.errors(
            model, at.solver.arrays, at.raw, at.way.gravity, stresses, square, lengths
        )
        if raw.negative or raw.loose:
            raise ElasticError("the undeformed state is unstable, or a motion has no stiffness")
        return np.stack([raw.below, raw.above], axis=1)

    def measure(self, stress: FloatArray) -> float:
        """First frequency [Hz] under a stress, 0 where it is unstable; or the lowest stiffness."""
        at = self.solution
        raw = at.raw._replace(stress=np.asfortranarray(stress))
        model = at.solver.model(at.held)
        found = core.frequencies(model, at.solver.arrays, raw, at.way.gravity, 1)
        square = float(found.values[0])
        return max(square, 0.0) if not self.bench.has_masses else frequency_of(square)

    def buckled(self, each: Misalignment, sense: float) -> FloatArray | None:
        """(nodes, 3) the shape in which it buckles, below or above zero; None where it does not."""
        found = self.stressed(self.stresses((each,))[:, :, 0]).buckling
        right = np.flatnonzero(sense * found.values > 0.0)
        if not right.size:
            return None
        first = right[int(np.argmin(np.abs(found.values[right])))]
        return np.ascontiguousarray(found.modes[:, :, first].T)

    def stressed(self, stress: FloatArray) -> Solution:
        """The state at rest under a stress (6, pieces)."""
        at = self.solution
        raw = at.raw._replace(stress=np.asfortranarray(stress))
        return Solution(at.solver, raw, at.way, at.held)


def frequency_of(square: float) -> float:
    """A frequency [Hz] of the square of an angular one; 0 of an unstable motion."""
    return math.sqrt(max(square, 0.0)) / (2.0 * math.pi)
