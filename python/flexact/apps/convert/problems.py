# SPDX-License-Identifier: BSD-3-Clause
"""Everything that is wrong with tables, each with its place, in one error."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ...deck.diagnostics import Diagnostic, Place, Problems, Severity
from ...deck.errors import ProblemsError
from ...deck.source import Source
from ...util.cached import cached_property


class TablesError(ProblemsError, ValueError):
    """Tables that are no model; each problem begins with its place, such as nprops[3].fix."""


class Text:
    """The text that tables were read from.

    Attributes:
        source: The text and its name, if there is one.
    """

    def __init__(
        self, source: Source | None = None, spans: Callable[[], Mapping[str, Place]] | None = None
    ) -> None:
        """Keep the text, and how it is found where each value stands when that is asked for."""
        self.source = source
        self._find_spans = spans

    @cached_property
    def _spans(self) -> Mapping[str, Place]:
        try:
            return {} if self._find_spans is None else self._find_spans()
        except RecursionError:
            # What stands in each other so deeply has no places.
            return {}

    def span_of(self, place: str) -> Place:
        """Where a value stands, or what holds it; zeros where that is not known."""
        while place and place not in self._spans:
            place = place[: max(place.rfind("."), place.rfind("["), 0)]
        return self._spans.get(place, Place(0, 0, 0))


class Found:
    """Problems as they are found."""

    def __init__(self, text: Text, name: str) -> None:
        """Nothing yet."""
        self._text = text
        self._name = name if text.source is None else text.source.name
        self._items: list[Diagnostic] = []
        self._said: set[str] = set()

    def error(self, place: str, message: str, hint: str = "") -> None:
        """Note, once, that something is wrong at a place, such as nprops[3].fix."""
        words = f"{place}: {message}" if place else message
        if words in self._said:
            return
        self._said.add(words)
        span = self._text.span_of(place)
        self._items.append(Diagnostic(Severity.ERROR, "bad-table", words, *span, help=hint))

    def require_none(self) -> None:
        """Raise if anything was found.

        Raises:
            TablesError: everything.
        """
        if self._items:
            raise TablesError(Problems.of(self._items), self._name, self._text.source)
