# SPDX-License-Identifier: BSD-3-Clause
"""``flexact table``: stiffness and compliance at a point, along a stroke, and when it is warm."""

from __future__ import annotations

import argparse
import json
import re
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from ...costs.request import DRIVE, HELD, POINTS, RequestError, stroke_of
from ...costs.resolve import Places
from ...elasticity import Elastic
from ...elasticity.mesh import beams_given
from ...elasticity.tables import TABLES, PointTable, StrokeTable
from ...util.decks import DeckFile
from ...util.errors import BatchError
from ...util.interruption import unwinding
from ...util.quantities import Quantity, QuantityError, as_typed
from .decks import UNITS, opened, report_problems, say_trade, take, trades
from .parser import Group, Verb, argument
from .targets import (
    DECK,
    asked_in_a_line,
    give_answer,
    number,
    number_or_name,
    one_deck,
    outputs_of,
)
from .terminal import Bar, ExitCode, Outcome

#: What argparse takes for a value although it begins with a minus, such as -10.
_NEGATIVE = re.compile(r"-\.?\d.*")


def _listed(*units: str) -> Callable[[str], list[Quantity]]:
    """An option's type: quantities behind commas; what says no unit is in those of the model."""

    def read(text: str) -> list[Quantity]:
        given = text.split(",")
        if len(given) != len(units):
            raise argparse.ArgumentTypeError(f"{len(units)} numbers are wanted, not {text!r}")
        try:
            return [as_typed(each, unit) for each, unit in zip(given, units, strict=True)]
        except QuantityError as error:
            raise argparse.ArgumentTypeError(str(error)) from None

    return read


def table_deck(chosen: argparse.Namespace) -> ExitCode:
    """Make the table, say and write it."""
    deck = one_deck(chosen)
    if chosen.points is not None and chosen.stroke is None:
        raise BatchError("--points is for the places along a stroke: give --stroke, too")
    for name in ("expansion", "gradient", "ground"):
        if getattr(chosen, name) is not None and chosen.warm is None:
            raise BatchError(f"--{name} is for what is warm: give --warm, too")
    files = outputs_of(deck, chosen, TABLES.require)
    try:
        if chosen.stroke is not None:
            stroke_of(chosen.stroke)
        beams = beams_given(int(chosen.beams) if chosen.beams.isdigit() else chosen.beams)
    except (RequestError, TypeError, ValueError) as error:
        raise BatchError(str(error)) from None

    def step(deck: DeckFile) -> Outcome:
        begun = time.perf_counter()
        with Bar(deck.name, deck.path) as bar:
            data = opened(deck, bar, chosen)
            report_problems(data)
            bar.show("computing")
            with asked_in_a_line(), unwinding():
                elastic, warm = Elastic(data, chosen.held, chosen.drive, {}, beams), None
                at = chosen.at
                if at is None:
                    at = Places(data, elastic.points.parts).point(None).node
                if chosen.warm is not None:
                    given = {
                        "by": chosen.warm[0],
                        "gradient": chosen.gradient,
                        "ground": chosen.ground,
                        "expansion": chosen.expansion and chosen.expansion[0],
                    }
                    warm = elastic.warmed(**given)
                    elastic = warm.model
                made: PointTable | StrokeTable
                if chosen.stroke is None:
                    state = warm or elastic.undeformed()
                    made = state.table(at, chosen.frame, chosen.place)
                else:
                    # What says no unit is in those of the model, which the deck has said.
                    point, name, first, last, from_rest = stroke_of(chosen.stroke, data.units)
                    values = np.linspace(first, last, chosen.points or POINTS)
                    values = data.units.shown(values, "rad" if name.startswith("r") else "m")
                    of = point if chosen.at is None else at
                    made = elastic.stroke_table(
                        *(point, name, values.tolist()),
                        of=of,
                        frame=chosen.frame,
                        at=chosen.place,
                        from_rest=from_rest,
                        beyond=chosen.beyond,
                    )
                for target in files:
                    made.save(target)
        gives = "with uncertainties" if chosen.beams == "auto" else "uncertainty not known"
        say_trade(deck, chosen, f"tabulated with {chosen.beams} beams a sheet", begun, gives)
        both = warm.to_dict() if warm else None
        give_answer(
            *(deck, chosen, files),
            table=made.to_csv,
            data=lambda: json.dumps(
                made.to_dict() | ({"warmed": both} if both else {}), allow_nan=False
            ),
            words=lambda: "\n\n".join([*([warm.describe()] if warm else []), made.describe()]),
        )
        return Outcome(deck.name, ExitCode.ANALYSED, "tabulated")

    return take([deck], step, as_json=chosen.json)


