# SPDX-License-Identifier: BSD-3-Clause
"""A design on the mechanism: its elastic model, its state at rest, and what pushes it off.

Stresses are in proportion to the error d. A frequency omega is reached where
K - omega^2 M + d G is singular, with G of the stresses of a unit error: one eigenvalue problem an
error, whatever its size; and with omega = 0 the design buckles.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..core.arrays import BoolArray, FloatArray
from ..core.elastic import RawLinear
from ..core.elements import NodeKind
from ..elasticity import Elastic, ElasticError, Estimate, State
from ..elasticity.equilibria import Imperfection, misalignment
from ..elasticity.limits import Strengths
from ..elasticity.points import words_of_direction
from ..elasticity.solution import Solution
from ..elasticity.tolerance import MISMATCH, Linear, unit_errors
from ..util.records import Frozen, cached_property
from .designs import (
    Misalignment,
    MisalignmentCurve,
    Number,
    Numbers,
    Point,
    Tolerance,
    unit_of_direction,
)

#: Compliances below this part of the largest, lengths by the size, are of directions that are held.
_HELD = 1.0e-12
#: The same of what moves after that did not move before.
_NEW = 1.0e-9
#: mu that differ by less than this part are equal.
_EQUAL = 1.0e-6
#: Parts of the energy from which a direction is named, and how many are.
_SHARE, _MOST_NAMED = 0.1, 2


#: All mu (k,) of the k directions that can move, ascending; their loads v (d, k) in the directions
#: of the point, scaled: moments by the size; and the part (d, k) of the work of each load that is
#: done in each direction.
Ratios = tuple[FloatArray, FloatArray, FloatArray]


def able(compliance: FloatArray, scale: FloatArray) -> BoolArray:
    """(d,) directions that are not held."""
    own = np.diag(compliance) * scale**2
    there = np.isfinite(own)
    return np.asarray(there & (own > _HELD * own[there].max(initial=0.0)))


def ratios(before: FloatArray, after: FloatArray, scale: FloatArray) -> Ratios:
    """All mu of C_before v = mu C_after v, ascending, of what can move in both; 1: all is kept.

    A compliance that is not positive definite, of a state that has buckled, gives mu of 0 or
    less: such a direction keeps nothing.

    Args:
        before: (d, d) compliance.
        after: (d, d) likewise.
        scale: (d,) as of `Measures`.
    """
    lost = np.isinf(np.diag(after)) & ~np.isinf(np.diag(before))
    if lost.any():
        return _nothing_left(before, after, scale, lost)
    free = np.flatnonzero(able(before, scale) & able(after, scale))
    if not free.size:
        none = np.zeros((scale.size, 0))
        return np.zeros(0), none, none
    one, two = ((each * np.outer(scale, scale))[np.ix_(free, free)] for each in (before, after))
    mu, vectors = _pairs((one + one.T) / 2.0, (two + two.T) / 2.0)
    loads, shares = (np.zeros((scale.size, mu.size)) for _ in range(2))
    vectors = _aligned(vectors, mu)
    done = vectors * (two @ vectors)
    loads[free] = vectors / np.abs(vectors).max(axis=0)
    shares[free] = done / np.where(done.sum(axis=0) != 0.0, done.sum(axis=0), 1.0)
    return mu, loads, shares


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
    mu, loads, shares = ratios(before, np.where(np.isfinite(inner), inner, 0.0), scale)
    first = lost.astype(np.float64)[:, None]
    return (
        np.concatenate([[0.0], mu]),
        np.hstack([first, loads]),
        np.hstack([first / first.sum(), shares]),
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
        """(d,) by which displacements are multiplied to be lengths: the size of a rotation."""
        units = map(unit_of_direction, self.directions)
        return np.array([self.size if unit == "rad" else 1.0 for unit in units])

    def compliance(self, state: State) -> FloatArray:
        """(d, d) at the point."""
        return state.compliance(self.point.node)

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
        mu, *_ = self.ratios(before, after)
        return mu[:1] if mu.size else np.ones(1)

    def frequencies(self, state: State) -> FloatArray:
        """(k,) lowest frequencies [Hz], ascending; 0 where a mode is unstable."""
        return np.maximum(np.asarray(state.frequencies[:MOST], np.float64), 0.0)


def over_levels(quantity: Callable[..., FloatArray], *states: State) -> Numbers:
    """A quantity of several states, extrapolated; of each number of beams what fits is taken."""
    made = [quantity(*each) for each in zip(*(s.alone for s in states), strict=True)]
    count = min(len(each) for each in made)
    found = Estimate.of(*(each[:count] for each in made))
    return Numbers(found.value, np.where(np.isfinite(found.uncertainty), found.uncertainty, 0.0))


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
    sizes = np.abs(shape) * np.where(state.data.arrays.node_kind > 2, measures.size, 1.0)[:, None]
    largest = float(sizes.max(initial=0.0))
    return float(sizes[index, "xyz".index(name[-1])]) / largest if largest > 0.0 else 0.0


@dataclass(frozen=True, eq=False)
class ElasticDesign(Frozen):
    """A design: its elastic model, and its state at rest.

    Attributes:
        elastic: The elastic model.
        watched: Index of the node of which the stiffness stands for frequencies without masses.
    """

    elastic: Elastic
    watched: int

    @cached_property
    def rest(self) -> State:
        """The undeformed state."""
        return self.elastic.undeformed()

    @cached_property
    def has_masses(self) -> bool:
        """Whether any mass is given, so that there are frequencies."""
        given = self.elastic.data.properties
        masses = () if given is None else (given.mass, given.node_mass)
        return any((np.nan_to_num(each) > 0.0).any() for each in masses)

    @cached_property
    def measured(self) -> State:
        """At rest, what has a first frequency to watch: without masses that of a unit mass."""
        data, node = self.elastic.data, self.watched
        given = data.properties
        if self.has_masses or given is None:
            return self.rest
        # With 1 kg, or 1 kg m^2, at the node alone the lowest square is the lowest stiffness.
        mass = np.full_like(given.node_mass, math.nan)
        if data.arrays.node_kind[node] == NodeKind.ORIENTATION:
            mass[node] = (1.0, 0.0, 0.0, 1.0, 0.0, 1.0)
        else:
            mass[node, 0] = 1.0
        properties = replace(given, mass=np.full_like(given.mass, math.nan), node_mass=mass)
        return replace(self.elastic, data=replace(data, properties=properties)).undeformed()

    @cached_property
    def levels(self) -> tuple[Level, ...]:
        """The design with each number of beams, the fewest first."""
        return tuple(Level(self, at) for at in self.measured.meshes)


class Level:
    """A design with one number of beams: what errors do to it whose stress is in proportion."""

    def __init__(self, mechanism: ElasticDesign, solution: Solution) -> None:
        """Keep the design, and its state at rest of one mesh."""
        self.mechanism, self.solution = mechanism, solution

    def square_at(self, shift: float) -> float:
        """Square of the first angular frequency [rad^2/s^2], shifted by a part of itself.

        Raises:
            ElasticError: a motion has no stiffness, or the design is unstable.
        """
        loose = self.mechanism.rest.loose
        if loose:
            raise ElasticError(f"a motion has no stiffness: {loose[0]}")
        values = self.solution.squares.values
        if not values.size or not values[0] > 0.0:
            raise ElasticError("no mass moves, or the undeformed state is unstable")
        return float(values[0]) * (1.0 + shift) ** 2

    def response(self, misalignments: Sequence[Misalignment]) -> tuple[FloatArray, RawLinear]:
        """(3, nodes, k) moves of the supports for unit errors, and what they do.

        Raises:
            ElasticError: a self-stress of rigid parts is not determined.
        """
        self.mechanism.elastic.require_determined()
        return unit_errors(self.solution, [self._off(each) for each in misalignments])

    def _off(self, each: Misalignment) -> Imperfection:
        points = self.mechanism.elastic.points
        return misalignment(points, each.clamp.node, each.direction, 1.0, each.about, beyond=True)

    def stresses(self, misalignments: Sequence[Misalignment]) -> FloatArray:
        """(6, pieces, k) stress of each unit error; NaN where rigid parts cannot follow it.

        Raises:
            ElasticError: a self-stress of rigid parts is not determined.
        """
        _, answer = self.response(misalignments)
        return np.where(answer.mismatch > MISMATCH, np.nan, answer.stress)

    def errors(
        self, stresses: FloatArray, *squares: float, lengths: FloatArray | None = None
    ) -> FloatArray:
        """(k, 2 squares) errors below and above zero by which a frequency has each square.

        For a square of 0 it buckles. With lengths (k,) of unit errors only those about as short as
        the shortest; others are infinite.
        """
        raw = self.solution.errors(stresses, squares, lengths)
        if raw.negative or raw.loose:
            raise ElasticError("the undeformed state is unstable, or a motion has no stiffness")
        return np.stack([raw.below, raw.above], axis=1).reshape(2 * len(squares), -1).T

    def usage(self, stresses: FloatArray, strengths: Strengths) -> FloatArray:
        """(k,) largest stress of unit errors, (6, pieces, k), over the strength of its part."""
        rows = [
            self.solution.under(each).peaks.von_mises[2] for each in np.moveaxis(stresses, 2, 0)
        ]
        return strengths.usage(np.array(rows)).max(axis=1) if rows else np.zeros(0)

    def measure(self, stress: FloatArray) -> float:
        """First frequency [Hz] under a stress, 0 where it is unstable; or the lowest stiffness."""
        # Of an unstable motion it is 0.
        square = max(self.solution.under(stress).lowest_square, 0.0)
        return math.sqrt(square) / (2.0 * math.pi) if self.mechanism.has_masses else square

    def rising(self, each: Misalignment, shift: float) -> tuple[float, float]:
        """Errors that raise the first frequency: of several modes it stays the lowest."""
        return Linear(self.solution, self._off(each)).shifted(shift)

    def buckled(self, each: Misalignment, sense: float) -> FloatArray | None:
        """(nodes, 3) the shape in which it buckles, below or above zero; None where it does not."""
        found = self.solution.under(self.stresses((each,))[:, :, 0]).buckling
        right = np.flatnonzero(sense * found.values > 0.0)
        if not right.size:
            return None
        first = right[int(np.argmin(np.abs(found.values[right])))]
        return np.ascontiguousarray(found.modes[:, :, first].T)


#: Errors of so many sizes of the model, or radians, are none that anybody makes, and far beyond
#: where the stress is in proportion to them.
FAR = 0.1
#: A design that buckles within so many times the reach is followed until it does.
_NEAR = 1.5
#: Places of a curve on each side of zero, closer where it falls steeply; few where it does not
#: fall to zero.
_PLACES, _FEW_PLACES = 9, 3


def tolerances_of(
    mechanism: ElasticDesign,
    misalignments: Sequence[Misalignment],
    shift: float,
    size: float,
    progress: Callable[[float], None],
) -> tuple[Tolerance, ...]:
    """The tolerance of each misalignment, and where the design buckles.

    Those that rigid parts cannot follow are left out: nothing can be off so.

    Args:
        mechanism: The design.
        misalignments: Of which clamps, in which directions.
        shift: Of the first frequency, relative.
        size: Of the model [m].
        progress: Called with the part that is done.

    Raises:
        ElasticError: there is no answer, as of a self-stress of rigid parts.
    """
    found, able = [], np.ones(len(misalignments), bool)
    for k, level in enumerate(mechanism.levels):
        square, stresses = level.square_at(shift), level.stresses(misalignments)
        able &= np.isfinite(stresses).all(axis=(0, 1))
        stresses = np.asfortranarray(stresses[:, :, able])
        progress((k + 0.5) / len(mechanism.levels))
        if shift < 0.0:
            critical, aimed = np.hsplit(level.errors(stresses, 0.0, square), 2)
        else:
            critical = level.errors(stresses, 0.0)
            some = [each for each, fits in zip(misalignments, able, strict=True) if fits]
            aimed = np.array([level.rising(each, shift) for each in some]).reshape(-1, 2)
        found.append(np.concatenate([aimed, critical], axis=1))
        progress((k + 1.0) / len(mechanism.levels))
    kept = [each for each, fits in zip(misalignments, able, strict=True) if fits]
    whole = Estimate.of(*found)
    return tuple(
        Tolerance(each, *(_number(whole, j, k, size, each.unit) for k in range(4)))
        for j, each in enumerate(kept)
    )


def safeties_of(
    mechanism: ElasticDesign, tolerances: Sequence[Tolerance], strengths: Strengths
) -> tuple[Number, ...]:
    """The strength over the largest stress at the smaller error of each tolerance.

    In proportion to the error, as the stress is taken; infinite without stress, 0 of an error
    without an end that stresses something.
    """
    misalignments = [each.misalignment for each in tolerances]
    rows = [level.usage(level.stresses(misalignments), strengths) for level in mechanism.levels]
    usage = Estimate.of(*rows)
    made = []
    for each, part, off in zip(
        tolerances, usage.value.tolist(), usage.uncertainty.tolist(), strict=True
    ):
        # Of rounding there is none.
        if not part > 0.0:
            made.append(Number(math.inf))
            continue
        safety = 1.0 / (part * each.tightest.value)
        made.append(Number(safety, safety * abs(off / part)))
    return tuple(made)


def _number(whole: Estimate, row: int, column: int, size: float, unit: str) -> Number:
    value, off = (float(each[row, column]) for each in (whole.value, whole.uncertainty))
    if abs(value) > FAR * (size if unit == "m" else 1.0):
        return Number(math.copysign(math.inf, value))
    return Number(value, off if math.isfinite(off) else 0.0)


def curve_against(
    mechanism: ElasticDesign, tolerance: Tolerance, reach: float
) -> MisalignmentCurve:
    """The first frequency, or stiffness, against one misalignment, up to where it buckles.

    Args:
        mechanism: The design.
        tolerance: Of that misalignment.
        reach: How far it is followed where it does not buckle before, about [m, rad].
    """
    low, high = tolerance.critical_negative.value, tolerance.critical_positive.value
    first, last = (
        end if abs(end) <= _NEAR * reach else math.copysign(reach, end) for end in (low, high)
    )
    values = np.concatenate([_places(first, low)[::-1], [0.0], _places(last, high)])
    rows = []
    for level in mechanism.levels:
        stress = level.stresses((tolerance.misalignment,))[:, :, 0]
        rows.append([level.measure(value * stress) for value in values.tolist()])
    whole = Estimate.of(*rows)
    is_lost = (values <= low) | (values >= high)
    measure = np.where(is_lost, 0.0, np.maximum(whole.value, 0.0))
    return MisalignmentCurve(
        tolerance.misalignment,
        values,
        Numbers(measure, np.where(measure > 0.0, whole.uncertainty, 0.0)),
    )


def _places(end: float, critical: float) -> FloatArray:
    """Errors from near zero to an end: more of them where the design buckles there."""
    count = _PLACES if end == critical else _FEW_PLACES
    return np.asarray(end * np.sin(np.linspace(0.0, math.pi / 2.0, count + 1)[1:]))
