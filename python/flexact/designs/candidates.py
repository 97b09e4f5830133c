# SPDX-License-Identifier: BSD-3-Clause
"""Flexures that hold nothing of a wanted freedom, from one region to another: of which to choose.

All lengths are in parts of the size of the problem, all screws about the centre. What a flexure
holds is a space of wrenches (f, m) within W; lines of W through a point p have the directions
perpendicular to all wanted velocities of p, V(p) = {v + w x p}, so that lines come from points and
small null spaces, not from pairs of points. Where W has three dimensions or fewer, lines are also
taken from the families of lines in it, which may meet few points of a grid.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from ..advice.spaces.screws import EXACT, Family, ScrewSpace, canonical, complement
from ..core.arrays import BoolArray, FloatArray, IndexArray
from ..util.records import Frozen, cached_property
from ..util.rotations import unit
from .geometry import SLACK, TINY, cut, meets_box, within
from .problem import Box, Region

#: Of screws, how much of one may be outside of a space in which it is.
_OUTSIDE = 1.0e-10
#: Angles between directions that are tried in a plane.
_ANGLES = 24
#: Values of a form that differ by less are one.
_EQUAL = 1.0e-7
#: Lines that are taken of a regulus.
_RULINGS = 180


@dataclass(frozen=True, eq=False)
class Sizes(Frozen):
    """What flexures may measure, in parts of the size; stiffness in that of a modulus of one.

    Attributes:
        length: Least and largest length.
        width: Least and largest breadth of sheets.
        thickness: Of sheets.
        diameter: Of wires.
        clearance: Between surfaces.
        shear: Young's modulus over the shear modulus.
    """

    length: tuple[float, float]
    width: tuple[float, float]
    thickness: float
    diameter: float
    clearance: float
    shear: float


@dataclass(frozen=True, eq=False)
class Place(Frozen):
    """Between which regions flexures of a body are sought, and what they must hold.

    Attributes:
        freedom: (d, 6) orthonormal rows (w, v) of T.
        here: Where they end on the body.
        there: Where they end on what holds it.
        keep_out: What they may not touch.
        sizes: What they may measure.
        held: (c, 6) orthonormal rows of W that the body is held by already.
    """

    freedom: FloatArray
    here: tuple[Box, ...]
    there: tuple[Box, ...]
    keep_out: tuple[Box, ...]
    sizes: Sizes
    held: FloatArray = field(default_factory=partial(np.zeros, (0, 6)))

    @property
    def constraint(self) -> FloatArray:
        """(k, 6) orthonormal rows (f, m) of W that flexures must hold."""
        return complement(np.concatenate((np.roll(self.freedom, 3, axis=1), self.held)))


def boxes_of(region: Region) -> tuple[Box, ...]:
    """The boxes of a region; a point is a box without size."""
    return (*region.boxes, *(Box(point, point) for point in region.points))


@dataclass(frozen=True, eq=False)
class Candidates(Frozen):
    """Flexures of one kind.

    Attributes:
        kind: Of `flexact.designs.problem.KINDS`.
        ends: (n, 2, 3) middles of their clamped ends.
        strips: (n, m, 3, 3) what they fill (`flexact.designs.geometry`).
        radius: Half of their thickness.
        rows: (n, r, 6) unit wrenches (f, m) that span what each holds.
        stiffness: (n, r, r) with these.
        width: (n,) of sheets; zeros of others.
        normal: (n, 3) across sheets; zeros of others.
        via: (n, v, 3) folds, waists, notches.
        axes: (n, v, 3) unit vectors along folds, of notches; zeros at waists.
    """

    kind: str
    ends: FloatArray
    strips: FloatArray
    radius: float
    rows: FloatArray
    stiffness: FloatArray
    width: FloatArray
    normal: FloatArray
    via: FloatArray
    axes: FloatArray

    def __len__(self) -> int:
        """How many there are."""
        return len(self.ends)

    @property
    def arrays(self) -> dict[str, Any]:
        """What there is one of for each."""
        names = ("ends", "strips", "rows", "stiffness", "width", "normal", "via", "axes")
        return {name: getattr(self, name) for name in names}

    @cached_property
    def balls(self) -> tuple[FloatArray, FloatArray]:
        """(n, m, 3) middles and (n, m) radii of balls around the strips, without thickness."""
        starts, ends, half = (self.strips[:, :, k] for k in range(3))
        reach = np.linalg.norm(ends - starts, axis=2) / 2.0 + np.linalg.norm(half, axis=2)
        return (starts + ends) / 2.0, reach

    def of(self, which: IndexArray | BoolArray) -> Candidates:
        """Those at some places."""
        return replace(self, **{name: each[which] for name, each in self.arrays.items()})


def joined(parts: Sequence[Candidates]) -> Candidates:
    """Candidates of one kind together."""
    names = parts[0].arrays
    arrays: dict[str, Any] = {
        name: np.concatenate([part.arrays[name] for part in parts]) for name in names
    }
    return replace(parts[0], **arrays)


# Points and directions ----------------------------------------------------------------


def points_of(boxes: Sequence[Box], fineness: int) -> FloatArray:
    """(n, 3) points of boxes: corners, middles of edges and faces, and so on evenly between."""
    made = [np.zeros((0, 3))]
    for box in boxes:
        steps = [
            np.linspace(low, high, fineness) if high - low > TINY else np.array([low])
            for low, high in zip(box.low, box.high, strict=True)
        ]
        made.append(np.array(list(itertools.product(*steps))))
    return np.concatenate(made)


def velocities(freedom: FloatArray, points: FloatArray) -> FloatArray:
    """(n, d, 3) of points in the twists of a freedom."""
    return np.asarray(freedom[None, :, 3:] + np.cross(freedom[None, :, :3], points[:, None]))


def able(freedom: FloatArray, points: FloatArray) -> tuple[FloatArray, IndexArray]:
    """(n, 3, 3) unit vectors, and how many of their last ones are across all velocities."""
    if not len(freedom):
        return np.broadcast_to(np.eye(3), (len(points), 3, 3)), np.full(len(points), 3)
    found = velocities(freedom, points)
    _, values, right = np.linalg.svd(found)
    size = 1.0 + np.linalg.norm(points, axis=1, keepdims=True)
    return right, 3 - (values > TINY * size).sum(axis=1)


def _turned(first: FloatArray, second: FloatArray) -> FloatArray:
    """(n, a, 3) directions in planes, from unit vectors of them; the nearest to axes among them."""
    shares = np.stack((first, second), axis=1)
    near = shares.transpose(0, 2, 1) @ shares
    # The projected axis that is longest is where angles begin.
    sizes = np.linalg.norm(near, axis=2)
    start = np.take_along_axis(near, np.round(sizes, 6).argmax(axis=1)[:, None, None], axis=1)[:, 0]
    start = unit(start)
    beside = np.cross(np.cross(first, second), start)
    angles = np.arange(_ANGLES // 2) * (2.0 * np.pi / _ANGLES)
    made = [np.cos(angle) * start + np.sin(angle) * beside for angle in angles]
    for axis in range(3):
        there = sizes[:, axis] > 1.0e-3
        made.append(
            np.where(
                there[:, None], near[:, axis] / np.where(there, sizes[:, axis], 1.0)[:, None], start
            )
        )
    return np.stack(made, axis=1)


def around(axes: FloatArray) -> FloatArray:
    """(n, a, 3) directions across axes, (n, 3)."""
    axis = np.eye(3)[np.abs(axes).argmin(axis=1)]
    first = unit(np.cross(axes, axis))
    return _turned(first, np.cross(axes, first))


#: Directions from the middle of a cube to its faces, edges and corners, one of each pair.
_CUBE = unit(
    np.array([each for each in itertools.product((1, 0, -1), repeat=3) if each > (0, 0, 0)], float)
)


def lines_through(freedom: FloatArray, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(n, 3) points and (n, 3) directions of lines of W through some points."""
    vectors, counts = able(freedom, points)
    starts, ways = [], []
    one = counts == 1
    starts.append(points[one])
    ways.append(vectors[one, 2])
    two = counts == 2
    if two.any():
        turned = _turned(vectors[two, 1], vectors[two, 2])
        starts.append(np.repeat(points[two], turned.shape[1], axis=0))
        ways.append(turned.reshape(-1, 3))
    three = counts == 3
    starts.append(np.repeat(points[three], len(_CUBE), axis=0))
    ways.append(np.tile(_CUBE, (int(three.sum()), 1)))
    return np.concatenate(starts), np.concatenate(ways)


