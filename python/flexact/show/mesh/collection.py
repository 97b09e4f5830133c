# SPDX-License-Identifier: BSD-3-Clause
"""Meshes that play in ParaView: a .pvd file that says when which of them is shown."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from xml.etree import ElementTree

from ...util.outputs import OutputError, write_together
from ..drawing import Pose
from .mesh_content import Mesh, Meshes

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
