# SPDX-License-Identifier: BSD-3-Clause
"""``flexact advise``: what is wrong with a mechanism, why, and steps that mend it."""

from __future__ import annotations

import argparse
import re
from pathlib import Path
from typing import NamedTuple

from flexact.advice.change import Change
from flexact.advice.proposal import After, tried
from flexact.advising import Advice, advice_of
from flexact.advising.describe import describe
from flexact.advising.json_advice import line_of
from flexact.advising.steps import together
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
from flexact.result.verdict import Verdict
from flexact.saving import PAGES
from flexact.text.margin import verdict_word
from flexact.text.naming import counts_in_words
from flexact.text.places import listed
from flexact.text.sentences import Pieces

_STEP = re.compile(r"([1-9]\d{0,8})(?:\.([1-9]\d{0,8}))?")


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
        help="with --apply the changed deck; or a page (.html) of before and after",
    )
    add_decision(parser)
    add_accuracy(parser)
    parser.set_defaults(run=advise_decks)


def chosen_steps(text: str) -> tuple[Chosen, ...]:
    """Numbers of steps, and maybe of one of their choices behind a point, as an option's type."""
    found = [_STEP.fullmatch(part.strip()) for part in text.split(",")]
    made = tuple(Chosen(int(one[1]), int(one[2] or 1)) for one in found if one is not None)
    if len(made) < len(found) or len({one.step for one in made}) < len(made):
        raise argparse.ArgumentTypeError(
            "the number of a step is wanted, such as 1, or 1.2 for its second choice, or of "
            f"several, such as 1,8, not {text!r}"
        )
    return made


def advise_decks(chosen: argparse.Namespace) -> ExitCode:
    """Advise on the decks that were asked for."""
    decks = find_decks(chosen.decks)
    return take(decks, _Work(chosen, decks).step, as_json=chosen.json)


class Taken(NamedTuple):
    """Steps that are taken together."""

    words: str
    """Such as "steps 1 and 8"."""
    change: Change
    after: After
    pieces: Pieces
    """What is done."""


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
                taken = None if self.target is None else self._taken(advice)
            except ModelError as error:
                raise _in_short(error) from None
            with unwinding():
                words = self._words(advice)
                written = "" if taken is None else self._written(advice, taken)
        if taken is None or self.chosen.json:
            say(words)
        if written:
            complain(written) if self.chosen.json else say(written)
        return Outcome(deck.name, ExitCode.ANALYSED, verdict_word(result))

    def _taken(self, advice: Advice) -> Taken:
        """The steps that were asked for; of a page by default the first."""
        asked = self.chosen.apply or (Chosen(1, 1),)
        for one in asked:
            if one.step > len(advice):
                raise AskedError(f"there is no step {one.step}: {_there(advice)}", "no-such-step")
        steps = [(advice[one.step - 1], one.choice) for one in asked]
        change = together(step.chosen(choice) for step, choice in steps)
        after = steps[0][0].after if len(steps) == 1 else tried(advice.analysis, change)
        numbers = listed([str(one.step) for one in asked])
        pieces = tuple(piece for step, _ in steps for piece in (*step.pieces, " "))
        return Taken(f"step{'s' * (len(steps) > 1)} {numbers}", change, after, pieces)

    def _words(self, advice: Advice) -> str:
        if self.chosen.json:
            text: str = load("json").dumps(line_of(advice), allow_nan=False)
            return text
        return f"{describe(advice)}\n"

    def _written(self, advice: Advice, taken: Taken) -> str:
        """Write what was asked for, and say so."""
        assert self.target is not None
        given = advice.analysis.given
        if self._is_page:
            page = load("flexact.advising.pages").page_of
            content: bytes = page(advice, taken.change, taken.pieces)
        else:
            content = edited_deck(given, taken.change.apply(given).data)
        write_together({self.target: content})
        counts = counts_in_words(taken.after.under_constrained, taken.after.over_constrained)
        deck, name = harmless(advice.analysis.name), harmless(str(self.target))
        how = "shown" if self._is_page else "written"
        where = "in" if self._is_page else "to"
        return f"{deck}: {taken.words} {how} {where} {name}, {counts}"


def _there(advice: Advice) -> str:
    """Which steps there are."""
    if len(advice):
        return f"there are {len(advice)}" if len(advice) > 1 else "there is one"
    if advice.analysis.verdict is Verdict.EXACT:
        return "it is exactly constrained, and there is nothing to mend"
    return "nothing was found that would mend this mechanism"


def _in_short(error: ModelError) -> AskedError:
    """What is wrong with what was asked, in a line: it stands in no deck."""
    first = error.diagnostics[0]
    return AskedError(f"{first.message}{f'; {first.help}' if first.help else ''}", first.code)
