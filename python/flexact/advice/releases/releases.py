# SPDX-License-Identifier: BSD-3-Clause
"""Which sets of deformations, released, leave no self-stress."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...util.records import Frozen
from ..proposal import Proposal, Purpose, nothing
from . import candidates as reaches
from .candidates import Places, Reach
from .cost import cost_of
from .counting import counted
from .kinds import BODY, LINK, tier_of_element
from .releases_candidates import candidates
from .stands import as_it_stands, complete
from .steps import by_steps
from .verify import NOTHING_LEFT_OUT, LeftOut, Outcome, decades, listed

#: How many supports that may be freed are listed.
_MOST_SUPPORTS = 4


@dataclass(frozen=True)
class Releases(Frozen):
    """What may be released so that no self-stress is left.

    Attributes:
        size: How many self-stresses the deck as it stands has, and so how many deformations
            must be released at least.
        count: How many sets of so many deformations of class fixed leave no self-stress when
            they are released; None where they are too many to be counted. It is 0 where there
            is no self-stress: nothing is to be released then, and that is no set.
        sets: The best of them, each tried; see `releases_of`.
        supports: The same of supports: fixed coordinates that may be freed, not in `count`.
        left_out: What was not looked at.
        doubtful: How many sets more do so for the numbers as they are, though rounding may hide
            that they do not; not in `count`, and None where they are too many.
    """

    size: int
    count: int | None
    sets: tuple[Proposal, ...] = ()
    supports: tuple[Proposal, ...] = ()
    left_out: LeftOut = NOTHING_LEFT_OUT
    doubtful: int | None = 0


def releases_of(result: Result, with_bodies: bool = False) -> Releases:
    """What may be released so that no self-stress is left, the best first.

    A set of s deformations works exactly when the s x s block of their rows in the left null
    space of D(c) is regular; they are counted on the deck as it stands, where each beam of a
    divided sheet is one of its own. What is listed are deformations of whole sheets, at their
    ends, as a designer would release them. `condition` of a proposal is the inverse of the
    smallest singular value of its block in an orthonormal basis, with moments compared by the
    characteristic length: by so much the largest self-stress can exceed what the released
    deformations carry of it.

    Where the stiffness of what is stressed is known, sets come first that cost little of it
    (`flexact.advice.releases.cost`); else those of a condition within ten times the best,
    flexures before bodies, ties by names and places. Links inside of bodies are listed where
    nothing else does it, or `with_bodies`.

    Without a self-stress there is one set, the empty one.

    Of large models, of which not all null vectors fit, nothing is counted, and one set at most is
    given (`flexact.advice.releases.steps`).

    Raises:
        AnalysisError: the deck as it stands cannot be analysed.
    """
    stands = as_it_stands(result)
    size = stands.over_constrained
    if not size:
        return Releases(0, 1, (nothing(result, Purpose.RELEASE),))
    if stands.stress_space.vectors < size or not reaches.fits(stands.stress_space):
        one = by_steps(stands, Purpose.RELEASE, reaches.of_rows, _tiers)
        sets = () if one is None else (one,)
        return Releases(size, None, sets, left_out=LeftOut(is_too_large=True))
    reach = reaches.of_rows(stands)
    count = counted(stands, reach, lambda after: after.over_constrained)
    tried = Outcome((), NOTHING_LEFT_OUT)
    for source in _sources(result, stands):
        tried = _listed(result, source, with_bodies) if count.certain != 0 else tried
        if tried.proposals:
            break
    supports = _supports(result, _whole(result, stands))
    return Releases(
        *(size, count.certain, tried.proposals, supports.proposals),
        tried.left_out,
        count.doubtful,
    )


def _sources(result: Result, stands: Result) -> list[Result]:
    """Results whose rows are listed: of whole sheets, where they have as many self-stresses."""
    whole = _whole(result, stands)
    same = [whole] if whole.over_constrained == stands.over_constrained else []
    return same if whole is stands else [*same, stands]


def _whole(result: Result, stands: Result) -> Result:
    """The result with each divided sheet or wire as one beam."""
    whole = result.with_internal_declared
    if whole is not None:
        return complete(whole)
    return complete(result) if result.condensed.chains else stands


def _listed(result: Result, source: Result, with_bodies: bool) -> Outcome:
    reach = reaches.of_rows(source)
    tiers = _tiers(source, reach)
    cost = cost_of(source, reach)

    def ranking(sets: Places, condition: FloatArray) -> FloatArray:
        first = decades(condition) if cost is None else cost(sets)[:, None]
        return np.concatenate([first, np.sort(tiers[sets], axis=1)[:, ::-1]], axis=1)

    found = candidates(reach, ranking, tiers)
    chosen = found
    for tier in () if with_bodies else (BODY, LINK):
        without = [one for one in found if tiers[list(one.members)].max() < tier]
        if without:
            chosen = without
            break
    return listed(result, reach, Purpose.RELEASE, chosen)


def _tiers(source: Result, reach: Reach) -> FloatArray:
    """(n,) how late rows are released."""
    elements = source.condensed.elements[source.raw.row_label[0, reach.index] - 1]
    return np.array([tier_of_element(source, int(i)) for i in elements], float)


def _supports(result: Result, source: Result) -> Outcome:
    space = source.stress_space
    if source.over_constrained != space.vectors or not reaches.fits(space):
        return Outcome((), NOTHING_LEFT_OUT)
    reach = reaches.of_supports(source)
    found = candidates(reach, lambda sets, _: np.zeros((len(sets), 1)), np.zeros(len(reach.index)))
    return listed(result, reach, Purpose.RELEASE, found, _MOST_SUPPORTS)
