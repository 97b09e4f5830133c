# SPDX-License-Identifier: BSD-3-Clause
"""Hinges, struts, vees, spiders: assemblies of sheets, wires and notches that designers know.

What lies about an axis lies about z of the frame at hand.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

from ..core.elements import Class
from ..deck.rendering import model_error
from ..util.quantities import Quantity
from .arguments import (
    Direction,
    Point,
    angle,
    at_place,
    call,
    count,
    direction,
    listed,
    numbers_of_size,
    one_of,
    pivot,
    point,
    several,
    text,
)
from .assemblies import add_body, assembly_of, numbered, numbered_from, pairs, prefixed
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
from .sections import MaterialLike, Section, sheet_section
from .transform import IDENTITY, NO_VECTOR, Vector, cross, on_circle, sine, unit

_MOST_ARMS = 1000
#: Sheets of a cartwheel miss its centre by no more than this part of their length.
_MISS = 1.0e-6
Parts = dict[str, Part | FoldedSheet | Element]


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
        name = text(name, "the name of a cartwheel")
        centre = at_place(draft, _crossing(draft, near, far))
        if width is None and not draft.planar:
            one, other = (span(draft, near[k], far[k]) for k in (0, 1))
            width = width_across(one, other, "the first two sheets are parallel")
        beams, sizes = sizes_of(given)
        parts: Parts = {}
        halves = [(p, centre) for p in near], [(centre, q) for q in far]
        for word, ends in zip(("near sheet", "far sheet"), halves, strict=True):
            names = numbered(prefixed(name, word), len(ends), draft.parts_by_name)
            for k, ((p, q), each) in enumerate(zip(ends, names, strict=True), 1):
                parts[f"{word} {k}"] = add_sheet(draft, p, q, width, beams, each, sizes)
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
    size = _dot(normal, normal)
    if math.sqrt(size) > _MISS * math.hypot(*ways[0]) * math.hypot(*ways[1]):
        t = _dot(cross(span(draft, near[0], near[1]), ways[1]), normal) / size
        centre = _along(draft.seen(near[0].position), ways[0], t)
        if all(
            math.hypot(*cross(_less(centre, draft.seen(p.position)), unit(way)))
            <= _MISS * math.hypot(*way)
            for p, way in zip(near, ways, strict=True)
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
    with call("infinity_hinge", name):
        p, q = (point(draft, each) for each in ends)
        name = text(name, "the name of a hinge")
        beams, sizes = sizes_of(given)
        main = add_sheet(draft, p, q, width, beams, prefixed(name, "sheet"), sizes)
        way, wide = span(draft, p, q), unit(direction(width, "width"))
        length = math.hypot(*way)
        away = length if aside is None else _size(aside, "the distance beside the sheet")
        low, high = draft.seen(p.position), draft.seen(q.position)
        middle = _along(low, way, 0.5)
        corners = (
            at_place(draft, _along(low, wide, away)),
            at_place(draft, _along(middle, wide, away + length / 4.0)),
            at_place(draft, _along(high, wide, away)),
        )
        word = "folded sheet"
        plain = sizes._replace(reinforced=None)
        folded = add_folded_sheet(draft, corners, None, beams, prefixed(name, word), plain)
        end = at_place(draft, _along(middle, wide, -away))
        across = unit(cross(wide, way))
        foot = at_place(draft, _along(draft.seen(end.position), across, length / 2.0))
        shape = sheet_section(sizes.section, sizes.thickness, sizes.breadth)
        thin = Sizes(None, shape.y if shape else None, sizes.material)
        wire = add_wire(draft, foot, end, None, prefixed(name, "wire"), beams, thin)
        parts: Parts = {"sheet": main, word: folded, "wire": wire}
        further = listed(draft, carries, "further points of the body")
        near, far = (p, corners[0], foot), (q, corners[2], end)
        return assembly_of(draft, name, parts, "body", (near, far), further)


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
    with call("folded_hinge", name):
        name = text(name, "the name of a hinge")
        r, slope = _size(radius, "the radius of the folds"), angle(tilt)
        if not 0.0 < slope < 90.0:
            raise model_error(
                "out-of-range",
                f"fold lines that are tilted by {slope:g} degrees do not hold a point",
                "give a tilt between 0 and 90 degrees",
            )
        leaf = r / 2.0 if arm is None else _size(arm, "the length of a leaf")
        beams, sizes = sizes_of(given)
        n = count(sheets, 3, _MOST_ARMS, "sheets")
        parts: Parts = {}
        rows: tuple[list[Node], list[Node]] = [], []
        names = numbered(prefixed(name, "folded sheet"), n, draft.parts_by_name)
        for k, each in enumerate(names):
            x, y, _ = on_circle(NO_VECTOR, sine(slope + 90.0), 360.0 * k / n)
            line = x, y, sine(slope)
            aside = on_circle(NO_VECTOR, 1.0, 360.0 * k / n + 90.0)
            fold = _along(NO_VECTOR, line, r)
            places = _along(fold, aside, leaf), fold, _along(fold, cross(line, aside), leaf)
            corners = [at_place(draft, place) for place in places]
            made = add_folded_sheet(draft, corners, line, beams, each, sizes)
            parts[f"folded sheet {k + 1}"] = made
            rows[0].append(made.nodes[0])
            rows[1].append(made.nodes[2])
        further = listed(draft, carries, "further points of the body")
        return assembly_of(draft, name, parts, "body", rows, further)


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


def add_vee(
    draft: Draft,
    at: Point,
    groove: Direction,
    up: Direction,
    length: Quantity,
    opening: Quantity,
    name: str,
    sizes: tuple[Section | None, Quantity | None, MaterialLike | None],
) -> Assembly:
    """A ball in a groove: two bars along the normals of its flanks."""
    with call("vee", name):
        name = text(name, "the name of a vee")
        ball, size = point(draft, at), _size(length, "the length of the bars of a vee")
        flanks = angle(opening)
        if not 0.0 < flanks < 180.0:
            raise model_error(
                "out-of-range",
                f"a groove cannot open by {flanks:g} degrees",
                "such as 90",
            )
        along = unit(direction(groove, "groove"))
        side = unit(cross(direction(up, "upward direction"), along))
        if side == NO_VECTOR:
            raise model_error(
                "parallel-vector", "the groove is along its upward direction", "give another up"
            )
        rise, run = cross(along, side), sine(90.0 + flanks / 2.0)
        parts: Parts = {}
        feet = []
        names = numbered(prefixed(name, "contact"), 2, draft.parts_by_name)
        for k, (sign, each) in enumerate(zip((-1.0, 1.0), names, strict=True), 1):
            normal = _along(_along(NO_VECTOR, rise, sine(flanks / 2.0)), side, sign * run)
            foot = at_place(draft, _along(draft.seen(ball.position), normal, -size))
            parts[f"contact {k}"] = add_truss(draft, foot, ball, each, *sizes)
            feet.append(foot)
        points = {"ground 1": feet[0], "ground 2": feet[1], "ball": ball}
        for word, node in points.items():
            if not node.name:
                own = numbered_from(prefixed(name, word), draft.points_by_name)
                draft.name_node(node.position, own)
        return Assembly(name, Named(parts), Named(points), tuple(feet))


def add_kinematic_mount(
    draft: Draft,
    radius: Quantity,
    length: Quantity,
    turned: Quantity,
    opening: Quantity,
    name: str,
    carries: Iterable[Point],
    sizes: tuple[Section | None, Quantity | None, MaterialLike | None],
) -> Assembly:
    """Three vees about z, and the plate whose balls lie in them."""
    with call("kinematic_mount", name):
        name = text(name, "the name of a mount")
        r, turn = _size(radius, "the radius of the balls"), angle(turned)
        parts: Parts = {}
        rows: tuple[list[Node], list[Node]] = [], []
        for k in range(3):
            ball = at_place(draft, on_circle(NO_VECTOR, r, 120.0 * k))
            groove = on_circle(NO_VECTOR, 1.0, 120.0 * k + turn)
            own = prefixed(name, f"vee {k + 1}")
            made = add_vee(draft, ball, groove, "z", length, opening, own, sizes)
            parts.update({f"vee {k + 1} {word}": part for word, part in made.parts.items()})
            rows[0].extend(made.ground)
            rows[1].append(ball)
        further = listed(draft, carries, "further points of the plate")
        return assembly_of(draft, name, parts, "plate", rows, further)


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
    with call("spider", name):
        name = text(name, "the name of a spider")
        layout = one_of(layout, LAYOUTS, "the layout of a spider")
        r, s = _radii(radii)
        beams, sizes = sizes_of(given)
        rows: tuple[list[Node], list[Node]] = [], []
        parts: Parts = {}
        n = count(arms, 2, _MOST_ARMS, "arms")
        #: How far from the centre a folded arm turns aside: there its two leaves are equal.
        corner = (s + math.sqrt(2.0 * r * r - s * s)) / 2.0
        for k, own in enumerate(numbered(prefixed(name, "arm"), n, draft.parts_by_name), 1):
            degrees = 360.0 * (k - 1) / n
            radial, aside = (on_circle(NO_VECTOR, 1.0, degrees + more) for more in (0.0, 90.0))
            end = at_place(draft, on_circle(NO_VECTOR, s, degrees))
            shift = {"radial": 0.0, "tangential": s, "folded": corner}[layout] / r
            turn = math.degrees(math.acos(shift)) if shift else 0.0
            start = at_place(draft, on_circle(NO_VECTOR, r, degrees + turn))
            arm: Part | FoldedSheet
            if layout == "folded":
                bend = at_place(draft, on_circle(NO_VECTOR, corner, degrees))
                arm = _flat_arm(draft, (start, bend, end), (radial, aside), own, beams, sizes)
            else:
                width = aside if layout == "radial" else radial
                arm = add_sheet(draft, start, end, width, beams, own, sizes)
            parts[f"arm {k}"] = arm
            rows[0].append(start)
            rows[1].append(end)
        further = listed(draft, carries, "further points of the hub")
        return assembly_of(draft, name, parts, "hub", rows, further)


def _flat_arm(
    draft: Draft,
    corners: tuple[Node, Node, Node],
    widths: tuple[Vector, Vector],
    name: str,
    beams: int,
    sizes: Sizes,
) -> FoldedSheet:
    """Two sheets in one plane, at right angles; how their corner leaves it is declared."""
    leaves = [
        add_sheet(draft, p, q, width, beams, f"{name}, leaf {k}", sizes._replace(reinforced=None))
        for k, (p, q, width) in enumerate(zip(corners, corners[1:], widths, strict=False), 1)
    ]
    declare_released(draft, beams)
    return FoldedSheet((leaves[0], leaves[1]), corners)


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
    with call("diaphragm", name):
        name = text(name, "the name of a diaphragm")
        r, s = _radii(radii)
        beams, sizes = sizes_of(given)
        n = count(sheets, 3, _MOST_ARMS, "sheets")
        word = "wire" if wires else "sheet"
        rows: tuple[list[Node], list[Node]] = [], []
        parts: Parts = {}
        for k, own in enumerate(numbered(prefixed(name, word), n, draft.parts_by_name), 1):
            degrees = 360.0 * (k - 1) / n
            p, q = (at_place(draft, on_circle(NO_VECTOR, size, degrees)) for size in (r, s))
            width = on_circle(NO_VECTOR, 1.0, degrees + 90.0)
            parts[f"{word} {k}"] = (
                add_wire(draft, p, q, None, own, beams, sizes)
                if wires
                else add_sheet(draft, p, q, width, beams, own, sizes)
            )
            rows[0].append(p)
            rows[1].append(q)
        ring = numbered_from(prefixed(name, "ring"), draft.parts_by_name)
        parts["ring"] = add_body(draft, rows[0], ring, (None, None))
        further = listed(draft, carries, "further points of the hub")
        made = assembly_of(draft, name, parts, "hub", rows, further)
        return replace(made, ground=made.ground[:1])


def _radii(given: tuple[Quantity, Quantity]) -> tuple[float, float]:
    """The outer and the inner radius [m]."""
    r, s = (
        _size(each, f"the {word} radius")
        for word, each in zip(("outer", "inner"), given, strict=True)
    )
    if not s < r:
        raise model_error("bad-size", f"the inner radius, {s:g} m, is not less than the outer one")
    return r, s


def _size(given: Quantity, what: str) -> float:
    """A positive length [m]."""
    (made,) = numbers_of_size(given, (1,), f"{what} is a number", "m")
    if made <= 0.0:
        raise model_error("bad-size", f"{what} is not positive", "give it in metres")
    return made


def _along(start: Vector, way: Vector, t: float) -> Vector:
    """A part of the way from a place."""
    return start[0] + t * way[0], start[1] + t * way[1], start[2] + t * way[2]


def _less(a: Vector, b: Vector) -> Vector:
    return _along(a, b, -1.0)


def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
