# SPDX-License-Identifier: BSD-3-Clause
"""A mechanism as a workshop makes it: clamps that are off, and thicknesses that differ.

The state of a sample is sought from the state as designed, at rest or at the end of a stroke, in
one way; frequencies are linear about it. The whole path goes from rest, for comparison.
"""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..core.arrays import BoolArray, FloatArray
from ..core.elements import Class, Member, NodeKind, member_table
from ..model.data import CrossSection, ModelData
from ..model.draft import Shape
from ..model.sections import Constants, constants_of
from ..util.records import Frozen, cached_property
from ..util.rotations import turned, vector_between
from . import equilibria
from .equilibria import Imperfection, at_rest, force_of, freed
from .limits import Strengths
from .points import Coordinate
from .solution import Solution, Solver
from .tolerance import unit_errors

if TYPE_CHECKING:
    from .elastic import Elastic

#: What is called that a state is sought along.
_OFF = "part of what is off"
#: A mode in which a declared coordinate moves by this part of what moves farthest is the drive's.
_DRIVEN = 0.1


class Scales(NamedTuple):
    """What other thicknesses make of the elements of a model."""

    size: FloatArray
    """(2, elements) sizes along local y and z [m]."""
    stiffness: FloatArray
    """(6, elements) factors of ESTIFF."""
    mass: FloatArray
    """(5, elements) factors of EM."""


@dataclass(frozen=True, eq=False)
class Thicknesses(Frozen):
    """The elements whose thickness is known, and how their stiffness and mass follow it.

    EA and the mass go with the area, E I, G It and the moments of inertia with those of the
    section (`flexact.model.sections.constants_of`), and the shear numbers with E I over the area.
    The thickness of a circle is its diameter, of a rectangle the smaller size, in a planar model
    that in its plane; the other size stays.

    Attributes:
        data: The model as given.
        is_known: (elements,) of which it is known.
    """

    data: ModelData
    is_known: BoolArray

    @cached_property
    def size(self) -> FloatArray:
        """(2, elements) sizes along local y and z [m], 1 where not known."""
        return np.where(self.is_known, self.data.appearance.dimensions.T, 1.0)

    @cached_property
    def _planar(self) -> BoolArray:
        return np.asarray(self.data.arrays.deformation_class[3] == Class.NONE)

    @cached_property
    def follows(self) -> BoolArray:
        """(2, elements) which sizes are the thickness."""
        is_round = self.data.appearance.cross_section == CrossSection.CIRC
        y, z = self.size
        along_y = is_round | self._planar | (y <= z)
        return np.asarray([along_y, is_round | ~along_y])

    @property
    def thickness(self) -> FloatArray:
        """(elements,) [m]; 1 where not known."""
        return np.asarray(np.where(self.follows[0], self.size[0], self.size[1]))

    def constants(self, element: int, size: FloatArray) -> Constants:
        """Of the section of an element with other sizes (2, elements)."""
        kind = int(self.data.appearance.cross_section[element])
        return constants_of(Shape(kind, float(size[0, element]), float(size[1, element])))

    @cached_property
    def _designed(self) -> dict[int, Constants]:
        return {e: self.constants(e, self.size) for e in np.flatnonzero(self.is_known).tolist()}

    def changed(self, by: FloatArray) -> Scales:
        """What becomes of the elements where thicknesses change by (elements,) [m]."""
        return self.resized(self.size + np.where(self.follows & self.is_known, by, 0.0))

    def resized(self, size: FloatArray) -> Scales:
        """What becomes of the elements with other sizes (2, elements) along local y and z [m]."""
        stiffness, mass = (np.ones((n, size.shape[1])) for n in (6, 5))
        bars = member_table()[self.data.arrays.element_kind] == Member.BAR
        for e in np.flatnonzero(self.is_known & (size != self.size).any(axis=0)).tolist():
            old, new = self._designed[e], self.constants(e, size)
            area, iy, iz, torsion = (b / a for a, b in zip(old, new, strict=True))
            polar = (new.iy + new.iz) / (old.iy + old.iz)
            if bars[e]:
                stiffness[0, e] = mass[0, e] = area
            elif self._planar[e]:
                stiffness[:3, e], mass[:2, e] = (area, iz, iz / area), (area, iz)
            else:
                stiffness[:, e] = area, torsion, iy, iz, iy / area, iz / area
                mass[:, e] = area, polar, iy, iz, polar
        return Scales(size, stiffness, mass)


