# SPDX-License-Identifier: BSD-3-Clause
"""A design on the mechanism: its elastic model, its state at rest, and what pushes it off."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ..core import elastic as core
from ..core.arrays import BoolArray, FloatArray
from ..core.elements import NodeKind
from ..deck.rendering import model_error
from ..elasticity import Elastic, ElasticError, Estimate, State, elastic
from ..elasticity.imperfections import misalignment
from ..elasticity.solution import Solution
from ..model.data import ModelData, Properties
from ..model.model import Model
from ..util.records import cached_property
from .designs import (
    Kept,
    Misalignment,
    Number,
    Numbers,
    Point,
    unit_of_direction,
    words_of_direction,
)
from .request import ReleaseRequest

#: Compliances below this part of the largest, lengths by the size, are of directions that are held.
_HELD = 1.0e-12
#: The same of what moves after that did not move before.
_NEW = 1.0e-9
#: mu that differ by less than this part are equal.
_EQUAL = 1.0e-6
#: Parts of the energy from which a direction is named, and how many are.
_SHARE, _MOST_NAMED = 0.1, 2


class Ratios(NamedTuple):
    """mu ascending with their loads."""

    mu: FloatArray
    """(k,) of the k directions that can move."""
    loads: FloatArray
    """(d, k) loads v in the directions of the point, scaled: moments by the size."""
    shares: FloatArray
    """(d, k) part of the work of each load that is done in each direction."""


def scales_of(directions: Sequence[str], size: float) -> FloatArray:
    """(d,) by which displacements are multiplied to be lengths: the size of a rotation."""
    return np.array([size if unit_of_direction(each) == "rad" else 1.0 for each in directions])


def able(compliance: FloatArray, scale: FloatArray) -> BoolArray:
    """(d,) directions that are not held."""
    own = np.diag(compliance) * scale**2
    there = np.isfinite(own)
    made: BoolArray = there & (own > _HELD * own[there].max(initial=0.0))
    return made


def ratios(before: FloatArray, after: FloatArray, scale: FloatArray) -> Ratios:
    """All mu of C_before v = mu C_after v, ascending, of what can move in both; 1: all is kept.

    A compliance that is not positive definite, of a state that has buckled, gives mu of 0 or
    less: such a direction keeps nothing.

    Args:
        before: (d, d) compliance.
        after: (d, d) likewise.
        scale: (d,) see `scales_of`.
    """
    lost = np.isinf(np.diag(after)) & ~np.isinf(np.diag(before))
    if lost.any():
        return _nothing_left(before, after, scale, lost)
    free = np.flatnonzero(able(before, scale) & able(after, scale))
    if not free.size:
        none = np.zeros((scale.size, 0))
        return Ratios(np.zeros(0), none, none)
    one, two = ((each * np.outer(scale, scale))[np.ix_(free, free)] for each in (before, after))
    mu, vectors = _pairs((one + one.T) / 2.0, (two + two.T) / 2.0)
    loads, shares = (np.zeros((scale.size, mu.size)) for _ in range(2))
    vectors = _aligned(vectors, mu)
    done = vectors * (two @ vectors)
    loads[free] = vectors / np.abs(vectors).max(axis=0)
    shares[free] = done / np.where(done.sum(axis=0) != 0.0, done.sum(axis=0), 1.0)
    return Ratios(mu, loads, shares)


def _pairs(one: FloatArray, two: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Values mu of one v = mu two v, ascending, and v, where something moves.

    By those of its inverse, so that only the first matrix need be positive; what moves in the
    second alone keeps nothing.
    """
    values, axes = np.linalg.eigh(one)
    some = values > _HELD * values.max()
    root = axes[:, some] / np.sqrt(values[some])
    inverse, turned = np.linalg.eigh(root.T @ two @ root)
    mu = np.where(inverse > 0.0, 1.0 / np.where(inverse > 0.0, inverse, 1.0), 0.0)
    rest = axes[:, ~some]
    left, new = np.linalg.eigh(rest.T @ two @ rest)
    moves = left > _NEW * max(np.trace(two), 0.0)
    mu = np.concatenate([np.zeros(int(moves.sum())), mu])
    vectors = np.hstack([rest @ new[:, moves], root @ turned])
    order = np.argsort(mu, kind="stable")
    return mu[order], vectors[:, order]


