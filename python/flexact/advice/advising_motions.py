# SPDX-License-Identifier: BSD-3-Clause
"""What nothing stops: a motion in a sentence, as a designer would put it."""

from __future__ import annotations

from ..analysis.body_motions import BodyMotion
from ..analysis.modes import Motion
from ..analysis.motions import (
    group_in_words,
    joined,
    largest_first,
    motion_in_parts,
    parts_in_words,
)
from ..analysis.places import with_article
from ..analysis.result import Result
from ..analysis.sentences import Named, Piece, Pieces

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


def nothing_stops(result: Result, motion: Motion) -> str:
    """That nothing stops it, or them, to stand behind what moves."""
    if not result.is_told_by_parts or motion.is_internal:
        return ": nothing stops it"
    told = moving_groups(result, motion)
    is_one = len(told) == 1 and len(told[0].names) == 1
    return f": nothing stops {'it' if is_one else 'them'}"


def moving_groups(result: Result, motion: Motion) -> tuple[BodyMotion, ...]:
    """What a designer looks at in a motion, the largest first.

    Bodies; where none moves, ends and joints; where none of them does, folds.
    """
    groups = largest_first(motion)
    bodies = tuple(group for group in groups if group.bodies)
    if bodies:
        return bodies
    joints = (_without_folds(group) for group in groups)
    return tuple(group for group in joints if group.joints) or tuple(groups)


def _without_folds(group: BodyMotion) -> BodyMotion:
    return group._replace(joints=tuple(joint for joint in group.joints if not joint.is_fold))


def _called(piece: Piece) -> Piece:
    """A point that is named "sheet 1, fold" as one says it: the fold of sheet 1."""
    if not isinstance(piece, Named) or piece.kind != "node":
        return piece
    whole, comma, own = piece.words.rpartition(", ")
    if not comma or not own[:1].islower():
        return piece
    return piece._replace(words=f"{with_article(own)} of {with_article(whole)}")
