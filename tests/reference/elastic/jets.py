# SPDX-License-Identifier: BSD-3-Clause
"""Second-order Taylor arithmetic: a value with its gradient and its Hessian.

Functions written with these numbers give first and second derivatives to rounding, and nobody has
derived one by hand. Every jet is a batch of B numbers that depend on the same n variables.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]


def _outer(a: Real, b: Real) -> Real:
    return np.asarray(a[:, :, None] * b[:, None, :])


@dataclass(frozen=True)
class Jet:
    """B values (B,), gradients (B, n) and Hessians (B, n, n)."""

    value: Real
    gradient: Real
    hessian: Real

    @staticmethod
    def constant(value: Real, count: int) -> Jet:
        batch = len(value)
        return Jet(np.array(value), np.zeros((batch, count)), np.zeros((batch, count, count)))

    @staticmethod
    def variable(value: Real, index: int, count: int) -> Jet:
        jet = Jet.constant(value, count)
        jet.gradient[:, index] = 1
        return jet

    def apply(self, value: Real, first: Real, second: Real) -> Jet:
        """A function of one variable, with its first two derivatives, applied to this."""
        gradient = first[:, None] * self.gradient
        hessian = first[:, None, None] * self.hessian
        hessian = hessian + second[:, None, None] * _outer(self.gradient, self.gradient)
        return Jet(value, gradient, hessian)

    def __add__(self, other: Jet | float) -> Jet:
        if not isinstance(other, Jet):
            return Jet(self.value + other, self.gradient, self.hessian)
        return Jet(
            self.value + other.value,
            self.gradient + other.gradient,
            self.hessian + other.hessian,
        )

    __radd__ = __add__

    def __neg__(self) -> Jet:
        return Jet(-self.value, -self.gradient, -self.hessian)

    def __sub__(self, other: Jet | float) -> Jet:
        return self + (-other)

    def __mul__(self, other: Jet | Real | float) -> Jet:
        if not isinstance(other, Jet):
            factor = np.broadcast_to(np.asarray(other, dtype=float), self.value.shape)
            return self.apply(factor * self.value, factor, 0 * factor)
        cross = _outer(self.gradient, other.gradient)
        return Jet(
            self.value * other.value,
            self.value[:, None] * other.gradient + other.value[:, None] * self.gradient,
            self.value[:, None, None] * other.hessian
            + other.value[:, None, None] * self.hessian
            + cross
            + cross.transpose(0, 2, 1),
        )

    __rmul__ = __mul__

    def reciprocal(self) -> Jet:
        x = self.value
        return self.apply(1 / x, -1 / x**2, 2 / x**3)

    def sqrt(self) -> Jet:
        root = np.sqrt(self.value)
        return self.apply(root, 0.5 / root, -0.25 / root**3)

    def sin(self) -> Jet:
        s, c = np.sin(self.value), np.cos(self.value)
        return self.apply(s, c, -s)

    def cos(self) -> Jet:
        s, c = np.sin(self.value), np.cos(self.value)
        return self.apply(c, -s, -c)

    def arctan2(self, other: Jet) -> Jet:
        """Angle of the point (other, self): the derivatives of arctan(self/other)."""
        s, c = self, other
        norm = (s * s + c * c).value
        # turn the point onto the axis, where the angle is arcsin(s')/r
        sine, cosine = s.value / norm**0.5, c.value / norm**0.5
        across = (s * cosine - c * sine) * (1 / norm**0.5)
        along = (s * sine + c * cosine) * (1 / norm**0.5)
        ratio = across * along.reciprocal()  # tan of the rest, zero with its value
        angle = np.arctan2(s.value, c.value)
        return Jet(angle, ratio.gradient, ratio.hessian)


Vector = tuple[Jet, Jet, Jet]


def dot(a: Sequence[Jet], b: Sequence[Jet]) -> Jet:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def minus(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def plus(a: Vector, b: Vector) -> Vector:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def times(a: Jet, b: Vector) -> Vector:
    return a * b[0], a * b[1], a * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )
