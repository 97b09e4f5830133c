# SPDX-License-Identifier: BSD-3-Clause
"""Mesh files through meshio: which format, and the bytes of the file.

Names of cells, which meshio can neither write nor read, are put into VTK's XML files behind it.
"""

from __future__ import annotations

import base64
import contextlib
import shutil
import sys
import tempfile
import zlib
from collections.abc import Iterator
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType

import numpy as np

from ..base.errors import reason_of
from ..base.interruption import undisturbed
from ..files.outputs import OutputError
from .content import Mesh

#: Formats that meshio writes unaided with every cell and every array, and how.
FORMATS: dict[str, dict[str, str]] = {"vtu": {}, "vtk": {}, "xdmf": {"data_format": "XML"}}

#: Where meshio begins the data of the cells and of the points; no data look like it.
_CELLS = b"<CellData>\n"
_POINTS = b"<PointData>\n"
_ARRAY = b'<DataArray type="String" Name="name" NumberOfComponents="1" format="binary">\n'
#: Bytes of a block that is compressed by itself, as meshio has it.
_BLOCK = 32_768


class MeshFormatError(OutputError):
    """A mesh format is not known, lacks a package, or cannot hold what is to be written."""


def find_format(name: str) -> str:
    """The format that has this name or suffix.

    Raises:
        MeshFormatError: There is none, or meshio is not installed.
    """
    known = name.lower().removeprefix(".")
    if known not in FORMATS:
        raise MeshFormatError(
            f"mesh format {known!r} is not known: it is one of {', '.join(FORMATS)}, for export "
            "also pvd, which plays, and vtp; meshio.write(..., analysis.to_meshio()) has others"
        )
    _meshio()
    return known


def _meshio() -> ModuleType:
    try:
        return import_module("meshio")
    except ImportError as error:
        raise MeshFormatError(
            f"mesh files need the package meshio: pip install meshio ({error})"
        ) from error


def mesh_bytes(mesh: Mesh, form: str) -> bytes:
    """The file that holds a mesh, and that meshio reads: without names.

    Raises:
        MeshFormatError: meshio is not installed.
        OutputError: The temporary folder cannot be written to, or there is not enough memory.
    """
    try:
        with _temporary_folder() as folder, _placeholder_for_h5py(form):
            path = folder / f"mesh.{form}"
            _meshio().write(path, mesh.to_meshio(), file_format=form, **FORMATS[form])
            return path.read_bytes()
    except MemoryError as error:
        raise OutputError("there is not enough memory for the mesh") from error
    except OSError as error:
        reason = reason_of(error)
        raise OutputError(f"the mesh cannot be written to a temporary folder: {reason}") from error


def named_bytes(mesh: Mesh, form: str) -> bytes:
    """The file that holds a mesh, a .vtu file with the names of the cells.

    Raises:
        OutputError: A package is missing, or the temporary folder cannot be written to.
    """
    content = mesh_bytes(mesh, form)
    return _with_names(content, mesh) if form == "vtu" else content


def _with_names(content: bytes, mesh: Mesh) -> bytes:
    """The .vtu file of meshio's that holds a mesh, with the array `name`, one text a cell.

    ParaView warps by `displacement` unless told otherwise.
    """
    array = _ARRAY + _encoded("\0".join((*cell_names(mesh), "")).encode()) + b"\n</DataArray>\n"
    content = content.replace(_CELLS, _CELLS + array, 1)
    return content.replace(_POINTS, b'<PointData Vectors="displacement">\n', 1)


def cell_names(mesh: Mesh) -> list[str]:
    """The name of each cell's element as VTK can keep it.

    Without zeros, and such that UTF-8 can spell it.
    """
    names = [
        name.replace("\0", "\ufffd").encode("utf-8", "backslashreplace").decode("utf-8")
        for name in mesh.names
    ]
    return [names[i] for i in mesh.element.tolist()]


def _encoded(raw: bytes) -> bytes:
    """Bytes as meshio's .vtu files have them: in blocks, compressed, in base 64."""
    blocks = [raw[i : i + _BLOCK] for i in range(0, len(raw), _BLOCK)]
    packed = [zlib.compress(block) for block in blocks]
    last = len(blocks[-1]) if blocks else 0
    header = np.array([len(blocks), _BLOCK, last, *map(len, packed)], np.uint32)
    return base64.b64encode(header.tobytes()) + base64.b64encode(b"".join(packed))


@contextlib.contextmanager
def _temporary_folder() -> Iterator[Path]:
    """A folder of the system's for a while; a signal does not leave it behind."""
    folder = None
    try:
        with undisturbed():
            folder = tempfile.mkdtemp(prefix="flexact-")
        yield Path(folder)
    finally:
        if folder is not None:
            with undisturbed():
                shutil.rmtree(folder, ignore_errors=True)


@contextlib.contextmanager
def _placeholder_for_h5py(form: str) -> Iterator[None]:
    """Let meshio's XDMF writer import h5py, which it does even where it will not use it."""
    if form != "xdmf" or find_spec("h5py") is not None:
        yield
        return
    sys.modules["h5py"] = ModuleType("h5py")
    try:
        yield
    finally:
        del sys.modules["h5py"]
