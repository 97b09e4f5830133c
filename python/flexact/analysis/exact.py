# SPDX-License-Identifier: BSD-3-Clause
"""Motions and self-stresses as fractions, from the echelon forms of D(c) modulo some primes.

The entries of the echelon form over the rationals are put together by the Chinese remainder
theorem, and found as fractions once there are primes enough (Wang, Guy and Davenport, SIGSAM
Bulletin 16, 1982). Two further primes must then give the same.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from ..core import calls
from ..core.raw import RawEchelon
from .decomposition import Decomposition
from .verdict import AnalysisError

Vector = tuple[Fraction, ...]
_Entries = dict[tuple[int, int], Fraction]

#: Rows or columns of D(c), and operations for all primes, some half a minute.
_LARGEST, _MOST_OPERATIONS = 1000, 3.0e10
#: Primes that took no part in what they check.
_CHECKS = 2


@dataclass(frozen=True)
class ExactBases:
    """Bases of both null spaces of D(c) over the rationals.

    Each vector is one where all others are zero. Two further random primes have given the same
    residues: a test of high probability, for which no bound is proven.

    Attributes:
        of: Of the "decimals" as they were typed, or of the "doubles" as they are stored.
        motions: Null vectors of D(c), in the order of `Analysis.column_labels`.
        self_stresses: Null vectors of its transpose, in the order of `Analysis.row_labels`,
            where each row of D(c) is multiplied by a positive number that makes it rational:
            lengths of vectors are roots. Of a bar that is its length, so that its entry is
            force over length.
        primes: So many were computed with.
    """

    of: str
    motions: tuple[Vector, ...]
    self_stresses: tuple[Vector, ...]
    primes: int


class _Lifted:
    """Entries of an echelon form modulo the product of some primes."""

    def __init__(self) -> None:
        """Modulo one, all are zero."""
        self.modulus = 1
        self.primes = 0
        self.pivots: tuple[int, ...] = ()
        self._residue: dict[tuple[int, int], int] = {}

    def add(self, echelon: RawEchelon) -> None:
        """Take in another prime, unless it divides a minor that the others do not divide."""
        mine, other = (-len(self.pivots), self.pivots), (-len(echelon.pivots), echelon.pivots)
        if self.primes and other > mine:
            return
        if other < mine:
            self.modulus, self.primes, self._residue = 1, 0, {}
        self.pivots = echelon.pivots
        inverse = pow(self.modulus, -1, echelon.prime)
        for key in self._residue.keys() | echelon.entries.keys():
            old = self._residue.get(key, 0)
            more = (echelon.entries.get(key, 0) - old) * inverse % echelon.prime
            self._residue[key] = old + self.modulus * more
        self.modulus *= echelon.prime
        self.primes += 1

    def fractions(self) -> _Entries | None:
        """The entries as fractions of numbers below the root of half the modulus, if they are."""
        most = math.isqrt(self.modulus // 2)
        found: _Entries = {}
        common: dict[int, int] = {}
        for (column, pivot), residue in self._residue.items():
            # Entries of one vector share most of their denominators.
            bottom = common.get(column, 1)
            top, factor = _fraction(residue * bottom % self.modulus, self.modulus, most)
            bottom *= factor
            if bottom > most:
                return None
            common[column] = bottom
            found[column, pivot] = Fraction(top, bottom)
        return found


def _fraction(residue: int, modulus: int, most: int) -> tuple[int, int]:
    """Top and bottom of a fraction with this residue, of which the top is at most `most`."""
    before, after = modulus, residue if 2 * residue <= modulus else residue - modulus
    bottom_before, bottom = 0, 1
    while abs(after) > most:
        quotient = before // after
        before, after = after, before - quotient * after
        bottom_before, bottom = bottom, bottom_before - quotient * bottom
    return (after, bottom) if bottom > 0 else (-after, -bottom)


def exact_bases(outcome: Decomposition) -> ExactBases:
    """Null vectors of D(c) and of its transpose over the rationals.

    Raises:
        AnalysisError: D(c) or the fractions are too large.
    """
    if max(outcome.rows, outcome.columns) > _LARGEST:
        raise AnalysisError(
            f"D(c) has {outcome.rows} rows and {outcome.columns} columns; vectors are given "
            f"as fractions up to {_LARGEST} of each"
        )
    motions, of, first = _basis(outcome, outcome.columns, is_transposed=False)
    stresses, of_stresses, second = _basis(outcome, outcome.rows, is_transposed=True)
    return ExactBases(of or of_stresses, motions, stresses, max(first, second))


def _basis(
    outcome: Decomposition, size: int, is_transposed: bool
) -> tuple[tuple[Vector, ...], str, int]:
    """Null vectors of one side, of what they are, and how many primes were taken."""
    if not size:
        return (), "", 0
    lifted, wanted, taken = _Lifted(), 1, 0
    for echelon in _echelons(outcome, size, is_transposed):
        taken += 1
        lifted.add(echelon)
        if lifted.primes < wanted:
            continue
        found = lifted.fractions()
        if found is not None:
            further = _echelons(outcome, size, is_transposed, -_CHECKS)
            if all(_agree(lifted.pivots, found, next(further)) for _ in range(_CHECKS)):
                of = "decimals" if echelon.as_typed else "doubles"
                return _vectors(size, lifted.pivots, found), of, taken + _CHECKS
        wanted = wanted + 1 + wanted // 3
    raise AnalysisError("the fractions have too many digits to be found in some half a minute")


def _echelons(
    outcome: Decomposition, size: int, is_transposed: bool, first: int = 0
) -> Iterator[RawEchelon]:
    """Echelon forms modulo one prime after the other."""
    operations = outcome.rows * outcome.columns * min(outcome.rows, outcome.columns)
    data = outcome.data
    for number in range(first, int(_MOST_OPERATIONS / max(operations, 1e6)) + 1):
        yield calls.find_echelon(data.packed, size, number, data.has_long_numbers, is_transposed)


def _agree(pivots: tuple[int, ...], found: _Entries, echelon: RawEchelon) -> bool:
    prime, entries = echelon.prime, echelon.entries
    return (
        pivots == echelon.pivots
        and entries.keys() <= found.keys()
        and all(
            (value.numerator - value.denominator * entries.get(key, 0)) % prime == 0
            for key, value in found.items()
        )
    )


def _vectors(size: int, pivots: tuple[int, ...], found: _Entries) -> tuple[Vector, ...]:
    """One vector for each column without a pivot."""
    free = sorted(set(range(size)) - set(pivots))
    made = {column: [Fraction(0)] * size for column in free}
    for column in free:
        made[column][column] = Fraction(1)
    for (column, pivot), value in found.items():
        made[column][pivot] = -value
    return tuple(tuple(made[column]) for column in free)
