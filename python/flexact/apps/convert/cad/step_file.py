# SPDX-License-Identifier: BSD-3-Clause
"""The solids of a STEP file with their names, places, colours and materials, by OpenCASCADE.

Loaded in the child process alone.
"""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import numpy as np
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher as Shapes
from OCP.collections import Sequence_TDF_Label
from OCP.IFSelect import IFSelect_RetDone
from OCP.Message import Message
from OCP.Quantity import Quantity_Color
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name, TDataStd_TreeNode
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_FACE, TopAbs_SHELL, TopAbs_SOLID
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Shape
from OCP.XCAFDoc import (
    XCAFDoc,
    XCAFDoc_ColorGen,
    XCAFDoc_ColorSurf,
    XCAFDoc_DocumentTool,
    XCAFDoc_Material,
    XCAFDoc_ShapeTool,
)

from ....model.names import one_line, part_name
from ....util.errors import BatchError
from .brep import Part, each

#: Assemblies stand in each other no deeper.
_DEPTH = 60
#: An assembly of more solids is no mechanism that is looked at by hand.
MOST_SOLIDS = 2000
#: Solids of more faces are not checked, which takes long.
_MOST_FACES = 500
#: Solids in the text of a file.
_SOLID = re.compile(rb"=\s*(?:MANIFOLD_SOLID_BREP|BREP_WITH_VOIDS|FACETED_BREP)\s*\(")
#: What translators write where there is no name.
_NO_NAME = re.compile(
    r"^(|NAUO\d+|=>\[.*\]|open cascade step translator.*|"
    r"(compound|solid|shape|product|unnamed|noname|none)|"
    r"(compound|solid|shape|shell|product|assembly)[ _.-]?\d+)$",
    re.I,
)


def parts_of(path: Path) -> tuple[list[Part], list[str], list[str]]:
    """Solids of a file in mm, doubts, and remarks.

    Raises:
        BatchError: it is no STEP file, or holds no solids.
    """
    for printer in list(Message.DefaultMessenger_s().Printers()):
        Message.DefaultMessenger_s().RemovePrinter(printer)
    reader = STEPCAFControl_Reader()
    reader.SetNameMode(True)
    reader.SetColorMode(True)
    reader.SetMatMode(True)
    if reader.ReadFile(str(path)) != IFSelect_RetDone:
        raise BatchError("this is no STEP file that OpenCASCADE can read: export it again")
    text = path.read_bytes()
    doubts, remarks = _units(text)
    stated = len(_SOLID.findall(text))
    del text
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    XCAFDoc_DocumentTool.SetLengthUnit_s(document, 0.001)
    if not reader.Transfer(document):
        raise BatchError("the file holds no shapes: export solids, not an empty assembly")
    main = document.Main()
    tool = XCAFDoc_DocumentTool.ShapeTool_s(main)
    walk = _Walk(main)
    free = Sequence_TDF_Label()
    tool.GetFreeShapes(free)
    for k in range(1, free.Length() + 1):
        walk.enter(free.Value(k), TopLoc_Location(), (), "", 0)
    parts = [part for part in walk.parts if np.isfinite(part.volume) and part.volume > 0.0]
    for part in walk.parts:
        if part not in parts:
            doubts.append(f"{part.name or 'a solid'} has no volume and is left out")
    parts = _once(parts, doubts)
    different = Shapes()
    for part in walk.parts:
        different.Add(part.shape.Located(TopLoc_Location()))
    if different.Extent() < stated:
        doubts.append(
            f"the file has {stated} solids, of which {different.Extent()} could be read: export it "
            "again"
        )
    for name in walk.empty:
        doubts.append(f"{name} has no shape in the file")
    if walk.surfaces:
        doubts.append(
            f"{walk.surfaces} surfaces of the file enclose no solid and are left out: "
            "export solid bodies where they matter"
        )
    if not parts:
        raise BatchError(
            "the file holds no solids, only "
            + ("surfaces" if walk.surfaces else "curves or nothing")
            + ": export solid bodies (AP214 or AP242)"
        )
    _name(parts)
    _require_size(parts, doubts)
    for part in parts:
        if len(part.faces) < _MOST_FACES and not BRepCheck_Analyzer(part.shape).IsValid():
            doubts.append(f"{part.name or 'a solid'} is no sound solid: export it again")
    return parts, doubts, remarks


