# SPDX-License-Identifier: BSD-3-Clause
"""Rows as a matroid, in terms of a basis: what is in parallel, in series, or taken out.

An entry is taken for zero where rounding explains it, and for another number where it is far
above that; in between somebody else is asked.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from time import monotonic
from typing import NamedTuple

import numpy as np

from ...core.arrays import BoolArray, FloatArray, IndexArray
from ...util.groups import grouped, groups_of

#: Entries of an echelon form beyond which the rows are better exchanged.
_EXCHANGED = 1.01
#: How many exchanges there are at most for each factor.
_MOST_EXCHANGES = 10


@dataclass(frozen=True)
class Echelon:
    """Rows of a matrix in terms of some of them.

    Attributes:
        basis: (k,) numbers of the rows of the basis.
        others: (n - k,) numbers of the others.
        factor: (k, n - k) of each other row the multiples of the rows of the basis that it is.
        smallest: Smallest singular value of the block of the basis.
    """

    basis: IndexArray
    others: IndexArray
    factor: FloatArray
    smallest: float


def echelon_of(matrix: FloatArray, least: float = 0.0) -> Echelon | None:
    """The rows of a matrix (n, k) in terms of k of them, whose block is well-conditioned.

    No factor is larger than 1.01: no exchange of one row makes the block much larger. None where
    the smallest singular value of the best block is not above `least`.
    """
    rows, count = matrix.shape
    if rows < count:
        return None
    rest, chosen = matrix.copy(), []
    for _ in range(count):
        row, column = divmod(int(np.argmax(np.abs(rest))), count)
        if not abs(rest[row, column]) > least:
            return None
        chosen.append(row)
        rest -= np.outer(rest[:, column], rest[row] / rest[row, column])
        rest[row], rest[:, column] = 0.0, 0.0
    basis = np.array(chosen, np.int64)
    others = np.setdiff1d(np.arange(rows), basis)
    if not _smallest(matrix[basis]) > least:
        return None

    def in_terms_of_basis() -> FloatArray:
        return np.asarray(np.linalg.solve(matrix[basis].T, matrix[others].T), np.float64)

    factor = in_terms_of_basis()
    for _ in range(_MOST_EXCHANGES * factor.size):
        i, j = divmod(int(np.argmax(np.abs(factor))), others.size)
        if abs(factor[i, j]) <= _EXCHANGED:
            break
        basis[i], others[j] = others[j], basis[i]
        factor = in_terms_of_basis()
    return Echelon(basis, others, factor, _smallest(matrix[basis]))


def _smallest(block: FloatArray) -> float:
    return float(np.linalg.svd(block, compute_uv=False)[-1]) if block.size else 1.0


#: Rows, by their numbers.
Rows = frozenset[int]
#: Whether the block of a set of k rows is regular, of which the numbers here do not tell; None
#: where that is not known either.
Judge = Callable[[Rows], bool | None]

#: Up to this multiple of its error, and below this part of what it is the difference of, an
#: entry is zero.
ZERO, _TINY = 10.0, 1.0e-9
#: From this multiple of its error, and this part of what it is the difference of, it is not; of
#: what nobody knows from a smaller part on.
CLEAR, LARGE, FAIR = 1.0e3, 1.0e-6, 1.0e-8
#: Rows that differ by more than this part are no multiples of each other.
_NEAR = 0.1
_EPSILON = float(np.finfo(np.float64).eps)


class TooManyError(Exception):
    """There are more bases than can be counted."""


class Piece(NamedTuple):
    """Rows that count as one: how often it is in a basis or not, and rows of one such choice."""

    inside: int
    outside: int
    taken: Rows
    left: Rows


def is_regular(judge: Judge, rows: Rows, is_fair: bool) -> bool:
    """Whether a block is regular that may be; where nobody knows only if it seems so."""
    known = judge(rows)
    if known is None and not is_fair:
        raise TooManyError
    return is_fair if known is None else known


def in_parallel(one: Piece, other: Piece) -> Piece:
    """Two of which a basis holds one at most."""
    return Piece(
        one.inside * other.outside + one.outside * other.inside,
        one.outside * other.outside,
        one.taken | other.left,
        one.left | other.left,
    )


def in_series(one: Piece, other: Piece) -> Piece:
    """Two of which a basis holds one at least."""
    return Piece(
        one.inside * other.inside,
        one.inside * other.outside + one.outside * other.inside,
        one.taken | other.taken,
        one.taken | other.left,
    )


@dataclass
class Minor:
    """A matroid on pieces: those of a basis, and the others in terms of them.

    Attributes:
        factor: (k, n) as of an `Echelon`, exactly zero where it is decided so.
        error: (k, n) by how much each may be off.
        basis: The k pieces of the basis.
        others: The n other pieces.
        chosen: Rows that are in the set besides.
    """

    factor: FloatArray
    error: FloatArray
    basis: list[Piece]
    others: list[Piece]
    chosen: Rows

    def exchanged(self, out: tuple[int, ...], into: tuple[int, ...]) -> Rows:
        """The rows of the basis with some of its pieces exchanged."""
        rows = set(self.chosen)
        for k, piece in enumerate(self.basis):
            rows |= piece.left if k in out else piece.taken
        for k, piece in enumerate(self.others):
            rows |= piece.taken if k in into else piece.left
        return frozenset(rows)

    def decide(self, size: FloatArray, looked_at: BoolArray, judge: Judge) -> None:
        """Put zeros where entries are zero; they are differences of numbers of a size."""
        value = np.abs(self.factor)
        limit = np.minimum(ZERO * self.error, _TINY * size)
        is_zero = looked_at & (value <= limit)
        is_clear = value >= np.maximum(CLEAR * self.error, LARGE * size)
        for i, j in np.argwhere(looked_at & ~is_zero & ~is_clear).tolist():
            is_fair = bool(value[i, j] >= max(CLEAR * self.error[i, j], FAIR * size[i, j]))
            is_zero[i, j] = not is_regular(judge, self.exchanged((i,), (j,)), is_fair)
        self.factor[is_zero] = 0.0

    def without(
        self, rows: Collection[int], columns: Collection[int], *, are_merged: bool = False
    ) -> Minor:
        """Without some pieces, of the basis and of the others, that are decided elsewhere.

        Or that were merged into others.
        """
        kept = [k for k in range(len(self.basis)) if k not in rows]
        kept_others = [k for k in range(len(self.others)) if k not in columns]
        chosen = self.chosen
        if not are_merged:
            chosen = chosen.union(
                *(self.basis[k].taken for k in rows), *(self.others[k].left for k in columns)
            )
        some = np.ix_(kept, kept_others)
        basis, others = [self.basis[k] for k in kept], [self.others[k] for k in kept_others]
        return Minor(self.factor[some], self.error[some], basis, others, chosen)

    def deleted(self, i: int, judge: Judge) -> Minor:
        """Without piece i of the basis, in none of the sets: another takes its place."""
        j = int(np.argmax(np.abs(self.factor[i])))
        pivot, off = self.factor[i, j], self.error[i, j]
        row, column = self.factor[i] / pivot, self.factor[:, j].copy()
        column[i] = 0.0
        row_error = (self.error[i] + np.abs(row) * off) / abs(pivot)
        row_error[self.factor[i] == 0.0] = 0.0
        column_error = np.where(column != 0.0, self.error[:, j], 0.0)
        product = np.outer(column, row)
        made = self.factor - product
        error = self.error + np.outer(np.abs(column), row_error)
        error += np.outer(column_error, np.abs(row))
        made[i], error[i] = row, row_error
        size = np.maximum(np.abs(self.factor), np.abs(product))
        both = (self.factor != 0.0) & (product != 0.0)
        both[i] = False
        basis, others = list(self.basis), list(self.others)
        basis[i], others[j] = others[j], basis[i]
        minor = Minor(made, np.where(made != 0.0, error, 0.0), basis, others, self.chosen)
        minor.error = np.maximum(minor.error, _EPSILON * size)
        minor.decide(size, both, judge)
        return minor.without((), (j,))

    def alike(self, is_row: bool, judge: Judge) -> Iterator[tuple[int, int]]:
        """Pairs of rows or of columns of the factors that are multiples of each other."""
        factor = self.factor if is_row else self.factor.T
        for same in grouped(((row != 0.0).tobytes(), k) for k, row in enumerate(factor)).values():
            some = factor[same]
            p = int(np.argmax(np.abs(some).min(axis=0)))
            if len(same) < 2 or not np.all(some[:, p]):
                continue
            scaled = some / some[:, [p]]
            gone: set[int] = set()
            for k in range(len(same) - 1):
                if same[k] in gone:
                    continue
                size = np.maximum(np.abs(scaled[k]), np.abs(scaled[k + 1 :]))
                near = np.all(np.abs(scaled[k] - scaled[k + 1 :]) <= _NEAR * size, axis=1)
                for other in np.flatnonzero(near).tolist():
                    a, b = same[k], same[k + 1 + other]
                    if b not in gone and self._is_multiple((a, b), is_row, judge):
                        gone.add(b)
                        yield a, b

    def _is_multiple(self, pair: tuple[int, int], is_row: bool, judge: Judge) -> bool:
        a, b = pair
        factor = self.factor if is_row else self.factor.T
        error = self.error if is_row else self.error.T
        p = int(np.argmax(np.abs(factor[a]) * np.abs(factor[b])))
        if factor[b, p] == 0.0:
            return False
        ratio = factor[a, p] / factor[b, p]
        rest = np.abs(factor[a] - ratio * factor[b])
        size = np.maximum(np.abs(factor[a]), np.abs(ratio * factor[b]))
        ratio_error = (error[a, p] + abs(ratio) * error[b, p]) / abs(factor[b, p])
        off = error[a] + abs(ratio) * error[b] + np.abs(factor[b]) * ratio_error
        off = np.maximum(off, _EPSILON * size)
        rest[p] = 0.0
        if np.any(rest >= np.maximum(CLEAR * off, LARGE * size) + (size == 0.0)):
            return False
        doubtful = rest > np.minimum(ZERO * off, _TINY * size)
        for q in np.flatnonzero(doubtful).tolist():
            out, into = ((a, b), (p, q)) if is_row else ((p, q), (a, b))
            is_fair = bool(rest[q] >= max(CLEAR * off[q], FAIR * size[q]))
            if is_regular(judge, self.exchanged(out, into), is_fair):
                return False
        return True


#: Bases found on the way beyond which little more is done: so many divisions of a matroid that
#: hangs together, and so many factors of what is divided. Of fewer all are counted.
_FOUND, _MOST_DIVISIONS, _MOST_FACTORS = 20_000, 600, 300_000


def count_bases(matrix: FloatArray, error: float, judge: Judge, until: float = math.inf) -> int:
    """How many sets of k rows of a matrix (n, k) have a regular block.

    Args:
        matrix: Rows of an orthonormal basis of a space.
        error: By how much its entries may be off.
        judge: Asked about the sets of which the numbers do not tell.
        until: When to give up, by the clock `time.monotonic` [s].

    Raises:
        TooManyError: there are more than can be counted, or than were counted until then.
    """
    form = echelon_of(matrix, ZERO * error)
    if form is None:
        return 0
    whole = frozenset(form.basis.tolist())
    is_clear = form.smallest >= max(CLEAR * error, LARGE)
    if not is_clear and not is_regular(judge, whole, form.smallest >= FAIR):
        return 0
    error /= form.smallest
    basis, others = (
        [Piece(1, 1, frozenset((row,)), frozenset()) for row in rows.tolist()]
        for rows in (form.basis, form.others)
    )
    errors = np.full(form.factor.shape, error)
    start = Minor(form.factor, errors, basis, others, frozenset())
    start.decide(np.ones(errors.shape), form.factor != 0.0, judge)
    return _Counter(judge, until).count(start)


class _Counter:
    """Counts the bases of minors, within a number of divisions."""

    def __init__(self, judge: Judge, until: float) -> None:
        self.judge, self.until = judge, until
        self.divisions = self.factors = self.found = 0

    def count(self, minor: Minor) -> int:
        """The weighted number of bases."""
        product, parts = _components(minor)
        for part in parts:
            if product == 0:
                break
            self.divisions = self.factors = self.found = 0
            product *= self._connected(part)
        return product

    def _any(self, minor: Minor) -> int:
        factor, parts = _components(minor)
        return factor * math.prod(map(self._connected, parts))

    def _connected(self, minor: Minor) -> int:
        minor, is_changed = self._reduced(minor)
        if is_changed:
            return self._any(minor)
        pieces = minor.basis + minor.others
        held = min(minor.factor.shape)
        if held <= 2:
            # All pairs are independent, of the rows or of what is left out.
            count = _uniform(pieces, len(minor.basis))
            self.found += count
            return count
        self.divisions += 1
        self.factors += minor.factor.size
        # What hangs together has a basis for each exchange of one of it.
        least = max(self.found, minor.factor.size)
        is_much = self.divisions > _MOST_DIVISIONS or self.factors > _MOST_FACTORS
        if (least > _FOUND and is_much) or monotonic() > self.until:
            raise TooManyError
        i = int(np.argmin(np.count_nonzero(minor.factor, axis=1)))
        piece = minor.basis[i]
        with_it = piece.inside * self._any(minor.without((i,), ()))
        without = piece.outside * self._any(minor.deleted(i, self.judge)) if piece.outside else 0
        return with_it + without

    def _reduced(self, minor: Minor) -> tuple[Minor, bool]:
        """With pieces in parallel and in series put together, if there are any."""
        size, nonzero = np.abs(minor.factor), minor.factor != 0.0
        for is_row in (False, True) if minor.factor.size else ():
            single = np.flatnonzero(np.count_nonzero(nonzero, axis=int(is_row)) == 1).tolist()
            for k in single:
                if is_row:
                    j = int(np.argmax(size[k]))
                    minor.others[j] = in_series(minor.others[j], minor.basis[k])
                else:
                    i = int(np.argmax(size[:, k]))
                    minor.basis[i] = in_parallel(minor.basis[i], minor.others[k])
            if single:
                return _without_merged(minor, set(single), is_row), True
        for is_row, merge in ((False, in_parallel), (True, in_series)):
            pieces = minor.basis if is_row else minor.others
            gone: set[int] = set()
            for i, j in list(minor.alike(is_row, self.judge)):
                if i not in gone and j not in gone:
                    pieces[i] = merge(pieces[i], pieces[j])
                    gone.add(j)
            if gone:
                return _without_merged(minor, gone, is_row), True
        return minor, False


def _without_merged(minor: Minor, gone: set[int], is_row: bool) -> Minor:
    return minor.without(*((gone, ()) if is_row else ((), gone)), are_merged=True)


def _components(minor: Minor) -> tuple[int, list[Minor]]:
    """What lies in every basis or in none, as a factor, and the parts that hang together."""
    rows, columns = len(minor.basis), len(minor.others)
    pairs = np.argwhere(minor.factor != 0.0)
    group = groups_of(rows + columns, ((i, rows + j) for i, j in pairs.tolist()))
    sizes = np.bincount(group, minlength=rows + columns)
    ways = [piece.inside for piece in minor.basis] + [piece.outside for piece in minor.others]
    factor = math.prod(way for k, way in enumerate(ways) if sizes[group[k]] == 1)
    outside = [group != one for one in np.flatnonzero(sizes > 1)]
    return factor, [
        minor.without(*(set(np.flatnonzero(each).tolist()) for each in np.split(gone, [rows])))
        for gone in outside
    ]


def _uniform(pieces: list[Piece], size: int) -> int:
    """The weighted number of sets of a size."""
    sums = [1] + [0] * size
    for piece in pieces:
        for k in range(size, 0, -1):
            sums[k] = sums[k] * piece.outside + sums[k - 1] * piece.inside
        sums[0] *= piece.outside
    return sums[size]
