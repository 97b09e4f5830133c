# SPDX-License-Identifier: BSD-3-Clause
"""Subspaces given by sparse vectors: orthonormal bases, and how far rows reach into them.

Vectors that share no place are orthogonal, so that each group of vectors that hang together by
their places is made orthonormal by itself. Where even a group is too large for that in little
time its vectors are taken as they are, each of unit norm: which rows reach into the space then
still is exact, how far is not.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..core.arrays import FloatArray, IntArray
from ..core.basis import Basis

#: How many entries are held in full.
_MOST_ENTRIES = 20_000_000
#: How many operations are spent on making one group orthonormal.
_MOST_WORK = 1.5e9
#: Up to so many vectors go through a product one by one.
_ONE_BY_ONE = 64
#: How many terms of a product are added up in all, and at once.
_MOST_TERMS = 50_000_000
_TERMS_AT_ONCE = 4_000_000


class Sparse(NamedTuple):
    """Entries of a sparse matrix; those at one place add up."""

    row_of: NDArray[np.integer]
    column_of: NDArray[np.integer]
    value: FloatArray
    rows: int

    def only(self, chosen: NDArray[np.bool_]) -> Sparse:
        """Some of the entries."""
        return Sparse(self.row_of[chosen], self.column_of[chosen], self.value[chosen], self.rows)


def orthonormal(basis: Basis, weights: FloatArray) -> Basis:
    """Orthonormal basis of the weighted space, as far as the module says.

    Args:
        basis: Independent vectors.
        weights: (size,) what their entries are multiplied by, positive.
    """
    weighted = basis._replace(value=basis.value * weights[basis.place])
    support = support_of(basis)
    if _can_be_held(support.size, basis.vectors):
        places = np.searchsorted(support, basis.place).astype(np.int32)
        within = weighted._replace(size=support.size, place=places)
        made = Basis.of_dense(np.linalg.qr(within.toarray())[0])
        return made._replace(size=basis.size, place=support[made.place].astype(np.int32))
    return _orthonormal_by_groups(weighted)


def support_of(basis: Basis) -> NDArray[np.integer]:
    """Places at which any of the vectors may be other than zero, ascending."""
    return np.flatnonzero(np.bincount(basis.place, minlength=basis.size))


def index_of(places: NDArray[np.integer], size: int) -> NDArray[np.int64]:
    """(size,) at which of the places each number stands, -1 where at none."""
    made = np.full(size, -1)
    made[places] = np.arange(places.size)
    return made


def row_norms(basis: Basis) -> FloatArray:
    """(size,) norm of each row of the vectors side by side."""
    return np.sqrt(np.bincount(basis.place, basis.value**2, basis.size))


def norms_of_product(matrix: Sparse, basis: Basis) -> FloatArray:
    """(rows,) norms of the rows of a sparse matrix times the vectors side by side.

    Where the vectors are so many and so full that this would take long, the first of them
    alone are taken.
    """
    if basis.vectors > _ONE_BY_ONE:
        return np.sqrt(_squares_by_terms(matrix, basis))
    total = np.zeros(matrix.rows)
    for k in range(basis.vectors):
        terms = matrix.value * basis.vector(k)[matrix.column_of]
        total += np.bincount(matrix.row_of, terms, matrix.rows) ** 2
    return np.sqrt(total)


def _can_be_held(rows: int, vectors: int) -> bool:
    return rows * vectors <= _MOST_ENTRIES and float(rows) * vectors**2 <= _MOST_WORK


def groups_of(basis: Basis) -> IntArray:
    """(k,) the first vector of the group that each vector belongs to."""
    order = np.argsort(basis.place, kind="stable")
    vector, place = basis.of_entries()[order], basis.place[order]
    new = np.concatenate(([True], place[1:] != place[:-1]))
    first = np.flatnonzero(new)
    of_place = np.empty(order.size, np.int64)
    of_place[order] = np.cumsum(new) - 1
    group = np.arange(basis.vectors, dtype=np.int32)
    while True:
        least = np.minimum.reduceat(group[vector], first)
        found = np.minimum.reduceat(least[of_place], basis.start[:-1])
        found = found[found]
        if np.array_equal(found, group):
            return group
        group = found


def _orthonormal_by_groups(basis: Basis) -> Basis:
    """Groups of one shape at a time; those that cannot be held stay as they are."""
    parts = _Grouped(basis)
    shapes, shape = np.unique(np.stack((parts.rows, parts.vectors)), axis=1, return_inverse=True)
    shape = shape.ravel()
    of_entry = shape[parts.group]
    entries = np.argsort(of_entry, kind="stable")
    bounds = np.searchsorted(of_entry[entries], np.arange(shapes.shape[1] + 1)).tolist()
    pieces = []
    for k, (rows, vectors) in enumerate(shapes.T.tolist()):
        mine = np.sort(entries[bounds[k] : bounds[k + 1]])
        if not _can_be_held(rows, vectors):
            pieces.append(_of_unit_norm(basis, mine))
            continue
        same = np.flatnonzero(shape == k)
        step = max(1, _MOST_ENTRIES // (rows * vectors))
        for some in np.split(same, range(step, same.size, step)):
            chosen = mine if some.size == same.size else mine[np.isin(parts.group[mine], some)]
            dense, places = parts.dense(some, chosen)
            pieces.append(_side_by_side(np.linalg.qr(dense)[0], places))
    return _joined(basis.size, pieces)


class _Grouped:
    """The vectors of a basis by group.

    Attributes:
        group: (entries,) group of each entry, from 0.
        rows: (groups,) number of places that each group reaches.
        vectors: (groups,) number of its vectors.
    """

    def __init__(self, basis: Basis) -> None:
        vector = basis.of_entries()
        _, group, self.vectors = np.unique(
            groups_of(basis), return_inverse=True, return_counts=True
        )
        # Where each vector stands in its group, and each of its places among the group's.
        order, rank = np.argsort(group, kind="stable"), np.empty(basis.vectors, np.int64)
        rank[order] = np.arange(basis.vectors) - _starts(self.vectors).repeat(self.vectors)
        self.group, self._rank, self._value = group[vector], rank[vector], basis.value
        keys = self.group.astype(np.int64) * basis.size + basis.place
        unique, self._key = np.unique(keys, return_inverse=True)
        owner, self._place = np.divmod(unique, basis.size)
        self.rows = np.bincount(owner, minlength=self.vectors.size)
        self._first = _starts(self.rows)

    def dense(
        self, groups: NDArray[np.integer], entries: NDArray[np.integer]
    ) -> tuple[FloatArray, NDArray[np.integer]]:
        """Groups of one shape in full (groups, rows, vectors), and their places (groups, rows)."""
        rows, vectors = int(self.rows[groups[0]]), int(self.vectors[groups[0]])
        made = np.zeros((groups.size, rows, vectors))
        owner = self.group[entries]
        row = self._key[entries] - self._first[owner]
        made[np.searchsorted(groups, owner), row, self._rank[entries]] = self._value[entries]
        return made, self._place[self._first[groups][:, None] + np.arange(rows)]


def _starts(counts: NDArray[np.integer]) -> NDArray[np.integer]:
    """Where each of several pieces of these sizes begins."""
    starts: NDArray[np.integer] = np.cumsum(counts) - counts
    return starts


class _Piece(NamedTuple):
    counts: NDArray[np.integer]
    place: NDArray[np.integer]
    value: FloatArray


def _of_unit_norm(basis: Basis, entries: NDArray[np.integer]) -> _Piece:
    """Some of the vectors, whose entries stand in a row, as they are."""
    vector, value = basis.of_entries()[entries], basis.value[entries]
    _, vector, count = np.unique(vector, return_inverse=True, return_counts=True)
    norm = np.sqrt(np.bincount(vector, value**2))
    return _Piece(count, basis.place[entries], value / norm[vector])


def _side_by_side(q: FloatArray, places: NDArray[np.integer]) -> _Piece:
    """The vectors of several groups: (groups, height, width), at places (groups, height)."""
    groups, height, width = q.shape
    place = np.broadcast_to(places[:, None], (groups, width, height))
    return _Piece(np.full(groups * width, height), place.ravel(), np.swapaxes(q, 1, 2).ravel())


def _joined(size: int, pieces: list[_Piece]) -> Basis:
    count, place, value = (np.concatenate(parts) for parts in zip(*pieces, strict=True))
    start = np.concatenate(([0], np.cumsum(count)))
    return Basis(size, start.astype(np.int32), place.astype(np.int32), value)


def _squares_by_terms(matrix: Sparse, basis: Basis) -> FloatArray:
    """Squares of the norms, from the terms of the product that are not zero."""
    basis = _first_that_fit(basis, np.bincount(matrix.column_of, minlength=basis.size))
    many = np.bincount(basis.place, minlength=basis.size)
    used = matrix.only(many[matrix.column_of] > 0)
    order = np.argsort(used.row_of, kind="stable")
    row, column, value = (part[order] for part in used[:3])
    by_place = np.argsort(basis.place, kind="stable")
    vector, factor = basis.of_entries()[by_place], basis.value[by_place]
    first, ends = _starts(many), np.cumsum(many[column])
    total = np.zeros(matrix.rows)
    begin = done = 0
    while begin < row.size:
        last = max(begin, int(np.searchsorted(ends, done + _TERMS_AT_ONCE, "right")) - 1)
        end = int(np.searchsorted(row, row[last], "right"))  # no row is torn apart
        repeat = many[column[begin:end]]
        entry = np.repeat(np.arange(begin, end), repeat)
        at = np.arange(entry.size) - np.repeat(_starts(repeat), repeat) + first[column[entry]]
        keys = row[entry].astype(np.int64) * basis.vectors + vector[at]
        unique, key = np.unique(keys, return_inverse=True)
        sums = np.bincount(key, value[entry] * factor[at])
        total += np.bincount(unique // basis.vectors, sums**2, matrix.rows)
        begin, done = end, int(ends[end - 1])
    return total


def _first_that_fit(basis: Basis, uses: NDArray[np.integer]) -> Basis:
    """As many of the vectors as the terms of a product allow; `uses` of each place."""
    terms = np.concatenate(([0], np.cumsum(uses[basis.place])))[basis.start]
    vectors = int(np.searchsorted(terms, _MOST_TERMS, "right")) - 1
    if vectors >= basis.vectors:
        return basis
    entries = int(basis.start[vectors])
    return Basis(
        basis.size, basis.start[: vectors + 1], basis.place[:entries], basis.value[:entries]
    )
