# SPDX-License-Identifier: BSD-3-Clause
"""The parts of a mechanism as its designer names them, and its joints, read off the model."""

from __future__ import annotations

from collections import Counter, deque
from dataclasses import replace
from itertools import groupby
from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray, IntArray, ModelArrays
from ...core.elements import Class, Member, NodeKind
from ...deck.rendering import model_error
from ...util.groups import grouped, groups_of
from ...util.records import Word, cached_property
from ...util.text import harmless, in_short
from ..data import ModelData
from ..names import is_half, own_number, part_name
from .forms import Form, all_held, forms_of, is_member


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
    members = grouped((group[place[op]], k) for k, (_, op, _, _) in enumerate(slots))
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


class PartKind(Word):
    """What a part is; the word that stands for its name where it has none."""

    SHEET = "sheet"
    WIRE = "wire"
    BAR = "bar"
    BEAM = "beam"
    BODY = "body"
    HINGE = "hinge"


_KIND_OF_FORM: dict[int, PartKind] = {
    Form.SHEET: PartKind.SHEET,
    Form.WIRE: PartKind.WIRE,
    Form.BAR: PartKind.BAR,
    Form.BEAM: PartKind.BEAM,
    Form.RIGID: PartKind.BODY,
}


class Part(NamedTuple):
    """A sheet, wire, bar, beam, body or hinge.

    Attributes:
        kind: Which of them.
        name: What it is called; its kind and the number of its first element where the model
            gives no name.
        elements: Indices of its elements in the model as given; of a divided sheet from end to
            end.
        ends: Indices of the position nodes at both ends, none of a body, one of a hinge.
        number: Number of its first element.
        is_named: Whether the model gives its name.
    """

    kind: PartKind
    name: str
    elements: tuple[int, ...]
    ends: tuple[int, ...]
    number: int
    is_named: bool

    @property
    def is_read_only(self) -> bool:
        """It holds no arrays, and results hold very many parts."""
        return True

    def __str__(self) -> str:
        """Its name."""
        return self.name


