# SPDX-License-Identifier: BSD-3-Clause
"""``flexact analyse``: verdict, counts, motions and self-stresses of decks."""

from __future__ import annotations

import argparse
import re
import sys
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ...advice.describe import MOST_MODES, describe, verdict_in_words
from ...analysis.result import Result
from ...analysis.verdict import Verdict
from ...analysis.verdict_words import verdict_word
from ...deck.rendering import DeckError
from ...model.reading import read_deck
from ...util.decks import DeckFile, find_decks
from ...util.errors import BatchError
from ...util.loading import load
from ...util.partial import attempted
from ...util.text import harmless
from . import decks as failures
from . import terminal as colour
from .decks import add_accuracy, add_decision, add_decks, read_and_analysed, report_problems, take
from .help_texts import add_examples
from .outcome import ExitCode, Outcome
from .summary import TABLES, Analysed, add_summary, is_table
from .targets import FormatOrMesh, FormsOrMeshes, add_mesh, folder_or
from .terminal import Bar, complain, give, is_coloured, say, text_width

if TYPE_CHECKING:
    from .targets import ResultFiles


TEXT, GITHUB, SARIF = FORMS = ("text", "github", "sarif")


def add_format(parser: argparse.ArgumentParser, *, was_mesh: bool = False) -> None:
    """Add to a verb's parser for whom it writes.

    Args:
        parser: The parser.
        was_mesh: Whether the option stood for what is `--mesh` now.
    """
    parser.add_argument(
        "--format",
        action=FormatOrMesh if was_mesh else "store",
        choices=FormsOrMeshes(FORMS) if was_mesh else FORMS,
        default=TEXT,
        help="words for people (default), annotations of a GitHub workflow, or SARIF 2.1.0",
    )


def require_one_form(chosen: argparse.Namespace) -> None:
    """Raise where several options say what stdout holds.

    Raises:
        BatchError: They do.
    """
    given = [f"--{name}" for name in ("summary", "json", "log") if getattr(chosen, name, None)]
    if chosen.format != TEXT:
        given.append(f"--format {chosen.format}")
    if "--summary" in given and len(given) > 1:
        raise BatchError(f"--summary is in place of {given[1]}; choose one")
    if len(given) > 1 and not ("--log" in given and chosen.output):
        mend = ", or give -o DIR for the log" if "--log" in given else ""
        raise BatchError(f"{given[0]} and {given[1]} both go to stdout: choose one{mend}")


class Findings:
    """Writes what is found: annotations deck by deck, SARIF when all decks are done."""

    def __init__(self, form: str) -> None:
        """Keep the form, one of `FORMS` that is for programs."""
        self._form = form
        self._kept: list[Any] = []

    def checked(self, deck: DeckFile) -> Outcome:
        """Read a deck, and write its problems."""
        model = read_deck(deck)
        report_problems(model)
        module = load("flexact.apps.checks.findings")
        self._add(module.findings_of(deck.name, model.problems, model.source))
        return Outcome(deck.name, ExitCode.ANALYSED, "without errors")

    def analysed(self, deck: DeckFile, result: Result, expected: Verdict | None) -> None:
        """Write what is found in a deck that was analysed."""
        module = load("flexact.apps.checks.findings")
        self._add(module.findings_about(deck.name, result, expected))

    def failed(self, deck: DeckFile, error: Exception) -> None:
        """Write why a deck failed."""
        source = error.source if isinstance(error, DeckError) else None
        module = load("flexact.apps.checks.findings")
        self._add(module.findings_of(deck.name, failures.problems_of(error), source))

    def _add(self, findings: list[Any]) -> None:
        if self._form == SARIF:
            self._kept += findings
            return
        lines = map(load("flexact.apps.checks.outputs").annotation, findings)
        if text := "\n".join(lines):
            give(text)

    def finish(self, code: ExitCode) -> ExitCode:
        """Write what waits until all decks are done; gives back the code."""
        if self._form == SARIF:
            ended_well = code is not ExitCode.OTHER
            module = load("flexact.apps.checks.sarif")
            log = module.log_of(self._kept, int(code), ended_well=ended_well)
            give(load("json").dumps(log, indent=1))
        return code


VERDICTS = {verdict.word: verdict for verdict in Verdict}
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
        type=folder_or(*TABLES),
        metavar="DIR",
        help="write NAME.json, NAME.log and the mesh NAME.vtu there; with --summary also "
        "TABLE.csv, .jsonl or .parquet",
    )
    add_summary(parser, "a table, one line a deck, in place of the words")
    add_format(parser, was_mesh=True)
    add_mesh(parser, "-o")
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
            "A line of each deck of a folder, and the same as a table",
            "flexact analyse input_decks/paper --summary -o results/decks.csv",
        ),
        (
            "A deck that another program writes",
            "cat input_decks/paper/five_wires.dat | flexact analyse -",
        ),
        (
            "In a design's own CI: exits with 3 unless it is so",
            "flexact analyse input_decks/paper/five_wires.dat --expect exact",
        ),
        (
            "The same in a workflow of GitHub, with marks beside the lines of a pull request",
            "flexact analyse input_decks/paper/five_wires.dat --expect exact --format github",
        ),
    )
    parser.set_defaults(run=analyse_decks)