def _nothing_left(
    before: FloatArray, after: FloatArray, scale: FloatArray, lost: BoolArray
) -> Ratios:
    """The ratios where a motion without stiffness is new: 0 along it, then those of the rest."""
    inner = np.where(lost[:, None] | lost, 0.0, after)
    rest = ratios(before, np.where(np.isfinite(inner), inner, 0.0), scale)
    first = lost.astype(np.float64)[:, None]
    return Ratios(
        np.concatenate([[0.0], rest.mu]),
        np.hstack([first, rest.loads]),
        np.hstack([first / first.sum(), rest.shares]),
    )


def _aligned(vectors: FloatArray, mu: FloatArray) -> FloatArray:
    """With the first one, where others are equal, turned to as few directions as can be."""
    same = np.abs(mu - mu[0]) <= _EQUAL * max(abs(mu[0]), _EQUAL)
    count = int(np.count_nonzero(same))
    if count < 2:
        return vectors
    base = np.linalg.qr(vectors[:, :count])[0]
    # The last digits do not decide which of equal directions it is.
    row = int(np.argmax(np.round(np.linalg.norm(base, axis=1), 6)))
    made = vectors.copy()
    made[:, 0] = base @ base[row]
    return made


def kept_of(found: Ratios, mu: Numbers, directions: Sequence[str]) -> Kept | None:
    """The ratios with uncertainties and words; None where nothing can move."""
    if not found.mu.size:
        return None
    return Kept(mu, found.loads[:, 0], direction_words(found.shares[:, 0], directions))


def direction_words(shares: FloatArray, directions: Sequence[str]) -> str:
    """Such as "about z", or "along x and about y"."""
    order = np.argsort(-np.round(shares, 6), kind="stable")[:_MOST_NAMED]
    named = [k for k in order.tolist() if shares[k] >= _SHARE] or [int(order[0])]
    return " and ".join(words_of_direction(directions[k]) for k in named)


#: How many frequencies are looked at.
MOST = 10
#: From which part of the largest displacement of a mode the driven point moves in it.
_DRIVEN = 0.1


@dataclass(frozen=True)
class Measures:
    """What is measured, and where.

    Attributes:
        point: The point.
        directions: Its directions.
        size: Of the model [m].
        drives: Declared coordinates, number of the node and name.
        has_masses: Whether there are frequencies.
    """

    point: Point
    directions: tuple[str, ...]
    size: float
    drives: tuple[tuple[int, str], ...]
    has_masses: bool

    @property
    def scale(self) -> FloatArray:
        """(d,) see `keeping.scales_of`."""
        return scales_of(self.directions, self.size)

    def compliance(self, state: State) -> FloatArray:
        """(d, d) at the point."""
        made: FloatArray = np.asarray(state.compliance(self.point.node), np.float64)
        return made

    def stiffness(self, state: State) -> FloatArray:
        """(d,) inverse of each compliance along its direction; infinite where it is held."""
        compliance = self.compliance(state)
        free = able(compliance, self.scale) | np.isinf(np.diag(compliance))
        own = np.where(free, np.diag(compliance), 1.0)
        return np.where(free, 1.0 / own, np.inf)

    def ratios(self, before: State, after: State) -> Ratios:
        """What is kept of the stiffness at the point."""
        return ratios(self.compliance(before), self.compliance(after), self.scale)

    def worst(self, before: State, after: State) -> FloatArray:
        """(1,) smallest part that is kept; 1 of a point that cannot move."""
        mu = self.ratios(before, after).mu
        return mu[:1] if mu.size else np.ones(1)

    def frequencies(self, state: State) -> FloatArray:
        """(k,) lowest frequencies [Hz], ascending; 0 where a mode is unstable."""
        return np.maximum(np.asarray(state.frequencies[:MOST], np.float64), 0.0)


