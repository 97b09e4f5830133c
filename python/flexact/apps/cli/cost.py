# SPDX-License-Identifier: BSD-3-Clause
"""``flexact cost``: what over-constraint costs, and what each release would keep."""

from __future__ import annotations

import argparse
import re
import time
from functools import partial
from pathlib import Path
from typing import Any

from ...costs.compute import compute
from ...costs.cost import COSTS, Cost
from ...costs.request import DRIVE, HELD, POINTS, Request, RequestError
from ...costs.words import WIDTH, describe
from ...elasticity.limits import AGAINST
from ...util.decks import DeckFile
from ...util.errors import BatchError
from ...util.interruption import unwinding
from ...util.text import harmless
from .decks import UNITS, opened, report_problems, say_trade, take, trades
from .parser import Argument, Verb, argument
from .scatter import ARGUMENTS, scatter_asked
from .targets import asked_in_a_line, give_answer, number, one_deck, outputs_of
from .terminal import Bar, ExitCode, Outcome, complain, text_width

#: What argparse takes for a value although it begins with a minus, such as -5% or -50um.
_NEGATIVE = re.compile(r"-\.?\d.*")


def _many(name: str, form: str, words: str) -> Argument:
    return argument(
        name, action="append", default=[], metavar=form, help=f"{words}; may be repeated"
    )


def cost_deck(chosen: argparse.Namespace) -> ExitCode:
    """Find the cost of the deck, say and write it."""
    deck = one_deck(chosen)
    if chosen.points is not None and chosen.stroke is None:
        raise BatchError("--points is for the places along a stroke: give --stroke, too")
    # Numbers without a unit are in those of the deck, which is read later.
    request = partial(
        Request.of,
        at=_point(chosen.at),
        release=chosen.release or None,
        stroke=chosen.stroke,
        misalign=chosen.misalign,
        shift=chosen.shift,
        held=chosen.held,
        drive=chosen.drive,
        beams=chosen.beams,
        points=POINTS if chosen.points is None else chosen.points,
        bodies=chosen.bodies,
        beyond=chosen.beyond,
        strength=chosen.strength,
        share=chosen.share,
        support=chosen.support,
        against=chosen.against,
    )
    scatter = scatter_asked(chosen)
    try:
        if scatter is None:
            request()
    except RequestError as error:
        *others, last = error.messages
        for each in others:
            complain(f"flexact: error: {harmless(each)}")
        raise BatchError(last) from None
    require = COSTS.require if scatter is None else scatter.require
    files = outputs_of(deck, chosen, require)

    def step(deck: DeckFile) -> Outcome:
        begun = time.perf_counter()
        with Bar(deck.name, deck.path) as bar:
            model = opened(deck, bar, chosen)
            report_problems(model)
            with asked_in_a_line(), unwinding() as look:

                def show(what: str, done: float) -> None:
                    look()
                    bar.show_work(what, done)

                made: Any
                if scatter is not None:
                    made = scatter(model, deck.name, show)
                else:
                    made = compute(model, request(units=model.units), deck.name, show, Cost)
                for target in files:
                    bar.show_work("writing", 1.0)
                    made.save(target)
        gives = "with uncertainties" if chosen.beams == "auto" else "uncertainty not known"
        say_trade(deck, chosen, f"costed with {chosen.beams} beams a sheet", begun, gives)
        words = describe if scatter is None else scatter.describe
        give_answer(
            *(deck, chosen, files),
            table=made.to_csv,
            data=made.to_json,
            words=lambda: f"{words(made, text_width(WIDTH))}\n",
        )
        if scatter is None and made.stroke is not None and made.stroke.why:
            complain(f"{harmless(deck.name)}: error: {harmless(made.stroke.beyond)}")
            return Outcome(deck.name, ExitCode.DECK_ERROR, "costed in part", "stroke beyond reach")
        return Outcome(deck.name, ExitCode.ANALYSED, "costed")

    return take([deck], step, as_json=chosen.json)


