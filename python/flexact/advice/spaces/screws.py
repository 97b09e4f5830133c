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

import numpy as np

from ...analysis.screws import ROUNDING, sense_of
from ...core.arrays import FloatArray
from .families import SAME, Family, FamilyKind
from .flat_families import directions_of, flat_family, line_of
from .principal_screws import principal_screws
from .reguli import regulus_of

_ORDER = {kind: place for place, kind in enumerate(FamilyKind)}
#: How many lines of a congruence are given.
_SAMPLES = 12


def families_of(rows: FloatArray, about: FloatArray, length: float) -> tuple[Family, ...]:
    """The families in the space of some rows, lines first.

    Args:
        rows: (k, 6) orthonormal, the first three components times the length.
        about: (3,) the point of the moments [m].
        length: [m].
    """
    if not len(rows):
        return ()
    free, lined = parted(rows)
    found, spanned = [], [np.zeros((0, 6)), free]
    for family, span in _lines(np.concatenate((lined, free))):
        found.append(family)
        spanned.append(span)
    found += [directions_of(free)] if len(free) else []
    found += principal_screws(lined, np.concatenate(spanned), len(rows))
    return tuple(sorted((_placed(family, about, length) for family in found), key=_order))


def _order(family: Family) -> tuple[int, float, tuple[float, ...]]:
    """Lines, directions, screws; what eigenvectors came first does not matter."""
    shown = np.concatenate((family.direction, family.normal, family.point))
    return _ORDER[family.kind], round(family.pitch, 9), tuple(np.round(shown, 9).tolist())


def parted(rows: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The directions without a line in a space, and the rest of it, both orthonormal rows."""
    left, sizes, _ = np.linalg.svd(rows[:, :3])
    count = int(np.sum(sizes > SAME))
    made = left.T @ rows
    made[count:, :3] = 0.0
    free = made[count:]
    if len(free):
        free = np.linalg.qr(free[:, 3:].T)[0].T
        free = np.concatenate((np.zeros_like(free), free), axis=1)
    lined = made[:count]
    # Rounding that was cut off the directions is cut off the rest.
    return free, lined - (lined @ free.T) @ free


def span_of_lines(rows: FloatArray) -> FloatArray:
    """(n, 6) rows that span all lines in the space of some; arguments as of `families_of`."""
    if not len(rows):
        return rows
    return np.concatenate([rows[:0], *(span for _, span in _lines(np.concatenate(parted(rows))))])


def _form_of(rows: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Eigenvalues, ascending, and eigenvectors of q on a space, in its rows."""
    form = rows[:, :3] @ rows[:, 3:].T
    values, vectors = np.linalg.eigh((form + form.T) / 2.0)
    return values, vectors


def _lines(rows: FloatArray) -> Iterator[tuple[Family, FloatArray]]:
    """Each family of lines, and rows that span it."""
    values, vectors = _form_of(rows)
    plus, minus = values > SAME, values < -SAME
    rest = vectors[:, ~(plus | minus)].T @ rows
    p, n = int(plus.sum()), int(minus.sum())
    if p == 0 or n == 0:
        yield from _flat(rest)
    elif p == n == 1:
        up = vectors[:, plus][:, 0] @ rows / np.sqrt(values[plus][0])
        down = vectors[:, minus][:, 0] @ rows / np.sqrt(-values[minus][0])
        for factor in (up + down, up - down):
            yield from _flat(np.concatenate((factor[None], rest)))
    elif len(rows) == 3:
        yield regulus_of(rows, values, vectors), rows
    else:
        yield _of_reciprocal(rows), rows


def _flat(rows: FloatArray) -> Iterator[tuple[Family, FloatArray]]:
    if not len(rows):
        return
    free, lined = parted(np.linalg.qr(rows.T)[0].T)
    if len(lined):
        yield flat_family(free, lined), rows


def _of_reciprocal(rows: FloatArray) -> Family:
    """The lines in four or more dimensions, by the one or two that all of them meet."""
    if len(rows) == 6:
        return Family(FamilyKind.EVERY)
    right = np.linalg.svd(np.roll(rows, 3, axis=1))[2]
    free, lined = parted(right[len(rows) :])
    met = [family for family, _ in _lines(np.concatenate((lined, free)))]
    if len(rows) == 5:
        return _complex(free, lined)
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
    return _congruence(right[len(rows) :])


def _congruence(met: FloatArray) -> Family:
    """Lines reciprocal to two screws, through points of a circle about the middle."""
    across = np.linalg.svd(met[:, :3])[2]
    points, directions = [], []
    for angle in 2.0 * np.pi * np.arange(_SAMPLES) / _SAMPLES:
        point = (np.cos(angle) * across[0] + np.sin(angle) * across[1]) / 2.0
        # A line along w through p is reciprocal to (a, b) where (a x p + b).w = 0.
        one, other = np.cross(met[:, :3], point) + met[:, 3:]
        way = np.cross(one, other)
        size = float(np.linalg.norm(way))
        if size > SAME:
            points.append(point)
            directions.append(way / size)
    return Family(
        FamilyKind.CONGRUENCE,
        points=np.array(points).reshape(-1, 3),
        directions=np.array(directions).reshape(-1, 3),
    )


def _complex(free: FloatArray, lined: FloatArray) -> Family:
    """The lines reciprocal to one screw."""
    if len(free):
        return Family(FamilyKind.ACROSS, direction=free[0, 3:])
    point, direction, pitch = line_of(lined[0])
    kind = FamilyKind.COMPLEX if abs(pitch) > SAME else FamilyKind.MEETING
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
    made: FloatArray = sense_of(vector) * np.where(np.abs(vector) > ROUNDING, vector, 0.0) + 0.0
    return made
