# SPDX-License-Identifier: BSD-3-Clause
"""What is said of the coordinates of points: their classes, and the loads along them."""

from __future__ import annotations

from collections.abc import Sequence

from ..core.elements import (
    AXES,
    Class,
    NodeKind,
    coordinate_name,
    is_position,
)
from ..deck.rendering import model_error
from ..util.quantities import Quantity
from ..util.text import in_short
from .arguments import several, vector
from .draft import Draft, Vector
from .names import is_coordinate, nearest
from .selection import Point, nodes_of


def fixed_targets(draft: Draft, given: Sequence[object]) -> tuple[list[object], list[object]]:
    """What is to be fixed: points or nodes, and names of coordinates.

    Raises:
        ModelError: there is no point, or a text is neither.
    """
    names = [each for each in given if is_coordinate(each)]
    targets = [each for each in given if not is_coordinate(each)]
    if not targets:
        raise model_error("not-a-node", "fix needs a point", 'such as fix("clamp 1", "x")')
    points, parts = draft.points_by_name, draft.parts_by_name
    for each in targets[1:]:
        if isinstance(each, str) and each not in points and each not in parts:
            near = nearest(each, [*points, *parts])
            hint = f"did you mean {' or '.join(map(in_short, near))}?" if near else ""
            raise model_error(
                "component-out-of-range",
                f"there is no coordinate or point {in_short(each)}",
                hint or "coordinates are x, y, z, rx, ry, rz",
            )
    return targets, names


def give_coordinates(
    draft: Draft, targets: Sequence[object], names: Sequence[object], value: Class
) -> None:
    """Give coordinates of points or nodes a class; all where none is named.

    Raises:
        ModelError: something of it is wrong; then nothing has changed.
    """
    nodes = [nodes_of(draft, target) for target in targets]
    places = [place for numbers in nodes for place in _places(draft, numbers, names)]
    draft.state_coordinates(places, value)
    if names:
        draft.named.update(places)
    else:
        draft.whole += [(numbers[0], numbers[-1]) for numbers in nodes]


def clear_coordinates(draft: Draft, target: object, names: Sequence[object]) -> None:
    """Take back the classes of coordinates, which are dependent then; all where none is named."""
    numbers = nodes_of(draft, target)
    places = _places(draft, numbers, names)
    for place in places:
        draft.coordinate_class.pop(place, None)
    draft.named.difference_update(places)
    if not names:
        draft.whole = [both for both in draft.whole if both[0] not in numbers]


def _places(draft: Draft, numbers: Sequence[int], names: Sequence[object]) -> list[tuple[int, int]]:
    """Nodes and axes of the coordinates of these names, of all where none is named."""
    every = {
        coordinate_name(draft.node_kind[n], k): (n, k)
        for n in numbers
        for k in AXES[draft.node_kind[n]]
    }
    if not names:
        return list(every.values())
    found = []
    for name in names:
        if not (isinstance(name, str) and name in every):
            raise model_error(
                "component-out-of-range",
                f"{draft.node_words(numbers[0])} has no coordinate {in_short(name)}",
                f"it has {', '.join(every)}",
            )
        found.append(every[name])
    return found


def node_with(draft: Draft, point: Point | int, wants_position: bool) -> int:
    """The node of a point that bears forces, its position, or moments, its orientation.

    Raises:
        ModelError: there is no such point, or the node of this number is of the other kind.
    """
    numbers = nodes_of(draft, point)
    for number in numbers:
        if is_position(draft.node_kind[number]) == wants_position:
            return number
    raise model_error(
        "two-kinds-of-node",
        f"node {numbers[0]} is {'an orientation' if wants_position else 'a position'}",
        "a position has a force, an orientation a moment",
    )


def load(
    draft: Draft,
    x: Quantity | Sequence[Quantity],
    y: Quantity | None,
    z: Quantity | None,
    what: str,
    unit: str,
) -> Vector:
    """Three numbers; the last may be missing, and in a plane must be nothing."""
    given: tuple[object, ...] = (x, y, 0.0 if z is None else z)
    if y is None and z is None:
        given = several(x, f"the components of a {what}") or given
    if len(given) == 2:
        given = (*given, 0.0)
    made = vector(given, what, unit)  # type: ignore[arg-type]
    if draft.planar and made[2]:
        raise model_error("bad-number", f"the {what} has a z component in a planar model")
    return made


def moment(
    draft: Draft,
    node: int,
    x: Quantity | Sequence[Quantity],
    y: Quantity | None,
    z: Quantity | None,
) -> Vector:
    """As `load`; at a planar orientation one number, the moment about z."""
    if draft.node_kind[node] != NodeKind.ANGLE:
        return load(draft, x, y, z, "moment", "N m")
    given = (x, y, z) if y is not None or z is not None else (0.0, 0.0, x)
    if any(given[:2]):
        raise model_error("bad-number", "a planar moment is one number, that about z")
    return vector((0.0, 0.0, given[2]), "moment", "N m")  # type: ignore[arg-type]