class Measured(NamedTuple):
    """What is known of a mechanism with errors, in SI; NaN where it is not."""

    stress: float
    """The largest of von Mises in any part and state [Pa]."""
    usage: float
    """The largest of stress over strength."""
    element: int
    """Index of the element that is nearest to its strength, or stressed most."""
    frequency: float
    """The lowest in any state [Hz]; 0 where a motion is unstable."""
    parasitic: float
    """The lowest that is not the drive's."""
    force: float
    """Of the drive [N, N m], in the last state."""
    errors: tuple[float, ...]
    """How far the point is from where it is as designed [m, rad], in the last state."""


@dataclass(frozen=True, eq=False)
class Scattered(Frozen):
    """A mechanism of which clamps and thicknesses are off.

    Attributes:
        elastic: The model, of one mesh, in SI, with nothing off.
        off: What is off of clamps, a unit of each.
        parts: Indices of the elements of each part whose thickness is.
        thicknesses: Of the model.
        coordinates: Of the point that is watched.
        drive: What is driven, or locked at rest.
        values: Where it is driven to, the farthest last; none: only the state at rest counts.
        strengths: What the stress is compared with.
    """

    elastic: Elastic
    off: tuple[Imperfection, ...]
    parts: tuple[tuple[int, ...], ...]
    thicknesses: Thicknesses
    coordinates: tuple[Coordinate, ...]
    drive: Coordinate | None
    values: tuple[float, ...]
    strengths: Strengths | None

    @cached_property
    def solver(self) -> Solver:
        """The mesh as designed."""
        return self.elastic.solvers[0]

    @cached_property
    def designed(self) -> tuple[Solution, ...]:
        """The states as designed: at rest, and at the values of the drive, which is held.

        Raises:
            StrokeError: one was not reached.
        """
        rest = at_rest(self.solver, self.elastic.locked)
        if self.drive is None or not self.values:
            return (rest,)
        points = self.elastic.points
        return rest, *equilibria.driven(rest, points, self.drive, self.values, True)

    @cached_property
    def _shift(self) -> FloatArray:
        """(3, nodes, k) moves of the supports for a unit of each error."""
        return unit_errors(self.designed[0], self.off)[0]

    @cached_property
    def _count(self) -> int:
        """So many frequencies are looked at: the drives' as designed, and one more."""
        counts = [1]
        for at in self.designed:
            raw = self._freed(at).lowest(10)
            found = self._driven_modes(at, raw.modes)
            counts.append(max((k for k in range(len(found)) if found[k]), default=-1) + 2)
        return max(counts) + 1

    def near(self, errors: FloatArray) -> Measured:
        """What a sample is, from the states as designed.

        Args:
            errors: (off and parts,) [m, rad].

        Raises:
            StrokeError: no equilibrium was found.
        """
        by, count = self._by(errors), len(self.off)
        solver = self.solver
        if by.any():
            scales, owner = self.thicknesses.changed(by), solver.mesh.owner
            own = solver.arrays
            solver = copy(solver)
            solver.arrays = own._replace(
                stiffness=np.asfortranarray(own.stiffness * scales.stiffness[:, owner]),
                mass=np.asfortranarray(own.mass * scales.mass[:, owner]),
            )
            there = self.solver.sections
            size = np.where(self.thicknesses.is_known, scales.size, there.size)
            solver.__dict__.pop("elastic", None)
            solver.__dict__["sections"] = there.resized(size)
        shift = self._shift @ errors[:count]
        states = []
        for at in self.designed:
            way = at.way._replace(target=self._moved(at.way.target, shift))
            begin = at.way._replace(misfit=at.way.misfit + self._unbalanced(at, solver))
            start = Solution(solver, at.raw, begin, at.held)
            states.append(self._freed(equilibria.reached(start, way, 0.0, 1.0, _OFF, "")))
        return self._measured(states)

    def followed(self, errors: FloatArray) -> Measured:
        """The same on the whole path from rest.

        Raises:
            StrokeError: no equilibrium was found.
        """
        by, model = self._by(errors), self.elastic
        data = model.data
        if by.any() and data.properties is not None:
            scales, looks = self.thicknesses.changed(by), data.appearance
            known = self.thicknesses.is_known[:, None]
            data = replace(
                data,
                properties=replace(
                    data.properties,
                    stiffness=data.properties.stiffness * scales.stiffness.T,
                    mass=data.properties.mass * scales.mass.T,
                ),
                given_appearance=replace(
                    looks, dimensions=np.where(known, scales.size.T, looks.dimensions)
                ),
            )
            model = replace(model, data=data)
        pairs = zip(self.off, errors.tolist(), strict=False)
        model = replace(model, off=tuple(replace(each, value=value) for each, value in pairs))
        states = list(model.assembled().meshes)
        if self.drive is not None and self.values:
            states += [at for each in model.driven(self.drive, self.values) for at in each.meshes]
        return self._measured(states)

    def _moved(self, configuration: FloatArray, by: FloatArray) -> FloatArray:
        """(4, nodes) configuration after small displacements and turns (3, nodes)."""
        kinds = self.solver.mesh.data.arrays.node_kind
        made = configuration.copy(order="F")
        made[:3] += np.where(kinds <= NodeKind.POSITION, by, 0.0)
        turns = kinds == NodeKind.ORIENTATION
        made[:, turns] = turned(made[:, turns].T, by[:, turns].T).T
        made[0] += np.where(kinds == NodeKind.ANGLE, by[2], 0.0)
        return made

    def _by(self, errors: FloatArray) -> FloatArray:
        """(elements,) by how much each is thicker [m]."""
        made = np.zeros(self.thicknesses.is_known.size)
        for elements, value in zip(self.parts, errors[len(self.off) :].tolist(), strict=True):
            made[list(elements)] = value
        return made

    def _unbalanced(self, at: Solution, solver: Solver) -> FloatArray:
        """(6, pieces) further misfits with which another stiffness bears the stress of a state."""
        made = np.zeros((6, solver.elements), order="F")
        if solver is not self.solver and at.is_stressed:
            (old, _), (new, _) = self.solver.elastic, solver.elastic
            changed = np.flatnonzero((old != new).any(axis=(1, 2)))
            more = np.linalg.pinv(old[changed], hermitian=True)
            more -= np.linalg.pinv(new[changed], hermitian=True)
            made[:, changed] = np.einsum("eij,je->ie", more, at.raw.stress[:, changed])
        return made

    def _freed(self, at: Solution) -> Solution:
        """A state with the drive as it is asked for: held, or free at a constant force."""
        held = self.elastic.locked
        if self.drive is None or at.held == held:
            return at
        return at if self.elastic.drive == "locked" else freed(at, held, self.drive)

    def _measured(self, states: Sequence[Solution]) -> Measured:
        stress = np.max([at.peaks.von_mises[2] for at in states], axis=0)
        usage, element = np.nan, int(np.argmax(stress))
        if self.strengths is not None:
            part = self.strengths.usage(stress)
            usage, element = float(part.max()), int(self.strengths.which[np.argmax(part)])
        known = bool(states[0].solver.sections.is_known.any())
        first = parasitic = np.nan
        if self.elastic.has_mass:
            found = [self._frequencies(at) for at in states]
            first, parasitic = np.min(found, axis=0).tolist()
        force = np.nan
        if self.drive is not None and (self.values or self.elastic.locked):
            force = force_of(states[-1], self.drive)
        there, designed = states[-1].raw.configuration, self.designed[-1].raw.configuration
        kinds, moved = self.solver.mesh.data.arrays.node_kind, (there - designed)[:3]
        for node in {node for node, _ in self.coordinates}:
            if kinds[node] == NodeKind.ORIENTATION:
                moved[:, node] = vector_between(designed[None, :, node], there[None, :, node])[0]
            elif kinds[node] == NodeKind.ANGLE:
                moved[2, node] = there[0, node] - designed[0, node]
        errors = tuple(float(moved[axis, node]) for node, axis in self.coordinates)
        return Measured(
            float(stress.max()) if known else np.nan,
            *(usage, element, first, parasitic, force, errors),
        )

    def _frequencies(self, at: Solution) -> tuple[float, float]:
        """The first frequency of a state, and the first parasitic one [Hz]; NaN without one."""
        raw = at.lowest(self._count)
        hertz = np.sqrt(np.maximum(raw.values, 0.0)) / (2.0 * np.pi)
        left = hertz[~self._driven_modes(at, raw.modes)]
        return (
            float(hertz[0]) if hertz.size else np.nan,
            float(left[0]) if left.size else np.nan,
        )

    def _driven_modes(self, at: Solution, modes: FloatArray) -> BoolArray:
        """(modes,) which are a free drive's: of each that in which it moves most, the lowest."""
        made = np.zeros(modes.shape[2], np.bool_)
        sizes = np.abs(modes) * at.scale[:, None]
        largest = np.maximum(sizes.max(axis=(0, 1), initial=0.0), 1.0e-300)
        classes = self.elastic.data.arrays.coordinate_class
        for node, axis in np.argwhere(classes.T == Class.INDEPENDENT).tolist():
            share = sizes[axis, node] / largest
            if made.size and share.max() >= _DRIVEN and not at.is_held(Coordinate(node, axis)):
                made[int(np.argmax(np.round(share, 1)))] = True
        return made
