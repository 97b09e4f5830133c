# SPDX-License-Identifier: BSD-3-Clause
"""Exact counts of a deck: the rank of D(c) modulo two random primes near 2**61.

The rank modulo a prime is never above the rank, and below it only where the prime divides all
minors of that size: for decks of this kind, made without regard to it, less than once in 10**13
times, theory.md (17) and (18).
"""

from __future__ import annotations

import random
from fractions import Fraction
from functools import cache
from typing import NamedTuple

from .exact_deck import Deck, Label, read
from .exact_rows import Row, rows_of

#: One row: entries that are not zero, by column.
SparseRow = dict[int, int]
_SEED = 20240229
#: With these bases the test of Miller and Rabin is a proof below 2**64.
_BASES = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37)


class Counts(NamedTuple):
    """Motions and self-stresses: columns and rows of D(c), each less the rank."""

    under_constrained: int
    over_constrained: int


def counts_of_text(text: str) -> Counts:
    """Exact counts of a deck as it is typed."""
    return counts_of(read(text))


def counts_of(deck: Deck) -> Counts:
    """Exact counts of a deck."""
    columns = deck.columns()
    found = []
    for prime in primes():
        matrix = residues(deck, columns, prime)
        found.append((len(matrix), rank(matrix, prime)))
    height, best = max(found)
    return Counts(len(columns) - best, height - best)


def residues(deck: Deck, columns: dict[Label, int], prime: int) -> list[SparseRow]:
    """The rows of D(c) modulo a prime."""

    def residue(number: Fraction) -> int:
        bottom = number.denominator
        if bottom == 1:
            return number.numerator % prime
        return number.numerator * pow(bottom, -1, prime) % prime

    every = rows_of(deck, residue)
    return [_sparse(nodes, row, columns, prime) for _, nodes, row in every]


def rank(matrix: list[SparseRow], prime: int) -> int:
    """Rank by elimination, the shortest row first; the rows are used up."""
    left = [row for row in matrix if row]
    found = 0
    while left:
        pivot = min(left, key=len)
        left.remove(pivot)
        found += 1
        column = _rarest(pivot, left)
        scale = -pow(pivot.pop(column), -1, prime)
        parts = [(j, value * scale % prime) for j, value in pivot.items()]
        for row in left:
            factor = row.pop(column, 0)
            if factor:
                _add(row, parts, factor, prime)
        left = [row for row in left if row]
    return found


def _add(row: SparseRow, parts: list[tuple[int, int]], factor: int, prime: int) -> None:
    for j, value in parts:
        total = (row.get(j, 0) + factor * value) % prime
        if total:
            row[j] = total
        else:
            row.pop(j, None)


def _rarest(pivot: SparseRow, left: list[SparseRow]) -> int:
    """The column of a row that fewest others have."""
    if len(pivot) == 1:
        return next(iter(pivot))
    return min(pivot, key=lambda column: sum(column in row for row in left))


def _sparse(
    nodes: tuple[int, ...], row: Row[int], columns: dict[Label, int], prime: int
) -> SparseRow:
    made: SparseRow = {}
    for node, block in zip(nodes, row, strict=True):
        for axis, value in enumerate(block):
            column = columns.get((node, axis))
            if value and column is not None:
                made[column] = (made.get(column, 0) + value) % prime
    return {column: value for column, value in made.items() if value}


@cache
def primes(seed: int = _SEED) -> tuple[int, int]:
    """Two primes between 2**60 and 2**61."""
    chance = random.Random(seed)
    found: list[int] = []
    while len(found) < 2:
        number = chance.randrange(2**60 + 1, 2**61, 2)
        if is_prime(number) and number not in found:
            found.append(number)
    return found[0], found[1]


def is_prime(number: int) -> bool:
    """Whether an odd number between 37 and 2**64 is a prime."""
    odd, twos = number - 1, 0
    while odd % 2 == 0:
        odd, twos = odd // 2, twos + 1
    return all(_may_be_prime(number, base, odd, twos) for base in _BASES)


def _may_be_prime(number: int, base: int, odd: int, twos: int) -> bool:
    power = pow(base, odd, number)
    if power in (1, number - 1):
        return True
    for _ in range(twos - 1):
        power = power * power % number
        if power == number - 1:
            return True
    return False
