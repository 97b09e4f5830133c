# SPDX-License-Identifier: BSD-3-Clause
"""Warnings about a decision in words: the doubts, and what a small misalignment would change."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..core.elements import NodeKind
from ..deck.diagnostics import Diagnostic, Severity
from ..util.plain_text import MOST_TYPED, significant_digits
from .certainty import CLEARLY, Doubt, DoubtKind
from .result import Result

#: A smallest non-zero singular value below this part of the largest is worth a warning.
_NEARLY_ZERO = 1.0e-5
_ALL_DIGITS = "give the geometry with all its digits"
_LOOK = "look at the geometry; far from the origin, move it there"


def warnings_of(result: Result) -> tuple[Diagnostic, ...]:
    """Warnings and notes about the model, then about the decision on its rank."""
    return (*result.data.problems.kept, *_of_the_decision(result))


def _of_the_decision(result: Result) -> Iterator[Diagnostic]:
    doubts = result.assessment.doubts
    for doubt in doubts:
        yield warning_of(result, doubt)
    small, largest = result.gap.smallest_nonzero, max(result.scaled_singular_values, default=0.0)
    if small is not None and small < _NEARLY_ZERO * largest and not doubts:
        yield Diagnostic(
            Severity.WARNING,
            "close-decision",
            f"the smallest singular value that counts as non-zero is {small / largest:.1e} "
            "of the largest: a small misalignment would change the verdict",
            help="look at the margin, and at the geometry",
        )


def warning_of(result: Result, doubt: Doubt) -> Diagnostic:
    """A doubt as a warning: its code, a sentence, and what helps."""
    sentence, advice = _words(result, doubt)
    return Diagnostic(Severity.WARNING, doubt.code, sentence, help=advice)


def _words(result: Result, doubt: Doubt) -> tuple[str, str]:
    size = f"{doubt.size:.1e}"
    match doubt.kind:
        case DoubtKind.UNCONFIRMED:
            what = f"the method {result.method} did not confirm the rank by a second route"
            return what, "analyse with the method svd"
        case DoubtKind.CLOSE_TO_NOISE:
            one = doubt.values == 1
            counts = "a singular value counts" if one else f"{doubt.values} singular values count"
            return (
                f"{counts} as non-zero within a factor of {CLEARLY:.0f} of what storing the "
                f"geometry may make of a zero, {size}",
                "look at the geometry, or state with a tolerance what is to count as zero",
            )
        case DoubtKind.DIGITS_EXPLAIN:
            full = result.rank == min(result.rows, result.columns)
            what = "full rank" if full else f"rank {result.rank}"
            return (
                f"{what}, but a rounding of the deck's own digits ({_digits(result)}) explains it: "
                f"those that were left out may make {size} of a zero",
                _ALL_DIGITS,
            )
        case DoubtKind.COORDINATES_ROUNDED:
            return (
                f"singular values up to {size} count as zero because the coordinates are given "
                f"with so few digits ({_digits(result)})",
                "give the coordinates with all their digits",
            )
        case DoubtKind.TOLERANCE_GIVEN:
            what = f"singular values up to {size} count as zero because the tolerance that was "
            return what + "given says so", ""
        case DoubtKind.UNSEEN:
            one = doubt.values == 1
            return (
                f"{'a singular value is' if one else f'{doubt.values} singular values are'} not "
                "zero in exact arithmetic, but too small to be compared with the rounding of the "
                "geometry",
                _LOOK,
            )
        case DoubtKind.UNDECIDED:
            one = doubt.zeros == 1
            counts = "a singular value counts" if one else f"{doubt.zeros} singular values count"
            left = f"it is {size}, and storing them makes {doubt.explained:.1e}"
            unknown = "how large it is was not computed"
            return (
                f"{counts} as zero, but for the numbers as they are {'is' if one else 'are'} not: "
                f"{left if doubt.size else unknown}",
                _LOOK,
            )
        case DoubtKind.ZERO_ABOVE_STORING:
            return (
                f"singular values up to {size} count as zero, which is more than the rounding of "
                "the geometry's last bits would make of a zero",
                _LOOK,
            )
        case DoubtKind.REMAINDER:
            return (
                f"of a motion and a self-stress {size} is left in the scaled D(c), of which "
                f"rounding in the last bits explains {doubt.explained:.1e}: their singular value "
                "counts as zero, but may be tiny instead",
                _LOOK,
            )
        case DoubtKind.FADING:
            return (
                f"a motion fades along the mechanism by {doubt.size:.0f} powers of ten, and so "
                "does a self-stress: whether its singular value is zero or only tiny is beyond "
                "the digits of the arithmetic",
                _LOOK,
            )


def _digits(result: Result) -> str:
    """How many digits the coordinates were typed with, those aside that are known to the bit."""
    arrays = result.data.arrays
    places = arrays.node_value[:3, arrays.node_kind <= NodeKind.POSITION]
    lengths = {significant_digits(value) for value in np.unique(places).tolist()}
    typed = [length for length in lengths if length <= MOST_TYPED]
    return f"at most {max(typed, default=0)}"
