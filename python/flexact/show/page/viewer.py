# SPDX-License-Identifier: BSD-3-Clause
"""What a page's viewer shows of a result, as data.

Movements and self-stresses, freedom and constraint spaces of a body, and what flexures hold.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from ...advice.spaces.spaces import Spaces
from ...analysis.freedoms import Freedom
from ...analysis.holding import BodyHolding
from ...analysis.naming import Named, freedom_in_words, plain
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...core.elements import NodeKind
from ...model.configuration import Configuration
from ...model.data import ModelData
from ...model.parts.parts import Part, Parts
from ...util.partial import attempted
from ...util.rotations import euler_of
from ...util.text import harmless
from ..drawing import (
    QUANTITIES,
    UNITS,
    Movement,
    Moving,
    Pose,
    axes_of,
    move,
    reach_of,
    resultants,
    stations,
    swing,
)
from ..drawing.movement import MOST_COORDINATES
from ..drawing.presses import SECOND, Press, presses_in_words, presses_of
from ..drawing.selection import way_of
from ..spaces import SpaceShown, dashes, holds_shown, spaces_shown
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
from .drawing import Frame, hinges_in, static_data

#: Pieces of bent members, where there are up to so many of them.
_SEGMENTS = ((400, 16), (2000, 8), (MOST_MEMBERS, 4))
#: What differs by no more than this part of the drawing's size, or of a turn, stays.
_STILL = 1.0e-9
#: Members in poses that are looked at together.
_AT_ONCE = 2000
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
        ends = self._states((poses[0], poses[-1]), self.chosen)
        rows = {
            name: np.flatnonzero(np.abs(ends[name] - still).max(axis=(0, 2), initial=0.0) > _STILL)
            for name, still in self.reference.items()
        }
        numbers = sum(rows[name].size * still.shape[1] for name, still in self.reference.items())
        steps = [2**k for k in range(4) if 2 * numbers * (len(poses) // 2**k) <= self.room]
        moving = np.zeros_like(self.chosen)
        for owner, name in zip(self.owner, ("centre", "section"), strict=True):
            moving[owner[rows[name]]] = True
        inner = poses[:: min(steps, default=8)][1:-1]
        between = self._states(inner, moving)
        made = {}
        for name, still in self.reference.items():
            there, end = rows[name], ends[name][:, rows[name]]
            every = np.concatenate((end[:1], between[name][:, there], end[1:]))
            change = every - still[there]
            largest = float(np.abs(change).max(initial=0.0))
            whole = np.rint(change * (_LARGEST / (largest or 1.0)))
            unit = largest / _LARGEST
            made[name] = {"rows": integers(there), "unit": unit, "change": shorts(whole)}
        phases = len(inner) + 2
        return {"phases": phases, "tracks": made}, 2 * numbers * phases

    def _states(self, poses: Sequence[Pose], moving: np.ndarray) -> State:
        """The shapes in several poses, in a first axis more; of many members one by one."""
        many = max(1, _AT_ONCE // max(len(self.members), 1))
        found = []
        for k in range(0, len(poses), many):
            some = poses[k : k + many]
            pose = Pose(
                np.array([each.position for each in some]),
                np.array([each.rotation for each in some]),
            )
            found.append(self._state(pose, self.reference, moving))
        return {name: np.concatenate([each[name] for each in found]) for name in self.reference}

    def _state(self, pose: Pose, still: State, moving: np.ndarray) -> State:
        """The shapes in a pose; members that are not `moving` are as in `still`."""
        frame, drawing = self.frame, self.frame.drawing
        placed = drawing.data.arrays.node_kind[frame.kept] <= NodeKind.POSITION
        position = frame.places(pose.position[..., frame.kept, :])
        many = pose.position.shape[:-2]
        centre, section = (
            np.broadcast_to(still[name], (*many, *still[name].shape)).copy()
            for name in ("centre", "section")
        )
        for strip in stations(self.members, pose, self.segments, moving):
            every = np.arange(strip.at.size)
            place = self.station[strip.member][:, None] + every
            centre[..., place, :] = frame.places(strip.centre)
            every = every if every.size > 2 else every[:1]
            there = self.section[strip.member][:, None] + every
            turns = euler_of(strip.frame[..., every, :, :])
            # Of the two that mean the same, the one that is nearer.
            turns[np.sum(turns * still["section"][there], axis=-1) < 0.0] *= -1.0
            section[..., there, :] = turns
        turned = axes_of(drawing.hinges, pose, hinges_in(frame)).frame[..., 0, :, :]
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


def _fitting(every: Iterable[tuple[dict[str, Any], int]]) -> list[dict[str, Any]]:
    """As many movements as fit, of which each has so many bytes; at least one."""
    made: list[dict[str, Any]] = []
    size = 0
    for movement, added in every:
        size += added
        if made and size > MOST_POSES:
            break
        made.append(movement)
    return made


#: Of a motion that is shown before it was followed.
_NOT_YET = "Being followed; until then drawn along its velocities."


def movements(
    analysis: Result,
    tracks: Tracks,
    missing: list[str],
    most: int = MOST_MODES,
    follows: int = MOST_COORDINATES,
) -> Iterator[tuple[dict[str, Any], int]]:
    """The motions, then the declared degrees of freedom, those that can be drawn; their bytes.

    What cannot be drawn is told in `missing`; of motions none is drawn behind it, as their
    places are their numbers. Of declared degrees of freedom there are at most so many.
    """
    drawing = tracks.frame.drawing

    def drawn(shown: Moving | Freedom) -> tuple[dict[str, Any], int] | None:
        found = way_of(shown) if isinstance(shown, Freedom) else shown
        if found is None:
            return None
        movement = move(drawing, found, follows)
        if not follows:
            movement = replace(movement, about=_NOT_YET)
        largest, angle = movement.farthest
        share = largest / drawing.size
        far = "no displacements"
        if share > _UNSEEN:
            far = f"displacements up to {100 * share:.2g}\N{NO-BREAK SPACE}% of the model's size"
        turned = f" and rotations up to {angle:.2g}\N{NO-BREAK SPACE}rad" * (angle > _UNSEEN)
        data, added = tracks.movement(movement)
        return {"note": f"{movement.remark} Drawn with {far}{turned}.", **data}, added

    is_large = analysis.given.arrays.element_number.size > MANY_ELEMENTS
    motions = analysis.motions[: FEW_MODES if is_large else MOST_MODES]
    chosen: list[tuple[str, str, str, Moving | Freedom]] = [
        ("motion", f"Motion {k}", f"Motion {k}", each) for k, each in enumerate(motions, start=1)
    ]
    for freedom in looked_at(analysis)[:most]:
        words = plain(freedom_in_words(freedom))
        chosen.append(("freedom", words, f"Degree of freedom: {words}", freedom))
    without = None
    for kind, label, title, motion in chosen:
        if kind == "motion" and kind == without:
            continue
        before = len(missing)
        data = attempted(f"The drawing of {title}", partial(drawn, motion), None, missing)
        if len(missing) > before:
            without = kind
        if data is not None:
            yield {"kind": kind, "label": label, "title": title, **data[0]}, data[1]


def looked_at(analysis: Result) -> tuple[Freedom, ...]:
    """The declared degrees of freedom whose motions are asked for."""
    if analysis.given.arrays.element_number.size > MOST_ELEMENTS:
        return ()
    return analysis.freedoms[:MOST_MODES]


def stresses(analysis: Result, frame: Frame, missing: list[str]) -> list[dict[str, Any]]:
    """The self-stresses, each with the quantities that it has, up to one that cannot be drawn."""
    rows, units = hinges_in(frame), analysis.given.units
    factors = {each: units.factor(unit) for each, unit in UNITS.items()}
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
                "presses": _presses(presses_of(frame.drawing, stress), frame, found.length),
                "dominant": found.dominant,
                "largest": {each: factors[each] * found.largest(each) for each in there},
                "members": {
                    each: floats(factors[each] * found[each][:MOST_MEMBERS]) for each in there
                },
                "hinges": {each: floats(factors[each] * values) for each, values in hinges.items()},
            }
        )
    return made


def _presses(presses: Sequence[Press], frame: Frame, length: float) -> dict[str, Any]:
    """Arrows by the nodes with which they move: where each begins beside it, and its way there.

    A moment has two arrows, one of them shorter, of which the heads are seen.
    """
    rows = [(each, part) for each in presses for part in (1.0, SECOND)[: 1 + each.is_moment]]
    rows = [(each, part) for each, part in rows if frame.new[each.node] >= 0]
    place = frame.drawing.reference.position
    offset = [each.start - place[each.node] for each, _ in rows]
    way = [part * (each.end - each.start) for each, part in rows]
    return {
        "node": integers([frame.new[each.node] for each, _ in rows]),
        "offset": floats(np.reshape(offset, (-1, 3)) / frame.size),
        "way": floats(np.reshape(way, (-1, 3)) / frame.size),
        "note": presses_in_words(length, frame.drawing.data.units) if rows else "",
    }


def body_named(analysis: Result, holding: BodyHolding) -> Named:
    """A body, or a point that flexures carry, by its first element or its node."""
    of, arrays = holding.of, analysis.given.arrays
    if isinstance(of, Part):
        return Named("element", int(arrays.element_number[of.elements[0]]), holding.name)
    return Named("node", int(arrays.node_number[of.nodes[0]]), holding.name)


def held_data(analysis: Result) -> list[dict[str, Any]]:
    """Of each body how often it is held, in words, and the numbers of elements that hold it."""
    numbers = analysis.given.arrays.element_number
    return [
        {
            "words": harmless(f"{each.words}."),
            body_named(analysis, each).kind: body_named(analysis, each).number,
            "own": numbers[list(each.of.elements)].tolist() if isinstance(each.of, Part) else [],
            "by": numbers[[k for part in each.by for k in part.elements]].tolist(),
        }
        for each in analysis.bodies
    ]


#: Of more flexures what they hold is shown together alone.
_MOST_HOLDS = 12


def holds_data(analysis: Result, frame: Frame) -> list[dict[str, Any]]:
    """What each flexure of an exactly constrained mechanism holds: all together, then each."""
    return [
        _space(each, frame, each.words, held=True)
        for each in holds_shown(analysis, frame.size, frame.planar, _MOST_HOLDS)
    ]


def _space(shown: SpaceShown, frame: Frame, words: str, **more: bool) -> dict[str, Any]:
    """Pieces of lines and arrows by their ends, and faces as triangles."""
    shape = shown.shape
    pieces = [np.stack((line[:-1], line[1:]), axis=1) for line in shape.lines]
    corners, triangles, behind = [], [], 0
    for face in shape.faces:
        fan = np.arange(1, len(face) - 1)
        triangles.append(behind + np.stack((np.zeros_like(fan), fan, fan + 1), axis=1))
        corners.append(face)
        behind += len(face)
    return {
        "label": harmless(shown.title),
        "title": harmless(words),
        "freedom": shape.is_freedom,
        **more,
        "lines": floats(_placed(pieces, frame)),
        "bold": shape.is_bold,
        "arrows": floats(_placed([each[None] for each in shape.arrows], frame)),
        "corners": floats(_placed(corners, frame)),
        "triangles": integers(np.concatenate([np.zeros((0, 3), int), *triangles])),
        "wires": floats(frame.places(dashes(shown.wires, frame.size))),
    }


def _placed(points: list[FloatArray], frame: Frame) -> FloatArray:
    every = [np.zeros((0, 3)), *(each.reshape(-1, 3) for each in points)]
    return frame.places(np.concatenate(every))


#: Pieces of a bent member, which mostly is a part of a divided sheet.
_PIECES = 4
#: The same in a small drawing, and bytes that a movement takes there, if it can; up to so many
#: lines are thick in it.
_SOME_PIECES, _SMALL, _FEW_LINES = 8, 10_000, 12


class Shape(NamedTuple):
    """A shape that plays.

    Attributes:
        kind: "vibrating" or "buckled", by which the page groups them.
        label: Short, on its button, such as "184 Hz".
        words: What it is, such as "first parasitic frequency, 184 Hz".
        state: Where the nodes are without it.
        displacement: (nodes, 3) of positions, and rotations (spins) of orientations; only their
            ratios matter.
    """

    kind: str
    label: str
    words: str
    state: Configuration
    displacement: FloatArray


class Shaped(NamedTuple):
    """A model, mostly one whose beams are divided, with its shapes."""

    data: ModelData
    shapes: Sequence[Shape]


def shapes_data(shaped: Shaped, frame: Frame, spaces: Sequence[SpaceShown] = ()) -> dict[str, Any]:
    """What a viewer draws of shapes; as many of them as fit; and of spaces, the first at once.

    At first it is how it buckles, else the second that vibrates, as the first is meant: the lowest
    parasitic one where a drive is free.
    """
    tracks, kinds = Tracks(frame, _PIECES), [each.kind for each in shaped.shapes[:MOST_MODES]]
    first = kinds.index("buckled") if "buckled" in kinds else min(1, len(kinds) - 1)
    return {
        **static_data(Parts(shaped.data), frame, tracks.segments),
        "reference": tracks.data(),
        "segments": tracks.segments,
        "movements": _fitting(_swings(shaped, tracks)),
        "stresses": [],
        "spaces": [_space(each, frame, f"{each.words}.") for each in spaces],
        "held": [],
        "first": [("movement", str(first))] if kinds else [("space", "0")] * bool(spaces),
    }


def _swings(shaped: Shaped, tracks: Tracks) -> Iterator[tuple[dict[str, Any], int]]:
    drawing = tracks.frame.drawing
    for each in shaped.shapes[:MOST_MODES]:
        movement = swing(drawing, each.state, each.displacement)
        reach, _ = reach_of(drawing, (movement.poses[0], movement.poses[-1]))
        # The sizes of a shape mean nothing.
        note = (
            f"Drawn with displacements up to {100 * reach / drawing.size:.2g}\N{NO-BREAK SPACE}% "
            "of the model's size; of a shape only the ratios matter."
        )
        title = f"{each.words[:1].upper()}{each.words[1:]}"
        data, added = tracks.movement(movement)
        told = {"kind": each.kind, "label": each.label, "title": title, "note": note}
        yield {**told, **data}, added


def motions_data(
    parts: Parts,
    frame: Frame,
    motions: Sequence[tuple[str, Moving]],
    spaces: Sequence[SpaceShown],
    follows: int = MOST_COORDINATES,
) -> dict[str, Any]:
    """What a small viewer draws: motions, each with what it is called, and spaces; no stresses."""
    tracks = Tracks(frame, _SOME_PIECES, _SMALL)
    played = [
        {"kind": "wanted", "label": label, "title": label, "note": "", **tracks.movement(made)[0]}
        for label, made in (
            (label, move(frame.drawing, motion, follows)) for label, motion in motions
        )
    ]
    return {
        **static_data(parts, frame, tracks.segments),
        "reference": tracks.data(),
        "segments": tracks.segments,
        "movements": played,
        "stresses": [],
        "spaces": [
            {**_space(each, frame, f"{each.words}."), "bold": len(each.shape.lines) <= _FEW_LINES}
            for each in spaces
        ],
        "held": [],
        "first": [("movement", "0")] * bool(played),
    }


def viewer_data(
    analysis: Result,
    frame: Frame,
    spaces: Spaces | None = None,
    room: int = MOST_SHAPES,
    most: int = MOST_MODES,
    follows: int = MOST_COORDINATES,
) -> dict[str, Any]:
    """All that is drawn of a result, with spaces of a body, and the first choices.

    A movement has so many phases that it takes so many bytes, if it can, and of declared degrees
    of freedom at most so many move. What cannot be drawn is
    told as "missing", sentences.
    """
    tracks = Tracks(frame, room=room)
    missing: list[str] = []

    def of_body() -> list[dict[str, Any]]:
        if spaces is None:
            return []
        every = spaces_shown(analysis, spaces, frame.size, frame.planar)
        return [_space(each, frame, f"{each.words}.") for each in every]

    shown: list[dict[str, Any]] = attempted("What a body may do", of_body, [], missing)
    held: list[dict[str, Any]] = attempted(
        "What each flexure holds", lambda: holds_data(analysis, frame), [], missing
    )
    data = {
        **static_data(analysis.parts, frame, tracks.segments),
        "reference": tracks.data(),
        "segments": tracks.segments,
        "movements": _fitting(movements(analysis, tracks, missing, most, follows)),
        "stresses": stresses(analysis, frame, missing),
        "spaces": shown + held,
        "held": attempted("What holds each body", lambda: held_data(analysis), [], missing),
        **({"missing": missing} if missing else {}),
    }
    # What the verdict says: a motion, else a self-stress, else a degree of freedom.
    moves = any(movement["kind"] == "motion" for movement in data["movements"])
    first = [("stress", "0")] if data["stresses"] and not moves else [("movement", "0")]
    has_any = data["stresses"] or data["movements"]
    return {**data, "first": first if has_any else []}


def stuck_in(analysis: Result) -> list[Freedom]:
    """The declared degrees of freedom in which the mechanism cannot move."""
    return [each for each in looked_at(analysis) if each.motion is None]


def left_out(analysis: Result, data: dict[str, Any]) -> str:
    """Sentences on what of a large result is not in its drawing."""
    told = list(data.get("missing", ()))
    members = int((analysis.given.arrays.element_node[[0, 2]] > 0).all(axis=0).sum())
    if members > MOST_MEMBERS:
        told.append(f"Of {members} members the first {MOST_MEMBERS} are drawn.")
    kinds = [movement["kind"] for movement in data["movements"]]
    moved = kinds.count("motion")
    if moved < analysis.under_constrained:
        told.append(f"Of {analysis.under_constrained} motions the first {moved} can be shown.")
    if (shown := len(data["stresses"])) < analysis.over_constrained:
        told.append(f"Of {analysis.over_constrained} self-stresses the first {shown} can be shown.")
    # Those inside of what is taken as one beam move nothing by themselves.
    freedom, free = int(analysis.raw.counts[:, -1].sum()), kinds.count("freedom")
    if free + len(stuck_in(analysis)) < freedom:
        told.append(f"Of {freedom} declared degrees of freedom {free} can be shown.")
    return " ".join(told)
