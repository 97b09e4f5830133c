# SPDX-License-Identifier: BSD-3-Clause
"""Pieces of an output, each of which may fail without taking the others along."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from typing import TypeVar

from .errors import FlexactError
from .plain_text import harmless

#: Where the environment has this name, what fails is raised: tests see mistakes of the program.
STRICT = "FLEXACT_STRICT"

_Made = TypeVar("_Made")
_Given = TypeVar("_Given")


class Attempts:
    """Makes pieces of an output, and keeps what could not be made.

    Attributes:
        failed: What could not be made and why, once each, in words that stand behind "Left out: ".
    """

    def __init__(self) -> None:
        """Nothing has failed yet."""
        self.failed: dict[str, None] = {}

    def make(self, what: str, make: Callable[[], _Made], otherwise: _Made) -> _Made:
        """What `make` gives, or something else where it fails, which is kept."""
        try:
            return make()
        except Exception as error:
            if not isinstance(error, FlexactError) and os.environ.get(STRICT):
                raise
            reason = str(error).strip().partition("\n")[0]
            why = reason if isinstance(error, FlexactError) else type(error).__name__
            self.failed[f"{what}, which failed ({harmless(why)})"] = None
            return otherwise

    def each(
        self, what: str, items: Iterable[_Given], make: Callable[[_Given], _Made]
    ) -> Iterator[_Made]:
        """What `make` gives of each item, without those of which it fails."""
        for item in items:
            made = self.make(what, lambda item=item: [make(item)], [])  # type: ignore[misc]
            yield from made
