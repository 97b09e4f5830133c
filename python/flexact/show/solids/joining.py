# SPDX-License-Identifier: BSD-3-Clause
"""Bodies and clamps as blocks that begin in the very planes in which flexures end.

Each end of a flexure has a pad beyond it, broader than its section. Pads of one body become one
convex block where that reaches across no end and goes through nothing; else they are joined by
bars from face to face. So every body is connected in itself, touches its flexures, and nothing
else. Where several flexures end at one point they are cut short at a block about it.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from ...util.groups import groups_of
from ...util.rotations import frames_along, unit
from ..drawing.bodies import polygon_round
from .shapes import Polyhedron, Prism, apart, box, circle, hull, polygon

#: Overlaps below this part of the size are rounding.
_TOUCH = 1.0e-9
#: Margin of a pad beside its flexure, and the room between what does not touch, parts of the
#: thickness of bodies.
MARGIN, ROOM = 0.35, 0.05
#: By what pads are made smaller, one after the other, where there is no room for them.
_SMALLER = (1.0, 0.6, 0.35, 0.2, 0.1, 0.05)
#: Of more blocks pairs are not looked at one by one; bars that are tried for a pair.
_MOST_BLOCKS, _MOST_TRIED = 60, 16
#: What fits was found after 60 questions in all models that were looked at.
_MOST_ASKED = 300
#: A box in place of a hull may be larger by so much.
_FULLER = 1.6


class End(NamedTuple):
    """An end of a flexure.

    Attributes:
        flexure: Which one.
        place: (3,) the middle of its section there [m].
        frame: (3, 3) out of it, into what holds it, and along its section.
        half: (2,) half sizes of the section [m].
    """

    flexure: int
    place: FloatArray
    frame: FloatArray
    half: FloatArray

    def contact(self, margin: float) -> FloatArray:
        """(4, 3) corners of its section with a margin [m]."""
        flat = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * (self.half + margin)
        return np.asarray(self.place + flat @ self.frame[:, 1:].T)

    def pad(self, margin: float, depth: float) -> Polyhedron:
        """The box beyond it."""
        middle = self.place + self.frame[:, 0] * depth / 2
        sizes = (depth, *(2.0 * (self.half + margin)).tolist())
        return box(middle, self.frame, sizes)

    def reaches(self, points: FloatArray, least: float) -> bool:
        """Whether points (n, 3) reach across its plane to its own side."""
        return bool(np.any((points - self.place) @ self.frame[:, 0] < -least))


class Lump(NamedTuple):
    """A convex block of a body, with the ends that it holds and the points that it carries."""

    block: Polyhedron
    ends: tuple[End, ...]


class World:
    """All that is there already, and must not be run through."""

    def __init__(self, size: float, room: float) -> None:
        """Nothing yet, in a model of this size; `room` is between what does not touch [m]."""
        self.touch, self.room = _TOUCH * size, room
        #: How often it was asked what is in the way, since it was set to zero.
        self.asked = 0
        self.blocks: list[Polyhedron] = []
        self.owner: list[Hashable] = []
        self._low: list[FloatArray] = []
        self._high: list[FloatArray] = []

    @property
    def is_tired(self) -> bool:
        """Whether it was asked so often that no more is tried."""
        return self.asked > _MOST_ASKED

    def add(self, block: Polyhedron, owner: Hashable) -> None:
        """A convex solid of a body or a flexure."""
        self.blocks.append(block)
        self.owner.append(owner)
        self._low.append(block.points.min(axis=0))
        self._high.append(block.points.max(axis=0))

    def remove(self, owner: Hashable) -> None:
        """All that is someone's."""
        kept = [k for k, each in enumerate(self.owner) if each != owner]
        for name in ("blocks", "owner", "_low", "_high"):
            setattr(self, name, [getattr(self, name)[k] for k in kept])

    def hits(
        self, block: Polyhedron, touching: Iterable[Hashable], ignored: Iterable[Hashable] = ()
    ) -> Hashable | None:
        """Who is in the way of a block; it may touch some, and only those."""
        self.asked += 1
        if not self.blocks:
            return None
        may_touch, left_out = set(touching), set(ignored)
        low, high = np.array(self._low), np.array(self._high)
        far = np.any(low > block.points.max(axis=0) + self.room, axis=1)
        far |= np.any(high < block.points.min(axis=0) - self.room, axis=1)
        for k in np.flatnonzero(~far).tolist():
            owner = self.owner[k]
            if owner in left_out:
                continue
            least = -self.touch if owner in may_touch else self.room
            if apart(block, self.blocks[k]) < least:
                return owner
        return None


