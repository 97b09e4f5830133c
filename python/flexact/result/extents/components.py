# SPDX-License-Identifier: BSD-3-Clause
"""What hangs together through held deformations, with its motions and self-stresses.

Coordinates of two components have no held deformation in common, at any position: a motion of
one feels the self-stresses of that one alone.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...base.frozen import Frozen
from ...core.basis import Basis
from ...core.elements import Class
from ..spaces import Spaces

#: Entries of a vector of unit norm that are rounding.
_UNSEEN = 1.0e-10


@dataclass(frozen=True, eq=False)
class Component(Frozen):
    """Coordinates that hang together, with the null vectors that reach them.

    Attributes:
        columns: Of D(c), ascending.
        elements: Indices of the elements that hold them, in the model as analysed.
        motions: Vectors of the space of motions that belong to it.
        stresses: Vectors of the space of self-stresses likewise.
    """

    columns: NDArray[np.integer]
    elements: NDArray[np.integer]
    motions: tuple[int, ...]
    stresses: tuple[int, ...]


def components_of(spaces: Spaces) -> tuple[tuple[Component, ...], int]:
    """The components in which both motions and self-stresses are, and all other motions' number.

    A vector of a basis that reaches over several makes one of them.
    """
    columns = spaces.columns
    groups = _Groups(columns + spaces.data.arrays.element_number.size)
    nodes, elements = _incidence(spaces)
    node, axis = spaces.raw.column_label - 1
    column_at = np.full((spaces.data.arrays.node_kind.size, 3), -1)
    column_at[node, axis] = np.arange(columns)
    for k in range(3):
        there = column_at[nodes, k]
        groups.join(there[there >= 0], elements[there >= 0] + columns)
    both = (
        (spaces.motion_space, np.arange(columns)),
        (spaces.stress_space, spaces.raw.row_label[0] - 1 + columns),
    )
    for basis, place in both:
        groups.join(*_within_vectors(basis, place))
    group = groups.found()
    moving, stressed = (_of_vectors(group, place, basis) for basis, place in both)
    felt = np.intersect1d(moving, stressed)
    free = int(np.count_nonzero(~np.isin(moving, felt)))
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
                tuple(np.flatnonzero(stressed == mine).tolist()),
            )
        )
    return tuple(made), free


def _of_vectors(
    group: NDArray[np.integer], place: NDArray[np.integer], basis: Basis
) -> NDArray[np.integer]:
    """(vectors,) the group that each vector of a basis belongs to."""
    made = np.zeros(basis.vectors, np.int64)
    seen = _seen(basis)
    made[basis.of_entries()[seen]] = group[place[basis.place[seen]]]
    return made


def _within_vectors(
    basis: Basis, place: NDArray[np.integer]
) -> tuple[NDArray[np.integer], NDArray[np.integer]]:
    """Places that a vector reaches, each beside one of them."""
    seen = _seen(basis)
    where, vector = place[basis.place[seen]], basis.of_entries()[seen]
    one = np.zeros(basis.vectors, np.int64)
    one[vector] = where
    return where, one[vector]


def _seen(basis: Basis) -> NDArray[np.bool_]:
    """Entries of vectors of unit norm that are more than rounding."""
    return np.abs(basis.value) > _UNSEEN


def _incidence(spaces: Spaces) -> tuple[NDArray[np.integer], NDArray[np.integer]]:
    """Nodes and elements that hold something, side by side."""
    arrays = spaces.data.arrays
    held = (arrays.deformation_class == Class.FIXED) | (
        arrays.deformation_class == Class.INDEPENDENT
    )
    slot, element = np.nonzero((arrays.element_node > 0) & held.any(axis=0))
    return arrays.element_node[slot, element] - 1, element


class _Groups:
    """Numbers that are joined."""

    def __init__(self, size: int) -> None:
        self._pairs: list[tuple[NDArray[np.integer], NDArray[np.integer]]] = []
        self._size = size

    def join(self, one: NDArray[np.integer], other: NDArray[np.integer]) -> None:
        """Join each of some with each of others, side by side."""
        self._pairs.append((one, other))

    def found(self) -> NDArray[np.integer]:
        """(size,) the least number of the group of each."""
        one = np.concatenate([pair[0] for pair in self._pairs])
        other = np.concatenate([pair[1] for pair in self._pairs])
        group = np.arange(self._size)
        while True:
            before = group.copy()
            least = np.minimum(group[one], group[other])
            # The roots of both are joined, then the ways are shortened.
            np.minimum.at(group, group[one], least)
            np.minimum.at(group, group[other], least)
            np.minimum.at(group, one, least)
            np.minimum.at(group, other, least)
            group = group[group]
            if np.array_equal(group, before):
                return group
