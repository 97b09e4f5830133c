# SPDX-License-Identifier: BSD-3-Clause
"""The held deformations of a model as functions of the coordinates that may change, eq. (5).

Held are those that are fixed and those that are independent; the dependent coordinates change.
Displacements and deformations that are lengths count by the model's size, so that rotations
compare with them. Positions are about the model's middle where it is far from the origin: there
too few digits are left for differences.
"""

from __future__ import annotations

import math

import numpy as np

from ..analysis.body_motions import Velocities
from ..core import calls
from ..core.arrays import FloatArray, IndexArray, packed
from ..core.elements import Class, Dual, NodeKind, Role, dual_table, role_table
from ..core.raw import RawAssembly
from ..model.configuration import Configuration
from ..model.data import ModelData
from ..util import rotations
from ..util.records import cached_property
from ..util.rotations import left_jacobian, vector_between
from .bordered import Entries, Matrix, Pattern

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


#: More coordinates than these are not followed: of some thousands it would take minutes.
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


#: Rows times columns up to which matrices are made in full, as nothing is faster then.
_MOST_IN_FULL = 20_000


class Place:
    """Where the nodes are, and what is held there."""

    def __init__(
        self,
        held: Held,
        value: FloatArray,
        raw: RawAssembly,
        turned: FloatArray | None = None,
    ) -> None:
        """Keep what was assembled.

        Args:
            held: What is held.
            value: (nodes, 4) of a `Configuration`, as `Held` has it: in its unit, about its middle.
            raw: All deformations there, and their derivatives.
            turned: (k, 3) the rotation vectors of the nodes that turn, where these led here.
        """
        self.held, self.value, self.raw, self._turned = held, value, raw, turned
        #: (m,) the held deformations, lengths by the size, angles in radians.
        self.error = raw.deformation.T.ravel()[held.rows] * held.row_factor

    @cached_property
    def configuration(self) -> Configuration:
        """Of the nodes."""
        return Configuration(self.held.arrays.node_kind, self.value)

    @property
    def here(self) -> Place:
        """With derivatives with respect to what leads on from here."""
        return self if self._turned is None else Place(self.held, self.value, self.raw)

    @cached_property
    def entries(self) -> Entries:
        """Row, column and value of the derivatives (m, n) with respect to what led here."""
        held, raw = self.held, self.raw
        row, value = held.row_place[raw.row_of], raw.value
        if self._turned is None:
            column = held.column_place[raw.column_of]
        else:
            # By rotation vectors in place of small rotations, exp(T dv) exp(v).
            turn, axis = held.turn_of[raw.column_of], raw.column_of % 3
            stays = turn < 0
            own, turn = raw.column_of[~stays], turn[~stays]
            after = (own - axis[~stays])[:, None] + np.arange(3)
            of_turned = value[~stays, None] * left_jacobian(self._turned)[turn, axis[~stays]]
            column = np.concatenate((raw.column_of[stays], after.ravel()))
            column = held.column_place[column]
            row = np.concatenate((row[stays], np.repeat(row[~stays], 3)))
            value = np.concatenate((value[stays], of_turned.ravel()))
        known = (row >= 0) & (column >= 0)
        row, column = row[known], column[known]
        return row, column, value[known] * held.row_factor[row] * held.column_factor[column]

    @property
    def jacobian(self) -> FloatArray:
        """(m, n) the derivatives in full."""
        held, raw = self.held, self.raw
        layout = held.layout(raw)
        m, n = held.shape[0], held.wide_factor.size
        value = raw.value[layout.chosen] * layout.factor
        wide = np.bincount(layout.flat, value, m * n).reshape(m, n).astype(np.float64, copy=False)
        if self._turned is not None:
            # By rotation vectors in place of small rotations, exp(T dv) exp(v).
            turned = wide[:, held.turned_columns].transpose(1, 0, 2) @ left_jacobian(self._turned)
            wide[:, held.turned_columns] = turned.transpose(1, 0, 2)
        return wide[:, : held.shape[1]]

    @cached_property
    def matrix(self) -> Matrix:
        """(m, n) the derivatives, in full where they are few."""
        if self.held.is_small:
            return self.jacobian
        return self.held.matrix(self.entries, self._turned is not None)

    @cached_property
    def scaled(self) -> Matrix:
        """(m, n) the matrix on which rank is decided, theory.md (2).

        One length, the geometric mean of all that are not zero, for all connected components.
        """
        held, raw = self.held, self.raw
        if held.is_small:
            there, row, weight, known, flat = held.layout(raw).scaled
            value = raw.value[there] * weight
            norm = np.sqrt(np.bincount(row, value * value, held.shape[0]))
            norm[norm == 0.0] = 1.0
            value = (value / norm[row])[known]
            return np.bincount(flat, value, math.prod(held.shape)).reshape(held.shape)
        row = held.row_place[raw.row_of]
        there = np.flatnonzero(row >= 0)
        row, column = row[there], raw.column_of[there]
        value = raw.value[there] * held.weight[column]
        norm = np.sqrt(np.bincount(row, value * value, held.shape[0]))
        norm[norm == 0.0] = 1.0
        self._norm = norm
        column = held.column_place[column]
        known = np.flatnonzero(column >= 0)
        row = row[known]
        value = value[known] / norm[row]
        return held.matrix((row, column[known], value))

    def unscaled(self, left: FloatArray, right: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Null vectors of `matrix`, from those of `scaled` and its transpose, (m, s) and (n, d)."""
        held, _ = self.held, self.scaled
        of_columns = held.weight[held.columns] / held.column_factor
        return left / (self._norm * held.row_factor)[:, None], of_columns[:, None] * right

    @property
    def is_finite(self) -> bool:
        """Whether all is defined here."""
        value = self.raw.value[self.held.layout(self.raw).chosen]
        return bool(np.isfinite(self.error).all() and np.isfinite(value).all())

    @property
    def residual(self) -> float:
        """The largest held deformation."""
        return float(np.abs(self.error).max(initial=0.0))


#: So many of these are kept.
_MOST_LAYOUTS = 4


class Layout:
    """Where the entries of an assembly stand in matrices in full."""

    def __init__(self, held: Held, raw: RawAssembly) -> None:
        """Of what is held, and an assembly."""
        self._held, self._row_of, self._column_of = held, raw.row_of, raw.column_of
        row, column = held.row_place[raw.row_of], held.wide_place[raw.column_of]
        #: Entries of the derivatives, what they are multiplied by, and their places.
        self.chosen = np.flatnonzero((row >= 0) & (column >= 0))
        row, column = row[self.chosen], column[self.chosen]
        self.factor = held.row_factor[row] * held.wide_factor[column]
        self.flat = row * held.wide_factor.size + column

    @cached_property
    def scaled(self) -> tuple[IndexArray, IndexArray, FloatArray, IndexArray, IndexArray]:
        """Entries of rows that are held, as the matrix has them on which rank is decided.

        Their numbers, rows, and what they are multiplied by; which of them are of coordinates
        that may change, and the places of these.
        """
        held = self._held
        row = held.row_place[self._row_of]
        there = np.flatnonzero(row >= 0)
        row, column = row[there], self._column_of[there]
        weight, column = held.weight[column], held.column_place[column]
        known = np.flatnonzero(column >= 0)
        return there, row, weight, known, row[known] * held.shape[1] + column[known]

    def fits(self, raw: RawAssembly) -> bool:
        """Whether the entries of another assembly stand at the same places."""
        return np.array_equal(raw.column_of, self._column_of) and np.array_equal(
            raw.row_of, self._row_of
        )


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
        kinds, classes = self.arrays.node_kind, self.arrays.deformation_class
        held = np.isin(classes, (Class.FIXED, Class.INDEPENDENT))
        self.rows = np.flatnonzero(held.T.ravel())
        dependent = self.arrays.coordinate_class == Class.DEPENDENT
        self.columns = np.flatnonzero(dependent.T.ravel())
        self.shape = self.rows.size, self.columns.size
        self.is_small = self.rows.size * self.columns.size <= _MOST_IN_FULL
        by_size = self.size / self.unit
        moments = dual_table()[self.arrays.element_kind].ravel()[self.rows] == Dual.MOMENT
        self._patterns: dict[bool, Pattern] = {}
        #: Of deformations and of coordinates in the unit, to those by the size.
        self.row_factor = np.where(moments, 1.0, 1.0 / by_size)
        placed = kinds[self.columns // 3] <= NodeKind.POSITION
        self.column_factor = np.where(placed, by_size, 1.0)
        #: Where each deformation and each coordinate is among these; -1 where it is not.
        self.row_place = np.full(classes.size, -1)
        self.row_place[self.rows] = np.arange(self.rows.size)
        self.column_place = np.full(dependent.size, -1)
        self.column_place[self.columns] = np.arange(self.columns.size)
        # Of an orientation all three rotations count, even if one of them is not dependent.
        self._turning = np.flatnonzero(dependent.any(axis=0) & (kinds == NodeKind.ORIENTATION))
        #: Which of the nodes that turn a coordinate is of; -1 where it is of none.
        self.turn_of = np.full(dependent.size, -1)
        for axis in range(3):
            self.turn_of[3 * self._turning + axis] = np.arange(self._turning.size)
        # Columns of a matrix in full, behind which those stand that turn and are not dependent.
        whole = (3 * self._turning[:, None] + np.arange(3)).ravel()
        others = whole[self.column_place[whole] < 0]
        self.wide_factor = np.append(self.column_factor, np.ones(others.size))
        self.wide_place = self.column_place.copy()
        self.wide_place[others] = self.columns.size + np.arange(others.size)
        self.turned_columns = self.wide_place[whole].reshape(-1, 3)
        self._layouts: list[Layout] = []
        # Columns that are added to, with their numbers among those of a configuration.
        self._straight = np.flatnonzero(self.turn_of[self.columns] < 0)
        node, part = np.divmod(self.columns[self._straight], 3)
        self._numbers = 4 * node + np.where(kinds[node] == NodeKind.ANGLE, 0, part)
        self._angles = np.flatnonzero(kinds[node] == NodeKind.ANGLE)
        turned = np.flatnonzero(self.turn_of[self.columns] >= 0)
        self._turned = turned
        self._turned_at = 3 * self.turn_of[self.columns[turned]] + self.columns[turned] % 3

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
        return self.way(one.value, other.value)

    def way(self, one: FloatArray, other: FloatArray) -> FloatArray:
        """(n,) `difference` of the numbers of two configurations, (nodes, 4)."""
        made = np.empty(self.columns.size)
        straight = other.ravel()[self._numbers] - one.ravel()[self._numbers]
        if self._angles.size:
            angle = straight[self._angles]
            straight[self._angles] = angle - 2.0 * np.pi * np.round(angle / (2.0 * np.pi))
        made[self._straight] = straight
        if self._turned.size:
            turned = vector_between(one[self._turning], other[self._turning])
            made[self._turned] = turned.ravel()[self._turned_at]
        made /= self.column_factor
        return made

    def at(self, here: Configuration | Place, change: FloatArray | None = None) -> Place:
        """The held deformations after a change (n,) of the coordinates, as a `direction`.

        The derivatives are with respect to the change.
        """
        value, turned = here.value, None
        if change is not None and change.any():
            value, turned = self._moved(value, change)
        elif isinstance(here, Place):
            return here.here
        return Place(self, value, self._raw(value), turned)

    def moved(self, here: Configuration, change: FloatArray) -> Configuration:
        """The nodes after a change (n,) of the coordinates."""
        return Configuration(here.kinds, self._moved(here.value, change)[0])

    def _moved(self, here: FloatArray, change: FloatArray) -> tuple[FloatArray, FloatArray | None]:
        """The numbers (nodes, 4) after a change, and (k, 3) by what vectors nodes have turned."""
        delta, value = change * self.column_factor, here.copy()
        value.ravel()[self._numbers] += delta[self._straight]
        if not self._turning.size:
            return value, None
        vectors = np.zeros((self._turning.size, 3))
        vectors.ravel()[self._turned_at] = delta[self._turned]
        value[self._turning] = rotations.turned(value[self._turning], vectors)
        return value, vectors

    def pressed(self, here: Configuration, stresses: FloatArray) -> FloatArray:
        """(n, s) u' D of some stresses (m, s), without the matrix in full.

        They are dual to `Place.error`, and the derivatives are those there.
        """
        row, column, value = self.at(here).entries
        made = np.zeros((self.columns.size, stresses.shape[1]))
        for k, stress in enumerate(stresses.T):
            made[:, k] = np.bincount(column, value * stress[row], self.columns.size)
        return made

    def rate(self, here: Place, row: int, change: FloatArray) -> float:
        """The rate of a deformation, held or not, by its row, element * 6 + deformation."""
        raw = here.raw
        mine = raw.row_of == row
        full = np.zeros(self.arrays.coordinate_class.size)
        full[self.columns] = change * self.column_factor
        return float(raw.value[mine] @ full[raw.column_of[mine]])

    def deformation(self, here: Place, row: int) -> float:
        """A deformation, held or not, by its row, in the unit if it is a length, else [rad]."""
        return float(here.raw.deformation.T.ravel()[row])

    def _raw(self, here: FloatArray) -> RawAssembly:
        return calls.assemble(self._packed, here.T, np.zeros(self.arrays.element_number.size))

    def layout(self, raw: RawAssembly) -> Layout:
        """Where the entries of an assembly stand, which are mostly the same."""
        for known in self._layouts:
            if known.fits(raw):
                return known
        made = Layout(self, raw)
        # Some are zero at the reference, some in a place that is passed.
        self._layouts = [made, *self._layouts[: _MOST_LAYOUTS - 1]]
        return made

    def matrix(self, entries: Entries, is_turned: bool = False) -> Matrix:
        """(m, n) of entries; of turned nodes others are not zero."""
        known = self._patterns.get(is_turned)
        if known is None or not known.fits(entries):
            known = self._patterns[is_turned] = Pattern(entries, self.shape)
        return known.matrix(entries[2])

    @cached_property
    def weight(self) -> FloatArray:
        """What entries of coordinates of nodes are multiplied by where rank is decided."""
        turns = np.repeat(self.arrays.node_kind > NodeKind.POSITION, 3)
        return np.where(turns, 1.0 / self._mean_length, 1.0)

    @cached_property
    def _lengths(self) -> FloatArray:
        return calls.find_frames(self._packed).length

    @cached_property
    def _mean_length(self) -> float:
        positive = self._lengths[self._lengths > 0.0]
        return math.exp(float(np.log(positive).mean())) if positive.size else 1.0

    @cached_property
    def _ranges(self) -> tuple[IndexArray, tuple[IndexArray, ...], IndexArray, FloatArray]:
        """Elements with a length, their ends, and bendings with what they may be."""
        nodes = self.arrays.element_node - 1
        long = np.flatnonzero((self._lengths > 0.0) & (nodes[2] >= 0))
        roles = role_table()[self.arrays.element_kind].ravel()
        bends = np.flatnonzero(np.isin(roles, _BENDINGS))
        most = np.asarray(_NO_BENDING * self._lengths[bends // 6])
        return long, (nodes[0, long], nodes[2, long]), bends, most

    def beyond(self, here: Place) -> tuple[int, str] | None:
        """An element that has left its range, from 0, and why; None where all are within.

        "length": its ends are at one point. "bending": an end of a beam is turned at right
        angles to the line between its ends.
        """
        long, (one, other), bends, most = self._ranges
        way = here.value[other, :3] - here.value[one, :3]
        gone = np.sqrt((way * way).sum(axis=1)) < _NO_LENGTH * self._lengths[long]
        if gone.any():
            return int(long[np.argmax(gone)]), "length"
        over = np.abs(here.raw.deformation.T.ravel()[bends]) > most
        return (int(bends[np.argmax(over)] // 6), "bending") if over.any() else None
