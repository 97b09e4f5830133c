# SPDX-License-Identifier: BSD-3-Clause
"""Reduced matrices in SPACAR's sense: in the declared coordinates and deformations."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core import elastic
from ..core.arrays import FloatArray, IntArray, PackedModel, packed
from ..core.elastic import ElasticArrays, ElasticState
from ..core.elements import AXES, Class, coordinate_name
from ..model.data import ModelData
from ..model.prescribed import class_statements, prescribed_in
from ..util.cached import cached_property
from .policy import Policy, notch_in_units
from .solution import Solution


class Reduced(NamedTuple):
    """Mass, stiffness and geometric stiffness, each (q, q)."""

    mass: FloatArray
    stiffness: FloatArray
    geometric: FloatArray


class Reducer:
    """The deck's own elements with its own classes, whatever is elastic."""

    def __init__(self, data: ModelData, policy: Policy) -> None:
        """Keep the model as given, with what its elements are made of."""
        self.data, self._policy = data, policy

    @cached_property
    def labels(self) -> tuple[tuple[int, str | int], ...]:
        """Node and coordinate, or element and deformation (from 1), of each row."""
        arrays = self.data.arrays
        made: list[tuple[int, str | int]] = []
        for place in self.independent.tolist():
            if place >= 0:
                node, axis = divmod(place, 3)
                kind = int(arrays.node_kind[node])
                made.append((int(arrays.node_number[node]), coordinate_name(kind, axis)))
            else:
                element, k = divmod(-1 - place, 6)
                made.append((int(arrays.element_number[element]), k + 1))
        return tuple(made)

    @cached_property
    def independent(self) -> IntArray:
        """(q,) coordinates 3 node + axis, then deformations -1 - (6 element + deformation).

        In the order of the deck's statements; inputs are none of them.
        """
        arrays, inputs = self.data.arrays, prescribed_in(self.data)
        dynamic = (arrays.coordinate_class == Class.INDEPENDENT) & ~inputs.coordinates
        modes = (arrays.deformation_class == Class.INDEPENDENT) & ~inputs.deformations
        nodes, elements = self._order(b"X"), self._order(b"E")
        places = [
            3 * node + axis
            for node in [*nodes, *(n for n in range(dynamic.shape[1]) if n not in nodes)]
            for axis in AXES[int(arrays.node_kind[node])]
            if dynamic[axis, node]
        ]
        places += [
            -1 - (6 * element + k)
            for element in [*elements, *(e for e in range(modes.shape[1]) if e not in elements)]
            for k in range(6)
            if modes[k, element]
        ]
        return np.array(places, np.int32)

    def _order(self, letter: bytes) -> dict[int, None]:
        """Indices of nodes or elements as the deck's statements name them."""
        index = self.data.node_index if letter == b"X" else self.data.element_index
        return {
            index[number]: None
            for which, number, _ in class_statements(self.data, b"DYN")
            if which == letter and number in index
        }

    @cached_property
    def _model(self) -> tuple[PackedModel, ElasticArrays]:
        arrays, inputs = self.data.arrays, prescribed_in(self.data)
        given = arrays.coordinate_class
        coordinates = np.where(given == Class.INDEPENDENT, Class.DEPENDENT, given)
        coordinates[inputs.coordinates] = Class.FIXED
        own = arrays.deformation_class
        deformations = np.where(own == Class.INDEPENDENT, Class.DEPENDENT, own)
        deformations[inputs.deformations] = Class.FIXED
        model = packed(
            arrays._replace(
                coordinate_class=np.asfortranarray(coordinates, np.int32),
                deformation_class=np.asfortranarray(deformations, np.int32),
            )
        )
        given_arrays = self._policy.arrays
        return model, given_arrays._replace(notch=notch_in_units(self.data, given_arrays.notch))

    def of(self, at: Solution) -> Reduced:
        """The matrices of the deck's elements where their ends are, under their stresses."""
        mesh = at.solver.mesh
        model, arrays = self._model
        state = ElasticState(
            mesh.own_nodes(at.raw.configuration), at.stress, mesh.own_nodes(at.raw.reaction)
        )
        if not self.independent.size:
            return Reduced(*(np.zeros((0, 0)) for _ in range(3)))
        independent = tuple(self.independent.tolist())
        raw = elastic.matrices(model, arrays, state, at.way.gravity, independent)
        return Reduced(raw.mass, raw.stiffness, raw.geometric)
