# SPDX-License-Identifier: BSD-3-Clause
"""What stands for a point: a handle, a name, a place, a body; and its nodes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..core.elements import Class, Member, NodeKind, is_position, member_table
from ..deck.errors import model_error
from ..util.plain_text import in_short
from ..util.quantities import Quantity
from .arguments import UNORDERED, several, text, vector, whole
from .draft import Draft
from .handles import Body, Element, Node, Part
from .names import COORDINATES, ambiguous, own_number, unknown
from .places import one_line

#: A point: its handle, its name, its place [m], or a body, which stands for its first point.
Point = Node | Body | str | Sequence[Quantity]


def require_own(draft: Draft, handle: Node | Element | Part, what: str = "node") -> None:
    """Raise for a handle of another model."""
    owned = handle if isinstance(handle, (Node, Element)) else handle.nodes[0]
    if owned.owner is not draft.owner:
        raise model_error("other-model", f"the {what} belongs to another model")


def listed(draft: Draft, given: object, what: str) -> list[Node]:
    """The points of a list, tuple or array of them.

    Raises:
        ModelError: it is none, or one of them is no point.
    """
    return [point(draft, each) for each in several(given, what)]


def point(draft: Draft, given: object) -> Node:
    """The point that is meant; a place where no point is gets one.

    Raises:
        ModelError: it is no point of this model, or no place.
    """
    if isinstance(given, Node):
        return _known(draft, given)
    if isinstance(given, Body):
        return _known(draft, given.nodes[0])
    if isinstance(given, str):
        return named(draft, given)
    if isinstance(given, UNORDERED) or not isinstance(given, Iterable):
        raise model_error(
            "not-a-point",
            f"a point is wanted, not {in_short(given)}",
            "make one with node(x, y, z), give its name or its place (x, y, z), or make one "
            "with handle(position, orientation) from numbers",
        )
    return at_place(draft, given)


def _known(draft: Draft, given: Node) -> Node:
    require_own(draft, given)
    if given.position not in draft.node_value:
        raise model_error("no-such-node", "the point was deleted")
    return given


def named(draft: Draft, name: str) -> Node:
    """The point with this name, or the first point of the body with it.

    Raises:
        ModelError: there is none, or there are several.
    """
    found = draft.points_by_name.get(name, [])
    if len(found) > 1:
        raise ambiguous("point", name)
    if found:
        return whole_point(draft, found[0])
    indices = draft.part_indices(name)
    if indices and all(is_rigid(draft, index) for index in indices):
        p, op, _, _ = draft.slots[in_order(draft, indices)[0]]
        return Node(p, op, draft.owner)
    if indices:
        raise model_error(
            "not-a-node",
            f"{in_short(name)} is a part and has no coordinates",
            "name a point, such as one of its ends",
        )
    raise unknown("no-such-point", "point", name, [*draft.points_by_name, *_bodies(draft)])


def _bodies(draft: Draft) -> list[str]:
    """Names of the bodies, which stand for their first points."""
    return [name for name, found in draft.parts_by_name.items() if is_rigid(draft, found[0])]


def is_rigid(draft: Draft, index: int) -> bool:
    """Whether an element is a rigid link: a beam or link that holds everything."""
    if int(member_table()[draft.kinds[index]]) not in (Member.BEAM, Member.LINK):
        return False
    return all(value in (Class.NONE, Class.FIXED) for value in draft.classes[index])


def in_order(draft: Draft, indices: Iterable[int]) -> list[int]:
    """Indices of the links of a body by the numbers in their names: the first point first."""
    return sorted(indices, key=lambda index: (own_number(draft.names.get(index, "")), index))


def at_place(draft: Draft, given: Iterable[Quantity]) -> Node:
    """The first point at this place, within 1e-9 of the model's size, or a new one.

    Raises:
        ModelError: it is no place in this model.
    """
    value = place(draft, given)
    found = draft.nodes_at(value)
    return whole_point(draft, found[0]) if found else add_point(draft, value)


def place(draft: Draft, given: Iterable[Quantity]) -> tuple[float, float, float, float]:
    """The values of a position node at a place of three numbers, or of two where z is zero.

    Raises:
        ModelError: they are none.
    """
    parts = given
    if not isinstance(given, UNORDERED) and isinstance(given, Iterable):
        try:
            parts = tuple(given)
        except TypeError:
            parts = ()
        if len(parts) == 2:
            parts = (*parts, 0.0)
    x, y, z = vector(parts, "position", "m")  # type: ignore[arg-type]
    if draft.planar and z != 0.0:
        raise model_error("no-coordinate", "a planar model has no coordinate z")
    return x, y, z, 0.0


def existing(draft: Draft, given: object) -> Node:
    """The point that is meant, which must be there.

    Raises:
        ModelError: it is not.
    """
    if isinstance(given, (Node, Body, str)) or not isinstance(given, Iterable):
        return point(draft, given)
    value = place(draft, given)
    if not draft.nodes_at(value):
        raise model_error("no-such-point", f"there is no point at {in_short(given)}")
    return at_place(draft, value[:3])


def add_point(draft: Draft, value: tuple[float, float, float, float]) -> Node:
    """A new point."""
    kind = NodeKind.PLANAR_POSITION if draft.planar else NodeKind.POSITION
    position = draft.add_node(kind, value)
    orientation = draft.add_orientation()
    draft.join(position, orientation)
    return Node(position, orientation, draft.owner)


def whole_point(draft: Draft, position: int) -> Node:
    """The point of a position node; a missing orientation is made."""
    if position not in draft.orientation_at:
        draft.join(position, draft.add_orientation())
    return Node(position, draft.orientation_at[position], draft.owner)


def checked_name(name: str) -> str:
    """The name of a point as a deck can hold it.

    Raises:
        ModelError: it is no text, or the name of a coordinate.
    """
    made = one_line(text(name, "the name of a point"))
    if made in COORDINATES:
        raise model_error(
            "bad-name", f"a point cannot be named {in_short(made)}, as a coordinate is"
        )
    return made


def position(draft: Draft, given: object) -> int:
    """Number of the position node of a point, or the number itself."""
    if _is_number(given):
        number = node_number(draft, given)
        if not is_position(draft.node_kind[number]):
            raise model_error(
                "two-kinds-of-node",
                f"node {number} is an orientation and is used as a position",
                "position and orientation of one point are two nodes with two numbers",
            )
    else:
        number = point(draft, given).position
    # In a spatial model of a deck, planar elements alone may have used this node so far.
    if draft.node_kind[number] == NodeKind.PLANAR_POSITION and not draft.planar:
        draft.node_kind[number] = NodeKind.POSITION
    return number


def _is_number(given: object) -> bool:
    return not isinstance(given, (Node, Body, str)) and not isinstance(given, Iterable)


def handle(draft: Draft, position_number: int, orientation_number: int) -> Node:
    """The point of two node numbers; a missing orientation is made anew."""
    position_number = position(draft, position_number)
    if whole(orientation_number, "an orientation is given by its number") == 0:
        return pivot(draft, position_number)
    orientation_number = node_number(draft, orientation_number)
    wanted = NodeKind.ANGLE if draft.planar else NodeKind.ORIENTATION
    if draft.node_kind[orientation_number] != wanted:
        raise model_error(
            "two-kinds-of-node",
            f"node {orientation_number} cannot be used as an orientation here",
            "position and orientation of one point are two nodes with two numbers",
        )
    draft.join(position_number, orientation_number)
    return Node(position_number, orientation_number, draft.owner)


def pivot(draft: Draft, position_number: int) -> Node:
    """Another point at a position node, with an orientation of its own."""
    orientation = draft.add_orientation()
    draft.join(position_number, orientation)
    return Node(position_number, orientation, draft.owner)


def node_number(draft: Draft, given: object) -> int:
    """Number of a node that there is.

    Raises:
        ModelError: there is none of this number.
    """
    number = whole(given, "a node is given by its handle or its number")
    if number not in draft.node_kind:
        raise model_error("no-such-node", f"there is no node {in_short(number)}")
    return number
