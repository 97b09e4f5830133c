# SPDX-License-Identifier: BSD-3-Clause
"""Reduced matrices in SPACAR's sense: in the declared coordinates and deformations."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..core import elastic
from ..core.arrays import FloatArray, IntArray, PackedModel, packed
from ..core.elastic import ElasticArrays, ElasticState
from ..core.elements import (
    AXES,
    Class,
    Dual,
    Member,
    Role,
    coordinate_name,
    dual_table,
    member_table,
    role_table,
)
from ..model.data import CrossSection, ModelData
from ..model.writing import class_statements, prescribed_in
from ..util.records import Frozen, cached_property
from .errors import ElasticError
from .solution import Policy, Solution, notch_in_units


class Reduced(NamedTuple):
    """Mass, stiffness and geometric stiffness, each (q, q)."""

    mass: FloatArray
    stiffness: FloatArray
    geometric: FloatArray


class Reducer:
    """The deck's own elements with its own classes, whatever is elastic."""

    def __init__(self, data: ModelData, policy: Policy) -> None:
        """Keep the model as given, with what its elements are made of."""
        self.data, self._policy = data, policy

    @cached_property
    def labels(self) -> tuple[tuple[int, str | int], ...]:
        """Node and coordinate, or element and deformation (from 1), of each row."""
        arrays = self.data.arrays
        made: list[tuple[int, str | int]] = []
        for place in self.independent.tolist():
            if place >= 0:
                node, axis = divmod(place, 3)
                kind = int(arrays.node_kind[node])
                made.append((int(arrays.node_number[node]), coordinate_name(kind, axis)))
            else:
                element, k = divmod(-1 - place, 6)
                made.append((int(arrays.element_number[element]), k + 1))
        return tuple(made)

    @cached_property
    def independent(self) -> IntArray:
        """(q,) coordinates 3 node + axis, then deformations -1 - (6 element + deformation).

        In the order of the deck's statements; inputs are none of them.
        """
        arrays, inputs = self.data.arrays, prescribed_in(self.data)
        dynamic = (arrays.coordinate_class == Class.INDEPENDENT) & ~inputs.coordinates
        modes = (arrays.deformation_class == Class.INDEPENDENT) & ~inputs.deformations
        nodes, elements = self._order("X"), self._order("E")
        places = [
            3 * node + axis
            for node in [*nodes, *(n for n in range(dynamic.shape[1]) if n not in nodes)]
            for axis in AXES[int(arrays.node_kind[node])]
            if dynamic[axis, node]
        ]
        places += [
            -1 - (6 * element + k)
            for element in [*elements, *(e for e in range(modes.shape[1]) if e not in elements)]
            for k in range(6)
            if modes[k, element]
        ]
        return np.array(places, np.int32)

    def _order(self, letter: str) -> dict[int, None]:
        """Indices of nodes or elements as the deck's statements name them."""
        index = self.data.node_index if letter == "X" else self.data.element_index
        return {
            index[number]: None
            for which, number, _ in class_statements(self.data, "DYN")
            if which == letter and number in index
        }

    @cached_property
    def _model(self) -> tuple[PackedModel, ElasticArrays]:
        arrays, inputs = self.data.arrays, prescribed_in(self.data)
        given = arrays.coordinate_class
        coordinates = np.where(given == Class.INDEPENDENT, Class.DEPENDENT, given)
        coordinates[inputs.coordinates] = Class.FIXED
        own = arrays.deformation_class
        deformations = np.where(own == Class.INDEPENDENT, Class.DEPENDENT, own)
        deformations[inputs.deformations] = Class.FIXED
        model = packed(
            arrays._replace(
                coordinate_class=np.asfortranarray(coordinates, np.int32),
                deformation_class=np.asfortranarray(deformations, np.int32),
            )
        )
        given_arrays = self._policy.arrays
        return model, given_arrays._replace(notch=notch_in_units(self.data, given_arrays.notch))

    def of(self, at: Solution) -> Reduced:
        """The matrices of the deck's elements where their ends are, under their stresses."""
        mesh = at.solver.mesh
        model, arrays = self._model
        state = ElasticState(
            mesh.own_nodes(at.raw.configuration), at.stress, mesh.own_nodes(at.raw.reaction)
        )
        if not self.independent.size:
            return Reduced(*(np.zeros((0, 0)) for _ in range(3)))
        independent = tuple(self.independent.tolist())
        raw = elastic.matrices(model, arrays, state, at.way.gravity, independent)
        return Reduced(raw.mass, raw.stiffness, raw.geometric)


