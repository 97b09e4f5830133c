# SPDX-License-Identifier: BSD-3-Clause
"""Nodes, elements, coordinates and deformations in an editor's words."""

from __future__ import annotations

import numpy as np

from ...analysis.deformation_words import deformation_word, deformation_words
from ...analysis.naming import length_in_words
from ...analysis.places import node_words, part_words
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
    kind = told.data.arrays.element_kind[index]
    many = element_kinds()[kind - 1].deformations
    return deformation_words(told, index, deformation) if 1 <= deformation <= many else ""


def _element(deck: Deck, number: int) -> tuple[Told | None, int | None]:
    told = deck.told
    return told, None if told is None else told.data.element_index.get(number)


def part_of_element(deck: Deck, number: int) -> str:
    """The name of the part that an element belongs to; empty where the deck has errors."""
    told, index = _element(deck, number)
    if told is None or index is None:
        return ""
    return part_words(told.parts.of_element(index))


def element_words(deck: Deck, number: int) -> list[str]:
    """What an element is, a line each; of a deck with errors what its statement says."""
    made = deck.index.element(number)
    if made is None:
        return [f"There is no element {number}."]
    assert made.element is not None
    head, comment = f"**element {number}**: {made.name}", made.comment
    told, index = _element(deck, number)
    if told is None or index is None:
        return [f"{head}{f', {comment}' if comment else ''}"]
    part = told.parts.of_element(index)
    lines = [f"{head}, {part.kind} *{part.name}*" if part.is_named else f"{head}, {part.kind}"]
    nodes = told.data.arrays.element_node[:, index]
    numbers = told.data.arrays.node_number
    slots = [
        f"{slot} {numbers[node - 1]}"
        for slot, node in zip(("p", "op", "q", "oq"), nodes.tolist(), strict=True)
        if node
    ]
    length = float(told.data.frames.length[index])
    lines.append(
        f"nodes {', '.join(slots)}" + (f"; length {length_in_words(length)}" if length else "")
    )
    return [*lines, *_classes_of_element(told, index, made.element)]


def _classes_of_element(told: Told, index: int, kind: ElementKind) -> list[str]:
    classes = told.data.arrays.deformation_class[:, index].tolist()
    lines = []
    for wanted, word in (
        (Class.FIXED, "held"),
        (Class.DEPENDENT, "released"),
        (Class.INDEPENDENT, "independent"),
    ):
        mine = [k for k in range(1, kind.deformations + 1) if classes[k - 1] == wanted]
        if len(mine) == kind.deformations:
            lines.append(f"{word}: all deformations")
        elif mine:
            words = [f"{k} {deformation_words(told, index, k)}" for k in mine]
            lines.append(f"{word}: {', '.join(words)}")
    return lines


def node_lines(deck: Deck, number: int) -> list[str]:
    """What a node is, a line each; of a deck with errors what its statements say."""
    index = deck.index
    kind = index.kinds.get(number)
    if kind is None:
        return [f"**node {number}**: no element names it."]
    lines = [f"**node {number}**: {kind_words(kind)}"]
    told = deck.told
    if told is not None and number in told.data.node_index:
        place = told.data.node_index[number]
        lines[0] += f", {node_words(told.parts, place)}"
        lines += [_value(told, place), _classes_of_node(told, place)]
    on = index.elements_on(number)
    named = [f"{one}{_name(part_of_element(deck, one))}" for one in on[:8]]
    more = f" and {len(on) - 8} more" if len(on) > 8 else ""
    if named:
        lines.append(f"element{'s' * (len(on) > 1)} {', '.join(named)}{more}")
    return lines


def _name(words: str) -> str:
    return f" ({words})" if words else ""


def _value(told: Told, place: int) -> str:
    """Where a node stands."""
    arrays = told.data.arrays
    kind = int(arrays.node_kind[place])
    value = arrays.node_value[:, place]
    if kind == NodeKind.POSITION:
        return f"at ({_coordinates(value[:3])}) m"
    if kind == NodeKind.PLANAR_POSITION:
        return f"at ({_coordinates(value[:2])}) m"
    at = told.parts.place_of(place)
    where = "" if at is None else f", at node {arrays.node_number[at]}"
    if kind == NodeKind.ANGLE:
        return f"turned by {value[0]:.6g} rad{where}"
    is_plain = bool(np.array_equal(value, [1.0, 0.0, 0.0, 0.0]))
    turned = "not turned" if is_plain else f"Euler parameters ({_coordinates(value)})"
    return f"{turned}{where}"


def _coordinates(values: np.ndarray) -> str:
    return ", ".join(f"{value:.6g}" for value in values.tolist())


def _classes_of_node(told: Told, place: int) -> str:
    arrays = told.data.arrays
    kind = int(arrays.node_kind[place])
    by_class: dict[str, list[str]] = {}
    for axis in AXES[kind]:
        word = _CLASSES.get(Class(int(arrays.coordinate_class[axis, place])))
        if word is not None:
            by_class.setdefault(word, []).append(coordinate_name(kind, axis))
    return "; ".join(f"{', '.join(names)} {word}" for word, names in by_class.items())