def numbers(estimate: Estimate) -> Numbers:
    """An estimate as a cost has it."""
    value, off = np.atleast_1d(estimate.value), np.atleast_1d(estimate.uncertainty)
    return Numbers(value, np.where(np.isfinite(off), off, 0.0))


def number(estimate: Estimate) -> Number:
    """The same of a single number."""
    value, off = float(estimate.value), float(estimate.uncertainty)
    return Number(value, off if np.isfinite(off) else 0.0)


def over_levels(quantity: Callable[..., FloatArray], *states: State) -> Estimate:
    """A quantity of several states, extrapolated; of each number of beams what fits is taken."""
    made = [quantity(*each) for each in zip(*(s.alone for s in states), strict=True)]
    if len(made) == 1:
        return Estimate.fixed(made[0])
    count = min(len(each) for each in made)
    return Estimate.of(made[0][:count], made[1][:count])


def drives_of(measures: Measures, state: State, count: int) -> tuple[bool, ...]:
    """Which of the lowest frequencies belong to a declared coordinate: one of each.

    Without a declared coordinate none does. The mode is the one in which the driven point moves
    most, of several the lowest.
    """
    found = [False] * count
    finest = state.alone[-1]
    for node, name in measures.drives:
        moved = [_moved(measures, finest, k, node, name) for k in range(count)]
        best = int(np.argmax(np.round(moved, 1)))
        if moved[best] >= _DRIVEN:
            found[best] = True
    return tuple(found)


def _moved(measures: Measures, state: State, mode: int, node: int, name: str) -> float:
    """How far a coordinate moves in a mode, as a part of what moves farthest."""
    shape = np.asarray(state.modes[mode], np.float64)
    index = state.data.node_index[node]
    turns = state.data.arrays.node_kind > 2
    sizes = np.abs(shape) * np.where(turns, measures.size, 1.0)[:, None]
    largest = float(sizes.max(initial=0.0))
    return float(sizes[index, "xyz".index(name[-1])]) / largest if largest > 0.0 else 0.0


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


class ElasticDesign:
    """A design: its elastic model, and its state at rest."""

    def __init__(self, data: ModelData, choice: Choice, pairs: ReleaseRequest, drive: int) -> None:
        """Of a model as given.

        Args:
            data: The model.
            choice: What is made of it.
            pairs: What is released.
            drive: Index of the node of which the stiffness stands for frequencies without masses.
        """
        self.data, self.choice, self.pairs, self.drive = data, choice, pairs, drive

    def with_beams(self, beams: int) -> ElasticDesign:
        """The same with another number of beams."""
        return ElasticDesign(self.data, self.choice._replace(beams=beams), self.pairs, self.drive)

    def released(self, pairs: ReleaseRequest) -> ElasticDesign:
        """The same with something else released."""
        return ElasticDesign(self.data, self.choice, pairs, self.drive)

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

    def __init__(self, mechanism: ElasticDesign, number: int, solution: Solution) -> None:
        """Keep the design, which of its meshes this is, and its state at rest."""
        self.mechanism, self.number, self.solution = mechanism, number, solution

    @cached_property
    def first_square(self) -> float:
        """Square of the first angular frequency [rad^2/s^2].

        Raises:
            ElasticError: a motion has no stiffness, or the design is unstable.
        """
        loose = self.mechanism.rest.loose
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
        self.mechanism.elastic.require_determined()
        solver, points = self.solution.solver, self.mechanism.elastic.points
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
        if not self.mechanism.has_masses:
            return max(square, 0.0)
        # Of an unstable motion it is 0.
        return math.sqrt(max(square, 0.0)) / (2.0 * math.pi)

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
