# SPDX-License-Identifier: BSD-3-Clause
"""Which motions go on, and which only begin: theorems first, then measurements."""

from __future__ import annotations

from contextlib import nullcontext

import numpy as np

from ..analysis.result_spaces import Spaces
from ..analysis.weights import column_weights
from ..core.arrays import FloatArray
from ..util.loading import load
from .components import Component, components_of
from .extent import EvidenceKind, Extent, Extents, Kind, Reason
from .judge import Decided, Judge

#: More components than this are not looked at, nor more motions in one, nor entries of these.
_MOST_COMPONENTS, _MOST_MOTIONS, _MOST_ENTRIES = 60, 400, 4_000_000
#: A told motion has no part in a component where it is below this.
_UNSEEN = 1.0e-9
_FREE = Extent(Kind.FINITE, EvidenceKind.CERTIFIED, Reason.NO_SELF_STRESS)


def extents_of(spaces: Spaces) -> Extents:
    """Whether each motion of an analysis goes on or only begins.

    A component without self-stress: D(x) = 0 is a manifold there, and each motion is finite
    (implicit function theorem). One in which a combination of the second-order forms is
    definite: none is. Where the form of a self-stress is not zero for a motion, that motion
    is not the velocity of a path. What is left is followed, or its least strain is fitted.
    """
    many = spaces.motion_basis.vectors
    if spaces.raw.motions.vectors < spaces.under_constrained:
        unknown = Extent(Kind.UNDECIDED, EvidenceKind.NONE, Reason.NOT_GIVEN)
        if spaces.over_constrained:
            return Extents((unknown,) * many, None)
        return Extents((_FREE,) * many, spaces.under_constrained)
    felt, free = components_of(spaces)
    told = _told_in(spaces, felt)
    # Matrices are so small that more threads would slow them down.
    with load("threadpoolctl").threadpool_limits(1) if felt else nullcontext():
        decided = [
            _of_component(spaces, component, mine, k < _MOST_COMPONENTS)
            for k, (component, mine) in enumerate(zip(felt, told, strict=True))
        ]
    parts: list[list[Extent]] = [[_FREE] for _ in range(many)]
    for each in decided:
        for k, extent in each.motions.items():
            parts[k].append(extent)
    known = [each.dimension for each in decided if each.dimension is not None]
    whole = sum(known) + free if len(known) == len(decided) else None
    branches = tuple(branch for each in decided for branch in each.branches)
    return Extents(tuple(map(_of_all, parts)), whole, branches)


def _of_all(parts: list[Extent]) -> Extent:
    """Of a motion of several components: it goes on where all parts do."""
    order = {Kind.INFINITESIMAL: 0, Kind.UNDECIDED: 1, Kind.FINITE: 2}
    felt = [part for part in parts if part is not _FREE] or parts
    by_proof = {EvidenceKind.FOLLOWED: 0, EvidenceKind.FITTED: 1, EvidenceKind.CERTIFIED: 2}
    return min(felt, key=lambda part: (order[part.kind], by_proof.get(part.evidence, 3)))


def _told_in(spaces: Spaces, components: tuple[Component, ...]) -> list[dict[int, FloatArray]]:
    """For each component (columns of it,) of each told motion that has a part in it."""
    told, made = spaces.motion_basis, []
    owner, there = np.full(spaces.columns, -1), np.zeros(spaces.columns, np.int64)
    for index, component in enumerate(components):
        owner[component.columns] = index
        there[component.columns] = np.arange(component.columns.size)
        made.append(dict[int, FloatArray]())
    vector, weighted = told.of_entries(), np.abs(told.value * column_weights(spaces)[told.place])
    largest = np.zeros(told.vectors)
    np.maximum.at(largest, vector, weighted)
    seen = weighted > _UNSEEN * largest[vector]
    pairs = np.unique(np.stack([owner[told.place], vector])[:, seen], axis=1)
    for index, k in pairs.T.tolist():
        if index < 0:
            continue
        place, value = told.entries(k)
        mine = owner[place] == index
        made[index][k] = np.zeros(components[index].columns.size)
        made[index][k][there[place[mine]]] = value[mine]
    return made


def _of_component(
    spaces: Spaces, component: Component, told: dict[int, FloatArray], looked_at: bool
) -> Decided:
    many = len(component.motions)
    too_large = many > _MOST_MOTIONS or many * component.columns.size > _MOST_ENTRIES
    if too_large or not looked_at:
        extent = Extent(Kind.UNDECIDED, EvidenceKind.NONE, Reason.TOO_LARGE)
        return Decided(dict.fromkeys(told, extent), None)
    return Judge(spaces, component).decided(told)
