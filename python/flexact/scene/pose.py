"""Where all nodes of a scene are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..configuration import Configuration
from ..elements import NodeKind
from ..exchange import FloatArray, ModelArrays
from ..frozen import Frozen
from .rotations import matrix_of, matrix_of_euler


@dataclass(frozen=True, eq=False)
class Pose(Frozen):
    """Where all nodes are.

    Attributes:
        position: (nodes, 3) of positions [m]; zero for orientations.
        rotation: (nodes, 3, 3) since the reference; the identity for positions.
    """

    position: FloatArray
    rotation: FloatArray


def reference_pose(arrays: ModelArrays) -> Pose:
    """The pose in which all deformations are zero."""
    placed = arrays.node_kind <= NodeKind.POSITION
    position = np.where(placed, arrays.node_value[:3], 0.0).T
    return Pose(position, np.broadcast_to(np.eye(3), (placed.size, 3, 3)).copy())


def pose_of(arrays: ModelArrays, configuration: Configuration) -> Pose:
    """The pose that a configuration means."""
    kind, value = arrays.node_kind, configuration.value
    placed = kind <= NodeKind.POSITION
    rotation = np.broadcast_to(np.eye(3), (kind.size, 3, 3)).copy()
    turned = kind == NodeKind.ORIENTATION
    now, then = matrix_of_euler(value[turned]), matrix_of_euler(arrays.node_value.T[turned])
    rotation[turned] = now @ np.swapaxes(then, -1, -2)
    angle = np.zeros((kind.size, 3))
    angle[:, 2] = np.where(kind == NodeKind.ANGLE, value[:, 0] - arrays.node_value[0], 0.0)
    plane = kind == NodeKind.ANGLE
    rotation[plane] = matrix_of(angle[plane])
    return Pose(np.where(placed[:, None], value[:, :3], 0.0), rotation)
