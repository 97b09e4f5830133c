# SPDX-License-Identifier: BSD-3-Clause
"""The analysis of a deck as it stands, where each beam of a divided sheet is one of its own."""

from __future__ import annotations


from ...model.data import ModelData
from ...model.parts.condensing import as_given
from ...result.decompose import decompose
from ...result.outcome import Asked
from ...result.result import Result


def as_it_stands(result: Result) -> Result:
    """The result of the model as given, without taking declared divided sheets for one beam.

    It is the result itself where there are none.

    Raises:
        AnalysisError: the model cannot be analysed so.
    """
    return result if not result.condensed.chains else standing(result, result.given)


def standing(result: Result, data: ModelData) -> Result:
    """The result of another sound model as it stands, analysed as another one was.

    Raises:
        AnalysisError: the model cannot be analysed.
    """
    asked = Asked(result.asked.method, result.asked.tolerance)
    return Result(result.name, as_given(data), decompose(data, asked), asked)
