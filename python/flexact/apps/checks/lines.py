# SPDX-License-Identifier: BSD-3-Clause
"""Lines of a deck's text: places in UTF-16 units, and words that stay when lines are laid out anew.

Lines are those of the core, which end at LF.
"""

from __future__ import annotations

from ...deck.diagnostics import Place
from ...deck.source import Source, decode
from ...util.cached import cached_property
from ..editor.deck import Index, Key
from ..editor.document import Document, Range, units
from ..editor.statements import Statements
from .finding import Region

_COMMENTS = "%#"


class Lines:
    """The lines of a deck.

    Attributes:
        source: The text; None of a deck that cannot be read.
    """

    def __init__(self, source: Source | None) -> None:
        """Keep the text; what is read off it is read when it is asked for."""
        self.source = source

    def text(self, number: int) -> str:
        """Line 1, 2, ...; empty where there is none."""
        return decode(self.source.line(number)) if self.source is not None else ""

    def region(self, place: Place) -> Region:
        """A place in UTF-16 units."""
        text = self.text(place.line)
        first = max(place.column, 1)
        last = max(place.last_column, first)
        start = units(text[: first - 1], "utf-16") + 1
        end = start + max(1, units(text[first - 1 : last], "utf-16"))
        return Region(place.line, start, end)

    def statement(self, number: int) -> str:
        """The words of a line in capitals, one blank between them, without the comment."""
        text = self.text(number)
        mark = min((k for k in map(text.find, _COMMENTS) if k >= 0), default=len(text))
        return " ".join(text[:mark].split()).upper()

    def definition(self, key: Key) -> Region | None:
        """Where an element is made or a node gets its place; None where the text does not say."""
        where = self._index.definition(key) if self._index is not None else []
        return self._region_of(where[0]) if where else None

    def _region_of(self, range_: Range) -> Region:
        line, first = range_.start
        return self.region(Place(line + 1, first + 1, max(range_.end.character, first + 1)))

    @cached_property
    def _index(self) -> Index | None:
        if self.source is None:
            return None
        # A CR that ends no line is a blank, as for the core.
        raw = self.source.text.replace(b"\r\n", b"\n").replace(b"\r", b" ")
        text = "\n".join(map(decode, raw.split(b"\n")))
        return Index(Statements(Document.of(text)))
