# SPDX-License-Identifier: BSD-3-Clause
"""Members of a draft: bars, beams, rigid links and hinges; wires, sheets and folded sheets."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple, TypedDict

from ..core.elements import Class, kind_of
from ..core.raw import ElementKind
from ..deck.rendering import model_error
from ..util.quantities import Quantity
from ..util.text import in_short
from .arguments import (
    Direction,
    Point,
    add_point,
    call,
    checked_name,
    direction,
    numbers_of_size,
    pivot,
    point,
    position,
    text,
    whole,
)
from .deformations import deformations, give_deformations
from .draft import LARGEST, Draft
from .handles import Element, FoldedSheet, Node, Notch, ReinforcedSheet, Sheet, Wire
from .sections import Make, MaterialLike, Section, made_of, round_section, shape_of, sheet_section
from .transform import NO_VECTOR, Vector, cross, unit


def kind(draft: Draft, keyword: str) -> ElementKind:
    """The kind of this keyword, in a planar model the planar one."""
    return kind_of("PL" + keyword if draft.planar else keyword)


def add_truss(
    draft: Draft,
    p: Point | int,
    q: Point | int,
    name: str,
    section: Section | None,
    thickness: Quantity | None,
    material: MaterialLike | None,
) -> Element:
    """A bar between two points."""
    name = text(name, "the name of an element")
    shape = round_section(draft.units, section, thickness)
    bar = kind(draft, "TRUSS")
    make = made_of(draft.units, bar, shape, material, "bar")
    slots = (position(draft, p), 0, position(draft, q), 0)
    number = draft.add_element(bar, slots, name, shape=shape)
    draft.give_properties(len(draft.kinds) - 1, *make.numbers)
    return Element(number, draft)


def add_beam(
    draft: Draft,
    p: Point,
    q: Point,
    y: Direction | None,
    released: tuple[int, ...],
    name: str,
    make: Make,
) -> Element:
    """A beam between two points; `released` are part of what it is."""
    if y is not None and draft.planar:
        raise model_error("surplus-vector", "a planar beam takes no y vector")
    hint = NO_VECTOR if y is None else direction(y, "y vector")
    name = text(name, "the name of an element")
    a, b = point(draft, p), point(draft, q)
    slots = (position(draft, a), a.orientation, position(draft, b), b.orientation)
    number = draft.add_element(kind(draft, "BEAM"), slots, name, hint, released, make.shape)
    draft.give_properties(len(draft.kinds) - 1, *make.numbers)
    return Element(number, draft)


def add_releasing_beam(
    draft: Draft,
    p: Point,
    q: Point,
    y: Direction | None,
    release: Iterable[int | str],
    name: str,
    section: Section | None,
    material: MaterialLike | None,
) -> Element:
    """A beam of which deformations are released one by one, as if they were said afterwards."""
    beam = kind(draft, "BEAM")
    released = deformations(beam, release)
    make = made_of(draft.units, beam, shape_of(draft.units, section), material, "beam")
    element = add_beam(draft, p, q, y, (), name, make)
    index = draft.index_of(element.number)
    draft.state_deformations([(index, k) for k in released], Class.DEPENDENT)
    for number in released:
        draft.set_deformation(index, number, Class.DEPENDENT)
    return element


def add_rigid(draft: Draft, p: Point, q: Point, name: str, make: Make) -> Element:
    """A rigid link, whose kind is decided when arrays are made."""
    element = add_beam(draft, p, q, None, (), name, make)
    draft.rigid.add(len(draft.kinds) - 1)
    return element


def add_hinge(
    draft: Draft,
    method: str,
    p: Point,
    axis: Direction | None,
    q: Node | None,
    name: str,
    independent: bool,
    stiffness: Quantity | Sequence[Quantity] | None,
) -> Notch:
    """A hinge between two points at one position; `method` is what users called."""
    with call(method, name):
        name = text(name, "the name of an element")
        given = None if stiffness is None else _hinge_stiffness(draft, stiffness)
        along = NO_VECTOR if axis is None else direction(axis, "axis")
        if draft.planar:
            if any(along[:2]):
                raise model_error("surplus-vector", "the axis of a planar hinge is z")
            along = NO_VECTOR
        elif axis is None:
            raise model_error("missing-vector", "a hinge needs an axis", "give axis=(x, y, z)")
        near = point(draft, p)
        if q is None:
            q = pivot(draft, position(draft, near))
        elif (q := point(draft, q)).position != near.position:
            raise model_error(
                "two-positions",
                "a hinge joins two points at one position node",
                "make the second point with pivot(p), or leave it out",
            )
        slots = (0, near.orientation, 0, q.orientation)
        number = draft.add_element(kind(draft, "HINGE"), slots, name, along, (1,))
        index = len(draft.kinds) - 1
        draft.give_properties(index, given)
        if independent:
            draft.state_deformations([(index, 1)], Class.INDEPENDENT)
            draft.set_deformation(index, 1, Class.INDEPENDENT)
        return Notch((Element(number, draft),), (near, q))


def _hinge_stiffness(draft: Draft, stiffness: Quantity | Sequence[Quantity]) -> tuple[float, ...]:
    """ESTIFF of a hinge."""
    what = "the stiffness of a hinge is one number" + ("" if draft.planar else ", or three")
    made = numbers_of_size(
        stiffness, (1,) if draft.planar else (1, 3), what, draft.units.symbol("N m/rad")
    )
    if min(made) < 0.0:
        raise model_error("bad-size", "a stiffness is not negative", "give one that is not")
    return made


#: The thickness with which the middle of a reinforced sheet is drawn, in that of the sheet.
_THICKER = 4.0
#: As the core's check of a y vector.
_PARALLEL = 1.0e-6


class Sizes(NamedTuple):
    """What a flexure is made of, as users give it; see `Model.wire` and `Model.sheet`."""

    section: Section | None
    thickness: Quantity | None
    material: MaterialLike | None
    breadth: Quantity | None = None
    """Of a sheet, as is what follows."""
    warping: bool | float = False
    reinforced: float | None = None


class Flexure(TypedDict, total=False):
    """What the flexures of a part are made of, by the words of `Model.wire` and `Model.sheet`."""

    beams: int
    section: Section | None
    thickness: Quantity | None
    material: MaterialLike | None
    breadth: Quantity | None
    warping: bool | float
    reinforced: float | None


def sizes_of(given: Flexure) -> tuple[int, Sizes]:
    """Into how many beams flexures are divided, and what they are made of.

    Raises:
        TypeError: a word is none of `Flexure`.
    """
    made = {"section": None, "thickness": None, "material": None, **given}
    beams = made.pop("beams", 1)
    return beams, Sizes(**made)  # type: ignore[arg-type, return-value]


def add_wire(
    draft: Draft,
    p: Point,
    q: Point,
    y: Direction | None,
    name: str,
    beams: int,
    sizes: Sizes,
) -> Wire:
    """A wire flexure."""
    released = (2, 3) if draft.planar else (2, 3, 4, 5, 6)
    with call("wire", name):
        shape = round_section(draft.units, sizes.section, sizes.thickness)
        make = made_of(draft.units, kind(draft, "BEAM"), shape, sizes.material, "wire")
        return Wire(*_chain(draft, p, q, y, released, name, make, beams))


def add_sheet(
    draft: Draft,
    p: Point,
    q: Point,
    width: Direction | None,
    beams: int,
    name: str,
    sizes: Sizes,
) -> Sheet:
    """A sheet flexure."""
    with call("sheet", name):
        make = _sheet_make(draft, sizes)
        if sizes.reinforced is None:
            return _sheet(draft, p, q, width, beams, name, make, sizes.warping)
        return _reinforced(draft, p, q, width, beams, name, make, sizes)


def _reinforced(
    draft: Draft,
    p: Point,
    q: Point,
    width: Direction | None,
    beams: int,
    name: str,
    make: Make,
    sizes: Sizes,
) -> ReinforcedSheet:
    """Two sheets with a rigid middle, which moves as the ends of the whole say.

    What the second of them releases is declared, as of the beams of a divided sheet.
    """
    what = "the reinforced part of a sheet is a share of its length"
    (share,) = numbers_of_size(sizes.reinforced, (1,), what)
    if not 0.0 < share < 1.0:
        raise model_error("out-of-range", f"{what}, not {share:g}", "give one such as 0.7")
    ends = point(draft, p), point(draft, q)
    draft.require_two_ends((ends[0].position, 0, ends[1].position, 0))
    start, end = (draft.node_value[each.position][:3] for each in ends)
    inner = []
    for t in ((1.0 - share) / 2.0, (1.0 + share) / 2.0):
        x, y, z = (a * (1.0 - t) + b * t for a, b in zip(start, end, strict=True))
        inner.append(add_point(draft, (x, y, z, 0.0)))
    near, far = inner
    names = [f"{name}, {word}" if name else "" for word in ("leaf 1", "middle", "leaf 2")]
    first = _sheet(draft, ends[0], near, width, beams, names[0], make, sizes.warping)
    shape = make.shape and make.shape._replace(y=_THICKER * make.shape.y)
    normal = _sheet_normal(draft, near, far, width)
    middle = add_beam(draft, near, far, normal, (), names[1], Make(shape))
    draft.rigid.add(len(draft.kinds) - 1)
    second = _sheet(draft, far, ends[1], width, beams, names[2], make, sizes.warping)
    declare_released(draft, beams)
    elements = *first.elements, middle, *second.elements
    return ReinforcedSheet(elements, first.nodes + second.nodes)


def declare_released(draft: Draft, beams: int) -> None:
    """Declare what the last beams release, so that they move only as what is in series says."""
    for index in range(len(draft.kinds) - beams, len(draft.kinds)):
        for number, value in enumerate(draft.classes[index], 1):
            if value == Class.DEPENDENT:
                draft.set_deformation(index, number, Class.INDEPENDENT)


def add_folded_sheet(
    draft: Draft,
    corners: Sequence[Point],
    width: Direction | None,
    beams: int,
    name: str,
    sizes: Sizes,
) -> FoldedSheet:
    """Two sheets from the first of three points over the fold to the last."""
    with call("folded_sheet", name):
        name = text(name, "the name of a folded sheet")
        make = _sheet_make(draft, sizes)
        start, middle, end = (point(draft, each) for each in corners)
        if width is None and not draft.planar:
            arms = span(draft, middle, start), span(draft, middle, end)
            width = width_across(*arms, "the two leaves are in one plane")
        leaves = [f"{name}, leaf {k}" if name else "" for k in (1, 2)]
        first = _sheet(draft, start, middle, width, beams, leaves[0], make, sizes.warping)
        second = _sheet(draft, middle, end, width, beams, leaves[1], make, sizes.warping)
        with call("independent", first):
            bending = ("out-of-plane bending",)
            give_deformations(draft, first, bending, Class.INDEPENDENT, "q")
        if name and not middle.name:
            draft.name_node(middle.position, checked_name(f"{name}, fold"))
    return FoldedSheet((first, second), (start, middle, end))


def _sheet_make(draft: Draft, sizes: Sizes) -> Make:
    shape = sheet_section(draft.units, sizes.section, sizes.thickness, sizes.breadth)
    return made_of(draft.units, kind(draft, "BEAM"), shape, sizes.material, "sheet")


def _sheet(
    draft: Draft,
    p: Point,
    q: Point,
    width: Direction | None,
    beams: int,
    name: str,
    make: Make,
    warping: bool | float,
) -> Sheet:
    name = text(name, "the name of a sheet")
    p, q = point(draft, p), point(draft, q)
    normal = _sheet_normal(draft, p, q, width)
    released = (2, 3) if draft.planar else (2, 5, 6)
    make = make.with_warping(warping, math.hypot(*span(draft, p, q)))
    return Sheet(*_chain(draft, p, q, normal, released, name, make, beams))


def _chain(
    draft: Draft,
    p: Point,
    q: Point,
    y: Direction | None,
    released: tuple[int, ...],
    name: str,
    make: Make,
    beams: int,
) -> tuple[tuple[Element, ...], tuple[Node, ...]]:
    """Beams in a row that are one flexure, and their points.

    What the beams but the first release is declared, so that the row is one beam.
    """
    name = text(name, "the name of an element")
    ends = point(draft, p), point(draft, q)
    draft.require_two_ends((ends[0].position, 0, ends[1].position, 0))
    beams = whole(beams, "the number of beams must be a whole number")
    if not 1 <= beams <= LARGEST:
        raise model_error(
            "out-of-range", f"a flexure cannot be divided into {in_short(beams)} beams"
        )
    start, end = (draft.node_value[each.position][:3] for each in ends)
    nodes = [ends[0]]
    for t in (i / beams for i in range(1, beams)):
        x, y_, z = (a * (1.0 - t) + b * t for a, b in zip(start, end, strict=True))
        nodes.append(add_point(draft, (x, y_, z, 0.0)))
    nodes.append(ends[1])
    names = [f"{name}, {i + 1}" if name and beams > 1 else name for i in range(beams)]
    elements = tuple(
        add_beam(draft, nodes[i], nodes[i + 1], y, released, names[i], make) for i in range(beams)
    )
    for index in range(len(draft.kinds) - beams + 1, len(draft.kinds)):
        for number in released:
            draft.set_deformation(index, number, Class.INDEPENDENT)
    return elements, tuple(nodes)


def span(draft: Draft, p: Node, q: Node) -> Vector:
    """The vector from p to q in the frame at hand [m]."""
    a, b = draft.seen(p.position), draft.seen(q.position)
    return b[0] - a[0], b[1] - a[1], b[2] - a[2]


def _normal_to(a: Vector, b: Vector) -> Vector:
    """The unit normal of the plane of two vectors; zero where they are parallel."""
    made = cross(unit(a), unit(b))
    if math.hypot(*made) <= _PARALLEL:
        return NO_VECTOR
    x, y, z = unit(made)
    return x + 0.0, y + 0.0, z + 0.0


def width_across(a: Vector, b: Vector, why_none: str) -> Vector:
    """The width that follows from the geometry: normal to two vectors.

    Raises:
        ModelError: they are parallel.
    """
    made = _normal_to(a, b)
    if made == NO_VECTOR:
        raise model_error(
            "missing-vector", f"{why_none}, so that no width follows", "give width=(x, y, z)"
        )
    return made


def _sheet_normal(draft: Draft, p: Node, q: Node, width: Direction | None) -> Vector | None:
    """The y vector of a sheet's beams: normal to the sheet, so that z lies in its plane.

    A sheet of no length has none; that is left to the check of the model.
    """
    if draft.planar:
        if width is not None and any(direction(width, "width")[:2]):
            raise model_error("surplus-vector", "the width of a sheet in a planar model is along z")
        return None
    if width is None:
        raise model_error(
            "missing-vector",
            "a sheet needs the direction of its width",
            'give width=(x, y, z), or "x", "y" or "z"',
        )
    wide, along = direction(width, "width"), unit(span(draft, p, q))
    if along == NO_VECTOR:
        return wide
    normal = _normal_to(wide, along)
    if normal == NO_VECTOR:
        raise model_error(
            "parallel-vector",
            "the width of the sheet is parallel to it",
            "give a direction across the sheet, from edge to edge",
        )
    return normal
