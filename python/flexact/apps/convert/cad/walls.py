# SPDX-License-Identifier: BSD-3-Clause
"""Walls of solids between parallel planes, which may be sheets, bars or filleted notches.

Loaded in the child process alone. A wall is what two parallel faces have in common, seen along
their normal, without what other solids clamp. It may be a flexure where material goes on at two of
its ends and at no other place; its free length is what lies between.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from OCP.TopAbs import TopAbs_FACE
from OCP.TopoDS import TopoDS_Shape

from ....core.arrays import FloatArray
from ....util.rotations import unit
from . import brep
from .assembly import Kind
from .brep import NEAR, Face, Part, are_parallel, without
from .thin import GLUED, LEAST_SLENDER, NOTCH, SHEET, Scene, Thin

#: Share of a clamp that may be holes, which screws fill.
_HOLES = 0.3
#: Planes are those of a tapered wall where the sine between them is less.
_TAPER = 0.05
#: From this share of the breadth of a sheet on a clamp is as broad as the sheet.
_NEARLY = 0.7


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


def regions(scene: Scene, row: int, tapers: list[Thin]) -> list[Region]:
    """Where a solid may have walls; what is like one but for its thickness goes to `tapers`."""
    part = scene.parts[row]
    found = []
    for a, b in itertools.combinations(_planes(part), 2):
        if float(a.normal @ b.normal) > -0.5 or not are_parallel(a.normal, b.normal, _TAPER):
            continue
        if not are_parallel(a.normal, b.normal):
            tapers += _taper(row, part, a, b)
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


def _taper(row: int, part: Part, a: _Plane, b: _Plane) -> list[Thin]:
    """A slender wall whose faces are not quite parallel, so that its thickness changes."""
    between = np.array([(place - b.at) @ b.normal for place in a.corners])
    low, high = -float(between.max()), -float(between.min())
    if low < NEAR or _overlap(a, b) < 15 * high:
        return []
    outline = _Outline(brep.loops(part.faces[a.rows[0]].shape), a.normal)
    inner = outline.samples()[0] - (low + high) / 4 * a.normal
    if not part.holds(inner):
        return []
    return [_web(row, outline, (low + high) / 2, f"it is {low:.3g} to {high:.3g} mm thick")]


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

    Where nothing holds a slender one at two ends, it may be glued: then a wider gap counts.
    """
    made = _free_walls(scene, region, before, min(0.02, 0.05 * region.thickness))
    if region.extent < 15 * region.thickness or any(thin.contour != "web" for thin in made):
        return made
    glued = _free_walls(scene, region, before, min(GLUED, 0.5 * region.thickness))
    return made if all(thin.contour == "web" for thin in glued) and made else glued


def _free_walls(scene: Scene, region: Region, before: Sequence[Thin], gap: float) -> list[Thin]:
    """The walls in one region, where what is no further away than a gap holds it."""
    row, thickness, normal = region.part, region.thickness, region.planes[0].normal
    part = scene.parts[row]
    step = max(0.05 * thickness, gap)
    box = brep.box_of(region.face, thickness / 2 + 2 * gap)
    others = scene.near(box, row)
    through = [k for k in others if _runs_through(scene, region, k)]
    others = [k for k in others if k not in through]
    levels = [side * (thickness / 2 + gap) * normal for side in (0.0, -1.0, 1.0)]
    clamps: list[TopoDS_Shape] = []
    for level in levels if others else ():
        for clamp in _held(scene, brep.moved(region.face, level), normal, others):
            clamps.append(brep.filled(brep.moved(clamp, -level), _HOLES))
    clamps = [_across_all(clamp, region.face, normal) for clamp in clamps]

    def is_held(place: FloatArray) -> bool:
        return any(scene.where(place + level, others) is not None for level in levels)

    def goes_on(place: FloatArray) -> bool:
        return part.holds(place) or is_held(place)

    left = without([region.face], clamps) if clamps else [region.face]
    if not left and region.extent > 15 * thickness:
        return _packed(scene, region, others)
    found = []
    for face in left:
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
    if through:
        names = " and ".join(scene.parts[k].name or "another sheet" for k in through)
        for thin in found:
            thin.doubts.append(f"{names} runs through it, and is taken as apart")
    return found


def _runs_through(scene: Scene, region: Region, row: int) -> bool:
    """Whether another sheet or wire crosses a wall somewhere between its ends."""
    part = scene.parts[row]
    area = sum(face.area for face in part.faces)
    if part.volume > 2.0 * region.thickness * area or part.size < 15 * region.thickness:
        return False
    cut = _held(scene, region.face, region.planes[0].normal, [row])
    left = without([region.face], cut) if cut else []
    return sum(_extent(face) > LEAST_SLENDER * region.thickness for face in left) > 1


def _packed(scene: Scene, region: Region, others: Sequence[int]) -> list[Thin]:
    """A wall that others cover all over, where one of them is as thin: a pack of sheets."""

    def is_sheet(part: Part) -> bool:
        """Whether all of a solid is about as thin as the wall."""
        return 2 * part.volume < 1.5 * region.thickness * sum(face.area for face in part.faces)

    for row in others if is_sheet(scene.parts[region.part]) else ():
        part = scene.parts[row]
        if is_sheet(part) and part.size > 0.6 * region.extent:
            words = f"{part.name or 'another sheet'} lies on it, as in a pack"
            outline = _Outline(brep.loops(region.face), region.planes[0].normal)
            return [_web(region.part, outline, region.thickness, words)]
    return []


