# SPDX-License-Identifier: BSD-3-Clause
"""Held deformations of a component as functions of its coordinates, free of units.

Displacements and elongations are parts of the component's size, rotations radians.
"""

from __future__ import annotations

import numpy as np

from ...core import calls
from ...core.arrays import FloatArray, ModelArrays, packed
from ...core.basis import Basis
from ...core.elements import Dual, NodeKind, dual_table
from ...core.raw import RawAssembly
from ...model.configuration import Configuration
from ..spaces import Spaces
from ..weights import column_weights, row_weights
from .components import Component

Place = Configuration


class Held:
    """The held deformations of a component, and the null vectors at the reference.

    Attributes:
        motions: (n, N) orthonormal.
        stresses: (m, s) orthonormal.
        reference: Where all held deformations are zero.
        size: By which lengths are divided [m].
    """

    def __init__(self, spaces: Spaces, component: Component) -> None:
        """Take the columns of a component, and all rows that reach them."""
        self.size = component.size
        arrays = _about_the_middle(spaces.data.arrays)
        self._packed = packed(arrays)
        self._elements, self._nodes = arrays.element_number.size, arrays.node_number.size
        node, axis = spaces.raw.column_label[:, component.columns] - 1
        self._columns = 3 * node + axis
        placed = arrays.node_kind[node] <= NodeKind.POSITION
        self._column_weight = np.where(placed, 1.0 / self.size, 1.0)
        element, deformation = spaces.raw.row_label - 1
        whole, mine = spaces.assembly, np.zeros(3 * self._nodes, bool)
        mine[self._columns] = True
        reached = np.zeros(6 * self._elements, bool)
        reached[whole.row_of[mine[whole.column_of]]] = True
        places = 6 * element + deformation
        reached[places[np.unique(_places_of(spaces.stress_space, component.stresses))]] = True
        rows = np.flatnonzero(reached[places])
        self._rows = places[rows]
        turning = dual_table()[arrays.element_kind[element[rows]], deformation[rows]] == Dual.MOMENT
        self._row_weight = np.where(turning, 1.0, 1.0 / self.size)
        self.reference = Configuration(arrays.node_kind, arrays.node_value.T)
        told = column_weights(spaces, component.columns)
        self.motions = _orthonormal(
            _dense(spaces.motion_space, component.motions)[component.columns]
            / told[:, None] * self._column_weight[:, None]
        )
        of_rows = _dense(spaces.stress_space, component.stresses)[rows]
        self.stresses = _orthonormal(
            of_rows / row_weights(spaces, rows)[:, None] / self._row_weight[:, None]
        )
        self._slot = np.full(6 * self._elements, -1)
        self._slot[self._rows] = np.arange(rows.size)
        self._column_slot = np.full(3 * self._nodes, -1)
        self._column_slot[self._columns] = np.arange(self._columns.size)

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self._rows.size, self._columns.size

    def of_told(self, vector: FloatArray) -> FloatArray:
        """(n,) a motion [m, rad] at the columns of this component, as a part of the size."""
        return vector * self._column_weight

    def moved(self, start: Place, change: FloatArray) -> Place:
        """After a change of the coordinates, (n,)."""
        delta = np.zeros(3 * self._nodes)
        delta[self._columns] = change / self._column_weight
        return start.moved(delta.reshape(-1, 3))

    def at(self, here: Place) -> tuple[FloatArray, FloatArray]:
        """Held deformations (m,), and their derivatives (m, n)."""
        raw = self._assembled(here)
        row, column = self._slot[raw.row_of], self._column_slot[raw.column_of]
        mine = (row >= 0) & (column >= 0)
        full = np.zeros(self.shape)
        np.add.at(full, (row[mine], column[mine]), raw.value[mine])
        error = raw.deformation.T.ravel()[self._rows] * self._row_weight
        return error, full * self._row_weight[:, None] / self._column_weight

    def pressed(self, here: Place) -> FloatArray:
        """(s, N) what the self-stresses do on the motions: u' D(x) v, without a full D(x)."""
        raw = self._assembled(here)
        row, column = self._slot[raw.row_of], self._column_slot[raw.column_of]
        mine = (row >= 0) & (column >= 0)
        row, column = row[mine], column[mine]
        value = raw.value[mine] * self._row_weight[row] / self._column_weight[column]
        made = np.empty((self.stresses.shape[1], self._columns.size))
        for i, stress in enumerate(self.stresses.T):
            made[i] = np.bincount(column, stress[row] * value, self._columns.size)
        return made @ self.motions

    def from_reference(self, here: Place) -> FloatArray:
        """(n,) displacements and rotation vectors since the reference."""
        then, now = self.reference.value, here.value
        delta = np.zeros((self._nodes, 3))
        kinds = here.kinds
        placed = kinds <= NodeKind.POSITION
        delta[placed] = (now - then)[placed, :3]
        angle = kinds == NodeKind.ANGLE
        delta[angle, 2] = (now - then)[angle, 0]
        turned = kinds == NodeKind.ORIENTATION
        delta[turned] = _rotation_between(then[turned], now[turned])
        return delta.ravel()[self._columns] * self._column_weight

    def largest(self, change: FloatArray) -> float:
        """The largest displacement or rotation of a node in a change of the coordinates."""
        square = np.bincount(self._columns // 3, change**2)
        return float(np.sqrt(square.max(initial=0.0)))

    def _assembled(self, here: Place) -> RawAssembly:
        return calls.assemble(self._packed, here.value.T, np.zeros(self._elements))


def _rotation_between(then: FloatArray, now: FloatArray) -> FloatArray:
    """(k, 3) rotation vectors from Euler parameters to others, (k, 4) each."""
    a = then / np.linalg.norm(then, axis=1)[:, None]
    b = now / np.linalg.norm(now, axis=1)[:, None]
    scalar = np.sum(a * b, axis=1)
    vector = a[:, :1] * b[:, 1:] - b[:, :1] * a[:, 1:] + np.cross(a[:, 1:], b[:, 1:])
    sign = np.where(scalar < 0.0, -1.0, 1.0)
    scalar, vector = scalar * sign, vector * sign[:, None]
    length = np.linalg.norm(vector, axis=1)
    angle = 2.0 * np.arctan2(length, scalar)
    factor = np.where(length > 0.0, angle / np.where(length > 0.0, length, 1.0), 2.0)
    return np.asarray(vector * factor[:, None])


def _about_the_middle(arrays: ModelArrays) -> ModelArrays:
    """The arrays with positions about their middle: far away digits of differences are lost."""
    placed = arrays.node_kind <= NodeKind.POSITION
    there = arrays.node_value[:3, placed]
    if not there.size:
        return arrays
    value = arrays.node_value.copy(order="F")
    value[:3, placed] -= (there.min(axis=1) / 2 + there.max(axis=1) / 2)[:, None]
    return arrays._replace(node_value=value)


def _places_of(basis: Basis, vectors: tuple[int, ...]) -> FloatArray:
    return basis.place[np.isin(basis.of_entries(), vectors)]


def _dense(basis: Basis, vectors: tuple[int, ...]) -> FloatArray:
    made = np.zeros((basis.size, len(vectors)))
    for k, vector in enumerate(vectors):
        place, value = basis.entries(vector)
        made[place, k] = value
    return made


def _orthonormal(vectors: FloatArray) -> FloatArray:
    return np.asarray(np.linalg.qr(vectors)[0])
