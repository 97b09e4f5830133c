"""Where members turn freely about their ends."""

from __future__ import annotations

import numpy as np

from ..exchange import FloatArray
from .scene import Scene

#: Diameter of a joint, times that of the bars.
_BALL = 1.9


def joints_of(scene: Scene) -> tuple[np.ndarray, FloatArray]:
    """(j,) position nodes about which members turn freely, (j,) radii of their joints [m].

    Bars do, and members that end at one position with different orientations, unless a hinge
    stands there.
    """
    members = scene.members
    nodes = scene.reference.position.shape[0]
    place = members.nodes[:, [0, 2]].ravel()
    turn = members.nodes[:, [1, 3]].copy()
    # The far end of a rigid link turns with its near end.
    turn[:, 1] = np.where(turn[:, 1] < 0, turn[:, 0], turn[:, 1])
    turn = turn.ravel()
    thick = np.repeat(members.section.max(axis=1), 2)
    bar = turn < 0
    size, solid_size = np.zeros(nodes), np.full(nodes, np.inf)
    np.maximum.at(size, place[bar], _BALL * thick[bar])
    pairs = np.unique(np.stack((place[~bar], turn[~bar]), axis=1), axis=0)
    orientations = np.bincount(pairs[:, 0], minlength=nodes)
    np.minimum.at(solid_size, place[~bar], thick[~bar])
    pinned = orientations > 1
    size[pinned] = np.maximum(size[pinned], 1.15 * solid_size[pinned])
    bars = np.bincount(place[bar], minlength=nodes)
    size[(orientations == 0) & (bars == 0)] = 0.0
    size[scene.hinges.nodes[scene.hinges.nodes[:, 0] >= 0, 0]] = 0.0
    node = np.flatnonzero(size > 0.0)
    return node, size[node] / 2