def pads_of(
    ends: Sequence[End], owner: Hashable, margin: float, depth: float, world: World
) -> list[Lump]:
    """A pad for each end, with a margin and as deep as there is room for."""
    made = []
    for end in ends:
        for part in _SMALLER:
            block = end.pad(margin * part, depth * part)
            if world.hits(block, (end.flexure,), (owner,)) is None:
                break
        made.append(Lump(block, (end,)))
    return made


def merged(
    lumps: list[Lump], owner: Hashable, world: World, *, is_ground: bool, wish: str
) -> list[Lump]:
    """Lumps in fewer convex ones: all in one where that can be, else two by two.

    Those of the ground only where they would else overlap.
    """
    if len(lumps) > 1 and not is_ground and (whole := _together(lumps, owner, world, wish)):
        return [whole]
    if len(lumps) == 1:
        single = lumps[0]
        return [_together(lumps, owner, world, wish) or single] if wish else lumps
    tried: set[tuple[int, int]] = set()
    while 1 < len(lumps) <= _MOST_BLOCKS:
        middle = np.array([lump.block.points.mean(axis=0) for lump in lumps])
        pairs = sorted(
            (float(np.linalg.norm(middle[i] - middle[j])), i, j)
            for i, j in combinations(range(len(lumps)), 2)
        )
        for _, i, j in pairs:
            key = id(lumps[i].block), id(lumps[j].block)
            if key in tried:
                continue
            tried.add(key)
            if is_ground and apart(lumps[i].block, lumps[j].block) > world.room:
                continue
            if both := _together([lumps[i], lumps[j]], owner, world, ""):
                lumps = [lump for k, lump in enumerate(lumps) if k not in (i, j)] + [both]
                break
        else:
            break
    return lumps


def overlap(lumps: Sequence[Lump], world: World) -> bool:
    """Whether some of a few blocks overlap."""
    blocks = [lump.block for lump in lumps]
    pairs = combinations(blocks, 2) if len(blocks) <= _MOST_BLOCKS else ()
    return any(apart(one, other) < -world.touch for one, other in pairs)


def _together(lumps: Sequence[Lump], owner: Hashable, world: World, wish: str) -> Lump | None:
    """Lumps as one convex block; None where it would reach across an end or through something."""
    ends = tuple(end for lump in lumps for end in lump.ends)
    block = hull(np.concatenate([lump.block.points for lump in lumps]))
    if block is None or not _fits(block, ends, owner, world):
        return None
    if wish == "hull":
        return Lump(block, ends)
    frames = [end.frame for end in ends] or [np.eye(3)]
    around = min(
        (_box_round(block.points, frame) for frame in frames), key=lambda each: each.volume
    )
    is_good = wish == "box" or around.volume < _FULLER * block.volume
    return Lump(around if is_good and _fits(around, ends, owner, world) else block, ends)


def _fits(block: Polyhedron, ends: Sequence[End], owner: Hashable, world: World) -> bool:
    if any(end.reaches(block.points, world.touch) for end in ends):
        return False
    return world.hits(block, {end.flexure for end in ends}, (owner,)) is None


def _box_round(points: FloatArray, frame: FloatArray) -> Polyhedron:
    local = points @ frame
    low, high = local.min(axis=0), local.max(axis=0)
    return box(frame @ ((low + high) / 2), frame, (high - low).tolist())


