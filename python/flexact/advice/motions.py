# SPDX-License-Identifier: BSD-3-Clause
"""What advice says of motions and self-stresses: cause, extent, what moves, and a sentence."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from ..analysis.body_motions import BodyMotion
from ..analysis.mode_words import (
    conflict_in_words,
    group_in_words,
    joined,
    largest_first,
    motion_in_parts,
    parts_in_words,
    stress_in_parts,
)
from ..analysis.naming import (
    Named,
    Piece,
    Pieces,
    begun,
    ended,
    in_a_row,
    in_words,
    named_node,
    sentence_of,
)
from ..analysis.places import joint_node, with_article
from ..analysis.result import Motion, Result, SelfStress
from ..analysis.screws import Screw
from ..motion.extent import Extent, extent_in_words
from ..util.records import Frozen, cached_property
from .causes.cause import Cause, Causes
from .causes.words import cause_of_motion_in_words, cause_of_stress_in_words

#: How many deformations of a large model are told.
_MOST_TOLD = 4


def stress_in_sentence(result: Result, stress: SelfStress) -> Pieces:
    """Which parts fight over what; where that cannot be said in short, what they carry."""
    conflict = conflict_in_words(stress)
    if conflict:
        return ended(begun(conflict))
    if not result.is_told_by_parts:
        told = stress_in_parts(stress, _MOST_TOLD)[:_MOST_TOLD]
        return ended(("Most stressed are ", *joined(told)))
    parts = stress_in_parts(stress, len(stress.parts))
    if len(parts) == 1:
        return sentence_of(("stressed in itself is ", *parts[0]))
    many = in_words(len(parts)).capitalize()
    return ended((f"{many} parts are stressed against each other: ", *joined(parts)))


#: How many things that move are named.
_MOST_NAMED = 3


def motion_in_sentence(result: Result, motion: Motion) -> Pieces:
    """What moves; joints that bodies take along are not named."""
    if not result.is_told_by_parts:
        return joined(motion_in_parts(motion, _MOST_NAMED))
    if motion.is_internal:
        if motion.ends:
            ends = [group_in_words(result, each, len(motion.ends) == 1) for each in motion.ends]
            return (*joined(ends), ", and nothing else moves")
        inside = parts_in_words(result, motion.internal_to)
        return ("inside ", *inside, " something moves, and nothing outside does")
    told = moving_groups(result, motion)
    groups = tuple(group_in_words(result, group, len(told) == 1) for group in told)
    pieces = tuple(map(_called, joined(groups)))
    is_inside = result.are_between_ends[motion.index]
    return (*pieces, ", and nothing else moves") if is_inside else pieces


def moving_groups(result: Result, motion: Motion) -> tuple[BodyMotion, ...]:
    """What a designer looks at in a motion, the largest first.

    Bodies; where none moves, ends and joints; where none of them does, folds.
    """
    groups = largest_first(motion)
    bodies = tuple(group for group in groups if group.bodies)
    if bodies:
        return bodies
    joints = (
        group._replace(joints=tuple(joint for joint in group.joints if not joint.is_fold))
        for group in groups
    )
    return tuple(group for group in joints if group.joints) or tuple(groups)


def _called(piece: Piece) -> Piece:
    """A point that is named "sheet 1, fold" as one says it: the fold of sheet 1."""
    if not isinstance(piece, Named) or piece.kind != "node":
        return piece
    whole, comma, own = piece.words.rpartition(", ")
    if not comma or not own[:1].islower():
        return piece
    return piece._replace(words=f"{with_article(own)} of {with_article(whole)}")


class MovingBody(NamedTuple):
    """A body, or a point where there is none, and how it moves."""

    name: str
    screw: Screw
    """Kind, direction, point and pitch."""


def _result_of(mode: Motion | SelfStress) -> Result:
    assert isinstance(mode.analysis, Result)
    return mode.analysis


@dataclass(frozen=True, repr=False)
class AdvisedMotion(Frozen):
    """A motion that nothing determines: what it is, why it is there, and how far it goes.

    Attributes:
        motion: The motion itself.
        causes: Why motions and self-stresses are there.
        extent: Whether it goes on, and how that is known.
    """

    motion: Motion
    causes: Causes
    extent: Extent

    @property
    def cause(self) -> Cause:
        """Whether any geometry has it, or this one."""
        return self.causes.motions[self.motion.index]

    @property
    def internal(self) -> bool:
        """Whether nothing moves but insides of sheets and wires, and folds."""
        return _result_of(self.motion).are_between_ends[self.motion.index]

    @cached_property
    def bodies(self) -> tuple[MovingBody, ...]:
        """The bodies that move; where there are none, ends and joints; none of an internal one."""
        result = _result_of(self.motion)
        if self.internal or not result.is_told_by_parts:
            return ()
        numbers = result.given.arrays.node_number
        made = []
        for group in moving_groups(result, self.motion):
            names = [part.name for part in group.bodies] or [
                named_node(result, int(numbers[joint_node(result.parts, joint)])).words
                for joint in group.joints
            ]
            made += [MovingBody(name, group.screw) for name in names]
        return tuple(made)

    @cached_property
    def sentences(self) -> tuple[Pieces, Pieces, Pieces]:
        """What moves, how far it goes, and why it is there."""
        result, index = _result_of(self.motion), self.motion.index
        return (
            sentence_of(motion_in_sentence(result, self.motion)),
            sentence_of(extent_in_words(result, self.extent)),
            sentence_of(cause_of_motion_in_words(result, index, self.causes)),
        )

    @property
    def statement(self) -> str:
        """All of it, and that nothing stops it, as text."""
        result, motion, is_one = _result_of(self.motion), self.motion, True
        if result.is_told_by_parts and not motion.is_internal:
            told = moving_groups(result, motion)
            is_one = len(told) == 1 and len(told[0].names) == 1
        stopped = f": nothing stops {'it' if is_one else 'them'}"
        moves = motion_in_sentence(result, motion)
        return in_a_row((sentence_of((*moves, stopped)), *self.sentences[1:]))

    def __repr__(self) -> str:
        """Number and words."""
        return f"<Motion {self.motion.index + 1}: {self.statement}>"


@dataclass(frozen=True, repr=False)
class AdvisedStress(Frozen):
    """A self-stress: what is stopped twice, and why.

    Attributes:
        stress: The self-stress itself.
        causes: Why motions and self-stresses are there.
    """

    stress: SelfStress
    causes: Causes

    @property
    def cause(self) -> Cause:
        """Whether any geometry has it, or this one."""
        return self.causes.self_stresses[self.stress.index]

    @cached_property
    def sentences(self) -> tuple[Pieces, Pieces]:
        """Which parts fight over what, and why it is there."""
        result, index = _result_of(self.stress), self.stress.index
        return (
            sentence_of(stress_in_sentence(result, self.stress)),
            sentence_of(cause_of_stress_in_words(result, index, self.causes)),
        )

    @property
    def statement(self) -> str:
        """All of it, as text."""
        return in_a_row(self.sentences)

    def __repr__(self) -> str:
        """Number and words."""
        return f"<SelfStress {self.stress.index + 1}: {self.statement}>"
