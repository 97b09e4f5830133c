# SPDX-License-Identifier: BSD-3-Clause
"""A traced path as a table: a row a step."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator

from ..show.drawing.rotations import vector_of
from .drive import drive_unit
from .names import Names
from .values import Traced
from .words import dead_in_words

#: Of so many points, and so many bodies, the places stand in a table at most.
_MOST = 400

Cell = str | int | float


def csv_bytes(trace: Traced) -> bytes:
    """The table as CSV; numbers read back to the last bit."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header(trace))
    writer.writerows(rows(trace))
    return text.getvalue().encode("utf-8", "backslashreplace")


def header(trace: Traced) -> list[str]:
    """The names of the columns, with units."""
    kept = max(step.values.size for step in trace.steps)
    names = Names(trace.result)
    axes = "xy" if trace.result.given.planar else "xyz"
    turns = ("rz",) if trace.result.given.planar else ("rx", "ry", "rz")
    drive = trace.shown.freedom
    return [
        *("step", "arc [m]", "residual [size]"),
        *(f"sigma {k + 1}" for k in range(kept)),
        *("under_constrained", "over_constrained", "verdict", "dead_point"),
        *([] if drive is None else [f"{drive.label} [{drive_unit(drive)}]"]),
        *(f"{point.name} {axis} [m]" for point in names.points(_MOST) for axis in axes),
        *(f"{body.name} {turn} [rad]" for body in names.bodies(_MOST) for turn in turns),
    ]


def rows(trace: Traced) -> Iterator[list[Cell]]:
    """A row a step; the reference is step 0."""
    names, planar = Names(trace.result), trace.result.given.planar
    points = [point.node for point in names.points(_MOST)]
    bodies = [body.node for body in names.bodies(_MOST)]
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
