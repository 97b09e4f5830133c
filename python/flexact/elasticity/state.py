# SPDX-License-Identifier: BSD-3-Clause
"""A state of an elastic model, as users ask it."""

from __future__ import annotations

from dataclasses import dataclass

from ..core.arrays import FloatArray
from ..core.elements import NodeKind
from ..model.configuration import Configuration
from ..model.data import ModelData
from ..util.cached import cached_property
from .errors import Estimate
from .reduced import Reduced
from .response import Response
from .resultants import Resultants, peak_stress, resultants_of
from .rotations import Angle, vector_of
from .solution import Solution
from .stiffness_drives import force_of, reaction_of, value_at
from .verdicts import Verdict
from .words import describe


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
