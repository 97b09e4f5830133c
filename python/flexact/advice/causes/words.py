# SPDX-License-Identifier: BSD-3-Clause
"""Causes of motions and self-stresses, and the mend of both, in words."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from math import degrees
from typing import NamedTuple

import numpy as np

from ...analysis.mode_basis import coordinate_key, row_key
from ...analysis.mode_words import conflict_in_words, line_words
from ...analysis.naming import (
    Named,
    Piece,
    Pieces,
    angle_in_words,
    coordinate_in_words,
    counts_in_words,
    deformation_in_words,
    in_words,
    length_in_words,
    named_element,
    named_node,
    plain,
)
from ...analysis.places import (
    axis_words,
    direction_words,
    end_words,
    joint_words,
    listed,
    part_words,
    place_words,
    with_article,
)
from ...analysis.result import Motion, Result
from ...analysis.screws import Screw, ScrewKind
from ...core.arrays import FloatArray
from ...core.elements import AXES, Class, coordinate_name
from ...model.parts.parts import Part, PartKind
from ..proposal import Proposal
from .cause import Cause, CauseKind, Causes, Lift, LineKind, Mend, Relation, RelationKind
from .realignment import JointMove

#: What is below this part of the largest, or of what is added up, is none.
_REST = 1.0e-7


class Driven(NamedTuple):
    """Declared freedoms on which a self-stress acts, in the numbers of the model as analysed."""

    deformations: tuple[tuple[int, int], ...]
    """Number of the element and of the deformation, from 1."""
    coordinates: tuple[tuple[int, str], ...]
    """Number of the node and name of the coordinate."""


def driven_against(result: Result, k: int) -> Driven:
    """The declared freedoms on which a self-stress of a result acts.

    Args:
        result: The result.
        k: Index of the self-stress.
    """
    arrays = result.data.arrays
    place, value = result.stress_basis.entries(k)
    element, deformation = result.raw.row_label[:, place] - 1
    weighted = np.abs(value / result.raw.row_scale[place])
    carries = weighted > _REST * weighted.max(initial=0.0)
    independent = arrays.deformation_class[deformation, element] == Class.INDEPENDENT
    rows = np.flatnonzero(carries & independent).tolist()
    rows.sort(key=lambda i: row_key(result, int(place[i])))
    numbers = arrays.element_number
    deformations = tuple((int(numbers[element[i]]), int(deformation[i]) + 1) for i in rows)
    return Driven(deformations, _coordinates(result, k))


def _coordinates(result: Result, k: int) -> tuple[tuple[int, str], ...]:
    """Independent coordinates at which what the elements exert does not cancel out."""
    arrays = result.data.arrays
    classes = arrays.coordinate_class.T
    if not np.any(classes == Class.INDEPENDENT):
        return ()
    place, value = result.stress_basis.entries(k)
    element, deformation = result.raw.row_label[:, place] - 1
    sigma = np.zeros(6 * arrays.element_number.size)
    sigma[6 * element + deformation] = value
    whole = result.assembly
    terms = whole.value * sigma[whole.row_of]
    total = np.bincount(whole.column_of, terms, classes.size)
    added = np.bincount(whole.column_of, np.abs(terms), classes.size)
    acts = (np.abs(total) > _REST * added.max(initial=0.0)) & (classes == Class.INDEPENDENT).ravel()
    made = []
    found = [divmod(index, 3) for index in np.flatnonzero(acts).tolist()]
    for node, axis in sorted(found, key=lambda each: coordinate_key(result, *each)):
        kind = int(arrays.node_kind[node])
        if axis in AXES[kind]:
            made.append((int(arrays.node_number[node]), coordinate_name(kind, axis)))
    return tuple(made)


#: How many names stand in a row; of more all but one are the first, and how many more there are.
_MOST_NAMES = 6
_FOLDS = {2: "half-turn", 3: "third of a turn", 4: "quarter-turn", 6: "sixth of a turn"}


#: Coordinates below this part of the mechanism's size are zero.
_ZERO = 1.0e-9
#: Relations of parts themselves, not of their lines of force.
_OF_PARTS = (RelationKind.POSITION, RelationKind.ALONG, RelationKind.ACROSS_AXIS)
_TRIED = "; other geometries with this symmetry were tried and have it too"


def relations_in_words(
    result: Result, relations: Sequence[Relation], in_short: bool = False
) -> Pieces:
    """Relations as one clause, such as "the fold lines of lower 0 and lower 180 are parallel".

    Args:
        result: The result.
        relations: What makes its geometry special.
        in_short: Whether only they are said, and not what follows, or what was tried.
    """
    made: list[Piece] = []
    for k, one in enumerate(relations):
        words = _relation(result, one, in_short)
        same = k > 0 and one.parts == relations[k - 1].parts and one.of is relations[k - 1].of
        made += [" and" if same else ", and "] * (k > 0) + list(words[-1:] if same else words)
    if in_short:
        return tuple(made)
    about = [one.couple for one in relations if one.couple.any()]
    if about and len(about) == len(relations) > 1:
        made.append(
            f"; by a couple {'each' if len(about) > 2 else 'either'} of these groups "
            f"holds the rotation about {axis_words(about[0])}"
        )
    elif all(one.of is LineKind.AXIS for one in relations) and relations:
        made.append("; that is enough, wherever the joints are")
    return tuple(made)


def limbs_in_words(result: Result, parts: Sequence[Part]) -> Pieces:
    """Limbs, sheets and bars in a row, as "lower 0 and lower 180"."""
    return row_of(limb_names(result, parts))


def limb_names(result: Result, parts: Sequence[Part]) -> list[Named]:
    """What limbs are called: what the names of their parts begin with, where it is all of them."""
    heads: dict[str, list[Part]] = {}
    for part in result.parts.all:
        head = part.name.rpartition(",")[0].strip()
        if head and part.kind is not PartKind.BODY:
            heads.setdefault(head, []).append(part)
    numbers = result.given.arrays.element_number
    chosen = set(parts)
    made: dict[str, Named] = {}
    for part in parts:
        head = part.name.rpartition(",")[0].strip()
        is_whole = len(heads.get(head, ())) > 1 and set(heads[head]) <= chosen
        words = with_article(head) if is_whole else part_words(part)
        made.setdefault(words, Named("element", int(numbers[part.elements[0]]), words))
    return list(made.values())


def row_of(names: Sequence[Named]) -> Pieces:
    """Names in a row; of many the first, and how many more there are."""
    rest = len(names) - _MOST_NAMES
    shown: list[Piece] = list(names if rest <= 0 else names[: _MOST_NAMES - 1])
    if rest > 0:
        shown.append(f"{rest + 1} more")
    made: list[Piece] = []
    for place, name in enumerate(shown):
        made += [" and " if place == len(shown) - 1 else ", "] * (place > 0)
        made.append(name)
    return tuple(made)


def _relation(result: Result, one: Relation, in_short: bool) -> Pieces:
    of = _lines_of(result, one)
    axis = axis_words(one.direction) if one.direction.any() else ""
    line = _line(result, one.point, one.direction) if axis else ""
    kind = one.kind
    if kind in (RelationKind.CIRCLE, RelationKind.TWO_LINES, RelationKind.CONIC):
        figure = {
            RelationKind.CIRCLE: "one circle",
            RelationKind.TWO_LINES: "two straight lines",
        }.get(kind, "one conic")
        return (f"the {len(one.nodes)} joints that are stressed lie on {figure}",)
    tried = "" if in_short else _TRIED
    if kind is RelationKind.ROTATION:
        turn = _FOLDS.get(one.fold, f"turn by {360 // one.fold} degrees")
        article = "an" if turn[0] in "aeiou" else "a"
        what = "what is stressed" if one.of is LineKind.MEMBER else plain(of)
        takes = f"{article} {turn} about {line} takes {what} onto "
        return (f"{takes}{'itself' if one.of is LineKind.MEMBER else 'each other'}{tried}",)
    if kind is RelationKind.REFLECTION:
        return (f"what is stressed is symmetric about {_plane(result, one)}{tried}",)
    if kind is RelationKind.POSITION:
        return (*of, " stand in a special position to each other")
    if kind in (RelationKind.ALONG, RelationKind.ACROSS_AXIS):
        many = len(limb_names(result, one.parts)) > 1
        # The normal of a sheet that is along an axis is what is told.
        is_along = (kind is RelationKind.ALONG) is not (one.of is LineKind.SHEET)
        way = "along" if is_along else "across"
        return (*of, f" lie{'' if many else 's'} {way} {axis}")
    if one.of is LineKind.SHEET and kind is not RelationKind.ONE_PLANE:
        return _of_sheets(result, one, axis, line, in_short)
    words = _common(result, one, axis, line)
    # What lines of force do not stop is told, and not what turns about axes do not.
    is_short = in_short or (one.of is LineKind.AXIS and kind is not RelationKind.REGULUS)
    return (*of, f" {words.partition(', so that')[0] if is_short else words}")


def _of_sheets(result: Result, one: Relation, axis: str, line: str, in_short: bool) -> Pieces:
    """Sheets whose planes contain one line, or that are parallel, and wires with them."""
    sheets = limb_names(result, [part for part in one.parts if part.kind is PartKind.SHEET])
    wires = limb_names(result, [part for part in one.parts if part.kind is not PartKind.SHEET])
    many, s = len(sheets) > 1, "s" if len(wires) == 1 else ""
    made: list[Piece] = [*row_of(sheets)]
    if one.kind is RelationKind.ACROSS:
        made.append(" are parallel" if many else f" lies across {axis}")
        if wires:
            made += [" and ", *row_of(wires), f" lie{s} along {'them' if many else 'it'}"]
        what = f"the translation along {axis}"
    else:
        made = [f"the plane{'s' if many else ''} of ", *made, f" contain{'' if many else 's'}"]
        made += [" one line"] + ([" that ", *row_of(wires), f" meet{s}"] if wires else [])
        what = f"the rotation about {line}"
    return tuple(made) if in_short else (*made, f", so that none of them stops {what}")


def _common(result: Result, one: Relation, axis: str, line: str) -> str:
    """What lines have in common."""
    point = _point(result, one.point)
    turn = f"the rotation about {line}"
    move = f"the translation along {axis}"
    words = {
        RelationKind.ONE_LINE: "lie along one line",
        RelationKind.PARALLEL: "are parallel",
        RelationKind.ONE_PLANE: "lie in one plane",
        RelationKind.CONCURRENT: f"meet in one point, {point} m",
        RelationKind.ONE_TRANSVERSAL: f"all meet one line, so that none of them stops {turn}",
        RelationKind.ACROSS: f"all lie across {axis}, so that none of them stops {move}",
        RelationKind.REGULUS: "lie on one hyperboloid, so that turns about them cancel out",
        RelationKind.COMPLEX: "belong to one linear complex, so that none of them stops the screw "
        f"motion about {line} of pitch {one.pitch:.4g} m/rad",
    }
    return words[one.kind]


def _lines_of(result: Result, one: Relation) -> Pieces:
    """The lines of a relation: of limbs of two sheets fold lines, of bars and wires they."""
    names = row_of(limb_names(result, one.parts))
    if one.of is LineKind.AXIS:
        many = len(limb_names(result, one.parts)) > 1
        return (f"the ax{'e' if many else 'i'}s of ", *names)
    if one.of is not LineKind.FORCE or one.kind in _OF_PARTS:
        return names
    kinds = {part.kind for part in one.parts}
    if kinds <= {PartKind.WIRE, PartKind.BAR}:
        return names
    folded = kinds == {PartKind.SHEET} and len(one.parts) == 2 * _limbs(one)
    return ("the fold lines of " if folded else "the lines of force of ", *names)


def _limbs(one: Relation) -> int:
    """How many heads of names there are among the parts."""
    return len({part.name.rpartition(",")[0].strip() or part.name for part in one.parts})


def _line(result: Result, point: FloatArray, direction: FloatArray) -> str:
    return line_words(result, point, direction)


def _plane(result: Result, one: Relation) -> str:
    point = _point(result, one.point)
    return f"the plane through {point} m across {axis_words(one.direction)}"


def _point(result: Result, place: FloatArray) -> str:
    small = _ZERO * result.characteristic_length
    numbers = [0.0 if abs(value) < small else value for value in place.tolist()]
    return f"({', '.join(f'{value:.4g}' for value in numbers[: 2 if result.given.planar else 3])})"


def mend_in_words(result: Result, proposal: Proposal) -> Pieces:
    """Which constraint repeats which while what is free, and how the limb is turned."""
    if isinstance(proposal, JointMove):
        return _moved(result, proposal)
    if not isinstance(proposal, Mend):
        return ()
    limb = limbs_in_words(result, proposal.parts)
    line = _line_of_advising_mends(result, proposal)
    angle = f" by {degrees(abs(proposal.angle)):.4g} degrees about {line}"
    stops = "" if proposal.stops is None else f", so that it stops this {_word(proposal.stops)}"
    return (*_repeats(result, proposal), "turn ", *limb, f"{angle}{stops}", *_after(proposal))


def _moved(result: Result, move: JointMove) -> Pieces:
    size = float(np.linalg.norm(move.step))
    way = direction_words(move.step)
    joint = named_node(result, move.node)
    far = f" by {length_in_words(size)} along {way}, out of the special position"
    return ("unless the motion is wanted, move ", joint, far, *_after(move))


def _repeats(result: Result, mend: Mend) -> Pieces:
    """Such as "the constraint of lower 0 repeats that of lower 180, while nothing stops …"."""
    others = limb_names(result, mend.repeats)
    if not others:
        return ()
    limb = limbs_in_words(result, mend.parts)
    if len(others) == 1:
        held: Pieces = ("the constraint of ", *limb, " repeats that of ", *others)
    else:
        between = ("the constraints of ", *limb, " and of ", *row_of(others))
        held = (*between, " depend on each other")
    if mend.stops is None:
        return (*held, ": ")
    free = motion_of(mend.stops, (hub_name(result, mend.end),))
    return (*held, ", while nothing stops ", *free, "; unless this is wanted, ")


def _after(mend: Proposal) -> Pieces:
    after = mend.after
    counts = counts_in_words(after.under_constrained, after.over_constrained)
    made = f". Then the mechanism is {counts}"
    if after.smallest is not None:
        made += f" (smallest singular value {after.smallest:.2g})"
    many = len(mend.alternatives)
    if many:
        what = "turn" if isinstance(mend, Mend) else "move"
        made += f"; {in_words(many)} other {what}{' does' if many == 1 else 's do'} the same"
    return (made,)


def _line_of_advising_mends(result: Result, mend: Mend) -> str:
    """The line about which a limb is turned, right-handed."""
    place = place_words(result.parts, mend.end)
    body = result.parts.body_at.get(mend.end)
    if body is not None and not result.parts.name_of_point(mend.end):
        place = f"its end at {part_words(result.parts.of_body(body))}"
    if result.given.planar:
        where = place if mend.is_in_place else line_words(result, mend.point, mend.direction)
        return f"{where}, {'anticlockwise' if mend.angle > 0.0 else 'clockwise'}"
    direction = mend.direction if mend.angle > 0.0 else -mend.direction
    if mend.is_in_place:
        return f"the line along {direction_words(direction)} through {place}"
    return line_words(result, mend.point, direction)


def hub_name(result: Result, end: int) -> Named:
    """The body or point that a limb holds."""
    body = result.parts.body_at.get(end)
    arrays = result.given.arrays
    if body is None:
        return named_node(result, int(arrays.node_number[end]))
    part = result.parts.of_body(body)
    return named_element(result, int(arrays.element_number[part.elements[0]]))


def motion_of(screw: Screw, on: Pieces) -> Pieces:
    """Such as "the rotation of the stage about y"."""
    axis = axis_words(screw.direction)
    of = (" of ", *on) if on else ()
    if screw.kind is ScrewKind.TRANSLATION:
        return ("the translation", *of, f" along {axis}")
    return (f"the {_word(screw)}", *of, f" about {axis}")


def _word(screw: Screw) -> str:
    return {
        ScrewKind.TRANSLATION: "translation",
        ScrewKind.ROTATION: "rotation",
    }.get(screw.kind, "screw motion")


_LIFTS = "lifts its singular value from zero to about"
_UNKNOWN: Pieces = ("whether another geometry would have it was not looked at",)
#: The misalignment for which a lift is told: the power of ten below this part of the size.
_SMALL, _ANGLE = 1.0e-2, 1.0e-3


def cause_of_motion_in_words(result: Result, k: int, causes: Causes) -> Pieces:
    """Why a motion of a result is there, as a sentence or two without their last stop."""
    cause = causes.motions[k]
    if cause.kind is CauseKind.UNKNOWN:
        return _UNKNOWN
    if cause.kind is CauseKind.GENERIC and not cause.together:
        return ("generic: in any geometry of these parts nothing stops it",)
    return _special(result, cause, "motion")


def cause_of_stress_in_words(result: Result, k: int, causes: Causes) -> Pieces:
    """Why a self-stress of a result is there, likewise."""
    cause = causes.self_stresses[k]
    if cause.kind is CauseKind.UNKNOWN:
        return _UNKNOWN
    if cause.kind is CauseKind.GENERIC and not cause.together:
        words = "generic: any geometry of these parts has it; better alignment does not help"
        return (words, *_driven(result, k))
    return (*_special(result, cause, "self-stress"), *_driven(result, k))


def _driven(result: Result, k: int) -> Pieces:
    """Which declared freedoms a self-stress acts on: they are held, or depend on each other."""
    found = driven_against(result, k)
    names = [deformation_in_words(result, *each) for each in found.deformations]
    names += [coordinate_in_words(result, *each) for each in found.coordinates]
    if not names:
        return ()
    rest = len(names) - _WORDS_MOST_NAMES
    shown: list[Pieces] = names if rest <= 0 else [*names[:_WORDS_MOST_NAMES], (f"{rest} more",)]
    made: list[Piece] = [". It acts on what is declared, "]
    for place, name in enumerate(shown):
        made += [" and " if place == len(shown) - 1 else ", "] * (place > 0) + list(name)
    held = ", which the constraints hold already"
    return (*made, held if len(names) == 1 else ": these cannot be driven one by one")


def both_in_words(result: Result, causes: Causes) -> Pieces:
    """Which constraint is spent twice while which motion is free; nothing where not both are.

    Such as "sheet 1 and sheet 2 both hold the stage against rotation about y, with opposite
    moments, while nothing stops the translation of the stage along y".
    """
    motions = [k for k, motion in enumerate(result.motions[:_MOST]) if not motion.is_internal]
    stresses = list(range(min(len(result.self_stresses), _MOST)))
    size = sum(result.stress_basis.entries(j)[0].size for j in stresses)
    stresses = stresses if size <= _MOST_ENTRIES else stresses[:1]
    if not motions or not stresses or not result.is_told_by_parts:
        return ()
    motions.sort(key=lambda k: not _is_special(causes.motions[k]))
    stresses.sort(key=lambda j: not causes.self_stresses[j].relations)
    for j in stresses:
        k = next(iter(_going_together(result, causes, j, motions)), None)
        if k is None:
            continue
        found = causes.self_stresses[j].relations
        about = relations_in_words(result, found, True)
        held = ("a constraint is spent twice where ", *about) if found else ()
        held = held or conflict_in_words(result.self_stresses[j])
        if not held:
            continue
        mend = next((one for one in causes.mends if isinstance(one, Mend) and one.stops), None)
        if mend is not None and mend.stops is not None:
            on: Pieces = (hub_name(result, mend.end),)
            return (*held, ", while nothing stops ", *motion_of(mend.stops, on))
        return (*held, *_free(result, result.motions[k]))
    return ()


def _going_together(
    result: Result, causes: Causes, j: int, motions: Sequence[int]
) -> Iterator[int]:
    """The motions with which a self-stress has to do, of some.

    Both live on this geometry for one reason, or the motion moves what is stressed.
    """
    of_stress = causes.self_stresses[j].relations
    own = {part for one in of_stress for part in one.parts}
    parts = result.self_stresses[j].parts
    ends = [end.position for one in parts for end in one.ends if end.position is not None]
    turning = [node for end in set(ends) for node in _turning(result, end)]
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


def _turning(result: Result, position: int) -> list[int]:
    """The orientation nodes of the body at a position node."""
    body = result.parts.body_at.get(position)
    return [] if body is None else list(result.parts.bodies[body].orientations)


def _is_special(cause: Cause) -> bool:
    return cause.kind is CauseKind.SPECIAL


def _free(result: Result, motion: Motion) -> Pieces:
    """While nothing stops what: of many joints the motion's number."""
    first = next(iter(motion.bodies), None)
    if first is None or (first.is_joint and len(motion.bodies) > 1):
        return (f", while nothing stops motion {motion.index + 1}",)
    names = [part_words(part) for part in first.bodies] or [
        joint_words(result.parts, joint) for joint in first.joints
    ]
    return (", while nothing stops ", *motion_of(first.screw, (listed(names[:_WORDS_MOST_NAMES]),)))


