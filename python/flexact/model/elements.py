# SPDX-License-Identifier: BSD-3-Clause
"""Single elements of a draft: bars, beams, rigid links, hinges."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..core.elements import Class, kind_of
from ..core.raw import ElementKind
from ..deck.rendering import model_error
from ..util.quantities import Quantity
from .arguments import Direction, call, direction, numbers_of_size, text
from .deformations import deformations
from .draft import NO_VECTOR, Draft
from .handles import Element, Node, Notch
from .sections import Make, MaterialLike, Section, made_of, round_section, shape_of
from .selection import Point, pivot, point, position


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
    shape = round_section(section, thickness)
    bar = kind(draft, "TRUSS")
    make = made_of(bar, shape, material, "bar")
    slots = (position(draft, p), 0, position(draft, q), 0)
    number = draft.add_element(bar, slots, name, shape=shape)
    draft.give_properties(len(draft.kinds) - 1, make.stiffness, make.mass)
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
    draft.give_properties(len(draft.kinds) - 1, make.stiffness, make.mass)
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
    make = made_of(beam, shape_of(section), material, "beam")
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
        given = None if stiffness is None else _hinge_stiffness(stiffness, draft.planar)
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


def _hinge_stiffness(stiffness: Quantity | Sequence[Quantity], planar: bool) -> tuple[float, ...]:
    """ESTIFF of a hinge."""
    what = "the stiffness of a hinge is one number" + ("" if planar else ", or three")
    made = numbers_of_size(stiffness, (1,) if planar else (1, 3), what, "N m/rad")
    if min(made) < 0.0:
        raise model_error("bad-size", "a stiffness is not negative", "give it in N m/rad")
    return made