def bridges(one: Polyhedron, other: Polyhedron, least: float) -> Iterator[Polyhedron]:
    """Bars between two convex blocks from a face of the one to a face of the other, short first.

    Each end is on the outer side of the other's plane, so that a bar is beside both blocks. On a
    face that is larger a bar stands upright.
    """
    faces = [[block.points[list(face)] for face in block.faces] for block in (one, other)]
    found: list[tuple[float, int, FloatArray, FloatArray]] = []
    middle = [np.array([face.mean(axis=0) for face in each]) for each in faces]
    ways = middle[1][None] - middle[0][:, None]
    facing = np.einsum("ijx,ix->ij", ways, one.normals) > 0.0
    facing &= np.einsum("ijx,jx->ij", ways, other.normals) < 0.0
    for i, j in np.argwhere(facing).tolist():
        mine, theirs = faces[0][i], faces[1][j]
        n, m = one.normals[i], other.normals[j]
        feet = [(mine, theirs)]
        feet += [(mine, foot)] if (foot := _foot(mine, theirs, m)) is not None else []
        feet += [(foot, theirs)] if (foot := _foot(theirs, mine, n)) is not None else []
        for start, end in feet:
            up, down = (end - mine[0]) @ n, (start - theirs[0]) @ m
            if min(up.min(), down.min()) < -least or min(up.max(), down.max()) < least:
                continue
            way = end.mean(axis=0) - start.mean(axis=0)
            far = float(np.linalg.norm(way)) or 1.0
            # Straight ones before those that leave a face aslant.
            slant = 2.0 - float(way @ n - way @ m) / far
            found.append((far * (1.0 + slant), len(found), start, end))
    for _, _, start, end in sorted(found, key=lambda each: each[:2])[:_MOST_TRIED]:
        made = hull(np.concatenate((start, end)))
        if made is not None:
            yield made


def _foot(corners: FloatArray, face: FloatArray, normal: FloatArray) -> FloatArray | None:
    """Corners dropped on the plane of a face, where they lie within it; else None."""
    made = corners - ((corners - face[0]) @ normal)[:, None] * normal
    side = np.cross(normal, np.roll(face, -1, axis=0) - face)
    inside = np.einsum("kx,nkx->nk", side, made[:, None] - face) > 0.0
    # A foot that is the edge of a face is none.
    flat = np.linalg.matrix_rank(made - made.mean(axis=0), tol=1.0e-6 * np.ptp(face, axis=0).max())
    return made if flat == 2 and inside.all() else None


def plate(
    lumps: list[Lump], owner: Hashable, thick: float, world: World, *, is_round: bool
) -> tuple[Prism, list[Polyhedron]] | None:
    """A plate beyond all lumps, on which each of them stands by a foot; None where none fits."""
    blocks = [lump.block for lump in lumps]
    points = np.concatenate([block.points for block in blocks])
    outs = np.array([end.frame[:, 0] for lump in lumps for end in lump.ends])
    flattest = np.linalg.svd(points - points.mean(axis=0))[2][2]
    ways = [unit(outs.sum(axis=0)), *(sign * flattest for sign in (1.0, -1.0))]
    ways = [way for way in ways if way.any()]
    ways += [sign * axis for axis in np.eye(3)[::-1] for sign in (1.0, -1.0)]
    # As the flexures come, and of those ways first the flat one.
    ways.sort(key=lambda way: -round(float(np.sum(outs @ way)), 6))
    for way in ways:
        frame = frames_along(way[None])[0][:, [1, 2, 0]]
        flat = points @ frame[:, :2]
        base = float(np.max(points @ way)) + 0.5 * thick
        if is_round:
            middle = (flat.max(axis=0) + flat.min(axis=0)) / 2
            contour = circle(2.1 * float(np.linalg.norm(flat - middle, axis=1).max()))
            origin = frame @ np.array((*middle, base))
        else:
            contour = polygon(_widened(flat[polygon_round(flat)], 0.1 * thick))
            origin = base * way
        solid = Prism(contour, origin, frame, thick)
        whole = solid.polyhedron()
        if world.is_tired:
            break
        if world.hits(whole, (), (owner,)) is not None:
            continue
        feet: list[Polyhedron] = []
        for block in blocks:
            others = [each for each in (*blocks, *feet) if each is not block]
            for bar in bridges(block, whole, world.touch):
                if any(apart(bar, each) < -world.touch for each in others):
                    continue
                if world.hits(bar, (), (owner,)) is None:
                    feet.append(bar)
                    break
            else:
                break
        if len(feet) == len(blocks):
            return solid, feet
    return None


