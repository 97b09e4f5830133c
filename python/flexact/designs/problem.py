# SPDX-License-Identifier: BSD-3-Clause
"""A design problem: what a body is to do, and where flexures may be."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np

from ..advice.spaces.screws import ScrewSpace
from ..analysis.screws import ScrewKind, screw_of
from ..core.arrays import FloatArray
from ..model.model import Model
from ..model.sections import Material
from ..util.records import Frozen, cached_property
from ..util.units import METRES, Units

#: Suffixes of files that hold a problem.
SUFFIXES = (".toml", ".json", ".yaml", ".yml")
#: Kinds of flexures that a designer may ask for, in the order in which layouts use them.
KINDS = ("wire", "sheet", "waisted sheet", "folded sheet", "notch", "bellows")


@dataclass(frozen=True, eq=False)
class Box(Frozen):
    """A box with edges along x, y and z.

    Attributes:
        low: (3,) its least coordinates [m].
        high: (3,) its largest ones [m].
    """

    low: FloatArray
    high: FloatArray

    def __repr__(self) -> str:
        """As it is made in Python."""
        corners = (tuple(each.tolist()) for each in (self.low, self.high))
        return f"flexact.box({', '.join(map(repr, corners))})"


@dataclass(frozen=True, eq=False)
class Region(Frozen):
    """Where flexures may end on a body or on the ground: in any of some boxes, and at points.

    Attributes:
        boxes: The boxes.
        points: (n, 3) the points [m].
    """

    boxes: tuple[Box, ...] = ()
    points: FloatArray = field(default_factory=lambda: np.zeros((0, 3)))

    @property
    def corners(self) -> FloatArray:
        """(n, 2, 3) lowest and highest corner of each box, then each point twice [m]."""
        boxes = [(box.low, box.high) for box in self.boxes]
        return np.array([*boxes, *((p, p) for p in self.points)]).reshape(-1, 2, 3)

    def to_dict(self) -> dict[str, Any]:
        """Its entry in a file."""
        made: dict[str, Any] = {"boxes": [[b.low.tolist(), b.high.tolist()] for b in self.boxes]}
        return {**made, "points": self.points.tolist()} if len(self.points) else made


@dataclass(frozen=True, eq=False)
class Motion(Frozen):
    """One wanted motion.

    Attributes:
        text: As it was written.
        twist: (6,) unit twist (w, v) about the centre: rotation [rad] and its velocity [m].
        kind: Translation, rotation or screw.
        direction: (3,) as it was written, of any size; zero where only the twist is known.
        point: (3,) of the axis [m].
        pitch: [m/rad]; 0 of a rotation, infinite of a translation.
    """

    text: str
    twist: FloatArray
    kind: ScrewKind = ScrewKind.NONE
    direction: FloatArray = field(default_factory=lambda: np.zeros(3))
    point: FloatArray = field(default_factory=lambda: np.zeros(3))
    pitch: float = 0.0

    @classmethod
    def of(
        cls,
        kind: ScrewKind,
        direction: FloatArray,
        point: FloatArray,
        pitch: float,
        centre: FloatArray,
        text: str = "",
    ) -> Motion:
        """A motion about a line, or along a direction, of any length.

        Args:
            kind: Translation, rotation or screw.
            direction: (3,) not zero.
            point: (3,) of the axis [m]; of a translation it does not matter.
            pitch: Of a screw [m/rad].
            centre: (3,) about which the twist is [m].
            text: As it was written; else words are made.
        """
        unit = direction / np.max(np.abs(direction))
        unit = unit / np.linalg.norm(unit)
        if kind is ScrewKind.TRANSLATION:
            pitch, twist = math.inf, np.concatenate((np.zeros(3), unit))
        else:
            pitch = pitch if kind is ScrewKind.SCREW else 0.0
            twist = np.concatenate((unit, np.cross(point - centre, unit) + pitch * unit))
        along = next(
            (
                name
                for name, axis in zip("xyz", np.eye(3), strict=True)
                if (direction == axis).all()
            ),
            _in_brackets(direction),
        )
        line = "" if kind is ScrewKind.TRANSLATION else f" about {_in_brackets(point)} along"
        end = f" pitch {pitch!r}" if kind is ScrewKind.SCREW else ""
        made = f"{kind}{line} {along}{end}"
        return cls(text or made, twist, kind, direction, point, pitch)

    def to_dict(self, centre: FloatArray, size: float) -> dict[str, Any]:
        """Its entry in a file; `centre` and `size` are those of the problem."""
        if self.kind is ScrewKind.NONE:
            found = screw_of(self.twist[:3], self.twist[3:], centre, size)
            motion = Motion.of(found.kind, found.direction, found.point, found.pitch, centre)
            return motion.to_dict(centre, size)
        made: dict[str, Any] = {"kind": str(self.kind), "direction": self.direction.tolist()}
        if self.kind is not ScrewKind.TRANSLATION:
            made["point"] = self.point.tolist()
        return {**made, "pitch": self.pitch} if self.kind is ScrewKind.SCREW else made


def _in_brackets(vector: FloatArray) -> str:
    return f"({', '.join(f'{part:.6g}' for part in vector)})"


@dataclass(frozen=True, eq=False)
class Limits(Frozen):
    """What a flexure may be.

    Attributes:
        kinds: Of `KINDS`.
        length: Least and largest length of a wire, a sheet, or a leaf of a folded sheet [m].
        width: Least and largest breadth of a sheet [m].
        thickness: Least and largest thickness of a sheet [m]; layouts begin with their geometric
            mean.
        diameter: Least and largest diameter of a wire [m]; likewise.
        clearance: Least distance between the surfaces of two flexures, and to keep-outs [m].
        over_constraint: How many self-stresses a layout may have.
        bodies: How many bodies may be between stage and ground.
    """

    kinds: tuple[str, ...]
    length: tuple[float, float]
    width: tuple[float, float]
    thickness: tuple[float, float]
    diameter: tuple[float, float]
    clearance: float
    over_constraint: int
    bodies: int


@dataclass(frozen=True, eq=False)
class Problem(Frozen):
    """What is wanted of a body, and what a layout may use.

    Attributes:
        title: What it is called.
        wanted: The wanted motions, independent of each other; none holds the body in all six ways.
        stage: Where flexures may end on the body.
        ground: Where they may end on the ground.
        keep_out: What no flexure and no body may touch.
        intermediate: Where bodies between may be; empty where anything goes.
        centre: (3,) of the stage, where stiffness is asked for and its mass is [m].
        size: L, by which rotations compare with displacements [m].
        limits: What a flexure may be.
        symmetry: "any", "none", "mirror x", "3-fold about z", ...
        material: Of the flexures.
        mass: Of the stage [kg]; 0 where it is not given.
        inertia: (3, 3) of the stage about the centre [kg m2]; zeros where it is not given.
        rank: The key of `scores` by which layouts are ordered, and whether less is better.
        count: How many layouts are shown.
        base: The model that the stage is of, where flexures hold it already; None without.
        body: What the stage is called in it.
        remarks: Sentences about what was taken where nothing was said, or not just as it was said.
        units: In which lengths are told.
    """

    title: str
    wanted: tuple[Motion, ...]
    stage: Region
    ground: Region
    keep_out: tuple[Box, ...]
    intermediate: tuple[Box, ...]
    centre: FloatArray
    size: float
    limits: Limits
    symmetry: str
    material: Material
    mass: float
    inertia: FloatArray
    rank: tuple[str, bool]
    count: int
    base: Model | None = None
    body: str = "stage"
    remarks: tuple[str, ...] = ()
    units: Units = METRES

    @cached_property
    def freedom(self) -> ScrewSpace:
        """T: the twists that are wanted, about the centre."""
        rows = np.array([motion.twist for motion in self.wanted]).reshape(-1, 6)
        scaled = rows * np.repeat((self.size, 1.0), 3)
        orthonormal = np.linalg.qr(scaled.T)[0].T if len(rows) else scaled
        return ScrewSpace(orthonormal / np.repeat((self.size, 1.0), 3), self.centre, self.size)

    @property
    def constraint(self) -> ScrewSpace:
        """W: the wrenches that do no work on what is wanted."""
        return self.freedom.reciprocal

    def to_dict(self) -> dict[str, Any]:
        """The problem as a file has it, all in SI; it reads back as the same problem."""
        key, less = self.rank
        limits = self.limits
        made: dict[str, Any] = {
            "title": self.title,
            "wanted": [each.to_dict(self.centre, self.size) for each in self.wanted],
            "stage": self.stage.to_dict(),
            "ground": self.ground.to_dict(),
            "keep_out": Region(self.keep_out).to_dict(),
            "intermediate": Region(self.intermediate).to_dict(),
            "centre": self.centre.tolist(),
            "size": self.size,
            "limits": {
                "kinds": list(limits.kinds),
                "length": list(limits.length),
                "width": list(limits.width),
                "thickness": _one_or_two(limits.thickness),
                "diameter": _one_or_two(limits.diameter),
                "clearance": limits.clearance,
                "over_constraint": limits.over_constraint,
                "bodies": limits.bodies,
            },
            "symmetry": self.symmetry,
            "material": values_of(self.material),
            "mass": self.mass,
            "inertia": _least_of(self.inertia),
            "rank": f"{'lower' if less else 'higher'}:{key}",
            "count": self.count,
        }
        if self.base is not None:
            made |= {"deck": self.base.to_deck(), "body": self.body}
        return made


def values_of(material: Material) -> dict[str, Any]:
    """What is known of a material, as a table or a call of `flexact.Material` has it, all in SI."""
    values = {each.name: getattr(material, each.name) for each in fields(material)}
    return {name: value for name, value in values.items() if value not in (None, "")}


def _one_or_two(pair: tuple[float, float]) -> float | list[float]:
    return pair[0] if pair[0] == pair[1] else list(pair)


def _least_of(inertia: FloatArray) -> float | list[float]:
    """One moment of inertia, three, or six: Jxx, Jxy, Jxz, Jyy, Jyz, Jzz."""
    three = np.diag(inertia)
    if np.any(inertia != np.diag(three)):
        return [float(each) for each in inertia[np.triu_indices(3)]]
    return float(three[0]) if (three == three[0]).all() else [float(each) for each in three]
