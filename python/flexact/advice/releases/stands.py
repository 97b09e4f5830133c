# SPDX-License-Identifier: BSD-3-Clause
"""The analysis of a deck as it stands, where each beam of a divided sheet is one of its own."""

from __future__ import annotations


from ...model.parts.condensing import as_given
from ...result.decompose import decompose
from ...result.result import Result


def as_it_stands(result: Result) -> Result:
    """The result of the model as given, without taking declared divided sheets for one beam.

    It is the result itself where there are none.

    Raises:
        AnalysisError: the model cannot be analysed so.
    """
    if not result.condensed.chains:
        return result
    asked = result.asked._replace(prove=None)
    raw = decompose(result.given, asked)
    return Result(result.name, as_given(result.given), raw, asked)
