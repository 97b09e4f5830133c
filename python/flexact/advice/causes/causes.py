# SPDX-License-Identifier: BSD-3-Clause
"""The cause of each motion and self-stress of a result."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import chain

import numpy as np

from ...analysis.result import Motion, Result
from ...core.arrays import FloatArray
from ...util.groups import groups_of, values_in
from ...util.records import cached_property
from ..step import Step
from .cause import Cause, CauseKind, Causes, Lift, Relation
from .gradients import (
    THERE,
    Gradients,
    are_affordable,
    generic_rank,
    shares_of_motions,
    shares_of_stresses,
)
from .realignment import joint_move, mends_of
from .relations import merged, relations_of
from .trials import Trials

#: What is below this part of the largest is none: differences are good to some 1e-8.
_NOTHING = 1.0e-6
#: Of vectors of unit length, what is beyond a space.
_OUTSIDE = 1.0e-4
_SEED = 20_110_720


def by_count(indices: Sequence[int], special: int) -> dict[int, Cause]:
    """So many of some, nobody knows which: the last ones."""
    first = len(indices) - special
    kinds = [CauseKind.SPECIAL if k >= first else CauseKind.GENERIC for k in range(len(indices))]
    return {j: Cause(kind, tuple(indices), special) for j, kind in zip(indices, kinds, strict=True)}


def told_apart(
    told: FloatArray, never: FloatArray, groups: Sequence[tuple[Sequence[int], int]]
) -> list[Cause]:
    """Which of some vectors are special.

    Args:
        told: (d, k) independent vectors of unit length in a null space, by an orthonormal basis.
        never: (d, g) orthonormal, those that nothing lifts.
        groups: Of vectors that no misalignment lifts together with others, and how many of
            each group are special; what is in no group is generic.
    """
    beyond = told - never @ (never.T @ told)
    made = dict.fromkeys(range(told.shape[1]), Cause(CauseKind.GENERIC))
    for indices, special in groups:
        rest = beyond[:, indices]
        lifted = [k for k in indices if float(np.linalg.norm(beyond[:, k])) > _OUTSIDE]
        chosen: list[int] = []
        # The last first: those that come first are the simpler ones, and rather wanted.
        for place, k in reversed(list(enumerate(indices))):
            size = float(np.linalg.norm(rest[:, place]))
            if len(chosen) < special and k in lifted and size > _OUTSIDE:
                unit = rest[:, [place]] / size
                rest = rest - unit @ (unit.T @ rest)
                chosen.append(k)
        if len(chosen) < special:
            # What is lifted to a higher order only, and was not looked at.
            made |= by_count(indices, special)
            continue
        is_known = len(lifted) == len(chosen)
        for k in lifted:
            kind = CauseKind.SPECIAL if k in chosen else CauseKind.GENERIC
            made[k] = Cause(kind) if is_known else Cause(kind, tuple(lifted), len(chosen))
    return list(made.values())


#: What misalignments lift together: which, and how many of them are special.
Groups = list[tuple[list[int], int]]


def _kernel(rows: FloatArray) -> FloatArray:
    """(d, g) orthonormal: combinations of d rows that vanish."""
    values, vectors = np.linalg.eigh(rows @ rows.T)
    return np.asarray(
        vectors[:, values <= _NOTHING**2 * max(float(values.max(initial=0.0)), 1e-12)]
    )


def _within(space: FloatArray, other: FloatArray, most: int) -> FloatArray:
    """(d, most) the part of a space that is nearest to another one."""
    if space.shape[1] <= most:
        return space
    turned = np.linalg.svd(space.T @ other)[0]
    return np.asarray(space @ turned[:, :most])


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
    rank = generic_rank(whole)
    motions, stresses = len(result.motions), len(result.self_stresses)
    if rank is None or rank == whole.rank:
        one = Cause(CauseKind.UNKNOWN if rank is None else CauseKind.GENERIC)
        return Causes((one,) * motions, (one,) * stresses, (), rank)
    can_be_told = whole is result or whole.is_told_by_parts
    if can_be_told and are_affordable(whole):
        return _Special(result, whole, rank).causes()
    of_motions, of_stresses = (
        (Cause(CauseKind.SPECIAL),) * count
        if generic == 0
        else tuple(by_count(range(count), min(rank - whole.rank, count)).values())
        for count, generic in ((motions, whole.columns - rank), (stresses, whole.rows - rank))
    )
    return Causes(of_motions, of_stresses, (), rank)


class _Special:
    """The causes where some of the motions and self-stresses are special.

    Attributes:
        whole: The result with divided sheets and wires as one beam each.
        rank: That of almost every geometry.
        motions: (k, told) the told motions by an orthonormal basis of those of `whole`.
        own_motions: (k, own) those of `whole` itself, likewise.
        stresses: (s, told) the told self-stresses.
        own_stresses: (s, own) those of `whole` itself.
        never_motions: (k, g) orthonormal combinations of the motions that nothing lifts.
        never_stresses: (s, g) likewise.
    """

    def __init__(self, result: Result, whole: Result, rank: int) -> None:
        self.whole, self.rank = whole, rank
        self.trials, self.gradients = Trials(whole, rank), Gradients(whole)
        gradients = self.gradients
        self.motions, self.own_motions = shares_of_motions(result, whole, gradients)
        self.stresses, self.own_stresses = shares_of_stresses(result, whole, gradients)
        # By every place, in lengths of the mechanism, and every vector: (changes, s, k).
        at_nodes = whole.characteristic_length * gradients.at_nodes
        flat = (-1, *at_nodes.shape[2:])
        changes = np.concatenate((at_nodes.reshape(flat), gradients.by_vector.reshape(flat)))
        self._changes = changes
        motions = _kernel(np.moveaxis(changes, 2, 0).reshape(changes.shape[2], -1))
        stresses = _kernel(np.moveaxis(changes, 1, 0).reshape(changes.shape[1], -1))
        of_motions, of_stresses = whole.columns - rank, whole.rows - rank
        if motions.shape[1] > of_motions or stresses.shape[1] > of_stresses:
            left = gradients.left_over(of_motions, of_stresses)
            if left is not None:
                motions = _within(motions, left[0], of_motions)
                stresses = _within(stresses, left[1], of_stresses)
        self.never_motions, self.never_stresses = motions, stresses

    def causes(self) -> Causes:
        """All of it."""
        motions, stresses = self._motions_told(self.motions), self._stresses_told(self.stresses)
        mends: tuple[Step, ...] = ()
        if self.whole.is_told_by_parts:
            relations = merged(chain(*self._relations.values()))
            mends = mends_of(self.whole, relations, self._motions)
            mends = mends or joint_move(self.whole, self.gradients)
        pairs = np.linalg.norm(self._blocks(self.own_stresses, self.motions), axis=2)
        lift_of = self.gradients.lift_of
        return Causes(
            tuple(
                one
                if _is_generic(one)
                else _explained(one, lift_of(self.motions[:, k]), self._of_motion(pairs[:, k]))
                for k, one in enumerate(motions)
            ),
            tuple(
                one
                if _is_generic(one)
                else _explained(
                    one,
                    lift_of(self.stresses[:, k], of_stress=True),
                    self._of_stress(self.stresses[:, k]),
                )
                for k, one in enumerate(stresses)
            ),
            mends,
            self.rank,
        )

    # Which are special ------------------------------------------------------

    def _blocks(self, stresses: FloatArray, motions: FloatArray) -> FloatArray:
        """(a, b, changes) what all changes make of self-stresses (s, a) and motions (k, b)."""
        return np.asarray(np.moveaxis(stresses.T @ self._changes @ motions, 0, 2))

    def _groups(self, stresses: FloatArray, motions: FloatArray) -> tuple[Groups, Groups] | None:
        """Self-stresses and motions that misalignments lift together, to first order.

        Args:
            stresses: (s, a) self-stresses.
            motions: (k, b) motions.

        Returns:
            None where not all that is special is lifted to first order.
        """
        blocks = self._blocks(stresses, motions)
        sizes = np.linalg.norm(blocks, axis=2)
        pairs = np.argwhere(sizes > _NOTHING * max(float(sizes.max(initial=0.0)), 1e-12))
        count = stresses.shape[1]
        owner = groups_of(count + motions.shape[1], ((i, count + j) for i, j in pairs.tolist()))
        weights = np.random.default_rng(_SEED).normal(size=blocks.shape[2])
        mixed = blocks @ weights
        of_stresses: Groups = []
        of_motions: Groups = []
        for group in values_in(owner[pairs[:, 0]]).tolist() if len(pairs) else []:
            mine = np.flatnonzero(owner == group)
            rows, columns = mine[mine < count], mine[mine >= count] - count
            values = np.linalg.svd(mixed[np.ix_(rows, columns)], compute_uv=False)
            special = int(np.count_nonzero(values > _NOTHING * values[0]))
            of_stresses.append((rows.tolist(), special))
            of_motions.append((columns.tolist(), special))
        is_all = sum(special for _, special in of_stresses) == self.rank - self.whole.rank
        return (of_stresses, of_motions) if is_all else None

    def _motions_told(self, told: FloatArray) -> list[Cause]:
        groups = self._groups(self.own_stresses, told)
        generic = self.whole.columns - self.rank
        return self._told(told, generic, self.never_motions, groups and groups[1])

    def _stresses_told(self, told: FloatArray) -> list[Cause]:
        groups = self._groups(told, self.own_motions)
        generic = self.whole.rows - self.rank
        return self._told(told, generic, self.never_stresses, groups and groups[0])

    def _told(
        self, told: FloatArray, generic: int, never: FloatArray, groups: Groups | None
    ) -> list[Cause]:
        """Which of some told vectors are special; what the undivided mechanism has not is not."""
        there = np.flatnonzero(np.linalg.norm(told, axis=0) > THERE).tolist()
        if generic == 0 and len(there) == told.shape[1]:
            return [Cause(CauseKind.SPECIAL)] * len(there)
        return told_apart(told, never, groups or [(there, self.rank - self.whole.rank)])

    @cached_property
    def _motions(self) -> list[Motion]:
        """The special ones of the undivided mechanism, if it is told by parts."""
        if not self.whole.is_told_by_parts:
            return []
        told = self._motions_told(self.own_motions)
        return [self.whole.motions[k] for k in _special(told)]

    # What makes them so -----------------------------------------------------

    @cached_property
    def _relations(self) -> dict[int, tuple[Relation, ...]]:
        """What makes the geometry special, by the self-stress of the undivided mechanism."""
        whole = self.whole
        if not whole.is_told_by_parts:
            return {}
        told = self._stresses_told(self.own_stresses)
        chosen = _special(told)[:_MOST_EXPLAINED]
        made: dict[int, tuple[Relation, ...]] = {}
        for k in chosen:
            # Which of several is special is free: they have one explanation.
            same = next((j for j in made if told[k].together and j in told[k].together), None)
            if same is not None:
                made[k] = made[same]
                continue
            which, special = (told[k].together, told[k].special) if told[k].together else ((k,), 1)
            made[k] = relations_of(whole, which, self._motions, self.trials, special)
        return made

    def _of_stress(self, share: FloatArray) -> tuple[Relation, ...]:
        """Of the special self-stress that has the largest part in one."""
        if not self._relations:
            return ()
        parts = np.abs(np.linalg.lstsq(self.own_stresses, share, rcond=None)[0])
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


def _special(told: list[Cause]) -> list[int]:
    return [k for k, one in enumerate(told) if one.kind is CauseKind.SPECIAL]


def _is_generic(one: Cause) -> bool:
    return one.kind is CauseKind.GENERIC and not one.together


def _explained(one: Cause, lift: Lift, relations: tuple[Relation, ...]) -> Cause:
    # What lifts nothing is none.
    return replace(one, lift=lift or None, is_first_order=bool(lift), relations=relations)
