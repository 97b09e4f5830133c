# SPDX-License-Identifier: BSD-3-Clause
"""What was found in a STEP file, as plain data: pieces of solids, flexures, bodies, doubts.

The child process that runs OpenCASCADE makes these, so nothing here needs it. All is in SI units
and in the coordinates of the assembly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....core.arrays import FloatArray, IntArray
from ....util.records import Frozen, Word


class Kind(Word):
    """What a flexure is."""

    SHEET = "sheet"
    WIRE = "wire"
    NOTCH = "notch"
    BENT = "bent sheet"


@dataclass(frozen=True)
class Choices:
    """What a designer has said of the parts of an assembly; by default nothing.

    A part is said by the name of a solid in the CAD, of a flexure or of a body, or by a place
    (x, y, z) [m] in it, which stays the same where names change.

    Attributes:
        ground: Parts that are ground, in place of what names and sizes say.
        flexures: Parts that are flexures, though they seem too thick.
        bodies: Parts that are bodies, though they are thin.
        declared: Motions that are degrees of freedom: a body, and names of its coordinates
            out of x, y, z, rx, ry, rz.
        material: Of what the file gives no material; "" for the default.
    """

    ground: tuple[str | tuple[float, float, float], ...] = ()
    flexures: tuple[str | tuple[float, float, float], ...] = ()
    bodies: tuple[str | tuple[float, float, float], ...] = ()
    declared: tuple[tuple[str | tuple[float, float, float], tuple[str, ...]], ...] = ()
    material: str = ""


@dataclass(frozen=True, eq=False)
class Piece(Frozen):
    """A solid of the assembly, or what it falls into where its flexures are cut out.

    Attributes:
        solid: Row of the solid in `Assembly.solids`.
        owner: Name of the flexure or body that the piece belongs to.
        is_flexure: Whether that is a flexure.
        vertices: Of its triangles (n, 3) [m].
        triangles: Rows of vertices, counterclockwise from outside (m, 3).
    """

    solid: int
    owner: str
    is_flexure: bool
    vertices: FloatArray
    triangles: IntArray


@dataclass(frozen=True, eq=False)
class Solid(Frozen):
    """A solid of the STEP file, where it stands in the assembly.

    Attributes:
        name: What the CAD calls it; "" where it has no name.
        path: Names of the assemblies around it, the outermost first.
        volume: [m3].
        centre: Centre of its volume [m].
        colour: Red, green and blue from 0 to 1, or () where the file has none.
        material: What it is taken to be made of, a name that Flexact knows.
        density: [kg/m3].
        is_purchased: Whether it is a screw, nut, washer, pin or bearing.
    """

    name: str
    path: tuple[str, ...]
    volume: float
    centre: FloatArray
    colour: tuple[float, ...]
    material: str
    density: float
    is_purchased: bool


@dataclass(frozen=True, eq=False)
class Flexure(Frozen):
    """A thin part of a solid, between two bodies or other flexures.

    Attributes:
        kind: Sheet, wire, notch, or the bend between flat pieces of a sheet.
        name: What it is called; that of its part of the model, where it is taken.
        solid: Row of its solid.
        p: Middle of one end (3,) [m].
        q: Middle of the other.
        width: Unit vector from edge to edge, of a notch along its axis (3,).
        normal: Unit vector across the thickness (3,).
        length: Free length, of a bent sheet the developed one [m].
        breadth: Along the width [m]; of a round wire its diameter.
        thickness: [m]; of a round wire its diameter.
        radius: Of the bends of a bent sheet at mid thickness, of a notch that of its contour, of
            a sheet or wire that of its fillets [m]; else 0.
        corners: p, where the mid planes of the pieces of a bent sheet meet, and q (n, 3) [m]; of
            others p and q.
        angle: By which a bent sheet turns in all [rad]; else 0.
        contour: Of a notch, as `flexact.NotchContour` has it; "round" of a round wire; else "".
        between: Names of what its ends are fastened to, of p first: of bodies, or of a fold, which
            two flexures share and which is no body.
        outline: Closed polygon of its mid plane, for drawing (n, 3) [m].
        doubt: Why it may be meant otherwise; "" where there is no doubt.
        is_taken: Whether it is a flexure of the model; a candidate that became a body is not.
    """

    kind: Kind
    name: str
    solid: int
    p: FloatArray
    q: FloatArray
    corners: FloatArray
    width: FloatArray
    normal: FloatArray
    length: float
    breadth: float
    thickness: float
    radius: float
    angle: float
    contour: str
    between: tuple[str, str]
    outline: FloatArray
    doubt: str
    is_taken: bool

    @property
    def place(self) -> FloatArray:
        """The middle between its ends [m]."""
        made: FloatArray = np.asarray((self.p + self.q) / 2.0)
        return made


@dataclass(frozen=True, eq=False)
class Body(Frozen):
    """What is left of solids beside their flexures, and touches.

    Attributes:
        name: Of its largest solid; "ground", "body 1", ... of pieces of one solid.
        solids: Rows of the solids of which it has something, the largest first.
        volume: [m3].
        mass: [kg].
        centre: Centre of mass (3,) [m].
        inertia: About that, Jxx, Jxy, Jxz, Jyy, Jyz, Jzz as tensor entries (6,) [kg m2].
        is_ground: Whether it stands still.
        is_middle: Whether it is the stiff middle of a reinforced sheet.
        flexures: Names of the flexures that end at it.
    """

    name: str
    solids: tuple[int, ...]
    volume: float
    mass: float
    centre: FloatArray
    inertia: FloatArray
    is_ground: bool
    is_middle: bool
    flexures: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Assembly(Frozen):
    """All that was found in a STEP file.

    Attributes:
        name: Of the file.
        solids: Its solids.
        pieces: What they fall into, for drawing.
        flexures: Those that are taken, in the order of their names.
        candidates: Thin parts that are taken as bodies.
        bodies: Ground first.
        declared: Bodies and names of their coordinates that are degrees of freedom.
        doubts: What the verdict depends on, the gravest first, as sentences.
        remarks: What else is worth knowing: the ground, materials, units, as sentences.
    """

    name: str
    solids: tuple[Solid, ...]
    pieces: tuple[Piece, ...]
    flexures: tuple[Flexure, ...]
    candidates: tuple[Flexure, ...]
    bodies: tuple[Body, ...]
    declared: tuple[tuple[str, tuple[str, ...]], ...]
    doubts: tuple[str, ...]
    remarks: tuple[str, ...]
