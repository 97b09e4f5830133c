# SPDX-License-Identifier: BSD-3-Clause
"""Symbols of fixed and of independent coordinates.

Clamps are blocks of ground: what is clamped at one point, or within one block, has one.
"""

from __future__ import annotations

from enum import IntEnum
from itertools import combinations, product
from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray, ModelArrays
from ...core.elements import Class, NodeKind
from ...util.groups import groups_of
from ...util.rotations import frames_along, unit
from .members import Members, turned_at
from .pose import Pose

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
#: Parts of the drawing's size, and of the shortest member at the node.
_PART, _SMALLEST = 0.045, 0.012
_LIMIT = 0.4


class Support(IntEnum):
    """What a symbol says of a position node."""

    CLAMP = 1
    """All translations and rotations are fixed: a block of ground."""
    PIN = 2
    """All translations are fixed: a pyramid."""
    SLIDE = 3
    """One translation is fixed: a cone along it."""
    TURN = 4
    """One rotation is fixed: a double cone about it."""


class Symbol(NamedTuple):
    """A symbol of fixed coordinates in the reference configuration.

    Attributes:
        kind: What is fixed.
        held: All the position nodes that it holds, ascending: of a block several. It goes with
            the first.
        middle: (3,) where it stands, of a block the middle of its face [m].
        frame: (3, 3) columns: the unit vector from the ground towards what is held, and two
            across it, of a clamp along the section of the widest member that it holds or along
            the points that it clamps.
        extent: (2,) half sizes along these two [m].
        depth: Thickness of a block [m].
        size: [m].
    """

    kind: Support
    held: tuple[int, ...]
    middle: FloatArray
    frame: FloatArray
    extent: FloatArray
    depth: float
    size: float

    def at(self, reference: Pose, pose: Pose) -> FloatArray:
        """(3,) where it stands in a pose [m]."""
        node = self.held[0]
        return np.asarray(pose.position[node] + (self.middle - reference.position[node]))

    @property
    def corners(self) -> FloatArray:
        """(8, 3) of a block [m]."""
        sizes = np.array((self.depth, *self.extent))
        return np.asarray(self.middle + (_CORNERS * sizes) @ self.frame.T)

    def reaches(self, other: Symbol) -> bool:
        """Whether corners, the middle or points of the face of another block lie within it."""
        inner = other.middle - other.depth / 2 * other.frame[:, 0]
        corners = other.corners
        points = np.concatenate((corners, (corners + other.middle) / 2, inner[None]))
        local = (points - self.middle) @ self.frame
        low, high = np.array((-self.depth, *-self.extent)), np.array((0.0, *self.extent))
        return bool(np.any(np.all((local >= low) & (local <= high), axis=1)))

    def solids(
        self, place: FloatArray, corners: int, tip: float = 0.0
    ) -> list[tuple[FloatArray, float]]:
        """The solids that it is: rings (r, c, 3) [m], and of a block of ground how thick it is.

        Args:
            place: (3,) where it stands [m].
            corners: Of round rings.
            tip: Radius of a tip, a part of the symbol's size.
        """
        frame, size = self.frame, self.size
        if self.kind == Support.CLAMP:
            return [(_block_rings(place, frame, self.extent, self.depth), self.depth)]
        if self.kind == Support.PIN:
            thick, half = 0.28 * size, np.full(2, 0.85 * size)
            ground = _block_rings(place - size * frame[:, 0], frame, half, thick)
            return [
                (rings_about(place, frame, ((-1.0, 0.75), (0.0, tip)), size, 4), 0.0),
                (ground, thick),
            ]
        rings: tuple[tuple[float, float], ...] = ((-0.7, 0.4), (0.0, tip), (0.7, 0.4))
        if self.kind == Support.SLIDE:
            rings = ((-1.1, 0.45), (0.0, tip))
        return [(rings_about(place, frame, rings, size, corners), 0.0)]


def rings_about(
    place: FloatArray,
    frame: FloatArray,
    rings: tuple[tuple[float, float], ...],
    size: float,
    corners: int,
) -> FloatArray:
    """(r, c, 3) rings about ex of a frame: place along it and radius of each, parts of the size."""
    angle = 2 * np.pi * (np.arange(corners) + 0.5 * (corners == 4)) / corners
    circle = np.cos(angle)[:, None] * frame[:, 1] + np.sin(angle)[:, None] * frame[:, 2]
    return np.stack([place + size * (x * frame[:, 0] + r * circle) for x, r in rings])


