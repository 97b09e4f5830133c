# SPDX-License-Identifier: BSD-3-Clause
"""The analysis of a deck as it stands, where each beam of a divided sheet is one of its own."""

from __future__ import annotations

from dataclasses import replace

from ...analysis.change import Change
from ...analysis.decomposition import Asked
from ...analysis.failing import AnalysisError
from ...analysis.result import Result
from ...analysis.spaces import decompose
from ...model.data import ModelData
from ...model.parts.condensing import as_given
from ..proposal import analysed

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