def _units(text: bytes) -> tuple[list[str], list[str]]:
    """What is to be said of units: a doubt, or a remark where they are not millimetres."""
    names = {
        prefix.lower() + b"metre"
        for prefix in re.findall(rb"SI_UNIT\s*\(\s*(?:\.(\w+)\.|\$)\s*,\s*\.METRE\.", text)
    }
    if b"LENGTH_UNIT" not in text or b"GLOBAL_UNIT_ASSIGNED_CONTEXT" not in text:
        return ["the file gives no unit of length: it is taken as mm"], []
    converted = re.findall(
        rb"CONVERSION_BASED_UNIT\s*\(\s*'(\w+)'[^;]*?LENGTH_UNIT|"
        rb"LENGTH_UNIT[^;]*?CONVERSION_BASED_UNIT\s*\(\s*'(\w+)'",
        text,
    )
    others = {(a or b).lower() for a, b in converted}
    # What is converted is so from a unit that stands there, too.
    used = others or names
    if not used:
        return ["the unit of length of the file is not known: it is taken as mm"], []
    if used == {b"millimetre"}:
        return [], []
    words = ", ".join(sorted(name.decode("ascii", "replace") for name in used))
    if len(used) > 1:
        return [f"the file has lengths in several units: {words}"], []
    return [], [f"lengths of the file are in {words}"]


def _once(parts: list[Part], doubts: list[str]) -> list[Part]:
    """Solids without those that are there a second time, at the same place."""
    kept: dict[tuple[float, ...], Part] = {}
    for part in parts:
        volume, centre, inertia = part.mass
        key = (
            float(f"{volume:.6g}"),
            *np.round(centre, 3),
            *np.round(inertia[np.triu_indices(3)] / volume, 2) + 0.0,
        )
        if key in kept:
            doubts.append(f"{part.name or 'a solid'} is there twice, and counts once")
        kept.setdefault(key, part)
    return list(kept.values())


def _require_size(parts: list[Part], doubts: list[str]) -> None:
    """Note a doubt where an assembly is larger or smaller than mechanisms are.

    Raises:
        BatchError: it is so by far.
    """
    boxes = np.array([part.box for part in parts])
    size = 1e-3 * float(np.linalg.norm(boxes[:, 1].max(0) - boxes[:, 0].min(0)))
    if not 1e-6 < size < 1e3:
        raise BatchError(f"the assembly measures {size:.3g} m: correct the unit of length")
    if not 5e-4 < size < 20.0:
        doubts.append(f"the assembly measures {size:.3g} m: is the unit of length right?")


