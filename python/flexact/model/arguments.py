# SPDX-License-Identifier: BSD-3-Clause
"""What users give: numbers, directions and texts; and what stands for a point or a part."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from operator import index as whole_number

from ..core.elements import Class, Member, NodeKind, is_position, kind_of, member_table
from ..deck.diagnostics import Problems
from ..deck.rendering import ModelError, model_error
from ..util.quantities import Quantity, QuantityError, measured
from ..util.text import in_short
from ..util.units import Units
from .draft import Draft
from .handles import Assembly, Body, Element, FoldedSheet, Node, Notch, Part, Sheet, Wire
from .names import COORDINATES, ambiguous, one_line, own_number, unknown
from .transform import NO_VECTOR, Place, Vector, on_circle

#: What gives three parts and still is no vector.
UNORDERED = (str, bytes, bytearray, set, frozenset, dict)
#: A direction by the name of a global axis, or as a vector.
Direction = str | Sequence[float]
_AXES: dict[str, Vector] = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


def vector(given: Sequence[Quantity], what: str, unit: str = "") -> Vector:
    """Three finite numbers; with a unit also texts that say theirs, such as "3 mm".

    Raises:
        ModelError: they are not.
    """
    try:
        if isinstance(given, UNORDERED):
            raise TypeError
        x, y, z = (real(part, unit) for part in given)
    except QuantityError as error:
        raise model_error("bad-number", f"the {what}: {error}") from None
    except (TypeError, ValueError, OverflowError):
        raise model_error("bad-number", f"the {what} must be three numbers") from None
    if not (math.isfinite(x) and math.isfinite(y) and math.isfinite(z)):
        raise model_error("bad-number", f"the {what} has a component that is not finite")
    return x, y, z


def real(part: object, unit: str = "") -> float:
    """A number, but no text that reads as one; with a unit also a text that says its own.

    Raises:
        QuantityError: the text says no unit, or another kind of one.
        TypeError, ValueError, OverflowError: it is no number.
    """
    if isinstance(part, (bytes, bytearray, complex)) or (isinstance(part, str) and not unit):
        raise TypeError
    return measured(part, unit) if unit else float(part)  # type: ignore[arg-type]


def several(given: object, what: str) -> tuple[object, ...]:
    """The items of a list, tuple or array.

    Raises:
        ModelError: it has none, or is a single text.
    """
    try:
        if isinstance(given, (str, bytes, bytearray)):
            raise TypeError
        return tuple(given)  # type: ignore[arg-type]
    except TypeError:
        raise model_error("bad-number", f"{what} are wanted, not {in_short(given)}") from None


def count(given: object, least: int, most: int, what: str) -> int:
    """A whole number from `least` to `most`.

    Raises:
        ModelError: it is none.
    """
    made = whole(given, f"the number of {what} must be a whole number")
    if not least <= made <= most:
        raise model_error(
            "out-of-range", f"{in_short(made)} {what}: there can be {least} to {most}"
        )
    return made


def angle(given: object) -> float:
    """An angle in degrees; a text says its unit, such as "0.5 rad".

    Raises:
        ModelError: it is no finite number.
    """
    try:
        made = real(given, "deg")
    except QuantityError as error:
        raise model_error("bad-number", str(error)) from None
    except (TypeError, ValueError, OverflowError):
        made = math.nan
    if not math.isfinite(made):
        raise model_error("bad-number", f"an angle is a number of degrees, not {in_short(given)}")
    return made


def text(given: object, what: str) -> str:
    """A text, such as a name, as a plain str: a member of an Enum is known to its script alone."""
    if not isinstance(given, str):
        raise model_error("bad-name", f"{what} must be text, not {type(given).__name__}")
    return str.__str__(given)


def direction(given: Direction, what: str) -> Vector:
    """Three finite numbers that are not all zero, or the axis "x", "y" or "z"."""
    if isinstance(given, str):
        found = _AXES.get(given.strip().lower())
        if found is None:
            raise model_error(
                "bad-number",
                f"the {what} must be three numbers, or x, y or z, not {in_short(given)}",
            )
        return found
    made = vector(given, what)
    if made == NO_VECTOR:
        raise model_error("zero-vector", f"the {what} is zero", "give a vector that is not zero")
    return made


def whole(given: object, what: str) -> int:
    """A whole number; `what` says of what.

    Raises:
        ModelError: it is none.
    """
    try:
        return whole_number(given)  # type: ignore[arg-type]
    except TypeError:
        raise model_error("bad-number", f"{what}, not {in_short(given)}") from None


def one_of(given: object, known: Iterable[str], what: str) -> str:
    """A word out of several.

    Raises:
        ModelError: it is none of them.
    """
    for word in known:
        if isinstance(given, str) and given == word:
            return word
    raise model_error("no-such-word", f"{what} is {' or '.join(known)}, not {in_short(given)}")


def numbers_of_size(
    given: object, sizes: tuple[int, ...], what: str, unit: str = ""
) -> tuple[float, ...]:
    """Finite numbers, as many as one of `sizes` says; a single one may stand alone.

    With a unit also texts that say theirs, such as "3 mm".

    Raises:
        ModelError: they are not.
    """
    single = not isinstance(given, Iterable) or getattr(given, "ndim", 1) == 0
    single = single or (isinstance(given, str) and bool(unit))
    parts = (given,) if single else several(given, what)
    wanted = len(parts) if len(parts) in sizes else sizes[0]
    given = parts if single or not isinstance(given, UNORDERED) else given
    return numbers(given, wanted, what, unit)


def numbers(given: object, wanted: int, what: str, unit: str = "") -> tuple[float, ...]:
    """So many finite numbers; with a unit also texts that say theirs.

    Raises:
        ModelError: they are not.
    """
    try:
        if isinstance(given, UNORDERED) or not isinstance(given, Iterable):
            raise TypeError
        parts = tuple(real(part, unit) for part in given if not isinstance(part, bool))
        if len(parts) != wanted:
            raise ValueError
    except QuantityError as error:
        raise model_error("bad-number", f"{what}: {error}") from None
    except (TypeError, ValueError, OverflowError):
        raise model_error("bad-number", f"{what}, not {in_short(given)}") from None
    if not all(map(math.isfinite, parts)):
        raise model_error("bad-number", f"{what}, and one of them is not finite")
    return parts


def length_of(units: Units, given: object, what: str) -> float:
    """A positive length [m].

    Raises:
        ModelError: it is none.
    """
    (made,) = numbers_of_size(given, (1,), f"{what} is a number", units.symbol("m"))
    if made <= 0.0:
        raise model_error("bad-size", f"{what} is not positive", "give one that is")
    return made


def polar(radius: Quantity, degrees: Quantity, z: Quantity = 0.0) -> tuple[float, ...]:
    """The place (x, y, z) at a radius and an angle from x about z.

    To the last bit where the angle is a multiple of 30 degrees.

    Args:
        radius: Distance from the z axis, in the units of the model, or a text with its unit.
        degrees: The angle, right-handed [degrees].
        z: Height, likewise.

    Returns:
        Numbers in the unit of those that were given; in metres where these have their units,
        which a model with other units knows.

    Raises:
        ModelError: one of them is no finite number, or one has a unit and the other none.
    """
    what = "a polar place is a radius, an angle and a height"
    r, height = (numbers_of_size(each, (1,), what, "m")[0] for each in (radius, z))
    made = on_circle((0.0, 0.0, height), r, angle(degrees))
    said = [isinstance(each, str) for each in (radius, z) if isinstance(each, str) or each]
    if any(said) and not all(said):
        raise model_error("bad-number", f"{what}: give both with their units, or none")
    return made if any(said) else tuple(made)


@contextmanager
def call(method: str, name: object = "") -> Iterator[None]:
    """Begin the message of an error with the call and the part that it was about."""
    try:
        yield
    except ModelError as error:
        name = name if isinstance(name, str) else getattr(name, "name", "")
        if not isinstance(name, str) or not name or len(error.diagnostics) != 1:
            raise
        (problem,) = error.diagnostics
        if problem.message.startswith(f"{method} "):
            raise
        message = f"{method} {in_short(name)}: {problem.message}"
        raise ModelError(Problems.of([replace(problem, message=message)])) from None


#: A point: its handle, its name, its place [m], or a body, which stands for its first point.
Point = Node | Body | str | Sequence[Quantity]
#: A part: its handle, its name, or the number of an element.
PartLike = Part | Element | str | int


def require_own(draft: Draft, handle: Node | Element | Part, what: str = "node") -> None:
    """Raise for a handle of another model."""
    owned = handle if isinstance(handle, (Node, Element)) else handle.nodes[0]
    if owned.owner is not draft:
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
    indices = draft.parts_by_name.get(name, [])
    if indices and all(draft.is_rigid(index) for index in indices):
        p, op, _, _ = draft.slots[in_order(draft, indices)[0]]
        return Node(p, op, draft)
    if indices:
        raise model_error(
            "not-a-node",
            f"{in_short(name)} is a part and has no coordinates",
            "name a point, such as one of its ends",
        )
    bodies = [each for each, of_it in draft.parts_by_name.items() if draft.is_rigid(of_it[0])]
    raise unknown("no-such-point", "point", name, [*draft.points_by_name, *bodies])


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
    """The values of a position node at a place of the frame at hand.

    Raises:
        ModelError: it is none.
    """
    made = coordinates(draft, given)
    return (*(draft.frame.place(made) if draft.frame else made), 0.0)


def coordinates(draft: Draft, given: Iterable[Quantity]) -> Vector:
    """Three numbers in SI, or two where z is zero.

    Raises:
        ModelError: they are none, or z is not zero in a planar model.
    """
    if isinstance(given, Place):
        return given
    parts = given
    if not isinstance(given, UNORDERED) and isinstance(given, Iterable):
        try:
            parts = tuple(given)
        except TypeError:
            parts = ()
        if len(parts) == 2:
            parts = (*parts, 0.0)
    x, y, z = vector(parts, "position", draft.units.symbol("m"))  # type: ignore[arg-type]
    if draft.planar and z != 0.0:
        raise model_error("no-coordinate", "a planar model has no coordinate z")
    return x, y, z


def existing(draft: Draft, given: object) -> Node:
    """The point that is meant, which must be there.

    Raises:
        ModelError: it is not.
    """
    if isinstance(given, (Node, Body, str)) or not isinstance(given, Iterable):
        return point(draft, given)
    found = draft.nodes_at(place(draft, given))
    if not found:
        raise model_error("no-such-point", f"there is no point at {in_short(given)}")
    return whole_point(draft, found[0])


def add_point(draft: Draft, value: tuple[float, float, float, float]) -> Node:
    """A new point."""
    kind = NodeKind.PLANAR_POSITION if draft.planar else NodeKind.POSITION
    return pivot(draft, draft.add_node(kind, value))


def whole_point(draft: Draft, position: int) -> Node:
    """The point of a position node; a missing orientation is made."""
    orientation = draft.orientation_at.get(position)
    return pivot(draft, position) if orientation is None else Node(position, orientation, draft)


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
    if not isinstance(given, (Node, Body, str, Iterable)):
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
    return Node(position_number, orientation_number, draft)


def pivot(draft: Draft, position_number: int) -> Node:
    """Another point at a position node, with an orientation of its own."""
    orientation = draft.add_orientation()
    draft.join(position_number, orientation)
    return Node(position_number, orientation, draft)


def node_number(draft: Draft, given: object) -> int:
    """Number of a node that there is.

    Raises:
        ModelError: there is none of this number.
    """
    number = whole(given, "a node is given by its handle or its number")
    if number not in draft.node_kind:
        raise model_error("no-such-node", f"there is no node {in_short(number)}")
    return number


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
        return named_part(draft, target)
    return Element(draft.numbers[element_index(draft, target)], draft)


def named_part(draft: Draft, name: str) -> Part | Element:
    """The part with this name, or the single element with it.

    Raises:
        ModelError: there is none, or there are several.
    """
    indices = draft.parts_by_name.get(name, [])
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
    is_body = are_links or all(draft.is_rigid(i) for i in indices)
    indices = in_order(draft, indices) if is_body else indices
    elements = tuple(Element(draft.numbers[i], draft) for i in indices)
    first = draft.slots[indices[0]]
    if is_body:
        return Body(elements, _points(draft, indices))
    if int(member_table()[draft.kinds[indices[0]]]) == Member.HINGE:
        at = draft.position_of.get(first[1], 0)
        nodes = Node(at, first[1], draft), Node(at, first[3], draft)
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
        found.setdefault(p, Node(p, op, draft))
        if q not in found:
            # An RBEAM of a deck carries no orientation at q.
            found[q] = Node(q, oq, draft) if oq else whole_point(draft, q)
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


def drawn_elements(draft: Draft, target: object) -> tuple[int, ...]:
    """Indices of the elements of a part, of all parts of an assembly, or of the hinge at a point.

    Raises:
        ModelError: there is no such part, or no hinge whose far side this point is.
    """
    if isinstance(target, FoldedSheet):
        return tuple(i for leaf in target.leaves for i in drawn_elements(draft, leaf))
    if isinstance(target, Assembly):
        return tuple(i for each in target.parts.values() for i in drawn_elements(draft, each))
    if isinstance(target, Node):
        require_own(draft, target)
        return (_hinge_at(draft, target),)
    return tuple(indices_of(draft, part(draft, target)))


def _hinge_at(draft: Draft, point: Node) -> int:
    """Index of the last hinge that ends at this point; most are asked for when just made."""
    hinge = kind_of("PLHINGE" if draft.planar else "HINGE").number
    for index in range(len(draft.kinds) - 1, -1, -1):
        if draft.slots[index][3] == point.orientation and draft.kinds[index] == hinge:
            return index
    raise model_error(
        "not-an-element",
        "no hinge ends at this point",
        "give an element, a sheet, an element's number, or the point beyond a hinge",
    )
