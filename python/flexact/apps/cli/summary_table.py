# SPDX-License-Identifier: BSD-3-Clause
"""Lines of a table, one a deck, in the columns that a terminal has."""

from __future__ import annotations

import os
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import takewhile

from ...util.text import columns as columns_of
from .fitting import columns_to_fill, padded, shortened, shortened_middle

#: From so many columns of the terminal on there is a place for everything.
_WIDE, _WIDER = 64, 100
#: Columns that are left out where there are fewer.
_LESS = ("freedoms", "certainty")
#: Width of each column, and in a wide terminal.
_WIDTHS = {
    "verdict": (6, 8),
    "under": (5, 5),
    "over": (4, 5),
    "freedoms": (8, 8),
    "margin": (8, 8),
    "certainty": (9, 9),
    "errors": (6, 6),
    "warnings": (8, 8),
    "notes": (5, 5),
}
_WIDE_MARGIN = 20
_NUMBERS = ("under", "over", "freedoms", "errors", "warnings", "notes")
#: Of a cell.
Value = str | int | tuple[str, str]
#: A name is not made shorter than this where there are other columns.
_SHORTEST = 8


@dataclass(frozen=True)
class Cells:
    """What the line of a deck says.

    Attributes:
        values: By the names of the columns; texts, or numbers.
        error: Why there are no others, in place of those behind the first.
        first: The value of the first column, where there is an error.
        behind: What stands behind the last column.
    """

    values: Mapping[str, Value]
    error: str = ""
    first: str = "error"
    behind: str = ""


class SummaryTable:
    """The columns of a table, and its lines.

    A value that is two texts is the first in a narrow terminal, and the second in a wide one.
    """

    def __init__(self, columns: Sequence[str], names: Sequence[str]) -> None:
        """Lay out the columns behind that of the decks, whose names are known."""
        self.width = columns_to_fill()
        wide = self.width is None or self.width >= _WIDE
        self._wider = self.width is None or self.width >= _WIDER
        self._gap = " " * (2 if wide else 1)
        self._columns = {name: _WIDTHS[name][wide] for name in columns if wide or name not in _LESS}
        if self._wider and "margin" in self._columns:
            self._columns["margin"] = _WIDE_MARGIN
        self.folder, ending = "", ""
        longest = _longest(names)
        self._name = longest
        if self.width is not None:
            others = sum(self._columns.values()) + len(self._gap) * len(self._columns)
            room = max(self.width - others, _SHORTEST)
            if longest > room:
                # What all names have in common tells none from another.
                self.folder, ending = _in_common(names)
                longest -= columns_of(self.folder) + len(ending)
            self._name = max(min(longest, room), len("deck"))
        self._names = {name: name[len(self.folder) :].removesuffix(ending) for name in names}

    @property
    def place(self) -> str:
        """Where the decks are, in words, if the lines do not say so."""
        return f" in {self.folder.rstrip('/' + os.sep)}" if self.folder else ""

    @property
    def head(self) -> str:
        """The first line."""
        return self._line("deck", {name: name for name in self._columns})

    def line(self, name: str, cells: Cells) -> str:
        """The line of a deck."""
        made, behind = self._line(name, cells.values), cells.behind
        if cells.error:
            first = next(iter(self._columns))
            made, behind = self._line(name, {first: cells.first}, (first,)), cells.error
        if behind:
            made += self._gap + behind
        return made if self.width is None else shortened(made, self.width)

    def filled(self, words: str) -> str:
        """A sentence below the table."""
        if self.width is None:
            return words
        return textwrap.fill(words, self.width, subsequent_indent="  ", break_on_hyphens=False)

    def _line(
        self,
        name: str,
        values: Mapping[str, Value],
        columns: Sequence[str] = (),
    ) -> str:
        made = [padded(shortened_middle(self._names.get(name, name), self._name), self._name)]
        for column in columns or self._columns:
            value = values.get(column, "")
            text = value[self._wider] if isinstance(value, tuple) else str(value)
            made.append(padded(text, self._columns[column], right=column in _NUMBERS))
        return self._gap.join(made).rstrip()


def _longest(names: Sequence[str]) -> int:
    return max((columns_of(name) for name in ("deck", *names)), default=0)


def _in_common(names: Sequence[str]) -> tuple[str, str]:
    """The folder that all names lie in, with its stroke, and their common suffix."""
    if len(names) < 2:
        return "", ""
    first, last = min(names), max(names)
    alike = (a == b for a, b in zip(first, last, strict=False))
    start = first[: sum(takewhile(bool, alike))]
    folder = start[: max(start.rfind("/"), start.rfind(os.sep)) + 1]
    suffixes = {os.path.splitext(name)[1] for name in names}
    return folder, suffixes.pop() if len(suffixes) == 1 else ""
