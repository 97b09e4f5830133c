# SPDX-License-Identifier: BSD-3-Clause
"""Stiffness and mass of a model in the making."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from ..core.arrays import FloatArray
from ..deck.errors import model_error
from .properties import NUMBERS, Properties

_Numbers = tuple[float, ...]


class PropertiesDraft:
    """What was said about stiffness and mass, by indices of elements and numbers of nodes."""

    def __init__(self) -> None:
        """Nothing is said yet."""
        self.stiffness: dict[int, _Numbers] = {}
        self.mass: dict[int, _Numbers] = {}
        self.node_mass: dict[int, _Numbers] = {}

    @classmethod
    def of(cls, properties: Properties, node_numbers: Sequence[int]) -> PropertiesDraft:
        """The draft that gives these properties."""
        draft = cls()
        draft.stiffness = dict(rows_of(properties.stiffness))
        draft.mass = dict(rows_of(properties.mass))
        draft.node_mass = {node_numbers[i]: row for i, row in rows_of(properties.node_mass)}
        return draft

    def give(self, index: int, stiffness: _Numbers | None, mass: _Numbers | None) -> None:
        """Say something about an element; what is not said now stays as it was."""
        if stiffness is not None:
            _require("stiffness", stiffness)
        if mass is not None:
            self.mass[index] = _require("mass", mass)
        if stiffness is not None:
            self.stiffness[index] = stiffness

    def give_node(self, number: int, values: _Numbers) -> None:
        """Say something about a node."""
        self.node_mass[number] = _require("node_mass", values)

    def renumber(self, new: Mapping[int, int]) -> None:
        """Give elements new indices; of those that get none nothing is said any more."""
        self.stiffness = {new[i]: row for i, row in self.stiffness.items() if i in new}
        self.mass = {new[i]: row for i, row in self.mass.items() if i in new}

    def freeze(self, elements: int, node_numbers: Sequence[int]) -> Properties | None:
        """The properties of these elements and nodes; None where nothing is said."""
        if not (self.stiffness or self.mass or self.node_mass):
            return None
        place = {number: i for i, number in enumerate(node_numbers)} if self.node_mass else {}
        at_nodes = {place[n]: row for n, row in self.node_mass.items() if n in place}
        return Properties(
            _table("stiffness", elements, self.stiffness),
            _table("mass", elements, self.mass),
            _table("node_mass", len(node_numbers), at_nodes),
        )


def rows_of(table: FloatArray) -> Iterable[tuple[int, _Numbers]]:
    """Index and numbers of each row of which something is given."""
    for i in np.flatnonzero(~np.isnan(table[:, 0])).tolist():
        yield i, tuple(value for value in table[i].tolist() if value == value)


def _table(name: str, rows: int, said: Mapping[int, _Numbers]) -> FloatArray:
    table = np.full((rows, NUMBERS[name]), np.nan)
    for i, row in said.items():
        table[i, : len(row)] = row
    return table


def _require(name: str, values: _Numbers) -> _Numbers:
    what = "mass" if name == "node_mass" else name
    if not 1 <= len(values) <= NUMBERS[name]:
        raise model_error(
            "bad-number", f"a {what} is 1 to {NUMBERS[name]} numbers, not {len(values)}"
        )
    if not all(map(math.isfinite, values)):
        raise model_error("bad-number", f"a number of the {what} is not finite")
    return values
