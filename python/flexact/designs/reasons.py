# SPDX-License-Identifier: BSD-3-Clause
"""Why a problem has no layout: which of its conditions leaves none, and by how much."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial, reduce
from typing import NamedTuple

import numpy as np

from ..advice.spaces.words import Geometry
from ..analysis.places import listed
from ..util.text import number_in_words
from .explain import motions_in_words, places_of_wires
from .layouts import plural
from .possible import Possible
from .problem import KINDS, Box, Limits, Problem, Region
from .regions import all_around
from .symmetry import mirror_possible, symmetry_possible

#: Steps by which it is found how far a condition would have to give, and how far at most.
_STEPS, _FARTHEST = 10, 16.0


class Reason(NamedTuple):
    """The condition that leaves no layout."""

    condition: str
    """wires, regions, kinds, length, width, keep-out, clearance or symmetry."""
    by: float | None
    """What it would have to be, at which a layout was found [m]; None where no number says it."""
    statement: str
    """In a sentence."""


def reason_of(problem: Problem, found: Possible, exists: Callable[[Problem], bool]) -> Reason:
    """Why a problem has no layout.

    Each condition is taken away in turn; the first whose removal gives a layout is named.

    Args:
        problem: The problem.
        found: What its freedom takes.
        exists: Whether a problem has a layout; asked for this one with fewer conditions.
    """
    limits = problem.limits
    if not found.needed:
        return Reason("wires", None, "Every motion is wanted: nothing has to hold the stage.")
    geometry = Geometry(problem.units, problem.size)
    if problem.symmetry not in ("any", "none"):
        free = replace(problem, symmetry="any")
        if exists(free):
            return _of_symmetry(problem, found)
        problem = free
    if (
        not found.parallel
        and limits.bodies < found.least_layers - 1
        and "bellows" not in limits.kinds
    ):
        return Reason("wires", None, _of_wires(geometry, found, limits.bodies))
    loosened = _loosened(problem)
    if exists(reduce(lambda made, each: each[1](made), loosened, problem)):
        for condition, without in loosened:
            if exists(without(problem)):
                # Where bodies are between, each look takes seconds.
                by = _how_far(problem, condition, exists) if found.parallel else None
                return Reason(condition, by, _statement(problem, condition, by))
        names = [condition for condition, _ in loosened]
        said = f"The limits of {listed(names)} leave no layout; none of them by itself."
        return Reason(names[0], None, said)
    every = replace(limits, kinds=tuple(kind for kind in KINDS if kind != "bellows"))
    other = replace(problem, limits=every)
    if not exists(in_free_space(problem)):
        kinds = listed([plural(kind) for kind in limits.kinds])
        if set(every.kinds) != set(limits.kinds) and exists(in_free_space(other)):
            said = f"In no place can {kinds} alone leave just this; flexures of other kinds can."
            return Reason("wires", None, said)
        return Reason("wires", None, _of_wires(geometry, found, limits.bodies))
    more = ""
    if set(every.kinds) != set(limits.kinds) and exists(other):
        more = "; with flexures of other kinds there are layouts"
    if not found.parallel:
        bodies = "Bodies between, and flexures to them, find no place within the regions and limits"
        return Reason("regions", None, f"{bodies}{more}.")
    along = places_of_wires(geometry, found.constraint)
    return Reason(
        "regions",
        None,
        f"Wires must be {along}; too few of these lines lead from the stage to the ground{more}.",
    )


def in_free_space(problem: Problem) -> Problem:
    """The same with ground all around, and with bodies between and flexures anywhere."""
    limits = problem.limits
    corners = problem.stage.corners
    low, high = corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)
    middle, half = (low + high) / 2.0, np.maximum((high - low) / 2.0, problem.size / 4.0)
    length = (0.5 * problem.size, 8.0 * problem.size)
    width = (0.05 * problem.size, max(limits.width[1], 0.1 * problem.size))
    free = replace(limits, length=length, width=width, clearance=0.0)
    return replace(
        problem,
        stage=Region((Box(middle - half, middle + half),)),
        ground=all_around(middle - half, middle + half, problem.size),
        keep_out=(),
        intermediate=(),
        limits=free,
    )


def _wide(limits: Limits, **new: object) -> Limits:
    return replace(limits, **new)  # type: ignore[arg-type]


def _loosened(problem: Problem) -> list[tuple[str, Callable[[Problem], Problem]]]:
    """Conditions, each with what takes it away from a problem."""
    limits, size = problem.limits, problem.size
    least, most = limits.length
    # Middle lines may cross, as if there were no material.
    none = -max(limits.diameter[1], limits.thickness[1])
    made: list[tuple[str, dict[str, object]]] = [
        ("length", {"length": (min(least, 0.05 * size), most * _FARTHEST)}),
        ("width", {"width": (limits.width[0] / _FARTHEST, limits.width[1])}),
        ("clearance", {"clearance": none}),
    ]
    found: list[tuple[str, Callable[[Problem], Problem]]] = [
        (condition, partial(_with_limits, new=new)) for condition, new in made
    ]
    if problem.keep_out:
        found.insert(2, ("keep-out", partial(replace, keep_out=())))
    return found


def _with_limits(problem: Problem, new: dict[str, object]) -> Problem:
    return replace(problem, limits=_wide(problem.limits, **new))


def _how_far(problem: Problem, condition: str, exists: Callable[[Problem], bool]) -> float | None:
    """At what value of a condition a layout was found, to a tenth of how far it has to give."""
    limits, size = problem.limits, problem.size
    least, most = limits.length
    if condition == "keep-out":
        return None
    if condition == "length":
        # Longer ones first: they are what regions mostly lack.
        def longer(value: float) -> Problem:
            return replace(problem, limits=_wide(limits, length=(least, value)))

        def shorter(value: float) -> Problem:
            return replace(problem, limits=_wide(limits, length=(value, most)))

        if exists(longer(most * _FARTHEST)):
            return _bisected(most, most * _FARTHEST, lambda value: exists(longer(value)))
        low = min(least, 0.05 * size)
        if exists(shorter(low)):
            return _bisected(least, low, lambda value: exists(shorter(value)))
        return None
    if condition == "width":

        def narrower(value: float) -> bool:
            return exists(replace(problem, limits=_wide(limits, width=(value, limits.width[1]))))

        return _bisected(limits.width[0], limits.width[0] / _FARTHEST, narrower)

    def nearer(value: float) -> bool:
        return exists(replace(problem, limits=_wide(limits, clearance=value)))

    return _bisected(limits.clearance, 0.0, nearer) if nearer(0.0) else None


def _bisected(bad: float, good: float, exists: Callable[[float], bool]) -> float:
    """The value nearest to a bad one for which something exists, from a good one."""
    for _ in range(_STEPS):
        if abs(good - bad) <= 0.02 * max(abs(good), abs(bad)):
            break
        middle = math.sqrt(good * bad) if good * bad > 0.0 else (good + bad) / 2.0
        if exists(middle):
            good = middle
        else:
            bad = middle
    return good


def _statement(problem: Problem, condition: str, by: float | None) -> str:
    limits = problem.limits

    def said(value: float) -> str:
        return problem.units.said(value, "m", 2)

    if condition == "keep-out":
        return "What is to be kept out of leaves no room; without it there is a layout."
    if condition == "clearance" and by is None:
        return "Every set of flexures that fits has some that run through each other."
    if by is None:
        return f"The limits of the {condition} leave no layout; wider ones do."
    if condition == "length":
        least, most = limits.length
        if by > most:
            return f"Flexures are at most {said(most)} long; {said(by)} would do."
        return f"Flexures are at least {said(least)} long; {said(by)} would do."
    if condition == "width":
        return f"Sheets are at least {said(limits.width[0])} wide; {said(by)} would do."
    return f"Flexures are {said(limits.clearance)} apart at least; {said(by)} would do."


def _of_wires(geometry: Geometry, found: Possible, bodies: int) -> str:
    count = found.extra_dimension
    ways = "way" if count == 1 else "ways"
    words = motions_in_words(geometry, found.alone)
    said = (
        f"Wires alone leave {number_in_words(count)} more {ways} to move: {words}."
        if found.forces.dimension
        else "No wire can hold what is to be held: along any line it would stop what is wanted."
    )
    layers = found.least_layers
    if bodies < layers - 1:
        more = layers - 1
        return f"{said} It takes {number_in_words(more)} bod{'ies' if more > 1 else 'y'} between."
    return f"{said} No layers with bodies between were found within the regions."


def _of_symmetry(problem: Problem, found: Possible) -> Reason:
    what, _, axis = problem.symmetry.replace(" about", "").rpartition(" ")
    direction = np.eye(3)["xyz".index(axis)]
    freedom, centre = found.freedom, problem.centre
    if what == "mirror":
        theory = mirror_possible(freedom, centre, direction)
    else:
        theory = symmetry_possible(freedom, centre, direction, int(what.split("-")[0]))
    said = theory.statement
    if theory.exact and theory.wires == found.wires:
        said = f"{said} Within the regions and limits none was found with it."
    return Reason("symmetry", None, said)
