# SPDX-License-Identifier: BSD-3-Clause
"""The cause of each motion and self-stress of a result."""

from __future__ import annotations

from collections.abc import Callable
from itertools import chain

import numpy as np

from ...analysis.modes import Motion
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...util.cached import cached_property
from ..proposal import Proposal
from .cause import Cause, CauseKind, Causes, Relation
from .generic import generic_rank
from .gradients import Gradients, are_affordable
from .joint_moves import joint_move
from .kinds import Lifted, Told, all_alike, by_count, told_apart
from .lifts import Lifts
from .mends import mends_of
from .relations import merged, relations_of
from .shares import THERE, Shares
from .trials import Trials

#: How many special self-stresses are explained, and by how many relations a motion.
_MOST_EXPLAINED, _MOST_RELATIONS = 8, 4
#: Pairs below this part of the largest do not belong together.
_COUPLED = 1.0e-6


def causes_of(result: Result) -> Causes:
    """Why the motions and self-stresses of a result are there.

    Divided sheets and wires count as one beam each, whether they are declared so or not. Where
    there are very many motions or self-stresses, which of them are special follows from the
    count alone, and what makes them so and what lifts them is not looked for.

    Args:
        result: The result of an analysis.

    Raises:
        ModelError, DeckError, AnalysisError: the mechanism with its divided sheets as one beam
            each cannot be analysed.
    """
    whole = result.with_internal_declared or result
    rank, trials = generic_rank(whole)
    motions, stresses = len(result.motions), len(result.self_stresses)
    if rank is None:
        unknown = Cause(CauseKind.UNKNOWN)
        return Causes((unknown,) * motions, (unknown,) * stresses)
    if rank == whole.rank:
        generic = Cause(CauseKind.GENERIC)
        return Causes((generic,) * motions, (generic,) * stresses, (), rank, trials)
    can_be_told = whole is result or whole.is_told_by_parts
    if not can_be_told or not are_affordable(whole):
        return Causes(
            _by_count(motions, whole.columns - rank, rank - whole.rank),
            _by_count(stresses, whole.rows - rank, rank - whole.rank),
            (),
            rank,
            trials,
        )
    return _Special(result, whole, rank).causes(trials)


def _by_count(count: int, generic: int, special: int) -> tuple[Cause, ...]:
    if generic == 0:
        return (Cause(CauseKind.SPECIAL),) * count
    told = list(by_count(range(count), min(special, count)).values())
    return _made(told, lambda _, kind: Cause(kind))


