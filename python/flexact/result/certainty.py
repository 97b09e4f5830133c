# SPDX-License-Identifier: BSD-3-Clause
"""How certain the rank of D(c) is, and what else could be true."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from enum import Enum
from typing import NamedTuple

import numpy as np

from .outcome import Outcome
from .rank_evidence import STORED, Evidence
from .verdict import Certainty, Nearly

#: Values up to this multiple of the noise are in doubt. The noise is what a rounding or two of
#: each number can do; a geometry that was itself computed (a loop closed by iteration, a scene
#: moved away and back) has lost some dozens of times that, and does not say so.
CLOSE = 100.0
_EPSILON = float(np.finfo(np.float64).eps)
#: Where motions and self-stresses of sound mechanisms both fade it is by 4 powers of ten at most;
#: where a tiny value counts as zero, by 10 and more.
_FADED = 7.0
#: Values up to this multiple of what half a unit of the last digits makes are in doubt: digits
#: may have been cut off, zeros at the end leave no trace, and the change is of first order.
_CUT_OFF = 2.0
#: A unit of a third digit moves a singular value by less than this; see `sensitivity`.
_REACH_OF_DIGITS = 0.1


class DoubtKind(str, Enum):
    """Why a decision is not certain."""

    UNCONFIRMED = "unconfirmed"
    """No second route confirmed the rank."""
    CLOSE_TO_NOISE = "close to noise"
    """Values count as non-zero that rounding may have made; `size`: the noise."""
    DIGITS_EXPLAIN = "digits explain"
    """Values count as non-zero that missing digits explain; `size`: what those may make."""
    COORDINATES_ROUNDED = "coordinates rounded"
    """Values up to `size` count as zero because the coordinates have few digits."""
    TOLERANCE_GIVEN = "tolerance given"
    """Values up to `size` count as zero because of the tolerance that was given."""
    DIGITS_MAY_LIFT = "digits may lift"
    """Zeros of the geometry as typed, of which missing digits may make `size`."""
    ZERO_ABOVE_STORING = "zero above storing"
    """Values up to `size` count as zero, which storing the geometry does not explain."""
    REMAINDER = "remainder"
    """Of a motion and a self-stress `size` is left, of which rounding makes `explained`."""
    FADING = "fading"
    """Motions and self-stresses fade through `size` powers of ten."""


_CODES = {
    DoubtKind.UNCONFIRMED: "unconfirmed-rank",
    DoubtKind.DIGITS_EXPLAIN: "rounded-geometry",
    DoubtKind.COORDINATES_ROUNDED: "rounded-coordinates",
    DoubtKind.TOLERANCE_GIVEN: "given-tolerance",
    DoubtKind.DIGITS_MAY_LIFT: "rounded-geometry",
}


class Doubt(NamedTuple):
    """A reason why the decision is not certain."""

    kind: DoubtKind
    values: int = 0
    """How many of the smallest singular values that count as non-zero may be zero."""
    size: float = 0.0
    explained: float = 0.0

    @property
    def code(self) -> str:
        """Code of the warning that reports it."""
        return _CODES.get(self.kind, "close-decision")


class Assessment(NamedTuple):
    """What is to be thought of a decision."""

    certainty: Certainty
    nearly: Nearly | None
    doubts: tuple[Doubt, ...]


def assess(outcome: Outcome, evidence: Evidence) -> Assessment:
    """Whether the decision is certain.

    It is in doubt where a value that counts as non-zero is close to the noise, or within
    reach of the digits that the geometry was typed with; where one that counts as zero is
    above the noise, or may be tiny (`rank_evidence`); and where the method has not confirmed
    the rank.
    """
    found = tuple(_doubts(outcome, evidence))
    if not found:
        return Assessment(Certainty.CERTAIN, None, ())
    rank = outcome.rank - max(doubt.values for doubt in found)
    nearly = Nearly(outcome.columns - rank, outcome.rows - rank)
    return Assessment(Certainty.NEARLY, nearly, found)


def _doubts(outcome: Outcome, evidence: Evidence) -> Iterator[Doubt]:
    if not outcome.raw.confirmed:
        yield Doubt(DoubtKind.UNCONFIRMED)
    if count := _nonzeros_up_to(outcome, CLOSE * outcome.raw.noise):
        yield Doubt(DoubtKind.CLOSE_TO_NOISE, count, outcome.raw.noise)
    yield from _explained_by_digits(outcome, evidence)
    yield from _zeros_above_noise(outcome)
    yield from _zeros_below_noise(outcome, evidence)


def _explained_by_digits(outcome: Outcome, evidence: Evidence) -> Iterator[Doubt]:
    reach = min(_REACH_OF_DIGITS, _CUT_OFF * outcome.raw.reach_of_digits)
    if not any(outcome.raw.pair_value <= reach):
        return
    every = evidence.pairs
    lifted = [pair for pair in every if pair.value <= _CUT_OFF * pair.lift_of_digits]
    if not lifted:
        return
    # Of more values than have vectors, those within the same reach are in doubt as well.
    reach = _CUT_OFF * max(pair.lift_of_digits for pair in lifted)
    count = max(every.index(lifted[-1]) + 1, len(lifted))
    if len(lifted) == len(every):
        count = max(count, _nonzeros_up_to(outcome, reach))
    yield Doubt(DoubtKind.DIGITS_EXPLAIN, count, reach)


def _zeros_above_noise(outcome: Outcome) -> Iterator[Doubt]:
    zero = outcome.gap.largest_zero
    if zero is None or zero <= outcome.raw.noise:
        return
    is_given = outcome.asked.tolerance is not None
    yield Doubt(DoubtKind.TOLERANCE_GIVEN if is_given else DoubtKind.COORDINATES_ROUNDED, size=zero)


def _zeros_below_noise(outcome: Outcome, evidence: Evidence) -> Iterator[Doubt]:
    """Zeros that are larger than storing the geometry makes them, or would not last.

    Those that the last digits typed could as well have lifted are zeros by chance, or because
    they are meant to be.
    """
    zero = outcome.gap.largest_zero
    if zero is None or not zero <= outcome.raw.noise:
        return
    if not (outcome.under_constrained and outcome.over_constrained):
        return
    yield from itertools.islice(_perhaps_tiny(outcome, evidence, zero), 1)
    if _CUT_OFF * outcome.raw.reach_of_digits <= outcome.raw.noise:
        return
    lifts = (pair.lift_of_digits for group in evidence.zero_pairs for pair in group)
    reach = _CUT_OFF * max(lifts, default=0.0)
    if reach > outcome.raw.noise:
        yield Doubt(DoubtKind.DIGITS_MAY_LIFT, size=reach)


def _perhaps_tiny(outcome: Outcome, evidence: Evidence, zero: float) -> Iterator[Doubt]:
    """Reasons to take a zero for a tiny value, the plainest first."""
    largest = max(outcome.scaled_singular_values[:1].max(initial=0.0), 1.0)
    computed = _EPSILON * max(outcome.rows, outcome.columns) * largest
    if zero > computed and zero > computed + _stored(evidence):
        yield Doubt(DoubtKind.ZERO_ABOVE_STORING, size=zero)
    left = evidence.largest_remainder
    if left and left.value > left.explained:
        yield Doubt(DoubtKind.REMAINDER, size=left.value, explained=left.explained)
    if evidence.powers_faded >= _FADED:
        yield Doubt(DoubtKind.FADING, size=evidence.powers_faded)


def _stored(evidence: Evidence) -> float:
    """What storing the geometry may make of the zeros."""
    lifts = (pair.lift_of_bits for group in evidence.zero_pairs for pair in group)
    return STORED * len(evidence.zero_pairs) * max(lifts, default=0.0)


def _nonzeros_up_to(outcome: Outcome, limit: float) -> int:
    """How many values that count as non-zero are not above a limit."""
    values = outcome.scaled_singular_values
    zeros = min(outcome.rows, outcome.columns) - outcome.rank
    return int(np.count_nonzero(values[: values.size - zeros] <= limit))
