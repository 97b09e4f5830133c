# SPDX-License-Identifier: BSD-3-Clause
"""Limbs: flexures, bars and what is in series with them, from one body or the ground to another."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...analysis.decomposition import Outcome
from ...core.arrays import FloatArray
from ...core.elements import Class, NodeKind
from ...model.parts.parts import Part, PartKind, natural
from ...util.cached import cached_property


class Limb(NamedTuple):
    """Flexible parts in a row.

    Attributes:
        parts: They, by name.
        ends: Indices of the position nodes at both ends in the model as given, ascending.
        inner: Indices of the position nodes between its parts.
    """

    parts: tuple[Part, ...]
    ends: tuple[int, ...]
    inner: tuple[int, ...]

    @property
    def name(self) -> str:
        """What the names of its parts begin with, else all of them."""
        heads = {part.name.rpartition(",")[0].strip() for part in self.parts}
        if len(self.parts) == 1:
            return self.parts[0].name
        head = heads.pop()
        return head if not heads and head else " and ".join(part.name for part in self.parts)

    def at(self, position: int) -> Part:
        """The part that ends at a position node."""
        return next(part for part in self.parts if position in part.ends)


class Limbs:
    """The limbs of a mechanism, and where they end."""

    def __init__(self, outcome: Outcome) -> None:
        """Keep the analysis; what is asked for is found then."""
        self.outcome = outcome
        self.parts = outcome.parts

    @cached_property
    def all(self) -> tuple[Limb, ...]:
        """By name."""
        flexible = [
            part
            for part in self.parts.all
            if part.kind not in (PartKind.BODY, PartKind.HINGE) and len(part.ends) == 2
        ]
        owner = list(range(len(flexible)))
        ends: dict[int, list[int]] = {}
        for k, part in enumerate(flexible):
            for position in part.ends:
                ends.setdefault(position, []).append(k)
        inner = {p: users for p, users in ends.items() if self._is_inner(p, len(users))}
        for users in inner.values():
            first, last = (_root(owner, k) for k in users)
            owner[first] = last
        groups: dict[int, list[int]] = {}
        for k in range(len(flexible)):
            groups.setdefault(_root(owner, k), []).append(k)
        made = []
        for mine in groups.values():
            members = tuple(sorted((flexible[k] for k in mine), key=_by_name))
            points = {position for part in members for position in part.ends}
            outer = tuple(sorted(p for p in points if p not in inner))
            made.append(Limb(members, outer, tuple(sorted(points - set(outer)))))
        return tuple(sorted(made, key=lambda limb: natural(limb.name)))

    def _is_inner(self, position: int, users: int) -> bool:
        """Whether a point is between two parts and nothing else is there."""
        if users != 2 or position in self.parts.body_at or len(self.parts.at(position)) != 2:
            return False
        classes = self.outcome.given.arrays.coordinate_class[:, position]
        turned = self._orientations.get(position, set())
        return bool(np.all(classes != Class.FIXED)) and len(turned) == 1

    @cached_property
    def _orientations(self) -> dict[int, set[int]]:
        """Orientation nodes of the parts that end at each position node."""
        slots = self.outcome.given.arrays.element_node - 1
        made: dict[int, set[int]] = {}
        for p, op in ((0, 1), (2, 3)):
            both = (slots[p] >= 0) & (slots[op] >= 0)
            for place, turned in zip(
                slots[p][both].tolist(), slots[op][both].tolist(), strict=True
            ):
                made.setdefault(place, set()).add(turned)
        return made

    def place(self, position: int) -> FloatArray:
        """(3,) of a position node [m]."""
        value: FloatArray = self.outcome.given.arrays.node_value[:3, position]
        return value

    @cached_property
    def hubs(self) -> tuple[tuple[object, tuple[tuple[Limb, int], ...]], ...]:
        """Bodies, and points that turn as one where parts meet: the limbs that end there.

        Each with the position nodes at which they do; those that end at the ground alone are
        left out.
        """
        made: dict[object, list[tuple[Limb, int]]] = {}
        for limb in self.all:
            for position in limb.ends:
                key = self._hub(position)
                if key is not None:
                    made.setdefault(key, []).append((limb, position))
        return tuple((key, tuple(found)) for key, found in made.items())

    def _hub(self, position: int) -> object | None:
        body = self.parts.body_at.get(position)
        if body is not None:
            return ("body", body)
        if self.parts.is_held(position) and self._is_held_turning(position):
            return None
        return ("joint", position) if len(self._orientations.get(position, ())) == 1 else None

    def _is_held_turning(self, position: int) -> bool:
        return all(self.parts.is_held(node) for node in self._orientations.get(position, ()))

    def orientation_at(self, position: int) -> int | None:
        """The one orientation node at a position node; None where there is none, or several."""
        found = self._orientations.get(position, set())
        return next(iter(found)) if len(found) == 1 else None

    def is_ground(self, position: int) -> bool:
        """Whether a position node is fixed."""
        return self.parts.is_held(position)


def _root(owner: list[int], k: int) -> int:
    while owner[k] != k:
        k = owner[k]
    return k


def _by_name(part: Part) -> tuple[object, ...]:
    return natural(part.name), part.elements


def position_of_hinge(outcome: Outcome, part: Part) -> int | None:
    """The position node at which a hinge stands; None where none is known."""
    arrays = outcome.given.arrays
    nodes = (arrays.element_node[:, part.elements[0]] - 1).tolist()
    for node in nodes:
        if node < 0:
            continue
        if arrays.node_kind[node] <= NodeKind.POSITION:
            return int(node)
        place = outcome.parts.place_of(node)
        if place is not None:
            return int(place)
    return None
