# SPDX-License-Identifier: BSD-3-Clause
"""Rigid bodies of a draft, and what they make with flexures: cross hinges, guides, hexapods."""

from __future__ import annotations

import itertools
from collections.abc import Container, Iterable, Mapping, Sequence
from types import MappingProxyType

from ..deck.rendering import model_error
from ..util.quantities import Quantity
from ..util.text import in_short
from .arguments import (
    Direction,
    Point,
    at_place,
    call,
    checked_name,
    coordinates,
    count,
    listed,
    named_part,
    numbers_of_size,
    one_of,
    point,
    require_own,
    text,
    vector,
)
from .data import BodyShape
from .draft import Draft, Said
from .handles import Assembly, Body, Element, FoldedSheet, Named, Node, Part
from .members import Sizes, add_rigid, add_sheet, add_wire, span, width_across
from .names import part_name
from .sections import Make, Section, shape_of
from .transform import Place, on_circle

#: Of one guide.
_MOST_SHEETS = 1000


#: Mass and moments of inertia of a body, as users give them; see `Model.body`.
Mass = tuple[Quantity | None, Quantity | Sequence[Quantity] | None]


def add_body(
    draft: Draft,
    points: Iterable[Point],
    name: str,
    mass: Mass,
    section: Section | None = None,
    looks: tuple[str | None, Quantity | None] = (None, None),
) -> Body:
    """One rigid body through points: links from the first to those that it does not carry yet."""
    with call("body", name):
        name = text(name, "the name of a body")
        nodes, links, old_name = _members(draft, points)
        make, said = Make(shape_of(draft.units, section)), _shape_said(draft, *looks)
        masses = _masses(draft, mass)
        components = draft.rigid_components()
        first = Node(*components.carrier(nodes[0].position, nodes[0].orientation), draft)
        for node in nodes[1:]:
            components = draft.rigid_components()
            carrier = Node(*components.carrier(node.position, node.orientation), draft)
            if not components.joined(first.orientation, carrier.orientation):
                links.append(add_rigid(draft, first, carrier, "", make))
        if said and not links:
            raise model_error(
                "not-an-element",
                "a body without links of its own is not drawn",
                "say it of the body that carries its points",
            )
        _name_links(draft, links, name or old_name, nodes[0])
        draft.say_looks((draft.index_of(link.number) for link in links), said)
        if not links and name:
            draft.name_node(nodes[0].position, checked_name(name))
    for number, values in zip((nodes[0].position, nodes[0].orientation), masses, strict=True):
        if values:
            draft.give_node_mass(number, values)
    return Body(tuple(links), nodes)


def _shape_said(draft: Draft, shape: object, thickness: Quantity | None) -> Said:
    """As what a body is drawn, and how thick; nothing where neither is given."""
    said: Said = {}
    if thickness is not None:
        (said["body_thickness"],) = numbers_of_size(
            thickness, (1,), "a thickness is one number", draft.units.symbol("m")
        )
        if said["body_thickness"] <= 0.0:
            raise model_error("bad-size", "a thickness is not positive", "give one that is")
        shape = shape or "hull"
    if shape is not None:
        known = {each.name.lower(): int(each) for each in BodyShape if each}
        said["body_shape"] = known[one_of(shape, known, "the shape of a body")]
    return said


def _members(draft: Draft, given: Iterable[Point]) -> tuple[tuple[Node, ...], list[Element], str]:
    """Points of a body, each once, the links of bodies among them, and the name of the first."""
    # An array of no dimension says that one can go through it, and one cannot.
    is_single = isinstance(given, (str, bytes)) or getattr(given, "ndim", 1) == 0
    if is_single or not isinstance(given, Iterable):
        raise model_error(
            "not-a-point", f"a body goes through several points, not {in_short(given)}"
        )
    nodes: dict[Node, None] = {}
    links: list[Element] = []
    name = ""
    for each in given:
        body: object = each
        if isinstance(each, str) and each not in draft.points_by_name:
            body = named_part(draft, each) if each in draft.parts_by_name else each
        if isinstance(body, Body):
            require_own(draft, body, "body")
            nodes.update(dict.fromkeys(body.nodes))
            links += [link for link in body.elements if link not in links]
            name = name or body.name
        else:
            nodes[point(draft, each)] = None
    if not nodes:
        raise model_error("not-a-point", "a body needs at least one point")
    return tuple(nodes), links, name


