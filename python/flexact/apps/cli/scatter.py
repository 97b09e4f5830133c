# SPDX-License-Identifier: BSD-3-Clause
"""``flexact cost --scatter``: what clamps and thicknesses that scatter do to a mechanism."""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ...elasticity import elastic
from ...model.data import ModelData
from ...model.model import Model
from ...show.writers import TABLES
from ...util.errors import BatchError
from ...util.loading import load
from ...util.outputs import STDOUT
from ...util.quantities import Quantity, QuantityError
from ...util.text import in_short
from .parser import argument
from .targets import number

if TYPE_CHECKING:
    from ...sweeps.scatter_result import Scatter

#: What is asked of a cost alone, and of scatter alone.
_OF_COST = ("release", "misalign", "strength", "share", "support", "points", "bodies")
_OF_SCATTER = ("samples", "seed", "limit", "workers", "resume")
#: By default.
_SAMPLES = 1000
_NUMBER = re.compile(r"\s*[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?\s*")


@dataclass(frozen=True)
class ScatterAsked:
    """What was asked for.

    Attributes:
        chosen: The options.
        spread: Standard deviations by name.
        limits: By quantity; None where none is given.
        journal: The file that keeps what is done; None without a table.
    """

    chosen: argparse.Namespace
    spread: dict[str, Quantity]
    limits: dict[str, Quantity] | None
    journal: Path | None

    def require(self, target: Path) -> None:
        """Raise where a file of this name cannot be written."""
        load("flexact.sweeps.scatter_result").require_suffix(target)

    def describe(self, made: Scatter, width: int) -> str:
        """The answer in words."""
        return made.describe(width)

    def __call__(self, data: ModelData, name: str, show: Callable[[str, float], object]) -> Scatter:
        """The answer."""
        chosen = self.chosen
        beams = int(chosen.beams) if chosen.beams.isdigit() else chosen.beams
        at = chosen.at
        made: Scatter = elastic(
            Model.from_data(data), held=chosen.held, drive=chosen.drive, beams=beams
        ).scatter(
            *map(self.spread.get, ("position", "angle", "thickness")),
            samples=_SAMPLES if chosen.samples is None else chosen.samples,
            seed=chosen.seed or 0,
            limits=self.limits,
            stroke=chosen.stroke,
            at=int(at) if at is not None and at.isdigit() else at,
            against=chosen.against,
            beyond=chosen.beyond,
            workers=chosen.workers,
            resume=self.journal,
            progress=show,
            name=name,
        )
        return made


def _given(chosen: argparse.Namespace, name: str) -> bool:
    return getattr(chosen, name) not in (None, False, [])


def scatter_asked(chosen: argparse.Namespace) -> ScatterAsked | None:
    """What was asked for; None without --scatter.

    Raises:
        BatchError: options do not go together, or something is not understood.
    """
    is_asked = chosen.scatter is not None
    others = [each for each in (_OF_COST if is_asked else _OF_SCATTER) if _given(chosen, each)]
    if others:
        named = ", ".join(f"--{each}" for each in others)
        way = "does not go with" if is_asked else "is for"
        raise BatchError(f"{named} {way} --scatter{'' if is_asked else ': give that, too'}")
    if not is_asked:
        return None
    try:
        spread = load("flexact.sweeps.scatter").spread_of(chosen.scatter)
    except QuantityError as error:
        raise BatchError(f"--scatter: {error}") from None
    limits: dict[str, Quantity] = {}
    for each in chosen.limit:
        name, sign, value = each.partition("=")
        if not sign or name.strip() in limits:
            twice = "is given twice" if sign else "is written NAME=VALUE, such as stress=240MPa"
            raise BatchError(f"--limit {twice}; {in_short(each)}")
        limits[name.strip()] = float(value) if _NUMBER.fullmatch(value) else value
    tables = [each for each in chosen.output if each.suffix.lower() in TABLES and each != STDOUT]
    journal = tables[0].with_name(f"{tables[0].name}.journal") if tables else None
    if chosen.resume and journal is None:
        raise BatchError("--resume is for a table that was not finished: name it with -o")
    if journal is not None and journal.exists() and not chosen.resume:
        raise BatchError(
            f"{journal} is there, of a run that was interrupted: go on with --resume, or delete it "
            "to start anew"
        )
    return ScatterAsked(chosen, spread, limits or None, journal)


ARGUMENTS = (
    argument(
        "--scatter",
        metavar="SD,SD,thickness=SD",
        help="instead: what clamps that are off and thicknesses do, normal, with these standard "
        "deviations of positions, angles and thicknesses, such as 20um,0.1mrad,thickness=5um",
    ),
    argument("--samples", type=number, metavar="N", help="of scatter (1000)"),
    argument("--seed", type=number, metavar="N", help="from which samples are made again (0)"),
    argument(
        "--limit",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="what good samples keep: stress, strength (a part of it), force, x to rz at most, "
        "frequency and parasitic at least, such as stress=240MPa; may be repeated (strength=0.5)",
    ),
    argument("-j", "--workers", type=number, metavar="N", help="processes (one a processor)"),
    argument("--resume", action="store_true", help="go on with the table -o that was not finished"),
)
