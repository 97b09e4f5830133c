# SPDX-License-Identifier: BSD-3-Clause
"""What stands for a point: a handle, a name, a place, a body; and its nodes."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Sequence
from operator import index as whole_number

import numpy as np

from ..core.elements import (
    AXES,
    POSITION_NAMES,
    ROTATION_NAMES,
    Class,
    Member,
    NodeKind,
    coordinate_name,
    is_position,
    kind_of,
    member_table,
)
from ..deck.rendering import model_error
from ..util.quantities import Quantity, QuantityError, measured
from ..util.text import in_short
from .attributes import CrossSection
from .draft import NO_VECTOR, Colour, Draft, Said, Shape, Vector
from .handles import Assembly, Body, Element, FoldedSheet, Node, Notch, Part, Sheet, Wire
from .names import COORDINATES, ambiguous, own_number, unknown
from .places import one_line
from .words import SIDE_VIEW, WIDE_Y, WIDE_Z, Planes

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
    if isinstance(part, str) and unit:
        return measured(part, unit)
    if isinstance(part, (str, bytes, bytearray, complex)):
        raise TypeError
    return float(part)  # type: ignore[arg-type]


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


def axis(draft: Draft, given: Direction | None) -> Vector:
    """The axis of a hinge, which a spatial model needs and a planar one does not take."""
    if draft.planar:
        if given is not None and any(direction(given, "axis")[:2]):
            raise model_error("surplus-vector", "the axis of a planar hinge is z")
        return NO_VECTOR
    if given is None:
        raise model_error("missing-vector", "a hinge needs an axis", "give axis=(x, y, z)")
    return direction(given, "axis")


def whole(given: object, what: str) -> int:
    """A whole number; `what` says of what.

    Raises:
        ModelError: it is none.
    """
    try:
        return whole_number(given)  # type: ignore[arg-type]
    except TypeError:
        raise model_error("bad-number", f"{what}, not {in_short(given)}") from None


def unit(given: Vector) -> Vector:
    """The vector of length one along this one; zero of zero."""
    largest = max(map(abs, given))
    if largest == 0.0:
        return NO_VECTOR
    x, y, z = (part / largest for part in given)
    norm = math.hypot(x, y, z)
    return x / norm, y / norm, z / norm


def cross(a: Vector, b: Vector) -> Vector:
    """The vector product a x b."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


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
        return named_part(draft, target)
    return Element(draft.numbers[element_index(draft, target)], draft.owner)


def named_part(draft: Draft, name: str) -> Part | Element:
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


#: A diameter, or two sizes [m].
Section = Quantity | Sequence[Quantity]


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


def said(
    target: object,
    section: Section | None,
    colour: Sequence[float] | None,
    edge_colour: Sequence[float] | None,
    opacity: float | None,
    drawn: bool | None,
) -> Said:
    """What is said about drawing a target, checked."""
    checked = {
        "shape": sheet_shape(section) if is_sheet(target) else shape_of(section),
        "colour": None if colour is None else _colour(colour, "colour"),
        "edge_colour": None if edge_colour is None else _colour(edge_colour, "colour of the edges"),
        "opacity": None if opacity is None else _opacity(opacity),
        "drawn": None if drawn is None else _flag(drawn),
    }
    return {name: value for name, value in checked.items() if value is not None}


def is_sheet(target: object) -> bool:
    """Whether the section of this part is its breadth and its thickness."""
    return isinstance(target, (Sheet, FoldedSheet))


def _flag(drawn: object) -> bool:
    if not isinstance(drawn, (bool, np.bool_)):
        raise model_error("not-a-flag", "whether an element is drawn is True or False")
    return bool(drawn)


def shape_of(section: Section | None) -> Shape | None:
    """A cross-section from a diameter, or from the sizes along local y and z [m], or none.

    Raises:
        ModelError: it is neither, or a size is not positive and finite.
    """
    if section is None:
        return None
    what = "a section is a diameter, or two sizes along the local y and z axes"
    if isinstance(section, Iterable) and not isinstance(section, str):
        sizes = _numbers(section, 2, what, "m")
    else:
        sizes = _numbers([section], 1, what, "m")
    if not all(size > 0.0 for size in sizes):
        raise model_error(
            "bad-size", "a size of a cross-section is not positive", "give sizes in metres"
        )
    kind = CrossSection.CIRC if len(sizes) == 1 else CrossSection.RECT
    return Shape(kind, sizes[0], sizes[-1])


def sheet_shape(section: Section | None) -> Shape | None:
    """A cross-section from the width and the thickness of a sheet, whose width is local z."""
    if section is None:
        return None
    what = "the section of a sheet is its width and its thickness"
    width, thickness = _numbers(section, 2, what, "m")
    return shape_of((thickness, width))


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
    return _numbers(given, wanted, what, unit)


def size_of(given: object, what: str) -> float:
    """A size [m]; `shape_of` asks that it be positive.

    Raises:
        ModelError: it is no finite number.
    """
    return _numbers([given], 1, f"the {what} is a number", "m")[0]


def _colour(given: Sequence[float], what: str) -> Colour:
    """Red, green and blue from 0 to 1.

    Raises:
        ModelError: they are not.
    """
    red, green, blue = _numbers(given, 3, f"the {what} is red, green and blue")
    if not all(0.0 <= part <= 1.0 for part in (red, green, blue)):
        raise model_error(
            "bad-colour", f"a part of the {what} is out of range", "give parts from 0 to 1"
        )
    return red, green, blue


def _opacity(given: float) -> float:
    """An opacity from 0 to 1.

    Raises:
        ModelError: it is none.
    """
    (opacity,) = _numbers([given], 1, "an opacity is a number")
    if not 0.0 <= opacity <= 1.0:
        raise model_error(
            "bad-opacity", "an opacity is out of range", "give 0 for invisible, 1 for opaque"
        )
    return opacity


def _numbers(given: object, wanted: int, what: str, unit: str = "") -> tuple[float, ...]:
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
