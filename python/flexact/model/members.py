# SPDX-License-Identifier: BSD-3-Clause
"""Members of a draft: bars, beams, rigid links and hinges; wires, sheets and folded sheets."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Mapping, Sequence
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
    length_of,
    numbers_of_size,
    pivot,
    point,
    position,
    several,
    text,
    whole,
)
from .data import CrossSection
from .deformations import deformations, give_deformations
from .draft import LARGEST, ROUNDING, Draft, Shape
from .handles import (
    CutNotch,
    Element,
    FoldedSheet,
    Node,
    Notch,
    Part,
    ReinforcedSheet,
    Sheet,
    Wire,
)
from .notches import CONTOURS, NotchContour, said, tapered_section
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
    q: Point | None,
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
        far = pivot(draft, position(draft, near)) if q is None else point(draft, q)
        if far.position != near.position:
            raise model_error(
                "two-positions",
                "a hinge joins two points at one position node",
                "make the second point with pivot(p), or leave it out",
            )
        slots = (0, near.orientation, 0, far.orientation)
        number = draft.add_element(kind(draft, "HINGE"), slots, name, along, (1,))
        index = len(draft.kinds) - 1
        draft.give_properties(index, given)
        if independent:
            draft.state_deformations([(index, 1)], Class.INDEPENDENT)
            draft.set_deformation(index, 1, Class.INDEPENDENT)
        return Notch((Element(number, draft),), (near, far))


def _hinge_stiffness(draft: Draft, stiffness: Quantity | Sequence[Quantity]) -> tuple[float, ...]:
    """ESTIFF of a hinge."""
    what = "the stiffness of a hinge is one number" + ("" if draft.planar else ", or three")
    made = numbers_of_size(
        stiffness, (1,) if draft.planar else (1, 3), what, draft.units.symbol("N m/rad")
    )
    if min(made) < 0.0:
        raise model_error("bad-size", "a stiffness is not negative", "give one that is not")
    return made


#: Of the compliances of a notch about its middle that of bending which its halves take, beside what
#: its hinge does; and by how many times they shear more than they bend.
_BENDING, _SHEARING = 1.0e-5, 100.0


def require_no_contour(sizes: Mapping[str, Quantity | None], material: MaterialLike | None) -> None:
    """Raise where sizes or a material are given for a notch without a contour.

    Raises:
        ModelError: there are some.
    """
    given = [word for word, value in sizes.items() if value is not None]
    if given or material is not None:
        raise model_error(
            "surplus-size",
            f"{[*given, 'material'][0]} is for a notch with a contour",
            f"give contour={' or '.join(map(repr, CONTOURS))}",
        )


def contour_of(
    draft: Draft,
    contour: str | NotchContour,
    sizes: Mapping[str, Quantity | None],
    material: MaterialLike | None,
    stiffness: object,
) -> NotchContour:
    """The contour that is meant.

    Raises:
        ModelError: it is none, or something is given twice.
    """
    if stiffness is not None:
        raise model_error(
            "given-twice", "the stiffness of a notch follows from its contour", "leave one out"
        )
    if not isinstance(contour, NotchContour):
        made = "steel" if material is None else material
        return NotchContour(contour, **sizes, material=made, units=draft.units)
    if material is not None or any(value is not None for value in sizes.values()):
        raise model_error("given-twice", "the contour has its sizes already", "leave one out")
    return contour


def add_contour_notch(
    draft: Draft,
    p: Point,
    axis: Direction | None,
    q: Point | None,
    name: str,
    independent: bool,
    contour: NotchContour,
    warping: bool,
) -> CutNotch:
    """A hinge between two halves that do not turn, with the six compliances of a contour.

    About the middle the shifts are those of the halves, in shear and elongation, the bendings
    those of the hinge. Its tilts are equal, as its local axes are not those of the notch: what
    torsion has more than bending about the height is of the halves.
    """
    name = text(name, "the name of an element")
    if q is None:
        raise model_error(
            "missing-point", "a notch with a contour reaches from p to q", "give q, its far end"
        )
    ends = point(draft, p), point(draft, q)
    draft.require_two_ends((ends[0].position, 0, ends[1].position, 0))
    along = span(draft, *ends)
    length = math.hypot(*along)
    if length < contour.length * (1.0 - ROUNDING):
        raise model_error(
            "bad-size",
            f"the notch is {said(draft.units, contour.length, 'm')} long, and its ends are "
            f"{said(draft.units, length, 'm')} apart",
            "give points that are at least as far apart",
        )
    if contour.breadth < contour.thickness:
        raise model_error(
            "bad-size",
            "the neck is narrower than thick, so that it bends about another axis",
            "exchange breadth and thickness and turn the axis, or model it as a beam",
        )
    y = None
    if not draft.planar and axis is not None:
        about, way = unit(direction(axis, "axis")), unit(along)
        y = cross(about, way)
        if abs(sum(a * b for a, b in zip(about, way, strict=True))) > _PARALLEL:
            raise model_error(
                "parallel-vector", "the axis of a notch is across it", "from p to q it is the notch"
            )
    start, end = (draft.node_value[each.position][:3] for each in ends)
    x, y_, z = ((a + b) / 2.0 for a, b in zip(start, end, strict=True))
    near = add_point(draft, (x, y_, z, 0.0))
    half = length / 2.0
    *shifts, torsion, tilt, bend = contour.compliance.tolist()
    torsion = contour.held_torsion if warping else torsion
    ei = [
        max(length / (_BENDING * turned), _SHEARING * half**3 / shift)
        for turned, shift in ((tilt, shifts[2]), (bend, shifts[1]))
    ]
    left = [turned - length / each for turned, each in zip((tilt, bend), ei, strict=True)]
    shear = [
        each * shift / length - half**2 / 3.0
        for each, shift in zip(ei, (shifts[2], shifts[1]), strict=True)
    ]
    stiffness = [length / shifts[0], length / (torsion - left[0]), *ei, *shear]
    beam, mass = kind(draft, "BEAM"), contour.mass(length)
    if draft.planar:
        stiffness = [stiffness[0], ei[1], shear[1]]
        mass = mass and (mass[0], mass[3])
    # The section is that of the neck, where its stress is known by the hinge.
    neck = Shape(CrossSection.RECT, contour.thickness, contour.breadth)
    make = made_of(draft.units, beam, neck, contour.material, "beam")
    half_make = Make(None, tuple(stiffness), mass, expansion=make.expansion)
    names = [f"{name}, half {k}" if name else "" for k in (1, 2)]
    first = add_beam(draft, ends[0], near, y, (), names[0], half_make)
    hinge = add_hinge(draft, "notch", near, axis, None, name, independent, None)
    index = len(draft.kinds) - 1
    turning = (left[1],) if draft.planar else (left[1], left[0], left[0])
    which = CONTOURS.index(contour.contour)
    cut = (float(which), contour.height, contour.length, contour.radius)
    draft.say_looks([index], {"shape": neck, "contour": cut})
    stiff = tuple(1.0 / each for each in turning)
    draft.give_properties(index, stiff, strength=make.strength, fillet=(contour.even_radius,))
    # From its end: a body that carries it stands for that point.
    second = add_beam(draft, ends[1], hinge.q, y, (), names[1], half_make)
    return CutNotch((first, *hinge.elements, second), (ends[0], *hinge.nodes, ends[1]))


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
    reinforced: float | Sequence[Quantity] | None = None
    tapered: Section | None = None
    fillet: Quantity | None = None
    """Of all flexures."""


class Flexure(TypedDict, total=False):
    """What the flexures of a part are made of, by the words of `Model.wire` and `Model.sheet`."""

    beams: int
    section: Section | None
    thickness: Quantity | None
    material: MaterialLike | None
    breadth: Quantity | None
    warping: bool | float
    reinforced: float | Sequence[Quantity] | None
    tapered: Section | None
    fillet: Quantity | None


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
        made = Wire(*_chain(draft, p, q, y, released, name, *_equal(make, beams)))
        _give_fillets(draft, sizes.fillet, made)
        return made


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
        made: Sheet
        if sizes.tapered is not None or (
            isinstance(sizes.reinforced, Iterable) and not isinstance(sizes.reinforced, str)
        ):
            made = _stepped(draft, p, q, width, beams, name, make, sizes)
        elif sizes.reinforced is not None:
            made = _reinforced(draft, p, q, width, beams, name, make, sizes)
            for leaf in ("leaf 1", "leaf 2"):
                _give_fillets(draft, sizes.fillet, made.pieces[leaf])
            return made
        else:
            made = _sheet(draft, p, q, width, beams, name, make, sizes.warping)
        _give_fillets(draft, sizes.fillet, made)
        return made


def _give_fillets(draft: Draft, fillet: Quantity | None, made: Part) -> None:
    """Give a flexure the radius of its fillets, where its end beams are clamped.

    Raises:
        ModelError: it is no positive length.
    """
    if fillet is None:
        return
    radius = length_of(draft.units, fillet, "the radius of a fillet")
    for end in {made.elements[0], made.elements[-1]}:
        draft.give_properties(draft.index_of(end.number), fillet=(radius,))


#: Into how many beams of one section a tapered sheet is divided where nothing is said.
_STEPS = 16


def _stepped(
    draft: Draft,
    p: Point,
    q: Point,
    width: Direction | None,
    beams: int,
    name: str,
    make: Make,
    sizes: Sizes,
) -> Sheet:
    """A sheet of several sections in a row, which is one sheet that is divided.

    Of a tapered sheet each beam has the section that gives way as its piece does, in elongation
    and in bending out of its plane.
    """
    if make.shape is None:
        raise model_error(
            "missing-section",
            "what is tapered or reinforced has a section",
            "give thickness and breadth",
        )
    if sizes.warping is True or (sizes.tapered is not None and sizes.reinforced is not None):
        raise model_error(
            "surplus-size",
            "a sheet is tapered, reinforced by a thickness, or held against warping",
            "give one of them; a number as warping is a factor of your own",
        )
    t, b = make.shape.y, make.shape.z
    beams = _beams(beams)
    if sizes.tapered is None:
        given = several(sizes.reinforced, "a share of the length and a thickness")
        if len(given) != 2:
            raise model_error(
                "bad-number",
                "a reinforced sheet has a share of its length and a thickness there",
                'give both, such as (0.7, "2 mm"), or the share alone',
            )
        part, thickness = _share(given[0]), given[1]
        thick = length_of(draft.units, thickness, "the thickness of the middle")
        if not thick > t:
            raise model_error(
                "bad-size", "the middle of a reinforced sheet is not thicker than the sheet"
            )
        shapes = [(t, b)] * beams + [(thick, b)] * beams + [(t, b)] * beams
        corners = [0.0, (1.0 - part) / 2.0, (1.0 + part) / 2.0, 1.0]
        places = [
            low + (high - low) * k / beams
            for low, high in itertools.pairwise(corners)
            for k in range(beams)
        ][1:]
    else:
        far = numbers_of_size(
            sizes.tapered,
            (1, 2),
            "a taper ends with its thickness, or breadth and thickness",
            draft.units.symbol("m"),
        )
        t1, b1 = far[-1], far[0] if len(far) == 2 else b
        if not min(far) > 0.0:
            raise model_error("bad-size", "a size at the end of a taper is not positive")
        beams = beams if beams > 1 else _STEPS
        shapes = [
            tapered_section((t, t1), (b, b1), k / beams, (k + 1) / beams) for k in range(beams)
        ]
        places = [k / beams for k in range(1, beams)]
    made = [
        made_of(
            draft.units,
            kind(draft, "BEAM"),
            Shape(CrossSection.RECT, *each),
            sizes.material,
            "sheet",
        ).with_warping(sizes.warping, 0.0)
        for each in shapes
    ]
    return _sheet_of(draft, p, q, width, name, places, made)


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
    share = _share(sizes.reinforced)
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


def _share(given: object) -> float:
    """The share of its length in which a sheet is reinforced."""
    what = "the reinforced part of a sheet is a share of its length"
    (share,) = numbers_of_size(given, (1,), what)
    if not 0.0 < share < 1.0:
        raise model_error("out-of-range", f"{what}, not {share:g}", "give one such as 0.7")
    return share


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
        for leaf in (first, second):
            _give_fillets(draft, sizes.fillet, leaf)
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
    p, q = point(draft, p), point(draft, q)
    make = make.with_warping(warping, math.hypot(*span(draft, p, q)))
    return _sheet_of(draft, p, q, width, name, *_equal(make, beams))


def _sheet_of(
    draft: Draft,
    p: Point,
    q: Point,
    width: Direction | None,
    name: str,
    places: Sequence[float],
    makes: Sequence[Make],
) -> Sheet:
    name = text(name, "the name of a sheet")
    p, q = point(draft, p), point(draft, q)
    normal = _sheet_normal(draft, p, q, width)
    released = (2, 3) if draft.planar else (2, 5, 6)
    return Sheet(*_chain(draft, p, q, normal, released, name, places, makes))


def _beams(given: object) -> int:
    """Into how many beams a flexure is divided."""
    beams = whole(given, "the number of beams must be a whole number")
    if not 1 <= beams <= LARGEST:
        raise model_error(
            "out-of-range", f"a flexure cannot be divided into {in_short(beams)} beams"
        )
    return beams


def _equal(make: Make, given: object) -> tuple[list[float], list[Make]]:
    """The inner points of a flexure of equal beams, as shares of its length, and its beams."""
    beams = _beams(given)
    return [i / beams for i in range(1, beams)], [make] * beams


def _chain(
    draft: Draft,
    p: Point,
    q: Point,
    y: Direction | None,
    released: tuple[int, ...],
    name: str,
    places: Sequence[float],
    makes: Sequence[Make],
) -> tuple[tuple[Element, ...], tuple[Node, ...]]:
    """Beams in a row that are one flexure, and their points.

    What the beams but the first release is declared, so that the row is one beam.
    """
    name = text(name, "the name of an element")
    ends = point(draft, p), point(draft, q)
    draft.require_two_ends((ends[0].position, 0, ends[1].position, 0))
    beams = len(makes)
    start, end = (draft.node_value[each.position][:3] for each in ends)
    nodes = [ends[0]]
    for t in places:
        x, y_, z = (a * (1.0 - t) + b * t for a, b in zip(start, end, strict=True))
        nodes.append(add_point(draft, (x, y_, z, 0.0)))
    nodes.append(ends[1])
    names = [f"{name}, {i + 1}" if name and beams > 1 else name for i in range(beams)]
    elements = tuple(
        add_beam(draft, nodes[i], nodes[i + 1], y, released, names[i], makes[i])
        for i in range(beams)
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
