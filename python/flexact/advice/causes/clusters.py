# SPDX-License-Identifier: BSD-3-Clause
"""Bodies made of bars: triangles, and joints that enough bars of one body hold."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from ...analysis.result import Result
from ...core.elements import Class
from ...model.parts.parts import PartKind, natural


def clusters_of(result: Result) -> tuple[frozenset[int], ...]:
    """Position nodes of each body of bars that can move, indices in the model as given.

    A triangle is a body; a joint with three bars to a body, two in the plane, belongs to it. Not
    all are found: of a body that no triangle starts nothing is known.
    """
    bars = [part for part in result.parts.all if part.kind is PartKind.BAR]
    near: dict[int, set[int]] = {}
    for part in bars:
        p, q = part.ends
        near.setdefault(p, set()).add(q)
        near.setdefault(q, set()).add(p)
    needed = 2 if result.given.planar else 3
    made: list[frozenset[int]] = []
    for p in sorted(near):
        for q, r in combinations(sorted(k for k in near[p] if k > p), 2):
            if r not in near[q] or any({p, q, r} <= body for body in made):
                continue
            made.append(_grown({p, q, r}, near, needed))
    free = [body for body in made if not _is_held(result, body)]
    return tuple(sorted(free, key=lambda body: (-len(body), _key(result, body))))


def _grown(body: set[int], near: dict[int, set[int]], needed: int) -> frozenset[int]:
    while True:
        around = {k for node in body for k in near[node]} - body
        new = {k for k in around if len(near[k] & body) >= needed}
        if not new:
            return frozenset(body)
        body |= new


def _is_held(result: Result, body: frozenset[int]) -> bool:
    """Whether a coordinate of one of its joints is fixed."""
    classes = result.given.arrays.coordinate_class[:, sorted(body)]
    return bool(np.any(classes == Class.FIXED))


def _key(result: Result, body: frozenset[int]) -> object:
    """By the names of its joints, then by their places."""
    step = 1.0e-9 * result.characteristic_length
    places = np.round(result.given.arrays.node_value[:3, sorted(body)].T / step) + 0.0
    names = sorted(natural(result.parts.name_of_point(node)) for node in body)
    return names, sorted(map(tuple, places.tolist()))
