"""Mesh files through meshio: which format, and the bytes of the file."""

from __future__ import annotations

import contextlib
import io
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from .outputs import OutputError

if TYPE_CHECKING:
    import meshio

# Known to hold lines, vertices and every array; what other formats hold is looked at.
COMPLETE = ("vtu", "vtk", "xdmf")

OPTIONS = {"xdmf": {"data_format": "XML"}}


class MeshFormatError(OutputError):
    """A mesh format is not known, or cannot hold what is to be written."""


@dataclass(frozen=True)
class MeshFormat:
    """A format of meshio: a file's suffix with its dot, and meshio's names for it."""

    suffix: str
    names: tuple[str, ...]


def find_format(name: str) -> MeshFormat:
    """The format that has this name or suffix.

    Raises:
        MeshFormatError: meshio has none, or is not installed.
    """
    known = _meshio().extension_to_filetypes
    name = name.lower().lstrip(".")
    suffix = f".{name}"
    if suffix in known:
        return MeshFormat(suffix, tuple(known[suffix]))
    for suffix, names in known.items():
        if name in names:
            return MeshFormat(suffix, (name,))
    every = sorted({each for names in known.values() for each in names})
    raise MeshFormatError(f"mesh format {name!r} is not known; there are {', '.join(every)}")


def mesh_bytes(mesh: meshio.Mesh, form: MeshFormat) -> bytes:
    """The file that holds a mesh.

    Raises:
        MeshFormatError: The format cannot hold the mesh or its data.
    """
    reasons = []
    for name in form.names:
        try:
            return _written(mesh, name, form.suffix)
        except MeshFormatError as error:
            reasons.append(f"mesh format {name} cannot hold this scene: {error}")
    raise MeshFormatError("; ".join(reasons))


def _meshio() -> ModuleType:
    try:
        return import_module("meshio")
    except ImportError as error:
        raise MeshFormatError(f"mesh files need the package meshio: {error}") from error


def _written(mesh: meshio.Mesh, name: str, suffix: str) -> bytes:
    from tempfile import TemporaryDirectory

    remarks = io.StringIO()
    with TemporaryDirectory() as folder, contextlib.redirect_stderr(remarks):
        path = Path(folder, f"mesh{suffix}")
        try:
            with _placeholder_for_h5py(name):
                made = _tagged(mesh) if name == "gmsh" else mesh
                _meshio().write(path, made, file_format=name, **OPTIONS.get(name, {}))
            if len(list(path.parent.iterdir())) != 1:
                raise MeshFormatError("it takes more than one file")
            if name not in COMPLETE:
                _check_held(mesh, _meshio().read(path, file_format=name))
            return path.read_bytes()
        # meshio's writers fail in ways of their own: KeyError, AssertionError, sys.exit ...
        except (Exception, SystemExit) as error:
            raise MeshFormatError(_reason(error, remarks.getvalue())) from error


def _tagged(mesh: meshio.Mesh) -> meshio.Mesh:
    """The mesh with the entities that gmsh wants: one for the vertices, one for the lines."""
    tagged = mesh.copy()
    entity = np.ones((len(mesh.points), 2), dtype=np.int32)
    for block in mesh.cells:
        entity[block.data.ravel(), 0] = block.dim
    tagged.point_data["gmsh:dim_tags"] = entity
    for tag in ("gmsh:physical", "gmsh:geometrical"):
        tagged.cell_data[tag] = [np.ones(len(block), dtype=np.int32) for block in mesh.cells]
    return tagged


def _reason(error: BaseException, remarks: str) -> str:
    told = isinstance(error, MeshFormatError) or type(error).__name__ == "WriteError"
    what = str(error) if told else f"{type(error).__name__}: {error}".rstrip(": ")
    return "; meshio: ".join(filter(None, (what, " ".join(remarks.split()))))


def _check_held(mesh: meshio.Mesh, back: meshio.Mesh) -> None:
    cells = [{block.type: len(block.data) for block in each.cells} for each in (mesh, back)]
    if cells[0] != cells[1] or len(mesh.points) != len(back.points):
        raise MeshFormatError("it loses cells or points")
    for name, values in mesh.point_data.items():
        if name not in back.point_data or not np.allclose(values, back.point_data[name]):
            raise MeshFormatError(f"it loses {name}")
    for name, blocks in mesh.cell_data.items():
        if name not in back.cell_data or not all(map(np.allclose, blocks, back.cell_data[name])):
            raise MeshFormatError(f"it loses {name}")


@contextlib.contextmanager
def _placeholder_for_h5py(name: str) -> Iterator[None]:
    """Let meshio's XDMF writer import h5py, which it does even where it will not use it."""
    if name != "xdmf" or find_spec("h5py") is not None:
        yield
        return
    sys.modules["h5py"] = ModuleType("h5py")
    try:
        yield
    finally:
        del sys.modules["h5py"]
