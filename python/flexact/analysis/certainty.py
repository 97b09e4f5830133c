# SPDX-License-Identifier: BSD-3-Clause
"""How certain the rank of D(c) is, and how far from another verdict: theory.md (22) to (29)."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator
from enum import Enum
from typing import NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from .decomposition import Decomposition
from .limits import CLEARLY, CUT_OFF, FADED, NEAR, NO_CHANGE, REACH_OF_DIGITS, STORED
from .rank_evidence import Evidence, Pair, largest_remainder, powers_faded
from .verdict import Alternative, Certainty, Margin

_NO_MARGIN = Margin(None, None, None, None, None)


def margins(outcome: Decomposition, evidence: Evidence) -> tuple[Margin, ...]:
    """One for each zero, at most 8, then one for each of the smallest other singular values.

    To first order: a value that is not zero is brought to zero by `value / change`, a zero
    above what can be told from zero likewise. A motion without self-stress, or a self-stress
    without motion, belongs to no singular value and is not lifted.
    """
    zeros = (_of_zero(outcome, group) for group in evidence.zero_pairs)
    others = (margin_of(outcome, pair, pair.value) for pair in evidence.pairs)
    return (*zeros, *others)


def _of_zero(outcome: Decomposition, group: tuple[Pair, ...]) -> Margin:
    """Of a zero that something lifts: none, but where a tolerance says what counts as zero.

    What else tells a value from zero is rounding, and no length of a machine.
    """
    noise, tolerance = outcome.raw.noise, outcome.asked.tolerance or 0.0
    told = max(tolerance, noise)
    found = least(margin_of(outcome, pair, told) for pair in group)
    found = found._replace(singular_value=group[0].value)
    if tolerance > noise or (found.length is None and found.angle is None):
        return found
    return found._replace(
        length=None if found.length is None else 0.0,
        angle=None if found.angle is None else 0.0,
        exact_alignment=True,
    )


def margin_of(outcome: Decomposition, pair: Pair, distance: float) -> Margin:
    """The misalignments that change the value of a pair by `distance`, to first order."""
    moves = pair.by_move * outcome.characteristic_length > NO_CHANGE
    turns = pair.by_turn > NO_CHANGE
    length = distance / pair.by_move if moves else math.inf
    angle = distance / pair.by_turn if turns else math.inf
    return Margin(
        length=length if math.isfinite(length) else None,
        angle=angle if math.isfinite(angle) else None,
        node=pair.node if math.isfinite(length) else None,
        element=pair.element if math.isfinite(angle) else None,
        singular_value=pair.value,
    )


def least_misalignments(
    values: FloatArray, by_move: FloatArray, by_turn: FloatArray, characteristic_length: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The least of `margin_of` over the pairs of each of many variants.

    Args:
        values: (variants, pairs) singular values that are not zero; NaN where there is none.
        by_move: (variants, pairs) what each changes by the move of one node [1/m].
        by_turn: (variants, pairs) by the turn of one element [1/rad].
        characteristic_length: (variants,) [m].

    Returns:
        Lengths [m] and angles [rad], (variants,) each; infinite where none changes a value.
    """
    moves = by_move * characteristic_length[:, None] > NO_CHANGE
    turns = by_turn > NO_CHANGE
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        lengths = np.where(moves, values / by_move, np.inf)
        angles = np.where(turns, values / by_turn, np.inf)
    return lengths.min(axis=1, initial=np.inf), angles.min(axis=1, initial=np.inf)


def least(of: Iterable[Margin]) -> Margin:
    """The smallest length and the smallest angle, each with its place."""
    every = list(of)
    every = [item for item in every if item.exact_alignment] or every
    by_length = min(every, key=lambda item: _last(item.length), default=_NO_MARGIN)
    by_angle = min(every, key=lambda item: _last(item.angle), default=_NO_MARGIN)
    first = by_length if by_angle.angle is None else by_angle
    return Margin(
        by_length.length,
        by_angle.angle,
        by_length.node,
        by_angle.element,
        first.singular_value,
        first.exact_alignment,
    )


def _last(misalignment: float | None) -> float:
    return math.inf if misalignment is None else misalignment


#: So many are given.
_MOST = 3
_EPSILON = float(np.finfo(np.float64).eps)


