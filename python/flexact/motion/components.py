# SPDX-License-Identifier: BSD-3-Clause
"""What hangs together through held deformations, with its motions and self-stresses.

Coordinates of two components have no held deformation in common, at any position: a motion of
one feels the self-stresses of that one alone.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..analysis.result_spaces import Spaces
from ..core.basis import Basis
from ..core.elements import Class
from ..util.records import Frozen

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

    columns: NDArray[np.integer]
    elements: NDArray[np.integer]
    motions: tuple[int, ...]
    stresses: int


def components_of(spaces: Spaces) -> tuple[tuple[Component, ...], int]:
    """The components in which both motions and self-stresses are, and all other motions' number.

    All motions have to be known. A vector that reaches over several components makes one of them.
    """
    columns, basis = spaces.columns, spaces.motion_space
    groups = _Groups(columns + spaces.data.arrays.element_number.size)
    nodes, elements = _incidence(spaces)
    node, axis = spaces.raw.column_label - 1
    column_at = np.full((spaces.data.arrays.node_kind.size, 3), -1)
    column_at[node, axis] = np.arange(columns)
    for k in range(3):
        there = column_at[nodes, k]
        groups.join(there[there >= 0], elements[there >= 0] + columns)
    groups.join(*_within_vectors(basis))
    group = groups.found()
    moving = _of_vectors(group, basis)
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


def _of_vectors(group: NDArray[np.integer], basis: Basis) -> NDArray[np.integer]:
    """(vectors,) the group that each vector of a basis belongs to."""
    made = np.zeros(basis.vectors, np.int64)
    seen = _seen(basis)
    made[basis.of_entries()[seen]] = group[basis.place[seen]]
    return made


def _within_vectors(basis: Basis) -> tuple[NDArray[np.integer], NDArray[np.integer]]:
    """Places that a vector reaches, each beside one of them."""
    seen = _seen(basis)
    where, vector = basis.place[seen], basis.of_entries()[seen]
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
