# SPDX-License-Identifier: BSD-3-Clause
"""Mesh files through meshio: which format, and the bytes of the file.

Field data, which meshio reads and does not write, are put into .vtu files behind it.
"""

from __future__ import annotations

import base64
import contextlib
import shutil
import sys
import tempfile
import zlib
from collections.abc import Callable, Iterator, Mapping
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from ...util.errors import reason_of
from ...util.interruption import undisturbed
from ...util.outputs import OutputError
from ...util.text import harmless
from .content import Mesh, component_names, spelt

#: Formats that meshio writes unaided with every cell and every array, and how.
FORMATS: dict[str, dict[str, str]] = {"vtu": {}, "vtk": {}, "xdmf": {"data_format": "XML"}}

#: Where meshio begins the grid and the data of the points; no data look like it.
_GRID = b"<UnstructuredGrid>\n"
_POINTS = b"<PointData>\n"
_TYPES = {"uint8": "UInt8", "int64": "Int64", "float64": "Float64"}
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
        raise unknown_format(name)
    _module("meshio")
    return known


def unknown_format(name: str) -> MeshFormatError:
    """The error of a name or suffix that no format has."""
    return MeshFormatError(
        f"mesh format {name.lower().removeprefix('.')!r} is not known: it is one of "
        f"{', '.join(FORMATS)}, for export also pvd, which plays, vtp, solids as step, glb, 3mf "
        "or stl, and tables of flexures as csv or xlsx; "
        "meshio.write(..., analysis.to_meshio()) has others"
    )


def _module(name: str) -> ModuleType:
    try:
        return import_module(name)
    except ImportError as error:
        needs = (
            "mesh files need the package meshio: pip install meshio"
            if name == "meshio"
            else "mesh format vtp needs the package vtk: pip install vtk"
        )
        raise MeshFormatError(f"{needs} ({error})") from error


def mesh_bytes(mesh: Mesh, form: str) -> bytes:
    """The file that holds a mesh; a .vtu file has the field data, too.

    Raises:
        MeshFormatError: meshio is not installed.
        OutputError: The temporary folder cannot be written to, or there is not enough memory.
    """
    try:
        with _temporary_folder() as folder, _placeholder_for_h5py(form):
            path = folder / f"mesh.{form}"
            _module("meshio").write(path, mesh.to_meshio(), file_format=form, **FORMATS[form])
            content = path.read_bytes()
    except MemoryError as error:
        raise OutputError("there is not enough memory for the mesh") from error
    except OSError as error:
        reason = reason_of(error)
        raise OutputError(f"the mesh cannot be written to a temporary folder: {reason}") from error
    return _completed(content, mesh.field_data) if form == "vtu" else content


def _completed(content: bytes, data: Mapping[str, NDArray[np.generic]]) -> bytes:
    """The .vtu file of meshio's with field data, which meshio reads and does not write.

    ParaView warps by `displacement` unless told otherwise.
    """
    components = component_names(data)
    arrays = b""
    for name, values in data.items():
        told = "".join(
            f" ComponentName{k}={quoteattr(harmless(words))}"
            for k, words in enumerate(components.get(name, []))
        )
        if values.ndim > 1:
            told = f' NumberOfComponents="{values.shape[1]}"{told}'
        head = (
            f'<DataArray type="{_TYPES[values.dtype.name]}" Name={quoteattr(name)}{told} '
            f'NumberOfTuples="{len(values)}" format="binary">\n'
        )
        arrays += head.encode() + _encoded(values.tobytes()) + b"\n</DataArray>\n"
    content = content.replace(_GRID, _GRID + b"<FieldData>\n" + arrays + b"</FieldData>\n", 1)
    return content.replace(_POINTS, b'<PointData Vectors="displacement">\n', 1)


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


def polydata_bytes(mesh: Mesh) -> bytes:
    """The .vtp file that holds a mesh: vertices, lines and polygons.

    Raises:
        MeshFormatError: The package vtk is not installed, or fails.
    """
    writer = _module("vtkmodules.vtkIOXML").vtkXMLPolyDataWriter()
    writer.SetInputData(_polydata(mesh))
    writer.SetWriteToOutputString(True)
    # Text alone: a string of Python's holds no raw bytes.
    writer.SetDataModeToBinary()
    if not writer.Write():
        raise MeshFormatError("VTK fails to write the mesh")
    text: str = writer.GetOutputString()
    return text.encode()


def require_polydata(_suffix: str = "") -> None:
    """Raise where .vtp files cannot be written.

    Raises:
        MeshFormatError: The package vtk is not installed.
    """
    _module("vtkmodules.vtkIOXML")


def _polydata(mesh: Mesh) -> Any:
    to_vtk: Callable[..., Any] = _module("vtkmodules.util.numpy_support").numpy_to_vtk
    made = _module("vtkmodules.vtkCommonDataModel").vtkPolyData()
    points = _module("vtkmodules.vtkCommonCore").vtkPoints()
    points.SetData(to_vtk(np.ascontiguousarray(mesh.points), deep=True))
    made.SetPoints(points)
    to_cells = _module("vtkmodules.util.numpy_support").numpy_to_vtkIdTypeArray
    for take, corners in zip(
        (made.SetVerts, made.SetLines, made.SetPolys), mesh.corners, strict=True
    ):
        cells = _module("vtkmodules.vtkCommonDataModel").vtkCellArray()
        offsets = np.arange(len(corners) + 1) * corners.shape[1]
        cells.SetData(to_cells(offsets, deep=True), to_cells(corners.ravel().copy(), deep=True))
        take(cells)
    for place, data in (
        (made.GetPointData(), mesh.point_data),
        (made.GetCellData(), mesh.cell_data),
        (made.GetFieldData(), mesh.field_data),
    ):
        for name, values in data.items():
            array = to_vtk(np.ascontiguousarray(values), deep=True)
            array.SetName(name)
            place.AddArray(array)
    made.GetPointData().SetActiveVectors("displacement")
    names = _module("vtkmodules.vtkCommonCore").vtkStringArray()
    names.SetName("name")
    names.SetNumberOfValues(len(mesh.element))
    known = list(map(spelt, mesh.names))
    for i, element in enumerate(mesh.element.tolist()):
        names.SetValue(i, known[element])
    made.GetCellData().AddArray(names)
    for name, words in component_names(mesh.field_data).items():
        # Names of elements are strings here.
        if len(words) == 1 and name != "element_number":
            made.GetFieldData().GetArray(name).SetComponentName(0, words[0])
    return made
