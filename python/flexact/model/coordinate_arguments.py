# SPDX-License-Identifier: BSD-3-Clause
"""Coordinates: which of a point are meant, and giving them classes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..core.elements import (
    AXES,
    POSITION_NAMES,
    ROTATION_NAMES,
    Class,
    coordinate_name,
    is_position,
)
from ..deck.errors import model_error
from ..util.plain_text import in_short
from .draft import Draft
from .handles import Assembly, Body, Element, FoldedSheet, Node, Part
from .selection import existing, node_number


def nodes_of(draft: Draft, target: object) -> list[int]:
    """Numbers of the nodes of a point, or the number of a single node.

    Raises:
        ModelError: there is no such point or node.
    """
    if isinstance(target, Assembly):
        raise model_error(
            "several-points", f"{in_short(target)} has several points", "fix(*assembly.ground)"
        )
    if isinstance(target, (Element, Part, FoldedSheet)) and not isinstance(target, Body):
        raise model_error("not-a-node", "an element has deformations, not coordinates")
    if isinstance(target, (Node, Body, str, Iterable)):
        found = existing(draft, target)
        return [found.position, found.orientation]
    return [node_number(draft, target)]


def give_coordinates(
    draft: Draft, targets: Iterable[object], names: Sequence[object], value: Class
) -> None:
    """Give coordinates of points or nodes a class; all where none is named.

    Raises:
        ModelError: something of it is wrong; then nothing has changed.
    """
    nodes = [nodes_of(draft, target) for target in targets]
    if names:
        named = [_coordinate(draft, numbers, name) for numbers in nodes for name in names]
        draft.state_coordinates(named, value)
        draft.named.update(named)
    else:
        every = [(n, k) for numbers in nodes for n in numbers for k in AXES[draft.node_kind[n]]]
        draft.state_coordinates(every, value)
        draft.whole += [(numbers[0], numbers[-1]) for numbers in nodes]


def clear_coordinates(draft: Draft, target: object, names: Sequence[object]) -> None:
    """Take back the classes of coordinates, which are dependent then; all where none is named."""
    numbers = nodes_of(draft, target)
    named = {_coordinate(draft, numbers, name) for name in names}
    every = {(number, k) for number in numbers for k in AXES[draft.node_kind[number]]}
    for place in named or every:
        draft.coordinate_class.pop(place, None)
    draft.named -= named or every
    if not named:
        draft.whole = [both for both in draft.whole if both[0] not in numbers]


def _coordinate(draft: Draft, numbers: Sequence[int], name: object) -> tuple[int, int]:
    for number in numbers:
        kind = draft.node_kind[number]
        known = POSITION_NAMES if is_position(kind) else ROTATION_NAMES
        if isinstance(name, str) and name in known and known.index(name) in AXES[kind]:
            return number, known.index(name)
    has = [
        coordinate_name(draft.node_kind[n], k) for n in numbers for k in AXES[draft.node_kind[n]]
    ]
    raise model_error(
        "component-out-of-range",
        f"{draft.node_words(numbers[0])} has no coordinate {in_short(name)}",
        f"it has {', '.join(has)}",
    )
