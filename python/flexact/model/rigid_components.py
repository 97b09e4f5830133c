# SPDX-License-Identifier: BSD-3-Clause
"""Which points are carried by one rigid body already."""

from __future__ import annotations

from .draft import Draft
from .handles import Node
from .point_arguments import is_rigid


class RigidComponents:
    """Points joined by rigid links, as sets that are merged.

    A point is known by the number of its orientation; a point that a link of a deck carries
    without its orientation (RBEAM) by its position number, negative.
    """

    def __init__(self, draft: Draft) -> None:
        """Of the model as it is now."""
        self._parent: dict[int, int] = {}
        self._anchor: dict[int, Node] = {}
        for index in [*range(draft.elements_given), *draft.rigid]:
            if is_rigid(draft, index):
                p, op, q, oq = draft.slots[index]
                if not oq:
                    self._anchor[-q] = Node(p, op, draft.owner)
                self._merge(op, oq or -q)

    def _root(self, key: int) -> int:
        self._parent.setdefault(key, key)
        while (above := self._parent[key]) != key:
            self._parent[key] = self._parent[above]
            key = above
        return key

    def _merge(self, a: int, b: int) -> None:
        self._parent[self._root(a)] = self._root(b)

    def carrier(self, node: Node) -> Node:
        """The point with an orientation by which a link takes hold of the body of a point."""
        if node.orientation in self._parent:
            return node
        return self._anchor.get(-node.position, node)

    def joined(self, a: Node, b: Node) -> bool:
        """Whether one body carries both points, given by their carriers."""
        return self._root(a.orientation) == self._root(b.orientation)

    def join(self, a: Node, b: Node) -> None:
        """A link was made between two carriers."""
        self._merge(a.orientation, b.orientation)
