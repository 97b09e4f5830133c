# SPDX-License-Identifier: BSD-3-Clause
"""Movements and self-stresses as data of a page."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from ...analysis.freedoms import Freedom
from ...analysis.naming import freedom_in_words, plain
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...core.elements import NodeKind
from ...util.partial import attempted
from ...util.rotations import euler_of
from ..drawing import (
    QUANTITIES,
    UNITS,
    Drawing,
    Movement,
    Moving,
    Pose,
    axes_of,
    move,
    reach_of,
    resultants,
    stations,
)
from ..drawing.selection import way_of
from .assets import (
    FEW_MODES,
    MANY_ELEMENTS,
    MOST_ELEMENTS,
    MOST_MEMBERS,
    MOST_MODES,
    MOST_POSES,
    MOST_SHAPES,
    floats,
    integers,
    shorts,
)
from .drawing import Frame, hinges_in

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


#: Below this part of the largest resultant a quantity is rounding.
_NOTHING = 1.0e-9
#: Displacements (parts of the drawing's size) and rotations [rad] that nobody sees.
_UNSEEN = 1.0e-5


def movements(analysis: Result, tracks: Tracks, missing: list[str]) -> list[dict[str, Any]]:
    """The motions, then the declared degrees of freedom; as many as fit and can be drawn.

    What cannot be drawn is told in `missing`; of motions none is drawn behind it, as their
    places are their numbers.
    """
    made: list[dict[str, Any]] = []
    size, drawing = 0, tracks.frame.drawing
    without: set[str] = set()

    def drawn(shown: Moving | Freedom) -> tuple[dict[str, Any], int] | None:
        found = way_of(shown) if isinstance(shown, Freedom) else shown
        if found is None:
            return None
        movement = move(drawing, found)
        data, added = tracks.movement(movement)
        return {"note": _note(drawing, movement), **data}, added

    is_large = analysis.given.arrays.element_number.size > MANY_ELEMENTS
    motions = analysis.motions[: FEW_MODES if is_large else MOST_MODES]
    chosen: list[tuple[str, str, str, Moving | Freedom]] = [
        ("motion", f"Motion {k}", f"Motion {k}", each) for k, each in enumerate(motions, start=1)
    ]
    for freedom in looked_at(analysis):
        words = plain(freedom_in_words(freedom))
        chosen.append(("freedom", words, f"Degree of freedom: {words}", freedom))
    for kind, label, title, motion in chosen:
        if kind == "motion" and kind in without:
            continue
        before = len(missing)
        data = attempted(f"The drawing of {title}", partial(drawn, motion), None, missing)
        if len(missing) > before:
            without.add(kind)
        if data is None:
            continue
        size += data[1]
        if made and size > MOST_POSES:
            break
        made.append({"kind": kind, "label": label, "title": title, **data[0]})
    return made


def looked_at(analysis: Result) -> tuple[Freedom, ...]:
    """The declared degrees of freedom whose motions are asked for."""
    if analysis.given.arrays.element_number.size > MOST_ELEMENTS:
        return ()
    return analysis.freedoms[:MOST_MODES]


def _note(drawing: Drawing, movement: Movement) -> str:
    """On what the poses lie, and how far they go."""
    largest, angle = reach_of(drawing, (movement.poses[0], movement.poses[-1]))
    share = largest / drawing.size
    far = "no displacements"
    if share > _UNSEEN:
        far = f"displacements up to {100 * share:.2g}\N{NO-BREAK SPACE}% of the model's size"
    turned = f" and rotations up to {angle:.2g}\N{NO-BREAK SPACE}rad" * (angle > _UNSEEN)
    return f"{movement.remark} Drawn with {far}{turned}."


def stresses(analysis: Result, frame: Frame, missing: list[str]) -> list[dict[str, Any]]:
    """The self-stresses, each with the quantities that it has, up to one that cannot be drawn."""
    rows = hinges_in(frame)
    made: list[dict[str, Any]] = []
    for number, stress in enumerate(analysis.self_stresses[:MOST_MODES], start=1):
        what = f"The drawing of self-stress {number}"
        found = attempted(what, partial(resultants, frame.drawing, stress), None, missing)
        if found is None:
            break
        weight = {each: 1.0 if UNITS[each] == "N" else 1.0 / found.length for each in QUANTITIES}
        sizes = {each: found.largest(each) * weight[each] for each in QUANTITIES}
        there = [each for each in QUANTITIES if sizes[each] > _NOTHING * max(sizes.values())]
        hinges = {each: found.hinges[rows, QUANTITIES.index(each)] for each in there}
        made.append(
            {
                "title": f"Self-stress {number}",
                "dominant": found.dominant,
                "largest": {each: found.largest(each) for each in there},
                "members": {each: floats(found[each][:MOST_MEMBERS]) for each in there},
                "hinges": {each: floats(values) for each, values in hinges.items()},
            }
        )
    return made