def analyse_decks(chosen: argparse.Namespace) -> ExitCode:
    """Analyse the decks that were asked for, say and write the results."""
    if chosen.mesh and not chosen.output:
        raise BatchError("--mesh needs a folder: -o DIR")
    require_one_form(chosen)
    if chosen.output and is_table(chosen.output) and not chosen.summary:
        raise BatchError(f"-o {chosen.output} is a table, which --summary writes; or name a folder")
    decks = find_decks(chosen.decks)
    work = _Work(chosen, decks)
    if chosen.summary:
        return Analysed(chosen, decks, work.judge_and_write).run()
    findings = work.findings
    if findings is None:
        return take(decks, work.step, as_json=chosen.json)
    return findings.finish(take(decks, work.step, on_failure=findings.failed))


class _Work:
    """One run of the verb: what was chosen, and what writes each deck's results."""

    def __init__(self, chosen: argparse.Namespace, decks: tuple[DeckFile, ...]) -> None:
        self.chosen = chosen
        self.files: ResultFiles | None = None
        self.findings = None if chosen.format == TEXT else Findings(chosen.format)
        if chosen.output and not is_table(chosen.output):
            module = load("flexact.apps.cli.targets")
            self.files = module.ResultFiles(
                decks, chosen.output, chosen.mesh or "vtu", log=chosen.log
            )

    def step(self, deck: DeckFile) -> Outcome:
        """Analyse one deck, say and write its results."""
        with Bar(deck.name, deck.path) as bar:
            analysis = read_and_analysed(deck, self.chosen, bar)
            bar.show("writing")
            failure = self._written(deck, analysis)
            words, is_data = ("", True) if self.findings else self._words(analysis)
        if self.findings:
            self.findings.analysed(deck, analysis, VERDICTS.get(self.chosen.expect))
        else:
            give(words) if is_data else say(words)
        outcome = self.judge(deck, analysis)
        if outcome.code is ExitCode.DIFFERENT:
            wanted = VERDICTS[self.chosen.expect].value
            found = verdict_in_words(analysis).start.lower()
            complain(f"{harmless(deck.name)}: {found}; expected {wanted}")
        return outcome if failure is None else _not_written(deck, outcome, failure)

    def judge(self, deck: DeckFile, analysis: Result) -> Outcome:
        """What the verdict asks for."""
        code, word = ExitCode.ANALYSED, verdict_word(analysis)
        if self.chosen.expect and word != VERDICTS[self.chosen.expect].value:
            code = ExitCode.DIFFERENT
        return Outcome(deck.name, code, word)

    def judge_and_write(self, deck: DeckFile, analysis: Result) -> Outcome:
        """What the verdict asks for, once the files of the result are written."""
        outcome, failure = self.judge(deck, analysis), self._written(deck, analysis)
        return outcome if failure is None else _not_written(deck, outcome, failure)

    def _written(self, deck: DeckFile, analysis: Result) -> Exception | None:
        return self.files.write(deck, analysis) if self.files else None

    def _words(self, analysis: Result) -> tuple[str, bool]:
        """What is said, and whether it is data."""
        if self.chosen.json:
            return load("flexact.analysis.json").text_of(analysis), True
        if self.chosen.log and not self.files:
            return load("flexact.show.spacar_log").spacar_log(analysis), True
        # What concerns the deck stands on stderr already.
        width = text_width()
        words = describe(analysis, about_model=False, most=MOST_MODES, width=width)
        if analysis.over_constrained and analysis.given.properties is not None:
            # It takes a while to load.
            quick, told = load("flexact.costs.quick_cost"), words
            missing: list[str] = []
            words = attempted(
                "What over-constraint costs",
                lambda: str(quick.with_quick_cost(told, analysis, width)),
                words,
                missing,
            )
            complain("\n".join(f"{harmless(analysis.name)}: note: {each}" for each in missing))
        return f"{_coloured(words, analysis)}\n", False


def _coloured(words: str, analysis: Result) -> str:
    """The words with the verdict in its colour, where colour is wanted."""
    if not is_coloured(sys.stdout):
        return words
    # The words may be broken into rows anywhere.
    verdict = r"\s+".join(map(re.escape, verdict_in_words(analysis).start.split()))
    style = "bad"
    if analysis.verdict is Verdict.EXACT:
        style = "unsure" if analysis.is_marginal else "good"
    return re.sub(verdict, lambda found: colour.painted(found[0], style), words, count=1)


def _not_written(deck: DeckFile, outcome: Outcome, failure: Exception) -> Outcome:
    failures.report_failure(deck, failure)
    return replace(outcome, code=ExitCode.OTHER, remark="results not written")
