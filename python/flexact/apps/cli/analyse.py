# SPDX-License-Identifier: BSD-3-Clause
"""``flexact analyse``: verdict, counts, motions and self-stresses of decks."""

from __future__ import annotations

import argparse
import re
import sys
from typing import Any

from ...advice.describe import MOST_MODES, describe, verdict_in_words
from ...advice.todo import todo_of
from ...analysis.result import Result
from ...analysis.verdict import Verdict
from ...analysis.verdict_words import verdict_word
from ...deck.rendering import DeckError
from ...model.data import ModelData
from ...show.writers import TABLES
from ...util.decks import DeckFile, find_decks
from ...util.errors import BatchError
from ...util.loading import load
from ...util.text import harmless
from .decks import (
    ACCURACY_AND_BEYOND,
    DECISION,
    DECKS,
    GRAVITY,
    UNITS,
    is_table,
    problems_of,
    read_and_analysed,
    report_failure,
    summarise_results,
    summary_argument,
    take,
)
from .parser import Verb, argument
from .targets import folder_or, mesh_argument
from .terminal import (
    Bar,
    ExitCode,
    Outcome,
    complain,
    give,
    is_coloured,
    is_verbose,
    painted,
    say,
    text_width,
)

TEXT, GITHUB, SARIF = FORMS = ("text", "github", "sarif")


FORMAT = argument(
    "--format",
    choices=FORMS,
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

    def checked(self, deck: DeckFile, model: ModelData) -> None:
        """Write the problems of a deck that was read."""
        self._add("findings_of", deck, model.problems, model.source)

    def analysed(self, deck: DeckFile, result: Result, expected: Verdict | None) -> None:
        """Write what is found in a deck that was analysed."""
        self._add("findings_about", deck, result, expected)

    def failed(self, deck: DeckFile, error: Exception) -> None:
        """Write why a deck failed."""
        source = error.source if isinstance(error, DeckError) else None
        self._add("findings_of", deck, problems_of(error), source)

    def _add(self, function: str, deck: DeckFile, *about: object) -> None:
        found = getattr(load("flexact.apps.checks.findings"), function)(deck.name, *about)
        if self._form == SARIF:
            self._kept += found
        elif text := "\n".join(map(load("flexact.apps.checks.outputs").annotation, found)):
            give(text)

    def finish(self, code: ExitCode) -> ExitCode:
        """Write what waits until all decks are done; gives back the code."""
        if self._form == SARIF:
            log_of = load("flexact.apps.checks.outputs").log_of
            log = log_of(self._kept, int(code), ended_well=code is not ExitCode.OTHER)
            give(load("json").dumps(log, indent=1))
        return code


VERDICTS = {verdict.word: verdict for verdict in Verdict}
#: Forms of logs beside that of Flexact.
LOGS = ("spacar",)


def analyse_decks(chosen: argparse.Namespace) -> ExitCode:
    """Analyse the decks that were asked for, say and write the results."""
    if chosen.mesh and not chosen.output:
        raise BatchError("--mesh needs a folder: -o DIR")
    require_one_form(chosen)
    if chosen.output and is_table(chosen.output) and not chosen.summary:
        raise BatchError(f"-o {chosen.output} is a table, which --summary writes; or name a folder")
    decks = find_decks(chosen.decks)
    findings = None if chosen.format == TEXT else Findings(chosen.format)
    form, plan = "", {}
    if chosen.output and not is_table(chosen.output):
        plan_results = load("flexact.apps.cli.export").plan_results
        form, plan = plan_results(decks, chosen.output, chosen.mesh or "vtu")
    wanted = VERDICTS.get(chosen.expect)

    def written(deck: DeckFile, result: Result) -> Exception | None:
        writing: Any = load("flexact.apps.cli.export") if plan else None
        made: Exception | None = writing and writing.write_results(
            *(result, plan[deck.path], form, chosen.log)
        )
        return made

    def judged(deck: DeckFile, result: Result, failure: Exception | None) -> Outcome:
        """What the verdict asks for, once the files are written, or why they are not."""
        word = verdict_word(result)
        is_wrong = wanted is not None and word != wanted.value
        code = ExitCode.DIFFERENT if is_wrong else ExitCode.ANALYSED
        if failure is None:
            return Outcome(deck.name, code, word)
        report_failure(deck, failure)
        return Outcome(deck.name, ExitCode.OTHER, word, "results not written")

    def step(deck: DeckFile) -> Outcome:
        """Analyse one deck, say and write its results."""
        with Bar(deck.name, deck.path) as bar:
            result = read_and_analysed(deck, chosen, bar)
            bar.show("writing")
            failure = written(deck, result)
            words, is_data = ("", True) if findings else _words(result, chosen, bool(plan))
        if findings:
            findings.analysed(deck, result, wanted)
        else:
            give(words) if is_data else say(words)
        if wanted is not None and verdict_word(result) != wanted.value:
            found = verdict_in_words(result).start.lower()
            complain(f"{harmless(deck.name)}: {found}; expected {wanted.value}")
        return judged(deck, result, failure)

    if chosen.summary:
        return summarise_results(
            chosen, decks, lambda deck, result: judged(deck, result, written(deck, result))
        )
    if findings is None:
        return take(decks, step, as_json=chosen.json)
    return findings.finish(take(decks, step, on_failure=findings.failed))


def _words(analysis: Result, chosen: argparse.Namespace, has_files: bool) -> tuple[str, bool]:
    """What is said, and whether it is data."""
    if chosen.json:
        return load("flexact.analysis.json").text_of(analysis), True
    if chosen.log and not has_files:
        return load("flexact.show.spacar_log").spacar_log(analysis), True
    # What concerns the deck stands on stderr already.
    missing: list[str] = []
    glances: Any = load("flexact.api").glances if analysis.given.has_stiffness else None
    words = describe(
        analysis,
        about_model=False,
        most=MOST_MODES,
        width=text_width(),
        verbose=is_verbose(),
        todo=todo_of(analysis, *(glances(analysis, missing) if glances else ())),
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
        style = "unsure" if analysis.has_small_margin else "good"
    return re.sub(verdict, lambda found: painted(found[0], style), words, count=1)


VERB = Verb(
    run=analyse_decks,
    description="Decide whether mechanisms are exactly, under- or over-constrained.",
    examples=(
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
    ),
    arguments=(
        DECKS,
        argument("--json", action="store_true", help="one JSON object a line on stdout"),
        argument(
            "-o",
            "--output",
            type=folder_or(*TABLES),
            metavar="DIR",
            help="write NAME.json, NAME.log and the mesh NAME.vtu there; with --summary also "
            "TABLE.csv, .jsonl or .parquet",
        ),
        summary_argument("a table, one line a deck, in place of the words"),
        FORMAT,
        mesh_argument("-o"),
        argument(
            "--log",
            choices=LOGS,
            help="the log in the form of SPACAR's in place of the words, or, with -o, as NAME.log",
        ),
        DECISION,
        UNITS,
        GRAVITY,
        *ACCURACY_AND_BEYOND,
        argument(
            "--expect",
            choices=VERDICTS,
            help="exit with 3 for any other verdict, and for an exact one within the accuracy only",
        ),
    ),
)
