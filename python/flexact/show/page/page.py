# SPDX-License-Identifier: BSD-3-Clause
"""The page of a deck: whole, as text."""

from __future__ import annotations

from collections.abc import Sequence

from ...advice.spaces.spaces import Spaces
from ...analysis.result import Result
from .assets import PLAIN_SCRIPTS, SCRIPTS, filled
from .content import broken_content, content_of


def page(
    analysis: Result,
    still: bytes | None = None,
    spaces: Spaces | None = None,
    missing: Sequence[str] = (),
) -> str:
    """The page of a result; arguments as those of `content_of`."""
    content = content_of(analysis, still, spaces, missing=missing)
    return filled(content.title, content.body, SCRIPTS)


def broken_page(error: Exception, name: str) -> str:
    """The page of a deck that cannot be analysed; it says why."""
    content = broken_content(error, name)
    return filled(content.title, content.body, PLAIN_SCRIPTS)
