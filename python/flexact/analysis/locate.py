# SPDX-License-Identifier: BSD-3-Clause
"""Parts, points and elements as users point at them: the one place where all forms are read.

A number, a name, a place, or what a model handed out; a body stands for its first point.
"""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray, IntArray
from ..core.elements import Class, NodeKind, element_kinds
from ..deck.rendering import model_error
from ..model.names import ambiguous, unknown
from ..model.parts.parts import Part, PartKind, Parts
from ..model.transform import Place
from ..util.loading import load
from ..util.quantities import without_units
from ..util.text import in_short
from .limits import SAME_PLACE

#: How many numbers of nodes or elements a message names.
_MOST = 12


def part_of(parts: Parts, target: object) -> Part:
    """The part that is meant.

    Args:
        parts: Those of the model.
        target: Its name, the part itself, a handle with `elements` or a `number`, or the number
            of one of its elements.

    Raises:
        ModelError: there is none, or there are several.
        TypeError: it is nothing of that.
    """
    if isinstance(target, Part):
        return parts.of_element(target.elements[0])
    if isinstance(target, str):
        return parts.named(target)
    elements = getattr(target, "elements", (target,))
    if not elements and hasattr(target, "nodes"):
        # A body that has no members of its own: what carries its point.
        body = parts.body_at.get(position_of(parts, target))
        if body is None:
            raise model_error(
                "no-such-part", "this body is a single point; ask for what the point does"
            )
        return parts.of_body(body)
    what = "a part is given by its name, the number of an element"
    numbers = (_whole(getattr(element, "number", element)) for element in elements)
    indices = [_element(parts, number, target, what) for number in numbers]
    found = dict.fromkeys(map(parts.of_element, indices))
    if len(found) > 1:
        raise model_error(
            "ambiguous-part",
            f"{len(found)} parts are meant: {', '.join(part.name for part in found)}",
            "ask for one of them",
        )
    return next(iter(found))


def _element(parts: Parts, number: int | None, target: object, what: str) -> int:
    """Index of the element with a number that was given by a target."""
    if number is None:
        raise TypeError(f"{what} or what the model handed out, not by {in_short(target)}")
    return _known("element", number, parts.data.element_index, parts.data.arrays.element_number)


def _known(what: str, number: int, index_of: dict[int, int], there: IntArray) -> int:
    """Index of the node or element with a number."""
    if number not in index_of:
        raise model_error(
            f"no-such-{what}",
            f"there is no {what} {in_short(number)}",
            f"there are {numbers_listed(there)}",
        )
    return index_of[number]


def _whole(given: object) -> int | None:
    """A whole number; None of anything else."""
    if isinstance(given, (int, np.integer)) and not isinstance(given, bool):
        return int(given)
    return None


def numbers_listed(numbers: IntArray) -> str:
    """The first of some numbers in ascending order, such as "1, 2, 3, ..."."""
    shown = ", ".join(map(str, sorted(numbers.tolist())[:_MOST]))
    return f"{shown}, ..." if numbers.size > _MOST else shown


def node_of(parts: Parts, target: object) -> int:
    """Index of the node that is meant: of any kind by its number, else that of a point.

    Raises:
        ModelError: there is none, or there are several.
        TypeError: it is nothing of that.
    """
    number = _whole(target)
    if number is None:
        return position_of(parts, target)
    return _known("node", number, parts.data.node_index, parts.data.arrays.node_number)


def position_of(parts: Parts, target: object) -> int:
    """Index of the position node of the point that is meant.

    Args:
        parts: Those of the model.
        target: Its name, that of a body, which stands for its first point, the number of its
            position node, its place [m], or a handle with `position`, or with `nodes`, of which
            the first is meant.

    Raises:
        ModelError: there is none, or there are several.
        TypeError: it is nothing of that.
    """
    data = parts.data
    if isinstance(target, str):
        return _named(parts, target)
    if isinstance(target, Part):
        return _first(parts, target)
    nodes = getattr(target, "nodes", None)
    handle = nodes[0] if nodes else target
    if isinstance(target, (tuple, list, np.ndarray)):
        taken = (
            target if isinstance(target, Place) else without_units(target, data.units.symbol("m"))
        )
        given = np.asarray(taken, np.float64)
        if given.shape not in ((2,), (3,)) or not np.isfinite(given).all():
            raise TypeError(f"a place has three finite coordinates [m], not {in_short(target)}")
        # Within rounding of the size of the model.
        found = positions_near(parts, np.pad(given, (0, 3 - given.size)), SAME_PLACE)
        if not found.size:
            raise model_error("no-such-point", f"there is no point at {in_short(target)}")
        return int(found[int(np.argmin(data.arrays.node_number[found]))])
    number = _whole(getattr(handle, "position", handle))
    if number is None:
        raise TypeError(
            f"a point is given by its name, its number, its place or what the model handed out, "
            f"not by {in_short(target)}"
        )
    index = data.node_index.get(number)
    if index is None or data.arrays.node_kind[index] > NodeKind.POSITION:
        raise model_error("no-such-node", f"no element uses a position node {number}")
    return index


