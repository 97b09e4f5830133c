# SPDX-License-Identifier: BSD-3-Clause
"""Checks of what a builder's methods are given: points, vectors, names of coordinates."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from operator import index as whole_number

from ..base.plain_text import in_short
from ..core.elements import (
    AXES,
    POSITION_NAMES,
    ROTATION_NAMES,
    Class,
    NodeKind,
    coordinate_name,
    is_position,
)
from ..core.raw import ElementKind
from ..diagnostics.errors import model_error
from .draft import LARGEST, NO_VECTOR, Draft, Vector
from .handles import Element, Node, Sheet

#: As the core's check of a y vector.
_PARALLEL = 1.0e-6
#: What gives three parts and still is no vector.
UNORDERED = (str, bytes, bytearray, set, frozenset, dict)
_BY_NUMBER = "a deformation is given by its number"


def vector(given: Sequence[float], what: str) -> Vector:
    """Three finite numbers.

    Raises:
        ModelError: they are not.
    """
    try:
        if isinstance(given, UNORDERED):
            raise TypeError
        x, y, z = (real(part) for part in given)
    except (TypeError, ValueError, OverflowError):
        raise model_error("bad-number", f"the {what} must be three numbers") from None
    if not (math.isfinite(x) and math.isfinite(y) and math.isfinite(z)):
        raise model_error("bad-number", f"the {what} has a component that is not finite")
    return x, y, z


def real(part: object) -> float:
    """A number, but no text that reads as one."""
    if isinstance(part, (str, bytes, bytearray, complex)):
        raise TypeError
    return float(part)  # type: ignore[arg-type]


def text(given: object, what: str) -> str:
    """A text, such as a name."""
    if not isinstance(given, str):
        raise model_error("bad-name", f"{what} must be text, not {type(given).__name__}")
    return given


def direction(given: Sequence[float], what: str) -> Vector:
    """Three finite numbers that are not all zero."""
    made = vector(given, what)
    if made == NO_VECTOR:
        raise model_error("zero-vector", f"the {what} is zero", "give a vector that is not zero")
    return made


def axis(draft: Draft, given: Sequence[float] | None) -> Vector:
    """The axis of a hinge, which a spatial model needs and a planar one does not take."""
    if draft.planar:
        if given is not None and any(vector(given, "axis")[:2]):
            raise model_error("surplus-vector", "the axis of a planar hinge is z")
        return NO_VECTOR
    if given is None:
        raise model_error("missing-vector", "a hinge needs an axis", "give axis=(x, y, z)")
    return direction(given, "axis")


def require_own(draft: Draft, handle: Node | Element, what: str = "node") -> None:
    """Raise for a handle of another model."""
    if handle.owner is not draft.owner:
        raise model_error("other-model", f"the {what} belongs to another model")


def position(draft: Draft, point: Node | int) -> int:
    """Number of the position node of a point, or the number itself."""
    if isinstance(point, Node):
        require_own(draft, point)
        number = point.position
    else:
        number = _node_number(draft, point)
        if not is_position(draft.node_kind[number]):
            raise model_error(
                "two-kinds-of-node",
                f"node {number} is an orientation and is used as a position",
                "position and orientation of one point are two nodes with two numbers",
            )
    # In a spatial model of a deck, planar elements alone may have used this node so far.
    if draft.node_kind[number] == NodeKind.PLANAR_POSITION and not draft.planar:
        draft.node_kind[number] = NodeKind.POSITION
    return number


def orientation(draft: Draft, point: Node) -> int:
    """Number of the orientation node of a point."""
    if not isinstance(point, Node):
        raise model_error(
            "not-a-point",
            "this element needs points with an orientation",
            "make one with node(x, y, z), or with handle(position, orientation) from numbers",
        )
    require_own(draft, point)
    return point.orientation


def handle(draft: Draft, position_number: int, orientation_number: int) -> Node:
    """The point of two node numbers; a missing orientation is made anew."""
    position_number = position(draft, position_number)
    if whole(orientation_number, "an orientation is given by its number") == 0:
        return Node(position_number, draft.add_orientation(), draft.owner)
    orientation_number = _node_number(draft, orientation_number)
    wanted = NodeKind.ANGLE if draft.planar else NodeKind.ORIENTATION
    if draft.node_kind[orientation_number] != wanted:
        raise model_error(
            "two-kinds-of-node",
            f"node {orientation_number} cannot be used as an orientation here",
            "position and orientation of one point are two nodes with two numbers",
        )
    return Node(position_number, orientation_number, draft.owner)


def whole(given: object, what: str) -> int:
    """A whole number; `what` says of what.

    Raises:
        ModelError: it is none.
    """
    try:
        return whole_number(given)  # type: ignore[arg-type]
    except TypeError:
        raise model_error("bad-number", f"{what}, not {in_short(given)}") from None


def _node_number(draft: Draft, given: object) -> int:
    number = whole(given, "a node is given by its handle or its number")
    if number not in draft.node_kind:
        raise model_error("no-such-node", f"there is no node {in_short(number)}")
    return number


def sheet_normal(draft: Draft, p: Node, q: Node, width: Sequence[float] | None) -> Vector | None:
    """The y vector of a sheet's beams: normal to the sheet, so that z lies in its plane.

    A sheet of no length has none; that is left to the check of the model.
    """
    if draft.planar:
        if width is not None and any(vector(width, "width")[:2]):
            raise model_error("surplus-vector", "the width of a sheet in a planar model is along z")
        return None
    if width is None:
        raise model_error("missing-vector", "a sheet needs the direction of its width")
    wide = direction(width, "width")
    start, end = (draft.node_value[position(draft, point)] for point in (p, q))
    along = _unit((end[0] - start[0], end[1] - start[1], end[2] - start[2]))
    across = _unit(wide)
    normal = (
        across[1] * along[2] - across[2] * along[1],
        across[2] * along[0] - across[0] * along[2],
        across[0] * along[1] - across[1] * along[0],
    )
    if along == NO_VECTOR:
        return wide
    if math.hypot(*normal) <= _PARALLEL:
        raise model_error(
            "parallel-vector",
            "the width of the sheet is parallel to it",
            "give a direction across the sheet, from edge to edge",
        )
    return _unit(normal)


def _unit(given: Vector) -> Vector:
    largest = max(map(abs, given))
    if largest == 0.0:
        return NO_VECTOR
    x, y, z = (part / largest for part in given)
    norm = math.hypot(x, y, z)
    return x / norm, y / norm, z / norm


def between(draft: Draft, p: Node, q: Node, parts: int) -> list[Vector]:
    """Points that divide the way from p to q into equal parts."""
    parts = whole(parts, "the number of beams must be a whole number")
    if not 1 <= parts <= LARGEST:
        raise model_error("out-of-range", f"a sheet cannot be divided into {in_short(parts)} beams")
    start, end = (draft.node_value[position(draft, point)] for point in (p, q))
    made = []
    for i in range(1, parts):
        t = i / parts
        x, y, z = (start[k] * (1.0 - t) + end[k] * t for k in range(3))
        made.append((x, y, z))
    return made


def deformations(kind: ElementKind, given: Iterable[int]) -> tuple[int, ...]:
    """Numbers of deformations that an element of this kind has.

    Raises:
        ModelError: one of them is none.
    """
    try:
        numbers = tuple(given)
    except TypeError:
        raise model_error(
            "bad-number", f"deformations are given as several numbers, not by {in_short(given)}"
        ) from None
    for number in numbers:
        if not 1 <= whole(number, _BY_NUMBER) <= kind.deformations:
            raise model_error(
                "component-out-of-range",
                f"a {kind.keyword} has no deformation {in_short(number)}",
                f"it has 1 to {kind.deformations}",
            )
    return numbers


def means_element(target: object, which: Sequence[str | int]) -> bool:
    """Whether a target is an element; a bare number is one where deformations are numbered."""
    if isinstance(target, Node):
        return False
    if isinstance(target, (Element, Sheet)):
        return True
    if not which:
        raise model_error(
            "ambiguous-number",
            "a number alone can be a node or an element",
            "name coordinates of a node or number deformations of an element",
        )
    return not all(isinstance(item, str) for item in which)


def give_coordinates(
    draft: Draft, target: object, names: Sequence[str | int], value: Class
) -> None:
    """Give coordinates of a point or a node a class; all where none is named."""
    if isinstance(target, Node):
        require_own(draft, target)
        numbers = [target.position, target.orientation]
    elif isinstance(target, (Element, Sheet)):
        raise model_error("not-a-node", "an element has deformations, not coordinates")
    else:
        numbers = [_node_number(draft, target)]
    if not names:
        every = ((number, k) for number in numbers for k in AXES[draft.node_kind[number]])
        draft.state_coordinates(every, value)
        draft.whole.append((numbers[0], numbers[-1]))
    named = [_coordinate(draft, numbers, name) for name in names]
    draft.state_coordinates(named, value)
    draft.named.update(named)


def _coordinate(draft: Draft, numbers: Sequence[int], name: str | int) -> tuple[int, int]:
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
        f"node {numbers[0]} has no coordinate {in_short(name)}",
        f"it has {', '.join(has)}",
    )


def element_index(draft: Draft, target: object) -> int:
    """Index of an element by its handle or its number."""
    if isinstance(target, Element):
        require_own(draft, target, "element")
        return draft.index_of(target.number)
    return draft.index_of(whole(target, "an element is given by its handle or its number"))


def give_deformations(
    draft: Draft, target: object, which: Sequence[str | int], value: Class
) -> None:
    """Give deformations of an element or of each beam of a sheet a class."""
    if isinstance(target, Node):
        raise model_error("not-an-element", "a node has coordinates, not deformations")
    if isinstance(target, Sheet):
        for element in target.elements:
            give_deformations(draft, element, which, value)
        return
    index = element_index(draft, target)
    numbers = [whole(item, _BY_NUMBER) for item in which]
    every = range(1, draft.deformations_of(index) + 1)
    draft.state_deformations(index, numbers or every, value)
