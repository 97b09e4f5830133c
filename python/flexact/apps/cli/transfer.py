# SPDX-License-Identifier: BSD-3-Clause
"""``flexact transfer``: what a controller sees from forces or base motion to displacements."""

from __future__ import annotations

import argparse
import re
import time
from pathlib import Path

import numpy as np

from ...core.elements import Class
from ...costs.request import DRIVE, HELD, ReleaseRequest, RequestError, release_of
from ...elasticity import elastic
from ...elasticity.points import Coordinate, Points
from ...elasticity.state_space import StateSpace
from ...elasticity.system_files import TRANSFERS
from ...elasticity.transfer import WIDTH, csv_text, describe
from ...model.model import Model
from ...util.decks import DeckFile
from ...util.errors import BatchError
from ...util.interruption import unwinding
from ...util.quantities import QuantityError, as_typed
from .decks import UNITS, opened, report_problems, say_trade, take, trades
from .parser import Verb, argument
from .targets import asked_in_a_line, give_answer, number, one_deck, outputs_of
from .terminal import Bar, ExitCode, Outcome, text_width

#: Where a state is driven to: the point, the coordinate, whether from the deck's place, and where.
_PLACE = re.compile(r"(?s)(.+):\s*(\w+)\s*(\+?)=(.+)")


def transfer_deck(chosen: argparse.Namespace) -> ExitCode:
    """Find the transfer of the deck, say and write it."""
    deck = one_deck(chosen)
    files = outputs_of(deck, chosen, TRANSFERS.require)

    def step(deck: DeckFile) -> Outcome:
        begun = time.perf_counter()
        with Bar(deck.name, deck.path) as bar:
            model = opened(deck, bar, chosen)
            report_problems(model)
            with asked_in_a_line(), unwinding():
                bar.show_work("finding all modes", 0.0)
                made = _transfer(Model.from_data(model), chosen)
                for target in files:
                    bar.show_work("writing", 1.0)
                    made.save(target)
        work = f"transferred with {chosen.beams} beams a sheet"
        say_trade(deck, chosen, work, begun, "uncertainty not known")
        give_answer(
            *(deck, chosen, files),
            table=lambda: csv_text(made),
            data=made.to_json,
            words=lambda: f"{describe(made, text_width(WIDTH))}\n",
        )
        return Outcome(deck.name, ExitCode.ANALYSED, "transferred")

    return take([deck], step, as_json=chosen.json)


def _transfer(model: Model, chosen: argparse.Namespace) -> StateSpace:
    """The linear system of the state that was asked for.

    Raises:
        BatchError: something is not written as it is to be.
        ElasticError: something is not there, or has no answer.
    """
    try:
        release: ReleaseRequest = {}
        for text in chosen.release:
            release.update(release_of(text))
        beams = int(chosen.beams) if chosen.beams.isdigit() else chosen.beams
        found = elastic(model, chosen.held, chosen.drive, release, beams)
    except (RequestError, TypeError) as error:
        raise BatchError(str(error)) from None
    drives = np.argwhere(model.data.arrays.coordinate_class.T == Class.INDEPENDENT).tolist()
    own = [_words(found.points, Coordinate(*each)) for each in drives]
    sources, sinks = chosen.sources or own, chosen.sinks or own
    if not sources or not sinks or (own in (sources, sinks) and len(own) > 1):
        raise BatchError(
            "from what to what? such as --from stage:y --to stage:y; base motion is "
            "--from 'base:y motion'"
        )
    asked = sources, sinks, chosen.damping, chosen.modes
    if chosen.stroke is None:
        return found.state_space(*asked)
    place = _PLACE.fullmatch(chosen.stroke)
    if place is None:
        raise BatchError(
            "a state is written POINT:COORDINATE=VALUE, such as stage:y=3mm, or from the place in "
            f"the deck stage:y+=3mm, not {chosen.stroke!r}"
        )
    point, name, by, value = place.groups()
    node = int(point) if point.isdigit() else point
    try:
        there = as_typed(value, "rad" if name.startswith("r") else "m")
    except QuantityError as error:
        raise BatchError(str(error)) from None
    (state,) = found.along(node, name, [there], from_rest=bool(by))
    return state.state_space(*asked)


