# SPDX-License-Identifier: BSD-3-Clause
"""The twists that a body has when nothing is declared.

Every declared coordinate and deformation is made dependent; the motions that are left are
projected on the body. Which directions of the projection are real is decided by their singular
values: what is not zero is far above what the arithmetic left of the others, `Outcome.rounding`.
Divided sheets and wires count as one beam each, declared or not, so that what is inside of them
adds nothing to what a body can do.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...analysis.decomposition import Asked
from ...analysis.result import Result
from ...analysis.spaces import decompose
from ...analysis.weights import column_weights
from ...core.arrays import FloatArray
from ...core.elements import Class
from ...core.raw import RawAnalysis
from ...deck.errors import model_error
from ...model.data import ModelData
from ...util.cached import cached_property
from .screw_space import ScrewSpace, canonical
from .spaces_subjects import Subject


class _Rows(NamedTuple):
    """Motions side by side, stored by rows."""

    start: NDArray[np.integer]
    """(size + 1,) where the entries of each row begin."""
    vector: NDArray[np.integer]
    """(entries,) the motion that each belongs to."""
    value: FloatArray
    """(entries,)."""
    vectors: int
    """How many motions there are."""


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

    def has(self, subject: Subject) -> bool:
        """Whether none of its nodes is inside of a divided sheet or wire."""
        return self._place_of.keys() >= {*subject.positions, *subject.orientations}

    @property
    def is_known(self) -> bool:
        """Whether all motions are kept; of very large mechanisms there may be too many."""
        return self.outcome.raw.motions.vectors == self.outcome.under_constrained

    @cached_property
    def _motions(self) -> _Rows:
        """The motions by rows, each of unit norm with rotations as lengths."""
        if not self.is_known:
            raise model_error(
                "too-many-motions",
                f"with nothing declared there are {self.outcome.under_constrained} motions, too "
                "many to find what a body can do",
                "declare what is inside of divided sheets, or ask of a part of the mechanism",
            )
        motions, vector = self.outcome.raw.motions, self.outcome.raw.motions.of_entries()
        weighted = motions.value * column_weights(self.outcome)[motions.place]
        norms = np.sqrt(np.bincount(vector, weighted**2, motions.vectors))
        order = np.argsort(motions.place, kind="stable")
        start = np.searchsorted(motions.place[order], np.arange(motions.size + 1))
        return _Rows(start, vector[order], (motions.value / norms[vector])[order], norms.size)

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
        """(3, motions) mean velocity of some nodes in each motion [m or rad]."""
        motions = self._motions
        made = np.zeros((3, motions.vectors))
        for node in nodes:
            for axis in range(3):
                column = self._row_of.get((self._place_of[node], axis))
                if column is not None:
                    mine = slice(int(motions.start[column]), int(motions.start[column + 1]))
                    made[axis, motions.vector[mine]] += motions.value[mine]
        return made / len(nodes)

    def twists(self, subject: Subject) -> FloatArray:
        """(6, motions) of a body about its middle, rotations times the characteristic length."""
        velocity = self._rates(subject.positions)
        rotation = self._rates(subject.orientations)
        return np.concatenate((rotation * self.result.characteristic_length, velocity))

    def space(self, subject: Subject) -> ScrewSpace:
        """All twists that a body has.

        Raises:
            ModelError: there are too many motions to be kept.
        """
        one = self.result
        length = one.characteristic_length
        left, sizes, _ = np.linalg.svd(self.twists(subject), full_matrices=False)
        rank = int(np.sum(sizes > self.outcome.rounding * max(1.0, sizes.max(initial=0.0))))
        rows = canonical(left[:, :rank].T) / np.repeat((length, 1.0), 3)
        return ScrewSpace(rows, subject.middle(one), length, False, one.given.planar)
