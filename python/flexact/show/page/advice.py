# SPDX-License-Identifier: BSD-3-Clause
"""The page of a mechanism before and after a change, and the picture of what a body can do."""

from __future__ import annotations

from ...advice.advice import Advice, sections_of
from ...advice.spaces.spaces import Spaces, spaces_of
from ...analysis.change import Change
from ...analysis.decomposition import Asked
from ...analysis.naming import Pieces
from ...analysis.result import Result, result_of
from ...deck.rendering import ModelError, model_error
from ...util.partial import attempted
from ..picture import has_packages, picture_bytes
from . import before_and_after, page


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
    told = (line for section in sections_of(advice) for line, _ in section)
    stills = _still(before), _still(after)
    spaces = advice.spaces, _spaces_after(advice, after)
    made = before_and_after(before, after, words, told, stills, spaces=spaces)
    return made.encode("utf-8", "backslashreplace")


def page_as_it_is(advice: Advice) -> bytes:
    """The page of a mechanism alone, with freedom and constraint to be switched on."""
    made = page(advice.analysis, _still(advice.analysis), advice.spaces)
    return made.encode("utf-8", "backslashreplace")


def picture_of(advice: Advice, suffix: str) -> bytes:
    """A picture of the freedom and the constraint of the body.

    Args:
        advice: The advice on the mechanism.
        suffix: `.png`, `.svg` or `.pdf`.

    Raises:
        ModelError: there is no body that could move.
        PictureError: a package is missing.
    """
    spaces = advice.spaces
    if spaces is None:
        raise model_error("no-body", "nothing in this mechanism has a freedom space to be drawn")
    return picture_bytes(advice.analysis, suffix, spaces=spaces)


def _spaces_after(advice: Advice, after: Result) -> Spaces | None:
    """Freedom and constraint of the same body in the changed mechanism."""
    if advice.spaces is None:
        return None
    try:
        return spaces_of(after, advice.spaces.subject.name, wires=False)
    except ModelError:
        # It has another name now, or none.
        return None


def _still(result: Result) -> bytes | None:
    if not has_packages():
        return None
    return attempted("", lambda: picture_bytes(result, ".png"), None, None)