#: How many modes are looked through, of how many resultants in all, and how many bodies are named.
_MOST, _MOST_ENTRIES, _WORDS_MOST_NAMES = 20, 4_000, 3
#: What moves by less than this part of the largest stands still.
_STILL = 1.0e-6


# Special ------------------------------------------------------------------------


def _of_several(cause: Cause, word: str) -> Pieces:
    """Which of several are special, where that depends on the misalignment."""
    many = len(cause.together)
    rest = many - cause.special
    some = "one is" if cause.special == 1 else f"{in_words(cause.special)} are"
    others = "the other is" if rest == 1 else f"the other {in_words(rest)} are"
    words = f"{word}{'es' if word.endswith('s') else 's'}"
    numbers = listed([str(k + 1) for k in cause.together])
    these = f"{words} {numbers}" if many <= _MOST else f"{many} {words}"
    which = "depends on the misalignment"
    if cause.is_first_order is None:
        which = "was not looked at"
    return (
        f"of {these} {some} special and {others} generic, and which {which}. What is special "
        "lives on this geometry",
    )


def _special(result: Result, cause: Cause, word: str) -> Pieces:
    head: Pieces = ("special: it lives on this geometry",)
    if cause.together:
        head = _of_several(cause, word)
    where = (", where ", *relations_in_words(result, cause.relations)) if cause.relations else ()
    if cause.is_first_order is None:
        return (*head, *where)
    return (*head, *where, ". ", *_lift(result, cause))


