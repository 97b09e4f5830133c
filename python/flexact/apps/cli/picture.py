# SPDX-License-Identifier: BSD-3-Clause
"""``flexact picture``: a deck's mechanism as a picture, still or moving."""

from __future__ import annotations

import argparse

from ...show.drawing import quantity_named
from ...show.picture import check_packages, check_suffix, check_view, picture_bytes
from ...show.picture.subject import refuse_zero
from ...util.decks import DeckFile
from ...util.interruption import unwinding
from ...util.outputs import plan_file, write_together
from ...util.text import harmless
from .decks import ACCURACY_AND_BEYOND, DECISION, UNITS, read_and_analysed, take
from .parser import Group, Verb, argument
from .targets import SHOWN_MOTION, deck_arguments, number, one_deck
from .terminal import Bar, ExitCode, Outcome, say

_QUANTITIES = ("normal-force", "twist-moment", "in-plane-moment", "out-of-plane-moment")


def _quantity(text: str) -> str:
    """A quantity by any of its names, as an option's type."""
    if quantity_named(text) is None:
        choices = ", ".join(_QUANTITIES)
        raise argparse.ArgumentTypeError(f"invalid choice: {text!r} (choose from {choices})")
    return text


def draw_deck(chosen: argparse.Namespace) -> ExitCode:
    """Analyse the deck and draw it."""
    deck, target = one_deck(chosen), chosen.output
    with unwinding():
        check_suffix(target.suffix)
        check_packages(target.suffix)
        check_view(chosen.view)
    plan_file(deck, target)

    def step(deck: DeckFile) -> Outcome:
        with Bar(deck.name, deck.path) as bar:
            analysis = read_and_analysed(deck, chosen, bar)
            with unwinding():
                refuse_zero(analysis, chosen.stress, chosen.quantity)
                content = picture_bytes(
                    analysis,
                    target.suffix,
                    motion=chosen.motion,
                    freedom=chosen.freedom,
                    stress=chosen.stress,
                    quantity=chosen.quantity,
                    held=chosen.held,
                    view=chosen.view,
                    progress=lambda done: bar.show_work("drawing", done),
                )
            with unwinding():
                write_together({target: content})
        say(f"{harmless(deck.name)}: drawn in {harmless(str(target))}")
        return Outcome(deck.name, ExitCode.ANALYSED, "drawn")

    return take([deck], step)


VERB = Verb(
    run=draw_deck,
    description="Draw a mechanism: by default its first motion and its first self-stress.",
    examples=(
        (
            "The first motion and the first self-stress",
            "flexact picture input_decks/paper/twelve_trusses.dat -o results/trusses.png",
        ),
        (
            "One quantity of a self-stress, from the front",
            "flexact picture input_decks/flexures/parallel_guide.dat --quantity in-plane-moment "
            "--view front -o results/moment.svg",
        ),
    ),
    arguments=(
        *deck_arguments("the picture: .png, .svg or .pdf; .gif, .mp4 or .webm, which move"),
        Group(
            "what is shown",
            (
                SHOWN_MOTION,
                argument(
                    "--stress",
                    type=number,
                    metavar="K",
                    help="show self-stress K, coloured by its resultant",
                ),
                argument(
                    "--quantity",
                    type=_quantity,
                    metavar="QUANTITY",
                    help=f"of the self-stress: {', '.join(_QUANTITIES)} (default: the dominant "
                    "one); N, T, My and Mz are older names of the four",
                ),
                argument(
                    "--held",
                    action="store_true",
                    help=(
                        "show what each flexure of an exactly constrained mechanism holds, and "
                        "how well"
                    ),
                ),
                argument(
                    "--view",
                    default="iso",
                    metavar="VIEW",
                    help=(
                        "iso (default), front, back, left, right, top, bottom, or AZ,EL: azimuth "
                        "and elevation of the eye in degrees, as in --view=-60,25; z is up"
                    ),
                ),
            ),
        ),
        DECISION,
        UNITS,
        *ACCURACY_AND_BEYOND,
    ),
)
