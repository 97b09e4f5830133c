# SPDX-License-Identifier: BSD-3-Clause
"""Edits in a mechanism that has taken the place of another: its parts are found again."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ...core.elements import NodeKind
from ...model.parts.parts import Parts
from ...util.records import cached_property
from .editable_model import Board, DeformationPlace, Edit, Edits, Place, RefusedError

Identity = tuple[object, ...]


class Renewal:
    """From places of a mechanism to those of the one that has taken its place."""

    def __init__(self, old: Board, new: Board) -> None:
        """Keep both."""
        self.old, self.new = old, new
        self._from, self._to = _Known(old.parts), _Known(new.parts)
        self._found: dict[Place, Place | None] = {}

    def edits(self, given: Edits) -> Edits:
        """The edits in the new mechanism, without those whose element or node is gone.

        What the new mechanism says itself is no edit any more.
        """
        found = [Edit(place, each.to) for each in given if (place := self.place(each.place))]
        return self.new.edited((), found)

    def place(self, place: Place) -> Place | None:
        """Where a place is now; None where it is gone."""
        if place not in self._found:
            try:
                self._found[place] = self._place(place)
            except RefusedError:
                self._found[place] = None
        return self._found[place]

    def _place(self, place: Place) -> Place | None:
        if isinstance(place, DeformationPlace):
            element = self._element(place.element)
            return None if element is None else self.new.deformation(element, place.number)
        node = self._node(place.node)
        return None if node is None else self.new.coordinate(node, place.name)

    def _element(self, number: int) -> int | None:
        """An element by its name; else by its number or its nodes."""
        old, new = self.old.given, self.new.given
        index = old.element_index[number]
        same = new.element_index.get(number)
        kind = int(old.arrays.element_kind[index])
        if same is not None and int(new.arrays.element_kind[same]) != kind:
            same = None
        name = old.element_names[index]
        if name:
            return self._named(name, old.element_names, new.element_names, index, same)
        here = self._from.ends(index)
        if same is not None and self._to.ends(same) == here:
            return number
        moved = self._to.elements_between.get((kind, here), [])
        if len(moved) == 1:
            return int(new.arrays.element_number[moved[0]])
        # In a deck a number says which it is; in a program it is counted, and may be another's.
        is_same_model = old.arrays.element_number.size == new.arrays.element_number.size
        stays = same is not None and not new.element_names[same]
        return number if stays and (new.source is not None or is_same_model) else None

    def _named(
        self,
        name: str,
        before: Sequence[str],
        after: Sequence[str],
        index: int,
        same: int | None,
    ) -> int | None:
        numbers = self.new.given.arrays.element_number
        mine = [i for i, each in enumerate(after) if each == name]
        if same in mine:
            return int(numbers[same])
        others = [i for i, each in enumerate(before) if each == name]
        if mine:
            place = others.index(index)
            return int(numbers[mine[place]]) if len(mine) == len(others) else None
        # It may have another name now.
        is_there = same is not None and self._to.ends(same) == self._from.ends(index)
        return int(numbers[same]) if is_there else None

    def _node(self, number: int) -> int | None:
        """A node by the name of its point, else by its place, else by what meets there."""
        old, new = self.old.given, self.new.given
        index = old.node_index[number]
        same = new.node_index.get(number)
        kind = int(old.arrays.node_kind[index])
        if same is not None and int(new.arrays.node_kind[same]) != kind:
            same = None
        name = self._from.name(index)
        found = self._to.points_named.get((kind, name), []) if name else []
        here = self._from.place(index)
        if not found:
            found = self._to.nodes_at.get((kind, here), []) if here else []
        if same is not None and (same in found or (not here and not name)):
            return number
        if len(found) == 1:
            return int(new.arrays.node_number[found[0]])
        if same is not None and self._to.meeting(same) == self._from.meeting(index):
            return number
        return None


class _Known:
    """What elements and nodes are known by."""

    def __init__(self, parts: Parts) -> None:
        self.parts, self.data = parts, parts.data

    def name(self, node: int) -> str:
        """The name of the point where a node stands."""
        position = self.parts.place_of(node)
        return "" if position is None else self.parts.name_of_point(position)

    def place(self, node: int) -> Identity:
        """Where a node is; nothing where it stands nowhere."""
        position = self.parts.place_of(node)
        if position is None:
            return ()
        count = 2 if self.data.arrays.node_kind[position] == NodeKind.PLANAR_POSITION else 3
        value = np.asarray(self.data.arrays.node_value[:count, position]) + 0.0
        return tuple(value.tolist())

    def ends(self, element: int) -> Identity:
        """Where the nodes of an element are."""
        slots = (self.data.arrays.element_node[:, element] - 1).tolist()
        return tuple(self.place(node) if node >= 0 else None for node in slots)

    def meeting(self, node: int) -> frozenset[str]:
        """Names of the parts that meet at a node."""
        position = self.parts.place_of(node)
        here = self.parts.turning(node) if position is None else self.parts.at(position)
        return frozenset(part.name for part in here)

    @cached_property
    def elements_between(self) -> dict[Identity, list[int]]:
        """Indices of elements by their kind and ends."""
        kinds = self.data.arrays.element_kind.tolist()
        return _grouped(((kind, self.ends(i)), i) for i, kind in enumerate(kinds))

    @cached_property
    def nodes_at(self) -> dict[Identity, list[int]]:
        """Indices of nodes by their kind and place."""
        kinds = self.data.arrays.node_kind.tolist()
        return _grouped(((kind, self.place(i)), i) for i, kind in enumerate(kinds))

    @cached_property
    def points_named(self) -> dict[Identity, list[int]]:
        """Indices of nodes by their kind and the name of their point."""
        kinds = self.data.arrays.node_kind.tolist()
        return _grouped(((kind, name), i) for i, kind in enumerate(kinds) if (name := self.name(i)))


def _grouped(items: Iterable[tuple[Identity, int]]) -> dict[Identity, list[int]]:
    made: dict[Identity, list[int]] = {}
    for key, value in items:
        made.setdefault(key, []).append(value)
    return made