def alternatives_of(
    outcome: Decomposition, evidence: Evidence, lower: int, higher: int
) -> tuple[Alternative, ...]:
    """The counts that may hold instead, likeliest first, at most three.

    Args:
        outcome: What was found.
        evidence: What may be made of its singular values.
        lower: How many of the smallest values that count as non-zero may be zero.
        higher: How many of the largest that count as zero may not be.
    """
    ranks = [rank for rank in _ranks(outcome, evidence, lower, higher) if rank != outcome.rank]
    made = []
    for rank in list(dict.fromkeys(ranks))[:_MOST]:
        # Above, the numbers as they are say so, or nothing is known of how far they are from it.
        sizes: list[float | None] = [0.0, 0.0]
        if rank < outcome.rank:
            pairs = evidence.pairs[: outcome.rank - rank]
            needed = [margin_of(outcome, pair, pair.value) for pair in pairs]
            sizes = [_largest([m.length for m in needed]), _largest([m.angle for m in needed])]
        made.append(Alternative(outcome.columns - rank, outcome.rows - rank, *sizes))
    return tuple(made)


def _largest(sizes: list[float | None]) -> float | None:
    """The size that brings all of some values to zero; None where one is not known."""
    known = [size for size in sizes if size is not None]
    return max(known) if known and len(known) == len(sizes) else None


def _ranks(outcome: Decomposition, evidence: Evidence, lower: int, higher: int) -> Iterator[int]:
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


class DoubtKind(str, Enum):
    """Why a decision is not certain."""

    UNCONFIRMED = "unconfirmed"
    """No second route confirmed the rank."""
    CLOSE_TO_NOISE = "close to noise"
    """Values count as non-zero that storing the geometry may have made; `size`: the largest."""
    DIGITS_EXPLAIN = "digits explain"
    """Values count as non-zero that missing digits explain; `size`: what those may make."""
    COORDINATES_ROUNDED = "coordinates rounded"
    """Values up to `size` count as zero because the coordinates have few digits."""
    TOLERANCE_GIVEN = "tolerance given"
    """Values up to `size` count as zero because of the tolerance that was given."""
    UNSEEN = "unseen"
    """`values` are not zero in exact arithmetic, but too small for any digits that are computed."""
    UNDECIDED = "undecided"
    """`values` that count as zero are not zero for the numbers as they are, but may be meant."""
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
}


class Doubt(NamedTuple):
    """A reason why the decision is not certain."""

    kind: DoubtKind
    values: int = 0
    """How many of the smallest singular values that count as non-zero may be zero."""
    zeros: int = 0
    """How many of the largest that count as zero may not be."""
    size: float = 0.0
    explained: float = 0.0

    @property
    def code(self) -> str:
        """Code of the warning that reports it."""
        return _CODES.get(self.kind, "close-decision")


class Assessment(NamedTuple):
    """What is to be thought of a decision."""

    certainty: Certainty
    alternatives: tuple[Alternative, ...]
    doubts: tuple[Doubt, ...]


def assess(outcome: Decomposition, evidence: Evidence) -> Assessment:
    """Whether the decision is certain.

    It is in doubt where a value that counts as non-zero is within reach of how the geometry
    was stored or typed, so that a change within the last digit would lower the rank; where
    one that counts as zero is above the noise, or is not zero for the numbers as they are;
    and where neither exact arithmetic nor the method has confirmed the rank. Of a certain one
    whose rank is not that of the numbers to the last digit, (22), the latter has the alternative.
    """
    found = tuple(_doubts(outcome, evidence))
    if not found:
        return Assessment(Certainty.CERTAIN, alternatives_of(outcome, evidence, 0, 0)[:1], ())
    lower = max(doubt.values for doubt in found)
    higher = max(doubt.zeros for doubt in found)
    return Assessment(Certainty.DOUBTFUL, alternatives_of(outcome, evidence, lower, higher), found)


def _doubts(outcome: Decomposition, evidence: Evidence) -> Iterator[Doubt]:
    raw = outcome.raw
    is_proven = raw.proven_rank == outcome.rank
    if not (raw.confirmed or is_proven):
        yield Doubt(DoubtKind.UNCONFIRMED, values=1)
    yield from _close_to_noise(outcome, evidence)
    yield from _explained_by_digits(outcome, evidence)
    if raw.unseen:
        yield Doubt(DoubtKind.UNSEEN, values=raw.unseen)
    if raw.undecided:
        yield Doubt(
            DoubtKind.UNDECIDED, zeros=raw.undecided, size=raw.left, explained=raw.explained
        )
    if not is_proven:
        yield from _zeros_above_noise(outcome)
        zero = outcome.gap.largest_zero
        is_below = zero is not None and zero <= raw.noise
        if raw.unjudged and is_below and outcome.under_constrained and outcome.over_constrained:
            # Zeros that may be tiny, where nothing but the decomposition has seen them.
            yield from itertools.islice(_perhaps_tiny(outcome, evidence, zero or 0.0), 1)


