# SPDX-License-Identifier: BSD-3-Clause
"""Rows as a matroid, in terms of a basis: what is in parallel, in series, or taken out.

An entry is taken for zero where rounding explains it, and for another number where it is far
above that; in between somebody else is asked.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import FloatArray

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

    def cleared(self, judge: Judge) -> Minor:
        """With zeros where entries are none."""
        self.decide(np.ones(self.factor.shape), self.factor != 0.0, judge)
        return self

    def decide(self, size: FloatArray, looked_at: NDArray[np.bool_], judge: Judge) -> None:
        """Put zeros where entries are zero; they are differences of numbers of a size."""
        value = np.abs(self.factor)
        limit = np.minimum(ZERO * self.error, _TINY * size)
        is_zero = looked_at & (value <= limit)
        is_clear = value >= np.maximum(CLEAR * self.error, LARGE * size)
        for i, j in np.argwhere(looked_at & ~is_zero & ~is_clear).tolist():
            is_fair = bool(value[i, j] >= max(CLEAR * self.error[i, j], FAIR * size[i, j]))
            is_zero[i, j] = not is_regular(judge, self.exchanged((i,), (j,)), is_fair)
        self.factor[is_zero] = 0.0

    def without(self, rows: NDArray[np.integer], columns: NDArray[np.integer]) -> Minor:
        """Without some pieces, of the basis and of the others, that are decided elsewhere."""
        gone = set(rows.tolist()), set(columns.tolist())
        basis = [piece for k, piece in enumerate(self.basis) if k not in gone[0]]
        others = [piece for k, piece in enumerate(self.others) if k not in gone[1]]
        left_rows = np.setdiff1d(np.arange(len(self.basis)), rows)
        left_columns = np.setdiff1d(np.arange(len(self.others)), columns)
        chosen = self.chosen.union(
            *(self.basis[k].taken for k in gone[0]), *(self.others[k].left for k in gone[1])
        )
        some = np.ix_(left_rows, left_columns)
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
        return minor.without(np.array([], np.int64), np.array([j]))

    def alike(self, is_row: bool, judge: Judge) -> Iterator[tuple[int, int]]:
        """Pairs of rows or of columns of the factors that are multiples of each other."""
        factor = self.factor if is_row else self.factor.T
        by_support: dict[bytes, list[int]] = {}
        for k in range(len(factor)):
            by_support.setdefault((factor[k] != 0.0).tobytes(), []).append(k)
        for same in by_support.values():
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
