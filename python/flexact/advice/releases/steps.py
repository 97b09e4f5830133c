# SPDX-License-Identifier: BSD-3-Clause
"""A set for a large model, of which not all null vectors fit: found step by step.

Of the vectors that the core gives as many rows are taken as there are vectors, so that their
block is regular; the mechanism is changed so and analysed again, until nothing is left.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...base.errors import FlexactError
from ...core.arrays import FloatArray
from ...result.result import Result
from ..change import Change
from ..proposal import Proposal, Purpose, after
from .bases import echelon_of
from .counting import joined
from .reach import Reach
from .stands import changed

#: Rows of D(c) of all analyses that are made.
_MOST_ROWS = 1_200_000
#: Blocks with smaller singular values are not used.
_LEAST = 1.0e-4


def by_steps(
    stands: Result,
    purpose: Purpose,
    reach_of: Callable[[Result], Reach],
    unwelcome: Callable[[Result, Reach], FloatArray],
) -> Proposal | None:
    """One set that leaves nothing; None where it is not found in little time.

    Its condition is the largest of those of the steps.

    Args:
        stands: The result of the deck as it stands.
        purpose: What it is to do.
        reach_of: The rows over the null vectors of a result.
        unwelcome: (n,) how unwelcome each row is; those of little are taken where they do.
    """
    now, change, condition = stands, Change(), 1.0
    rows = 0
    while _left(purpose, now):
        rows += now.rows
        reach = reach_of(now)
        block = _block(reach, unwelcome(now, reach)) if reach.vectors else None
        if block is None or rows > _MOST_ROWS:
            return None
        chosen, smallest = block
        condition = max(condition, 1.0 / smallest)
        change = joined([change, *(reach.change(int(reach.index[row])) for row in chosen)])
        before = _left(purpose, now)
        try:
            now = changed(stands, change)
        except FlexactError:
            return None
        if _left(purpose, now) >= before:
            return None
    return Proposal(purpose, change, condition, after(now))


def _left(purpose: Purpose, result: Result) -> int:
    is_release = purpose is Purpose.RELEASE
    return result.over_constrained if is_release else result.under_constrained


def _block(reach: Reach, unwelcome: FloatArray) -> tuple[list[int], float] | None:
    """Rows with a well-conditioned block, and its smallest singular value."""
    for most in np.unique(unwelcome).tolist():
        some = np.flatnonzero(unwelcome <= most)
        form = echelon_of(reach.rows[some], _LEAST)
        if form is not None:
            return some[form.basis].tolist(), form.smallest
    return None
