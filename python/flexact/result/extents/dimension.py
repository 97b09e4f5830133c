# SPDX-License-Identifier: BSD-3-Clause
"""The dimension of the positions without strain, measured near the reference.

From places a little off, in random directions of the null space, steps lead back to positions
without strain. How many directions of those are independent is the dimension.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from .held import Held, Place
from .settling import settled
from .walking import LARGEST_STRAIN

#: How far off, from the reference and then from the positions that were found.
_OFF, _NEAR = 0.03, 2.0e-3
#: Of that a position has come back to the reference where no more than the first part is left,
#: and has not where the second is; between them it is open.
_BACK, _AWAY = 0.1, 0.3
#: Singular values of D(x) that count as zero on a path.
_ZERO = 1.0e-7
#: Directions are independent where a singular value is above the second part of the largest.
_DEPENDENT, _INDEPENDENT = 0.03, 0.2
#: More motions are not looked at.
MOST_MOTIONS = 12


class Near(NamedTuple):
    """Positions without strain near the reference."""

    dimension: int | None
    """None where it is open."""
    directions: tuple[tuple[int, FloatArray], ...]
    """Dimension about each position, and its direction from the reference, (N,)."""


def positions_near(held: Held, also: list[FloatArray]) -> Near:
    """Positions without strain near the reference, and their dimension.

    Args:
        held: What is held.
        also: (N,) unit vectors of motions to begin with, besides random ones.
    """
    many = held.motions.shape[1]
    random = np.random.default_rng(many)
    starts = [sign * each for each in also for sign in (1.0, -1.0)]
    starts += list(random.standard_normal((2 * many + 6, many)))
    dimension, is_open = 0, False
    found: list[tuple[int, FloatArray]] = []
    for start in starts:
        unit = start / np.linalg.norm(start)
        end = settled(held, held.moved(held.reference, _OFF * (held.motions @ unit)))
        gone = held.from_reference(end.place)
        far = float(np.linalg.norm(gone)) / _OFF
        if far <= _BACK:
            continue
        if far <= _AWAY or end.strain > LARGEST_STRAIN:
            is_open = True
            continue
        here = _dimension_at(held, end.place, random)
        is_open |= here is None
        if here is not None:
            dimension = max(dimension, here)
            along = held.motions.T @ gone
            found.append((here, along / np.linalg.norm(along)))
    return Near(None if is_open else dimension, tuple(found))


def _dimension_at(held: Held, place: Place, random: np.random.Generator) -> int | None:
    _, jacobian = held.at(place)
    _, s, vt = np.linalg.svd(jacobian, full_matrices=True)
    rank = int(np.count_nonzero(s > _ZERO * s.max(initial=1.0)))
    null = vt[rank:].T
    if null.shape[1] <= 1 or rank == jacobian.shape[0]:
        return null.shape[1]
    base, ways = held.from_reference(place), []
    for _ in range(null.shape[1] + 2):
        off = null @ random.standard_normal(null.shape[1])
        start = held.moved(place, _NEAR / np.linalg.norm(off) * off)
        end = settled(held, start)
        ways.append(null.T @ (held.from_reference(end.place) - base) / _NEAR)
    values = np.linalg.svd(np.array(ways), compute_uv=False)
    values = values / max(values[0], _INDEPENDENT)
    if np.any((values > _DEPENDENT) & (values < _INDEPENDENT)):
        return None
    return int(np.count_nonzero(values >= _INDEPENDENT))