def _block_rings(
    place: FloatArray, frame: FloatArray, half: FloatArray, thick: float
) -> FloatArray:
    """(2, 4, 3) a block of ground whose upper face lies at the place."""
    corner = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half
    upper = place + corner @ frame[:, 1:].T
    return np.stack((upper - thick * frame[:, 0], upper))


def supports_of(arrays: ModelArrays, members: Members, size: float) -> tuple[Symbol, ...]:
    """The supports of a model whose drawing has this size [m]."""
    moved, turned, whole = _fixed(arrays)
    positions = np.flatnonzero(arrays.node_kind <= NodeKind.POSITION)
    held = moved[positions].all(axis=1)
    clamped = held & whole[positions]
    partly, pinned = positions[~clamped], positions[held & ~clamped]
    spatial, place = arrays.node_kind == NodeKind.POSITION, arrays.node_value[:3].T
    upwards = np.array((0.0, 0.0, 1.0) if spatial.any() else (0.0, 1.0, 0.0))
    outward, room = _outward(arrays.node_kind.size, members)
    outward[~np.any(outward != 0.0, axis=1)] = upwards
    sizes = np.minimum(_PART * size, np.maximum(_LIMIT * room, _SMALLEST * size))
    made = _blocks(members, place, positions[clamped], sizes, upwards)
    # A pyramid stands straight.
    rows = [(pinned, Support.PIN, _upright(outward[pinned]))]
    for axis in range(3):
        slides = partly[moved[partly, axis] & ~moved[partly].all(axis=1)]
        turns = partly[turned[partly, axis]]
        # In the plane, z is not a coordinate that could be fixed or free.
        slides = slides if axis < 2 else slides[spatial[slides]]
        turns = turns if axis == 2 else turns[spatial[turns]]
        for nodes, kind in ((slides, Support.SLIDE), (turns, Support.TURN)):
            # To the side on which the members are.
            side = np.where(outward[nodes, axis] < 0.0, -1.0, 1.0)
            rows.append((nodes, kind, side[:, None] * np.eye(3)[axis]))
    for nodes, kind, direction in rows:
        for node, frame in zip(nodes.tolist(), frames_along(direction), strict=True):
            own = float(sizes[node])
            extent = np.full(2, BESIDE * own)
            made.append(Symbol(kind, (node,), place[node], frame, extent, 0.0, own))
    return tuple(made)


def _blocks(
    members: Members,
    position: FloatArray,
    nodes: np.ndarray,
    sizes: FloatArray,
    upwards: FloatArray,
) -> list[Symbol]:
    """The blocks of some clamped nodes.

    Args:
        members: The members of the drawing.
        position: (nodes of the model, 3) [m].
        nodes: (c,) the clamped position nodes.
        sizes: (nodes of the model,) of their symbols [m].
        upwards: (3,) the direction of a block whose members go all ways.
    """
    # Ends of members there: node, member, and away from the clamp.
    slots = [np.flatnonzero(np.isin(members.nodes[:, slot], nodes)) for slot in (0, 2)]
    ends = (
        np.concatenate(
            [members.nodes[rows, slot] for rows, slot in zip(slots, (0, 2), strict=True)]
        ),
        np.concatenate(slots),
        np.concatenate([members.frame[slots[0], :, 0], -members.frame[slots[1], :, 0]]),
    )
    size = float(np.ptp(position, axis=0).max(initial=0.0)) or 1.0
    _, first = np.unique(
        np.round(position[nodes] / (_SAME * size) / 2), axis=0, return_inverse=True
    )

    def made(group: list[int]) -> Symbol:
        return _block(members, position, ends, group, float(sizes[group].max()), upwards)

    groups: dict[int, list[int]] = {}
    for node, key in zip(nodes.tolist(), first.ravel().tolist(), strict=True):
        groups.setdefault(key, []).append(node)
    blocks = [made(group) for group in groups.values()]
    while 1 < len(blocks) <= _MOST:
        # Corners of some are too far apart for them to meet.
        middle = np.array([block.corners.mean(axis=0) for block in blocks])
        arm = np.array([block.corners[0] for block in blocks]) - middle
        radius = np.linalg.norm(arm, axis=1)
        near = np.linalg.norm(middle[:, None] - middle, axis=-1) < radius[:, None] + radius
        pairs = [
            (i, j)
            for i, j in combinations(range(len(blocks)), 2)
            if near[i, j] and (blocks[i].reaches(blocks[j]) or blocks[j].reaches(blocks[i]))
        ]
        if not pairs:
            break
        owner = groups_of(len(blocks), pairs).tolist()
        joined = [
            sorted(n for k, one in zip(owner, blocks, strict=True) if k == each for n in one.held)
            for each in dict.fromkeys(owner)
        ]
        blocks = [made(group) for group in joined]
    return sorted(blocks, key=lambda block: block.held)


