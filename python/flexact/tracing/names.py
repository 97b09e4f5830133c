# SPDX-License-Identifier: BSD-3-Clause
"""What moves in a path, by name: bodies, and points that belong to none."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..analysis.result import Result
from ..core.elements import NodeKind
from ..model.parts.parts import natural
from ..util.cached import cached_property

#: Before the name of a body that only turns back in its rotation.
ROTATION = "rotation of "


class Point(NamedTuple):
    """A position node of the model as given."""

    node: int
    """Its index."""
    name: str
    """Such as "E", or "node 5" where it has none, or not for itself alone."""


class Names:
    """Names of what moves."""

    def __init__(self, result: Result) -> None:
        """Keep the result."""
        self.result, self.parts = result, result.parts

    def of_node(self, node: int) -> str:
        """The body of a node of the model as given, by its index; else the point."""
        body = self.parts.body_at.get(node)
        if body is not None:
            return self.parts.of_body(body).name
        position = self.parts.place_of(node)
        name = "" if position is None else self.parts.name_of_point(position)
        number = self.parts.data.arrays.node_number[node if position is None else position]
        return name or f"node {number}"

    def turning(
        self, nodes: Sequence[int], resting: np.ndarray, turns: np.ndarray
    ) -> tuple[str, ...]:
        """Bodies and points that turn back where nodes, by their index as analysed, rest.

        A body does so if all of its nodes that move do, and its rotation if those that turn do.
        """
        given, kinds = self.result.condensed.nodes, self.result.given.arrays.node_kind
        rests = {int(given[node]) for node in np.flatnonzero(resting | turns).tolist()}
        names: set[str] = set()
        for node in nodes:
            name = self.of_node(int(given[node]))
            mine = self._moving.get(name, set())
            turned = {each for each in mine if kinds[each] > NodeKind.POSITION}
            if mine <= rests:
                names.add(name)
            elif turned and turned <= rests:
                names.add(f"{ROTATION}{name}")
        return tuple(sorted(names, key=natural))

    @cached_property
    def _moving(self) -> dict[str, set[int]]:
        """Nodes of the model as given that can move and were analysed, by what they belong to."""
        made: dict[str, set[int]] = {}
        classes = self.result.data.arrays.coordinate_class
        free = np.flatnonzero((classes > 1).any(axis=0)).tolist()
        for node in free:
            given = int(self.result.condensed.nodes[node])
            made.setdefault(self.of_node(given), set()).add(given)
        return made

    def points(self, most: int) -> tuple[Point, ...]:
        """Position nodes that can move, by their numbers; at most so many."""
        arrays = self.result.given.arrays
        free = (arrays.coordinate_class > 1).any(axis=0) & (arrays.node_kind <= NodeKind.POSITION)
        nodes = sorted(
            np.flatnonzero(free).tolist(), key=lambda node: int(arrays.node_number[node])
        )[:most]
        own = [self.parts.name_of_point(node) for node in nodes]
        return tuple(
            Point(
                node,
                name
                if name and own.count(name) == 1
                else f"{name} (node {arrays.node_number[node]})".strip()
                if name
                else f"node {arrays.node_number[node]}",
            )
            for node, name in zip(nodes, own, strict=True)
        )

    def bodies(self, most: int) -> tuple[Point, ...]:
        """An orientation node of each body that can turn, with the body's name; at most so many."""
        kinds = self.result.given.arrays.node_kind
        classes = self.result.given.arrays.coordinate_class
        made: list[Point] = []
        for k, body in enumerate(self.parts.bodies):
            turns = [
                node
                for node in body.orientations
                if kinds[node] > NodeKind.POSITION and bool((classes[:, node] > 1).any())
            ]
            if turns and len(made) < most:
                made.append(Point(turns[0], self.parts.of_body(k).name))
        return tuple(made)