class Parts:
    """The parts of a model; each is made when it is asked for."""

    def __init__(self, data: ModelData) -> None:
        """Keep the model, as it was given."""
        self.data = data
        self._known: dict[int, Part] = {}
        self._at: dict[int, tuple[Part, ...]] = {}
        self._order: dict[Part, tuple[object, ...]] = {}

    def __len__(self) -> int:
        """How many there are."""
        return len(self.all)

    @cached_property
    def all(self) -> tuple[Part, ...]:
        """All parts, by their first elements."""
        elements = range(self.data.arrays.element_number.size)
        found = dict.fromkeys(self.of_element(i) for i in elements)
        return tuple(sorted(found, key=lambda part: part.elements[0]))

    @cached_property
    def bodies(self) -> tuple[Body, ...]:
        """The rigid bodies, in the order of their first elements."""
        return bodies_of(self.data.arrays)

    @cached_property
    def first_points(self) -> tuple[int, ...]:
        """Of each of `bodies`, index of the position node for which it stands."""
        names, nodes = self.data.element_names, self.data.arrays.element_node[0]
        first = (
            min(body.elements, key=lambda i: (is_half(names[i]), own_number(names[i]), i))
            for body in self.bodies
        )
        return tuple(int(nodes[i]) - 1 for i in first)

    @cached_property
    def links(self) -> frozenset[int]:
        """Indices of the elements that only carry points of a body.

        Rigid links, and of a body of several members those without a name of their own.
        """
        link = is_member(self.data.arrays.element_kind, Member.LINK)
        made = set(np.flatnonzero(link).tolist())
        names = self.data.element_names
        for body in self.bodies:
            if len(body.elements) > 1:
                own = [part_name(names[i]) for i in body.elements]
                given = Counter(own)
                made.update(
                    i
                    for i, name in zip(body.elements, own, strict=True)
                    if not name or given[name] > 1
                )
        return frozenset(made)

    def of_element(self, index: int) -> Part:
        """The part that an element, by its index, belongs to."""
        if index not in self._known:
            part = self._part_with(index)
            self._known.update(dict.fromkeys(part.elements, part))
        return self._known[index]

    def _part_with(self, index: int) -> Part:
        chain, body = self._chain_of.get(index), self._body_of_element.get(index)
        if chain is not None:
            row = self.data.chains[chain]
            kind = self._kinds[row.elements[0]]
            return self._made(kind, row.elements, (row.positions[0], row.positions[-1]))
        if body is not None:
            return self._made(PartKind.BODY, self.bodies[body].elements, ())
        kind, ends = self._kinds[index], self._ends[index]
        if kind is PartKind.HINGE:
            return self._made(kind, (index,), tuple(n for n in ends[:1] if n >= 0))
        return self._made(kind, (index,), ends)

    @cached_property
    def _kinds(self) -> list[PartKind]:
        """Of each element what it is where it is a part by itself."""
        # What is no member is a hinge.
        return [_KIND_OF_FORM.get(form, PartKind.HINGE) for form in self.form.tolist()]

    @cached_property
    def _ends(self) -> list[tuple[int, ...]]:
        """Of each element the position nodes at its ends."""
        return list(map(tuple, (self.data.arrays.element_node[[0, 2]] - 1).T.tolist()))

    def of_body(self, body: int) -> Part:
        """The part that a body, by its index, is."""
        return self.of_element(self.bodies[body].elements[0])

    @cached_property
    def elements_by_name(self) -> dict[str, list[int]]:
        """Indices of elements by the name of their part, ascending."""
        names = enumerate(self.data.element_names)
        return grouped((part_name(name), index) for index, name in names if name)

    @cached_property
    def points_by_name(self) -> dict[str, list[int]]:
        """Indices of position nodes by their names, ascending."""
        return grouped((name, index) for index, name in enumerate(self.data.node_names) if name)

    def named(self, name: str) -> Part:
        """The part of a name.

        Raises:
            ModelError: there is none, or there are several.
        """
        found = [part for part in self.all if part.name == name]
        if not found:
            raise model_error("no-such-part", f"there is no part called {in_short(name)}")
        if len(found) > 1:
            raise model_error(
                "ambiguous-part",
                f"{len(found)} parts are called {in_short(name)}",
                "give each part a name of its own",
            )
        return found[0]

    @property
    def form(self) -> np.ndarray:
        """(elements,) `Form`, 0 where an element is no member."""
        return self._forms[0]

    @property
    def wide(self) -> np.ndarray:
        """(elements,) local axis, 1 or 2, along which a sheet is wide, else 0."""
        return self._forms[1]

    @cached_property
    def _forms(self) -> tuple[np.ndarray, np.ndarray]:
        return forms_of(self.data.arrays)

    def _made(self, kind: PartKind, elements: tuple[int, ...], ends: tuple[int, ...]) -> Part:
        number = int(self.data.arrays.element_number[min(elements)])
        names = [name for i in elements if (name := part_name(self.data.element_names[i]).strip())]
        # A body that carries the half of a notch is called by its own name.
        given = Counter([name for name in names if not is_half(name)] or names)
        if given:
            # Of several names the commonest, of those the first.
            return Part(kind, harmless(given.most_common(1)[0][0]), elements, ends, number, True)
        return Part(kind, f"{kind} {number}", elements, ends, number, False)

    def is_one_beam(self, index: int) -> bool:
        """Whether an element, by its index, is of a row of beams that are declared as one."""
        chain = self._chain_of.get(index)
        return chain is not None and self.data.chains[chain].condensed_classes is not None

    @cached_property
    def _chain_of(self) -> dict[int, int]:
        return {i: k for k, chain in enumerate(self.data.chains) for i in chain.elements}

    @cached_property
    def _body_of_element(self) -> dict[int, int]:
        return {i: k for k, body in enumerate(self.bodies) for i in body.elements}

    # Places -----------------------------------------------------------------

    @cached_property
    def body_at(self) -> dict[int, int]:
        """The first body that carries a position node or turns with an orientation node."""
        return {
            node: k
            for k, body in reversed(list(enumerate(self.bodies)))
            for node in (*body.positions, *body.orientations)
        }

    @cached_property
    def _users(self) -> tuple[IntArray, IntArray]:
        """Elements by position node that they end at: where each node's start, and they."""
        ends = self.data.arrays.element_node[[0, 2]] - 1
        element = np.broadcast_to(np.arange(ends.shape[1]), ends.shape)
        used = ends >= 0
        order = np.argsort(ends[used], kind="stable")
        counts = np.bincount(ends[used], minlength=self.data.arrays.node_number.size)
        start = np.concatenate([np.zeros(1, np.int64), np.cumsum(counts)])
        return start.astype(np.int32), element[used][order].astype(np.int32)

    def at(self, position: int) -> tuple[Part, ...]:
        """The parts that end at or belong to a position node, by name."""
        if position not in self._at:
            self._at[position] = self._sorted(self.elements_at(position))
        return self._at[position]

    def turning(self, orientation: int) -> tuple[Part, ...]:
        """The parts that turn with an orientation node, by name."""
        used = np.any(self.data.arrays.element_node[[1, 3]] == orientation + 1, axis=0)
        return self._sorted(np.flatnonzero(used).tolist())

    def _sorted(self, elements: list[int]) -> tuple[Part, ...]:
        """The parts of some elements, by name."""
        found = dict.fromkeys(self.of_element(i) for i in elements)
        for part in found:
            if part not in self._order:
                self._order[part] = natural(part.name), part.elements
        return tuple(sorted(found, key=self._order.__getitem__))

    def elements_at(self, position: int) -> list[int]:
        """Indices of the elements that end at a position node."""
        start, element = self._users
        mine: list[int] = element[start[position] : start[position + 1]].tolist()
        return mine

    def is_held(self, node: int) -> bool:
        """Whether a node is fixed in all that it has."""
        classes = self.data.arrays.coordinate_class[:, node]
        return bool(np.all((classes == Class.FIXED) | (classes == Class.NONE)))

    @cached_property
    def position_of(self) -> dict[int, int]:
        """The position node at which an orientation node stands, of the first that names both."""
        slots = self.data.arrays.element_node - 1
        place, turned = slots[[0, 2]].ravel(), slots[[1, 3]].ravel()
        both = np.flatnonzero((place >= 0) & (turned >= 0))[::-1]
        return dict(zip(turned[both].tolist(), place[both].tolist(), strict=True))

    @cached_property
    def orientations_at(self) -> dict[int, tuple[int, ...]]:
        """The orientation nodes that stand at each position node, ascending."""
        made = grouped((place, node) for node, place in sorted(self.position_of.items()))
        return {place: tuple(nodes) for place, nodes in made.items()}

    def is_shared(self, node: int) -> bool:
        """Whether an orientation of no body stands where a body is, or another orientation."""
        place = self.position_of.get(node)
        if place is None or node in self.body_at:
            return False
        return place in self.body_at or len(self.orientations_at[place]) > 1

    def place_of(self, node: int) -> int | None:
        """The position node of a node: itself, or where an orientation stands."""
        if self.data.arrays.node_kind[node] <= NodeKind.POSITION:
            return node
        return self.position_of.get(node)

    def name_of_point(self, position: int) -> str:
        """The name that the model gives a position node; empty without one."""
        return harmless(self.data.node_names[position]).strip()


