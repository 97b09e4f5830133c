# SPDX-License-Identifier: BSD-3-Clause
"""What is left of D(x) = 0 near the reference: as many equations as self-stresses.

A change of the coordinates is split into one of the motions, which is given, and one across them,
for which the part of D(x) = 0 across the self-stresses is solved. What is left is g(a) = 0, a
function of the shares of the motions, whose value and derivatives are zero at the reference
(Lyapunov and Schmidt; Golubitsky and Schaeffer, Singularities and Groups in Bifurcation Theory).
Its zeros are the positions without strain.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from .reduced import Felt

_MOST_STEPS = 14
#: A correction below this is rounding, where it no longer gets smaller.
_SETTLED, _ROUNDING, _SHRINKS = 1.0e-15, 1.0e-10, 0.7
#: What is left of g where it is zero, and where that may be rounding, so that steps have to gain.
_ZERO, _ROUNDED, _GAIN_IN_ROUNDING = 1.0e-18, 1.0e-15, 0.5
#: The steps to the least of g: how many, their damping times its square, and what ends them.
_MOST_DESCENTS, _DAMPING, _MOST_DAMPING, _GAIN = 60, 1.0, 1.0e12, 1.0e-9

#: So many positions are looked at in a component of few coordinates; of more, where each costs
#: more, fewer.
_MOST_POSITIONS, _FEWEST_POSITIONS, _FEW_COORDINATES = 5_000, 500, 50


class Here(NamedTuple):
    """A position at which nothing but g is left."""

    shares: FloatArray
    """(N,) of the motions."""
    change: FloatArray
    """(n,) of the coordinates, from the reference."""
    left: FloatArray
    """(s,) g."""
    slope: FloatArray
    """(s, N) its derivatives."""
    strain: float
    """The largest held deformation."""


class Reduced:
    """g near the reference of a component."""

    def __init__(self, felt: Felt, stresses: FloatArray) -> None:
        """Complete the null vectors to bases of all coordinates and deformations."""
        self.felt, self.stresses = felt, stresses
        self._across = _complement(felt.motions)
        self._rest = _complement(stresses)
        share = (_FEW_COORDINATES / max(felt.motions.shape[0], _FEW_COORDINATES)) ** 2
        self._left = _FEWEST_POSITIONS + int(_MOST_POSITIONS * share)

    @property
    def is_spent(self) -> bool:
        """Whether as many positions were looked at as may be; no more are found then."""
        return self._left <= 0

    def at(self, shares: FloatArray, guess: FloatArray | None = None) -> Here | None:
        """The position after some shares of the motions (N,); None where Newton finds none.

        Args:
            shares: Of the motions.
            guess: (n,) a change near which it is.
        """
        felt, held, self._left = self.felt, self.felt.held, self._left - 1
        if self._left < 0:
            return None
        ahead, last = felt.motions @ shares, np.inf
        across = np.zeros(self._across.shape[1]) if guess is None else self._across.T @ guess
        for _ in range(_MOST_STEPS):
            change = ahead + self._across @ across
            place = held.at(held.reference, change)
            if not place.is_finite:
                return None
            by_rest = self._rest.T @ place.jacobian
            matrix = by_rest @ self._across
            try:
                both = np.linalg.solve(
                    matrix,
                    np.column_stack([self._rest.T @ place.error, by_rest @ felt.motions]),
                )
            except np.linalg.LinAlgError:
                return None
            now = float(np.linalg.norm(both[:, 0]))
            if now <= _SETTLED or _SHRINKS * last < now <= _ROUNDING:
                along = felt.motions - self._across @ both[:, 1:]
                by_stress = self.stresses.T @ place.jacobian
                left = self.stresses.T @ place.error
                return Here(shares, change, left, by_stress @ along, place.residual)
            if now > max(_SHRINKS * last, _ROUNDING) or not np.isfinite(now):
                return None
            across, last = across - both[:, 0], now
        return None

    def least(self, start: FloatArray, basis: FloatArray, reach: float) -> Here | None:
        """The position with the least of g near some shares (N,), changed within a basis (N, k).

        Args:
            start: The shares to begin with.
            basis: Orthonormal.
            reach: What would lead farther than this in one direction is not corrected there.

        Levenberg-Marquardt steps, whose damping is the square of what is left: they converge
        fast to a zero also where it is one of many (Yamashita and Fukushima, Computing
        Supplement 15, 2001).
        """
        here, damping = self.at(start), _DAMPING
        if here is None or not basis.shape[1]:
            return here
        for _ in range(_MOST_DESCENTS):
            best = float(here.left @ here.left)
            if best <= _ZERO**2 or damping > _MOST_DAMPING:
                break
            u, s, vt = np.linalg.svd(here.slope @ basis, full_matrices=False)
            along, there = u.T @ here.left, None
            most = _MOST_DAMPING if best > _ROUNDED**2 else 64.0 * damping
            while damping <= most:
                factor = s / (s**2 + damping * best + np.finfo(float).tiny)
                factor[np.abs(factor * along) > reach] = 0.0
                change = -basis @ (vt.T @ (factor * along))
                there = self.at(here.shares + change, here.change)
                if there is not None and float(there.left @ there.left) < best:
                    break
                there, damping = None, 8.0 * damping
            if there is None:
                break
            gain = 1.0 - float(there.left @ there.left) / best
            here, damping = there, max(damping / 8.0, 1.0e-12)
            if gain < (_GAIN if best > _ROUNDED**2 else _GAIN_IN_ROUNDING):
                break
        return here


def _complement(vectors: FloatArray) -> FloatArray:
    """(n, n - k) what completes orthonormal vectors (n, k) to a basis."""
    return np.asarray(np.linalg.qr(vectors, mode="complete")[0][:, vectors.shape[1] :])


def across(vectors: FloatArray) -> FloatArray:
    """(N, N - k) likewise, of vectors of any length."""
    return _complement(np.linalg.qr(vectors)[0])
