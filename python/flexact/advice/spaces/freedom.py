# SPDX-License-Identifier: BSD-3-Clause
"""The twists that a body has when nothing is declared.

Every declared coordinate and deformation is made dependent; the motions that are left are
projected on the body. Which directions of the projection are real is decided by their singular
values: what is not zero is far above what the arithmetic left of the others, `Outcome.rounding`.
Divided sheets and wires count as one beam each, declared or not, so that what is inside of them
adds nothing to what a body can do.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from ...core.arrays import FloatArray
from ...core.basis import Basis
from ...core.elements import Class
from ...core.raw import RawAnalysis
from ...diagnostics.errors import model_error
from ...model.data import ModelData
from ...result.decompose import decompose
from ...result.outcome import Asked
from ...result.result import Result
from ...result.sparse_basis import orthonormal
from ...result.weights import column_weights
from .screw_space import ScrewSpace
from .subjects import Subject


class Freed:
    """A mechanism in which nothing is declared; each answer is found when it is asked for."""

    def __init__(self, result: Result, *, is_freed: bool = True) -> None:
        """Keep the result; that of divided sheets as one beam each, where there are any."""
        self.result = result.with_internal_declared or result
        self._is_freed = is_freed

    @classmethod
    def as_declared(cls, result: Result) -> Freed:
        """The mechanism with its declarations: what moves is what nobody declared."""
        return cls(result, is_freed=False)

    @cached_property
    def _data(self) -> ModelData:
        data = self.result.data
        arrays = data.arrays
        coordinates, deformations = (
            np.where(classes == Class.INDEPENDENT, np.int32(Class.DEPENDENT), classes)
            for classes in (arrays.coordinate_class, arrays.deformation_class)
        )
        return ModelData(
            arrays._replace(
                coordinate_class=np.asfortranarray(coordinates),
                deformation_class=np.asfortranarray(deformations),
            ),
            data.planar,
            data.name,
            data.element_names,
            given_appearance=data.given_appearance,
            has_long_numbers=data.has_long_numbers,
        )

    @cached_property
    def _raw(self) -> RawAnalysis:
        if not self._is_freed or not self.result.degrees_of_freedom:
            return self.result.raw
        asked = self.result.asked
        return decompose(self._data, Asked(asked.method, asked.tolerance))

    @cached_property
    def outcome(self) -> Result:
        """What is known of it, at the nodes of the model in which divided sheets are one beam."""
        one = self.result
        return Result(one.name, one.condensed, self._raw, one.asked)

    @cached_property
    def _motions(self) -> Basis:
        outcome = self.outcome
        if outcome.raw.motions.vectors < outcome.under_constrained:
            raise model_error(
                "too-many-motions",
                f"with nothing declared there are {outcome.under_constrained} motions, too many "
                "to find what each body can do",
            )
        return orthonormal(outcome.raw.motions, column_weights(outcome))

    @cached_property
    def _place_of(self) -> dict[int, int]:
        """Index in the model that is analysed of each node, by its index in that given."""
        return {node: k for k, node in enumerate(self.result.condensed.nodes.tolist())}

    @cached_property
    def _row_of(self) -> dict[tuple[int, int], int]:
        """Column of D(c) by node and axis."""
        labels = (self._raw.column_label - 1).T.tolist()
        return {(node, axis): k for k, (node, axis) in enumerate(labels)}

    def _rates(self, nodes: tuple[int, ...]) -> FloatArray:
        """(nodes, 3, motions) velocity of some nodes in each motion [m or rad]."""
        motions = self._motions
        weights = column_weights(self.outcome)
        made = np.zeros((3 * len(nodes), motions.vectors))
        of_entry = motions.of_entries()
        wanted = np.full(motions.size, -1)
        for k, node in enumerate(nodes):
            for axis in range(3):
                column = self._row_of.get((self._place_of[node], axis))
                if column is not None:
                    wanted[column] = 3 * k + axis
        used = wanted[motions.place] >= 0
        columns = motions.place[used]
        made[wanted[columns], of_entry[used]] = motions.value[used] / weights[columns]
        return made.reshape(len(nodes), 3, motions.vectors)

    def twists(self, subject: Subject) -> FloatArray:
        """(6, motions) of a body about its middle, rotations times the characteristic length."""
        velocity = self._rates(subject.positions).mean(axis=0)
        rotation = self._rates(subject.orientations).mean(axis=0)
        return np.concatenate((rotation * self.result.characteristic_length, velocity))

    def space(self, subject: Subject) -> ScrewSpace:
        """All twists that a body has.

        Raises:
            ModelError: there are too many motions to be kept.
        """
        one = self.result
        length = one.characteristic_length
        left, sizes, _ = np.linalg.svd(self.twists(subject), full_matrices=False)
        rank = int(np.sum(sizes > self.outcome.rounding))
        rows = left[:, :rank].T / np.repeat((length, 1.0), 3)
        return ScrewSpace(rows, subject.middle(one), length, False, one.given.planar)
