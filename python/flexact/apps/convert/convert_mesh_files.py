# SPDX-License-Identifier: BSD-3-Clause
"""Files of meshes through meshio, with errors in words whatever a file holds."""

from __future__ import annotations

import contextlib
import io
import tempfile
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from ...util.errors import BatchError
from ...util.plain_text import harmless


class MeshError(BatchError):
    """A mesh that cannot be read, written or taken for a mechanism."""

    def __init__(self, words: str) -> None:
        """Why not; names of the file in it move no cursor."""
        super().__init__(harmless(words))


def suffixes() -> tuple[str, ...]:
    """Those that meshio knows, without decks'."""
    return tuple(sorted(set(_meshio().extension_to_filetypes) - {".dat"}))


def read_mesh(path: Path) -> Any:
    """A mesh of meshio from a file.

    Raises:
        MeshError: it cannot be read, or meshio is missing.
    """
    meshio = _meshio()
    if not path.is_file():
        raise MeshError(f"{path}: there is no such file")
    said = io.StringIO()
    try:
        with _in_silence() as said:
            return meshio.read(path)
    except MemoryError:
        raise
    except (Exception, SystemExit) as error:
        words = str(error) if isinstance(error, Exception) else ""
        words = words or next(iter(said.getvalue().strip().splitlines()), "")
        reason = " ".join(words.split())[:200] or type(error).__name__
        raise MeshError(f"{path}: meshio cannot read this mesh: {reason}") from error


def mesh_bytes(mesh: Any, suffix: str) -> tuple[bytes, tuple[str, ...]]:
    """The file that holds a mesh of lines, and names of the data that it lost.

    Of the formats that a suffix may mean, it is the first that holds lines.

    Raises:
        MeshError: meshio has no such format or cannot write this one, or is missing.
    """
    meshio = _meshio()
    if suffix not in suffixes():
        raise MeshError(f"meshio writes no {suffix or 'file without a suffix'}: try .vtu or .vtk")
    reason = ""
    for form in meshio.extension_to_filetypes[suffix]:
        with tempfile.TemporaryDirectory(prefix="flexact-") as folder:
            path = Path(folder) / f"mesh{suffix}"
            try:
                with _in_silence():
                    meshio.write(path, mesh, file_format=form)
                return path.read_bytes(), _lost(mesh, path, form)
            except MemoryError:
                raise
            except (Exception, SystemExit) as error:
                reason = " ".join(str(error).split())[:200] or type(error).__name__
    raise MeshError(f"meshio writes no {suffix} of lines: {reason}; try .vtu or .vtk")


def _lost(mesh: Any, path: Path, form: str) -> tuple[str, ...]:
    """Names of the data that a file has lost, with what of the points it has."""
    if len(list(path.parent.iterdir())) > 1:
        raise MeshError("the mesh is several files")
    with _in_silence():
        again = _meshio().read(path, file_format=form)
    lines = sum(len(cells.data) for cells in again.cells if cells.type == "line")
    if lines != sum(len(cells.data) for cells in mesh.cells):
        raise MeshError("it holds no lines")
    lost = [name for name in mesh.point_data if name not in again.point_data]
    lost += [name for name in mesh.cell_data if name not in again.cell_data]
    if not np.array_equal(np.asarray(again.points, float), mesh.points):
        lost.append("the last digits of coordinates")
    return tuple(lost)


@contextlib.contextmanager
def _in_silence() -> Iterator[io.StringIO]:
    """Keep what meshio prints from who reads results; it prints why it fails."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        yield said


def _meshio() -> ModuleType:
    try:
        return import_module("meshio")
    except ImportError as error:
        raise MeshError(f"meshes need the package meshio: pip install meshio ({error})") from error