def lines_of_families(constraint: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(n, 3) points and directions of lines in a space of at most three dimensions."""
    rows = constraint
    if not 0 < len(rows) <= 3:
        return np.zeros((0, 3)), np.zeros((0, 3))
    form = rows[:, :3] @ rows[:, 3:].T
    values, vectors = np.linalg.eigh((form + form.T) / 2.0)
    axes = _told(values, vectors.T @ rows)
    plus, minus = axes[values > TINY], axes[values < -TINY]
    flat = axes[np.abs(values) <= TINY]
    made: list[FloatArray] = []
    if not len(plus) or not len(minus):
        made.append(_combined(flat))
    elif len(plus) == len(minus) == 1:
        up = plus[0] / math.sqrt(values[values > TINY][0])
        down = minus[0] / math.sqrt(-values[values < -TINY][0])
        made += [_combined(np.vstack((factor[None], flat))) for factor in (up + down, up - down)]
    else:
        sizes = np.sqrt(np.abs(values))
        pair, alone = (plus, minus) if len(plus) == 2 else (minus, plus)
        of_pair = sizes[values > TINY] if len(plus) == 2 else sizes[values < -TINY]
        of_alone = sizes[values < -TINY] if len(plus) == 2 else sizes[values > TINY]
        angles = np.arange(_RULINGS) * (2.0 * np.pi / _RULINGS)
        made.append(
            np.cos(angles)[:, None] * pair[0] / of_pair[0]
            + np.sin(angles)[:, None] * pair[1] / of_pair[1]
            + alone[0] / of_alone[0]
        )
    found = np.concatenate([np.zeros((0, 6)), *made])
    sizes = np.linalg.norm(found[:, :3], axis=1)
    found = found[sizes > TINY * 10.0] / sizes[sizes > TINY * 10.0, None]
    return np.cross(found[:, :3], found[:, 3:]), found[:, :3]


def _told(values: FloatArray, axes: FloatArray) -> FloatArray:
    """Principal axes of a form; of equal values those nearest to unit vectors, none at random."""
    made = np.array(axes)
    first = 0
    while first < len(values):
        same = np.flatnonzero(np.abs(values - values[first]) <= _EQUAL)
        made[same] = canonical(axes[same]) if same.size > 1 else axes[same]
        first = int(same[-1]) + 1
    return made


def _combined(rows: FloatArray) -> FloatArray:
    """Members of a flat family: of one or two dimensions evenly, of three the rows."""
    if len(rows) != 2:
        return rows
    angles = np.arange(_ANGLES) * (np.pi / _ANGLES)
    return np.asarray(np.cos(angles)[:, None] * rows[0] + np.sin(angles)[:, None] * rows[1])


def special_places(freedom: FloatArray) -> list[tuple[FloatArray, FloatArray]]:
    """Points and directions of planes and lines that are special for a freedom.

    Of each a point and a (n, 3) orthonormal basis of the directions across it: a plane has one, a
    line two, a point three.
    """
    constraint = complement(np.roll(freedom, 3, axis=1))
    found = []
    for rows in (freedom, constraint):
        for family in _families(rows):
            normal, direction = family.normal, family.direction
            if normal.any():
                found.append((family.point, normal[None]))
            elif direction.any() and family.is_of_lines:
                found.append((family.point, complement(direction[None])))
            elif family.is_of_lines and len(family.points) == 0:
                found.append((family.point, np.eye(3)))
            for point, way in zip(family.points[:2], family.directions[:2], strict=True):
                found.append((point, complement(way[None])))
    return found


def _families(rows: FloatArray) -> Sequence[Family]:
    from_rows = ScrewSpace(rows, np.zeros(3), 1.0, tolerance=EXACT)
    return from_rows.families


def with_special(freedom: FloatArray, points: FloatArray, boxes: Sequence[Box]) -> FloatArray:
    """Points, and what they become when they are moved onto special planes and lines, in boxes."""
    made = [points]
    for point, across in special_places(freedom):
        moved = points - (points - point) @ across.T @ across
        inside = np.zeros(len(moved), dtype=bool)
        for box in boxes:
            inside |= within(moved, box.low, box.high)
        made.append(moved[inside])
    return distinct_rows(np.concatenate(made))


def distinct_rows(rows: FloatArray) -> FloatArray:
    """Rows without repetitions, in their order."""
    return rows[first_of_alike(rows)]


def first_of_alike(rows: FloatArray) -> IndexArray:
    """Where rows are that do not repeat one before."""
    _, first = np.unique(np.round(rows, 9) + 0.0, axis=0, return_index=True)
    return np.sort(first)


# From region to region ----------------------------------------------------------------


def reached(
    place: Place,
    points: FloatArray,
    directions: FloatArray,
    half: FloatArray,
    beside: float | None = None,
) -> tuple[IndexArray, FloatArray, FloatArray]:
    """Which lines reach from a body to what holds it, forth or back, and where they end.

    A strip leaves the body where its box ends and ends where that of the ground begins; where
    that is too short it goes deeper into the ground, and then into the body. None passes through
    one box of the ground to another one.

    Args:
        place: The regions.
        points: (n, 3) of the lines.
        directions: (n, 3) unit vectors.
        half: (n, 3) half of the width of the strips, of which the edges must be in the regions; of
            what has more edges (m, n, 3).
        beside: How far strips go at least to both sides of the points; None where they need not
            pass through these.

    Returns:
        The lines, with their ends on the body and on the ground, (m, 3) each.
    """
    which, starts, ends = [], [], []
    least, most = place.sizes.length
    before, after = (np.inf, -np.inf) if beside is None else (-beside, beside)
    here = [spans(points, directions, half, box) for box in place.here]
    there = [spans(points, directions, half, box) for box in place.there]
    for sense in (1.0, -1.0):
        best = np.full(len(points), np.inf)
        begin, end = np.zeros(len(points)), np.zeros(len(points))
        grounds = [span if sense > 0.0 else (-span[1], -span[0]) for span in there]
        for first, last in here:
            s0, s1 = (first, last) if sense > 0.0 else (-last, -first)
            for g0, g1 in grounds:
                t = np.minimum(np.minimum(s1, g1 - least), before)
                u = np.maximum(np.maximum(g0, t + least), after)
                ok = (
                    (s0 <= s1 + SLACK)
                    & (g0 <= g1 + SLACK)
                    & (t >= s0 - SLACK)
                    & (u - t <= most + SLACK)
                    & (g1 > s1 - SLACK)
                    & (u <= g1 + SLACK)
                )
                ok &= u - t < best - TINY
                best = np.where(ok, u - t, best)
                begin, end = np.where(ok, t, begin), np.where(ok, u, end)
        found = np.isfinite(best)
        for g0, g1 in grounds:
            found &= ~((g0 <= g1) & (g0 > begin + TINY) & (g1 < end - TINY))
        chosen = np.flatnonzero(found)
        which.append(chosen)
        starts.append(points[chosen] + sense * begin[chosen, None] * directions[chosen])
        ends.append(points[chosen] + sense * end[chosen, None] * directions[chosen])
    return np.concatenate(which), np.concatenate(starts), np.concatenate(ends)


def spans(
    points: FloatArray, directions: FloatArray, half: FloatArray, box: Box
) -> tuple[FloatArray, FloatArray]:
    """Where the lines of strips, with their edges, are in a box: see `cut`."""
    if not half.any() or (box.high - box.low).max() <= TINY:
        # At a point the middle of the clamp is, however wide it is.
        return cut(points, directions, box.low, box.high)
    edges = [each for h in half.reshape(-1, *points.shape) for each in (h, -h)]
    cuts = [cut(points + edge, directions, box.low, box.high) for edge in edges]
    return np.max([each[0] for each in cuts], axis=0), np.min([each[1] for each in cuts], axis=0)


def clear_of_boxes(place: Place, strips: FloatArray, radius: float) -> BoolArray:
    """(n,) whether flexures, (n, m, 3, 3), stay out of what is to be kept out of."""
    clear = np.ones(len(strips), dtype=bool)
    if not len(strips):
        return clear
    away = place.sizes.clearance + radius
    for box in place.keep_out:
        for k in range(strips.shape[1]):
            clear &= ~meets_box(strips[:, k], box.low - away, box.high + away)
    return clear


def forces(points: FloatArray, directions: FloatArray) -> FloatArray:
    """(n, 6) unit forces along lines."""
    return np.concatenate((directions, np.cross(points, directions)), axis=-1)


def couples(directions: FloatArray) -> FloatArray:
    """(n, 6) unit couples."""
    return np.concatenate((np.zeros_like(directions), directions), axis=-1)


def outside(freedom: FloatArray, rows: FloatArray) -> FloatArray:
    """(...,) the part of wrenches that does work on a freedom."""
    works = rows @ np.roll(freedom, 3, axis=1).T
    return np.asarray(np.linalg.norm(works, axis=-1) / np.linalg.norm(rows, axis=-1))


# Wires ----------------------------------------------------------------------------------


def wires(place: Place, fineness: int = 3) -> Candidates:
    """Wires along lines of W from region to region."""
    points, directions = lines_for(place, fineness)
    held = outside(place.freedom, forces(points, directions)) <= _OUTSIDE
    points, directions = points[held], directions[held]
    _, starts, ends = reached(place, points, directions, np.zeros_like(points))
    return wires_between(place, starts, ends)


def lines_for(place: Place, fineness: int) -> tuple[FloatArray, FloatArray]:
    """Points and directions of lines of W that pass through the regions."""
    here = with_special(place.freedom, points_of(place.here, fineness), place.here)
    there = with_special(place.freedom, points_of(place.there, fineness), place.there)
    # From the ground few lines go to the body; there they are needed where it is small.
    every = complement(np.roll(place.freedom, 3, axis=1))
    sets = [lines_through(place.freedom, here), lines_of_families(every)]
    sets.append(lines_through(place.freedom, there))
    points, directions = _pairs(place, here, there)
    sets.append((points, directions))
    points = np.concatenate([each[0] for each in sets])
    directions = np.concatenate([each[1] for each in sets])
    # Of one line one point and one sense are enough.
    key = np.round(forces(points, directions), 9) + 0.0
    sign = key[np.arange(len(key)), (key != 0.0).argmax(axis=1)]
    _, first = np.unique(key * np.sign(sign)[:, None] + 0.0, axis=0, return_index=True)
    first = np.sort(first)
    return points[first], directions[first]


def _pairs(place: Place, here: FloatArray, there: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Lines from points of the body to points of the ground that lie in W."""
    if len(here) * len(there) > 200_000:
        return np.zeros((0, 3)), np.zeros((0, 3))
    starts = np.repeat(here, len(there), axis=0)
    ways = np.tile(there, (len(here), 1)) - starts
    sizes = np.linalg.norm(ways, axis=1)
    some = sizes > TINY
    starts, ways = starts[some], ways[some] / sizes[some, None]
    held = outside(place.freedom, forces(starts, ways)) <= _OUTSIDE
    return starts[held], ways[held]


def wires_between(place: Place, starts: FloatArray, ends: FloatArray) -> Candidates:
    """Wires with these ends, those left out that touch what is kept out."""
    both = distinct_rows(np.concatenate((starts, ends), axis=1))
    starts, ends = both[:, :3], both[:, 3:]
    lengths = np.linalg.norm(ends - starts, axis=1)
    directions = (ends - starts) / lengths[:, None]
    strips = np.stack((starts, ends, np.zeros_like(starts)), axis=1)[:, None]
    radius = place.sizes.diameter / 2.0
    area = math.pi * radius**2
    made = Candidates(
        "wire",
        np.stack((starts, ends), axis=1),
        strips,
        radius,
        forces(starts, directions)[:, None],
        (area / lengths)[:, None, None],
        *(np.zeros(len(starts)), np.zeros_like(starts)),
        *(np.zeros((len(starts), 0, 3)), np.zeros((len(starts), 0, 3))),
    )
    return made.of(clear_of_boxes(place, strips, radius))


# Sheets ---------------------------------------------------------------------------------


def planes(
    freedom: FloatArray, points: FloatArray, *, pencil: bool
) -> tuple[FloatArray, FloatArray]:
    """(n, 3) points and unit normals of planes that stop nothing wanted.

    Args:
        freedom: (d, 6) rows of T.
        points: (m, 3) where to look.
        pencil: Whether lines through the point alone are held, not all lines of the plane.
    """
    found_at, normals = [], []
    turning = freedom[:, :3]
    if not len(freedom):
        found_at.append(np.repeat(points, len(_CUBE), axis=0))
        normals.append(np.tile(_CUBE, (len(points), 1)))
    else:
        vectors, counts = able(freedom, points)
        one = counts == 2
        found_at.append(points[one])
        normals.append(vectors[one, 0])
        still = points[counts == 3]
        if pencil:
            ways = _CUBE
        else:
            # Normals across all rotations.
            rank = int((np.linalg.svd(turning, compute_uv=False) > TINY).sum())
            free = np.linalg.svd(turning)[2][rank:]
            ways = np.zeros((0, 3))
            if len(free) == 1:
                ways = free
            elif len(free) == 2:
                ways = _turned(free[:1], free[1:])[0]
            elif len(free) == 3:
                ways = _CUBE
        found_at.append(np.repeat(still, len(ways), axis=0))
        normals.append(np.tile(ways, (len(still), 1)))
    points, across = np.concatenate(found_at), np.concatenate(normals)
    if not pencil and len(freedom):
        held = np.abs(across @ turning.T).max(axis=1, initial=0.0) <= TINY
        points, across = points[held], across[held]
    return points, across


def ways_in_planes(
    points: FloatArray, normals: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Points, normals and directions of middle lines in planes."""
    ways = around(normals)
    many = ways.shape[1]
    return np.repeat(points, many, axis=0), np.repeat(normals, many, axis=0), ways.reshape(-1, 3)


def breadths(sizes: Sizes) -> list[float]:
    """Breadths that are tried: the limits, and their geometric mean."""
    low, high = sizes.width
    return sorted({high, math.sqrt(low * high), low}, reverse=True)


def sheets(place: Place, fineness: int = 3) -> Candidates:
    """Whole sheets, in planes all lines of which are in W (theorem 2)."""
    here = with_special(place.freedom, points_of(place.here, fineness), place.here)
    points, normals = planes(place.freedom, here, pencil=False)
    return _strips(place, *ways_in_planes(points, normals), "sheet")


def waisted(place: Place, fineness: int = 3) -> Candidates:
    """Sheets with a waist at one end: the lines through it in their plane are in W."""
    made = []
    for at_end in (0, 1):
        boxes = place.here if at_end == 0 else place.there
        points = with_special(place.freedom, points_of(boxes, fineness), boxes)
        at, normals = planes(place.freedom, points, pencil=True)
        made.append(_strips(place, *ways_in_planes(at, normals), "waisted sheet", at_end))
    return joined(made)


def _strips(
    place: Place,
    points: FloatArray,
    normals: FloatArray,
    ways: FloatArray,
    kind: str,
    waist: int | None = None,
) -> Candidates:
    """Sheets through points, along directions; with a waist at the point."""
    sizes = place.sizes
    made = []
    for breadth in breadths(sizes):
        half = breadth / 2.0 * np.cross(normals, ways)
        which, starts, ends = reached(place, points, ways, half)
        if waist is not None and len(which):
            # The waist is where the plane was looked for, or all of the plane is held.
            at = starts if waist == 0 else ends
            near = np.linalg.norm(at - points[which], axis=1) <= TINY
            near |= outside(place.freedom, couples(normals[which])) <= TINY
            which, starts, ends = which[near], starts[near], ends[near]
        made.append(sheets_between(place, starts, ends, normals[which], breadth, kind, waist))
    return joined(made)


def sheets_between(
    place: Place,
    starts: FloatArray,
    ends: FloatArray,
    normals: FloatArray,
    breadth: float,
    kind: str,
    waist: int | None,
) -> Candidates:
    """Sheets with these middles of their clamped ends."""
    first = first_of_alike(np.concatenate((starts, ends, normals), axis=1))
    starts, ends, normals = starts[first], ends[first], normals[first]
    along, lengths = _along(starts, ends)
    across = np.cross(normals, along)
    thickness = place.sizes.thickness
    area, second = thickness * breadth, thickness * breadth**3 / 12.0
    stretch, side, turn = in_plane(area, second, lengths, place.sizes.shear)
    strips = np.stack((starts, ends, breadth / 2.0 * across), axis=1)[:, None]
    if waist is None:
        middle = (starts + ends) / 2.0
        rows = np.stack((forces(middle, along), forces(middle, across), couples(normals)), axis=1)
        stiffness = _diagonal(stretch, side, turn)
        via = np.zeros((len(starts), 0, 3))
    else:
        at = starts if waist == 0 else ends
        rows = np.stack((forces(at, along), forces(at, across)), axis=1)
        # What is free to turn at one end is a quarter as stiff.
        stiffness = _diagonal(stretch, 1.0 / (1.0 / side + lengths**2 / (4.0 * turn)))
        via = at[:, None]
    held = (outside(place.freedom, rows) <= _OUTSIDE).all(axis=1)
    made = Candidates(
        *(kind, np.stack((starts, ends), axis=1), strips, thickness / 2.0, rows, stiffness),
        *(np.full(len(starts), breadth), normals, via, np.zeros_like(via)),
    )
    return made.of(held & clear_of_boxes(place, strips, thickness / 2.0))


def _along(starts: FloatArray, ends: FloatArray) -> tuple[FloatArray, FloatArray]:
    lengths = np.linalg.norm(ends - starts, axis=1)
    return (ends - starts) / lengths[:, None], lengths


def in_plane(
    area: float, second: float, lengths: FloatArray, shear: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Stiffness of a sheet in its plane about its middle: along it, across, and of turning.

    In parts of the modulus, by Timoshenko, with a shear factor of 5/6.
    """
    lag = 12.0 * second * shear / (5.0 / 6.0 * area * lengths**2)
    return area / lengths, 12.0 * second / (lengths**3 * (1.0 + lag)), second / lengths


def _diagonal(*values: FloatArray) -> FloatArray:
    made = np.zeros((len(values[0]), len(values), len(values)))
    for k, value in enumerate(values):
        made[:, k, k] = value
    return made


# Folded sheets --------------------------------------------------------------------------


def folded(place: Place, fineness: int = 5) -> Candidates:
    """Folded sheets: the line of the fold is in W, wherever the leaves go."""
    spread = [np.array((box.low, box.high)) for box in (*place.here, *place.there)]
    corners = np.concatenate(spread)
    room = (Box(corners.min(axis=0), corners.max(axis=0)),)
    grid = with_special(place.freedom, points_of(room, fineness), room)
    middles = np.concatenate([points_of(boxes, 3) for boxes in (place.here,)])
    grid = distinct_rows(np.concatenate((grid, *_corners(place, middles))))
    folds, ways = lines_through(place.freedom, grid)
    more = lines_of_families(complement(np.roll(place.freedom, 3, axis=1)))
    for point, way in zip(*more, strict=True):
        reach = np.linspace(-2.0, 2.0, 9)[:, None]
        folds = np.concatenate((folds, point + reach * way))
        ways = np.concatenate((ways, np.repeat(way[None], 9, axis=0)))
    held = outside(place.freedom, forces(folds, ways)) <= _OUTSIDE
    folds, ways = folds[held], ways[held]
    made = []
    for breadth in breadths(place.sizes)[1:]:
        half = breadth / 2.0 * ways
        least = place.sizes.length[0]
        begins = [nearest_in(folds, ways, half, box, least) for box in place.here]
        ends = [nearest_in(folds, ways, half, box, least) for box in place.there]
        for (start, ok), (end, there) in itertools.product(begins, ends):
            both = ok & there
            made.append(
                folded_between(place, start[both], folds[both], end[both], ways[both], breadth)
            )
    return joined(made)


def _corners(place: Place, starts: FloatArray) -> Iterator[FloatArray]:
    """Folds that are at a least length along axes from points of the body."""
    for length in (place.sizes.length[0], math.sqrt(place.sizes.length[0] * place.sizes.length[1])):
        for axis in np.concatenate((np.eye(3), -np.eye(3))):
            yield starts + length * axis


def nearest_in(
    folds: FloatArray, ways: FloatArray, half: FloatArray, box: Box, least: float = 0.0
) -> tuple[FloatArray, BoolArray]:
    """(n, 3) nearest points of a box in planes across folds, and whether edges are in the box.

    Where the nearest one is nearer than is asked for, the leaf goes on into the box.
    """
    found = np.clip(folds, box.low, box.high)
    low, high = box.low + np.abs(half), box.high - np.abs(half)
    if (box.high - box.low).max() <= TINY:
        low, high = np.broadcast_arrays(box.low, box.high)
        low, high = np.broadcast_to(low, folds.shape), np.broadcast_to(high, folds.shape)
    fits = (low <= high + TINY).all(axis=1)
    for _ in range(30):
        found = found - ((found - folds) * ways).sum(-1, keepdims=True) * ways
        found = np.clip(found, np.minimum(low, high), high)
    leaf = found - folds
    lengths = np.linalg.norm(leaf, axis=1, keepdims=True)
    deeper = folds + leaf * (least / np.maximum(lengths, TINY))
    inside = ((deeper >= low - SLACK) & (deeper <= high + SLACK)).all(axis=1, keepdims=True)
    found = np.where((lengths < least) & inside, deeper, found)
    off = np.abs(((found - folds) * ways).sum(-1))
    return found, fits & (off <= TINY / 10.0)


def folded_between(
    place: Place,
    starts: FloatArray,
    folds: FloatArray,
    ends: FloatArray,
    ways: FloatArray,
    breadth: float,
) -> Candidates:
    """Folded sheets with these ends and folds; leaves that are too long, short or flat left out."""
    sizes = place.sizes
    least, most = sizes.length
    one, first = _along_or_not(starts, folds)
    other, second = _along_or_not(folds, ends)
    fits = (first >= least - TINY) & (first <= most + TINY)
    fits &= (second >= least - TINY) & (second <= most + TINY)
    # Leaves in one plane, or one upon the other, are no fold.
    fits &= np.abs((one * other).sum(-1)) <= _FLAT
    starts, folds, ends, ways = starts[fits], folds[fits], ends[fits], ways[fits]
    first, second = first[fits], second[fits]
    half = breadth / 2.0 * ways
    strips = np.stack(
        (np.stack((starts, folds, half), axis=1), np.stack((folds, ends, half), axis=1)), axis=1
    )
    thickness = sizes.thickness
    area, inertia = thickness * breadth, thickness * breadth**3 / 12.0
    give = np.zeros(len(starts))
    for lengths in (first, second):
        _, side, turn = in_plane(area, inertia, lengths, sizes.shear)
        give = give + 1.0 / side + lengths**2 / (4.0 * turn)
    made = Candidates(
        *("folded sheet", np.stack((starts, ends), axis=1), strips, thickness / 2.0),
        *(forces(folds, ways)[:, None], (1.0 / give)[:, None, None]),
        *(np.full(len(starts), breadth), np.zeros((len(starts), 3)), folds[:, None], ways[:, None]),
    )
    return made.of(clear_of_boxes(place, strips, thickness / 2.0))


#: The largest cosine between the leaves of a folded sheet.
_FLAT = 0.8


def _along_or_not(starts: FloatArray, ends: FloatArray) -> tuple[FloatArray, FloatArray]:
    lengths = np.linalg.norm(ends - starts, axis=1)
    return (ends - starts) / np.maximum(lengths, TINY)[:, None], lengths
