# SPDX-License-Identifier: BSD-3-Clause
"""A traced path in plain English."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator
from itertools import groupby

from ..analysis.naming import (
    counted,
    counts_in_words,
    freedom_in_words,
    in_words,
    motion_in_words,
    named_element,
    plain,
)
from ..analysis.places import listed, with_article
from ..motion import Ending, Stop
from ..show.writers import as_bytes
from ..util.rotations import vector_of
from .values import ROTATION, DeadPoint, Step, Traced, bodies_of, drive_unit, points_of

_RANGES = {
    "length": "its ends have come to one point",
    "bending": "an end of it is at right angles to the line between its ends",
}
#: How many dead points, and how many changes of the counts, are told one by one.
_MOST = 12
#: Residuals up to here are rounding.
_ROUNDING = 1.0e-14


def lines(trace: Traced) -> list[str]:
    """What is to be said of a path, in sentences."""
    shown, dead = trace.shown, trace.dead_points
    what = motion_in_words(trace.result, shown.number, shown.freedom)
    told = [f"{_capital(what)}, followed both ways with every held deformation zero."]
    for side, way in (("Along it", trace.along), ("Against it", trace.against)):
        told.append(f"{side}: {way.length:.4g} m; {stop_in_words(trace, way.stop)}.")
    if shown.freedom is not None:
        values = [step.drive for step in trace.steps]
        told.append(
            f"{_capital(plain(freedom_in_words(shown.freedom)))} goes from {min(values):+.6g} to "
            f"{max(values):+.6g} {drive_unit(shown.freedom)}; its declaration was let loose."
        )
    for step in dead[:_MOST]:
        place = "At the reference" if step.arc == 0.0 else f"At {step.arc:+.6g} m"
        if step.dead is not None:
            is_last = step is trace.steps[0] or step is trace.steps[-1]
            on = "; the path goes straight on" if step.dead.is_branch and not is_last else ""
            told.append(f"{place}: {dead_in_words(step, step.dead)}{on}.")
    if len(dead) > _MOST:
        told.append(f"{len(dead) - _MOST} more dead points are in the file that -o writes.")
    told += _verdicts(trace)
    # The next power of ten; what is rounding on any machine is one.
    bound = 10.0 ** math.ceil(math.log10(max(trace.residual, _ROUNDING)))
    told.append(
        f"Held deformations stay below {bound:.0e} of the model's size (angles in rad) all along."
    )
    return told


def stop_in_words(trace: Traced, stop: Stop) -> str:
    """Why a path was not followed farther."""
    ending = stop.ending
    if ending is Ending.BRANCHES:
        return f"there {_branches(stop.directions)}, and none was chosen"
    if ending is Ending.NOT_ZERO:
        return (
            f"there it ends: {stop.step * trace.size:.2g} m on, held deformations of "
            f"{stop.residual:.2g} of the model's size are left"
        )
    if ending is Ending.ELEMENT:
        element = int(trace.result.data.arrays.element_number[stop.element])
        name = plain((named_element(trace.result, element),))
        return f"there {name} leaves its range: {_RANGES[stop.range]}"
    return {
        Ending.LENGTH: "as far as was asked",
        Ending.CLOSED: "there it is back at the reference: the path is closed",
        Ending.TURNS_BACK: "there it ends in a cusp: no direction leads on but the one back",
    }.get(ending, "more steps than are allowed would be needed")


def _branches(directions: int) -> str:
    return (
        f"other paths branch off: the mechanism can move in {in_words(directions)} independent "
        "directions"
    )


def dead_in_words(step: Step, dead: DeadPoint) -> str:
    """What is special at a step."""
    told = []
    if dead.is_drive:
        told.append("the declared degree of freedom turns back, as it can be driven no farther")
    if dead.turning:
        names = listed(
            [
                f"the rotation of {with_article(name.removeprefix(ROTATION))}"
                if name.startswith(ROTATION)
                else with_article(name)
                for name in dead.turning
            ]
        )
        told.append(f"{names} {'turns' if len(dead.turning) == 1 else 'turn'} back")
    if dead.is_branch:
        told.append(_branches(dead.directions))
    counts = counts_in_words(step.under_constrained, step.over_constrained)
    return f"{'; '.join(told)} ({counts})"


def _verdicts(trace: Traced) -> list[str]:
    plain_steps = [step for step in trace.steps if step.dead is None]
    runs = [
        list(run)
        for _, run in groupby(
            plain_steps, lambda step: (step.under_constrained, step.over_constrained)
        )
    ]
    special = "" if len(plain_steps) == len(trace.steps) else ", but for the places above"
    if len(runs) == 1:
        counts = counts_in_words(runs[0][0].under_constrained, runs[0][0].over_constrained)
        return [f"All along{special}: {counts}."]
    told = [
        f"From {run[0].arc:+.4g} to {run[-1].arc:+.4g} m: "
        f"{counts_in_words(run[0].under_constrained, run[0].over_constrained)}."
        for run in runs[:_MOST]
    ]
    if len(runs) > _MOST:
        told.append(f"The counts change {counted(len(runs) - _MOST, 'more time', '', 's')}.")
    return told


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]


#: Of so many points, and so many bodies, the places stand in a table at most.
_MOST_PLACES = 400

Cell = str | int | float


def csv_bytes(trace: Traced) -> bytes:
    """The table as CSV; numbers read back to the last bit."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header(trace))
    writer.writerows(rows(trace))
    return as_bytes(text.getvalue())


def header(trace: Traced) -> list[str]:
    """The names of the columns, with units."""
    kept = max(step.values.size for step in trace.steps)
    points, bodies = (each(trace.result, _MOST_PLACES) for each in (points_of, bodies_of))
    axes = "xy" if trace.result.given.planar else "xyz"
    turns = ("rz",) if trace.result.given.planar else ("rx", "ry", "rz")
    drive = trace.shown.freedom
    return [
        *("step", "arc [m]", "residual [size]"),
        *(f"sigma {k + 1}" for k in range(kept)),
        *("under_constrained", "over_constrained", "verdict", "dead_point"),
        *([] if drive is None else [f"{drive.label} [{drive_unit(drive)}]"]),
        *(f"{name} {axis} [m]" for name in points.values() for axis in axes),
        *(f"{name} {turn} [rad]" for name in bodies.values() for turn in turns),
    ]


def rows(trace: Traced) -> Iterator[list[Cell]]:
    """A row a step; the reference is step 0."""
    planar = trace.result.given.planar
    points, bodies = (list(each(trace.result, _MOST_PLACES)) for each in (points_of, bodies_of))
    kept = max(step.values.size for step in trace.steps)
    first = trace.reference
    for number, step in enumerate(trace.steps):
        values = [*step.values.tolist(), *[math.nan] * (kept - step.values.size)]
        places = step.pose.position[points, : 2 if planar else 3].ravel().tolist()
        turned = vector_of(step.pose.rotation[bodies])[:, 2 if planar else 0 :].ravel().tolist()
        yield [
            *(number - first, step.arc, step.residual),
            *("" if math.isnan(value) else value for value in values),
            *(step.under_constrained, step.over_constrained, step.verdict.value),
            "" if step.dead is None else dead_in_words(step, step.dead),
            *([] if trace.shown.freedom is None else [step.drive]),
            *places,
            *turned,
        ]
