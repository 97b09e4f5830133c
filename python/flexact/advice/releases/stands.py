# SPDX-License-Identifier: BSD-3-Clause
"""The analysis of a deck as it stands, where each beam of a divided sheet is one of its own."""

from __future__ import annotations

from dataclasses import replace

from ...model.data import ModelData
from ...model.parts.condensing import as_given
from ...result.decompose import AnalysisError, decompose
from ...result.outcome import Asked
from ...result.result import Result

#: Rows and columns of D(c) up to which null vectors are computed that were left out.
_MOST_DENSE = 2_500


def as_it_stands(result: Result) -> Result:
    """The result of the model as given, without taking declared divided sheets for one beam.

    It is the result itself where there are none.

    Raises:
        AnalysisError: the model cannot be analysed so.
    """
    return complete(result) if not result.condensed.chains else standing(result, result.given)


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
