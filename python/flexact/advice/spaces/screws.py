# SPDX-License-Identifier: BSD-3-Clause
"""Which lines, directions and screws are in a space of twists or wrenches.

On six numbers s = (a, b), a line's direction and its moment, q(s) = a.b is zero where s is a line
or a direction without a line (Klein's quadric). On a space of k dimensions q has p positive, n
negative and z zero eigenvalues, and that says what lines there are:

- q = 0 all over, or p n = 0: the z dimensions on which q vanishes, a flat family;
- p = n = 1: two flat families of z + 1 dimensions, the factors of q;
- of three dimensions and p + n = 3: a regulus, on a hyperboloid or a hyperbolic paraboloid;
- of four, five or six: the lines that meet, in the projective sense, all lines of the reciprocal
  space, of two, one or no dimensions.

In a flat family any two lines meet: with f dimensions, t of them directions without a line, it is
one line (f, t = 1, 0), a pencil (2, 0), parallels in a plane (2, 1), all lines through a point
(3, 0), in a plane (3, 1), or of one direction (3, 2). Sources: Hunt, *Kinematic Geometry of
Mechanisms*, 1978, chapters 11 and 12; Gibson and Hunt, "Geometry of screw systems", Mechanism and
Machine Theory 25, 1990; Hopkins and Culpepper, "Synthesis of multi-degree of freedom, parallel
flexure system concepts via FACT", Precision Engineering 34, 2010.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import Enum
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from ...analysis.limits import ROUNDING
from ...analysis.screws import sense_of
from ...core.arrays import FloatArray, floats
from ...util.records import Frozen, cached_property

#: Directions off by so little [rad], or lines by this part of the characteristic length, are one:
#: in a design as it is drawn, and in a space that is given exactly.
SAME, EXACT = 1.0e-4, 1.0e-9


class FamilyKind(str, Enum):
    """What a family is."""

    LINE = "one line"
    PENCIL = "all lines through a point in a plane"
    PARALLELS_IN_PLANE = "all parallel lines in a plane"
    BUNDLE = "all lines through a point"
    PARALLELS = "all parallel lines"
    PLANE = "all lines in a plane"
    REGULUS = "lines on a ruled quadric"
    MEETING_TWO = "all lines that meet two lines"
    MEETING_ACROSS = "all lines that meet a line and are perpendicular to a direction"
    CONGRUENCE = "a linear congruence"
    MEETING = "all lines that meet a line"
    ACROSS = "all lines perpendicular to a direction"
    COMPLEX = "a linear complex"
    EVERY = "every line"
    DIRECTION = "one direction"
    DIRECTIONS_IN_PLANE = "all directions in a plane"
    EVERY_DIRECTION = "every direction"
    SCREW = "one screw"


#: Kinds whose members are directions: translations, or couples.
DIRECTIONS = frozenset(
    (FamilyKind.DIRECTION, FamilyKind.DIRECTIONS_IN_PLANE, FamilyKind.EVERY_DIRECTION)
)


@dataclass(frozen=True, eq=False)
class Family(Frozen):
    """Lines, directions or screws that belong together.

    | kind | `point` | `direction` | `normal` | `points`, `directions` |
    |---|---|---|---|---|
    | `LINE` | on it | along it | | the line |
    | `PENCIL` | through which all go | | of the plane | |
    | `PARALLELS_IN_PLANE` | in the plane | along all | of the plane | |
    | `BUNDLE` | through which all go | | | |
    | `PARALLELS` | | along all | | |
    | `PLANE` | in the plane | | of the plane | |
    | `REGULUS` | the middle of the quadric | axis of a hyperboloid | of the plane to which all \
