# SPDX-License-Identifier: BSD-3-Clause
"""Which motions or self-stresses came, and which went: of two spaces, whatever their bases.

Two spaces have as many directions in common as there are principal angles between them that are
small (Bjoerck and Golub, 1973). So many modes stay; of each side those that reach least into the
other space are the ones that went, or came.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..core.arrays import FloatArray
from .differences import Mode

#: Cosine of the angle up to which a direction is the same: 25 degrees, so that small changes of
#: the geometry keep it.
_SAME = 0.9


def came_and_went(
    before: Sequence[Mode], after: Sequence[Mode]
) -> tuple[tuple[Mode, ...], tuple[Mode, ...]]:
    """The modes that are new, and those that are no more."""
    labels = sorted({label for mode in (*before, *after) for label in mode.vector})
    place = {label: k for k, label in enumerate(labels)}
    bases = [_orthonormal(modes, place) for modes in (before, after)]
    cosines = np.linalg.svd(bases[0].T @ bases[1], compute_uv=False)
    common = int(np.count_nonzero(cosines > _SAME))
    went = _least(before, place, bases[1], bases[0].shape[1] - common)
    came = _least(after, place, bases[0], bases[1].shape[1] - common)
    return came, went


def _matrix(modes: Sequence[Mode], place: dict[tuple[int, str], int]) -> FloatArray:
    """(labels, modes) unit vectors."""
    made = np.zeros((len(place), len(modes)))
    for k, mode in enumerate(modes):
        for label, value in mode.vector.items():
            made[place[label], k] = value
    length = np.linalg.norm(made, axis=0)
    return np.asarray(made / np.where(length > 0.0, length, 1.0))


def _orthonormal(modes: Sequence[Mode], place: dict[tuple[int, str], int]) -> FloatArray:
    left, sizes, _ = np.linalg.svd(_matrix(modes, place), full_matrices=False)
    return np.asarray(left[:, sizes > 1e-10])


def _least(
    modes: Sequence[Mode], place: dict[tuple[int, str], int], other: FloatArray, count: int
) -> tuple[Mode, ...]:
    """So many modes, those of which the least lies in the other space, in their order."""
    reach = np.linalg.norm(other.T @ _matrix(modes, place), axis=0)
    rows = np.argsort(np.round(reach, 9), kind="stable")[: max(count, 0)]
    return tuple(modes[k] for k in sorted(rows.tolist()))