def _widened(corners: FloatArray, by: float) -> FloatArray:
    """A convex polygon (n, 2), anticlockwise, with its sides moved outwards."""
    way = unit(np.roll(corners, -1, axis=0) - corners)
    out = np.stack((way[:, 1], -way[:, 0]), axis=1)
    before = np.roll(out, 1, axis=0)
    return np.asarray(corners + by * (before + out) / (1.0 + np.sum(before * out, axis=1))[:, None])


def joined(
    lumps: list[Lump], owner: Hashable, thick: float, world: World
) -> tuple[list[Polyhedron], Hashable | None]:
    """Lumps with bars between them, so that they are connected.

    Returns:
        The bars and what carries them; who is in the way where nothing else can be done.
    """
    blocks = [lump.block for lump in lumps]
    extra, group = _tree(blocks, owner, world)
    if len(set(group)) == 1 or len(blocks) > _MOST_BLOCKS:
        return extra, None
    # Over a block beside all of them.
    points = np.concatenate([block.points for block in blocks])
    middle = points.mean(axis=0)
    ways = [unit(sum((end.frame[:, 0] for lump in lumps for end in lump.ends), np.zeros(3)))]
    ways += [sign * axis for axis in np.eye(3) for sign in (1.0, -1.0)]
    for far in (1.0, 2.0, 4.0):
        for way in ways:
            if not way.any():
                continue
            reach = float(np.max((points - middle) @ way)) + far * thick
            there = middle + reach * way
            hub = box(there, frames_along(way[None])[0], (thick, thick * 1.5, thick * 1.5))
            if world.is_tired or world.hits(hub, (), ()) is not None:
                continue
            bars, now = _tree([*blocks, hub], owner, world)
            if len(set(now)) == 1:
                return [hub, *bars], None
    in_way: Hashable | None = None
    # Straight through what is in the way.
    for i, j in combinations(range(len(blocks)), 2):
        if group[i] != group[j] and (bar := next(bridges(blocks[i], blocks[j], world.touch), None)):
            in_way = world.hits(bar, (), (owner,)) or in_way
            extra.append(bar)
            group = [group[i] if each == group[j] else each for each in group]
    if len(set(group)) > 1:
        in_way = in_way or owner
    return extra, in_way


def _tree(
    blocks: Sequence[Polyhedron], owner: Hashable, world: World
) -> tuple[list[Polyhedron], list[int]]:
    """Bars that join as many blocks as can be, near ones first; the group of each block."""
    middle = np.array([block.points.mean(axis=0) for block in blocks])
    pairs = list(combinations(range(len(blocks)), 2))
    near = {(i, j): apart(blocks[i], blocks[j]) for i, j in pairs if len(blocks) <= _MOST_BLOCKS}
    connected = [pair for pair, gap in near.items() if gap <= world.touch]
    group = groups_of(len(blocks), connected).tolist()
    bars: list[Polyhedron] = []
    pairs.sort(key=lambda pair: float(np.linalg.norm(middle[pair[0]] - middle[pair[1]])))
    for i, j in pairs:
        if group[i] == group[j] or world.is_tired:
            continue
        for bar in bridges(blocks[i], blocks[j], world.touch):
            others = [block for k, block in enumerate(blocks) if k not in (i, j)] + bars
            if any(apart(bar, each) < -world.touch for each in others):
                continue
            if world.hits(bar, (), (owner,)) is None:
                bars.append(bar)
                group = [group[i] if each == group[j] else each for each in group]
                break
    return bars, group
