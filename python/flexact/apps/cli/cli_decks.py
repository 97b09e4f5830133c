# SPDX-License-Identifier: BSD-3-Clause
"""What all verbs do with decks: the argument, one after the other, the closing lines."""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Callable, Sequence

from ...util.decks import SUFFIX, DeckFile
from ...util.plain_text import harmless
from . import failures
from .outcome import ExitCode, Outcome, exit_code
from .terminal import complain, end_progress, say, show_progress

REMARKS = {
    ExitCode.OTHER: "failed",
    ExitCode.DECK_ERROR: "deck with errors",
    ExitCode.DIFFERENT: "not as expected",
}


def add_decks(parser: argparse.ArgumentParser) -> None:
    """Add the decks to a verb's parser."""
    parser.add_argument(
        "decks", nargs="+", metavar="DECK", help=f"a deck, a folder of *{SUFFIX}, or - for stdin"
    )


def take(
    decks: Sequence[DeckFile],
    step: Callable[[DeckFile], Outcome],
    *,
    as_json: bool = False,
    on_failure: Callable[[DeckFile, Exception], None] | None = None,
) -> ExitCode:
    """Take one deck after the other through `step`; a failing deck does not stop the rest.

    Args:
        decks: The decks.
        step: What is done with a deck; whatever it raises is told, and the next one is taken.
        as_json: Whether stdout is for JSON alone.
        on_failure: Says on stdout why a deck failed, in a form for programs, which stdout is for
            then.

    Returns:
        The exit code of the command.
    """
    outcomes = []
    for number, deck in enumerate(decks, start=1):
        show_progress(number, len(decks), deck.name)
        outcomes.append(_attempt(deck, step, as_json, on_failure))
    end_progress()
    if text := summarise(outcomes):
        complain(text) if as_json or on_failure else say(text)
    return exit_code(outcomes)


def _attempt(
    deck: DeckFile,
    step: Callable[[DeckFile], Outcome],
    as_json: bool,
    on_failure: Callable[[DeckFile, Exception], None] | None,
) -> Outcome:
    try:
        if deck.error is not None:
            raise deck.error
        return step(deck)
    except Exception as unforeseen:
        error = failures.foreseen(unforeseen)
        outcome = failures.report(deck, error, as_json=as_json)
        if on_failure is not None:
            on_failure(deck, error)
        return outcome


def summarise(outcomes: Sequence[Outcome]) -> str:
    """How many decks gave what, and which of them want attention; empty for a single deck."""
    if len(outcomes) < 2:
        return ""
    counts = Counter(outcome.result for outcome in outcomes)
    parts = ", ".join(f"{count} {result}" for result, count in counts.most_common())
    lines = [f"{len(outcomes)} decks: {parts}"]
    lines += [
        f"  {outcome.remark or REMARKS[outcome.code]}: {harmless(outcome.deck)}"
        for outcome in outcomes
        if outcome.code is not ExitCode.ANALYSED
    ]
    return "\n".join(lines)