def _block(
    members: Members,
    position: FloatArray,
    ends: tuple[np.ndarray, np.ndarray, FloatArray],
    group: list[int],
    size: float,
    upwards: FloatArray,
) -> Symbol:
    """The block of some nodes."""
    rows = np.flatnonzero(np.isin(ends[0], group))
    node, member, away = (each[rows] for each in ends)
    points = position[group]
    mean = away.sum(axis=0)
    direction = unit(mean) if np.linalg.norm(mean) > 1.0e-6 else upwards
    frame = frames_along(direction[None])[0]
    half = np.zeros((0, 3))
    if rows.size:
        widest = int(np.argmax(np.round(members.section[member].max(axis=1) / size, 9)))
        frame = _lying(direction, members.frame[member[widest]], away[widest], points, size)
        sides = members.section[member][:, :, None] / 2
        corner = np.array(list(product((-1.0, 1.0), repeat=2)))
        arms = np.einsum("kxd,kd,cd->kcx", members.frame[member][..., 1:], sides[..., 0], corner)
        half = (position[node][:, None] + arms).reshape(-1, 3)
    local = np.concatenate((points, half)) @ frame
    along = points @ frame[:, 0]
    low, high = local[:, 1:].min(axis=0), local[:, 1:].max(axis=0)
    middle = frame @ np.array((along.max(), *((low + high) / 2)))
    extent, depth = (high - low) / 2 + BESIDE * size, float(np.ptp(along)) + THICK * size
    return Symbol(Support.CLAMP, tuple(sorted(group)), middle, frame, extent, depth, size)


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
    if away @ direction > _UPRIGHT:
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


def _fixed(arrays: ModelArrays) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Of position nodes: which translations and rotations are fixed, which orientations whole.

    (nodes, 3), (nodes, 3) and (nodes,). A coordinate that a planar node does not have counts as
    fixed. Of several orientations at one position one is enough: a member is held there, though
    others may turn.
    """
    mine = np.isin(arrays.coordinate_class.T, (Class.FIXED, Class.NONE))
    moved = mine & (arrays.node_kind <= NodeKind.POSITION)[:, None]
    pairs = turned_at(arrays)
    turned, whole = np.zeros_like(moved), np.zeros(len(moved), bool)
    np.logical_or.at(turned, pairs[:, 0], mine[pairs[:, 1]])
    np.logical_or.at(whole, pairs[:, 0], mine[pairs[:, 1]].all(axis=1))
    return moved, turned, whole


def _outward(nodes: int, members: Members) -> tuple[FloatArray, FloatArray]:
    """(nodes, 3) mean direction of the members at a node, (nodes,) length of the shortest."""
    towards = np.zeros((nodes, 3))
    room = np.full(nodes, np.inf)
    for slot, sign in ((0, 1.0), (2, -1.0)):
        np.add.at(towards, members.nodes[:, slot], sign * members.frame[..., 0])
        long = members.length > 0.0
        np.minimum.at(room, members.nodes[long, slot], members.length[long])
    towards[np.linalg.norm(towards, axis=1) < 1.0e-6] = 0.0
    return unit(towards), room


def _upright(direction: FloatArray) -> FloatArray:
    """(k, 3) the global axes nearest to directions; of equally near ones the last."""
    axis = 2 - np.argmax(np.round(np.abs(direction[:, ::-1]), 6), axis=1)
    made: FloatArray = np.eye(3)[axis]
    made[np.sum(made * direction, axis=1) < 0.0] *= -1.0
    return made


def arrows_of(arrays: ModelArrays) -> tuple[np.ndarray, FloatArray, np.ndarray]:
    """The independent coordinates of a model, those of positions first.

    A rotation has one arrow, at the first position that turns with it.

    Returns:
        (a,) position nodes, (a, 3) unit vectors along or about which each moves, and (a,) whether
        it is a rotation.
    """
    node, axis = np.argwhere((arrays.coordinate_class == Class.INDEPENDENT).T).T
    pairs = turned_at(arrays)
    place = np.full(arrays.node_kind.size, -1)
    place[pairs[::-1, 1]] = pairs[::-1, 0]
    turning = arrays.node_kind[node] > NodeKind.POSITION
    node = np.where(turning, place[node], node)
    rows = np.argsort(turning, kind="stable")
    rows = rows[node[rows] >= 0]
    return node[rows], np.eye(3)[axis[rows]], turning[rows]
