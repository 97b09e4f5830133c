# SPDX-License-Identifier: BSD-3-Clause
"""The file that ``flexact advise -o`` writes: a changed deck, a page, or a picture."""

from __future__ import annotations

import argparse
import re
from collections.abc import Sequence
from itertools import islice
from pathlib import Path
from typing import NamedTuple

from ...advice.advice import Advice, advice_of, describe
from ...advice.json import line_of
from ...advice.step import After, together, tried
from ...analysis.change import Change
from ...analysis.naming import Pieces
from ...analysis.places import listed
from ...analysis.verdict import Verdict
from ...analysis.verdict_words import verdict_word
from ...core.progress import Progress
from ...deck.rendering import ModelError
from ...model.editing import edited_deck
from ...show.writers import PAGES, PICTURES, STILLS
from ...util.decks import DeckFile, find_decks
from ...util.errors import BatchError
from ...util.interruption import unwinding
from ...util.loading import load
from ...util.outputs import STDOUT, plan_file, write_together
from ...util.text import harmless
from .decks import ACCURACY_AND_BEYOND, DECISION, DECKS, read_and_analysed, take
from .parser import Verb, argument
from .targets import plan_deck, write_text
from .terminal import Bar, ExitCode, Outcome, complain, give, say, text_width

_STEP = re.compile(r"([1-9]\d{0,8})(?:\.([1-9]\d{0,8}))?")


class AskedError(BatchError):
    """A step, a body or a wish that the mechanism does not have."""

    def __init__(self, message: str, code: str) -> None:
        """Keep the words and their code."""
        super().__init__(message)
        self.code = code


def in_short(error: ModelError) -> AskedError:
    """What is wrong with what was asked, in a line: it stands in no deck."""
    first = error.diagnostics[0]
    return AskedError(f"{first.message}{f'; {first.help}' if first.help else ''}", first.code)


class Chosen(NamedTuple):
    """A step by its number, and which of its choices."""

    step: int
    choice: int

    def __str__(self) -> str:
        """As it is asked for, such as "1" or "1.2"."""
        return f"{self.step}.{self.choice}" if self.choice > 1 else str(self.step)


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


class _Taken(NamedTuple):
    """Steps that are taken together."""

    words: str
    """Such as "steps 1 and 8"."""
    change: Change
    after: After
    pieces: Pieces
    """What is done."""


