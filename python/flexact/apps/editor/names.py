# SPDX-License-Identifier: BSD-3-Clause
"""Nodes, elements, coordinates and deformations in an editor's words."""

from __future__ import annotations

import numpy as np

from ...analysis.naming import length_in_words
from ...analysis.places import deformation_word, deformation_words, node_words, part_words
from ...core.elements import AXES, Class, NodeKind, coordinate_name, element_kinds
from ...core.raw import ElementKind
from ...deck.keywords import WITH_WARPING
from ...model.writing import FIRST_COMPONENT
from .deck import WARPING, Deck, Told

_CLASSES = {
    Class.FIXED: "fixed",
    Class.DEPENDENT: "dependent",
    Class.INDEPENDENT: "independent",
}
_KINDS = {
    NodeKind.POSITION: "position",
    NodeKind.PLANAR_POSITION: "position",
    NodeKind.ORIENTATION: "orientation",
    NodeKind.ANGLE: "orientation",
    WARPING: "warping",
}


#: Numbers of a position.
_NUMBERS = {NodeKind.POSITION: 3, NodeKind.PLANAR_POSITION: 2}


def kind_words(kind: int) -> str:
    """What a node is: position, orientation or warping."""
    return _KINDS[kind]


def components_of_node(kind: int) -> dict[int, str]:
    """What the components of a node of this kind are, by their numbers."""
    if kind == WARPING:
        return {1: "warping, which is not analysed"}
    first = FIRST_COMPONENT[NodeKind(kind)]
    made = {}
    for axis in AXES[kind]:
        name = coordinate_name(kind, axis)
        words = f"rotation about {name[1:]}" if name.startswith("r") else f"position along {name}"
        made[axis + first] = words
    if kind == NodeKind.ORIENTATION:
        made[1] = "the first Euler parameter, which is no coordinate of its own"
    return dict(sorted(made.items()))


def components_of_element(kind: ElementKind, name: str = "") -> dict[int, str]:
    """What the deformations of an element of this kind are, in its local frame."""
    made = {k: deformation_word(kind.number, k) for k in range(1, kind.deformations + 1)}
    if name == WITH_WARPING:
        made |= {7: "warping at p, which is not analysed", 8: "warping at q, which is not analysed"}
    return made


def designers_words(deck: Deck, element: int, deformation: int) -> str:
    """Such as "in-plane bending at its clamp"; empty where the deck has errors."""
    told, index = _element(deck, element)
    if told is None or index is None:
        return ""
    kind = element_kinds()[told.data.arrays.element_kind[index] - 1]
    is_one = 1 <= deformation <= kind.deformations
    return deformation_words(told, index, deformation) if is_one else ""


def _element(deck: Deck, number: int) -> tuple[Told | None, int | None]:
    told = deck.told
    return told, None if told is None else told.data.element_index.get(number)


def element_words(deck: Deck, number: int) -> list[str]:
    """What an element is, a line each; of a deck with errors what its statement says."""
    made = deck.index.element(number)
    if made is None or made.element is None:
        return [f"There is no element {number}."]
    head = f"**element {number}**: {made.name}"
    told, index = _element(deck, number)
    if told is None or index is None:
        return [f"{head}, {made.comment}" if made.comment else head]
    part = told.parts.of_element(index)
    nodes = told.data.arrays.element_node[:, index].tolist()
    numbers = told.data.arrays.node_number
    slots = [
        f"{slot} {numbers[node - 1]}"
        for slot, node in zip(("p", "op", "q", "oq"), nodes, strict=True)
        if node
    ]
    length = float(told.data.frames.length[index])
    lines = [
        f"{head}, {part.kind} *{part.name}*" if part.is_named else f"{head}, {part.kind}",
        f"nodes {', '.join(slots)}" + (f"; length {length_in_words(length)}" if length else ""),
    ]
    classes = told.data.arrays.deformation_class[:, index].tolist()
    for wanted, word in (
        (Class.FIXED, "held"),
        (Class.DEPENDENT, "released"),
        (Class.INDEPENDENT, "independent"),
    ):
        mine = [k for k, own in enumerate(classes, start=1) if own == wanted]
        words = [f"{k} {deformation_words(told, index, k)}" for k in mine]
        if len(mine) == made.element.deformations:
            words = ["all deformations"]
        if words:
            lines.append(f"{word}: {', '.join(words)}")
    return lines


def node_lines(deck: Deck, number: int) -> list[str]:
    """What a node is, a line each; of a deck with errors what its statements say."""
    kind = deck.index.kinds.get(number)
    if kind is None:
        return [f"**node {number}**: no element names it."]
    lines = [f"**node {number}**: {kind_words(kind)}"]
    told, on = deck.told, deck.index.elements_on(number)
    part_of = dict.fromkeys(on[:8], "")
    if told is not None:
        place, known = told.data.node_index.get(number), told.data.element_index
        if place is not None:
            lines[0] += f", {node_words(told.parts, place)}"
            lines += [_value(told, place), _classes_of_node(told, place)]
        for one in part_of.keys() & known.keys():
            part_of[one] = f" ({part_words(told.parts.of_element(known[one]))})"
    if on:
        named = ", ".join(f"{one}{part}" for one, part in part_of.items())
        more = f" and {len(on) - 8} more" if len(on) > 8 else ""
        lines.append(f"element{'s' * (len(on) > 1)} {named}{more}")
    return lines


def _value(told: Told, place: int) -> str:
    """Where a node stands."""
    arrays = told.data.arrays
    kind = int(arrays.node_kind[place])
    value = arrays.node_value[:, place]
    numbers = ", ".join(f"{each:.6g}" for each in value.tolist()[: _NUMBERS.get(NodeKind(kind), 4)])
    if kind in _NUMBERS:
        return f"at ({numbers}) m"
    at = told.parts.place_of(place)
    where = "" if at is None else f", at node {arrays.node_number[at]}"
    if kind == NodeKind.ANGLE:
        return f"turned by {value[0]:.6g} rad{where}"
    is_plain = bool(np.array_equal(value, [1.0, 0.0, 0.0, 0.0]))
    return f"{'not turned' if is_plain else f'Euler parameters ({numbers})'}{where}"


def _classes_of_node(told: Told, place: int) -> str:
    arrays = told.data.arrays
    kind = int(arrays.node_kind[place])
    by_class: dict[str, list[str]] = {}
    for axis in AXES[kind]:
        word = _CLASSES.get(Class(int(arrays.coordinate_class[axis, place])))
        if word is not None:
            by_class.setdefault(word, []).append(coordinate_name(kind, axis))
    return "; ".join(f"{', '.join(names)} {word}" for word, names in by_class.items())
