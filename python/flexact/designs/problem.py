# SPDX-License-Identifier: BSD-3-Clause
"""A design problem: what a body is to do, and where flexures may be."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..advice.spaces.screws import ScrewSpace
from ..core.arrays import FloatArray
from ..model.model import Model
from ..model.sections import Material
from ..util.records import Frozen, cached_property

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


@dataclass(frozen=True, eq=False)
class Region(Frozen):
    """Where flexures may end on a body or on the ground: in any of some boxes, and at points.

    Attributes:
        boxes: The boxes.
        points: (n, 3) the points [m].
    """

    boxes: tuple[Box, ...] = ()
    points: FloatArray = field(default_factory=lambda: np.zeros((0, 3)))


@dataclass(frozen=True, eq=False)
class Motion(Frozen):
    """One wanted motion.

    Attributes:
        text: As it was written.
        twist: (6,) unit twist (w, v) about the centre: rotation [rad] and its velocity [m].
    """

    text: str
    twist: FloatArray


@dataclass(frozen=True, eq=False)
class Limits(Frozen):
    """What a flexure may be.

    Attributes:
        kinds: Of `KINDS`.
        length: Least and largest length of a wire, a sheet, or a leaf of a folded sheet [m].
        width: Least and largest breadth of a sheet [m].
        thickness: Least and largest thickness of a sheet [m]; layouts begin with the geometric mean.
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
