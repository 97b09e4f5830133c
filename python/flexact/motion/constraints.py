# SPDX-License-Identifier: BSD-3-Clause
"""The held deformations of a model as functions of the coordinates that may change, eq. (5).

Held are those that are fixed and those that are independent; the dependent coordinates change.
Displacements and deformations that are lengths count by the model's size, so that rotations
compare with them. Positions are about the model's middle where it is far from the origin: there
too few digits are left for differences.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..analysis.body_motions import Velocities
from ..core import calls
from ..core.arrays import FloatArray, IndexArray, packed
from ..core.elements import Class, Dual, NodeKind, Role, dual_table, role_table
from ..core.raw import RawAssembly
from ..model.configuration import Configuration
from ..model.data import ModelData
from ..util.records import Frozen, cached_property
from ..util.rotations import left_jacobian, vector_between

#: Of more positions than so many not all pairs are looked at.
_MANY = 1_500


def _extent(there: FloatArray) -> float:
    """The largest distance between two positions, (3, k); of many twice that to their mean.

    It does not change when the model is turned.
    """
    if there.shape[1] > _MANY:
        return 2.0 * float(np.linalg.norm(there - there.mean(axis=1, keepdims=True), axis=0).max())
    apart = there[:, :, None] - there[:, None, :]
    return float(np.sqrt((apart**2).sum(axis=0).max()))


#: More coordinates than these are not followed: each step solves a dense system.
MOST_COORDINATES = 1_000
#: A length below this part of its own at first is none; a sine above this is no bending.
_NO_LENGTH = 1.0e-6
_NO_BENDING = 0.999

_BENDINGS = (
    *(Role.BENDING_XZ_P, Role.BENDING_XZ_Q, Role.BENDING_XY_P, Role.BENDING_XY_Q),
    *(Role.PLANAR_BENDING_P, Role.PLANAR_BENDING_Q),
)


def is_followed(data: ModelData, most: int = MOST_COORDINATES) -> bool:
    """Whether a model is small enough for its motions to be followed."""
    return 0 < int(np.count_nonzero(data.arrays.coordinate_class == Class.DEPENDENT)) <= most


@dataclass(frozen=True, eq=False)
class Place(Frozen):
    """Where the nodes are, and what is held there.

    Attributes:
        configuration: Of the nodes, as `Held` has them: in its unit, about its middle.
        error: (m,) the held deformations, lengths by the size, angles in radians.
        jacobian: (m, n) their derivatives with respect to what led here.
    """

    configuration: Configuration
    error: FloatArray
    jacobian: FloatArray

    @property
    def is_finite(self) -> bool:
        """Whether all is defined here."""
        return bool(np.isfinite(self.error).all() and np.isfinite(self.jacobian).all())

    @property
    def residual(self) -> float:
        """The largest held deformation."""
        return float(np.abs(self.error).max(initial=0.0))


class Held:
    """The held deformations of a model."""

    def __init__(self, data: ModelData, size: float | None = None) -> None:
        """Take the classes of a sound model as they are; `size` [m] in place of its own."""
        self.data = data
        placed = data.arrays.node_kind <= NodeKind.POSITION
        value = data.arrays.node_value.copy(order="F")
        #: The largest distance between positions [m], 1 where they are one point; the power of two
        #: next to it: nothing is rounded when it is divided by; and what is taken off positions.
        self.size, self.unit, self.middle = 1.0 if size is None else size, 1.0, np.zeros(3)
        if placed.any():
            there = value[:3, placed]
            self.size = float(_extent(there) or 1.0) if size is None else size
            self.unit = 2.0 ** round(math.log2(self.size))
            middle = there.min(axis=1) / 2 + there.max(axis=1) / 2
            # Near the origin the numbers are best left as they were typed.
            self.middle = np.where(np.abs(middle) > self.size, middle, 0.0)
            value[:3, placed] = (there - self.middle[:, None]) / self.unit
        self.arrays = data.arrays._replace(node_value=value)
        self._packed = packed(self.arrays)
        classes = self.arrays.deformation_class
        held = np.isin(classes, (Class.FIXED, Class.INDEPENDENT))
        self.rows = np.flatnonzero(held.T.ravel())
        self.columns = np.flatnonzero((self.arrays.coordinate_class == Class.DEPENDENT).T.ravel())
        by_size = self.size / self.unit
        turns = dual_table()[self.arrays.element_kind].ravel()[self.rows] == Dual.MOMENT
        self._row_factor = np.where(turns, 1.0, 1.0 / by_size)
        placed = self.arrays.node_kind[self.columns // 3] <= NodeKind.POSITION
        self._column_factor = np.where(placed, by_size, 1.0)
        place = np.full(classes.size, -1)
        place[self.rows] = np.arange(self.rows.size)
        self._row_place = place
        # Of an orientation all three rotations count, even if one of them is not dependent.
        free = (self.arrays.coordinate_class == Class.DEPENDENT).any(axis=0)
        self._turning = np.flatnonzero(free & (self.arrays.node_kind == NodeKind.ORIENTATION))
        whole = (3 * self._turning[:, None] + np.arange(3)).ravel()
        wide = np.union1d(self.columns, whole)
        self._narrow = np.searchsorted(wide, self.columns)
        self._wide_size = wide.size
        place = np.full(self.arrays.coordinate_class.size, -1)
        place[wide] = np.arange(wide.size)
        self._column_place = place

    @property
    def reference(self) -> Configuration:
        """Where the model was analysed."""
        return Configuration(self.arrays.node_kind, self.arrays.node_value.T)

    def outside(self, here: Configuration) -> Configuration:
        """A configuration where the model stands, in metres."""
        value = here.value.copy()
        placed = here.kinds <= NodeKind.POSITION
        axes = 2 if self.data.planar else 3
        value[placed, :3] *= self.unit
        value[placed, :axes] += self.middle[:axes]
        return Configuration(here.kinds, value)

    def direction(self, motion: Velocities) -> FloatArray:
        """(n,) a motion: displacements by the size, rotations in radians."""
        both = (motion.displacement / self.size + motion.rotation).ravel()
        return np.asarray(both[self.columns])

    def reach(self, change: FloatArray) -> float:
        """How far a change moves the node that it moves farthest, by the size or in radians."""
        return float(np.linalg.norm(self.at_nodes(change), axis=1).max())

    def at_nodes(self, change: FloatArray) -> FloatArray:
        """(nodes, 3) a change of the coordinates: by the size, or in radians."""
        made = np.zeros(self.arrays.coordinate_class.size)
        made[self.columns] = change
        return made.reshape(-1, 3)

    def difference(self, one: Configuration, other: Configuration) -> FloatArray:
        """(n,) the change that leads from a configuration to another one."""
        delta = np.zeros((one.kinds.size, 3))
        placed = one.kinds <= NodeKind.POSITION
        delta[placed] = (other.value - one.value)[placed, :3]
        plane = one.kinds == NodeKind.ANGLE
        angle = (other.value - one.value)[plane, 0]
        delta[plane, 2] = angle - 2.0 * np.pi * np.round(angle / (2.0 * np.pi))
        turned = self._turning
        delta[turned] = vector_between(one.value[turned], other.value[turned])
        return np.asarray(delta.ravel()[self.columns] / self._column_factor)

    def at(self, here: Configuration, change: FloatArray | None = None) -> Place:
        """The held deformations after a change (n,) of the coordinates, as a `direction`.

        The derivatives are with respect to the change.
        """
        delta, there = np.zeros((self.arrays.node_kind.size, 3)), here
        if change is not None and change.any():
            delta.ravel()[self.columns] = change * self._column_factor
            there = here.moved(delta)
        raw, row, column, value = self._entries(there)
        m, n = self.rows.size, self._wide_size
        wide = np.bincount(row * n + column, value, m * n).astype(np.float64).reshape(m, n)
        if self._turning.size and delta.any():
            # By rotation vectors in place of small rotations, exp(T dv) exp(v).
            columns = self._column_place[3 * self._turning][:, None] + np.arange(3)
            turns = left_jacobian(delta[self._turning])
            wide[:, columns] = np.einsum("mkx,kxy->mky", wide[:, columns], turns)
        error = raw.deformation.T.ravel()[self.rows] * self._row_factor
        jacobian = self._row_factor[:, None] * wide[:, self._narrow] * self._column_factor
        return Place(there, error, jacobian)

    def moved(self, here: Configuration, change: FloatArray) -> Configuration:
        """The nodes after a change (n,) of the coordinates."""
        return here.moved(self.at_nodes(change * self._column_factor))

    def pressed(self, here: Configuration, stresses: FloatArray) -> FloatArray:
        """(n, s) u' D of some stresses (m, s), without the matrix in full.

        They are dual to `Place.error`, and the derivatives are those there.
        """
        _, row, column, value = self._entries(here)
        value = value * self._row_factor[row]
        made = np.zeros((self._wide_size, stresses.shape[1]))
        for k, stress in enumerate(stresses.T):
            made[:, k] = np.bincount(column, value * stress[row], self._wide_size)
        return made[self._narrow] * self._column_factor[:, None]

    def _entries(
        self, here: Configuration
    ) -> tuple[RawAssembly, IndexArray, IndexArray, FloatArray]:
        """The assembly, and rows, columns and values of its entries that are held and may move."""
        raw = self._raw(here)
        row, column = self._row_place[raw.row_of], self._column_place[raw.column_of]
        known = (row >= 0) & (column >= 0)
        return raw, row[known], column[known], raw.value[known]

    def rate(self, here: Configuration, row: int, change: FloatArray) -> float:
        """The rate of a deformation, held or not, by its row, element * 6 + deformation."""
        raw = self._raw(here)
        mine = raw.row_of == row
        full = np.zeros(self.arrays.coordinate_class.size)
        full[self.columns] = change * self._column_factor
        return float(raw.value[mine] @ full[raw.column_of[mine]])

    def deformation(self, here: Configuration, row: int) -> float:
        """A deformation, held or not, by its row, in the unit if it is a length, else [rad]."""
        return float(self._raw(here).deformation.T.ravel()[row])

    def _raw(self, here: Configuration) -> RawAssembly:
        return calls.assemble(self._packed, here.value.T, np.zeros(self.arrays.element_number.size))

    def scaled(self, here: Configuration) -> FloatArray:
        """(m, n) the matrix on which rank is decided, theory.md (2).

        One length, the geometric mean of all that are not zero, for all connected components.
        """
        raw, many = self._raw(here), self.arrays.coordinate_class.size
        row = self._row_place[raw.row_of]
        there = row >= 0
        flat = np.bincount(
            row[there] * many + raw.column_of[there], raw.value[there], self.rows.size * many
        )
        full = flat.astype(np.float64).reshape(self.rows.size, many)
        full[:, np.repeat(self.arrays.node_kind > NodeKind.POSITION, 3)] /= self._mean_length
        norm = np.linalg.norm(full, axis=1, keepdims=True)
        return np.asarray(full[:, self.columns] / np.where(norm > 0.0, norm, 1.0))

    def values(self, here: Configuration) -> FloatArray:
        """All singular values of the scaled matrix, descending."""
        return np.asarray(np.linalg.svd(self.scaled(here), compute_uv=False), np.float64)

    @cached_property
    def _lengths(self) -> FloatArray:
        return calls.find_frames(self._packed).length

    @cached_property
    def _mean_length(self) -> float:
        positive = self._lengths[self._lengths > 0.0]
        return math.exp(float(np.log(positive).mean())) if positive.size else 1.0

    def beyond(self, here: Configuration) -> tuple[int, str] | None:
        """An element that has left its range, from 0, and why; None where all are within.

        "length": its ends are at one point. "bending": an end of a beam is turned at right
        angles to the line between its ends.
        """
        value, nodes = here.value[:, :3], self.arrays.element_node - 1
        apart = np.linalg.norm(value[nodes[2]] - value[nodes[0]], axis=1)
        gone = (self._lengths > 0.0) & (apart < _NO_LENGTH * self._lengths) & (nodes[2] >= 0)
        if gone.any():
            return int(np.argmax(gone)), "length"
        roles = role_table()[self.arrays.element_kind]
        bends = np.isin(roles, _BENDINGS).T
        bent = np.abs(self._raw(here).deformation) > _NO_BENDING * self._lengths
        over = (bends & bent).any(axis=0)
        return (int(np.argmax(over)), "bending") if over.any() else None