def _across_all(clamp: TopoDS_Shape, face: TopoDS_Shape, normal: FloatArray) -> TopoDS_Shape:
    """A clamp as broad as its sheet, where it is nearly so: beside it nothing bends for itself."""
    outline = brep.loops(face)[0]
    straight = [edge for edge in outline if len(edge) == 2]
    if not straight:
        return clamp
    a, b = max(straight, key=lambda edge: float(np.linalg.norm(edge[1] - edge[0])))
    along = unit(b - a)
    frame = np.array([along, np.cross(normal, along)])
    sheet = np.concatenate(outline) @ frame.T
    held = np.concatenate(brep.loops(clamp)[0]) @ frame.T
    shares = np.ptp(held, axis=0) / np.ptp(sheet, axis=0)
    k = int(np.argmax(shares))
    if not _NEARLY <= shares[k] < 1.0 - 1e-6 or shares[1 - k] > shares[k] - 0.05:
        return clamp
    low, high = held.min(0), held.max(0)
    low[k], high[k] = sheet[:, k].min() - 1.0, sheet[:, k].max() + 1.0
    centre = float(a @ normal) * normal + (low + high) / 2 @ frame
    half = (high - low) / 2
    return brep.rectangle(centre, half[0] * frame[0], half[1] * frame[1])


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
    for piece in brep.split(face, cuts, TopAbs_FACE) if cuts else [face]:
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
        part=row,
        kind=Kind.SHEET,
        p=p,
        q=q,
        cuts=(),
        width=width,
        normal=outline.normal,
        breadth=breadth,
        thickness=thickness,
        span=(0.0, 0.0),
        outline=ring,
        radius=0.0,
        contour="web",
        doubts=[words],
    )


def _front(
    chain: list[_Segment], axis: FloatArray, normal: FloatArray
) -> tuple[FloatArray, FloatArray, float, bool]:
    """Of an end: its middle, direction and length of its edge, and whether that is straight.

    The axis goes to the other end.

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
        middle = top + float((places.mean(0) - top) @ side) * side
        return middle, side, float(spread), False
    a, b = runs[best]
    middle, direction = (a + b) / 2, unit(b - a)
    behind = ahead - float(max(a @ axis, b @ axis))
    if behind > NEAR:
        middle = middle + behind * axis
    return middle, direction, float(np.linalg.norm(b - a)), True


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
        m0, d0, b0, flat0 = _front(chains[0], axis, normal)
        m1, d1, b1, flat1 = _front(chains[1], -axis, normal)
        if float(d0 @ d1) < 0:
            d1 = -d1
        width = unit(b0 * d0 + b1 * d1)
        straight = np.cross(width, normal)
        straight = straight if straight @ axis > 0 else -straight
        if np.linalg.norm(straight - axis) < 1e-9:
            break
        axis = straight
    doubts = []
    if not (flat0 and flat1):
        doubts.append("it ends at something round: its length is that of the shortest line")
    skew = m1 - m0 - (m1 - m0) @ axis * axis
    length = float((m1 - m0) @ axis)
    if length < 0.2 * thickness:
        return None
    ring = outline.rings[0]
    lateral = (ring - m0) @ width
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
    radii, ends, is_open = [], [], []
    for m, out in ((m0, -axis), (m1, axis)):
        outside = m + 0.05 * thickness * out
        is_open.append(not part.holds(outside))
        if is_open[-1]:
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
    made = Thin(
        part=row,
        kind=Kind.SHEET if breadth >= SHEET * thickness else Kind.WIRE,
        p=p,
        q=q,
        cuts=cuts,
        width=width,
        normal=normal,
        breadth=breadth,
        thickness=thickness,
        span=span,
        outline=ring,
        radius=min(radii),
        doubts=doubts,
        is_open=(is_open[0], is_open[1]),
    )
    if min(radii) >= 0.4 * thickness and nominal < NOTCH * thickness and breadth > thickness:
        middle = (m0 + (m1 - m0) / 2,)
        return replace(made, kind=Kind.NOTCH, cuts=middle, contour="fillet", is_open=(False, False))
    return None if nominal < LEAST_SLENDER * thickness else made


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
        body = _behind_chamfer(part, face, edge, width, thickness, out)
        return _meets(body or face, middle, out, far, thickness), 0.0
    normal = part.faces[row].axis
    away = abs(float((face.at - part.edges[edge].ends[0]) @ normal))
    # A fillet is tangent to the wall; the inside of a ring is none.
    is_fillet = face.kind == "cylinder" and abs(away - face.radius) < 0.02 * face.radius
    if is_fillet and not face.is_convex and are_parallel(face.axis, width, 1e-3):
        # The other edges of a fillet lead to the body.
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


def _behind_chamfer(
    part: Part, face: Face, edge: int, width: FloatArray, thickness: float, out: FloatArray
) -> Face | None:
    """The body behind a plane face that is small and slanted, as chamfers are."""
    own = next(k for k, each in enumerate(part.faces) if each is face)
    slope = abs(float(face.axis @ out))
    if not 0.2 < slope < 0.98:
        return None
    for k in face.edges:
        if k == edge or not part.edges[k].is_along(width):
            continue
        away = part.edges[k].ends[0] - part.edges[edge].ends[0]
        across = float(np.linalg.norm(away - away @ width * width))
        body = part.beyond(own, k)
        is_near = body is not None and body.kind == "plane" and across < 4 * thickness
        if is_near and body is not None and abs(float(body.axis @ out)) > slope + 0.05:
            return body
    return None


def _meets(
    face: Face, middle: FloatArray, out: FloatArray, else_: float, thickness: float
) -> float:
    """How far out the plane of a face meets the mid plane."""
    slope = float(face.axis @ out)
    if abs(slope) < 0.1:
        return else_
    far = float((face.at - middle) @ face.axis) / slope
    return far if abs(far - else_) < max(3 * thickness, 3 * abs(else_)) else else_


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
