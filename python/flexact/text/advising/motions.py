# SPDX-License-Identifier: BSD-3-Clause
"""What nothing stops: a motion in a sentence, as a designer would put it."""

from __future__ import annotations

from ...result.body_motions import BodyMotion
from ...result.modes import Motion
from ...result.result import Result
from ..motions import group_in_words, joined, largest_first, motion_in_parts, parts_in_words
from ..sentences import Pieces
from .sentences import begun

#: How many things that move are named.
_MOST_NAMED = 3


def motion_in_sentence(result: Result, motion: Motion) -> Pieces:
    """What moves, and that nothing stops it; joints that bodies take along are not named."""
    if not result.is_told_by_parts:
        return begun((*joined(motion_in_parts(motion, _MOST_NAMED)), ": nothing stops it."))
    if motion.is_internal:
        inside = parts_in_words(result, motion.internal_to)
        return ("Inside ", *inside, " something moves, and nothing outside does: nothing stops it.")
    told = moving_groups(result, motion)
    pieces = joined(tuple(group_in_words(result, group, len(told) == 1) for group in told))
    it = "it" if len(told) == 1 and len(told[0].names) == 1 else "them"
    if result.are_between_ends[motion.index]:
        return begun((*pieces, f", and nothing else moves: nothing stops {it}."))
    return begun((*pieces, f": nothing stops {it}."))


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
