# SPDX-License-Identifier: BSD-3-Clause
"""Mesh files as VTK's own readers see them, which are ParaView's."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader
from vtkmodules.vtkIOXdmf2 import vtkXdmfReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader

#: VTK's codes of cells.
VERTEX, LINE, QUAD = 1, 3, 9

READERS = {
    ".vtu": vtkXMLUnstructuredGridReader,
    ".vtp": vtkXMLPolyDataReader,
    ".vtk": vtkUnstructuredGridReader,
    ".xdmf": vtkXdmfReader,
}


@dataclass(frozen=True)
class Read:
    """What VTK reads: points (n, 3), cells as lists of points, their shapes, and the data."""

    points: np.ndarray
    shape: np.ndarray
    cells: list[list[int]]
    point_data: dict[str, Any]
    cell_data: dict[str, Any]
    field_data: dict[str, Any]
    vectors: str | None

    @property
    def names(self) -> dict[int, str]:
        """The name of each element."""
        texts = bytes(self.field_data["element_names"]).decode().split("\n")[:-1]
        numbers = self.field_data["element_number"].ravel().tolist()
        return dict(zip(numbers, texts, strict=True))

    def cells_of(self, element: int, shape: int) -> np.ndarray:
        """The cells of a shape that an element has, in their order."""
        mine = np.flatnonzero((self.cell_data["element"] == element) & (self.shape == shape))
        return np.array([self.cells[i] for i in mine.tolist()], dtype=np.int64)

    def ends_of(self, element: int) -> tuple[int, int]:
        """The points at both ends of an element's axis, p first."""
        lines = self.cells_of(element, LINE)
        assert np.array_equal(lines[1:, 0], lines[:-1, 1])
        return int(lines[0, 0]), int(lines[-1, 1])

    @property
    def points_of_elements(self) -> np.ndarray:
        """The points of all cells but those of symbols, ascending."""
        mine = np.flatnonzero(self.cell_data["element"])
        return np.unique([point for i in mine.tolist() for point in self.cells[i]])

    def points_of(self, element: int, shape: int) -> np.ndarray:
        """The points of those cells, ascending."""
        return np.unique(self.cells_of(element, shape))


def read(path: Path) -> Read:
    """Read a file by its suffix."""
    reader = READERS[path.suffix]()
    reader.SetFileName(str(path))
    reader.Update()
    found = reader.GetOutputDataObject(0)
    assert found.GetNumberOfPoints() > 0, path
    cells, shape = [], []
    for i in range(found.GetNumberOfCells()):
        cell = found.GetCell(i)
        shape.append(cell.GetCellType())
        cells.append([cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())])
    vectors = found.GetPointData().GetVectors()
    return Read(
        vtk_to_numpy(found.GetPoints().GetData()).astype(float),
        np.array(shape),
        cells,
        _arrays(found.GetPointData()),
        _arrays(found.GetCellData()),
        _arrays(found.GetFieldData()),
        vectors.GetName() if vectors is not None else None,
    )


def _arrays(place: Any) -> dict[str, Any]:
    made: dict[str, Any] = {}
    for i in range(place.GetNumberOfArrays()):
        array = place.GetAbstractArray(i)
        if array.IsNumeric():
            made[array.GetName()] = vtk_to_numpy(array)
        else:
            count = array.GetNumberOfValues()
            made[array.GetName()] = [array.GetValue(k) for k in range(count)]
    return made