def _lift(result: Result, cause: Cause) -> Pieces:
    if cause.lift is None:
        return ("No small misalignment of one node or element lifts it to first order",)
    made: list[Piece] = []
    lift: Lift = cause.lift
    if lift.node is not None:
        step = _step(result.characteristic_length)
        made += [
            *("Moving ", _point_of_words(result, lift.node), f" by {length_in_words(step)}"),
            f" {_LIFTS} {lift.by_move * step:.2g}",
            f" ({lift.by_move:.2g} per metre)",
        ]
    if lift.element is not None:
        made += [
            *(", turning " if made else "Turning ", named_element(result, lift.element)),
            f" by {angle_in_words(_ANGLE)}",
            f" {'to about' if lift.node is not None else _LIFTS} "
            f"{lift.by_turn * _ANGLE:.2g} ({lift.by_turn:.2g} per radian)",
        ]
    return tuple(made)


def _point_of_words(result: Result, node: int) -> Named:
    """A node; where one part ends at a body, this end."""
    parts = result.parts
    index = parts.data.node_index[node]
    body = parts.body_at.get(index)
    others = [part for part in parts.at(index) if part.kind is not PartKind.BODY]
    if body is None or len(others) != 1 or parts.name_of_point(index):
        return named_node(result, node)
    return Named("node", node, end_words(parts, index))


def _step(length: float) -> float:
    """The power of ten below a hundredth of a length [m]."""
    return float(10.0 ** math.floor(math.log10(_SMALL * length)))
