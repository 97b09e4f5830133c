# SPDX-License-Identifier: BSD-3-Clause
"""``flexact check``: the diagnostics of decks, without analysing them."""

from __future__ import annotations

import argparse

from ...deck.diagnostics import Problems
from ...deck.rendering import DeckError
from ...model.reading import read_deck
from ...util.decks import DeckFile, find_decks
from ...util.loading import load
from ...util.text import harmless
from .analyse import FORMAT, TEXT, Findings, require_one_form
from .decks import (
    DECKS,
    Cells,
    failed,
    problems_of,
    report_problems,
    summary_argument,
    tabulate,
    take,
)
from .parser import Verb, argument
from .terminal import ExitCode, Outcome, give, say


def check_decks(chosen: argparse.Namespace) -> ExitCode:
    """Read the decks that were asked for and say what is wrong with them."""
    require_one_form(chosen)
    decks = find_decks(chosen.decks)
    if chosen.summary:
        return tabulate(decks, ("errors", "warnings", "notes"), _counted)
    findings = None if chosen.format == TEXT else Findings(chosen.format)

    def give_problems(deck: DeckFile, error: Exception) -> None:
        give_as_json(deck, problems_of(error))

    def give_as_json(deck: DeckFile, problems: Problems) -> None:
        made = load("flexact.apps.checks.outputs").dictionary_of(deck.name, problems)
        give(load("json").dumps(made))

    def step(deck: DeckFile) -> Outcome:
        model = read_deck(deck)
        report_problems(model)
        if findings is not None:
            findings.checked(deck, model)
        elif chosen.json:
            give_as_json(deck, model.problems)
        else:
            say(f"{harmless(deck.name)}: no errors")
        return _without_errors(deck)

    if findings is not None:
        return findings.finish(take(decks, step, on_failure=findings.failed))
    return take(decks, step, on_failure=give_problems if chosen.json else None)


def _counted(deck: DeckFile) -> tuple[Cells, Outcome]:
    """The line of a deck: how many problems it has."""
    try:
        found = read_deck(deck).problems
    except DeckError as error:
        cells, outcome = failed(deck, error)
        return cells._replace(first=str(error.problems.errors)), outcome
    counts = {"errors": found.errors, "warnings": found.warnings, "notes": found.notes}
    first = next(iter(found.kept), None)
    return Cells(counts, behind=first.message if first else ""), _without_errors(deck)


def _without_errors(deck: DeckFile) -> Outcome:
    return Outcome(deck.name, ExitCode.ANALYSED, "without errors")


VERB = Verb(
    run=check_decks,
    description="Say what is wrong with decks.",
    examples=(
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
    ),
    arguments=(
        DECKS,
        argument("--json", action="store_true", help="one JSON object a line on stdout"),
        FORMAT,
        summary_argument("a table, one line a deck, with its first error"),
    ),
)
