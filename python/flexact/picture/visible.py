"""Members that are not invisible: an opacity of 0 leaves nothing of them, not even an outline."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..exchange import FloatArray
from ..scene import Members, Pose, Scene, Strip, joints_of, stations


def visible_stations(members: Members, pose: Pose, segments: int) -> Iterator[Strip]:
    """As `stations`, of the members that are seen."""
    for strip in stations(members, pose, segments):
        rows = np.flatnonzero(members.opacity[strip.member] > 0.0)
        if rows.size:
            yield Strip(strip.member[rows], strip.at, strip.centre[rows], strip.frame[rows])


def visible_joints(scene: Scene) -> tuple[np.ndarray, FloatArray]:
    """As `joints_of`, of the joints at which members end that are seen."""
    node, radius = joints_of(scene)
    ends = scene.members.nodes[scene.members.opacity > 0.0][:, [0, 2]]
    shown = np.isin(node, ends)
    return node[shown], radius[shown]
