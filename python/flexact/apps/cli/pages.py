# SPDX-License-Identifier: BSD-3-Clause
"""The page of a deck, and what the index of several says of it."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from ...analysis.result import Result
from ...deck.errors import ProblemsError
from ...show.page import Entry, broken_entry, broken_page, entry_of, unread_entry, with_way_back
from ...show.saving import as_bytes, page_bytes, small_picture
from ...util.decks import DeckFile
from ...util.interruption import unwinding
from . import failures

#: What the index takes the place of among the decks.
INDEX = DeckFile("the index", Path("index"))
WITHOUT_PICTURES = (
    "without the packages matplotlib and pillow there are no still pictures, for browsers without "
    "WebGL and in the index: pip install matplotlib pillow"
)


class DeckPage(NamedTuple):
    """A page, and its place in the index."""

    content: bytes
    entry: Entry


def page_of(result: Result, place: str, *, indexed: bool) -> DeckPage:
    """The page of a result, whose path beside the index is `place` but for its suffix.

    Args:
        result: The result.
        place: The path.
        indexed: Whether there is an index, which has a picture of each page.
    """
    with unwinding():
        content = page_bytes(result, place if indexed else None)
    with unwinding():
        picture = small_picture(result) if indexed else None
    return DeckPage(content, entry_of(result, place, f"{place}.html", picture))


def broken_page_of(
    error: Exception, name: str, place: str, *, indexed: bool = True
) -> DeckPage | None:
    """The page of a deck with errors; None where its file could not be read."""
    if isinstance(error, ProblemsError):
        codes = {item.code for item in error.diagnostics}
        if codes & failures.NOT_READ:
            return None
    made = broken_page(error, name)
    if indexed:
        made = with_way_back(made, place)
    return DeckPage(as_bytes(made), broken_entry(error, place, f"{place}.html", name))


def unread(place: str) -> Entry:
    """What the index says of a deck that could not be read."""
    return unread_entry(place)
