# SPDX-License-Identifier: BSD-3-Clause
"""A state of one mesh: what the core answers about it, each asked once."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..analysis.limits import NO_COMPLIANCE, NODE_RESTS, POINT_RESTS, ROUNDING
from ..core import calls, elastic
from ..core.arrays import BoolArray, FloatArray, ModelArrays, PackedModel, packed
from ..core.elastic import (
    ElasticArrays,
    ElasticState,
    RawErrors,
    RawLinear,
    RawModes,
    Waypoint,
    element_stiffness,
)
from ..core.elements import (
    AXES,
    Class,
    Dual,
    NodeKind,
    Role,
    coordinate_name,
    dual_table,
    role_table,
)
from ..model.data import ModelData, Properties
from ..util.matrices import complement, span
from ..util.quantities import NOTCH, Quantity, measured
from ..util.records import Frozen, cached_property
from ..util.text import in_short
from ..util.units import Units
from .errors import ElasticError
from .mesh import Mesh, bending_pairs
from .points import Coordinate, Point, Points
from .stresses import Peaks, Sections, carried_by

HELD = ("elastic", "rigid")
DRIVES = ("free", "locked")

#: Deformations that are released, as users give them.
Release = Iterable[tuple[object, ...]] | Mapping[tuple[object, ...], Quantity]
#: Stiffness [N m/rad; N/m of an elongation] by numbers of element and deformation, from 1.
Releases = dict[tuple[int, int], float]


def choice(given: object, known: tuple[str, ...], what: str) -> str:
    """One of some words.

    Raises:
        ElasticError: it is none of them.
    """
    if given not in known or not isinstance(given, str):
        raise ElasticError(f"{what} must be {' or '.join(map(repr, known))}, not {in_short(given)}")
    return given


def releases_given(points: Points, given: object, units: Units | None = None) -> Releases:
    """Releases with the stiffness of each notch in SI, 0 where none is given.

    Numbers are in the units, by default those of the model.

    Raises:
        UnknownError: there is no such element or deformation.
        ElasticError: a stiffness is negative or not finite.
        TypeError: it is neither pairs nor a mapping of them.
    """
    if isinstance(given, Mapping):
        pairs = list(given.items())
    elif isinstance(given, Iterable) and not isinstance(given, (str, bytes)):
        pairs = [_with_stiffness(pair) for pair in given]
    else:
        raise TypeError(_WANTED + in_short(given))
    made: Releases = {}
    taken = units or points.data.units
    for pair, stiffness in pairs:
        if not isinstance(pair, (tuple, list)) or len(pair) not in (2, 3):
            raise TypeError(_WANTED + in_short(pair))
        # Of which kind a text is to be hangs on the deformation.
        number = measured(stiffness, NOTCH) if isinstance(stiffness, str) else stiffness
        if not isinstance(number, (int, float, np.number)) or isinstance(number, bool):
            number = math.nan
        if not (math.isfinite(number) and number >= 0.0):
            own = [points.data.units.symbol(each) for each in ("N m/rad", "N/m")]
            raise ElasticError(
                f"the stiffness of a release must be a number from 0 in {own[0]} (of an elongation "
                f"in {own[1]}), not {in_short(stiffness)}"
            )
        for element, k in points.deformations(*pair):
            unit = notch_unit(points.data, element, k)
            is_text = isinstance(stiffness, str)
            value = taken.read(stiffness, unit) if is_text else taken.si(float(number), unit)
            made[int(points.data.arrays.element_number[element]), k + 1] = value
    return made


def notch_unit(data: ModelData, element: int, k: int) -> str:
    """SI unit of the stiffness of a notch in deformation k, from 0, of an element, by its index."""
    role = role_table()[data.arrays.element_kind[element], k]
    return "N/m" if role in _LENGTHS else "N m/rad"


#: What is stretched or shifted, and not turned or bent.
_LENGTHS = (Role.ELONGATION, Role.OFFSET_X, Role.OFFSET_Y, Role.OFFSET_Z)


def _with_stiffness(given: object) -> tuple[object, object]:
    """A pair without a stiffness, or a pair with its own."""
    if isinstance(given, (tuple, list)) and given and isinstance(given[0], (tuple, list)):
        return (given[0], given[1]) if len(given) == 2 else (given, 0.0)
    return given, 0.0


NO_STIFFNESS = (
    "no element has a stiffness: give ESTIFF in the deck's dynamics block, or a material with a "
    "section"
)
_WANTED = "releases are pairs of an element and a deformation, or a mapping of them, not "


@dataclass(frozen=True, eq=False)
class Policy(Frozen):
    """What is rigid in a model, and what its elements are made of.

    Attributes:
        arrays: Stiffness and mass of the deck's elements; notches in N m/rad, N/m, by element.
        rigid: (6, elements) which deformations are rigid, those with a notch too: that is in
            series.
        stiff: (6, elements) which have a stiffness of their own.
    """

    arrays: ElasticArrays
    rigid: BoolArray
    stiff: BoolArray

    @property
    def has_stiffness(self) -> bool:
        """Whether any stiffness is given at all."""
        return bool(self.stiff.any() or np.nan_to_num(self.arrays.notch).any())


def policy_of(data: ModelData, held: str, release: Mapping[tuple[int, int], float]) -> Policy:
    """What is rigid: fixed deformations; with held "elastic" only those without a stiffness."""
    arrays = data.arrays
    notch = np.full(arrays.deformation_class.shape, np.nan, order="F")
    plain = elastic_arrays(data, notch)
    # What is rigid has none in the core: here all of it is asked for.
    free = np.where(arrays.deformation_class == Class.NONE, Class.NONE, Class.DEPENDENT)
    own, _ = element_stiffness(packed_with(arrays, arrays.coordinate_class, free), plain)
    stiff = np.diagonal(own, axis1=1, axis2=2).T > 0.0
    rigid = arrays.deformation_class == Class.FIXED
    if held == "elastic":
        rigid &= ~stiff
    for (element, k), stiffness in release.items():
        notch[k - 1, data.element_index[element]] = stiffness
    return Policy(elastic_arrays(data, notch), rigid, stiff)


def packed_with(
    arrays: ModelArrays, coordinates: np.ndarray, deformations: np.ndarray
) -> PackedModel:
    """A model with other classes of its coordinates and deformations, as the core takes it."""
    return packed(
        arrays._replace(
            coordinate_class=np.asfortranarray(coordinates, np.int32),
            deformation_class=np.asfortranarray(deformations, np.int32),
        )
    )


def elastic_arrays(data: ModelData, notch: FloatArray) -> ElasticArrays:
    """Stiffness and mass of a model, as the core takes them; NaN where nothing is given."""
    given, ne = data.properties, data.arrays.element_number.size
    if given is None:
        given = Properties.none(ne, data.arrays.node_number.size)
    stiffness, mass, node_mass = (
        np.asfortranarray(each.T) for each in (given.stiffness, given.mass, given.node_mass)
    )
    return ElasticArrays(stiffness, mass, node_mass, notch)


def notch_in_units(data: ModelData, notch: FloatArray) -> FloatArray:
    """Notches in the units of the deformations: of lengths that are angles, over length squared."""
    by_length = (dual_table()[data.arrays.element_kind] == Dual.MOMENT_OVER_LENGTH).T
    length = np.where(data.frames.length > 0.0, data.frames.length, 1.0)
    return np.asfortranarray(np.where(by_length, notch / length**2, notch))


class Compliance(NamedTuple):
    """What a point does under unit loads, rotations times a length of the model.

    Attributes:
        finite: (n, n) the compliance but for motions without stiffness.
        loose: (n, l) orthonormal motions of the point without any stiffness.
        scale: (n,) what makes a length of each coordinate.
        is_held: (n,) which are held.
    """

    finite: FloatArray
    loose: FloatArray
    scale: FloatArray
    is_held: BoolArray

    @property
    def matrix(self) -> FloatArray:
        """Compliance in SI units; 0 for what is held, infinite for motions without stiffness."""
        made = self.finite / np.outer(self.scale, self.scale)
        return _with_infinity(made, self.loose @ self.loose.T)

    @property
    def stiffness(self) -> FloatArray:
        """Stiffness in SI units: infinite for what is held, 0 for motions without stiffness."""
        values, some, none = self.springs
        made = (some / values) @ some.T * np.outer(self.scale, self.scale)
        return _with_infinity(made, none @ none.T)

    @property
    def springs(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """(k,) compliances of (n, k) orthonormal motions that are elastic, and (n, h) held ones."""
        across = complement(self.loose)
        inner = across.T @ self.finite @ across
        values, vectors = np.linalg.eigh((inner + inner.T) / 2.0)
        none = np.abs(values) <= NO_COMPLIANCE * np.abs(values).max(initial=0.0)
        turned = across @ vectors
        return values[~none], turned[:, ~none], turned[:, none]


def kept(before: Compliance, after: Compliance) -> FloatArray:
    """All mu of C_before v = mu C_after v, ascending, without held directions.

    A motion that the release leaves without stiffness gives 0; one without stiffness before,
    too, is left out.
    """
    free = ~after.is_held
    scale = before.scale / after.scale
    across = complement(after.loose[free])
    inner = across.T @ after.finite[np.ix_(free, free)] @ across
    values, vectors = np.linalg.eigh((inner + inner.T) / 2.0)
    some = values > NO_COMPLIANCE * np.abs(values).max(initial=0.0)
    root = across @ (vectors[:, some] / np.sqrt(values[some]))
    first = (before.finite * np.outer(1.0 / scale, 1.0 / scale))[np.ix_(free, free)]
    reduced = root.T @ first @ root
    made = np.linalg.eigvalsh((reduced + reduced.T) / 2.0)
    lost = max(after.loose.shape[1] - before.loose.shape[1], 0)
    return np.sort(np.concatenate([np.zeros(lost), np.maximum(made, 0.0)]))


def _with_infinity(finite: FloatArray, along: FloatArray) -> FloatArray:
    """The matrix with infinity, signed, where a projector has entries."""
    return np.where(np.abs(along) > ROUNDING, np.copysign(np.inf, along), finite)


#: Part of the compliance of all elements in parallel that is rounding.
_ROUNDED_COMPLIANCE = 1.0e-6

Held = frozenset[Coordinate]


class Solver:
    """What the core needs of a divided model; nothing of it changes."""

    def __init__(self, mesh: Mesh, policy: Policy) -> None:
        """Of a mesh, with the policy of its deck's elements."""
        self.mesh, self.policy = mesh, policy
        self._models: dict[Held, PackedModel] = {}
        rigid = mesh.rigid(policy.rigid)
        self._classes = np.where(
            mesh.data.arrays.deformation_class == Class.NONE,
            Class.NONE,
            np.where(rigid, Class.FIXED, Class.DEPENDENT),
        )
        # At q notches are those of the last piece, all others of the first.
        is_first, is_last = mesh.ends
        there = np.repeat(is_first[None, :], 6, axis=0)
        for _, q, bends in bending_pairs(mesh.own.arrays.element_kind):
            there[q] = np.where(bends[mesh.owner], is_last, is_first)
        own = np.where(there, policy.arrays.notch[:, mesh.owner], np.nan)
        self.arrays: ElasticArrays = elastic_arrays(mesh.data, notch_in_units(mesh.data, own))
        #: (6, pieces) which deformations are no multipliers: those with a notch neither.
        self.is_elastic: BoolArray = ~rigid | (self.arrays.notch >= 0.0)

    def model(self, held: Held) -> PackedModel:
        """The model in which fixed coordinates and these are held, and all others free."""
        if held not in self._models:
            arrays = self.mesh.data.arrays
            given = arrays.coordinate_class
            classes = np.where(given > Class.FIXED, np.int32(Class.DEPENDENT), given)
            for node, axis in held:
                classes[axis, node] = Class.FIXED
            self._models[held] = packed_with(arrays, classes, self._classes)
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
    def sections(self) -> Sections:
        """What stresses hang on, of the deck's elements."""
        return Sections.of(self.mesh.own)

    @cached_property
    def at_rest(self) -> ElasticState:
        """As the deck gives it, without stress."""
        value = np.asfortranarray(self.mesh.data.arrays.node_value)
        none = np.zeros((6, self.elements), order="F"), np.zeros((3, self.nodes), order="F")
        return ElasticState(value, *none)

    @cached_property
    def nothing(self) -> Waypoint:
        """All held coordinates where the deck has them, no load, no misfit."""
        return Waypoint(*self.at_rest, np.zeros(3))

    @cached_property
    def elastic(self) -> tuple[FloatArray, FloatArray]:
        """Stiffness (pieces, 6, 6) without what is rigid, and torsion-elongation constants."""
        return element_stiffness(self.model(frozenset()), self.arrays)

    @cached_property
    def least_compliance(self) -> float:
        """What is more compliant than this [m/N] is so for a reason; 0 without any stiffness."""
        whole = float(np.diagonal(self.elastic[0], axis1=1, axis2=2)[self.is_elastic.T].sum())
        return _ROUNDED_COMPLIANCE / whole if whole > 0.0 else 0.0

    def loads(self, factor: float) -> tuple[FloatArray, FloatArray]:
        """(3, nodes) forces and (3,) gravity of the deck, times a factor."""
        given = self.mesh.own.loads
        force, gravity = np.zeros((3, self.nodes), order="F"), np.zeros(3)
        if given is not None:
            force[:, : self.mesh.nodes] = factor * (given.force + given.increment).T
            gravity = factor * np.array(given.gravity)
        return force, gravity


