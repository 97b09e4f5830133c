"""``flexact check``: the diagnostics of decks, without analysing them."""

from __future__ import annotations

import argparse

import flexact
from flexact.batch import DeckFile, ExitCode, Outcome, find_decks
from flexact.cli import remarks
from flexact.cli.decks import add_decks, take
from flexact.cli.terminal import say
from flexact.rendering import harmless


def add_parser(verbs: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add this verb to the command's parser."""
    parser = verbs.add_parser(
        "check",
        help="the diagnostics of decks, without analysing them",
        description="Say what is wrong with decks.",
        allow_abbrev=False,
    )
    add_decks(parser)
    parser.set_defaults(run=check_decks)


def check_decks(chosen: argparse.Namespace) -> ExitCode:
    """Read the decks that were asked for and say what is wrong with them."""
    return take(find_decks(chosen.decks), _check)


def _check(deck: DeckFile) -> Outcome:
    model = flexact.read(deck.path)
    remarks.tell_problems(model)
    say(f"{harmless(deck.name)}: no errors")
    return Outcome(deck.name, ExitCode.ANALYSED, "without errors")
