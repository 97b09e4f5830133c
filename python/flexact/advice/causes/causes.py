# SPDX-License-Identifier: BSD-3-Clause
"""The cause of each motion and self-stress of a result."""

from __future__ import annotations

import numpy as np

from ...core.arrays import FloatArray
from ...core.elements import NodeKind
from ...result.modes import Motion, SelfStress
from ...result.result import Result
from .cause import Cause, CauseKind, Causes, Lift
from .generic import generic_rank
from .gradients import Gradients, are_affordable
from .kinds import Lifted, Told, all_alike, by_count, told_apart
from .lifts import Lifts

#: A told vector of which less than this lies in the space of the undivided mechanism is not there.
_THERE = 0.5
_LARGE = 400


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
        return Causes(
            _made(motions, of_motions, None if lifts is None else lifts.of_motion),
            _made(stresses, of_stresses, None if lifts is None else lifts.of_stress),
            (),
            self.rank,
            trials,
        )

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
        whole, scale = self.whole, self.whole.raw.column_scale
        if whole is self.result:
            made = self.gradients.motions.T @ (whole.motion_basis.toarray() / scale[:, None])
        else:
            made = np.zeros((self.gradients.motions.shape[1], len(told)))
            for k, motion in enumerate(told):
                made[:, k] = self._share_of_motion(motion)
        return _unit(made)

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
        whole, scale = self.whole, self.whole.raw.row_scale
        own = self.gradients.stresses.T @ (whole.stress_basis.toarray() / scale[:, None])
        if whole is self.result:
            return _unit(own)
        of_whole = _loads_of(list(whole.self_stresses))
        of_told = _loads_of(list(told))
        keys = {key: i for i, key in enumerate(sorted({*of_whole, *of_told}))}
        left, right = np.zeros((len(keys), 6, own.shape[1])), np.zeros((len(keys), 6, len(told)))
        for loads, made in ((of_whole, left), (of_told, right)):
            for key, block in loads.items():
                made[keys[key]] = block
        shares = np.linalg.lstsq(left.reshape(-1, own.shape[1]), right.reshape(-1, len(told)))[0]
        return _unit(own @ shares)


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


def _made(told: Told, shares: FloatArray, lift_of: object) -> tuple[Cause, ...]:
    made = []
    for k, is_special in enumerate(told.is_special):
        kind = CauseKind.SPECIAL if is_special else CauseKind.GENERIC
        free = k in told.together
        lift: Lift | None = None
        if lift_of is not None and shares[:, k].any() and (is_special or free):
            lift = lift_of(shares[:, k])  # type: ignore[operator]
        made.append(
            Cause(
                kind,
                told.together if free else (),
                told.special if free else 0,
                lift or None,
                bool(lift),
            )
        )
    return tuple(made)
