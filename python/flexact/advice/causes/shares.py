# SPDX-License-Identifier: BSD-3-Clause
"""The told motions and self-stresses by orthonormal ones of the undivided mechanism."""

from __future__ import annotations

import numpy as np

from ...analysis.modes import Motion, SelfStress
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...core.elements import NodeKind
from ...util.cached import cached_property
from ...util.records import Frozen
from .gradients import Gradients

#: A told vector of which less than this lies in the space of the undivided mechanism is not there.
THERE = 0.5


class Shares(Frozen):
    """Columns of unit length, zero of what the undivided mechanism has not.

    Attributes:
        result: The result of which modes are told.
        whole: The same with divided sheets and wires as one beam each.
        gradients: Has the orthonormal bases of `whole`.
    """

    def __init__(self, result: Result, whole: Result, gradients: Gradients) -> None:
        """Keep them; shares are found when they are asked for."""
        self.result, self.whole, self.gradients = result, whole, gradients

    @cached_property
    def motions(self) -> FloatArray:
        """(k, told) the told motions."""
        told = self.result.motions
        if self.whole is self.result:
            return self.own_motions
        made = np.zeros((self.gradients.motions.shape[1], len(told)))
        for k, motion in enumerate(told):
            made[:, k] = self._share_of_motion(motion)
        return _unit(made)

    @cached_property
    def own_motions(self) -> FloatArray:
        """(k, told) those of the undivided mechanism."""
        scale = self.whole.raw.column_scale
        told = self.whole.motion_basis.toarray() / scale[:, None]
        return _unit(self.gradients.motions.T @ told)

    def _share_of_motion(self, motion: Motion) -> FloatArray:
        """(k,) of a motion of the divided mechanism; zero of one inside of a part."""
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
        return np.asarray(share / size if np.linalg.norm(share) > THERE * size else 0.0 * share)

    @cached_property
    def stresses(self) -> FloatArray:
        """(s, told) the told self-stresses."""
        told = self.result.self_stresses
        whole = self.whole
        own = self.own_stresses
        if whole is self.result or not len(told):
            return own[:, : len(told)]
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
    def own_stresses(self) -> FloatArray:
        """(s, told) those of the undivided mechanism."""
        scale = self.whole.raw.row_scale
        told = self.whole.stress_basis.toarray() / scale[:, None]
        return _unit(self.gradients.stresses.T @ told)


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
