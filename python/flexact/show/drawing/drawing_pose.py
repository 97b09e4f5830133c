# SPDX-License-Identifier: BSD-3-Clause
"""Where all nodes of a drawing are, and what moves them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ...analysis.velocities import Velocities
from ...core.arrays import FloatArray, ModelArrays
from ...core.elements import NodeKind
from ...model.configuration import Configuration
from ...model.parts.condensing import Condensed
from ...util.records import Frozen
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


class Moving(Protocol):
    """A motion at the nodes: of an analysis, or of a declared degree of freedom."""

    @property
    def condensed(self) -> Condensed:
        """The model at whose nodes it is a motion, and the one that was analysed."""

    @property
    def analysed(self) -> Velocities:
        """The velocities of the latter's nodes; nothing determines them in its model."""

    @property
    def displacement(self) -> FloatArray:
        """(nodes, 3) of the model as given [m]."""

    @property
    def rotation(self) -> FloatArray:
        """(nodes, 3) likewise [rad]."""


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
