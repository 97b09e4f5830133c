# SPDX-License-Identifier: BSD-3-Clause
"""STEP files as OpenCASCADE reads them: what files of solids are tested against."""

from pathlib import Path
from typing import Any, NamedTuple

import pytest

pytest.importorskip("OCP")

from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps
from OCP.OCP.collections import Sequence_TDF_Label
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.STEPControl import STEPControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_SHELL, TopAbs_SOLID
from OCP.TopExp import TopExp_Explorer
from OCP.XCAFDoc import XCAFDoc_DocumentTool


class Read(NamedTuple):
    """A component of an assembly: its name, and its solids."""

    name: str
    solids: list[Any]


def solids_in(shape: Any) -> list[Any]:
    found, explorer = [], TopExp_Explorer(shape, TopAbs_SOLID)
    while explorer.More():
        found.append(explorer.Current())
        explorer.Next()
    return found


def read_step(path: Path) -> list[Any]:
    """All solids, with the plain reader."""
    reader = STEPControl_Reader()
    reader.ReadFile(str(path))
    reader.TransferRoots()
    return solids_in(reader.OneShape())


def read_assembly(path: Path) -> tuple[str, list[Read]]:
    """The name of the whole and its components, with the reader that knows names."""
    document = TDocStd_Document(TCollection_ExtendedString("x"))
    reader = STEPCAFControl_Reader()
    reader.SetNameMode(True)
    reader.ReadFile(str(path))
    reader.Transfer(document)
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    roots = Sequence_TDF_Label()
    tool.GetFreeShapes(roots)
    (root,) = (roots.Value(k) for k in range(1, roots.Length() + 1))
    parts = Sequence_TDF_Label()
    tool.GetComponents_s(root, parts)
    labels = [parts.Value(k) for k in range(1, parts.Length() + 1)]
    return _name(root), [Read(_name(label), solids_in(tool.GetShape_s(label))) for label in labels]


def _name(label: Any) -> str:
    found = TDataStd_Name()
    assert label.FindAttribute(TDataStd_Name.GetID_s(), found)
    return str(found.Get().ToExtString())


def volume(solid: Any) -> float:
    """In mm3; negative where the shell is turned inside out."""
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(solid, properties)
    return float(properties.Mass())


def is_sound(solid: Any) -> bool:
    """Whether it is valid, closed and the right way round."""
    shells = TopExp_Explorer(solid, TopAbs_SHELL)
    closed = True
    while shells.More():
        closed &= bool(shells.Current().Closed())
        shells.Next()
    return closed and bool(BRepCheck_Analyzer(solid).IsValid()) and volume(solid) > 0.0


def distance(one: Any, other: Any) -> float:
    """In mm."""
    return float(BRepExtrema_DistShapeShape(one, other).Value())


def shared(one: Any, other: Any) -> float:
    """Volume of what they have in common [mm3]."""
    return volume(BRepAlgoAPI_Common(one, other).Shape())
