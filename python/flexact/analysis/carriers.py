# SPDX-License-Identifier: BSD-3-Clause
"""What moves in a mechanism: bodies, joints between parts, and what is inside a part."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import NodeKind
from ..model.parts.parts import Part, PartKind, Parts, natural
from ..util.records import cached_property

#: How many of the parts that meet at a joint its name names.
_MOST_NAMED = 3
_FLEXURES = (PartKind.SHEET, PartKind.WIRE)


class Joint(NamedTuple):
    """A point that belongs to no body: where parts meet, or where one ends."""

    position: int | None
    """Index of its position node in the model as given; None where its place is not known."""
    orientation: int | None
    """Index of its orientation node; None where it has none."""
    parts: tuple[Part, ...]
    """The parts that meet there, by name."""
    name: str
    """Its name in the model; empty without one."""

    @property
    def is_read_only(self) -> bool:
        """It holds no arrays, and where many parts meet many results hold it."""
        return True

    @property
    def nodes(self) -> tuple[int, ...]:
        """Indices of its nodes, the position first."""
        return tuple(node for node in self[:2] if node is not None)

    @property
    def is_fold(self) -> bool:
        """Whether two sheets or wires meet there, and nothing else.

        Where more meet it is what they carry: a body that is a point.
        """
        return len(self.parts) == 2 and all(part.kind in _FLEXURES for part in self.parts)

    def __str__(self) -> str:
        """Its name, or what meets there."""
        if self.name:
            return self.name
        names = [part.name for part in self.parts]
        if not names:
            return "a joint"
        if len(names) > _MOST_NAMED:
            names[_MOST_NAMED - 1 :] = [f"{len(names) - _MOST_NAMED + 1} more"]
        if not names:
            return "a free joint"
        return f"the joint of {' and '.join(names)}" if len(names) > 1 else f"the end of {names[0]}"


class Carriers:
    """The bodies, joints and insides of a model; each is found when it is asked for.

    An inside is the inner nodes of a row of beams, or an orientation that is one part's alone
    where it ends at others: the end of a wire that can spin.
    """

    def __init__(self, parts: Parts) -> None:
        """Keep the parts of the model as given."""
        self.parts = parts
        self.data = parts.data

    @cached_property
    def bodies(self) -> tuple[Part, ...]:
        """The part of each of `parts.bodies`."""
        return tuple(self.parts.of_body(k) for k in range(len(self.parts.bodies)))

    @cached_property
    def inner(self) -> frozenset[int]:
        """The nodes of all insides."""
        return frozenset(node for _, nodes in self.insides for node in nodes)

    @cached_property
    def between_ends(self) -> frozenset[int]:
        """The nodes that lie between the ends of flexures: those of insides and of folds."""
        folds = (joint for joint in self.joints if joint.is_fold)
        return self.inner.union(node for joint in folds for node in joint.nodes)

    @cached_property
    def joints(self) -> tuple[Joint, ...]:
        """By name, then by place."""
        bodies = self.parts.bodies
        taken = {node for body in bodies for node in body.orientations} | self.inner
        turns = self.data.arrays.node_kind > NodeKind.POSITION
        free = [node for node in np.flatnonzero(turns).tolist() if node not in taken]
        made = [self.joint(self.parts.place_of(node), node) for node in free]
        known = taken.union(node for body in bodies for node in body.positions)
        known.update(joint.position for joint in made if joint.position is not None)
        alone = (node for node in np.flatnonzero(~turns).tolist() if node not in known)
        made += [self.joint(node, None) for node in alone]
        # A length by which places are compared.
        step = float(np.abs(self.data.arrays.node_value[:3, ~turns]).max(initial=0.0)) or 1.0

        def key(joint: Joint) -> tuple[object, ...]:
            place = self.place_of(joint)
            rounded = () if place is None else tuple(np.round(place / step, 9).tolist())
            here = next((part.name for part in joint.parts if part.is_named), "")
            return natural(joint.name or here), rounded, joint.orientation or -1

        return tuple(sorted(made, key=key))

    @cached_property
    def insides(self) -> tuple[tuple[Part, tuple[int, ...]], ...]:
        """The nodes that belong to one sheet or wire alone, in the model as given, by part."""
        made: dict[Part, list[int]] = {}
        for chain in self.data.chains:
            part = self.parts.of_element(chain.elements[0])
            made.setdefault(part, []).extend((*chain.positions[1:-1], *chain.orientations[1:-1]))
        for node, part in self.own_ends:
            made.setdefault(part, []).append(node)
        found = ((part, tuple(sorted(set(nodes)))) for part, nodes in made.items())
        return tuple(sorted(found, key=lambda inside: (natural(inside[0].name), inside[1])))

    @cached_property
    def own_ends(self) -> list[tuple[int, Part]]:
        """Orientations that one part alone has, where other parts or a support hold its place."""
        slots = self.data.arrays.element_node - 1
        users: dict[int, set[int]] = {}
        for k in (1, 3):
            for element in np.flatnonzero(slots[k] >= 0).tolist():
                users.setdefault(int(slots[k, element]), set()).add(element)
        made = []
        for node, elements in sorted(users.items()):
            place = self.parts.place_of(node)
            if len(elements) > 1 or place is None:
                continue
            part = self.parts.of_element(*elements)
            if part.kind in (PartKind.BODY, PartKind.HINGE):
                continue
            if self.parts.is_held(place) or any(other != part for other in self.parts.at(place)):
                made.append((node, part))
        return made

    def place_of(self, joint: Joint) -> FloatArray | None:
        """(3,) where a joint is [m]; None where that is not known."""
        if joint.position is None:
            return None
        return np.asarray(self.data.arrays.node_value[:3, joint.position])

    def joint(self, position: int | None, orientation: int | None) -> Joint:
        """What is at a position node and turns with an orientation node."""
        here = () if position is None else self.parts.at(position)
        name = "" if position is None else self.parts.name_of_point(position)
        return Joint(position, orientation, here, name)
