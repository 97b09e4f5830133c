# SPDX-License-Identifier: BSD-3-Clause
"""Matrices with borders that make them regular, and the smallest singular values of large ones.

[A U; V' 0] is regular where U and V fill up what the rank of A leaves out, as null vectors do
(Govaerts, Numerical Methods for Bifurcations of Dynamical Equilibria, SIAM 2000). Small matrices
are in full, and numpy has all that they need; large ones are sparse, and scipy is loaded for them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from ..core.arrays import FloatArray, IndexArray
from ..util.loading import load

#: Row, column and value of the entries of a matrix; those of one place are added.
Entries = tuple[IndexArray, IndexArray, FloatArray]
#: In full, or as a `csc_array` of scipy.
Matrix = Any

#: Scaled singular values up to here are rounding.
_ROUNDING = 1.0e-13
#: Sparse matrices with more borders than this are factorised in full.
_MOST_BORDERS = 60


class Pattern:
    """Where entries of a sparse matrix are, so that it is made of their values alone."""

    def __init__(self, entries: Entries, shape: tuple[int, int]) -> None:
        """Sort them by columns."""
        self._row, self._column, _ = entries
        self._shape = shape
        places, self._slot = np.unique(self._column * shape[0] + self._row, return_inverse=True)
        column, self._index = np.divmod(places, shape[0])
        self._index = self._index.astype(np.int32)
        self._first = np.searchsorted(column, np.arange(shape[1] + 1)).astype(np.int32)

    def fits(self, entries: Entries) -> bool:
        """Whether others stand at the same places in the same order."""
        return all(map(np.array_equal, entries, (self._row, self._column)))

    def matrix(self, value: FloatArray) -> Matrix:
        """(m, n) with some values."""
        values = np.bincount(self._slot, value, self._index.size)
        made = load("scipy.sparse").csc_array((values, self._index, self._first), self._shape)
        made.has_canonical_format = True
        return made


class Bordered:
    """The matrix [A U; V' 0], factorised."""

    def __init__(self, matrix: Matrix, left: FloatArray, right: FloatArray) -> None:
        """Border a matrix (m, n) with columns (m, s) and (n, d), m + d = n + s.

        Raises:
            LinAlgError: It is singular, or not finite; of a small one where it is solved.
        """
        (m, s), (n, d) = left.shape, right.shape
        self._shape = (m, n)
        self._factor: _Sparse | _Dense | None = None
        if isinstance(matrix, np.ndarray):
            self._whole = np.zeros((m + d, n + s))
            self._whole[:m, :n] = matrix
        elif s + d > _MOST_BORDERS:
            self._whole = np.zeros((m + d, n + s))
            self._whole[:m, :n] = matrix.toarray()
        else:
            self._factor = _Sparse(matrix, left, right)
            return
        self._whole[:m, n:], self._whole[m:, :n] = left, right.T
        if not isinstance(matrix, np.ndarray):
            self._factor = _Dense(self._whole)

    def solved(self, top: FloatArray, below: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The x (n, ...) and g (s, ...) of A x + U g = `top`, V' x = `below`.

        Raises:
            LinAlgError: It is singular.
        """
        return self._solved(top, below, self._shape[1], is_transposed=False)

    def solved_transposed(
        self, top: FloatArray, below: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """The y (m, ...) and h (d, ...) of A' y + V h = `top`, U' y = `below`.

        Raises:
            LinAlgError: It is singular.
        """
        return self._solved(top, below, self._shape[0], is_transposed=True)

    def _solved(
        self, top: FloatArray, below: FloatArray, first: int, *, is_transposed: bool
    ) -> tuple[FloatArray, FloatArray]:
        known = np.concatenate((top, below))
        if self._factor is None:
            whole = self._whole.T if is_transposed else self._whole
            made: FloatArray = np.asarray(np.linalg.solve(whole, known), np.float64)
        else:
            made = self._factor.solved(known, is_transposed)
        return made[:first], made[first:]

    @property
    def sign(self) -> float:
        """Of its determinant."""
        if self._factor is None:
            return float(np.linalg.slogdet(self._whole)[0])
        return self._factor.sign


class _Sparse:
    """LU factors of a sparse matrix with borders."""

    def __init__(self, matrix: Matrix, left: FloatArray, right: FloatArray) -> None:
        (m, s), (n, d) = left.shape, right.shape
        # To each column d entries are added, and s columns.
        first = np.concatenate((matrix.indptr + d * np.arange(n + 1), np.full(s, m)))
        first[n + 1 :] = first[n] + m * np.arange(1, s + 1)
        index, value = np.empty(first[-1], np.int32), np.empty(first[-1])
        where = np.arange(matrix.nnz) + d * np.repeat(np.arange(n), np.diff(matrix.indptr))
        index[where], value[where] = matrix.indices, matrix.data
        below = first[1 : n + 1, None] - np.arange(d, 0, -1)
        index[below], value[below] = np.arange(m, m + d), right
        index[first[n] :], value[first[n] :] = np.tile(np.arange(m), s), left.T.ravel()
        if not np.isfinite(value).all():
            raise np.linalg.LinAlgError
        shape = m + d, n + s
        whole = load("scipy.sparse").csc_array((value, index, first.astype(np.int32)), shape)
        whole.has_canonical_format = True
        # SuperLU does not always see that.
        if load("scipy.sparse.csgraph").structural_rank(whole) < m + d:
            raise np.linalg.LinAlgError
        try:
            self._lu = load("scipy.sparse.linalg").splu(whole)
        except RuntimeError:
            raise np.linalg.LinAlgError from None

    def solved(self, known: FloatArray, is_transposed: bool) -> FloatArray:
        return np.asarray(self._lu.solve(known, "T" if is_transposed else "N"))

    @property
    def sign(self) -> float:
        negative = np.count_nonzero(self._lu.U.diagonal() < 0.0)
        return (-1.0) ** (negative + _swaps(self._lu.perm_r) + _swaps(self._lu.perm_c))


class _Dense:
    """LU factors of a matrix in full."""

    def __init__(self, whole: FloatArray) -> None:
        self._library = load("scipy.linalg")
        if not np.isfinite(whole).all():
            raise np.linalg.LinAlgError
        self._lu, self._swapped, info = self._library.lapack.dgetrf(whole, overwrite_a=True)
        if info:
            raise np.linalg.LinAlgError

    def solved(self, known: FloatArray, is_transposed: bool) -> FloatArray:
        factors = self._lu, self._swapped
        return np.asarray(self._library.lu_solve(factors, known, int(is_transposed)))

    @property
    def sign(self) -> float:
        swaps = np.count_nonzero(self._swapped != np.arange(self._swapped.size))
        return (-1.0) ** (np.count_nonzero(np.diagonal(self._lu) < 0.0) + swaps)


def _swaps(order: IndexArray) -> int:
    """The parity of a permutation: its length less its cycles."""
    graph = load("scipy.sparse").coo_array(
        (np.ones(order.size), (np.arange(order.size), order)), shape=(order.size, order.size)
    )
    cycles = load("scipy.sparse.csgraph").connected_components(graph, directed=False)[0]
    return int(order.size - cycles)


class Smallest(NamedTuple):
    """The smallest singular values of a matrix (m, n), with their vectors."""

    values: FloatArray
    """(k,) ascending; all of a small matrix."""
    many: int
    """How many singular values it has."""
    left: FloatArray
    """(m, s + p) orthonormal: what counts as null vectors of its transpose, then of p values."""
    right: FloatArray
    """(n, d + p) likewise of itself."""
    pairs: int
    """p."""
    beside: FloatArray
    """(n, ...) where vectors of further values are sought."""
    sign: float | None = None
    """Of the determinant of the matrix bordered with what counts as null vectors; None where it
    was not made."""
    passed: float | None = None
    """-1 where a value passed zero since the matrix that was the guess, else 1; None where the
    numbers of null vectors differ, or it is not known."""

    def rank(self, zero: float) -> int:
        """How many values are larger than one that counts as zero."""
        return self.many - int(np.searchsorted(self.values, zero, "right"))

    def value(self, index: int) -> float:
        """One of them by its index, from 0, in descending order."""
        return float(self.values[self.many - 1 - index])

    def is_clear(self, rank: int) -> bool:
        """Whether what the rank leaves out are zeros but for rounding."""
        return rank == self.many or self.value(rank) <= _ROUNDING

    def null(self, rank: int) -> tuple[FloatArray, FloatArray]:
        """(m, m - rank) and (n, n - rank), what counts as null vectors if the rank is that."""
        s, d = self.left.shape[1] - self.pairs, self.right.shape[1] - self.pairs
        more = self.many - rank - min(s, d)
        if more > self.pairs:
            raise np.linalg.LinAlgError
        return self.left[:, : s + more], self.right[:, : d + more]


#: How many of the smallest values of a sparse matrix are found beside those that count as zero.
KEPT = 6
#: Vectors of further values, which make those converge, new ones, and columns of a space at most.
_BESIDE, _NEW, _MOST_VECTORS = 6, 2, 160
#: What is left of a pair of vectors when it is found, as a part of the square of its value's
#: inverse: of the value the square of that is left.
_LEFT = 1.0e-7
Solved = Callable[[FloatArray, FloatArray], "tuple[FloatArray, FloatArray]"]
#: Values up to here that count as zero are far below all others.
_SURELY = 1.0e-9
#: How often borders are changed.
_MOST_CHANGES = 40


def smallest_of(matrix: Matrix, zero: float, guess: Smallest | None = None) -> Smallest:
    """The smallest singular values of a matrix (m, n): more than count as zero.

    Args:
        matrix: It.
        zero: Values up to here count as zero.
        guess: Of a matrix that differs little.

    A value of a sparse matrix that counts as zero is not passed over: the inverse of the bordered
    matrix enlarges whatever rounding has of its vectors by the ratio to the next at every step.
    """
    if isinstance(matrix, np.ndarray):
        values = np.linalg.svd(matrix, compute_uv=False)[::-1]
        none = np.zeros((0, 0))
        return Smallest(values, values.size, none, none, 0, none)
    try:
        found = _smallest_of_sparse(matrix, zero, guess)
    except np.linalg.LinAlgError:
        found = None
    if found is not None:
        return found
    left, values, right = np.linalg.svd(matrix.toarray())
    left, values, right = left[:, ::-1], values[::-1], right[::-1].T
    rank = int(np.count_nonzero(values > zero))
    return Smallest(values, values.size, left, right, rank, right[:, :0])


def _smallest_of_sparse(matrix: Matrix, zero: float, guess: Smallest | None) -> Smallest | None:
    """By inverse iteration; None where it does not converge."""
    (m, n), random, kept = matrix.shape, np.random.default_rng(0), KEPT
    if guess is None:
        rank = load("scipy.sparse.csgraph").structural_rank(matrix)
        left, right = (random.standard_normal((k, k - rank)) for k in (m, n))
        start = np.zeros((n, 0))
    else:
        left = guess.left[:, : guess.left.shape[1] - guess.pairs]
        right, start = np.split(guess.right, [guess.right.shape[1] - guess.pairs], axis=1)
        start = np.hstack([start[:, : KEPT + _BESIDE], guess.beside])
    first = True
    for _ in range(_MOST_CHANGES):
        borders = left, right
        try:
            factor = Bordered(matrix, left, right)
            right, strains = _null(factor.solved, matrix, right.shape[1])
            left, forces = _null(factor.solved_transposed, matrix.T, left.shape[1])
        except np.linalg.LinAlgError:
            # There are too few.
            more = max(1, min(left.shape[1], right.shape[1]))
            left, right = (
                np.hstack([each, random.standard_normal((each.shape[0], more))])
                for each in (left, right)
            )
            first = False
            continue
        over = max(int(np.count_nonzero(each > zero)) for each in (strains, forces))
        if over > min(left.shape[1], right.shape[1]):
            return None
        if over:
            left, right = left[:, : left.shape[1] - over], right[:, : right.shape[1] - over]
            first = False
            continue
        pairs = _pairs(factor, (left, right), start, kept, zero, random)
        if pairs is None:
            return None
        values, others, found = pairs
        more = int(np.searchsorted(values, zero, "right"))
        if not more:
            within = np.linalg.svd(left.T @ (matrix @ right), compute_uv=False)[::-1]
            # [A U; V' 0] is of other borders the determinant times two of small matrices.
            sign, turns = factor.sign, zip(borders, (left, right), strict=True)
            own = sign * math.prod(np.linalg.slogdet(a.T @ b)[0] for a, b in turns)
            return Smallest(
                np.concatenate((within, values)),
                min(m, n),
                np.hstack([left, others]),
                np.hstack([right, found[:, : values.size]]),
                values.size,
                found[:, values.size :],
                own,
                sign * guess.sign if guess is not None and guess.sign and first else None,
            )
        left, right = np.hstack([left, others[:, :more]]), np.hstack([right, found[:, :more]])
        start = found[:, more:] if found.shape[1] > more else start
        # Where all are zeros there may be many more.
        kept, first = 2 * kept if more >= kept else KEPT, False
    return None


def _null(solved: Solved, matrix: Matrix, many: int) -> tuple[FloatArray, FloatArray]:
    """Orthonormal columns that a matrix makes small, of a bordered one; and how small, ascending.

    Raises:
        LinAlgError: The bordered matrix is singular.
    """
    if not many:
        return np.zeros((matrix.shape[1], 0)), np.zeros(0)
    columns = solved(np.zeros((matrix.shape[0], many)), np.eye(many))[0]
    if not np.isfinite(columns).all():
        raise np.linalg.LinAlgError
    basis = np.linalg.qr(columns)[0]
    _, values, turned = np.linalg.svd(matrix @ basis, full_matrices=False)
    return np.asarray(basis @ turned[::-1].T), values[::-1]


def _pairs(
    factor: Bordered,
    null: tuple[FloatArray, FloatArray],
    start: FloatArray,
    kept: int,
    zero: float,
    random: np.random.Generator,
) -> tuple[FloatArray, FloatArray, FloatArray] | None:
    """The smallest singular values but those of null vectors, and left and right vectors.

    There are more of the right vectors, which may be those of further values. Where some are
    zeros, those alone, and only nearly. By the block Krylov space of the pseudoinverse and its
    transpose. None if it gets too large.
    """
    left, right = null

    def across(basis: FloatArray, vectors: FloatArray) -> FloatArray:
        return np.asarray(vectors - basis @ (basis.T @ vectors))

    given = start[:, : kept + _BESIDE]
    new = random.standard_normal((right.shape[0], max(_NEW, kept - given.shape[1])))
    beside = np.hstack([given, new])
    width = beside.shape[1]
    block = np.linalg.qr(across(right, across(right, beside)))[0]
    zeros = [np.zeros((each.shape[1], width)) for each in (right, left)]
    space, images = np.zeros((right.shape[0], 0)), np.zeros((left.shape[0], 0))
    most = min(max(_MOST_VECTORS, width), *(b.shape[0] - b.shape[1] for b in null))
    while space.shape[1] + width <= most:
        image = factor.solved_transposed(across(right, block), zeros[1])[0]
        image = across(left, image)
        space, images = np.hstack([space, block]), np.hstack([images, image])
        ahead = across(right, factor.solved(image, zeros[0])[0])
        if not np.isfinite(ahead).all():
            return None
        squares, shares = np.linalg.eigh(images.T @ images)
        zeros_here = int(np.count_nonzero(squares * min(zero, _SURELY) ** 2 >= 1.0))
        if zeros_here:
            # Beside these nothing else is seen.
            others, inverse, _ = np.linalg.svd(images, full_matrices=False)
            found = np.linalg.svd(ahead, full_matrices=False)[0]
            zeros_here = min(zeros_here, found.shape[1])
            return 1.0 / inverse[:zeros_here], others[:, :zeros_here], found[:, :zeros_here]
        block, rest = np.linalg.qr(across(space, across(space, ahead)))
        # What is left may be rounding, which need not be across.
        block = np.linalg.qr(across(right, across(space, block)))[0]
        left_over = np.linalg.norm(rest @ shares[-width:, -kept:], axis=0)
        if np.all(left_over <= _LEFT * squares[-kept:]):
            others, inverse, turned = np.linalg.svd(images, full_matrices=False)
            with np.errstate(divide="ignore"):
                found = space @ turned[: kept + _BESIDE].T
                return 1.0 / inverse[:kept], others[:, :kept], found
    return None
