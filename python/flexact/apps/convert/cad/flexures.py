# SPDX-License-Identifier: BSD-3-Clause
"""Thin parts of solids: walls between parallel faces, round wires, necks between two bores.

Loaded in the child process alone. A wall is what two parallel faces have in common, seen along
their normal, without what other solids clamp. It is a flexure where material goes on at two of its
ends and at no other place: free length is what lies between.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from OCP.TopoDS import TopoDS_Shape

from ....core.arrays import FloatArray
from . import brep
from .assembly import Kind
from .brep import NEAR, PARALLEL, Face, Part, are_parallel, unit, without

#: A wall is at least so many thicknesses long.
LEAST_SLENDER = 4.0
#: A wall with fillets at both ends that is no longer than so many thicknesses is a notch.
NOTCH = 12.0
#: A sheet is at least so many thicknesses broad; what is narrower is a wire.
SHEET = 5.0
#: The widest gap that is filled with glue [mm].
GLUED = 0.25
#: Share of a clamp that may be holes, which screws fill.
_HOLES = 0.3


@dataclass(eq=False)
class Thin:
    """A thin part of a solid that may be a flexure.

    Attributes:
        part: Row of its solid.
        kind: What it would be.
        p: Middle of one end, where the nominal flexure ends.
        q: Middle of the other one.
        cuts: Middles of both cross-sections at which it is cut from what it is fastened to.
        width: From edge to edge; of a notch along its axis.
        normal: Across the thickness.
        breadth: Along the width.
        thickness: At the thinnest.
        span: From where to where the cuts go along the width, from the line of middles.
        outline: Of its mid plane (n, 3).
        radius: Of a notch, or of the fillets of a sheet.
        contour: See `Flexure`.
        doubts: What is odd in its shape.
        why: Why it is taken as a flexure or as a body, where that is in doubt.
    """

    part: int
    kind: Kind
    p: FloatArray
    q: FloatArray
    cuts: tuple[FloatArray, ...]
    width: FloatArray
    normal: FloatArray
    breadth: float
    thickness: float
    span: tuple[float, float]
    outline: FloatArray
    radius: float = 0.0
    contour: str = ""
    doubts: list[str] = field(default_factory=list)
    why: list[str] = field(default_factory=list)

    @property
    def length(self) -> float:
        """Free length."""
        return float(np.linalg.norm(self.q - self.p))

    @property
    def axis(self) -> FloatArray:
        """From p to q."""
        return unit(self.q - self.p)

    @property
    def middle(self) -> FloatArray:
        """The middle between its ends."""
        made: FloatArray = np.asarray((self.p + self.q) / 2.0)
        return made

    @property
    def bending(self) -> float:
        """Stiffness against bending, without the modulus."""
        return self.breadth * self.thickness**3 / self.length**3

    def has(self, place: FloatArray, more: float = 0.0) -> bool:
        """Whether a place is within it."""
        x, y, z = (float((place - self.middle) @ d) for d in (self.axis, self.width, self.normal))
        half = np.array([self.length, self.breadth, self.thickness]) / 2 + more + NEAR
        return bool(abs(x) <= half[0] and abs(y) <= half[1] and abs(z) <= half[2])


@dataclass(eq=False)
class Scene:
    """All solids of an assembly, and simple ones in place of those that are purchased."""

    parts: list[Part]
    stand_ins: dict[int, Part]

    def near(self, box: FloatArray, but: int) -> list[int]:
        """Rows of other solids that have something in a box."""
        return [
            k
            for k, part in enumerate(self.parts)
            if k != but and brep.boxes_meet(self.shown(k).box, box)
        ]

    def shown(self, row: int) -> Part:
        """The solid, or what stands in for it."""
        return self.stand_ins.get(row, self.parts[row])

    def where(self, place: FloatArray, rows: Sequence[int]) -> int | None:
        """Which of some solids has a place in it."""
        return next((k for k in rows if self.shown(k).holds(place)), None)


# Walls between parallel planes


@dataclass(eq=False)
class _Plane:
    """The faces of a solid in one plane that look the same way."""

    at: FloatArray
    normal: FloatArray
    rows: list[int]
    corners: FloatArray


def _planes(part: Part) -> list[_Plane]:
    found: list[_Plane] = []
    for row, face in enumerate(part.faces):
        if face.kind != "plane":
            continue
        ends = [part.edges[k].places for k in face.edges]
        corners = np.concatenate(ends) if ends else face.box
        for plane in found:
            if (
                float(plane.normal @ face.axis) > 0.5
                and are_parallel(plane.normal, face.axis)
                and abs((face.at - plane.at) @ plane.normal) < NEAR
            ):
                plane.rows.append(row)
                plane.corners = np.concatenate([plane.corners, corners])
                break
        else:
            found.append(_Plane(face.at, face.axis, [row], corners))
    return found


@dataclass(eq=False)
class Region:
    """What two parallel planes of a solid have in common, seen along their normal.

    Attributes:
        part: Row of the solid.
        face: In the middle between both.
        planes: Both.
        thickness: Their distance.
        extent: Diagonal of its box.
    """

    part: int
    face: TopoDS_Shape
    planes: tuple[_Plane, _Plane]
    thickness: float
    extent: float


def regions(scene: Scene, row: int) -> list[Region]:
    """Where a solid may have walls."""
    part = scene.parts[row]
    found = []
    for a, b in itertools.combinations(_planes(part), 2):
        if float(a.normal @ b.normal) > -0.5 or not are_parallel(a.normal, b.normal):
            continue
        thickness = float((a.at - b.at) @ a.normal)
        if thickness < NEAR or _overlap(a, b) < LEAST_SLENDER * thickness:
            continue
        half = thickness / 2 * a.normal
        # Seen from far away a plane may be a little off; moved by its distance both are one.
        top = [brep.moved(part.faces[k].shape, -half) for k in a.rows]
        shift = float((a.at - half - b.at) @ a.normal)
        bottom = [brep.moved(part.faces[k].shape, shift * a.normal) for k in b.rows]
        for face in brep.common(top, bottom):
            extent = _extent(face)
            if extent >= LEAST_SLENDER * thickness:
                found.append(Region(row, face, (a, b), thickness, extent))
    return found


def walls(scene: Scene, found: Sequence[Region]) -> list[Thin]:
    """The walls in some regions that may be sheets or bars, the thinnest first.

    Once slender ones are found, what is much thicker and not slender is not looked at.
    """
    made: list[Thin] = []
    least = 0.0
    for region in sorted(found, key=lambda each: each.thickness):
        if least and region.thickness > 8 * least and region.extent < 40 * region.thickness:
            continue
        new = _walls_of(scene, region, [thin for thin in made if thin.part == region.part])
        made += new
        if not least and any(t.contour != "web" and t.length > 20 * t.thickness for t in new):
            least = region.thickness
    return made


def _overlap(a: _Plane, b: _Plane) -> float:
    """The diagonal of what the boxes of two planes have in common, at most."""
    u = brep.across(a.normal)
    frame = np.array([u, np.cross(a.normal, u)])
    one, other = a.corners @ frame.T, b.corners @ frame.T
    sides = np.minimum(one.max(0), other.max(0)) - np.maximum(one.min(0), other.min(0))
    return float(np.linalg.norm(sides)) if sides.min() > 0 else 0.0


def _extent(face: TopoDS_Shape) -> float:
    box = brep.box_of(face)
    return float(np.linalg.norm(box[1] - box[0]))


def _walls_of(scene: Scene, region: Region, before: Sequence[Thin]) -> list[Thin]:
    """The walls in one region; those of thinner walls are passed over.

    Where nothing holds a slender one, it may be glued: then a wider gap counts.
    """
    made = _free_walls(scene, region, before, min(0.02, 0.05 * region.thickness))
    if made or region.extent < 15 * region.thickness:
        return made
    made = _free_walls(scene, region, before, min(GLUED, 0.5 * region.thickness))
    return made


def _free_walls(
    scene: Scene, region: Region, before: Sequence[Thin], gap: float
) -> list[Thin]:
    """The walls in one region, where what is no further away than a gap holds it."""
    row, thickness, normal = region.part, region.thickness, region.planes[0].normal
    part = scene.parts[row]
    step = max(0.05 * thickness, gap)
    box = brep.box_of(region.face, thickness / 2 + 2 * gap)
    others = scene.near(box, row)
    levels = [side * (thickness / 2 + gap) * normal for side in (0.0, -1.0, 1.0)]
    clamps: list[TopoDS_Shape] = []
    for level in levels if others else ():
        for clamp in _held(scene, brep.moved(region.face, level), normal, others):
            clamps.append(brep.filled(brep.moved(clamp, -level), _HOLES))

    def is_held(place: FloatArray) -> bool:
        return any(scene.where(place + level, others) is not None for level in levels)

    def goes_on(place: FloatArray) -> bool:
        return part.holds(place) or is_held(place)

    found = []
    for face in without([region.face], clamps) if clamps else [region.face]:
        if _extent(face) < LEAST_SLENDER * thickness or brep.area_of(face) < thickness**2:
            continue
        outline = _Outline(brep.loops(face), normal)
        inner = outline.samples()
        if any(thin.has(place) for thin in before for place in inner[:1]):
            continue
        if np.mean([part.holds(place) for place in inner]) < 0.75:
            continue
        chains = outline.chains(goes_on, step, thickness / 2)
        if len(chains) == 2:
            made = _wall(part, row, outline, chains, thickness, region.planes, is_held)
            if made is not None:
                found.append(made)
            elif region.extent > 15 * thickness:
                found.append(_web(row, outline, thickness, "it is fastened all around"))
        elif len(chains) > 2:
            found.append(_web(row, outline, thickness, f"it is fastened at {len(chains)} places"))
    return found


def _held(
    scene: Scene, face: TopoDS_Shape, normal: FloatArray, others: Sequence[int]
) -> list[TopoDS_Shape]:
    """What of a plane face lies in other solids."""
    box = brep.box_of(face, NEAR)
    at = brep.corner(face)
    cuts = []
    for row in others:
        part = scene.shown(row)
        for each in part.faces:
            if not brep.boxes_meet(each.box, box):
                continue
            if each.kind == "plane":
                levels = [(part.edges[k].ends - at) @ normal for k in each.edges]
                straight = all(part.edges[k].kind == "line" for k in each.edges)
                if are_parallel(each.axis, normal, 1e-6) or (
                    straight and (np.min(levels) > NEAR or np.max(levels) < -NEAR)
                ):
                    continue
            cuts.append(each.shape)
    made = []
    for piece in brep.split_face(face, cuts) if cuts else [face]:
        inner = _Outline(brep.loops(piece), normal).samples(3)[0]
        if scene.where(inner, others) is not None:
            made.append(piece)
    return made


#: Of an outline: from, to, and whether it is straight.
_Segment = tuple[FloatArray, FloatArray]


class _Outline:
    """The outline of a plane region, as straight pieces in order."""

    def __init__(self, wires: list[list[FloatArray]], normal: FloatArray) -> None:
        """Of the wires of a face."""
        self.wires = wires
        self.normal = normal
        self.u = brep.across(normal)
        self.v = np.cross(normal, self.u)
        self.at = wires[0][0][0]
        rings = [np.concatenate([edge[:-1] for edge in wire]) for wire in wires]
        self.rings = rings
        starts = [self._flat(ring) for ring in rings]
        self._starts = np.concatenate(starts)
        self._ends = np.concatenate([np.roll(each, -1, axis=0) for each in starts])

    def _flat(self, places: FloatArray) -> FloatArray:
        return np.asarray((places - self.at) @ np.array([self.u, self.v]).T)

    def has(self, places: FloatArray) -> np.ndarray:
        """Whether places (n, 3) of the plane are inside."""
        flat = self._flat(places)[:, None, :]
        a, b = self._starts[None], self._ends[None]
        crosses = (a[..., 1] > flat[..., 1]) != (b[..., 1] > flat[..., 1])
        with np.errstate(divide="ignore", invalid="ignore"):
            slope = (b[..., 0] - a[..., 0]) / (b[..., 1] - a[..., 1])
            beyond = flat[..., 0] < a[..., 0] + slope * (flat[..., 1] - a[..., 1])
        return np.asarray(np.count_nonzero(crosses & beyond, axis=1) % 2 == 1)

    def samples(self, count: int = 5) -> FloatArray:
        """Places inside, that nearest to the centre first."""
        low, high = self._starts.min(0), self._starts.max(0)
        for n in (count, 4 * count, 16 * count):
            steps = (np.arange(n) + 0.5) / n
            grid = low + np.stack(np.meshgrid(steps, steps), -1).reshape(-1, 2) * (high - low)
            places = self.at + grid @ np.array([self.u, self.v])
            inside = places[self.has(places)]
            if len(inside) > 2:
                away = np.linalg.norm(inside - inside.mean(0), axis=1)
                return np.asarray(inside[np.argsort(away)][: count**2])
        return np.asarray([self.rings[0].mean(0)])

    def area(
        self, low: float, high: float, axis: FloatArray, at: FloatArray, *, holes: bool = True
    ) -> float:
        """Area between two distances from a place along an axis, with or without holes."""
        total = 0.0
        side = np.cross(self.normal, axis)
        for k, ring in enumerate(self.rings if holes else self.rings[:1]):
            flat = np.stack([(ring - at) @ axis, (ring - at) @ side], 1)
            flat = _clipped(_clipped(flat, low, 1.0), high, -1.0)
            x, y = flat[:, 0], flat[:, 1]
            area = abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2
            total += area if k == 0 else -area
        return total

    def chains(
        self, goes_on: Callable[[FloatArray], bool], step: float, least: float
    ) -> list[list[_Segment]]:
        """Pieces of the outline, in a row, beyond which material goes on."""
        found: list[list[_Segment]] = []
        for wire in self.wires:
            pieces: list[tuple[FloatArray, FloatArray, bool]] = []
            for edge in wire:
                for a, b in itertools.pairwise(edge):
                    if np.linalg.norm(b - a) > NEAR:
                        pieces += self._flagged(a, b, goes_on, step, len(edge) == 2)
            if not pieces:
                continue
            flags = [flag for *_, flag in pieces]
            if not any(flags):
                continue
            first = next((k for k in range(len(flags)) if flags[k] and not flags[k - 1]), 0)
            turned = pieces[first:] + pieces[:first]
            for flag, group in itertools.groupby(turned, key=lambda piece: piece[2]):
                chain = [(a, b) for a, b, _ in group]
                if flag and sum(float(np.linalg.norm(b - a)) for a, b in chain) > least:
                    found.append(chain)
        return found

    def _flagged(
        self,
        a: FloatArray,
        b: FloatArray,
        goes_on: Callable[[FloatArray], bool],
        step: float,
        straight: bool,
    ) -> list[tuple[FloatArray, FloatArray, bool]]:
        along = unit(b - a)
        out = np.cross(along, self.normal)
        middle = (a + b) / 2
        if self.has((middle + min(step, 1e-3) * out)[None])[0]:
            out = -out

        def there(share: float) -> bool:
            return goes_on(a + share * (b - a) + step * out)

        if not straight:
            return [(a, b, there(0.5))]
        shares = [(k + 0.5) / 9 for k in range(9)]
        flags = [there(share) for share in shares]
        borders, kept = [0.0], [flags[0]]
        for k in range(8):
            if flags[k] != flags[k + 1]:
                low, high = shares[k], shares[k + 1]
                for _ in range(24):
                    half = (low + high) / 2
                    low, high = (half, high) if there(half) == flags[k] else (low, half)
                borders.append((low + high) / 2)
                kept.append(flags[k + 1])
        borders.append(1.0)
        return [
            (a + low * (b - a) if low else a, a + high * (b - a) if high < 1 else b, flag)
            for low, high, flag in zip(borders, borders[1:], kept, strict=False)
        ]


def _clipped(ring: FloatArray, level: float, sign: float) -> FloatArray:
    """What of a polygon (n, 2) has its first coordinate above a level, or below."""
    made = []
    for a, b in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        da, db = sign * (a[0] - level), sign * (b[0] - level)
        if da >= 0:
            made.append(a)
        if (da >= 0) != (db >= 0):
            made.append(a + (b - a) * da / (da - db))
    return np.array(made) if made else np.zeros((1, 2))


def _web(row: int, outline: _Outline, thickness: float, words: str) -> Thin:
    """A wall that is not fastened at two ends: no flexure that is known."""
    ring = outline.rings[0]
    flat = ring @ np.array([outline.u, outline.v]).T
    low, high = flat.min(0), flat.max(0)
    middle = outline.samples()[0]
    half = (high - low) / 2
    k = int(np.argmax(half))
    axis, width = (outline.u, outline.v) if k == 0 else (outline.v, outline.u)
    p, q = middle - half[k] * axis, middle + half[k] * axis
    breadth = 2 * float(half[1 - k])
    return Thin(
        *(row, Kind.SHEET, p, q, (), width, outline.normal, breadth, thickness),
        *((0.0, 0.0), ring, 0.0, "web", [words]),
    )


def _front(
    chain: list[_Segment], axis: FloatArray, normal: FloatArray
) -> tuple[FloatArray, FloatArray, float] | None:
    """Of an end: its middle, the direction of its edge, how far it goes; `axis` goes to the other.

    Pieces in one line are one; the longest that lies across the axis is the front.
    """
    runs: list[tuple[FloatArray, FloatArray]] = []
    for a, b in chain:
        if runs and are_parallel(unit(runs[-1][1] - runs[-1][0]), unit(b - a), 1e-6):
            runs[-1] = (runs[-1][0], b)
        else:
            runs.append((a, b))
    places = np.array([place for run in runs for place in run])
    side = np.cross(normal, axis)
    spread = np.ptp(places @ side)
    lengths = [abs(float((b - a) @ side)) for a, b in runs]
    best = int(np.argmax(lengths))
    ahead = float((places @ axis).max())
    if lengths[best] < 0.45 * spread:
        top = places[int(np.argmax(places @ axis))]
        middle = top + side * float(places @ side @ np.ones(len(places)) / len(places) - top @ side)
        return middle, side, float(spread)
    a, b = runs[best]
    middle, direction = (a + b) / 2, unit(b - a)
    behind = ahead - float(max(a @ axis, b @ axis))
    if behind > NEAR:
        middle = middle + behind * axis
    return middle, direction, float(np.linalg.norm(b - a))


def _wall(
    part: Part,
    row: int,
    outline: _Outline,
    chains: list[list[_Segment]],
    thickness: float,
    planes: tuple[_Plane, _Plane],
    is_held: Callable[[FloatArray], bool],
) -> Thin | None:
    """A wall that is fastened at two ends."""
    normal = outline.normal
    centres = [np.mean([(x + y) / 2 for x, y in chain], axis=0) for chain in chains]
    away = centres[1] - centres[0]
    if np.linalg.norm(away) < NEAR:
        return None
    axis = unit(away)
    for _ in range(3):
        fronts = [_front(chains[0], axis, normal), _front(chains[1], -axis, normal)]
        if fronts[0] is None or fronts[1] is None:
            return None
        (m0, d0, b0), (m1, d1, b1) = fronts
        if float(d0 @ d1) < 0:
            d1 = -d1
        width = unit(b0 * d0 + b1 * d1)
        straight = np.cross(width, normal)
        straight = straight if straight @ axis > 0 else -straight
        if np.linalg.norm(straight - axis) < 1e-9:
            break
        axis = straight
    doubts = []
    skew = m1 - m0 - (m1 - m0) @ axis * axis
    length = float((m1 - m0) @ axis)
    if length < 0.2 * thickness:
        return None
    ring = outline.rings[0]
    lateral = (ring - m0) @ width
    inside = np.ptp(lateral)
    span = (float(lateral.min()) - 0.05 * thickness, float(lateral.max()) + 0.05 * thickness)
    # Fillets in its plane are near the ends, holes to make it lighter in the middle.
    breadth, near, far = (
        outline.area(low * length, high * length, axis, m0) / ((high - low) * length)
        for low, high in ((0.3, 0.7), (0.3, 0.4), (0.6, 0.7))
    )
    solid = outline.area(0.3 * length, 0.7 * length, axis, m0, holes=False) / (0.4 * length)
    if breadth < 0.9 * solid:
        doubts.append(f"holes take away {100 * (1 - breadth / solid):.0f} % of its middle")
    elif abs(near - far) > 0.02 * breadth:
        doubts.append("its breadth changes along it: it is taken as even")
    cuts = (m0, m1)
    radii = []
    ends = []
    for m, out in ((m0, -axis), (m1, axis)):
        outside = m + 0.05 * thickness * out
        if not part.holds(outside):
            more, radius = _end_face(part, planes, m, out, width, thickness), 0.0
        elif is_held(outside):
            # Beyond a slanted end the solid goes on, and the other one is there already.
            more, radius = _end_face(part, planes, m, out, width, thickness, slanted=True), 0.0
        else:
            more, radius = _to_the_body(part, planes, m, out, width, thickness, breadth)
        ends.append(m + more * out)
        radii.append(radius)
    p, q = ends
    if np.linalg.norm(skew) > 0.1 * length:
        doubts.append("its ends are not opposite to each other")
    else:
        # Of ends that are not opposite by rounding the line between both is the axis.
        width = unit(width - width @ (q - p) * (q - p) / ((q - p) @ (q - p)))
    nominal = float(np.linalg.norm(q - p))
    if min(radii) >= 0.4 * thickness and nominal < NOTCH * thickness and breadth > thickness:
        half = (m1 - m0) / 2
        return Thin(
            *(row, Kind.NOTCH, p, q, (m0 + half,), width, normal, breadth, thickness, span),
            *(ring, min(radii), "fillet", doubts),
        )
    if nominal < LEAST_SLENDER * thickness:
        return None
    kind = Kind.SHEET if breadth >= SHEET * thickness else Kind.WIRE
    return Thin(
        *(row, kind, p, q, cuts, width, normal, breadth, thickness, span),
        *(ring, min(radii), "", doubts),
    )


def _to_the_body(
    part: Part,
    planes: tuple[_Plane, _Plane],
    middle: FloatArray,
    out: FloatArray,
    width: FloatArray,
    thickness: float,
    breadth: float,
) -> tuple[float, float]:
    """How far an end is from where the body would begin without fillets, and their radius.

    At each face of the wall the next edge across it is looked at, and what is beyond: a fillet,
    whose other neighbour is the body, or the body itself. Its plane meets the mid plane there.
    """
    found: list[tuple[float, float]] = []
    for plane in planes:
        near: list[tuple[float, int, int]] = []
        for row in plane.rows:
            for k in part.faces[row].edges:
                edge = part.edges[k]
                if not edge.is_along(width):
                    continue
                far = float((edge.ends[0] - middle) @ out)
                sides = np.sort((edge.ends - middle) @ width)
                if (
                    -NEAR <= far <= 8 * thickness
                    and sides[0] < 0.4 * breadth
                    and sides[1] > -0.4 * breadth
                ):
                    near.append((far, row, k))
        if near:
            far, row, k = min(near)
            found.append(_beyond(part, row, k, far, middle, out, width, thickness))
    if not found:
        return 0.0, 0.0
    more, radius = min(found)
    return more, radius


def _beyond(
    part: Part,
    row: int,
    edge: int,
    far: float,
    middle: FloatArray,
    out: FloatArray,
    width: FloatArray,
    thickness: float,
) -> tuple[float, float]:
    face = part.beyond(row, edge)
    if face is None:
        return far, 0.0
    if face.kind == "plane":
        return _meets(face, middle, out, far, thickness), 0.0
    if face.kind == "cylinder" and not face.is_convex and are_parallel(face.axis, width, 1e-3):
        # The other edges of a fillet lead to the body.
        normal = part.faces[row].axis
        own = next(k for k, each in enumerate(part.faces) if each is face)
        for k in face.edges:
            if k == edge or not part.edges[k].is_along(width):
                continue
            body = part.beyond(own, k)
            if body is None or body.kind != "plane":
                continue
            if are_parallel(body.axis, normal, 1e-3):
                return far + face.radius, face.radius
            return _meets(body, middle, out, far + face.radius, thickness), face.radius
        return far + face.radius, face.radius
    return far, 0.0


def _meets(
    face: Face, middle: FloatArray, out: FloatArray, else_: float, thickness: float
) -> float:
    """How far out the plane of a face meets the mid plane."""
    slope = float(face.axis @ out)
    if abs(slope) < 0.1:
        return else_
    far = float((face.at - middle) @ face.axis) / slope
    return far if abs(far - else_) < max(3 * thickness, 1.5 * abs(else_)) else else_


def _end_face(
    part: Part,
    planes: tuple[_Plane, _Plane],
    middle: FloatArray,
    out: FloatArray,
    width: FloatArray,
    thickness: float,
    slanted: bool = False,
) -> float:
    """How far an end that touches something is from where its end face meets the mid plane."""
    for plane in planes:
        for row in plane.rows:
            for k in part.faces[row].edges:
                edge = part.edges[k]
                if edge.is_along(width) and abs((edge.ends[0] - middle) @ out) < thickness:
                    face = part.beyond(row, k)
                    if face is None or face.kind != "plane":
                        continue
                    if not slanted or 0.1 < abs(face.axis @ out) < 0.999:
                        return _meets(face, middle, out, 0.0, thickness)
    return 0.0


# Round wires


def wires(scene: Scene, row: int) -> list[Thin]:
    """The round wires of a solid."""
    part = scene.parts[row]
    found = []
    for group in rounds(part, convex=True):
        found += _wires_of(scene, row, group)
    return found


def rounds(part: Part, *, convex: bool) -> list[list[Face]]:
    """The cylindrical faces of a solid, those of one axis and radius together."""
    groups: list[list[Face]] = []
    for face in part.faces:
        if face.kind != "cylinder" or face.is_convex != convex:
            continue
        for group in groups:
            if _coaxial(group[0], face) and abs(group[0].radius - face.radius) < NEAR:
                group.append(face)
                break
        else:
            groups.append([face])
    return groups


def _coaxial(a: Face, b: Face) -> bool:
    away = b.at - a.at
    return (
        are_parallel(a.axis, b.axis) and float(np.linalg.norm(away - away @ a.axis * a.axis)) < NEAR
    )


def _wires_of(scene: Scene, row: int, group: list[Face]) -> list[Thin]:
    part = scene.parts[row]
    axis, at, radius = group[0].axis, group[0].at, group[0].radius
    spans = []
    for face in group:
        ends = np.concatenate([part.edges[k].ends for k in face.edges])
        levels = (ends - at) @ axis
        spans.append((float(levels.min()), float(levels.max()), face.area))
    spans.sort()
    merged: list[list[float]] = []
    for low, high, area in spans:
        if merged and low < merged[-1][1] - NEAR:
            merged[-1] = [merged[-1][0], max(high, merged[-1][1]), merged[-1][2] + area]
        else:
            merged.append([low, high, area])
    found = []
    for low, high, area in merged:
        if high - low < LEAST_SLENDER * 2 * radius:
            continue
        if area < 0.9 * 2 * np.pi * radius * (high - low):
            continue
        if not part.holds(at + (low + high) / 2 * axis):
            continue
        line = at + low * axis, at + high * axis
        made = _free_wires(scene, row, line, axis, radius, min(0.02, 0.05 * radius))
        if not made and high - low > 20 * radius:
            made = _free_wires(scene, row, line, axis, radius, min(GLUED, 0.5 * radius))
        found += made
    return found


def _free_wires(
    scene: Scene,
    row: int,
    line: tuple[FloatArray, FloatArray],
    axis: FloatArray,
    radius: float,
    gap: float,
) -> list[Thin]:
    """What of a round bar no other solid holds, where its ends are fastened."""
    part = scene.parts[row]
    at, low, high = line[0], 0.0, float((line[1] - line[0]) @ axis)
    u = brep.across(axis)
    v = np.cross(axis, u)
    ends = np.array([at + low * axis, at + high * axis])
    box = np.array([ends.min(0) - radius - gap, ends.max(0) + radius + gap])
    others = scene.near(box, row)
    around = [np.zeros(3)] + [
        (radius + gap) * (np.cos(k * np.pi / 3) * u + np.sin(k * np.pi / 3) * v) for k in range(6)
    ]

    def covered(level: float) -> bool:
        place = at + level * axis
        if scene.where(place, others) is not None:
            return True
        return sum(scene.where(place + d, others) is not None for d in around[1:]) >= 3

    count = 96
    levels = low + (np.arange(count) + 0.5) / count * (high - low)
    flags = [covered(level) for level in levels] if others else [False] * count
    borders: list[tuple[float, float, bool, bool]] = []
    start = low
    held = False
    for k in range(count + 1):
        now = flags[k] if k < count else None
        before = flags[k - 1] if k else None
        if before is None or now == before:
            continue
        if now is None:
            border = high
        else:
            a, b = levels[k - 1], levels[k]
            for _ in range(40):
                half = (a + b) / 2
                a, b = (half, b) if covered(half) == before else (a, half)
            border = (a + b) / 2
        if not before:
            borders.append((start, border, held, bool(now)))
        held, start = bool(before), border
    found = []
    for first, last, held_first, held_last in borders:
        if last - first < LEAST_SLENDER * 2 * radius:
            continue
        made = []
        radii = []
        for level, sign, is_held in ((first, -1.0, held_first), (last, 1.0, held_last)):
            place = at + level * axis
            more = 0.0
            if not is_held:
                outside = place + sign * max(0.05 * radius, gap) * axis
                fastened = part.holds(outside) or any(
                    scene.where(outside + 0.5 * d, others) is not None for d in around
                )
                if not fastened:
                    break
                more = _filletrounds(part, place, axis, radius)
            made.append(place + sign * more * axis)
            radii.append(more)
        if len(made) < 2:
            continue
        cuts = (at + first * axis, at + last * axis)
        outline = np.array(
            [made[0] + radius * v, made[0] - radius * v, made[1] - radius * v, made[1] + radius * v]
        )
        found.append(
            Thin(
                *(row, Kind.WIRE, made[0], made[1], cuts, v, u, 2 * radius, 2 * radius),
                *((-1.05 * radius, 1.05 * radius), outline, min(radii), "round", []),
            )
        )
    return found


def _filletrounds(part: Part, end: FloatArray, axis: FloatArray, radius: float) -> float:
    """Radius of the fillet at the end of a round wire, or 0."""
    for face in part.faces:
        if face.kind == "torus" and not face.is_convex and are_parallel(face.axis, axis, 1e-3):
            away = face.at - end
            off = np.linalg.norm(away - away @ axis * axis)
            if off < NEAR and abs(away @ axis) < 1.01 * face.radius + NEAR:
                return face.radius
    return 0.0


# Necks between two bores


def _has_arc(group: Sequence[Face], centre: FloatArray, towards: FloatArray) -> bool:
    """Whether a bore is there on both sides of a direction: where a fillet begins, it is not."""
    along = np.cross(group[0].axis, towards)
    places = [
        centre + group[0].radius * (np.cos(turn) * towards + np.sin(turn) * along)
        for turn in (-0.15, 0.15)
    ]
    return all(
        any(brep.distance(brep.vertex(place), face.shape) < 1e-3 for face in group)
        for place in places
    )


def necks(scene: Scene, row: int) -> list[Thin]:
    """The circular notches of a solid: what is left between two bores side by side."""
    part = scene.parts[row]
    bores: list[tuple[list[Face], float, float]] = []
    for group in rounds(part, convex=False):
        ends = np.concatenate([part.edges[e].ends for face in group for e in face.edges])
        levels = ends @ group[0].axis
        bores.append((group, float(levels.min()), float(levels.max())))
    found: list[Thin] = []
    for (as_, low_a, high_a), (bs, low_b, high_b) in itertools.combinations(bores, 2):
        a, b = as_[0], bs[0]
        if not are_parallel(a.axis, b.axis):
            continue
        away = b.at - a.at
        away = away - away @ a.axis * a.axis
        d = float(np.linalg.norm(away))
        neck = d - a.radius - b.radius
        if not NEAR < neck < min(a.radius, b.radius) * 1.2:
            continue
        if float(a.axis @ b.axis) < 0:
            low_b, high_b = -high_b, -low_b
        low, high = max(low_a, low_b), min(high_a, high_b)
        if high - low < neck / 2:
            continue
        normal = away / d
        level = (low + high) / 2
        on_axis = a.at + (level - a.at @ a.axis) * a.axis
        middle = on_axis + (a.radius + neck / 2) * normal
        faces = (on_axis + a.radius * normal, on_axis + (a.radius + neck) * normal)
        # Both bores have to be there, at the neck, and material between them.
        inside = part.holds(middle)
        open_ = not part.holds(faces[0] - 0.05 * neck * normal) and not part.holds(
            faces[1] + 0.05 * neck * normal
        )
        if not (inside and open_) or any(
            np.linalg.norm(each.middle - middle) < NEAR for each in found
        ):
            continue
        if not all(
            _has_arc(group, on_axis_, sign * normal)
            for group, on_axis_, sign in (
                (as_, on_axis, 1.0),
                (bs, faces[1] + b.radius * normal, -1.0),
            )
        ):
            continue
        axis = np.cross(a.axis, normal)
        radius = min(a.radius, b.radius)
        doubts = []
        if abs(a.radius - b.radius) > 0.02 * radius:
            doubts.append(f"its bores have radii of {a.radius:.3g} and {b.radius:.3g} mm")
        breadth = high - low
        outline = np.array(
            [
                middle + s * radius / 2 * axis + z * breadth / 2 * a.axis
                for s, z in ((-1, -1), (1, -1), (1, 1), (-1, 1))
            ]
        )
        found.append(
            Thin(
                *(row, Kind.NOTCH, middle - radius * axis, middle + radius * axis, (middle,)),
                *(a.axis, normal, breadth, neck, (-0.52 * breadth, 0.52 * breadth), outline),
                *(radius, "circular", doubts),
            )
        )
    return found


def odd_necks(scene: Scene, row: int) -> list[Thin]:
    """Necks of a solid that are not between two bores: elliptic, one-sided, or of another shape."""
    part = scene.parts[row]
    swept = [
        (face, direction)
        for face in part.faces
        if face.kind == "other" and (direction := brep.swept_along(face.shape)) is not None
    ]
    hollow = [(f, f.axis) for f in part.faces if f.kind == "cylinder" and not f.is_convex]
    flat = [f for f in part.faces if f.kind == "plane"]
    found: list[Thin] = []
    for (a, axis), (b, other) in itertools.combinations([*swept, *hollow], 2):
        if (a.kind != "cylinder" or b.kind != "cylinder") and are_parallel(axis, other):
            if brep.boxes_meet(a.box + [[-0.1 * part.size] * 3, [0.1 * part.size] * 3], b.box):
                found += _odd_neck(part, row, a, b, axis)
    for a, axis in hollow:
        for plane in flat:
            gap = float((plane.at - a.at) @ plane.axis) - a.radius
            if abs(plane.axis @ axis) < PARALLEL and NEAR < gap < 0.5 * a.radius:
                found += _odd_neck(part, row, a, plane, axis)
    for a, axis in swept:
        for plane in flat:
            if abs(plane.axis @ axis) < PARALLEL and brep.boxes_meet(
                a.box + [[-0.03 * part.size] * 3, [0.03 * part.size] * 3], plane.box
            ):
                found += _odd_neck(part, row, a, plane, axis)
    kept: list[Thin] = []
    for thin in found:
        if not any(np.linalg.norm(thin.middle - each.middle) < each.thickness for each in kept):
            kept.append(thin)
    return kept


def _odd_neck(part: Part, row: int, a: Face, b: Face, axis: FloatArray) -> list[Thin]:
    """The neck between two faces that are swept along one axis, where there is one."""
    if set(a.edges) & set(b.edges):
        return []
    near = brep.nearest(a.shape, b.shape)
    if near is None:
        return []
    levels = []
    for face in (a, b):
        places = np.concatenate([part.edges[k].places for k in face.edges]) @ axis
        levels.append((float(places.min()), float(places.max())))
    low, high = max(x for x, _ in levels), min(x for _, x in levels)
    away = near[1] - near[0]
    away = away - away @ axis * axis
    neck, breadth = float(np.linalg.norm(away)), high - low
    if neck < NEAR or breadth < neck / 2:
        return []
    normal = away / neck
    middle = near[0] + away / 2
    middle = middle + ((low + high) / 2 - middle @ axis) * axis
    half = neck / 2 * normal
    if not part.holds(middle) or any(part.holds(middle + s * 1.1 * half) for s in (-1, 1)):
        return []
    along = np.cross(axis, normal)
    # What begins at the neck, as the inside of a bend does, makes no notch: behind a curved face
    # there is more material on both sides.
    for face, place in ((a, middle - half), (b, middle + half)):
        if face.kind != "plane" and not all(
            part.holds(place + step * neck * along) for step in (-0.5, 0.5)
        ):
            return []
    one, other = brep.ellipse_of(a.shape), brep.ellipse_of(b.shape)
    contour, length = "", neck
    if one is not None and other is not None and np.allclose(one[:2], other[:2], rtol=0.01):
        major, minor, direction = one
        along_major = are_parallel(direction, along, 1e-2)
        if along_major or are_parallel(direction, normal, 1e-2):
            contour, length = "elliptic", 2 * (major if along_major else minor)
            radius = minor if along_major else major
    doubts = [] if contour else ["its shape is not known: it is taken as a hinge, without stiffness"]
    if not contour:
        radius = 0.0
    p, q = middle - length / 2 * along, middle + length / 2 * along
    outline = np.array([p - half, q - half, q + half, p + half])
    return [
        Thin(
            *(row, Kind.NOTCH, p, q, (middle,), axis, normal, breadth, neck),
            *((-0.52 * breadth, 0.52 * breadth), outline, radius, contour, doubts),
        )
    ]