_BENDINGS = {
    # The axis about which it bends (1: y, 2: z), and the end.
    Role.BENDING_XZ_P: (1, 0),
    Role.BENDING_XZ_Q: (1, 1),
    Role.BENDING_XY_P: (2, 0),
    Role.BENDING_XY_Q: (2, 1),
    Role.PLANAR_BENDING_P: (2, 0),
    Role.PLANAR_BENDING_Q: (2, 1),
}


@dataclass(frozen=True, eq=False)
class Resultants(Frozen):
    """What an element carries, in its own axes.

    Attributes:
        normal_force: N [N], positive where it pulls.
        torque: T [N m]; of a hinge the moment about its axis.
        moment_y: (2,) M about y at p and q [N m], in the local xz plane.
        moment_z: (2,) M about z at p and q [N m], in the local xy plane.
        shear_y: [N] along y, the difference of the moments about z over the length.
        shear_z: [N] along z, likewise about y.
    """

    normal_force: float
    torque: float
    moment_y: FloatArray
    moment_z: FloatArray
    shear_y: float
    shear_z: float


def resultants_of(data: ModelData, element: int, stress: FloatArray) -> Resultants:
    """Of an element, by its index, with its stresses (6,)."""
    kind = int(data.arrays.element_kind[element])
    length = float(data.frames.length[element])
    moments = np.zeros((3, 2))
    normal = torque = 0.0
    for k, role in enumerate(role_table()[kind].tolist()):
        lever = length if dual_table()[kind, k] == Dual.MOMENT_OVER_LENGTH else 1.0
        value = float(stress[k]) * lever
        if role in (Role.ELONGATION, Role.OFFSET_X):
            normal = value
        elif role in (Role.TORSION, Role.ROTATION, Role.ANGLE):
            torque = value
        elif role in _BENDINGS:
            moments[_BENDINGS[Role(role)]] = value
    slope = (moments[:, 0] - moments[:, 1]) / length if length > 0.0 else np.zeros(3)
    return Resultants(normal, torque, moments[1], moments[2], float(slope[2]), float(slope[1]))


def peak_stress(data: ModelData, element: int, every: list[Resultants]) -> float:
    """The largest normal stress [Pa] in the pieces of a member with a known section.

    |N|/A + |My| h/2Iy + |Mz| b/2Iz at a corner; of a circle the moments add as vectors.

    Raises:
        ElasticError: it is no member, or its section is not known.
    """
    number = int(data.arrays.element_number[element])
    kind = int(data.arrays.element_kind[element])
    if member_table()[kind] not in (Member.BAR, Member.BEAM):
        raise ElasticError(f"element {number} is neither a bar nor a beam: it has no section")
    shape = int(data.appearance.cross_section[element])
    b, h = (float(size) for size in data.appearance.dimensions[element])
    if shape not in (CrossSection.RECT, CrossSection.CIRC) or not (b > 0.0 and h > 0.0):
        raise ElasticError(
            f"the section of element {number} is not known: give BEAMPROPS with CROSSTYPE RECT or "
            "CIRC and CROSSDIM in the deck's picture block, or a section in Python"
        )
    largest = 0.0
    for each in every:
        my, mz = np.abs(each.moment_y), np.abs(each.moment_z)
        if shape == CrossSection.CIRC:
            area, bending = math.pi * b * b / 4.0, np.hypot(my, mz) * 32.0 / (math.pi * b**3)
        else:
            area, bending = b * h, 6.0 * my / (b * h * h) + 6.0 * mz / (h * b * b)
        largest = max(largest, abs(each.normal_force) / area + float(bending.max()))
    return largest


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
