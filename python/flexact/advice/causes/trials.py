# SPDX-License-Identifier: BSD-3-Clause
"""Whether a relation is enough: other geometries that have it, and nothing else, are tried."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...base.frozen import Frozen
from ...core.arrays import FloatArray
from ...model.parts.parts import Part
from ...result.result import Result
from .generic import Geometry, rank_at

_TRIALS = 2
_SEED = 19_800_101


class Trials(Frozen):
    """Random geometries of a mechanism that keep a relation.

    Attributes:
        result: The result whose rank they must not exceed.
    """

    def __init__(self, result: Result) -> None:
        """Keep the result."""
        self.result = result
        self._geometry = Geometry(result.data)

    def with_parallel(self, groups: Sequence[Sequence[Part]]) -> bool:
        """Whether parallel axes in each group are enough, nodes being anywhere."""

        def axes(rng: np.random.Generator, _: FloatArray, vectors: FloatArray) -> None:
            for group in groups:
                vectors[self._elements(group)] = _unit(rng)

        return self._all_keep(axes)

    def with_concurrent(self, parts: Sequence[Part]) -> bool:
        """Whether axes through one point are enough."""
        elements = self._elements(parts)
        arrays = self.result.data.arrays
        orientations = arrays.element_node[[1, 3]][:, elements] - 1
        owners = [
            {
                int(node)
                for k in (0, 2)
                for node in arrays.element_node[k][
                    (arrays.element_node[k + 1] - 1 == op) | (arrays.element_node[k + 1] - 1 == oq)
                ]
                - 1
                if node >= 0
            }
            for op, oq in orientations.T.tolist()
        ]

        def axes(rng: np.random.Generator, places: FloatArray, vectors: FloatArray) -> None:
            centre = rng.uniform(-1.0, 1.0, 3) * self.result.characteristic_length
            for element, nodes in zip(elements, owners, strict=True):
                at = self._hinge_place(element, nodes)
                if at is not None:
                    way = places[at] - centre
                    vectors[element] = way / np.linalg.norm(way)

        return self._all_keep(axes)

    def _hinge_place(self, element: int, nodes: set[int]) -> int | None:
        """The position node at which a hinge stands: shared by what turns on both sides."""
        given = self.result.parts.place_of
        arrays, condensed = self.result.data.arrays, self.result.condensed
        slots = arrays.element_node[:, element] - 1
        for node in slots.tolist():
            if node < 0:
                continue
            place = given(int(condensed.nodes[node]))
            found = [n for n in nodes if int(condensed.nodes[n]) == place]
            if found:
                return found[0]
        return None

    def keeps(self, places: FloatArray, vectors: FloatArray) -> bool:
        """Whether the rank at a geometry is as low as that of the result."""
        rank = rank_at(self._geometry, places, vectors)
        return rank is not None and rank <= self.result.rank

    @property
    def geometry(self) -> Geometry:
        """The places and vectors of the mechanism."""
        return self._geometry

    def _all_keep(self, change: object) -> bool:
        for trial in range(_TRIALS):
            places, vectors = self._geometry.random(2 * trial)
            change(np.random.default_rng((_SEED, trial)), places, vectors)  # type: ignore[operator]
            if not self.keeps(places, vectors):
                return False
        return True

    def _elements(self, parts: Sequence[Part]) -> list[int]:
        """Their elements in the model as analysed."""
        own = self.result.condensed.elements
        return [int(np.searchsorted(own, part.elements[0])) for part in parts]


def _unit(rng: np.random.Generator) -> FloatArray:
    made = rng.normal(size=3)
    return np.asarray(made / np.linalg.norm(made))
