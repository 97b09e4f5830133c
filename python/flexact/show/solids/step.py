# SPDX-License-Identifier: BSD-3-Clause
"""Solids as a STEP file: ISO 10303-21 text of an AP214 assembly (automotive_design).

Each product is a component of the model (`next_assembly_usage_occurrence`), and has its solids as
`manifold_solid_brep` with exact surfaces: planes, cylinders, and extruded ellipses and parabolas.
Lengths are in mm, with so many digits that they are read back to the last bit. Nothing in a file
depends on when or where it is written.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ...core.arrays import FloatArray
from .shapes import Curve, Polyhedron, Prism, Shape, ways

#: Metres to millimetres.
_MM = 1000.0
#: Points nearer than this are one for who reads the file [mm].
_UNCERTAINTY = 1.0e-7
#: ISO 10303-21, 6.4.3.3: what stands for itself in a string.
_PLAIN = frozenset(map(chr, range(32, 127))) - {"'", "\\"}


def real(value: float) -> str:
    """A number as ISO 10303-21, 6.4.2 spells it: with a point, and a capital E."""
    text = repr(float(value) + 0.0).upper()
    mantissa, mark, power = text.partition("E")
    return f"{mantissa if '.' in mantissa else mantissa + '.'}{mark}{power}"


def string(text: str) -> str:
    r"""A text as ISO 10303-21, 6.4.3 spells it: other characters as \X2\ or \X4\ and their code."""
    made, wide, width = [], "", 0

    def closed() -> str:
        return f"\\X{width}\\{wide}\\X0\\" if wide else ""

    for character in text:
        code = ord(character)
        if character in _PLAIN or character in "'\\":
            made.append(closed() + (character * 2 if character in "'\\" else character))
            wide = ""
            continue
        own = 2 if code < 0x10000 else 4
        if wide and own != width:
            made.append(closed())
            wide = ""
        width = own
        wide += f"{code:0{2 * own}X}"
    return f"'{''.join(made)}{closed()}'"


class _File:
    """The lines of the data section."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self._known: dict[str, int] = {}

    def add(self, text: str) -> int:
        """A new instance; gives its number."""
        self.lines.append(f"#{len(self.lines) + 1}={text};\n")
        return len(self.lines)

    def shared(self, text: str) -> int:
        """The number of an instance that has no identity of its own, and is there once."""
        if text not in self._known:
            self._known[text] = self.add(text)
        return self._known[text]

    def point(self, place: Iterable[float]) -> int:
        """A point [m]."""
        x, y, z = (real(_MM * float(each)) for each in place)
        return self.shared(f"CARTESIAN_POINT('',({x},{y},{z}))")

    def direction(self, way: Iterable[float]) -> int:
        """A unit vector."""
        x, y, z = map(real, way)
        return self.shared(f"DIRECTION('',({x},{y},{z}))")

    def placement(self, place: FloatArray, z: FloatArray, x: FloatArray) -> int:
        """A place with two axes."""
        axes = self.direction(z), self.direction(x)
        return self.shared(f"AXIS2_PLACEMENT_3D('',#{self.point(place)},#{axes[0]},#{axes[1]})")


def _list(numbers: Iterable[int]) -> str:
    return ",".join(f"#{number}" for number in numbers)


#: Edges of a solid by their two vertices: the number of the curve, and whether as it is.
_Edges = dict[tuple[int, int], tuple[int, bool]]


def _vertices(file: _File, points: FloatArray) -> list[int]:
    return [file.add(f"VERTEX_POINT('',#{file.point(place)})") for place in points]


def _line(file: _File, points: FloatArray, vertices: Sequence[int], a: int, b: int) -> int:
    way = points[b] - points[a]
    length = float(np.linalg.norm(way))
    vector = file.add(f"VECTOR('',#{file.direction(way / length)},1.)")
    line = file.add(f"LINE('',#{file.point(points[a])},#{vector})")
    return file.add(f"EDGE_CURVE('',#{vertices[a]},#{vertices[b]},#{line},.T.)")


def _face(file: _File, loop: Iterable[tuple[int, bool]], surface: int, outward: bool = True) -> int:
    edges = [
        file.add(f"ORIENTED_EDGE('',*,*,#{edge},{'.T.' if along else '.F.'})")
        for edge, along in loop
    ]
    ring = file.add(f"EDGE_LOOP('',({_list(edges)}))")
    bound = file.add(f"FACE_OUTER_BOUND('',#{ring},.T.)")
    sense = ".T." if outward else ".F."
    return file.add(f"ADVANCED_FACE('',(#{bound}),#{surface},{sense})")


def _plane(file: _File, place: FloatArray, other: FloatArray, normal: FloatArray) -> int:
    """A plane through two places."""
    x = (other - place) - ((other - place) @ normal) * normal
    x = x / np.sqrt(x @ x)
    return file.add(f"PLANE('',#{file.placement(place, normal, x)})")


