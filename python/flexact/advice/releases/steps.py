# SPDX-License-Identifier: BSD-3-Clause
"""A set for a large model, of which not all null vectors fit: found step by step.

Of the vectors that the core gives as many rows are taken as there are vectors, so that their
block is regular; the mechanism is changed so and analysed again, until nothing is left.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...analysis.change import Change
from ...analysis.result import Result
from ...analysis.result_sparse_basis import groups_of
from ...core.arrays import FloatArray
from ...core.basis import Basis
from ...util.errors import FlexactError
from ..proposal import Proposal, Purpose, after
from .candidates import Places, Reach
from .counting import joined
from .echelon import echelon_of
from .stands import changed

#: Rows of D(c) of all analyses that are made.
_MOST_ROWS = 1_200_000
#: Of vectors that hang together so many are taken at once.
_AT_ONCE = 60
#: Blocks with smaller singular values are not used.
_LEAST = 1.0e-4

#: The rows over some of the vectors of a result.
ReachOf = Callable[[Result, Places], Reach]
#: (n,) how unwelcome each of its rows is; those of little are taken where they do.
Unwelcome = Callable[[Result, Reach], FloatArray]


def by_steps(
    stands: Result, purpose: Purpose, reach_of: ReachOf, unwelcome: Unwelcome
) -> Proposal | None:
    """One set that leaves nothing; None where it is not found in little time.

    Its condition is the largest of those of the steps.
    """
    now, changes, condition, rows = stands, list[Change](), 1.0, 0
    while before := _left(purpose, now):
        groups = _groups(_space(purpose, now))
        done = sum(group.size for group in groups)
        # So many more are needed if each step goes as far as this one.
        if not done or rows + now.rows * before / done > _MOST_ROWS:
            return None
        rows += now.rows
        for vectors in groups:
            reach = reach_of(now, vectors)
            block = _block(reach, unwelcome(now, reach))
            if block is None:
                return None
            condition = max(condition, 1.0 / block[1])
            changes += [reach.change(int(reach.index[row])) for row in block[0]]
        try:
            now = changed(stands, joined(changes))
        except FlexactError:
            return None
        if _left(purpose, now) >= before:
            return None
    return Proposal(purpose, joined(changes), condition, after(now))


def _left(purpose: Purpose, result: Result) -> int:
    is_release = purpose is Purpose.RELEASE
    return result.over_constrained if is_release else result.under_constrained


def _space(purpose: Purpose, result: Result) -> Basis:
    return result.stress_space if purpose is Purpose.RELEASE else result.motion_space


def _groups(space: Basis) -> list[Places]:
    """Vectors that share places, of each such group the first."""
    if not space.vectors:
        return []
    group = groups_of(space)
    order = np.argsort(group, kind="stable")
    parts = np.split(order, np.flatnonzero(np.diff(group[order])) + 1)
    return [part[:_AT_ONCE] for part in parts]


def _block(reach: Reach, unwelcome: FloatArray) -> tuple[list[int], float] | None:
    """Rows with a well-conditioned block, and its smallest singular value."""
    for most in np.unique(unwelcome).tolist():
        some = np.flatnonzero(unwelcome <= most)
        form = echelon_of(reach.rows[some], _LEAST)
        if form is not None:
            return some[form.basis].tolist(), form.smallest
    return None
