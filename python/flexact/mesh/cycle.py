# SPDX-License-Identifier: BSD-3-Clause
"""A motion as a cycle that plays in ParaView: a .pvd file and a mesh for each time step."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from ..drawing import Movement, Moving, move
from ..drawing.rotations import vector_of
from ..files.outputs import OutputError, write_together
from ..result.result import Result
from .content import Mesh, Meshes
from .file import find_format, named_bytes

SUFFIX = ".pvd"
#: Time steps of a cycle, from time 0 to time 1; the last is as the first.
STEPS = 24
#: Names of the meshes: this, and one of these each.
STEM = "step_"
ENDINGS = tuple(f"{i:02d}.vtu" for i in range(STEPS + 1))


def folder_of(target: Path) -> Path:
    """Where the meshes of a .pvd file lie."""
    return target.with_name(f"{target.stem}_files")


class Cycle(Mapping[Path, bytes]):
    """The files of a cycle, each made when it is asked for; the .pvd file comes last.

    A step at time t shows the motion at the phase cos(2 pi t): points where they have moved to,
    `displacement` and `rotation` finite, since the reference; all other data as in any mesh. A
    mechanism that does not move has a single step.
    """

    def __init__(self, analysis: Result, shown: Moving | None, target: Path) -> None:
        """The cycle of a motion; its meshes lie in a folder beside the .pvd file `target`."""
        self.folder = folder_of(target)
        self._format = find_format("vtu")
        times = np.linspace(0.0, 1.0, STEPS + 1).tolist() if shown is not None else [0.0]
        self._meshes = Meshes(analysis, len(times))
        self._movement = None if shown is None else move(self._meshes.drawn, shown)
        files = [self.folder / f"{STEM}{ending}" for ending in ENDINGS]
        self._times = dict(zip(files, times, strict=False))
        self._target = target
        self._require_nameable()

    def __iter__(self) -> Iterator[Path]:
        """The files in the order in which they are to be written."""
        yield from (*self._times, self._target)

    def __len__(self) -> int:
        """How many files there are."""
        return len(self._times) + 1

    def __getitem__(self, path: Path) -> bytes:
        """What a file holds."""
        if path == self._target:
            return self._collection()
        time = self._times[path]
        if self._movement is None:
            return named_bytes(self._meshes.still(None), self._format)
        return named_bytes(self._moved(self._movement, time), self._format)

    def _moved(self, movement: Movement, time: float) -> Mesh:
        reference = self._meshes.reference
        here = self._meshes.layout(movement.pose(float(np.cos(2 * np.pi * time))))
        turned = vector_of(here.frame @ np.swapaxes(reference.frame, -1, -2))
        return self._meshes.with_data(
            here.points, here.points - reference.points, turned[reference.axis_point]
        )

    def _require_nameable(self) -> None:
        try:
            ElementTree.fromstring(self._collection())
        except (UnicodeEncodeError, ElementTree.ParseError) as error:
            raise OutputError(
                f"cannot write {self._target}: its name has characters that XML cannot spell"
            ) from error

    def _collection(self) -> bytes:
        root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
        steps = ElementTree.SubElement(root, "Collection")
        for path, time in self._times.items():
            file = f"{path.parent.name}/{path.name}"
            ElementTree.SubElement(
                steps, "DataSet", timestep=repr(time), group="", part="0", file=file
            )
        ElementTree.indent(root)
        return bytes(ElementTree.tostring(root, encoding="utf-8", xml_declaration=True)) + b"\n"


def write_cycle(cycle: Cycle) -> None:
    """Write the files of a cycle, all or none.

    Raises:
        OutputError: They cannot be written.
    """
    there = cycle.folder.exists()
    try:
        write_together(cycle)
    except BaseException:
        if not there:
            with contextlib.suppress(OSError):
                cycle.folder.rmdir()
        raise
