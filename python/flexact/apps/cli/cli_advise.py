# SPDX-License-Identifier: BSD-3-Clause
"""``flexact advise``: what is wrong with a mechanism, why, and steps that mend it."""

from __future__ import annotations

import argparse
from pathlib import Path

from ...advice.advising import Advice, advice_of
from ...advice.json import line_of
from ...advice.words import describe
from ...analysis.text_margin import verdict_word
from ...deck.errors import ModelError
from ...util.decks import DeckFile, find_decks
from ...util.errors import BatchError
from ...util.interruption import unwinding
from ...util.loading import load
from .advise import AdviceFile, chosen_steps, in_short
from .bar import Bar
from .cli_decks import add_decks, take
from .decks import add_accuracy, add_decision, read_and_analysed
from .help_texts import add_examples
from .outcome import ExitCode, Outcome
from .terminal import complain, give, say, text_width


def fill(parser: argparse.ArgumentParser) -> None:
    """Give the verb its description and arguments."""
    parser.description = (
        "Say what is wrong with mechanisms and why, and how to mend it: every step was analysed "
        "before it is shown."
    )
    add_decks(parser)
    parser.add_argument(
        "--body", metavar="NAME", help="the body whose freedom and constraint are looked at"
    )
    parser.add_argument(
        "--wanted",
        action="append",
        default=[],
        metavar="MOTION",
        help='what is meant to move, such as "stage: translation z"; may be repeated',
    )
    parser.add_argument(
        "--bodies",
        action="store_true",
        help="release insides of rigid bodies, too, where anything else does it as well",
    )
    parser.add_argument("--json", action="store_true", help="one JSON object a line on stdout")
    parser.add_argument(
        "--apply",
        type=chosen_steps,
        metavar="K",
        help="take step K, or several, such as 1,8; K.2, K.3, ... take the alternatives that "
        "symmetry gives it",
    )
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE",
        help="with --apply the changed deck, - for stdout; or a page (.html) of before and after; "
        "or a picture (.png, .svg, .pdf) of the freedom and the constraint of the body",
    )
    add_decision(parser)
    add_accuracy(parser)
    add_examples(
        parser,
        (
            "What is wrong, and steps that mend it",
            "flexact advise input_decks/flexures/parallel_guide.dat",
        ),
        (
            "The deck that step 1 makes",
            "flexact advise input_decks/flexures/parallel_guide.dat --apply 1 "
            "-o results/mended.dat",
        ),
        (
            "A page of before and after",
            "flexact advise input_decks/flexures/parallel_guide.dat -o results/mended.html",
        ),
    )
    parser.set_defaults(run=advise_decks)


def advise_decks(chosen: argparse.Namespace) -> ExitCode:
    """Advise on the decks that were asked for."""
    decks = find_decks(chosen.decks)
    return take(decks, _Work(chosen, decks).step, as_json=chosen.json)


class _Work:
    """One run of the verb: what was chosen, and what is done with each deck."""

    def __init__(self, chosen: argparse.Namespace, decks: tuple[DeckFile, ...]) -> None:
        """Find out what is wrong with the choice before anything is analysed."""
        self.chosen = chosen
        self.file = AdviceFile(chosen.output, chosen.apply)
        self.file.plan(decks)
        if self.file.to_stdout and chosen.json:
            raise BatchError("--json and -o - both go to standard output: choose one")

    def step(self, deck: DeckFile) -> Outcome:
        """Advise on one deck, say and write it."""
        with Bar(deck.name, deck.path) as bar:
            result = read_and_analysed(deck, self.chosen, bar)
            try:
                asked = self.chosen
                advice = advice_of(result, asked.body, asked.wanted, asked.bodies)
                advice.found(bar.show_work)
                with unwinding():
                    written = self.file.write(advice)
            except ModelError as error:
                raise in_short(error) from None
            words = "" if written and not self.chosen.json else self._words(advice)
        if words:
            give(words) if self.chosen.json else say(words)
        if written:
            complain(written) if self.chosen.json or self.file.to_stdout else say(written)
        return Outcome(deck.name, ExitCode.ANALYSED, verdict_word(result))

    def _words(self, advice: Advice) -> str:
        if self.chosen.json:
            text: str = load("json").dumps(line_of(advice), allow_nan=False)
            return text
        return f"{describe(advice, width=text_width())}\n"
