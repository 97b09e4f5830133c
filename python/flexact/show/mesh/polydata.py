# SPDX-License-Identifier: BSD-3-Clause
"""Meshes as VTK's surfaces, .vtp files, by VTK's own writer."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from types import ModuleType
from typing import Any

import numpy as np

from .field_data import component_names
from .file import MeshFormatError, cell_names
from .mesh_content import Mesh


def polydata_bytes(mesh: Mesh) -> bytes:
    """The .vtp file that holds a mesh: vertices, lines and polygons.

    Raises:
        MeshFormatError: The package vtk is not installed, or fails.
    """
    writer = _module("vtkIOXML").vtkXMLPolyDataWriter()
    writer.SetInputData(_polydata(mesh))
    writer.SetWriteToOutputString(True)
    # Text alone: a string of Python's holds no raw bytes.
    writer.SetDataModeToBinary()
    if not writer.Write():
        raise MeshFormatError("VTK fails to write the mesh")
    text: str = writer.GetOutputString()
    return text.encode()


def require() -> None:
    """Raise where .vtp files cannot be written.

    Raises:
        MeshFormatError: The package vtk is not installed.
    """
    _module("vtkIOXML")


def _module(name: str) -> ModuleType:
    try:
        return import_module(f"vtkmodules.{name}")
    except ImportError as error:
        raise MeshFormatError(
            f"mesh format vtp needs the package vtk: pip install vtk ({error})"
        ) from error


def _polydata(mesh: Mesh) -> Any:
    to_vtk: Callable[..., Any] = _module("util.numpy_support").numpy_to_vtk
    made = _module("vtkCommonDataModel").vtkPolyData()
    points = _module("vtkCommonCore").vtkPoints()
    points.SetData(to_vtk(np.ascontiguousarray(mesh.points), deep=True))
    made.SetPoints(points)
    for take, corners in zip(
        (made.SetVerts, made.SetLines, made.SetPolys), mesh.corners, strict=True
    ):
        take(_cells(corners))
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
    made.GetCellData().AddArray(_names(mesh))
    for name, words in component_names(mesh.field_data).items():
        # Names of elements are strings here.
        if len(words) == 1 and name != "element_number":
            made.GetFieldData().GetArray(name).SetComponentName(0, words[0])
    return made


def _cells(corners: np.ndarray) -> Any:
    to_vtk = _module("util.numpy_support").numpy_to_vtkIdTypeArray
    made = _module("vtkCommonDataModel").vtkCellArray()
    offsets = np.arange(len(corners) + 1) * corners.shape[1]
    made.SetData(to_vtk(offsets, deep=True), to_vtk(corners.ravel().copy(), deep=True))
    return made


def _names(mesh: Mesh) -> Any:
    made = _module("vtkCommonCore").vtkStringArray()
    made.SetName("name")
    names = cell_names(mesh)
    made.SetNumberOfValues(len(names))
    for i, name in enumerate(names):
        made.SetValue(i, name)
    return made
