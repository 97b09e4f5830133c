# SPDX-License-Identifier: BSD-3-Clause
"""Bases of a space whose vectors reach as few groups of rows as can be.

The vectors that are zero in some groups are a subspace, a flat. A basis whose vectors cost least
in all is found greedily, as in any matroid: from the cheapest flat on, what is not spanned yet is
added (Coleman and Pothen, SIAM J. Algebraic Discrete Methods 7, 1986). All flats are looked at
where they are not too many; else those to which a descent in the sum of the groups' norms leads.
Either way the vectors are independent and span the space: that is made sure of at the end.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..core.arrays import Basis, BoolArray, FloatArray, IndexArray
from ..util.groups import grouped, least_of_groups, values_in
from ..util.matrices import complement, null_space, span
from .limits import ROUNDING

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

    row_of: IndexArray
    column_of: IndexArray
    value: FloatArray
    rows: int

    def only(self, chosen: BoolArray) -> Sparse:
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


def support_of(basis: Basis) -> IndexArray:
    """Places at which any of the vectors may be other than zero, ascending."""
    return np.flatnonzero(np.bincount(basis.place, minlength=basis.size))


def index_of(places: IndexArray, size: int) -> NDArray[np.int64]:
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


def groups_of(basis: Basis) -> NDArray[np.int64]:
    """(k,) the first vector of the group that each vector belongs to: they share places."""
    count = basis.vectors
    group = least_of_groups(count + basis.size, basis.of_entries(), count + basis.place)
    return group[:count]


def _orthonormal_by_groups(basis: Basis) -> Basis:
    """Groups of one shape at a time; those that cannot be held stay as they are."""
    parts = _Grouped(basis)
    shapes, shape = np.unique(np.stack((parts.rows, parts.vectors)), axis=1, return_inverse=True)
    shape = shape.ravel()
    of_entry = shape[parts.group]
    entries = np.argsort(of_entry, kind="stable")
    bounds = np.searchsorted(of_entry[entries], np.arange(shapes.shape[1] + 1)).tolist()
    # Of each piece the number of entries of each vector, their places and values.
    counts: list[IndexArray] = []
    places: list[IndexArray] = []
    values: list[FloatArray] = []
    for k, (rows, vectors) in enumerate(shapes.T.tolist()):
        mine = np.sort(entries[bounds[k] : bounds[k + 1]])
        if not _can_be_held(rows, vectors):
            # They stay as they are, but for their norm.
            value = basis.value[mine]
            vector, count = np.unique(
                basis.of_entries()[mine], return_inverse=True, return_counts=True
            )[1:]
            norm = np.sqrt(np.bincount(vector, value**2))
            counts.append(count)
            places.append(basis.place[mine])
            values.append(value / norm[vector])
            continue
        same = np.flatnonzero(shape == k)
        step = max(1, _MOST_ENTRIES // (rows * vectors))
        for some in np.split(same, range(step, same.size, step)):
            chosen = mine if some.size == same.size else mine[np.isin(parts.group[mine], some)]
            dense, at = parts.dense(some, chosen)
            q = np.linalg.qr(dense)[0]
            many, height, width = q.shape
            counts.append(np.full(many * width, height))
            places.append(np.broadcast_to(at[:, None], (many, width, height)).ravel())
            values.append(np.swapaxes(q, 1, 2).ravel())
    start = np.concatenate(([0], np.cumsum(np.concatenate(counts))))
    place = np.concatenate(places).astype(np.int32)
    return Basis(basis.size, start.astype(np.int32), place, np.concatenate(values))


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

    def dense(self, groups: IndexArray, entries: IndexArray) -> tuple[FloatArray, IndexArray]:
        """Groups of one shape in full (groups, rows, vectors), and their places (groups, rows)."""
        rows, vectors = int(self.rows[groups[0]]), int(self.vectors[groups[0]])
        made = np.zeros((groups.size, rows, vectors))
        owner = self.group[entries]
        row = self._key[entries] - self._first[owner]
        made[np.searchsorted(groups, owner), row, self._rank[entries]] = self._value[entries]
        return made, self._place[self._first[groups][:, None] + np.arange(rows)]


def _starts(counts: IndexArray) -> IndexArray:
    """Where each of several pieces of these sizes begins."""
    return np.asarray(np.cumsum(counts) - counts)


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


def _first_that_fit(basis: Basis, uses: IndexArray) -> Basis:
    """As many of the vectors as the terms of a product allow; `uses` of each place."""
    terms = np.concatenate(([0], np.cumsum(uses[basis.place])))[basis.start]
    vectors = int(np.searchsorted(terms, _MOST_TERMS, "right")) - 1
    if vectors >= basis.vectors:
        return basis
    entries = int(basis.start[vectors])
    return Basis(
        basis.size, basis.start[: vectors + 1], basis.place[:entries], basis.value[:entries]
    )


#: A vector that has less than this outside what is spanned already is not taken for a new one.
_NEW = 1.0e-2
#: A group that has all of a vector but this is looked at as one that may have it alone.
_ALL_BUT = 1.0e-6
#: Subspaces that are cut to find all flats of one component.
_MOST_CUTS = 1_500
#: Of components of more dimensions than this circuits are given; of still more they are left as
#: they are.
MOST_DIMENSIONS, _MOST_CIRCUITS = 24, 400
#: A row of which less than this is new makes no circuit.
_CLEARLY_NEW = 1.0e-3
#: Of flats of more dimensions only what is not spanned yet is refined.
_MOST_REFINED = 8
#: Steps of the descent, and groups from which one starts.
_STEPS = 12
_MOST_STARTS = 60

Groups = Sequence[IndexArray]
Cost = tuple[int, ...]
#: What makes a basis of a space, (rows, k) columns, that a choice of groups leaves: (rows, k).
Refine = Callable[[FloatArray], FloatArray]


class Piece(NamedTuple):
    """Vectors that reach the same groups."""

    cost: Cost
    """The sum of the costs of these groups."""
    support: tuple[int, ...]
    """Which groups they are."""
    vectors: FloatArray
    """(rows, d)."""


#: The vectors that are zero in some groups: these groups, a bit each, and (k, d) coefficients.
_Flat = tuple[int, FloatArray]


def pieces_of(
    space: FloatArray, groups: Groups, costs: Sequence[Cost], refine: Refine
) -> list[Piece]:
    """A basis of a space, the cheapest vectors first.

    Args:
        space: (rows, k) independent columns.
        groups: Rows of each group; what no group has is not paid for.
        costs: Of each group; of equal costs the groups that come first are taken.
        refine: Chooses among the vectors that reach the same groups.

    Returns:
        Together k columns, in pieces of one support each; those that reach no group first.
    """
    unseen, seen = _by_what_is_seen(space, groups)
    nothing: Cost = tuple(0 for _ in costs[0]) if costs else ()
    made = [Piece(nothing, (), refine(unseen))] if unseen.shape[1] else []
    if not seen.shape[1]:
        return made
    # Coefficients in which the rows of all groups together are orthonormal.
    stacked = np.concatenate([seen[group] for group in groups])
    change = np.linalg.inv(np.linalg.qr(stacked)[1])
    blocks = [_reduced(seen[group] @ change) for group in groups]
    search = _Search(blocks, costs, lambda given: refine(seen @ (change @ given)), seen @ change)
    found = made + sorted(search.pieces(), key=lambda piece: piece[:2])
    return _independent(found, space, _sum(costs, range(len(groups))))


def _newly_spanned(vectors: FloatArray, spanned: FloatArray) -> tuple[list[int], FloatArray]:
    """Which vectors (k, d) are outside of what orthonormal ones span, and what all of them span."""
    chosen = []
    for k, one in enumerate((vectors / np.linalg.norm(vectors, axis=0)).T):
        off = _off(one[:, None], spanned)
        if np.linalg.norm(off) > _NEW:
            spanned = np.concatenate([spanned, off / np.linalg.norm(off)], axis=1)
            chosen.append(k)
    return chosen, spanned


def _independent(pieces: list[Piece], space: FloatArray, cost: Cost) -> list[Piece]:
    """The pieces without vectors that depend on those before, and what is missing then.

    Both happen where entries are neither zero nor clearly more: near a change of rank.
    """
    orthonormal = np.linalg.qr(space)[0]
    spanned, made = np.zeros((space.shape[1], 0)), []
    for piece in pieces:
        coefficients = orthonormal.T @ piece.vectors
        chosen, spanned = _newly_spanned(coefficients, spanned)
        if chosen:
            # Rounding may have left the space where groups see little of a vector.
            made.append(piece._replace(vectors=orthonormal @ coefficients[:, chosen]))
    if spanned.shape[1] < space.shape[1]:
        support = tuple(sorted({i for piece in pieces for i in piece.support}))
        made.append(Piece(cost, support, orthonormal @ complement(spanned)))
    return made


def columns_of(pieces: Sequence[Piece], rows: int) -> FloatArray:
    """All vectors side by side."""
    return np.concatenate([np.zeros((rows, 0)), *(piece.vectors for piece in pieces)], axis=1)


def classes_of_rows(space: FloatArray) -> list[IndexArray]:
    """Rows that are parallel to each other, class by class in the order of their first rows.

    Rows that are zero are in none.
    """
    size = np.linalg.norm(space, axis=1)
    there = np.flatnonzero(size > ROUNDING * size.max(initial=0.0))
    unit = space[there] / size[there, None]
    left = np.ones(there.size, bool)
    made = []
    for k in range(there.size):
        if left[k]:
            off = unit - np.outer(unit @ unit[k], unit[k])
            mine = left & (np.linalg.norm(off, axis=1) < 1.0e3 * ROUNDING)
            left &= ~mine
            made.append(there[mine])
    return made


def _by_what_is_seen(space: FloatArray, groups: Groups) -> tuple[FloatArray, FloatArray]:
    """The vectors of a space that no group has, and those across them."""
    every = np.concatenate([np.zeros(0, int), *groups])
    orthonormal = np.linalg.qr(space)[0]
    if values_in(every).size == len(space):
        return orthonormal[:, :0], orthonormal
    unseen = null_space(np.linalg.qr(orthonormal[every])[1], ROUNDING)
    return orthonormal @ unseen, orthonormal @ complement(unseen)


def _reduced(block: FloatArray) -> FloatArray:
    """A matrix of few rows with the same product with its transpose."""
    if len(block) == 1:
        return block if np.linalg.norm(block) > ROUNDING else block[:0]
    _, values, right = np.linalg.svd(block, full_matrices=False)
    return np.asarray((values[:, None] * right)[values > ROUNDING])


class _Search:
    """The search in coefficients of k vectors whose groups together are orthonormal."""

    def __init__(
        self,
        blocks: list[FloatArray],
        costs: Sequence[Cost],
        refine: Refine,
        space: FloatArray,
    ) -> None:
        """Keep (r, k) blocks of the groups; `refine` takes coefficients, (k, d)."""
        self.blocks = blocks
        self.costs = costs
        self.refine = refine
        self.space = space

    def pieces(self) -> Iterator[Piece]:
        """Vectors that one group has alone, then those of each component of the rest."""
        size = self.space.shape[1]
        alone = [np.zeros((size, 0))]
        for i, block in enumerate(self.blocks):
            if not block.size or _norm(block) < 1.0 - _ALL_BUT:
                continue
            others = [other for k, other in enumerate(self.blocks) if k != i]
            mine = null_space(np.concatenate([np.zeros((0, size)), *others]), ROUNDING)
            if mine.shape[1]:
                alone.append(mine)
                yield Piece(self.costs[i], (i,), self.refine(mine))
        rest = complement(np.concatenate(alone, axis=1))
        if rest.shape[1]:
            yield from self._of_components(rest)

    def _of_components(self, rest: FloatArray) -> Iterator[Piece]:
        blocks = [_reduced(block @ rest) for block in self.blocks]
        for members in _components(blocks):
            stacked = np.concatenate([blocks[i] for i in members])
            _, values, right = np.linalg.svd(np.linalg.qr(stacked)[1])
            within = rest @ right[: int(np.count_nonzero(values > 0.5))].T
            yield from self._of_component(members, within)

    def _of_component(self, members: list[int], within: FloatArray) -> Iterator[Piece]:
        """The greedy choice; `within` (k, d) are the vectors of the component."""
        d = within.shape[1]
        if not d:
            return
        blocks = [_reduced(self.blocks[i] @ within) for i in members]
        if MOST_DIMENSIONS < d <= _MOST_CIRCUITS:
            yield from self._circuits(members, blocks, within)
            return
        spanned = np.zeros((d, 0))
        for support, new in self._cheapest_first(members, blocks, d):
            if not np.linalg.norm(_off(new, spanned)) > _NEW:
                continue
            if new.shape[1] > _MOST_REFINED:
                new = span(_off(new, spanned), _NEW)
            refined = self.refine(within @ new)
            coefficients = np.asarray(np.linalg.lstsq(self.space @ within, refined, rcond=None)[0])
            chosen, spanned = _newly_spanned(coefficients, spanned)
            if chosen:
                yield Piece(self._cost(support), support, refined[:, chosen])
            if spanned.shape[1] == d:
                return
        left = within @ complement(spanned)
        yield Piece(self._cost(members), tuple(members), self.space @ left)

    def _circuits(
        self, members: list[int], blocks: list[FloatArray], within: FloatArray
    ) -> Iterator[Piece]:
        """Of so many vectors those in which one row each of d rows is not zero.

        The rows are those of the last groups, so that what they share are the first ones.
        """
        rows = np.concatenate(blocks)
        owner = np.repeat(np.arange(len(blocks)), [len(block) for block in blocks])
        chosen, spanned = list[int](), np.zeros((rows.shape[1], 0))
        for k in reversed(range(len(rows))):
            off = _off(rows[k][:, None], spanned)
            size = float(np.linalg.norm(off))
            if size > _CLEARLY_NEW * np.linalg.norm(rows[k]):
                spanned = np.concatenate([spanned, off / size], axis=1)
                chosen.append(k)
        if len(chosen) < rows.shape[1]:
            yield Piece(self._cost(members), tuple(members), self.space @ within)
            return
        vectors = np.linalg.inv(rows[chosen])
        vectors /= np.abs(rows @ vectors).max(axis=0)
        there = np.abs(rows @ vectors) > 1.0e3 * ROUNDING
        supports = [tuple(members[i] for i in values_in(owner[mine]).tolist()) for mine in there.T]
        made = [
            Piece(self._cost(support), support, self.refine(within @ vectors[:, same]))
            for support, same in grouped((each, k) for k, each in enumerate(supports)).items()
        ]
        yield from sorted(made, key=lambda piece: piece[:2])

    def _cheapest_first(
        self, members: list[int], blocks: list[FloatArray], d: int
    ) -> list[tuple[tuple[int, ...], FloatArray]]:
        if d > MOST_DIMENSIONS:
            return []
        whole = 0, np.eye(d)
        flats = [whole] if d == 1 else _all_flats(blocks, d) or [*_by_descent(blocks, d), whole]
        supports = [
            tuple(i for k, i in enumerate(members) if not zero >> k & 1) for zero, _ in flats
        ]
        order = sorted(range(len(flats)), key=lambda n: (self._cost(supports[n]), supports[n]))
        return [(supports[n], flats[n][1]) for n in order]

    def _cost(self, support: Iterable[int]) -> Cost:
        return _sum(self.costs, support)


def _sum(costs: Sequence[Cost], support: Iterable[int]) -> Cost:
    """What some groups cost together."""
    return tuple(map(sum, zip(*(costs[i] for i in support), strict=True)))


def _norm(block: FloatArray) -> float:
    """The largest singular value."""
    return float(np.linalg.norm(block, 2 if len(block) > 1 else None))


def _off(vectors: FloatArray, spanned: FloatArray) -> FloatArray:
    """What of some vectors is outside of what orthonormal ones span."""
    off = vectors - spanned @ (spanned.T @ vectors)
    return off - spanned @ (spanned.T @ off)


def _components(blocks: list[FloatArray]) -> list[list[int]]:
    """Groups that vectors join, as the projector on the space shows; those without rows in none."""
    there = [i for i, block in enumerate(blocks) if block.size]
    if not there:
        return []
    stacked = np.concatenate([blocks[i] for i in there])
    start = np.cumsum([0, *(len(blocks[i]) for i in there[:-1])])
    square = np.add.reduceat((stacked @ stacked.T) ** 2, start, axis=0)
    joined = np.sqrt(np.add.reduceat(square, start, axis=1)) > 1.0e3 * ROUNDING
    group = least_of_groups(len(there), *np.nonzero(joined)).tolist()
    return list(grouped(zip(group, there, strict=True)).values())


class _Stack:
    """Blocks above each other, to see at once in which of them vectors are zero."""

    def __init__(self, blocks: list[FloatArray]) -> None:
        self.there = [i for i, block in enumerate(blocks) if block.size]
        self._rows = np.concatenate([blocks[i] for i in self.there])
        self._start = np.cumsum([0, *(len(blocks[i]) for i in self.there[:-1])])
        self._counts = [len(blocks[i]) for i in self.there]
        self._never = sum(1 << i for i, block in enumerate(blocks) if not block.size)

    def norms(self, vectors: FloatArray) -> FloatArray:
        """Of each block that has rows."""
        squares = np.sum((self._rows @ vectors) ** 2, axis=1)
        return np.sqrt(np.add.reduceat(squares, self._start))

    def smaller(self, vector: FloatArray, row: FloatArray) -> FloatArray:
        """(k,) of least sum of squares over present norms, of those with one product with a row."""
        norms = self.norms(vector[:, None])
        weights = np.repeat(1.0 / np.maximum(norms, 1.0e-8 * norms.max()), self._counts)
        matrix = self._rows.T @ (weights[:, None] * self._rows)
        return np.asarray(np.linalg.lstsq(matrix, row, rcond=None)[0])

    def zero(self, vectors: FloatArray) -> int:
        """The blocks in which they are zero, a bit each."""
        small = np.flatnonzero(self.norms(vectors) < 10.0 * ROUNDING).tolist()
        return self._never | sum(1 << self.there[k] for k in small)


def _all_flats(blocks: list[FloatArray], d: int) -> list[_Flat] | None:
    """Every flat once, the whole space first; None where they are too many.

    Each is cut out of another by the first group in which it is zero and that one is not; that
    this is the first, and later than those before, tells it from its repetitions (Ganter 1984).
    """
    stack = _Stack(blocks)
    whole = stack.zero(np.eye(d)), np.eye(d)
    made, cuts = [whole], 0
    open_flats = [(whole, -1)]
    while open_flats:
        (flat, within), last = open_flats.pop()
        for i in range(last + 1, len(blocks)):
            if flat >> i & 1:
                continue
            cuts += 1
            if cuts > _MOST_CUTS:
                return None
            left = null_space(blocks[i] @ within, ROUNDING)
            if not left.shape[1]:
                continue
            vectors = within @ left
            zero = stack.zero(vectors)
            new = zero & ~flat
            if new & -new == 1 << i:
                made.append((zero, vectors))
                open_flats.append((made[-1], i))
    return made


def _by_descent(blocks: list[FloatArray], d: int) -> Iterator[_Flat]:
    """Flats that cannot be made smaller, one for each direction of the first groups.

    From a vector with a small sum of the groups' norms, found by weighted least squares again
    and again, the groups are made zero as long as the one that it starts from is not.
    """
    stack = _Stack(blocks)
    for i in range(min(len(blocks), _MOST_STARTS)):
        for row in blocks[i]:
            vector = row / np.linalg.norm(row)
            for _ in range(_STEPS):
                vector = stack.smaller(vector, row)
                vector = vector / np.linalg.norm(vector)
            norms = np.zeros(len(blocks))
            norms[stack.there] = stack.norms(vector[:, None])
            rounded = np.round(norms / norms.max(), 6)
            # The smallest first; of equal ones the last, so that those that come first are kept.
            vectors = np.eye(d)
            for k in np.lexsort((-np.arange(norms.size), rounded)).tolist():
                if k == i or not blocks[k].size:
                    continue
                left = vectors @ null_space(blocks[k] @ vectors, ROUNDING)
                if left.shape[1] and np.linalg.norm(blocks[i] @ left) > _NEW:
                    vectors = left
            yield stack.zero(vectors), vectors
