# SPDX-License-Identifier: BSD-3-Clause
"""What is true of a mechanism in a STEP file, and its counts from lines of constraint alone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

Vector = Sequence[float]


@dataclass(frozen=True)
class Sheet:
    """A leaf that is free to bend between `p` and `q`, where bodies or folds begin [mm].

    `p` and `q` are on the middle of the sheet; at a fold it is where the middle planes meet. A
    fillet belongs to the free length. `middle` is the stiff part of a reinforced sheet: its share
    of the length, and its thickness.
    """

    name: str
    between: tuple[str, str]
    p: Vector
    q: Vector
    across: Vector
    width: float
    thickness: float
    middle: tuple[float, float] | None = None

    @property
    def length(self) -> float:
        return float(np.linalg.norm(np.subtract(self.q, self.p)))


@dataclass(frozen=True)
class Bent:
    """A sheet that is bent by a radius between its straight leaves [mm].

    `corners` are its ends and, between them, where the middle planes of its leaves would meet;
    `radius` is that of the middle surface, `length` the developed one.
    """

    name: str
    between: tuple[str, str]
    corners: Sequence[Vector]
    across: Vector
    width: float
    thickness: float
    radius: float
    length: float


@dataclass(frozen=True)
class Wire:
    """A wire that is free to bend between `p` and `q` [mm]; `sides`: diameter, or two sides.

    Of a strut that is thick between them `middle` is the length of the thin ends; else it is 0.
    """

    name: str
    between: tuple[str, str]
    p: Vector
    q: Vector
    sides: tuple[float, ...]
    middle: float = 0.0

    @property
    def length(self) -> float:
        return float(np.linalg.norm(np.subtract(self.q, self.p)))


@dataclass(frozen=True)
class Notch:
    """A notch that turns about the line through `middle` along `axis` [mm]."""

    name: str
    between: tuple[str, str]
    middle: Vector
    axis: Vector
    thickness: float
    radius: float
    breadth: float


Flexure = Sheet | Bent | Wire | Notch


@dataclass(frozen=True)
class Truth:
    """What is true of a design.

    Attributes:
        ground: The body that stands still, as `bodies` calls it.
        bodies: Of each body, the ground among them, a point inside it [mm]. Folds and the stiff
            middles of reinforced sheets are none.
        flexures: All of them.
        motions: Motions of the bodies, with those that the bodies do not see left out; -1 where it
            is not known, as what a part holds is not.
        over: Over-constrained by; -1 likewise.
        inner: Motions that no body sees: one at each fold, which turns about itself. Where the
            stiff middle of a reinforced sheet is made a body, each has three more.
        told: Names of what must be told before the verdict, as a doubt.
        is_named: Whether the CAD calls bodies and flexures as they are called here.
        must_name_ground: Whether the file does not say which the ground is, and it is not the
            largest: `--ground` or a choice has to.
        more_grounds: Bodies that stand still besides.
        loose: Bodies that hang on nothing: each has six motions besides, if it is kept.
        why: The counts in words, with their source.
    """

    ground: str
    bodies: Mapping[str, Vector]
    flexures: tuple[Flexure, ...]
    motions: int
    over: int
    inner: int = 0
    told: tuple[str, ...] = ()
    is_named: bool = True
    must_name_ground: bool = False
    loose: tuple[str, ...] = ()
    more_grounds: tuple[str, ...] = ()
    why: str = field(default="", compare=False)

    def count(self, kind: type) -> int:
        return sum(isinstance(each, kind) for each in self.flexures)


def wrenches(flexure: Flexure) -> np.ndarray:
    """What a flexure holds, one force and its moment about the origin a row, shape (n, 6).

    A sheet holds two forces in its plane and the moment about its normal, a wire the force along
    itself, a notch all but the moment about its axis: D. L. Blanding, Exact Constraint: Machine
    Design Using Kinematic Principles, ASME Press 1999. A folded sheet, made of two
    sheets and a fold that is free, holds the force along its fold; so does one that is bent by
    a small radius.
    """
    if isinstance(flexure, Bent):
        if len(flexure.corners) != 3:
            return np.zeros((0, 6))
        return np.array([_force(flexure.corners[1], flexure.across)])
    if isinstance(flexure, Wire):
        return np.array([_force(flexure.p, np.subtract(flexure.q, flexure.p))])
    if isinstance(flexure, Sheet):
        along, across = np.subtract(flexure.q, flexure.p), np.asarray(flexure.across, float)
        normal = np.cross(along, across)
        moment = np.array([np.zeros(3), normal / np.linalg.norm(normal)]).ravel()
        return np.array([_force(flexure.p, along), _force(flexure.p, across), moment])
    axis = np.asarray(flexure.axis, float) / np.linalg.norm(flexure.axis)
    one = np.eye(3)[np.argmin(np.abs(axis))]
    across = np.cross(axis, one)
    across /= np.linalg.norm(across)
    rows = [_force(flexure.middle, d) for d in np.eye(3)]
    rows += [np.r_[np.zeros(3), d] for d in (across, np.cross(axis, across))]
    return np.array(rows)


def _force(at: Vector, along: Vector) -> np.ndarray:
    along = np.asarray(along, float) / np.linalg.norm(along)
    return np.r_[along, np.cross(at, along)]


def counts(truth: Truth) -> tuple[int, int]:
    """Under- and over-constrained by, from the rank of all that the flexures hold.

    Under-constrained counts the turning folds; loose bodies are left out.
    """
    names = {name for each in truth.flexures for name in each.between}
    names -= {truth.ground, *truth.more_grounds}
    column = {name: 6 * k for k, name in enumerate(sorted(names))}
    rows = []
    for each in truth.flexures:
        held = wrenches(each)
        # Moments in units of 50 mm, so that they weigh like forces.
        held = held / np.array([1, 1, 1, 50, 50, 50])
        row = np.zeros((len(held), 6 * len(column)))
        for name, sign in zip(each.between, (1, -1), strict=True):
            if name in column:
                row[:, column[name] : column[name] + 6] += sign * held
        rows.append(row)
    matrix = np.vstack(rows)
    rank = int(np.linalg.matrix_rank(matrix, tol=1e-9 * len(matrix)))
    return matrix.shape[1] - rank, matrix.shape[0] - rank
