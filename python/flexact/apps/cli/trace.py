# SPDX-License-Identifier: BSD-3-Clause
"""``flexact trace``: the path of a motion, both ways, with its dead points."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from ...tracing.output import ENDINGS, TRACES, csv_bytes, lines
from ...tracing.trace import STEPS, trace
from ...util.decks import DeckFile
from ...util.errors import BatchError, FlexactError
from ...util.interruption import unwinding
from ...util.outputs import STDOUT
from ...util.quantities import Quantity, QuantityError, as_typed, quantity
from ...util.text import harmless
from .decks import DECISION, UNITS, read_and_analysed, take
from .parser import Group, Verb, argument
from .targets import DECK, SHOWN_MOTION, number, one_deck, plan_shown, write_text
from .terminal import Bar, ExitCode, Outcome, complain, say


def _length(text: str) -> Quantity:
    try:
        value, made = quantity(text, "m"), as_typed(text, "m")
    except QuantityError as error:
        raise argparse.ArgumentTypeError(str(error)) from None
    if not value > 0.0:
        raise argparse.ArgumentTypeError(f"a length above 0 is wanted, such as 20mm, not {text!r}")
    return made


def trace_deck(chosen: argparse.Namespace) -> ExitCode:
    """Analyse the deck and trace the motion."""
    deck, target = one_deck(chosen), chosen.output
    if target is not None and target != STDOUT:
        plan_shown(deck, target, ENDINGS)
        with unwinding():
            TRACES.require(target)

    def step(deck: DeckFile) -> Outcome:
        with Bar(deck.name, deck.path) as bar:
            analysis = read_and_analysed(deck, chosen, bar)
            try:
                with unwinding() as look:

                    def show(done: float) -> None:
                        look()
                        bar.show_work("tracing", done)

                    made = trace(
                        analysis,
                        motion=chosen.motion,
                        freedom=chosen.freedom,
                        length=chosen.length,
                        steps=chosen.steps,
                        through=chosen.through,
                        beyond=chosen.beyond,
                        progress=show,
                    )
            except BatchError:
                raise
            except FlexactError as error:
                raise BatchError(str(error)) from error
            if target is not None and target != STDOUT:
                with unwinding():
                    made.save(target)
        tell: Callable[[str], None] = say
        if target == STDOUT:
            write_text(target, csv_bytes(made))
            tell = complain
        for line in lines(made):
            tell(harmless(line))
        if target is not None and target != STDOUT:
            say(f"{harmless(deck.name)}: written to {harmless(str(target))}")
        return Outcome(deck.name, ExitCode.ANALYSED, "traced")

    return take([deck], step)


VERB = Verb(
    run=trace_deck,
    description=(
        "Follow a motion, or a declared degree of freedom, both ways from the reference with "
        "every held deformation zero; say how far it goes, what stops it, and where its dead "
        "points are."
    ),
    examples=(
        (
            "How far a declared freedom goes",
            "flexact trace input_decks/linkages/slider_crank_planar.dat --freedom 1",
        ),
        (
            "The path as a table",
            "flexact trace input_decks/linkages/four_bar_planar.dat --motion 1 -o results/path.csv",
        ),
    ),
    arguments=(
        DECK,
        Group(
            "what is followed",
            (
                SHOWN_MOTION,
                argument(
                    "--length",
                    type=_length,
                    metavar="L",
                    help=(
                        "how far each way, such as 20mm, of the node that moves farthest; a "
                        "rotation of 1 rad counts as the model's size (default: that size)"
                    ),
                ),
                argument(
                    "--beyond",
                    action="store_true",
                    help="take a length that is larger than the model",
                ),
                argument(
                    "--steps",
                    type=number,
                    default=STEPS,
                    metavar="N",
                    help=f"steps each way ({STEPS})",
                ),
                argument(
                    "--through",
                    action=argparse.BooleanOptionalAction,
                    default=True,
                    help=(
                        "whether to go straight on where other paths branch off, which is said; "
                        "else the path ends there"
                    ),
                ),
            ),
        ),
        argument(
            "-o",
            "--output",
            type=Path,
            metavar="FILE",
            help=(
                "the path: .csv, a row a step; a picture (.png, .svg, .pdf) of singular values "
                "and places along the path; .pvd, a cycle that plays in ParaView; - for the table "
                "on stdout"
            ),
        ),
        DECISION,
        UNITS,
    ),
    defaults={"accuracy": None},
)
