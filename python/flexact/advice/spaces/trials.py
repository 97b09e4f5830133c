# SPDX-License-Identifier: BSD-3-Clause
"""Wires and sheets are tried before they are proposed."""

from __future__ import annotations

import numpy as np

from ...analysis.change import Change
from ...analysis.decomposition import Asked
from ...analysis.result import Result, result_of
from ...util.errors import FlexactError
from ..proposal import After, Proposal, Purpose
from .aims import Aim
from .freedom import Freed
from .spaces_subjects import Subject


def proposed(
    freed: Freed, subject: Subject, aim: Aim, change: Change, count: int, condition: float
) -> Proposal | None:
    """The proposal of a change; None where it does not do what it should.

    The mechanism with nothing declared must have `count` motions fewer, all of the body; the body
    must go on doing what is wanted; and there must be no further self-stress. What only lengthens
    a sheet or wire, so that the point between is inside of it, is none.
    """
    result = freed.result
    try:
        data = change.apply(result.given).data
        after: Result = result_of(data, Asked(result.asked.method, result.asked.tolerance))
        then, same = Freed(after), _same(subject, result, after)
        if not then.has(same):
            return None
        space = then.space(same)
    except FlexactError:
        return None
    fewer = freed.outcome.under_constrained - then.outcome.under_constrained
    if fewer != count or space.dimension != aim.freedom.dimension - count:
        return None
    factors = np.repeat((aim.freedom.length, 1.0), 3)
    if not all(space.has(row / factors) for row in aim.wanted):
        return None
    if after.over_constrained > result.over_constrained:
        return None
    told = After(
        after.verdict, after.under_constrained, after.over_constrained, after.gap.smallest_nonzero
    )
    purpose = Purpose.ADD_SHEET if change.sheets else Purpose.ADD_WIRE
    return Proposal(purpose, change, max(condition, 1.0), told)


def _same(subject: Subject, before: Result, after: Result) -> Subject:
    """A body by the numbers of its nodes in the changed mechanism."""
    numbers, index = before.given.arrays.node_number, after.given.node_index
    positions, orientations = (
        tuple(index[int(numbers[node])] for node in nodes)
        for nodes in (subject.positions, subject.orientations)
    )
    return Subject(subject.body, positions, orientations)
