# SPDX-License-Identifier: BSD-3-Clause
"""Files of meshes through meshio, with errors in words whatever a file holds."""

from __future__ import annotations

import contextlib
import io
import tempfile
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

from ..base.errors import BatchError


class MeshError(BatchError):
    """A mesh that cannot be read, written or taken for a mechanism."""


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
        # It prints why it fails, and ends the process.
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            return meshio.read(path)
    except MemoryError:
        raise
    except (Exception, SystemExit) as error:
        words = str(error) if isinstance(error, Exception) else ""
        words = words or next(iter(said.getvalue().strip().splitlines()), "")
        reason = " ".join(words.split())[:200] or type(error).__name__
        raise MeshError(f"{path}: meshio cannot read this mesh: {reason}") from error


def mesh_bytes(mesh: Any, suffix: str) -> tuple[bytes, tuple[str, ...]]:
    """The file that holds a mesh, and names of the data that it lost.

    Raises:
        MeshError: meshio has no such format or cannot write this one, or is missing.
    """
    meshio = _meshio()
    if suffix not in suffixes():
        raise MeshError(f"meshio writes no {suffix or 'file without a suffix'}: try .vtu or .vtk")
    said = io.StringIO()
    with tempfile.TemporaryDirectory(prefix="flexact-") as folder:
        path = Path(folder) / f"mesh{suffix}"
        try:
            with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
                meshio.write(path, mesh)
        except MemoryError:
            raise
        except (Exception, SystemExit) as error:
            reason = " ".join(str(error).split())[:200] or type(error).__name__
            words = f"meshio cannot write a {suffix} of lines with data: {reason}; try .vtu or .vtk"
            raise MeshError(words) from error
        if len(list(path.parent.iterdir())) > 1:
            raise MeshError(f"a {suffix} is several files: try .vtu or .vtk")
        content = path.read_bytes()
        try:
            again = read_mesh(path)
        except MeshError:
            return content, (*mesh.point_data, *mesh.cell_data)
    lost = [name for name in mesh.point_data if name not in again.point_data]
    lost += [name for name in mesh.cell_data if name not in again.cell_data]
    return content, tuple(lost)


def _meshio() -> ModuleType:
    try:
        return import_module("meshio")
    except ImportError as error:
        raise MeshError(f"meshes need the package meshio: pip install meshio ({error})") from error
