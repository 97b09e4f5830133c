# SPDX-License-Identifier: BSD-3-Clause
"""Everything that is wrong with tables, each with its place, in one error."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property

from ..diagnostics.diagnostic import Diagnostic, Problems, Severity
from ..diagnostics.errors import ProblemsError
from ..diagnostics.source import Source


class TablesError(ProblemsError, ValueError):
    """Tables that are no model; each problem begins with its place, such as nprops[3].fix."""


class Text:
    """The text that tables were read from.

    Attributes:
        source: The text and its name, if there is one.
    """

    def __init__(
        self, source: Source | None = None, lines: Callable[[], Mapping[str, int]] | None = None
    ) -> None:
        """Keep the text, and how the line of each place is found when it is asked for."""
        self.source = source
        self._find_lines = lines

    @cached_property
    def _lines(self) -> Mapping[str, int]:
        return {} if self._find_lines is None else self._find_lines()

    def line_of(self, place: str) -> int:
        """The line of a place, or of what holds it; 0 where it is not known."""
        while place and place not in self._lines:
            place = place[: max(place.rfind("."), place.rfind("["), 0)]
        return self._lines.get(place, 0)


class Found:
    """Problems as they are found."""

    def __init__(self, text: Text, name: str) -> None:
        """Nothing yet."""
        self._text = text
        self._name = name
        self._items: list[Diagnostic] = []

    def error(self, place: str, message: str, hint: str = "") -> None:
        """Note that something is wrong at a place, such as nprops[3].fix."""
        line = self._text.line_of(place)
        words = f"{place}: {message}" if place else message
        row = self._text.source.line(line) if self._text.source is not None and line else b""
        indent = len(row) - len(row.lstrip())
        columns = (indent + 1, max(indent + 1, len(row.rstrip()))) if line else (0, 0)
        self._items.append(
            Diagnostic(Severity.ERROR, "bad-table", words, line, *columns, help=hint)
        )

    def require_none(self) -> None:
        """Raise if anything was found.

        Raises:
            TablesError: everything.
        """
        if self._items:
            raise TablesError(Problems.of(self._items), self._name, self._text.source)
