# SPDX-License-Identifier: BSD-3-Clause
"""The picture of the trade: time, memory, certainty and error by method, family and size."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("svg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import NullFormatter
from trade import NAMES, PEERS, Outcome, best_peer

#: Colours and lines that stand out on white and on black.
_STYLE: dict[str, dict[str, Any]] = {
    "auto": {"color": "#e0662f", "linewidth": 2.6, "marker": "o", "zorder": 5},
    "sparse": {"color": "#3a8fd9", "linewidth": 1.6, "marker": "s"},
    "svd": {"color": "#2aa876", "linewidth": 1.6, "marker": "^"},
    "jacobi": {"color": "#a06fd0", "linewidth": 1.6, "marker": "D"},
    "dgesdd": {"color": "#808080", "linewidth": 1.4, "linestyle": "--", "marker": "^"},
    "best bare SuiteSparse": {
        "color": "#808080",
        "linewidth": 1.4,
        "linestyle": ":",
        "marker": "s",
    },
}
_TEXT = "#808080"
#: Errors of no size at all are drawn here.
_LEAST = 1e-17


def draw(
    found: list[Outcome],
    errors: list[dict[str, Any]],
    beams: dict[int | str, tuple[float, float, float]],
    path: Path,
) -> None:
    """Times and memories by family, and errors, on a transparent ground.

    A point is filled where the rank is proven or numerically certain.
    """
    matplotlib.rcParams.update(
        {
            "font.family": "sans-serif",
            "font.size": 9,
            "svg.hashsalt": "flexact",
            "lines.markersize": 3.5,
            "axes.facecolor": "none",
            "text.color": _TEXT,
            "axes.edgecolor": _TEXT,
            "axes.labelcolor": _TEXT,
            "xtick.color": _TEXT,
            "ytick.color": _TEXT,
        }
    )
    figure, panels = plt.subplots(4, 3, figsize=(10, 12))
    for first, last, of in ((0, 5, "seconds"), (6, 11, "memory")):
        limits = [_decades([x for x in of_all if x > 0]) for of_all in _numbers(found, of)]
        for axes, family in zip(list(panels.flat)[first:last], _FAMILIES, strict=True):
            _by_size(axes, [one for one in found if one.family == family], family, of)
            axes.set(xlim=limits[0], ylim=limits[1])
    for row, words in enumerate(("time [s]", "time [s]", "memory [MB]", "memory [MB]")):
        panels[row, 0].set_ylabel(words)
    _errors(panels.flat[5], [one for one in errors if one["kind"] == "small"])
    _beams(panels.flat[11], beams)
    shown = [axes.get_legend_handles_labels() for axes in panels.flat]
    entries = {
        name: line for lines, names in shown for line, name in zip(lines, names, strict=True)
    }
    names = [name for name in _STYLE if name in entries]
    lines = [entries[name] for name in names]
    figure.legend(lines, names, loc="lower center", ncols=len(names), frameon=False)
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    figure.savefig(path, metadata={"Date": None}, transparent=True)


_FAMILIES = ("T", "O", "B", "C", "Tb")
#: By what a memory is divided to be shown.
_SHOWN = {"seconds": 1.0, "memory": 1.0e6}


def _numbers(found: list[Outcome], of: str) -> tuple[list[float], list[float]]:
    return [one.columns for one in found], [getattr(one, of) / _SHOWN[of] for one in found]


def _by_size(axes: Axes, those: list[Outcome], family: str, of: str) -> None:
    for name, style in _STYLE.items():
        points = [one for one in those if one.contestant == name]
        if name == "best bare SuiteSparse":
            sizes = sorted({one.size for one in those if one.contestant in PEERS})
            peers = (best_peer(those, family, size) for size in sizes)
            points = [one for one in peers if one is not None]
        # What is too little to be measured is no point.
        points = [one for one in points if getattr(one, of) > 0]
        _line(axes, list(zip(*_numbers(points, of), strict=True)), name, style)
        doubtful = [one for one in points if one.certainty == "doubtful"]
        if doubtful:
            hollow = {**style, "markerfacecolor": "white", "linestyle": "none", "zorder": 6}
            axes.plot(*_numbers(doubtful, of), **hollow)
    _log(axes, NAMES[family])


def _beams(axes: Axes, beams: dict[int | str, tuple[float, float, float]]) -> None:
    """Error against time by beams a sheet."""
    taken, tolerance, frequency = zip(*beams.values(), strict=True)
    for values, name, mark in ((tolerance, "tolerances", "o"), (frequency, "frequencies", "s")):
        order = np.argsort(taken)
        axes.plot(
            np.array(taken)[order], np.array(values)[order], marker=mark, color=_TEXT, linewidth=1
        )
        _note(axes, name, (taken[0], values[0]), (6, 2))
    for many, each in beams.items():
        _note(axes, str(many), each[:2], (2, -10))
    _log(axes, "cost by beams a sheet")
    axes.set(xlabel="time [s]", ylabel="off by, at most")


def _note(axes: Axes, text: str, at: tuple[float, float], off: tuple[int, int]) -> None:
    axes.annotate(text, at, color=_TEXT, xytext=off, textcoords="offset points")


def _errors(axes: Axes, errors: list[dict[str, Any]]) -> None:
    for name, style in _STYLE.items():
        points = [
            (one["columns"], max(one["errors"][name], _LEAST))
            for one in errors
            if name in one["errors"]
        ]
        _line(axes, points, name, style)
    _log(axes, "smallest value, stages 1 nm apart")
    axes.set(ylabel="relative error", xlim=_decades([one["columns"] for one in errors]))


def _decades(values: list[Any]) -> tuple[float, float]:
    """Powers of ten around all of them."""
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    return 10.0**low, 10.0 ** max(high, low + 1)


def _line(axes: Axes, points: list[tuple[int, float]], name: str, style: dict[str, Any]) -> None:
    if points:
        axes.plot(*zip(*points, strict=True), label=name, **style)


def _log(axes: Axes, title: str) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_formatter(NullFormatter())
    axes.set_title(title, fontsize=10)
    axes.set_xlabel("columns of D(c)")
    axes.grid(color=_TEXT, alpha=0.25, linewidth=0.6)
    axes.spines[["top", "right"]].set_visible(False)
