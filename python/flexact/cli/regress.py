"""``flexact regress``: compare decks with stored answers, or store them."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING

import flexact
from flexact.batch import BatchError, DeckFile, ExitCode, Outcome, find_decks
from flexact.cli.decks import add_decks, take
from flexact.cli.terminal import say

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
        type=_tolerance,
        metavar="T",
        help="largest difference of singular values, as a fraction of the largest "
        "(default 1e-9), and of entries of projectors (default 1e-8)",
    )
    parser.set_defaults(run=regress_decks)


def _tolerance(text: str) -> float:
    value = float(text)
    if not (math.isfinite(value) and value >= 0.0):
        raise ValueError
    return value


_tolerance.__name__ = "tolerance"  # argparse names the type in its message


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
            return _store(deck, plan[deck.path][0])
        stem = chosen.against / deck.relative
        return _compare(deck, stem.with_name(f"{stem.name}.json"), tolerances)

    return take(decks, step)


def _store(deck: DeckFile, target: Path) -> Outcome:
    from flexact.outputs import write_together
    from flexact.stored_answer import dumps, store

    answer = store(flexact.analyse(flexact.read(deck.path), name=deck.path))
    write_together({target: dumps(answer).encode()})
    say(f"{deck.path}: stored in {target}")
    return Outcome(deck.path, ExitCode.ANALYSED, "stored")


def _compare(deck: DeckFile, stored: Path, tolerances: Tolerances) -> Outcome:
    from flexact.regress import differences
    from flexact.stored_answer import load, store

    model = flexact.read(deck.path)
    answer = load(stored)
    found = differences(answer, store(flexact.analyse(model, name=deck.path)), tolerances)
    if not found:
        say(f"{deck.path}: as stored")
        return Outcome(deck.path, ExitCode.ANALYSED, "as stored")
    say("\n".join((f"{deck.path}: differs from {stored}", *(f"  {line}" for line in found))))
    return Outcome(deck.path, ExitCode.DIFFERENT, "different")
