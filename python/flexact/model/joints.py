# SPDX-License-Identifier: BSD-3-Clause
"""Hinges, struts, vees, spiders: assemblies of sheets, wires and notches that designers know.

What lies about an axis lies about z of the frame at hand.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from ..core.elements import Class
from ..deck.rendering import model_error
from ..util.groups import grouped
from ..util.quantities import Quantity
from .arguments import (
    Direction,
    Point,
    angle,
    at_place,
    call,
    count,
    direction,
    length_of,
    listed,
    numbers_of_size,
    one_of,
    pivot,
    point,
    several,
    text,
)
from .assemblies import add_body, assembly_of, name_point, numbered, numbered_from, pairs, prefixed
from .deformations import give_deformations
from .draft import Draft
from .handles import Assembly, Element, FoldedSheet, Named, Node, Part
from .members import (
    Flexure,
    Sizes,
    add_folded_sheet,
    add_hinge,
    add_sheet,
    add_truss,
    add_wire,
    declare_released,
    sizes_of,
    span,
    width_across,
)
from .sections import sheet_section
from .transform import IDENTITY, NO_VECTOR, Place, Vector, cross, on_circle, sine, unit

_MOST_ARMS = 1000
#: Sheets of a cartwheel miss its centre by no more than this part of their length; axes of a
#: universal joint whose sine is less are parallel.
_MISS = 1.0e-6
Parts = dict[str, Part | FoldedSheet | Element]
#: A flexure to be made: the word for it, its points from the ground to the body, and the widths of
#: its sheets, one, or two of a flat arm; without one it is a folded sheet, a wire or a contact.
Wanted = tuple[str, Sequence[Point], Sequence[Direction]]
_CONTACT = "contact"


def _flexures(
    draft: Draft, name: str, wanted: Iterable[Wanted], given: Flexure
) -> tuple[Parts, tuple[list[Node], list[Node]]]:
    """Flexures by their words and numbers, and their ends on the ground and on the body."""
    beams, sizes = sizes_of(given)
    plain = sizes._replace(reinforced=None, tapered=None)
    every = [*wanted]
    whole = {"reinforced", "tapered"}
    round_, surplus = plain, given.keys() & {"breadth", "warping", *whole}
    if any(widths or len(points) == 3 for _, points, widths in every):
        surplus &= whole
    if any(len(widths) == 1 for _, _, widths in every):
        surplus = set()
        shape = sheet_section(draft.units, sizes.section, sizes.thickness, sizes.breadth)
        round_ = Sizes(None, shape and f"{shape.y!r}m", sizes.material, fillet=sizes.fillet)
    if surplus:
        raise model_error("surplus-size", f"{min(surplus)} is for sheets, which it has not")
    parts: Parts = {}
    rows: tuple[list[Node], list[Node]] = [], []
    for word, group in grouped((each[0], each[1:]) for each in every).items():
        names = numbered(prefixed(name, word), len(group), draft.parts_by_name)
        for k, (own, (points, widths)) in enumerate(zip(names, group, strict=True), 1):
            nodes = [point(draft, each) for each in points]
            made: Part | FoldedSheet | Element
            if len(widths) == 2:
                first, second = (
                    add_sheet(draft, nodes[i], nodes[i + 1], widths[i], beams, leaf, plain)
                    for i, leaf in enumerate((f"{own}, leaf 1", f"{own}, leaf 2"))
                )
                # How the corner leaves the plane moves nothing else.
                declare_released(draft, beams)
                made = FoldedSheet((first, second), (nodes[0], nodes[1], nodes[2]))
            elif len(nodes) == 3:
                made = add_folded_sheet(draft, nodes, None, beams, own, plain)
            elif widths:
                made = add_sheet(draft, nodes[0], nodes[1], widths[0], beams, own, sizes)
            elif word == _CONTACT:
                made = add_truss(draft, nodes[0], nodes[1], own, *plain[:3])
            else:
                made = add_wire(draft, nodes[0], nodes[1], None, own, beams, round_)
            parts[f"{word} {k}"] = made
            rows[0].append(nodes[0])
            rows[1].append(nodes[-1])
    return parts, rows


def _held(
    draft: Draft,
    method: str,
    name: str,
    wanted: Iterable[Wanted],
    body: str,
    carries: Iterable[Point],
    given: Flexure,
) -> Assembly:
    """Flexures from the ground to a body, and the body."""
    with call(method, name):
        name = text(name, "the name of an assembly")
        parts, rows = _flexures(draft, name, wanted, given)
        further = listed(draft, carries, f"further points of the {body}")
        return assembly_of(draft, name, parts, body, rows, further)


def add_cartwheel(
    draft: Draft,
    sides: tuple[Iterable[Point], Iterable[Point]],
    width: Direction | None,
    name: str,
    carries: Iterable[Point],
    given: Flexure,
) -> Assembly:
    """Sheets that cross, each cut in two where they meet."""
    with call("cartwheel", name):
        near, far = pairs(draft, sides, "cartwheel")
        name = text(name, "the name of an assembly")
        centre = at_place(draft, _crossing(draft, near, far))
        if width is None and not draft.planar:
            one, other = (span(draft, near[k], far[k]) for k in (0, 1))
            width = width_across(one, other, "the first two sheets are parallel")
        halves: list[Wanted] = [("near sheet", (p, centre), [width or "z"]) for p in near]
        halves += [("far sheet", (centre, q), [width or "z"]) for q in far]
        parts, _ = _flexures(draft, name, halves, given)
        first, bending = parts["near sheet 1"], ("out-of-plane bending",)
        with call("independent", first):
            give_deformations(draft, first, bending, Class.INDEPENDENT, "q")
        further = listed(draft, carries, "further points of the body")
        inner = {"centre": centre}
        return assembly_of(draft, name, parts, "body", (near, far), further, inner=inner)


def _crossing(draft: Draft, near: Sequence[Node], far: Sequence[Node]) -> Vector:
    """Where the lines of sheets meet, in the frame at hand [m]."""
    ways = [span(draft, p, q) for p, q in zip(near, far, strict=True)]
    normal = cross(ways[0], ways[1])
    size = math.hypot(*normal)
    if size > _MISS * math.hypot(*ways[0]) * math.hypot(*ways[1]):
        between = cross(span(draft, near[0], near[1]), ways[1])
        t = sum(a * b for a, b in zip(between, normal, strict=True)) / size**2
        centre = _along(draft.seen(near[0].position), ways[0], t)
        beside = (_along(centre, draft.seen(p.position), -1.0) for p in near)
        if all(
            math.hypot(*cross(each, way)) <= _MISS * math.hypot(*way) ** 2
            for each, way in zip(beside, ways, strict=True)
        ):
            return centre
    raise model_error(
        "bad-number", "the sheets do not cross in one line", "give points whose lines meet"
    )


def add_infinity_hinge(
    draft: Draft,
    ends: tuple[Point, Point],
    width: Direction,
    aside: Quantity | None,
    name: str,
    carries: Iterable[Point],
    given: Flexure,
) -> Assembly:
    """A sheet, beside it a folded sheet against its twist and a wire against its going aside."""

    def wanted() -> Iterator[Wanted]:
        p, q = (point(draft, each) for each in ends)
        low, way, wide = draft.seen(p.position), span(draft, p, q), unit(direction(width, "width"))
        length = math.hypot(*way)
        away = length if aside is None else _size(draft, aside, "the distance beside the sheet")
        yield "sheet", (p, q), [width]
        middle, beside = _along(low, way, 0.5), _along(low, wide, away)
        fold = _along(middle, wide, away + length / 4.0)
        yield "folded sheet", (beside, fold, _along(beside, way, 1.0)), ()
        end = _along(middle, wide, -away)
        yield "wire", (_along(end, unit(cross(wide, way)), length / 2.0), end), ()

    return _held(draft, "infinity_hinge", name, wanted(), "body", carries, given)


def add_folded_hinge(
    draft: Draft,
    radius: Quantity,
    tilt: Quantity,
    arm: Quantity | None,
    sheets: int,
    name: str,
    carries: Iterable[Point],
    given: Flexure,
) -> Assembly:
    """Folded sheets whose fold lines meet at the origin, tilted out of the xy plane."""

    def wanted() -> Iterator[Wanted]:
        r, slope = _size(draft, radius, "the radius of the folds"), angle(tilt)
        if not 0.0 < slope < 90.0:
            what = f"fold lines that are tilted by {slope:g} degrees do not hold a point"
            raise model_error("out-of-range", what, "give a tilt between 0 and 90 degrees")
        leaf = r / 2.0 if arm is None else _size(draft, arm, "the length of a leaf")
        for radial, aside in _around(sheets, 3, "sheets"):
            line = _along((0.0, 0.0, sine(slope)), radial, sine(slope + 90.0))
            fold = _along(NO_VECTOR, line, r)
            ends = _along(fold, aside, leaf), _along(fold, cross(line, aside), leaf)
            yield "folded sheet", (ends[0], fold, ends[1]), ()

    return _held(draft, "folded_hinge", name, wanted(), "body", carries, given)


#: What the notches at an end of a strut are.
ENDS = ("universal", "spherical")
Ends = str | Sequence[str]


def add_universal_joint(
    draft: Draft, p: Point, axes: Sequence[Direction], q: Point | None, name: str
) -> Assembly:
    """Two notches in series, with a rigid body between them where they are at two places."""
    with call("universal_joint", name):
        name = text(name, "the name of a joint")
        given = several(axes, "the two axes of a universal joint")
        if len(given) != 2:
            raise model_error("bad-number", "a universal joint has two axes", 'such as ("x", "y")')
        one, other = (direction(each, "axis") for each in axes)
        if math.hypot(*cross(unit(one), unit(other))) <= _MISS:
            raise model_error(
                "parallel-vector", "the axes of the joint are parallel", "give two that cross"
            )
        names = numbered(prefixed(name, "notch"), 2, draft.parts_by_name)
        first = add_hinge(draft, "notch", p, one, None, names[0], False, None)
        parts: Parts = {"notch 1": first}
        far, end = first.q, None
        if q is not None:
            end = point(draft, q)
            far = pivot(draft, end.position)
            word = "intermediate body"
            own = numbered_from(prefixed(name, word), draft.parts_by_name)
            parts[word] = add_body(draft, [first.q, far], own, (None, None))
        second = add_hinge(draft, "notch", far, other, end, names[1], False, None)
        parts["notch 2"] = second
        return Assembly(name, Named(parts), Named({"p": first.p, "q": second.q}), (first.p,))


def add_strut(draft: Draft, p: Point, q: Point, ends: Ends, name: str) -> Assembly:
    """A rigid bar between two points, with notches at both ends."""
    with call("strut", name):
        name = text(name, "the name of a strut")
        words = (ends, ends) if isinstance(ends, str) else several(ends, "both ends")
        if len(words) != 2:
            raise model_error("bad-number", f"a strut with {len(words)} ends", "give one or two")
        words = tuple(one_of(word, ENDS, "an end of a strut") for word in words)
        nodes = point(draft, p), point(draft, q)
        draft.require_two_ends((nodes[0].position, 0, nodes[1].position, 0))
        along = unit(span(draft, *nodes))
        least = min(range(3), key=lambda k: abs(along[k]))
        across = unit(cross(along, IDENTITY[least]))
        crossed = across, cross(along, across)
        parts: Parts = {}
        inner = []
        for node, word in zip(nodes, words, strict=True):
            spherical = word == "spherical" or draft.planar
            for axis in (along,) if spherical else crossed:
                own = numbered(prefixed(name, "notch"), 1, draft.parts_by_name)[0]
                given = None if draft.planar else axis
                made = add_hinge(draft, "notch", node, given, None, own, False, None)
                parts[f"notch {len(parts) + 1}"] = made
                node = made.q
            index = len(draft.kinds) - 1
            if spherical:
                for number in range(2, draft.deformations_of(index) + 1):
                    draft.set_deformation(index, number, Class.DEPENDENT)
            inner.append(node)
        if words == ("spherical", "spherical") and not draft.planar:
            # Its turning about itself moves nothing else.
            draft.declare(index, (1,))
        own = numbered_from(prefixed(name, "bar"), draft.parts_by_name)
        parts["bar"] = add_body(draft, inner, own, (None, None))
        points = Named({"p": nodes[0], "q": nodes[1]})
        return Assembly(name, Named(parts), points, nodes[:1])


def add_bipod(
    draft: Draft,
    feet: Iterable[Point],
    apex: Point,
    reach: float,
    ends: Ends,
    name: str,
    carries: Iterable[Point],
) -> Assembly:
    """Two struts towards one point of a body."""
    with call("bipod", name):
        name = text(name, "the name of a bipod")
        near = listed(draft, feet, "feet")
        if len(near) != 2:
            raise model_error("bad-number", f"a bipod with {len(near)} feet", "give two")
        (share,) = numbers_of_size(reach, (1,), "the reach of a bipod is a number")
        if not 0.0 < share <= 1.0:
            raise model_error(
                "out-of-range",
                f"struts reach {share:g} of the way",
                "such as 0.8",
            )
        top = point(draft, apex)
        far = [
            top
            if share == 1.0
            else at_place(draft, _along(draft.seen(foot.position), span(draft, foot, top), share))
            for foot in near
        ]
        parts: Parts = {}
        names = numbered(prefixed(name, "strut"), 2, draft.parts_by_name)
        for k, (p, q, each) in enumerate(zip(near, far, names, strict=True), 1):
            made = add_strut(draft, p, q, ends, each)
            parts.update({f"strut {k} {word}": part for word, part in made.parts.items()})
        further = listed(draft, carries, "further points of the body")
        return assembly_of(draft, name, parts, "body", (near, far), [top, *further])


def _contacts(
    ball: Vector, groove: Vector, up: Vector, size: float, opening: float
) -> Iterator[Wanted]:
    """The bars of a ball in a groove, along the normals of its flanks."""
    along = unit(groove)
    side = unit(cross(up, along))
    if side == NO_VECTOR:
        raise model_error(
            "parallel-vector", "the groove is along its upward direction", "give another up"
        )
    if not 0.0 < opening < 180.0:
        what = f"a groove cannot open by {opening:g} degrees"
        raise model_error("out-of-range", what, "such as 90")
    rise = _along(NO_VECTOR, cross(along, side), sine(opening / 2.0))
    for sign in (-1.0, 1.0):
        normal = _along(rise, side, sign * sine(90.0 + opening / 2.0))
        yield _CONTACT, (_along(ball, normal, -size), ball), ()


def add_vee(
    draft: Draft,
    at: Point,
    groove: Direction,
    up: Direction,
    length: Quantity,
    opening: Quantity,
    name: str,
    given: Flexure,
) -> Assembly:
    """A ball in a groove: two bars."""
    with call("vee", name):
        name = text(name, "the name of an assembly")
        ball, size = point(draft, at), _size(draft, length, "the length of the bars of a vee")
        place, upward = draft.seen(ball.position), direction(up, "upward direction")
        wanted = _contacts(place, direction(groove, "groove"), upward, size, angle(opening))
        parts, (feet, _) = _flexures(draft, name, wanted, given)
        points = {"ground 1": feet[0], "ground 2": feet[1], "ball": ball}
        for word, node in points.items():
            name_point(draft, node, prefixed(name, word))
        return Assembly(name, Named(parts), Named(points), tuple(feet))


def add_kinematic_mount(
    draft: Draft,
    radius: Quantity,
    length: Quantity,
    turned: Quantity,
    opening: Quantity,
    name: str,
    carries: Iterable[Point],
    given: Flexure,
) -> Assembly:
    """Three vees about z, and the plate whose balls lie in them."""

    def wanted() -> Iterator[Wanted]:
        r, size = (
            _size(draft, radius, "the radius of the balls"),
            _size(draft, length, "the length of the bars"),
        )
        for k in range(3):
            ball = on_circle(NO_VECTOR, r, 120.0 * k)
            groove = on_circle(NO_VECTOR, 1.0, 120.0 * k + angle(turned))
            yield from _contacts(ball, groove, IDENTITY[2], size, angle(opening))

    return _held(draft, "kinematic_mount", name, wanted(), "plate", carries, given)


#: How the arms of a spider lie.
LAYOUTS = ("radial", "tangential", "folded")


def add_spider(
    draft: Draft,
    radii: tuple[Quantity, Quantity],
    arms: int,
    layout: str,
    name: str,
    carries: Iterable[Point],
    given: Flexure,
) -> Assembly:
    """Flat arms in the xy plane from a circle to the hub that they hold."""

    def wanted() -> Iterator[Wanted]:
        kind = one_of(layout, LAYOUTS, "the layout of a spider")
        r, s = _radii(draft, radii)
        # How far from the centre a folded arm turns aside: there its leaves are equal.
        corner = (s + math.sqrt(2.0 * r * r - s * s)) / 2.0
        for radial, aside in _around(arms, 2, "arms"):
            hub = _along(NO_VECTOR, radial, s)
            if kind == "radial":
                yield "arm", (_along(NO_VECTOR, radial, r), hub), [aside]
            elif kind == "tangential":
                yield "arm", (_along(hub, aside, math.sqrt(r * r - s * s)), hub), [radial]
            else:
                bend = _along(NO_VECTOR, radial, corner)
                yield "arm", (_along(bend, aside, corner - s), bend, hub), (radial, aside)

    return _held(draft, "spider", name, wanted(), "hub", carries, given)


def add_diaphragm(
    draft: Draft,
    radii: tuple[Quantity, Quantity],
    sheets: int,
    wires: bool,
    name: str,
    carries: Iterable[Point],
    given: Flexure,
) -> Assembly:
    """A membrane as radial sheets or wires in the xy plane, with its ring and its hub."""

    def wanted() -> Iterator[Wanted]:
        r, s = _radii(draft, radii)
        for radial, aside in _around(sheets, 3, "sheets"):
            ends = _along(NO_VECTOR, radial, r), _along(NO_VECTOR, radial, s)
            yield ("wire", ends, ()) if wires else ("sheet", ends, [aside])

    made = _held(draft, "diaphragm", name, wanted(), "hub", carries, given)
    own = numbered_from(prefixed(made.name, "ring"), draft.parts_by_name)
    ring = add_body(draft, made.ground, own, (None, None))
    return replace(made, parts=Named({**made.parts, "ring": ring}), ground=made.ground[:1])


def _around(n: int, least: int, what: str) -> Iterator[tuple[Vector, Vector]]:
    """So many radial directions about z, each with that at right angles to it."""
    size = count(n, least, _MOST_ARMS, what)
    for k in range(size):
        yield (
            on_circle(NO_VECTOR, 1.0, 360.0 * k / size),
            on_circle(NO_VECTOR, 1.0, 360.0 * k / size + 90.0),
        )


def _radii(draft: Draft, given: tuple[Quantity, Quantity]) -> tuple[float, float]:
    """The outer and the inner radius [m]."""
    r, s = (
        _size(draft, each, f"the {word} radius")
        for word, each in zip(("outer", "inner"), given, strict=True)
    )
    if not s < r:
        small = f"{draft.units.shown(s, 'm'):g} {draft.units.symbol('m')}"
        raise model_error("bad-size", f"the inner radius, {small}, is not less than the outer one")
    return r, s


def _size(draft: Draft, given: Quantity, what: str) -> float:
    """A positive length [m]."""
    return length_of(draft.units, given, what)


def _along(start: Vector, way: Vector, t: float) -> Place:
    """A part of the way from a place."""
    return Place(start[0] + t * way[0], start[1] + t * way[1], start[2] + t * way[2])
