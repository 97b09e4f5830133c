# SPDX-License-Identifier: BSD-3-Clause
"""Assemblies of sheets and a body: methods that make cross hinges and parallel guides."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypedDict

from ..deck.rendering import model_error
from ..util.quantities import Quantity
from . import selection as arguments
from . import selection as points
from .bodies import FoldedSheetMethods, across
from .copying import on_circle
from .draft import Draft
from .elements import call
from .flexures import normal_to, span
from .handles import Assembly, Body, Named, Node, Part
from .sections import MaterialLike
from .selection import Direction, Point, numbers_of_size


class AssemblyNames:
    """Names of the parts of an assembly: with its own name before them, and not yet in use."""

    def __init__(self, draft: Draft, name: str) -> None:
        """Of an assembly in this model, whose name may be empty."""
        self._draft = draft
        self._name = name

    def free(self, word: str) -> str:
        """The name of a single part."""
        name = f"{self._name} {word}" if self._name else word
        return next(each for each in _variants(name) if each not in self._draft.parts_by_name)

    def numbered(self, word: str, count: int) -> list[str]:
        """Names of some parts, with numbers that go on after those in use."""
        return self._numbers(self.prefixed(word), count, self._draft.parts_by_name)

    def prefixed(self, word: str) -> str:
        """A word after the name of the assembly."""
        return f"{self._name} {word}" if self._name else word

    @staticmethod
    def _numbers(word: str, count: int, taken: dict[str, list[int]]) -> list[str]:
        start = 1
        while any(f"{word} {start + k}" in taken for k in range(count)):
            start += 1
        return [f"{word} {start + k}" for k in range(count)]

    def assembly(
        self,
        word: str,
        flexures: Sequence[Part],
        body_word: str,
        body: Body,
        ends: list[list[Node]],
    ) -> Assembly:
        """The handle of what was made; points that have no name get one."""
        parts: dict[str, Part] = {f"{word} {k}": each for k, each in enumerate(flexures, 1)}
        parts[body_word] = body
        found: dict[str, Node] = {}
        rows = []
        for side, nodes in zip(("ground", body_word), ends, strict=True):
            row = list(dict.fromkeys(nodes))
            rows.append(row)
            names = self._numbers(self.prefixed(side), len(row), self._draft.points_by_name)
            for k, (node, name) in enumerate(zip(row, names, strict=True), 1):
                found[f"{side} {k}"] = node
                if not node.name:
                    self._draft.name_node(node.position, name)
        return Assembly(self._name, Named(parts), Named(found), tuple(rows[0]), body)


def _variants(name: str) -> Iterable[str]:
    yield name
    k = 2
    while True:
        yield f"{name} {k}"
        k += 1


#: Of one guide.
_MOST_SHEETS = 1000


class SheetAssemblyMethods(FoldedSheetMethods):
    """Methods that make cross hinges and parallel guides."""

    def cross_hinge(
        self,
        ground: Iterable[Point],
        moving: Iterable[Point],
        width: Direction | None = None,
        name: str = "",
        *,
        carries: Iterable[Point] = (),
        mass: Quantity | None = None,
        inertia: Quantity | Sequence[Quantity] | None = None,
        beams: int = 1,
        section: Sequence[Quantity] | None = None,
        thickness: Quantity | None = None,
        breadth: Quantity | None = None,
        material: MaterialLike | None = None,
        warping: bool | float = False,
    ) -> Assembly:
        """A cross hinge: two, three or more sheets that cross, and the body that they carry.

        The k-th sheet goes from the k-th point of `ground` to the k-th of `moving`. The body
        turns about the line in which the sheets cross. Nothing is clamped: say
        `fix(*hinge.ground)`, or give the points to a body.

        Args:
            ground: Points on the near side, one a sheet.
            moving: Points on the body, one a sheet.
            width: Direction of the width of the sheets, which is that of the axis; by default
                normal to the first two sheets.
            name: What it is called: its parts are "name sheet 1", ..., "name body".
            carries: Further points of the body.
            mass: Of the body [kg], at its first point, see `body`.
            inertia: Of the body, see `body`.
            beams: Into how many beams each sheet is divided.
            section: Breadth and thickness of the sheets [m].
            thickness: The thickness [m], instead of `section`.
            breadth: The size along the axis [m], instead of `section`.
            material: See `wire`.
            warping: See `sheet`.

        Returns:
            Parts "sheet 1", ..., "body" and points "ground 1", ..., "body 1", ...
        """
        draft = self._change()
        with call("cross_hinge", name):
            near = [
                points.point(draft, p) for p in arguments.several(ground, "points of the ground")
            ]
            far = points.listed(draft, moving, "points of the body")
            if len(near) != len(far) or len(near) < 2:
                raise model_error(
                    "bad-number",
                    f"a cross hinge with {len(near)} points on the ground and {len(far)} on the "
                    "body",
                    "give as many points of the one as of the other, at least two",
                )
            if width is None and not self._planar:
                along = (span(draft, p, q) for p, q in zip(near[:2], far[:2], strict=True))
                width = across(normal_to(*along), "the first two sheets are parallel")
            make = _Sheets(
                section=section,
                thickness=thickness,
                breadth=breadth,
                material=material,
                warping=warping,
            )
            return self._sheets_and_body(
                (near, far), width, name, "body", carries, beams, make, mass, inertia
            )

    def parallel_guide(
        self,
        p: Point,
        q: Point,
        offset: Sequence[Quantity],
        width: Direction | None = None,
        name: str = "",
        *,
        sheets: int = 2,
        carries: Iterable[Point] = (),
        mass: Quantity | None = None,
        inertia: Quantity | Sequence[Quantity] | None = None,
        beams: int = 1,
        section: Sequence[Quantity] | None = None,
        thickness: Quantity | None = None,
        breadth: Quantity | None = None,
        material: MaterialLike | None = None,
        warping: bool | float = False,
    ) -> Assembly:
        """A parallel guide: equal sheets side by side, and the stage that they carry.

        The stage moves along the normal of the sheets. Nothing is clamped: say
        `fix(*guide.ground)`, or give the points to a body.

        Args:
            p: The near end of the first sheet: a point, its name, or its place [m].
            q: Its end on the stage.
            offset: From each sheet to the next, (x, y, z) [m].
            width: Direction of the width; by default normal to the sheet and the offset.
            name: What it is called: its parts are "name sheet 1", ..., "name stage".
            sheets: How many sheets there are, two or more.
            carries: Further points of the stage.
            mass: Of the stage [kg], see `body`.
            inertia: Of the stage, see `body`.
            beams: Into how many beams each sheet is divided.
            section: Breadth and thickness of the sheets [m].
            thickness: The thickness [m], instead of `section`.
            breadth: The size along the width [m], instead of `section`.
            material: See `wire`.
            warping: See `sheet`.

        Returns:
            Parts "sheet 1", ..., "stage" and points "ground 1", ..., "stage 1", ...
        """
        draft = self._change()
        with call("parallel_guide", name):
            count = arguments.count(sheets, 2, _MOST_SHEETS, "sheets")
            step = points.place(draft, offset)
            first = points.point(draft, p), points.point(draft, q)
            if width is None and not self._planar:
                normal = normal_to(span(draft, *first), step[:3])
                width = across(normal, "the offset is along the sheets")
            near, far = (
                [end, *(_shifted(draft, end, step, k) for k in range(1, count))] for end in first
            )
            make = _Sheets(
                section=section,
                thickness=thickness,
                breadth=breadth,
                material=material,
                warping=warping,
            )
            return self._sheets_and_body(
                (near, far), width, name, "stage", carries, beams, make, mass, inertia
            )

    def _sheets_and_body(
        self,
        ends: tuple[list[Node], list[Node]],
        width: Direction | None,
        name: str,
        body_word: str,
        carries: Iterable[Point],
        beams: int,
        sheets: _Sheets,
        mass: Quantity | None,
        inertia: Quantity | Sequence[Quantity] | None,
    ) -> Assembly:
        """Sheets between two rows of points, and the body that carries the far ones."""
        naming = AssemblyNames(self._change(), arguments.text(name, "the name of an assembly"))
        names = naming.numbered("sheet", len(ends[0]))
        made = [
            self.sheet(p, q, width, beams, sheet, **sheets)
            for p, q, sheet in zip(*ends, names, strict=True)
        ]
        further = points.listed(self._change(), carries, "further points of the body")
        body = self.body([*ends[1], *further], naming.free(body_word), mass=mass, inertia=inertia)
        return naming.assembly("sheet", made, body_word, body, list(ends))


class _Sheets(TypedDict):
    """What the sheets of an assembly are made of."""

    section: Sequence[Quantity] | None
    thickness: Quantity | None
    breadth: Quantity | None
    material: MaterialLike | None
    warping: bool | float


def _shifted(draft: Draft, node: Node, step: Sequence[float], k: int) -> Node:
    """The point k steps from this one."""
    here = draft.node_value[node.position]
    size = 2 if draft.planar else 3
    return points.at_place(draft, [here[i] + k * step[i] for i in range(size)])


class HexapodMethods(SheetAssemblyMethods):
    """The method that makes hexapods."""

    def hexapod(
        self,
        base: Quantity | Iterable[Point],
        platform: Quantity | Iterable[Point],
        height: Quantity | None = None,
        name: str = "",
        *,
        spread: Quantity | Sequence[Quantity] = 0.0,
        at: Sequence[Quantity] = (0.0, 0.0, 0.0),
        carries: Iterable[Point] = (),
        mass: Quantity | None = None,
        inertia: Quantity | Sequence[Quantity] | None = None,
        beams: int = 1,
        section: Quantity | Sequence[Quantity] | None = None,
        thickness: Quantity | None = None,
        material: MaterialLike | None = None,
    ) -> Assembly:
        """A hexapod: six wires that hold a platform once in each of its six motions.

        With radii the wires zigzag about the z axis: their base ends lie in pairs at 0, 120
        and 240 degrees, their platform ends at 60, 180 and 300 degrees. Nothing is clamped:
        say `fix(*hexapod.ground)`.

        Args:
            base: Radius of the base ends [m], or six points (three: each for two wires).
            platform: Radius of the platform ends [m], or six points, or three.
            height: From the base to the platform [m], with radii.
            name: What it is called: its parts are "name wire 1", ..., "name platform".
            spread: Angle between the two wires of a pair [degrees], with radii; of the base
                and of the platform where two are given.
            at: Centre of the base [m], with radii.
            carries: Further points of the platform.
            mass: Of the platform [kg], see `body`.
            inertia: Of the platform, see `body`.
            beams: Into how many beams each wire is divided.
            section: How the wires are drawn, as a rule their diameter [m].
            thickness: The diameter [m], instead of `section`.
            material: See `wire`.

        Returns:
            Parts "wire 1", ..., "wire 6", "platform" and points "ground 1", ..., "platform 1", ...
        """
        draft = self._change()
        with call("hexapod", name):
            name = arguments.text(name, "the name of a hexapod")
            sides = (base, platform)
            of_points = [s for s in sides if isinstance(s, Iterable) and not isinstance(s, str)]
            if of_points:
                if len(of_points) < 2:
                    raise model_error(
                        "bad-number", "a hexapod has two radii, or points of both sides"
                    )
                near, far = _six(draft, of_points[0], 0), _six(draft, of_points[1], 1)
            else:
                near, far = _zigzag(base, platform, height, spread, at)
            ends = [[points.point(draft, each) for each in side] for side in (near, far)]
            naming = AssemblyNames(self._change(), name)
            names = naming.numbered("wire", 6)
            wires = [
                self.wire(
                    p,
                    q,
                    name=wire,
                    beams=beams,
                    section=section,
                    thickness=thickness,
                    material=material,
                )
                for p, q, wire in zip(*ends, names, strict=True)
            ]
            further = points.listed(draft, carries, "further points of the platform")
            body = self.body(
                [*ends[1], *further], naming.free("platform"), mass=mass, inertia=inertia
            )
            return naming.assembly("wire", wires, "platform", body, ends)


def _six(draft: Draft, given: object, start: int) -> list[Point]:
    """Six ends: each of three points twice, the platform's (start 1) in turn with the base's."""
    made: list[Point] = [*points.listed(draft, given, "ends of wires")]
    if len(made) == 3:
        return [made[(k + 1 - start) // 2 % 3] for k in range(6)]
    if len(made) != 6:
        raise model_error(
            "bad-number", f"a hexapod with {len(made)} points on one side", "give three or six"
        )
    return made


def _zigzag(
    base: object, platform: object, height: object, spread: object, at: Sequence[Quantity]
) -> tuple[list[Point], list[Point]]:
    """Ends of the six wires: at 0, 120, 240 degrees below, at 60, 180, 300 degrees above."""
    if height is None:
        raise model_error("bad-number", "a hexapod of two radii needs its height")
    what = "a radius or the height of a hexapod is a number"
    r, s, h = (numbers_of_size(each, (1,), what, "m")[0] for each in (base, platform, height))
    if r <= 0.0 or s <= 0.0:
        raise model_error("bad-size", "a radius of a hexapod is not positive")
    angles = numbers_of_size(spread, (1, 2), "the spread of a hexapod is one angle or two", "deg")
    beta, gamma = angles[0] / 2.0, angles[-1] / 2.0
    centre = arguments.vector(at, "centre of the base", "m")
    top = centre[0], centre[1], centre[2] + h
    near: list[Point] = [
        on_circle(centre, r, 120.0 * (k // 2) + (beta if k % 2 else -beta))
        for k in (1, 2, 3, 4, 5, 0)
    ]
    far: list[Point] = [
        on_circle(top, s, 60.0 + 120.0 * (k // 2) + (gamma if k % 2 else -gamma)) for k in range(6)
    ]
    return near, far
