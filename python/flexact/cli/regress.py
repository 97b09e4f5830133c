# SPDX-License-Identifier: BSD-3-Clause
"""``flexact regress``: compare decks with stored answers, or store them."""

from __future__ import annotations

import argparse
from pathlib import Path

from flexact.base.errors import BatchError
from flexact.base.interruption import unwinding
from flexact.base.plain_text import harmless
from flexact.cli.analysed import add_method, analysed, opened, tolerance
from flexact.cli.bar import Bar
from flexact.cli.decks import add_decks, take
from flexact.cli.outcome import ExitCode, Outcome
from flexact.cli.terminal import say
from flexact.files.decks import DeckFile, find_decks
from flexact.files.outputs import plan_files, write_together
from flexact.regress.comparison import STRICT, Tolerances, differences
from flexact.regress.stored_answer import answer_of, read_answer, text_of


def fill(parser: argparse.ArgumentParser) -> None:
    """Give the verb its description and arguments."""
    parser.description = "Compare what does not depend on sign, order or basis with stored answers."
    add_decks(parser)
    parser.add_argument(
        "--against", type=Path, metavar="DIR", required=True, help="folder of the stored answers"
    )
    parser.add_argument("--store", action="store_true", help="store the answers instead")
    parser.add_argument(
        "--tolerance",
        type=tolerance,
        metavar="T",
        help="largest difference of singular values, as a fraction of the largest "
        "(default 1e-9), and of entries of projectors (default 1e-8)",
    )
    add_method(parser)
    parser.set_defaults(run=regress_decks, zero_tolerance=None, prove=None, accuracy=None)


def regress_decks(chosen: argparse.Namespace) -> ExitCode:
    """Compare the decks that were asked for with their stored answers, or store them."""
    if chosen.store and chosen.tolerance is not None:
        raise BatchError("--tolerance is for comparing; it has no meaning with --store")
    decks = find_decks(chosen.decks)
    plan = plan_files(decks, chosen.against, (".json",)) if chosen.store else {}

    def step(deck: DeckFile) -> Outcome:
        if chosen.store:
            return _store(deck, chosen, plan[deck.path][0])
        return _compare(deck, chosen)

    return take(decks, step)


def _store(deck: DeckFile, chosen: argparse.Namespace, target: Path) -> Outcome:
    with Bar(deck.name, deck.path) as bar:
        text = text_of(answer_of(analysed(deck, opened(deck, bar), chosen, bar)))
    with unwinding():
        write_together({target: text.encode()})
    say(f"{harmless(deck.name)}: stored in {harmless(str(target))}")
    return Outcome(deck.name, ExitCode.ANALYSED, "stored")


def _compare(deck: DeckFile, chosen: argparse.Namespace) -> Outcome:
    stem, t = chosen.against / deck.relative, chosen.tolerance
    stored = stem.with_name(f"{stem.name}.json")
    with Bar(deck.name, deck.path) as bar:
        model = opened(deck, bar)
        answer, now = read_answer(stored), answer_of(analysed(deck, model, chosen, bar))
    found = differences(answer, now, STRICT if t is None else Tolerances(t, t))
    name = harmless(deck.name)
    if not found:
        say(f"{name}: as stored")
        return Outcome(deck.name, ExitCode.ANALYSED, "as stored")
    head = f"{name}: differs from {harmless(str(stored))}"
    say("\n".join((head, *(f"  {harmless(line)}" for line in found))))
    return Outcome(deck.name, ExitCode.DIFFERENT, "different")
