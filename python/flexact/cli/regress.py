"""``flexact regress``: compare decks with stored answers, or store them."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from flexact.batch import BatchError, DeckFile, ExitCode, Outcome, find_decks
from flexact.cli.analysed import add_method, analysed, opened, tolerance
from flexact.cli.bar import Bar
from flexact.cli.decks import add_decks, take
from flexact.cli.terminal import say
from flexact.interruption import unwinding
from flexact.rendering import harmless

if TYPE_CHECKING:
    from flexact.regress import Tolerances


def add_parser(verbs: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add this verb to the command's parser."""
    parser = verbs.add_parser(
        "regress",
        help="compare decks with stored answers, or store them",
        description="Compare what does not depend on sign, order or basis with stored answers.",
        allow_abbrev=False,
    )
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
    parser.set_defaults(run=regress_decks, zero_tolerance=None)


def regress_decks(chosen: argparse.Namespace) -> ExitCode:
    """Compare the decks that were asked for with their stored answers, or store them."""
    from flexact.outputs import plan_files
    from flexact.regress import STRICT, Tolerances

    if chosen.store and chosen.tolerance is not None:
        raise BatchError("--tolerance is for comparing; it has no meaning with --store")
    decks = find_decks(chosen.decks)
    plan = plan_files(decks, chosen.against, (".json",)) if chosen.store else {}
    t = chosen.tolerance
    tolerances = STRICT if t is None else Tolerances(t, t)

    def step(deck: DeckFile) -> Outcome:
        if chosen.store:
            return _store(deck, chosen, plan[deck.path][0])
        stem = chosen.against / deck.relative
        return _compare(deck, chosen, stem.with_name(f"{stem.name}.json"), tolerances)

    return take(decks, step)


def _store(deck: DeckFile, chosen: argparse.Namespace, target: Path) -> Outcome:
    from flexact.outputs import write_together
    from flexact.stored_answer import answer_of, text_of

    with Bar(deck.name, deck.path) as bar:
        text = text_of(answer_of(analysed(deck, opened(deck, bar), chosen, bar)))
    with unwinding():
        write_together({target: text.encode()})
    say(f"{harmless(deck.name)}: stored in {harmless(str(target))}")
    return Outcome(deck.name, ExitCode.ANALYSED, "stored")


def _compare(
    deck: DeckFile, chosen: argparse.Namespace, stored: Path, tolerances: Tolerances
) -> Outcome:
    from flexact.regress import differences
    from flexact.stored_answer import answer_of, read_answer

    with Bar(deck.name, deck.path) as bar:
        model = opened(deck, bar)
        answer = read_answer(stored)
        found = differences(answer, answer_of(analysed(deck, model, chosen, bar)), tolerances)
    name = harmless(deck.name)
    if not found:
        say(f"{name}: as stored")
        return Outcome(deck.name, ExitCode.ANALYSED, "as stored")
    head = f"{name}: differs from {harmless(str(stored))}"
    say("\n".join((head, *(f"  {harmless(line)}" for line in found))))
    return Outcome(deck.name, ExitCode.DIFFERENT, "different")