class AdviceFile:
    """Where the file goes, and what it is by its suffix."""

    def __init__(self, target: Path | None, steps: tuple[Chosen, ...] | None) -> None:
        """Keep the file, None where none is wanted, and the steps that are to be taken."""
        self.target, self.steps = target, steps
        self.kind = "" if target is None else target.suffix.lower()

    @property
    def is_deck(self) -> bool:
        """Whether a deck is written, for which the steps up to that which is taken are enough."""
        return self.target is not None and self.kind not in (*PAGES, *STILLS)

    @property
    def to_stdout(self) -> bool:
        """Whether the deck goes to stdout in place of words."""
        return self.target == STDOUT

    def plan(self, decks: Sequence[DeckFile]) -> None:
        """Find out what is wrong with the choice before anything is analysed.

        Raises:
            BatchError: options do not go together, or the file cannot be written.
        """
        if self.target is None:
            if self.steps is not None:
                raise BatchError("--apply writes the changed deck: say where, with -o FILE")
            return
        if len(decks) > 1:
            raise BatchError(f"-o is for one deck, and there are {len(decks)}")
        if self.kind in PICTURES and self.steps is not None:
            raise BatchError(
                "a picture shows the mechanism as it is; for what --apply makes of it name a "
                "page (.html), or a deck"
            )
        if self.kind not in (*PAGES, *STILLS) and self.steps is None:
            what = "standard output" if self.to_stdout else self.target
            raise BatchError(
                f"what is {what} to be? A page ends with .html, a picture with .png, "
                ".svg or .pdf; the deck that a step makes also needs --apply K"
            )
        if self.kind in (*PAGES, *STILLS):
            plan_file(decks[0], self.target)
        else:
            plan_deck(decks[0], self.target)

    def write(self, advice: Advice, progress: Progress | None = None) -> str:
        """Write what was asked for, and say so; empty where nothing was.

        Raises:
            AskedError: there is no such step.
            ModelError: there is no such choice, or no body to be drawn.
            OutputError: the file cannot be written.
            PictureError: a package is missing.
        """
        if self.target is None:
            return ""
        deck, name = harmless(advice.analysis.name), harmless(str(self.target))
        name = "standard output" if self.to_stdout else name
        pages = "flexact.show.page.advice"
        content: bytes
        if self.kind in STILLS:
            content = load(pages).picture_of(advice, self.kind)
            said = f"freedom and constraint drawn in {name}"
        elif self.kind in PAGES and not self.steps and not len(advice):
            content = load(pages).page_as_it_is(advice)
            said = f"shown in {name}; {_there(advice)}"
        else:
            taken, given = self._taken(advice, progress), advice.analysis.given
            if self.kind in PAGES:
                content = load(pages).page_of(advice, taken.change, taken.pieces)
                said = f"{taken.words} shown in {name}, {taken.after.outcome}"
            else:
                content = edited_deck(given, taken.change.apply(given).data)
                said = f"{taken.words} written to {name}, {taken.after.outcome}"
        if self.kind in (*PAGES, *STILLS):
            write_together({self.target: content})
        else:
            write_text(self.target, content)
        return f"{deck}: {said}"

    def _taken(self, advice: Advice, progress: Progress | None) -> _Taken:
        """The steps that were asked for; of a page by default the first, or what makes it exact."""
        asked = self.steps or tuple(Chosen(k, 1) for k in advice.exact_by or (1,))
        steps = tuple(islice(advice.numbered(progress), max(one.step for one in asked)))
        for one in asked:
            if one.step > len(steps):
                raise AskedError(f"there is no step {one.step}: {_there(advice)}", "no-such-step")
        taken = [steps[one.step - 1] for one in asked]
        change = together(steps[one.step - 1].chosen(one.choice) for one in asked)
        after = taken[0].after if len(taken) == 1 else tried(advice.analysis, change)
        numbers = listed([str(one) for one in asked])
        pieces = tuple(piece for step in taken for piece in (*step.pieces, " "))
        return _Taken(f"step{'s' * (len(taken) > 1)} {numbers}", change, after, pieces)


def _there(advice: Advice) -> str:
    """Which steps there are."""
    if len(advice):
        return f"there are {len(advice)}" if len(advice) > 1 else "there is one"
    if advice.analysis.verdict is Verdict.EXACT:
        return "it is exactly constrained, and there is nothing to mend"
    return "nothing was found that would mend this mechanism"


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
                if not self.file.is_deck or self.chosen.json:
                    advice.found(bar.show_work)
                with unwinding():
                    written = self.file.write(advice, bar.show_work)
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
            text: str = load("json").dumps(
                line_of(advice.analysis, advice.to_dict()), allow_nan=False
            )
            return text
        return f"{describe(advice, width=text_width())}\n"


VERB = Verb(
    run=advise_decks,
    description=(
        "Say what is wrong with mechanisms and why, and how to mend it: every step was analysed "
        "before it is shown."
    ),
    examples=(
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
    ),
    arguments=(
        DECKS,
        argument(
            "--body", metavar="NAME", help="the body whose freedom and constraint are looked at"
        ),
        argument(
            "--wanted",
            action="append",
            default=[],
            metavar="MOTION",
            help='what is meant to move, such as "stage: translation z"; may be repeated',
        ),
        argument(
            "--bodies",
            action="store_true",
            help="release insides of rigid bodies, too, where anything else does it as well",
        ),
        argument("--json", action="store_true", help="one JSON object a line on stdout"),
        argument(
            "--apply",
            type=chosen_steps,
            metavar="K",
            help="take step K, or several, such as 1,8; K.2, K.3, ... take the alternatives that "
            "symmetry gives it",
        ),
        argument(
            "-o",
            "--output",
            type=Path,
            metavar="FILE",
            help=(
                "with --apply the changed deck, - for stdout; or a page (.html) of before and "
                "after; or a picture (.png, .svg, .pdf) of the freedom and the constraint of the "
                "body"
            ),
        ),
        DECISION,
        *ACCURACY_AND_BEYOND,
    ),
)