def _name_links(draft: Draft, links: list[Element], name: str, first: Node) -> None:
    """Name the links of a body, that from its first point first; a single one like the body.

    Those of this name that belong to the same body are counted, too.
    """
    if not name:
        return
    indices = _from_first(draft, [draft.index_of(link.number) for link in links], first)
    components = draft.rigid_components()
    taken = sum(
        components.joined(first.orientation, draft.slots[i][1])
        for i in draft.parts_by_name.get(name, [])
        if i not in indices
    )
    alone = len(indices) == 1 and not taken
    for k, index in enumerate(indices, taken + 1):
        draft.name_element(index, name if alone else f"{part_name(name)}, {k}")


def _from_first(draft: Draft, indices: list[int], first: Node) -> list[int]:
    """The links with one that begins at the first point before the others."""
    start = [i for i in indices if draft.slots[i][0] == first.position]
    if not start:
        # A body that was there carries it: its link is turned round, which holds the same,
        # unless something was said of it.
        stated = {i for i, _ in draft.stated}
        start = [
            i
            for i in draft.rigid.intersection(indices)
            if i not in stated and draft.slots[i][2:] == (first.position, first.orientation)
        ][:1]
        for index in start:
            p, op, q, oq = draft.slots[index]
            draft.slots[index] = q, oq, p, op
    return [*start, *(i for i in indices if i not in start)]


