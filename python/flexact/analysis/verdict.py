# SPDX-License-Identifier: BSD-3-Clause
"""Verdict, counts, gap, certainty and margin: the small parts of a result."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from ..core.raw import RawAnalysis
from ..model.data import ModelData
from ..util.errors import FlexactError
from ..util.records import Word
from .limits import ZERO_ELSEWHERE


class Verdict(Word):
    """What Table 1 of the paper says about rows, columns and rank of D(c)."""

    EXACT = "exactly constrained"
    UNDER = "under-constrained"
    OVER = "over-constrained"
    BOTH = "under-constrained and over-constrained"

    @property
    def word(self) -> str:
        """In a word, as the command has it: "exact", "under", "over" or "both"."""
        return self.name.lower()

    def __eq__(self, other: object) -> bool:
        """Whether it is the same verdict; a text is it in a word, or in its own words."""
        if isinstance(other, str) and not isinstance(other, Verdict):
            return other in (self.word, self.value)
        return self is other

    def __ne__(self, other: object) -> bool:
        """Whether it is another verdict."""
        return not self == other

    __hash__ = str.__hash__

    @property
    def colour(self) -> str:
        """In pictures and pages on white, as #rrggbb; the words always stand beside it."""
        return _COLOURS[self]


_COLOURS = {
    Verdict.EXACT: "#15774a",
    Verdict.UNDER: "#b25406",
    Verdict.OVER: "#b3261e",
    Verdict.BOTH: "#93205e",
}
#: Of an exactly constrained mechanism whose margin is smaller than the accuracy: never green.
MARGINAL_COLOUR = "#8a6a00"


class ClassCounts(NamedTuple):
    """How many coordinates or deformations there are of each class, eq. (7)."""

    total: int
    fixed: int
    dependent: int
    independent: int


class Counts(NamedTuple):
    """Counts by class; a dependent deformation is a released one."""

    coordinates: ClassCounts
    deformations: ClassCounts


class Gap(NamedTuple):
    """The scaled singular values on both sides of the decision on rank, None without one."""

    smallest_nonzero: float | None
    largest_zero: float | None

    @property
    def ratio(self) -> float | None:
        """The zero over the other; None without one of them."""
        if self.smallest_nonzero is None or self.largest_zero is None:
            return None
        return self.largest_zero / self.smallest_nonzero

    def zero_elsewhere(self, noise: float) -> float:
        """Up to where scaled singular values are zero in other configurations.

        Rounding of places is magnified there; what is small at the reference and not zero stays so.
        """
        above = self.smallest_nonzero or 1.0
        below = max(noise, self.largest_zero or 0.0)
        return max(min(ZERO_ELSEWHERE, math.sqrt(above * below)), noise)


class Certainty(Word):
    """Whether the geometry could be meant with another rank than was decided.

    This is about the arithmetic alone. How far the machine may be out of alignment is the
    `Margin`.
    """

    CERTAIN = "numerically certain"
    DOUBTFUL = "doubtful"


class Alternative(NamedTuple):
    """Counts that may be meant, and what change of the geometry leads there, to first order."""

    under_constrained: int
    over_constrained: int
    change_m: float | None
    """By so much one node must be moved [m]; None where no such move does it, 0 where no change
    is needed for the numbers as they are."""
    change_rad: float | None
    """By so much one element must be turned about its centre [rad], likewise."""


class Proof(NamedTuple):
    """The rank of D(c) in exact arithmetic."""

    of: str
    """Of the "decimals" as they were typed, or of the "doubles" as they are stored."""
    rank: int
    primes: int
    """It was computed modulo so many random primes."""
    failure_probability: float
    """A rank modulo a prime is never too high; that it is too low has at most this probability."""


class Margin(NamedTuple):
    """The smallest misalignment that changes the verdict, to first order; None where none does.

    A zero that is there in exact alignment only has no margin: its length and angle are 0.
    """

    length: float | None
    """By so much one node must be moved [m]."""
    angle: float | None
    """By so much one element must be turned about its centre [rad]."""
    node: int | None
    """Number of that node."""
    element: int | None
    """Number of that element."""
    singular_value: float | None
    """The value of the scaled D(c) that becomes zero, or is zero and becomes non-zero."""
    exact_alignment: bool = False
    """Whether a motion and a self-stress are there in exact alignment only: any misalignment of
    the node or the element lifts both."""


class AnalysisError(FlexactError):
    """A sound model that could not be analysed: too large, or no convergence."""


_FAILURES = {
    "convergence": "the decomposition of D(c) did not converge",
    "interrupted": "the analysis was stopped",
}


def completed(
    data: ModelData, work: Callable[[], RawAnalysis], forgiven: tuple[str, ...] = ()
) -> RawAnalysis:
    """What the core gives for a model, where nothing failed.

    Args:
        data: The model.
        work: The call of the core.
        forgiven: Errors, by their names in `flexact.core.calls.ERRORS`, that leave it without.

    Raises:
        AnalysisError: the model is too large for the memory, or there was no convergence.
    """
    try:
        raw = work()
    except MemoryError:
        raise AnalysisError(_too_large(data, None)) from None
    if raw.error == "memory":
        raise AnalysisError(_too_large(data, raw.bytes_needed))
    if raw.error not in ("none", *forgiven):
        raise AnalysisError(_FAILURES.get(raw.error, f"the core failed ({raw.error})"))
    return raw


def _too_large(data: ModelData, needed: float | None) -> str:
    size = "" if needed is None else f"about {needed / 1e9:.3g} GB of memory, "
    return (
        f"D(c) has {data.count.rows} rows and {data.count.columns} columns; its decomposition "
        f"needs {size}more {'' if size else 'memory '}than there is"
    )