class _Walk:
    """What is found on the way through an assembly."""

    def __init__(self, main: TDF_Label) -> None:
        """At the start."""
        self.parts: list[Part] = []
        self.instances: list[str] = []
        self.surfaces = 0
        self.empty: list[str] = []
        self.colours = XCAFDoc_DocumentTool.ColorTool_s(main)

    def enter(
        self,
        label: TDF_Label,
        place: TopLoc_Location,
        path: tuple[str, ...],
        instance: str,
        depth: int,
    ) -> None:
        """Take what a label holds.

        Raises:
            BatchError: there is too much of it.
        """
        if depth > _DEPTH or len(self.parts) > MOST_SOLIDS:
            raise BatchError(
                f"assemblies stand in each other more than {_DEPTH} deep, or have more than "
                f"{MOST_SOLIDS} solids: export the mechanism alone"
            )
        name = _name_of(label)
        if XCAFDoc_ShapeTool.IsAssembly_s(label):
            inside = Sequence_TDF_Label()
            XCAFDoc_ShapeTool.GetComponents_s(label, inside)
            for k in range(1, inside.Length() + 1):
                component, target = inside.Value(k), TDF_Label()
                if XCAFDoc_ShapeTool.GetReferredShape_s(component, target):
                    at = place.Multiplied(XCAFDoc_ShapeTool.GetLocation_s(component))
                    self.enter(target, at, (*path, name), _name_of(component), depth + 1)
            return
        shape = XCAFDoc_ShapeTool.GetShape_s(label)
        if shape is None or shape.IsNull():
            if name:
                self.empty.append(name)
            return
        whole = shape.Moved(place)
        solids = list(each(whole, TopAbs_SOLID)) or list(_closed(whole))
        if not solids:
            faces = sum(1 for _ in each(whole, TopAbs_FACE))
            self.surfaces += faces
            if not faces and name:
                self.empty.append(name)
            return
        material, density = _material(label)
        for solid in solids:
            colour = self._colour(label, solid)
            made = Part(solid, name, name, path, colour, material, density)
            if made.volume < 0.0:
                made = Part(solid.Reversed(), name, name, path, colour, material, density)
            self.parts.append(made)
            self.instances.append(instance)

    def _colour(self, label: TDF_Label, shape: TopoDS_Shape) -> tuple[float, ...]:
        colour = Quantity_Color()
        for kind in (XCAFDoc_ColorSurf, XCAFDoc_ColorGen):
            if self.colours.GetColor_s(label, kind, colour):
                return colour.Red(), colour.Green(), colour.Blue()
        return ()


def _closed(shape: TopoDS_Shape) -> list[TopoDS_Shape]:
    """Solids of closed shells."""
    made = []
    for shell in each(shape, TopAbs_SHELL):
        if shell.Closed():
            made.append(BRepBuilderAPI_MakeSolid(TopoDS.Shell(shell)).Solid())
    return made


def _name_of(label: TDF_Label) -> str:
    name = TDataStd_Name()
    if not label.FindAttribute(TDataStd_Name.GetID_s(), name):
        return ""
    text = one_line(" ".join(str(name.Get().ToExtString()).split()))[:80]
    # In models "plate, 2" and "plate 1 of 2" are pieces of a plate.
    if (head := part_name(text)) != text:
        text = f"{head} ({text[len(head) :].lstrip(', ')})"
    return "" if _NO_NAME.match(text) else text


def _material(label: TDF_Label) -> tuple[str, float]:
    """Name and density [kg/m3] of a material; "" and 0 where the file has none."""
    node, found = TDataStd_TreeNode(), XCAFDoc_Material()
    reference = XCAFDoc.MaterialRefGUID_s()
    # Asked for what is not there, the binding ends the process.
    if not label.IsAttribute(reference) or not label.FindAttribute(reference, node):
        return "", 0.0
    if not node.HasFather():
        return "", 0.0
    if not node.Father().Label().FindAttribute(XCAFDoc_Material.GetID_s(), found):
        return "", 0.0
    name = found.GetName()
    density = float(found.GetDensity())
    # In g/cm3 by the manual of XDE; some files have it in kg/m3, or in g/mm3.
    factors = ((0.0, 0.05, 1e6), (0.05, 50.0, 1e3), (50.0, 5e4, 1.0))
    made = next((density * f for low, high, f in factors if low < density <= high), 0.0)
    return ("" if name is None else str(name.ToCString()).strip()), made


def _name(parts: list[Part]) -> None:
    """Tell parts of one name apart by numbers."""
    many = Counter(part.name for part in parts)
    seen: Counter[str] = Counter()
    taken = set(many)
    for part in parts:
        if part.name and many[part.name] > 1:
            base = part.name
            while True:
                seen[base] += 1
                part.name = f"{base} {seen[base]}"
                if part.name not in taken:
                    break
