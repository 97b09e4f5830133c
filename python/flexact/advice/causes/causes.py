# SPDX-License-Identifier: BSD-3-Clause
"""The cause of each motion and self-stress of a result."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import numpy as np

from ...core.arrays import FloatArray
from ...core.elements import NodeKind
from ...result.modes import Motion, SelfStress
from ...result.result import Result
from .cause import Cause, CauseKind, Causes, Lift, Relation
from .generic import generic_rank
from .gradients import Gradients, are_affordable
from .kinds import Lifted, Told, all_alike, by_count, told_apart
from .lifts import Lifts
from .mends import Mend, mends_of
from .relations import relations_of

#: A told vector of which less than this lies in the space of the undivided mechanism is not there.
_THERE = 0.5
#: How many special self-stresses are explained, and by how many relations each.
_MOST_EXPLAINED, _MOST_RELATIONS = 8, 3
#: Pairs below this part of the largest do not belong together.
_COUPLED = 1.0e-6


def causes_of(result: Result) -> Causes:
    """Why the motions and self-stresses of a result are there.

    Divided sheets and wires count as one beam each, whether they are declared so or not.

    Args:
        result: The result of an analysis.

    Raises:
        ModelError, DeckError, AnalysisError: the mechanism with its divided sheets as one beam
            each cannot be analysed.
    """
    whole = result.with_internal_declared or result
    rank, trials = generic_rank(whole)
    if rank is None:
        return _not_looked_at(result)
    return _Finding(result, whole, rank).causes(trials)


def _not_looked_at(result: Result) -> Causes:
    unknown = Cause(CauseKind.UNKNOWN)
    return Causes((unknown,) * len(result.motions), (unknown,) * len(result.self_stresses))


class _Finding:
    """What is needed for the causes of one result.

    Attributes:
        result: The result of which modes are told.
        whole: The same with divided sheets and wires as one beam each.
    """

    def __init__(self, result: Result, whole: Result, rank: int) -> None:
        self.result, self.whole, self.rank = result, whole, rank
        self.motions, self.stresses = whole.columns - rank, whole.rows - rank
        self.is_special = rank > whole.rank
        able = self.is_special and are_affordable(whole)
        self.gradients = Gradients(whole) if able else None

    def causes(self, trials: int) -> Causes:
        """All of it."""
        lifted = None if self.gradients is None else Lifted(self.gradients, self.rank)
        lifts = None if self.gradients is None else Lifts(self.gradients)
        of_motions = self._motions_told()
        of_stresses = self._stresses_told()
        motions = self._told(of_motions, self.motions, None if lifted is None else lifted.motions)
        stresses = self._told(
            of_stresses, self.stresses, None if lifted is None else lifted.stresses
        )
        special = self._special_relations(lifted)
        return Causes(
            _made(
                motions,
                of_motions,
                None if lifts is None else lifts.of_motion,
                lambda share: self._of_motion(share, special),
            ),
            _made(
                stresses,
                of_stresses,
                None if lifts is None else lifts.of_stress,
                lambda share: self._of_stress(share, special),
            ),
            self._mends(lifted, special),
            self.rank,
            trials,
        )

    # What makes it special --------------------------------------------------

    def _special_relations(self, lifted: Lifted | None) -> dict[int, tuple[Relation, ...]]:
        """What makes the geometry special, by the self-stress of the undivided mechanism."""
        whole = self.whole
        if lifted is None or not whole.is_told_by_parts:
            return {}
        told = self._told(self._own_stresses, self.stresses, lifted.stresses)
        if told.together:
            last = int(np.flatnonzero(told.is_special)[-1])
            found = relations_of(whole, told.together) or relations_of(whole, (last,))
            return {k: found for k in np.flatnonzero(told.is_special).tolist()}
        chosen = np.flatnonzero(told.is_special)[:_MOST_EXPLAINED].tolist()
        return {k: relations_of(whole, (k,)) for k in chosen}

    def _mends(
        self, lifted: Lifted | None, special: dict[int, tuple[Relation, ...]]
    ) -> tuple[Mend, ...]:
        if lifted is None or not special:
            return ()
        told = self._told(self._own_motions, self.motions, lifted.motions)
        motions = [self.whole.motions[k] for k in np.flatnonzero(told.is_special).tolist()]
        return mends_of(self.whole, _all_of(special), motions)

    def _of_stress(
        self, share: FloatArray, special: dict[int, tuple[Relation, ...]]
    ) -> tuple[Relation, ...]:
        """Of the special self-stress that has the largest part in one."""
        if not special:
            return ()
        parts = np.abs(np.linalg.lstsq(self._own_stresses, share)[0])
        return special[max(special, key=lambda k: (round(float(parts[k]), 9), -k))]

    def _of_motion(
        self, share: FloatArray, special: dict[int, tuple[Relation, ...]]
    ) -> tuple[Relation, ...]:
        """Of all special self-stresses that misalignments lift together with a motion."""
        if self.gradients is None:
            return ()
        pairs = {}
        for k in special:
            of_stress = self._own_stresses[:, k]
            pairs[k] = self.gradients.coupling(of_stress, share)
        largest = max(pairs.values(), default=0.0)
        able = [k for k in special if pairs[k] > _COUPLED * largest] or list(special)
        return _all_of({k: special[k] for k in able})[:_MOST_RELATIONS]

    def _told(self, told: FloatArray, generic: int, never: FloatArray | None) -> Told:
        count = told.shape[1]
        if not self.is_special or not count:
            return all_alike(count, False)
        here = np.linalg.norm(told, axis=0) > _THERE
        if generic == 0 and here.all():
            return all_alike(count, True)
        special = self.rank - self.whole.rank
        if never is None:
            return by_count(count, min(special, count))
        there = np.flatnonzero(here)
        found = told_apart(told[:, there], never, generic)
        labels = np.zeros(count, bool)
        labels[there] = found.is_special
        together = tuple(there[list(found.together)].tolist())
        return Told(tuple(labels.tolist()), together, found.special)

    def _motions_told(self) -> FloatArray:
        """(k, told) the told motions by the orthonormal ones of the undivided mechanism."""
        told = self.result.motions
        if self.gradients is None:
            return np.ones((1, len(told)))
        if self.whole is self.result:
            return self._own_motions
        made = np.zeros((self.gradients.motions.shape[1], len(told)))
        for k, motion in enumerate(told):
            made[:, k] = self._share_of_motion(motion)
        return _unit(made)

    @cached_property
    def _own_motions(self) -> FloatArray:
        """(k, told) those of the undivided mechanism."""
        assert self.gradients is not None
        scale = self.whole.raw.column_scale
        told = self.whole.motion_basis.toarray() / scale[:, None]
        return _unit(self.gradients.motions.T @ told)

    def _share_of_motion(self, motion: Motion) -> FloatArray:
        """(k,) of a motion of the divided mechanism; zero of one inside of a part."""
        assert self.gradients is not None
        whole = self.whole
        node, axis = whole.raw.column_label - 1
        given = whole.condensed.nodes[node]
        placed = whole.data.arrays.node_kind[node] <= NodeKind.POSITION
        both = np.where(placed, motion.displacement[given, axis], motion.rotation[given, axis])
        vector = both / whole.raw.column_scale
        share = self.gradients.motions.T @ vector
        size = float(np.linalg.norm(vector))
        everything = np.concatenate((motion.displacement, motion.rotation))
        if motion.is_internal or not size > 1.0e-9 * float(np.abs(everything).max()):
            return np.zeros_like(share)
        return np.asarray(share / size if np.linalg.norm(share) > _THERE * size else 0.0 * share)

    def _stresses_told(self) -> FloatArray:
        """(s, told) likewise of the self-stresses."""
        told = self.result.self_stresses
        if self.gradients is None:
            return np.ones((1, len(told)))
        whole = self.whole
        own = self._own_stresses
        if whole is self.result:
            return own
        of_whole = _loads_of(list(whole.self_stresses))
        of_told = _loads_of(list(told))
        keys = {key: i for i, key in enumerate(sorted({*of_whole, *of_told}))}
        left, right = np.zeros((len(keys), 6, own.shape[1])), np.zeros((len(keys), 6, len(told)))
        for loads, made in ((of_whole, left), (of_told, right)):
            for key, block in loads.items():
                made[keys[key]] = block
        shares = np.linalg.lstsq(left.reshape(-1, own.shape[1]), right.reshape(-1, len(told)))[0]
        return _unit(own @ shares)

    @cached_property
    def _own_stresses(self) -> FloatArray:
        """(s, told) those of the undivided mechanism."""
        assert self.gradients is not None
        scale = self.whole.raw.row_scale
        told = self.whole.stress_basis.toarray() / scale[:, None]
        return _unit(self.gradients.stresses.T @ told)


def _all_of(special: dict[int, tuple[Relation, ...]]) -> tuple[Relation, ...]:
    return tuple(dict.fromkeys(one for found in special.values() for one in found))


def _loads_of(stresses: list[SelfStress]) -> dict[tuple[int, int], FloatArray]:
    """(6, stresses) what parts exert where they end, by their first element and the node."""
    made: dict[tuple[int, int], FloatArray] = {}
    for k, stress in enumerate(stresses):
        for one in stress.parts:
            for end in one.ends:
                key = one.part.elements[0], -1 if end.position is None else end.position
                block = made.setdefault(key, np.zeros((6, len(stresses))))
                wrench = end.wrench
                block[:3, k] = wrench.force * wrench.length
                block[3:, k] = wrench.moment
    return made


def _unit(vectors: FloatArray) -> FloatArray:
    """Columns of unit length; those that are nothing stay zero."""
    sizes = np.linalg.norm(vectors, axis=0)
    made: FloatArray = np.where(sizes > 1.0e-9, vectors / np.where(sizes > 0.0, sizes, 1.0), 0.0)
    return made


def _made(
    told: Told,
    shares: FloatArray,
    lift_of: Callable[[FloatArray], Lift] | None,
    relations_of_share: Callable[[FloatArray], tuple[Relation, ...]],
) -> tuple[Cause, ...]:
    made = []
    for k, is_special in enumerate(told.is_special):
        kind = CauseKind.SPECIAL if is_special else CauseKind.GENERIC
        free = k in told.together
        lift: Lift | None = None
        relations: tuple[Relation, ...] = ()
        if lift_of is not None and shares[:, k].any() and (is_special or free):
            lift = lift_of(shares[:, k])
            relations = relations_of_share(shares[:, k])
        made.append(
            Cause(
                kind,
                told.together if free else (),
                told.special if free else 0,
                lift or None,
                bool(lift),
                relations,
            )
        )
    return tuple(made)
