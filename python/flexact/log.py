"""The log of an analysis: its words, and what they leave out."""

from __future__ import annotations

import platform
from collections.abc import Iterator

import numpy as np

from . import __version__
from .analysis import Analysis
from .words import describe


def log_text(analysis: Analysis) -> str:
    """The words, every singular value, what the rows and columns of D(c) are, and versions."""
    return "\n".join((describe(analysis), "", *_sections(analysis))) + "\n"


def _sections(analysis: Analysis) -> Iterator[str]:
    yield "Singular values of D(c), and of the scaled matrix on which its rank is decided"
    pairs = zip(analysis.singular_values, analysis.scaled_singular_values, strict=True)
    for number, (value, scaled) in enumerate(pairs, start=1):
        zero = "  counts as zero" if number > analysis.rank else ""
        yield f"  {number:5d}  {value:23.16e}  {scaled:23.16e}{zero}"
    yield f"  tolerance on the scaled values: {analysis.tolerance:.16e}"
    yield from ("", "Rows of D(c)")
    for number, (element, deformation) in enumerate(analysis.row_labels, start=1):
        yield f"  {number:5d}  element {element}, deformation {deformation}"
    yield from ("", "Columns of D(c)")
    for number, (node, coordinate) in enumerate(analysis.column_labels, start=1):
        yield f"  {number:5d}  node {node}, coordinate {coordinate}"
    yield from ("", "Versions")
    yield f"  flexact {__version__}, numpy {np.__version__}, Python {platform.python_version()}"
