# SPDX-License-Identifier: BSD-3-Clause
"""The counts that may be meant instead of those that were found, and what change leads there.

See theory.md (28) and (29).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

from .decomposition import Outcome
from .margin import margin_of
from .rank_evidence import Evidence
from .verdict import Alternative, Margin

#: So many are given.
_MOST = 3


def alternatives_of(
    outcome: Outcome, evidence: Evidence, lower: int, higher: int
) -> tuple[Alternative, ...]:
    """The counts that may hold instead, likeliest first, at most three.

    Args:
        outcome: What was found.
        evidence: What may be made of its singular values.
        lower: How many of the smallest values that count as non-zero may be zero.
        higher: How many of the largest that count as zero may not be.
    """
    ranks = [rank for rank in _ranks(outcome, evidence, lower, higher) if rank != outcome.rank]
    return tuple(_alternative(outcome, evidence, rank) for rank in dict.fromkeys(ranks))[:_MOST]


def _ranks(outcome: Outcome, evidence: Evidence, lower: int, higher: int) -> Iterator[int]:
    """All values in doubt; then as many as stand together, the widest gap above them first."""
    if lower:
        yield outcome.rank - lower
    if higher:
        yield outcome.rank + higher
    if outcome.proof:
        yield outcome.proof.rank
    if higher > outcome.raw.fading > 0:
        yield outcome.rank + higher - outcome.raw.fading
    if not lower and not higher and (not outcome.proof or outcome.proof.rank == outcome.rank):
        return
    for k in _groups([pair.value for pair in evidence.pairs[:lower]]):
        yield outcome.rank - k
    if outcome.proof:
        higher = max(higher, outcome.proof.rank - outcome.rank)
    below = outcome.scaled_singular_values.size + outcome.rank - min(outcome.rows, outcome.columns)
    zeros = outcome.scaled_singular_values[max(below, 0) :][:higher]
    for k in _groups([1.0 / value if value else math.inf for value in zeros.tolist()]):
        yield outcome.rank + k


def _groups(ascending: list[float]) -> list[int]:
    """How many of the first values stand together, the widest gap above them first."""
    gaps = [
        after / before if 0.0 < before < math.inf else 0.0
        for before, after in itertools.pairwise(ascending)
    ]
    return sorted(range(1, len(gaps) + 1), key=lambda k: -gaps[k - 1])


def _alternative(outcome: Outcome, evidence: Evidence, rank: int) -> Alternative:
    counts = (outcome.columns - rank, outcome.rows - rank)
    if rank > outcome.rank:
        # The numbers as they are say so, or nothing is known of how far they are from it.
        return Alternative(*counts, 0.0, 0.0)
    needed = evidence.pairs[: outcome.rank - rank]
    every = [margin_of(outcome, pair, pair.value) for pair in needed]
    return Alternative(*counts, *_all_of(every))


def _all_of(margins: list[Margin]) -> tuple[float | None, float | None]:
    """A length and an angle by which each of some values is brought to zero."""
    lengths = [margin.length for margin in margins]
    angles = [margin.angle for margin in margins]
    return _largest(lengths), _largest(angles)


def _largest(sizes: list[float | None]) -> float | None:
    known = [size for size in sizes if size is not None]
    return max(known) if known and len(known) == len(sizes) else None
