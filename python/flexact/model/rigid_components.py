# SPDX-License-Identifier: BSD-3-Clause
"""Which points are carried by one rigid body already."""

from __future__ import annotations

from .draft import Draft
from .handles import Node
from .selection import is_rigid


class RigidComponents:
    """Points joined by rigid links, as sets that are merged.

    A point is known by the number of its orientation; a point that a link of a deck carries
    without its orientation (RBEAM) by its position number, negative.
    """

    def __init__(self) -> None:
        """Of no elements so far."""
        self._parent: dict[int, int] = {}
        self._anchor: dict[int, Node] = {}
        #: How many elements of the draft were looked at.
        self.seen = 0

    @classmethod
    def of(cls, draft: Draft) -> RigidComponents:
        """Those of a draft as it is now; elements that are new since the last time are added."""
        if draft.components is None:
            draft.components = cls()
        made = draft.components
        for index in range(made.seen, len(draft.kinds)):
            if is_rigid(draft, index):
                p, op, q, oq = draft.slots[index]
                if not oq:
                    made._anchor[-q] = Node(p, op, draft.owner)
                made._merge(op, oq or -q)
        made.seen = len(draft.kinds)
        return made

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
