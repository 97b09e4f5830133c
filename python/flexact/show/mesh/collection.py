# SPDX-License-Identifier: BSD-3-Clause
"""Meshes that play in ParaView: a .pvd file that says when which of them is shown."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from ...analysis.result import Result
from ...util.outputs import OutputError, write_together
from ..drawing import Moving, Pose, move
from . import file as polydata
from .content import Mesh, Meshes, mesh_of
from .file import find_format, mesh_bytes

SUFFIX = ".pvd"


def folder_of(target: Path) -> Path:
    """Where the meshes of a .pvd file lie."""
    return target.with_name(f"{target.stem}_files")


class Collection(Mapping[Path, bytes]):
    """The files of what plays, each made when it is asked for; the .pvd file comes last."""

    def __init__(self, target: Path, files: Iterable[Path], times: Mapping[float, Path]) -> None:
        """The meshes, and which of them is shown at each time.

        Raises:
            OutputError: XML cannot spell their names.
        """
        self.folder = folder_of(target)
        self._files, self._times, self._target = tuple(files), times, target
        self._require_nameable()

    def mesh(self, path: Path) -> bytes:
        """What a mesh holds."""
        raise NotImplementedError

    def __iter__(self) -> Iterator[Path]:
        """The files in the order in which they are to be written."""
        yield from (*self._files, self._target)

    def __len__(self) -> int:
        """How many files there are."""
        return len(self._files) + 1

    def __getitem__(self, path: Path) -> bytes:
        """What a file holds."""
        return self._told() if path == self._target else self.mesh(path)

    def _require_nameable(self) -> None:
        try:
            ElementTree.fromstring(self._told())
        except (UnicodeEncodeError, ElementTree.ParseError) as error:
            raise OutputError(
                f"cannot write {self._target}: its name has characters that XML cannot spell"
            ) from error

    def _told(self) -> bytes:
        root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
        steps = ElementTree.SubElement(root, "Collection")
        for time, path in self._times.items():
            file = f"{path.parent.name}/{path.name}"
            ElementTree.SubElement(
                steps, "DataSet", timestep=repr(time), group="", part="0", file=file
            )
        ElementTree.indent(root)
        return bytes(ElementTree.tostring(root, encoding="utf-8", xml_declaration=True)) + b"\n"


def moved_mesh(meshes: Meshes, pose: Pose) -> Mesh:
    """The mesh in a pose: points where they have moved to, `displacement` and `rotation` finite."""
    return meshes.with_data(*meshes.moved(pose))


def write_collection(collection: Collection) -> None:
    """Write the files of what plays, all or none.

    Raises:
        OutputError: They cannot be written.
    """
    there = collection.folder.exists()
    try:
        write_together(collection)
    except BaseException:
        if not there:
            with contextlib.suppress(OSError):
                collection.folder.rmdir()
        raise


#: Time steps of a cycle, from time 0 to time 1; the last is as the first.
STEPS = 24
#: Names of the meshes: this, and one of these each.
STEM = "step_"
ENDINGS = tuple(f"{i:02d}.vtu" for i in range(STEPS + 1))


class Cycle(Collection):
    """The files of a cycle.

    A step at time t shows the motion at the phase sin(2 pi t), from rest: points where they have
    moved to, `displacement` and `rotation` finite, since the reference; all other data as in any
    mesh. A mechanism that does not move has a single step.
    """

    def __init__(self, analysis: Result, shown: Moving | None, target: Path) -> None:
        """The cycle of a motion; its meshes lie in a folder beside the .pvd file `target`."""
        self._format = find_format("vtu")
        times = np.linspace(0.0, 1.0, STEPS + 1).tolist() if shown is not None else [0.0]
        self._meshes = Meshes(analysis, len(times))
        self._movement = None if shown is None else move(self._meshes.drawn, shown)
        files = [folder_of(target) / f"{STEM}{ending}" for ending in ENDINGS[: len(times)]]
        self._time_of = dict(zip(files, times, strict=True))
        super().__init__(target, files, dict(zip(times, files, strict=True)))

    def mesh(self, path: Path) -> bytes:
        """What a mesh holds."""
        time = self._time_of[path]
        if self._movement is None:
            return mesh_bytes(self._meshes.still(None), self._format)
        # Rounded, so that it is at rest where it ends, too.
        pose = self._movement.pose(round(float(np.sin(2 * np.pi * time)), 15))
        return mesh_bytes(moved_mesh(self._meshes, pose), self._format)


Write = Callable[[Result, Moving | None, Path], None]


def mesh_writer(target: Path) -> Write:
    """What writes an analysis, and the motion that is shown, to a file with this suffix.

    Raises:
        OutputError: There is nothing, or a package is missing.
    """
    suffix = target.suffix.lower()
    if not suffix:
        raise OutputError(f"the suffix of {target} is to say what to write: .vtu, .pvd, ...")
    if suffix == SUFFIX:
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
    write_collection(Cycle(analysis, shown, target))
