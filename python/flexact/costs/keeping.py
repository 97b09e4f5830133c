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
#: The same of what moves after that did not move before.
_NEW = 1.0e-9
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
    there = np.isfinite(own)
    made: BoolArray = there & (own > _HELD * own[there].max(initial=0.0))
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
    lost = np.isinf(np.diag(after)) & ~np.isinf(np.diag(before))
    if lost.any():
        return _nothing_left(before, after, scale, lost)
    free = np.flatnonzero(able(before, scale) & able(after, scale))
    if not free.size:
        none = np.zeros((scale.size, 0))
        return Ratios(np.zeros(0), none, none)
    one, two = ((each * np.outer(scale, scale))[np.ix_(free, free)] for each in (before, after))
    mu, vectors = _pairs((one + one.T) / 2.0, (two + two.T) / 2.0)
    loads, shares = (np.zeros((scale.size, mu.size)) for _ in range(2))
    vectors = _aligned(vectors, mu)
    done = vectors * (two @ vectors)
    loads[free] = vectors / np.abs(vectors).max(axis=0)
    shares[free] = done / np.where(done.sum(axis=0) != 0.0, done.sum(axis=0), 1.0)
    return Ratios(mu, loads, shares)


def _pairs(one: FloatArray, two: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Values mu of one v = mu two v, ascending, and v, where something moves.

    By those of its inverse, so that only the first matrix need be positive; what moves in the
    second alone keeps nothing.
    """
    values, axes = np.linalg.eigh(one)
    some = values > _HELD * values.max()
    root = axes[:, some] / np.sqrt(values[some])
    inverse, turned = np.linalg.eigh(root.T @ two @ root)
    mu = np.where(inverse > 0.0, 1.0 / np.where(inverse > 0.0, inverse, 1.0), 0.0)
    rest = axes[:, ~some]
    left, new = np.linalg.eigh(rest.T @ two @ rest)
    moves = left > _NEW * max(np.trace(two), 0.0)
    mu = np.concatenate([np.zeros(int(moves.sum())), mu])
    vectors = np.hstack([rest @ new[:, moves], root @ turned])
    order = np.argsort(mu, kind="stable")
    return mu[order], vectors[:, order]


def _nothing_left(
    before: FloatArray, after: FloatArray, scale: FloatArray, lost: BoolArray
) -> Ratios:
    """The ratios where a motion without stiffness is new: 0 along it, then those of the rest."""
    inner = np.where(lost[:, None] | lost, 0.0, after)
    rest = ratios(before, np.where(np.isfinite(inner), inner, 0.0), scale)
    first = lost.astype(np.float64)[:, None]
    return Ratios(
        np.concatenate([[0.0], rest.mu]),
        np.hstack([first, rest.loads]),
        np.hstack([first / first.sum(), rest.shares]),
    )


def _aligned(vectors: FloatArray, mu: FloatArray) -> FloatArray:
    """With the first one, where others are equal, turned to as few directions as can be."""
    same = np.abs(mu - mu[0]) <= _EQUAL * max(abs(mu[0]), _EQUAL)
    count = int(np.count_nonzero(same))
    if count < 2:
        return vectors
    base = np.linalg.qr(vectors[:, :count])[0]
    # The last digits do not decide which of equal directions it is.
    row = int(np.argmax(np.round(np.linalg.norm(base, axis=1), 6)))
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
