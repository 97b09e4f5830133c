# SPDX-License-Identifier: BSD-3-Clause
"""``flexact analyse --summary``: one line a deck, in a table that fits the terminal."""

from __future__ import annotations

import argparse
import os
import textwrap
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from itertools import takewhile
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from ...analysis.result import Result
from ...analysis.verdict import Certainty, Verdict
from ...analysis.verdict_words import certainty_word, margin_cells
from ...util.decks import DeckFile
from ...util.loading import load
from ...util.text import columns as columns_of
from ...util.text import harmless
from .decks import analysed, each_of, foreseen, opened, outcome_of
from .parser import Argument, argument
from .terminal import (
    Bar,
    ExitCode,
    Outcome,
    columns_to_fill,
    exit_code,
    padded,
    say,
    shortened,
    shortened_middle,
)

if TYPE_CHECKING:
    from ...sweeps.writing import Cell


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


class Cells(NamedTuple):
    """What the line of a deck says."""

    values: Mapping[str, Value]
    """By the names of the columns; texts, or numbers."""
    error: str = ""
    """Why there are no others, in place of those behind the first."""
    first: str = "error"
    """The value of the first column, where there is an error."""
    behind: str = ""
    """What stands behind the last column."""


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
        longest = max(columns_of(name) for name in ("deck", *names))
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


#: Suffixes of -o that mean the table itself.
TABLES = (".csv", ".jsonl", ".parquet")
_COLUMNS = ("verdict", "under", "over", "freedoms", "margin", "certainty")


def summary_argument(about: str) -> Argument:
    """The choice of a table."""
    return argument("--summary", action="store_true", help=about)


def is_table(path: Path | None) -> bool:
    """Whether a path names a table, by its suffix."""
    return path is not None and path.suffix.lower() in TABLES


def summarise(
    decks: Sequence[DeckFile],
    columns: Sequence[str],
    step: Callable[[DeckFile], tuple[Cells, Outcome]],
) -> ExitCode:
    """Take decks through `step`, a line each as soon as it is known, then what they add up to.

    Args:
        decks: The decks.
        columns: Names of columns behind that of the deck; see `SummaryTable`.
        step: What is done with a deck; it may raise what `take` takes.
    """
    table = SummaryTable(columns, [harmless(deck.name) for deck in decks])
    say(table.head)
    outcomes = []
    for deck, (cells, outcome) in zip(decks, each_of(decks, step, failed), strict=True):
        say(table.line(harmless(deck.name), cells))
        outcomes.append(outcome)
    # Of a deck without a verdict the lines say why.
    counts = Counter(outcome.result for outcome in outcomes)
    parts = ", ".join(
        f"{count} {'with errors' if result == 'failed' else result}"
        for result, count in counts.most_common()
    )
    many = len(outcomes)
    say(table.filled(f"{many} deck{'s' * (many != 1)}{table.place}: {parts}"))
    for outcome in outcomes:
        if outcome.code is ExitCode.DIFFERENT:
            say(f"  not as expected: {harmless(outcome.deck)}")
    return exit_code(outcomes)


def failed(deck: DeckFile, error: Exception) -> tuple[Cells, Outcome]:
    """The line of a deck that has no result: its first error."""
    words = load("flexact.sweeps.batch").first_error(error, "")
    words = words.removeprefix(f"{harmless(deck.name)}: ").removeprefix(":").lstrip()
    return Cells({}, words), outcome_of(deck, error)


def summarise_results(
    chosen: argparse.Namespace,
    decks: Sequence[DeckFile],
    finish: Callable[[DeckFile, Result], Outcome],
) -> ExitCode:
    """Analyse decks, each for its line, and write the table where that was asked for.

    Args:
        chosen: The options of the verb.
        decks: The decks.
        finish: Writes what else is wanted of a result, and says what its verdict asks for.

    Raises:
        OutputError: The table has no place.
    """
    target: Path | None = chosen.output if is_table(chosen.output) else None
    if target is not None:
        load("flexact.apps.cli.batch").require_place(target, decks)
    rows: dict[str, dict[str, Cell]] = {}

    def step(deck: DeckFile) -> tuple[Cells, Outcome]:
        try:
            with Bar(deck.name, deck.path) as bar:
                result = analysed(deck, opened(deck, bar), chosen, bar)
                told = _cells(result), finish(deck, result)
        except Exception as error:
            told = failed(deck, foreseen(error))
            rows[deck.name] = {"error": told[0].error}
        else:
            if target is not None:
                rows[deck.name] = {
                    **load("flexact.sweeps.columns").row_of(result),
                    "degrees_of_freedom": result.degrees_of_freedom,
                    "certainty": certainty_word(result),
                }
        return told

    code = summarise(decks, _COLUMNS, step)
    if target is not None:
        columns = _columns()
        # A folder that gives no decks has not come to a step.
        found = ((deck, rows.get(deck.name, {"error": str(deck.error)})) for deck in decks)
        lines = ([deck.name, *(row.get(c.name) for c in columns[1:])] for deck, row in found)
        load("flexact.sweeps.writing").write_table(target, columns, lines)
        say(f"table in {harmless(str(target))}")
    return code


def _columns() -> tuple[Any, ...]:
    """The columns of the table as a file: those that `batch` has too go by the same names."""
    rows, known = load("flexact.sweeps.batch"), load("flexact.sweeps.columns")
    names = ("verdict", "under_constrained", "over_constrained", "certainty", "margin")
    of = {column.name: column for column in known.COLUMNS}
    freedoms = known.Column("degrees_of_freedom", int, "declared degrees of freedom", "verdict")
    counts = (*(of[name] for name in names[:3]), freedoms)
    return (rows.DECK, *counts, of["certainty"], of["margin"], of["margin_angle"], known.ERROR)


def _cells(result: Result) -> Cells:
    word = result.verdict.word
    if result.verdict is Verdict.EXACT and result.is_marginal:
        word = "marginal"
    sure = certainty_word(result)
    doubt = "?" * (result.certainty is Certainty.DOUBTFUL)
    return Cells(
        {
            "verdict": word + doubt,
            "under": result.under_constrained,
            "over": result.over_constrained,
            "freedoms": result.degrees_of_freedom,
            "margin": margin_cells(result),
            "certainty": "certain" if sure == Certainty.CERTAIN.value else sure,
        }
    )
