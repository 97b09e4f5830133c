# SPDX-License-Identifier: BSD-3-Clause
"""``flexact advise``: what is wrong with a mechanism, why, and steps that mend it."""

from __future__ import annotations

import argparse
import re
from pathlib import Path
from typing import NamedTuple

from flexact.advising import Advice, Step, advice_of
from flexact.advising.describe import describe
from flexact.advising.json_advice import line_of
from flexact.base.errors import BatchError
from flexact.base.interruption import unwinding
from flexact.base.loading import load
from flexact.base.plain_text import harmless
from flexact.cli.analysed import add_accuracy, add_decision, read_and_analysed
from flexact.cli.bar import Bar
from flexact.cli.decks import add_decks, take
from flexact.cli.outcome import ExitCode, Outcome
from flexact.cli.terminal import complain, say
from flexact.deck.editing import edited_deck
from flexact.diagnostics.errors import ModelError
from flexact.files.decks import DeckFile, find_decks
from flexact.files.outputs import plan_file, write_together
from flexact.saving import PAGES
from flexact.text.margin import verdict_word


class AskedError(BatchError):
    """A step, a body or a wish that the mechanism does not have."""

    def __init__(self, message: str, code: str) -> None:
        """Keep the words and their code."""
        super().__init__(message)
        self.code = code


class Chosen(NamedTuple):
    """A step by its number, and which of its choices."""

    step: int
    choice: int


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
    parser.add_argument("--json", action="store_true", help="one JSON object a line on stdout")
    parser.add_argument(
        "--apply",
        type=chosen_step,
        metavar="K",
        help="take step K; K.2, K.3, ... take the alternatives that symmetry gives it",
    )
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE",
        help="with --apply the changed deck; or a page (.html) of before and after",
    )
    add_decision(parser)
    add_accuracy(parser)
    parser.set_defaults(run=advise_decks)


def chosen_step(text: str) -> Chosen:
    """Number of a step, and maybe of one of its choices behind a point, as an option's type."""
    found = re.fullmatch(r"([1-9]\d{0,8})(?:\.([1-9]\d{0,8}))?", text)
    if found is None:
        raise argparse.ArgumentTypeError(
            f"the number of a step is wanted, such as 1, or 1.2 for its second choice, not {text!r}"
        )
    return Chosen(int(found[1]), int(found[2] or 1))


def advise_decks(chosen: argparse.Namespace) -> ExitCode:
    """Advise on the decks that were asked for."""
    decks = find_decks(chosen.decks)
    return take(decks, _Work(chosen, decks).step, as_json=chosen.json)


class _Work:
    """One run of the verb: what was chosen, and what is done with each deck."""

    def __init__(self, chosen: argparse.Namespace, decks: tuple[DeckFile, ...]) -> None:
        """Find out what is wrong with the choice before anything is analysed."""
        self.chosen = chosen
        self.target: Path | None = chosen.output
        if self.target is None:
            if chosen.apply is not None:
                raise BatchError("--apply writes the changed deck: say where, with -o FILE")
            return
        if len(decks) > 1:
            raise BatchError(f"-o is for one deck, and there are {len(decks)}")
        if not self._is_page and chosen.apply is None:
            raise BatchError(
                f"what is {self.target} to be? A page ends with .html; the deck that a step "
                "makes also needs --apply K"
            )
        plan_file(decks[0], self.target)

    @property
    def _is_page(self) -> bool:
        return self.target is not None and self.target.suffix.lower() in PAGES

    def step(self, deck: DeckFile) -> Outcome:
        """Advise on one deck, say and write it."""
        with Bar(deck.name, deck.path) as bar:
            result = read_and_analysed(deck, self.chosen, bar)
            try:
                advice = advice_of(result, self.chosen.body, self.chosen.wanted)
                advice.found(bar.show_work)
                step = None if self.chosen.apply is None else self._step(advice)
            except ModelError as error:
                raise _in_short(error) from None
            with unwinding():
                words = self._words(advice)
                written = self._written(advice, step)
        if self.target is None or self.chosen.json:
            say(words)
        if written:
            complain(written) if self.chosen.json else say(written)
        return Outcome(deck.name, ExitCode.ANALYSED, verdict_word(result))

    def _step(self, advice: Advice) -> Step:
        number, choice = self.chosen.apply
        if number > len(advice):
            there = f"there are {len(advice)}" if len(advice) > 1 else "there is one"
            if not len(advice):
                there = "nothing was found that would mend this mechanism"
                if not advice.analysis.under_constrained + advice.analysis.over_constrained:
                    there = "it is exactly constrained, and there is nothing to mend"
            raise AskedError(f"there is no step {number}: {there}", "no-such-step")
        step: Step = advice[number - 1]
        step.apply(choice)
        return step

    def _words(self, advice: Advice) -> str:
        if self.chosen.json:
            text: str = load("json").dumps(line_of(advice), allow_nan=False)
            return text
        return f"{describe(advice)}\n"

    def _written(self, advice: Advice, step: Step | None) -> str:
        """Write what was asked for, and say so; empty where nothing was."""
        if self.target is None:
            return ""
        name = harmless(str(self.target))
        if self._is_page:
            raise NotImplementedError
        assert step is not None
        model = step.apply(self.chosen.apply.choice)
        write_together({self.target: edited_deck(advice.analysis.given, model.data)})
        deck = harmless(advice.analysis.name)
        return f"{deck}: step {step.number} written to {name}, {step.outcome}"


def _in_short(error: ModelError) -> AskedError:
    """What is wrong with what was asked, in a line: it stands in no deck."""
    first = error.diagnostics[0]
    return AskedError(f"{first.message}{f'; {first.help}' if first.help else ''}", first.code)
