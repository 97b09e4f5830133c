# SPDX-License-Identifier: BSD-3-Clause
"""Which format a file's suffix means, and models from and to files of any of them."""

from __future__ import annotations

import stat
from collections.abc import Iterable
from enum import Enum
from pathlib import Path

from ...deck.diagnostics import Diagnostic
from ...model.model import Model
from ...model.reading import read, read_text
from ...util.errors import BatchError, reason_of
from .mesh_files import MeshError, mesh_bytes, mesh_of, model_of_mesh, read_mesh, suffixes
from .tables import model_of, tables_of
from .text import JSON, YAML, read_tables, text_of

DECK = (".dat",)
#: Larger files are no tables that somebody has written.
_MOST_BYTES = 2**30
#: So much a file may have grown since its size was asked for.
_PIECE = 2**20


class Format(Enum):
    """What a file holds."""

    DECK = "deck"
    TABLES = "tables"
    MESH = "mesh"


class FormatError(BatchError):
    """A file of no known format, or one that cannot be read."""


def format_of(path: Path) -> Format:
    """The format that a file's suffix means.

    Raises:
        FormatError: there is none.
    """
    suffix = path.suffix.lower()
    if suffix in DECK:
        return Format.DECK
    if suffix in (*JSON, *YAML):
        return Format.TABLES
    try:
        if suffix in suffixes():
            return Format.MESH
    except MeshError as error:
        raise FormatError(f"{path}: {error}") from error
    raise FormatError(
        f"the suffix of {path} says no format: decks are .dat, tables .json or .yaml, "
        "meshes .vtu, .vtk, .msh and others that meshio knows"
    )


def read_any(
    path: Path, *, flexible: str = "independent", kind: str = "beam", fixed: Iterable[int] = ()
) -> Model:
    """The model in a file; what it does not hold stands in `Model.diagnostics`.

    Args:
        path: Its suffix says what it is.
        flexible: Of tables, see `flexact.apps.convert.tables.model_of`.
        kind: Of meshes, see `flexact.apps.convert.mesh_files.model_of_mesh`.
        fixed: Likewise.

    Raises:
        FlexactError: anything is wrong with the file; all of it, each with its place.
    """
    form = format_of(path)
    if form is Format.DECK:
        return read(path)
    if form is Format.MESH:
        return model_of_mesh(read_mesh(path), kind=kind, fixed=fixed, name=path.stem)
    try:
        # A pipe or a device may keep whoever reads it for ever.
        found = path.stat()
        if not stat.S_ISREG(found.st_mode) and not stat.S_ISDIR(found.st_mode):
            raise FormatError(f"{path}: this is not a regular file; write the tables to one first")
        if found.st_size > _MOST_BYTES:
            raise FormatError(f"{path}: tables larger than a gigabyte are not read")
        with open(path, "rb") as file:
            raw = file.read(found.st_size + _PIECE)
    except OSError as error:
        raise FormatError(f"{path}: the file cannot be read: {reason_of(error)}") from error
    return _of_tables(raw, path, flexible)


def read_content(raw: bytes, name: str, *, flexible: str = "independent") -> Model:
    """The model in a text without a suffix: JSON tables if it begins with a brace, else a deck.

    Args:
        raw: The text.
        name: What it is called.
        flexible: As of `read_any`.

    Raises:
        FlexactError: anything is wrong with it.
    """
    if form_of_content(raw) is Format.TABLES:
        return _of_tables(raw, Path(f"{name}{JSON[0]}"), flexible)
    return read_text(raw, name)


def form_of_content(raw: bytes) -> Format:
    """What a text without a suffix is."""
    return Format.TABLES if raw.lstrip()[:1] == b"{" else Format.DECK


def _of_tables(raw: bytes, path: Path, flexible: str) -> Model:
    tables, text = read_tables(raw, str(path), path.suffix.lower())
    return model_of(tables, flexible=flexible, name=path.stem, text=text)


def bytes_of(model: Model, path: Path) -> tuple[bytes, tuple[Diagnostic, ...]]:
    """The content of a file that holds a model, and notes of what it does not hold.

    Args:
        model: The model.
        path: Its suffix says what it is to be.

    Raises:
        FlexactError: the model is wrong, or the format cannot hold it.
    """
    form = format_of(path)
    if form is Format.DECK:
        return model.to_deck().encode("utf-8"), ()
    if form is Format.TABLES:
        remarks: list[Diagnostic] = []
        made = text_of(tables_of(model, remarks), path.suffix.lower())
        return made.encode("utf-8"), tuple(remarks)
    mesh, noted = mesh_of(model)
    content, lost = mesh_bytes(mesh, path.suffix.lower())
    for name in lost:
        noted.lost[f"{name}, which a {path.suffix} does not keep"] += 1
    return content, noted.diagnostics()
