# SPDX-License-Identifier: BSD-3-Clause
"""Limbs that repeat what others hold, turned so that they stop what is free instead.

A limb is turned as a whole, about lines through the body that it holds or through where it is
fastened there, and each turn is tried by an analysis.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ...analysis.change import Change
from ...analysis.decomposition import Asked
from ...analysis.modes import Motion
from ...analysis.result import Result, result_of
from ...analysis.screws import Screw
from ...core.arrays import FloatArray
from ..proposal import After, Purpose
from .cause import Relation
from .mend import Mend
from .realignment import Tried, TurnSearch

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
    able.sort(key=lambda one: (not one.is_in_place, -_rounded(one.smallest)))
    groups: dict[tuple[float, bool], list[Tried]] = {}
    for one in able:
        groups.setdefault((_rounded(one.smallest), one.is_in_place), []).append(one)
    given: set[tuple[object, ...]] = set()
    for group in groups.values():
        turn = group[0].turn
        key = (turn.limb.parts, *np.round(turn.direction, 6).tolist())
        if key not in given and len(given) < _MOST_LOOKED_AT:
            given.add(key)
            yield tuple(group)


def _rounded(value: float) -> float:
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
