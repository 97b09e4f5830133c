# SPDX-License-Identifier: BSD-3-Clause
"""Which limbs are turned about which lines by which angles, and what that leaves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import combinations
from math import pi
from typing import NamedTuple

import numpy as np

from ...analysis.change import Change
from ...analysis.decomposition import Asked
from ...analysis.mode_basis import without_sense
from ...analysis.result import Motion, Result, result_of
from ...analysis.screws import Screw
from ...core.arrays import FloatArray
from ...core.elements import Vector, element_kinds
from ...model.parts.parts import Part, PartKind
from ...util.errors import FlexactError
from ...util.records import cached_property
from ...util.rotations import about
from ..proposal import After, Proposal, Purpose, tried
from .cause import Mend, Relation
from .gradients import Gradients, node_key
from .lines import Limb, Limbs

#: Components below this part of the size of the mechanism are zero.
_ZERO = 1.0e-12
#: Points nearer than this part of the characteristic length are one.
_TOO_NEAR = 1.0e-3


class Turn(NamedTuple):
    """A limb turned about a line."""

    limb: Limb
    end: int
    """Index of the position node of the body or point that it holds, in the model as given."""
    direction: FloatArray
    point: FloatArray
    """(3,) of the line [m]."""
    angle: float
    """[rad]."""


def change_of(result: Result, limbs: Limbs, turn: Turn) -> Change | None:
    """What a turn does to the model as given; None where the limb cannot be turned so.

    It cannot where a point that it shares with other limbs would move, or where it would come
    to stand on another point.
    """
    arrays = result.given.arrays
    elements = [index for part in turn.limb.parts for index in part.elements]
    found = set((arrays.element_node[[0, 2]][:, elements] - 1).ravel().tolist())
    matrix = about(turn.direction, turn.angle)
    places = arrays.node_value[:3].T
    after = places.copy()
    made = {}
    for node in sorted(found):
        after[node] = turn.point + matrix @ (places[node] - turn.point)
        way = float(np.linalg.norm(after[node] - places[node]))
        if way <= _ZERO * result.characteristic_length:
            continue
        if not _is_own(result, limbs, turn.limb, node):
            return None
        made[node] = _rounded(after[node], result.characteristic_length)
    if not made or _is_in_the_way(result, turn.limb, after):
        return None
    numbers = arrays.node_number
    return Change(
        places=tuple((int(numbers[node]), place) for node, place in made.items()),
        vectors=tuple(_vectors(result, elements, matrix)),
    )


def _is_in_the_way(result: Result, limb: Limb, places: FloatArray) -> bool:
    """Whether a member of a limb goes through a point of another one, or the other way round.

    Of divided sheets and wires their ends count.
    """
    arrays, condensed = result.data.arrays, result.condensed
    mine = np.isin(condensed.elements, [index for part in limb.parts for index in part.elements])
    ends = arrays.element_node[[0, 2]] - 1
    both = (ends >= 0).all(axis=0)
    near = _TOO_NEAR * result.characteristic_length
    own = set(ends[:, mine & both].ravel().tolist())
    others = set(ends[:, ~mine & both].ravel().tolist()) - own
    at = places[condensed.nodes]
    for chosen, points in ((mine & both, others), (~mine & both, own)):
        for p, q in ends[:, chosen].T.tolist():
            beside = [node for node in points if node not in (p, q)]
            if beside and _distances(at[beside], at[p], at[q]).min() < near:
                return True
    return False


def _distances(points: FloatArray, first: FloatArray, last: FloatArray) -> FloatArray:
    """(points,) from a segment."""
    way = last - first
    size = float(way @ way)
    share = np.clip((points - first) @ way / size, 0.0, 1.0) if size > 0.0 else 0.0 * points[:, 0]
    made: FloatArray = np.linalg.norm(points - first - share[:, None] * way, axis=1)
    return made


def _is_own(result: Result, limbs: Limbs, limb: Limb, node: int) -> bool:
    """Whether nothing but the limb and one body is at a node."""
    others = [part for part in limbs.parts.at(node) if part not in limb.parts]
    return all(part.kind is PartKind.BODY for part in others) and len(others) <= 1


def _vectors(
    result: Result, elements: list[int], matrix: FloatArray
) -> list[tuple[int, tuple[float, float, float]]]:
    """The vectors of elements that have one, or need one to be turned."""
    arrays, frames = result.given.arrays, result.given.frames.frame
    optional = [0, *(kind.vector for kind in element_kinds())]
    made = []
    for index in elements:
        given = arrays.element_vector[:, index]
        sheet = bool(result.parts.wide[index])
        if not given.any() and not (sheet and optional[arrays.element_kind[index]] != Vector.NONE):
            continue
        own = given if given.any() else frames[index][:, 1]
        turned = _rounded(matrix @ own, float(np.linalg.norm(own)))
        made.append((int(arrays.element_number[index]), turned))
    return made


def _rounded(vector: FloatArray, size: float) -> tuple[float, float, float]:
    """Twelve digits, so that a quarter turn leaves whole numbers whole."""
    digits = 12 - int(np.floor(np.log10(size)))
    x, y, z = (float(np.round(value, digits)) + 0.0 for value in vector)
    return x, y, z


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


#: How many mends are given, and out of how many: first those that stop what is special.
_MOST, _MOST_LOOKED_AT = 3, 8
#: Turns that leave less than this part of the best smallest value are not given.
_FAIR = 0.6
#: A motion of which more than this part is no motion any more is stopped.
_STOPPED = 1.0e-6


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
    search = TurnSearch(whole, relations, special)
    made = [_mend(search, *group) for group in _best(search.found())]
    made.sort(key=lambda mend: mend.stops is None)
    return tuple(made[:_MOST])


def _best(found: list[Tried]) -> Iterator[tuple[Tried, ...]]:
    """The best first; behind each those that leave the same."""
    if not found:
        return
    least = min(one.left for one in found)
    able = [one for one in found if one.left == least]
    best = max(one.smallest for one in able)
    # What is nearly as good and turns the limb where it is fastened is the simpler one.
    able = [one for one in able if one.smallest > _FAIR * best]
    able.sort(key=lambda one: (not one.is_in_place, -_rounded_of_mends(one.smallest)))
    groups: dict[tuple[float, bool], list[Tried]] = {}
    for one in able:
        groups.setdefault((_rounded_of_mends(one.smallest), one.is_in_place), []).append(one)
    given: set[tuple[object, ...]] = set()
    for group in groups.values():
        turn = group[0].turn
        key = (turn.limb.parts, *np.round(turn.direction, 6).tolist())
        if key not in given and len(given) < _MOST_LOOKED_AT:
            given.add(key)
            yield tuple(group)


def _rounded_of_mends(value: float) -> float:
    return float(f"{value:.5g}")


def _mend(search: TurnSearch, first: Tried, *others: Tried) -> Mend:
    whole, turn = search.whole, first.turn
    return Mend(
        Purpose.MEND,
        first.change,
        _condition(whole, first.after),
        first.after,
        tuple(one.change for one in others),
        parts=turn.limb.parts,
        end=turn.end,
        repeats=search.repeated(turn.limb.parts),
        direction=turn.direction,
        point=turn.point,
        angle=turn.angle,
        is_in_place=first.is_in_place,
        stops=_stopped(search, first.change, turn.end),
    )


def _condition(whole: Result, after: After) -> float:
    """How much weaker the weakest is than it was among what was no zero."""
    before = whole.gap.smallest_nonzero or 1.0
    return max(1.0, before / after.smallest) if after.smallest else float("inf")


def _stopped(search: TurnSearch, change: Change, end: int) -> Screw | None:
    """How what a limb holds moved in a special motion that it cannot do any more."""
    whole = search.whole
    body = whole.parts.body_at.get(end)
    turned = whole.parts.bodies[body].orientations[0] if body is not None else None
    nodes = (end, turned if turned is not None else search.limbs.orientation_at(end))
    after: Result = result_of(
        change.apply(whole.given).data, Asked(whole.asked.method, prove=False)
    )
    left = _twists(after, nodes)
    for motion in search.special:
        screw = _screw(whole, motion, end)
        if screw is None:
            continue
        rotation = motion.rotation[nodes[1]] if nodes[1] is not None else np.zeros(3)
        mine = np.concatenate((motion.displacement[end], whole.characteristic_length * rotation))
        rest = mine - left @ np.linalg.lstsq(left, mine, rcond=1.0e-9)[0]
        if np.linalg.norm(rest) > _STOPPED * np.linalg.norm(mine):
            return screw
    return None


def _screw(whole: Result, motion: Motion, end: int) -> Screw | None:
    """How the body or point at a node moves; None where it does not."""
    body = whole.parts.body_at.get(end)
    for one in motion.bodies:
        is_body = body is not None and whole.parts.of_body(body) in one.bodies
        if is_body or any(joint.position == end for joint in one.joints):
            return one.screw
    return None


def _twists(result: Result, nodes: tuple[int, int | None]) -> FloatArray:
    """(6, motions) what all motions make of a position and an orientation, in lengths.

    Those that do not move it are left out.
    """
    node, axis = result.raw.column_label - 1
    given = result.condensed.nodes[node]
    motions = result.raw.motions.toarray() / result.raw.column_scale[:, None]
    motions /= np.linalg.norm(motions, axis=0)
    made = np.zeros((6, motions.shape[1]))
    for k, wanted in enumerate(nodes):
        here = np.flatnonzero(given == (-1 if wanted is None else wanted))
        made[3 * k + axis[here]] = motions[here] * result.raw.column_scale[here, None]
    made[3:] *= result.characteristic_length
    return made[:, np.linalg.norm(made, axis=0) > _STOPPED]


#: How far a joint is moved beside the members that meet there, and how many are tried.
_STEP, _MOST_JOINTS = 0.2, 12
#: Values that differ by less than this part are one.
_JOINT_MOVES_EQUAL = 1.0e-5


@dataclass(frozen=True, eq=False)
class JointMove(Proposal):
    """A joint of bars that is moved, tried.

    Attributes:
        node: Number of its position node in the model as given; 0 where there is none.
        step: (3,) by which it is moved [m].
    """

    node: int = 0
    step: FloatArray = field(default_factory=lambda: np.zeros(3))


def joint_move(whole: Result, gradients: Gradients) -> tuple[JointMove, ...]:
    """The one move of one joint that lifts the most, with its equals as alternatives; or none.

    Only of mechanisms of bars, and where fewer motions and self-stresses are left.

    Args:
        whole: A result with special motions and self-stresses, told by parts.
        gradients: Its derivatives.
    """
    if any(part.kind is not PartKind.BAR for part in whole.parts.all):
        return ()
    blocks = gradients.at_nodes()
    flat = blocks.reshape(blocks.shape[0], 3, -1)
    left, values, _ = np.linalg.svd(flat, full_matrices=False)
    held = [whole.parts.is_held(int(given)) for given in whole.condensed.nodes]
    sizes = np.where(held, 0.0, values[:, 0] * gradients.geometry.sizes)
    if not sizes.max(initial=0.0) * 1.0e7 > 1.0:
        return ()
    able = np.flatnonzero(sizes >= (1.0 - _JOINT_MOVES_EQUAL) * sizes.max()).tolist()
    able.sort(key=lambda node: node_key(whole, node))
    found = []
    for node in able[:_MOST_JOINTS]:
        direction = without_sense(left[node, :, 0])
        step = _STEP * float(gradients.geometry.sizes[node]) * direction
        for sense in (1.0, -1.0):
            made = _tried(whole, node, sense * step)
            if made is not None:
                found.append(made)
    if not found:
        return ()
    best = max(one.after.smallest or 0.0 for one in found)
    first, *others = [
        one for one in found if abs((one.after.smallest or 0.0) - best) <= _JOINT_MOVES_EQUAL * best
    ]
    alternatives = tuple(one.change for one in others)
    return (
        JointMove(
            *(Purpose.MEND, first.change, first.condition, first.after, alternatives),
            node=first.node,
            step=first.step,
        ),
    )


def _tried(whole: Result, node: int, step: FloatArray) -> JointMove | None:
    given = int(whole.condensed.nodes[node])
    arrays = whole.given.arrays
    number = int(arrays.node_number[given])
    x, y, z = (arrays.node_value[:3, given] + step).tolist()
    change = Change(places=((number, (x, y, z)),))
    try:
        after = tried(whole, change)
    except FlexactError:
        return None
    under = whole.under_constrained - after.under_constrained
    over = whole.over_constrained - after.over_constrained
    if under <= 0 or over <= 0 or not after.smallest:
        return None
    before = whole.gap.smallest_nonzero or 1.0
    condition = max(1.0, before / after.smallest)
    return JointMove(Purpose.MEND, change, condition, after, node=number, step=np.array(step))
