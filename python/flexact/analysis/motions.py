# SPDX-License-Identifier: BSD-3-Clause
"""Motions in words: what each body does, a translation, a rotation about a line, or a screw."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..core.arrays import FloatArray
from ..model.parts.parts import Part
from .body_motions import BodyMotion
from .decomposition import Outcome
from .modes import Motion
from .naming import coordinate_in_words, named_element, named_node, unit_of_coordinate
from .places import direction_words, joint_node, listed, part_words
from .result import Result
from .screws import Screw, ScrewKind
from .sentences import Pieces

#: How many names stand in a row.
_MOST_NAMES = 4
#: Coordinates below this part of the mechanism's size are zero.
_ZERO = 1.0e-9


def motion_in_parts(motion: Motion, most: int) -> tuple[Pieces, ...]:
    """What moves in a motion, the largest first, one more than `most` where there are more.

    Bodies stand before joints; of a large model these are coordinates.
    """
    outcome = motion.analysis
    if not outcome.is_told_by_parts:
        return tuple(
            (
                *coordinate_in_words(outcome, node, name),
                f" {value:.4g} {unit_of_coordinate(name)}",
            )
            for node, name, value in motion.largest(most + 1)
        )
    if motion.is_internal and not motion.ends:
        return (("inside ", *parts_in_words(outcome, motion.internal_to)),)
    groups = largest_first(motion)
    alone = len(groups) == 1
    return tuple(group_in_words(outcome, group, alone) for group in groups[: most + 1])


def largest_first(motion: Motion) -> list[BodyMotion]:
    """Bodies that move as one, the largest motion first, then joints, or ends inside of parts."""
    length = motion.analysis.characteristic_length
    return sorted(
        motion.bodies or motion.ends,
        key=lambda one: (one.is_joint, -round(_size(one.screw, length), 9)),
    )


def internal_in_words(result: Result) -> str:
    """How many motions are internal to which parts; empty where there are none."""
    count = result.internal_motions
    if not count:
        return ""
    inside = {part: None for motion in result.motions for part in motion.internal_to}
    names = [part_words(part) for part in inside]
    if len(names) > _MOST_NAMES:
        names = [*names[: _MOST_NAMES - 1], f"{len(names) - _MOST_NAMES + 1} other parts"]
    which = "All" if count == result.under_constrained else f"{count} of these motions"
    if count == result.under_constrained == 1:
        which = "This motion"
    be = "is" if count == 1 else "are"
    return f"{which} {be} internal to {listed(names)}."


def _size(screw: Screw, length: float) -> float:
    return max(
        float(np.linalg.norm(screw.velocity)), length * float(np.linalg.norm(screw.rotation))
    )


def group_in_words(outcome: Outcome, group: BodyMotion, alone: bool) -> Pieces:
    """Bodies or joints and how they move; without sizes where nothing else does."""
    if group.bodies:
        names = parts_in_words(outcome, group.bodies)
    else:
        numbers = outcome.given.arrays.node_number
        nodes = [joint_node(outcome.parts, joint) for joint in group.joints]
        names = joined([(named_node(outcome, int(numbers[node])),) for node in nodes])
    many = len(group.bodies or group.joints) > 1
    together = " together" if many else ""
    return (*names, f" {_verb(outcome, group.screw, many, alone)}{together}")


def _verb(outcome: Outcome, screw: Screw, many: bool, alone: bool) -> str:
    s = "" if many else "s"
    axis = direction_words(screw.direction)
    if screw.kind is ScrewKind.TRANSLATION:
        return f"move{s} along {axis}" + ("" if alone else f" by {screw.magnitude:.4g} m")
    about = f"about {line_words(outcome, screw.point, screw.direction)}"
    size = "" if alone else f" by {screw.magnitude:.4g} rad"
    if screw.kind is ScrewKind.ROTATION:
        return f"turn{s} {about}{size}"
    return f"turn{s} {about}{size} and move{s} along it by {screw.pitch:.4g} m/rad"


def line_words(outcome: Outcome, point: FloatArray, direction: FloatArray) -> str:
    """A line by a point of it [m] and its direction; along an axis any point of it serves.

    Across the plane of a planar model it is a point.
    """
    axis = direction_words(direction)
    numbers = [_number(outcome, value) for value in point]
    if outcome.given.planar and axis == "z":
        return f"the point ({', '.join(numbers[:2])}) m"
    if axis in ("x", "y", "z"):
        numbers["xyz".index(axis)] = "*"
    shown = numbers[:2] if outcome.given.planar else numbers
    return f"the line through ({', '.join(shown)}) m along {axis}"


def _number(outcome: Outcome, value: float) -> str:
    small = abs(value) < _ZERO * outcome.characteristic_length
    return "0" if small else f"{value:.4g}"


def parts_in_words(outcome: Outcome, parts: tuple[Part, ...]) -> Pieces:
    """Names of parts in a row."""
    numbers = outcome.given.arrays.element_number
    return joined([(named_element(outcome, int(numbers[part.elements[0]])),) for part in parts])


def joined(names: Sequence[Pieces]) -> Pieces:
    """Such as "a, b and c"; of many the first, and how many more."""
    rest = len(names) - _MOST_NAMES
    shown = names if rest <= 0 else [*names[: _MOST_NAMES - 1], (f"{rest + 1} more",)]
    made: list[Pieces] = []
    for place, name in enumerate(shown):
        before = "" if not place else " and " if place == len(shown) - 1 else ", "
        made.append((before, *name) if before else name)
    return tuple(piece for pieces in made for piece in pieces)