def _point(text: str | None) -> int | str | None:
    return int(text) if text is not None and re.fullmatch(r"\d{1,9}", text) else text


VERB = Verb(
    run=cost_deck,
    negative=_NEGATIVE,
    description=(
        "Say what over-constraint costs: how far each clamp may be off, and what the design and "
        "each proven release keep of stiffness and frequencies. The deck gives stiffness (ESTIFF) "
        "and, for frequencies, masses (EM, XM)."
    ),
    examples=(
        (
            "What over-constraint costs",
            "flexact cost input_decks/flexures/notch_guide.dat",
        ),
        (
            "Which errors lower the first frequency by 1 %",
            "flexact cost input_decks/flexures/notch_guide.dat --shift=-1%",
        ),
        (
            "What the workshop's scatter does to stress, frequencies and errors",
            "flexact cost input_decks/flexures/notch_guide.dat --scatter 20um,0.1mrad",
        ),
        (
            "Two kinds of files at once",
            "flexact cost input_decks/flexures/notch_guide.dat -o results/cost.csv "
            "-o results/cost.json",
        ),
    ),
    arguments=(
        argument("deck", metavar="DECK", help="a deck with stiffness, or - for stdin"),
        argument(
            "--at",
            metavar="POINT",
            help="where stiffness is measured: a node or a name (the drive)",
        ),
        _many(
            "--release",
            "E:M[=K]",
            "a design that releases deformation M of element E, with a notch of K, such as "
            "3.5Nm/rad; several together: 1:5+2:5=3.5; none: only as built (default: the proven "
            "releases)",
        ),
        argument(
            "--stroke",
            metavar="POINT:C=FROM..TO",
            help="all of it along a stroke, such as 1:z=25mm..35mm, or from the place in the deck "
            "1:z+=-5mm..5mm",
        ),
        argument("--points", type=number, metavar="N", help=f"places along it ({POINTS})"),
        _many(
            "--misalign",
            "CLAMP:C=VALUE[@POINT]",
            (
                "what this misalignment does, with all of the nonlinearity, such as 11:x=50um, or "
                "turned about a point 11:rx=1mrad@13; several act together"
            ),
        ),
        argument(
            "--shift",
            default="-5%",
            metavar="PART",
            help="of the first frequency, for which tolerances are found (-5%%)",
        ),
        argument(
            "--strength",
            action="store_true",
            help="how far the drive may go until half of the strength is reached (STRENGTH), and "
            "safety factors",
        ),
        argument("--share", metavar="PART", help="of the strength, in place of half"),
        argument(
            "--support",
            metavar="PART",
            help="the stroke, too, to which supported directions keep this part of their stiffness",
        ),
        argument(
            "--against",
            choices=AGAINST,
            help="which strength counts (that of fatigue where it is given)",
        ),
        *ARGUMENTS,
        argument("--drive", choices=DRIVE, default=DRIVE[0], help="declared coordinates"),
        argument("--held", choices=HELD, default=HELD[0], help="held deformations"),
        argument(
            "--beams",
            default="auto",
            metavar="auto|N",
            help="beams a sheet; auto: 8 and 16, extrapolated, with the uncertainty",
        ),
        *trades("beams"),
        argument(
            "--bodies",
            action="store_true",
            help="releases inside of rigid bodies too (default: only where nothing else does it)",
        ),
        argument(
            "--beyond",
            action="store_true",
            help="take strokes and misalignments that are larger than the model",
        ),
        UNITS,
        argument("--json", action="store_true", help="one JSON object on stdout"),
        argument(
            *("-o", "--output"),
            action="append",
            default=[],
            type=Path,
            metavar="FILE",
            help="a picture (.png, .svg, .pdf), a page (.html), a table (.csv) or .json; - for the "
            "table on stdout; may be repeated",
        ),
    ),
)
