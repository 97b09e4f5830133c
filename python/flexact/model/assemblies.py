# SPDX-License-Identifier: BSD-3-Clause
"""Assemblies that designers know: methods of the builder that make several parts at once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypedDict

from ..diagnostics.errors import model_error
from . import arguments
from . import point_arguments as points
from .appearance_arguments import numbers_of_size
from .arguments import Direction
from .bodies import BodyMethods
from .classes import ClassMethods
from .draft import NO_VECTOR, Vector
from .handles import Assembly, Body, FoldedSheet, Named, Node, Part
from .making import call
from .material import MaterialLike
from .point_arguments import Point
from .sheet_geometry import normal_to, span
from .transform import on_circle


class AssemblyMethods(BodyMethods, ClassMethods):
    """Methods that make folded sheets, cross hinges, parallel guides and hexapods."""

    def folded_sheet(
        self,
        a: Point,
        fold: Point,
        b: Point,
        width: Direction | None = None,
        name: str = "",
        *,
        beams: int = 1,
        section: Sequence[float] | None = None,
        thickness: float | None = None,
        breadth: float | None = None,
        material: MaterialLike | None = None,
    ) -> FoldedSheet:
        """A folded sheet: two sheets in series, which take one translation, along the fold.

        The fold can turn about itself while both ends stand still: this internal motion is
        declared, as the bending of the first leaf at the fold (section 4.2 of the paper).

        Args:
            a: One end: a point, its name, or its place (x, y, z) [m].
            fold: Where the leaves meet.
            b: The other end.
            width: Direction of the fold line; by default normal to the plane of the points.
            name: What it is called; its leaves are "name, leaf 1" and "name, leaf 2", the
                point where they meet is "name, fold".
            beams: Into how many beams each leaf is divided, see `sheet`.
            section: Breadth (along the fold line) and thickness [m].
            thickness: The thickness [m], instead of `section`.
            breadth: The size along the fold line [m], instead of `section`.
            material: See `wire`.

        Raises:
            ModelError: something of it is wrong, such as three points on a line and no width.
        """
        draft = self._change()
        with call("folded_sheet", name):
            name = arguments.text(name, "the name of a folded sheet")
            make = self._sheet_make(section, thickness, breadth, material)
            start, middle, end = (points.point(draft, each) for each in (a, fold, b))
            if width is None and not self._planar:
                arms = span(draft, middle, start), span(draft, middle, end)
                width = _across(normal_to(*arms), "the two leaves are in one plane")
            names = [f"{name}, leaf {k}" if name else "" for k in (1, 2)]
            first = self._sheet(start, middle, width, beams, names[0], make)
            second = self._sheet(middle, end, width, beams, names[1], make)
            self.independent(first, "out-of-plane bending", at="q")
            if name and not middle.name:
                draft.name_node(middle.position, points.checked_name(f"{name}, fold"))
        return FoldedSheet((first, second), (start, middle, end))

    def cross_hinge(
        self,
        ground: Iterable[Point],
        moving: Iterable[Point],
        width: Direction | None = None,
        name: str = "",
        *,
        carries: Iterable[Point] = (),
        mass: float | None = None,
        inertia: float | Sequence[float] | None = None,
        beams: int = 1,
        section: Sequence[float] | None = None,
        thickness: float | None = None,
        breadth: float | None = None,
        material: MaterialLike | None = None,
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

        Returns:
            Parts "sheet 1", ..., "body" and points "ground 1", ..., "body 1", ...
        """
        draft = self._change()
        with call("cross_hinge", name):
            near = [points.point(draft, each) for each in ground]
            far = [points.point(draft, each) for each in moving]
            if len(near) != len(far) or len(near) < 2:
                raise model_error(
                    "bad-number",
                    f"a cross hinge with {len(near)} points on the ground and {len(far)} on the "
                    "body",
                    "give as many points of the one as of the other, at least two",
                )
            if width is None and not self._planar:
                along = (span(draft, p, q) for p, q in zip(near[:2], far[:2], strict=True))
                width = _across(normal_to(*along), "the first two sheets are parallel")
            make = _Sheets(section=section, thickness=thickness, breadth=breadth, material=material)
            return self._sheets_and_body(
                (near, far), width, name, "body", carries, beams, make, mass, inertia
            )

    def parallel_guide(
        self,
        p: Point,
        q: Point,
        offset: Sequence[float],
        width: Direction | None = None,
        name: str = "",
        *,
        sheets: int = 2,
        carries: Iterable[Point] = (),
        mass: float | None = None,
        inertia: float | Sequence[float] | None = None,
        beams: int = 1,
        section: Sequence[float] | None = None,
        thickness: float | None = None,
        breadth: float | None = None,
        material: MaterialLike | None = None,
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

        Returns:
            Parts "sheet 1", ..., "stage" and points "ground 1", ..., "stage 1", ...
        """
        draft = self._change()
        with call("parallel_guide", name):
            count = arguments.whole(sheets, "the number of sheets must be a whole number")
            if count < 2:
                raise model_error("out-of-range", "a parallel guide has at least two sheets")
            step = points.place(draft, offset)
            first = points.point(draft, p), points.point(draft, q)
            if width is None and not self._planar:
                normal = normal_to(span(draft, *first), step[:3])
                width = _across(normal, "the offset is along the sheets")
            near, far = (
                [end, *(_shifted(self, end, step, k) for k in range(1, count))] for end in first
            )
            make = _Sheets(section=section, thickness=thickness, breadth=breadth, material=material)
            return self._sheets_and_body(
                (near, far), width, name, "stage", carries, beams, make, mass, inertia
            )

    def hexapod(
        self,
        base: float | Iterable[Point],
        platform: float | Iterable[Point],
        height: float | None = None,
        name: str = "",
        *,
        spread: float | Sequence[float] = 0.0,
        at: Sequence[float] = (0.0, 0.0, 0.0),
        carries: Iterable[Point] = (),
        mass: float | None = None,
        inertia: float | Sequence[float] | None = None,
        beams: int = 1,
        section: float | Sequence[float] | None = None,
        thickness: float | None = None,
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
            if isinstance(base, Iterable) or isinstance(platform, Iterable):
                if not (isinstance(base, Iterable) and isinstance(platform, Iterable)):
                    raise model_error(
                        "bad-number", "a hexapod has two radii, or points of both sides"
                    )
                near, far = _six(base, 0), _six(platform, 1)
            else:
                near, far = _zigzag(base, platform, height, spread, at)
            ends = [[points.point(draft, each) for each in side] for side in (near, far)]
            naming = _Naming(self, name)
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
            body = self.body(
                [*ends[1], *carries], naming.free("platform"), mass=mass, inertia=inertia
            )
            return naming.assembly("wire", wires, "platform", body, ends)

    def _sheets_and_body(
        self,
        ends: tuple[list[Node], list[Node]],
        width: Direction | None,
        name: str,
        body_word: str,
        carries: Iterable[Point],
        beams: int,
        sheets: _Sheets,
        mass: float | None,
        inertia: float | Sequence[float] | None,
    ) -> Assembly:
        """Sheets between two rows of points, and the body that carries the far ones."""
        naming = _Naming(self, arguments.text(name, "the name of an assembly"))
        names = naming.numbered("sheet", len(ends[0]))
        made = [
            self.sheet(p, q, width, beams, sheet, **sheets)
            for p, q, sheet in zip(*ends, names, strict=True)
        ]
        further = [points.point(self._change(), each) for each in carries]
        body = self.body([*ends[1], *further], naming.free(body_word), mass=mass, inertia=inertia)
        return naming.assembly("sheet", made, body_word, body, list(ends))


class _Sheets(TypedDict):
    """What the sheets of an assembly are made of."""

    section: Sequence[float] | None
    thickness: float | None
    breadth: float | None
    material: MaterialLike | None


class _Naming:
    """Names of the parts of an assembly: with its own name before them, and not yet in use."""

    def __init__(self, model: AssemblyMethods, name: str) -> None:
        self._draft = model._change()
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


def _across(normal: Vector, why: str) -> Vector:
    """The width that follows from the geometry.

    Raises:
        ModelError: none follows.
    """
    if normal == NO_VECTOR:
        raise model_error(
            "missing-vector", f"{why}, so that no width follows", "give width=(x, y, z)"
        )
    return normal


def _shifted(model: AssemblyMethods, node: Node, step: Sequence[float], k: int) -> Node:
    """The point k steps from this one."""
    draft = model._change()
    here = draft.node_value[node.position]
    size = 2 if draft.planar else 3
    return points.at_place(draft, [here[i] + k * step[i] for i in range(size)])


def _six(given: Iterable[Point], start: int) -> list[Point]:
    """Six ends: each of three points twice, the platform's (start 1) in turn with the base's."""
    made = list(given)
    if len(made) == 3:
        return [made[(k + 1 - start) // 2 % 3] for k in range(6)]
    if len(made) != 6:
        raise model_error(
            "bad-number", f"a hexapod with {len(made)} points on one side", "give three or six"
        )
    return made


def _zigzag(
    base: object, platform: object, height: object, spread: object, at: Sequence[float]
) -> tuple[list[Point], list[Point]]:
    """Ends of the six wires: at 0, 120, 240 degrees below, at 60, 180, 300 degrees above."""
    if height is None:
        raise model_error("bad-number", "a hexapod of two radii needs its height")
    what = "a radius or the height of a hexapod is a number"
    r, s, h = (numbers_of_size(each, (1,), what)[0] for each in (base, platform, height))
    if r <= 0.0 or s <= 0.0:
        raise model_error("bad-size", "a radius of a hexapod is not positive")
    angles = numbers_of_size(spread, (1, 2), "the spread of a hexapod is one angle or two")
    beta, gamma = angles[0] / 2.0, angles[-1] / 2.0
    centre = arguments.vector(at, "centre of the base")
    top = centre[0], centre[1], centre[2] + h
    near: list[Point] = [
        on_circle(centre, r, 120.0 * (k // 2) + (beta if k % 2 else -beta))
        for k in (1, 2, 3, 4, 5, 0)
    ]
    far: list[Point] = [
        on_circle(top, s, 60.0 + 120.0 * (k // 2) + (gamma if k % 2 else -gamma)) for k in range(6)
    ]
    return near, far