are parallel, of a paraboloid | twelve of the lines |
    | `MEETING_TWO` | | | | the two lines |
    | `MEETING_ACROSS` | | to which all are perpendicular | | the line that all meet |
    | `CONGRUENCE` | | | | some of its lines |
    | `MEETING` | on the line | along it | | the line that all meet |
    | `ACROSS` | | to which all are perpendicular | | |
    | `COMPLEX` | on the axis | along it | | the axis |
    | `EVERY` | | | | |
    | `DIRECTION` | | it | | |
    | `DIRECTIONS_IN_PLANE` | | | of the plane | |
    | `EVERY_DIRECTION` | | | | |
    | `SCREW` | on the axis | along it | | the axis |

    Attributes:
        kind: What it is.
        point: (3,) [m]; of lines and planes the point nearest to the body's middle.
        direction: (3,) unit vector; zero where there is none.
        normal: (3,) unit vector; zero where there is none.
        pitch: Of a screw [m/rad]; of a complex that of the screw to which all its lines are
            reciprocal [m].
        points: (n, 3) of lines, one each [m].
        directions: (n, 3) unit vectors along them.
    """

    kind: FamilyKind
    point: FloatArray = field(default_factory=partial(np.zeros, 3))
    direction: FloatArray = field(default_factory=partial(np.zeros, 3))
    normal: FloatArray = field(default_factory=partial(np.zeros, 3))
    pitch: float = 0.0
    points: FloatArray = field(default_factory=partial(np.zeros, (0, 3)))
    directions: FloatArray = field(default_factory=partial(np.zeros, (0, 3)))

    @property
    def is_of_lines(self) -> bool:
        """Whether its members are lines: of rotations, or of forces."""
        return self.kind not in DIRECTIONS and self.kind is not FamilyKind.SCREW

    @property
    def is_of_directions(self) -> bool:
        """Whether its members are directions: of translations, or of couples."""
        return self.kind in DIRECTIONS


def line_of(row: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Point, direction and pitch of a screw, (6,)."""
    axis, moment = row[:3], row[3:]
    square = float(axis @ axis)
    point = np.cross(axis, moment) / square
    return point, _unit(axis), float(axis @ moment) / square


def directions_of(free: FloatArray) -> Family:
    """The family of all directions in the space of some, (t, 6) orthonormal."""
    if len(free) == 1:
        return Family(FamilyKind.DIRECTION, direction=_unit(free[0, 3:]))
    if len(free) == 2:
        normal = _unit(np.cross(free[0, 3:], free[1, 3:]))
        return Family(FamilyKind.DIRECTIONS_IN_PLANE, normal=normal)
    return Family(FamilyKind.EVERY_DIRECTION)


def flat_family(free: FloatArray, lined: FloatArray) -> Family:
    """The family of lines, of which there is one, any two of which meet.

    Args:
        free: (t, 6) its directions without a line, orthonormal.
        lined: (f - t, 6) the rest, perpendicular to these.
    """
    axes, moments = lined[:, :3], lined[:, 3:]
    point, direction, _ = line_of(lined[0])
    if len(lined) == 1:
        if not len(free):
            return Family(FamilyKind.LINE, point, direction)
        if len(free) == 2:
            return Family(FamilyKind.PARALLELS, direction=direction)
        normal = _unit(free[0, 3:])
        height = float(normal @ point)
        return Family(FamilyKind.PARALLELS_IN_PLANE, height * normal, direction, normal)
    if len(free):
        normal = _unit(free[0, 3:])
        # A line at d from the middle has the moment d x a; along the normal that is the height.
        across = np.cross(normal, axes)
        height = float(np.sum(across * moments) / np.sum(across * across))
        return Family(FamilyKind.PLANE, height * normal, normal=normal)
    # The point d through which all lines go: d x a = b for each.
    matrix = np.concatenate([np.cross(np.eye(3), axis).T for axis in axes])
    point = np.asarray(np.linalg.lstsq(matrix, moments.ravel(), rcond=None)[0])
    if len(lined) == 2:
        normal = _unit(np.cross(axes[0], axes[1]))
        return Family(FamilyKind.PENCIL, point, normal=normal)
    return Family(FamilyKind.BUNDLE, point)


def _unit(vector: FloatArray) -> FloatArray:
    return np.asarray(sense_of(vector) * vector / np.linalg.norm(vector))


#: How many lines of it are given.
_SAMPLES = 12


def regulus_of(
    rows: FloatArray, values: FloatArray, vectors: FloatArray, same: float = SAME
) -> Family:
    """The regulus of a space of three dimensions.

    Args:
        rows: (3, 6) that span it.
        values: (3,) eigenvalues of q on it, of both signs.
        vectors: (3, 3) their eigenvectors.
        same: What is smaller is zero.
    """
    points, directions = _samples(rows, values, vectors, same)
    _, sizes, right = np.linalg.svd(rows[:, :3])
    if sizes[-1] > same:
        point, axis = _middle(rows)
        return Family(
            FamilyKind.REGULUS, point, direction=axis, points=points, directions=directions
        )
    normal = sense_of(right[2]) * right[2]
    # The vertex is no more than a point to look at: the mean of the middles of some lines.
    return Family(
        *(FamilyKind.REGULUS, points.mean(axis=0)),
        normal=normal,
        points=points,
        directions=directions,
    )


