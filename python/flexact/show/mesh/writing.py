# SPDX-License-Identifier: BSD-3-Clause
"""Meshes to files of any kind: which kind a file's suffix means, and what writes it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ...analysis.result import Result
from ...util.outputs import OutputError, write_together
from ..drawing import Moving
from . import collection, cycle, polydata
from .file import find_format, mesh_bytes
from .mesh_content import mesh_of

Write = Callable[[Result, Moving | None, Path], None]


def mesh_writer(target: Path) -> Write:
    """What writes an analysis, and the motion that is shown, to a file with this suffix.

    Raises:
        OutputError: There is nothing, or a package is missing.
    """
    suffix = target.suffix.lower()
    if not suffix:
        raise OutputError(f"the suffix of {target} is to say what to write: .vtu, .pvd, ...")
    if suffix == collection.SUFFIX:
        find_format("vtu")
        return _write_cycle
    if suffix == ".vtp":
        polydata.require()
        return _write_polydata
    form = find_format(suffix)

    def write(analysis: Result, shown: Moving | None, target: Path) -> None:
        write_together({target: mesh_bytes(mesh_of(analysis, shown), form)})

    return write


def _write_polydata(analysis: Result, shown: Moving | None, target: Path) -> None:
    write_together({target: polydata.polydata_bytes(mesh_of(analysis, shown))})


def _write_cycle(analysis: Result, shown: Moving | None, target: Path) -> None:
    collection.write_collection(cycle.Cycle(analysis, shown, target))
