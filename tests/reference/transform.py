# SPDX-License-Identifier: BSD-3-Clause
"""Write a deck turned, moved or in other units, for tests of what must not depend on either.

What stays the same: both counts and, for a turn or a move, the singular values and the projector of
the self-stresses (but for deformations 2 and 3 of a HINGE and those of a PINBODY, whose axes follow
from the global ones). Motions turn with the mechanism. Only the kinematics are changed, so a
dynamics block keeps the numbers of the original.
"""

from __future__ import annotations

import re
from collections.abc import Callable

import numpy as np
from oracle_deck import ELEMENT_TYPES, Deck, Element, kinematic_statements, number, read_deck
from oracle_elements import Real, default_vector

SAME = 1e-12

Change = Callable[[Real], Real]


def turned(text: str, rotation: Real) -> str | None:
    """A deck turned about the origin by a rotation matrix (3 x 3).

    Returns:
        the new text, or None where the deck names a single coordinate that the turn mixes with one
        of another class, a single deformation whose axis would not turn along, or where a planar
        deck would leave its plane.
    """
    deck = read_deck(text)
    if not (_coordinates_survive(deck, rotation) and _deformations_survive(deck)):
        return None
    return _rewritten(text, deck, lambda place: rotation @ place, lambda axis: rotation @ axis)


def moved(text: str, shift: Real) -> str | None:
    """A deck moved by a vector in m, or None where a planar deck would leave its plane."""
    deck = read_deck(text)
    if deck.planar and shift[2] != 0:
        return None
    return _rewritten(text, deck, lambda place: place + shift, lambda axis: axis)


def scaled(text: str, factor: float) -> str:
    """A deck with all lengths multiplied by a factor, such as 1000 for millimetres."""
    return _rewritten(text, read_deck(text), lambda place: factor * place, lambda axis: axis)


def about(axis: str, angle: float) -> Real:
    """Rotation matrix about a global axis x, y or z by an angle in rad."""
    first = "xyz".index(axis)
    i, j = (first + 1) % 3, (first + 2) % 3
    matrix = np.eye(3)
    matrix[i, i] = matrix[j, j] = np.cos(angle)
    matrix[j, i] = np.sin(angle)
    matrix[i, j] = -matrix[j, i]
    return matrix


def _coordinates_survive(deck: Deck, rotation: Real) -> bool:
    if deck.planar:
        out_of_plane = np.abs(rotation[:, 2] - [0.0, 0.0, 1.0])
        if np.max(out_of_plane) > SAME:
            return False
    for node in deck.kinds:
        classes = [deck.coordinates[node, axis] for axis in deck.axes(node)]
        mixed = [
            abs(rotation[i, j]) > SAME and classes[i] != classes[j]
            for i in range(len(classes))
            for j in range(len(classes))
        ]
        if any(mixed) and len(classes) > 1:
            return False
    return True


def _deformations_survive(deck: Deck) -> bool:
    for label, element in deck.elements.items():
        for together in element.type.free_axes:
            if len({deck.deformations[label, deformation] for deformation in together}) > 1:
                return False
    return True


def _rewritten(text: str, deck: Deck, place: Change, axis: Change) -> str:
    lines = text.splitlines()
    written = set()
    last = 0
    for index, (keyword, *operands) in kinematic_statements(text):
        last = index
        if keyword == "X":
            node = int(operands[0])
            written.add(node)
            statement = _position(deck, node, place)
        elif keyword in ELEMENT_TYPES and ELEMENT_TYPES[keyword].vector:
            element = deck.elements[int(operands[0])]
            head = [keyword, *operands[: 1 + len(element.nodes)]]
            statement = " ".join([*head, *_words(axis(_vector(deck, element)))])
        else:
            continue
        comment = re.search("[%#].*", lines[index])
        lines[index] = f"{statement}  {comment.group()}" if comment else statement
    unset = [node for node in deck.position if node not in written]
    lines[last + 1 : last + 1] = [_position(deck, node, place) for node in unset]
    return "\n".join(lines) + "\n"


def _position(deck: Deck, node: int, place: Change) -> str:
    values = place(np.array(deck.position[node]))[: 2 if deck.planar else 3]
    return " ".join(["X", str(node), *_words(values)])


def _vector(deck: Deck, element: Element) -> Real:
    if element.vector:
        return np.array([number(str(value)) for value in element.vector])
    start, end = (deck.position[element.nodes[slot]] for slot in (0, 2))
    return default_vector(np.subtract(end, start))


def _words(values: Real) -> list[str]:
    return [repr(float(value)) for value in values]
