# SPDX-License-Identifier: BSD-3-Clause
"""The frame in which layouts are sought, and the isometries of a problem.

A problem that is moved, turned by right angles, mirrored or scaled has the same layouts. So it is
moved with the centre to the origin, divided by its size, and of the 48 turns and mirrors that
exchange and reverse the axes the one is taken that makes its numbers the first in order; what is
found there goes back the same way. Those of the 48 that change nothing are its isometries.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..advice.spaces.screws import EXACT, ScrewSpace, canonical
from ..core.arrays import FloatArray
from ..util.records import Frozen, cached_property
from .problem import Box, Problem, Region

#: Digits to which the numbers of a problem, in parts of its size, are compared.
_DIGITS = 9


@dataclass(frozen=True, eq=False)
class Scaled(Frozen):
    """A problem in its own frame: lengths in parts of the size, the centre at the origin.

    Attributes:
        turn: (3, 3) the turn or mirror from places of the problem to those of the frame.
        centre: (3,) of the problem [m].
        size: Of the problem [m].
        freedom: (d, 6) orthonormal rows (w, v) of T.
        stage: Where flexures may end on the stage.
        ground: Likewise on the ground.
        keep_out: What is not to be touched.
        intermediate: Where bodies between may be.
        isometries: (g, 3, 3) the turns and mirrors that keep all of it, the identity first.
    """

    turn: FloatArray
    centre: FloatArray
    size: float
    freedom: FloatArray
    stage: Region
    ground: Region
    keep_out: tuple[Box, ...]
    intermediate: tuple[Box, ...]
    isometries: FloatArray

    @cached_property
    def space(self) -> ScrewSpace:
        """T as a space of twists about the origin."""
        return ScrewSpace(self.freedom, np.zeros(3), 1.0, tolerance=EXACT)

    def back(self, places: FloatArray) -> FloatArray:
        """Places of the problem [m], (..., 3), of places in the frame."""
        return np.asarray(self.centre + self.size * (places @ self.turn))

    def turned_back(self, vectors: FloatArray) -> FloatArray:
        """Directions of the problem, (..., 3), of directions in the frame."""
        return np.asarray(vectors @ self.turn)


def turned_screws(turn: FloatArray, rows: FloatArray) -> FloatArray:
    """Twists or wrenches, (..., 6), after a turn or mirror about the origin.

    Of twists the rotation, of wrenches the moment changes its sense in a mirror; `rows` are
    twists (w, v), and so the first three do. For wrenches (f, m) roll them by three.
    """
    sense = round(float(np.linalg.det(turn)))
    first, last = rows[..., :3] @ turn.T * sense, rows[..., 3:] @ turn.T
    return np.concatenate((first, last), axis=-1)


def signed_permutations() -> Iterator[FloatArray]:
    """The 48 turns and mirrors that exchange and reverse the axes, the identity first."""
    for order in itertools.permutations(range(3)):
        for senses in itertools.product((1.0, -1.0), repeat=3):
            made = np.zeros((3, 3))
            made[np.arange(3), order] = senses
            yield made


def scaled(problem: Problem) -> Scaled:
    """A problem in its own frame."""
    centre, size = problem.centre, problem.size

    def plain(region: Region) -> Region:
        return Region(
            tuple(_moved(box, centre, size) for box in region.boxes),
            (region.points - centre) / size,
        )

    places = [plain(problem.stage), plain(problem.ground)]
    places += [
        Region(tuple(_moved(box, centre, size) for box in boxes))
        for boxes in (problem.keep_out, problem.intermediate)
    ]
    twists = problem.freedom.scaled
    largest = float(np.abs(problem.inertia).max()) or 1.0
    turns = list(signed_permutations()) if problem.base is None else [np.eye(3)]
    keys = [_key(turn, twists, places, problem.inertia / largest) for turn in turns]
    first = min(range(len(turns)), key=lambda k: keys[k])
    turn = turns[first]
    same = np.array(
        [other @ turn.T for other, key in zip(turns, keys, strict=True) if key == keys[first]]
    )
    order = np.argsort([not np.array_equal(each, np.eye(3)) for each in same], kind="stable")
    stage, ground, keep_out, intermediate = (_turned(turn, region) for region in places)
    return Scaled(
        *(turn, centre, size, rounded(canonical(turned_screws(turn, twists))), stage, ground),
        *(keep_out.boxes, intermediate.boxes, same[order]),
    )


def _moved(box: Box, centre: FloatArray, size: float) -> Box:
    return Box((box.low - centre) / size, (box.high - centre) / size)


def _turned(turn: FloatArray, region: Region) -> Region:
    boxes = []
    for box in region.boxes:
        ends = np.array((box.low, box.high)) @ turn.T
        boxes.append(Box(rounded(ends.min(axis=0)), rounded(ends.max(axis=0))))
    boxes.sort(key=lambda box: (*box.low.tolist(), *box.high.tolist()))
    points = rounded(region.points @ turn.T)
    return Region(tuple(boxes), points[np.lexsort(points.T[::-1])])


def rounded(values: FloatArray) -> FloatArray:
    """Numbers as they are of all problems that differ by a move or a scale alone, to the bit."""
    return np.round(values, _DIGITS + 3) + 0.0


def _key(
    turn: FloatArray, twists: FloatArray, places: list[Region], inertia: FloatArray
) -> tuple[float, ...]:
    """Numbers of a problem after a turn, to be compared."""
    numbers: list[float] = []
    rows = turned_screws(turn, twists)
    numbers += (np.round(rows.T @ rows, _DIGITS) + 0.0).ravel().tolist()
    for region in places:
        turned = _turned(turn, region)
        for box in turned.boxes:
            numbers += (np.round(np.concatenate((box.low, box.high)), _DIGITS) + 0.0).tolist()
        numbers += (np.round(turned.points, _DIGITS) + 0.0).ravel().tolist()
    numbers += (np.round(turn @ inertia @ turn.T, _DIGITS) + 0.0).ravel().tolist()
    return tuple(numbers)


#: What a place is off a short decimal by rounding, in parts of itself or of the size.
_ROUNDING = 1.0e-13


def snapped(places: FloatArray, size: float) -> FloatArray:
    """Places as they would be typed: what rounding made of short decimals is taken back."""
    flat = np.asarray(places, float).ravel()
    made = []
    for value in flat.tolist():
        short = float(f"{value:.9g}") if abs(value) > _ROUNDING * size else 0.0
        is_near = abs(short - value) <= _ROUNDING * max(abs(value), size)
        made.append(short if is_near else float(f"{value:.15g}"))
    return np.array(made).reshape(np.shape(places)) + 0.0
