# SPDX-License-Identifier: BSD-3-Clause
"""The variants of a table as a picture: which one, and what all have in common."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..analysis.verdict import Verdict
from ..core.arrays import FloatArray
from ..show.picture.files import STILLS, png_bytes, still_bytes
from ..show.picture.loading import load_matplotlib
from ..show.picture.make import PictureError, check_packages
from ..util.errors import FlexactError
from ..util.outputs import write_together
from ..util.plain_text import harmless
from .crossing import Crossings
from .described import described, in_short
from .lines import varying

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .table import Table

#: Of errors, of doubt, and of singular places.
ERROR_COLOUR, DOUBT_COLOUR, SINGULAR_COLOUR = "#6b7280", "#8a6a00", "#111827"
#: Rows of which each has a large mark.
FEW_ROWS = 150
#: Rows between which singular places are sought unasked.
MOST_SEARCHED = 20_000
#: Width and height of a picture [inch], and of each further panel.
_SIZE, _PANEL, _DPI = (8.0, 6.2), 2.6, 120


def chosen(table: Table, x: str | None, y: str | None) -> tuple[str | None, str | None]:
    """What is drawn along and up the picture; None: the number of the row, and by default.

    Raises:
        KeyError: there is no such column.
        ValueError: it holds no numbers.
    """
    names = varying(table)
    for name in (x, y):
        if name is not None and table[name].dtype.kind not in "if":
            raise ValueError(f"{name!r} cannot be drawn: it holds no numbers")
    if x is None:
        left = [name for name in names if name != y]
        x = next(iter(left), None)
        if y is None and len(left) > 1:
            y = left[1]
    return x, y


def figure_of(panels: int = 1) -> Any:
    """An empty figure that shows itself in a notebook.

    Raises:
        FlexactError: matplotlib is missing.
    """
    check_packages()
    load_matplotlib()
    from matplotlib.figure import Figure

    class Shown(Figure):
        def _repr_png_(self) -> bytes:
            return png_bytes(self)

    height = _SIZE[1] if panels == 1 else 1.0 + _PANEL * panels
    return Shown(figsize=(_SIZE[0], height), dpi=_DPI, layout="constrained", facecolor="white")


def smallest_values(table: Table) -> FloatArray:
    """(variants,) the smallest singular value of the scaled D(c), as far as it is known."""
    zero: FloatArray = table["largest_zero"]
    return np.where(np.isnan(zero), table["gap"], zero)


def add_legend(axes: Any, table: Table, *, has_singular: bool, marks: bool) -> None:
    """The colours of the verdicts, in words with counts, and what else there is."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles: list[Any] = []
    mark: Any
    for verdict in Verdict:
        if count := int((table.verdict == verdict.value).sum()):
            told = f"{verdict.value}: {count}"
            handles.append(_of_verdict(verdict, told, marks))
    if has_singular:
        handles.append(Line2D([], [], color=SINGULAR_COLOUR, lw=1.8, label="singular"))
    if count := int(table.is_doubtful.sum()):
        mark = {"marker": "o", "mfc": "none", "mec": DOUBT_COLOUR, "ls": "none", "mew": 1.5}
        handles.append(Line2D([], [], label=f"rank doubtful: {count}", ms=9, **mark))
    if count := int(table.has_error.sum()):
        mark = {"marker": "x", "color": ERROR_COLOUR, "ls": "none", "mew": 1.6}
        handles.append(Line2D([], [], label=f"error: {count}", **mark))
    if not handles:
        handles.append(Patch(facecolor="none", label="no variants"))
    figure: Any = axes.get_figure()
    figure.legend(handles=handles, loc="outside lower center", ncols=2, frameon=False, fontsize=9.5)


def _of_verdict(verdict: Verdict, told: str, marks: bool) -> Any:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    if marks:
        return Line2D([], [], marker="o", ms=6, ls="none", color=verdict.colour, label=told)
    return Patch(facecolor=verdict.colour, label=told)


def verdict_colours(table: Table) -> np.ndarray:
    """(variants, 3) the colour of each row, from 0 to 1."""
    from matplotlib.colors import to_rgb

    made = np.tile(to_rgb(ERROR_COLOUR), (len(table), 1))
    for verdict in Verdict:
        made[table.verdict == verdict.value] = to_rgb(verdict.colour)
    return made


def mark_rows(axes: Any, table: Table, x: np.ndarray, y: np.ndarray) -> None:
    """Rings round what is doubtful, and crosses at errors."""
    doubtful, wrong = table.is_doubtful, table.has_error
    size = 70 if len(table) <= FEW_ROWS else 24
    if doubtful.any():
        rings = {"marker": "o", "facecolors": "none", "edgecolors": DOUBT_COLOUR, "s": size}
        axes.scatter(x[doubtful], y[doubtful], linewidths=1.5, zorder=6, clip_on=False, **rings)
    if wrong.any():
        cross = {"marker": "x", "color": ERROR_COLOUR, "s": 28, "linewidths": 1.6}
        axes.scatter(x[wrong], y[wrong], zorder=6, clip_on=False, **cross)


def found_crossings(table: Table, given: bool | Crossings) -> Crossings:
    """The singular places to be drawn; none where rows have no neighbours."""
    if isinstance(given, Crossings):
        return given
    if given and len(table) <= MOST_SEARCHED and varying(table):
        try:
            return table.crossings()
        except (ValueError, FlexactError):
            pass
    return Crossings((), 0)


def label(axes: Any, x: str, y: str) -> None:
    """Names of the axes; what they hold is never taken for a formula."""
    for put, words in ((axes.set_xlabel, x), (axes.set_ylabel, y)):
        put(harmless(words), parse_math=False, fontsize=11)


def finished(figure: Figure, table: Table, path: Path | None) -> Figure:
    """The figure, which is also written to a file if one is named.

    Raises:
        FlexactError: it cannot be written.
    """
    if path is not None:
        suffix = path.suffix.lower()
        if suffix not in STILLS:
            raise PictureError(f"{path} is no such picture: its suffix must be .png, .svg or .pdf")
        words = in_short(table), described(table)
        write_together({path: still_bytes(figure, suffix, *words)})
    return figure
