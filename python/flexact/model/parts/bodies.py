# SPDX-License-Identifier: BSD-3-Clause
"""Rigid bodies: what hangs together by members that hold every deformation."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from ...core.arrays import ModelArrays
from ...core.elements import Member
from .forms import all_held, is_member


class Body(NamedTuple):
    """A rigid body of one or several rigid members.

    Attributes:
        elements: Indices of its members, ascending.
        positions: Indices of the position nodes that it carries, ascending.
        orientations: Indices of the orientation nodes that turn with it, ascending.
    """

    elements: tuple[int, ...]
    positions: tuple[int, ...]
    orientations: tuple[int, ...]


def bodies_of(arrays: ModelArrays) -> tuple[Body, ...]:
    """The rigid bodies of a model, by their first members.

    Members that share an orientation node belong together; those that share a position alone
    turn about it.
    """
    rigid = np.flatnonzero(
        is_member(arrays.element_kind, Member.BEAM, Member.LINK) & all_held(arrays)
    )
    slots = (arrays.element_node[:, rigid].T - 1).tolist()
    turning = {
        orientation for _, op, _, oq in slots for orientation in (op, oq) if orientation >= 0
    }
    place = {orientation: k for k, orientation in enumerate(sorted(turning))}
    group = groups_of(
        len(place), ((place[op], place[oq]) for _, op, _, oq in slots if oq >= 0)
    ).tolist()
    members: dict[int, list[int]] = {}
    for k, (_, op, _, _) in enumerate(slots):
        members.setdefault(group[place[op]], []).append(k)
    made = []
    for mine in members.values():
        ends = [slots[k] for k in mine]
        made.append(
            Body(
                tuple(rigid[mine].tolist()),
                tuple(sorted({node for p, _, q, _ in ends for node in (p, q)})),
                tuple(sorted({node for _, op, _, oq in ends for node in (op, oq) if node >= 0})),
            )
        )
    return tuple(sorted(made))


def groups_of(count: int, pairs: Iterable[tuple[int, int]]) -> np.ndarray:
    """(count,) of each thing one of its group, the same for all of the group."""
    owner = list(range(count))

    def root(i: int) -> int:
        while owner[i] != i:
            owner[i] = owner[owner[i]]
            i = owner[i]
        return i

    for i, j in pairs:
        owner[root(i)] = root(j)
    return np.array([root(i) for i in range(count)], dtype=np.int64)
