# SPDX-License-Identifier: BSD-3-Clause
"""Solids by OpenCASCADE: their faces and edges as numbers, what lies inside, cuts and volumes.

Loaded in the child process alone. Lengths are in mm, as OpenCASCADE reads them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common, BRepAlgoAPI_Cut, BRepAlgoAPI_Splitter
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepBuilderAPI import (
    BRepBuilderAPI_MakeEdge,
    BRepBuilderAPI_MakeFace,
    BRepBuilderAPI_MakePolygon,
    BRepBuilderAPI_MakeVertex,
)
from OCP.BRepClass3d import BRepClass3d_SolidClassifier
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.BRepGProp import BRepGProp
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.BRepPrimAPI import BRepPrimAPI_MakeCylinder
from OCP.BRepTools import BRepTools, BRepTools_WireExplorer
from OCP.collections import (
    IndexedDataMap_TopoDS_Shape_List_TopoDS_Shape_TopTools_ShapeMapHasher as Ancestors,
)
from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher as Shapes
from OCP.collections import List_TopoDS_Shape
from OCP.GeomAbs import (
    GeomAbs_Circle,
    GeomAbs_Cylinder,
    GeomAbs_Ellipse,
    GeomAbs_Line,
    GeomAbs_Plane,
    GeomAbs_SurfaceOfExtrusion,
    GeomAbs_Torus,
)
from OCP.gp import gp_Ax2, gp_Cylinder, gp_Dir, gp_Pln, gp_Pnt, gp_Trsf, gp_Vec
from OCP.GProp import GProp_GProps
from OCP.ShapeAnalysis import ShapeAnalysis_CanonicalRecognition
from OCP.ShapeUpgrade import ShapeUpgrade_UnifySameDomain
from OCP.TopAbs import (
    TopAbs_EDGE,
    TopAbs_FACE,
    TopAbs_IN,
    TopAbs_ON,
    TopAbs_REVERSED,
    TopAbs_ShapeEnum,
    TopAbs_VERTEX,
)
from OCP.TopExp import TopExp, TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Compound, TopoDS_Shape

from ....core.arrays import FloatArray, IntArray
from ....util.records import cached_property
from ....util.rotations import unit

#: Within this two places are one [mm].
NEAR = 1e-4
#: Directions are parallel where the sine between them is less.
PARALLEL = 1e-4


def xyz(p: gp_Pnt | gp_Dir | gp_Vec) -> FloatArray:
    """The coordinates of a point or a direction."""
    return np.array([p.X(), p.Y(), p.Z()])


def point(p: FloatArray) -> gp_Pnt:
    """A point of OpenCASCADE."""
    return gp_Pnt(float(p[0]), float(p[1]), float(p[2]))


def across(v: FloatArray) -> FloatArray:
    """Some unit vector normal to another one."""
    return unit(np.cross(v, np.eye(3)[int(np.argmin(np.abs(v)))]))


def are_parallel(a: FloatArray, b: FloatArray, sine: float = PARALLEL) -> bool:
    """Whether two unit vectors lie along one line."""
    # Asked very often, and of three numbers each.
    (ax, ay, az), (bx, by, bz) = a.tolist(), b.tolist()
    x, y, z = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
    return bool(x * x + y * y + z * z < sine * sine)


def each(shape: TopoDS_Shape, kind: TopAbs_ShapeEnum) -> Iterator[TopoDS_Shape]:
    """The parts of a shape of a kind; what several parts share comes several times."""
    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


def box_of(shape: TopoDS_Shape, gap: float = 0.0) -> FloatArray:
    """Lowest and highest coordinates (2, 3), made larger by a gap."""
    around = Bnd_Box()
    BRepBndLib.Add_s(shape, around, False)
    if around.IsVoid():
        return np.array([[np.inf] * 3, [-np.inf] * 3])
    low, high = xyz(around.CornerMin()), xyz(around.CornerMax())
    return np.array([low - gap, high + gap])


def boxes_meet(a: FloatArray, b: FloatArray) -> bool:
    """Whether two boxes have something in common."""
    return bool(np.all(a[0] <= b[1]) and np.all(b[0] <= a[1]))


@dataclass(eq=False)
class Edge:
    """An edge of a solid.

    Attributes:
        shape: Its shape.
        kind: "line", "circle" or "other".
        ends: Its two ends (2, 3).
        places: Some places on it, its ends among them (n, 3).
        faces: Rows of the faces that meet in it.
    """

    shape: TopoDS_Shape
    kind: str
    ends: FloatArray
    places: FloatArray
    faces: tuple[int, ...]

    @cached_property
    def length(self) -> float:
        """Between its ends."""
        return float(np.linalg.norm(self.ends[1] - self.ends[0]))

    def is_along(self, direction: FloatArray) -> bool:
        """Whether it is straight in a direction."""
        if self.kind != "line" or self.length < NEAR:
            return False
        return are_parallel((self.ends[1] - self.ends[0]) / self.length, direction, 1e-3)


@dataclass(eq=False)
class Face:
    """A face of a solid.

    Attributes:
        shape: Its shape.
        kind: "plane", "cylinder", "torus" or "other".
        at: A point of a plane or another face, or of the axis.
        axis: Outward normal there, or direction of the axis of a cylinder or torus.
        radius: Of a cylinder, or the smaller one of a torus.
        is_convex: Whether the material is inside of it.
        area: [mm2].
        edges: Rows of its edges.
    """

    shape: TopoDS_Shape
    kind: str
    at: FloatArray
    axis: FloatArray
    radius: float
    is_convex: bool
    area: float
    edges: list[int] = field(default_factory=list)

    @cached_property
    def box(self) -> FloatArray:
        """Lowest and highest coordinates."""
        return box_of(self.shape)


def _face(shape: TopoDS_Shape) -> Face:
    face = TopoDS.Face(shape)
    surface = BRepAdaptor_Surface(face)
    sign = -1.0 if shape.Orientation() == TopAbs_REVERSED else 1.0
    kind = surface.GetType()
    properties = GProp_GProps()
    BRepGProp.SurfaceProperties_s(shape, properties)
    area = properties.Mass()
    at, du, dv = gp_Pnt(), gp_Vec(), gp_Vec()
    u = (surface.FirstUParameter() + surface.LastUParameter()) / 2
    v = (surface.FirstVParameter() + surface.LastVParameter()) / 2
    surface.D1(u, v, at, du, dv)
    normal = sign * unit(np.cross(xyz(du), xyz(dv)))
    plane, cylinder = gp_Pln(), gp_Cylinder()
    known = kind in (GeomAbs_Plane, GeomAbs_Cylinder, GeomAbs_Torus)
    # Some programs export all surfaces as splines.
    spline = None if known else ShapeAnalysis_CanonicalRecognition(shape)
    if kind == GeomAbs_Plane or (spline is not None and spline.IsPlane(NEAR, plane)):
        return Face(shape, "plane", xyz(at), normal, 0.0, True, area)
    if kind == GeomAbs_Cylinder or (spline is not None and spline.IsCylinder(NEAR, cylinder)):
        if known:
            cylinder = surface.Cylinder()
        start, axis = xyz(cylinder.Axis().Location()), xyz(cylinder.Axis().Direction())
        away = xyz(at) - start - (xyz(at) - start) @ axis * axis
        convex = bool(normal @ away > 0)
        return Face(shape, "cylinder", start, axis, cylinder.Radius(), convex, area)
    if kind != GeomAbs_Torus:
        return Face(shape, "other", xyz(at), normal, 0.0, True, area)
    torus = surface.Torus()
    start, axis = xyz(torus.Axis().Location()), xyz(torus.Axis().Direction())
    away = xyz(at) - start - (xyz(at) - start) @ axis * axis
    tube = start + torus.MajorRadius() * unit(away)
    convex = bool(normal @ (xyz(at) - tube) > 0)
    return Face(shape, "torus", start, axis, torus.MinorRadius(), convex, area)


def _is_straight(curve: BRepAdaptor_Curve, first: float, last: float) -> bool:
    """Whether a spline is a straight line."""
    places = np.array([xyz(curve.Value(t)) for t in np.linspace(first, last, 5)])
    along = places[-1] - places[0]
    if np.linalg.norm(along) < NEAR:
        return False
    away = places - places[0]
    off = away - np.outer(away @ unit(along), unit(along))
    return bool(np.abs(off).max() < NEAR)


@dataclass(eq=False)
class Part:
    """A solid, or a piece of one.

    Attributes:
        shape: Its shape, where it stands in the assembly.
        name: In the CAD, with a number where several have it.
        title: In the CAD.
        path: Names of the assemblies around it.
        colour: Red, green, blue, or ().
        material: Its name in the file.
        density: In the file [kg/m3], or 0.
        is_purchased: Whether it is a screw or the like.
    """

    shape: TopoDS_Shape
    name: str = ""
    title: str = ""
    path: tuple[str, ...] = ()
    colour: tuple[float, ...] = ()
    material: str = ""
    density: float = 0.0
    is_purchased: bool = False

    @cached_property
    def box(self) -> FloatArray:
        """Lowest and highest coordinates."""
        return box_of(self.shape)

    @cached_property
    def size(self) -> float:
        """Diagonal of its box."""
        return float(np.linalg.norm(self.box[1] - self.box[0]))

    @cached_property
    def _table(self) -> tuple[list[Face], list[Edge]]:
        rows = Shapes()
        TopExp.MapShapes_s(self.shape, TopAbs_FACE, rows)
        made = [_face(rows.FindKey(k)) for k in range(1, rows.Extent() + 1)]
        ancestors = Ancestors()
        TopExp.MapShapesAndAncestors_s(self.shape, TopAbs_EDGE, TopAbs_FACE, ancestors)
        edges: list[Edge] = []
        for k in range(1, ancestors.Extent() + 1):
            shape = ancestors.FindKey(k)
            edge = TopoDS.Edge(shape)
            if BRep_Tool.Degenerated_s(edge):
                continue
            found = (rows.FindIndex(face) - 1 for face in ancestors.FindFromIndex(k))
            around = tuple(dict.fromkeys(found))
            curve = BRepAdaptor_Curve(edge)
            first, last = curve.FirstParameter(), curve.LastParameter()
            kind = {GeomAbs_Line: "line", GeomAbs_Circle: "circle"}.get(curve.GetType(), "other")
            ends = [xyz(curve.Value(t)) for t in (first, last)]
            if kind == "other" and _is_straight(curve, first, last):
                kind = "line"
            for row in around:
                made[row].edges.append(len(edges))
            count = 2 if kind == "line" else 9
            places = [xyz(curve.Value(t)) for t in np.linspace(first, last, count)]
            edges.append(Edge(shape, kind, np.array(ends), np.array(places), around))
        return made, edges

    @property
    def faces(self) -> list[Face]:
        """Its faces."""
        return self._table[0]

    @property
    def edges(self) -> list[Edge]:
        """Its edges."""
        return self._table[1]

    def beyond(self, face: int, edge: int) -> Face | None:
        """The other face at an edge of a face."""
        others = [row for row in self.edges[edge].faces if row != face]
        return self.faces[others[0]] if others else None

    @cached_property
    def _classifier(self) -> BRepClass3d_SolidClassifier:
        return BRepClass3d_SolidClassifier(self.shape)

    def holds(self, p: FloatArray, *, edge: bool = False) -> bool:
        """Whether a point is inside; `edge`: or on its surface."""
        if np.any(p < self.box[0] - NEAR) or np.any(p > self.box[1] + NEAR):
            return False
        self._classifier.Perform(point(p), 1e-7)
        state = self._classifier.State()
        return bool(state == TopAbs_IN or (edge and state == TopAbs_ON))

    @cached_property
    def mass(self) -> tuple[float, FloatArray, FloatArray]:
        """Volume, its centre, and inertia (3, 3) about that at density 1."""
        properties = GProp_GProps()
        BRepGProp.VolumeProperties_s(self.shape, properties)
        centre = xyz(properties.CentreOfMass())
        m = properties.MatrixOfInertia()
        inertia = np.array([[m.Value(i, j) for j in (1, 2, 3)] for i in (1, 2, 3)])
        return properties.Mass(), centre, inertia

    @property
    def volume(self) -> float:
        """[mm3]."""
        return self.mass[0]

    def triangles(self) -> tuple[FloatArray, IntArray]:
        """Vertices (n, 3) and triangles (m, 3) of its surface, for drawing."""
        BRepMesh_IncrementalMesh(self.shape, max(self.size / 300, 1e-3), False, 0.4, False)
        vertices: list[FloatArray] = []
        rows: list[IntArray] = []
        count = 0
        for shape in each(self.shape, TopAbs_FACE):
            place = TopLoc_Location()
            mesh = BRep_Tool.Triangulation_s(TopoDS.Face(shape), place)
            if mesh is None:
                continue
            turn = place.Transformation()
            for k in range(1, mesh.NbNodes() + 1):
                vertices.append(xyz(mesh.Node(k).Transformed(turn)))
            flip = shape.Orientation() == TopAbs_REVERSED
            for k in range(1, mesh.NbTriangles() + 1):
                a, b, c = mesh.Triangle(k).Get()
                rows.append(np.array([a, c, b] if flip else [a, b, c]) + count - 1)
            count += mesh.NbNodes()
        if not rows:
            return np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)
        return np.array(vertices), np.array(rows, dtype=np.int64)


def listed(shapes: Iterable[TopoDS_Shape]) -> List_TopoDS_Shape:
    """A list of OpenCASCADE."""
    made = List_TopoDS_Shape()
    for shape in shapes:
        made.Append(shape)
    return made


def moved(shape: TopoDS_Shape, by: FloatArray) -> TopoDS_Shape:
    """A shape shifted by a vector."""
    shift = gp_Trsf()
    shift.SetTranslation(gp_Vec(*map(float, by)))
    return shape.Moved(TopLoc_Location(shift))


def common(
    ones: Sequence[TopoDS_Shape], others: Sequence[TopoDS_Shape], *, unified: bool = True
) -> list[TopoDS_Shape]:
    """Faces that faces have in common with faces, or with solids."""
    return _boolean(BRepAlgoAPI_Common(), ones, others, unified)


def without(ones: Sequence[TopoDS_Shape], others: Sequence[TopoDS_Shape]) -> list[TopoDS_Shape]:
    """Faces that are left of faces where others are taken away."""
    return _boolean(BRepAlgoAPI_Cut(), ones, others, True)


def _boolean(
    operation: Any, ones: Sequence[TopoDS_Shape], others: Sequence[TopoDS_Shape], unified: bool
) -> list[TopoDS_Shape]:
    operation.SetArguments(listed(ones))
    operation.SetTools(listed(others))
    operation.SetRunParallel(False)
    operation.Build()
    if not operation.IsDone():
        return []
    shape = operation.Shape()
    if unified and shape is not None and not shape.IsNull():
        unify = ShapeUpgrade_UnifySameDomain(shape, True, True, False)
        unify.Build()
        shape = unify.Shape()
    return list(each(shape, TopAbs_FACE))


def area_of(shape: TopoDS_Shape) -> float:
    """[mm2]."""
    properties = GProp_GProps()
    BRepGProp.SurfaceProperties_s(shape, properties)
    return float(properties.Mass())


def filled(shape: TopoDS_Shape, most: float) -> TopoDS_Shape:
    """A plane face without those holes that are smaller than a share of it."""
    face = TopoDS.Face(shape)
    outer = BRepTools.OuterWire_s(face)
    whole = BRepBuilderAPI_MakeFace(outer, True).Face()
    if area_of(whole) <= area_of(shape) / (1.0 - most):
        return whole
    return shape


def loops(shape: TopoDS_Shape, turns: int = 12) -> list[list[FloatArray]]:
    """The wires of a plane face, the outer one first: of each its edges as points (n, 3) in order.

    An edge that is straight has its two ends, an arc as many points as it is curved.
    """
    face = TopoDS.Face(shape)
    outer = BRepTools.OuterWire_s(face)
    wires = [outer]
    explorer = TopExp_Explorer(face, TopAbs_ShapeEnum.TopAbs_WIRE)
    while explorer.More():
        if not explorer.Current().IsSame(outer):
            wires.append(TopoDS.Wire(explorer.Current()))
        explorer.Next()
    made = []
    for wire in wires:
        edges = []
        walk = BRepTools_WireExplorer(wire, face)
        while walk.More():
            edge = walk.Current()
            curve = BRepAdaptor_Curve(edge)
            first, last = curve.FirstParameter(), curve.LastParameter()
            count = 2
            if curve.GetType() != GeomAbs_Line and not _is_straight(curve, first, last):
                count = turns + 1
            points = np.array([xyz(curve.Value(t)) for t in np.linspace(first, last, count)])
            edges.append(points[::-1] if walk.Orientation() == TopAbs_REVERSED else points)
            walk.Next()
        made.append(edges)
    return made


def rectangle(centre: FloatArray, u: FloatArray, v: FloatArray) -> TopoDS_Shape:
    """A rectangle about a centre, with half its sides."""
    polygon = BRepBuilderAPI_MakePolygon()
    for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        polygon.Add(point(centre + a * u + b * v))
    polygon.Close()
    return BRepBuilderAPI_MakeFace(polygon.Wire()).Face()


def cylinder(start: FloatArray, axis: FloatArray, radius: float, length: float) -> TopoDS_Shape:
    """A solid cylinder."""
    place = gp_Ax2(point(start), gp_Dir(*map(float, axis)))
    return BRepPrimAPI_MakeCylinder(place, radius, length).Shape()


def split(
    shape: TopoDS_Shape, cuts: Sequence[TopoDS_Shape], kind: TopAbs_ShapeEnum
) -> list[TopoDS_Shape]:
    """The solids, or plane faces, of a kind into which a shape falls where faces cut it."""
    splitter = BRepAlgoAPI_Splitter()
    splitter.SetArguments(listed([shape]))
    splitter.SetTools(listed(cuts))
    splitter.Build()
    if not splitter.IsDone():
        return [shape]
    return list(each(splitter.Shape(), kind)) or [shape]


def corner(shape: TopoDS_Shape) -> FloatArray:
    """Some vertex of a shape."""
    return xyz(BRep_Tool.Pnt_s(TopoDS.Vertex(next(each(shape, TopAbs_VERTEX)))))


def distance(a: TopoDS_Shape, b: TopoDS_Shape) -> float:
    """The least distance of two shapes [mm]; 0 where they have something in common."""
    measure = BRepExtrema_DistShapeShape(a, b)
    if not measure.IsDone():
        return float("inf")
    return 0.0 if measure.InnerSolution() else float(measure.Value())


def segment(p: FloatArray, q: FloatArray) -> TopoDS_Shape:
    """A straight line as a shape."""
    return BRepBuilderAPI_MakeEdge(point(p), point(q)).Edge()


def vertex(p: FloatArray) -> TopoDS_Shape:
    """A point as a shape."""
    return BRepBuilderAPI_MakeVertex(point(p)).Vertex()


def nearest(a: TopoDS_Shape, b: TopoDS_Shape) -> tuple[FloatArray, FloatArray] | None:
    """The places of two shapes that are nearest to each other."""
    measure = BRepExtrema_DistShapeShape(a, b)
    if not measure.IsDone() or measure.NbSolution() < 1:
        return None
    return xyz(measure.PointOnShape1(1)), xyz(measure.PointOnShape2(1))


def swept_along(shape: TopoDS_Shape) -> FloatArray | None:
    """The direction along which the surface of a face is swept, if it is."""
    surface = BRepAdaptor_Surface(TopoDS.Face(shape))
    if surface.GetType() == GeomAbs_SurfaceOfExtrusion:
        return xyz(surface.Direction())
    return None


def ellipse_of(shape: TopoDS_Shape) -> tuple[float, float, FloatArray] | None:
    """Half axes of the ellipse that a face is swept from, and the direction of the first."""
    surface = BRepAdaptor_Surface(TopoDS.Face(shape))
    if surface.GetType() != GeomAbs_SurfaceOfExtrusion:
        return None
    curve = surface.BasisCurve()
    if curve.GetType() != GeomAbs_Ellipse:
        return None
    ellipse = curve.Ellipse()
    return ellipse.MajorRadius(), ellipse.MinorRadius(), xyz(ellipse.XAxis().Direction())


def compound(shapes: Iterable[TopoDS_Shape]) -> TopoDS_Shape:
    """One shape of several."""
    builder, made = BRep_Builder(), TopoDS_Compound()
    builder.MakeCompound(made)
    for shape in shapes:
        builder.Add(made, shape)
    return made
