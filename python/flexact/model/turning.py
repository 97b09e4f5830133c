# SPDX-License-Identifier: BSD-3-Clause
"""What turns with parts: vectors of elements, and classes along axes, or cannot."""

from __future__ import annotations

import math
from collections.abc import Iterable

from ..core.elements import AXES, Class, Role, element_kinds
from ..core.elements import Vector as StatedVector
from ..deck.errors import model_error
from .arguments import cross, unit
from .draft import NO_VECTOR, Draft, Vector
from .model_places import ROUNDING
from .selection import is_rigid
from .transform import Transform


def vector(source: Draft, index: int, move: Transform) -> Vector:
    """The vector of an element's image; one that had none gets the image of its default."""
    given = source.vectors[index]
    kind = element_kinds()[source.kinds[index] - 1]
    optional = kind.vector == StatedVector.OPTIONAL
    if given == NO_VECTOR and optional and not source.planar and not is_rigid(source, index):
        p, _, q, _ = source.slots[index]
        a, b = source.node_value[p], source.node_value[q]
        given = _default((b[0] - a[0], b[1] - a[1], b[2] - a[2]))
    return given if given == NO_VECTOR else move.turned(given)


def _default(along: Vector) -> Vector:
    """The global axis along which a direction is smallest, from which a frame is made."""
    parts = unit(along)
    least = min(range(3), key=lambda k: abs(parts[k]))
    x, y, z = (float(k == least) for k in range(3))
    return x, y, z


#: What an element with an axis does across it, in a frame that no statement gives.
_ACROSS = ((Role.TILT_Y, Role.TILT_Z), (Role.OFFSET_Y, Role.OFFSET_Z))


def check_axes(source: Draft, indices: Iterable[int], move: Transform) -> None:
    """Raise where a joint does different things across its axis, which do not turn with it."""
    for index in indices:
        kind = element_kinds()[source.kinds[index] - 1]
        if kind.vector != StatedVector.REQUIRED:
            continue
        classes = dict(zip(kind.role, source.classes[index], strict=True))
        axis = source.vectors[index]
        alike = all(classes.get(a) == classes.get(b) for a, b in _ACROSS)
        if alike or _along(move.turned(_default(axis)), _default(move.turned(axis))):
            continue
        raise model_error(
            "turned-class",
            f"{source.element_words(index)} has classes across its axis that would not turn",
            "copy first and give the classes afterwards",
        )


def _along(a: Vector, b: Vector) -> bool:
    return math.hypot(*cross(unit(a), unit(b))) <= ROUNDING


def check_classes(
    source: Draft, nodes: Iterable[int], move: Transform, shared: bool = False
) -> None:
    """Raise where coordinates that were given a class are not along the axes after a move.

    Where nodes that stay at their places are `shared`, these keep their classes as they are.
    """
    for number in nodes:
        for value, axes in axes_of(source, number).items():
            if move.axes(axes) is None:
                here = _place(source, number)
                stays = math.dist(move.place(here), here) <= ROUNDING * math.hypot(*here)
                if not (shared and stays):
                    raise model_error(
                        "turned-class",
                        f"{source.node_words(number)} has {value.name.lower()} coordinates that "
                        "are not along x, y or z any more",
                        "copy first and give the class afterwards",
                    )


def _place(source: Draft, number: int) -> Vector:
    position = source.position_of.get(number, number)
    x, y, z = source.node_value[position][:3]
    return x, y, z


def axes_of(source: Draft, number: int) -> dict[Class, set[int]]:
    """Axes of a node by the classes that they were given."""
    found: dict[Class, set[int]] = {}
    axes = AXES[source.node_kind[number]]
    for axis in axes:
        value = source.coordinate_class.get((number, axis))
        if value is not None:
            found.setdefault(Class(value), set()).add(axis)
    return found
