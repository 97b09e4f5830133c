# SPDX-License-Identifier: BSD-3-Clause
"""How many sets of releases or declarations work, on the deck as it stands."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...base.errors import FlexactError
from ...result.result import Result
from ..change import Change
from .bases import Rows, TooManyError, count_bases
from .reach import Reach
from .stands import standing

#: Rows times vectors squared beyond which a count is not begun.
_MOST_WORK = 2.0e9
#: Rows of D(c) of all analyses that a count may ask for.
_MOST_ROWS_ASKED = 60_000
#: Of a null vector so many times the noise over the gap may be rounding.
_OF_NOISE = 10.0


def counted(stands: Result, reach: Reach, left: Callable[[Result], int]) -> int | None:
    """How many sets of rows span their space; None where there are too many to be counted.

    A block that the numbers leave in doubt is tried: the mechanism is changed so and analysed.

    Args:
        stands: That of the deck as it stands, whose rows they are.
        reach: The rows over the null space.
        left: What is left of what is to be removed.
    """
    rows, vectors = reach.rows.shape
    if not vectors:
        return 0
    if float(rows) * vectors**2 > _MOST_WORK:
        return None
    known: dict[Rows, bool] = {}

    def judge(chosen: Rows) -> bool:
        if chosen not in known:
            if len(known) * max(stands.rows, 1) > _MOST_ROWS_ASKED:
                raise TooManyError
            change = joined([reach.change(int(reach.index[i])) for i in sorted(chosen)])
            try:
                known[chosen] = left(standing(stands, change.apply(stands.given).data)) == 0
            except FlexactError:
                known[chosen] = False
        return known[chosen]

    try:
        return count_bases(reach.rows, error_of(stands), judge)
    except TooManyError:
        return None


def error_of(result: Result) -> float:
    """By how much entries of its orthonormal null vectors may be off."""
    zero, above = result.gap.largest_zero or 0.0, result.gap.smallest_nonzero or 1.0
    noise = max(result.raw.noise, zero, float(np.finfo(np.float64).eps))
    return _OF_NOISE * noise / min(above, 1.0)


def joined(changes: list[Change]) -> Change:
    """Several changes as one."""
    return Change(
        tuple(one for change in changes for one in change.deformations),
        tuple(one for change in changes for one in change.coordinates),
    )
