# SPDX-License-Identifier: BSD-3-Clause
"""What hangs together: members in a row, into which a sheet or a wire is divided, and bodies."""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray
from ..model.parts.bodies import groups_of

#: Cosine of the largest angle between two beams of one sheet.
_IN_LINE = 0.9998


def chain_lengths(
    nodes: np.ndarray, form: np.ndarray, ex: FloatArray, length: FloatArray
) -> FloatArray:
    """(k,) length of the row of equal members in line that each member belongs to [m].

    Args:
        nodes: (k, 2) position nodes of the ends.
        form: (k,) forms; only members of one form make a row.
        ex: (k, 3) directions.
        length: (k,) [m].
    """
    in_row = (
        (i, j)
        for i, j in _neighbours(nodes)
        if form[i] == form[j] and abs(ex[i] @ ex[j]) > _IN_LINE
    )
    row = groups_of(len(length), in_row)
    return np.asarray(np.bincount(row, length, len(length))[row], np.float64)


def _neighbours(nodes: np.ndarray) -> list[tuple[int, int]]:
    """Members that are alone with each other at a node."""
    ends = nodes.ravel()
    order = np.argsort(ends, kind="stable")
    member = np.repeat(np.arange(len(nodes)), 2)[order]
    starts = np.flatnonzero(np.r_[True, np.diff(ends[order]) > 0]) if ends.size else np.array([])
    counts = np.diff(np.r_[starts, ends.size])
    first = starts[counts == 2].astype(np.int64)
    return list(zip(member[first].tolist(), member[first + 1].tolist(), strict=True))
