# SPDX-License-Identifier: BSD-3-Clause
"""A component at the reference: what is held in it, its motions and the self-stresses they feel.

All is free of units, as `flexact.motion.constraints` has it.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ..analysis.result_spaces import Spaces
from ..analysis.weights import column_weights, row_weights
from ..core.arrays import FloatArray, ModelArrays
from ..core.basis import Basis
from ..core.elements import Class, Dual, NodeKind, dual_table
from ..model.data import ModelData
from ..util.cached import cached_property
from .components import Component
from .constraints import Held
from .rigid import leading_rows, rigid_motions

#: Entries of D(c) of a component that is small; of self-stresses that are looked at.
_MOST_NUMBERS, _MOST_ENTRIES = 650_000, 4_000_000


class Felt:
    """A component at the reference.

    Attributes:
        held: What is held in it, of a model of its elements alone. So many coordinates are
            stopped that it cannot move as one rigid body: that would carry a path to paths.
        rigid: How many motions as one rigid body it has besides.
        motions: (n, N) orthonormal.
        is_small: Whether a position in it costs little.
    """

    def __init__(self, spaces: Spaces, component: Component) -> None:
        """Make the model of a component and take the null vectors over."""
        data, node_place, element_place = _alone(spaces.data, component.elements)
        whole = Held(data)
        node, axis = spaces.raw.column_label[:, component.columns] - 1
        self._places = np.searchsorted(whole.columns, 3 * node_place[node] + axis)
        placed = spaces.data.arrays.node_kind[node] <= NodeKind.POSITION
        self._factor = np.where(placed, 1.0 / whole.size, 1.0)
        self._rigid = rigid_motions(whole)
        self._stopped = leading_rows(self._rigid)
        self.rigid = self._stopped.size
        self.held = held = _stopped(whole, self._stopped)
        told = column_weights(spaces)[component.columns]
        motions = _dense(spaces.motion_space, component.motions)[component.columns]
        left, _, _ = np.linalg.svd(self.of(motions / told[:, None]), full_matrices=False)
        self.motions = np.asarray(left[:, : len(component.motions) - self.rigid])
        self.is_small = held.rows.size * held.columns.size <= _MOST_NUMBERS
        self._of_stresses = partial(_of_space, spaces, component.stresses, element_place, held)
        self._many_stresses = component.stresses

    @cached_property
    def stresses(self) -> FloatArray | None:
        """(m, s) orthonormal, dual to the deformations; None where not all are known."""
        if not self.is_small:
            return self._of_stresses()
        left = np.linalg.svd(self.held.at(self.held.reference).jacobian)[0]
        return np.asarray(left[:, left.shape[1] - self._many_stresses :])

    @property
    def many(self) -> int:
        """Number of motions."""
        return int(self.motions.shape[1])

    def of(self, vectors: FloatArray) -> FloatArray:
        """(n, ...) velocities [m, rad] at the columns of the component, as `Held` has them.

        What makes the stopped coordinates still is added of the rigid motions.
        """
        made = np.empty_like(vectors)
        made[self._places] = (vectors.T * self._factor).T
        if self.rigid:
            shares = np.linalg.solve(self._rigid[self._stopped], made[self._stopped])
            made = made - self._rigid @ shares
        return np.asarray(np.delete(made, self._stopped, axis=0))

    def norm(self, vector: FloatArray) -> float:
        """Of velocities at the columns of the component, displacements by the size."""
        return float(np.linalg.norm(vector * self._factor))

    def within(self, change: FloatArray) -> FloatArray:
        """(N,) what a change of the coordinates (n,) has of each motion."""
        return np.asarray(self.motions.T @ change)


def _of_space(
    spaces: Spaces, many: int, element_place: NDArray[np.integer], held: Held
) -> FloatArray | None:
    """(m, s) orthonormal, what the self-stresses of the analysis have in a component."""
    if spaces.raw.stresses.vectors < spaces.over_constrained:
        return None
    element, deformation = spaces.raw.row_label - 1
    rows = np.flatnonzero(element_place[element] >= 0)
    space, mine = spaces.stress_space, np.zeros(spaces.rows, bool)
    mine[rows] = True
    vectors = np.unique(space.of_entries()[mine[space.place]])
    if vectors.size * held.rows.size > _MOST_ENTRIES:
        return None
    places = np.searchsorted(held.rows, 6 * element_place[element[rows]] + deformation[rows])
    made = np.zeros((held.rows.size, vectors.size))
    of_rows = _dense(space, tuple(vectors.tolist()))[rows]
    made[places] = of_rows / row_weights(spaces)[rows][:, None]
    kinds = spaces.data.arrays.element_kind[element[rows]]
    turns = dual_table()[kinds, deformation[rows]] == Dual.MOMENT
    made[places] *= np.where(turns, 1.0, held.size)[:, None]
    return np.asarray(np.linalg.svd(made, full_matrices=False)[0][:, :many])


def _stopped(whole: Held, columns: NDArray[np.integer]) -> Held:
    """What is held where some columns stay."""
    if not columns.size:
        return whole
    arrays = whole.data.arrays
    classes = arrays.coordinate_class.copy(order="F")
    node, axis = np.divmod(whole.columns[columns], 3)
    classes[axis, node] = Class.FIXED
    return Held(replace(whole.data, arrays=arrays._replace(coordinate_class=classes)))


def _alone(
    data: ModelData, elements: NDArray[np.integer]
) -> tuple[ModelData, NDArray[np.integer], NDArray[np.integer]]:
    """A model of some elements alone; where each node and element is in it, -1 where it is not."""
    arrays = data.arrays
    slots = arrays.element_node[:, elements]
    nodes = np.unique(slots[slots > 0]) - 1
    node_place = np.full(arrays.node_number.size, -1)
    node_place[nodes] = np.arange(nodes.size)
    element_place = np.full(arrays.element_number.size, -1)
    element_place[elements] = np.arange(elements.size)
    renumbered = np.where(slots > 0, node_place[slots - 1] + 1, 0)
    made = ModelArrays(
        node_number=arrays.node_number[nodes],
        node_kind=arrays.node_kind[nodes],
        node_value=arrays.node_value[:, nodes],
        coordinate_class=arrays.coordinate_class[:, nodes],
        element_number=arrays.element_number[elements],
        element_kind=arrays.element_kind[elements],
        element_node=renumbered.astype(np.int32),
        element_vector=arrays.element_vector[:, elements],
        deformation_class=arrays.deformation_class[:, elements],
    )
    whole = replace(
        data,
        arrays=ModelArrays._make(np.asfortranarray(each) for each in made),
        element_names=("",) * elements.size,
        node_names=(),
        given_appearance=None,
        properties=None,
        loads=None,
        found=None,
        besides=(),
    )
    return whole, node_place, element_place


def _dense(basis: Basis, vectors: tuple[int, ...]) -> FloatArray:
    made = np.zeros((basis.size, len(vectors)))
    for k, vector in enumerate(vectors):
        place, value = basis.entries(vector)
        made[place, k] = value
    return made
