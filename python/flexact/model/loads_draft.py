# SPDX-License-Identifier: BSD-3-Clause
"""Loads on a model in the making."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

import numpy as np

from ..core.arrays import FloatArray
from .loads import Loads

_Load = tuple[float, float, float]
_NONE: _Load = (0.0, 0.0, 0.0)


class LoadsDraft:
    """What was said about loads, by numbers of nodes; x, y, z of each, zero where not given."""

    def __init__(self) -> None:
        """Nothing is said yet."""
        self.force: dict[int, _Load] = {}
        self.increment: dict[int, _Load] = {}
        self.gravity: _Load = _NONE

    @classmethod
    def of(cls, loads: Loads, node_numbers: Sequence[int]) -> LoadsDraft:
        """The draft that gives these loads."""
        draft = cls()
        draft.force = _rows(loads.force, node_numbers)
        draft.increment = _rows(loads.increment, node_numbers)
        x, y, z = loads.gravity.tolist()
        draft.gravity = x, y, z
        return draft

    @property
    def nodes(self) -> list[int]:
        """Numbers of the nodes that bear something."""
        both = (*self.force.items(), *self.increment.items())
        return list(dict.fromkeys(number for number, load in both if any(load)))

    def drop(self, number: int) -> None:
        """Say nothing of a node any more."""
        self.force.pop(number, None)
        self.increment.pop(number, None)

    def on(self, numbers: Iterable[int]) -> LoadsDraft:
        """The loads on some nodes, without gravity."""
        chosen, made = set(numbers), LoadsDraft()
        made.force = {n: load for n, load in self.force.items() if n in chosen}
        made.increment = {n: load for n, load in self.increment.items() if n in chosen}
        return made

    def add(
        self, loads: LoadsDraft, new: Mapping[int, int], moved: Callable[[int, _Load], _Load]
    ) -> None:
        """Add the loads on nodes after a move to those that their images bear.

        Args:
            loads: Of which only those on nodes that have an image are taken.
            new: Numbers of the images.
            moved: The image of a load on a node.
        """
        for said, there in ((loads.force, self.force), (loads.increment, self.increment)):
            for number, load in said.items():
                if number in new:
                    a, b, c = there.get(new[number], _NONE)
                    x, y, z = moved(number, load)
                    there[new[number]] = (a + x, b + y, c + z)

    def freeze(self, node_numbers: Sequence[int]) -> Loads | None:
        """The loads on these nodes; None where all are zero."""
        loaded = self.nodes
        place = {number: i for i, number in enumerate(node_numbers)} if loaded else {}
        if not (any(number in place for number in loaded) or any(self.gravity)):
            return None
        rows = len(node_numbers)
        force, increment = (_table(each, place, rows) for each in (self.force, self.increment))
        return Loads(force, increment, np.array(self.gravity))


def _rows(table: FloatArray, node_numbers: Sequence[int]) -> dict[int, _Load]:
    made = {}
    for i in np.flatnonzero(table.any(axis=1)).tolist():
        x, y, z = table[i].tolist()
        made[node_numbers[i]] = (x, y, z)
    return made


def _table(said: Mapping[int, _Load], place: Mapping[int, int], rows: int) -> FloatArray:
    table = np.zeros((rows, 3))
    for number, load in said.items():
        if number in place:
            table[place[number]] = load
    return table
