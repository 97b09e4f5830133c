# SPDX-License-Identifier: BSD-3-Clause
"""A state of an elastic model, as users ask it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray
from ..core.elements import AXES, NodeKind, coordinate_name
from ..model.configuration import Configuration
from ..model.data import ModelData
from ..util.records import Frozen, cached_property
from .drives import force_of, reaction_of, value_at
from .errors import ElasticError, Estimate, matched_by_order, matched_by_sign
from .imperfections import Angle, vector_of
from .points import Coordinate
from .reduced import Reduced, Resultants, peak_stress, resultants_of
from .solution import Compliance, Solution
from .verdicts import Verdict

if TYPE_CHECKING:
    from .elastic import Elastic


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


Mine = TypeVar("Mine", bound="OnMeshes")


@dataclass(frozen=True, eq=False, repr=False)
class OnMeshes(Frozen):
    """A state: where everything is and what is stressed, and how it answers to small changes.

    Whatever is asked is computed once. With beams="auto" there are two meshes, and numbers are
    extrapolated from both (`estimate` has the uncertainty); eigenvalues are matched by their
    order.

    Attributes:
        model: The elastic model.
        label: What the state is, such as "undeformed".
        drive: The coordinate that was driven here, if one was.
        meshes: The state of each mesh, the coarser first.
    """

    model: Elastic
    label: str
    drive: Coordinate | None
    meshes: tuple[Solution, ...]

    @property
    def finest(self) -> Solution:
        """The state of the finer mesh, for pictures and further computations."""
        return self.meshes[-1]

    def estimate(self: Mine, quantity: Callable[[Mine], ArrayLike]) -> Estimate:
        """A quantity of this state with its uncertainty, from 8 and 16 beams a sheet.

        Args:
            quantity: What is wanted of a state, such as `lambda s: s.frequencies[0]`.
        """
        if len(self.alone) == 1:
            return Estimate.fixed(quantity(self.alone[0]))
        return Estimate.of(*map(quantity, self.alone))

    @cached_property
    def alone(self: Mine) -> tuple[Mine, ...]:
        """This state with each of its meshes alone."""
        if len(self.meshes) == 1:
            return (self,)
        return tuple(replace(self, meshes=(at,)) for at in self.meshes)

    def best(self, of: Callable[[Solution], ArrayLike]) -> FloatArray:
        """Numbers of the state of a mesh, extrapolated from those of both."""
        values = [np.asarray(of(each), np.float64) for each in self.meshes]
        made = values[0] if len(values) == 1 else Estimate.of(*values).value
        # A zero has no sign.
        return np.array(made) + 0.0

    def eigenvalues(
        self,
        of: Callable[[Solution], FloatArray],
        match: Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray]],
    ) -> FloatArray:
        """Eigenvalues likewise, of which `match` finds for each its like; ascending."""
        values = [of(each) for each in self.meshes]
        made = values[0] if len(values) == 1 else Estimate.of(*match(*values)).value
        return np.sort(made) + 0.0


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


#: How many eigenvalues are told.
_WORDS_MOST = 6
#: An uncertainty below this part of the value is not told.
_SHOWN = 1.0e-6


def describe(state: State) -> str:
    """What a state is, its verdict, whether it is stable, frequencies and multipliers."""
    lines = [f"{state.label[:1].upper()}{state.label[1:]}; {state.model.words}."]
    over, under = state.over_constrained, state.under_constrained
    lines.append(
        f"Over-constrained by {over}, under-constrained by {under}, by the deck's classes."
    )
    if state.drive is not None:
        lines.append(f"Force of the drive: {state.force:.6g}.")
    lines.append(f"Elastic energy: {state.energy:.6g} J.")
    lines.append(_stability(state))
    if state.model.has_mass:
        lines.append(f"Frequencies: {_listed(state, 'frequencies')} Hz.")
    else:
        lines.append("Nothing has a mass (EM, XM): there are no frequencies.")
    if state.finest.is_stressed:
        try:
            lines.append(f"Multipliers: {_listed(state, 'multipliers') or 'none'}.")
        except ElasticError as error:
            lines.append(f"Multipliers: {error}.")
    lines += [f"Note: {note}." for note in state.notes]
    return "\n".join(lines)


def _stability(state: State) -> str:
    if not state.is_stable:
        return "Buckled: this state is unstable."
    if state.loose:
        several = "s" * (len(state.loose) > 1)
        motions = "; ".join(map(str, state.loose[:_WORDS_MOST]))
        return f"{len(state.loose)} motion{several} without stiffness: {motions}."
    return "Stable."


def _listed(state: State, name: str) -> str:
    """Such as "9.92 (+- 0.01), 403"; the nearest to zero, ascending."""
    every = [getattr(each, name) for each in state.alone]
    match = matched_by_sign if name == "multipliers" else matched_by_order
    found = Estimate.of(*match(*every)) if len(every) > 1 else Estimate.fixed(every[0])
    least = _SHOWN * np.abs(found.value)
    nearest = np.argsort(np.abs(found.value), kind="stable")[:_WORDS_MOST]
    chosen = sorted(nearest.tolist(), key=lambda k: float(found.value[k]))
    return ", ".join(
        f"{found.value[k]:.5g}"
        + (f" (+- {found.uncertainty[k]:.1g})" if found.uncertainty[k] > least[k] else "")
        for k in chosen
    )


@dataclass(frozen=True, eq=False, repr=False)
class State(Response):
    """A state: where everything is and what is stressed, and how it answers to small changes.

    Whatever is asked is computed once. With beams="auto" there are two meshes, and numbers are
    extrapolated from both (`estimate` has the uncertainty); eigenvalues are matched by their
    order.

    Attributes:
        model: The elastic model.
        label: What the state is, such as "undeformed".
        drive: The coordinate that was driven here, if one was.
        meshes: The state of each mesh, the coarser first.
    """

    # -- where it is, and what it carries ------------------------------------------------------

    @property
    def data(self) -> ModelData:
        """The model of the finer mesh, to which `modes` and `configuration` belong."""
        return self.finest.solver.mesh.data

    @cached_property
    def configuration(self) -> Configuration:
        """Where the nodes of the finer mesh are; those of the deck come first."""
        kinds = self.data.arrays.node_kind
        return Configuration(kinds, self.finest.raw.configuration.T)

    def position(self, node: object) -> FloatArray | Angle:
        """Where a node is.

        Returns:
            (3,) position [m], planar (2,); of an orientation its rotation vector (3,) [rad],
            planar its angle, a number (which also is a vector of one).

        Raises:
            UnknownError: there is no such node.
        """
        index = self.model.points.node(node)
        kind = self.model.points.kinds[index]
        if kind == NodeKind.ANGLE:
            return Angle(self.best(lambda at: at.raw.configuration[0, index]))
        if kind == NodeKind.ORIENTATION:
            return self.best(lambda at: vector_of(at.raw.configuration[:, index]))
        axes = 2 if kind == NodeKind.PLANAR_POSITION else 3
        return self.best(lambda at: at.raw.configuration[:axes, index])

    def deformation(self, element: object, k: object) -> float:
        """A deformation of the deck's element between its own ends, in the deck's units.

        Raises:
            UnknownError: there is no such element or deformation.
        """
        e, number = self.model.points.deformation(element, k)
        return float(self.best(lambda at: at.deformation[number, e]))

    def stress(self, element: object, k: object) -> float:
        """The stress dual to a deformation of the deck's element: a force [N].

        Of torsion and bending it is the moment at that end over the element's length; of a
        hinge the moment [N m].

        Raises:
            UnknownError: there is no such element or deformation.
        """
        e, number = self.model.points.deformation(element, k)
        return float(self.best(lambda at: at.stress[number, e]))

    def resultants(self, element: object) -> Resultants:
        """Normal force, torque, moments at both ends and shear of the deck's element.

        Raises:
            UnknownError: there is no such element.
        """
        e = self.model.points.element(element)
        stress = self.best(lambda at: at.stress[:, e])
        return resultants_of(self.model.data, e, stress)

    def peak_stress(self, element: object) -> float:
        """The largest normal stress [Pa] anywhere in an element, or part, of known section.

        Args:
            element: Its number or handle, or the name of a part.

        Raises:
            ModelError: no part, or several, have this name.
            UnknownError: there is no such element.
            ElasticError: its section is not known.
        """
        which = self.model.points.elements(element)
        return float(self.best(lambda at: max(peak_of(at, e) for e in which)))

    @property
    def energy(self) -> float:
        """Elastic energy [J]."""
        return float(self.best(lambda at: at.energy))

    @property
    def force(self) -> float:
        """Force of the drive on the mechanism [N], or moment about the driven axis [N m]; signed.

        The axis is that of the spin that changes the angle and nothing else: x, y or z while the
        node turns about that alone. With a free drive compliance, stiffness and frequencies are
        those at this constant force or moment.
        0 where the drive is free and no stroke was asked for.

        Raises:
            ElasticError: several coordinates are locked, or none is declared that could be.
        """
        if self.drive is None and self.model.drive == "free":
            return 0.0
        drive = self.model.drive_of(self.drive)
        return float(self.best(lambda at: force_of(at, drive)))

    def reaction(self, node: object, coordinate: str) -> float:
        """Force or moment of what holds a coordinate, on the mechanism [N, N m].

        Raises:
            UnknownError: there is no such coordinate.
        """
        where = self.model.points.coordinate(node, coordinate)
        return float(self.best(lambda at: reaction_of(at, where)))

    @property
    def stroke(self) -> float:
        """Where the drive is [m, rad]."""
        drive = self.model.drive_of(self.drive)
        return float(self.best(lambda at: value_at(at, drive)))

    # -- the deck's own elements and classes ---------------------------------------------------

    @cached_property
    def _reduced(self) -> tuple[Reduced, ...]:
        return tuple(self.model.reducer.of(at) for at in self.meshes)

    def _matrix(self, which: int) -> FloatArray:
        values = [each[which] for each in self._reduced]
        return values[0] if len(values) == 1 else Estimate.of(*values).value

    @property
    def mass_matrix(self) -> FloatArray:
        """(q, q) in the declared coordinates and deformations, DYNX and DYNE in deck order.

        Like the two others of the deck's own elements with the deck's own classes, where their
        ends are; an Euler parameter counts half the angle.
        """
        return self._matrix(0)

    @property
    def stiffness_matrix(self) -> FloatArray:
        """(q, q) likewise, of the elastic deformations."""
        return self._matrix(1)

    @property
    def geometric_matrix(self) -> FloatArray:
        """(q, q) likewise, of all stresses, those of rigid deformations too."""
        return self._matrix(2)

    @cached_property
    def _verdict(self) -> Verdict:
        mesh = self.finest.solver.mesh
        return self.model.verdicts.of(mesh.own_nodes(self.finest.raw.configuration))

    @property
    def under_constrained(self) -> int:
        """Number of motions here that nothing determines, by the deck's classes."""
        return self._verdict.under_constrained

    @property
    def over_constrained(self) -> int:
        """Number of self-stresses here, by the deck's classes."""
        return self._verdict.over_constrained

    @property
    def smallest_singular_value(self) -> float:
        """The smallest singular value of D(c) itself here, in the deck's units."""
        return self._verdict.smallest_singular_value

    @property
    def notes(self) -> tuple[str, ...]:
        """What is to be known about the numbers of this state."""
        return self.model.notes_of(self.finest)

    def describe(self) -> str:
        """The state in plain English."""
        return describe(self)

    def __repr__(self) -> str:
        """What it is a state of."""
        return f"<State: {self.label}, {self.model.words}>"


def peak_of(at: Solution, element: int) -> float:
    """The largest normal stress [Pa] in the pieces of an element, by its index.

    Raises:
        ElasticError: its section is not known.
    """
    mesh = at.solver.mesh
    first, count = int(mesh.first[element]), int(mesh.pieces[element])
    every = [
        resultants_of(mesh.data, piece, at.raw.stress[:, piece])
        for piece in range(first, first + count)
    ]
    return peak_stress(mesh.own, element, every)
