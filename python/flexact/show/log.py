# SPDX-License-Identifier: BSD-3-Clause
"""The log of an analysis: its words, and what they leave out."""

from __future__ import annotations

import platform
from collections.abc import Iterator

import numpy as np

from ..advice.describe import describe
from ..analysis.result import Result
from ..core.arrays import FloatArray
from ..util.version import VERSION

#: How many motions, and how many self-stresses, are reported one by one.
MOST_MODES = 1000


def log_text(analysis: Result, *, most_in_mesh: int | None = None) -> str:
    """The words, every singular value, what the rows and columns of D(c) are, and versions.

    Args:
        analysis: The result.
        most_in_mesh: How many motions, and how many self-stresses, a mesh beside the log
            holds at most.
    """
    words = describe(analysis, most=MOST_MODES)
    return "\n".join((words, *_left_out(analysis, most_in_mesh), "", *_sections(analysis))) + "\n"


def _left_out(analysis: Result, most_in_mesh: int | None) -> Iterator[str]:
    if most_in_mesh is None:
        return
    for count, modes, what in (
        (analysis.under_constrained, analysis.motions, "motions"),
        (analysis.over_constrained, analysis.self_stresses, "self-stresses"),
    ):
        held = min(len(modes), most_in_mesh)
        if held < count:
            yield f"The mesh holds the first {held} of {count} {what}."


def _last(values: FloatArray, count: int) -> list[str]:
    """The last of `count` singular values, behind dashes for those that are not given."""
    return ["-"] * (count - values.size) + [f"{value:.16e}" for value in values.tolist()]


def _sections(analysis: Result) -> Iterator[str]:
    smallest = analysis.singular_values_given == "smallest"
    which = "The smallest singular values" if smallest else "Singular values"
    yield f"{which} of D(c), and of the scaled matrix on which its rank is decided"
    values, scaled_values = analysis.singular_values, analysis.scaled_singular_values
    count = max(values.size, scaled_values.size)
    first = min(analysis.rows, analysis.columns) - count + 1
    pairs = zip(_last(values, count), _last(scaled_values, count), strict=True)
    for number, (value, scaled) in enumerate(pairs, start=first):
        zero = "  counts as zero" if number > analysis.rank else ""
        yield f"  {number:5d}  {value:>23}  {scaled:>23}{zero}"
    yield f"  tolerance on the scaled values: {analysis.tolerance:.16e}"
    if analysis.method == "sparse":
        yield f"  the factorisation shows the count of those below {analysis.raw.bound:.16e}"
    yield from ("", "Rows of D(c)")
    for number, (element, deformation) in enumerate(analysis.row_labels, start=1):
        yield f"  {number:5d}  element {element}, deformation {deformation}"
    yield from ("", "Columns of D(c)")
    for number, (node, coordinate) in enumerate(analysis.column_labels, start=1):
        yield f"  {number:5d}  node {node}, coordinate {coordinate}"
    yield from ("", "Versions")
    yield f"  flexact {VERSION}, numpy {np.__version__}, Python {platform.python_version()}"
