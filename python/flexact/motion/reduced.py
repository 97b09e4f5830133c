# SPDX-License-Identifier: BSD-3-Clause
"""A component at the reference: what is held in it, its motions and the self-stresses they feel.

All is free of units, as `flexact.motion.constraints` has it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ..analysis.decomposition import column_weights, row_weights
from ..analysis.limits import ROUNDING
from ..analysis.result import Result
from ..analysis.ways import spanning
from ..core.arrays import Basis, FloatArray, IndexArray
from ..core.elements import Class, Dual, NodeKind, dual_table
from ..model.data import ModelData
from ..util.groups import least_of_groups
from ..util.matrices import complement, null_space, span
from ..util.records import Frozen, cached_property
from .bordered import Bordered
from .constraints import Held
from .stations import solved

#: Entries of a vector of unit norm that are rounding.
_UNSEEN = 1.0e-10


@dataclass(frozen=True, eq=False)
class Component(Frozen):
    """Coordinates that hang together and feel a self-stress.

    Attributes:
        columns: Of D(c), ascending.
        elements: Indices of the elements that hold them, in the model as analysed.
        motions: Vectors of the space of motions that belong to it.
        stresses: How many independent self-stresses are in it.
    """

    columns: IndexArray
    elements: IndexArray
    motions: tuple[int, ...]
    stresses: int


def components_of(spaces: Result) -> tuple[tuple[Component, ...], int]:
    """The components in which both motions and self-stresses are, and all other motions' number.

    All motions have to be known. A vector that reaches over several components makes one of them.
    """
    columns, basis = spaces.columns, spaces.motion_space
    pairs = []
    # Nodes and elements that hold something, side by side.
    arrays = spaces.data.arrays
    held = np.isin(arrays.deformation_class, (Class.FIXED, Class.INDEPENDENT)).any(axis=0)
    slot, elements = np.nonzero((arrays.element_node > 0) & held)
    nodes = arrays.element_node[slot, elements] - 1
    node, axis = spaces.raw.column_label - 1
    column_at = np.full((spaces.data.arrays.node_kind.size, 3), -1)
    column_at[node, axis] = np.arange(columns)
    for k in range(3):
        there = column_at[nodes, k]
        pairs.append((there[there >= 0], elements[there >= 0] + columns))
    # Places that a vector of unit norm reaches by more than rounding, each beside one of them.
    seen = np.abs(basis.value) > _UNSEEN
    where, vector = basis.place[seen], basis.of_entries()[seen]
    one_of = np.zeros(basis.vectors, np.int64)
    one_of[vector] = where
    pairs.append((where, one_of[vector]))
    one, other = (np.concatenate(side) for side in zip(*pairs, strict=True))
    group = least_of_groups(columns + spaces.data.arrays.element_number.size, one, other)
    # The group that each vector belongs to.
    moving = np.zeros(basis.vectors, np.int64)
    moving[vector] = group[where]
    # Rows less rank, by component.
    stresses = np.bincount(group[spaces.raw.row_label[0] - 1 + columns], minlength=group.size)
    stresses = stresses - np.bincount(group[:columns], minlength=group.size)
    stresses = stresses + np.bincount(moving, minlength=group.size)
    felt = np.unique(moving[stresses[moving] > 0])
    free = int(np.count_nonzero(stresses[moving] <= 0))
    # Columns and elements of each, without going through all of them for each.
    order = np.argsort(group, kind="stable")
    first, last = (np.searchsorted(group[order], felt, side) for side in ("left", "right"))
    made = []
    for mine, begin, end in zip(felt.tolist(), first.tolist(), last.tolist(), strict=True):
        members = np.sort(order[begin:end])
        made.append(
            Component(
                members[members < columns],
                members[members >= columns] - columns,
                tuple(np.flatnonzero(moving == mine).tolist()),
                int(stresses[mine]),
            )
        )
    return tuple(made), free


#: The axes in which a node of each kind can move or turn.
_AXES = {
    NodeKind.PLANAR_POSITION: (0, 1),
    NodeKind.POSITION: (0, 1, 2),
    NodeKind.ANGLE: (2,),
    NodeKind.ORIENTATION: (0, 1, 2),
}


def rigid_motions(held: Held) -> FloatArray:
    """(n, k) orthonormal basis of the motions that move all nodes as one body would.

    They are those that do not move what is fixed or independent.
    """
    kinds, value = held.arrays.node_kind, held.arrays.node_value[:3].T
    every = np.array([3 * i + axis for i, k in enumerate(kinds.tolist()) for axis in _AXES[k]])
    # Translations along and rotations about the axes, by the size and in radians.
    placed = kinds <= NodeKind.POSITION
    middle = value[placed].mean(axis=0) if placed.any() else np.zeros(3)
    arms = (value - middle) * (held.unit / held.size)
    each = np.zeros((kinds.size, 3, 6))
    each[placed, :, :3] = np.eye(3)
    for axis in range(3):
        each[placed, :, 3 + axis] = np.cross(np.eye(3)[axis], arms[placed])
        each[~placed, axis, 3 + axis] = 1.0
    if held.data.planar:
        each[:, :, [2, 3, 4]] = 0.0
    fields = each.reshape(-1, 6)
    free = np.isin(every, held.columns)
    stopped = fields[every[~free]]
    ways = null_space(np.asarray(np.linalg.qr(stopped, mode="r")), ROUNDING)
    return span(fields[held.columns] @ ways, ROUNDING)


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

    def __init__(self, spaces: Result, component: Component) -> None:
        """Make the model of a component and take the null vectors over."""
        data, node_place, element_place = _alone(spaces.data, component.elements)
        whole = Held(data)
        node, axis = spaces.raw.column_label[:, component.columns] - 1
        self._places = np.searchsorted(whole.columns, 3 * node_place[node] + axis)
        placed = spaces.data.arrays.node_kind[node] <= NodeKind.POSITION
        self._factor = np.where(placed, 1.0 / whole.size, 1.0)
        self._rigid = rigid_motions(whole)
        # Coordinates in which the rigid motions are as independent as can be.
        self._stopped = np.array(spanning(self._rigid, int), np.int64)
        self.rigid = self._stopped.size
        self.held = held = whole
        if self.rigid:
            classes = data.arrays.coordinate_class.copy(order="F")
            stopped, axes = np.divmod(whole.columns[self._stopped], 3)
            classes[axes, stopped] = Class.FIXED
            arrays = data.arrays._replace(coordinate_class=classes)
            self.held = held = Held(replace(data, arrays=arrays))
        told = column_weights(spaces)[component.columns]
        motions = _dense(spaces.motion_space, component.motions)[component.columns]
        left, _, _ = np.linalg.svd(self.of(motions / told[:, None]), full_matrices=False)
        self.motions = np.asarray(left[:, : len(component.motions) - self.rigid])
        self.is_small = held.rows.size * held.columns.size <= _MOST_NUMBERS
        self._spaces, self._element_place = spaces, element_place
        self._many_stresses = component.stresses

    @cached_property
    def stresses(self) -> FloatArray | None:
        """(m, s) orthonormal, dual to the deformations; None where not all are known."""
        spaces, held, many = self._spaces, self.held, self._many_stresses
        if self.is_small:
            left = np.linalg.svd(held.at(held.reference).jacobian)[0]
            return np.asarray(left[:, left.shape[1] - many :])
        # What the self-stresses of the analysis have in the component.
        if spaces.raw.stresses.vectors < spaces.over_constrained:
            return None
        element, deformation = spaces.raw.row_label - 1
        rows = np.flatnonzero(self._element_place[element] >= 0)
        space, mine = spaces.stress_space, np.zeros(spaces.rows, bool)
        mine[rows] = True
        vectors = np.unique(space.of_entries()[mine[space.place]])
        if vectors.size * held.rows.size > _MOST_ENTRIES:
            return None
        own = 6 * self._element_place[element[rows]] + deformation[rows]
        made = np.zeros((held.rows.size, vectors.size))
        of_rows = _dense(space, tuple(vectors.tolist()))[rows]
        places = np.searchsorted(held.rows, own)
        made[places] = of_rows / row_weights(spaces)[rows][:, None]
        kinds = spaces.data.arrays.element_kind[element[rows]]
        turns = dual_table()[kinds, deformation[rows]] == Dual.MOMENT
        made[places] *= np.where(turns, 1.0, held.size)[:, None]
        return np.asarray(np.linalg.svd(made, full_matrices=False)[0][:, :many])

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


def _alone(data: ModelData, elements: IndexArray) -> tuple[ModelData, IndexArray, IndexArray]:
    """A model of some elements alone; where each node and element is in it, -1 where it is not."""
    arrays = data.arrays
    slots = arrays.element_node[:, elements]
    nodes = np.unique(slots[slots > 0]) - 1
    node_place = np.full(arrays.node_number.size, -1)
    node_place[nodes] = np.arange(nodes.size)
    element_place = np.full(arrays.element_number.size, -1)
    element_place[elements] = np.arange(elements.size)
    whole = replace(
        data,
        arrays=arrays.of(nodes, elements),
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


_MOST_STEPS = 14
#: A correction below this is rounding, where it no longer gets smaller.
_ROUNDING, _SHRINKS = 1.0e-10, 0.7
#: What is left of g where it is zero, and where that may be rounding, so that steps have to gain.
_EXTENTS_REDUCED_ZERO, _ROUNDED, _GAIN_IN_ROUNDING = 1.0e-18, 1.0e-15, 0.5
#: The steps to the least of g: how many, their damping times its square, and what ends them.
_MOST_DESCENTS, _DAMPING, _MOST_DAMPING, _GAIN = 60, 1.0, 1.0e12, 1.0e-9

#: So many positions are looked at in a component of few coordinates; of more, where each costs
#: more, fewer.
_MOST_POSITIONS, _FEWEST_POSITIONS, _FEW_COORDINATES = 5_000, 500, 50


class Here(NamedTuple):
    """A position at which nothing but g is left."""

    shares: FloatArray
    """(N,) of the motions."""
    change: FloatArray
    """(n,) of the coordinates, from the reference."""
    left: FloatArray
    """(s,) g."""
    slope: FloatArray
    """(s, N) its derivatives."""
    strain: float
    """The largest held deformation."""


class Reduced:
    """g near the reference of a component."""

    def __init__(self, felt: Felt, stresses: FloatArray) -> None:
        """Take what the component is at the reference."""
        self.felt, self.stresses = felt, stresses
        self._start = felt.held.at(felt.held.reference)
        share = (_FEW_COORDINATES / max(felt.motions.shape[0], _FEW_COORDINATES)) ** 2
        self._left = _FEWEST_POSITIONS + int(_MOST_POSITIONS * share)

    @property
    def is_spent(self) -> bool:
        """Whether as many positions were looked at as may be; no more are found then."""
        return self._left <= 0

    def at(self, shares: FloatArray, guess: FloatArray | None = None) -> Here | None:
        """The position after some shares of the motions (N,); None where Newton finds none.

        Args:
            shares: Of the motions.
            guess: (n,) a change near which it is.
        """
        motions, self._left = self.felt.motions, self._left - 1
        if self._left < 0:
            return None
        beside = np.zeros(motions.shape[0]) if guess is None else guess
        beside = beside - motions @ (motions.T @ beside)
        ahead, nulls = motions @ shares, (self.stresses, motions)
        near = solved(self._start, ahead, nulls, beside, (_MOST_STEPS, _ROUNDING, _SHRINKS))
        if near is None:
            return None
        # What the stresses feel of the motions, with what is across these as it is.
        matrix = near.place.matrix
        still = np.zeros((motions.shape[1], motions.shape[1]))
        slope = Bordered(matrix, *nulls).solved(matrix @ motions, still)[1]
        left = self.stresses.T @ near.place.error
        return Here(shares, ahead + near.across, left, slope, near.place.residual)

    def least(self, start: FloatArray, basis: FloatArray, reach: float) -> Here | None:
        """The position with the least of g near some shares (N,), changed within a basis (N, k).

        Args:
            start: The shares to begin with.
            basis: Orthonormal.
            reach: What would lead farther than this in one direction is not corrected there.

        Levenberg-Marquardt steps, whose damping is the square of what is left: they converge
        fast to a zero also where it is one of many (Yamashita and Fukushima, Computing
        Supplement 15, 2001).
        """
        here, damping = self.at(start), _DAMPING
        if here is None or not basis.shape[1]:
            return here
        for _ in range(_MOST_DESCENTS):
            best = float(here.left @ here.left)
            if best <= _EXTENTS_REDUCED_ZERO**2 or damping > _MOST_DAMPING:
                break
            u, s, vt = np.linalg.svd(here.slope @ basis, full_matrices=False)
            along, there = u.T @ here.left, None
            most = _MOST_DAMPING if best > _ROUNDED**2 else 64.0 * damping
            while damping <= most:
                factor = s / (s**2 + damping * best + np.finfo(float).tiny)
                factor[np.abs(factor * along) > reach] = 0.0
                change = -basis @ (vt.T @ (factor * along))
                there = self.at(here.shares + change, here.change)
                if there is not None and float(there.left @ there.left) < best:
                    break
                there, damping = None, 8.0 * damping
            if there is None:
                break
            gain = 1.0 - float(there.left @ there.left) / best
            here, damping = there, max(damping / 8.0, 1.0e-12)
            if gain < (_GAIN if best > _ROUNDED**2 else _GAIN_IN_ROUNDING):
                break
        return here


def across(vectors: FloatArray) -> FloatArray:
    """(N, N - k) orthonormal, across independent vectors (N, k)."""
    return complement(np.linalg.qr(vectors)[0])
