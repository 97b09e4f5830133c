"""Symbols of what is declared about nodes: supports, and degrees of freedom."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from ..elements import Class, NodeKind
from ..exchange import FloatArray, ModelArrays
from ..frozen import Frozen
from .members import Members
from .places import turned_at
from .rotations import unit

#: Part of the scene's size, and of the shortest member at the node.
_PART = 0.045
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
        node: (s,) position node.
        kind: (s,) `Support`.
        direction: (s, 3) unit vectors, from the ground towards what is held.
        size: (s,) [m].
    """

    node: np.ndarray
    kind: np.ndarray
    direction: FloatArray
    size: FloatArray

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
    """The supports of a model whose scene has this size [m]."""
    moved, turned = _where(arrays, Class.FIXED)
    positions = np.flatnonzero(arrays.node_kind <= NodeKind.POSITION)
    held = moved[positions].all(axis=1)
    clamped = held & turned[positions].all(axis=1)
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
    return Supports(node, kind, direction, np.minimum(_PART * size, _LIMIT * room[node]))


def arrows_of(arrays: ModelArrays) -> Arrows:
    """The independent coordinates of a model, those of positions first."""
    moved, turned = _where(arrays, Class.INDEPENDENT, anywhere=True)
    node, axis = np.concatenate((np.argwhere(moved), np.argwhere(turned))).T
    turning = np.arange(node.size) >= np.count_nonzero(moved)
    return Arrows(node, np.eye(3)[axis], turning)


def _where(
    arrays: ModelArrays, wanted: Class, anywhere: bool = False
) -> tuple[np.ndarray, np.ndarray]:
    """(nodes, 3) each: which translations and rotations of position nodes are of a class.

    A translation or rotation that a planar node does not have counts as fixed. Of several
    orientations at one position all must be of the class, or, `anywhere`, one of them.
    """
    mine = (arrays.coordinate_class == wanted).T
    position = arrays.node_kind <= NodeKind.POSITION
    lacking = (arrays.coordinate_class == Class.NONE).T & (wanted == Class.FIXED)
    moved = (mine | lacking) & position[:, None]
    pairs = turned_at(arrays)
    turned = np.zeros_like(moved)
    there = (mine | lacking)[pairs[:, 1]]
    if anywhere:
        np.logical_or.at(turned, pairs[:, 0], there)
    else:
        turned[pairs[:, 0]] = True
        np.logical_and.at(turned, pairs[:, 0], there)
    return moved, turned


def _outward(nodes: int, members: Members) -> tuple[FloatArray, FloatArray]:
    """(nodes, 3) mean direction of the members at a node, (nodes,) length of the shortest."""
    towards = np.zeros((nodes, 3))
    room = np.full(nodes, np.inf)
    for slot, sign in ((0, 1.0), (2, -1.0)):
        np.add.at(towards, members.nodes[:, slot], sign * members.frame[..., 0])
        np.minimum.at(room, members.nodes[:, slot], members.length)
    towards[np.linalg.norm(towards, axis=1) < 1.0e-6] = 0.0
    return unit(towards), room


def _along(axis: int, outward: FloatArray) -> FloatArray:
    """(k, 3) the axis, to the side on which the members are."""
    side = np.where(outward[:, axis] < 0.0, -1.0, 1.0)
    return np.asarray(side[:, None] * np.eye(3)[axis])
