# SPDX-License-Identifier: BSD-3-Clause
"""``flexact advise``: what is wrong with decks and why, and steps that mend it."""

from __future__ import annotations

import argparse
import re
from collections.abc import Sequence
from itertools import islice
from pathlib import Path

from ...advice.advice import Advice, advice_of, describe
from ...advice.json import line_of
from ...advice.releases.candidates import COUNT_SECONDS
from ...advice.step import together, tried
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
from .decks import ACCURACY_AND_BEYOND, DECISION, DECKS, GRAVITY, UNITS, read_and_analysed, take
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


#: A step by its number, and which of its choices.
Chosen = tuple[int, int]


def chosen_steps(text: str) -> tuple[Chosen, ...]:
    """Numbers of steps, and maybe of one of their choices behind a point, as an option's type."""
    found = [_STEP.fullmatch(part.strip()) for part in text.split(",")]
    made = tuple((int(one[1]), int(one[2] or 1)) for one in found if one is not None)
    if len(made) < len(found) or len({step for step, _ in made}) < len(made):
        raise argparse.ArgumentTypeError(
            "the number of a step is wanted, such as 1, or 1.2 for its second choice, or of "
            f"several, such as 1,8, not {text!r}"
        )
    return made


def _plan(chosen: argparse.Namespace, decks: Sequence[DeckFile]) -> None:
    """Find out what is wrong with the choice before anything is analysed.

    Raises:
        BatchError: options do not go together, or the file cannot be written.
    """
    target: Path | None = chosen.output
    if target is None:
        if chosen.apply is not None:
            raise BatchError("--apply writes the changed deck: say where, with -o FILE")
        return
    if len(decks) > 1:
        raise BatchError(f"-o is for one deck, and there are {len(decks)}")
    kind = target.suffix.lower()
    if kind in PICTURES and chosen.apply is not None:
        raise BatchError(
            "a picture shows the mechanism as it is; for what --apply makes of it name a "
            "page (.html), or a deck"
        )
    is_shown = kind in (*PAGES, *STILLS)
    if not is_shown and chosen.apply is None:
        what = "standard output" if target == STDOUT else target
        raise BatchError(
            f"what is {what} to be? A page ends with .html, a picture with .png, "
            ".svg or .pdf; the deck that a step makes also needs --apply K"
        )
    (plan_file if is_shown else plan_deck)(decks[0], target)
    if target == STDOUT and chosen.json:
        raise BatchError("--json and -o - both go to standard output: choose one")


def _written(
    advice: Advice, target: Path, steps: tuple[Chosen, ...] | None, progress: Progress | None
) -> str:
    """Write a page, a picture, or the deck that some steps make; say so.

    Raises:
        AskedError: there is no such step.
        ModelError: there is no such choice, or no body to be drawn.
        OutputError: the file cannot be written.
        PictureError: a package is missing.
    """
    kind = target.suffix.lower()
    name = "standard output" if target == STDOUT else harmless(str(target))
    pages = "flexact.show.page.advice"
    content: bytes
    if kind in STILLS:
        content = load(pages).picture_of(advice, kind)
        said = f"freedom and constraint drawn in {name}"
    elif kind in PAGES and not steps and not len(advice):
        content = load(pages).page_as_it_is(advice)
        said = f"shown in {name}; {_there(advice)}"
    else:
        # Of a page by default the first step.
        asked = steps or ((1, 1),)
        # Those up to what is taken are enough.
        there = tuple(islice(advice.numbered(progress), max(step for step, _ in asked)))
        for step, _ in asked:
            if step > len(there):
                raise AskedError(f"there is no step {step}: {_there(advice)}", "no-such-step")
        taken = [there[step - 1] for step, _ in asked]
        change = together(there[step - 1].chosen(choice) for step, choice in asked)
        after = taken[0].after if len(taken) == 1 else tried(advice.analysis, change)
        names = [f"{step}.{choice}" if choice > 1 else str(step) for step, choice in asked]
        words = f"step{'s' * (len(taken) > 1)} {listed(names)}"
        if kind in PAGES:
            pieces = tuple(piece for one in taken for piece in (*one.pieces, " "))
            content = load(pages).page_of(advice, change, pieces)
            said = f"{words} shown in {name}, {after.outcome}"
        else:
            given = advice.analysis.given
            content = edited_deck(given, change.apply(given).data)
            said = f"{words} written to {name}, {after.outcome}"
    if kind in (*PAGES, *STILLS):
        write_together({target: content})
    else:
        write_text(target, content)
    return f"{harmless(advice.analysis.name)}: {said}"


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
    _plan(chosen, decks)
    target: Path | None = chosen.output

    def step(deck: DeckFile) -> Outcome:
        """Advise on one deck, say and write it."""
        with Bar(deck.name, deck.path) as bar:
            result = read_and_analysed(deck, chosen, bar)
            try:
                advice = advice_of(result, chosen.body, chosen.wanted, chosen.bodies)
                # A deck that a step makes needs no step behind it.
                if chosen.json or target is None or target.suffix.lower() in (*PAGES, *STILLS):
                    advice.found(bar.show_work)
                if chosen.count:
                    advice.count()
                with unwinding():
                    written = ""
                    if target is not None:
                        written = _written(advice, target, chosen.apply, bar.show_work)
            except ModelError as error:
                # It stands in no deck.
                first = error.diagnostics[0]
                hint = f"; {first.help}" if first.help else ""
                raise AskedError(f"{first.message}{hint}", first.code) from None
            words = ""
            if chosen.json:
                words = load("json").dumps(
                    line_of(advice.analysis, advice.to_dict()), allow_nan=False
                )
            elif not written:
                words = f"{describe(advice, width=text_width())}\n"
        if words:
            give(words) if chosen.json else say(words)
        if written:
            complain(written) if chosen.json or target == STDOUT else say(written)
        return Outcome(deck.name, ExitCode.ANALYSED, verdict_word(result))

    return take(decks, step, as_json=chosen.json)


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
        argument(
            "--count",
            action="store_true",
            help="count the smallest sets of releases and of declarations, in at most "
            f"{COUNT_SECONDS:.0f} seconds each",
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
        UNITS,
        GRAVITY,
        *ACCURACY_AND_BEYOND,
    ),
)
