# SPDX-License-Identifier: BSD-3-Clause
"""Designs as they come out of CAD: solids by OpenCASCADE alone, and what is true of each.

`CASES` has them by name; `CASES["cross hinge"]()` makes one, `Design.write` its STEP file. What the
counts are is said where a design is made, and `truth.counts` finds them again from lines of
constraint (`tests/python/test_cad_truth.py`). All lengths are in mm.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
from OCP.gp import gp_Trsf
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS_Shape

from . import shapes
from .shapes import box, common, cut, cylinder, fused, plate, prism, turning
from .truth import Bent, Flexure, Notch, Sheet, Truth, Vector, Wire

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)

#: Paths of names from the outermost assembly to the part, and solids.
Parts = tuple[tuple[tuple[str, ...], TopoDS_Shape], ...]


@dataclass(frozen=True)
class Design:
    """Solids, their names, and what is true of them."""

    parts: Parts
    truth: Truth
    unit: str = "MM"
    root: str = "mechanism"
    #: Assemblies that stand there once more: name, names of the first, how it is turned and put.
    copies: tuple[tuple[str, tuple[str, ...], gp_Trsf], ...] = ()

    def write(self, path: Path | str) -> Truth:
        """Write the STEP file; what is true of it."""
        shapes.write(path, self.parts, self.unit, self.root, self.copies)
        return self.truth


#: Every design by its name.
CASES: dict[str, Callable[[], Design]] = {}


def case(name: str) -> Callable[[Callable[[], Design]], Callable[[], Design]]:
    def known(make: Callable[[], Design]) -> Callable[[], Design]:
        CASES[name] = functools.cache(make)
        return make

    return known


def design(parts: Mapping[str, TopoDS_Shape], truth: Truth, **more: str) -> Design:
    """A design of parts by their names; a name "a/b" is that of part b in assembly a."""
    return Design(tuple((tuple(n.split("/")), s) for n, s in parts.items()), truth, **more)


def as_one(
    made: Design, fillets: Sequence[Vector] = (), radius: float = 0.0, unified: bool = True
) -> Design:
    """The same out of one piece, with fillets along edges that have these middles."""
    whole = fused(*(shape for _, shape in made.parts), unified=unified)
    if fillets:
        whole = shapes.filleted(whole, fillets, radius)
    return replace(made, parts=((("part",), whole),), truth=replace(made.truth, is_named=False))


def without_names(made: Design) -> Design:
    """The same where the CAD calls all parts by numbers."""
    parts = tuple(((f"Body{k}",), shape) for k, (_, shape) in enumerate(made.parts, 1))
    return replace(made, parts=parts, truth=replace(made.truth, is_named=False), root="Part1")


def turned(made: Design, *turns: gp_Trsf, shift: Vector = (0, 0, 0)) -> Design:
    """The same, turned about one axis after the other and put elsewhere."""
    whole = gp_Trsf()
    whole.SetTranslation(shapes.vector(shift))
    for turn in turns:
        whole.PreMultiply(turn)
    matrix = np.array([[whole.Value(i, j) for j in range(1, 5)] for i in range(1, 4)])

    def place(p: Vector) -> tuple[float, ...]:
        return tuple(map(float, matrix[:, :3] @ np.asarray(p, float) + matrix[:, 3]))

    def direction(d: Vector) -> tuple[float, ...]:
        return tuple(map(float, matrix[:, :3] @ np.asarray(d, float)))

    def flexure(each: Flexure) -> Flexure:
        if isinstance(each, Notch):
            return replace(each, middle=place(each.middle), axis=direction(each.axis))
        if isinstance(each, Bent):
            places = tuple(map(place, each.corners))
            return replace(each, corners=places, across=direction(each.across))
        ends = replace(each, p=place(each.p), q=place(each.q))
        if isinstance(ends, Sheet):
            return replace(ends, across=direction(ends.across))
        return ends

    truth = replace(
        made.truth,
        bodies={name: place(p) for name, p in made.truth.bodies.items()},
        flexures=tuple(map(flexure, made.truth.flexures)),
    )
    parts = tuple((names, shapes.turned(shape, whole)) for names, shape in made.parts)
    return replace(made, parts=parts, truth=truth)


def scaled(made: Design, factor: float) -> Design:
    """The same, so many times as large."""
    whole = gp_Trsf()
    whole.SetScaleFactor(factor)

    def times(values: Vector) -> tuple[float, ...]:
        return tuple(float(factor * each) for each in values)

    def flexure(each: Flexure) -> Flexure:
        if isinstance(each, Wire):
            return replace(each, p=times(each.p), q=times(each.q), sides=times(each.sides))
        thickness = factor * each.thickness
        if isinstance(each, Notch):
            sizes = {"radius": factor * each.radius, "breadth": factor * each.breadth}
            return replace(each, middle=times(each.middle), thickness=thickness, **sizes)
        if isinstance(each, Bent):
            sizes = {name: factor * getattr(each, name) for name in ("width", "radius", "length")}
            corners = tuple(map(times, each.corners))
            return replace(each, corners=corners, thickness=thickness, **sizes)
        middle = each.middle and (each.middle[0], factor * each.middle[1])
        ends = {"p": times(each.p), "q": times(each.q), "width": factor * each.width}
        return replace(each, thickness=thickness, middle=middle, **ends)

    truth = replace(
        made.truth,
        bodies={name: times(p) for name, p in made.truth.bodies.items()},
        flexures=tuple(map(flexure, made.truth.flexures)),
    )
    parts = tuple((names, shapes.turned(shape, whole)) for names, shape in made.parts)
    return replace(made, parts=parts, truth=truth)


def skewed(made: Design) -> Design:
    """Turned by 13, 47 and 71 degrees about skew axes."""
    return turned(
        made,
        turning((1, 2, 3), 13, (10, 0, 5)),
        turning((-2, 1, 1), 47, (0, 30, 0)),
        turning((1, -1, 4), 71, (-7, 3, 40)),
    )


# The parallel guide

GUIDE_WHY = (
    "Two parallel sheets hold 3 each, 6 of the 6 freedoms of the stage, which moves all the same: "
    "under by 1, over by 1 (both hold the turning about their common normal's plane)."
)


def guide_truth(
    sheets: Sequence[Sheet],
    stage: Vector = (50, 65, 15),
    base: Vector = (50, 10, 15),
    **more: object,
) -> Truth:
    bodies = {"base": base, "stage": stage}
    truth = Truth("base", bodies, tuple(sheets), motions=1, over=1, why=GUIDE_WHY)
    return replace(truth, **more)  # type: ignore[arg-type]


def guide_sheets(
    x: Sequence[float] = (20, 80),
    lengths: tuple[float, float] = (20, 60),
    thickness: float = 0.5,
    width: float = 30,
) -> list[Sheet]:
    return [
        Sheet(
            f"sheet {k}", ("base", "stage"), (each, lengths[0], 15), (each, lengths[1], 15), Z,
            width, thickness,
        )
        for k, each in enumerate(x, 1)
    ]  # fmt: skip


def solid_of(sheet: Sheet | Wire, more: float = 0.0) -> TopoDS_Shape:
    if isinstance(sheet, Wire):
        if len(sheet.sides) == 1:
            along = np.subtract(sheet.q, sheet.p) / sheet.length
            ends = np.subtract(sheet.p, more * along), np.add(sheet.q, more * along)
            return cylinder(*ends, sheet.sides[0])
        across = np.cross(np.subtract(sheet.q, sheet.p), (0.36, 0.48, 0.8))
        return plate(sheet.p, sheet.q, across, *sheet.sides, more)
    return plate(sheet.p, sheet.q, sheet.across, sheet.width, sheet.thickness, more)


def ends_of(sheets: Sequence[Sheet]) -> list[Vector]:
    """Middles of the edges at which sheets meet bodies."""
    found = []
    for each in sheets:
        normal = np.cross(np.subtract(each.q, each.p), each.across)
        half = each.thickness / 2 * normal / np.linalg.norm(normal)
        found += [np.add(end, s * half) for end in (each.p, each.q) for s in (-1, 1)]
    return found


@case("guide")
def guide() -> Design:
    """Sheets that end on the faces of base and stage, and touch them there."""
    sheets = guide_sheets()
    parts = {"base": box((0, 100), (0, 20), (0, 30)), "stage": box((0, 100), (60, 72), (0, 30))}
    parts |= {each.name: solid_of(each) for each in sheets}
    return design(parts, guide_truth(sheets))


@case("guide, in slots")
def guide_in_slots() -> Design:
    """Sheets that go 8 mm into slots of base and stage that are as wide as they are thick."""
    sheets = guide_sheets()
    long = {each.name: solid_of(each, 8) for each in sheets}
    base, stage = box((0, 100), (0, 20), (0, 30)), box((0, 100), (60, 72), (0, 30))
    parts = {"base": cut(base, *long.values()), "stage": cut(stage, *long.values()), **long}
    return design(parts, guide_truth(sheets))


@case("guide, lapped")
def guide_lapped() -> Design:
    """Sheets that lie against the sides of base and stage, 12 mm at each end."""
    sheets = guide_sheets((-0.25, 100.25))
    parts = {"base": box((0, 100), (0, 20), (0, 30)), "stage": box((0, 100), (60, 72), (0, 30))}
    parts |= {each.name: solid_of(each, 12) for each in sheets}
    return design(parts, guide_truth(sheets))


@case("guide, monolithic")
def guide_monolithic() -> Design:
    return as_one(guide())


@case("guide, monolithic with fillets")
def guide_filleted() -> Design:
    """Fillets of 0.8 mm, that is 4 % of the free length of 40 mm at each sheet."""
    made = guide()
    return as_one(made, ends_of(guide_sheets()), 0.8)


@case("guide, clamped")
def guide_clamped() -> Design:
    """Sheets between the sides and drilled plates, two M3 screws with heads through each."""
    return clamped_guide()


def screw(head: Vector, along: Vector, length: float, thread: float = 3.0) -> TopoDS_Shape:
    """A cap screw whose head begins at `head` and whose shank goes `along`."""
    along = np.asarray(along, float)
    seat = np.add(head, thread * along)
    return fused(
        cylinder(head, seat, 1.83 * thread), cylinder(seat, seat + length * along, thread),
        unified=False,
    )  # fmt: skip


def clamped_guide(name: str = "DIN 912 M3x12", clearance: float = 0.0) -> Design:
    sheets = guide_sheets((-0.25, 100.25))
    base, stage = box((0, 100), (0, 20), (0, 30)), box((0, 100), (60, 72), (0, 30))
    parts: dict[str, TopoDS_Shape] = {}
    screws, number = {}, 0
    for k, (sheet, side) in enumerate(zip(sheets, (-1, 1), strict=True), 1):
        blade = solid_of(sheet, 12)
        outside = (-0.5, 100.5)[k - 1]
        for what, y in (("base", 14.0), ("stage", 66.0)):
            clamp = box(sorted((outside, outside + 5 * side)), (y - 6, y + 6), (0, 30))
            for z in (7.0, 23.0):
                number += 1
                head = (outside + side * 8, y, z)
                bolt = screw(head, (-side, 0, 0), 12)
                hole = cylinder(
                    (outside + 6 * side, y, z), (outside - 13 * side, y, z), 3 + clearance
                )
                screws[f"screws/{name}-{number}"] = bolt
                thread = cylinder((outside, y, z), (outside - 7.5 * side, y, z), 3)
                blade, clamp = cut(blade, hole), cut(clamp, hole)
                if what == "base":
                    base = cut(base, thread)
                else:
                    stage = cut(stage, thread)
            parts[f"clamps/clamp plate {2 * k - (what == 'base')}"] = clamp
        parts[sheet.name] = blade
    return design({"base": base, "stage": stage, **parts, **screws}, guide_truth(sheets))


@case("guide, clamped, holes with clearance")
def guide_clamped_with_clearance() -> Design:
    """The holes are 0.4 mm wider than the screws, which touch the clamp plates by their heads."""
    return clamped_guide(clearance=0.4)


@case("guide, clamped, turned")
def guide_clamped_turned() -> Design:
    return skewed(guide_clamped())


@case("guide, clamped, without names")
def guide_clamped_nameless() -> Design:
    return without_names(guide_clamped())


@case("guide, filleted, turned")
def guide_filleted_turned() -> Design:
    return skewed(guide_filleted())


@case("guide, in inches")
def guide_in_inches() -> Design:
    return replace(guide_lapped(), unit="INCH")


@case("guide, in metres")
def guide_in_metres() -> Design:
    return replace(guide_clamped(), unit="M")


@case("guide, without names")
def guide_nameless() -> Design:
    return without_names(guide())


@case("guide, ground in German")
def guide_german() -> Design:
    """A light "Grundplatte", which is not the largest."""
    sheets = guide_sheets()
    parts = {"Führung/Schlitten": box((0, 100), (60, 90), (0, 30))}
    parts["Gestell/Grundplatte"] = box((0, 100), (12, 20), (0, 30))
    parts |= {f"Führung/Blattfeder {k}": solid_of(each) for k, each in enumerate(sheets, 1)}
    names = {"base": "Grundplatte", "stage": "Schlitten"}
    renamed = [
        replace(each, name=f"Blattfeder {k}", between=("Grundplatte", "Schlitten"))
        for k, each in enumerate(sheets, 1)
    ]
    bodies = {names["base"]: (50, 16, 15), names["stage"]: (50, 75, 15)}
    truth = replace(guide_truth(renamed), ground="Grundplatte", bodies=bodies)
    return design(parts, truth, root="Führung")


@case("guide, ground in Dutch")
def guide_dutch() -> Design:
    """An "onderplaat vast" that is not the largest, and bladveren."""
    made = guide_german()
    words = {
        "Schlitten": "slede", "Grundplatte": "grondplaat", "Führung": "geleiding",
        "Gestell": "gestel", "Blattfeder 1": "bladveer 1", "Blattfeder 2": "bladveer 2",
    }  # fmt: skip
    parts = tuple((tuple(words[name] for name in names), s) for names, s in made.parts)
    truth = replace(
        made.truth,
        ground="grondplaat",
        bodies={words[name]: p for name, p in made.truth.bodies.items()},
        flexures=tuple(
            replace(f, name=words[f.name], between=tuple(words[b] for b in f.between))
            for f in made.truth.flexures
        ),
    )
    return Design(parts, truth, root="rechtgeleiding")


@case("guide, one assembly twice")
def guide_twice() -> Design:
    """A sheet between clamp plates is one assembly, which stands there twice, once turned."""
    made = guide_lapped()
    parts = {names[0]: shape for names, shape in made.parts[:2]}
    parts["leaf set/blade"] = solid_of(guide_sheets((-0.25, 100.25))[0], 12)
    for n, y in enumerate((14, 66), 1):
        parts[f"leaf set/clamp {n}"] = box((-4.5, -0.5), (y - 6, y + 6), (0, 30))
    whole = design(parts, replace(made.truth, is_named=False))
    return replace(whole, copies=(("leaf set", ("leaf set",), turning(Y, 180, (50, 0, 15))),))


# The cross hinge


def cross_sheets() -> list[Sheet]:
    """One sheet in the middle, two narrower ones that cross it at its sides."""
    return [
        Sheet("left", ("base", "stage"), (5, 0, 5), (45, 40, 5), Z, 10, 0.4),
        Sheet("middle", ("base", "stage"), (45, 0, 22), (5, 40, 22), Z, 20, 0.4),
        Sheet("right", ("base", "stage"), (5, 0, 39), (45, 40, 39), Z, 10, 0.4),
    ]


@case("cross hinge")
def cross_hinge() -> Design:
    """Three sheets, cut along the faces that they touch.

    Three sheets hold 9. Those at the sides lie in one plane and hold the same 3; with the middle
    one 5 of 6 are held: a hinge, over-constrained by 9 - 5 = 4.
    """
    sheets = cross_sheets()
    parts = {"base": box((-10, 60), (-20, 0), (0, 44)), "stage": box((0, 50), (40, 55), (0, 44))}
    between = box((-50, 100), (0, 40), (-10, 60))
    parts |= {each.name: common(solid_of(each, 5), between) for each in sheets}
    bodies = {"base": (25, -10, 22), "stage": (25, 48, 22)}
    why = "9 held by three sheets, rank 5: the two at the sides are in one plane."
    return design(parts, Truth("base", bodies, tuple(sheets), motions=1, over=4, why=why))


@case("cross hinge, monolithic")
def cross_hinge_monolithic() -> Design:
    return as_one(cross_hinge())


def cross_ends() -> list[Vector]:
    """Edges of the slanted sheets at y = 0 and 40: the thickness is seen as t / cos 45."""
    half = 0.2 * np.sqrt(2)
    return [
        (end[0] + s * half, end[1], end[2])
        for each in cross_sheets()
        for end in (each.p, each.q)
        for s in (-1, 1)
    ]


@case("cross hinge, monolithic with fillets")
def cross_hinge_filleted() -> Design:
    return as_one(cross_hinge(), cross_ends(), 0.5)


@case("cross hinge, monolithic with fillets of 1.5 mm")
def cross_hinge_more_filleted() -> Design:
    """On the acute side of a slanted sheet the fillet reaches far along it: it is free there."""
    return as_one(cross_hinge(), cross_ends(), 1.5)


@case("cross hinge, turned")
def cross_hinge_turned() -> Design:
    return skewed(cross_hinge())


@case("cross hinge, monolithic, turned, in inches")
def cross_hinge_monolithic_turned() -> Design:
    return replace(skewed(cross_hinge_monolithic()), unit="INCH")


@case("cross hinge of two")
def cross_hinge_of_two() -> Design:
    """Two sheets side by side: 6 held, rank 5; a hinge, over-constrained by 1."""
    made = cross_hinge()
    parts = tuple(part for part in made.parts if part[0] != ("right",))
    truth = replace(made.truth, flexures=made.truth.flexures[:2], over=1, why="6 held, rank 5.")
    return replace(made, parts=parts, truth=truth)


# Five folded sheets


def folded_corners() -> dict[str, tuple[Vector, Vector, Vector]]:
    """End at the base, fold, end at the stage of each folded sheet."""
    return {
        "folded 1": ((60, 52, 15), (60, 12, 15), (20, 12, 15)),
        "folded 2": ((60, -52, 15), (60, -12, 15), (20, -12, 15)),
        "folded 3": ((-60, 52, 15), (-60, 12, 15), (-20, 12, 15)),
        "folded 4": ((0, 60, -32), (0, 60, 8), (0, 20, 8)),
        "folded 5": ((0, -60, -32), (0, -60, 8), (0, -20, 8)),
    }


FOLDED_WHY = (
    "Each folded sheet holds the force along its fold: three along z, two along x, of rank 5; the "
    "stage moves along y, and nothing is over-constrained. Each fold turns about itself. "
    "Soemers, Design Principles for Precision Mechanisms, 2011: a folded sheet takes one freedom."
)


def folded_truth() -> Truth:
    leaves = []
    for name, (end, fold, stage) in folded_corners().items():
        across = X if name in ("folded 4", "folded 5") else Z
        leaves.append(Sheet(f"{name}, leaf 1", ("base", name), end, fold, across, 20, 0.5))
        leaves.append(Sheet(f"{name}, leaf 2", (name, "stage"), fold, stage, across, 20, 0.5))
    bodies = {"base": (0, 0, -45), "stage": (0, 0, 10)}
    return Truth("base", bodies, tuple(leaves), motions=1, over=0, inner=5, why=FOLDED_WHY)


def folded_base() -> TopoDS_Shape:
    posts = [
        box((x - 10, x + 10), sorted((y, y + s * 12)), (-40, 30))
        for x, y, s in ((60, 52, 1), (60, -52, -1), (-60, 52, 1))
    ]
    return fused(box((-80, 80), (-80, 80), (-52, -32)), *posts)


def strip(corners: Sequence[Vector], across: Vector, width: float, thickness: float, inner: float):
    """A strip through corners; `inner` is the inside radius of its bends, 0 for sharp ones."""
    places = [np.asarray(p, float) for p in corners]
    across = np.asarray(across, float)
    steps = [(q - p) / np.linalg.norm(q - p) for p, q in itertools.pairwise(places)]
    normal = [np.cross(across, step) for step in steps]
    sides: list[list[np.ndarray]] = []
    for s in (-1, 1):
        side = [places[0] + s * thickness / 2 * normal[0]]
        for p, a, b in zip(places[1:-1], normal[:-1], normal[1:], strict=True):
            side.append(p + s * thickness / 2 * (a + b) / (1 + a @ b))
        sides.append([*side, places[-1] + s * thickness / 2 * normal[-1]])
    outline = [p - width / 2 * across for p in (*sides[0], *reversed(sides[1]))]
    whole = prism(outline, width * across)
    if not inner:
        return whole
    middle = whole
    for k, p in enumerate(places[1:-1], 1):
        a, b = normal[k - 1], normal[k]
        towards = a + b if a @ (places[k + 1] - p) > 0 else -(a + b)
        half = thickness / 2 * towards / (1 + a @ b)
        middle = shapes.filleted(middle, [p + half], inner)
        middle = shapes.filleted(middle, [p - half], inner + thickness)
    return middle


@case("five folded sheets")
def folded() -> Design:
    parts = {"base": folded_base(), "stage": box((-20, 20), (-20, 20), (-5, 30))}
    for name, corners in folded_corners().items():
        across = X if name in ("folded 4", "folded 5") else Z
        parts[name] = strip(corners, across, 20, 0.5, 0)
    return design(parts, folded_truth())


@case("five folded sheets, monolithic")
def folded_monolithic() -> Design:
    return as_one(folded())


def folded_ends() -> list[Vector]:
    """Edges at bodies alone, none at the folds."""
    return [
        end
        for k, each in enumerate(folded_truth().flexures)
        for end in (ends_of([each])[2:] if k % 2 else ends_of([each])[:2])
    ]


@case("five folded sheets, monolithic with fillets")
def folded_filleted() -> Design:
    return as_one(folded(), folded_ends(), 0.8)


@case("five folded sheets, monolithic, turned")
def folded_turned() -> Design:
    return skewed(folded_monolithic())


@case("five folded sheets, leaves apart")
def folded_of_leaves() -> Design:
    """Each folded sheet is two solids, which touch at the fold."""
    made = folded()
    parts = {names[0]: shape for names, shape in made.parts[:2]}
    for name, (end, fold, stage) in folded_corners().items():
        across = X if name in ("folded 4", "folded 5") else Z
        along = np.subtract(fold, end) / 40
        parts[f"{name}, leaf 1"] = plate(end, np.add(fold, 0.25 * along), across, 20, 0.5)
        beyond = np.subtract(stage, fold) / 40
        parts[f"{name}, leaf 2"] = plate(np.add(fold, 0.25 * beyond), stage, across, 20, 0.5)
    return design(parts, made.truth)


# Sheets bent with a radius


@case("five bent sheets")
def bent() -> Design:
    """The five folded sheets, bent by an inside radius of 2 mm: the counts are theirs."""
    made = folded()
    parts = {names[0]: shape for names, shape in made.parts[:2]}
    flexures = []
    radius = 2.25
    for name, corners in folded_corners().items():
        across = X if name in ("folded 4", "folded 5") else Z
        parts[name] = strip(corners, across, 20, 0.5, 2)
        length = 2 * (40 - radius) + np.pi / 2 * radius
        flexures.append(
            Bent(name, ("base", "stage"), corners, across, 20, 0.5, radius, float(length))
        )
    truth = replace(made.truth, flexures=tuple(flexures), inner=0)
    return design(parts, truth)


@case("five bent sheets, monolithic")
def bent_monolithic() -> Design:
    return as_one(bent())


@case("bent U")
def bent_u() -> Design:
    """Base and stage by one sheet in the shape of a U, of which nothing is said but its sizes.

    What a U holds depends on how far its bend is taken as a bend: the counts are those of a sheet
    that holds nothing, which the recogniser must say to be in doubt.
    """
    corners = ((0, 0, 10), (40, 0, 10), (40, 12, 10), (0, 12, 10))
    edges = []
    for r, back in ((6.25, False), (5.75, True)):
        y = 6 - r, 6 + r
        turn = (34, y[0], 0), (34 + r, 6, 0), (34, y[1], 0)
        ends = (0, y[0], 0), (0, y[1], 0)
        path = [shapes.line(ends[0], turn[0]), shapes.arc(*turn), shapes.line(turn[2], ends[1])]
        edges += path[::-1] if back else [*path, shapes.line(ends[1], (0, 11.75, 0))]
    edges.append(shapes.line((0, 0.25, 0), (0, -0.25, 0)))
    parts = {
        "base": box((-30, 0), (-40, 4), (0, 20)),
        "stage": box((-20, 0), (8, 24), (0, 20)),
        "U spring": shapes.swept(edges, (0, 0, 20)),
    }
    length = 2 * (40 - 6) + np.pi * 6
    flexure = Bent("U spring", ("base", "stage"), corners, Z, 20, 0.5, 6, float(length))
    bodies = {"base": (-10, -10, 10), "stage": (-10, 15, 10)}
    truth = Truth(
        "base", bodies, (flexure,), motions=6, over=0, told=("U spring",),
        why="What it holds is a matter of the model.",
    )  # fmt: skip
    return design(parts, truth)


# Reinforced sheets and plates that look like sheets


@case("guide, reinforced by plates")
def guide_reinforced() -> Design:
    """Plates of 1.5 mm on both faces of each sheet, over 0.7 of its length of 60 mm."""
    sheets = [replace(s, middle=(0.7, 3.5)) for s in guide_sheets(lengths=(20, 80))]
    parts = {"base": box((0, 100), (0, 20), (0, 30)), "stage": box((0, 100), (80, 92), (0, 30))}
    for k, each in enumerate(sheets, 1):
        parts[each.name] = solid_of(each)
        x = each.p[0]
        for n, side in enumerate((-1, 1), 1):
            faces = sorted((x + side * 0.25, x + side * 1.75))
            parts[f"stiffener {k}.{n}"] = box(faces, (29, 71), (0, 30))
    return design(parts, guide_truth(sheets, stage=(50, 85, 15)))


@case("guide, reinforced, monolithic")
def guide_reinforced_monolithic() -> Design:
    """A thick middle of 3.5 mm out of one piece with the leaves, base and stage."""
    return as_one(guide_reinforced())


@case("guide, thick stage")
def guide_thick_stage() -> Design:
    """A stage plate of 10 mm between parallel faces, 100 x 60 mm, as a sheet would be."""
    sheets = [
        replace(each, p=(each.p[0], 20, 30), q=(each.q[0], 60, 30), width=60)
        for each in guide_sheets()
    ]
    parts = {"base": box((0, 100), (8, 20), (0, 60)), "stage": box((0, 100), (60, 70), (0, 60))}
    parts |= {each.name: solid_of(each) for each in sheets}
    return design(parts, guide_truth(sheets, stage=(50, 65, 30), base=(50, 14, 30)))


@case("guide, thick stage, monolithic")
def guide_thick_stage_monolithic() -> Design:
    return as_one(guide_thick_stage())


@case("guide, stage of 3 mm")
def guide_thin_stage() -> Design:
    """A stage as thin as 3 mm between sheets of 0.3 mm."""
    sheets = guide_sheets(thickness=0.3)
    parts = {"base": box((0, 100), (0, 20), (0, 30)), "stage": box((0, 100), (60, 63), (0, 30))}
    parts |= {each.name: solid_of(each) for each in sheets}
    return design(parts, guide_truth(sheets, stage=(50, 61.5, 15)))


@case("guide, stage of 3 mm, monolithic")
def guide_thin_stage_monolithic() -> Design:
    return as_one(guide_thin_stage())


@case("guide in a frame")
def framed() -> Design:
    """A plate of 12 mm with slots: four sheets between a stage and the frame around it.

    Four sheets hold 12, of rank 5: all but the motion along their normals; over by 7.
    """
    sheets = []
    for k, (x, y) in enumerate(((-20, -20), (-20, 20), (20, -20), (20, 20)), 1):
        far = x + np.sign(x) * 40
        sheets.append(Sheet(f"sheet {k}", ("frame", "stage"), (far, y, 6), (x, y, 6), Z, 12, 0.6))
    frame = cut(box((-75, 75), (-45, 45), (0, 12)), box((-60, 60), (-30, 30), (-1, 13)))
    whole = fused(frame, box((-20, 20), (-26, 26), (0, 12)), *map(solid_of, sheets))
    bodies = {"frame": (70, 0, 6), "stage": (0, 0, 6)}
    why = "12 held by four parallel sheets, rank 5."
    truth = Truth(
        "frame", bodies, tuple(sheets), motions=1, over=7, is_named=False, why=why
    )  # fmt: skip
    return Design(((("Frame plate",), whole),), truth)


@case("compound guide, monolithic")
def compound() -> Design:
    """Two parallel guides in series: two motions, over-constrained by 1 in each."""
    outer = [
        Sheet(f"outer {k}", ("base", "link"), (x, 20, 6), (x, 70, 6), Z, 12, 0.5)
        for k, x in enumerate((10, 90), 1)
    ]
    inner = [
        Sheet(f"inner {k}", ("stage", "link"), (x, 30, 6), (x, 70, 6), Z, 12, 0.5)
        for k, x in enumerate((35, 65), 1)
    ]
    base = fused(
        box((0, 100), (0, 10), (0, 12)),
        box((0, 20), (0, 20), (0, 12)),
        box((80, 100), (0, 20), (0, 12)),
    )
    stage, link = box((28, 72), (18, 30), (0, 12)), box((5, 95), (70, 76), (0, 12))
    parts = {"base": base, "stage": stage, "link": link}
    parts |= {each.name: solid_of(each) for each in (*outer, *inner)}
    bodies = {"base": (50, 5, 6), "stage": (50, 24, 6), "link": (50, 73, 6)}
    why = "Each parallel guide has one motion and is over-constrained by 1."
    truth = Truth("base", bodies, (*outer, *inner), motions=2, over=2, why=why)
    return as_one(design(parts, truth))


# Wires


def wires(sides: tuple[float, ...]) -> list[Wire]:
    """Three along z, two along x, one along y: they hold all six freedoms, once."""
    ends = [
        ((-15, -10, -40), (-15, -10, 0)), ((15, -10, -40), (15, -10, 0)),
        ((0, 15, -40), (0, 15, 0)),
        ((60, -10, 10), (20, -10, 10)), ((60, 10, 10), (20, 10, 10)), ((0, 60, 14), (0, 20, 14)),
    ]  # fmt: skip
    return [Wire(f"wire {k}", ("base", "stage"), *each, sides) for k, each in enumerate(ends, 1)]


def wired_base() -> TopoDS_Shape:
    posts = box((60, 80), (-20, 20), (-50, 25)), box((-15, 15), (60, 80), (-50, 25))
    return fused(box((-40, 80), (-40, 80), (-60, -40)), *posts)


WIRES_WHY = "Six wires hold one force each, of rank 6: nothing moves, nothing is held twice."


def wired(sides: tuple[float, ...], inside: float) -> Design:
    found = wires(sides)
    rods = {each.name: solid_of(each, inside) for each in found}
    base, stage = wired_base(), box((-20, 20), (-20, 20), (0, 25))
    if inside:
        base, stage = cut(base, *rods.values()), cut(stage, *rods.values())
    bodies = {"base": (20, 20, -50), "stage": (3, 0, 20)}
    truth = Truth("base", bodies, tuple(found), motions=0, over=0, why=WIRES_WHY)
    return design({"base": base, "stage": stage, **rods}, truth)


@case("six wires")
def six_wires() -> Design:
    """Round wires of 0.8 mm that go 6 mm into holes of their diameter."""
    return wired((0.8,), 6)


@case("six wires, butted, turned")
def six_wires_turned() -> Design:
    return skewed(wired((0.8,), 0))


@case("six wires, monolithic")
def six_wires_monolithic() -> Design:
    return as_one(wired((0.8,), 0))


@case("six square wires, monolithic")
def six_square_wires() -> Design:
    return as_one(wired((0.7, 0.7), 0))


# Notches


@case("notch guide")
def notch_guide() -> Design:
    """A parallelogram of four circular notches in a plate of 10 mm.

    Three bodies have 18 freedoms, four notches hold 20: one motion, over by 3, as in every plane
    loop of four hinges.
    """
    return four_bar(((10, 10), (10, 60), (90, 60), (90, 10)))


@case("four-bar of notches")
def four_bar_uneven() -> Design:
    """The same with links of unequal length that are not parallel."""
    return four_bar(((15, 10), (5, 60), (70, 75), (90, 10)))


def four_bar(places: Sequence[tuple[float, float]]) -> Design:
    """Links from the first to the second and from the fourth to the third of four notches."""
    radius, neck, thick = 4.0, 0.8, 10.0
    height = 2 * radius + neck
    beyond = radius + 2
    p = [np.array(place, float) for place in places]
    solids, bores, rim = [box((-10, 110), (-30, 10 - beyond), (0, thick))], [], []
    bodies: dict[str, Vector] = {"base": (50, -12, 5)}
    for k, (low, high) in enumerate(((p[0], p[1]), (p[3], p[2])), 1):
        along = (high - low) / np.linalg.norm(high - low)
        normal = np.array([along[1], -along[0]])
        foot, head = low - (beyond + 3) * along, high + (beyond + 3) * along
        middle = ((*foot, thick / 2), (*head, thick / 2))
        solids.append(plate(*middle, Z, thick, height))
        bodies[f"link {k}"] = (*map(float, (low + high) / 2), thick / 2)
        for centre in (low, high):
            for s in (-1, 1):
                c = centre + s * height / 2 * normal
                bores.append(cylinder((*c, -1), (*c, thick + 1), 2 * radius))
        out = high + beyond * along + (-12 if k == 1 else 12) * normal
        rim += [out, out + 16 * along][:: 1 if k == 1 else -1]
    solids.append(prism([(*c, 0) for c in (rim[0], rim[3], rim[2], rim[1])], (0, 0, thick)))
    bodies["stage"] = (*map(float, np.mean(rim, axis=0)), thick / 2)
    between = (("base", "link 1"), ("link 1", "stage"), ("stage", "link 2"), ("link 2", "base"))
    notches = tuple(
        Notch(f"notch {k}", pair, (*map(float, at), thick / 2), Z, neck, radius, thick)
        for k, (pair, at) in enumerate(zip(between, p, strict=True), 1)
    )
    why = "18 freedoms of three bodies, 20 held, rank 17: one loop of parallel hinges."
    truth = Truth("base", bodies, notches, motions=1, over=3, is_named=False, why=why)
    return Design(((("notch plate",), cut(fused(*solids), *bores)),), truth)


# Assemblies with much that is bought


@case("assembly of 32 solids")
def assembly() -> Design:
    """Base, stage, two sheets, four clamp plates, eight screws, washers and nuts each.

    The screws go through clamp plate, sheet and the flanges of base and stage, to nuts behind; the
    bought parts are instances of one shape each, as CAD writes them.
    """
    sheets = guide_sheets((-0.25, 100.25))
    flanges = [[box(x, y, (0, 30)) for x in ((0, 8), (92, 100))] for y in ((8, 20), (60, 72))]
    base = fused(*flanges[0], box((0, 100), (-8, 8), (0, 30)))
    stage = fused(*flanges[1], box((0, 100), (72, 80), (0, 30)))
    bolt = screw((0, 0, 0), X, 16.5)
    washer = cut(cylinder((0, 0, 0), (0.5, 0, 0), 7), cylinder((-1, 0, 0), (1, 0, 0), 3.2))
    hexagon = [(0, 3 * np.cos(a), 3 * np.sin(a)) for a in np.radians(np.arange(0, 360, 60))]
    nut = cut(prism(hexagon, (2.4, 0, 0)), cylinder((-1, 0, 0), (4, 0, 0), 3))
    parts: dict[str, TopoDS_Shape] = {}
    bought: dict[str, TopoDS_Shape] = {}
    number = 0
    for k, (sheet, side) in enumerate(zip(sheets, (1, -1), strict=True), 1):
        blade, outside = solid_of(sheet, 12), (-0.5, 100.5)[k - 1]
        for n, y in enumerate((14.0, 66.0)):
            clamp = box(sorted((outside, outside - 5 * side)), (y - 6, y + 6), (0, 30))
            for z in (7.0, 23.0):
                number += 1
                hole = cylinder((outside - 6 * side, y, z), (outside + 10 * side, y, z), 3.2)
                blade, clamp = cut(blade, hole), cut(clamp, hole)
                base, stage = (base, cut(stage, hole)) if n else (cut(base, hole), stage)
                for words, part, x in (
                    ("ISO 4762 M3x16", bolt, -9.0),
                    ("ISO 7089 washer 3", washer, -6.0),
                    ("ISO 4032 nut M3", nut, 8.0),
                ):
                    turn = gp_Trsf() if side > 0 else turning(Z, 180)
                    turn.SetTranslationPart(shapes.vector((x if side > 0 else 100 - x, y, z)))
                    bought[f"fasteners/{words}:{number}"] = part.Located(TopLoc_Location(turn))
            parts[f"guide/clamp plate {2 * k - 1 + n}"] = clamp
        parts[f"guide/{sheet.name}"] = blade
    parts = {"fixed/base": base, "guide/stage": stage, **parts, **bought}
    truth = guide_truth(sheets, base=(50, 0, 15), stage=(50, 76, 15))
    return design(parts, truth, root="linear guide")


@case("assembly of 32 solids, turned, without names")
def assembly_turned() -> Design:
    return without_names(skewed(assembly()))


@case("folded sheets between clamps")
def folded_clamped() -> Design:
    """The five folded sheets, each in a clamp with a dowel and a screw at both ends: 37 solids."""
    made = folded()
    base, stage = made.parts[0][1], made.parts[1][1]
    parts: dict[str, TopoDS_Shape] = {}
    for name, corners in folded_corners().items():
        across = np.asarray(X if name in ("folded 4", "folded 5") else Z)
        end, fold, top = (np.asarray(p, float) for p in corners)
        # The sheet goes on for 10 mm at both ends; what it meets there gives way on one side.
        beyond = [end + (end - fold) / 4, fold, top + (top - fold) / 4]
        blade = strip(beyond, across, 20, 0.5, 0)
        for what, (p, along) in {
            "base": (end, (end - fold) / 40), "stage": (top, (top - fold) / 40)
        }.items():  # fmt: skip
            normal = np.cross(along, across)
            if normal @ (np.asarray((0, 0, 0)) - p) > 0:
                normal = -normal
            slot = plate(p, p + 10 * along, across, 20, 0.5)
            room = plate(p + 2.25 * normal, p + 2.25 * normal + 10 * along, across, 20, 4)
            body = cut(base if what == "base" else stage, slot, room)
            clamp = room
            for k, (kind, size) in enumerate((("M2.5x8 screw", 2.5), ("dowel 2x10", 2.0))):
                at = p + 5 * along + (6 - 12 * k) * across
                shank = cylinder(at + 4.25 * normal, at - 4 * normal, size)
                clamp, blade, body = cut(clamp, shank), cut(blade, shank), cut(body, shank)
                if k == 0:
                    head = cylinder(at + 4.25 * normal, at + 6.25 * normal, 4.5)
                    free = cylinder(at + 4.25 * normal, at + 30 * normal, 5)
                    body = cut(body, free)
                    shank = fused(head, shank)
                parts[f"{name}/{kind} {what}"] = shank
            parts[f"{name}/clamp {what}"] = clamp
            base, stage = (body, stage) if what == "base" else (base, body)
        parts[f"{name}/{name}"] = blade
    parts = {"base": base, "stage": stage, **parts}
    return design(parts, made.truth)


# Solids as translators and habits leave them


@case("guide, split faces")
def guide_split() -> Design:
    """Each sheet of two halves along its length that are one solid, its faces not made one."""
    sheets = guide_sheets()
    made = guide()
    parts = {names[0]: shape for names, shape in made.parts[:2]}
    for each in sheets:
        halves = [
            plate((each.p[0], y[0], 15), (each.p[0], y[1], 15), Z, 30, 0.5)
            for y in ((20, 33), (33, 60))
        ]
        parts[each.name] = fused(*halves, unified=False)
    return design(parts, made.truth)


@case("guide, split faces, monolithic")
def guide_split_monolithic() -> Design:
    return as_one(guide_split(), unified=False)


@case("guide, stage of two solids")
def guide_two_solids() -> Design:
    """The stage is a rail below a block, which touch; base and a foot likewise."""
    made = guide()
    parts = {names[0]: shape for names, shape in made.parts if names[0] != "stage"}
    parts["stage"] = box((0, 100), (60, 66), (0, 30))
    parts["stage block"] = box((20, 80), (66, 90), (0, 30))
    parts["foot"] = box((-20, 120), (-12, 0), (-10, 40))
    return design(parts, made.truth)


@case("guide, sheets with holes where they are clamped")
def guide_holed() -> Design:
    """Lapped sheets with two holes of 4 mm at each end, and nothing in them."""
    made = guide_lapped()
    parts = {names[0]: shape for names, shape in made.parts}
    for each in guide_sheets((-0.25, 100.25)):
        x = each.p[0]
        bores = [
            cylinder((x - 2, y, z), (x + 2, y, z), 4) for y in (14.0, 66.0) for z in (7.0, 23.0)
        ]
        parts[each.name] = cut(parts[each.name], *bores)
    return design(parts, made.truth)


@case("guide, unequal sheets")
def guide_unequal() -> Design:
    """Sheets of 40 and 52 mm: the stage turns as it moves, and the counts are those of a guide."""
    sheets = guide_sheets()
    sheets[1] = replace(sheets[1], q=(80, 72, 15))
    stage = fused(box((0, 70), (60, 84), (0, 30)), box((70, 100), (72, 84), (0, 30)))
    parts = {"base": box((0, 100), (0, 20), (0, 30)), "stage": stage}
    parts |= {each.name: solid_of(each) for each in sheets}
    return design(parts, guide_truth(sheets, stage=(50, 78, 15)))


@case("guide, gap of 0.01 mm")
def guide_gap() -> Design:
    """Between the second sheet and the stage there is a gap of 0.01 mm: they are meant to touch."""
    made = guide()
    parts = {names[0]: shape for names, shape in made.parts}
    parts["sheet 2"] = plate((80, 20, 15), (80, 59.99, 15), Z, 30, 0.5)
    return design(parts, made.truth)


@case("guide, overlap of 0.05 mm")
def guide_overlap() -> Design:
    """The second sheet goes 0.05 mm into the stage."""
    made = guide()
    parts = {names[0]: shape for names, shape in made.parts}
    parts["sheet 2"] = plate((80, 20, 15), (80, 60.05, 15), Z, 30, 0.5)
    return design(parts, made.truth)


@case("guide, a body that hangs on nothing")
def guide_loose() -> Design:
    made = guide()
    parts = {names[0]: shape for names, shape in made.parts}
    parts["cover"] = box((0, 100), (100, 103), (0, 30))
    truth = replace(
        made.truth,
        bodies={**made.truth.bodies, "cover": (50, 101.5, 15)},
        told=("cover",),
        loose=("cover",),
    )
    return design(parts, truth)


@case("guide, two grounds")
def guide_two_grounds() -> Design:
    """Each sheet on a base of its own: both are named as ground."""
    sheets = guide_sheets()
    named = [replace(s, between=(f"base {k}", "stage")) for k, s in enumerate(sheets, 1)]
    parts = {f"base {k}": box(x, (0, 20), (0, 30)) for k, x in ((1, (0, 40)), (2, (60, 100)))}
    parts["stage"] = box((0, 100), (60, 72), (0, 30))
    parts |= {each.name: solid_of(each) for each in sheets}
    bodies = {"base 1": (30, 10, 15), "base 2": (70, 10, 15), "stage": (50, 65, 15)}
    truth = Truth(
        "base 1", bodies, tuple(named), motions=1, over=1, more_grounds=("base 2",), why=GUIDE_WHY
    )
    return design(parts, truth)


@case("guide, a sheet from the stage to itself")
def guide_loop() -> Design:
    """A third sheet between two arms of the stage: it holds 3 that nothing asks of it.

    The guide is over-constrained by 1, the sheet by all that it holds, 3.
    """
    made = guide()
    parts = {names[0]: shape for names, shape in made.parts if names[0] != "stage"}
    arms = [box(x, (60, 100), (0, 30)) for x in ((0, 30), (70, 100))]
    parts["stage"] = fused(*arms, box((0, 100), (60, 72), (0, 30)))
    loop = Sheet("cross sheet", ("stage", "stage"), (30, 90, 15), (70, 90, 15), Z, 30, 0.5)
    parts[loop.name] = solid_of(loop)
    truth = replace(made.truth, flexures=(*made.truth.flexures, loop), over=4)
    return design(parts, truth)


@case("guide, nothing says what stands still")
def guide_small_base() -> Design:
    """The larger body moves, and no name tells: `--ground` or a choice has to."""
    made = guide_german()
    parts = {("A", "Schlitten")[0] if n[-1] == "Schlitten" else n[-1]: s for n, s in made.parts}
    parts = {("B" if n == "Grundplatte" else n): s for n, s in parts.items()}
    truth = replace(
        made.truth,
        ground="B",
        bodies={"B": (50, 16, 15), "A": (50, 75, 15)},
        flexures=tuple(replace(f, between=("B", "A")) for f in made.truth.flexures),
        must_name_ground=True,
    )
    return design(parts, truth)


# What is thin and neither sheet nor wire


def wavy_strip() -> TopoDS_Shape:
    """A strip whose outline is by splines, as of a water jet, 12 mm high, about 0.6 mm thick."""
    wave = [0 if k in (0, 8) else k % 3 for k in range(9)]
    sides = [[(30 + d + x, 20 + 5 * k, 0) for k, x in enumerate(wave)] for d in (0.0, 0.6)]
    edges = [
        shapes.spline(sides[0]),
        shapes.line(sides[0][-1], sides[1][-1]),
        shapes.spline(sides[1][::-1]),
        shapes.line(sides[1][0], sides[0][0]),
    ]
    return shapes.swept(edges, (0, 0, 12))


@case("guide with a part by a water jet")
def guide_water_jet() -> Design:
    """Between base and stage besides the sheets a thin part whose outline is two splines.

    It is no sheet: it becomes a body, which ties the stage to the base, and is told. Without it the
    counts are those of the guide; what is asked here is that it is told.
    """
    made = guide()
    parts = {names[0]: shape for names, shape in made.parts}
    parts["jet part"] = wavy_strip()
    truth = replace(made.truth, told=("jet part",), motions=-1, over=-1)
    return design(parts, truth)


@case("guide with a free-form part")
def guide_free_form() -> Design:
    """The same with a surface by B-splines that is curved both ways, 0.5 mm thick."""
    made = guide()
    parts = {names[0]: shape for names, shape in made.parts}
    surface = shapes.spline_surface(
        [
            [(45 + 4 * np.sin(k / 2) * np.cos(n / 2) * (0 < k < 6), 20 + k * 40 / 6, 5 + 4 * n)
             for n in range(6)]
            for k in range(7)
        ]
    )  # fmt: skip
    face = BRepBuilderAPI_MakeFace(surface, 1e-6).Face()
    parts["spring foil"] = BRepPrimAPI_MakePrism(face, shapes.vector((0.5, 0, 0))).Shape()
    truth = replace(made.truth, told=("spring foil",), motions=-1, over=-1)
    return design(parts, truth)


# What lies about in real assemblies


@case("cartwheel")
def cartwheel() -> Design:
    """Two sheets that cross in one plane, out of one piece with base and stage.

    Four half sheets meet in the middle, where they have a piece of material of their own. Four hold
    12 of the 12 freedoms of stage and middle. Both halves of a pair are in one plane; the middle
    turns about its axis while both ends stand, and the stage turns about it: 2 motions, over by 2.
    """
    corner = 20.0
    ends = {
        "half 1": ("base", (-corner, 0, 6)), "half 2": ("base", (corner, 0, 6)),
        "half 3": ("stage", (corner, 2 * corner, 6)), "half 4": ("stage", (-corner, 2 * corner, 6)),
    }  # fmt: skip
    middle = (0, corner, 6)
    halves = [
        Sheet(name, (body, "middle"), end, middle, Z, 12, 0.5) for name, (body, end) in ends.items()
    ]
    between = box((-50, 50), (0, 2 * corner), (-1, 13))
    blades = [common(plate(halves[k].p, halves[k + 2].p, Z, 12, 0.5, 3), between) for k in (0, 1)]
    base, stage = box((-30, 30), (-15, 0), (0, 12)), box((-28, 28), (40, 50), (0, 12))
    bodies = {"base": (0, -8, 6), "stage": (0, 45, 6), "middle": middle}
    truth = Truth(
        "base", bodies, tuple(halves), motions=2, over=2,
        why="12 held of 12 freedoms, rank 10.",
    )  # fmt: skip
    return as_one(design({"base": base, "stage": stage, "a": blades[0], "b": blades[1]}, truth))


@case("guide in a frame, fillets at all corners")
def framed_filleted() -> Design:
    """As milled: every inner corner has a fillet of 1 mm."""
    made = framed()
    (shape,) = (shape for _, shape in made.parts)
    fillets = ends_of([f for f in made.truth.flexures if isinstance(f, Sheet)])
    corners = [(x, y, 6) for x in (-60, 60) for y in (-30, 30)]
    whole = shapes.filleted(shape, [*fillets, *corners], 1.0)
    return replace(made, parts=((("Frame plate",), whole),))


@case("trapezoid guide")
def trapezoid() -> Design:
    """Two sheets that lean towards each other: the stage turns about where they meet."""
    ends = (((20, 20, 15), (30, 60, 15)), ((80, 20, 15), (70, 60, 15)))
    sheets = [
        Sheet(f"sheet {k}", ("base", "stage"), p, q, Z, 30, 0.5) for k, (p, q) in enumerate(ends, 1)
    ]
    between = box((-50, 200), (20, 60), (-1, 40))
    parts = {"base": box((0, 100), (0, 20), (0, 30)), "stage": box((10, 90), (60, 72), (0, 30))}
    parts |= {each.name: common(solid_of(each, 3), between) for each in sheets}
    return design(parts, guide_truth(sheets))


@case("guide, sheets wider where they are clamped")
def guide_dog_bone() -> Design:
    """Lapped sheets of 16 mm between clamped ends of 30 mm."""
    made = guide_lapped()
    parts = {names[0]: shape for names, shape in made.parts}
    sheets = [replace(each, width=16) for each in guide_sheets((-0.25, 100.25))]
    for each in sheets:
        x = each.p[0]
        ends = [box((x - 0.25, x + 0.25), y, (0, 30)) for y in ((8, 20), (60, 72))]
        parts[each.name] = fused(solid_of(each, 1), *ends)
    return design(parts, guide_truth(sheets))


@case("guide, sandwiched")
def guide_sandwiched() -> Design:
    """Each end of a sheet between two plates, of which the inner one stands on base or stage."""
    sheets = guide_sheets()
    parts = {"base": box((0, 100), (0, 10), (0, 30)), "stage": box((0, 100), (70, 80), (0, 30))}
    for k, each in enumerate(sheets, 1):
        x = each.p[0]
        parts[each.name] = solid_of(each, 10)
        for n, y in enumerate(((10, 20), (60, 70)), 1):
            for side, letter in ((-1, "a"), (1, "b")):
                faces = sorted((x + side * 0.25, x + side * 5.25))
                parts[f"jaw {k}.{n}{letter}"] = box(faces, y, (0, 30))
    return design(parts, guide_truth(sheets, base=(50, 5, 15), stage=(50, 75, 15)))


@case("guide, with a shim, a cover and a flag")
def guide_with_thin_parts() -> Design:
    """Thin parts that are no flexures: a shim below the base, a plate flat on it, a flag.

    The shim of 0.2 mm lies between base and foot over all its face; the cover of 1 mm lies on a
    side of the base; the flag of 0.5 mm stands on the stage by one end, and its other end is free.
    """
    made = guide()
    parts = {names[0]: shape for names, shape in made.parts}
    parts["shim"] = box((0, 100), (-0.2, 0), (0, 30))
    parts["foot"] = box((0, 100), (-6.2, -0.2), (0, 30))
    parts["cover"] = box((0, 100), (2, 18), (30, 31))
    parts["flag"] = box((49.75, 50.25), (72, 102), (5, 25))
    return design(parts, made.truth)


@case("guide on a thin-walled housing")
def guide_on_housing() -> Design:
    """The base is a box of 2 mm walls, open above: its walls lie between parallel faces too."""
    sheets = [
        replace(s, p=(s.p[0], 20, 15), q=(s.q[0], 60, 15)) for s in guide_sheets(thickness=0.3)
    ]
    shell = cut(box((0, 100), (-30, 20), (0, 30)), box((2, 98), (-28, 18), (2, 31)))
    parts = {"housing": shell, "stage": box((0, 100), (60, 72), (0, 30))}
    parts |= {each.name: solid_of(each) for each in sheets}
    renamed = [replace(each, between=("housing", "stage")) for each in sheets]
    bodies = {"housing": (50, -5, 1), "stage": (50, 65, 15)}
    truth = replace(guide_truth(renamed), ground="housing", bodies=bodies)
    return design(parts, truth)


@case("guide, stiffened on one side")
def guide_stiffened() -> Design:
    """A plate of 2 mm on one face of each sheet alone."""
    sheets = [replace(s, middle=(0.7, 2.5)) for s in guide_sheets(lengths=(20, 80))]
    parts = {"base": box((0, 100), (0, 20), (0, 30)), "stage": box((0, 100), (80, 92), (0, 30))}
    for k, each in enumerate(sheets, 1):
        x = each.p[0]
        parts[each.name] = solid_of(each)
        parts[f"stiffener {k}"] = box((x + 0.25, x + 2.25), (29, 71), (0, 30))
    return design(parts, guide_truth(sheets, stage=(50, 85, 15)))


@case("guide, names as CAD gives them")
def guide_cad_names() -> Design:
    """Names with suffixes and numbers of instances, and an assembly of the same name as a part."""
    made = guide_lapped()
    words = {
        "base": "Baseplate.SLDPRT",
        "stage": "stage <2>",
        "sheet 1": "Leaf-1",
        "sheet 2": "Leaf-2",
    }
    parts = tuple(((f"{words[n[0]]}", words[n[0]]), shape) for n, shape in made.parts)
    names = {"base": words["base"], "stage": words["stage"]}
    truth = replace(
        made.truth,
        ground=names["base"],
        bodies={names[name]: place for name, place in made.truth.bodies.items()},
        flexures=tuple(
            replace(each, name=words[each.name], between=tuple(names[b] for b in each.between))
            for each in made.truth.flexures
        ),
    )
    return Design(parts, truth, root="Assembly1.SLDASM")


@case("six wires with fillets, monolithic")
def six_wires_filleted() -> Design:
    """Round wires of 0.8 mm with fillets of 0.5 mm at both ends."""
    made = wired((0.8,), 0)
    whole = as_one(made)
    (shape,) = (shape for _, shape in whole.parts)
    ends = [end for each in made.truth.flexures for end in (each.p, each.q)]  # type: ignore[union-attr]
    filleted = shapes.filleted(shape, ends, 0.5)
    return replace(whole, parts=((("part",), filleted),))


@case("guide, reinforced, monolithic with fillets")
def guide_reinforced_filleted() -> Design:
    """Fillets of 0.8 mm at base and stage and at both ends of each thick middle of 3.5 mm."""
    return links_filleted(0.7, 3.5, 0.8)


@case("guide of links with flat hinges")
def guide_of_links() -> Design:
    """Links of 10 mm between hinges of 8 mm with fillets of 2 mm: 2 of their 8 mm on each side."""
    return links_filleted(44 / 60, 10, 2)


def links_filleted(share: float, thick: float, radius: float) -> Design:
    sheets = [replace(s, middle=(share, thick)) for s in guide_sheets(lengths=(20, 80))]
    parts = {"base": box((0, 100), (0, 20), (0, 30)), "stage": box((0, 100), (80, 92), (0, 30))}
    near, far = 50 - 30 * share, 50 + 30 * share
    edges = ends_of(sheets)
    for k, each in enumerate(sheets, 1):
        x = each.p[0]
        parts[each.name] = solid_of(each)
        parts[f"middle {k}"] = box((x - thick / 2, x + thick / 2), (near, far), (0, 30))
        edges += [(x + s * each.thickness / 2, y, 15) for s in (-1, 1) for y in (near, far)]
    return as_one(design(parts, guide_truth(sheets, stage=(50, 85, 15))), edges, radius)


@case("guide with a sheet like a shell")
def guide_shell() -> Design:
    """Besides the sheets a piece of a thin cylinder from end to end: it must be told."""
    made = guide()
    parts = {names[0]: shape for names, shape in made.parts}
    outline = [
        shapes.arc((50, 20, 0), (56, 40, 0), (50, 60, 0)),
        shapes.line((50, 60, 0), (50.5, 60, 0)),
        shapes.arc((50.5, 60, 0), (56.5, 40, 0), (50.5, 20, 0)),
        shapes.line((50.5, 20, 0), (50, 20, 0)),
    ]
    parts["shell"] = shapes.swept(outline, (0, 0, 30))
    return design(parts, replace(made.truth, told=("shell",), motions=-1, over=-1))


@case("guide, glued")
def guide_glued() -> Design:
    """Gaps of 0.05 mm at both ends of each sheet, as for glue: what joins them must be told."""
    made = guide()
    parts = {names[0]: shape for names, shape in made.parts}
    parts["base"] = box((0, 100), (0, 19.95), (0, 30))
    parts["stage"] = box((0, 100), (60.05, 72), (0, 30))
    return design(parts, replace(made.truth, told=("sheet 1", "sheet 2")))


@case("guide with end stops")
def guide_with_stops() -> Design:
    """Stops that stand on the base, 0.1 and 0.03 mm from the stage, which they do not touch."""
    made = guide()
    parts = {names[0]: shape for names, shape in made.parts}
    parts["stop left"] = box((-12.1, -0.1), (0, 72), (5, 25))
    parts["stop right"] = box((100.03, 112), (0, 72), (5, 25))
    # They stand on a foot below the base.
    parts["foot"] = box((-20, 120), (-10, 0), (0, 30))
    return design(parts, made.truth)


@case("guide with a coil spring")
def guide_with_spring() -> Design:
    """A helical spring of 1 mm wire between base and stage, which is no flexure of these: told."""
    made = guide()
    parts = {names[0]: shape for names, shape in made.parts}
    parts["pressure spring"] = shapes.coil((50, 20.5, 15), 8, 1, 39, 6)
    return design(parts, replace(made.truth, told=("pressure spring",), motions=-1, over=-1))


@case("guide with a micrometer")
def guide_with_micrometer() -> Design:
    """Its ball touches the stage in a point, which holds nothing that a drawing shows: told."""
    made = guide()
    parts = {names[0]: shape for names, shape in made.parts}
    parts["bracket"] = fused(box((100, 130), (0, 20), (0, 30)), box((118, 130), (20, 80), (0, 30)))
    spindle = fused(cylinder((118, 66, 15), (103, 66, 15), 6), shapes.ball((103, 66, 15), 3))
    parts["micrometer"] = spindle
    truth = replace(made.truth, told=("micrometer",))
    return design(parts, truth)


@case("stage with all that belongs to it")
def real_stage() -> Design:
    """A base of two plates, a stage of two, reinforced sheets in jaws, stops, a coil, a cover.

    34 solids: sheets between jaws with two screws each, of which one jaw stands on base or stage;
    stiffeners on both faces; a stop with 0.2 mm of room; magnet and coil with 0.5 mm between them;
    a cover that stands on the base by four columns.
    """
    sheets = [
        replace(s, middle=(0.6, 4.5))
        for s in guide_sheets((30, 130), lengths=(30, 80), width=40, thickness=0.4)
    ]
    sheets = [replace(s, p=(s.p[0], 30, 20), q=(s.q[0], 80, 20)) for s in sheets]
    parts: dict[str, TopoDS_Shape] = {
        "base/base plate": box((0, 160), (0, 12), (-10, 50)),
        "base/foot plate": box((-10, 170), (-8, 0), (-20, 60)),
        "stage/carriage": box((0, 160), (98, 106), (0, 40)),
        "stage/table": box((20, 140), (106, 114), (-10, 50)),
    }
    screws: dict[str, TopoDS_Shape] = {}
    for k, each in enumerate(sheets, 1):
        x = each.p[0]
        blade = plate((x, 14, 20), (x, 96, 20), Z, 40, 0.4)
        for what, y in (("base", (12, 30)), ("stage", (80, 98))):
            jaws = [box(sorted((x + s * 0.2, x + s * 8.2)), y, (0, 40)) for s in (-1, 1)]
            for n, z in enumerate((8, 32), 1):
                middle = sum(y) / 2
                hole = cylinder((x - 9, middle, z), (x + 9, middle, z), 3)
                blade, jaws = cut(blade, hole), [cut(jaw, hole) for jaw in jaws]
                bolt = fused(cylinder((x + 8.2, middle, z), (x + 11.2, middle, z), 5.5), hole)
                trimmed = common(bolt, box((x - 8.2, x + 12), (0, 120), (-20, 60)))
                screws[f"screws/ISO 4762 M3x16 {k}{what}{n}"] = trimmed
            for jaw, side in zip(jaws, ("inner", "outer"), strict=True):
                parts[f"{what}/jaw {side} {k} {what}"] = jaw
        parts[f"flexures/{each.name}"] = blade
        for s in (-1, 1):
            faces = sorted((x + s * 0.2, x + s * 2.25))
            parts[f"flexures/stiffener {k}{'ab'[s > 0]}"] = box(faces, (40, 70), (0, 40))
    parts["base/stop"] = box((60, 70), (12, 97.8), (10, 30))
    parts["base/magnet"] = cylinder((100, 12, 20), (100, 60, 20), 20)
    ring = cut(
        cylinder((100, 40, 20), (100, 98, 20), 30), cylinder((100, 39, 20), (100, 99, 20), 21)
    )
    parts["stage/coil"] = ring
    for n, (x, z) in enumerate(((-5, -15), (165, -15), (-5, 55), (165, 55)), 1):
        parts[f"cover/column {n}"] = cylinder((x, 0, z), (x, 125, z), 6)
    parts["cover/cover"] = box((-10, 170), (125, 127), (-20, 60))
    bodies = {"foot plate": (80, -4, 20), "carriage": (80, 102, 20)}
    renamed = [replace(each, between=("foot plate", "carriage")) for each in sheets]
    truth = Truth(
        "foot plate", bodies, tuple(renamed), motions=1, over=1, is_named=False, why=GUIDE_WHY
    )
    return design({**parts, **screws}, truth, root="stage")


def slot(p: tuple[float, float], q: tuple[float, float], wide: float, thick: float) -> TopoDS_Shape:
    """What a wire takes away on its way from p to q through a plate, with round ends."""
    way = plate((*p, thick / 2), (*q, thick / 2), Z, thick + 2, wide)
    ends = (cylinder((*c, -1), (*c, thick + 1), wide) for c in (p, q))
    return fused(way, *ends)


@case("notch guide cut by a wire")
def notch_guide_by_wire() -> Design:
    """Four notches between bores in a plate, whose parts slots of 1 mm keep apart."""
    radius, neck, thick, off = 4.0, 0.8, 10.0, 4.4
    tools = [
        cylinder((x + s * off, y, -1), (x + s * off, y, thick + 1), 2 * radius)
        for x in (20, 100)
        for y in (20, 60)
        for s in (-1, 1)
    ]
    for x in (20 - off, 20 + off, 100 - off, 100 + off):
        tools.append(slot((x, 20), (x, 60), 1, thick))
    tools.append(slot((20 + off, 20), (100 - off, 20), 1, thick))
    for x, edge in ((20 - off, -2), (100 + off, 122)):
        tools.append(slot((x, 60), (edge, 60), 1, thick))
    whole = cut(box((0, 120), (0, 80), (0, thick)), *tools)
    bodies = {
        "base": (60, 8, 5), "stage": (60, 40, 5), "link 1": (20, 40, 5), "link 2": (100, 40, 5),
    }  # fmt: skip
    ends = (("base", "link 1", 20, 20), ("link 1", "stage", 20, 60), ("base", "link 2", 100, 20))
    notches = tuple(
        Notch(f"notch {k}", (a, b), (x, y, 5), Z, neck, radius, thick)
        for k, (a, b, x, y) in enumerate((*ends, ("link 2", "stage", 100, 60)), 1)
    )
    why = "As of the notch guide: one loop of parallel hinges."
    truth = Truth("base", bodies, notches, motions=1, over=3, is_named=False, why=why)
    # The stage with its inner block is the larger one.
    return Design(((("plate",), whole),), replace(truth, ground="stage"))


@case("guide cut by a wire")
def guide_by_wire() -> Design:
    """Two sheets of 0.5 mm between slots of 1 mm in a plate: what is left of it is base and stage.

    The stage is the block between the sheets with the bar above; the base goes around below.
    """
    thick = 10.0
    tools = []
    sheets = []
    for k, (x, s) in enumerate(((20, -1), (100, 1)), 1):
        # A slot on both sides of each sheet, from y = 20 to 60 between the middles of their ends.
        for side in (-1, 1):
            tools.append(slot((x + side * 0.75, 20.5), (x + side * 0.75, 59.5), 1, thick))
        tools.append(slot((x + s * 0.75, 59.5), (x + s * 30, 59.5), 1, thick))
        sheets.append(Sheet(f"sheet {k}", ("base", "stage"), (x, 20, 5), (x, 60, 5), Z, thick, 0.5))
    tools.append(slot((20.75, 20.5), (99.25, 20.5), 1, thick))
    whole = cut(box((0, 120), (0, 80), (0, thick)), *tools)
    bodies = {"base": (60, 8, 5), "stage": (60, 40, 5)}
    truth = Truth("stage", bodies, tuple(sheets), motions=1, over=1, is_named=False, why=GUIDE_WHY)
    return Design(((("plate",), whole),), truth)


@case("five folded sheets, rounded inside")
def folded_inside() -> Design:
    """Folds that are sharp outside and have a radius of 0.5 mm inside, as of a wire."""
    made = folded()
    parts = {names[0]: shape for names, shape in made.parts[:2]}
    for name, corners in folded_corners().items():
        across = X if name in ("folded 4", "folded 5") else Z
        end, fold, stage = (np.asarray(corner, float) for corner in corners)
        inside = (end - fold) / 40 + (stage - fold) / 40
        sharp = strip(corners, across, 20, 0.5, 0)
        parts[name] = shapes.filleted(sharp, [fold + 0.25 * inside], 0.5)
    return as_one(design(parts, made.truth))


@case("guide, tapered sheets")
def guide_tapered() -> Design:
    """Sheets of 0.5 mm at the base and 0.3 mm at the stage: no parallel planes, so told."""
    made = guide()
    parts = {names[0]: shape for names, shape in made.parts}
    for k, x in enumerate((20, 80), 1):
        outline = [(x - 0.25, 20, 0), (x + 0.25, 20, 0), (x + 0.15, 60, 0), (x - 0.15, 60, 0)]
        parts[f"sheet {k}"] = prism(outline, (0, 0, 30))
    told = ("sheet 1", "sheet 2")
    return design(parts, replace(made.truth, told=told, motions=-1, over=-1))


@case("guide, sheets in packs")
def guide_of_packs() -> Design:
    """Each sheet is two that lie on each other: what a pack holds is told to be in doubt."""
    made = guide_lapped()
    parts = {names[0]: shape for names, shape in made.parts}
    for k, (x, s) in enumerate(((-0.5, -1), (100.5, 1)), 1):
        parts[f"sheet {k} again"] = box(sorted((x, x + 0.5 * s)), (8, 72), (0, 30))
    told = ("sheet 1", "sheet 2")
    return design(parts, replace(made.truth, told=told, motions=-1, over=-1))


@case("guide, monolithic with chamfers")
def guide_chamfered() -> Design:
    """Chamfers of 0.8 mm in the place of fillets: they belong to the free length likewise."""
    made = as_one(guide())
    ((names, shape),) = made.parts
    return replace(made, parts=((names, shapes.chamfered(shape, ends_of(guide_sheets()), 0.8)),))


def radial_sheets() -> list[Sheet]:
    angles = np.radians((0, 120, 240))
    return [
        Sheet(
            f"spoke {k}", ("ring", "hub"), (40 * np.cos(a), 40 * np.sin(a), 6),
            (10 * np.cos(a), 10 * np.sin(a), 6), Z, 12, 0.5,
        )
        for k, a in enumerate(angles, 1)
    ]  # fmt: skip


@case("hub on three spokes")
def hub() -> Design:
    """Sheets from a round hub to a ring: a hinge, over by 4, as of each spoke 3 are held.

    9 held, of rank 5: all but the turning about the axis of the hub.
    """
    sheets = radial_sheets()
    core = cylinder((0, 0, 0), (0, 0, 12), 20)
    ring = cut(cylinder((0, 0, 0), (0, 0, 12), 100), cylinder((0, 0, -1), (0, 0, 13), 80))
    between = cut(cylinder((0, 0, 0), (0, 0, 12), 80), core)
    parts = {"ring": ring, "hub": core}
    parts |= {each.name: common(solid_of(each, 1), between) for each in sheets}
    bodies = {"ring": (0, 45, 6), "hub": (0, 0, 6)}
    why = "9 held by three sheets, rank 5."
    return design(parts, Truth("ring", bodies, tuple(sheets), motions=1, over=4, why=why))


@case("hub on three spokes, monolithic")
def hub_monolithic() -> Design:
    return as_one(hub())


@case("six struts with thin ends")
def six_struts() -> Design:
    """Wires of 0.8 mm, 8 mm long, at both ends of rods of 4 mm: each holds what a wire holds."""
    made = wired((0.8,), 0)
    parts = {names[0]: shape for names, shape in made.parts}
    for each in wires((0.8,)):
        p, q = np.asarray(each.p, float), np.asarray(each.q, float)
        along = (q - p) / each.length
        parts[each.name] = fused(parts[each.name], cylinder(p + 8 * along, q - 8 * along, 4))
    bent = tuple(replace(each, middle=8.0) for each in made.truth.flexures)
    return design(parts, replace(made.truth, flexures=bent))
