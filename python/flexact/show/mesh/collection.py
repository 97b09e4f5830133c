# SPDX-License-Identifier: BSD-3-Clause
"""The files of meshes, still or playing in ParaView (.pvd), and of solids, by suffix."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

from ...analysis.result import Result
from ...util.loading import feature, load
from ...util.outputs import OutputError
from ..drawing import Moving, move
from ..writers import FLEXURES, PLAYING, STILL_SOLIDS, Writers
from .content import Mesh, Meshes, mesh_of
from .file import (
    FORMATS,
    find_format,
    mesh_bytes,
    polydata_bytes,
    require_polydata,
    unknown_format,
)


def folder_of(target: Path) -> Path:
    """Where the meshes of a .pvd file lie."""
    return target.with_name(f"{target.stem}_files")


class Collection(Mapping[Path, bytes]):
    """The files of what plays, each made when it is asked for; the .pvd file comes last."""

    def __init__(
        self, target: Path, times: Mapping[float, Path], mesh: Callable[[Path], Mesh]
    ) -> None:
        """The mesh that is shown at each time, and what makes it.

        Raises:
            MeshFormatError: A package is missing.
            OutputError: XML cannot spell the names of the files.
        """
        self._format = find_format("vtu")
        self._times, self._target, self._mesh = times, target, mesh
        # One mesh may be shown more than once.
        self._files = tuple(sorted({*times.values()}))
        try:
            ElementTree.fromstring(self._told())
        except (UnicodeEncodeError, ElementTree.ParseError) as error:
            raise OutputError(
                f"cannot write {self._target}: its name has characters that XML cannot spell"
            ) from error

    def __iter__(self) -> Iterator[Path]:
        """The files in the order in which they are to be written."""
        yield from (*self._files, self._target)

    def __len__(self) -> int:
        """How many files there are."""
        return len(self._files) + 1

    def __getitem__(self, path: Path) -> bytes:
        """What a file holds."""
        if path == self._target:
            return self._told()
        return mesh_bytes(self._mesh(path), self._format)

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


#: Time steps of a cycle, from time 0 to time 1; the last is as the first.
STEPS = 24
#: Names of the meshes: this, and one of these each.
STEM = "step_"
ENDINGS = tuple(f"{i:02d}.vtu" for i in range(STEPS + 1))


def cycle(analysis: Result, shown: Moving | None, target: Path) -> Collection:
    """The files of a cycle; its meshes lie in a folder beside the .pvd file `target`.

    A step at time t shows the motion at the phase sin(2 pi t), from rest: points where they have
    moved to, `displacement` and `rotation` finite, since the reference; all other data as in any
    mesh. A mechanism that does not move has a single step.
    """
    times = np.linspace(0.0, 1.0, STEPS + 1).tolist() if shown is not None else [0.0]
    meshes = Meshes(analysis, len(times))
    movement = None if shown is None else move(meshes.drawn, shown)
    files = [folder_of(target) / f"{STEM}{ending}" for ending in ENDINGS[: len(times)]]
    time_of = dict(zip(files, times, strict=True))

    def mesh(path: Path) -> Mesh:
        if movement is None:
            return meshes.still(None)
        # Rounded, so that it is at rest where it ends, too.
        phase = round(float(np.sin(2 * np.pi * time_of[path])), 15)
        return meshes.moved(movement.pose(phase))

    return Collection(target, dict(zip(times, files, strict=True)), mesh)


def _unknown(path: Path, suffixes: tuple[str, ...]) -> Exception:
    if not path.suffix:
        return OutputError(f"the suffix of {path} is to say what to write: .vtu, .step, .glb, ...")
    return unknown_format(path.suffix)


#: Of an analysis and the motion that is shown, if one is.
MESHES = Writers(_unknown)


@MESHES.register((f".{form}" for form in FORMATS), require=find_format)
def _still(drawn: tuple[Result, Moving | None], path: Path) -> bytes:
    return mesh_bytes(mesh_of(*drawn), find_format(path.suffix))


@MESHES.register((".vtp",), require=require_polydata)
def _polydata(drawn: tuple[Result, Moving | None], path: Path) -> bytes:
    return polydata_bytes(mesh_of(*drawn))


@MESHES.register((PLAYING,), require=lambda _: find_format("vtu"))
def _playing(drawn: tuple[Result, Moving | None], path: Path) -> Collection:
    return cycle(*drawn, path)


@MESHES.register(STILL_SOLIDS, shows=("notes",))
@MESHES.register((".glb",), shows=("notes", "stress"))
def _solids(drawn: tuple[Result, Moving | None], path: Path, **chosen: Any) -> bytes:
    # Whoever writes meshes, as analyse does, has no need of what makes solids.
    files: Any = load("flexact.show.solids.files")
    return bytes(files.solid_bytes(*drawn, path.suffix.lower(), **chosen))


@MESHES.register(FLEXURES, shows=("notes",))
def _flexures(
    drawn: tuple[Result, Moving | None], path: Path, notes: list[str] | None = None
) -> bytes:
    content, told = feature("flexures")(drawn[0].given, path.suffix.lower())
    if notes is not None:
        notes += [each.message for each in told]
    return bytes(content)
