# SPDX-License-Identifier: BSD-3-Clause
"""Solids and STEP files by OpenCASCADE directly, without a line of Flexact; lengths in mm."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from OCP.Bnd import Bnd_Box
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common, BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepBuilderAPI import (
    BRepBuilderAPI_MakeEdge,
    BRepBuilderAPI_MakeFace,
    BRepBuilderAPI_MakePolygon,
    BRepBuilderAPI_MakeWire,
    BRepBuilderAPI_Transform,
)
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepClass3d import BRepClass3d_SolidClassifier
from OCP.BRepFilletAPI import BRepFilletAPI_MakeChamfer, BRepFilletAPI_MakeFillet
from OCP.BRepGProp import BRepGProp
from OCP.BRepLib import BRepLib
from OCP.BRepOffsetAPI import BRepOffsetAPI_MakePipeShell
from OCP.BRepPrimAPI import (
    BRepPrimAPI_MakeBox,
    BRepPrimAPI_MakeCylinder,
    BRepPrimAPI_MakePrism,
    BRepPrimAPI_MakeSphere,
)
from OCP.BRepTools import BRepTools
from OCP.collections import Array1_gp_Pnt, Array2_gp_Pnt, List_TopoDS_Shape
from OCP.GC import GC_MakeArcOfCircle
from OCP.Geom import Geom_BSplineSurface, Geom_CylindricalSurface
from OCP.Geom2d import Geom2d_Line
from OCP.GeomAPI import GeomAPI_PointsToBSpline, GeomAPI_PointsToBSplineSurface
from OCP.gp import (
    gp_Ax1,
    gp_Ax2,
    gp_Ax3,
    gp_Circ,
    gp_Dir,
    gp_Dir2d,
    gp_Pnt,
    gp_Pnt2d,
    gp_Trsf,
    gp_Vec,
)
from OCP.GProp import GProp_GProps
from OCP.IFSelect import IFSelect_RetDone
from OCP.Interface import Interface_Static
from OCP.Message import Message
from OCP.ShapeUpgrade import ShapeUpgrade_UnifySameDomain
from OCP.STEPCAFControl import STEPCAFControl_Writer
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_EDGE, TopAbs_IN, TopAbs_ON, TopAbs_SOLID
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Shape
from OCP.XCAFDoc import XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

Vector = Sequence[float]

# What OpenCASCADE says of each transfer is of no use here.
for _printer in list(Message.DefaultMessenger_s().Printers()):
    Message.DefaultMessenger_s().RemovePrinter(_printer)


def point(p: Vector) -> gp_Pnt:
    return gp_Pnt(*map(float, p))


def vector(v: Vector) -> gp_Vec:
    return gp_Vec(*map(float, v))


def box(x: Vector, y: Vector, z: Vector) -> TopoDS_Shape:
    """A box between two values of each coordinate."""
    low, high = zip(x, y, z, strict=True)
    return BRepPrimAPI_MakeBox(point(low), point(high)).Shape()


def cylinder(p: Vector, q: Vector, diameter: float) -> TopoDS_Shape:
    """A round rod from p to q."""
    axis = np.subtract(q, p)
    place = gp_Ax2(point(p), gp_Dir(*map(float, axis)))
    return BRepPrimAPI_MakeCylinder(place, diameter / 2, float(np.linalg.norm(axis))).Shape()


def plate(
    p: Vector, q: Vector, across: Vector, width: float, thickness: float, more: float = 0.0
) -> TopoDS_Shape:
    """A straight plate about the line from p to q, longer by `more` at both ends."""
    p, q = np.asarray(p, float), np.asarray(q, float)
    along = (q - p) / np.linalg.norm(q - p)
    across = np.asarray(across, float) / np.linalg.norm(across)
    p, q = p - more * along, q + more * along
    sides = (
        [p + s * width / 2 * across for s in (-1, 1)],
        [q + s * width / 2 * across for s in (1, -1)],
    )
    normal = np.cross(along, across)
    corners = [c - thickness / 2 * normal for c in (*sides[0], *sides[1])]
    return prism(corners, thickness * normal)


def prism(corners: Sequence[Vector], height: Vector) -> TopoDS_Shape:
    """What a polygon sweeps along a vector."""
    polygon = BRepBuilderAPI_MakePolygon()
    for corner in corners:
        polygon.Add(point(corner))
    polygon.Close()
    face = BRepBuilderAPI_MakeFace(polygon.Wire()).Face()
    return BRepPrimAPI_MakePrism(face, vector(height)).Shape()


def swept(edges: Sequence[TopoDS_Shape], height: Vector) -> TopoDS_Shape:
    """What a closed outline of plane edges sweeps along a vector."""
    outline = BRepBuilderAPI_MakeWire()
    for edge in edges:
        outline.Add(TopoDS.Edge(edge))
    face = BRepBuilderAPI_MakeFace(outline.Wire()).Face()
    return BRepPrimAPI_MakePrism(face, vector(height)).Shape()


def ball(centre: Vector, radius: float) -> TopoDS_Shape:
    return BRepPrimAPI_MakeSphere(point(centre), radius).Shape()


def coil(start: Vector, radius: float, wire: float, height: float, turns: int) -> TopoDS_Shape:
    """A helical spring along y of a round wire."""
    surface = Geom_CylindricalSurface(gp_Ax3(point(start), gp_Dir(0, 1, 0)), radius)
    slope = gp_Dir2d(2 * np.pi * turns, height)
    length = float(np.hypot(2 * np.pi * turns, height))
    helix = Geom2d_Line(gp_Pnt2d(0, 0), slope)
    edge = BRepBuilderAPI_MakeEdge(helix, surface, 0.0, length).Edge()
    BRepLib.BuildCurves3d_s(edge)
    spine = BRepBuilderAPI_MakeWire(edge).Wire()
    curve = BRepAdaptor_Curve(edge)
    at, along = gp_Pnt(), gp_Vec()
    curve.D1(curve.FirstParameter(), at, along)
    ring = gp_Circ(gp_Ax2(at, gp_Dir(along)), wire / 2)
    profile = BRepBuilderAPI_MakeFace(
        BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(ring).Edge()).Wire()
    ).Face()
    pipe = BRepOffsetAPI_MakePipeShell(spine)
    pipe.SetMode(gp_Dir(0, 1, 0))
    pipe.Add(BRepTools.OuterWire_s(profile))
    pipe.Build()
    pipe.MakeSolid()
    return pipe.Shape()


def line(p: Vector, q: Vector) -> TopoDS_Shape:
    return BRepBuilderAPI_MakeEdge(point(p), point(q)).Edge()


def arc(p: Vector, via: Vector, q: Vector) -> TopoDS_Shape:
    """The arc of a circle from p through `via` to q."""
    return BRepBuilderAPI_MakeEdge(
        GC_MakeArcOfCircle(point(p), point(via), point(q)).Value()
    ).Edge()


def spline(places: Sequence[Vector]) -> TopoDS_Shape:
    """A B-spline through points."""
    array = Array1_gp_Pnt(1, len(places))
    for k, place in enumerate(places, 1):
        array.SetValue(k, point(place))
    return BRepBuilderAPI_MakeEdge(GeomAPI_PointsToBSpline(array).Curve()).Edge()


def spline_surface(places: Sequence[Sequence[Vector]]) -> Geom_BSplineSurface:
    """A B-spline surface through rows of points."""
    array = Array2_gp_Pnt(1, len(places), 1, len(places[0]))
    for i, row in enumerate(places, 1):
        for j, place in enumerate(row, 1):
            array.SetValue(i, j, point(place))
    return GeomAPI_PointsToBSplineSurface(array).Surface()


def fused(*shapes: TopoDS_Shape, unified: bool = True) -> TopoDS_Shape:
    """One solid of several; with `unified` faces of one plane are one face."""
    whole = shapes[0]
    if len(shapes) > 1:
        fuse = BRepAlgoAPI_Fuse()
        first, others = List_TopoDS_Shape(), List_TopoDS_Shape()
        first.Append(shapes[0])
        for shape in shapes[1:]:
            others.Append(shape)
        fuse.SetArguments(first)
        fuse.SetTools(others)
        fuse.Build()
        whole = fuse.Shape()
    if unified:
        unify = ShapeUpgrade_UnifySameDomain(whole, True, True, False)
        unify.Build()
        whole = unify.Shape()
    found = solids(whole)
    if len(found) != 1:
        raise ValueError(f"{len(found)} solids where one is wanted")
    return found[0]


def cut(shape: TopoDS_Shape, *tools: TopoDS_Shape) -> TopoDS_Shape:
    """A solid without what the tools take away; one solid must be left."""
    for tool in tools:
        shape = BRepAlgoAPI_Cut(shape, tool).Shape()
    (left,) = solids(shape)
    return left


def common(shape: TopoDS_Shape, other: TopoDS_Shape) -> TopoDS_Shape:
    (left,) = solids(BRepAlgoAPI_Common(shape, other).Shape())
    return left


def filleted(shape: TopoDS_Shape, middles: Sequence[Vector], radius: float) -> TopoDS_Shape:
    """Fillets along those edges whose middles are nearest to the given points."""
    return _dressed(BRepFilletAPI_MakeFillet(shape), shape, middles, radius)


def chamfered(shape: TopoDS_Shape, middles: Sequence[Vector], size: float) -> TopoDS_Shape:
    """Chamfers likewise."""
    return _dressed(BRepFilletAPI_MakeChamfer(shape), shape, middles, size)


def _dressed(
    maker: BRepFilletAPI_MakeFillet | BRepFilletAPI_MakeChamfer,
    shape: TopoDS_Shape,
    middles: Sequence[Vector],
    size: float,
) -> TopoDS_Shape:
    edges, places = [], []
    for edge in _each(shape, TopAbs_EDGE):
        properties = GProp_GProps()
        BRepGProp.LinearProperties_s(edge, properties)
        centre = properties.CentreOfMass()
        edges.append(TopoDS.Edge(edge))
        places.append((centre.X(), centre.Y(), centre.Z()))
    for middle in middles:
        distance = np.linalg.norm(np.asarray(places) - np.asarray(middle, float), axis=1)
        if distance.min() > 0.3:
            raise ValueError(f"no edge has its middle at {middle}; the nearest: {distance.min()}")
        maker.Add(size, edges[int(distance.argmin())])
    (left,) = solids(maker.Shape())
    return left


def turning(axis: Vector, degrees: float, about: Vector = (0, 0, 0)) -> gp_Trsf:
    turn = gp_Trsf()
    turn.SetRotation(gp_Ax1(point(about), gp_Dir(*map(float, axis))), float(np.radians(degrees)))
    return turn


def turned(shape: TopoDS_Shape, turn: gp_Trsf) -> TopoDS_Shape:
    """The solid turned, its geometry as well: not by a location alone."""
    return BRepBuilderAPI_Transform(shape, turn, True).Shape()


def solids(shape: TopoDS_Shape) -> list[TopoDS_Shape]:
    return list(_each(shape, TopAbs_SOLID))


def volume(shape: TopoDS_Shape) -> float:
    """Volume in mm^3."""
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties)
    return properties.Mass()


def is_valid(shape: TopoDS_Shape) -> bool:
    return BRepCheck_Analyzer(shape).IsValid()


def is_inside(shape: TopoDS_Shape, place: Vector) -> bool:
    inside = BRepClass3d_SolidClassifier(shape)
    inside.Perform(point(place), 1e-7)
    return inside.State() in (TopAbs_IN, TopAbs_ON)


def bounds(shape: TopoDS_Shape) -> np.ndarray:
    """Lowest and highest coordinates, shape (2, 3)."""
    around = Bnd_Box()
    BRepBndLib.AddOptimal_s(shape, around, True, False)
    low, high = around.CornerMin(), around.CornerMax()
    return np.array([[c.X(), c.Y(), c.Z()] for c in (low, high)])


def _each(shape: TopoDS_Shape, kind: object) -> list[TopoDS_Shape]:
    explorer = TopExp_Explorer(shape, kind)
    found: list[TopoDS_Shape] = []
    while explorer.More():
        if not any(explorer.Current().IsSame(each) for each in found):
            found.append(explorer.Current())
        explorer.Next()
    return found


def write(
    path: Path | str,
    parts: Sequence[tuple[tuple[str, ...], TopoDS_Shape]],
    unit: str = "MM",
    root: str = "assembly",
    copies: Sequence[tuple[str, tuple[str, ...], gp_Trsf]] = (),
) -> None:
    """Write a STEP file with names and the structure of the assembly.

    Args:
        path: The file.
        parts: Of each part the names from the outermost assembly below the root to its own, and
            its solid. The same solid (`IsPartner`) is written once, as an instance each time.
        unit: "MM", "INCH" or "M": of the file; the shapes are in mm.
        root: What the whole is called. A single part with a path of one name is no assembly.
        copies: Assemblies that stand there once more: name, path of names, how turned and put.
    """
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    XCAFDoc_DocumentTool.SetLengthUnit_s(document, 0.001)
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    XCAFDoc_ShapeTool.SetAutoNaming_s(False)

    def name(label: TDF_Label, words: str) -> None:
        TDataStd_Name.Set_s(label, TCollection_ExtendedString(words, True))

    if len(parts) == 1 and len(parts[0][0]) == 1:
        (((words,), shape),) = parts
        name(tool.AddShape(shape, False), words)
    else:
        top = tool.NewShape()
        name(top, root)
        assemblies = {(): top}
        shapes: list[tuple[TopoDS_Shape, TDF_Label]] = []
        for path_names, shape in parts:
            for n in range(1, len(path_names)):
                if path_names[:n] in assemblies:
                    continue
                label = tool.NewShape()
                name(label, path_names[n - 1])
                name(
                    tool.AddComponent(assemblies[path_names[: n - 1]], label, TopLoc_Location()),
                    path_names[n - 1],
                )
                assemblies[path_names[:n]] = label
            place = shape.Location()
            plain = shape.Located(TopLoc_Location())
            label = next((known for s, known in shapes if s.IsPartner(plain)), None)
            if label is None:
                label = tool.AddShape(plain, False)
                name(label, path_names[-1])
                shapes.append((plain, label))
            component = tool.AddComponent(assemblies[path_names[:-1]], label, place)
            name(component, path_names[-1])
        for words, names, turn in copies:
            name(tool.AddComponent(top, assemblies[names], TopLoc_Location(turn)), words)
        tool.UpdateAssemblies()
    _put(path, document, unit)


def write_nested(path: Path | str, shape: TopoDS_Shape, places: Sequence[gp_Trsf], n: int) -> None:
    """Write assemblies in assemblies, n deep, each with the one below at all these places."""
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    XCAFDoc_DocumentTool.SetLengthUnit_s(document, 0.001)
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    below = tool.AddShape(shape, False)
    for _ in range(n):
        label = tool.NewShape()
        for place in places:
            tool.AddComponent(label, below, TopLoc_Location(place))
        below = label
    tool.UpdateAssemblies()
    _put(path, document, "MM")


def _put(path: Path | str, document: TDocStd_Document, unit: str) -> None:
    writer = STEPCAFControl_Writer()
    writer.SetNameMode(True)
    before = Interface_Static.CVal_s("write.step.unit")
    Interface_Static.SetCVal_s("write.step.unit", unit)
    try:
        if not writer.Transfer(document) or writer.Write(str(path)) != IFSelect_RetDone:
            raise OSError(f"{path} could not be written")
    finally:
        Interface_Static.SetCVal_s("write.step.unit", before)