VERB = Verb(
    run=table_deck,
    negative=_NEGATIVE,
    description=(
        "Say what a point does under forces and moments: stiffness and compliance in any frame, "
        "principal stiffnesses as lines, the centre of compliance; parasitic motions along a "
        "stroke; where it goes when the mechanism is warm. The deck gives stiffness (ESTIFF)."
    ),
    examples=(
        (
            "The stiffness of a stage, and its centre of compliance",
            "flexact table input_decks/flexures/notch_guide.dat",
        ),
        (
            "Parasitic motions along a stroke, as a table and a picture",
            "flexact table input_decks/paper/six_folded_sheets.dat --stroke 1:z=+-2mm --points 5 "
            "-o results/stroke.csv -o results/stroke.png",
        ),
        (
            "Where it goes when it is 10 K warmer",
            "flexact table input_decks/paper/six_folded_sheets.dat --warm 10 --expansion 12e-6",
        ),
    ),
    arguments=(
        DECK,
        Group(
            "where",
            (
                argument(
                    "--at",
                    type=number_or_name,
                    metavar="POINT",
                    help="a node or a name, also of a body (the driven point)",
                ),
                argument(
                    "--place",
                    type=_listed("m", "m", "m"),
                    metavar="X,Y,Z",
                    help="another place that is carried with the point, such as 0,20mm,5mm",
                ),
                argument(
                    "--frame",
                    default="global",
                    metavar="NAME",
                    help="in the axes of a part at rest (those of the model)",
                ),
                argument(
                    "--stroke",
                    metavar="POINT:C=FROM..TO",
                    help="along a stroke, such as 1:z=25mm..35mm, or from the place in the deck "
                    "1:z+=-5mm..5mm",
                ),
                argument("--points", type=number, metavar="N", help=f"places along it ({POINTS})"),
                argument(
                    "--beyond", action="store_true", help="take a stroke larger than the model"
                ),
            ),
        ),
        Group(
            "warmth",
            (
                argument(
                    "--warm",
                    type=_listed("K"),
                    metavar="KELVIN",
                    help="by how much all but the ground is warmer",
                ),
                argument(
                    "--expansion",
                    type=_listed("1/K"),
                    metavar="ALPHA",
                    help="coefficient of what has none of its own (EXPANSION), such as 12e-6",
                ),
                argument(
                    "--gradient",
                    type=_listed("K/m", "K/m", "K/m"),
                    metavar="GX,GY,GZ",
                    help="of the temperature, such as 0,0,5K/m",
                ),
                argument(
                    "--ground",
                    type=_listed("K", "1/K"),
                    metavar="KELVIN,ALPHA",
                    help="by how much the ground is warmer, with its own coefficient",
                ),
            ),
        ),
        UNITS,
        argument("--drive", choices=DRIVE, default=DRIVE[0], help="declared coordinates"),
        argument("--held", choices=HELD, default=HELD[0], help="held deformations"),
        argument("--beams", default="auto", metavar="auto|N", help="beams a sheet; auto: 8 and 16"),
        *trades("beams"),
        argument("--json", action="store_true", help="one JSON object on stdout"),
        argument(
            *("-o", "--output"),
            action="append",
            default=[],
            type=Path,
            metavar="FILE",
            help="a picture (.png, .svg, .pdf), a table (.csv) or .json; - for the table on "
            "stdout; may be repeated",
        ),
    ),
)