def _samples(
    rows: FloatArray, values: FloatArray, vectors: FloatArray, same: float
) -> tuple[FloatArray, FloatArray]:
    """Points and directions of lines all round."""
    scaled = (vectors / np.sqrt(np.abs(values))).T @ rows
    lone = int(np.argmax(np.sign(values) != np.sign(np.sum(np.sign(values)))))
    one, other = (scaled[k] for k in range(3) if k != lone)
    points, directions = [], []
    for angle in 2.0 * np.pi * (np.arange(_SAMPLES) + 0.5) / _SAMPLES:
        screw = np.cos(angle) * one + np.sin(angle) * other + scaled[lone]
        if np.linalg.norm(screw[:3]) > same * np.linalg.norm(screw):
            point, direction, _ = line_of(screw)
            points.append(point)
            directions.append(direction)
    return np.array(points), np.array(directions)


def _middle(rows: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The centre of the hyperboloid and the direction of its axis.

    Every rotation a has the moment M a; the skew part of M is that of the centre, and the
    symmetric part has the principal pitches.
    """
    matrix = np.linalg.solve(rows[:, :3], rows[:, 3:]).T
    skew = (matrix - matrix.T) / 2.0
    point = np.array([skew[2, 1], skew[0, 2], skew[1, 0]])
    pitches, axes = np.linalg.eigh((matrix + matrix.T) / 2.0)
    # Of three pitches of both signs the lone one is the first or the last.
    lone = 0 if pitches[1] > 0.0 else 2
    axis = axes[:, lone]
    return point, sense_of(axis) * axis


def principal_screws(
    lined: FloatArray, spanned: FloatArray, count: int, same: float = SAME
) -> list[Family]:
    """Those of a space that its lines and directions do not span.

    Args:
        lined: (n, 6) independent rows, without directions, perpendicular to these.
        spanned: (m, 6) rows that its lines and directions span.
        count: Its dimension.
        same: What is smaller is zero.
    """
    if _rank(spanned, same) == count:
        return []
    made = []
    for row in principal_rows(lined, same):
        more = np.concatenate((spanned, row[None]))
        if _rank(more, same) > _rank(spanned, same):
            spanned = more
            point, direction, pitch = line_of(row)
            kind = FamilyKind.SCREW if abs(pitch) > same else FamilyKind.LINE
            made.append(Family(kind, point, direction, pitch=pitch * (kind is FamilyKind.SCREW)))
    return made


def principal_rows(lined: FloatArray, same: float = SAME) -> FloatArray:
    """(n, 6) the principal screws of rows as of `principal_screws`, with unit axes."""
    if not len(lined):
        return lined
    # Pitches are stationary, h = a.b/a.a, at the principal screws (Ball 1900).
    back = np.linalg.inv(np.linalg.cholesky(lined[:, :3] @ lined[:, :3].T))
    form = lined[:, :3] @ lined[:, 3:].T
    pitches, vectors = np.linalg.eigh(back @ (form + form.T) @ back.T / 2.0)
    return np.array(list(_told(pitches, vectors.T @ back @ lined, same)))


def _told(pitches: FloatArray, rows: FloatArray, same: float) -> Iterator[FloatArray]:
    """Screws of unit axes at right angles; of those with one pitch the nearest to x, y and z."""
    first = 0
    while first < pitches.size:
        group = rows[np.abs(pitches - pitches[first]) <= same]
        first += len(group)
        if len(group) == 1:
            yield group[0]
            continue
        taken = np.zeros((0, len(group)))
        for shares in group[:, :3].T:
            rest = shares - (shares @ taken.T) @ taken
            size = float(np.linalg.norm(rest))
            if size > 0.1 and len(taken) < len(group):
                taken = np.concatenate((taken, rest[None] / size))
                yield taken[-1] @ group


def _rank(rows: FloatArray, same: float) -> int:
    """How many of some rows are independent."""
    sizes = np.linalg.norm(rows, axis=1, keepdims=True)
    return int(np.linalg.matrix_rank(rows / sizes, same)) if len(rows) else 0


def families_of(
    rows: FloatArray, about: FloatArray, length: float, same: float = SAME
) -> tuple[Family, ...]:
    """The families in the space of some rows, lines first.

    Args:
        rows: (k, 6) orthonormal, the first three components times the length.
        about: (3,) the point of the moments [m].
        length: [m].
        same: What is smaller is zero.
    """
    if not len(rows):
        return ()
    free, lined = parted(rows, same)
    found, spanned = [], [np.zeros((0, 6)), free]
    for family, span in _lines(np.concatenate((lined, free)), same):
        found.append(family)
        spanned.append(span)
    found += [directions_of(free)] if len(free) else []
    found += principal_screws(lined, np.concatenate(spanned), len(rows), same)
    return tuple(sorted((_placed(family, about, length) for family in found), key=_order))


def _order(family: Family) -> tuple[int, float, tuple[float, ...]]:
    """Lines, directions, screws; what eigenvectors came first does not matter."""
    shown = np.concatenate((family.direction, family.normal, family.point))
    return (
        list(FamilyKind).index(family.kind),
        round(family.pitch, 9),
        tuple(np.round(shown, 9).tolist()),
    )


def parted(rows: FloatArray, same: float = SAME) -> tuple[FloatArray, FloatArray]:
    """The directions without a line in a space, and the rest of it, both orthonormal rows."""
    left, sizes, _ = np.linalg.svd(rows[:, :3])
    count = int(np.sum(sizes > same))
    made = left.T @ rows
    made[count:, :3] = 0.0
    free = made[count:]
    if len(free):
        free = np.linalg.qr(free[:, 3:].T)[0].T
        free = np.concatenate((np.zeros_like(free), free), axis=1)
    lined = made[:count]
    # Rounding that was cut off the directions is cut off the rest.
    return free, lined - (lined @ free.T) @ free


def _lines(rows: FloatArray, same: float) -> Iterator[tuple[Family, FloatArray]]:
    """Each family of lines, about the middle in parts of the length, and rows that span it."""
    form = rows[:, :3] @ rows[:, 3:].T
    # Of q on the space, in its rows.
    values, vectors = np.linalg.eigh((form + form.T) / 2.0)
    plus, minus = values > same, values < -same
    rest = vectors[:, ~(plus | minus)].T @ rows
    p, n = int(plus.sum()), int(minus.sum())
    if p == 0 or n == 0:
        yield from _flat(rest, same)
    elif p == n == 1:
        up = vectors[:, plus][:, 0] @ rows / np.sqrt(values[plus][0])
        down = vectors[:, minus][:, 0] @ rows / np.sqrt(-values[minus][0])
        for factor in (up + down, up - down):
            yield from _flat(np.concatenate((factor[None], rest)), same)
    elif len(rows) == 3:
        yield regulus_of(rows, values, vectors, same), rows
    else:
        yield _of_reciprocal(rows, same), rows


def _flat(rows: FloatArray, same: float) -> Iterator[tuple[Family, FloatArray]]:
    if not len(rows):
        return
    free, lined = parted(np.linalg.qr(rows.T)[0].T, same)
    if len(lined):
        yield flat_family(free, lined), rows


def _of_reciprocal(rows: FloatArray, same: float) -> Family:
    """The lines in four or more dimensions, by the one or two that all of them meet."""
    if len(rows) == 6:
        return Family(FamilyKind.EVERY)
    right = np.linalg.svd(np.roll(rows, 3, axis=1))[2]
    free, lined = parted(right[len(rows) :], same)
    met = [family for family, _ in _lines(np.concatenate((lined, free)), same)]
    if len(rows) == 5:
        return _complex(free, lined, same)
    lines = [family for family in met if family.kind is FamilyKind.LINE]
    points = np.array([line.point for line in lines]).reshape(-1, 3)
    directions = np.array([line.direction for line in lines]).reshape(-1, 3)
    if len(lines) == 2:
        return Family(FamilyKind.MEETING_TWO, points=points, directions=directions)
    if len(lines) == 1 and len(free):
        return Family(
            FamilyKind.MEETING_ACROSS,
            direction=free[0, 3:],
            points=points,
            directions=directions,
        )
    return _congruence(right[len(rows) :], same)


def _congruence(met: FloatArray, same: float) -> Family:
    """Lines reciprocal to two screws, through points of a circle about the middle."""
    across = np.linalg.svd(met[:, :3])[2]
    points, directions = [], []
    for angle in 2.0 * np.pi * np.arange(_SAMPLES) / _SAMPLES:
        point = (np.cos(angle) * across[0] + np.sin(angle) * across[1]) / 2.0
        # A line along w through p is reciprocal to (a, b) where (a x p + b).w = 0.
        one, other = np.cross(met[:, :3], point) + met[:, 3:]
        way = np.cross(one, other)
        size = float(np.linalg.norm(way))
        if size > same:
            points.append(point)
            directions.append(way / size)
    return Family(
        FamilyKind.CONGRUENCE,
        points=np.array(points).reshape(-1, 3),
        directions=np.array(directions).reshape(-1, 3),
    )


def _complex(free: FloatArray, lined: FloatArray, same: float) -> Family:
    """The lines reciprocal to one screw."""
    if len(free):
        return Family(FamilyKind.ACROSS, direction=free[0, 3:])
    point, direction, pitch = line_of(lined[0])
    kind = FamilyKind.COMPLEX if abs(pitch) > same else FamilyKind.MEETING
    return Family(kind, point, direction, pitch=pitch * (kind is FamilyKind.COMPLEX))


def _placed(family: Family, about: FloatArray, length: float) -> Family:
    """A family in metres, from one about the middle in parts of the length."""
    kind = family.kind
    directions, points = family.directions, family.points
    if kind in (FamilyKind.LINE, FamilyKind.SCREW, FamilyKind.COMPLEX, FamilyKind.MEETING):
        points, directions = family.point[None], family.direction[None]
    return Family(
        kind,
        about + length * family.point,
        _with_sense(family.direction),
        _with_sense(family.normal),
        family.pitch * length,
        about + length * points,
        np.array([_with_sense(each) for each in directions]).reshape(-1, 3),
    )


def _with_sense(vector: FloatArray) -> FloatArray:
    """A direction whose first component is positive, with zeros for what is rounding."""
    return np.asarray(sense_of(vector) * np.where(np.abs(vector) > ROUNDING, vector, 0.0) + 0.0)


@dataclass(frozen=True, eq=False)
class ScrewSpace(Frozen):
    """All twists that a body has, or all wrenches that hold it.

    A twist is a rotation w [rad] and the velocity v [m] of the point `about`; a wrench a force
    f [N] and the moment m [N m] about it. Both are six numbers, (w, v) and (f, m): a line first,
    and then its moment. They are reciprocal, the wrench does no work on the twist, where
    w.m + v.f = 0 (Ball 1900; Hunt, *Kinematic Geometry of Mechanisms*, 1978).

    Attributes:
        basis: (k, 6) rows (w, v) or (f, m); with the first three times `length` the rows are
            orthonormal.
        about: (3,) the middle of the body's points [m].
        length: By which rotations compare with displacements, and moments with forces [m].
        of_wrenches: Whether its members are wrenches, not twists.
        planar: Whether it is that of a planar model, with rotations about z and forces in the
            plane alone.
        tolerance: What is smaller, of its scaled rows, is zero: `SAME`, or `EXACT` of a space that
            is given and not measured.
    """

    basis: FloatArray
    about: FloatArray
    length: float
    of_wrenches: bool = False
    planar: bool = False
    tolerance: float = SAME

    @property
    def dimension(self) -> int:
        """How many of them are independent."""
        return int(self.basis.shape[0])

    @property
    def scaled(self) -> FloatArray:
        """(k, 6) the orthonormal rows."""
        return np.asarray(self.basis * self.factors)

    @property
    def factors(self) -> FloatArray:
        """(6,) by which twists and wrenches are made comparable: rows times them are scaled."""
        return np.repeat((self.length, 1.0), 3)

    def of_scaled(self, rows: FloatArray, of_wrenches: bool | None = None) -> ScrewSpace:
        """The space of other scaled rows, about the same point; of twists and wrenches alike."""
        wrenches = self.of_wrenches if of_wrenches is None else of_wrenches
        return ScrewSpace(
            *(rows / self.factors, self.about, self.length, wrenches, self.planar, self.tolerance)
        )

    @cached_property
    def families(self) -> tuple[Family, ...]:
        """The lines, directions and screws in it (`flexact.advice.spaces.screws`)."""
        return families_of(self.scaled, self.about, self.length, self.tolerance)

    @cached_property
    def principal(self) -> tuple[Family, ...]:
        """The principal screws, lines among them, then what directions there are."""
        free, lined = parted(self.scaled, self.tolerance)
        found = principal_screws(lined, np.zeros((0, 6)), self.dimension, self.tolerance)
        found += [directions_of(row[None]) for row in canonical(free)]
        return tuple(_placed(family, self.about, self.length) for family in found)

    @property
    def lines(self) -> tuple[Family, ...]:
        """The families of lines: rotations, or forces."""
        return tuple(family for family in self.families if family.is_of_lines)

    def line(self, point: ArrayLike, direction: ArrayLike, pitch: float = 0.0) -> FloatArray:
        """(6,) the unit screw of a line: a rotation about it, or a force along it.

        Args:
            point: (3,) of the line [m].
            direction: (3,) along it.
            pitch: [m/rad], or [m] of a wrench.
        """
        d = floats(direction, "a direction")
        unit = d / np.linalg.norm(d)
        arm = floats(point, "a point") - self.about
        return np.asarray(np.concatenate((unit, np.cross(arm, unit) + pitch * unit)))

    @staticmethod
    def free(direction: ArrayLike) -> FloatArray:
        """(6,) a translation along a direction, or a couple about it."""
        d = floats(direction, "a direction")
        return np.concatenate((np.zeros(3), d / np.linalg.norm(d)))

    def has(self, screw: FloatArray, limit: float = SAME) -> bool:
        """Whether a twist or a wrench, (6,) as `line` and `free` make them, is in the space.

        No larger part of it than the limit may be beyond.
        """
        scaled = screw * self.factors
        rest = scaled - self.scaled.T @ (self.scaled @ scaled)
        return float(np.linalg.norm(rest) / np.linalg.norm(scaled)) <= limit

    def sine_to(self, other: ScrewSpace) -> float:
        """The sine of the largest angle of this space with another one about the same point."""
        rest = self.scaled - (self.scaled @ other.scaled.T) @ other.scaled
        return float(np.linalg.norm(rest, 2)) if rest.size else 0.0

    def nearest(self, screw: FloatArray) -> FloatArray:
        """(6,) the part of a twist or a wrench that is in the space."""
        scaled = screw * self.factors
        return np.asarray((self.scaled.T @ (self.scaled @ scaled)) / self.factors)

    @cached_property
    def directions(self) -> FloatArray:
        """(t, 6) orthonormal rows of its directions: translations, or couples."""
        return parted(self.scaled, self.tolerance)[0] if self.dimension else np.zeros((0, 6))

    @cached_property
    def span_of_lines(self) -> FloatArray:
        """(n, 6) scaled rows that span its lines, pure rotations or forces."""
        rows = self.scaled
        return np.concatenate((rows[:0], *self.spans))

    @cached_property
    def spans(self) -> tuple[FloatArray, ...]:
        """(n, 6) scaled rows each: what each family of lines spans."""
        rows, same = self.scaled, self.tolerance
        if not len(rows):
            return ()
        return tuple(span for _, span in _lines(np.concatenate(parted(rows, same)), same))

    @cached_property
    def reciprocal(self) -> ScrewSpace:
        """Of twists all wrenches that do no work on them, and the other way round."""
        swapped = np.roll(self.scaled, 3, axis=1)
        used = np.arange(6)
        if self.planar:
            # Twists have wz, vx and vy; wrenches have fx, fy and mz.
            used = np.array([2, 3, 4] if self.of_wrenches else [0, 1, 5])
        made = np.zeros((used.size - self.dimension, 6))
        made[:, used] = complement(swapped[:, used])
        return self.of_scaled(canonical(made), not self.of_wrenches)


def complement(rows: FloatArray) -> FloatArray:
    """(n - k, n) orthonormal rows perpendicular to k independent ones, (k, n)."""
    count, size = rows.shape
    if not count:
        return np.eye(size)
    right: FloatArray = np.linalg.svd(rows)[2]
    return right[count:]


def canonical(rows: FloatArray) -> FloatArray:
    """(k, n) orthonormal rows that follow from the space of some alone: nearest to unit vectors.

    Args:
        rows: (k, n) orthonormal.
    """
    made = np.zeros((0, rows.shape[1]))
    chosen: list[int] = []
    while len(made) < len(rows):
        # The rest of each unit vector within the space, of which the largest is taken.
        rest = rows.T @ rows - made.T @ made
        place = int(np.argmax(np.round(np.diag(rest), 6)))
        made = np.concatenate((made, rest[place][None] / np.linalg.norm(rest[place])))
        chosen.append(place)
    return made[np.argsort(chosen)]
