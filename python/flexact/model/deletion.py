# SPDX-License-Identifier: BSD-3-Clause
"""Taking elements and nodes out of a draft, and moving nodes."""

from __future__ import annotations

from collections.abc import Iterable

from ..core.elements import Class
from ..deck.errors import model_error
from ..util.plain_text import in_short
from .draft import Draft
from .handles import Node
from .names import part_name
from .part_arguments import is_chain


def delete_elements(draft: Draft, indices: Iterable[int]) -> None:
    """Delete elements, and the points between the beams of a chain that nobody else uses."""
    gone = set(indices)
    inner = _inner(draft, gone)
    kept = [i for i in range(len(draft.kinds)) if i not in gone]
    new = {old: k for k, old in enumerate(kept)}
    for name in ("kinds", "numbers", "slots", "vectors", "classes"):
        values = getattr(draft, name)
        values[:] = [values[i] for i in kept]
    draft.names = {new[i]: each for i, each in draft.names.items() if i in new}
    draft.properties.renumber(new)
    said = draft.appearance.said
    draft.appearance.said = {new[i]: each for i, each in said.items() if i in new}
    draft.stated = {(new[i], k): value for (i, k), value in draft.stated.items() if i in new}
    draft.rigid = {new[i] for i in draft.rigid if i in new}
    draft.elements_given = sum(i < draft.elements_given for i in kept)
    draft.changed_names_or_places()
    for number in inner - {node for slots in draft.slots for node in slots}:
        _drop_node(draft, number)


def _inner(draft: Draft, indices: set[int]) -> set[int]:
    """Nodes at which one of these elements ends and the next begins."""
    begins, ends = set(), set()
    for index in indices:
        p, op, q, oq = draft.slots[index]
        begins |= {p, op}
        ends |= {q, oq}
    stated = {number for number, _ in draft.coordinate_class}
    return (begins & ends) - stated - {0}


def delete_point(draft: Draft, point: Node) -> None:
    """Delete the nodes of a point.

    Raises:
        ModelError: an element uses them.
    """
    nodes = {point.position, point.orientation}
    users = [i for i, slots in enumerate(draft.slots) if nodes & set(slots)]
    if users:
        names = dict.fromkeys(_part_words(draft, i) for i in users)
        raise model_error(
            "in-use",
            f"{point.words} is used by {', '.join(names)}",
            "delete these parts first, or move the point",
        )
    for number in nodes:
        _drop_node(draft, number)
    draft.changed_names_or_places()


def _part_words(draft: Draft, index: int) -> str:
    name = part_name(draft.names.get(index, ""))
    return in_short(name) if name else draft.element_words(index)


def _drop_node(draft: Draft, number: int) -> None:
    for table in (draft.node_kind, draft.node_value, draft.node_names, draft.properties.node_mass):
        table.pop(number, None)
    draft.loads.drop(number)
    draft.coordinate_class = {
        place: value for place, value in draft.coordinate_class.items() if place[0] != number
    }
    draft.named = {place for place in draft.named if place[0] != number}
    draft.whole = [both for both in draft.whole if number not in both]
    draft.position_of.pop(number, None)
    draft.orientation_at.pop(number, None)
    draft.changed_names_or_places()


def move(draft: Draft, number: int, value: tuple[float, float, float, float]) -> None:
    """Move a position node, and the inner points of divided flexures that end there."""
    chains = _chains_at(draft, number)
    draft.node_value[number] = value
    for indices in chains:
        start = draft.node_value[draft.slots[indices[0]][0]]
        end = draft.node_value[draft.slots[indices[-1]][2]]
        for k, index in enumerate(indices[1:], 1):
            t = k / len(indices)
            x, y, z = (start[i] * (1.0 - t) + end[i] * t for i in range(3))
            draft.node_value[draft.slots[index][0]] = (x, y, z, 0.0)
    draft.changed_names_or_places()


def _chains_at(draft: Draft, number: int) -> list[list[int]]:
    """Flexures of several beams, by their names and classes, with an end at a position node."""
    found = []
    for indices in draft.parts_by_name.values():
        if len(indices) > 1 and is_chain(draft, indices):
            divided = Class.INDEPENDENT in draft.classes[indices[1]]
            ends = draft.slots[indices[0]][0], draft.slots[indices[-1]][2]
            if divided and number in ends:
                found.append(indices)
    return found
