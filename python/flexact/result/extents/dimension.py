# SPDX-License-Identifier: BSD-3-Clause
"""The dimension of the positions without strain, measured near the reference.

From places a little off, in random directions of the null space, steps lead back to positions
without strain. How many directions of those are independent is the dimension.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from ...model.configuration import Configuration
from ..following.follow import TRUE
from ..following.least import descend
from .felt import Felt

#: How far off, from the reference and then from the positions that were found.
_OFF, _FAR, _NEAR = 0.03, 0.1, 2.0e-3
#: Of that a position has come back to the reference where no more than the first part is left,
#: and has not where the second is; between them it is open.
_BACK, _AWAY = 0.1, 0.3
#: Singular values of D(x) that count as zero on a path.
_ZERO = 1.0e-7
#: Directions are independent where a singular value is above the second part of the largest.
_DEPENDENT, _INDEPENDENT = 0.03, 0.2
#: About so many positions it is measured; in components of more motions nowhere.
_MOST_LOOKED_AT = 8
MOST_MOTIONS = 12


class Near(NamedTuple):
    """Positions without strain near the reference."""

    dimension: int | None
    """None where it is open."""
    lines: tuple[FloatArray, ...]
    """Directions from the reference, (N,), of positions about which it is one."""


def is_without_strain(felt: Felt, cone: FloatArray) -> bool:
    """Whether random motions of a cone (N, k) lead to positions without strain, others added.

    Then all do, as the least strain is an analytic function or the root of one.
    """
    random = np.random.default_rng(felt.many)
    for share in (_OFF, _FAR, _FAR):
        unit = cone @ random.standard_normal(cone.shape[1])
        motion = felt.motions @ (unit / np.linalg.norm(unit))
        base = _across(felt, cone)
        place, correction = descend(felt.held, felt.held.reference, share * motion, base)
        if place.residual > TRUE / 10.0 or np.linalg.norm(correction) > _AWAY * share:
            return False
    return True


def positions_near(felt: Felt, cone: FloatArray, also: list[FloatArray]) -> Near:
    """Positions without strain near the reference, and their dimension.

    Args:
        felt: The component.
        cone: (N, k) orthonormal, in which all paths begin.
        also: (N,) unit vectors of motions to begin with, besides random ones.
    """
    held, width = felt.held, cone.shape[1]
    whole = np.eye(felt.motions.shape[0])
    random = np.random.default_rng(width)
    starts = [sign * each for each in also for sign in (1.0, -1.0)]
    starts += [cone @ each for each in random.standard_normal((2 * width + 4, width))]
    dimension, is_open, looked_at = 0, False, 0
    lines: list[FloatArray] = []
    for start in starts:
        off = _OFF * (felt.motions @ (start / np.linalg.norm(start)))
        place, correction = descend(held, held.reference, off, whole)
        gone = off + correction
        far = float(np.linalg.norm(gone)) / _OFF
        if far <= _BACK:
            continue
        if far <= _AWAY or place.residual > TRUE:
            is_open = True
            continue
        if looked_at == _MOST_LOOKED_AT:
            break
        looked_at += 1
        here = _dimension_at(felt, place.configuration, random)
        is_open |= here is None
        dimension = max(dimension, here or 0)
        if here == 1:
            lines.append(_refined(felt, gone))
        if dimension == width:
            return Near(width, tuple(lines))
    return Near(None if is_open else dimension, tuple(lines))


def _refined(felt: Felt, gone: FloatArray) -> FloatArray:
    """(N,) the direction in which a path begins that has gone somewhere, of unit norm."""
    whole = np.eye(gone.size)
    for share in (0.1, 0.1, 0.1):
        start = share * gone
        _, correction = descend(felt.held, felt.held.reference, start, whole)
        if np.linalg.norm(correction) > _AWAY * np.linalg.norm(start):
            break
        gone = start + correction
    along = felt.within(gone)
    return np.asarray(along / np.linalg.norm(along))


def _across(felt: Felt, cone: FloatArray) -> FloatArray:
    """(n, n - k) what is across the motions of a cone."""
    return np.asarray(np.linalg.qr(felt.motions @ cone, mode="complete")[0][:, cone.shape[1] :])


def _dimension_at(felt: Felt, where: Configuration, random: np.random.Generator) -> int | None:
    jacobian = felt.held.at(where).jacobian
    _, s, vt = np.linalg.svd(jacobian, full_matrices=True)
    rank = int(np.count_nonzero(s > _ZERO * s.max(initial=1.0)))
    null, whole = vt[rank:].T, np.eye(vt.shape[0])
    if null.shape[1] <= 1 or rank == jacobian.shape[0]:
        return null.shape[1]
    ways = []
    for _ in range(null.shape[1] + 2):
        off = null @ random.standard_normal(null.shape[1])
        off *= _NEAR / np.linalg.norm(off)
        _, correction = descend(felt.held, where, off, whole)
        ways.append(null.T @ (off + correction) / _NEAR)
    values = np.linalg.svd(np.array(ways), compute_uv=False)
    values = values / max(values[0], _INDEPENDENT)
    if np.any((values > _DEPENDENT) & (values < _INDEPENDENT)):
        return None
    return int(np.count_nonzero(values >= _INDEPENDENT))
