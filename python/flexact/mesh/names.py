"""Names of cells in VTK's XML files, which meshio can neither write nor read."""

from __future__ import annotations

import base64
import zlib
from typing import TYPE_CHECKING

import numpy as np

from .file import mesh_bytes

if TYPE_CHECKING:
    from .content import Mesh
    from .file import MeshFormat

#: Where meshio begins the data of the cells and of the points; no data look like it.
_CELLS = b"<CellData>\n"
_POINTS = b"<PointData>\n"
_ARRAY = b'<DataArray type="String" Name="name" NumberOfComponents="1" format="binary">\n'
#: Bytes of a block that is compressed by itself, as meshio has it.
_BLOCK = 32_768


def named_bytes(mesh: Mesh, form: MeshFormat) -> bytes:
    """The file that holds a mesh, a .vtu file with the names of the cells.

    Raises:
        MeshFormatError: The format cannot hold the mesh or its data, or needs a package.
        OutputError: The temporary folder cannot be written to.
    """
    content = mesh_bytes(mesh, form)
    return _with_names(content, mesh) if form.names == ("vtu",) else content


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
