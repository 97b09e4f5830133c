# SPDX-License-Identifier: BSD-3-Clause
"""``flexact check``: the diagnostics of decks, without analysing them."""

from __future__ import annotations

import argparse

from flexact.base.plain_text import harmless
from flexact.cli.analysed import report_problems
from flexact.cli.decks import add_decks, take
from flexact.cli.help_texts import add_examples
from flexact.cli.outcome import ExitCode, Outcome
from flexact.cli.terminal import say
from flexact.deck.reading import read_deck
from flexact.files.decks import DeckFile, find_decks


def fill(parser: argparse.ArgumentParser) -> None:
    """Give the verb its description and arguments."""
    parser.description = "Say what is wrong with decks."
    add_decks(parser)
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
    )
    parser.set_defaults(run=check_decks)


def check_decks(chosen: argparse.Namespace) -> ExitCode:
    """Read the decks that were asked for and say what is wrong with them."""
    return take(find_decks(chosen.decks), _check)


def _check(deck: DeckFile) -> Outcome:
    model = read_deck(deck)
    report_problems(model)
    say(f"{harmless(deck.name)}: no errors")
    return Outcome(deck.name, ExitCode.ANALYSED, "without errors")