def natural(name: str) -> tuple[tuple[bool, int, str, str], ...]:
    """A key by which names are sorted as people do: "sheet 2" before "sheet 10"."""
    words = ["".join(run) for _, run in groupby(name, str.isdigit)]
    # Python makes no number of thousands of digits, but more digits are a larger one.
    numbers = (word.lstrip("0") if word.isdecimal() else "" for word in words)
    return tuple(
        (not word.isdecimal(), len(number), number, word)
        for word, number in zip(words, numbers, strict=True)
    )


def surplus_of(data: ModelData) -> tuple[tuple[int, tuple[int, ...]], ...]:
    """Released deformations (from 1) of beams of divided sheets, by index, that are inside these.

    They are to be declared independent.
    """
    return tuple(sorted(each for chain in data.chains for each in chain.surplus))


def declared(data: ModelData) -> ModelData:
    """The model with all of that independent; the same object where there is nothing."""
    surplus = surplus_of(data)
    if not surplus:
        return data
    classes = data.arrays.deformation_class.copy(order="F")
    for element, deformations in surplus:
        classes[np.array(deformations) - 1, element] = Class.INDEPENDENT
    return replace(data, arrays=data.arrays._replace(deformation_class=classes))


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
        inner = (
            (self.parts.of_element(chain.elements[0]), node)
            for chain in self.data.chains
            for node in (*chain.positions[1:-1], *chain.orientations[1:-1])
        )
        made = grouped([*inner, *((part, node) for node, part in self.own_ends)])
        found = ((part, tuple(sorted(set(nodes)))) for part, nodes in made.items())
        return tuple(sorted(found, key=lambda inside: (natural(inside[0].name), inside[1])))

    @cached_property
    def own_ends(self) -> list[tuple[int, Part]]:
        """Orientations that one part alone has, where other parts or a support hold its place."""
        slots = self.data.arrays.element_node[[1, 3]] - 1
        end, element = np.nonzero(slots >= 0)
        users = grouped(zip(slots[end, element].tolist(), element.tolist(), strict=True))
        made = []
        for node, elements in sorted(users.items()):
            place = self.parts.place_of(node)
            if len(elements) > 1 or place is None:
                continue
            part = self.parts.of_element(elements[0])
            if part.kind in (PartKind.BODY, PartKind.HINGE):
                continue
            if self.parts.is_held(place) or any(other != part for other in self.parts.at(place)):
                made.append((node, part))
        return made

    @cached_property
    def away(self) -> IntArray:
        """(nodes,) how many flexible elements lie between a node and the ground, at least.

        Of what does not hang on the ground one more than of anything else.
        """
        slots = self.data.arrays.element_node - 1
        rigid = np.isin(
            np.arange(slots.shape[1]), [i for b in self.parts.bodies for i in b.elements]
        )
        beside: list[list[tuple[int, bool]]] = [
            [] for _ in range(self.data.arrays.node_number.size)
        ]
        for nodes, is_rigid in zip(slots.T.tolist(), rigid.tolist(), strict=True):
            p, op, q, oq = nodes
            near, far = [n for n in (p, op) if n >= 0], [n for n in (q, oq) if n >= 0]
            # Of what is rigid all nodes are as far; of the rest those of one end are.
            groups = [(near + far, False)] if is_rigid else [(near, False), (far, False)]
            pairs = [(a, b, step) for group, step in groups for a in group for b in group]
            pairs += [] if is_rigid else [(a, b, True) for a in near for b in far]
            for a, b, step in pairs:
                beside[a].append((b, step))
                beside[b].append((a, step))
        made = np.full(len(beside), -1, np.int32)
        front = deque((n, 0) for n in range(len(beside)) if self.parts.is_held(n))
        while front:
            node, far_away = front.popleft()
            if made[node] >= 0:
                continue
            made[node] = far_away
            for other, step in beside[node]:
                if made[other] < 0:
                    # What is as far comes first, so that all are met in their order.
                    (front.append if step else front.appendleft)((other, far_away + step))
        made[made < 0] = made.max(initial=0) + 1
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