def _masses(draft: Draft, given: Mass) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Mass, and Jxx, Jxy, Jxz, Jyy, Jyz, Jzz or one J in the plane; empty where not given."""
    own_mass, inertia = given
    unit = draft.units.symbol("kg m2")
    mass: tuple[float, ...] = ()
    if own_mass is not None:
        mass = numbers_of_size(own_mass, (1,), "a mass is one number", "kg")
        if mass[0] < 0.0:
            raise model_error("bad-size", "a mass is not negative", "give it in kg")
    if inertia is None:
        return mass, ()
    if draft.planar:
        what = "the moment of inertia in a plane is one number"
        return mass, numbers_of_size(inertia, (1,), what, unit)
    what = "moments of inertia are Jxx, Jyy, Jzz, or Jxx, Jxy, Jxz, Jyy, Jyz, Jzz"
    values = numbers_of_size(inertia, (3, 6), what, unit)
    if len(values) == 3:
        values = values[0], 0.0, 0.0, values[1], 0.0, values[2]
    return mass, values


def add_cross_hinge(
    draft: Draft,
    sides: tuple[Iterable[Point], Iterable[Point]],
    width: Direction | None,
    name: str,
    carries: Iterable[Point],
    mass: Mass,
    beams: int,
    sizes: Sizes,
) -> Assembly:
    """Sheets from points of the ground to points of a body, which cross."""
    with call("cross_hinge", name):
        near, far = pairs(draft, sides, "cross hinge")
        if width is None and not draft.planar:
            one, other = (span(draft, near[k], far[k]) for k in (0, 1))
            width = width_across(one, other, "the first two sheets are parallel")
        return _sheets_and_body(
            draft, (near, far), width, name, "body", carries, beams, sizes, mass
        )


def pairs(
    draft: Draft, sides: tuple[Iterable[Point], Iterable[Point]], what: str
) -> tuple[list[Node], list[Node]]:
    """Points of the ground and of the body, as many of the one as of the other.

    Raises:
        ModelError: they are not, or there is a single pair.
    """
    near, far = (
        listed(draft, each, f"points of the {side}")
        for side, each in zip(("ground", "body"), sides, strict=True)
    )
    if len(near) != len(far) or len(near) < 2:
        raise model_error(
            "bad-number",
            f"a {what} with {len(near)} points on the ground and {len(far)} on the body",
            "give as many points of the one as of the other, at least two",
        )
    return near, far


def add_parallel_guide(
    draft: Draft,
    ends: tuple[Point, Point],
    offset: Sequence[Quantity],
    width: Direction | None,
    name: str,
    sheets: int,
    carries: Iterable[Point],
    mass: Mass,
    beams: int,
    sizes: Sizes,
) -> Assembly:
    """Equal sheets side by side, and the stage that they carry."""
    with call("parallel_guide", name):
        number = count(sheets, 2, _MOST_SHEETS, "sheets")
        x, y, z = coordinates(draft, offset)
        p, q = (point(draft, each) for each in ends)
        if width is None and not draft.planar:
            width = width_across(span(draft, p, q), (x, y, z), "the offset is along the sheets")
        rows = []
        for end in (p, q):
            here = draft.seen(end.position)
            further = (
                at_place(draft, Place(here[0] + k * x, here[1] + k * y, here[2] + k * z))
                for k in range(1, number)
            )
            rows.append([end, *further])
        return _sheets_and_body(
            draft, (rows[0], rows[1]), width, name, "stage", carries, beams, sizes, mass
        )


def _sheets_and_body(
    draft: Draft,
    ends: tuple[list[Node], list[Node]],
    width: Direction | None,
    name: str,
    body_word: str,
    carries: Iterable[Point],
    beams: int,
    sizes: Sizes,
    mass: Mass,
) -> Assembly:
    """Sheets between two rows of points, and the body that carries the far ones."""
    name = text(name, "the name of an assembly")
    names = numbered(prefixed(name, "sheet"), len(ends[0]), draft.parts_by_name)
    made = [
        add_sheet(draft, p, q, width, beams, sheet, sizes)
        for p, q, sheet in zip(*ends, names, strict=True)
    ]
    further = listed(draft, carries, "further points of the body")
    parts = {f"sheet {k}": each for k, each in enumerate(made, 1)}
    return assembly_of(draft, name, parts, body_word, ends, further, mass)


def add_hexapod(
    draft: Draft,
    sides: tuple[Quantity | Iterable[Point], Quantity | Iterable[Point]],
    height: Quantity | None,
    name: str,
    spread: Quantity | Sequence[Quantity],
    at: Sequence[Quantity],
    carries: Iterable[Point],
    mass: Mass,
    beams: int,
    sizes: Sizes,
) -> Assembly:
    """Six wires between points, or between two circles, and the platform that they hold."""
    with call("hexapod", name):
        name = text(name, "the name of a hexapod")
        of_points = [s for s in sides if isinstance(s, Iterable) and not isinstance(s, str)]
        if len(of_points) == 1:
            raise model_error("bad-number", "a hexapod has two radii, or points of both sides")
        if of_points:
            near, far = (_six(draft, side, k) for k, side in enumerate(of_points))
        else:
            near, far = _zigzag(draft, *sides, height, spread, at)
        ends = [point(draft, each) for each in near], [point(draft, each) for each in far]
        names = numbered(prefixed(name, "wire"), 6, draft.parts_by_name)
        wires = [
            add_wire(draft, p, q, None, wire, beams, sizes)
            for p, q, wire in zip(*ends, names, strict=True)
        ]
        further = listed(draft, carries, "further points of the platform")
        parts = {f"wire {k}": each for k, each in enumerate(wires, 1)}
        return assembly_of(draft, name, parts, "platform", ends, further, mass)


def _six(draft: Draft, given: object, start: int) -> list[Point]:
    """Six ends: each of three points twice, the platform's (start 1) in turn with the base's."""
    made: list[Point] = [*listed(draft, given, "ends of wires")]
    if len(made) == 3:
        return [made[(k + 1 - start) // 2 % 3] for k in range(6)]
    if len(made) != 6:
        raise model_error(
            "bad-number", f"a hexapod with {len(made)} points on one side", "give three or six"
        )
    return made


def _zigzag(
    draft: Draft,
    base: object,
    platform: object,
    height: object,
    spread: object,
    at: Sequence[Quantity],
) -> tuple[list[Point], list[Point]]:
    """Ends of the six wires: at 0, 120, 240 degrees below, at 60, 180, 300 degrees above."""
    if height is None:
        raise model_error("bad-number", "a hexapod of two radii needs its height")
    what = "a radius or the height of a hexapod is a number"
    unit = draft.units.symbol("m")
    r, s, h = (numbers_of_size(each, (1,), what, unit)[0] for each in (base, platform, height))
    if r <= 0.0 or s <= 0.0:
        raise model_error("bad-size", "a radius of a hexapod is not positive")
    angles = numbers_of_size(spread, (1, 2), "the spread of a hexapod is one angle or two", "deg")
    beta, gamma = angles[0] / 2.0, angles[-1] / 2.0
    centre = vector(at, "centre of the base", unit)
    top = centre[0], centre[1], centre[2] + h
    near: list[Point] = [
        on_circle(centre, r, 120.0 * (k // 2) + (beta if k % 2 else -beta))
        for k in (1, 2, 3, 4, 5, 0)
    ]
    far: list[Point] = [
        on_circle(top, s, 60.0 + 120.0 * (k // 2) + (gamma if k % 2 else -gamma)) for k in range(6)
    ]
    return near, far


def assembly_of(
    draft: Draft,
    name: str,
    parts: Mapping[str, Part | FoldedSheet | Element],
    body_word: str,
    ends: tuple[Sequence[Node], Sequence[Node]],
    further: Sequence[Node] = (),
    mass: Mass = (None, None),
    inner: Mapping[str, Node] = MappingProxyType({}),
) -> Assembly:
    """The body at the far ends of flexures, and the handle of all; points get names.

    Parts are called as their words are, with the name of the assembly before them, and "2" or
    the like behind where a part of the model has this name.
    """
    own = prefixed(name, body_word)
    body_name = numbered_from(own, draft.parts_by_name)
    body = add_body(draft, [*ends[1], *further], body_name, mass)
    found: dict[str, Node] = {}
    rows = [list(dict.fromkeys(nodes)) for nodes in ends]
    for side, row in zip(("ground", body_word), rows, strict=True):
        names = numbered(prefixed(name, side), len(row), draft.points_by_name)
        for k, (node, each) in enumerate(zip(row, names, strict=True), 1):
            found[f"{side} {k}"] = node
            if not node.name:
                draft.name_node(node.position, each)
    for word, node in inner.items():
        found[word] = node
        name_point(draft, node, prefixed(name, word))
    return Assembly(name, Named({**parts, body_word: body}), Named(found), tuple(rows[0]), body)


def name_point(draft: Draft, node: Node, name: str) -> None:
    """Give a point a name where it has none, with a number where that is taken."""
    if not node.name:
        draft.name_node(node.position, numbered_from(name, draft.points_by_name))


def numbered_from(name: str, taken: Container[str]) -> str:
    """The name, or where it is taken the name with the first number from 2 that is free."""
    free = itertools.chain([name], (f"{name} {k}" for k in itertools.count(2)))
    return next(each for each in free if each not in taken)


def prefixed(name: str, word: str) -> str:
    """A word after the name of an assembly, which may be empty."""
    return f"{name} {word}" if name else word


def numbered(word: str, size: int, taken: dict[str, list[int]]) -> list[str]:
    """So many names with numbers, which go on after those in use."""
    start = 1
    while any(f"{word} {start + k}" in taken for k in range(size)):
        start += 1
    return [f"{word} {start + k}" for k in range(size)]
