# SPDX-License-Identifier: BSD-3-Clause
"""``flexact check``: the diagnostics of decks, without analysing them."""

from __future__ import annotations

import argparse
from dataclasses import replace

from ...deck.diagnostics import Problems
from ...deck.rendering import DeckError
from ...model.reading import read_deck
from ...util.decks import DeckFile, find_decks
from ...util.loading import load
from ...util.text import harmless
from . import decks as failures
from .analyse import TEXT, Findings, add_format, require_one_form
from .decks import add_decks, report_problems, take
from .help_texts import add_examples
from .outcome import ExitCode, Outcome
from .summary import Cells, Told, add_summary, failed, summarise
from .terminal import give, say


def fill(parser: argparse.ArgumentParser) -> None:
    """Give the verb its description and arguments."""
    parser.description = "Say what is wrong with decks."
    add_decks(parser)
    parser.add_argument("--json", action="store_true", help="one JSON object a line on stdout")
    add_format(parser)
    add_summary(parser, "a table, one line a deck, with its first error")
    add_examples(
        parser,
        (
            "What is wrong with decks, in one run",
            "flexact check input_decks/paper input_decks/flexures",
        ),
        (
            "A deck on standard input",
            "flexact check - < input_decks/paper/five_wires.dat",
        ),
        (
            "Marks beside the lines of a pull request, in a workflow of GitHub",
            "flexact check input_decks/paper --format github",
        ),
    )
    parser.set_defaults(run=check_decks)


def check_decks(chosen: argparse.Namespace) -> ExitCode:
    """Read the decks that were asked for and say what is wrong with them."""
    require_one_form(chosen)
    decks = find_decks(chosen.decks)
    if chosen.summary:
        return summarise(decks, ("errors", "warnings", "notes"), _counted)
    if chosen.json:
        return take(decks, _object, on_failure=_object_of_failure)
    if chosen.format == TEXT:
        return take(decks, _check)
    findings = Findings(chosen.format)
    return findings.finish(take(decks, findings.checked, on_failure=findings.failed))


def _counted(deck: DeckFile) -> Told:
    """The line of a deck: how many problems it has."""
    outcome = _without_errors(deck)
    try:
        found = read_deck(deck).problems
    except DeckError as error:
        failure = failed(deck, error)
        cells = replace(failure.cells, first=str(error.problems.errors))
        return failure._replace(cells=cells)
    counts = {"errors": found.errors, "warnings": found.warnings, "notes": found.notes}
    first = next(iter(found.kept), None)
    return Told(Cells(counts, behind=first.message if first else ""), outcome)


def _check(deck: DeckFile) -> Outcome:
    model = read_deck(deck)
    report_problems(model)
    say(f"{harmless(deck.name)}: no errors")
    return _without_errors(deck)


def _without_errors(deck: DeckFile) -> Outcome:
    return Outcome(deck.name, ExitCode.ANALYSED, "without errors")


def _object(deck: DeckFile) -> Outcome:
    model = read_deck(deck)
    report_problems(model)
    _give(deck, model.problems)
    return _without_errors(deck)


def _object_of_failure(deck: DeckFile, error: Exception) -> None:
    _give(deck, failures.problems_of(error))


def _give(deck: DeckFile, problems: Problems) -> None:
    made = load("flexact.apps.checks.outputs").dictionary_of(deck.name, problems)
    give(load("json").dumps(made))
