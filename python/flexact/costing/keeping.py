# SPDX-License-Identifier: BSD-3-Clause
"""What is left of a stiffness in the worst direction: mu of C_before v = mu C_after v."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..core.arrays import BoolArray, FloatArray
from .values import Kept, Numbers, unit_of_direction, words_of_direction

#: Compliances below this part of the largest, lengths by the size, are of directions that are held.
_HELD = 1.0e-12
#: mu that differ by less than this part are equal.
_EQUAL = 1.0e-6
#: Parts of the energy from which a direction is named, and how many are.
_SHARE, _MOST_NAMED = 0.1, 2


class Ratios(NamedTuple):
    """mu ascending with their loads."""

    mu: FloatArray
    """(k,) of the k directions that can move."""
    loads: FloatArray
    """(d, k) loads v in the directions of the point, scaled: moments by the size."""
    shares: FloatArray
    """(d, k) part of the work of each load that is done in each direction."""


def scales_of(directions: Sequence[str], size: float) -> FloatArray:
    """(d,) by which displacements are multiplied to be lengths: the size of a rotation."""
    return np.array([size if unit_of_direction(each) == "rad" else 1.0 for each in directions])


def able(compliance: FloatArray, scale: FloatArray) -> BoolArray:
    """(d,) directions that are not held."""
    own = np.diag(compliance) * scale**2
    made: BoolArray = own > _HELD * own.max(initial=0.0)
    return made


def ratios(before: FloatArray, after: FloatArray, scale: FloatArray) -> Ratios:
    """All mu of C_before v = mu C_after v, ascending, of what can move in both; 1: all is kept.

    A compliance that is not positive definite, of a state that has buckled, gives mu of 0 or
    less: such a direction keeps nothing.

    Args:
        before: (d, d) compliance.
        after: (d, d) likewise.
        scale: (d,) see `scales_of`.
    """
    free = np.flatnonzero(able(before, scale) & able(after, scale))
    loads, shares = (np.zeros((scale.size, free.size)) for _ in range(2))
    if not free.size:
        return Ratios(np.zeros(0), loads, shares)
    one, two = ((each * np.outer(scale, scale))[np.ix_(free, free)] for each in (before, after))
    # Of mu^-1, so that only the compliance before need be positive: C_after v = mu^-1 C_before v.
    lower = np.linalg.cholesky((one + one.T) / 2.0)
    inner = np.linalg.solve(lower, np.linalg.solve(lower, (two + two.T) / 2.0).T)
    inverse, vectors = np.linalg.eigh((inner + inner.T) / 2.0)
    with np.errstate(divide="ignore"):
        mu = np.where(inverse > 0.0, 1.0 / np.where(inverse > 0.0, inverse, 1.0), 0.0)
    order = np.argsort(mu, kind="stable")
    mu = mu[order]
    vectors = _aligned(np.linalg.solve(lower.T, vectors[:, order]), mu)
    done = vectors * (two @ vectors)
    loads[free] = vectors / np.abs(vectors).max(axis=0)
    shares[free] = done / done.sum(axis=0)
    return Ratios(mu, loads, shares)


def _aligned(vectors: FloatArray, mu: FloatArray) -> FloatArray:
    """With the first one, where others are equal, turned to as few directions as can be."""
    same = np.abs(mu - mu[0]) <= _EQUAL * max(abs(mu[0]), _EQUAL)
    count = int(np.count_nonzero(same))
    if count < 2:
        return vectors
    base = np.linalg.qr(vectors[:, :count])[0]
    row = int(np.argmax(np.linalg.norm(base, axis=1)))
    made = vectors.copy()
    made[:, 0] = base @ base[row]
    return made


def kept_of(found: Ratios, mu: Numbers, directions: Sequence[str]) -> Kept | None:
    """The ratios with uncertainties and words; None where nothing can move."""
    if not found.mu.size:
        return None
    return Kept(mu, found.loads[:, 0], direction_words(found.shares[:, 0], directions))


def direction_words(shares: FloatArray, directions: Sequence[str]) -> str:
    """Such as "about z", or "along x and about y"."""
    order = np.argsort(-np.round(shares, 6), kind="stable")[:_MOST_NAMED]
    named = [k for k in order.tolist() if shares[k] >= _SHARE] or [int(order[0])]
    return " and ".join(words_of_direction(directions[k]) for k in named)