def _polyhedron(file: _File, solid: Polyhedron) -> list[int]:
    vertices = _vertices(file, solid.points)
    edges: _Edges = {}
    faces = []
    for face, normal in zip(solid.faces, solid.normals, strict=True):
        loop = []
        for a, b in zip(face, (*face[1:], face[0]), strict=True):
            if (a, b) not in edges:
                edge = _line(file, solid.points, vertices, a, b)
                edges[a, b], edges[b, a] = (edge, True), (edge, False)
            loop.append(edges[a, b])
        faces.append(
            _face(file, loop, _plane(file, solid.points[face[0]], solid.points[face[1]], normal))
        )
    return faces


def _prism(file: _File, solid: Prism) -> list[int]:
    """Faces of a prism: its two ends, and one along each piece of its contour."""
    pieces = list(ways(solid.contour))
    n = len(pieces)
    x, _, z = solid.frame.T
    flat = np.array([piece.start for piece, _ in pieces])
    below = solid.origin + flat @ solid.frame[:, :2].T
    points = np.concatenate((below, below + solid.length * z))
    vertices = _vertices(file, points)
    up = [_line(file, points, vertices, k, n + k) for k in range(n)]
    extruded = file.add(f"VECTOR('',#{file.direction(z)},1.)")
    rings: list[list[int]] = [[], []]
    faces, surfaces = [], []
    for k, (piece, end) in enumerate(pieces):
        follower = (k + 1) % n
        # Curves run as the contour does: about -z where it goes clockwise.
        axis = z if piece.left else -z
        for level, shift in enumerate((0.0, solid.length)):
            p, q = level * n + k, level * n + follower
            if piece.curve == Curve.LINE:
                rings[level].append(_line(file, points, vertices, p, q))
                continue
            centre = solid.origin + solid.frame[:, :2] @ np.array(piece.centre) + shift * z
            if piece.curve == Curve.PARABOLA:
                # As a Bezier curve of degree 2: tangents at its ends meet below the vertex.
                corner = 2.0 * np.array(piece.centre) - (np.array(piece.start) + end) / 2
                control = solid.origin + solid.frame[:, :2] @ corner + shift * z
                three = _list(file.point(each) for each in (points[p], control, points[q]))
                curve = file.add(
                    f"B_SPLINE_CURVE_WITH_KNOTS('',2,({three}),.PARABOLIC_ARC.,.F.,.F.,(3,3),"
                    "(0.,1.),.UNSPECIFIED.)"
                )
            else:
                # The first axis of an ellipse is the longer one, as OpenCASCADE asks for.
                a, b = piece.axes
                place = file.placement(centre, axis, x if a >= b else solid.frame[:, 1])
                sizes = real(_MM * max(a, b)), real(_MM * min(a, b))
                words = f"CIRCLE('',#{place},{sizes[0]})"
                if piece.curve == Curve.ELLIPSE:
                    words = f"ELLIPSE('',#{place},{','.join(sizes)})"
                curve = file.add(words)
            if level == 0:
                surfaces.append(
                    file.add(
                        f"CYLINDRICAL_SURFACE('',#{file.placement(centre, z, x)},"
                        f"{real(_MM * piece.axes[0])})"
                        if piece.curve == Curve.CIRCLE
                        else f"SURFACE_OF_LINEAR_EXTRUSION('',#{curve},#{extruded})"
                    )
                )
            rings[level].append(
                file.add(f"EDGE_CURVE('',#{vertices[p]},#{vertices[q]},#{curve},.T.)")
            )
        outward = True
        if piece.curve == Curve.LINE:
            way = np.array(end) - piece.start
            normal = solid.frame[:, :2] @ (np.array((way[1], -way[0])) / np.hypot(*way))
            surfaces.append(_plane(file, points[k], points[follower], normal))
        elif piece.curve == Curve.CIRCLE:
            outward = piece.left
        loop = ((rings[0][k], True), (up[follower], True), (rings[1][k], False), (up[k], False))
        faces.append(_face(file, loop, surfaces[k], outward))
    down = [(edge, False) for edge in rings[0][::-1]]
    faces.append(_face(file, down, _plane(file, points[0], points[0] + x, -z)))
    faces.append(
        _face(file, [(edge, True) for edge in rings[1]], _plane(file, points[n], points[n] + x, z))
    )
    return faces


def _styled(file: _File, solid: int, colour: FloatArray, opacity: float) -> int:
    """The colour of a solid."""
    red, green, blue = (real(round(float(each), 6)) for each in colour)
    rgb = file.shared(f"COLOUR_RGB('',{red},{green},{blue})")
    fill = file.shared(f"FILL_AREA_STYLE_COLOUR('',#{rgb})")
    area = file.shared(f"FILL_AREA_STYLE('',(#{fill}))")
    style = file.shared(f"SURFACE_STYLE_FILL_AREA(#{area})")
    looks = [style]
    if opacity < 1.0:
        clear = file.shared(f"SURFACE_STYLE_TRANSPARENT({real(round(1.0 - opacity, 6))})")
        looks.append(
            file.shared(
                f"SURFACE_STYLE_RENDERING_WITH_PROPERTIES(.NORMAL_SHADING.,#{rgb},(#{clear}))"
            )
        )
    side = file.shared(f"SURFACE_SIDE_STYLE('',({_list(looks)}))")
    usage = file.shared(f"SURFACE_STYLE_USAGE(.BOTH.,#{side})")
    assigned = file.shared(f"PRESENTATION_STYLE_ASSIGNMENT((#{usage}))")
    return file.add(f"STYLED_ITEM('',(#{assigned}),#{solid})")


