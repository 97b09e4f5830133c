# SPDX-License-Identifier: BSD-3-Clause
"""``flexact analyse --summary``: one line a deck, in a table that fits the terminal."""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from ...analysis.result import Result
from ...analysis.text_margin import margin_cells
from ...analysis.verdict import Certainty, Verdict
from ...analysis.verdict_words import certainty_word
from ...util.decks import DeckFile
from ...util.loading import load
from ...util.plain_text import harmless
from .bar import Bar
from .decks import analysed, opened
from .failures import foreseen, outcome_of
from .outcome import ExitCode, Outcome, exit_code
from .summary_table import Cells, SummaryTable
from .terminal import end_progress, say, show_progress

if TYPE_CHECKING:
    from ...sweeps.writing import Cell

#: Suffixes of -o that mean the table itself.
TABLES = (".csv", ".jsonl", ".parquet")
_COLUMNS = ("verdict", "under", "over", "freedoms", "margin", "certainty")


def add_summary(parser: argparse.ArgumentParser, about: str) -> None:
    """Add the choice of a table to a verb's parser."""
    parser.add_argument("--summary", action="store_true", help=about)


def is_table(path: Path | None) -> bool:
    """Whether a path names a table, by its suffix."""
    return path is not None and path.suffix.lower() in TABLES


class Told(NamedTuple):
    """What came of a deck: its line, and what the command makes of it."""

    cells: Cells
    outcome: Outcome


def summarise(
    decks: Sequence[DeckFile], columns: Sequence[str], step: Callable[[DeckFile], Told]
) -> ExitCode:
    """Take decks through `step`, a line each as soon as it is known, then what they add up to.

    Args:
        decks: The decks.
        columns: Names of columns behind that of the deck; see `summary_table`.
        step: What is done with a deck; it may raise what `take` takes.
    """
    table = SummaryTable(columns, [harmless(deck.name) for deck in decks])
    say(table.head)
    outcomes = []
    for number, deck in enumerate(decks, start=1):
        show_progress(number, len(decks), deck.name)
        told = _attempt(deck, step)
        say(table.line(harmless(deck.name), told.cells))
        outcomes.append(told.outcome)
    end_progress()
    say(table.filled(_total(outcomes, table.place)))
    wrong = [each for each in outcomes if each.code is ExitCode.DIFFERENT]
    for outcome in wrong:
        say(f"  not as expected: {harmless(outcome.deck)}")
    return exit_code(outcomes)


def _attempt(deck: DeckFile, step: Callable[[DeckFile], Told]) -> Told:
    try:
        if deck.error is not None:
            raise deck.error
        return step(deck)
    except Exception as error:
        return failed(deck, foreseen(error))


def failed(deck: DeckFile, error: Exception) -> Told:
    """The line of a deck that has no result: its first error."""
    words = load("flexact.sweeps.deck_rows").first_error(error, "")
    words = words.removeprefix(f"{harmless(deck.name)}: ").removeprefix(":").lstrip()
    return Told(Cells({}, words), outcome_of(deck, error))


def _total(outcomes: Sequence[Outcome], place: str) -> str:
    counts = Counter(outcome.result for outcome in outcomes)
    # Of a deck without a verdict the lines say why.
    parts = ", ".join(
        f"{count} {'with errors' if result == 'failed' else result}"
        for result, count in counts.most_common()
    )
    many = len(outcomes)
    return f"{many} deck{'s' * (many != 1)}{place}: {parts}"


class Analysed:
    """Decks analysed one by one, each for its line, and the table that is written of them."""

    def __init__(
        self,
        chosen: argparse.Namespace,
        decks: Sequence[DeckFile],
        finish: Callable[[DeckFile, Result], Outcome],
    ) -> None:
        """What was chosen.

        Args:
            chosen: The options of the verb.
            decks: The decks.
            finish: Writes what else is wanted of a result, and says what its verdict asks for.

        Raises:
            OutputError: The table has no place.
        """
        self.chosen, self.decks, self._finish = chosen, decks, finish
        self._rows: dict[str, dict[str, Cell]] = {}
        if is_table(chosen.output):
            load("flexact.apps.cli.batch").require_place(chosen.output, decks)

    def run(self) -> ExitCode:
        """Print the table, and write it where that was asked for."""
        code = summarise(self.decks, _COLUMNS, self._step)
        if is_table(self.chosen.output):
            table: Path = self.chosen.output
            load("flexact.sweeps.writing").write_table(table, _columns(), self._lines())
            say(f"table in {harmless(str(table))}")
        return code

    def _step(self, deck: DeckFile) -> Told:
        try:
            with Bar(deck.name, deck.path) as bar:
                result = analysed(deck, opened(deck, bar), self.chosen, bar)
                told = Told(_cells(result), self._finish(deck, result))
        except Exception as error:
            told = failed(deck, foreseen(error))
            self._rows[deck.name] = {"error": told.cells.error}
        else:
            if is_table(self.chosen.output):
                self._rows[deck.name] = _values(result)
        return told

    def _lines(self) -> Iterator[list[Cell]]:
        names = [column.name for column in _columns()]
        for deck in self.decks:
            # A folder that gives no decks has not come to a step.
            row = self._rows.get(deck.name, {"error": str(deck.error)})
            yield [deck.name, *(row.get(name) for name in names[1:])]


def _columns() -> tuple[Any, ...]:
    """The columns of the table as a file: those that `batch` has too go by the same names."""
    rows, known = load("flexact.sweeps.deck_rows"), load("flexact.sweeps.columns")
    names = ("verdict", "under_constrained", "over_constrained", "certainty", "margin")
    of = {column.name: column for column in known.COLUMNS}
    freedoms = known.Column("degrees_of_freedom", int, "declared degrees of freedom", "verdict")
    counts = (*(of[name] for name in names[:3]), freedoms)
    return (rows.DECK, *counts, of["certainty"], of["margin"], of["margin_angle"], known.ERROR)


def _values(result: Result) -> dict[str, Cell]:
    made: dict[str, Cell] = load("flexact.sweeps.row").row_of(result)
    more: dict[str, Cell] = {
        "degrees_of_freedom": result.degrees_of_freedom,
        "certainty": certainty_word(result),
    }
    return {**made, **more}


def _cells(result: Result) -> Cells:
    word = result.verdict.word
    if result.verdict is Verdict.EXACT and result.is_marginal:
        word = "marginal"
    sure = certainty_word(result)
    doubt = "?" * (result.certainty is Certainty.NEARLY)
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
