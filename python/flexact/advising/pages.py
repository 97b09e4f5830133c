# SPDX-License-Identifier: BSD-3-Clause
"""The page of a mechanism before and after a change, with the advice below."""

from __future__ import annotations

from ..advice.change import Change
from ..page import before_and_after
from ..picture import has_packages, picture_bytes
from ..result.outcome import Asked
from ..result.result import Result, result_of
from ..text.sentences import Pieces
from .advice import Advice
from .describe import sections_of


def page_of(advice: Advice, change: Change, words: Pieces) -> bytes:
    """A page that shows the mechanism as it is beside what a change makes of it, moving.

    Args:
        advice: The advice on the mechanism.
        change: What is done.
        words: The same, for people.
    """
    before, asked = advice.analysis, advice.analysis.asked
    model = change.apply(before.given)
    after: Result = result_of(
        model.data, Asked(asked.method, asked.tolerance, asked.prove, asked.accuracy), before.name
    )
    told = (each.line for section in sections_of(advice) for each in section)
    stills = _still(before), _still(after)
    page = before_and_after(before, after, words, told, stills)
    return page.encode("utf-8", "backslashreplace")


def _still(result: Result) -> bytes | None:
    return picture_bytes(result, ".png") if has_packages() else None