#: A product: its name, names of its solids, these, colour, opacity.
Item = tuple[str, Sequence[str], Sequence[Shape], FloatArray, float]


def step_bytes(name: str, items: Sequence[Item], notes: Sequence[str] = ()) -> bytes:
    """The file of an assembly.

    Args:
        name: Of the assembly.
        items: Its products.
        notes: What is to be said of it, in the header.
    """
    file = _File()
    context = file.add(
        "APPLICATION_CONTEXT('core data for automotive mechanical design processes')"
    )
    file.add(
        "APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2010,"
        f"#{context})"
    )
    mechanical = file.add(f"PRODUCT_CONTEXT('',#{context},'mechanical')")
    design = file.add(f"PRODUCT_DEFINITION_CONTEXT('part definition',#{context},'design')")
    millimetre = file.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))")
    radian = file.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))")
    steradian = file.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())")
    certain = file.add(
        f"UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({real(_UNCERTAINTY)}),#{millimetre},"
        "'distance_accuracy_value','points that are nearer are one')"
    )
    space = file.add(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3)"
        f"GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#{certain}))"
        f"GLOBAL_UNIT_ASSIGNED_CONTEXT(({_list((millimetre, radian, steradian))}))"
        "REPRESENTATION_CONTEXT('','3D'))"
    )
    origin = file.placement(np.zeros(3), np.eye(3)[2], np.eye(3)[0])

    def product(called: str) -> tuple[int, int, int]:
        """A product, its definition and its shape."""
        text = string(called)
        made = file.add(f"PRODUCT({text},{text},'',(#{mechanical}))")
        version = file.add(f"PRODUCT_DEFINITION_FORMATION('','',#{made})")
        defined = file.add(f"PRODUCT_DEFINITION('design','',#{version},#{design})")
        return made, defined, file.add(f"PRODUCT_DEFINITION_SHAPE('','',#{defined})")

    whole, assembly, assembled = product(name)
    products, styles, parts = [], [], []
    for called, names, shapes, colour, opacity in items:
        made, defined, shaped = product(called)
        products.append(made)
        solids = []
        for own, shape in zip(names, shapes, strict=True):
            faces = _prism(file, shape) if isinstance(shape, Prism) else _polyhedron(file, shape)
            shell = file.add(f"CLOSED_SHELL('',({_list(faces)}))")
            solids.append(file.add(f"MANIFOLD_SOLID_BREP({string(own)},#{shell})"))
            styles.append(_styled(file, solids[-1], colour, opacity))
        shown = file.add(
            f"ADVANCED_BREP_SHAPE_REPRESENTATION({string(called)},({_list([origin, *solids])}),"
            f"#{space})"
        )
        file.add(f"SHAPE_DEFINITION_REPRESENTATION(#{shaped},#{shown})")
        parts.append((called, defined, shown))
    root = file.add(f"SHAPE_REPRESENTATION({string(name)},(#{origin}),#{space})")
    file.add(f"SHAPE_DEFINITION_REPRESENTATION(#{assembled},#{root})")
    for number, (called, defined, shown) in enumerate(parts, 1):
        usage = file.add(
            f"NEXT_ASSEMBLY_USAGE_OCCURRENCE('{number}',{string(called)},'',#{assembly},"
            f"#{defined},$)"
        )
        placed = file.add(f"PRODUCT_DEFINITION_SHAPE('','',#{usage})")
        moved = file.shared(f"ITEM_DEFINED_TRANSFORMATION('','',#{origin},#{origin})")
        related = file.add(
            f"(REPRESENTATION_RELATIONSHIP('','',#{shown},#{root})"
            f"REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{moved})"
            "SHAPE_REPRESENTATION_RELATIONSHIP())"
        )
        file.add(f"CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#{related},#{placed})")
    file.add(f"PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,({_list([whole, *products])}))")
    file.add(
        f"MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',({_list(styles)}),#{space})"
    )
    told = ",".join(map(string, ("Solids of an exact-constraint model, in mm", *notes)))
    header = (
        "ISO-10303-21;\nHEADER;\n"
        f"FILE_DESCRIPTION(({told}),'2;1');\n"
        f"FILE_NAME({string(name)},'1970-01-01T00:00:00',(''),(''),'Flexact','Flexact','');\n"
        "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 3 1 1 1 }'));\nENDSEC;\nDATA;\n"
    )
    return "".join((header, *file.lines, "ENDSEC;\nEND-ISO-10303-21;\n")).encode("ascii")