def _named(parts: Parts, name: str) -> int:
    """The point of this name, else the first point of the body."""
    kinds = parts.data.arrays.node_kind
    positions = np.flatnonzero(kinds <= NodeKind.POSITION).tolist()
    names = {node: own for node in positions if (own := parts.name_of_point(node))}
    found = [node for node, own in names.items() if own == name]
    if len(found) > 1:
        raise ambiguous("point", name)
    if found:
        return found[0]
    of_name = [part for part in parts.all if part.name == name]
    bodies = [part for part in of_name if part.kind is PartKind.BODY]
    if len(bodies) > 1:
        raise ambiguous("body", name)
    if of_name:
        return _first(parts, (bodies or of_name)[0])
    known = [part.name for part in parts.all if part.kind is PartKind.BODY]
    raise unknown("no-such-point", "point", name, [*names.values(), *known])


def _first(parts: Parts, part: Part) -> int:
    """The first point of a body."""
    if part.kind is not PartKind.BODY:
        raise model_error(
            "not-a-node",
            f"{in_short(part.name)} is a {part.kind} and no point",
            "name a point, such as one of its ends",
        )
    return int(parts.data.arrays.element_node[0, part.elements[0]]) - 1


def positions_near(parts: Parts, place: FloatArray, within: float) -> IntArray:
    """Indices of position nodes at a place (3,) [m], within a part of the largest coordinate."""
    arrays = parts.data.arrays
    nodes = np.flatnonzero(arrays.node_kind <= NodeKind.POSITION).astype(np.int32)
    values = arrays.node_value[:3, nodes]
    apart = np.abs(values - place[:, None]).max(axis=0)
    return np.asarray(nodes[apart <= within * np.abs(values).max(initial=0.0)])


def elements_of(parts: Parts, target: object) -> tuple[int, ...]:
    """Indices of the elements that are meant: by number, name, that of their part, or handle.

    Raises:
        ModelError: there is none, or several parts have this name.
        TypeError: it is nothing of that.
    """
    data = parts.data
    if isinstance(target, str):
        own = [k for k, name in enumerate(data.element_names) if name.strip() == target]
        if len(own) == 1 and parts.of_element(own[0]).name != target:
            return (own[0],)
        return part_of(parts, target).elements
    if isinstance(target, Part):
        return target.elements
    if hasattr(target, "elements"):
        return tuple(i for each in target.elements for i in elements_of(parts, each.number))
    number = _whole(getattr(target, "number", target))
    return (_element(parts, number, target, "an element is given by its number, its name"),)


def element_of(parts: Parts, target: object) -> int:
    """Index of the single element that is meant; see `elements_of`.

    Raises:
        ModelError: there is none, or the part has several.
        TypeError: it is nothing of that.
    """
    found = elements_of(parts, target)
    if len(found) > 1:
        numbers = parts.data.arrays.element_number[list(found)].tolist()
        raise model_error(
            "several-elements",
            f"{in_short(str(target))} has {len(found)} elements",
            f"give one of their numbers: {', '.join(map(str, numbers[:_MOST]))}",
        )
    return found[0]


def deformations_of(
    parts: Parts, target: object, which: int | str, at: object = None
) -> list[tuple[int, int]]:
    """Indices, from 0, of elements and deformations that are meant.

    Args:
        parts: Those of the model.
        target: The part or element, as of `elements_of`.
        which: The number of a deformation, from 1, or a word such as "in-plane bending", which
            may mean several; of a divided part as if it were one beam.
        at: Of bending the end, "p", "q", a point or what the part is fastened to there; by
            default both.

    Raises:
        ModelError: there is no such part, deformation or end.
        TypeError: it is nothing of that.
    """
    data, found = parts.data, elements_of(parts, target)
    number = _whole(which)
    if number is None and not isinstance(which, str):
        raise TypeError(
            f"a deformation is given by its number or in a word, not by {in_short(which)}"
        )
    if number is not None and len(found) == 1 and at is None:
        there = np.flatnonzero(data.arrays.deformation_class[:, found[0]] != Class.NONE) + 1
        if number not in there:
            name = int(data.arrays.element_number[found[0]])
            raise model_error(
                "no-such-deformation",
                f"element {name} has no deformation {in_short(number)}",
                f"it has {', '.join(map(str, there.tolist()))}",
            )
        return [(found[0], number - 1)]
    # What builds models is loaded where one is made.
    draft = load("flexact.model.draft_arrays").draft_of(data)
    spelled = load("flexact.model.deformations")
    if at is not None and not isinstance(at, str):
        place = data.arrays.node_value[:3, position_of(parts, at)].tolist()
        at = place[:2] if data.planar else place
    part = load("flexact.model.arguments").of_indices(draft, list(found))
    indices, numbers = spelled.find_deformations(draft, part, (which,), at)
    kind = element_kinds()[draft.kinds[indices[0]] - 1]
    places, _ = spelled.classes_of_division(draft.classes, kind, indices, numbers, Class.DEPENDENT)
    return [(index, k - 1) for index, k in places]
