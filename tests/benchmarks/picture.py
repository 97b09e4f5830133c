# SPDX-License-Identifier: BSD-3-Clause
"""The picture of the trade: time against size by family, and error against size, by method."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("svg")

import matplotlib.pyplot as plt
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


def draw(found: list[Outcome], errors: list[dict[str, Any]], path: Path) -> None:
    """Five panels of times and one of errors, on a transparent ground."""
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
    figure, panels = plt.subplots(2, 3, figsize=(10, 6.2))
    times = list(panels.flat)[:5]
    limits = _decades([one.columns for one in found]), _decades([one.seconds for one in found])
    for axes, family in zip(times, ("T", "O", "B", "C", "Tb"), strict=True):
        _times(axes, [one for one in found if one.family == family], family)
        axes.set(xlim=limits[0], ylim=limits[1])
    for axes in panels[:, 0]:
        axes.set_ylabel("time [s]")
    _errors(panels.flat[5], [one for one in errors if one["kind"] == "small"])
    shown = [axes.get_legend_handles_labels() for axes in panels.flat]
    entries = {
        name: line for lines, names in shown for line, name in zip(lines, names, strict=True)
    }
    names = [name for name in _STYLE if name in entries]
    lines = [entries[name] for name in names]
    figure.legend(lines, names, loc="lower center", ncols=len(names), frameon=False)
    figure.tight_layout(rect=(0, 0.05, 1, 1))
    figure.savefig(path, metadata={"Date": None}, transparent=True)


def _times(axes: Axes, those: list[Outcome], family: str) -> None:
    for name, style in _STYLE.items():
        points = [(one.columns, one.seconds) for one in those if one.contestant == name]
        if name == "best bare SuiteSparse":
            sizes = sorted({one.size for one in those if one.contestant in PEERS})
            peers = (best_peer(those, family, size) for size in sizes)
            points = [(one.columns, one.seconds) for one in peers if one is not None]
        _line(axes, points, name, style)
    _log(axes, NAMES[family])


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