def _close_to_noise(outcome: Decomposition, evidence: Evidence) -> Iterator[Doubt]:
    near = _nonzeros_up_to(outcome, NEAR * outcome.raw.noise)
    if not near:
        return
    looked_at = evidence.pairs[:near]
    close = [pair for pair in looked_at if pair.value <= CLEARLY * pair.lift_of_storing]
    count = looked_at.index(close[-1]) + 1 if close else 0
    if near > len(looked_at) and count == len(looked_at):
        count = near
    if count:
        size = max((pair.lift_of_storing for pair in close), default=outcome.raw.noise)
        yield Doubt(DoubtKind.CLOSE_TO_NOISE, values=count, size=size)


def _explained_by_digits(outcome: Decomposition, evidence: Evidence) -> Iterator[Doubt]:
    reach = min(REACH_OF_DIGITS, CUT_OFF * outcome.raw.reach_of_digits)
    if not any(outcome.raw.pair_value <= reach):
        return
    every = evidence.pairs
    lifted = [pair for pair in every if pair.value <= CUT_OFF * pair.lift_of_digits]
    if not lifted:
        return
    # Of more values than have vectors, those within the same reach are in doubt as well.
    reach = CUT_OFF * max(pair.lift_of_digits for pair in lifted)
    count = max(every.index(lifted[-1]) + 1, len(lifted))
    if len(lifted) == len(every):
        count = max(count, _nonzeros_up_to(outcome, reach))
    yield Doubt(DoubtKind.DIGITS_EXPLAIN, values=count, size=reach)


def _zeros_above_noise(outcome: Decomposition) -> Iterator[Doubt]:
    zero = outcome.gap.largest_zero
    if zero is None or zero <= outcome.raw.noise:
        return
    is_given = outcome.asked.tolerance is not None
    kind = DoubtKind.TOLERANCE_GIVEN if is_given else DoubtKind.COORDINATES_ROUNDED
    values = outcome.scaled_singular_values
    above = int(np.count_nonzero(values > outcome.raw.noise))
    rank = max(above + min(outcome.rows, outcome.columns) - values.size, outcome.raw.proven_rank)
    yield Doubt(kind, zeros=max(1, rank - outcome.rank), size=zero)


def _perhaps_tiny(outcome: Decomposition, evidence: Evidence, zero: float) -> Iterator[Doubt]:
    """Reasons to take a zero for a tiny value, the plainest first."""
    zeros = min(outcome.under_constrained, outcome.over_constrained)
    largest = max(outcome.scaled_singular_values[:1].max(initial=0.0), 1.0)
    computed = _EPSILON * max(outcome.rows, outcome.columns) * largest
    # What storing the geometry may make of the zeros.
    lifts = (pair.lift_of_bits for group in evidence.zero_pairs for pair in group)
    if zero > computed and zero > computed + STORED * len(evidence.zero_pairs) * max(
        lifts, default=0.0
    ):
        yield Doubt(DoubtKind.ZERO_ABOVE_STORING, zeros=zeros, size=zero)
    left, explained = largest_remainder(outcome) or (0.0, 0.0)
    if left > explained:
        yield Doubt(DoubtKind.REMAINDER, zeros=zeros, size=left, explained=explained)
    # Through which a motion and a self-stress fade, the less of the two.
    raw = outcome.raw
    powers = min(
        powers_faded(raw.motions, raw.column_scale), powers_faded(raw.stresses, raw.row_scale)
    )
    if powers >= FADED:
        yield Doubt(DoubtKind.FADING, zeros=zeros, size=powers)


def _nonzeros_up_to(outcome: Decomposition, limit: float) -> int:
    """How many values that count as non-zero are not above a limit."""
    values = outcome.scaled_singular_values
    zeros = min(outcome.rows, outcome.columns) - outcome.rank
    return int(np.count_nonzero(values[: values.size - zeros] <= limit))
