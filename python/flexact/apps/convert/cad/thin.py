# SPDX-License-Identifier: BSD-3-Clause
"""Thin parts of solids, and the solids around them.

Loaded in the child process alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ....core.arrays import FloatArray
from ....util.rotations import unit
from . import brep
from .assembly import Kind
from .brep import NEAR, Face, Part, are_parallel

#: A wall is at least so many thicknesses long.
LEAST_SLENDER = 4.0

#: A sheet is at least so many thicknesses broad; what is narrower is a wire.
SHEET = 5.0

#: A wall with fillets at both ends that is no longer than so many thicknesses is a notch.
NOTCH = 12.0

#: The widest gap that is filled with glue [mm].
GLUED = 0.25


@dataclass(eq=False)
class Thin:
    """A thin part of a solid that may be a flexure.

    Attributes:
        part: Row of its solid.
        kind: What it would be.
        p: Middle of one end, where the nominal flexure ends.
        q: Middle of the other one.
        cuts: Middles of both cross-sections at which it is cut from what it is fastened to.
        width: From edge to edge; of a notch along its axis.
        normal: Across the thickness.
        breadth: Along the width.
        thickness: At the thinnest.
        span: From where to where the cuts go along the width, from the line of middles.
        outline: Of its mid plane (n, 3).
        radius: Of a notch, or of the fillets of a sheet.
        contour: See `Flexure`.
        doubts: What is odd in its shape.
        is_open: Whether its solid ends where it does, at p and at q, so that nothing is to be cut.
        why: Why it is taken as a flexure or as a body, where that is in doubt.
    """

    part: int
    kind: Kind
    p: FloatArray
    q: FloatArray
    cuts: tuple[FloatArray, ...]
    width: FloatArray
    normal: FloatArray
    breadth: float
    thickness: float
    span: tuple[float, float]
    outline: FloatArray
    radius: float = 0.0
    contour: str = ""
    doubts: list[str] = field(default_factory=list)
    why: list[str] = field(default_factory=list)
    is_open: tuple[bool, bool] = (False, False)

    @property
    def length(self) -> float:
        """Free length."""
        return float(np.linalg.norm(self.q - self.p))

    @property
    def axis(self) -> FloatArray:
        """From p to q."""
        return unit(self.q - self.p)

    @property
    def middle(self) -> FloatArray:
        """The middle between its ends."""
        made: FloatArray = np.asarray((self.p + self.q) / 2.0)
        return made

    @property
    def bending(self) -> float:
        """Stiffness against bending for each breadth, so that wires and sheets compare."""
        return (self.thickness / self.length) ** 3

    def has(self, place: FloatArray, more: float = 0.0) -> bool:
        """Whether a place is within it."""
        x, y, z = (float((place - self.middle) @ d) for d in (self.axis, self.width, self.normal))
        half = np.array([self.length, self.breadth, self.thickness]) / 2 + more + NEAR
        return bool(abs(x) <= half[0] and abs(y) <= half[1] and abs(z) <= half[2])


@dataclass(eq=False)
class Scene:
    """All solids of an assembly, and simple ones in place of those that are purchased."""

    parts: list[Part]
    stand_ins: dict[int, Part]

    def near(self, box: FloatArray, but: int) -> list[int]:
        """Rows of other solids that have something in a box."""
        return [
            k
            for k, part in enumerate(self.parts)
            if k != but and brep.boxes_meet(self.shown(k).box, box)
        ]

    def shown(self, row: int) -> Part:
        """The solid, or what stands in for it."""
        return self.stand_ins.get(row, self.parts[row])

    def where(self, place: FloatArray, rows: Sequence[int]) -> int | None:
        """Which of some solids has a place in it."""
        return next((k for k in rows if self.shown(k).holds(place)), None)


def rounds(part: Part, *, convex: bool) -> list[list[Face]]:
    """The cylindrical faces of a solid, those of one axis and radius together."""
    groups: list[list[Face]] = []
    for face in part.faces:
        if face.kind != "cylinder" or face.is_convex != convex:
            continue
        for group in groups:
            if _coaxial(group[0], face) and abs(group[0].radius - face.radius) < NEAR:
                group.append(face)
                break
        else:
            groups.append([face])
    return groups


def _coaxial(a: Face, b: Face) -> bool:
    away = b.at - a.at
    return (
        are_parallel(a.axis, b.axis) and float(np.linalg.norm(away - away @ a.axis * a.axis)) < NEAR
    )
