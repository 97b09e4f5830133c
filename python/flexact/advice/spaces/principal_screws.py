# SPDX-License-Identifier: BSD-3-Clause
"""The principal screws of a space, at which the pitch is stationary (Ball 1900)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...core.arrays import FloatArray
from .families import SAME, Family, FamilyKind
from .flat_families import line_of


def principal_screws(lined: FloatArray, spanned: FloatArray, count: int) -> list[Family]:
    """Those of a space that its lines and directions do not span.

    Args:
        lined: (n, 6) independent rows, without directions, perpendicular to these.
        spanned: (m, 6) rows that its lines and directions span.
        count: Its dimension.
    """
    if _rank(spanned) == count:
        return []
    # Pitches are stationary, h = a.b/a.a, at the principal screws (Ball 1900).
    back = np.linalg.inv(np.linalg.cholesky(lined[:, :3] @ lined[:, :3].T))
    form = lined[:, :3] @ lined[:, 3:].T
    pitches, vectors = np.linalg.eigh(back @ (form + form.T) @ back.T / 2.0)
    made = []
    for row in _told(pitches, vectors.T @ back @ lined):
        more = np.concatenate((spanned, row[None]))
        if _rank(more) > _rank(spanned):
            spanned = more
            point, direction, pitch = line_of(row)
            kind = FamilyKind.SCREW if abs(pitch) > SAME else FamilyKind.LINE
            made.append(Family(kind, point, direction, pitch=pitch * (kind is FamilyKind.SCREW)))
    return made


def _told(pitches: FloatArray, rows: FloatArray) -> Iterator[FloatArray]:
    """Screws of unit axes at right angles; of those with one pitch the nearest to x, y and z."""
    first = 0
    while first < pitches.size:
        group = rows[np.abs(pitches - pitches[first]) <= SAME]
        first += len(group)
        if len(group) == 1:
            yield group[0]
            continue
        taken = np.zeros((0, len(group)))
        for shares in group[:, :3].T:
            rest = shares - (shares @ taken.T) @ taken
            size = float(np.linalg.norm(rest))
            if size > 0.1 and len(taken) < len(group):
                taken = np.concatenate((taken, rest[None] / size))
                yield taken[-1] @ group


def _rank(rows: FloatArray) -> int:
    """How many of some rows are independent."""
    sizes = np.linalg.norm(rows, axis=1, keepdims=True)
    if not len(rows):
        return 0
    return int(np.sum(np.linalg.svd(rows / sizes, compute_uv=False) > SAME))
