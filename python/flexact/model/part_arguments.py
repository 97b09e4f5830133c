# SPDX-License-Identifier: BSD-3-Clause
"""What stands for a part: a handle, a name, an element's number; and its elements."""

from __future__ import annotations

import itertools

from ..core.elements import Class, Member, member_table
from ..deck.errors import model_error
from ..util.plain_text import in_short
from .arguments import whole
from .draft import NO_VECTOR, Draft
from .handles import Assembly, Body, Element, FoldedSheet, Node, Notch, Part, Sheet, Wire
from .names import ambiguous, unknown
from .selection import in_order, is_rigid, require_own, whole_point
from .words import SIDE_VIEW, WIDE_Y, WIDE_Z, Planes

#: A part: its handle, its name, or the number of an element.
PartLike = Part | Element | str | int


def element_index(draft: Draft, target: object) -> int:
    """Index of an element by its handle or its number."""
    if isinstance(target, Element):
        require_own(draft, target, "element")
        return draft.index_of(target.number)
    return draft.index_of(whole(target, "an element is given by its handle or its number"))


def part(draft: Draft, target: object) -> Part | Element:
    """The part that is meant.

    Raises:
        ModelError: there is no such part in this model, or it is none.
    """
    if isinstance(target, Part):
        require_own(draft, target, "part")
        return target
    if isinstance(target, (FoldedSheet, Assembly)):
        raise model_error(
            "several-parts",
            f"{in_short(target)} is several parts",
            "give one of them, such as leaves[0] of a folded sheet or parts of an assembly",
        )
    if isinstance(target, Node):
        raise model_error("not-an-element", "a point has coordinates, not deformations")
    if isinstance(target, str):
        return named(draft, target)
    return Element(draft.numbers[element_index(draft, target)], draft.owner)


def named(draft: Draft, name: str) -> Part | Element:
    """The part with this name, or the single element with it.

    Raises:
        ModelError: there is none, or there are several.
    """
    indices = draft.part_indices(name)
    if not indices:
        single = [i for i, each in draft.names.items() if each == name]
        if len(single) == 1:
            return of_indices(draft, single)
        if name in draft.points_by_name:
            raise model_error(
                "not-an-element",
                f"{in_short(name)} is a point and has no deformations",
                "name a part",
            )
        raise unknown("no-such-part", "part", name, draft.parts_by_name)
    made = of_indices(draft, indices)
    if draft.shares(indices) or (isinstance(made, Element) and len(indices) > 1):
        raise ambiguous("part", name)
    return made


def of_indices(draft: Draft, indices: list[int]) -> Part | Element:
    """The part that these elements are; the first of them alone where they are none."""
    # A single link of which something is released is the flexure that it looks like.
    are_links = len(indices) > 1 and all(i in draft.rigid for i in indices)
    is_body = are_links or all(is_rigid(draft, i) for i in indices)
    indices = in_order(draft, indices) if is_body else indices
    elements = tuple(Element(draft.numbers[i], draft.owner) for i in indices)
    first = draft.slots[indices[0]]
    if is_body:
        return Body(elements, _points(draft, indices))
    if int(member_table()[draft.kinds[indices[0]]]) == Member.HINGE:
        at = draft.position_of.get(first[1], 0)
        nodes = Node(at, first[1], draft.owner), Node(at, first[3], draft.owner)
        return Notch(elements, nodes) if len(indices) == 1 else elements[0]
    released = sum(value > Class.FIXED for value in draft.classes[indices[0]])
    if not is_chain(draft, indices) or not released:
        return elements[0]
    held = draft.deformations_of(indices[0]) - released
    made = Sheet if held > 1 or draft.planar else Wire
    return made(elements, _points(draft, indices))


def _points(draft: Draft, indices: list[int]) -> tuple[Node, ...]:
    """The points of elements, each once, in their order."""
    found: dict[int, Node] = {}
    for index in indices:
        p, op, q, oq = draft.slots[index]
        found.setdefault(p, Node(p, op, draft.owner))
        if q not in found:
            # An RBEAM of a deck carries no orientation at q.
            found[q] = Node(q, oq, draft.owner) if oq else whole_point(draft, q)
    return tuple(found.values())


def is_chain(draft: Draft, indices: list[int]) -> bool:
    """Whether elements are beams in a row, each going on where the one before ends."""
    if any(int(member_table()[draft.kinds[i]]) != Member.BEAM for i in indices):
        return False
    slots = [draft.slots[i] for i in indices]
    return all(a[2:] == b[:2] for a, b in itertools.pairwise(slots))


def indices_of(draft: Draft, made: Part | Element) -> list[int]:
    """Indices of the elements of a part.

    Raises:
        ModelError: one of them was deleted, or the part has none.
    """
    if not made.elements:
        raise model_error("not-an-element", f"{in_short(made)} has no elements")
    return [element_index(draft, element) for element in made.elements]


def words_for(draft: Draft, made: Part | Element, indices: list[int]) -> str:
    """What messages call a part."""
    return in_short(made.name) if made.name else draft.element_words(indices[0])


def end_positions(draft: Draft, indices: list[int]) -> tuple[int, int]:
    """Position nodes of the two ends of a part."""
    return draft.slots[indices[0]][0], draft.slots[indices[-1]][2]


def planes_of(draft: Draft, made: Part | Element, indices: list[int]) -> Planes | None:
    """Which bending of a part is in its plane; None where it has no plane.

    The width is where more bending is held, else where the section is wider, else where the
    builder puts it.
    """
    if draft.planar:
        return SIDE_VIEW
    first, last = draft.classes[indices[0]], draft.classes[indices[-1]]
    held_xz = (first[2] == Class.FIXED) + (last[3] == Class.FIXED)
    held_xy = (first[4] == Class.FIXED) + (last[5] == Class.FIXED)
    if held_xz != held_xy:
        return WIDE_Z if held_xz > held_xy else WIDE_Y
    shape = draft.appearance.said.get(indices[0], {}).get("shape")
    if shape is not None and shape.y != shape.z:
        return WIDE_Z if shape.z > shape.y else WIDE_Y
    # A round wire has no vector as a rule, a sheet of the builder has one.
    own = draft.vectors[indices[0]] != NO_VECTOR
    return WIDE_Z if own or isinstance(made, Sheet) else None
