"""How certain the rank of D(c) is, and what else could be true."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from . import fading
from .verdict import Certainty, Nearly

if TYPE_CHECKING:
    from .analysis import Analysis

#: Values up to this multiple of the noise are in doubt. The noise is what a rounding or two of
#: each number can do; a geometry that was itself computed (a loop closed by iteration, a scene
#: moved away and back) has lost some dozens of times that, and does not say so.
_CLOSE = 100.0
_EPSILON = float(np.finfo(np.float64).eps)
#: Where motions and self-stresses of sound mechanisms both fade it is by 4 powers of ten at most;
#: where a tiny value counts as zero, by 10 and more.
_FADED = 7.0
#: Values up to this multiple of what half a unit of the last digits makes are in doubt: digits
#: may have been cut off, zeros at the end leave no trace, and the change is of first order.
_CUT_OFF = 2.0
#: A unit of a third digit moves a singular value by less than this; see `flexact.pairs`.
_REACH_OF_DIGITS = 0.1


class Doubt(NamedTuple):
    """A reason why the decision is not certain."""

    code: str
    """Code of the warning."""
    sentence: str
    help: str
    values: int
    """So many of the smallest singular values that count as non-zero may be zero."""


class Assessment(NamedTuple):
    """What is to be thought of a decision."""

    certainty: Certainty
    nearly: Nearly | None
    doubts: tuple[Doubt, ...]


def assess(analysis: Analysis) -> Assessment:
    """Whether the decision is certain.

    It is in doubt where a value that counts as non-zero is close to the noise, or within
    reach of the digits that the geometry was typed with; where one that counts as zero is
    above the noise, or may be tiny (`flexact.fading`); and where the method has not confirmed
    the rank.
    """
    found = tuple(_doubts(analysis))
    if not found:
        return Assessment(Certainty.CERTAIN, None, ())
    rank = analysis.rank - max(doubt.values for doubt in found)
    nearly = Nearly(analysis.columns - rank, analysis.rows - rank)
    return Assessment(Certainty.NEARLY, nearly, found)


def _doubts(analysis: Analysis) -> Iterator[Doubt]:
    yield from _unconfirmed(analysis)
    yield from _close_to_noise(analysis)
    yield from _explained_by_digits(analysis)
    yield from _zeros_above_noise(analysis)
    yield from _zeros_below_noise(analysis)


def _unconfirmed(analysis: Analysis) -> Iterator[Doubt]:
    if analysis.raw.confirmed:
        return
    what = f"the method {analysis.method} did not confirm the rank by a second route"
    if analysis.method == "qr":
        what = "the method qr estimates: its values may be larger than the singular values are"
    yield Doubt("unconfirmed-rank", what, "analyse with the method svd", 0)


def _close_to_noise(analysis: Analysis) -> Iterator[Doubt]:
    limit = _CLOSE * analysis.raw.noise
    count = _nonzeros_up_to(analysis, limit)
    if count:
        yield Doubt(
            "close-decision",
            f"{_values(count)} as non-zero within a factor of {_CLOSE:.0f} of what computing and "
            f"rounding in the last bits may make of a zero, {analysis.raw.noise:.1e}",
            "look at the geometry, or state with a tolerance what is to count as zero",
            count,
        )


def _explained_by_digits(analysis: Analysis) -> Iterator[Doubt]:
    reach = min(_REACH_OF_DIGITS, _CUT_OFF * analysis.raw.reach_of_digits)
    if not any(analysis.raw.pair_value <= reach):
        return
    every = analysis.pairs
    lifted = [pair for pair in every if pair.value <= _CUT_OFF * pair.lift_of_digits]
    if not lifted:
        return
    # Of more values than have vectors, those within the same reach are in doubt as well.
    reach = _CUT_OFF * max(pair.lift_of_digits for pair in lifted)
    count = max(every.index(lifted[-1]) + 1, len(lifted))
    if len(lifted) == len(every):
        count = max(count, _nonzeros_up_to(analysis, reach))
    full = analysis.rank == min(analysis.rows, analysis.columns)
    what = "full rank" if full else f"rank {analysis.rank}"
    yield Doubt(
        "rounded-geometry",
        f"{what}, but a rounding of the deck's own digits explains it: the digits that were "
        f"left out may make {reach:.1e} of a zero",
        "give the geometry with all its digits",
        count,
    )


def _zeros_above_noise(analysis: Analysis) -> Iterator[Doubt]:
    zero = analysis.gap.largest_zero
    if zero is None or zero <= analysis.raw.noise:
        return
    because, mend = "the coordinates are given with so many digits only", "all their digits"
    if analysis.asked.tolerance is not None:
        because, mend = "the tolerance that was given says so", ""
    yield Doubt(
        "rounded-coordinates" if mend else "given-tolerance",
        f"singular values up to {zero:.1e} count as zero because {because}",
        f"give the coordinates with {mend}" if mend else "",
        0,
    )


def _zeros_below_noise(analysis: Analysis) -> Iterator[Doubt]:
    """Zeros that are larger than storing the geometry makes them, or would not last.

    Those that the last digits typed could as well have lifted are zeros by chance, or because
    they are meant to be.
    """
    zero = analysis.gap.largest_zero
    if zero is None or not zero <= analysis.raw.noise:
        return
    if not (analysis.under_constrained and analysis.over_constrained):
        return
    yield from itertools.islice(_perhaps_tiny(analysis, zero), 1)
    if _CUT_OFF * analysis.raw.reach_of_digits <= analysis.raw.noise:
        return
    lifts = (pair.lift_of_digits for group in analysis.zero_pairs for pair in group)
    reach = _CUT_OFF * max(lifts, default=0.0)
    if reach > analysis.raw.noise:
        yield Doubt(
            "rounded-geometry",
            "singular values count as zero in the geometry as it was typed; the digits that were "
            f"left out may make {reach:.1e} of them",
            "give the geometry with all its digits",
            0,
        )


def _perhaps_tiny(analysis: Analysis, zero: float) -> Iterator[Doubt]:
    """Reasons to take a zero for a tiny value, the plainest first."""
    largest = max(analysis.scaled_singular_values[:1].max(initial=0.0), 1.0)
    computed = _EPSILON * max(analysis.rows, analysis.columns) * largest
    if zero > computed + _stored(analysis, zero > computed):
        yield _close_zero(
            f"singular values up to {zero:.1e} count as zero, which is more than the rounding of "
            "the geometry's last bits would make of a zero"
        )
    left = fading.largest_remainder(analysis)
    if left and left.value > left.explained:
        yield _close_zero(
            f"of a motion and a self-stress {left.value:.1e} is left in the scaled D(c), of which "
            f"rounding in the last bits explains {left.explained:.1e}: their singular value counts "
            "as zero, but may be tiny instead"
        )
    powers = fading.powers_faded(analysis)
    if powers >= _FADED:
        yield _close_zero(
            f"a motion fades along the mechanism by {powers:.0f} powers of ten, and so does a "
            "self-stress: whether its singular value is zero or only tiny is beyond the digits "
            "of the arithmetic"
        )


def _stored(analysis: Analysis, is_needed: bool) -> float:
    """What storing the geometry may make of the zeros; found only where it is needed."""
    if not is_needed:
        return 0.0
    lifts = (pair.lift_of_bits for group in analysis.zero_pairs for pair in group)
    return fading.STORED * len(analysis.zero_pairs) * max(lifts, default=0.0)


def _close_zero(sentence: str) -> Doubt:
    where = "look at the geometry; far from the origin, move it there"
    return Doubt("close-decision", sentence, where, 0)


def _nonzeros_up_to(analysis: Analysis, limit: float) -> int:
    """How many values that count as non-zero are not above a limit."""
    values = analysis.scaled_singular_values
    zeros = min(analysis.rows, analysis.columns) - analysis.rank
    return int(np.count_nonzero(values[: values.size - zeros] <= limit))


def _values(count: int) -> str:
    return "a singular value counts" if count == 1 else f"{count} singular values count"
