# SPDX-License-Identifier: BSD-3-Clause
"""One design: what it keeps, what its clamps may be off, what its stroke costs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..elasticity import ElasticError
from ..model.parts.parts import Parts
from . import along
from .compute import effect_of
from .designs import Design
from .elastic_design import Bench
from .keeping import kept_of
from .measuring import Measures, drives_of, numbers, over_levels
from .proven import Candidate
from .shapes import shapes_of
from .tolerances import curve_against, tolerances_of
from .values import Kept, Misalignment, Numbers, Tolerance

Progress = Callable[[float], None]
#: Parts of the work of a design that its tolerances, curve, stroke and effect are.
_TOLERANCES, _CURVE, _STROKE = 0.4, 0.5, 0.9


class Wanted(NamedTuple):
    """What is to be found of each design."""

    measures: Measures
    parts: Parts
    misalignments: tuple[Misalignment, ...]
    shift: float
    stroke: along.Asked | None
    given: tuple[tuple[Misalignment, float], ...]
    """Misalignments that act together."""


def kept_beside(measures: Measures, before: Bench, after: Bench) -> Kept | None:
    """What a design keeps of the stiffness of the one as built."""
    one, two = before.rest, after.rest
    finest = measures.ratios(one.alone[-1], two.alone[-1])
    mu = numbers(over_levels(lambda a, b: measures.ratios(a, b).mu, one, two))
    return kept_of(finest, mu, measures.directions)


def frequencies_of(measures: Measures, bench: Bench) -> tuple[Numbers | None, tuple[bool, ...]]:
    """The lowest frequencies at rest, and which are the drive's."""
    if not measures.has_masses:
        return None, ()
    found = numbers(over_levels(measures.frequencies, bench.rest))
    if not found.value.size:
        return None, ()
    if bench.choice.drive == "locked":
        return found, (False,) * found.value.size
    return found, drives_of(measures, bench.rest, found.value.size)


def design_of(
    wanted: Wanted, built: Bench, bench: Bench, candidate: Candidate, progress: Progress
) -> tuple[Design, along.Along | None]:
    """A design but for its curve, and how far it was followed along the stroke.

    What has no answer is a remark.
    """
    measures, remarks = wanted.measures, list[str]()
    frequencies, is_drive = frequencies_of(measures, bench)
    tolerances: tuple[Tolerance, ...] = ()
    try:
        tolerances = tolerances_of(
            *(bench, wanted.misalignments, wanted.shift, measures.size),
            lambda done: progress(_TOLERANCES * done),
        )
    except ElasticError as error:
        remarks.append(f"No tolerances: {error}.")
    design = Design(
        candidate.released,
        candidate.alike,
        candidate.under_constrained,
        candidate.over_constrained,
        numbers(bench.rest.estimate(measures.compliance)),
        None if bench is built else kept_beside(measures, built, bench),
        frequencies,
        is_drive,
        tolerances,
        measures.size,
    )
    way = None
    if wanted.stroke is not None:
        way = along.follow(bench.elastic, wanted.stroke)
        drive = (wanted.stroke.node, wanted.stroke.coordinate)
        curve = along.curve_of(
            *(measures, bench.rest, way, drive, bench.choice.drive == "locked"),
            lambda done: progress(_CURVE + (_STROKE - _CURVE) * done),
        )
        design = replace(design, stroke=curve)
    if wanted.given:
        try:
            design = replace(design, effect=effect_of(bench, measures, wanted.given, wanted.parts))
        except ElasticError as error:
            remarks.append(f"Misaligned: {error}.")
    shapes = tuple(shapes_of(bench, frequencies, is_drive, design.buckles_at))
    return replace(design, shapes=shapes, remarks=tuple(remarks)), way


def with_curve(design: Design, bench: Bench, built: Design) -> Design:
    """With the first frequency against the misalignment that matters most as built."""
    matters = built.tightest or built.buckles_at
    if matters is None:
        return design
    mine = next(
        (each for each in design.tolerances if each.misalignment == matters.misalignment), None
    )
    critical = matters.critical
    reach = critical.value if critical.is_finite else 4.0 * matters.tightest.value
    if mine is None or not np.isfinite(reach):
        return design
    return replace(design, curve=curve_against(bench, mine, reach))
