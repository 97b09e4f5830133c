# SPDX-License-Identifier: BSD-3-Clause
"""``flexact report``: a page to open in a browser and to mail, and an index of several."""

from __future__ import annotations

import argparse
from pathlib import Path

from ...analysis.result import Result
from ...analysis.text_margin import verdict_word
from ...show.page import Entry
from ...show.page import index as index_page
from ...show.picture import has_packages
from ...show.saving import PAGES, as_bytes
from ...util.decks import DeckFile, find_decks
from ...util.errors import BatchError
from ...util.interruption import unwinding
from ...util.outputs import OutputError, plan_file, plan_files, write_together
from ...util.plain_text import harmless
from . import failures
from .bar import Bar
from .cli_decks import add_decks, take
from .decks import add_accuracy, add_decision, read_and_analysed
from .help_texts import add_examples
from .outcome import ExitCode, Outcome
from .pages import INDEX, WITHOUT_PICTURES, DeckPage, broken_page_of, page_of, unread
from .report import add_compare, compare
from .targets import folder_or
from .terminal import complain, say


def fill(parser: argparse.ArgumentParser) -> None:
    """Give the verb its description and arguments."""
    parser.description = (
        "Write the result of a deck as one HTML page that opens without a network: "
        "verdict, drawing in motion, self-stresses in colour, tables, deck. A deck with errors "
        "gives a page with its diagnostics, and exit code 1."
    )
    add_decks(parser)
    parser.add_argument(
        "-o",
        "--output",
        type=folder_or(*PAGES),
        metavar="PAGE",
        required=True,
        help="the page, NAME.html; or a folder for a page of each deck and index.html",
    )
    add_compare(parser)
    add_decision(parser)
    add_accuracy(parser)
    add_examples(
        parser,
        (
            "A page of a deck",
            "flexact report input_decks/paper/five_wires.dat -o results/wires.html",
        ),
        (
            "Pages of several decks, and an index",
            "flexact report input_decks/paper/five_wires.dat input_decks/linkages/rssr.dat "
            "-o results/pages",
        ),
        (
            "What changed between two decks, or two folders of decks or results",
            "flexact report input_decks/paper/six_folded_sheets.dat "
            "input_decks/paper/six_folded_sheets_released.dat --compare -o results/changes.html",
        ),
    )
    parser.set_defaults(run=report_decks)


def report_decks(chosen: argparse.Namespace) -> ExitCode:
    """Write the pages of the decks that were asked for, or the page that compares two runs."""
    if chosen.compare:
        return compare(chosen)
    if chosen.expect:
        raise BatchError("--expect same is for --compare")
    decks = find_decks(chosen.decks)
    work = _Work(chosen, decks)
    code = take(decks, work.step)
    work.finish()
    return code


class _Work:
    """One run of the verb: where each deck's page goes, and what the index will say."""

    def __init__(self, chosen: argparse.Namespace, decks: tuple[DeckFile, ...]) -> None:
        self.chosen, self.decks = chosen, decks
        output: Path = chosen.output
        self.index: Path | None = None
        if output.suffix.lower() in PAGES and not output.is_dir():
            if len(decks) > 1:
                raise BatchError(f"-o {output} is one page; of {len(decks)} decks name a folder")
            self.plan = plan_file(decks[0], output)
        else:
            self.plan = plan_files((*decks, INDEX), output, (".html",))
            self.index = self.plan[INDEX.path][0]
        self.entries: dict[str, Entry] = {}
        if not has_packages():
            complain(WITHOUT_PICTURES)

    def step(self, deck: DeckFile) -> Outcome:
        """Analyse one deck and write its page."""
        try:
            with Bar(deck.name, deck.path) as bar:
                analysis = read_and_analysed(deck, self.chosen, bar)
                bar.show("writing")
                self._write(deck, analysis)
        except BatchError:
            raise
        except Exception as unforeseen:
            error = failures.foreseen(unforeseen)
            self._write_broken(deck, error)
            raise error from None
        target = self.plan[deck.path][0]
        say(f"{harmless(deck.name)}: {verdict_word(analysis)}; page in {harmless(str(target))}")
        return Outcome(deck.name, ExitCode.ANALYSED, verdict_word(analysis))

    def _write(self, deck: DeckFile, analysis: Result) -> None:
        page = page_of(analysis, deck.relative.as_posix(), indexed=self.index is not None)
        with unwinding():
            self._put(deck, page)

    def _write_broken(self, deck: DeckFile, error: Exception) -> None:
        place, indexed = deck.relative.as_posix(), self.index is not None
        page = broken_page_of(error, deck.name, place, indexed=indexed)
        if page is None:
            return
        try:
            self._put(deck, page)
        except OutputError:
            failures.report_failure(deck, error)
            raise

    def _put(self, deck: DeckFile, page: DeckPage) -> None:
        write_together({self.plan[deck.path][0]: page.content})
        self.entries[deck.path] = page.entry

    def finish(self) -> None:
        """Write the index, if there is to be one."""
        if self.index is None:
            return
        entries = [
            self.entries.get(deck.path, unread(deck.relative.as_posix())) for deck in self.decks
        ]
        with unwinding():
            write_together({self.index: as_bytes(index_page(entries))})
        say(f"index in {harmless(str(self.index))}")
