# SPDX-License-Identifier: BSD-3-Clause
"""The mend of both in words: which limb is turned, and what it stops then."""

from __future__ import annotations

from math import degrees

import numpy as np

from ...analysis.motions import line_words
from ...analysis.naming import counts_in_words, in_words, named_element, named_node
from ...analysis.places import axis_words, direction_words, part_words, place_words
from ...analysis.result import Result
from ...analysis.screws import Screw, ScrewKind
from ...analysis.sentences import Named, Pieces
from ...analysis.units import length_in_words
from ..proposal import Proposal
from .advising_relations import limb_names, limbs_in_words, row_of
from .joint_moves import JointMove
from .mend import Mend


def mend_in_words(result: Result, proposal: Proposal) -> Pieces:
    """Which constraint repeats which while what is free, and how the limb is turned."""
    if isinstance(proposal, JointMove):
        return _moved(result, proposal)
    if not isinstance(proposal, Mend):
        return ()
    limb = limbs_in_words(result, proposal.parts)
    angle = f" by {degrees(abs(proposal.angle)):.4g} degrees about {_line(result, proposal)}"
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


def _line(result: Result, mend: Mend) -> str:
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
