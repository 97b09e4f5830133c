# SPDX-License-Identifier: BSD-3-Clause
"""``flexact table``: stiffness and compliance at a point, along a stroke, and when it is warm."""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np

from ...costs.request import DRIVE, HELD, POINTS, RequestError, stroke_of
from ...costs.resolve import Places
from ...deck.rendering import ModelError, ProblemsError
from ...elasticity import Elastic
from ...elasticity.mesh import beams_given
from ...elasticity.tables import TABLES, PointTable, StrokeTable
from ...show.writers import as_bytes
from ...util.decks import DeckFile
from ...util.errors import BatchError, FlexactError
from ...util.interruption import unwinding
from ...util.outputs import STDOUT, plan_file
from ...util.quantities import Quantity, QuantityError, as_typed, without_units
from ...util.text import harmless
from .decks import UNITS, opened, report_problems, take
from .parser import Group, Verb, argument
from .targets import DECK, number, number_or_name, one_deck
from .terminal import Bar, ExitCode, Outcome, complain, give, put, say

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
    to_stdout = STDOUT in chosen.output
    if to_stdout and chosen.json:
        raise BatchError("--json and -o - both go to standard output: choose one")
    files = [target for target in chosen.output if target != STDOUT]
    for target in files:
        plan_file(deck, target)
        with unwinding():
            TABLES.require(target)
    try:
        stroke = None if chosen.stroke is None else stroke_of(chosen.stroke)
        beams = beams_given(int(chosen.beams) if chosen.beams.isdigit() else chosen.beams)
    except (RequestError, TypeError, ValueError) as error:
        raise BatchError(str(error)) from None

    def step(deck: DeckFile) -> Outcome:
        with Bar(deck.name, deck.path) as bar:
            data = opened(deck, bar, chosen)
            report_problems(data)
            bar.show("computing")
            try:
                with unwinding():
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
                    if stroke is None:
                        state = warm or elastic.undeformed()
                        made = state.table(at, chosen.frame, chosen.place)
                    else:
                        point, name, _, _, from_rest = stroke
                        unit = "rad" if name.startswith("r") else "m"
                        # What says no unit is in those of the model, which the deck has said.
                        start, dots, stop = chosen.stroke.rpartition("=")[2].partition("..")
                        if not dots:
                            stop = start.strip().removeprefix("+-")
                            start = f"-{stop.strip()}"
                        symbol = data.units.symbol(unit)
                        first, last = without_units(
                            [as_typed(each, unit) for each in (start, stop)], symbol
                        )
                        values = np.linspace(first, last, chosen.points or POINTS)
                        values = data.units.shown(values, unit)
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
            except BatchError:
                raise
            except ModelError as error:
                # What was asked for and is not there, in a line.
                told = (f"{e.message}{f'; {e.help}' if e.help else ''}" for e in error.diagnostics)
                raise BatchError("\n".join(told)) from None
            except ProblemsError:
                raise
            except FlexactError as error:
                raise BatchError(str(error)) from error
        if to_stdout:
            put(as_bytes(made.to_csv()))
        elif chosen.json:
            both = made.to_dict() | ({"warmed": warm.to_dict()} if warm else {})
            give(json.dumps(both, allow_nan=False))
        else:
            say("\n\n".join([*([warm.describe()] if warm else []), made.describe()]))
        for target in files:
            text = f"{harmless(deck.name)}: written to {harmless(str(target))}"
            complain(text) if chosen.json or to_stdout else say(text)
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
