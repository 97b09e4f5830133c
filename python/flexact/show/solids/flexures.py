# SPDX-License-Identifier: BSD-3-Clause
"""Flexures as solids: sheets and wires from end to end, folded sheets, and notches.

A sheet or a wire is as long as the model says, and ends in planes across its axis, in which what
holds it begins. Leaves that meet at a fold are one solid, mitred there; so are the beams of a
sheet that is divided, whether it is straight or not. A tapered sheet is the frustum of which its
beams are the even pieces.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ...core.arrays import FloatArray
from ...model.data import CrossSection
from ...model.notches import tapered_section
from ...model.parts.parts import Part, PartKind, Parts
from ...util.groups import grouped
from ...util.records import Frozen
from ...util.rotations import unit
from ..drawing import Drawing, Pose
from ..drawing.members import Neck
from ..drawing.pose import along
from .shapes import (
    Curve,
    Piece,
    Polyhedron,
    Prism,
    Shape,
    circle,
    polygon,
    rings_solid,
)

#: What is in line, in a plane or parallel within this part, is so.
_SAME = 1.0e-9
#: Leaves that turn back by more than this cosine are not one solid.
_SHARPEST = -0.9
#: Stations of a beam that bends, where it is drawn so; corners of a round section there.
_SEGMENTS, _CORNERS = 12, 16
#: Sections that change from beam to beam in so many of them are those of a taper.
_TAPER = 4
#: A waist or notch at an end of a member: its length as a part of the member's, by its width, and
#: by which part of the width it is cut, as they are drawn.
_WAIST, _CUT = (0.3, 0.45), 0.375


@dataclass(frozen=True, eq=False)
class Strip(Frozen):
    """Sheets, a wire or a bar from end to end.

    Attributes:
        name: What it is called.
        parts: Its parts: of a folded sheet all leaves.
        rows: (n,) its members in the drawing, from end to end.
        against: (n,) whether each runs against it.
        nodes: (n + 1, 2) position and orientation nodes; -1 where there is none.
        points: (n + 1, 3) where they are in the reference [m].
        width: (n, 3) unit vectors along the breadth.
        local: (n,) which column of a member's frame that is, and `sign` (n,) its sign.
        sign: (n,) likewise.
        sizes: (n, 2) thickness and breadth [m]; of a round one twice the diameter.
        round: Whether it is.
        cut: (2,) by how much it is shorter at both ends [m].
        assumed: Whether the model gives no section.
        bends: Whether it does; a bar stays straight.
    """

    name: str
    parts: tuple[Part, ...]
    rows: np.ndarray
    against: np.ndarray
    nodes: np.ndarray
    points: FloatArray
    width: FloatArray
    local: np.ndarray
    sign: FloatArray
    sizes: FloatArray
    round: bool
    cut: FloatArray
    assumed: bool
    bends: bool

    @property
    def kind(self) -> PartKind:
        """What it is."""
        return self.parts[0].kind

    @property
    def length(self) -> FloatArray:
        """(n,) of its beams [m]."""
        return np.asarray(np.linalg.norm(np.diff(self.points, axis=0), axis=1))

    @property
    def ways(self) -> FloatArray:
        """(n, 3) unit vectors along its beams."""
        return unit(np.diff(self.points, axis=0))

    @property
    def corners(self) -> FloatArray:
        """(n + 1, 3) its points without what is cut off [m]."""
        made = self.points.copy()
        made[0] += self.cut[0] * self.ways[0]
        made[-1] -= self.cut[1] * self.ways[-1]
        return made

    def frame(self, end: int) -> FloatArray:
        """(3, 3) at its first end, 0, or its last, 1: out of it, along thickness and breadth."""
        out = -self.ways[0] if end == 0 else self.ways[-1]
        z = self.width[-end]
        return np.stack((out, np.cross(z, out), z), axis=1)

    def turned(self) -> Strip:
        """The same from its other end."""
        return replace(
            self,
            parts=self.parts[::-1],
            **{
                name: getattr(self, name)[::-1].copy()
                for name in ("rows", "nodes", "points", "width", "local", "sign", "sizes", "cut")
            },
            against=~self.against[::-1],
        )

    def shape(self) -> Shape:
        """Its solid in the reference."""
        return _taper(self) or _plain(self) or rings_solid(self.rings_at_rest())

    def rings_at_rest(self) -> FloatArray:
        """(s, c, 3) rings of corners round it in the reference [m]."""
        corner, ways, made = self.corners, self.ways, []
        for k in range(len(ways)):
            frame = _frames(ways[k][None], self.width[k][None])
            ends = corner[k : k + 2]
            made.append(_rings(self, k, ends, np.repeat(frame, 2, axis=0)))
        return _joined(self, made)

    def _shares(self, k: int) -> FloatArray:
        """(s,) stations of one of its beams, from 0 at its p to 1 at its q."""
        low = self.cut[0] / self.length[0] if k == 0 else 0.0
        high = self.cut[1] / self.length[-1] if k == len(self.rows) - 1 else 0.0
        count = max(_SEGMENTS // len(self.rows), 1) if self.bends else 1
        at = np.linspace(low, 1.0 - high, count + 1)
        return 1.0 - at if self.against[k] else at

    def stations(self) -> list[tuple[int, float]]:
        """The member and the share of its length of each of its `rings`."""
        made: list[tuple[int, float]] = []
        for k, row in enumerate(self.rows.tolist()):
            shares = self._shares(k).tolist()
            made += [(row, at) for at in shares[k > 0 and self._is_even(k - 1) :]]
        return made

    def _is_even(self, k: int) -> bool:
        """Whether the sections of a beam and the next one are equal."""
        return bool(np.allclose(self.sizes[k], self.sizes[k + 1], rtol=_SAME, atol=0.0))

    def rings(self, drawing: Drawing, pose: Pose) -> FloatArray:
        """(s, c, 3) rings of corners round it in a pose [m]."""
        made = []
        for k, row in enumerate(self.rows.tolist()):
            there = along(drawing.members, pose, np.array([row]), self._shares(k))
            x = there.frame[0, ..., 0] * (-1.0 if self.against[k] else 1.0)
            z = self.sign[k] * there.frame[0, ..., self.local[k]]
            # Waists as they are drawn.
            scale, _ = drawing.members.profile(np.array([row]), there.at)
            share = scale[0][:, [2 - self.local[k], self.local[k] - 1]]
            made.append(_rings(self, k, there.centre[0], _frames(x, z), share))
        return _joined(self, made)


def _frames(x: FloatArray, z: FloatArray) -> FloatArray:
    """(s, 3, 3) frames with axes along and breadths (s, 3)."""
    return np.stack((x, np.cross(z, x), z), axis=-1)


def _rings(
    strip: Strip, k: int, centre: FloatArray, frame: FloatArray, share: FloatArray | None = None
) -> FloatArray:
    """(s, c, 3) rings of a beam of a strip, mitred where it meets its neighbours.

    Args:
        strip: The strip.
        k: Which of its beams.
        centre: (s, 3) points of its axis [m].
        frame: (s, 3, 3) its cross-sections.
        share: (s, 2) parts of its thickness and breadth there; by default all.
    """
    if strip.round:
        angle = 2 * np.pi * np.arange(_CORNERS) / _CORNERS
        flat = np.column_stack((np.cos(angle), np.sin(angle)))
    else:
        flat = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    local = flat * strip.sizes[k] / 2
    sized = local * (np.ones((len(centre), 2)) if share is None else share)[:, None]
    made = centre[:, None] + np.einsum("sxd,scd->scx", frame[..., 1:], sized)
    for end, (one, other) in enumerate(((k - 1, k), (k, k + 1))):
        if one < 0 or other >= len(strip.rows):
            continue
        t, u, z = strip.ways[one], strip.ways[other], strip.width[one]
        half = float(np.cross(t, u) @ z) / (1.0 + float(t @ u))
        shift = local[:, :1] * half * (1.0 if end == 0 else -1.0)
        made[-end] += shift * frame[-end, None, :, 0]
    return np.asarray(made)


def _joined(strip: Strip, made: list[FloatArray]) -> FloatArray:
    """The rings of all beams in a row; where sections are equal those of two ends are one."""
    rings = [made[0]]
    for k, following in enumerate(made[1:]):
        if strip._is_even(k):
            rings[-1] = np.concatenate((rings[-1][:-1], (rings[-1][-1:] + following[:1]) / 2))
            following = following[1:]
        rings.append(following)
    return np.concatenate(rings)


def _plain(strip: Strip) -> Prism | None:
    """A strip whose beams lie in a plane across its breadth, and are as broad; else None."""
    ways, width, corner = strip.ways, strip.width[0], strip.corners
    breadth = strip.sizes[:, 1]
    is_straight = bool(np.all(ways @ ways[0] > 1.0 - _SAME))
    extent = float(np.ptp(corner, axis=0).max())
    if (
        np.any(np.abs(ways @ width) > _SAME)
        or np.any(strip.width @ width < 1.0 - _SAME)
        or np.ptp(breadth) > _SAME * breadth.max()
        or (strip.round and not (is_straight and len(set(strip.sizes[:, 0].tolist())) == 1))
    ):
        return None
    x = ways[0]
    y = np.cross(width, x)
    if strip.round:
        frame = np.stack((y, width, x), axis=1)
        long = float((corner[-1] - corner[0]) @ x)
        return Prism(circle(strip.sizes[0, 0]), corner[0], frame, long)
    flat = (corner - corner[0]) @ np.stack((x, y), axis=1)
    if is_straight:
        flat[np.abs(flat) < _SAME * extent] = 0.0
    origin = corner[0] - width * breadth[0] / 2
    sides = [_offset(flat, side * strip.sizes[:, 0] / 2) for side in (-1.0, 1.0)]
    contour = polygon([*sides[0], *sides[1][::-1]])
    return Prism(contour, origin, np.stack((x, y, width), axis=1), float(breadth[0]))


def _offset(points: FloatArray, beside: FloatArray) -> list[FloatArray]:
    """Corners of a way beside one (n + 1, 2), by (n,) to the left of its pieces [m]."""
    way = unit(np.diff(points, axis=0))
    left = np.stack((-way[:, 1], way[:, 0]), axis=1)
    made = [points[0] + beside[0] * left[0]]
    for k in range(len(way) - 1):
        turn = float(way[k, 0] * way[k + 1, 1] - way[k, 1] * way[k + 1, 0])
        one, other = (points[k + 1] + beside[i] * left[i] for i in (k, k + 1))
        if abs(turn) > 1.0e-7:
            gap = other - one
            share = float(gap[0] * way[k + 1, 1] - gap[1] * way[k + 1, 0]) / turn
            made.append(one + share * way[k])
        elif abs(beside[k] - beside[k + 1]) > _SAME * abs(beside[k]):
            made += [one, other]
    return [*made, points[-1] + beside[-1] * left[-1]]


def _taper(strip: Strip) -> Polyhedron | None:
    """The frustum of a tapered sheet that is straight; None of what is none."""
    n, change = len(strip.rows), np.diff(strip.sizes, axis=0)
    steps = np.abs(change) > _SAME * strip.sizes.max(axis=0)
    if n < _TAPER or not steps[:, 0].all() or strip.round:
        return None
    if np.any(strip.ways @ strip.ways[0] < 1.0 - _SAME):
        return None
    edge = np.concatenate(([0.0], np.cumsum(strip.length))) / strip.length.sum()
    basis = np.stack((1.0 - (edge[1:] + edge[:-1]) / 2, (edge[1:] + edge[:-1]) / 2), axis=1)
    fit = np.linalg.pinv(basis)
    ends = fit @ strip.sizes
    for _ in range(20):
        (t, b), pieces = ends.T, list(zip(edge[:-1].tolist(), edge[1:].tolist(), strict=True))
        now = [tapered_section((t[0], t[1]), (b[0], b[1]), *piece) for piece in pieces]
        ends = ends + fit @ (strip.sizes - np.array(now))
    if np.abs(basis @ ends / strip.sizes - 1.0).max() > 0.05 or not np.all(ends > 0.0):
        return None
    rings = []
    for corner, size in zip(strip.corners[[0, -1]], ends, strict=True):
        frame = _frames(strip.ways[:1], strip.width[:1])
        one = replace(strip, sizes=np.array([size]), rows=strip.rows[:1])
        rings.append(_rings(one, 0, corner[None], frame))
    return rings_solid(np.concatenate(rings))


def waisted(strip: Strip, drawing: Drawing) -> Prism | None:
    """A straight strip that is cut where it bends at an end, as it is drawn; else None."""
    members, row = drawing.members, int(strip.rows[0])
    neck = members.neck[row][::-1] if strip.against[0] else members.neck[row]
    there = np.isin(neck, (Neck.WAIST, Neck.NOTCH))
    if len(strip.rows) > 1 or strip.round or not there.any():
        return None
    in_width = int(members.cut[row]) + 1 == strip.local[0]
    size, deep = strip.sizes[0, ::-1] if in_width else strip.sizes[0]
    corner, x = strip.corners, strip.ways[0]
    z = np.cross(x, strip.width[0]) if in_width else strip.width[0]
    long = float((corner[1] - corner[0]) @ x)
    reach = float(np.clip(size / long, *_WAIST)) * long
    # From a little beyond the end on, so that the strip ends as broad as it is.
    land = 0.02 * reach
    spans = [(land, reach)] * bool(there[0]) + [(long - reach, long - land)] * bool(there[1])
    below: list[Piece] = [Piece((0.0, -size / 2))]
    above: list[Piece] = []
    for low, high in spans:
        middle, half = (
            (low + high) / 2,
            (high - low) / 2,
        )
        axes = (half, _CUT * size)
        below += [
            Piece((low, -size / 2), Curve.ELLIPSE, (middle, -size / 2), axes, False),
            Piece((high, -size / 2)),
        ]
        above = [
            Piece((high, size / 2), Curve.ELLIPSE, (middle, size / 2), axes, False),
            Piece((low, size / 2)),
            *above,
        ]
    contour = (*below, Piece((long, -size / 2)), Piece((long, size / 2)), *above)
    contour = (*contour, Piece((0.0, size / 2)))
    frame = np.stack((x, np.cross(z, x), z), axis=1)
    return Prism(contour, corner[0] - z * deep / 2, frame, float(deep))


def strips_of(drawing: Drawing, parts: Parts) -> list[Strip]:
    """The strips of a model, folded sheets in one piece."""
    flexible = (PartKind.SHEET, PartKind.WIRE, PartKind.BAR, PartKind.BEAM)
    row_of = dict(zip(drawing.members.index.tolist(), range(len(drawing.members)), strict=True))
    against = {
        element: turned
        for chain in drawing.data.chains
        for element, turned in zip(chain.elements, chain.reversed, strict=True)
    }
    made = [
        _strip(drawing, part, row_of, against)
        for part in parts.all
        if part.kind in flexible and drawing.members.length[row_of[part.elements[0]]] > 0.0
    ]
    return _folded(made, parts)


def _strip(drawing: Drawing, part: Part, row_of: dict[int, int], against: dict[int, bool]) -> Strip:
    members, looks = drawing.members, drawing.data.appearance
    rows = np.array([row_of[i] for i in part.elements])
    turned = np.array([against.get(i, False) for i in part.elements])
    slots = members.nodes[rows]
    slots = np.where(turned[:, None], slots[:, [2, 3, 0, 1]], slots)
    nodes = np.concatenate((slots[:, :2], slots[-1:, 2:]))
    section, frame = members.section[rows], members.frame[rows]
    local = np.where(section[:, 1] >= section[:, 0], 2, 1)
    if part.kind == PartKind.SHEET:
        # As the first is wide, else beams of a square section would turn.
        local[:] = local[0]
    pick = np.arange(len(rows))
    width = frame[pick, :, local]
    sign = np.ones(len(rows))
    for k in range(1, len(rows)):
        sign[k] = sign[k - 1] * (-1.0 if width[k] @ width[k - 1] < 0.0 else 1.0)
    given = np.all(looks.dimensions[list(part.elements)] > 0.0, axis=1)
    known = looks.cross_section[list(part.elements)]
    return Strip(
        *(part.name, (part,), rows, turned, nodes, drawing.reference.position[nodes[:, 0]]),
        *(sign[:, None] * width, local, sign),
        np.stack((section[pick, 2 - local], section[pick, local - 1]), axis=1),
        bool(members.round[rows].all() and np.allclose(section[:, 0], section[:, 1])),
        np.zeros(2),
        not given.all() or bool(np.any(known == CrossSection.LINE)),
        bool(members.bends[rows].any()),
    )


def _folded(strips: list[Strip], parts: Parts) -> list[Strip]:
    """Strips with those in one that meet at folds."""
    folds = [key for key, at in _ends_at(strips).items() if _is_fold(strips, parts, key, at)]
    for key in folds:
        (i, end_i), (j, end_j) = _ends_at(strips)[key]
        if i == j:
            continue
        one = strips[i] if end_i == 1 else strips[i].turned()
        other = strips[j] if end_j == 0 else strips[j].turned()
        if one.width[-1] @ other.width[0] < 0.0:
            other = replace(other, width=-other.width, sign=-other.sign)
        if one.assumed and other.assumed:
            least = np.minimum(one.sizes.min(axis=0), other.sizes.min(axis=0))
            one, other = (replace(x, sizes=np.tile(least, (len(x.rows), 1))) for x in (one, other))
        joined: dict[str, Any] = {
            name: np.concatenate((getattr(one, name), getattr(other, name)))
            for name in ("rows", "against", "width", "local", "sign", "sizes")
        }
        every = (*one.parts, *other.parts)
        strips = [each for k, each in enumerate(strips) if k not in (i, j)]
        strips.insert(
            min(i, j),
            replace(
                one,
                name=_name_of(every),
                parts=every,
                nodes=np.concatenate((one.nodes, other.nodes[1:])),
                points=np.concatenate((one.points, other.points[1:])),
                assumed=one.assumed or other.assumed,
                bends=one.bends or other.bends,
                **joined,
            ),
        )
    return strips


def _ends_at(strips: list[Strip]) -> dict[tuple[int, int], list[tuple[int, int]]]:
    """Which ends, strip and 0 or 1, are at which position and orientation."""
    return grouped(
        ((int(strip.nodes[-end, 0]), int(strip.nodes[-end, 1])), (k, end))
        for k, strip in enumerate(strips)
        for end in (0, 1)
    )


def _is_fold(
    strips: list[Strip], parts: Parts, key: tuple[int, int], at: list[tuple[int, int]]
) -> bool:
    node, turn = key
    if len(at) != 2 or turn < 0 or node in parts.body_at or parts.is_held(node):
        return False
    (i, end_i), (j, end_j) = at
    one, other = strips[i], strips[j]
    if {one.kind, other.kind} != {PartKind.SHEET} or len(parts.at(node)) != 2:
        return False
    out, back = one.frame(end_i), other.frame(end_j)
    breadth = one.sizes[-end_i, 1], other.sizes[-end_j, 1]
    if one.assumed and other.assumed:
        # Drawn by its own length each: then both as the smaller one.
        breadth = breadth[0], breadth[0]
    return bool(
        abs(out[:, 2] @ back[:, 2]) > 1.0 - _SAME
        and -(out[:, 0] @ back[:, 0]) > _SHARPEST
        and abs(breadth[0] - breadth[1]) < _SAME * breadth[0]
    )


def _name_of(parts: tuple[Part, ...]) -> str:
    """What leaves in a row are called: what their names begin with, up to a word."""
    names = [part.name for part in parts]
    stem = names[0]
    for name in names[1:]:
        count = next((k for k, (a, b) in enumerate(zip(stem, name)) if a != b), len(stem))  # noqa: B905
        stem = stem[:count]
    words = stem if stem in names else stem[: max(stem.rfind(" "), stem.rfind(",")) + 1]
    told = words.rstrip(" ,")
    for tail in (" leaf", ","):
        told = told.removesuffix(tail).rstrip(" ,")
    enough = told and all(part.is_named for part in parts) and told not in ("sheet", "leaf")
    return told if enough else " + ".join(names)


def convex_pieces(strip: Strip) -> Iterator[Polyhedron]:
    """Convex solids within which a strip lies."""
    rings = replace(strip, round=False).rings_at_rest()
    for k in range(len(rings) - 1):
        if not np.allclose(rings[k], rings[k + 1]):
            yield rings_solid(rings[k : k + 2], _SAME)