class _Special:
    """The causes where some of the motions and self-stresses are special.

    Attributes:
        result: The result of which modes are told.
        whole: The same with divided sheets and wires as one beam each.
        generic: How many motions and self-stresses of `whole` are generic.
    """

    def __init__(self, result: Result, whole: Result, rank: int) -> None:
        self.result, self.whole = result, whole
        self.generic = whole.columns - rank, whole.rows - rank
        self.rank = rank
        self.gradients = Gradients(whole)
        self.lifted = Lifted(self.gradients, rank)
        self.shares = Shares(result, whole, self.gradients)
        self.trials = Trials(whole, rank)

    def causes(self, trials: int) -> Causes:
        """All of it."""
        lifts = Lifts(self.gradients)
        motions, stresses = self.shares.motions, self.shares.stresses
        pairs = self.lifted.couplings(self.shares.own_stresses, motions)

        def of_motion(k: int, kind: CauseKind) -> Cause:
            share = motions[:, k]
            relations = self._of_motion(pairs[:, k])
            return Cause(kind, lift=lifts.of_motion(share), relations=relations)

        def of_stress(k: int, kind: CauseKind) -> Cause:
            share = stresses[:, k]
            return Cause(kind, lift=lifts.of_stress(share), relations=self._of_stress(share))

        return Causes(
            _made(self._motions_told(motions), of_motion),
            _made(self._stresses_told(stresses), of_stress),
            self._mends(),
            self.rank,
            trials,
        )

    def _mends(self) -> tuple[Proposal, ...]:
        if not self.whole.is_told_by_parts:
            return ()
        relations = merged(chain(*self._relations.values()))
        return mends_of(self.whole, relations, self._motions) or joint_move(
            self.whole, self.gradients
        )

    # Which are special ------------------------------------------------------

    def _motions_told(self, told: FloatArray) -> list[Told]:
        groups = self.lifted.groups(self.shares.own_stresses, told)
        return self._told(
            told, self.generic[0], self.lifted.motions, None if groups is None else groups.motions
        )

    def _stresses_told(self, told: FloatArray) -> list[Told]:
        groups = self.lifted.groups(told, self.shares.own_motions)
        return self._told(
            told, self.generic[1], self.lifted.stresses, None if groups is None else groups.stresses
        )

    def _told(
        self,
        told: FloatArray,
        generic: int,
        never: FloatArray,
        groups: list[tuple[list[int], int]] | None,
    ) -> list[Told]:
        """Which of some told vectors are special; what the undivided mechanism has not is not."""
        there = np.flatnonzero(np.linalg.norm(told, axis=0) > THERE).tolist()
        if generic == 0 and len(there) == told.shape[1]:
            return all_alike(len(there), True)
        return told_apart(told, never, groups or [(there, self.lifted.special)])

    @cached_property
    def _motions(self) -> list[Motion]:
        """The special ones of the undivided mechanism, if it is told by parts."""
        if not self.whole.is_told_by_parts:
            return []
        told = self._motions_told(self.shares.own_motions)
        return [self.whole.motions[k] for k, one in enumerate(told) if one.is_special]

    # What makes them so -----------------------------------------------------

    @cached_property
    def _relations(self) -> dict[int, tuple[Relation, ...]]:
        """What makes the geometry special, by the self-stress of the undivided mechanism."""
        whole = self.whole
        if not whole.is_told_by_parts:
            return {}
        told = self._stresses_told(self.shares.own_stresses)
        chosen = [k for k, one in enumerate(told) if one.is_special][:_MOST_EXPLAINED]
        made: dict[int, tuple[Relation, ...]] = {}
        for k in chosen:
            # Which of several is special is free: they have one explanation.
            same = next((j for j in made if told[k].together and j in told[k].together), None)
            if same is not None:
                made[k] = made[same]
                continue
            one, trials = told[k], self.trials
            many = (one.together, one.special) if one.together else ((k,), 1)
            made[k] = relations_of(whole, many[0], self._motions, trials, many[1])
        return made

    def _of_stress(self, share: FloatArray) -> tuple[Relation, ...]:
        """Of the special self-stress that has the largest part in one."""
        if not self._relations:
            return ()
        parts = np.abs(np.linalg.lstsq(self.shares.own_stresses, share, rcond=None)[0])
        return self._relations[max(self._relations, key=lambda k: (round(float(parts[k]), 9), -k))]

    def _of_motion(self, pairs: FloatArray) -> tuple[Relation, ...]:
        """Of all special self-stresses that misalignments lift together with a motion.

        Args:
            pairs: (told,) how much they do, of each self-stress of the undivided mechanism.
        """
        special = self._relations
        largest = max((float(pairs[k]) for k in special), default=0.0)
        able = [k for k in special if pairs[k] > _COUPLED * largest] or list(special)
        # A part of what is enough together is not.
        made: tuple[Relation, ...] = ()
        for k in able:
            more = merged((*made, *special[k]))
            made = more if not made or len(more) <= _MOST_RELATIONS else made
        return made


def _made(told: list[Told], cause_of: Callable[[int, CauseKind], Cause]) -> tuple[Cause, ...]:
    """The causes of some modes; `cause_of` makes what may be special."""
    made = []
    for k, one in enumerate(told):
        if not one.is_special and not one.together:
            made.append(Cause(CauseKind.GENERIC))
            continue
        found = cause_of(k, CauseKind.SPECIAL if one.is_special else CauseKind.GENERIC)
        made.append(
            Cause(
                found.kind,
                one.together,
                one.special,
                found.lift or None,
                None if found.lift is None else bool(found.lift),
                found.relations,
            )
        )
    return tuple(made)