def _words(points: Points, coordinate: Coordinate) -> str:
    """A coordinate as it is asked for, by the body that its node stands for where it has a name."""
    parts, node = points.parts, coordinate.node
    body = parts.body_at.get(node)
    name = ""
    if body is not None and parts.first_points[body] == node and parts.of_body(body).is_named:
        name = parts.of_body(body).name
    return f"{name or points.number(node)}:{points.name(coordinate)}"


def ratios(text: str) -> float | list[float]:
    """Modal damping, one or one a mode, such as 0.01, 1% or 1%,2%,2%, as an option's type."""
    try:
        made = [
            float(part.removesuffix("%")) / (100.0 if part.endswith("%") else 1.0)
            for part in map(str.strip, text.split(","))
        ]
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"a modal damping is wanted, such as 0.01 or 1%, or one a mode 1%,2%,2%, not {text!r}"
        ) from None
    return made if len(made) > 1 else made[0]


VERB = Verb(
    run=transfer_deck,
    description=(
        "Say what a controller sees: static gain, poles, zeros and the frequency response from "
        "forces or base motion to displacements, with modal damping. The deck gives stiffness "
        "(ESTIFF) and masses (EM, XM)."
    ),
    examples=(
        (
            "From a force on the stage to its displacement",
            "flexact transfer input_decks/flexures/notch_guide.dat --from 14:x --to 14:x",
        ),
        (
            "From the floor, with two modes, as a picture and a table",
            "flexact transfer input_decks/flexures/notch_guide.dat --from 'ground:x motion' "
            "--to 14:x --modes 2 -o results/bode.png -o results/bode.csv",
        ),
    ),
    arguments=(
        argument("deck", metavar="DECK", help="a deck with stiffness and mass, or - for stdin"),
        argument(
            "--from",
            dest="sources",
            action="append",
            default=[],
            metavar="POINT:C",
            help="a force or moment there, such as stage:y (by default where the only declared "
            "coordinate is); a pair of opposite ones "
            "stage:y-base:y; the motion of what is fixed 'base:y motion', of all of it "
            "'ground:y motion'; may be repeated",
        ),
        argument(
            "--to",
            dest="sinks",
            action="append",
            default=[],
            metavar="POINT:C",
            help="what is seen, such as stage:y; a difference stage:y-base:y; a rate "
            "'stage:y velocity'; may be repeated",
        ),
        argument(
            "--damping",
            type=ratios,
            default=0.01,
            metavar="RATIO",
            help="modal damping, such as 0.01 or 1%%; one a mode: 1%%,2%%,2%% with --modes 3 (1%%)",
        ),
        argument(
            "--modes",
            type=number,
            metavar="N",
            help="the N slowest, the others by what they do statically (default: all)",
        ),
        argument(
            "--stroke",
            metavar="POINT:C=VALUE",
            help="in the state driven there, such as stage:y=3mm, or from the place in the deck "
            "stage:y+=3mm (default: at rest)",
        ),
        argument(
            "--release",
            action="append",
            default=[],
            metavar="E:M[=K]",
            help="release deformation M of element E, with a notch of K, such as 3.5Nm/rad; may be "
            "repeated",
        ),
        argument("--drive", choices=DRIVE, default=DRIVE[0], help="declared coordinates"),
        argument("--held", choices=HELD, default=HELD[0], help="held deformations"),
        argument(
            "--beams",
            default="auto",
            metavar="auto|N",
            help="beams a sheet; auto: 16",
        ),
        UNITS,
        *trades("beams"),
        argument("--json", action="store_true", help="one JSON object on stdout"),
        argument(
            *("-o", "--output"),
            action="append",
            default=[],
            type=Path,
            metavar="FILE",
            help="a Bode picture (.png, .svg, .pdf), a page (.html), the frequency response "
            "(.csv), .json, or A, B, C, D for MATLAB (.mat); - for the response on stdout; may "
            "be repeated",
        ),
    ),
)
