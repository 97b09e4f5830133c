# SPDX-License-Identifier: BSD-3-Clause
"""Where the nodes inside a divided sheet or wire are when its ends have moved."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ...core.arrays import FloatArray
from ...model.parts.condensing import Condensed, InnerNodes
from .drawing_pose import Pose
from .rotations import matrix_of, vector_of


def poses_with_inner_nodes(condensed: Condensed, poses: Iterable[Pose]) -> tuple[Pose, ...]:
    """Poses of the model as it was given, from those of the model as it was analysed.

    Between its ends a divided sheet or wire is cubic about its chord, as one beam is.
    """
    if not condensed.chains:
        return tuple(poses)
    return tuple(_whole(condensed, pose) for pose in poses)


def _whole(condensed: Condensed, pose: Pose) -> Pose:
    nodes = condensed.given.arrays.node_number.size
    position, rotation = np.zeros((nodes, 3)), np.broadcast_to(np.eye(3), (nodes, 3, 3)).copy()
    position[condensed.nodes], rotation[condensed.nodes] = pose.position, pose.rotation
    for inner in condensed.inner:
        place, turned = _between(inner, position[inner.ends[[0, 2]]], rotation[inner.ends[[1, 3]]])
        position[inner.positions], rotation[inner.orientations] = place, turned
    return Pose(position, rotation)


def _between(
    inner: InnerNodes, ends: FloatArray, turns: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Positions (k, 3) and rotations (k, 3, 3) of inner nodes."""
    carried = _carried(inner.chord, ends[1] - ends[0], turns)
    local = vector_of(np.swapaxes(carried, -1, -2) @ turns)
    moved, turned = inner.between(np.zeros((2, 3)), local)
    beside = inner.share[:, None] * inner.chord + inner.offset + moved
    stretch = (ends[1] - ends[0]) - carried @ inner.chord
    place = ends[0] + beside @ carried.T + inner.share[:, None] * stretch
    return place, carried @ matrix_of(turned)


def _carried(chord: FloatArray, now: FloatArray, turns: FloatArray) -> FloatArray:
    """(3, 3) the rotation that the beam makes as a whole: with its ends, and with its chord."""
    half = vector_of(turns[0].T @ turns[1]) / 2.0
    mean = turns[0] @ matrix_of(half)
    along = mean @ chord / np.linalg.norm(chord)
    length = float(np.linalg.norm(now))
    if not length > 0.0:
        return np.asarray(mean)
    to = now / length
    axis = np.cross(along, to)
    sine, cosine = float(np.linalg.norm(axis)), float(along @ to)
    if sine <= 0.0:
        return np.asarray(mean)
    return np.asarray(matrix_of(axis / sine * np.arctan2(sine, cosine)) @ mean)
