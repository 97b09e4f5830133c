# SPDX-License-Identifier: BSD-3-Clause
"""How many sets of releases or declarations work, on the deck as it stands."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...analysis.change import Change
from ...analysis.decomposition import Asked, decompose
from ...analysis.result import Result
from ...analysis.verdict import Alternative, AnalysisError
from ...model.data import ModelData
from ...model.parts.condensing import as_given
from ...util.errors import FlexactError
from ..proposal import analysed
from .candidates import Reach
from .matroid import Judge, Rows, TooManyError, count_bases

#: Rows and columns of D(c) up to which null vectors are computed that were left out.
_MOST_DENSE = 1_000


def as_it_stands(result: Result) -> Result:
    """The result of the model as given, without taking declared divided sheets for one beam.

    It is the result itself where there are none, and where each beam by itself gives other
    counts, as it can where inner nodes are off the line: what the verdict counts is counted.

    Raises:
        AnalysisError: the model cannot be analysed so.
    """
    if result.condensed.chains:
        made = standing(result, result.given)
        if _counts(made) == _counts(result):
            return made
    return complete(result)


def _counts(result: Result) -> tuple[int, int]:
    return result.under_constrained, result.over_constrained


def changed(stands: Result, change: Change) -> Result:
    """The analysis of what `as_it_stands` gave, once it is changed, in the same way.

    Raises:
        FlexactError: the changed mechanism cannot be analysed.
    """
    if stands.condensed.chains:
        return analysed(stands, change)
    return standing(stands, change.apply(stands.given).data)


def complete(result: Result) -> Result:
    """The result with all its null vectors, where to compute those left out takes little time."""
    raw = result.raw
    left_out = result.under_constrained - raw.motions.vectors
    left_out += result.over_constrained - raw.stresses.vectors
    if not left_out or max(result.rows, result.columns) > _MOST_DENSE:
        return result
    asked = result.asked._replace(method="svd", prove=False)
    try:
        raw = decompose(result.data, asked)
    except AnalysisError:
        return result
    return result if raw.rank != result.rank else replace(result, raw=raw)


def standing(result: Result, data: ModelData) -> Result:
    """The result of another sound model as it stands, analysed as another one was.

    Raises:
        AnalysisError: the model cannot be analysed.
    """
    asked = Asked(result.asked.method, result.asked.tolerance)
    return complete(Result(result.name, as_given(data), decompose(data, asked), asked))


#: Larger counts are not given: readers of JSON may take them for other numbers.
_LARGEST = 2**53
#: Rows times vectors squared beyond which a count is not begun.
_MOST_WORK = 2.0e9
#: How many blocks are tried that the numbers leave in doubt, and rows of D(c) in all of them.
_MOST_TRIES, _MOST_ROWS_TRIED = 400, 40_000
#: Of a null vector so many times the noise over the gap may be rounding.
_OF_NOISE = 10.0

#: What is left of what is to be removed, of a result or of what may be meant instead.
Left = Callable[[Result | Alternative], int]


class Count(NamedTuple):
    """How many sets there are; None where they are too many to be counted."""

    certain: int | None
    doubtful: int | None = 0
    """How many more work for the numbers as they are, though rounding may hide that they do not."""


def counted(stands: Result, reach: Reach, left: Left) -> Count:
    """How many sets of rows span their space.

    A block that the numbers leave in doubt is tried: the mechanism is changed so and analysed.
    Where that leaves doubts it is counted again with such blocks taken for regular.

    Args:
        stands: The result of the deck as it stands, whose rows they are.
        reach: The rows over the null space.
        left: What is left of what is to be removed.
    """
    rows, vectors = reach.rows.shape
    if not vectors:
        return Count(0)
    if float(rows) * vectors**2 > _MOST_WORK:
        return Count(None)
    known: dict[Rows, bool] = {}
    doubtful: set[Rows] = set()

    def judge(chosen: Rows) -> bool | None:
        if chosen not in known:
            tries = len(known) + 1
            if tries > _MOST_TRIES or tries * stands.rows > _MOST_ROWS_TRIED:
                return None
            change = joined([reach.change(int(reach.index[i])) for i in sorted(chosen)])
            try:
                after = changed(stands, change)
                known[chosen] = removes_all(stands, after, left)
                if not known[chosen] and not left(after):
                    doubtful.add(chosen)
            except FlexactError:
                known[chosen] = False
        return known[chosen]

    def kindly(chosen: Rows) -> bool | None:
        found = judge(chosen)
        return True if chosen in doubtful else found

    count = _bases(stands, reach, judge)
    if count is None or not doubtful:
        return Count(count)
    more = _bases(stands, reach, kindly)
    return Count(count, None if more is None else max(0, more - count))


def _bases(stands: Result, reach: Reach, judge: Judge) -> int | None:
    try:
        count = count_bases(reach.rows, error_of(stands), judge)
    except TooManyError:
        return None
    return count if count <= _LARGEST else None


def removes_all(before: Result, after: Result, left: Left) -> bool:
    """Whether nothing is left, and what rounding of the geometry may have hidden neither.

    What may be left besides was in doubt before.
    """
    if left(after):
        return False
    return _at_most(after, left) <= _at_most(before, left) - left(before)


def _at_most(result: Result, left: Left) -> int:
    """What is left if all is so that is in doubt."""
    return max(left(result), *(left(one) for one in result.alternatives), 0)


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
