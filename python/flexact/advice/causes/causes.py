# SPDX-License-Identifier: BSD-3-Clause
"""The cause of each motion and self-stress of a result."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import chain
from typing import NamedTuple

import numpy as np

from ...analysis.result import Motion, Result
from ...core.arrays import FloatArray
from ...util.groups import groups_of
from ...util.records import Frozen, cached_property
from ..step import Step
from .cause import Cause, CauseKind, Causes, Relation
from .gradients import (
    THERE,
    Gradients,
    MisalignmentRates,
    UndividedBasis,
    are_affordable,
    generic_rank,
)
from .realignment import joint_move, mends_of
from .relations import merged, relations_of
from .trials import Trials

#: What is below this part of the largest is none: differences are good to some 1e-8.
_NOTHING = 1.0e-6
#: Of vectors of unit length, what is beyond a space.
_OUTSIDE = 1.0e-4
_SEED = 20_110_720


class Genericity(NamedTuple):
    """What is known of a vector of a basis."""

    is_special: bool
    together: tuple[int, ...] = ()
    """Indices of those among which the choice is free; empty where it is not."""
    special: int = 0
    """How many of these are special."""


def by_count(indices: Sequence[int], special: int) -> dict[int, Genericity]:
    """So many of some, nobody knows which: the last ones."""
    first = len(indices) - special
    together = tuple(indices)
    return {j: Genericity(k >= first, together, special) for k, j in enumerate(indices)}


def told_apart(
    told: FloatArray, never: FloatArray, groups: Sequence[tuple[Sequence[int], int]]
) -> list[Genericity]:
    """Which of some vectors are special.

    Args:
        told: (d, k) independent vectors of unit length in a null space, by an orthonormal basis.
        never: (d, g) orthonormal, those that nothing lifts.
        groups: Of vectors that no misalignment lifts together with others, and how many of
            each group are special; what is in no group is generic.
    """
    beyond = told - never @ (never.T @ told)
    made = [Genericity(False)] * told.shape[1]
    for indices, special in groups:
        for k, found in _of_group(beyond, indices, special).items():
            made[k] = found
    return made


def _of_group(beyond: FloatArray, indices: Sequence[int], special: int) -> dict[int, Genericity]:
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
        return by_count(indices, special)
    if len(lifted) == len(chosen):
        return {k: Genericity(k in chosen) for k in indices}
    together = tuple(lifted)
    return {
        k: Genericity(k in chosen, together, len(chosen)) if k in lifted else Genericity(False)
        for k in indices
    }


#: What misalignments lift together: which, and how many of them are special.
Groups = list[tuple[list[int], int]]


class Lifted(Frozen):
    """What misalignments make of the motions and self-stresses of a result.

    Attributes:
        gradients: The derivatives of all pairs.
        motions: (k, g) orthonormal combinations of the motions that nothing lifts.
        stresses: (s, g) likewise.
        special: How many of either are special.
    """

    def __init__(self, gradients: Gradients, generic_rank: int) -> None:
        """Find both spaces."""
        self.gradients = gradients
        result = gradients.result
        # By every place, in lengths of the mechanism, and every vector: (changes, s, k).
        at_nodes = result.characteristic_length * gradients.at_nodes()
        flat = (-1, *at_nodes.shape[2:])
        changes = self._changes = np.concatenate(
            (at_nodes.reshape(flat), gradients.by_vector.reshape(flat))
        )
        self.special = generic_rank - result.rank
        motions = _kernel(np.moveaxis(changes, 2, 0).reshape(changes.shape[2], -1))
        stresses = _kernel(np.moveaxis(changes, 1, 0).reshape(changes.shape[1], -1))
        of_motions, of_stresses = result.columns - generic_rank, result.rows - generic_rank
        if motions.shape[1] > of_motions or stresses.shape[1] > of_stresses:
            left = gradients.left_over(of_motions, of_stresses)
            if left is not None:
                motions = _within(motions, left[0], of_motions)
                stresses = _within(stresses, left[1], of_stresses)
        self.motions, self.stresses = motions, stresses

    def couplings(self, stresses: FloatArray, motions: FloatArray) -> FloatArray:
        """(a, b) how much all changes make of self-stresses (s, a) and motions (k, b)."""
        return np.asarray(np.linalg.norm(self._blocks(stresses, motions), axis=2))

    def _blocks(self, stresses: FloatArray, motions: FloatArray) -> FloatArray:
        return np.asarray(np.moveaxis(stresses.T @ self._changes @ motions, 0, 2))

    def groups(self, stresses: FloatArray, motions: FloatArray) -> tuple[Groups, Groups] | None:
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
        made = []
        for group in np.unique(owner[pairs[:, 0]]).tolist() if len(pairs) else []:
            mine = np.flatnonzero(owner == group)
            rows, columns = mine[mine < count], mine[mine >= count] - count
            values = np.linalg.svd(mixed[np.ix_(rows, columns)], compute_uv=False)
            special = int(np.count_nonzero(values > _NOTHING * values[0]))
            made.append((rows.tolist(), columns.tolist(), special))
        if sum(special for _, _, special in made) != self.special:
            return None
        return (
            [(rows, special) for rows, _, special in made],
            [(columns, special) for _, columns, special in made],
        )


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
    rank, trials = generic_rank(whole)
    motions, stresses = len(result.motions), len(result.self_stresses)
    if rank is None or rank == whole.rank:
        one = Cause(CauseKind.UNKNOWN if rank is None else CauseKind.GENERIC)
        tried = 0 if rank is None else trials
        return Causes((one,) * motions, (one,) * stresses, (), rank, tried)
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
    told = by_count(range(count), min(special, count)).values()
    return _made(list(told), lambda _, kind: Cause(kind))


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
        self.shares = UndividedBasis(result, whole, self.gradients)
        self.trials = Trials(whole, rank)

    def causes(self, trials: int) -> Causes:
        """All of it."""
        lifts = MisalignmentRates(self.gradients)
        motions, stresses = self.shares.motions, self.shares.stresses
        pairs = self.lifted.couplings(self.shares.own_stresses, motions)

        def of_motion(k: int, kind: CauseKind) -> Cause:
            share = motions[:, k]
            relations = self._of_motion(pairs[:, k])
            return Cause(kind, lift=lifts.of_motion(share), relations=relations)

        def of_stress(k: int, kind: CauseKind) -> Cause:
            share = stresses[:, k]
            return Cause(kind, lift=lifts.of_stress(share), relations=self._of_stress(share))

        mends: tuple[Step, ...] = ()
        if self.whole.is_told_by_parts:
            relations = merged(chain(*self._relations.values()))
            mends = mends_of(self.whole, relations, self._motions)
            mends = mends or joint_move(self.whole, self.gradients)
        return Causes(
            _made(self._motions_told(motions), of_motion),
            _made(self._stresses_told(stresses), of_stress),
            mends,
            self.rank,
            trials,
        )

    # Which are special ------------------------------------------------------

    def _motions_told(self, told: FloatArray) -> list[Genericity]:
        groups = self.lifted.groups(self.shares.own_stresses, told)
        return self._told(told, self.generic[0], self.lifted.motions, groups and groups[1])

    def _stresses_told(self, told: FloatArray) -> list[Genericity]:
        groups = self.lifted.groups(told, self.shares.own_motions)
        return self._told(told, self.generic[1], self.lifted.stresses, groups and groups[0])

    def _told(
        self, told: FloatArray, generic: int, never: FloatArray, groups: Groups | None
    ) -> list[Genericity]:
        """Which of some told vectors are special; what the undivided mechanism has not is not."""
        there = np.flatnonzero(np.linalg.norm(told, axis=0) > THERE).tolist()
        if generic == 0 and len(there) == told.shape[1]:
            return [Genericity(True)] * len(there)
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
            which, special = (told[k].together, told[k].special) if told[k].together else ((k,), 1)
            made[k] = relations_of(whole, which, self._motions, self.trials, special)
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


def _made(told: list[Genericity], cause_of: Callable[[int, CauseKind], Cause]) -> tuple[Cause, ...]:
    """The causes of some modes; `cause_of` makes what may be special."""
    made = []
    for k, one in enumerate(told):
        if not one.is_special and not one.together:
            made.append(Cause(CauseKind.GENERIC))
            continue
        found = cause_of(k, CauseKind.SPECIAL if one.is_special else CauseKind.GENERIC)
        # What lifts nothing is none.
        lift, first_order = found.lift or None, None if found.lift is None else bool(found.lift)
        made.append(
            Cause(found.kind, one.together, one.special, lift, first_order, found.relations)
        )
    return tuple(made)
