# SPDX-License-Identifier: BSD-3-Clause
"""Quasi-random points, and how much of a variance each of many inputs has."""

from __future__ import annotations

from statistics import NormalDist
from typing import NamedTuple

import numpy as np

from ..core.arrays import FloatArray

#: Digits of a point go on until they are below this.
_FINEST = 2.0**-53
#: Highest degree of the polynomials that stand for what one input does alone.
_DEGREE = 5


def primes(count: int) -> list[int]:
    """The first so many primes."""
    found: list[int] = []
    number = 2
    while len(found) < count:
        if all(number % each for each in found if each * each <= number):
            found.append(number)
        number += 1
    return found


def points(count: int, dimensions: int, seed: int) -> FloatArray:
    """Points of the randomised Halton sequence, (count, dimensions) between 0 and 1.

    Each digit of each dimension is permuted at random: A. B. Owen, A randomized Halton algorithm in
    R, arXiv:1706.02808 (2017). Each point is uniform, and together they lie evenly. More points
    of the same seed begin with the same ones.
    """
    rng = np.random.default_rng(seed)
    made = np.zeros((count, dimensions))
    for k, base in enumerate(primes(dimensions)):
        left, weight = np.arange(count), 1.0 / base
        while weight > _FINEST:
            # Also of digits that are all zero.
            made[:, k] += rng.permutation(base)[left % base] * weight
            left, weight = left // base, weight / base
    return np.clip(made, _FINEST, 1.0 - _FINEST)


def normal(uniform: FloatArray) -> FloatArray:
    """The same points with independent standard normal coordinates."""
    quantile = NormalDist().inv_cdf
    return np.array([quantile(u) for u in uniform.ravel().tolist()]).reshape(uniform.shape)


def first_order(inputs: FloatArray, answers: FloatArray) -> FloatArray:
    """What part of the variance the mean has, of the answers at each value of one input.

    That mean is a polynomial: the sum of squares that Hermite polynomials up to the fifth degree of
    one input explain, less what they would of noise (adjusted R^2). Of normal inputs they are
    the first terms of the polynomial chaos: B. Sudret, Global sensitivity analysis using
    polynomial chaos expansions, Reliability Engineering and System Safety 93 (2008) 964-979.

    Args:
        inputs: (n, k) independent standard normal numbers.
        answers: (n, q).

    Returns:
        (q, k) from 0 to 1; NaN of answers that do not vary, or of too few.
    """
    count = len(inputs)
    freedoms = count - _DEGREE - 1
    made = np.full((answers.shape[1], inputs.shape[1]), np.nan)
    if freedoms < 1:
        return made
    centred = answers - answers.mean(axis=0)
    whole = (centred**2).sum(axis=0) / (count - 1)
    some = whole > 0.0
    for k in range(inputs.shape[1]):
        basis = np.polynomial.hermite_e.hermevander(inputs[:, k], _DEGREE)
        fitted = basis @ np.linalg.lstsq(basis, centred, rcond=None)[0]
        rest = ((centred - fitted) ** 2).sum(axis=0) / freedoms
        made[some, k] = np.clip(1.0 - rest[some] / whole[some], 0.0, 1.0)
    return made


class Totals(NamedTuple):
    """Total indices of k inputs and q answers."""

    value: FloatArray
    """(q, k) part of the variance that is left where all other inputs are known."""
    error: FloatArray
    """(q, k) standard error of each."""


def totals(before: FloatArray, behind: FloatArray, variance: FloatArray) -> Totals:
    """Total indices, from pairs that differ in one input alone.

    The estimator is that of M. J. W. Jansen, Analysis of variance designs for model output,
    Computer Physics Communications 117 (1999) 35-43: half of the mean square of the difference.

    Args:
        before: (m, q) answers.
        behind: (k, m, q) the same with another value of each input.
        variance: (q,) of the answers.
    """
    half = (behind - before) ** 2 / 2.0
    count = np.maximum(np.isfinite(half).sum(axis=1), 1)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.nansum(half, axis=1) / count
        spread = np.sqrt(np.nansum((half - mean[:, None]) ** 2, axis=1) / count / count)
        # (q, k)
        made = [np.where(variance > 0.0, each / variance, np.nan).T for each in (mean, spread)]
    return Totals(*made)
