# SPDX-License-Identifier: BSD-3-Clause
"""Second-order forms of self-stresses on motions, and whether one of them is definite.

The form of a self-stress u is q(v) = d/dt u' D(x + t v) v: along any path that begins with v,
u' e begins with t**2 q(v) / 2, since u' D = 0. On a path of positions without strain it is zero.
If a combination of the forms is definite on all motions, none of them goes on: prestress
stability (Pellegrino and Calladine, Int. J. Solids Structures 22, 1986; Salerno, Int. J.
Numer. Methods Eng. 35, 1992; Connelly and Whiteley, SIAM J. Discrete Math. 9, 1996).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from .reduced import Felt

#: Steps of the central differences, in parts of the size; the best of their table is taken.
_STEPS = 0.02 * 0.25 ** np.arange(7)
#: A value is told from zero where it is this multiple of its error, and this part of the terms
#: that it is the sum of.
_CLEARLY, _PART = 1.0e3, 1.0e-9
#: Steps of the search for a definite combination.
_MOST_STEPS, _MOST_STARTS = 200, 4


class Forms(NamedTuple):
    """The second-order forms of some self-stresses on some motions."""

    matrix: FloatArray
    """(s, N, N) symmetric."""
    error: float
    """Below this an entry may be error."""

    def of(self, motion: FloatArray) -> FloatArray:
        """(s,) of a motion, (N,)."""
        return np.asarray(np.einsum("ijk,j,k->i", self.matrix, motion, motion))

    def along(self, motion: FloatArray) -> FloatArray:
        """(s, N) derivatives at a motion, halved."""
        return np.asarray(self.matrix @ motion)


def forms_of(felt: Felt, stresses: FloatArray, explained: float) -> Forms:
    """The forms of some self-stresses on all motions.

    Args:
        felt: The component.
        stresses: (m, s) the self-stresses.
        explained: What part of a form the rounding of the geometry may make.
    """
    rates, errors = zip(*(_rate(felt, stresses, motion) for motion in felt.motions.T), strict=True)
    matrix = np.stack(rates, axis=1)
    skew = np.abs(matrix - np.swapaxes(matrix, 1, 2)).max(initial=0.0)
    size = np.abs(matrix).max(initial=0.0)
    error = _CLEARLY * max(*errors, float(skew)) + (_PART + explained) * max(float(size), 1.0)
    return Forms((matrix + np.swapaxes(matrix, 1, 2)) / 2.0, error)


def _rate(felt: Felt, stresses: FloatArray, motion: FloatArray) -> tuple[FloatArray, float]:
    """(s, N) d/dt u' D(x + t v) v by differences, and their error (Ridders, Richardson)."""
    best, error = None, np.inf
    before: list[FloatArray] = []
    for step in _STEPS.tolist():
        ahead, behind = (_pressed(felt, stresses, sign * step * motion) for sign in (1.0, -1.0))
        now = [(ahead - behind) / (2.0 * step)]
        if not np.all(np.isfinite(now[0])):
            # An element has left its range.
            before = []
            continue
        for k, other in enumerate(before):
            factor = 16.0 ** (k + 1)
            now.append((factor * now[-1] - other) / (factor - 1.0))
            off = max(float(np.abs(now[-1] - now[-2]).max()), float(np.abs(now[-1] - other).max()))
            if off < error:
                best, error = now[-1], off
        if best is None:
            best = now[0]
        before = now
    if best is None:
        return np.zeros((stresses.shape[1], felt.many)), np.inf
    return np.asarray(best), error


def _pressed(felt: Felt, stresses: FloatArray, change: FloatArray) -> FloatArray:
    """(s, N) u' D v after a change, whose derivative along itself does not turn with it."""
    held = felt.held
    where = held.moved(held.reference, change)
    return np.asarray(held.pressed(where, stresses).T @ felt.motions)


