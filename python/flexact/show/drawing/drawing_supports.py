# SPDX-License-Identifier: BSD-3-Clause
"""Symbols of what is declared about nodes: supports, and degrees of freedom."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from ...core.arrays import FloatArray, ModelArrays
from ...core.elements import Class, NodeKind
from ...util.records import Frozen
from .members import Members
from .places import turned_at
from .rotations import frames_along, unit
from .supports import BESIDE, Block, blocks_of

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


@dataclass(frozen=True, eq=False)
class Supports(Frozen):
    """Symbols of fixed coordinates.

    Attributes:
        node: (s,) position node; the first of those that a block clamps.
        kind: (s,) `Support`.
        frame: (s, 3, 3) columns: the unit vector from the ground towards what is held, and two
            across it, of a clamp along the section of the widest member that it holds or along
            the points that it clamps.
        extent: (s, 2) half sizes along these two [m].
        size: (s,) [m].
        offset: (s, 3) from the node to where the symbol stands, of a block to the middle of its
            face [m].
        depth: (s,) thickness of a block [m].
        held: All the position nodes that each holds: of a block several.
    """

    node: np.ndarray
    kind: np.ndarray
    frame: FloatArray
    extent: FloatArray
    size: FloatArray
    offset: FloatArray
    depth: FloatArray
    held: tuple[tuple[int, ...], ...]

    @property
    def direction(self) -> FloatArray:
        """(s, 3) unit vectors from the ground towards what is held."""
        return self.frame[..., 0]

    def __len__(self) -> int:
        """How many there are."""
        return int(self.node.size)


@dataclass(frozen=True, eq=False)
class Arrows(Frozen):
    """Symbols of independent coordinates: declared degrees of freedom.

    Attributes:
        node: (a,) position node.
        direction: (a, 3) unit vectors along or about which it moves.
        turning: (a,) whether it is a rotation.
    """

    node: np.ndarray
    direction: FloatArray
    turning: np.ndarray

    def __len__(self) -> int:
        """How many there are."""
        return int(self.node.size)


def supports_of(arrays: ModelArrays, members: Members, size: float) -> Supports:
    """The supports of a model whose drawing has this size [m]."""
    moved, turned, whole = _fixed(arrays)
    positions = np.flatnonzero(arrays.node_kind <= NodeKind.POSITION)
    held = moved[positions].all(axis=1)
    clamped = held & whole[positions]
    partly = positions[~clamped]
    rows: list[tuple[np.ndarray, Support, int | None]] = [
        (positions[clamped], Support.CLAMP, None),
        (positions[held & ~clamped], Support.PIN, None),
    ]
    spatial = arrays.node_kind == NodeKind.POSITION
    for axis in range(3):
        slides = partly[moved[partly, axis] & ~moved[partly].all(axis=1)]
        # In the plane, z is not a coordinate that could be fixed or free.
        rows.append((slides if axis < 2 else slides[spatial[slides]], Support.SLIDE, axis))
        turns = partly[turned[partly, axis]]
        rows.append((turns if axis == 2 else turns[spatial[turns]], Support.TURN, axis))
    outward, room = _outward(arrays.node_kind.size, members)
    outward[~np.any(outward != 0.0, axis=1)] = (0.0, 0.0, 1.0) if spatial.any() else (0.0, 1.0, 0.0)
    node = np.concatenate([each for each, _, _ in rows])
    kind = np.concatenate([np.full(each.size, support) for each, support, _ in rows])
    direction = np.concatenate(
        [outward[each] if axis is None else _along(axis, outward[each]) for each, _, axis in rows]
    )
    # A pyramid stands straight.
    pinned = kind == Support.PIN
    direction[pinned] = _upright(direction[pinned])
    sizes = np.minimum(_PART * size, np.maximum(_LIMIT * room[node], _SMALLEST * size))
    others = np.flatnonzero(kind != Support.CLAMP)
    place = arrays.node_value[:3].T
    clamps = node[kind == Support.CLAMP]
    upwards = np.array((0.0, 0.0, 1.0) if spatial.any() else (0.0, 1.0, 0.0))
    blocks = blocks_of(members, place, clamps, sizes[kind == Support.CLAMP], upwards)
    first = np.array([block.nodes[0] for block in blocks], np.int64)
    middle = np.array([block.middle for block in blocks]).reshape(-1, 3)
    return Supports(
        np.concatenate((first, node[others])),
        np.concatenate((np.full(len(blocks), Support.CLAMP), kind[others])),
        np.concatenate((_stacked(blocks, "frame", (3, 3)), frames_along(direction[others]))),
        np.concatenate((_stacked(blocks, "extent", (2,)), BESIDE * sizes[others, None] * [1, 1])),
        np.concatenate((_stacked(blocks, "size", ()), sizes[others])),
        np.concatenate((middle - place[first], np.zeros((others.size, 3)))),
        np.concatenate((_stacked(blocks, "depth", ()), np.zeros(others.size))),
        (*(block.nodes for block in blocks), *((each,) for each in node[others].tolist())),
    )


def _stacked(blocks: list[Block], name: str, shape: tuple[int, ...]) -> FloatArray:
    return np.array([getattr(block, name) for block in blocks], float).reshape(-1, *shape)


def arrows_of(arrays: ModelArrays) -> Arrows:
    """The independent coordinates of a model, those of positions first.

    A rotation has one arrow, at the first position that turns with it.
    """
    node, axis = np.argwhere((arrays.coordinate_class == Class.INDEPENDENT).T).T
    pairs = turned_at(arrays)
    place = np.full(arrays.node_kind.size, -1)
    place[pairs[::-1, 1]] = pairs[::-1, 0]
    turning = arrays.node_kind[node] > NodeKind.POSITION
    node = np.where(turning, place[node], node)
    rows = np.argsort(turning, kind="stable")
    rows = rows[node[rows] >= 0]
    return Arrows(node[rows], np.eye(3)[axis[rows]], turning[rows])


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


def _along(axis: int, outward: FloatArray) -> FloatArray:
    """(k, 3) the axis, to the side on which the members are."""
    side = np.where(outward[:, axis] < 0.0, -1.0, 1.0)
    return np.asarray(side[:, None] * np.eye(3)[axis])
