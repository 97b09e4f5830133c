# SPDX-License-Identifier: BSD-3-Clause
"""Limbs that repeat what others hold, turned so that they stop what is free instead.

A limb is turned as a whole, about lines through the body that it holds or through where it is
fastened there, and each turn is tried by an analysis.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations
from math import pi

import numpy as np

from ...base.errors import FlexactError
from ...core.arrays import FloatArray
from ...model.parts.parts import Part
from ...result.modes import Motion
from ...result.order import without_sense
from ...result.result import Result
from ...result.screws import Screw, ScrewKind
from ..proposal import After, Proposal, Purpose, tried
from .cause import Relation
from .limbs import Limb, Limbs
from .turns import Turn, change_of

#: How many mends are given, how many limbs are turned, and what is spent: analyses times elements.
_MOST, _MOST_LIMBS, _MOST_WORK = 3, 8, 40_000
#: Directions about which a limb is turned.
_MOST_AXES = 4
#: Angles that a workshop likes, in the order in which they are tried.
_ANGLES = ((pi / 2,), (pi / 4, pi / 6))
#: Turns that leave less than this part of the best smallest value are not given.
_FAIR = 0.6
#: Values that differ by less than this part are one.
_EQUAL = 1.0e-6


@dataclass(frozen=True, eq=False)
class Mend(Proposal):
    """A limb turned as a whole, tried.

    What the analysis says is of the mechanism with each divided sheet or wire as one beam.

    Attributes:
        parts: The limb's parts, by name.
        end: Index of the position node where it holds a body or point, in the model as given.
        repeats: Parts of other limbs whose constraints it repeats.
        direction: (3,) unit vector of the line about which it is turned.
        point: (3,) of that line [m].
        angle: [rad], right-handed about `direction`.
        is_in_place: Whether the line goes through where the limb is fastened to the body.
        stops: How the body or point moves in a motion that nothing stopped; None where none of
            them moves it.
    """

    parts: tuple[Part, ...] = ()
    end: int = -1
    repeats: tuple[Part, ...] = ()
    direction: FloatArray = field(default_factory=lambda: np.zeros(3))
    point: FloatArray = field(default_factory=lambda: np.zeros(3))
    angle: float = 0.0
    is_in_place: bool = False
    stops: Screw | None = None


@dataclass(frozen=True)
class _Tried:
    turn: Turn
    mend: Mend

    @property
    def left(self) -> int:
        """How many motions and self-stresses are left."""
        return self.mend.after.under_constrained + self.mend.after.over_constrained

    @property
    def smallest(self) -> float:
        return self.mend.after.smallest or 0.0


def mends_of(
    whole: Result, relations: Sequence[Relation], special: Sequence[Motion]
) -> tuple[Mend, ...]:
    """At most three turns of limbs after which fewer motions and self-stresses are left.

    Args:
        whole: A result with motions and self-stresses, divided sheets being one beam each.
        relations: What makes its geometry special.
        special: Its motions that are so.
    """
    if not whole.is_told_by_parts or not whole.under_constrained or not whole.over_constrained:
        return ()
    return tuple(_best(list(_Search(whole, relations, special).found())))


class _Search:
    def __init__(
        self, whole: Result, relations: Sequence[Relation], special: Sequence[Motion]
    ) -> None:
        self.whole, self.relations, self.special = whole, relations, special
        self.limbs = Limbs(whole)
        self.hub_of = {
            (limb.parts, position): ends for _, ends in self.limbs.hubs for limb, position in ends
        }

    def found(self) -> Iterator[_Tried]:
        """What the first angles that help any limb make of it."""
        work = _MOST_WORK // max(1, self.whole.data.arrays.element_number.size)
        for angles in _ANGLES:
            made = []
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
                    mend = Mend(
                        Purpose.MEND,
                        change,
                        self._condition(after),
                        after,
                        parts=turn.limb.parts,
                        end=turn.end,
                        repeats=self._repeated(turn.limb),
                        direction=turn.direction,
                        point=turn.point,
                        angle=turn.angle,
                        is_in_place=self._is_in_place(turn),
                        stops=self._stopped(turn.end),
                    )
                    made.append(_Tried(turn, mend))
            if made:
                yield from made
                return

    def _is_better(self, after: After) -> bool:
        under = self.whole.under_constrained - after.under_constrained
        over = self.whole.over_constrained - after.over_constrained
        return under > 0 and over > 0

    def _condition(self, after: After) -> float:
        """How much weaker the weakest is than it was among what was no zero."""
        before = self.whole.gap.smallest_nonzero or 1.0
        return max(1.0, before / after.smallest) if after.smallest else float("inf")

    def _is_in_place(self, turn: Turn) -> bool:
        off = np.cross(self.limbs.place(turn.end) - turn.point, turn.direction)
        return bool(np.linalg.norm(off) <= _EQUAL * self.whole.characteristic_length)

    def _stopped(self, end: int) -> Screw | None:
        body = self.whole.parts.body_at.get(end)
        for motion in self.special:
            for one in motion.bodies:
                is_body = body is not None and self.whole.parts.of_body(body) in one.bodies
                if is_body or any(joint.position == end for joint in one.joints):
                    return one.screw
        return None

    def _repeated(self, limb: Limb) -> tuple[Part, ...]:
        """What else is in the smallest relation that a limb is in."""
        mine = [one for one in self.relations if set(limb.parts) <= set(one.parts)]
        if not mine:
            return ()
        smallest = min(mine, key=lambda one: len(one.parts))
        return tuple(part for part in smallest.parts if part not in limb.parts)

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
            ends = [p for p in limb.ends if (limb.parts, p) in self.hub_of]
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
        ends = self.hub_of[limb.parts, end]
        places = [self.limbs.place(position) for _, position in ends]
        return np.asarray(np.mean(places, axis=0))

    def _directions(self, limb: Limb, end: int) -> list[FloatArray]:
        """Of the relations, of the motions, and of the limb, and across two of them."""
        if self.whole.given.planar:
            return [np.array([0.0, 0.0, 1.0])]
        found = [one.couple for one in self.relations] + [one.direction for one in self.relations]
        stopped = self._stopped(end)
        if stopped is not None and stopped.kind is not ScrewKind.NONE:
            found.append(stopped.direction)
        made: list[FloatArray] = []
        for axis in found:
            _add(made, axis)
        # Then along the other limbs there, and across two of all these.
        for other, position in self.hub_of[limb.parts, end]:
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


def _best(found: list[_Tried]) -> Iterator[Mend]:
    """The best first; those that leave the same are alternatives of the first of them."""
    if not found:
        return
    least = min(one.left for one in found)
    able = [one for one in found if one.left == least]
    best = max(one.smallest for one in able)
    # What is nearly as good and turns the limb where it is fastened is the simpler one.
    able = [one for one in able if one.smallest > _FAIR * best]
    able.sort(key=lambda one: (not one.mend.is_in_place, -_rounded(one.smallest)))
    groups: dict[tuple[float, bool], list[_Tried]] = {}
    for one in able:
        groups.setdefault((_rounded(one.smallest), one.mend.is_in_place), []).append(one)
    given: set[tuple[object, ...]] = set()
    for first, *others in groups.values():
        key = (first.turn.limb.parts, *np.round(first.turn.direction, 6).tolist())
        if key in given or len(given) == _MOST:
            continue
        given.add(key)
        alternatives = tuple(one.mend.change for one in others)
        yield replace(first.mend, alternatives=alternatives)


def _rounded(value: float) -> float:
    return float(f"{value:.5g}")
