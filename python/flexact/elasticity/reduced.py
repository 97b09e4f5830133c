# SPDX-License-Identifier: BSD-3-Clause
"""What the deck's own elements and classes say in a state: reduced matrices, verdict, resultants.

Reduced matrices are those in SPACAR's sense: in the declared coordinates and deformations.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..analysis.result import Result
from ..core import calls, elastic
from ..core.arrays import FloatArray, IntArray
from ..core.elastic import ElasticState, RawMatrices
from ..core.elements import AXES, Class, Dual, NodeKind, dual_table
from ..model.data import ModelData
from ..model.writing import class_statements, prescribed_in
from ..util.records import Frozen
from ..util.units import Units
from .errors import ElasticError
from .solution import Policy, Solution, notch_in_units, packed_with
from .stresses import carried_by


def independent_of(data: ModelData) -> IntArray:
    """(q,) coordinates 3 node + axis, then deformations -1 - (6 element + deformation).

    In the order of the deck's statements; inputs are none of them.
    """
    arrays, inputs = data.arrays, prescribed_in(data)
    dynamic = (arrays.coordinate_class == Class.INDEPENDENT) & ~inputs.coordinates
    modes = (arrays.deformation_class == Class.INDEPENDENT) & ~inputs.deformations
    # As the statements name them, then all others.
    named = {"X": list[int](), "E": list[int]()}
    for which, number, _ in class_statements(data, "DYN"):
        index = data.node_index if which == "X" else data.element_index
        named[which] += [index[number]] if number in index else []
    nodes = dict.fromkeys([*named["X"], *range(dynamic.shape[1])])
    elements = dict.fromkeys([*named["E"], *range(modes.shape[1])])
    places = [
        3 * node + axis
        for node in nodes
        for axis in AXES[int(arrays.node_kind[node])]
        if dynamic[axis, node]
    ]
    places += [-1 - (6 * e + k) for e in elements for k in range(6) if modes[k, e]]
    return np.array(places, np.int32)


class Reducer:
    """The deck's own elements with its own classes, whatever is elastic."""

    def __init__(self, data: ModelData, policy: Policy) -> None:
        """Of the model as given, with what its elements are made of."""
        arrays, inputs = data.arrays, prescribed_in(data)
        self._data = data
        self._independent = tuple(independent_of(data).tolist())
        own = arrays.coordinate_class, arrays.deformation_class
        coordinates, deformations = (
            np.where(each == Class.INDEPENDENT, Class.DEPENDENT, each) for each in own
        )
        coordinates[inputs.coordinates] = deformations[inputs.deformations] = Class.FIXED
        self._model = packed_with(arrays, coordinates, deformations)
        self._arrays = policy.arrays._replace(notch=notch_in_units(data, policy.arrays.notch))

    def lengths(self, units: Units) -> FloatArray:
        """(q,) what each of them is multiplied with where lengths are in other units: angles."""
        arrays, made = self._data.arrays, []
        for place in self._independent:
            if place >= 0:
                is_angle = arrays.node_kind[place // 3] > NodeKind.POSITION
            else:
                e, k = divmod(-1 - place, 6)
                is_angle = dual_table()[arrays.element_kind[e], k] == Dual.MOMENT
            made.append(units.factor("m") if is_angle else 1.0)
        return np.array(made)

    def of(self, at: Solution) -> RawMatrices:
        """The matrices of the deck's elements where their ends are, under their stresses."""
        mesh = at.solver.mesh
        state = ElasticState(
            mesh.own_nodes(at.raw.configuration), at.stress, mesh.own_nodes(at.raw.reaction)
        )
        if not self._independent:
            none = np.zeros((0, 0))
            return RawMatrices(none, none, none, True)
        return elastic.matrices(self._model, self._arrays, state, at.way.gravity, self._independent)


#: More rows times columns than these are not decomposed in full.
_MOST = 6_000_000


def verdict_of(
    result: Result, configuration: FloatArray, c_t: FloatArray
) -> tuple[int, int, float]:
    """The verdict of a model where its nodes are.

    Args:
        result: Of the reference configuration.
        configuration: (4, nodes).
        c_t: Torsion-elongation constants (elements,).

    Returns:
        By how much it is under- and over-constrained, and the smallest singular value of D(c)
        in the deck's units, infinite where D(c) has no rows or no columns.

    Raises:
        ElasticError: the model is too large for it.
    """
    data, arrays = result.given, result.given.arrays
    held = np.isin(arrays.deformation_class.T.ravel(), (Class.FIXED, Class.INDEPENDENT))
    free = (arrays.coordinate_class == Class.DEPENDENT).T.ravel()
    m, n = int(held.sum()), int(free.sum())
    at_rest = np.array_equal(configuration, arrays.node_value)
    value = math.nan
    if m * n <= _MOST:
        raw = calls.assemble(data.packed, configuration, c_t)
        row, column = np.cumsum(held) - 1, np.cumsum(free) - 1
        there = held[raw.row_of] & free[raw.column_of]
        place = row[raw.row_of[there]] * n + column[raw.column_of[there]]
        dense = np.bincount(place, raw.value[there], m * n).reshape(m, n)
        value = float(np.linalg.svd(dense, compute_uv=False).min(initial=math.inf))
    if at_rest:
        return result.under_constrained, result.over_constrained, value
    if m * n > _MOST:
        raise ElasticError(
            f"D(c) has {m} rows and {n} columns: it is not decomposed away from the reference"
        )
    turns = np.repeat(arrays.node_kind > NodeKind.POSITION, 3)[free]
    length = data.frames.length[data.frames.length > 0.0]
    mean = math.exp(float(np.log(length).mean())) if length.size else 1.0
    scaled = np.where(turns, dense / mean, dense)
    norm = np.linalg.norm(scaled, axis=1, keepdims=True)
    values = np.linalg.svd(scaled / np.where(norm > 0.0, norm, 1.0), compute_uv=False)
    rank = int(np.count_nonzero(values > result.gap.zero_elsewhere(result.raw.noise)))
    return n - rank, m - rank, value


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
    made = carried_by(data, stress[:, None], np.array([element], np.int32))
    about_y, about_z = made.moments[:, :, 0]
    length = float(data.frames.length[element])
    shear_y, shear_z = (
        float(m[0] - m[1]) / length if length > 0.0 else 0.0 for m in (about_z, about_y)
    )
    return Resultants(
        float(made.normal[0]), float(made.torque[0]), about_y, about_z, shear_y, shear_z
    )
