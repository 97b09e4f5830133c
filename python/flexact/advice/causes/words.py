# SPDX-License-Identifier: BSD-3-Clause
"""Causes of motions and self-stresses, and the mend of both, in words."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from ...analysis.mode_words import conflict_in_words
from ...analysis.modes import Motion
from ...analysis.naming import (
    coordinate_in_words,
    deformation_in_words,
    in_words,
    named_element,
    named_node,
)
from ...analysis.places import end_words, joint_words, listed, part_words
from ...analysis.result import Result
from ...analysis.sentences import Named, Piece, Pieces
from ...analysis.units import angle_in_words, length_in_words
from ...model.parts.parts import PartKind
from .advising_mends import hub_name, motion_of
from .advising_relations import relations_in_words
from .cause import Cause, CauseKind, Causes, Lift
from .driven import driven_against
from .mend import Mend

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
    rest = len(names) - _MOST_NAMES
    shown: list[Pieces] = names if rest <= 0 else [*names[:_MOST_NAMES], (f"{rest} more",)]
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
    return (", while nothing stops ", *motion_of(first.screw, (listed(names[:_MOST_NAMES]),)))


#: How many modes are looked through, of how many resultants in all, and how many bodies are named.
_MOST, _MOST_ENTRIES, _MOST_NAMES = 20, 4_000, 3
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
            *("Moving ", _point(result, lift.node), f" by {length_in_words(step)}"),
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


def _point(result: Result, node: int) -> Named:
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
