# SPDX-License-Identifier: BSD-3-Clause
"""Vectors; rigid movements and reflections of places, directions, frames, inertia."""

from __future__ import annotations

import math
from typing import NamedTuple

Vector = tuple[float, float, float]
#: What the vector of an element is where none is given.
NO_VECTOR: Vector = (0.0, 0.0, 0.0)
Matrix = tuple[Vector, Vector, Vector]
IDENTITY: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
#: Where the sine is known to the last bit, in steps of 30 degrees.
_SINES = (0.0, 0.5, math.sqrt(0.75), 1.0)
#: An entry of an image is no whole number beyond this.
_ROUNDING = 1.0e-9


def unit(given: Vector) -> Vector:
    """The vector of length one along this one; zero of zero."""
    largest = max(map(abs, given))
    if largest == 0.0:
        return NO_VECTOR
    x, y, z = (part / largest for part in given)
    norm = math.hypot(x, y, z)
    return x / norm, y / norm, z / norm


def cross(a: Vector, b: Vector) -> Vector:
    """The vector product a x b."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


class Transform(NamedTuple):
    """x goes to matrix x + shift; the matrix is orthogonal.

    Attributes:
        matrix: (3, 3) rows.
        shift: (3,) [m].
    """

    matrix: Matrix
    shift: Vector

    def place(self, x: Vector) -> Vector:
        """The image of a place."""
        a, b, c = self.turned(x)
        return a + self.shift[0], b + self.shift[1], c + self.shift[2]

    def turned(self, v: Vector) -> Vector:
        """The image of a direction."""
        a, b, c = (row[0] * v[0] + row[1] * v[1] + row[2] * v[2] for row in self.matrix)
        return a, b, c

    def turned_axially(self, v: Vector) -> Vector:
        """The image of a rotation or a moment, which a mirror image reverses."""
        a, b, c = self.turned(v)
        return (-a, -b, -c) if self.is_mirror else (a, b, c)

    def after(self, first: Transform) -> Transform:
        """That which does `first`, then this."""
        columns = [self.turned((c[0], c[1], c[2])) for c in zip(*first.matrix, strict=True)]
        x, y, z = ((row[0], row[1], row[2]) for row in zip(*columns, strict=True))
        return Transform((x, y, z), self.place(first.shift))

    @property
    def inverse(self) -> Transform:
        """That which takes it back."""
        x, y, z = ((c[0], c[1], c[2]) for c in zip(*self.matrix, strict=True))
        back = Transform((x, y, z), NO_VECTOR)
        a, b, c = back.turned(self.shift)
        return back._replace(shift=(-a, -b, -c))

    @property
    def is_mirror(self) -> bool:
        """Whether it turns a right hand into a left one."""
        (a, b, c), (d, e, f), (g, h, i) = self.matrix
        return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) < 0.0

    def euler(self, value: tuple[float, ...]) -> tuple[float, ...]:
        """Euler parameters of the image of an orientation; unturned stays unturned."""
        x, y, z = self.turned((value[1], value[2], value[3]))
        sign = -1.0 if self.is_mirror else 1.0
        return value[0], sign * x, sign * y, sign * z

    def inertia(self, value: tuple[float, ...]) -> tuple[float, ...]:
        """Jxx, Jxy, Jxz, Jyy, Jyz, Jzz of the image of a body."""
        xx, xy, xz, yy, yz, zz = value
        rows = [self.turned(column) for column in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))]
        columns = list(zip(*rows, strict=True))
        made = [self.turned((c[0], c[1], c[2])) for c in columns]
        return made[0][0], made[0][1], made[0][2], made[1][1], made[1][2], made[2][2]

    def axes(self, chosen: set[int]) -> set[int] | None:
        """The axes that span the image of some axes; None where no axes do."""
        found = set()
        for k in range(3):
            size = sum(self.matrix[k][j] ** 2 for j in chosen)
            if abs(size - 1.0) < _ROUNDING:
                found.add(k)
            elif size > _ROUNDING:
                return None
        return found


def rotation(axis: Vector, degrees: float, at: Vector) -> Transform:
    """The rotation about an axis through a point; exact for multiples of 30 degrees about x, y, z.

    Args:
        axis: A vector along it.
        degrees: The angle, right-handed [degrees].
        at: A point of the axis [m].
    """
    n = unit(axis)
    s, c = sine(degrees), sine(degrees + 90.0)
    skew = ((0.0, -n[2], n[1]), (n[2], 0.0, -n[0]), (-n[1], n[0], 0.0))
    x, y, z = (
        [(c if i == j else 0.0) + (1.0 - c) * n[i] * n[j] + s * skew[i][j] for j in range(3)]
        for i in range(3)
    )
    return _about(((x[0], x[1], x[2]), (y[0], y[1], y[2]), (z[0], z[1], z[2])), at)


def reflection(normal: Vector, at: Vector) -> Transform:
    """The mirror image in a plane through a point [m]."""
    n = unit(normal)
    x, y, z = ([one - 2.0 * n[i] * n[j] for j, one in enumerate(IDENTITY[i])] for i in range(3))
    return _about(((x[0], x[1], x[2]), (y[0], y[1], y[2]), (z[0], z[1], z[2])), at)


def _about(matrix: Matrix, at: Vector) -> Transform:
    moved = Transform(matrix, NO_VECTOR).turned(at)
    return Transform(matrix, (at[0] - moved[0], at[1] - moved[1], at[2] - moved[2]))


def sine(degrees: float) -> float:
    """The sine of an angle in degrees, right to the last bit for multiples of 30."""
    angle = math.fmod(degrees, 360.0)
    steps = round(angle / 30.0)
    if angle != 30.0 * steps:
        return math.sin(math.radians(angle))
    steps %= 12
    sign = -1.0 if steps > 6 else 1.0
    steps %= 6
    return sign * _SINES[min(steps, 6 - steps)] + 0.0


class Place(NamedTuple):
    """A place that was computed [m], whatever the units of the model are."""

    x: float
    y: float
    z: float


def on_circle(centre: Vector, radius: float, degrees: float) -> Place:
    """The point of a circle about z at an angle from x [degrees]."""
    x, y = radius * sine(degrees + 90.0), radius * sine(degrees)
    return Place(centre[0] + x, centre[1] + y, centre[2])
