# SPDX-License-Identifier: BSD-3-Clause
"""What moves in a page: places and turns of everything drawn, phase by phase.

The viewer computes no shapes. It has those of the reference, and of each movement by how much
they differ from it at some phases; between two phases it goes straight.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ...core.arrays import FloatArray
from ...core.elements import NodeKind
from ..drawing import Movement, Pose, axes_of, stations
from ..drawing.rotations import euler_of
from .drawing import Frame, hinges_in
from .limits import MOST_MEMBERS, MOST_SHAPES
from .packing import floats, integers, shorts

#: Pieces of bent members, where there are up to so many of them.
_SEGMENTS = ((400, 16), (2000, 8), (MOST_MEMBERS, 4))
#: What differs by no more than this part of the drawing's size, or of a turn, stays.
_STILL = 1.0e-9
#: The largest number of 16 bits.
_LARGEST = 32767

#: Of nodes, of stations, of their cross-sections (Euler parameters), and of axes of hinges.
State = dict[str, FloatArray]


class Tracks:
    """The shapes of a drawing in its poses."""

    def __init__(self, frame: Frame, most: int = 16, room: int = MOST_SHAPES) -> None:
        """The shapes in the reference.

        Bent members are in at most so many pieces; a movement takes so many bytes, if it can.
        """
        self.frame, self.room = frame, room
        self.members = frame.drawing.members
        self.chosen = np.arange(len(self.members)) < MOST_MEMBERS
        bends = self.members.bends[:MOST_MEMBERS]
        count = int(np.count_nonzero(bends))
        self.segments = min(most, next(pieces for up_to, pieces in _SEGMENTS if count <= up_to))
        #: Of each member the first station, and the first cross-section: straight ones have one.
        counts = np.where(bends[:, None], self.segments + 1, (2, 1))
        self.station, self.section = (np.cumsum(counts, axis=0) - counts).T
        self.owner = [np.repeat(np.arange(len(bends)), each) for each in counts.T]
        stations, sections = counts.sum(axis=0).tolist()
        empty = {"centre": np.zeros((stations, 3)), "section": np.zeros((sections, 4))}
        self.reference = self._state(frame.drawing.reference, empty, self.chosen)

    def data(self) -> dict[str, Any]:
        """The reference."""
        return {name: floats(values) for name, values in self.reference.items()}

    def movement(self, movement: Movement) -> tuple[dict[str, Any], int]:
        """A movement, and the bytes that it takes.

        At all its phases, or, if that takes much room, at fewer.
        """
        poses = movement.poses
        ends = [self._state(poses[k], self.reference, self.chosen) for k in (0, -1)]
        rows = {
            name: np.flatnonzero(
                np.abs([end[name] - still for end in ends]).max(axis=(0, 2), initial=0.0) > _STILL
            )
            for name, still in self.reference.items()
        }
        numbers = sum(rows[name].size * still.shape[1] for name, still in self.reference.items())
        steps = [2**k for k in range(4) if 2 * numbers * (len(poses) // 2**k) <= self.room]
        moving = np.zeros_like(self.chosen)
        for owner, name in zip(self.owner, ("centre", "section"), strict=True):
            moving[owner[rows[name]]] = True
        inner = poses[:: min(steps, default=8)][1:-1]
        states = [ends[0], *(self._state(pose, self.reference, moving) for pose in inner), ends[1]]
        made = {}
        for name, still in self.reference.items():
            there = rows[name]
            change = np.stack([state[name][there] for state in states]) - still[there]
            largest = float(np.abs(change).max(initial=0.0))
            whole = np.rint(change * (_LARGEST / (largest or 1.0)))
            unit = largest / _LARGEST
            made[name] = {"rows": integers(there), "unit": unit, "change": shorts(whole)}
        size = 2 * numbers * len(states)
        return {"phases": len(states), "tracks": made}, size

    def _state(self, pose: Pose, still: State, moving: np.ndarray) -> State:
        """The shapes in a pose; members that are not `moving` are as in `still`."""
        frame, drawing = self.frame, self.frame.drawing
        placed = drawing.data.arrays.node_kind[frame.kept] <= NodeKind.POSITION
        position = frame.places(pose.position[frame.kept])
        centre, section = still["centre"].copy(), still["section"].copy()
        for strip in stations(self.members, pose, self.segments, moving):
            every = np.arange(strip.at.size)
            centre[self.station[strip.member][:, None] + every] = frame.places(strip.centre)
            every = every if every.size > 2 else every[:1]
            there = self.section[strip.member][:, None] + every
            turns = euler_of(strip.frame[:, every])
            # Of the two that mean the same, the one that is nearer.
            turns[np.sum(turns * still["section"][there], axis=-1) < 0.0] *= -1.0
            section[there] = turns
        turned = axes_of(drawing.hinges, pose, hinges_in(frame)).frame[:, 0]
        return {
            "position": np.where(placed[:, None], position, 0.0),
            "centre": centre,
            "section": section,
            "axis": turned[..., 0],
        }
