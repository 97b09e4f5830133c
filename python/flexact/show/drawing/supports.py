# SPDX-License-Identifier: BSD-3-Clause
"""Clamps as blocks of ground: what is clamped at one point, or within one block, has one."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations, product

import numpy as np

from ...core.arrays import FloatArray
from ...model.parts.bodies import groups_of
from ...util.records import Frozen
from .members import Members
from .rotations import frames_along, unit

#: How much a block stands out beside a member, and how thick it is: parts of the symbol's size.
BESIDE, THICK = 0.55, 0.6
#: Cosine of the largest angle between a block and a member along whose section it lies.
_UPRIGHT = 0.9
#: Points nearer than this part of the drawing's size are one; ends spread less than this part of
#: the symbol's size say nothing of how a block lies.
_SAME, _SPREAD = 1.0e-9, 0.2
#: Of more clamps it is not looked for blocks that overlap, only for those at one point.
_MOST = 400
_CORNERS = np.array(list(product((-1.0, 0.0), (-1.0, 1.0), (-1.0, 1.0))))


@dataclass(frozen=True, eq=False)
class Block(Frozen):
    """A block of ground.

    Attributes:
        nodes: Position nodes that it clamps, ascending.
        middle: (3,) of its face [m].
        frame: (3, 3) columns: from the ground towards what is held, and two along its face.
        extent: (2,) half sizes along these two [m].
        depth: Its thickness [m].
        size: Of the symbol [m].
    """

    nodes: tuple[int, ...]
    middle: FloatArray
    frame: FloatArray
    extent: FloatArray
    depth: float
    size: float

    def holds(self, points: FloatArray) -> bool:
        """Whether one of some points (n, 3) lies within it."""
        local = (points - self.middle) @ self.frame
        low, high = np.array((-self.depth, *-self.extent)), np.array((0.0, *self.extent))
        return bool(np.any(np.all((local >= low) & (local <= high), axis=1)))

    @property
    def corners(self) -> FloatArray:
        """(8, 3) [m]."""
        sizes = np.array((self.depth, *self.extent))
        made: FloatArray = self.middle + (_CORNERS * sizes) @ self.frame.T
        return made

    def meets(self, other: Block) -> bool:
        """Whether it overlaps with another one: corners or faces of one lie in the other."""
        return self.holds(other._looked_at) or other.holds(self._looked_at)

    @property
    def _looked_at(self) -> FloatArray:
        inner = self.middle - self.depth / 2 * self.frame[:, 0]
        return np.concatenate((self.corners, (self.corners + self.middle) / 2, inner[None]))


@dataclass(frozen=True, eq=False)
class _Ends(Frozen):
    """Ends of members at clamps: which node and member, and away from the clamp (e, 3)."""

    node: np.ndarray
    member: np.ndarray
    away: FloatArray


def blocks_of(
    members: Members,
    position: FloatArray,
    nodes: np.ndarray,
    sizes: FloatArray,
    otherwise: FloatArray,
) -> list[Block]:
    """The blocks of some clamped nodes.

    Args:
        members: The members of the drawing.
        position: (nodes of the model, 3) [m].
        nodes: (c,) the clamped position nodes.
        sizes: (c,) of their symbols [m].
        otherwise: (3,) the direction of a block whose members go all ways.
    """
    ends = _ends_at(members, nodes)
    size = float(np.ptp(position, axis=0).max(initial=0.0)) or 1.0
    size_of = dict(zip(nodes.tolist(), sizes.tolist(), strict=True))
    places = np.round(position[nodes] / (_SAME * size) / 2)
    _, first = np.unique(places, axis=0, return_inverse=True)

    def made(group: list[int]) -> Block:
        return _block(
            members, position, ends, group, max(map(size_of.__getitem__, group)), otherwise
        )

    groups: dict[int, list[int]] = {}
    for node, key in zip(nodes.tolist(), first.ravel().tolist(), strict=True):
        groups.setdefault(key, []).append(node)
    blocks = [made(group) for group in groups.values()]
    while 1 < len(blocks) <= _MOST:
        pairs = [(i, j) for i, j in _near(blocks) if blocks[i].meets(blocks[j])]
        if not pairs:
            break
        owner = groups_of(len(blocks), pairs).tolist()
        joined = [
            sorted(n for k, one in zip(owner, blocks, strict=True) if k == each for n in one.nodes)
            for each in dict.fromkeys(owner)
        ]
        blocks = [made(group) for group in joined]
    return sorted(blocks, key=lambda block: block.nodes)


def _near(blocks: list[Block]) -> list[tuple[int, int]]:
    """Pairs of blocks whose corners are not too far apart for them to meet."""
    middle = np.array([block.corners.mean(axis=0) for block in blocks])
    radius = np.array([np.linalg.norm(b.corners[0] - b.corners.mean(axis=0)) for b in blocks])
    near = np.linalg.norm(middle[:, None] - middle, axis=-1) < radius[:, None] + radius
    return [(i, j) for i, j in combinations(range(len(blocks)), 2) if near[i, j]]


def _ends_at(members: Members, nodes: np.ndarray) -> _Ends:
    node, member, away = [], [], []
    for slot, sign in ((0, 1.0), (2, -1.0)):
        rows = np.flatnonzero(np.isin(members.nodes[:, slot], nodes))
        node.append(members.nodes[rows, slot])
        member.append(rows)
        away.append(sign * members.frame[rows, :, 0])
    return _Ends(np.concatenate(node), np.concatenate(member), np.concatenate(away))


def _block(
    members: Members,
    position: FloatArray,
    ends: _Ends,
    group: list[int],
    size: float,
    otherwise: FloatArray,
) -> Block:
    """The block of some nodes."""
    rows = np.flatnonzero(np.isin(ends.node, group))
    place, away, member = position[ends.node[rows]], ends.away[rows], ends.member[rows]
    points = position[group]
    mean = away.sum(axis=0)
    direction = unit(mean) if np.linalg.norm(mean) > 1.0e-6 else otherwise
    frame = frames_along(direction[None])[0]
    half = np.zeros((0, 3))
    if rows.size:
        widest = int(np.argmax(np.round(members.section[member].max(axis=1) / size, 9)))
        frame = _lying(direction, members.frame[member[widest]], away[widest], points, size)
        sides = members.section[member][:, :, None] / 2
        corner = np.array(list(product((-1.0, 1.0), repeat=2)))
        arms = np.einsum("kxd,kd,cd->kcx", members.frame[member][..., 1:], sides[..., 0], corner)
        half = (place[:, None] + arms).reshape(-1, 3)
    local = np.concatenate((points, half)) @ frame
    along = points @ frame[:, 0]
    low, high = local[:, 1:].min(axis=0), local[:, 1:].max(axis=0)
    middle = frame @ np.array((along.max(), *((low + high) / 2)))
    return Block(
        tuple(sorted(group)),
        middle,
        frame,
        (high - low) / 2 + BESIDE * size,
        float(np.ptp(along)) + THICK * size,
        size,
    )


def _lying(
    direction: FloatArray, own: FloatArray, away: FloatArray, points: FloatArray, size: float
) -> FloatArray:
    """(3, 3) the frame of a block: along the section of the widest member, or along its points.

    Args:
        direction: (3,) of what it holds.
        own: (3, 3) frame of the widest member.
        away: (3,) along that member, from the ground.
        points: (n, 3) that it clamps [m].
        size: Of the symbol [m].
    """
    upright = bool(away @ direction > _UPRIGHT)
    if upright:
        side = 1.0 if own[:, 0] @ away > 0.0 else -1.0
        return np.asarray(own * np.array((side, 1.0, side)))
    flat = points - points.mean(axis=0)
    flat = flat - (flat @ direction)[:, None] * direction
    far = flat[int(np.argmax(np.round(np.linalg.norm(flat, axis=1) / size, 9)))]
    axis = far if np.linalg.norm(far) > _SPREAD * size else own[:, 1]
    axis = unit(axis - (axis @ direction) * direction)
    if not axis.any():
        return np.asarray(frames_along(direction[None])[0])
    return np.stack((direction, axis, np.cross(direction, axis)), axis=1)
