# SPDX-License-Identifier: BSD-3-Clause
"""``flexact report``: a page to open in a browser and to mail, and an index of several."""

from __future__ import annotations

import argparse
from pathlib import Path

from flexact.base.errors import BatchError
from flexact.base.interruption import unwinding
from flexact.base.plain_text import harmless
from flexact.cli import failures
from flexact.cli.analysed import add_accuracy, add_decision, read_and_analysed
from flexact.cli.bar import Bar
from flexact.cli.decks import add_decks, take
from flexact.cli.outcome import ExitCode, Outcome
from flexact.cli.terminal import complain, say
from flexact.diagnostics.errors import DeckError, ProblemsError
from flexact.files.decks import DeckFile, find_decks
from flexact.files.outputs import OutputError, plan_file, plan_files, write_together
from flexact.page import BROKEN, Entry, broken_page, index_page, kind_of, reason_in_words
from flexact.picture import has_packages
from flexact.result.decompose import AnalysisError
from flexact.result.result import Result
from flexact.saving import PAGES, as_bytes, page_bytes, small_picture
from flexact.text.describe import verdict_in_words
from flexact.text.margin import margin_in_short, verdict_word

#: What the index takes the place of among the decks.
_INDEX = DeckFile("the index", Path("index"))
#: What is counted of decks without a verdict.
_BROKEN = "cannot be analysed"
_WITHOUT_PICTURES = (
    "without the packages matplotlib and pillow there are no still pictures, for browsers without "
    "WebGL and in the index: pip install 'flexact[pictures]'"
)


def fill(parser: argparse.ArgumentParser) -> None:
    """Give the verb its description and arguments."""
    parser.description = (
        "Write the result of a deck as one HTML page that opens without a network: "
        "verdict, drawing in motion, self-stresses in colour, tables, deck. A deck with errors "
        "gives a page with its diagnostics, and exit code 2."
    )
    add_decks(parser)
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="PAGE",
        required=True,
        help="the page, NAME.html; or a folder for a page of each deck and index.html",
    )
    add_decision(parser)
    add_accuracy(parser)
    parser.set_defaults(run=report_decks)


def report_decks(chosen: argparse.Namespace) -> ExitCode:
    """Write the pages of the decks that were asked for."""
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
            self.plan = plan_files((*decks, _INDEX), output, (".html",))
            self.index = self.plan[_INDEX.path][0]
        self.entries: dict[str, Entry] = {}
        if not has_packages():
            complain(_WITHOUT_PICTURES)

    def step(self, deck: DeckFile) -> Outcome:
        """Analyse one deck and write its page."""
        try:
            with Bar(deck.name, deck.path) as bar:
                analysis = read_and_analysed(deck, self.chosen, bar)
                bar.show("writing")
                self._write(deck, analysis)
        except (DeckError, AnalysisError) as error:
            self._write_broken(deck, error)
            raise
        target = self.plan[deck.path][0]
        say(f"{harmless(deck.name)}: {verdict_word(analysis)}; page in {harmless(str(target))}")
        return Outcome(deck.name, ExitCode.ANALYSED, verdict_word(analysis))

    def _write(self, deck: DeckFile, analysis: Result) -> None:
        with unwinding():
            content = page_bytes(analysis)
        with unwinding():
            self._put(deck, content)
            if self.index is None:
                return
            thumb = small_picture(analysis)
        place = deck.relative.as_posix()
        self.entries[deck.path] = Entry(
            *(place, f"{place}.html", kind_of(analysis), verdict_word(analysis)),
            *(verdict_in_words(analysis).start, margin_in_short(analysis), thumb),
        )

    def _write_broken(self, deck: DeckFile, error: Exception) -> None:
        if isinstance(error, ProblemsError):
            codes = {item.code for item in error.diagnostics}
            if codes & failures.NOT_READ:
                return
        try:
            self._put(deck, as_bytes(broken_page(error, deck.name)))
        except OutputError:
            failures.report_failure(deck, error)
            raise
        words = f"Cannot be analysed: {reason_in_words(error)}"
        place = deck.relative.as_posix()
        self.entries[deck.path] = Entry(place, f"{place}.html", BROKEN, _BROKEN, words)

    def _put(self, deck: DeckFile, content: bytes) -> None:
        write_together({self.plan[deck.path][0]: content})

    def finish(self) -> None:
        """Write the index, if there is to be one."""
        if self.index is None:
            return
        nothing = "Cannot be read"
        entries = [
            self.entries.get(
                deck.path, Entry(deck.relative.as_posix(), "", BROKEN, _BROKEN, nothing)
            )
            for deck in self.decks
        ]
        with unwinding():
            write_together({self.index: as_bytes(index_page(entries))})
        say(f"index in {harmless(str(self.index))}")