class Combination(NamedTuple):
    """A combination of forms, of unit norm."""

    shares: FloatArray
    """(s,)."""
    eigenvalues: FloatArray
    """(N,) ascending."""
    vectors: FloatArray
    """(N, N) their eigenvectors."""


def most_definite(forms: Forms) -> Combination:
    """The combination whose smallest eigenvalue is the largest that was found.

    The smallest eigenvalue is a concave function of the shares, which steps along its
    supergradients climb.
    """
    many = forms.matrix.shape[0]
    starts = [*np.eye(many)[:_MOST_STARTS], *-np.eye(many)[:_MOST_STARTS]]
    traces = np.trace(forms.matrix, axis1=1, axis2=2)
    size = float(np.linalg.norm(traces))
    if size > forms.error:
        starts.insert(0, traces / size)
    best: Combination | None = None
    for start in starts:
        found = _climbed(forms, start)
        if best is None or found.eigenvalues[0] > best.eigenvalues[0]:
            best = found
        if best.eigenvalues[0] > forms.error:
            break
    assert best is not None
    return best


class Cone(NamedTuple):
    """What the forms leave of the motions: none beyond it is the velocity of a path."""

    basis: FloatArray
    """(N, k) orthonormal."""
    forms: Forms
    """The forms on it, those that are independent."""
    least: float | None
    """The smallest eigenvalue that took motions away; None where none did."""


def cone_of(forms: Forms) -> Cone:
    """Take away what semidefinite combinations of the forms exclude, until none does.

    Where a combination is not negative, its value is zero on a path, so that the velocity is in
    the null space of the combination; there the forms are looked at again.
    """
    basis, now = np.eye(forms.matrix.shape[1]), _independent(forms)
    least: float | None = None
    while now.matrix.size:
        found = most_definite(now)
        values, error = found.eigenvalues, forms.error
        if values[0] < -error or not values[-1] > error:
            break
        zero = values <= error
        taken = float(values[~zero].min())
        least = taken if least is None else min(least, taken)
        basis = basis @ found.vectors[:, zero]
        within = np.einsum("ja,ijk,kb->iab", basis, forms.matrix, basis)
        now = _independent(Forms(within, error))
    return Cone(basis, now, least)


def _independent(forms: Forms) -> Forms:
    """As many forms as are independent, the largest first; none that is zero."""
    many, size = forms.matrix.shape[:2]
    left, values, _ = np.linalg.svd(forms.matrix.reshape(many, -1), full_matrices=False)
    chosen = left[:, values > forms.error]
    made = np.tensordot(chosen.T, forms.matrix, 1).reshape(chosen.shape[1], size, size)
    return Forms(made, forms.error)


def _climbed(forms: Forms, shares: FloatArray) -> Combination:
    best = now = _combined(forms, shares)
    for k in range(_MOST_STEPS if shares.size > 1 else 0):
        # The mean over the lowest eigenvectors, weighted by how low they are.
        spread = np.abs(now.eigenvalues).max() / (4.0 + k / 4.0)
        weight = np.exp(-(now.eigenvalues - now.eigenvalues[0]) / spread)
        slope = np.einsum(
            "ijk,jl,kl,l->i",
            *(forms.matrix, now.vectors, now.vectors, weight / weight.sum()),
            optimize=True,
        )
        size = float(np.linalg.norm(slope))
        if not size > 0.0:
            break
        shares = shares + slope / size / (1.0 + k / 4.0)
        length = float(np.linalg.norm(shares))
        if not length > 0.0:
            break
        shares = shares / length
        now = _combined(forms, shares)
        if now.eigenvalues[0] > best.eigenvalues[0]:
            best = now
        if best.eigenvalues[0] > forms.error:
            break
    return best


def _combined(forms: Forms, shares: FloatArray) -> Combination:
    values, vectors = np.linalg.eigh(np.tensordot(shares, forms.matrix, 1))
    return Combination(shares, values, np.asarray(vectors))
