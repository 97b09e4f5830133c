# SPDX-License-Identifier: BSD-3-Clause
"""Which limbs are turned about which lines by which angles, and what that leaves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from math import pi
from typing import NamedTuple

import numpy as np

from ...analysis.change import Change
from ...analysis.modes import Motion
from ...analysis.order import without_sense
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...model.parts.parts import Part
from ...util.cached import cached_property
from ...util.errors import FlexactError
from ..proposal import After, tried
from .cause import Relation
from .limbs import Limb, Limbs
from .turns import Turn, change_of

#: How many limbs are turned, and what is spent: analyses times elements.
_MOST_LIMBS, _MOST_WORK = 8, 20_000
#: Directions about which a limb is turned.
_MOST_AXES = 4
#: Angles that a workshop likes; the later ones where none of the first helps.
_ANGLES = ((pi / 2,), (pi / 4, pi / 6))
#: Values that differ by less than this part are one.
_EQUAL = 1.0e-6


class Tried(NamedTuple):
    """A turn after which fewer motions and fewer self-stresses are left."""

    turn: Turn
    change: Change
    after: After
    is_in_place: bool
    """Whether the line goes through where the limb is fastened to the body."""

    @property
    def left(self) -> int:
        """How many motions and self-stresses are left."""
        return self.after.under_constrained + self.after.over_constrained

    @property
    def smallest(self) -> float:
        """The smallest singular value that is not zero."""
        return self.after.smallest or 0.0


class TurnSearch:
    """Tries turns of the limbs that relations are about."""

    def __init__(
        self, whole: Result, relations: Sequence[Relation], special: Sequence[Motion]
    ) -> None:
        """Keep a result, what makes its geometry special, and its special motions."""
        self.whole, self.relations, self.special = whole, relations, special
        self.limbs = Limbs(whole)
        self._hub_of = {
            (limb.parts, position): ends for _, ends in self.limbs.hubs for limb, position in ends
        }

    def found(self) -> list[Tried]:
        """What the first angles that help any limb make of it."""
        work = _MOST_WORK // max(1, self.whole.data.arrays.element_number.size)
        made: list[Tried] = []
        for angles in _ANGLES:
            for turn in self._turns(angles):
                if work <= 0:
                    break
                change = change_of(self.whole, self.limbs, turn)
                if change is None:
                    continue
                work -= 1
                try:
                    after = tried(self.whole, change)
                except FlexactError:
                    continue
                if self._is_better(after):
                    made.append(Tried(turn, change, after, self._is_in_place(turn)))
            if made:
                break
        return made

    def _is_better(self, after: After) -> bool:
        under = self.whole.under_constrained - after.under_constrained
        over = self.whole.over_constrained - after.over_constrained
        return under > 0 and over > 0

    def _is_in_place(self, turn: Turn) -> bool:
        off = np.cross(self.limbs.place(turn.end) - turn.point, turn.direction)
        return bool(np.linalg.norm(off) <= _EQUAL * self.whole.characteristic_length)

    def repeated(self, parts: tuple[Part, ...]) -> tuple[Part, ...]:
        """What else is in the smallest relation that a limb is in."""
        mine = [one for one in self.relations if set(parts) <= set(one.parts)]
        if not mine:
            return ()
        smallest = min(mine, key=lambda one: len(one.parts))
        return tuple(part for part in smallest.parts if part not in parts)

    # Which turns ------------------------------------------------------------

    def _turns(self, angles: tuple[float, ...]) -> Iterator[Turn]:
        for limb, end in self._candidates():
            place = self.limbs.place(end)
            centres = [place]
            middle = self._middle(limb, end)
            if np.linalg.norm(middle - place) > _EQUAL * self.whole.characteristic_length:
                centres.append(middle)
            for point in centres:
                for direction in self._directions(limb, end):
                    for angle in angles:
                        yield Turn(limb, end, direction, point, angle)
                        yield Turn(limb, end, direction, point, -angle)

    def _candidates(self) -> list[tuple[Limb, int]]:
        """Limbs in the relations, between a body or point and the ground, by name."""
        special = {part for one in self.relations for part in one.parts}
        smallest = min((len(one.parts) for one in self.relations), default=0)
        first = {p for one in self.relations if len(one.parts) == smallest for p in one.parts}
        able = []
        for limb in self.limbs.all:
            ends = [p for p in limb.ends if (limb.parts, p) in self._hub_of]
            if len(limb.ends) == 2 and len(ends) == 1 and set(limb.parts) <= special:
                able.append((limb, ends[0]))
        # Those that the fewest repeat are turned first.
        able.sort(key=lambda one: not set(one[0].parts) <= first)
        return able[:_MOST_LIMBS]

    def _middle(self, limb: Limb, end: int) -> FloatArray:
        """Where the members of the body meet, else the middle of where limbs hold it."""
        arrays, body = self.whole.given.arrays, self.whole.parts.body_at.get(end)
        if body is not None:
            mine = self.whole.parts.bodies[body]
            slots = (arrays.element_node[[0, 2]][:, list(mine.elements)] - 1).ravel()
            many = np.bincount(slots[slots >= 0])
            if many.max() > 2 and np.count_nonzero(many == many.max()) == 1:
                return self.limbs.place(int(np.argmax(many)))
        ends = self._hub_of[limb.parts, end]
        places = [self.limbs.place(position) for _, position in ends]
        return np.asarray(np.mean(places, axis=0))

    @cached_property
    def _moved(self) -> list[FloatArray]:
        """The directions of special motions."""
        motions = self.special[:_MOST_LIMBS]
        return [one.screw.direction for motion in motions for one in motion.bodies[:1]]

    def _directions(self, limb: Limb, end: int) -> list[FloatArray]:
        """Of the relations and of the motions, then of limbs, and across two of them."""
        if self.whole.given.planar:
            return [np.array([0.0, 0.0, 1.0])]
        found = [one.couple for one in self.relations] + [one.direction for one in self.relations]
        found += self._moved
        made: list[FloatArray] = []
        for axis in found:
            _add(made, axis)
        for other, position in self._hub_of[limb.parts, end]:
            away = next((p for p in other.ends if p != position), position)
            if len(made) < 2:
                _add(made, self.limbs.place(away) - self.limbs.place(position))
        if len(made) < 2:
            for axis in np.eye(3):
                _add(made, axis)
        for a, b in combinations(made[:3], 2):
            _add(made, np.cross(a, b))
        return made[:_MOST_AXES]


def _add(axes: list[FloatArray], axis: FloatArray) -> None:
    """An axis without sense, where it is one and not there yet."""
    size = float(np.linalg.norm(axis))
    if size > _EQUAL:
        unit = without_sense(axis / size)
        unit = np.where(np.abs(unit) > _EQUAL**2, unit, 0.0)
        if all(float(np.linalg.norm(np.cross(unit, other))) > _EQUAL for other in axes):
            axes.append(unit)
