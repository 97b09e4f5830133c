# SPDX-License-Identifier: BSD-3-Clause
"""Which sets of coordinates, declared independent or held, leave no motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...core.elements import NodeKind
from ...util.records import Frozen
from ..proposal import Proposal, Purpose, nothing
from . import candidates as reaches
from .candidates import Places, Reach
from .counting import counted
from .kinds import LINK, tier_of_node
from .releases_candidates import Candidate, candidates
from .stands import as_it_stands, complete
from .steps import by_steps
from .verify import NOTHING_LEFT_OUT, LeftOut, Outcome, decades, listed

#: How many sets of released deformations that may be held are listed.
_MOST_HELD = 4
#: Motions of points of a body that agree to so many digits are one.
_DIGITS = 9


@dataclass(frozen=True)
class Declarations(Frozen):
    """What may be declared independent, or held, so that no motion is left.

    Attributes:
        size: How many motions the deck as it stands has that nothing determines, and so how
            many coordinates must be declared at least.
        count: How many sets of so many columns of D(c) leave no motion when they are held;
            None where they are too many to be counted. It is 0 where there is no motion.
        sets: The best of them, each tried; see `declarations_of`.
        holds: The same of released deformations that may be held, not in `count`.
        left_out: What was not looked at.
        doubtful: How many sets more do so for the numbers as they are, though rounding may hide
            that they do not; not in `count`, and None where they are too many.
    """

    size: int
    count: int | None
    sets: tuple[Proposal, ...] = ()
    holds: tuple[Proposal, ...] = ()
    left_out: LeftOut = NOTHING_LEFT_OUT
    doubtful: int | None = 0


def declarations_of(result: Result) -> Declarations:
    """What may be declared independent, or held, so that no motion is left, the best first.

    A set of m coordinates works exactly when the m x m block of their rows in the null space of
    D(c) is regular. They are counted on the deck as it stands, where each beam of a divided
    sheet is one of its own. `condition` of a proposal is the inverse of the smallest singular
    value of its block in an orthonormal basis, with rotations compared by the characteristic
    length. Sets of a condition within ten times the best come first, of these such of bodies,
    then of joints, then of what is inside of sheets; displacements before rotations. Without a
    motion there is one set, the empty one.

    Raises:
        AnalysisError: the deck as it stands cannot be analysed.
    """
    stands = as_it_stands(result)
    size = stands.under_constrained
    if not size:
        return Declarations(0, 1, (nothing(result, Purpose.DECLARE),))
    if stands.motion_space.vectors < size or not reaches.fits(stands.motion_space):
        one = by_steps(stands, Purpose.DECLARE, reaches.of_columns, _tiers)
        sets = () if one is None else (one,)
        return Declarations(size, None, sets, left_out=LeftOut(is_too_large=True))
    reach = reaches.of_columns(stands)
    count = counted(stands, reach, lambda after: after.under_constrained)
    whole = complete(result) if result.condensed.chains else stands
    tried = Outcome((), NOTHING_LEFT_OUT)
    for source in dict.fromkeys(one for one in (whole, stands) if one.under_constrained == size):
        tried = _listed(result, source)
        if tried.proposals:
            break
    is_told = whole.under_constrained == size and result.with_internal_declared is None
    holds = _holds(result, whole) if is_told else Outcome((), NOTHING_LEFT_OUT)
    return Declarations(
        *(size, count.certain, tried.proposals, holds.proposals),
        tried.left_out,
        count.doubtful,
    )


def _listed(result: Result, source: Result) -> Outcome:
    reach = _without_repeats(source, reaches.of_columns(source))
    nodes = source.raw.column_label[0, reach.index] - 1
    tiers = _tiers(source, reach)
    turns = (source.data.arrays.node_kind[nodes] > NodeKind.POSITION).astype(float)

    def ranking(sets: Places, condition: FloatArray) -> FloatArray:
        of_sets = np.sort(tiers[sets], axis=1)[:, ::-1]
        turning = turns[sets].sum(axis=1)[:, None]
        return np.concatenate([decades(condition), of_sets, turning], axis=1)

    found = candidates(reach, ranking, tiers)
    return listed(result, reach, Purpose.DECLARE, _one_inside(found, tiers))


def _tiers(source: Result, reach: Reach) -> FloatArray:
    """(n,) how late coordinates are declared."""
    nodes = source.condensed.nodes[source.raw.column_label[0, reach.index] - 1]
    return np.array([tier_of_node(source, int(i)) for i in nodes], float)


def _one_inside(found: list[Candidate], tiers: FloatArray) -> list[Candidate]:
    """Of sets that differ in what is inside of sheets and wires alone the best."""
    first: dict[tuple[int, ...], Candidate] = {}
    for one in found:
        first.setdefault(tuple(i for i in one.members if tiers[i] < LINK), one)
    return list(first.values())


def _without_repeats(source: Result, reach: Reach) -> Reach:
    """Of points of one body that move in the same way along an axis the first by name."""
    first: dict[tuple[int, int, bool, bytes], int] = {}
    for i in sorted(range(len(reach.index)), key=lambda i: reach.key(int(reach.index[i]))):
        node, axis = (source.raw.column_label[:, reach.index[i]] - 1).tolist()
        given = int(source.condensed.nodes[node])
        turns = bool(source.data.arrays.node_kind[node] > NodeKind.POSITION)
        body = source.parts.body_at.get(given, -1 - given)
        way = (np.round(reach.rows[i], _DIGITS) + 0.0).tobytes()
        first.setdefault((body, axis, turns, way), i)
    return reach.only(np.array(sorted(first.values()), np.int64))


def _holds(result: Result, source: Result) -> Outcome:
    reach = reaches.of_released(source)
    found = candidates(reach, lambda _, condition: decades(condition), np.zeros(len(reach.index)))
    return listed(result, reach, Purpose.HOLD, found, _MOST_HELD)
