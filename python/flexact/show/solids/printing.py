# SPDX-License-Identifier: BSD-3-Clause
"""Solids as closed surfaces of triangles, in mm: 3MF with names and colours, and binary STL.

3MF is that of the 3MF Consortium, Core Specification 1.3: an object for each solid, products and
the whole as components. Nothing in a file depends on when or where it is written.
"""

from __future__ import annotations

import io
import zipfile
from collections.abc import Sequence
from xml.sax.saxutils import quoteattr

import numpy as np

from .step import Item

_MM = 1000.0

_TYPES = (
    '<?xml version="1.0" encoding="UTF-8"?>\n'
    '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">'
    '<Default Extension="rels" '
    'ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    '<Default Extension="model" '
    'ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>\n'
)
_RELATIONS = (
    '<?xml version="1.0" encoding="UTF-8"?>\n'
    '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
    '<Relationship Target="/3D/3dmodel.model" Id="model" '
    'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>\n'
)
#: The first time that a zip file can tell.
_THEN = (1980, 1, 1, 0, 0, 0)


def threemf_bytes(name: str, items: Sequence[Item], notes: Sequence[str] = ()) -> bytes:
    """The 3MF file of an assembly.

    Args:
        name: Of the assembly.
        items: Its products.
        notes: What is to be said of it.
    """
    low = np.full(3, np.inf)
    colours: list[str] = []
    objects: list[str] = []
    parts: list[int] = []

    def add(kind: str, content: str) -> int:
        # Number 1 is that of the colours.
        number = len(objects) + 2
        objects.append(f'<object id="{number}" type="model" {kind}>{content}</object>\n')
        return number

    def of_parts(numbers: Sequence[int]) -> str:
        told = "".join(f'<component objectid="{number}"/>' for number in numbers)
        return f"<components>{told}</components>"

    for called, names, shapes, colour, opacity in items:
        shown = np.clip(np.round(np.append(colour, opacity) * 255.0), 0, 255).astype(int)
        hue = f"#{''.join(f'{each:02X}' for each in shown.tolist())}"
        if hue not in colours:
            colours.append(hue)
        solids = []
        for own, shape in zip(names, shapes, strict=True):
            points, triangles = shape.triangulated()
            low = np.minimum(low, points.min(axis=0) * _MM)
            vertices = "".join(
                f'<vertex x="{x!r}" y="{y!r}" z="{z!r}"/>' for x, y, z in (points * _MM).tolist()
            )
            faces = "".join(
                f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in triangles.tolist()
            )
            solids.append(
                add(
                    f'name={_quoted(own)} pid="1" pindex="{colours.index(hue)}"',
                    f"<mesh><vertices>{vertices}</vertices><triangles>{faces}</triangles></mesh>",
                )
            )
        whole = solids[0] if len(solids) == 1 else add(f"name={_quoted(called)}", of_parts(solids))
        parts.append(whole)
    root = add(f"name={_quoted(name)}", of_parts(parts))
    materials = "".join(
        f'<base name="colour {k}" displaycolor="{hue}"/>' for k, hue in enumerate(colours, 1)
    )
    # What is printed has no negative coordinates; the solids have those of the model.
    shift = " ".join(repr(float(each)) for each in np.where(low < 0.0, -low, 0.0))
    told = "".join(
        f"<metadata name={quoteattr(key)}>{_quoted(text)[1:-1]}</metadata>\n"
        for key, text in (
            ("Title", name),
            ("Application", "Flexact"),
            *((("Description", " ".join(notes)),) if notes else ()),
        )
    )
    model = (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<model unit="millimeter" xml:lang="en-US" '
        'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">\n'
        f'{told}<resources>\n<basematerials id="1">{materials}</basematerials>\n'
        f"{''.join(objects)}</resources>\n"
        f'<build><item objectid="{root}" transform="1 0 0 0 1 0 0 0 1 {shift}"/></build>\n'
        "</model>\n"
    )
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, text in (
            ("[Content_Types].xml", _TYPES),
            ("_rels/.rels", _RELATIONS),
            ("3D/3dmodel.model", model),
        ):
            entry = zipfile.ZipInfo(path, _THEN)
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, text.encode("utf-8", "replace"))
    return packed.getvalue()


def _quoted(text: str) -> str:
    """A text as a value in XML, without characters that XML cannot spell."""
    allowed = "".join(c if c >= " " and c not in "\ufffe\uffff" else " " for c in text)
    return quoteattr(allowed, {'"': "&quot;"})


def stl_bytes(name: str, items: Sequence[Item], notes: Sequence[str] = ()) -> bytes:
    """The binary STL file of an assembly, all solids in one; it has no place for notes."""
    del notes
    surfaces = [shape.triangulated() for _, _, shapes, _, _ in items for shape in shapes]
    corners = np.concatenate([points[faces] * _MM for points, faces in surfaces])
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(normal, axis=1, keepdims=True)
    record = np.zeros(
        len(corners), np.dtype([("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("more", "<u2")])
    )
    record["normal"] = normal / np.where(size > 0.0, size, 1.0)
    record["corner"] = corners
    head = f"Flexact, mm: {name}".encode("ascii", "replace")[:80].ljust(80)
    return head + np.uint32(len(corners)).tobytes() + record.tobytes()
