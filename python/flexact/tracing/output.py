# SPDX-License-Identifier: BSD-3-Clause
"""A traced path in plain English, and as files: a table, a picture, and meshes that play."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

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
from ..analysis.verdict import Verdict
from ..core.arrays import FloatArray
from ..motion import Ending, Stop
from ..show.mesh.collection import STEM, Collection, folder_of
from ..show.mesh.content import Meshes
from ..show.mesh.file import find_format
from ..show.picture.files import load_matplotlib, still_bytes
from ..show.picture.make import check_packages
from ..show.writers import PLAYING, STILLS, Writers, as_bytes
from ..util.outputs import OutputError
from ..util.rotations import vector_of
from ..util.text import file_name, harmless
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
    shown, dead, units = trace.shown, trace.dead_points, trace.result.given.units
    what = motion_in_words(trace.result, shown.number, shown.freedom)
    told = [f"{_capital(what)}, followed both ways with every held deformation zero."]
    for side, way in (("Along it", trace.along), ("Against it", trace.against)):
        told.append(f"{side}: {units.said(way.length, 'm')}; {stop_in_words(trace, way.stop)}.")
    if shown.freedom is not None:
        unit = drive_unit(shown.freedom)
        values = [units.shown(step.drive, unit) for step in trace.steps]
        told.append(
            f"{_capital(plain(freedom_in_words(shown.freedom)))} goes from {min(values):+.6g} to "
            f"{max(values):+.6g} {units.symbol(unit)}; its declaration was let loose."
        )
    for step in dead[:_MOST]:
        place = f"At {units.shown(step.arc, 'm'):+.6g} {units.symbol('m')}"
        place = "At the reference" if step.arc == 0.0 else place
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
            f"there it ends: {trace.result.given.units.said(stop.step * trace.size, 'm', 2)} on, "
            f"held deformations of {stop.residual:.2g} of the model's size are left"
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
    units = trace.result.given.units
    told = [
        f"From {units.shown(run[0].arc, 'm'):+.4g} to {units.shown(run[-1].arc, 'm'):+.4g} "
        f"{units.symbol('m')}: "
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
    writer.writerows(rows(trace))
    return as_bytes(text.getvalue())


def rows(trace: Traced) -> Iterator[list[Cell]]:
    """The names of the columns, with units, then a row a step; the reference is step 0."""
    planar, drive, units = trace.result.given.planar, trace.shown.freedom, trace.result.given.units
    unit = units.symbol("m")
    points, bodies = (each(trace.result, _MOST_PLACES) for each in (points_of, bodies_of))
    kept = max(step.values.size for step in trace.steps)
    axes, turns = ("xy", ("rz",)) if planar else ("xyz", ("rx", "ry", "rz"))
    yield [
        *("step", f"arc [{unit}]", "residual [size]"),
        *(f"sigma {k + 1}" for k in range(kept)),
        *("under_constrained", "over_constrained", "verdict", "dead_point"),
        *([] if drive is None else [f"{drive.label} [{units.symbol(drive_unit(drive))}]"]),
        *(f"{name} {axis} [{unit}]" for name in points.values() for axis in axes),
        *(f"{name} {turn} [rad]" for name in bodies.values() for turn in turns),
    ]
    first = trace.reference
    for number, step in enumerate(trace.steps):
        values = [*step.values.tolist(), *[math.nan] * (kept - step.values.size)]
        places = step.pose.position[list(points), : len(axes)].ravel()
        turned = vector_of(step.pose.rotation[list(bodies)])[:, -len(turns) :].ravel().tolist()
        yield [
            *(number - first, units.shown(step.arc, "m"), step.residual),
            *("" if math.isnan(value) else value for value in values),
            *(step.under_constrained, step.over_constrained, step.verdict.value),
            "" if step.dead is None else dead_in_words(step, step.dead),
            *([] if drive is None else [units.shown(step.drive, drive_unit(drive))]),
            *units.shown(places, "m").tolist(),
            *turned,
        ]


#: Below this singular values are drawn at the lower edge.
_FLOOR = 1.0e-9
#: How many singular values, and how many curves of what moves, are drawn.
_MOST_VALUES, _MOST_CURVES = 3, 6
#: Curves that differ by less than this part of the largest are the same.
_SAME = 1.0e-3
_DEAD = "#111827"
_CURVES = ("#1f5fa8", "#b25406", "#15774a", "#93205e", "#8a6a00", "#4b5563")
_SIZE, _PANEL, _DPI = (8.0, 1.4), 2.6, 120


def plot_bytes(trace: Traced, suffix: str = ".png") -> bytes:
    """The picture as a file: .png, .svg or .pdf.

    Raises:
        FlexactError: matplotlib is missing.
    """
    check_packages()
    load_matplotlib()
    from matplotlib.figure import Figure

    units = trace.result.given.units
    arc = units.shown(trace.arc, "m")
    panels = 2 if trace.shown.freedom is None else 3
    figure: Any = Figure(
        figsize=(_SIZE[0], _SIZE[1] + _PANEL * panels),
        dpi=_DPI,
        layout="constrained",
        facecolor="white",
    )
    axes = figure.subplots(panels, 1, sharex=True)
    what = motion_in_words(trace.result, trace.shown.number, trace.shown.freedom)
    axes[0].set_title(harmless(what), parse_math=False, fontsize=11, loc="left", pad=18)
    _draw_values(axes[0], trace, arc)
    _draw_places(axes[1], trace, arc)
    if (freedom := trace.shown.freedom) is not None:
        unit = drive_unit(freedom)
        driven = [units.shown(step.drive, unit) for step in trace.steps]
        axes[2].plot(arc, driven, color=_CURVES[0], lw=1.4)
        drive = harmless(f"{freedom.label} [{units.symbol(unit)}]")
        axes[2].set_ylabel(drive, parse_math=False, fontsize=11)
    for panel in axes:
        for step in trace.dead_points:
            panel.axvline(units.shown(step.arc, "m"), color=_DEAD, lw=1.0, ls=(0, (4, 3)), zorder=3)
        panel.grid(True, which="major", color="#e5e7eb", lw=0.7, zorder=0)
        panel.set_axisbelow(True)
    for number, step in enumerate(trace.dead_points, start=1):
        axes[0].annotate(
            str(number),
            (units.shown(step.arc, "m"), 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0, 3),
            textcoords="offset points",
            ha="center",
            fontsize=9,
        )
    axes[-1].set_xlabel(f"along the path [{units.symbol('m')}]", fontsize=11)
    _legend(figure, trace)
    return still_bytes(figure, suffix, file_name(trace.result.given.name) or "path", harmless(what))


def _draw_values(axes: Any, trace: Traced, arc: FloatArray) -> None:
    count = min(_MOST_VALUES, *(step.values.size for step in trace.steps))
    colours = [step.verdict.colour for step in trace.steps]
    axes.set_yscale("log")
    for k in range(count):
        values = np.maximum([step.values[k] for step in trace.steps], _FLOOR)
        axes.plot(arc, values, color="#9ca3af", lw=1.0, zorder=2)
        axes.scatter(arc, values, c=colours, s=10, zorder=4, clip_on=False)
    axes.set_ylim(bottom=_FLOOR)
    axes.set_ylabel("smallest singular values", fontsize=11)


def _draw_places(axes: Any, trace: Traced, arc: FloatArray) -> None:
    """Coordinates that change most; of those that are the same the first."""
    units = trace.result.given.units
    points = points_of(trace.result, len(trace.result.given.node_names))
    start = trace.steps[trace.reference].pose.position
    moved: list[tuple[float, str, FloatArray]] = []
    for node, point in points.items():
        way = np.array([step.pose.position[node] for step in trace.steps])
        for k, axis in enumerate("xy" if trace.result.given.planar else "xyz"):
            curve = units.shown(way[:, k] - start[node, k], "m")
            moved.append((float(np.ptp(curve)), f"{point} {axis}", curve))
    largest = max((each[0] for each in moved), default=0.0)
    moved.sort(key=lambda each: -round(each[0] / (largest or 1.0), 9))
    curves: list[tuple[str, FloatArray]] = []
    for size, name, curve in moved:
        is_new = all(np.abs(curve - other).max() > _SAME * largest for _, other in curves)
        if size > _SAME * largest and is_new and len(curves) < _MOST_CURVES:
            curves.append((name, curve))
    for colour, (name, curve) in zip(_CURVES, curves, strict=False):
        axes.plot(arc, curve, color=colour, lw=1.4, label=harmless(name).replace("$", r"\$"))
    axes.set_ylabel(f"displacement [{units.symbol('m')}]", fontsize=11)
    if curves:
        axes.legend(fontsize=9, frameon=False, ncols=3, loc="best")


def _legend(figure: Any, trace: Traced) -> None:
    from matplotlib.lines import Line2D

    there = {step.verdict for step in trace.steps}
    handles: list[Any] = [
        Line2D([], [], marker="o", ms=5, ls="none", color=verdict.colour, label=verdict.value)
        for verdict in Verdict
        if verdict in there
    ]
    if trace.dead_points:
        handles.append(Line2D([], [], color=_DEAD, lw=1.0, ls=(0, (4, 3)), label="dead point"))
    figure.legend(handles=handles, loc="outside lower center", ncols=3, frameon=False, fontsize=9.5)


#: Names of the meshes: `STEM` of `show.mesh.collection`, and a number each. Of more steps than so
#: many some are left out, never the dead points.
MOST = 400
ENDINGS = tuple(f"{k:03d}.vtu" for k in range(MOST))


def played(trace: Traced, target: Path) -> Collection:
    """The files that play: a mesh a step, to the end along the motion, back, and to the other end.

    Time is the way that has been gone along the path [m]; it begins and ends at rest. The meshes
    lie in a folder beside the .pvd file `target`.
    """
    many = len(trace.steps)
    steps = list(range(many))
    if many > MOST:
        every = np.linspace(0, many - 1, MOST // 2).round().astype(int).tolist()
        dead = [k for k, step in enumerate(trace.steps) if step.dead is not None][: MOST // 2]
        steps = sorted({*every, *dead, trace.reference})
    meshes = Meshes(trace.result, len(steps))
    files = [folder_of(target) / f"{STEM}{ending}" for ending in ENDINGS[: len(steps)]]
    poses = {file: trace.steps[k].pose for file, k in zip(files, steps, strict=True)}
    start = steps.index(trace.reference)
    order = [*range(start, len(steps)), *range(len(steps) - 2, -1, -1), *range(1, start + 1)]
    times = np.concatenate(([0.0], np.cumsum(np.abs(np.diff(trace.arc[steps][order])))))
    shown = {time: files[k] for time, k in zip(times.tolist(), order, strict=True)}
    return Collection(target, shown, lambda path: meshes.moved(poses[path]))


#: Of paths.
TRACES = Writers(
    lambda path, _: OutputError(f"the suffix of {path} is to be .pvd, .csv, .png, .svg or .pdf")
)
TRACES.register((PLAYING,), require=lambda _: find_format("vtu"))(played)


@TRACES.register((".csv",))
def _table(trace: Traced, path: Path) -> bytes:
    return csv_bytes(trace)


@TRACES.register(STILLS, require=check_packages)
def _picture(trace: Traced, path: Path) -> bytes:
    return plot_bytes(trace, path.suffix.lower())