#: How many frequencies and multipliers are computed.
FREQUENCIES, MULTIPLIERS = 10, 20
#: Multipliers so many times the nearest are those of stresses that are rounding.
_ROUNDED_MULTIPLIER = 1.0e10


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

    @property
    def _asked(self) -> tuple[PackedModel, ElasticArrays, ElasticState, FloatArray]:
        """What the core is asked about."""
        return self.solver.model(self.held), self.solver.arrays, self.raw, self.way.gravity

    def respond(
        self,
        force: FloatArray,
        shift: FloatArray | None = None,
        misfit: FloatArray | None = None,
    ) -> RawLinear:
        """Increments under loads (3, nodes, k), moves of what is held likewise, and misfits.

        These are (6, pieces, k), deformations without stress.
        """
        fits = np.zeros((6, self.solver.elements, force.shape[2]), order="F")
        at_rest = np.zeros_like(force) if shift is None else shift
        return elastic.linear(*self._asked, force, fits if misfit is None else misfit, at_rest)

    def under(self, stress: FloatArray) -> Solution:
        """The same place under a stress (6, pieces)."""
        raw = self.raw._replace(stress=np.asfortranarray(stress))
        return Solution(self.solver, raw, self.way, self.held)

    def errors(
        self, stresses: FloatArray, squares: Sequence[float], lengths: FloatArray | None = None
    ) -> RawErrors:
        """Errors at which a frequency has squares, of the stresses (6, pieces, k) of unit ones."""
        return elastic.errors(*self._asked, stresses, squares, lengths)

    @property
    def lowest_square(self) -> float:
        """The square of the first angular frequency alone [rad^2/s^2]."""
        return float(self.lowest(1).values[0])

    def lowest(self, count: int) -> RawModes:
        """Squares of so many of the lowest angular frequencies, with their modes."""
        return elastic.frequencies(*self._asked, count)

    def compliance(self, point: Point, coordinates: list[Coordinate]) -> Compliance:
        """What a point does under unit loads along and about all of its coordinates."""
        if point not in self._at:
            force = np.zeros((3, self.solver.nodes, len(coordinates)), order="F")
            for i, (node, axis) in enumerate(coordinates):
                force[axis, node, i] = 1.0
            answer = self.respond(force)
            nodes, axes = (list(each) for each in zip(*coordinates, strict=True))
            scale = np.asarray(self.scale[nodes])
            is_held = np.array([self._is_still(each) for each in coordinates])
            finite = answer.displacement[axes, nodes] * np.outer(scale, scale)
            finite = (finite + finite.T) / 2.0
            finite[is_held] = finite[:, is_held] = 0.0
            if np.abs(finite).max(initial=0.0) < self.solver.least_compliance:
                finite[:] = 0.0
            loose = self.unit_motions(answer.loose)[axes, nodes] * scale[:, None]
            loose = span(np.where(is_held[:, None], 0.0, loose), POINT_RESTS)
            self._at[point] = Compliance(finite, loose, scale, is_held)
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
        return elastic.frequencies(*self._asked, FREQUENCIES)

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
        if not self.is_stressed:
            return RawModes(np.zeros(0), np.zeros((3, self.solver.nodes, 0)), 0, 0, True)
        found = elastic.multipliers(*self._asked, MULTIPLIERS)
        size = np.abs(found.values)
        some = size < _ROUNDED_MULTIPLIER * size.min(initial=math.inf)
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
    def peaks(self) -> Peaks:
        """The largest stresses [Pa] in the deck's elements, all along."""
        mesh = self.solver.mesh
        carried = carried_by(mesh.data, self.raw.stress)
        return self.solver.sections.peaks(carried, mesh.owner, mesh.first)

    @cached_property
    def energy(self) -> float:
        """Elastic energy [J]."""
        stiffness, c_t = self.solver.elastic
        here = calls.assemble(self.solver.mesh.data.packed, self.raw.configuration, c_t).deformation
        strain = np.where(self.solver.is_elastic, here - self.way.misfit, 0.0).T
        return float(np.einsum("ei,eij,ej->", strain, stiffness, strain)) / 2.0

    def require_stiffness(self) -> None:
        """Raise where nothing in the model has a stiffness.

        Raises:
            ElasticError: There is none, and no stress either.
        """
        if not (self.solver.policy.has_stiffness or self.is_stressed):
            raise ElasticError(NO_STIFFNESS)


#: How many coordinates of a motion without stiffness are named.
_MOST_NAMED = 4


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
        shown = [f"{name} of node {node}" for node, name in self.coordinates[:_MOST_NAMED]]
        more = len(self.coordinates) - len(shown)
        if more > 0:
            shown.append(f"{more} more")
        return " and ".join(filter(None, [", ".join(shown[:-1]), *shown[-1:]])) or "inner nodes"


def loose_motion(at: Solution, k: int) -> LooseMotion:
    """A motion without stiffness of a state, by its index."""
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
            if size[axis, node] > NODE_RESTS
        ]
    # Of equal ones the first of the deck; rounding does not decide.
    found.sort(key=lambda each: -round(each[0], 6))
    return LooseMotion(moved.T.copy(), tuple((node, name) for _, node, name in found))
