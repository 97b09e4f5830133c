# SPDX-License-Identifier: BSD-3-Clause
"""The points of a model: a position and an orientation each, as tables and meshes have nodes."""

from __future__ import annotations

from typing import NamedTuple

from ...core.arrays import ModelArrays
from ...core.elements import element_kinds


class Points(NamedTuple):
    """Points by number from 1, in the order in which the elements name them.

    Attributes:
        nodes: Index of the position and of the orientation of each; -1 where it has none.
        ends: The two points of each element.
    """

    nodes: tuple[tuple[int, int], ...]
    ends: tuple[tuple[int, int], ...]

    @property
    def same_position(self) -> dict[int, int]:
        """Points that share their position with an earlier one, with the first that does."""
        return _shared([position for position, _ in self.nodes])

    @property
    def same_orientation(self) -> dict[int, int]:
        """Likewise of orientations."""
        return _shared([orientation for _, orientation in self.nodes])


def _shared(nodes: list[int]) -> dict[int, int]:
    first: dict[int, int] = {}
    made = {}
    for point, node in enumerate(nodes, start=1):
        if node >= 0 and first.setdefault(node, point) != point:
            made[point] = first[node]
    return made


def points_of(arrays: ModelArrays) -> Points:
    """The points of a sound model."""
    slots = (arrays.element_node.T - 1).tolist()
    pairs: dict[tuple[int, int], None] = {}
    for nodes in slots:
        for end in (nodes[:2], nodes[2:]):
            if min(end) >= 0:
                pairs[end[0], end[1]] = None
    of_position: dict[int, tuple[int, int]] = {}
    of_orientation: dict[int, tuple[int, int]] = {}
    for pair in pairs:
        of_position.setdefault(pair[0], pair)
        of_orientation.setdefault(pair[1], pair)
    _add_turned(arrays, slots, of_orientation)
    ends = []
    for nodes in slots:
        both = []
        for position, orientation in (nodes[:2], nodes[2:]):
            if min(position, orientation) >= 0:
                pair = position, orientation
            elif position >= 0:
                pair = of_position.setdefault(position, (position, -1))
            else:
                pair = of_orientation[orientation]
            both.append(pair)
        ends.append(both)
    order: dict[tuple[int, int], int] = {}
    for both in ends:
        for pair in both:
            order.setdefault(pair, len(order) + 1)
    return Points(tuple(order), tuple((order[p], order[q]) for p, q in ends))


def _add_turned(
    arrays: ModelArrays, slots: list[list[int]], known: dict[int, tuple[int, int]]
) -> None:
    """Orientations that stand nowhere are where those stand that a hinge joins them to."""
    kinds = element_kinds()
    hinges = [
        (nodes[1], nodes[3])
        for kind, nodes in zip(arrays.element_kind.tolist(), slots, strict=True)
        if not kinds[kind - 1].slots[0]
    ]
    waiting = hinges
    while waiting:
        left = []
        for one, other in waiting:
            if one in known:
                known.setdefault(other, (known[one][0], other))
            elif other in known:
                known[one] = known[other][0], one
            else:
                left.append((one, other))
        if len(left) == len(waiting):
            one, _ = left[0]
            known[one] = -1, one
        waiting = left
