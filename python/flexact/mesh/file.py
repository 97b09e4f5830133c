"""Mesh files through meshio: which format, and the bytes of the file."""

from __future__ import annotations

import contextlib
import io
import shutil
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from ..batch import SUFFIX, reason_of
from ..interruption import undisturbed
from ..outputs import OutputError

if TYPE_CHECKING:
    import meshio

    from .content import Mesh

# Known to hold every cell and every array; what other formats hold is looked at.
COMPLETE = ("vtu", "vtk", "xdmf")

OPTIONS = {"xdmf": {"data_format": "XML"}}


class MeshFormatError(OutputError):
    """A mesh format is not known, lacks a package, or cannot hold what is to be written."""


class MeshPackageError(MeshFormatError):
    """A format needs a package that is not there."""


@dataclass(frozen=True)
class MeshFormat:
    """A format of meshio: a file's suffix with its dot, and meshio's names for it."""

    suffix: str
    names: tuple[str, ...]


def find_format(name: str) -> MeshFormat:
    """The format that has this name or suffix, if it can hold lines and quads with data.

    Raises:
        MeshFormatError: meshio has none, it cannot hold them, or a package is not installed.
    """
    suffix, names = _look_up(name)
    usable, reasons = [], []
    for each in names:
        try:
            _try_out(each, suffix)
            usable.append(each)
        except MeshPackageError as error:
            reasons.append(str(error))
        except MeshFormatError:
            reasons.append(f"mesh format {each} cannot hold lines and quads with data")
    if usable:
        return MeshFormat(suffix, tuple(usable))
    raise MeshFormatError(f"{'; '.join(reasons)}; {' or '.join(COMPLETE)} will do")


def _look_up(name: str) -> tuple[str, tuple[str, ...]]:
    # What is written is not to be taken for a deck.
    known = {k: v for k, v in _meshio().extension_to_filetypes.items() if k != SUFFIX}
    name = name.lower().lstrip(".")
    suffix = f".{name}"
    if suffix in known:
        return suffix, tuple(known[suffix])
    for suffix, names in known.items():
        if name in names:
            return suffix, (name,)
    every = sorted({each for names in known.values() for each in names})
    raise MeshFormatError(
        f"mesh format {name!r} is not known; there are {', '.join(every)}; "
        f"{' or '.join(COMPLETE)} will do"
    )


def _try_out(name: str, suffix: str) -> None:
    """Write a line and a quad with the data that every mesh has."""
    from .content import Mesh

    if name in COMPLETE:
        return
    points = np.arange(18.0).reshape(-1, 3)
    mesh = Mesh(
        points,
        (np.zeros((0, 1), np.int64), np.array([[0, 1]]), np.array([[2, 3, 4, 5]])),
        point_data={"displacement": points + 1.0, "node": np.arange(6)},
        cell_data={"element": np.array([7, 9]), "kind": np.array([1, 2])},
        names=("", ""),
        element=np.array([0, 1]),
    )
    try:
        _written(mesh, name, suffix)
    except MeshFormatError:
        raise
    except OutputError:
        # The disk's fault, not the format's; each deck tells of it behind its verdict.
        return


def mesh_bytes(mesh: Mesh, form: MeshFormat) -> bytes:
    """The file that holds a mesh, and that meshio reads: without names.

    Raises:
        MeshFormatError: The format cannot hold the mesh or its data, or needs a package.
        OutputError: The temporary folder cannot be written to.
    """
    reasons = []
    for name in form.names:
        try:
            return _written(mesh, name, form.suffix)
        except MeshFormatError as error:
            reasons.append(str(error))
    raise MeshFormatError("; ".join(reasons))


def _meshio() -> ModuleType:
    try:
        return import_module("meshio")
    except ImportError as error:
        raise MeshPackageError(
            f"mesh files need the package meshio: pip install meshio ({error})"
        ) from error


def _written(mesh: Mesh, name: str, suffix: str) -> bytes:
    remarks = io.StringIO()
    try:
        with (
            contextlib.redirect_stdout(remarks),
            contextlib.redirect_stderr(remarks),
            _temporary_folder() as folder,
            _placeholder_for_h5py(name),
        ):
            path = folder / f"mesh{suffix}"
            made = mesh.to_meshio()
            if name == "gmsh":
                made = _tagged(made)
            _meshio().write(path, made, file_format=name, **OPTIONS.get(name, {}))
            if (files := len(list(folder.iterdir()))) != 1:
                raise MeshFormatError(f"it takes {files} files instead of one")
            if name not in COMPLETE:
                _check_held(mesh.to_meshio(), _meshio().read(path, file_format=name))
            return path.read_bytes()
    # meshio's writers fail in ways of their own: KeyError, AssertionError, sys.exit ...
    except (Exception, SystemExit) as error:
        raise _explained(error, name, " ".join(remarks.getvalue().split())) from error


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


def _explained(error: BaseException, name: str, remarks: str) -> OutputError:
    """What a failure of meshio's means to the one who wants the file."""
    if isinstance(error, MemoryError):
        return OutputError("there is not enough memory for the mesh")
    if isinstance(error, OSError) and error.errno is not None:
        reason = reason_of(error)
        return OutputError(f"the mesh cannot be written to a temporary folder: {reason}")
    if isinstance(error, ImportError):
        package = error.name.partition(".")[0] if error.name else f"that fails: {error}"
        return MeshPackageError(f"mesh format {name} needs the package {package}")
    told = isinstance(error, MeshFormatError) or type(error).__name__ == "WriteError"
    reason = str(error) if told else f"meshio fails to write it ({str(error) or 'it says not why'})"
    what = "; meshio: ".join(filter(None, (reason, remarks)))
    return MeshFormatError(f"mesh format {name} cannot hold this scene: {what}")


def _tagged(mesh: meshio.Mesh) -> meshio.Mesh:
    """The mesh with the entities that gmsh wants: one for the cells of a shape."""
    tagged = mesh.copy()
    entity = np.ones((len(mesh.points), 2), dtype=np.int32)
    for block in mesh.cells:
        entity[block.data.ravel(), 0] = block.dim
    tagged.point_data["gmsh:dim_tags"] = entity
    for tag in ("gmsh:physical", "gmsh:geometrical"):
        tagged.cell_data[tag] = [np.ones(len(block), dtype=np.int32) for block in mesh.cells]
    return tagged


def _check_held(mesh: meshio.Mesh, back: meshio.Mesh) -> None:
    cells = [{block.type: len(block.data) for block in each.cells} for each in (mesh, back)]
    if cells[0] != cells[1] or len(mesh.points) != len(back.points):
        raise MeshFormatError("it loses cells or points")
    for name, values in mesh.point_data.items():
        if name not in back.point_data or not np.allclose(values, back.point_data[name]):
            raise MeshFormatError(f"it loses {name}")
    for name in mesh.cell_data:
        # A format may have the shapes in an order of its own.
        if name not in back.cell_data or not all(
            np.allclose(mesh.get_cell_data(name, shape), back.get_cell_data(name, shape))
            for shape in cells[0]
        ):
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
