# SPDX-License-Identifier: BSD-3-Clause
"""A traced path as files: a table, a picture along the path, and meshes that play."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ..analysis.naming import motion_in_words
from ..analysis.verdict import Verdict
from ..core.arrays import FloatArray
from ..show.mesh.collection import STEM, Collection, folder_of
from ..show.mesh.content import Meshes
from ..show.mesh.file import find_format
from ..show.picture.files import load_matplotlib, still_bytes
from ..show.picture.make import check_packages
from ..show.writers import PLAYING, STILLS, Writers
from ..util.outputs import OutputError
from ..util.text import file_name, harmless
from .values import Traced, drive_unit, points_of
from .words import csv_bytes

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
    _draw_values(axes[0], trace)
    _draw_places(axes[1], trace)
    if (freedom := trace.shown.freedom) is not None:
        axes[2].plot(trace.arc, [step.drive for step in trace.steps], color=_CURVES[0], lw=1.4)
        drive = harmless(f"{freedom.label} [{drive_unit(freedom)}]")
        axes[2].set_ylabel(drive, parse_math=False, fontsize=11)
    for panel in axes:
        for step in trace.dead_points:
            panel.axvline(step.arc, color=_DEAD, lw=1.0, ls=(0, (4, 3)), zorder=3)
        panel.grid(True, which="major", color="#e5e7eb", lw=0.7, zorder=0)
        panel.set_axisbelow(True)
    for number, step in enumerate(trace.dead_points, start=1):
        axes[0].annotate(
            str(number),
            (step.arc, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0, 3),
            textcoords="offset points",
            ha="center",
            fontsize=9,
        )
    axes[-1].set_xlabel("along the path [m]", fontsize=11)
    _legend(figure, trace)
    name = file_name(trace.result.given.name) or "path"
    return still_bytes(figure, suffix, name, harmless(what))


def _draw_values(axes: Any, trace: Traced) -> None:
    count = min(_MOST_VALUES, *(step.values.size for step in trace.steps))
    colours = [step.verdict.colour for step in trace.steps]
    axes.set_yscale("log")
    for k in range(count):
        values = np.maximum([step.values[k] for step in trace.steps], _FLOOR)
        axes.plot(trace.arc, values, color="#9ca3af", lw=1.0, zorder=2)
        axes.scatter(trace.arc, values, c=colours, s=10, zorder=4, clip_on=False)
    axes.set_ylim(bottom=_FLOOR)
    axes.set_ylabel("smallest singular values", fontsize=11)


def _draw_places(axes: Any, trace: Traced) -> None:
    """Coordinates that change most; of those that are the same the first."""
    points = points_of(trace.result, len(trace.result.given.node_names))
    start = trace.steps[trace.reference].pose.position
    moved: list[tuple[float, str, FloatArray]] = []
    for node, point in points.items():
        way = np.array([step.pose.position[node] for step in trace.steps])
        for k, axis in enumerate("xy" if trace.result.given.planar else "xyz"):
            curve = way[:, k] - start[node, k]
            moved.append((float(np.ptp(curve)), f"{point} {axis}", curve))
    largest = max((each[0] for each in moved), default=0.0)
    moved.sort(key=lambda each: -round(each[0] / (largest or 1.0), 9))
    curves: list[tuple[str, FloatArray]] = []
    for size, name, curve in moved:
        is_new = all(np.abs(curve - other).max() > _SAME * largest for _, other in curves)
        if size > _SAME * largest and is_new and len(curves) < _MOST_CURVES:
            curves.append((name, curve))
    for colour, (name, curve) in zip(_CURVES, curves, strict=False):
        told = harmless(name).replace("$", r"\$")
        axes.plot(trace.arc, curve, color=colour, lw=1.4, label=told)
    axes.set_ylabel("displacement [m]", fontsize=11)
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
    arc = trace.arc[steps][order]
    times = np.concatenate(([0.0], np.cumsum(np.abs(np.diff(arc)))))
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
