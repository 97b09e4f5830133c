# SPDX-License-Identifier: BSD-3-Clause
"""Some results beside each other: a row each, with a picture in a notebook."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import overload

from ...advice.describe import verdict_in_words
from ...analysis.result import Result
from ...analysis.text_margin import margin_in_short, verdict_word
from ...util.errors import require_kind
from ...util.plain_text import file_name, harmless
from ..page.markup import text
from ..page.verdict_part import kind_of
from .stills import SMALL, still
from .tables import table, verdict

#: How many rows have a picture: each takes some tenths of a second.
MOST_PICTURES = 40
_HEADS = ("", "mechanism", "verdict", "motions", "self-stresses", "margin")


class Results(Sequence[Result]):
    """Results in a row, which a notebook shows as a table with pictures.

    Args:
        results: Results of `analyse`, such as those of some designs.

    Raises:
        TypeError: One of them is no result.
    """

    def __init__(self, results: Iterable[Result]) -> None:
        """Keep them in their order."""
        self._all = tuple(results)
        for each in self._all:
            require_kind(each, Result, "a table of results holds results of analyse()")

    def __len__(self) -> int:
        """How many there are."""
        return len(self._all)

    @overload
    def __getitem__(self, index: int) -> Result: ...
    @overload
    def __getitem__(self, index: slice) -> Results: ...
    def __getitem__(self, index: int | slice) -> Result | Results:
        """One of them, or several."""
        return Results(self._all[index]) if isinstance(index, slice) else self._all[index]

    def __repr__(self) -> str:
        """A line each."""
        rows = [_words(each) for each in self._all]
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        lines = (
            "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
            for row in rows
        )
        return "\n".join(lines) or "no results"

    def _repr_html_(self) -> str:
        rows = [_cells(each, k < MOST_PICTURES) for k, each in enumerate(self._all)]
        return table(_HEADS, rows) if rows else "<p>No results.</p>"


def _words(result: Result) -> tuple[str, ...]:
    name = harmless(file_name(result.name)) or "model"
    counts = str(result.under_constrained), str(result.over_constrained)
    return name, verdict_word(result), *counts, margin_in_short(result)


def _cells(result: Result, is_pictured: bool) -> tuple[str, ...]:
    name, word, *others = _words(result)
    picture = still(result, SMALL, str(verdict_in_words(result))) if is_pictured else ""
    told = verdict(result.colour, kind_of(result)[1], word)
    return picture, f"<b>{text(name)}</b>", told, *map(text, others)
