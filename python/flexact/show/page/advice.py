# SPDX-License-Identifier: BSD-3-Clause
"""The page of a mechanism before and after a change, and the picture of what a body can do."""

from __future__ import annotations

import contextlib

from ...advice.advice import Advice, sections_of
from ...advice.spaces.spaces import spaces_of
from ...analysis.change import Change
from ...analysis.decomposition import Asked
from ...analysis.naming import Pieces
from ...analysis.result import Result, result_of
from ...deck.rendering import ModelError, model_error
from ..picture import picture_bytes, still_of
from ..writers import as_bytes
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
    stills = still_of(before), still_of(after)
    body = None
    if advice.spaces is not None:
        # It may have another name now, or none.
        with contextlib.suppress(ModelError):
            body = spaces_of(after, advice.spaces.subject.name, wires=False)
    spaces = advice.spaces, body
    return as_bytes(before_and_after(before, after, words, told, stills, spaces=spaces))


def page_as_it_is(advice: Advice) -> bytes:
    """The page of a mechanism alone, with freedom and constraint to be switched on."""
    return as_bytes(page(advice.analysis, still_of(advice.analysis), advice.spaces))


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
