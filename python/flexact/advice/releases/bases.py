# SPDX-License-Identifier: BSD-3-Clause
"""How many sets of rows of a matrix are bases: sets of k rows whose k x k block is regular.

The rows are taken as a matroid. It is brought to echelon form on a well-conditioned set of rows;
what is in parallel or in series is put together, what does not hang together is counted apart,
and the rest is divided into the bases that hold a row and those that do not (deletion and
contraction; Oxley, Matroid Theory, 2011, ch. 3 and 5). Each leaf of that tree is a basis at
least, so that the work is bounded by the count.
"""

from __future__ import annotations

import numpy as np

from ...core.arrays import FloatArray
from ...model.parts.bodies import groups_of
from .echelon import echelon_of
from .matroid import (
    CLEAR,
    FAIR,
    LARGE,
    ZERO,
    Judge,
    Minor,
    Piece,
    TooManyError,
    in_parallel,
    in_series,
    is_regular,
)

#: Bases found on the way beyond which little more is done: so many divisions of a matroid that
#: hangs together, and so many factors of what is divided. Of fewer all are counted.
_FOUND, _MOST_DIVISIONS, _MOST_FACTORS = 20_000, 600, 300_000


def count_bases(matrix: FloatArray, error: float, judge: Judge) -> int:
    """How many sets of k rows of a matrix (n, k) have a regular block.

    Args:
        matrix: Rows of an orthonormal basis of a space.
        error: By how much its entries may be off.
        judge: Asked about the sets of which the numbers do not tell.

    Raises:
        TooManyError: there are more than can be counted.
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
    return _Counter(judge).count(start.cleared(judge))


class _Counter:
    """Counts the bases of minors, within a number of divisions."""

    def __init__(self, judge: Judge) -> None:
        self.judge = judge
        self.divisions = self.factors = self.found = 0

    def count(self, minor: Minor) -> int:
        """The weighted number of bases."""
        product = 1
        factor, parts = _components(minor)
        product *= factor
        for part in parts:
            if product == 0:
                break
            self.divisions = self.factors = self.found = 0
            product *= self._connected(part)
        return product

    def _any(self, minor: Minor) -> int:
        product, parts = _components(minor)
        for part in parts:
            product *= self._connected(part)
        return product

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
        if least > _FOUND and is_much:
            raise TooManyError
        i = int(np.argmin(np.count_nonzero(minor.factor, axis=1)))
        piece = minor.basis[i]
        with_it = piece.inside * self._any(minor.without(np.array([i]), np.array([], np.int64)))
        without = piece.outside * self._any(minor.deleted(i, self.judge)) if piece.outside else 0
        return with_it + without

    def _reduced(self, minor: Minor) -> tuple[Minor, bool]:
        """With pieces in parallel and in series put together, if there are any."""
        single = np.argwhere(np.count_nonzero(minor.factor, axis=0) == 1).ravel()
        if single.size and minor.factor.size:
            gone = set()
            for j in single.tolist():
                i = int(np.argmax(np.abs(minor.factor[:, j])))
                minor.basis[i] = in_parallel(minor.basis[i], minor.others[j])
                gone.add(j)
            return _merged(minor, gone, False), True
        single = np.argwhere(np.count_nonzero(minor.factor, axis=1) == 1).ravel()
        if single.size and minor.factor.size:
            gone = set()
            for i in single.tolist():
                j = int(np.argmax(np.abs(minor.factor[i])))
                minor.others[j] = in_series(minor.others[j], minor.basis[i])
                gone.add(i)
            return _merged(minor, gone, True), True
        for is_row, merge in ((False, in_parallel), (True, in_series)):
            pieces = minor.basis if is_row else minor.others
            gone = set()
            for i, j in list(minor.alike(is_row, self.judge)):
                if i not in gone and j not in gone:
                    pieces[i] = merge(pieces[i], pieces[j])
                    gone.add(j)
            if gone:
                return _merged(minor, gone, is_row), True
        return minor, False


def _merged(minor: Minor, gone: set[int], is_row: bool) -> Minor:
    """Without pieces that were put into others."""
    pieces = minor.basis if is_row else minor.others
    kept = [k for k in range(len(pieces)) if k not in gone]
    left = [pieces[k] for k in kept]
    if is_row:
        return Minor(minor.factor[kept], minor.error[kept], left, minor.others, minor.chosen)
    return Minor(minor.factor[:, kept], minor.error[:, kept], minor.basis, left, minor.chosen)


def _components(minor: Minor) -> tuple[int, list[Minor]]:
    """What lies in every basis or in none, as a factor, and the parts that hang together."""
    rows, columns = len(minor.basis), len(minor.others)
    pairs = np.argwhere(minor.factor != 0.0)
    group = groups_of(rows + columns, ((i, rows + j) for i, j in pairs.tolist()))
    factor, parts = 1, []
    sizes = np.bincount(group, minlength=rows + columns)
    for k, piece in enumerate(minor.basis):
        if sizes[group[k]] == 1:
            factor *= piece.inside
    for k, piece in enumerate(minor.others):
        if sizes[group[rows + k]] == 1:
            factor *= piece.outside
    for one in np.flatnonzero(sizes > 1).tolist():
        mine = group == one
        parts.append(minor.without(np.flatnonzero(~mine[:rows]), np.flatnonzero(~mine[rows:])))
    return factor, parts


def _uniform(pieces: list[Piece], size: int) -> int:
    """The weighted number of sets of a size."""
    sums = [1] + [0] * size
    for piece in pieces:
        for k in range(size, 0, -1):
            sums[k] = sums[k] * piece.outside + sums[k - 1] * piece.inside
        sums[0] *= piece.outside
    return sums[size]
