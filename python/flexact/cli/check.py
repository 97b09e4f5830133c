"""``flexact check``: the diagnostics of decks, without analysing them."""

from __future__ import annotations

import argparse

import flexact
from flexact.batch import DeckFile, ExitCode, Outcome, exit_code, find_decks, run
from flexact.cli import failures
from flexact.cli.summary import summarise
from flexact.cli.terminal import say


def add_parser(verbs: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add this verb to the command's parser."""
    parser = verbs.add_parser(
        "check",
        help="the diagnostics of decks, without analysing them",
        description="Say what is wrong with decks.",
        allow_abbrev=False,
    )
    parser.add_argument("decks", nargs="+", metavar="DECK", help="a deck, or a folder of *.dat")
    parser.set_defaults(run=check_decks)


def check_decks(chosen: argparse.Namespace) -> ExitCode:
    """Read the decks that were asked for and say what is wrong with them."""
    decks = find_decks(chosen.decks)
    outcomes = run(decks, _check, lambda deck, error: failures.tell(deck, error, as_json=False))
    if text := summarise(outcomes):
        say(text)
    return exit_code(outcomes)


def _check(deck: DeckFile) -> Outcome:
    model = flexact.read(deck.path)
    failures.remark(model)
    say(f"{deck.path}: no errors")
    return Outcome(deck.path, ExitCode.ANALYSED, "without errors")
