# SPDX-License-Identifier: BSD-3-Clause
"""``flexact analyse``: verdict, counts, motions and self-stresses of decks."""

from __future__ import annotations

import argparse
from dataclasses import replace
from typing import TYPE_CHECKING

from flexact.base.errors import BatchError
from flexact.base.loading import load
from flexact.base.plain_text import harmless
from flexact.cli import failures
from flexact.cli.analysed import add_accuracy, add_decision, read_and_analysed
from flexact.cli.bar import Bar
from flexact.cli.decks import add_decks, take
from flexact.cli.help_texts import add_examples
from flexact.cli.outcome import ExitCode, Outcome
from flexact.cli.targets import folder
from flexact.cli.terminal import complain, say
from flexact.files.decks import DeckFile, find_decks
from flexact.result.result import Result
from flexact.result.verdict import Verdict
from flexact.text.describe import MOST_MODES, describe, verdict_in_words
from flexact.text.margin import verdict_word

if TYPE_CHECKING:
    from flexact.cli.result_files import ResultFiles

VERDICTS = {
    "exact": Verdict.EXACT,
    "under": Verdict.UNDER,
    "over": Verdict.OVER,
    "both": Verdict.BOTH,
}
#: Forms of logs beside that of Flexact.
LOGS = ("spacar",)


def fill(parser: argparse.ArgumentParser) -> None:
    """Give the verb its description and arguments."""
    parser.description = "Decide whether mechanisms are exactly, under- or over-constrained."
    add_decks(parser)
    parser.add_argument("--json", action="store_true", help="one JSON object a line on stdout")
    parser.add_argument(
        "-o",
        "--output",
        type=folder,
        metavar="DIR",
        help="write NAME.json, NAME.log and the mesh NAME.vtu there",
    )
    parser.add_argument(
        "--format", metavar="FORMAT", help="mesh format: vtu (default), vtk, xdmf, ..."
    )
    parser.add_argument(
        "--log",
        choices=LOGS,
        help="the log in the form of SPACAR's in place of the words, or, with -o, as NAME.log",
    )
    add_decision(parser)
    add_accuracy(parser)
    parser.add_argument(
        "--expect",
        choices=VERDICTS,
        help="exit with 3 for any other verdict, and for an exact one within the accuracy only",
    )
    add_examples(
        parser,
        (
            "Verdict, motions and self-stresses of a deck",
            "flexact analyse input_decks/paper/five_wires.dat",
        ),
        (
            "JSON, log and mesh of each deck of a folder",
            "flexact analyse input_decks/paper -o results",
        ),
        (
            "A deck that another program writes",
            "cat input_decks/paper/five_wires.dat | flexact analyse -",
        ),
        (
            "In a design's own CI: exits with 3 unless it is so",
            "flexact analyse input_decks/paper/five_wires.dat --expect exact",
        ),
    )
    parser.set_defaults(run=analyse_decks)


def analyse_decks(chosen: argparse.Namespace) -> ExitCode:
    """Analyse the decks that were asked for, say and write the results."""
    if chosen.format and not chosen.output:
        raise BatchError("--format is for the mesh, which needs a folder: -o DIR")
    if chosen.log and chosen.json and not chosen.output:
        raise BatchError("--json and --log both go to stdout: choose one, or a folder: -o DIR")
    decks = find_decks(chosen.decks)
    return take(decks, _Work(chosen, decks).step, as_json=chosen.json)


class _Work:
    """One run of the verb: what was chosen, and what writes each deck's results."""

    def __init__(self, chosen: argparse.Namespace, decks: tuple[DeckFile, ...]) -> None:
        self.chosen = chosen
        self.files: ResultFiles | None = None
        if chosen.output:
            module = load("flexact.cli.result_files")
            self.files = module.ResultFiles(
                decks, chosen.output, chosen.format or "vtu", log=chosen.log
            )

    def step(self, deck: DeckFile) -> Outcome:
        """Analyse one deck, say and write its results."""
        with Bar(deck.name, deck.path) as bar:
            analysis = read_and_analysed(deck, self.chosen, bar)
            bar.show("writing")
            failure = self.files.write(deck, analysis) if self.files else None
            words = self._words(analysis)
        say(words)
        outcome = self._judge(deck, analysis)
        if failure is None:
            return outcome
        failures.report_failure(deck, failure)
        return replace(outcome, code=ExitCode.OTHER, remark="results not written")

    def _judge(self, deck: DeckFile, analysis: Result) -> Outcome:
        code, word = ExitCode.ANALYSED, verdict_word(analysis)
        if self.chosen.expect and word != VERDICTS[self.chosen.expect].value:
            code = ExitCode.DIFFERENT
            wanted = VERDICTS[self.chosen.expect].value
            found = verdict_in_words(analysis).start.lower()
            complain(f"{harmless(deck.name)}: {found}; expected {wanted}")
        return Outcome(deck.name, code, word)

    def _words(self, analysis: Result) -> str:
        if self.chosen.json:
            text: str = load("flexact.text.json_result").text_of(analysis)
            return text
        if self.chosen.log and not self.files:
            log: str = load("flexact.text.spacar_log").spacar_log(analysis)
            return log
        # What concerns the deck stands on stderr already.
        words = describe(analysis, about_model=False, most=MOST_MODES)
        if analysis.over_constrained and analysis.given.properties is not None:
            # It takes a while to load.
            words = load("flexact.costing.glance").with_glance(words, analysis)
        return f"{words}\n"
