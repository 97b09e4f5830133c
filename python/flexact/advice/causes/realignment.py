# SPDX-License-Identifier: BSD-3-Clause
"""What mends a special geometry: a limb turned as a whole, or a joint moved; values and words.

Which limbs are turned about which lines by which angles, which joints are moved, what that leaves,
and which constraint is spent twice while which motion is free.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations
from math import degrees, pi

import numpy as np

from ...analysis.change import Change
from ...analysis.decomposition import Asked
from ...analysis.mode_basis import without_sense
from ...analysis.mode_words import conflict_in_words, line_words
from ...analysis.naming import (
    Named,
    Pieces,
    in_words,
    length_in_words,
    named_element,
    named_node,
)
from ...analysis.places import (
    axis_words,
    direction_words,
    joint_words,
    listed,
    part_words,
    place_words,
)
from ...analysis.result import Motion, Result, result_of
from ...analysis.screws import Screw, ScrewKind
from ...core.arrays import FloatArray
from ...core.elements import Vector, element_kinds
from ...model.parts.parts import Part, PartKind
from ...util.errors import FlexactError
from ...util.groups import grouped
from ...util.rotations import matrix_of
from ..step import After, Purpose, Step, tried
from .cause import CauseKind, Causes, Relation
from .gradients import Gradients, node_key
from .lines import Limb, Limbs
from .words import MOST_NAMED, limb_names, names_in_words, relations_in_words

#: Components below this part of the size of the mechanism are zero.
_ZERO = 1.0e-12
#: Points nearer than this part of the characteristic length are one.
_TOO_NEAR = 1.0e-3


@dataclass(frozen=True, eq=False, repr=False)
class Mend(Step):
    """A limb turned as a whole, tried.

    What the analysis says is of the mechanism with each divided sheet or wire as one beam.
    `condition` is by how much the smallest singular value that is not zero is smaller than
    before.

    Attributes:
        parts: The limb's parts, by name.
        end: Index of the position node where it holds a body or point, in the model as given.
        repeats: Parts of other limbs whose constraints it repeats.
        direction: (3,) unit vector of the line about which it is turned.
        point: (3,) of that line [m].
        angle: [rad], right-handed about `direction`.
        is_in_place: Whether the line goes through where the limb is fastened to the body.
        stops: How the body or point moved in a motion that nothing stopped, and cannot any more;
            None where that is not so of any of them.
    """

    parts: tuple[Part, ...] = ()
    end: int = -1
    repeats: tuple[Part, ...] = ()
    direction: FloatArray = field(default_factory=lambda: np.zeros(3))
    point: FloatArray = field(default_factory=lambda: np.zeros(3))
    angle: float = 0.0
    is_in_place: bool = False
    stops: Screw | None = None

    def words(self) -> Pieces:
        """Which constraint repeats which while what is free, and how the limb is turned."""
        result = self.analysis
        limb = names_in_words(limb_names(result, self.parts))
        turn = f" by {degrees(abs(self.angle)):.4g} degrees about {self._line()}"
        if self.stops is not None:
            turn += f", so that it stops this {_word(self.stops)}"
        return (*self._repeated(limb), "turn ", *limb, turn, _and_then(self, "turn"))

    def _repeated(self, limb: Pieces) -> Pieces:
        """Such as "the constraint of lower 0 repeats that of lower 180, while nothing stops …"."""
        others = limb_names(self.analysis, self.repeats)
        if not others:
            return ()
        held: Pieces = ("the constraint of ", *limb, " repeats that of ", *others)
        if len(others) > 1:
            between = ("the constraints of ", *limb, " and of ", *names_in_words(others))
            held = (*between, " depend on each other")
        if self.stops is None:
            return (*held, ": ")
        free = motion_of(self.stops, (hub_name(self.analysis, self.end),))
        return (*held, ", while nothing stops ", *free, "; unless this is wanted, ")

    def _line(self) -> str:
        """The line about which the limb is turned, right-handed."""
        result = self.analysis
        place = place_words(result.parts, self.end)
        body = result.parts.body_at.get(self.end)
        if body is not None and not result.parts.name_of_point(self.end):
            place = f"its end at {part_words(result.parts.of_body(body))}"
        if result.given.planar:
            where = place if self.is_in_place else line_words(result, self.point, self.direction)
            return f"{where}, {'anticlockwise' if self.angle > 0.0 else 'clockwise'}"
        direction = self.direction if self.angle > 0.0 else -self.direction
        if self.is_in_place:
            return f"the line along {direction_words(direction)} through {place}"
        return line_words(result, self.point, direction)


@dataclass(frozen=True, eq=False, repr=False)
class JointMove(Step):
    """A joint of bars that is moved, tried.

    Attributes:
        node: Number of its position node in the model as given; 0 where there is none.
        move: (3,) by which it is moved [m].
    """

    node: int = 0
    move: FloatArray = field(default_factory=lambda: np.zeros(3))

    def words(self) -> Pieces:
        """Which joint is moved, by how much and along what."""
        far, way = length_in_words(float(np.linalg.norm(self.move))), direction_words(self.move)
        return (
            *("unless the motion is wanted, move ", named_node(self.analysis, self.node)),
            f" by {far} along {way}, out of the special position{_and_then(self, 'move')}",
        )


def _and_then(mend: Step, what: str) -> str:
    """What the mechanism is then, and how many others do the same."""
    smallest, many = mend.after.smallest, len(mend.alternatives)
    made = f". Then the mechanism is {mend.outcome}"
    if smallest is not None:
        made += f" (smallest singular value {smallest:.2g})"
    if many:
        made += f"; {in_words(many)} other {what}{' does' if many == 1 else 's do'} the same"
    return made


def hub_name(result: Result, end: int) -> Named:
    """The body or point that a limb holds."""
    body = result.parts.body_at.get(end)
    if body is None:
        return named_node(result, int(result.given.arrays.node_number[end]))
    return named_element(result, result.parts.of_body(body).number)


def motion_of(screw: Screw, on: Pieces) -> Pieces:
    """Such as "the rotation of the stage about y"."""
    way = "along" if screw.kind is ScrewKind.TRANSLATION else "about"
    of = (" of ", *on) if on else ()
    return (f"the {_word(screw)}", *of, f" {way} {axis_words(screw.direction)}")


def _word(screw: Screw) -> str:
    turns = {ScrewKind.TRANSLATION: "translation", ScrewKind.ROTATION: "rotation"}
    return turns.get(screw.kind, "screw motion")


# Limbs turned -----------------------------------------------------------------------


def change_of(
    result: Result, limb: Limb, direction: FloatArray, point: FloatArray, angle: float
) -> Change | None:
    """What a turn of a limb about a line does to the model as given.

    None where the limb cannot be turned so: where a point that it shares with other limbs would
    move, or where it would come to stand on another point.
    """
    arrays, length = result.given.arrays, result.characteristic_length
    elements = [index for part in limb.parts for index in part.elements]
    found = set((arrays.element_node[[0, 2]][:, elements] - 1).ravel().tolist())
    matrix = matrix_of(angle * direction)
    places = arrays.node_value[:3].T
    after = places.copy()
    made = []
    for node in sorted(found):
        after[node] = point + matrix @ (places[node] - point)
        if float(np.linalg.norm(after[node] - places[node])) <= _ZERO * length:
            continue
        others = [part for part in result.parts.at(node) if part not in limb.parts]
        if len(others) > 1 or any(part.kind is not PartKind.BODY for part in others):
            return None
        made.append((int(arrays.node_number[node]), _rounded(after[node], length)))
    if not made or _is_in_the_way(result, limb, after):
        return None
    # The vectors of elements that have one, or need one to be turned.
    vectors, optional = [], [0, *(kind.vector for kind in element_kinds())]
    for index in elements:
        own = arrays.element_vector[:, index]
        if not own.any():
            is_none = optional[arrays.element_kind[index]] == Vector.NONE
            if is_none or not result.parts.wide[index]:
                continue
            own = result.given.frames.frame[index][:, 1]
        turned = _rounded(matrix @ own, float(np.linalg.norm(own)))
        vectors.append((int(arrays.element_number[index]), turned))
    return Change(places=tuple(made), vectors=tuple(vectors))


def _is_in_the_way(result: Result, limb: Limb, places: FloatArray) -> bool:
    """Whether a member of a limb goes through a point of another one, or the other way round.

    Of divided sheets and wires their ends count.
    """
    arrays, condensed = result.data.arrays, result.condensed
    mine = np.isin(condensed.elements, [index for part in limb.parts for index in part.elements])
    ends = arrays.element_node[[0, 2]] - 1
    both = (ends >= 0).all(axis=0)
    own = set(ends[:, mine & both].ravel().tolist())
    others = set(ends[:, ~mine & both].ravel().tolist()) - own
    at, near = places[condensed.nodes], _TOO_NEAR * result.characteristic_length
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
    return np.asarray(np.linalg.norm(points - first - share[:, None] * way, axis=1))


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
    search = _TurnSearch(whole, relations, special)
    made = [
        replace(
            first,
            alternatives=tuple(one.change for one in others),
            repeats=search.repeated(first.parts),
            stops=search.stopped(first.change, first.end),
        )
        for first, *others in _best(search.found())
    ]
    made.sort(key=lambda mend: mend.stops is None)
    return tuple(made[:_MOST])


def _best(found: list[Mend]) -> list[list[Mend]]:
    """Turns that leave the fewest and are strong, the best first; behind each its equals."""
    left = [one.after.under_constrained + one.after.over_constrained for one in found]
    able = [one for one, count in zip(found, left, strict=True) if count == min(left)]
    best = max((_smallest(one) for one in able), default=0.0)
    # What is nearly as good and turns the limb where it is fastened is the simpler one.
    able = [one for one in able if _smallest(one) > _FAIR * best]
    able.sort(key=lambda one: (not one.is_in_place, -float(f"{_smallest(one):.5g}")))
    equal = grouped(((f"{_smallest(one):.5g}", one.is_in_place), one) for one in able)
    turned: dict[tuple[object, ...], list[Mend]] = {}
    for group in equal.values():
        key = (group[0].parts, *np.round(group[0].direction, 6).tolist())
        turned.setdefault(key, group)
    return list(turned.values())[:_MOST_LOOKED_AT]


def _smallest(mend: Mend) -> float:
    return mend.after.smallest or 0.0


def _is_better(whole: Result, after: After) -> bool:
    """Whether fewer motions and fewer self-stresses are left."""
    under = whole.under_constrained - after.under_constrained
    over = whole.over_constrained - after.over_constrained
    return under > 0 and over > 0


def _condition(whole: Result, after: After) -> float:
    """How much weaker the weakest is than it was among what was no zero."""
    before = whole.gap.smallest_nonzero or 1.0
    return max(1.0, before / after.smallest) if after.smallest else float("inf")


class _TurnSearch:
    """Tries turns of the limbs that relations are about.

    Attributes:
        whole: A result.
        relations: What makes its geometry special.
        special: Its special motions.
    """

    def __init__(
        self, whole: Result, relations: Sequence[Relation], special: Sequence[Motion]
    ) -> None:
        self.whole, self.relations, self.special = whole, relations, special
        self.limbs = Limbs(whole)
        self._hub_of = {
            (limb.parts, position): ends for _, ends in self.limbs.hubs for limb, position in ends
        }

    def found(self) -> list[Mend]:
        """What the first angles that help any limb make of it."""
        whole = self.whole
        work = _MOST_WORK // max(1, whole.data.arrays.element_number.size)
        made: list[Mend] = []
        for angles in _ANGLES:
            for limb, end, direction, point, angle in self._turns(angles):
                if work <= 0:
                    break
                change = change_of(whole, limb, direction, point, angle)
                if change is None:
                    continue
                work -= 1
                try:
                    after = tried(whole, change)
                except FlexactError:
                    continue
                if not _is_better(whole, after):
                    continue
                off = np.cross(self.limbs.place(end) - point, direction)
                in_place = bool(np.linalg.norm(off) <= _EQUAL * whole.characteristic_length)
                how = whole, Purpose.MEND, change, _condition(whole, after), after
                turn = direction, point, angle, in_place
                made.append(Mend(*how, (), 0, limb.parts, end, (), *turn))
            if made:
                break
        return made

    def repeated(self, parts: tuple[Part, ...]) -> tuple[Part, ...]:
        """What else is in the smallest relation that a limb is in."""
        mine = [one.parts for one in self.relations if set(parts) <= set(one.parts)]
        return tuple(part for part in min(mine, key=len, default=()) if part not in parts)

    def stopped(self, change: Change, end: int) -> Screw | None:
        """How what a limb holds moved in a special motion that it cannot do any more."""
        whole, length = self.whole, self.whole.characteristic_length
        body = whole.parts.body_at.get(end)
        turned = self.limbs.orientation_at(end)
        if body is not None:
            turned = whole.parts.bodies[body].orientations[0]
        asked = Asked(whole.asked.method, prove=False)
        left = _twists(result_of(change.apply(whole.given).data, asked), (end, turned))
        for motion in self.special:
            # How the body or point at the end moves; nothing where it does not.
            part = None if body is None else whole.parts.of_body(body)
            screws = (
                one.screw
                for one in motion.bodies
                if part in one.bodies or any(joint.position == end for joint in one.joints)
            )
            screw = next(screws, None)
            if screw is None:
                continue
            rotation = motion.rotation[turned] if turned is not None else np.zeros(3)
            mine = np.concatenate((motion.displacement[end], length * rotation))
            rest = mine - left @ np.linalg.lstsq(left, mine, rcond=1.0e-9)[0]
            if np.linalg.norm(rest) > _STOPPED * np.linalg.norm(mine):
                return screw
        return None

    def _turns(
        self, angles: tuple[float, ...]
    ) -> Iterator[tuple[Limb, int, FloatArray, FloatArray, float]]:
        """Limbs, their ends, and lines and angles by which they are turned."""
        for limb, end in self._candidates():
            place, middle = self.limbs.place(end), self._middle(limb, end)
            apart = float(np.linalg.norm(middle - place))
            is_apart = apart > _EQUAL * self.whole.characteristic_length
            for point in (place, middle) if is_apart else (place,):
                for direction in self._directions(limb, end):
                    for angle in angles:
                        yield limb, end, direction, point, angle
                        yield limb, end, direction, point, -angle

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
        return np.asarray(np.mean([self.limbs.place(position) for _, position in ends], axis=0))

    def _directions(self, limb: Limb, end: int) -> list[FloatArray]:
        """Of the relations and of the motions, then of limbs, and across two of them."""
        if self.whole.given.planar:
            return [np.array([0.0, 0.0, 1.0])]
        made: list[FloatArray] = []

        def add(axis: FloatArray) -> None:
            """Keep an axis without sense, where it is one and not there yet."""
            size = float(np.linalg.norm(axis))
            if size > _EQUAL:
                unit = without_sense(axis / size)
                unit = np.where(np.abs(unit) > _EQUAL**2, unit, 0.0)
                if all(float(np.linalg.norm(np.cross(unit, other))) > _EQUAL for other in made):
                    made.append(unit)

        screws = [one.screw for each in self.special[:_MOST_LIMBS] for one in each.bodies[:1]]
        for axis in (
            *(one.couple for one in self.relations),
            *(one.direction for one in self.relations),
            *(screw.direction for screw in screws),
        ):
            add(axis)
        for other, position in self._hub_of[limb.parts, end]:
            away = next((p for p in other.ends if p != position), position)
            if len(made) < 2:
                add(self.limbs.place(away) - self.limbs.place(position))
        for axis in np.eye(3) if len(made) < 2 else ():
            add(axis)
        for a, b in combinations(made[:3], 2):
            add(np.cross(a, b))
        return made[:_MOST_AXES]


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


# Joints moved -----------------------------------------------------------------------

#: How far a joint is moved beside the members that meet there, and how many are tried.
_STEP, _MOST_JOINTS = 0.2, 12
#: Values that differ by less than this part are one.
_JOINTS_EQUAL = 1.0e-5


def joint_move(whole: Result, gradients: Gradients) -> tuple[JointMove, ...]:
    """The one move of one joint that lifts the most, with its equals as alternatives; or none.

    Only of mechanisms of bars, and where fewer motions and self-stresses are left.

    Args:
        whole: A result with special motions and self-stresses, told by parts.
        gradients: Its derivatives.
    """
    if any(part.kind is not PartKind.BAR for part in whole.parts.all):
        return ()
    blocks, lengths = gradients.at_nodes, gradients.geometry.sizes
    left, values, _ = np.linalg.svd(blocks.reshape(blocks.shape[0], 3, -1), full_matrices=False)
    held = [whole.parts.is_held(int(given)) for given in whole.condensed.nodes]
    sizes = np.where(held, 0.0, values[:, 0] * lengths)
    if not sizes.max(initial=0.0) * 1.0e7 > 1.0:
        return ()
    able = np.flatnonzero(sizes >= (1.0 - _JOINTS_EQUAL) * sizes.max()).tolist()
    able.sort(key=lambda node: node_key(whole, node))
    found = []
    for node in able[:_MOST_JOINTS]:
        step = _STEP * float(lengths[node]) * without_sense(left[node, :, 0])
        found += [_moved(whole, node, sense * step) for sense in (1.0, -1.0)]
    moves = [one for one in found if one is not None]
    best = max((one.after.smallest or 0.0 for one in moves), default=0.0)
    equal = [
        one for one in moves if abs((one.after.smallest or 0.0) - best) <= _JOINTS_EQUAL * best
    ]
    return tuple(
        replace(one, alternatives=tuple(other.change for other in equal[1:])) for one in equal[:1]
    )


def _moved(whole: Result, node: int, move: FloatArray) -> JointMove | None:
    """A joint that is moved, if that leaves fewer motions and fewer self-stresses."""
    given = int(whole.condensed.nodes[node])
    arrays = whole.given.arrays
    number = int(arrays.node_number[given])
    x, y, z = (arrays.node_value[:3, given] + move).tolist()
    change = Change(places=((number, (x, y, z)),))
    try:
        after = tried(whole, change)
    except FlexactError:
        return None
    if not _is_better(whole, after) or not after.smallest:
        return None
    how = whole, Purpose.MEND, change, _condition(whole, after), after
    return JointMove(*how, node=number, move=np.array(move))


# The pair that is mended ------------------------------------------------------------

#: How many modes are looked through, and of how many resultants in all.
_MOST_MODES, _MOST_ENTRIES = 20, 4_000
#: What moves by less than this part of the largest stands still.
_STILL = 1.0e-6


def both_in_words(result: Result, causes: Causes) -> Pieces:
    """Which constraint is spent twice while which motion is free; nothing where not both are.

    Such as "sheet 1 and sheet 2 both hold the stage against rotation about y, with opposite
    moments, while nothing stops the translation of the stage along y".
    """
    motions = [k for k, one in enumerate(result.motions[:_MOST_MODES]) if not one.is_internal]
    stresses = list(range(min(len(result.self_stresses), _MOST_MODES)))
    size = sum(result.stress_basis.entries(j)[0].size for j in stresses)
    stresses = stresses if size <= _MOST_ENTRIES else stresses[:1]
    if not motions or not stresses or not result.is_told_by_parts:
        return ()
    motions.sort(key=lambda k: causes.motions[k].kind is not CauseKind.SPECIAL)
    stresses.sort(key=lambda j: not causes.self_stresses[j].relations)
    for j in stresses:
        k = next(_going_together(result, causes, j, motions), None)
        if k is None:
            continue
        found = causes.self_stresses[j].relations
        about = relations_in_words(result, found, True)
        held = ("a constraint is spent twice where ", *about) if found else ()
        held = held or conflict_in_words(result.self_stresses[j])
        if not held:
            continue
        for mend in causes.mends:
            if isinstance(mend, Mend) and mend.stops:
                free = motion_of(mend.stops, (hub_name(result, mend.end),))
                return (*held, ", while nothing stops ", *free)
        first, *others = result.motions[k].bodies or (None,)
        free = (f"motion {k + 1}",)
        if first is not None and not (first.is_joint and others):
            names = [part_words(part) for part in first.bodies] or [
                joint_words(result.parts, joint) for joint in first.joints
            ]
            free = motion_of(first.screw, (listed(names[:MOST_NAMED]),))
        return (*held, ", while nothing stops ", *free)
    return ()


def _going_together(
    result: Result, causes: Causes, j: int, motions: Sequence[int]
) -> Iterator[int]:
    """The motions with which a self-stress has to do, of some.

    Both live on this geometry for one reason, or the motion moves what is stressed.
    """
    of_stress = causes.self_stresses[j].relations
    own = {part for one in of_stress for part in one.parts}
    parts, bodies = result.self_stresses[j].parts, result.parts.bodies
    ends = [end.position for one in parts for end in one.ends if end.position is not None]
    held = {result.parts.body_at[end] for end in ends if end in result.parts.body_at}
    turning = [node for body in held for node in bodies[body].orientations]
    for k in motions:
        of_motion, motion = causes.motions[k].relations, result.motions[k]
        if of_stress and of_motion:
            if any(own >= set(one.parts) for one in of_motion):
                yield k
            continue
        moved, turned = np.linalg.norm(motion.displacement, axis=1), np.abs(motion.rotation)
        least = _STILL * max(float(moved.max(initial=0.0)), float(turned.max(initial=0.0)))
        if max(moved[ends].max(initial=0.0), turned[turning].max(initial=0.0)) > least:
            yield k
